// SPDX-License-Identifier: MIT
// page.mjs - what one touches and sees. The body lives in a worker; a frame is asked for when the last one is drawn.
import { BODIES, FIELDS, LESSONS, STRUCK, fromHash, settingsOf, toHash } from "./scenes.mjs";
import { Ledger, Stage, dots } from "./draw.mjs";
import { pack, unpack } from "./story.mjs";

const $ = id => document.getElementById(id);
const form = $("settings"),
    stage = new Stage($("stage"));
const calm = matchMedia("(prefers-reduced-motion: reduce)"),
    dark = matchMedia("(prefers-color-scheme: dark)");
const LINES = {
    // of the ledger: in grey they differ by dashes
    external: ["Put in", "#8a6d00", "#e6c54a", []],
    kinetic: ["Motion", "#0b5f8a", "#7cc3ea", []],
    elastic: ["Bonds, stored", "#00704f", "#5fcf9f", [6, 3]],
    fracture: ["Bonds, broken", "#a63a14", "#ff9a66", [2, 3]],
    damping: ["Damped", "#7a3f8f", "#cf9be0", [8, 2, 2, 2]],
    error: ["Left open", "#6b6b6b", "#b0b0b0", [1, 4]],
};
const TERMS = {
    kinetic: ["inertia", "At work: inertia, the motion of mass."],
    elastic: ["bonds", "At work: the bonds, stretched and sheared."],
    fracture: ["breaks", "At work: μ, which turns from 1 to 0 as bonds break."],
    external: ["loads", "At work: the loads, and what strikes."],
};
const LAWS = {
    BOND_BASED: "Bond-based: t = ½ c w s along the bond, by its own stretch s alone.",
    LPS: "State-based: t = w (Aθ|ξ| + Be)/m, by the volume change θ of the family and the extension e of the bond.",
    CORRESPONDENCE: "Correspondence: t = w P K⁻¹ ξ, by the stress P of the strain that fits the whole family.",
};

let settings = fromHash(location.hash),
    story = null, // to be done again with the next body
    about = null,
    last = null,
    scene = 0,
    running = false,
    isWaiting = false,
    isDirty = false;
let isToTell = false,
    tool = "strike",
    press = null,
    energyBefore = null,
    said = 0,
    tried = [],
    measured = null,
    errors = {};
let ledger = new Ledger($("ledger"), {});

// ---- the worker ---------------------------------------------------------------------------------------------------------------

const worker = globalThis.makeWorker();
const tell = message => worker.postMessage({ scene, ...message });

worker.onmessage = ({ data }) => {
    if (data.type === "loaded") return make();
    if (data.scene !== scene) return;
    ({ ready, frame, rest, failed, chosen, story: share, cut: () => {} })[data.type](data);
};

function ready(data) {
    about = data;
    stage.setScene(data);
    ledger.clear();
    energyBefore = null;
    $("points").textContent = about.points.toLocaleString("en");
    $("memory").textContent = `${(about.bytes / 1e6).toFixed(1)} MB`;
    const top = Math.max(20, Math.ceil(0.06 / about.e0));
    form.magnify.max = top;
    if (!settings.magnify) settings.magnify = Math.round(0.02 / about.e0);
    fill();
    notice("");
    isWaiting = true;
    tell({ type: "frame", field: settings.field, steps: 0 });
}

function frame(data) {
    isWaiting = false;
    if (last && data.steps < last.steps) ledger.clear();
    last = data;
    isDirty = true;
    if (data.isOver) run(false); // here the link was made
    if (isToTell && data.energy) {
        isToTell = false;
        report();
    }
    if (!calm.matches) ask(); // the next is computed while this one is drawn
}

function ask() {
    if (!running || isWaiting || !about || !last) return;
    isWaiting = true;
    tell({ type: "frame", field: settings.field, steps: settings.steps });
}

function rest(data) {
    const millimetres = v => (v * 1e3).toPrecision(3);
    measured = null;
    if (data.ratio !== undefined) {
        measured = { error: data.error, of: `of Poisson’s ratio at rest, ${data.ratio.toFixed(3)}` };
        say(`At rest, Poisson’s ratio is ${data.ratio.toFixed(3)}.`);
    } else if (data.deflection !== undefined) {
        tried = [...tried, { horizon: about.horizon / BODIES[settings.body].size[1], error: data.error }];
        measured = { error: data.error, of: "of the deflection at rest" };
        say(`At rest: the tip is ${millimetres(-data.deflection)} millimetres lower; of beams like this ${millimetres(-data.known)}.`);
    } else say(`At rest after ${data.iterations} iterations.`);
    showError();
    tell({ type: "frame", field: settings.field, steps: 0 });
}

function failed(data) {
    isWaiting = false;
    run(false);
    isToTell = false;
    const where = { rest: "No rest was found", scene: "This body cannot be made", choose: "Out of reach here" }[data.of] ?? "It stopped";
    notice(`${where}: ${data.text}.`);
    say($("notice").textContent);
}

function chosen(data) {
    const range = BODIES[settings.body].points,
        isLarge = data.n > range[1];
    $("choice").textContent =
        `${data.text}: ${data.points.toLocaleString("en")} points, error at most ${(100 * data.error).toPrecision(2)} %.` +
        (isLarge ? " That is too many for this page: the most it takes was set." : "");
    for (const key of ["law", "precision", "correction", "m"]) settings[key] = data[key];
    settings.n = Math.min(range[1], Math.max(range[0], data.n));
    changed("n");
}

// ---- settings -------------------------------------------------------------------------------------------------------------------

function make() {
    ++scene;
    about = last = measured = null;
    press = null;
    isWaiting = false;
    stage.cursor = stage.line = null;
    tell({ type: "scene", settings, story });
    story = null;
}

async function open() {
    settings = fromHash(location.hash);
    story = await unpack(new URLSearchParams(location.hash.replace(/^#/, "")).get("story") ?? "");
}

const LIVE = ["pull", "magnify", "steps", "strength", "field"]; // all else makes the body anew

function changed(name) {
    fill();
    history.replaceState(null, "", toHash(settings));
    if (name === "pull") tell({ type: "pull", value: settings.pull });
    else if (!LIVE.includes(name)) make();
    else if (!running && about) tell({ type: "frame", field: settings.field, steps: 0 });
}

/** The settings into the form. */
function fill() {
    const body = BODIES[settings.body],
        isBonded = settings.law === "BOND_BASED";
    [form.n.min, form.n.max] = body.points;
    for (const [key, value] of Object.entries(settings)) {
        const input = form.elements[key];
        if (!input) continue;
        if (input.type === "checkbox") input.checked = Boolean(value);
        else input.value = "log" in input.dataset ? Math.log10(value) : value;
        const output = input.parentElement.querySelector("output");
        if (output)
            output.textContent = key === "toughness" ? Number(Number(value).toPrecision(2)) : key === "magnify" ? `${value} ×` : value;
    }
    const poisson = form.poisson.parentElement;
    form.poisson.disabled = isBonded;
    poisson.classList.toggle("off", isBonded);
    if (isBonded) poisson.querySelector("output").textContent = body.dim === 2 ? "1/3, always" : "1/4, always";
    form.criterion.disabled = isBonded || settings.law === "CORRESPONDENCE";
    $("pull-name").textContent = body.pullName;
    $("turn-tool").hidden = body.dim === 2;
    $("tried").hidden = settings.body !== "beam";
    $("lesson-text").textContent = LESSONS[settings.lesson].text;
    $("law-text").textContent = LAWS[settings.law];
    $("scale-name").textContent = `${FIELDS[settings.field].name}: ${FIELDS[settings.field].what}`;
    for (const radio of document.querySelectorAll("[name=lesson]")) radio.checked = radio.value === settings.lesson;
    showError();
}

/** What docs/accuracy.md measured with settings like these; of a beam at rest, what it is. */
function showError() {
    const body = BODIES[settings.body],
        isWave = settings.lesson === "waves",
        problem = isWave ? "wave" : body.problem;
    const across = Math.round(isWave ? 4 * STRUCK(settings.m) : (body.feature / body.size[0]) * settings.n);
    if (measured !== null) {
        $("error").textContent = `${(100 * measured.error).toPrecision(2)} %`;
        $("error-text").textContent = `error ${measured.of}`;
        return;
    }
    const recipe = settings.law === "BOND_BASED" ? (settings.correction === "MOMENT" ? 1 : 0) : settings.law === "LPS" ? 2 : 3;
    const row = errors[problem]?.[recipe];
    if (!row) return;
    const at = Math.log2(across / 8),
        k = Math.max(0, Math.min(2, Math.floor(at))),
        next = Math.min(2, k + 1),
        f = Math.min(1, Math.max(0, at - k));
    const percent = row[k] * (row[next] / row[k]) ** f,
        sign = at < 0 ? "> " : at > 2 ? "< " : "";
    $("error").textContent = `${sign}${percent.toPrecision(2)} %`;
    $("error-text").textContent = `error: ${problem}, ${across} spacings, m = ${recipe === 0 ? 3 : 2}`;
}

form.addEventListener("input", ({ target }) => {
    if (!(target.name in settings)) return;
    const value = target.type === "checkbox" ? Number(target.checked) : target.type === "range" ? Number(target.value) : target.value;
    settings[target.name] = "log" in target.dataset ? Number((10 ** value).toPrecision(2)) : value;
    if (target.name === "body") {
        const body = BODIES[settings.body];
        Object.assign(settings, { n: Math.round((body.points[0] + body.points[1]) / 2), toughness: body.toughness, magnify: 0, pull: 0 });
        if (body.dim === 3 && settings.m > 3) settings.m = 3;
    }
    if (["toughness", "m", "n"].includes(target.name)) settings.magnify = 0;
    if (target.name === "law" && settings.law === "CORRESPONDENCE") settings.criterion = "STRETCH";
    if (target.type === "range" && !LIVE.includes(target.name)) return later(target.name);
    changed(target.name);
});
form.addEventListener("submit", event => event.preventDefault());

let waitingFor = 0;
function later(name) {
    // while a slider moves the body is not made anew
    fill();
    clearTimeout(waitingFor);
    waitingFor = setTimeout(() => changed(name), 180);
}

for (const button of document.querySelectorAll("[data-preset]"))
    button.addEventListener("click", () => tell({ type: "choose", settings, preset: button.dataset.preset }));

const LONGEST = 30000; // link that is passed on whole everywhere
async function share({ story: told }) {
    const packed = told.acts.length ? await pack(told) : "",
        isShort = packed.length < LONGEST;
    history.replaceState(null, "", toHash(settings) + (packed && isShort ? `&story=${packed}` : ""));
    try {
        await navigator.clipboard.writeText(location.href);
        $("share").textContent = isShort ? "Copied" : "Copied, without what was done: that is too long";
    } catch {
        $("share").textContent = isShort ? "The link is in the address bar" : "In the address bar, without what was done: that is too long";
    }
    setTimeout(() => {
        $("share").textContent = "Copy a link to this state";
    }, 2500);
}
$("share").addEventListener("click", () => {
    run(false);
    tell({ type: "story" });
});

function lists() {
    for (const [key, body] of Object.entries(BODIES)) form.body.add(new Option(body.name, key));
    for (const [key, field] of Object.entries(FIELDS)) form.field.add(new Option(field.name, key));
    for (const [key, lesson] of Object.entries(LESSONS)) {
        const label = document.createElement("label"),
            input = document.createElement("input"),
            span = document.createElement("span");
        Object.assign(input, { type: "radio", name: "lesson", value: key });
        span.textContent = lesson.name;
        label.append(input, span);
        $("lessons").append(label);
        input.addEventListener("change", () => {
            settings = settingsOf(key);
            tried = [];
            history.replaceState(null, "", toHash(settings));
            fill();
            make();
            run(!calm.matches);
        });
    }
}

// ---- tools ------------------------------------------------------------------------------------------------------------------------

const placeOf = event => {
    const box = $("stage").getBoundingClientRect();
    return [(event.clientX - box.left) * stage.scale, (event.clientY - box.top) * stage.scale];
};

function begin(place) {
    if (!about || !last) return;
    const { point, far } = stage.pick(place),
        at = stage.place3(place);
    press = { place, at, point, isOff: far > 4 * about.spacing, yaw: stage.yaw, pitch: stage.pitch };
    if (tool === "strike" && !press.isOff) {
        tell({ type: "strike", at, strength: settings.strength });
        run(true);
    }
    if (tool === "drag" || tool === "load") run(true);
}

function move(place) {
    if (!press || !about) return;
    if (tool === "cut") stage.line = [press.place, place];
    if ((tool === "drag" || tool === "load") && !press.isOff) {
        const way = stage.along(press.place, place),
            scale = tool === "drag" ? 1 / Math.max(1, settings.magnify) : 1 / about.size[0];
        tell({ type: "hold", kind: tool, at: press.at, by: way.map(v => v * scale), strength: settings.strength });
        if (tool === "load") stage.line = [press.place, place];
    }
    if (tool === "turn") {
        stage.yaw = press.yaw + (place[0] - press.place[0]) / 200 / stage.scale;
        stage.pitch = Math.min(1.5, Math.max(0.1, press.pitch + (place[1] - press.place[1]) / 200 / stage.scale));
        stage.fit();
    }
    isDirty = true;
}

function end(place) {
    if (!press) return;
    if (tool === "cut") tell({ type: "cut", from: stage.place3(press.place), to: stage.place3(place), view: stage.view ?? 0 });
    if (tool === "drag" || tool === "load") tell({ type: "release" });
    press = stage.line = null;
    isDirty = true;
    if (!running && about && tool === "cut") tell({ type: "frame", field: settings.field, steps: 0 });
}

const canvas = $("stage");
canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    stage.cursor = null;
    begin(placeOf(event));
});
canvas.addEventListener("pointermove", event => move(placeOf(event)));
canvas.addEventListener("pointerup", event => end(placeOf(event)));
canvas.addEventListener("pointercancel", event => end(placeOf(event)));

canvas.addEventListener("keydown", event => {
    const step = (event.shiftKey ? 40 : 12) * stage.scale,
        way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const named = { s: "strike", d: "drag", c: "cut", l: "load" }[event.key.toLowerCase()];
    stage.cursor ??= [canvas.width / 2, canvas.height / 2];
    if (way) {
        stage.cursor = stage.cursor.map((v, k) => Math.max(0, Math.min([canvas.width, canvas.height][k], v + way[k] * step)));
        move(stage.cursor);
    } else if (event.key === "Enter") {
        if (press) end(stage.cursor);
        else begin(stage.cursor.slice());
        if (tool === "strike") press = null;
    } else if (event.key === " ") run(!running);
    else if (event.key === "Escape") end(stage.cursor);
    else if (named) choose(named);
    else return;
    isDirty = true;
    event.preventDefault();
});
canvas.addEventListener("blur", () => {
    if (stage.cursor && press) end(stage.cursor);
    stage.cursor = null;
    isDirty = true;
});

function choose(name) {
    tool = name;
    document.querySelector(`[name=tool][value=${name}]`).checked = true;
}
$("tools").addEventListener("change", ({ target }) => choose(target.value));

// ---- running ------------------------------------------------------------------------------------------------------------------------

function run(on) {
    running = on;
    $("run").textContent = on ? "Pause" : "Run";
    isToTell = !on; // with the next frame, which has all numbers
    if (!on && about) tell({ type: "frame", field: settings.field, steps: 0 });
}
$("run").addEventListener("click", () => run(!running));
$("rest").addEventListener("click", () => {
    run(false);
    tell({ type: "rest" });
});
$("reset").addEventListener("click", () => {
    measured = null;
    history.replaceState(null, "", toHash(settings));
    make();
});

function notice(text) {
    $("notice").hidden = !text;
    $("notice").textContent = text;
}

function say(text) {
    $("live").textContent = text;
}

const brief = v =>
    v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(1).replace("e+", "e") : String(Number(v.toPrecision(3)));

/** The state in words, for those who do not see it. */
function report() {
    if (!last || !about) return;
    const e = last.energy ?? energyBefore,
        microseconds = (last.time * 1e6).toPrecision(3);
    const parts = [
        `${BODIES[settings.body].name}, ${about.points} points.`,
        `After ${microseconds} microseconds ${last.broken} of ${about.bonds} bonds are broken.`,
    ];
    if (last.damage !== undefined) parts.push(`Largest damage ${last.damage.toFixed(2)}.`);
    if (e) parts.push(`Energy of motion ${brief(e.kinetic)} joules, stored ${brief(e.elastic)}, lost in broken bonds ${brief(e.fracture)}.`);
    say(parts.join(" "));
}

function showEnergy(data) {
    const e = { ...data.energy, external: data.energy.external + data.energy.initial + data.energy.obstacle };
    ledger.add(data.time, e);
    for (const name of Object.keys(LINES)) $(`energy-${name}`).textContent = `${brief(e[name])} J`;
    const way = Object.keys(TERMS)
        .map(name => [name, Math.abs(e[name] - (energyBefore?.[name] ?? 0))])
        .sort((a, b) => b[1] - a[1])[0];
    energyBefore = e;
    if (way[1] === 0 && data.steps > 0) return; // no time has passed: what was at work is still told
    const works = way[1] > 0 && data.steps > 0 ? TERMS[way[0]] : null;
    for (const term of document.querySelectorAll(".term")) term.classList.toggle("works", term.dataset.term === works?.[0]);
    $("term-text").textContent = works?.[1] ?? "";
}

let barOf = "",
    counted = 0,
    countedFrom = performance.now(),
    drawn = 0;
function show() {
    isDirty = false;
    stage.show(last, settings.magnify);
    if (barOf !== last.field + dark.matches) {
        stage.bar($("bar"));
        barOf = last.field + dark.matches;
    }
    $("scale-lo").textContent = brief(stage.range[0]);
    $("scale-hi").textContent = `${brief(stage.range[1])} ${FIELDS[last.field].unit}`;
    $("time").textContent = (last.time * 1e6).toFixed(last.time < 1e-4 ? 2 : 0);
    $("broken").textContent = last.broken.toLocaleString("en");
    if (last.ms) $("ms").textContent = last.ms.toPrecision(2);
    if (last.energy) {
        showEnergy(last);
        ledger.paint(getComputedStyle(document.body).color, brief);
        if (settings.body === "beam") dots($("dots"), tried, getComputedStyle(document.body).color, dark.matches ? "#ffb27a" : "#a63a14");
    }
}

function tick(now) {
    requestAnimationFrame(tick);
    ++counted;
    if (now - countedFrom > 1000) {
        const seconds = (now - countedFrom) / 1000;
        $("rate").textContent = Math.round(counted / seconds);
        globalThis.rates = { screen: counted / seconds, body: drawn / seconds };
        counted = drawn = 0;
        countedFrom = now;
        if (running && now - said > 6000) {
            said = now;
            isToTell = true;
        }
    }
    if (last && isDirty) {
        show();
        ++drawn;
    }
    if (!calm.matches || now - asked > 500) {
        asked = now;
        ask();
    }
}
let asked = 0;

function colours() {
    const isDark = dark.matches;
    stage.setDark(isDark);
    ledger.lines = Object.fromEntries(
        Object.entries(LINES).map(([name, [, light, night, dash]]) => [name, [isDark ? night : light, dash]]),
    );
    const row = ([name, [text, , , dash]]) => {
        const look = `stroke="${ledger.lines[name][0]}" stroke-width="3" stroke-dasharray="${dash.join(" ")}"`;
        return (
            `<dt><svg aria-hidden="true"><line x1="0" y1="2" x2="22" y2="2" ${look}/></svg>${text}</dt>` +
            `<dd id="energy-${name}">0 J</dd>`
        );
    };
    $("energies").innerHTML = Object.entries(LINES).map(row).join("");
    isDirty = Boolean(last);
}

dark.addEventListener("change", colours);
addEventListener("hashchange", () => open().then(make));
new ResizeObserver(() => {
    stage.resize();
    isDirty = Boolean(last);
}).observe(canvas);
document.addEventListener("visibilitychange", () => {
    if (document.hidden) run(false);
});

export function start(bytes, table) {
    errors = table;
    lists();
    colours();
    fill();
    open().then(() => tell({ type: "wasm", bytes }));
    run(!calm.matches);
    requestAnimationFrame(tick);
    globalThis.shown = () => last;
}
