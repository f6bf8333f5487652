// SPDX-License-Identifier: MIT
// peri.mjs - the library as a module of JavaScript. All names are those of peri.h without "peri_" and "PERI_"; api.mjs, made of
// bindings/api.json, says what there is. README.md tells how arguments and results look.
import { api } from "./api.mjs";

const SIZES = { i32: 4, f32: 4, u32: 4, i64: 8, u64: 8, f64: 8, ptr: 4 };
const ARRAYS = { i32: Int32Array, f64: Float64Array, f32: Float32Array, i64: BigInt64Array };

/** A call that failed: what peri_get_error tells. */
export class PeriError extends Error {
    constructor(code, field = "", index = -1, value = 0, text = "") {
        const where = (field && ` ${field}`) + (index >= 0 ? ` index ${index}` : "") + (value ? ` value ${value}` : "");
        super((text || api.statusNames[code] || `status ${code}`) + (where && ":" + where));
        this.name = "PeriError";
        Object.assign(this, { code, status: api.statusNames[code] ?? "", field, index, value });
    }
}

/** A name that hides what the scope below it computes. */
function put(scope, name, value) {
    Object.defineProperty(scope, name, { value, writable: true, configurable: true });
}

// ---- functions of JavaScript as functions of WebAssembly: a module of one import and one export per signature -------------

const CODES = { i32: 0x7f, ptr: 0x7f, i64: 0x7e, u64: 0x7e, f64: 0x7c };

function toWasm(callback, fn) {
    const types = [0x60, callback.params.length, ...callback.params.map(p => CODES[p.t]), ...(callback.void ? [0] : [1, 0x7f])];
    const section = (id, ...bytes) => [id, bytes.length, ...bytes];
    const bytes = [
        0,
        0x61,
        0x73,
        0x6d,
        1,
        0,
        0,
        0,
        ...section(1, 1, ...types),
        ...section(2, 1, 1, 0x65, 1, 0x66, 0, 0),
        ...section(7, 1, 1, 0x66, 0, 0),
    ];
    return new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(bytes)), { e: { f: fn } }).exports.f;
}

// ---- memory -----------------------------------------------------------------------------------------------------------------

class Machine {
    constructor(exports) {
        this.exports = exports;
        this.memory = exports.memory;
        this.table = exports.__indirect_function_table;
        this.closures = new Map(); // what the callbacks of a call mean: by the number that is passed as `user`
        this.trampolines = new Map();
        this.bodies = new Map();
        this.next = 1;
        this.thrown = null; // what a callback threw, until the call that it came from hands it on
        this.refresh();
    }
    refresh() {
        if (this.data?.buffer !== this.memory.buffer) this.data = new DataView(this.memory.buffer);
        return this.data;
    }
    allocate(bytes) {
        const at = this.exports.malloc(Math.max(bytes, 8));
        if (!at) throw new PeriError(api.codes.ERROR_MEMORY);
        return at;
    }
    text(at) {
        if (!at) return "";
        const bytes = new Uint8Array(this.memory.buffer);
        let end = at;
        while (bytes[end]) ++end;
        return new TextDecoder().decode(bytes.slice(at, end));
    }
    get(type, at) {
        const d = this.refresh();
        return type === "f64"
            ? d.getFloat64(at, true)
            : type === "i64"
              ? Number(d.getBigInt64(at, true))
              : type === "u64"
                ? Number(d.getBigUint64(at, true))
                : type === "f32"
                  ? d.getFloat32(at, true)
                  : type === "ptr"
                    ? d.getUint32(at, true)
                    : d.getInt32(at, true);
    }
    set(type, at, value) {
        const d = this.refresh();
        if (type === "f64") d.setFloat64(at, value, true);
        else if (type === "i64") d.setBigInt64(at, BigInt(value), true);
        else if (type === "u64") d.setBigUint64(at, BigInt(value), true);
        else if (type === "ptr") d.setUint32(at, value, true);
        else d.setInt32(at, value, true);
    }
    array(type, at, entries) {
        return new ARRAYS[type](this.memory.buffer, at, entries);
    }

    /** The number in the table of the one function that serves all callbacks of a type. */
    trampoline(type) {
        if (this.trampolines.has(type)) return this.trampolines.get(type);
        const callback = api.callbacks[type];
        const fn = (...given) => this.called(type, callback, given);
        const at = this.table.grow(1);
        this.table.set(at, toWasm(callback, fn));
        this.trampolines.set(type, at);
        return at;
    }
    called(type, callback, given) {
        const closure = this.closures.get(given[0]);
        if (this.thrown) return -1; // an exception ends the call: nothing more is asked
        try {
            const fn = closure.functions[type],
                scope = Object.create(closure.scope),
                values = [];
            callback.params.forEach((p, k) => put(scope, p.name, p.t === "i64" ? Number(given[k]) : given[k]));
            for (const p of callback.params) {
                const value = scope[p.name];
                if (p.role === "user") continue;
                if (p.role === "array") values.push(this.array(p.of, value, p.entries(scope)));
                else if (p.role === "bytes") values.push(new Uint8Array(this.memory.buffer, value, scope.count));
                else if (p.role === "text") values.push(this.text(value));
                else if (p.role === "handle") values.push(this.bodies.get(value));
                else if (!p.counts) values.push(value);
            }
            const answer = fn(...values);
            return answer === true ? 1 : Number(answer ?? 0) | 0;
        } catch (error) {
            this.thrown = { error };
            return -1;
        }
    }
}

// ---- one call ---------------------------------------------------------------------------------------------------------------

/** Places arguments in memory, keeps count of what is to be freed and read back. */
class Call {
    constructor(machine, object) {
        this.m = machine;
        this.object = object; // of which a method is called, or null
        this.temporary = [];
        this.after = [];
        this.closure = 0;
        this.scope = object ? object.scope : {};
    }
    allocate(bytes) {
        const at = this.m.allocate(bytes);
        this.temporary.push(at);
        return at;
    }
    user(functions) {
        // all callbacks of one `user`
        if (!this.closure) {
            this.closure = this.m.next++;
            this.m.closures.set(this.closure, { functions: {}, scope: this.scope });
        }
        Object.assign(this.m.closures.get(this.closure).functions, functions);
        return this.closure;
    }
    string(value) {
        const bytes = new TextEncoder().encode(String(value)),
            at = this.allocate(bytes.length + 1);
        new Uint8Array(this.m.memory.buffer).set([...bytes, 0], at);
        return at;
    }
    /** Entries as given; a typed array in the memory of the library stays where it is. `back`: what is written comes back. */
    arrayIn(type, value, name, back = false) {
        if (value.buffer === this.m.memory.buffer) return value.byteOffset;
        if (!(ArrayBuffer.isView(value) || Array.isArray(value))) throw new TypeError(`${name}: an array is wanted`);
        const kind = type === "void" ? value.constructor : ARRAYS[type];
        const at = this.allocate(value.length * kind.BYTES_PER_ELEMENT);
        new kind(this.m.memory.buffer, at, value.length).set(type === "i64" ? Array.from(value, BigInt) : value);
        if (back) this.after.push(() => value.set(new kind(this.m.memory.buffer, at, value.length)));
        return at;
    }
    /** A descriptor: its defaults, then what `value` has. */
    structIn(name, value) {
        const s = api.structs[name],
            at = this.allocate(s.size);
        new Uint8Array(this.m.memory.buffer, at, s.size).fill(0);
        if (s.init) this.m.exports[s.init](at, ...s.initWith.map(w => this.needed(value, w, name)));
        this.fill(s, at, value, name);
        return at;
    }
    fill(s, at, value, name) {
        for (const [key, given] of Object.entries(value ?? {})) {
            const f = s.fields[key];
            if (!f || f.role === "user" || key === "cookie") throw new TypeError(`${name}: there is no field "${key}"`);
            if (given !== undefined && given !== null) this.field(f, at + f.at, given, `${name}.${key}`, at, s, value);
        }
    }
    needed(value, key, name) {
        if (typeof value?.[key] !== "number") throw new TypeError(`${name}: ${key} is required`);
        return value[key];
    }
    fieldArray(f, at, value, name, owner) {
        const scope = Object.create(this.scope),
            single = owner.type === api.codes.TYPE_F32;
        for (const [key, one] of Object.entries(owner)) if (typeof one === "number") put(scope, key, one);
        for (const key of ["point_stride", "component_stride"]) if (!(key in scope)) put(scope, key, 0);
        const need = f.entries?.(scope);
        if (need > value.length) throw new TypeError(`${name}: ${need} entries are wanted, ${value.length} given`);
        const kind = single ? Float32Array : Float64Array;
        if (f.of === "void" && !(value instanceof kind)) throw new TypeError(`${name}: not of the type of the desc`);
        this.m.set("ptr", at, this.arrayIn(f.of, value, name, !f.const));
    }
    field(f, at, value, name, base, s, owner) {
        if (f.role === "hook") throw new TypeError(`${name}: not for JavaScript`);
        if (f.role === "callback") {
            if (typeof value !== "function") throw new TypeError(`${name}: a function is wanted`);
            const user = this.user({ [f.of]: value });
            this.m.set("ptr", at, this.m.trampoline(f.of));
            this.m.set("ptr", base + s.fields[f.user].at, user);
        } else if (f.role === "inner") this.fill(api.structs[f.of], at, value, name);
        else if (f.role === "struct") this.m.set("ptr", at, this.structIn(f.of, value));
        else if (f.role === "array") this.fieldArray(f, at, value, name, owner);
        else if (f.length) {
            if (value.length > f.length) throw new TypeError(`${name}: at most ${f.length} entries`);
            for (let k = 0; k < value.length; ++k) this.m.set(f.t, at + k * SIZES[f.t], value[k]);
        } else {
            const number = checked(value, name);
            this.m.set(f.t, at, f.t === "i64" || f.t === "u64" ? whole(number, name) : number);
        }
    }
    structOut(name, at) {
        const out = {};
        for (const [key, f] of Object.entries(api.structs[name].fields)) {
            if (key === "cookie" || key === "reserved" || f.role === "user" || f.role === "hook" || f.role === "callback") continue;
            if (f.role === "text") out[key] = this.m.text(this.m.get("ptr", at + f.at));
            else if (f.role === "inner") out[key] = this.structOut(f.of, at + f.at);
            else if (f.length) out[key] = Array.from({ length: f.length }, (_, k) => this.m.get(f.t, at + f.at + k * SIZES[f.t]));
            else if (!f.role) out[key] = this.m.get(f.t, at + f.at);
        }
        return out;
    }
    free() {
        for (const at of this.temporary) this.m.exports.free(at);
        this.temporary.length = 0;
    }
}

function checked(value, name) {
    if (typeof value === "boolean") return Number(value);
    if (typeof value !== "number" && typeof value !== "bigint") throw new TypeError(`${name}: a number is wanted`);
    return value;
}

function whole(value, name) {
    if (typeof value !== "bigint" && !Number.isSafeInteger(value)) throw new TypeError(`${name}: a whole number is wanted`);
    return BigInt(value);
}

// ---- functions ----------------------------------------------------------------------------------------------------------------

function argument(call, p, value, scope, capacities) {
    const m = call.m;
    switch (p.role) {
        case "value": {
            const number = checked(value, p.name);
            return p.t === "i64" || p.t === "u64" ? whole(number, p.name) : Number(number);
        }
        case "text":
            return value === null || value === undefined ? 0 : call.string(value);
        case "array in": {
            if ((value === null || value === undefined) && p.optional) return 0;
            if (value === null || value === undefined) throw new TypeError(`${p.name}: an array is wanted`);
            const at = call.arrayIn(p.of, value, p.name),
                need = p.entries(scope);
            if (value.length < need) throw new TypeError(`${p.name}: ${need} entries are wanted, ${value.length} given`);
            return at;
        }
        case "struct in":
            return value === null && p.optional ? 0 : call.structIn(p.of, value);
        case "struct inout":
            return call.structIn(p.of, value);
        case "array out": {
            const entries = Math.max(0, p.entries(scope));
            return (capacities.at[p.name] = call.allocate((capacities.entries[p.name] = entries) * SIZES[p.of]));
        }
        case "struct out": {
            const entries = Math.max(0, p.entries(scope));
            return (capacities.at[p.name] = call.allocate((capacities.entries[p.name] = entries) * api.structs[p.of].size));
        }
        case "new":
            return (capacities.at[p.name] = call.allocate(4));
        case "error":
            return (capacities.at.error = call.allocate(api.structs.peri_error.size));
        case "callback":
            if ((value === null || value === undefined) && p.optional) return 0;
            if (typeof value !== "function") throw new TypeError(`${p.name}: a function is wanted`);
            call.user({ [p.of]: value });
            return m.trampoline(p.of);
        case "user":
            return call.closure;
    }
    throw new Error(p.role);
}

function failure(call, status, errorAt) {
    const m = call.m,
        e = api.structs.peri_error;
    let at = errorAt;
    if (!at && call.object?.isBody) {
        at = call.allocate(e.size);
        m.exports.peri_get_error(call.object.pointer, at);
    }
    if (!at || m.get("i32", at) !== status) return new PeriError(status, "", -1, 0, m.text(m.exports.peri_status_text(status)));
    const o = call.structOut("peri_error", at);
    return new PeriError(o.code, o.field, o.index, o.value, o.text);
}

/** Calls once; capacities are what earlier calls asked for. */
function attempt(machine, object, f, given, call, capacities) {
    const scope = Object.create(call.scope);
    for (const p of f.params) {
        if (p.role === "value" && p.name in given) put(scope, p.name, Number(given[p.name]));
        if (p.role === "capacity") put(scope, p.name, capacities.known[p.name] ?? 0);
        if (p.counts) put(scope, p.name, Math.floor((given[p.counts.by]?.length ?? 0) / p.counts.per(scope)));
    }
    const args = f.params.map(p => {
        if (p.role === "self") return object.pointer;
        if (p.role === "capacity") return 0n; // below, where all arrays are known
        if (p.counts) return p.t === "i64" ? BigInt(scope[p.name]) : scope[p.name];
        if (capacities.without.has(p.name)) return 0;
        const at = argument(call, p, given[p.name], scope, capacities);
        if (p.role === "struct inout") capacities.at[p.name] = at;
        return at;
    });
    f.params.forEach((p, k) => {
        if (p.role === "capacity") args[k] = BigInt(p.entries ? p.entries(scope) : scope[p.name]);
    });
    const result = machine.exports[f.name](...args);
    return typeof result === "bigint" ? Number(result) : result;
}

function results(machine, f, call, capacities, result) {
    const out = {};
    for (const p of f.params) {
        const at = capacities.at[p.name];
        if (p.role === "new") out[p.name] = new machine.classes[p.of](HANDLE, machine.get("ptr", at), call.object);
        else if (p.role === "struct inout") out[p.name] = call.structOut(p.of, at);
        else if (capacities.without.has(p.name)) out[p.name] = null;
        else if (p.role === "array out") {
            const n = capacities.entries[p.name];
            const all = p.single ? null : machine.array(p.of, at, n);
            out[p.name] = p.single ? machine.get(p.of, at) : p.of === "i64" ? Array.from(all, Number) : all.slice();
        } else if (p.role === "struct out") {
            const size = api.structs[p.of].size;
            out[p.name] = p.single
                ? call.structOut(p.of, at)
                : Array.from({ length: capacities.entries[p.name] }, (_, k) => call.structOut(p.of, at + k * size));
        }
    }
    const names = Object.keys(out);
    if (f.result === "text") return machine.text(result);
    if (f.result === "count" && names.length) return { count: result, ...out };
    if (names.length === 1) return out[names[0]];
    return names.length ? out : f.result === "none" ? undefined : result;
}

function invoke(machine, object, f, given) {
    if (object && !object.pointer) throw new Error(`${f.js}: this was destroyed`);
    const capacities = { known: {}, at: {}, entries: {}, without: new Set() };
    for (let tries = 0; ; ++tries) {
        const call = new Call(machine, object);
        let kept = false;
        try {
            const result = attempt(machine, object, f, given, call, capacities);
            if (machine.thrown) {
                const { error } = machine.thrown;
                machine.thrown = null;
                throw error;
            }
            if (f.result !== "number" && f.result !== "text" && result < 0) {
                const error = failure(call, result, capacities.at.error);
                const p = f.params.find(q => q.name === error.field);
                const isShort = error.code === api.codes.ERROR_CAPACITY && p?.role === "capacity";
                const isNone = p?.role === "array out" && p.optional && !capacities.without.has(p.name);
                if (tries > 3 || !(isShort || isNone)) throw error;
                if (isShort) capacities.known[p.name] = error.value;
                else capacities.without.add(p.name); // this body has none: null
                continue;
            }
            for (const write of call.after) write();
            if (call.closure && f.keeps) {
                kept = true;
                object?.kept.handles.push(call.closure);
            }
            return results(machine, f, call, capacities, result);
        } finally {
            if (call.closure && !kept) machine.closures.delete(call.closure);
            call.free();
        }
    }
}

/** By position, as in peri.h, without handles, counts, capacities, what comes back and `user`. */
function byName(f, values) {
    if (values.length > f.given.length) throw new TypeError(`${f.js}: at most ${f.given.length} arguments`);
    return Object.fromEntries(f.given.map((name, k) => [name, values[k]]));
}

// ---- files that the library writes and reads -----------------------------------------------------------------------------------

/** export_..._to() and save_state_to() without a function return the bytes; load_state_from takes bytes, too. */
function withBytes(f, given) {
    const p = f.params.find(q => q.of === "peri_write_fn" || q.of === "peri_read_fn");
    const value = given[p.name];
    if (p.of === "peri_read_fn" && ArrayBuffer.isView(value)) {
        let at = 0;
        given[p.name] = bytes => {
            if (at + bytes.length > value.length) return -1;
            bytes.set(value.subarray(at, (at += bytes.length)));
            return 0;
        };
    }
    if (p.of !== "peri_write_fn" || value !== undefined) return null;
    const parts = [];
    given[p.name] = bytes => {
        parts.push(bytes.slice());
    };
    return () => {
        const whole = new Uint8Array(parts.reduce((n, part) => n + part.length, 0));
        let at = 0;
        for (const part of parts) {
            whole.set(part, at);
            at += part.length;
        }
        return whole;
    };
}

// ---- classes ---------------------------------------------------------------------------------------------------------------------

const HANDLE = Symbol("made by the library");

/** A field in place, without a copy: data[i*point_stride + k*component_stride], scaled and shifted. */
class View {
    #machine;
    #struct;
    constructor(machine, struct, pointer) {
        const { TYPE_F64, TYPE_F32 } = api.codes;
        Object.assign(this, struct);
        this.#machine = machine;
        this.#struct = { pointer, kind: struct.type === TYPE_F64 ? "f64" : struct.type === TYPE_F32 ? "f32" : "i32" };
    }
    /** The numbers in the memory of the library. Ask again after calls that may take memory: growth replaces the buffer. */
    get data() {
        const last = (this.count - 1) * this.point_stride + (this.components - 1) * this.component_stride;
        return this.#machine.array(this.#struct.kind, this.#struct.pointer, last + 1);
    }
    /** Component k of point i, in your units. */
    at(i, k = 0) {
        return (this.offset[k] ?? 0) + this.scale * this.data[i * this.point_stride + k * this.component_stride];
    }
}

function makeClass(machine, name) {
    const Made = class {
        constructor(desc, pointer, parent) {
            const isBody = name === "peri_body";
            Object.defineProperty(this, "isBody", { value: isBody });
            Object.defineProperty(this, "kept", { value: isBody && parent ? parent.kept : { handles: [], users: 0 } });
            this.kept.users++;
            if (desc === HANDLE) this.pointer = pointer;
            else if (isBody) this.create(desc);
            else throw new TypeError(`made by a body: ${name.replace("peri_", "")}_create`);
            Object.defineProperty(this, "pointer", { enumerable: false });
            Object.defineProperty(this, "dimension_", { value: isBody ? machine.exports.peri_dimension(this.pointer) : parent.dimension_ });
            if (isBody) machine.bodies.set(this.pointer, this);
            if (isBody) this.scope.dim = this.dimension_;
        }
        create(desc) {
            Object.defineProperty(this, "scope_", { value: this.makeScope(), configurable: true });
            const f = { ...api.functions.peri_body_create, js: "Body", keeps: true };
            const call = new Call(machine, this),
                error = call.allocate(api.structs.peri_error.size),
                out = call.allocate(4);
            try {
                const status = machine.exports[f.name](call.structIn("peri_body_desc", desc), out, error);
                if (status < 0) throw failure(call, status, error);
                this.pointer = machine.get("ptr", out);
                if (call.closure) this.kept.handles.push(call.closure);
            } finally {
                if (!this.pointer && call.closure) machine.closures.delete(call.closure);
                call.free();
            }
        }
        /** What lengths of arrays depend on. */
        makeScope() {
            const e = machine.exports,
                self = this,
                number = v => Number(v);
            const scope = {
                get points() {
                    return number(e.peri_point_count(self.pointer));
                },
                get width() {
                    return number(e.peri_family_width(self.pointer));
                },
                get turns() {
                    return this.dim === 2 ? 1 : 3;
                },
            };
            if (name !== "peri_body") {
                for (const f of Object.values(api.functions)) {
                    if (f.of !== name || f.params.length !== 1 || f.result === "none") continue;
                    Object.defineProperty(scope, f.js, { get: () => number(e[f.name](self.pointer)), configurable: true });
                }
                scope.dim = this.dimension_;
            }
            return scope;
        }
        get scope() {
            if (!this.scope_) Object.defineProperty(this, "scope_", { value: this.makeScope(), configurable: true });
            return this.scope_;
        }
        destroy() {
            if (!this.pointer) return;
            machine.exports[name + "_destroy"](this.pointer);
            machine.bodies.delete(this.pointer);
            this.pointer = 0;
            if (--this.kept.users === 0) for (const handle of this.kept.handles) machine.closures.delete(handle);
        }
    };
    if (Symbol.dispose) Made.prototype[Symbol.dispose] = Made.prototype.destroy;
    return Made;
}

function addMethod(machine, target, f, isMethod) {
    target[f.js] = function (...values) {
        const given = byName(f, values),
            bytes = f.bytes ? withBytes(f, given) : null;
        const result = invoke(machine, isMethod ? this : null, f, given);
        return bytes ? bytes() : result;
    };
}

function addViews(machine, Body) {
    Body.prototype.view_field = function (field) {
        const call = new Call(machine, this),
            s = api.structs.peri_view,
            at = call.allocate(s.size);
        try {
            const status = machine.exports.peri_view_field(this.pointer, field, at);
            if (status < 0) throw failure(call, status, 0);
            return new View(machine, call.structOut("peri_view", at), machine.get("ptr", at + s.fields.data.at));
        } finally {
            call.free();
        }
    };
}

// ---- the module --------------------------------------------------------------------------------------------------------------------

/** The library: source is the bytes, the address or a compiled module of a build; default peri.wasm beside this file. */
export async function load(source = new URL("./peri.wasm", import.meta.url)) {
    return instantiate(await compile(source));
}

async function compile(source) {
    if (source instanceof WebAssembly.Module) return source;
    if (ArrayBuffer.isView(source) || source instanceof ArrayBuffer) return WebAssembly.compile(source);
    const url = new URL(source, import.meta.url);
    if (url.protocol === "file:" && globalThis.process?.versions?.node) {
        const { readFile } = await import("node:fs/promises");
        return WebAssembly.compile(await readFile(url));
    }
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status}`);
    return WebAssembly.compile(await response.arrayBuffer());
}

/** The same of a compiled module, at once. */
export function instantiate(module) {
    let machine = null;
    const clock = (_id, _precision, at) => {
        machine.refresh().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
    };
    const { exports } = new WebAssembly.Instance(module, {
        env: { emscripten_notify_memory_growth: () => {} },
        wasi_snapshot_preview1: { clock_time_get: clock },
    });
    exports._initialize?.();
    machine = new Machine(exports);
    machine.classes = {
        peri_body: makeClass(machine, "peri_body"),
        peri_matrix: makeClass(machine, "peri_matrix"),
        peri_cracks: makeClass(machine, "peri_cracks"),
    };
    const peri = { ...api.constants, Body: machine.classes.peri_body, PeriError };
    for (const f of Object.values(api.functions)) {
        if (f.hidden) continue;
        const on = f.of ? machine.classes[f.of].prototype : peri;
        if (f.name in exports) addMethod(machine, on, f, Boolean(f.of));
        else
            on[f.js] = () => {
                throw new PeriError(api.codes.ERROR_LEFT_OUT, f.js);
            };
    }
    addViews(machine, machine.classes.peri_body);
    Object.defineProperty(peri, "memory", { get: () => exports.memory });
    return peri;
}
