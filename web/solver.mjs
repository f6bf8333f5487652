// SPDX-License-Identifier: MIT
// solver.mjs - the body, in a worker: the page asks for a frame, is given one, and asks again when it is drawn.
import { instantiate } from "../build/js/peri.mjs";
import { BODIES, STRUCK, poissonOf, waveSpeed } from "./scenes.mjs";

let peri = null,
    scene = null;

/** Acts on a scene, by the letters of story.mjs. */
const ACTS = {
    a: (scene, steps) => scene.advance(steps),
    s: (scene, ...values) => scene.strike(...values),
    h: (scene, ...values) => scene.hold(...values),
    f: scene => scene.release(),
    c: (scene, ...values) => scene.cut(...values),
    p: (scene, value) => scene.pull(value),
    r: scene => scene.rest(),
};
/** As short as links want it; what is done is what is told. */
const brief = v => (Array.isArray(v) ? v.map(brief) : typeof v === "number" ? Number(v.toPrecision(5)) : v);

class Scene {
    constructor(settings, story) {
        this.s = settings;
        this.story = { pull: settings.pull, acts: [] };
        this.script = story ? story.acts.map(act => act.slice()) : []; // what is to be done again
        const b = (this.b = BODIES[settings.body]);
        this.dim = b.dim;
        this.h = b.size[0] / settings.n;
        this.horizon = this.h * settings.m * 1.0001; // what lies on the horizon is within
        this.ms = 0;
        this.pulls = [];
        this.held = null;
        this.frames = 0;
        this.make();
    }
    make() {
        const { s, b, h } = this,
            space = b.dim === 2 ? peri.SPACE_PLANE_STRESS : peri.SPACE_SOLID;
        this.body = new peri.Body({
            space,
            horizon: this.horizon,
            precision: peri["PRECISION_" + s.precision],
            correction: peri["CORRECTION_" + s.correction],
            influence: s.correction === "MOMENT" ? peri.INFLUENCE_LINEAR : peri.INFLUENCE_CONSTANT,
        });
        const material = { law: peri["LAW_" + s.law], young: b.young, density: b.density };
        if (s.law !== "BOND_BASED") material.poisson = s.poisson;
        if (s.breaks) material.fracture_energy = s.toughness;
        if (s.breaks && s.law !== "BOND_BASED") material.criterion = peri["CRITERION_" + s.criterion];
        this.material = this.body.add_material(material);
        const lo = b.size.map(() => 0);
        if (b.hole) {
            const middle = b.size.map(l => l / 2);
            this.body.add_shape(this.material, lo, b.size, h, (index, x) => Math.hypot(x[0] - middle[0], x[1] - middle[1]) > b.hole / 2);
        } else this.body.add_box(this.material, lo, b.size, h);
        this.body.build();
        this.e0 = this.strainScale();
        this.c = waveSpeed(s);
        this.supports();
        this.pull(s.pull);
        this.dt = 0.7 * this.body.stable_step();
        this.reference = new Float32Array(this.body.get_field(peri.FIELD_POSITION));
    }
    /** The strain that matters here: where bonds break, else a thousandth. */
    strainScale() {
        const { s, b } = this,
            k = b.dim === 2 ? b.young / (2 * (1 - poissonOf(s))) : b.young / (3 * (1 - 2 * poissonOf(s)));
        return Math.sqrt(s.toughness / (2 * k * this.horizon)) || 1e-3;
    }
    supports() {
        const { body, b, h, horizon, s } = this,
            e = b.size.length === 3 ? [b.size[2]] : [],
            z = e.map(() => 0);
        const [x, y] = b.size;
        if (s.body === "beam") {
            body.prescribe_displacement(body.select_box("clamp", [0, 0], [horizon, y]), peri.AXIS_XY, null);
            this.ends = [[body.select_box("tip", [x - h, 0], [x, y]), y, [0, -1]]];
            this.tip = body.get_set(body.find_set("tip"));
            this.noFail([0, 0], [2 * horizon, y]);
            this.noFail([x - 2 * horizon, 0], [x, y]);
            return;
        }
        const axis = b.axis,
            top = b.size.slice(),
            bottom = b.size.map(() => 0),
            area = (axis ? x : y) * (e[0] ?? 1);
        const near = depth => [
            b.size.map((_, k) => (k === axis ? b.size[axis] - depth : 0)),
            b.size.map((l, k) => (k === axis ? depth : l)),
        ];
        const [lo, hi] = near(h),
            [deepLo, deepHi] = near(horizon),
            unit = b.size.map((_, k) => (k === axis ? 1 : 0));
        this.ends = [
            [body.select_box("upper", lo, top), area, unit],
            [body.select_box("lower", bottom, hi), area, unit.map(v => -v)],
        ];
        this.noFail(deepLo, top);
        this.noFail(bottom, deepHi);
        if (s.notch && b.dim === 2 && !b.hole) body.cut_segment(peri.CUT_INITIAL, [-h, y / 2], [x / 2, y / 2]);
        else if (s.notch && b.dim === 2) body.cut_segment(peri.CUT_INITIAL, [x / 2, y / 2 - b.hole * 0.75], [x / 2, y / 2 + b.hole * 0.75]);
        else if (s.notch) body.cut_rectangle(peri.CUT_INITIAL, [x / 2, -h, -h], [0, y / 2, 0], [0, 0, e[0] + z[0] + 2 * h]);
    }
    noFail(lo, hi) {
        if (this.s.breaks) this.body.set_no_fail(this.body.select_box(null, lo, hi), 1);
    }
    pull(value) {
        for (const id of this.pulls) this.body.remove_load(id);
        this.pulls = [];
        this.pulled = value;
        if (!value) return;
        for (const [set, area, way] of this.ends)
            this.pulls.push(
                this.body.apply_layer_traction(
                    set,
                    area,
                    way.map(v => v * value * this.b.pullUnit),
                ),
            );
    }
    /** Does it, and notes that. */
    act(letter, ...given) {
        const values = given.map(brief),
            { acts } = this.story,
            last = acts.at(-1);
        const out = ACTS[letter](this, ...values);
        if (letter !== "a") acts.push([letter, ...values]);
        else if (last?.[0] === "a" && last[1] === values[0]) ++last[2];
        else acts.push(["a", values[0], 1]);
        return out;
    }
    /** The next frame of the script, and what was done between it and the one after. */
    follow() {
        let isDone = false;
        while (this.script.length) {
            const act = this.script[0];
            if (act[0] !== "a") this.act(...this.script.shift());
            else if (isDone) break;
            else {
                this.act("a", act[1]);
                isDone = true;
                if (--act[2] === 0) this.script.shift();
            }
        }
    }
    /** What the user does ends the script. */
    take(letter, ...values) {
        this.script = [];
        return this.act(letter, ...values);
    }
    /** A hammer drives the material apart around it; on the block falls a ball. */
    strike(at, strength) {
        const { body, h, horizon, e0, c, dim } = this,
            radius = STRUCK(horizon / h) * h;
        if (dim === 3) {
            const r = 0.006,
                away = body.view_field(peri.FIELD_CURRENT_POSITION);
            let top = 0;
            for (let i = 0; i < away.count; ++i) {
                const dx = away.at(i, 0) - at[0],
                    dy = away.at(i, 1) - at[1];
                if (dx * dx + dy * dy < r * r) top = Math.max(top, away.at(i, 2));
            }
            this.balls ??= [];
            while (this.balls.length > 3) body.remove_obstacle(this.balls.shift());
            this.balls.push(
                body.add_obstacle({
                    shape: peri.SHAPE_BALL,
                    place: [at[0], at[1], top + r],
                    radius: r,
                    density: 7800,
                    velocity: [0, 0, -40 * strength],
                    friction: 0.1,
                }),
            );
            this.ballRadius = r;
            return;
        }
        const velocity = body.get_field(peri.FIELD_VELOCITY),
            x = body.get_field(peri.FIELD_POSITION),
            v = 8 * strength * e0 * c;
        for (let i = 0; i < x.length; i += dim) {
            const away = [x[i] - at[0], x[i + 1] - at[1]],
                r = Math.sqrt(away[0] * away[0] + away[1] * away[1]);
            if (r > 2 * radius || r === 0) continue;
            const q = r / radius,
                fading = 1 - (q * q) / 4, // to the fourth power nearly exp(-q^2), whose bits differ among browsers
                kick = v * q * (fading * fading) * (fading * fading);
            velocity[i] += (kick * away[0]) / r;
            velocity[i + 1] += (kick * away[1]) / r;
        }
        body.set_field(peri.FIELD_VELOCITY, velocity);
    }
    /** As long as the pointer is down: points follow it, or a force acts towards it. */
    hold(kind, at, by, strength) {
        const { body, h, horizon, e0, dim } = this,
            radius = Math.max(2 * h, 0.5 * horizon);
        if (!this.held) {
            const set = body.select_ball(null, at, radius),
                [first] = body.get_set(set);
            this.held = { set, kind, first, by, id: 0 };
            if (kind === "drag") {
                const view = body.view_field(peri.FIELD_DISPLACEMENT),
                    held = this.held;
                held.start = by.map((_, k) => view.at(first, k));
                this.held.id = body.prescribe_velocity(set, dim === 2 ? peri.AXIS_XY : peri.AXIS_XYZ, null, (time, points, value) => {
                    const limit = 8 * this.c * e0,
                        tau = 40 * this.dt;
                    for (let k = 0; k < dim; ++k) {
                        const v = (held.start[k] + held.by[k] - view.at(first, k)) / tau,
                            bounded = Math.max(-limit, Math.min(limit, v));
                        for (let p = 0; p < points.length; ++p) value[p * dim + k] = bounded;
                    }
                });
            }
        }
        this.held.by = by;
        if (kind !== "load") return;
        if (this.held.id) body.remove_load(this.held.id);
        const density = (4 * strength * e0 * this.b.young) / radius; // of a pull across the whole view
        this.held.id = body.apply_body_force(
            this.held.set,
            by.map(v => v * density),
        );
    }
    release() {
        if (this.held?.id) this.body.remove_load(this.held.id);
        this.held = null;
    }
    cut(from, to, view) {
        const { body, dim } = this,
            standing = peri.CUT_NOW;
        if (dim === 2) return body.cut_segment(standing, from, to);
        const far = 0.2,
            corner = from.map((v, k) => v - far * view[k]);
        return body.cut_rectangle(
            standing,
            corner,
            to.map((v, k) => v - from[k]),
            view.map(v => 2 * far * v),
        );
    }
    advance(steps) {
        const start = performance.now();
        this.body.advance({ steps, safety: 0.7 });
        const ms = (performance.now() - start) / steps;
        this.ms = this.ms ? 0.9 * this.ms + 0.1 * ms : ms;
    }
    /** The equilibrium under what acts, and of the beam how far it is from what beams do. */
    rest() {
        const { body, s, b } = this;
        const report = body.solve({ loose: peri.LOOSE_PINNED, fracture: s.breaks, tolerance: s.precision === "SINGLE" ? 1e-3 : 1e-6 });
        const out = { iterations: report.iterations, residual: report.residual };
        if (s.body === "beam" && this.pulled) {
            const u = body.get_field(peri.FIELD_DISPLACEMENT),
                [x, y] = b.size,
                length = x - this.horizon + this.h / 2;
            let sum = 0;
            for (const i of this.tip) sum += u[2 * i + 1];
            const force = this.pulled * b.pullUnit * y,
                inertia = y ** 3 / 12,
                shear = b.young / (2 * (1 + poissonOf(s)));
            const arm = length - this.h / 2; // to the middle of the last row
            const known = -((force * arm ** 3) / (3 * b.young * inertia) + (force * arm) / ((shear * y * 5) / 6));
            Object.assign(out, { deflection: sum / this.tip.length, known, error: Math.abs(sum / this.tip.length / known - 1) });
        }
        if (s.body === "pane" && this.pulled && !s.notch && !s.breaks) {
            const ratio = this.ratio();
            if (Number.isFinite(ratio)) Object.assign(out, { ratio, error: Math.abs(ratio / poissonOf(s) - 1) });
        }
        return out;
    }
    /** -strain across over strain along the pull, within, where no surface is near. */
    ratio() {
        const { body, b, horizon, reference } = this,
            strain = body.get_field(peri.FIELD_STRAIN),
            sums = [0, 0];
        for (let i = 0; i < reference.length / 2; ++i) {
            const inside = b.size.every((l, k) => reference[2 * i + k] > 3 * horizon && reference[2 * i + k] < l - 3 * horizon);
            if (inside) for (let k = 0; k < 2; ++k) sums[k] += strain[3 * i + k];
        }
        return -sums[0] / sums[1];
    }
    values(field) {
        const { body } = this;
        if (field === "damage") return this.damage().slice();
        if (field === "energy") return new Float32Array(body.get_field(peri.FIELD_ENERGY_DENSITY));
        if (field === "speed") {
            const v = body.get_field(peri.FIELD_VELOCITY),
                out = new Float32Array(v.length / this.dim);
            for (let i = 0; i < out.length; ++i)
                out[i] = Math.hypot(v[i * this.dim], v[i * this.dim + 1], this.dim === 3 ? v[i * 3 + 2] : 0);
            return out;
        }
        return principal(body.get_field(peri.FIELD_STRESS), this.dim);
    }
    damage() {
        // changes only where bonds do
        const gone = body => body.broken_count() + body.cut_count();
        if (this.gone !== gone(this.body)) this.known = new Float32Array(this.body.get_field(peri.FIELD_DAMAGE));
        this.gone = gone(this.body);
        return this.known;
    }
    frame(field, withEnergy) {
        const { body } = this,
            frame = {
                type: "frame",
                displacement: new Float32Array(body.get_field(peri.FIELD_DISPLACEMENT)),
                value: this.values(field),
                field,
                time: body.time(),
                steps: body.step_count(),
                broken: body.broken_count(),
                ms: this.ms,
                balls: (this.balls ?? []).map(id => body.get_obstacle_state(id).place),
                ballRadius: this.ballRadius,
            };
        if (withEnergy) {
            frame.energy = body.get_energy();
            frame.damage = most(this.damage());
        }
        return frame;
    }
    about() {
        const { body, s, b } = this;
        return {
            type: "ready",
            reference: this.reference,
            dim: this.dim,
            size: b.size,
            spacing: this.h,
            horizon: this.horizon,
            points: body.point_count(),
            bonds: body.bond_count(),
            cut: body.cut_count(),
            dt: this.dt,
            e0: this.e0,
            bytes: body.get_memory().total,
            kernel: body.kernel_text(),
            poisson: poissonOf(s),
            speed: this.c,
        };
    }
}

const most = array => array.reduce((a, v) => Math.max(a, v), 0);

/** The largest principal stress; of solids the mean of it and the shear is costly: their largest normal component. */
function principal(t, dim) {
    const per = dim === 2 ? 3 : 6,
        out = new Float32Array(t.length / per);
    for (let i = 0; i < out.length; ++i) {
        const k = i * per;
        if (dim === 2) {
            const mean = (t[k] + t[k + 1]) / 2,
                radius = Math.hypot((t[k] - t[k + 1]) / 2, t[k + 2]);
            out[i] = Math.abs(mean + radius) > Math.abs(mean - radius) ? mean + radius : mean - radius;
        } else out[i] = Math.max(t[k], t[k + 1], t[k + 2]);
    }
    return out;
}

/** What peri_choose takes for an error, as settings of the page. */
function choose(message) {
    const { settings: s, preset } = message,
        b = BODIES[s.body];
    const quantity = { crack: "FRACTURE", hole: "STRESS", cantilever: "DEFORMATION" }[b.problem];
    const bonded = Math.abs(s.poisson - (b.dim === 2 ? 1 / 3 : 1 / 4)) < 0.01;
    const { body, material, report } = peri.choose(
        {
            preset: peri["PRESET_" + preset],
            quantity: peri["QUANTITY_" + quantity],
            feature: b.problem === "hole" ? b.feature / 2 : b.feature,
            lo: b.size.map(() => 0),
            hi: b.size,
        },
        { space: b.dim === 2 ? peri.SPACE_PLANE_STRESS : peri.SPACE_SOLID },
        {
            law: peri.LAW_BOND_BASED,
            young: b.young,
            density: b.density,
            fracture_energy: s.toughness,
            ...(bonded ? {} : { poisson: s.poisson }),
        },
    );
    const name = (group, value) =>
        Object.keys(peri)
            .find(k => k.startsWith(group) && peri[k] === value)
            .slice(group.length);
    return {
        type: "chosen",
        law: name("LAW_", material.law),
        precision: name("PRECISION_", body.precision),
        correction: name("CORRECTION_", body.correction),
        n: Math.round(b.size[0] / report.spacing),
        m: Math.round((body.horizon / report.spacing) * 10) / 10,
        error: report.error,
        text: report.text,
        points: report.cost.points,
    };
}

const ACTIONS = {
    async wasm({ bytes }) {
        peri = instantiate(await WebAssembly.compile(bytes));
        return { type: "loaded" };
    },
    scene({ settings, story }) {
        scene?.body.destroy();
        scene = null;
        const made = new Scene({ ...settings, pull: story ? story.pull : settings.pull }, story);
        scene = made;
        return made.about();
    },
    frame({ field, steps }) {
        const isScript = steps > 0 && scene.script.length > 0;
        if (isScript) scene.follow();
        else if (steps > 0) scene.act("a", steps);
        const isOver = isScript && scene.script.length === 0;
        return { ...scene.frame(field, steps === 0 || isOver || scene.frames++ % 6 === 0), isOver };
    },
    strike({ at, strength }) {
        scene.take("s", at, strength);
    },
    hold({ kind, at, by, strength }) {
        scene.take("h", kind, at, by, strength);
    },
    release() {
        scene.take("f");
    },
    cut({ from, to, view }) {
        return { type: "cut", bonds: scene.take("c", from, to, view) };
    },
    pull({ value }) {
        scene.take("p", value);
    },
    rest() {
        return { type: "rest", ...scene.take("r") };
    },
    story() {
        return { type: "story", story: scene.story };
    },
    choose,
};

self.onmessage = async ({ data }) => {
    try {
        if (data.type !== "wasm" && data.type !== "scene" && data.type !== "choose" && !scene) return;
        const answer = await ACTIONS[data.type](data);
        if (!answer) return;
        answer.scene = data.scene;
        self.postMessage(answer, [answer.displacement?.buffer, answer.value?.buffer].filter(Boolean));
    } catch (error) {
        self.postMessage({ type: "failed", of: data.type, text: error.message, status: error.status ?? "", scene: data.scene });
    }
};
