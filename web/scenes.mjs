// SPDX-License-Identifier: MIT
// scenes.mjs - what the page can show: bodies, lessons, and the settings of both. Lengths in metres, all else in SI units.

/** Bodies: size, material, what is measured across (`feature`) and how the error of such a scene is named in docs/accuracy.md. */
export const BODIES = {
    pane: {
        name: "Pane of glass",
        dim: 2,
        size: [0.1, 0.05],
        young: 72e9,
        density: 2440,
        toughness: 3.8,
        feature: 0.05,
        problem: "crack",
        pullUnit: 1e6,
        pullName: "Pull, MPa",
        points: [20, 200],
        axis: 1,
        about: "Soda-lime glass, 100 × 50 mm, pulled up and down.",
    },
    plate: {
        name: "Plate with a hole",
        dim: 2,
        size: [0.1, 0.1],
        young: 72e9,
        density: 2440,
        toughness: 3.8,
        feature: 0.02,
        problem: "hole",
        hole: 0.02,
        pullUnit: 1e6,
        pullName: "Pull, MPa",
        points: [20, 140],
        axis: 0,
        about: "Glass, 100 × 100 mm, with a round hole, pulled to the left and right.",
    },
    beam: {
        name: "Beam",
        dim: 2,
        size: [0.2, 0.025],
        young: 3.2e9,
        density: 1180,
        toughness: 400,
        feature: 0.025,
        problem: "cantilever",
        pullUnit: 1e5,
        pullName: "Load at the tip, bar",
        points: [40, 320],
        axis: 1,
        about: "Acrylic, 200 × 25 mm, clamped at the left, loaded at its right end.",
    },
    block: {
        name: "Block",
        dim: 3,
        size: [0.06, 0.06, 0.024],
        young: 30e9,
        density: 2400,
        toughness: 60,
        feature: 0.024,
        problem: "crack",
        pullUnit: 1e6,
        pullName: "Pull, MPa",
        points: [10, 40],
        axis: 0,
        about: "Concrete, 60 × 60 × 24 mm, solid: strike it with a steel ball.",
    },
};

/** Settings and their ranges: n is the number of points across the longest side, m the horizon in spacings. */
export const DEFAULTS = {
    lesson: "branching",
    body: "pane",
    n: 140,
    m: 3,
    law: "BOND_BASED",
    poisson: 0.33,
    toughness: 3.8,
    breaks: 1,
    precision: "SINGLE",
    criterion: "STRETCH",
    correction: "NONE",
    notch: 1,
    pull: 2,
    steps: 1,
    magnify: 0,
    field: "damage",
    strength: 1,
};

export const LESSONS = {
    branching: {
        name: "Branching",
        set: {},
        text:
            "A crack in glass speeds up under tension until one tip cannot spend the energy that flows to it. It splits. " +
            "Raise the toughness, or pull less, and it stays single. Strike the pane while it runs.",
    },
    waves: {
        name: "Waves",
        set: { notch: 0, pull: 0, breaks: 0, field: "speed", n: 120 },
        text:
            "Strike the middle. A pressure wave runs out at √(E/ρ(1−ν²)), a slower shear wave behind it. " +
            "A coarse horizon delays short waves: halve the number of points and look at the ripples behind the front.",
    },
    poisson: {
        name: "Poisson’s ratio",
        set: { law: "LPS", poisson: 0.2, pull: 2, breaks: 0, field: "stress", n: 60, notch: 0, steps: 4 },
        text:
            "Pulled up and down, the pane narrows. Bonds that act alone have one ratio, 1/3 in thin plates; " +
            "in the state-based laws each bond knows the volume change of its whole family, so that any ratio can be had. " +
            "“Find rest” measures it; the moment correction makes it right.",
    },
    criteria: {
        name: "Criteria",
        set: { law: "LPS", poisson: 0.22, criterion: "BOND_ENERGY", n: 110, m: 3 },
        text:
            "When does a bond break? When it is stretched beyond s₀; when the work on it passes w₀; or when the energy of its ends does. " +
            "All are fixed by the same toughness G₀, and none gives the same crack.",
    },
    convergence: {
        name: "Horizon",
        set: { body: "beam", n: 80, m: 3, law: "BOND_BASED", pull: 1, breaks: 0, field: "stress", correction: "NONE", notch: 0, steps: 4 },
        text:
            "A beam has a known answer. Press “Find rest”: each press leaves a dot in the plot, error against horizon. " +
            "More points with the same m shrink the horizon; a larger m at the same points widens it. Then choose the moment correction.",
    },
    impact: {
        name: "Impact",
        set: { body: "block", law: "LPS", poisson: 0.2, toughness: 60, n: 26, m: 2, pull: 0, notch: 0, magnify: 8 },
        text: "Three dimensions. Strike the top: a steel ball falls where you point. Turn the block by its own tool.",
    },
};

export const FIELDS = {
    damage: { name: "Damage", unit: "", what: "broken part of a point’s bonds" },
    energy: { name: "Energy density", unit: "J/m³", what: "elastic energy per volume" },
    stress: { name: "Stress", unit: "Pa", what: "largest principal stress; blue is compression" },
    speed: { name: "Speed", unit: "m/s", what: "how fast the points move" },
};

/** Everything that a lesson sets, over the defaults. */
export function settingsOf(lesson) {
    const set = { ...DEFAULTS, ...LESSONS[lesson].set, lesson };
    if (!("toughness" in LESSONS[lesson].set)) set.toughness = BODIES[set.body].toughness;
    return set;
}

/** Into the address and back: what differs from the lesson. */
export function toHash(settings) {
    const base = settingsOf(settings.lesson),
        parts = [`lesson=${settings.lesson}`];
    for (const key of Object.keys(DEFAULTS)) if (key !== "lesson" && settings[key] !== base[key]) parts.push(`${key}=${settings[key]}`);
    return "#" + parts.join("&");
}

const CHOICES = {
    body: Object.keys(BODIES),
    field: Object.keys(FIELDS),
    law: ["BOND_BASED", "LPS", "CORRESPONDENCE"],
    precision: ["DOUBLE", "MIXED", "SINGLE"],
    criterion: ["STRETCH", "BOND_ENERGY", "NODE_ENERGY"],
    correction: ["NONE", "MOMENT"],
};
export const RANGES = {
    n: [10, 320],
    m: [1.5, 6],
    poisson: [0, 0.45],
    toughness: [0.1, 2000],
    breaks: [0, 1],
    notch: [0, 1],
    pull: [-6, 6],
    steps: [1, 16],
    magnify: [0, 2000],
    strength: [0.25, 4],
};

export function fromHash(hash) {
    const given = Object.fromEntries(new URLSearchParams(hash.replace(/^#/, "")));
    const lesson = given.lesson in LESSONS ? given.lesson : DEFAULTS.lesson,
        settings = settingsOf(lesson);
    for (const [key, value] of Object.entries(given)) {
        if (CHOICES[key]?.includes(value)) settings[key] = value;
        else if (RANGES[key] && value !== "" && Number.isFinite(Number(value)))
            settings[key] = Math.min(RANGES[key][1], Math.max(RANGES[key][0], Number(value)));
    }
    return settings;
}

/** How far a strike reaches, in spacings. */
export const STRUCK = m => Math.max(3, 0.8 * m);

/** Stiffness that waves and beams in the plane feel. */
export const poissonOf = s => (s.law === "BOND_BASED" ? (BODIES[s.body].dim === 3 ? 1 / 4 : 1 / 3) : s.poisson);
export const waveSpeed = s => {
    const b = BODIES[s.body],
        nu = poissonOf(s);
    return Math.sqrt(b.dim === 2 ? b.young / (b.density * (1 - nu * nu)) : (b.young * (1 - nu)) / (b.density * (1 + nu) * (1 - 2 * nu)));
};
