// SPDX-License-Identifier: MIT
// story.mjs - what was done to a body since it was made, for links: { pull, acts }, an act [letter, ...values] as solver.mjs takes it;
// of frames "a", [a, steps of each, how many]. Done again, it ends in the same state to the last bit: what acts on a body is
// computed by WebAssembly and by sums, products and square roots alone, which have the same bits everywhere.
const LETTERS = { a: 2, s: 2, h: 4, f: 0, c: 3, p: 1, r: 0 }; // and how many values

const isValue = v => (Array.isArray(v) ? v.length < 4 && v.every(Number.isFinite) : Number.isFinite(v) || v === "drag" || v === "load");
const isAct = act => Array.isArray(act) && act.length === LETTERS[act[0]] + 1 && act.slice(1).every(isValue);
const isFrames = ([letter, steps, count]) => letter !== "a" || (Number.isInteger(steps) && steps > 0 && Number.isInteger(count) && count > 0);

const through = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

export async function pack(story) {
    const bytes = await through(new TextEncoder().encode(JSON.stringify(story)), new CompressionStream("deflate-raw"));
    const text = Array.from(bytes, b => String.fromCharCode(b)).join("");
    return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** null for what is no story. */
export async function unpack(text) {
    try {
        const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), c => c.charCodeAt(0));
        const { pull, acts } = JSON.parse(new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw"))));
        return Number.isFinite(pull) && acts.every(act => isAct(act) && isFrames(act)) ? { pull, acts } : null;
    } catch {
        return null;
    }
}
