// SPDX-License-Identifier: MIT
// grows.mjs - what is added to peri.h is in the layer, too, by no other edit: a field, a value of an enum, a function, of a scratch copy.
//   node tests/web/grows.mjs EMCC
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [emcc = "emcc"] = process.argv.slice(2),
    folder = "build/wasm/grown";
rmSync(folder, { recursive: true, force: true });
for (const name of ["tools", "bindings", "out"]) mkdirSync(`${folder}/${name}`, { recursive: true });
cpSync("tools/api.py", `${folder}/tools/api.py`);
for (const name of ["package.json", "peri.mjs"]) cpSync(`bindings/js/${name}`, `${folder}/out/${name}`);

const once = (text, from, to) => {
    assert.equal(text.split(from).length, 2, from);
    return text.replace(from, to);
};
let header = readFileSync("peri.h", "utf8");
header = once(
    header,
    "    double horizon;                    /*",
    "    double warmth; /* [L] > 0. Default 1 */\n    double horizon;                    /*",
);
header = once(header, "    PERI_LAW_BOND_BASED = 1001,", "    PERI_LAW_NEW = 1999,\n    PERI_LAW_BOND_BASED = 1001,");
header = once(
    header,
    "PERI_API int32_t peri_build(peri_body *body);",
    "PERI_API int32_t peri_build(peri_body *body);\n\n" +
        "/* Warmth [-] of each point to warmth[points]. */\nPERI_API int32_t peri_get_warmth(peri_body *body, int32_t set, double *warmth);",
);
writeFileSync(`${folder}/peri.h`, header);

const python = (...args) => execFileSync("python3", [`${folder}/tools/api.py`, ...args], { encoding: "utf8" });
python();
writeFileSync(`${folder}/sizes.c`, python("--sizes"));
execFileSync(emcc, ["-I" + folder, "-s", "SINGLE_FILE=1", `${folder}/sizes.c`, "-o", `${folder}/sizes.js`]);
writeFileSync(`${folder}/sizes.json`, execFileSync("node", [`${folder}/sizes.js`]));
execFileSync("node", ["tools/bind_js.mjs", `${folder}/bindings/api.json`, `${folder}/sizes.json`, `${folder}/out`]);

const { api } = await import(pathToFileURL(resolve(`${folder}/out/api.mjs`)).href),
    before = await import(pathToFileURL(resolve("build/js/api.mjs")).href);
const body = api.structs.peri_body_desc,
    old = before.api.structs.peri_body_desc;
assert.equal(body.fields.warmth.at, old.fields.horizon.at);
assert.equal(body.fields.horizon.at, old.fields.horizon.at + 8);
assert.equal(body.size, old.size + 8);
assert.equal(api.constants.LAW_NEW, 1999);
const f = api.functions.peri_get_warmth,
    out = f.params.find(p => p.name === "warmth");
assert.deepEqual([f.js, f.of, f.given], ["get_warmth", "peri_body", ["set"]]);
assert.equal(out.entries({ points: 7 }), 7);
const types = readFileSync(`${folder}/out/peri.d.mts`, "utf8");
assert.match(types, /warmth\?: number;/);
assert.match(types, /get_warmth\(set: number\): Float64Array;/);
assert.match(types, /readonly LAW_NEW: number;/);
console.log("ok   a field, a value and a function added to peri.h are in the layer");
