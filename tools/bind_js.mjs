// SPDX-License-Identifier: MIT
// bind_js.mjs - bindings/api.json and the sizes that a program printed under WebAssembly -> api.mjs, what bindings/js/peri.mjs works by,
// and peri.d.mts, the same for TypeScript and editors.
//   node tools/bind_js.mjs bindings/api.json build/wasm/sizes.json build/js
import { readFileSync, writeFileSync } from "node:fs";

const [apiFile, sizesFile, folder] = process.argv.slice(2);
const header = JSON.parse(readFileSync(apiFile, "utf8")),
    alone = list => list.filter(entry => !entry.name.startsWith("peri_world")), // as tools/api.py: without_joining
    api = { ...header, functions: alone(header.functions), structs: alone(header.structs), opaque: alone(header.opaque) },
    sizes = JSON.parse(readFileSync(sizesFile, "utf8"));
if (sizes.pointer !== 4) throw new Error("sizes of another machine");

const short = name => name.replace(/^peri_/i, "");
const TYPES = { int32_t: "i32", uint32_t: "i32", int64_t: "i64", uint64_t: "u64", double: "f64", float: "f32", void: "void" };
const callbacks = new Map(api.callbacks.map(c => [c.name, c])),
    structs = new Map(api.structs.map(s => [s.name, s]));
const functions = new Map(api.functions.map(f => [f.name, f])),
    opaque = new Set(api.opaque.map(o => o.name));
const HOOKS = /^peri_(allocate|release|parallel_for|task)_fn$/; // for C: nothing that JavaScript could do there

// Lengths that depend on more than the text beside the argument says.
const ENTRIES = Object.fromEntries(
    ["displacement", "velocity", "force", "impulse"].map(n => [
        "peri_evaluate_desc." + n,
        "(points-1)*(point_stride||dim)+(dim-1)*(component_stride||1)+1",
    ]),
);
const entries = (owner, p) => {
    const said = ENTRIES[`${owner}.${p.name}`] ?? p.entries;
    return said === undefined ? undefined : `s => ${said.replace(/[a-z_]\w*/g, "s.$&")}`;
};

// ---- callbacks, structs, functions --------------------------------------------------------------------------------------

function makeCallback(c) {
    const listed = c.params.map(p => {
        const out = { name: p.name, t: p.pointer || callbacks.has(p.type) ? "ptr" : TYPES[p.type] };
        if (p.role.startsWith("array")) Object.assign(out, { role: "array", of: TYPES[p.type], entries: entries(c.name, p) });
        else if (p.role !== "value") out.role = p.role;
        if (p.role === "value" && p.name === "count") out.counts = true; // the length of the arrays says it
        return out;
    });
    return { void: c.returns === "void", params: listed };
}

function makeField(s, f) {
    const [at] = sizes.structs[s.name].fields[f.name],
        out = { at, t: f.pointer || callbacks.has(f.type) ? "ptr" : TYPES[f.type] };
    if (f.length) out.length = f.length;
    if (HOOKS.test(f.type)) out.role = "hook";
    else if (callbacks.has(f.type)) {
        const own = f.name.replace(/_fn$/, "") + "_user";
        Object.assign(out, { role: "callback", of: f.type, user: s.fields.some(x => x.name === own) ? own : "user" });
    } else if (/(^|_)user$/.test(f.name)) out.role = "user";
    else if (structs.has(f.type)) Object.assign(out, { role: f.pointer ? "struct" : "inner", of: f.type });
    else if (f.type === "char") out.role = "text";
    else if (s.name === "peri_view" && f.name === "data") out.role = "pointer";
    else if (f.pointer) Object.assign(out, { role: "array", of: TYPES[f.type], const: f.const, entries: entries(s.name, f) });
    return out;
}

function makeStruct(s) {
    const init = functions.get(s.name + "_init");
    return {
        size: sizes.structs[s.name].size,
        init: init?.name,
        initWith: init?.params.slice(1).map(p => p.name),
        fields: Object.fromEntries(s.fields.map(f => [f.name, makeField(s, f)])),
    };
}

function makeParam(f, p, k) {
    const out = { name: p.name, role: p.role };
    if (p.optional) out.optional = true;
    if (p.role === "handle" && k === 0) return { ...out, role: "self" };
    if (p.role === "new handle") return { ...out, role: "new", of: p.type };
    if (p.type === "peri_error") return { ...out, role: "error" };
    if (p.role === "callback") return { ...out, of: p.type };
    if (p.role === "struct in") return { ...out, of: p.type };
    const length = { entries: entries(f.name, p), single: p.entries === "1" || undefined };
    if (p.role === "struct out") {
        if (functions.has(p.type + "_init")) return { ...out, role: "struct inout", of: p.type };
        return { ...out, of: p.type, ...length };
    }
    if (p.role.startsWith("array")) return { ...out, of: TYPES[p.type], ...length };
    if (/(^|_)capacity$/.test(p.name)) {
        const filled = f.params.find(q => q.role.endsWith("out") && q.entries && !/capacity/.test(q.entries));
        return { ...out, role: "capacity", entries: filled && p.name === "capacity" ? entries(f.name, filled) : undefined };
    }
    out.t = TYPES[p.type];
    const by = f.params.find(q => q.role === "array in" && q.entries && new RegExp(`^${p.name}(\\*\\w+)?$`).test(q.entries));
    if (p.name === "count" && by) out.counts = { by: by.name, per: `s => ${by.entries.split("*")[1]?.replace(/^[a-z]\w*/, "s.$&") ?? 1}` };
    return out;
}

function makeFunction(f) {
    const params = f.params.map((p, k) => makeParam(f, p, k)),
        of = f.params[0]?.role === "handle" ? f.params[0].type : undefined;
    const asked = ["value", "text", "array in", "struct in", "struct inout", "callback"];
    const given = params.filter(p => !p.counts && asked.includes(p.role)).map(p => p.name);
    const js = of && f.name.startsWith(of + "_") ? f.name.slice(of.length + 1) : short(f.name);
    return {
        name: f.name,
        js,
        of,
        given,
        params,
        result: f.result === "count or status" ? (f.returns === "int64_t" ? "count" : "status") : f.result,
        bytes: f.params.some(p => /^peri_(write|read)_fn$/.test(p.type)) || undefined,
        // callbacks of loads, of obstacles and of the body outlive the call; the others end with it
        keeps: !/advance|solve|evaluate|select_if|add_shape|cut_if|_to$|_from$|plan|choose/.test(f.name) || undefined,
        hidden: /_init$|_destroy$|^peri_(format_error|body_create|get_error)$/.test(f.name) || undefined,
    };
}

const constants = Object.fromEntries([...api.constants, ...api.enums.flatMap(e => e.values)].map(v => [short(v.name), v.value]));
const status = api.enums.find(e => e.name === "peri_status").values;
const made = {
    constants,
    codes: Object.fromEntries(Object.entries(constants).filter(([k]) => /^(ERROR|TYPE)_/.test(k))),
    statusNames: Object.fromEntries(status.map(v => [v.value, v.name])),
    callbacks: Object.fromEntries(api.callbacks.filter(c => !HOOKS.test(c.name)).map(c => [c.name, makeCallback(c)])),
    structs: Object.fromEntries(api.structs.map(s => [s.name, makeStruct(s)])),
    functions: Object.fromEntries(api.functions.filter(f => !f.unless).map(f => [f.name, makeFunction(f)])),
};

/** JSON, but for the arrows that compute lengths. */
const code = value => JSON.stringify(value).replace(/"(s => [^"]*)"/g, "$1");

writeFileSync(
    `${folder}/api.mjs`,
    "// made by tools/bind_js.mjs of bindings/api.json\nexport const api = {\n" +
        Object.entries(made)
            .map(([name, part]) =>
                name === "constants" || name === "codes" || name === "statusNames"
                    ? `${name}: ${code(part)}`
                    : `${name}: {\n${Object.entries(part)
                          .map(([k, v]) => `${k}: ${code(v)}`)
                          .join(",\n")}\n}`,
            )
            .join(",\n") +
        "\n};\n",
);

// ---- types ------------------------------------------------------------------------------------------------------------------

const ARRAYS = { i32: "Int32Array", f64: "Float64Array", f32: "Float32Array", i64: "number[]", void: "Float64Array | Float32Array" };
const Name = name =>
    short(name)
        .replace(/_fn$/, "_callback")
        .replace(/(^|_)(\w)/g, (_, _u, c) => c.toUpperCase());
const doc = (text, indent = "") => (text ? `${indent}/** ${text.replaceAll("*/", "* /")} */\n` : "");
const numbers = "ArrayLike<number>";
const lines = ["// made by tools/bind_js.mjs of bindings/api.json"];

function callbackType(c) {
    const m = made.callbacks[c.name];
    const args = c.params
        .filter((p, k) => m.params[k].role !== "user" && !m.params[k].counts)
        .map(p => {
            const k = m.params.find(q => q.name === p.name);
            const plain = { bytes: "Uint8Array", text: "string", handle: "Body" };
            return `${p.name}: ${k.role === "array" ? ARRAYS[k.of] : (plain[k.role] ?? "number")}`;
        });
    return `(${args.join(", ")}) => number | boolean | void`;
}

function fieldType(f, m, isInput) {
    if (m.role === "callback") return Name(m.of);
    if (m.role === "struct" || m.role === "inner") return Name(m.of);
    if (m.role === "text") return "string";
    if (m.role === "array") return isInput && m.const && m.of !== "void" ? numbers : ARRAYS[m.of];
    return m.length ? (isInput ? numbers : "number[]") : "number";
}

for (const c of api.callbacks) if (made.callbacks[c.name]) lines.push(doc(c.doc) + `export type ${Name(c.name)} = ${callbackType(c)};`);
for (const s of api.structs) {
    const m = made.structs[s.name],
        isInput = Boolean(m.init) || s.name === "peri_obstacle_state";
    lines.push(doc(s.doc) + `export interface ${Name(s.name)} {`);
    for (const f of s.fields) {
        const k = m.fields[f.name];
        if (["user", "hook", "pointer"].includes(k.role) || f.name === "cookie" || f.name === "reserved") continue;
        lines.push(doc(f.doc, "    ") + `    ${f.name}${isInput && !f.required ? "?" : ""}: ${fieldType(f, k, isInput)};`);
    }
    if (s.name === "peri_view") {
        lines.push("    /** The numbers in place. Ask again after calls that may take memory. */");
        lines.push("    readonly data: Float64Array | Float32Array | Int32Array;");
        lines.push("    /** Component k of point i, in your units. */\n    at(i: number, k?: number): number;");
    }
    lines.push("}");
}

function resultType(f) {
    if (f.result === "text") return "string";
    if (f.name === "peri_view_field") return "View";
    const outs = f.params
        .filter(p => ["new", "struct inout", "array out", "struct out"].includes(p.role))
        .map(p => {
            const one = p.role === "new" || p.role.startsWith("struct") ? Name(p.of) : p.single ? "number" : ARRAYS[p.of];
            const many = p.role === "struct out" && !p.single ? "[]" : "";
            return [p.name, one + many + (p.single && p.optional ? " | null" : "")];
        });
    const object = list => `{ ${list.map(([n, t]) => `${n}: ${t}`).join("; ")} }`;
    if (f.result === "count" && outs.length) return object([["count", "number"], ...outs]);
    if (outs.length > 1) return object(outs);
    return outs.length ? outs[0][1] : f.result === "none" ? "void" : "number";
}

function signature(f) {
    const args = f.given.map((name, k) => {
        const p = f.params.find(q => q.name === name);
        const type =
            p.role === "value"
                ? "number"
                : p.role === "text"
                  ? "string | null"
                  : p.role === "array in"
                    ? numbers
                    : p.role === "callback"
                      ? Name(p.of)
                      : Name(p.of);
        const rest = f.given.slice(k).map(n => f.params.find(q => q.name === n));
        const mayLack = q => q.optional || q.role === "struct in" || q.role === "struct inout" || (f.bytes && q.role === "callback");
        const bytes = f.bytes && p.of === "peri_read_fn" ? " | Uint8Array" : "";
        return `${name === "in" ? "in_" : name}${rest.every(mayLack) ? "?" : ""}: ${type}${bytes}${p.optional ? " | null" : ""}`;
    });
    const returns = f.bytes && f.params.some(p => p.of === "peri_write_fn") ? "Uint8Array" : resultType(f);
    return `${f.js}(${args.join(", ")}): ${returns};`;
}

const visible = Object.values(made.functions).filter(f => !f.hidden);
for (const name of ["peri_body", "peri_matrix", "peri_cracks"]) {
    lines.push(`export interface ${Name(name)} {`);
    for (const f of visible) if (f.of === name) lines.push(doc(functions.get(f.name).doc, "    ") + "    " + signature(f));
    lines.push("    /** Frees it. */\n    destroy(): void;", "}");
}
lines.push(
    "export declare class PeriError extends Error {",
    "    code: number;",
    "    /** PERI_ERROR_RANGE, ... */\n    status: string;",
    '    /** The name in peri.h of what is at fault, or "". */\n    field: string;',
    "    /** The first offending point, entry or id; else -1. */\n    index: number;",
    "    value: number;",
    "}",
    "export interface Peri {",
    "    Body: new (desc: BodyDesc) => Body;",
    "    PeriError: typeof PeriError;",
    "    readonly memory: WebAssembly.Memory;",
);
for (const f of visible) if (!f.of) lines.push(doc(functions.get(f.name).doc, "    ") + "    " + signature(f));
for (const v of [...api.constants, ...api.enums.flatMap(e => e.values)])
    lines.push(doc(v.doc, "    ") + `    readonly ${short(v.name)}: ${typeof v.value};`);
lines.push(
    "}",
    "/** The library; source: the bytes, the address or a compiled module of a build. Default: peri.wasm beside this file. */",
    "export declare function load(source?: string | URL | BufferSource | WebAssembly.Module): Promise<Peri>;",
    "/** The same of a compiled module, at once. */",
    "export declare function instantiate(module: WebAssembly.Module): Peri;",
);
if (opaque.size !== 3) throw new Error("a class of its own for the new opaque type: bindings/js/peri.mjs");
const about = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
writeFileSync(`${folder}/package.json`, JSON.stringify({ ...about, version: constants.VERSION }, null, 2) + "\n");
writeFileSync(`${folder}/peri.d.mts`, lines.join("\n") + "\n");
