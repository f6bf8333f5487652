// SPDX-License-Identifier: MIT
// draw.mjs - points as squares (in the plane) or small balls (solids), coloured by a field, straight into the pixels of a canvas; the
// colour bar; the plot of the ledger. Palettes go by lightness alone, so that all eyes can read them.

const PALETTES = {
    damage: {
        light: ["#c9dcea", "#e8c36a", "#d9822b", "#a63a14", "#4a1206"],
        dark: ["#263c52", "#7d4a2d", "#d0721f", "#f2b84b", "#fff6d0"],
    },
    energy: {
        light: ["#e9eef2", "#a9c4d4", "#5f93b4", "#2b5f8c", "#0b2347"],
        dark: ["#1c2733", "#1f4e79", "#3b86b3", "#8fc7d8", "#f4fbe8"],
    },
    speed: {
        light: ["#eef0ee", "#b8d0bd", "#71a68a", "#327561", "#06372f"],
        dark: ["#1d2927", "#1f5a4d", "#3f927a", "#93cbac", "#f4fbe8"],
    },
    stress: {
        light: ["#1b4f8f", "#7fb0d8", "#eef0f1", "#efb066", "#9a4a04"],
        dark: ["#8cc4f2", "#356fa6", "#222b35", "#b0661a", "#ffcf87"],
    },
};

const rgb = hex => [1, 3, 5].map(k => parseInt(hex.slice(k, k + 2), 16));

/** 256 colours as words of a pixel. */
function ramp(field, dark) {
    const stops = PALETTES[field][dark ? "dark" : "light"].map(rgb),
        out = new Uint32Array(256);
    for (let i = 0; i < 256; ++i) {
        const at = (i / 255) * (stops.length - 1),
            k = Math.min(stops.length - 2, Math.floor(at)),
            f = at - k;
        const [r, g, b] = [0, 1, 2].map(c => Math.round(stops[k][c] * (1 - f) + stops[k + 1][c] * f));
        out[i] = ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
    }
    return out;
}

export class Stage {
    constructor(canvas) {
        this.canvas = canvas;
        this.context = canvas.getContext("2d", { alpha: true });
        this.yaw = 0.6;
        this.pitch = 0.95;
        this.dark = false;
        this.ramps = {};
        this.range = [0, 1];
    }
    setScene(about) {
        this.about = about;
        this.frame = null;
        this.range = null;
        this.screen = new Float32Array(about.points * 2);
        this.depth = new Float32Array(about.points);
        this.resize();
    }
    setDark(dark) {
        this.dark = dark;
        this.ramps = {};
    }
    resize() {
        const box = this.canvas.getBoundingClientRect(),
            most = 1.1e6;
        let scale = Math.min(globalThis.devicePixelRatio || 1, 2);
        if (box.width * box.height * scale * scale > most) scale = Math.sqrt(most / (box.width * box.height));
        const width = Math.max(2, Math.round(box.width * scale)),
            height = Math.max(2, Math.round(box.height * scale));
        this.scale = scale;
        if (this.pixels?.width === width && this.pixels.height === height) return this.fit();
        this.canvas.width = width;
        this.canvas.height = height;
        this.pixels = this.context.createImageData(width, height);
        this.words = new Uint32Array(this.pixels.data.buffer);
        this.z = new Float32Array(width * height);
        return this.fit();
    }
    /** How metres become pixels. */
    fit() {
        if (!this.about) return;
        const { size, dim } = this.about,
            { width, height } = this.canvas;
        const cy = Math.cos(this.yaw),
            sy = Math.sin(this.yaw),
            cp = Math.cos(this.pitch),
            sp = Math.sin(this.pitch);
        this.right = dim === 2 ? [1, 0] : [cy, sy, 0];
        this.up = dim === 2 ? [0, 1] : [-sy * cp, cy * cp, sp];
        this.view = dim === 2 ? null : [-sy * sp, cy * sp, -cp]; // away from the eye
        const extent =
            dim === 2
                ? size
                : [Math.abs(cy) * size[0] + Math.abs(sy) * size[1], (Math.abs(sy) * size[0] + Math.abs(cy) * size[1]) * cp + size[2] * sp];
        this.zoom = Math.min((width * 0.86) / extent[0], (height * (dim === 2 ? 0.82 : 0.7)) / extent[1]);
        this.middle = size.map(l => l / 2);
    }
    project(x, out) {
        const { right, up, middle, zoom, canvas } = this;
        let u = 0,
            v = 0;
        for (let k = 0; k < right.length; ++k) {
            u += right[k] * (x[k] - middle[k]);
            v += up[k] * (x[k] - middle[k]);
        }
        out[0] = canvas.width / 2 + zoom * u;
        out[1] = canvas.height / 2 - zoom * v;
        return out;
    }
    /** The range of colours: damage is absolute, the others follow what there is, slowly when it falls. */
    follow(value, field) {
        if (field === "damage") {
            this.range = [0, 0.6];
            return;
        }
        const step = Math.max(1, Math.floor(value.length / 1500)),
            sample = [];
        for (let i = 0; i < value.length; i += step) sample.push(Math.abs(value[i]));
        sample.sort((a, b) => a - b);
        const high = sample[Math.floor(0.985 * (sample.length - 1))] || 1e-30,
            old = this.high && this.highOf === field ? this.high : high;
        this.high = high > old ? 0.7 * old + 0.3 * high : 0.97 * old + 0.03 * high;
        this.highOf = field;
        this.range = field === "stress" ? [-this.high, this.high] : [0, this.high];
    }
    show(frame, magnify) {
        this.frame = frame;
        this.magnify = magnify;
        this.follow(frame.value, frame.field);
        this.paint();
    }
    place() {
        // where each point is on the screen
        const { about, frame, magnify, right, up, view, middle, zoom, canvas, screen, depth } = this,
            { reference, dim } = about;
        const u = frame.displacement,
            w = canvas.width / 2,
            h = canvas.height / 2;
        for (let i = 0, k = 0; i < about.points; ++i, k += dim) {
            const x = reference[k] + magnify * u[k] - middle[0],
                y = reference[k + 1] + magnify * u[k + 1] - middle[1];
            if (dim === 2) {
                screen[2 * i] = w + zoom * x;
                screen[2 * i + 1] = h - zoom * y;
            } else {
                const z = reference[k + 2] + magnify * u[k + 2] - middle[2];
                screen[2 * i] = w + zoom * (right[0] * x + right[1] * y + right[2] * z);
                screen[2 * i + 1] = h - zoom * (up[0] * x + up[1] * y + up[2] * z);
                depth[i] = view[0] * x + view[1] * y + view[2] * z;
            }
        }
    }
    paint() {
        if (!this.frame) return;
        this.place();
        this.words.fill(0);
        const colours = (this.ramps[this.frame.field] ??= ramp(this.frame.field, this.dark));
        if (this.about.dim === 2) this.squares(colours);
        else this.balls(colours);
        this.context.putImageData(this.pixels, 0, 0);
        this.marks();
    }
    index(value) {
        const [lo, hi] = this.range,
            k = Math.floor((255.999 * (value - lo)) / (hi - lo));
        return k < 0 ? 0 : k > 255 ? 255 : k | 0;
    }
    squares(colours) {
        const { words, screen, about, frame } = this,
            { width, height } = this.canvas,
            half = (about.spacing * this.zoom) / 2;
        for (let i = 0; i < about.points; ++i) {
            const x0 = Math.max(0, Math.floor(screen[2 * i] - half)),
                x1 = Math.min(width, Math.ceil(screen[2 * i] + half));
            const y0 = Math.max(0, Math.floor(screen[2 * i + 1] - half)),
                y1 = Math.min(height, Math.ceil(screen[2 * i + 1] + half));
            const colour = colours[this.index(frame.value[i])];
            for (let y = y0; y < y1; ++y) for (let x = x0, k = y * width + x0; x < x1; ++x) words[k++] = colour;
        }
    }
    balls(colours) {
        const { about, frame, zoom, z } = this;
        z.fill(1e30);
        for (let i = 0; i < about.points; ++i)
            this.sphere(
                this.screen[2 * i],
                this.screen[2 * i + 1],
                this.depth[i],
                0.62 * about.spacing,
                colours[this.index(frame.value[i])],
                zoom,
            );
        const at = [0, 0],
            steel = this.dark ? 0xffc8beb4 : 0xff6b625a;
        for (const place of frame.balls) {
            const depth = place.reduce((sum, v, k) => sum + this.view[k] * (v - this.middle[k]), 0);
            this.project(place, at);
            this.sphere(at[0], at[1], depth, frame.ballRadius, steel, zoom);
        }
    }
    sphere(cx, cy, depth, radius, colour, zoom) {
        const { words, z } = this,
            { width, height } = this.canvas,
            r = radius * zoom,
            r2 = r * r;
        const x0 = Math.max(0, Math.ceil(cx - r)),
            x1 = Math.min(width - 1, Math.floor(cx + r));
        const y0 = Math.max(0, Math.ceil(cy - r)),
            y1 = Math.min(height - 1, Math.floor(cy + r));
        const red = colour & 255,
            green = (colour >> 8) & 255,
            blue = (colour >> 16) & 255;
        for (let y = y0; y <= y1; ++y) {
            for (let x = x0; x <= x1; ++x) {
                const dx = x - cx,
                    dy = y - cy,
                    d2 = r2 - dx * dx - dy * dy;
                if (d2 < 0) continue;
                const n = Math.sqrt(d2),
                    at = depth - n / zoom,
                    k = y * width + x;
                if (at >= z[k]) continue;
                z[k] = at;
                const lit = 0.5 + 0.5 * Math.max(0, (-0.4 * dx - 0.6 * dy + 0.7 * n) / r);
                words[k] = ((255 << 24) | (((blue * lit) & 255) << 16) | (((green * lit) & 255) << 8) | ((red * lit) & 255)) >>> 0;
            }
        }
    }
    /** The cursor of the keyboard, and what the pointer draws. */
    marks() {
        const { context, scale } = this;
        context.lineWidth = 1.5 * scale;
        context.strokeStyle = this.dark ? "#ffffff" : "#10202e";
        if (this.line) {
            context.setLineDash([5 * scale, 4 * scale]);
            context.beginPath();
            context.moveTo(...this.line[0]);
            context.lineTo(...this.line[1]);
            context.stroke();
            context.setLineDash([]);
        }
        if (this.cursor) {
            const [x, y] = this.cursor,
                r = 9 * scale;
            context.beginPath();
            context.arc(x, y, r, 0, 7);
            context.moveTo(x - 1.6 * r, y);
            context.lineTo(x + 1.6 * r, y);
            context.moveTo(x, y - 1.6 * r);
            context.lineTo(x, y + 1.6 * r);
            context.stroke();
        }
    }
    /** The point drawn nearest to a place on the canvas, in front where it is a solid. */
    pick(place) {
        const { about, screen, depth } = this;
        let best = -1,
            least = Infinity;
        for (let i = 0; i < about.points; ++i) {
            const d = Math.hypot(screen[2 * i] - place[0], screen[2 * i + 1] - place[1]) / this.zoom;
            const score = about.dim === 2 ? d : Math.max(0, d - about.spacing) + 1e-3 * depth[i];
            if (score < least) {
                least = score;
                best = i;
            }
        }
        return { point: best, far: Math.hypot(screen[2 * best] - place[0], screen[2 * best + 1] - place[1]) / this.zoom };
    }
    /** A place on the canvas as a place of the body at rest: by how far it is from the nearest point. */
    place3(place) {
        const { point } = this.pick(place),
            { dim, reference } = this.about,
            by = this.along([this.screen[2 * point], this.screen[2 * point + 1]], place);
        return Array.from({ length: dim }, (_, k) => reference[dim * point + k] + by[k]);
    }
    /** A way across the canvas in metres. */
    along(from, to) {
        const u = (to[0] - from[0]) / this.zoom,
            v = (from[1] - to[1]) / this.zoom;
        return this.right.map((r, k) => r * u + this.up[k] * v);
    }
    bar(canvas) {
        const { width } = canvas,
            context = canvas.getContext("2d"),
            field = this.frame?.field ?? "damage";
        const colours = (this.ramps[field] ??= ramp(field, this.dark)),
            image = context.createImageData(width, 1),
            words = new Uint32Array(image.data.buffer);
        for (let x = 0; x < width; ++x) words[x] = colours[Math.floor((x / width) * 256)];
        for (let y = 0; y < canvas.height; ++y) context.putImageData(image, 0, y);
    }
}

/** Lines over time: the ledger. */
export class Ledger {
    constructor(canvas, lines) {
        this.canvas = canvas;
        this.lines = lines; // { name: colour }
        this.rows = [];
    }
    clear() {
        this.rows = [];
    }
    add(time, energy) {
        this.rows.push([time, energy]);
        if (this.rows.length > 400) this.rows = this.rows.filter((_, k) => k % 2 === 0 || k === this.rows.length - 1);
    }
    paint(ink, brief) {
        const { canvas, rows } = this,
            context = canvas.getContext("2d"),
            box = canvas.getBoundingClientRect();
        const scale = Math.min(globalThis.devicePixelRatio || 1, 2),
            width = Math.round(box.width * scale),
            height = Math.round(box.height * scale);
        if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
        context.clearRect(0, 0, width, height);
        let lo = 0,
            hi = 1e-30;
        for (const [, e] of rows)
            for (const name of Object.keys(this.lines)) {
                lo = Math.min(lo, e[name]);
                hi = Math.max(hi, e[name]);
            }
        const pad = 17 * scale,
            y = v => height - pad - ((v - lo) / (hi - lo)) * (height - 2 * pad),
            last = rows.at(-1)?.[0] || 1;
        context.strokeStyle = ink;
        context.globalAlpha = 0.25;
        context.lineWidth = scale;
        context.beginPath();
        context.moveTo(0, y(0));
        context.lineTo(width, y(0));
        context.stroke();
        context.globalAlpha = 1;
        context.lineWidth = 1.8 * scale;
        for (const [name, [colour, dash]] of Object.entries(this.lines)) {
            context.strokeStyle = colour;
            context.setLineDash(dash.map(d => d * scale));
            context.beginPath();
            rows.forEach(([t, e], k) => context[k ? "lineTo" : "moveTo"]((t / last) * width, y(e[name])));
            context.stroke();
        }
        context.setLineDash([]);
        context.fillStyle = ink;
        context.font = `${11 * scale}px system-ui, sans-serif`;
        context.textAlign = "left";
        if (hi > 1e-30) context.fillText(`${brief(hi)} J`, 0, 11 * scale);
        context.fillText("0", 0, height - 3 * scale);
        context.textAlign = "right";
        if (rows.length > 1) context.fillText(`${brief(last * 1e6)} µs`, width, height - 3 * scale);
        return [lo, hi];
    }
}

/** Dots: error against horizon, both by powers of ten. */
export function dots(canvas, tried, ink, accent) {
    const context = canvas.getContext("2d"),
        box = canvas.getBoundingClientRect(),
        scale = Math.min(globalThis.devicePixelRatio || 1, 2);
    const width = (canvas.width = Math.round(box.width * scale)),
        height = (canvas.height = Math.round(box.height * scale)),
        pad = 26 * scale;
    context.font = `${11 * scale}px system-ui, sans-serif`;
    context.fillStyle = context.strokeStyle = ink;
    const x = v => pad + ((Math.log10(v) + 1.6) / 1.6) * (width - 1.5 * pad),
        y = v => height - pad - ((Math.log10(v) + 3) / 3) * (height - 1.5 * pad);
    for (const [v, text] of [
        [0.001, "0.1 %"],
        [0.01, "1 %"],
        [0.1, "10 %"],
        [1, "100 %"],
    ]) {
        context.globalAlpha = 0.2;
        context.beginPath();
        context.moveTo(pad, y(v));
        context.lineTo(width, y(v));
        context.stroke();
        context.globalAlpha = 1;
        context.fillText(text, 0, y(v) - 3 * scale);
    }
    for (const v of [0.05, 0.1, 0.2, 0.5, 1]) context.fillText(String(v), x(v) - 8 * scale, height - 4 * scale);
    tried.forEach(({ horizon, error }, k) => {
        context.fillStyle = k === tried.length - 1 ? accent : ink;
        context.beginPath();
        context.arc(x(Math.min(1, Math.max(0.03, horizon))), y(Math.min(1, Math.max(0.001, error))), 4 * scale, 0, 7);
        context.fill();
    });
}
