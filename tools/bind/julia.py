# SPDX-License-Identifier: MIT
"""julia.py - bindings/julia/Peri.jl: one module."""
import re

from model import PASSING, RAW, short, wrap

TYPES = {"double": "Float64", "float": "Float32", "int32_t": "Int32", "int64_t": "Int64", "uint32_t": "UInt32", "uint64_t": "UInt64",
         "void": "Cvoid", "char": "UInt8"}
WORDS = {"in", "end", "function", "begin", "let", "for", "if", "do", "global", "local", "const", "struct", "module", "return", "type"}

HEAD = r'''# SPDX-License-Identifier: MIT
"""
peri for Julia: deformation and fracture of solids by nonlocal bonds. Made from peri.h by tools/bind.py: edit that.

The shared library is that of the environment variable PERI, else libperi. Names are those of peri.h: `peri_add_box(body, ...)` is
`Peri.add_box(body, ...)`, `PERI_SPACE_SOLID` is `Peri.SPACE_SOLID`, `peri_body_desc` with its init function is `Peri.body_desc()`. A function
that fills arrays has a `!` and takes them; without it returns new ones. `nothing` stands for NULL. Points count from 0. A call that fails
throws a `Peri.Error`; what a function of yours throws stops the call that it came from and comes out of it.
"""
module Peri

const LIB = get(ENV, "PERI", "libperi")
'''

INNER = r'''
# ---- errors

struct Error <: Exception
    status::Int32
    field::String
    index::Int64
    value::Float64
    text::String
end
Base.showerror(io::IO, e::Error) = print(io, "Peri.Error: ", e.text)

text(p) = p == C_NULL ? "" : unsafe_string(Ptr{UInt8}(p))

blank(status, field) = peri_error(Int32(status), Int32(0), Int64(-1), 0.0, pointer(field), ccall((:peri_status_text, LIB), Ptr{UInt8}, (Int32,), status))

function failed(record::peri_error)
    letters = zeros(UInt8, 300)
    ccall((:peri_format_error, LIB), Int64, (Ref{peri_error}, Ptr{UInt8}, Int64), Ref(record), letters, 300)
    said = GC.@preserve letters unsafe_string(pointer(letters))
    return Error(record.code, text(record.field), record.index, record.value, said)
end

refuse(field::String) = throw(GC.@preserve field failed(blank(-1, field)))

# What a function of yours has thrown, until the call that it came from has ended.
function guarded(f)
    try
        result = f()
        return result === true ? Int32(1) : result isa Integer ? Int32(result) : Int32(0)
    catch thrown
        task_local_storage(:peri_thrown, thrown)
        return Int32(-1)
    end
end

function check(result, record = nothing)
    thrown = get(task_local_storage(), :peri_thrown, nothing)
    if thrown !== nothing
        delete!(task_local_storage(), :peri_thrown)
        throw(thrown)
    end
    if result < 0
        none = ""
        GC.@preserve none throw(failed(record !== nothing && record.code == result ? record : blank(result, none)))
    end
    return result
end

# ---- arrays

array(kind::Type{T}, given::Vector{T}) where {T} = given
array(kind::Type{T}, given) where {T} = collect(T, given)
maybe(kind, given) = given === nothing ? C_NULL : array(kind, given)
entries(given) = given === nothing ? 0 : length(given)
sized(given, needs, field) = given === nothing || length(given) == needs || refuse(field)

# ---- descriptions: fields of C, and functions of yours in the place of callbacks

mutable struct Desc{T}
    raw::T
    calls::Dict{Symbol,Any}
    anchors::Dict{Symbol,Any}
    Desc(raw::T) where {T} = new{T}(raw, Dict{Symbol,Any}(), Dict{Symbol,Any}())
end

callbacks(::Type) = ()

function Base.getproperty(d::Desc{T}, name::Symbol) where {T}
    name in callbacks(T) && return get(getfield(d, :calls), name, nothing)
    return getfield(getfield(d, :raw), name)
end

function Base.setproperty!(d::Desc{T}, name::Symbol, value) where {T}
    raw = getfield(d, :raw)
    if name in callbacks(T)
        getfield(d, :calls)[name] = value
        return value
    end
    kind = fieldtype(T, name)
    if value isa Desc
        getfield(d, :anchors)[name] = value
        setfield!(raw, name, kind(pointer_from_objref(getfield(value, :raw))))
    elseif kind <: Ptr && value isa Array
        getfield(d, :anchors)[name] = value
        setfield!(raw, name, kind(pointer(value)))
    elseif kind <: Tuple
        setfield!(raw, name, convert(kind, Tuple(value)))
    else
        setfield!(raw, name, convert(kind, value))
    end
    return value
end

# What a function of C gets back as its user: closures, the body, its dimension.
mutable struct Context
    calls::Dict{Symbol,Any}
    owner::Any
    dim::Int64
end

version() = ccall((:peri_version, LIB), Int32, ())
status_text(status) = text(ccall((:peri_status_text, LIB), Ptr{UInt8}, (Int32,), status))
id_index(id) = id & 0xFFFFF

"""A field in place, nothing copied: component k of point i, from 0, is at 1 + i*point_stride + k*component_stride."""
function numbers(view)
    kind = view.type == TYPE_F64 ? Float64 : view.type == TYPE_F32 ? Float32 : Int32
    n = view.count == 0 ? 0 : (view.count - 1) * view.point_stride + (view.components - 1) * view.component_stride + 1
    return unsafe_wrap(Array, Ptr{kind}(view.data), n)
end
'''


def word(name):
    return name + "_" if name in WORDS else name


def doc(text):
    return ['"""', *wrap(text.replace("\\", "\\\\").replace('"', "'").replace("$", "\\$"), 130), '"""'] if text else []


class Julia:
    def __init__(self, model):
        self.m = model

    def c_type(self, p):
        if p["type"] in self.m.callbacks:
            return "Ptr{Cvoid}"
        base = TYPES.get(p["type"], p["type"] if p["type"] in self.m.structs else "Cvoid")
        if p.get("length"):
            return "NTuple{%d,%s}" % (p["length"], base)
        for _ in range(p["pointer"]):
            base = "Ptr{%s}" % base
        return base

    def struct(self, s):
        desc = self.m.is_desc(s["name"])
        out = ["", *doc(s["doc"]), "%sstruct %s" % ("mutable " if desc else "", s["name"])]
        for f in s["fields"]:
            out.append("    %s::%s%s" % (f["name"], self.c_type(f), " # " + f["doc"] if f["doc"] else ""))
        if desc:
            out.append("    %s() = new()" % s["name"])
        return out + ["end"]

    def desc(self, s):
        init = next((f for f in self.m.functions if f["name"] == s["name"] + "_init"), None)
        if not init:
            return []
        extra = [p for p in init["params"] if p["kind"] == "value"]
        out = [""]
        calls = self.m.calls(s["name"])
        if calls:
            out.append("callbacks(::Type{%s}) = (%s)" % (s["name"], "".join(":%s, " % f["name"] for f in calls)))
        out += ['"""%s with its defaults."""' % s["name"], "function %s(%s)" % (short(s["name"]), ", ".join(p["name"] for p in extra)), "    raw = %s()" % s["name"]]
        out += ["    ccall((:%s, LIB), Cvoid, (Ref{%s}, %s), raw%s)" % (init["name"], s["name"], ", ".join(TYPES[p["type"]] for p in extra), "".join(
            ", " + p["name"] for p in extra)) if extra else "    ccall((:%s, LIB), Cvoid, (Ref{%s},), raw)" % (init["name"], s["name"])]
        return out + ["    return Desc(raw)", "end"]

    # ---- callbacks -----------------------------------------------------------------------------------------------------

    def trampoline(self, kind, member):
        c = self.m.callbacks[kind]
        takes, gives = [], []
        counted = any(q.get("entries", "").startswith("count") or q["role"] == "bytes" for q in c["params"])
        for p in c["params"]:
            own = word(p["name"])
            user = p.get("kind") == "user"
            takes.append("%s::%s" % ("user" if user else own, self.c_type(p)))
            if user or p["name"] == "count" and counted:
                continue
            if p["role"] == "handle":
                gives.append("context.owner")
            elif p["role"] == "bytes":
                gives.append("unsafe_wrap(Array, Ptr{UInt8}(%s), count)" % own)
            elif p["role"] in ("array in", "array out"):
                size = re.sub(r"\bturns\b", "(2 * context.dim - 3)", re.sub(r"\bdim\b", "context.dim", p["entries"]))
                gives.append("unsafe_wrap(Array, %s, %s)" % (own, size))
            elif p["role"] == "text":
                gives.append("text(%s)" % own)
            else:
                gives.append(own)
        void = c["returns"] == "void"
        name = "%s_%s" % (short(kind), member)
        out = ["", "function %s(%s)" % (name, ", ".join(takes)), "    context = unsafe_pointer_to_objref(user)::Context",
               "    result = guarded(() -> context.calls[:%s](%s))" % (member, ", ".join(gives)), "    return %s" % ("nothing" if void else "result"), "end"]
        types = ", ".join(self.c_type(p) for p in c["params"])
        out += ["pointer_of_%s() = @cfunction(%s, %s, (%s,))" % (name, name, "Cvoid" if void else "Int32", types)]
        return out

    # ---- functions -----------------------------------------------------------------------------------------------------

    def size_word(self, f):
        values = {p["name"] for p in f["params"] if p["kind"] == "value"}
        body = f["class"] == "Body"
        h = f["params"][0]["name"]
        dim = "dimension(%s)" % h if body else "%s.dim" % h

        def of(w):
            if w in values:
                return word(w)
            own = short(f["params"][0]["type"]) if f["class"] else ""
            return {"dim": dim, "turns": "(2 * %s - 3)" % dim, "points": "point_count(%s)" % h, "width": "family_width(%s)" % h,
                    "rows": "%s_rows(%s)" % (own, h), "entries": "%s_entries(%s)" % (own, h), "paths": "%s_paths(%s)" % (own, h),
                    "vertices": None if body else "%s_vertices(%s)" % (own, h), "tips": "%s_tips(%s)" % (own, h),
                    "size_of_field": "size_of_field(%s, field)" % h, "size_of_set": "size_of_set(%s, set)" % h,
                    "fragments": "find_fragments!(%s)" % h}.get(w)
        return of

    def function(self, f):
        m, of = self.m, self.size_word(f)
        lengths = {}
        for p in f["params"]:
            if p["kind"] == "length":
                factor = "" if p["factor"] == "1" else " ÷ " + (of(p["factor"]) or p["factor"])
                lengths[p["name"]] = "entries(%s)%s" % (word(p["source"]), factor)
        checks = m.sizes(f, lambda w: lengths.get(w) or of(w))
        sizes = m.sizes(f, of)
        shown = m.visible(f)
        before, kinds, args, after, given, returned = [], [], [], [], [], []
        preserve = []
        for p in f["params"]:
            k, own = p["kind"], word(p["name"])
            if k == "self":
                given.append("%s::%s" % (own, f["class"]))
                kinds.append("Ptr{Cvoid}")
                args.append(own + ".handle")
                preserve.append(own)
            elif k == "new":
                before.append("made = Ref{Ptr{Cvoid}}(C_NULL)")
                kinds.append("Ptr{Ptr{Cvoid}}")
                args.append("made")
            elif k == "length":
                kinds.append("Int64")
                args.append(lengths[p["name"]])
            elif k == "error":
                before.append('record = Ref{peri_error}(blank(0, ""))')
                kinds.append("Ref{peri_error}")
                args.append("record")
            elif k == "user":
                kinds.append("Ptr{Cvoid}")
                args.append("context === nothing ? C_NULL : pointer_from_objref(context)")
            elif k in ("array in", "array out"):
                base = TYPES.get(p["type"], p["type"])
                given.append(own + (" = nothing" if p.get("optional") else ""))
                sources = [q for q in f["params"] if q["kind"] == "length" and q["source"] == p["name"]]
                size = checks.get(p["name"]) or ("1" if p["entries"] == "1" else None)
                if sources and sources[0]["factor"] != "1":
                    before.append('entries(%s) %% %s == 0 || refuse("%s")' % (own, of(sources[0]["factor"]) or sources[0]["factor"], p["name"]))
                elif size and not sources:
                    before.append('sized(%s, %s, "%s")' % (own, size, p["name"]))
                kinds.append("Ptr{%s}" % base)
                args.append("maybe(%s, %s)" % (base, own) if p["const"] else "%s === nothing ? C_NULL : %s" % (own, own) if p.get("optional") else own)
            elif k == "struct out":
                before.append("%s = Ref{%s}()" % (own, p["type"]))
                kinds.append("Ref{%s}" % p["type"])
                args.append(own)
                returned.append(own + "[]")
            elif k in ("struct in", "struct in out"):
                if m.is_desc(p["type"]):
                    given.append(own + ("" if p.get("optional") else "::Desc{%s}" % p["type"]))
                    raw = "getfield(%s, :raw)" % own
                    kinds.append("Ptr{%s}" % p["type"])
                    pointer = "Ptr{%s}(pointer_from_objref(%s))" % (p["type"], raw)
                    args.append("%s === nothing ? C_NULL : %s" % (own, pointer) if p.get("optional") else pointer)
                    preserve.append(own)
                    groups = {}
                    for g in m.calls(p["type"]):
                        groups.setdefault(g["user"], []).append(g)
                    for user, fields in groups.items():
                        context = "context_%s_%s" % (own, user)
                        before += ["%s = Context(copy(getfield(%s, :calls)), %s, %s)" % (context, own, given[0].split("::")[0] if self.has_handle(fields) else "nothing", self.dim_of(f)),
                                   "setfield!(%s, :%s, pointer_from_objref(%s))" % (raw, user, context)]
                        for g in fields:
                            before.append("setfield!(%s, :%s, %s.%s === nothing ? C_NULL : pointer_of_%s_%s())" % (raw, g["name"], own, g["name"], short(g["type"]), g["name"]))
                        preserve.append(context)
                        if not all(g["type"] in PASSING for g in fields):
                            before.append("push!(%s, %s)" % ("%s.keep" % given[0].split("::")[0] if f["class"] else "keep", context))
                else:
                    given.append(own + "::" + p["type"])
                    kinds.append("Ref{%s}" % p["type"])
                    args.append(own)
            elif k == "callback":
                given.append(own + ("" if p["type"] in PASSING else " = nothing"))
                before.append("context = %s === nothing ? nothing : Context(Dict{Symbol,Any}(:call => %s), nothing, %s)" % (own, own, self.dim_of(f)))
                if p["type"] not in PASSING:
                    before.append("context === nothing || push!(%s.keep, context)" % given[0].split("::")[0])
                preserve.append("context")
                kinds.append("Ptr{Cvoid}")
                args.append("context === nothing ? C_NULL : pointer_of_%s_call()" % short(p["type"]))
            elif k == "text":
                given.append(own)
                kinds.append("Cstring")
                args.append("%s === nothing ? Cstring(C_NULL) : %s" % (own, own) if p.get("optional") else own)
            else:
                given.append(own)
                kinds.append(TYPES[p["type"]])
                args.append(own)
        return self.emit(f, shown, given, before, kinds, args, after, returned, preserve, sizes)

    def has_handle(self, fields):
        return any(p["role"] == "handle" for g in fields for p in self.m.callbacks[g["type"]]["params"])

    def dim_of(self, f):
        if f["name"] == "peri_body_create":
            return "desc.space == SPACE_SOLID ? 3 : 2"
        return "dimension(%s)" % f["params"][0]["name"] if f["class"] == "Body" else "%s.dim" % f["params"][0]["name"]

    def emit(self, f, shown, given, before, kinds, args, after, returned, preserve, sizes):
        own_name = short(f["name"]) if f["class"] != "Body" else f["method"]
        arrays = [p for p in f["outs"] if p["kind"] == "array out"]
        name = own_name + ("!" if arrays else "")
        returns = {"const char *": "Ptr{UInt8}"}.get(f["returns"]) or TYPES[f["returns"]]
        types = "(%s)" % ", ".join(kinds + [""]).rstrip() if len(kinds) == 1 else "(%s)" % ", ".join(kinds)
        call = "ccall((:%s, LIB), %s, %s, %s)" % (f["name"], returns, types, ", ".join(args)) if kinds else "ccall((:%s, LIB), %s, ())" % (f["name"], returns)
        if preserve:
            call = "GC.@preserve %s %s" % (" ".join(preserve), call)
        out = ["", *doc(f["doc"]), "function %s(%s)" % (name, ", ".join(given))]
        if f["plain"]:
            return out + ["    result = " + call, "    return " + ("text(result)" if f["result"] == "text" else "result"), "end"]
        head = ["    keep = Any[]"] if f["makes"] and not f["class"] else []
        out += head + ["    " + b for b in before] + ["    result = " + call]
        if any(p["kind"] == "error" for p in f["params"]):
            out.append("    check(result, record[])")
        elif f["class"] == "Body":
            out.append("    check(result, result < 0 ? last_error(%s) : nothing)" % f["params"][0]["name"])
        else:
            out.append("    check(result)")
        if f["makes"]:
            kind = m_class = self.m.classes[f["makes"]["type"]]
            second = "%s.keep" % f["params"][0]["name"] if f["class"] else "keep"
            out.append("    return %s(made[], %s)" % (kind, second if m_class == "Body" else "dimension(%s)" % f["params"][0]["name"]))
        else:
            out.append("    return " + (", ".join(returned) if returned else "result"))
        out.append("end")
        if arrays and not any(p.get("optional") for p in arrays) and all(sizes.get(p["name"]) or p["entries"] in ("1", "count") for p in arrays):
            names = {word(p["name"]) for p in arrays}
            rest = [g for g in given if g.split(" ")[0].split("::")[0] not in names]
            out += ["", "function %s(%s)" % (own_name, ", ".join(rest))]
            for p in arrays:
                size = sizes.get(p["name"]) or ("1" if p["entries"] == "1" else None)
                size = size or next("length(%s)" % word(q["name"]) for q in shown if q["kind"] == "array in" and q["entries"] == "count")
                out.append("    %s = Vector{%s}(undef, %s)" % (word(p["name"]), TYPES.get(p["type"], p["type"]), size))
            out.append("    %s(%s)" % (name, ", ".join(g.split(" ")[0].split("::")[0] for g in given)))
            out += ["    return " + ", ".join(word(p["name"]) + ("[1]" if p["entries"] == "1" else "") for p in arrays), "end"]
        return out

    def text(self):
        m = self.m
        out = HEAD.rstrip("\n").split("\n") + [""]
        for c in m.api["constants"] + [v for e in m.api["enums"] for v in e["values"]]:
            value = '"%s"' % c["value"] if isinstance(c["value"], str) else "Int32(%d)" % c["value"]
            out.append("const %s = %s%s" % (short(c["name"]), value, " # " + c["doc"] if c["doc"] else ""))
        out += ["", "# ---- structs as C has them"]
        for s in m.api["structs"]:
            out += self.struct(s)
        out += INNER.rstrip("\n").split("\n")
        for s in m.api["structs"]:
            out += self.desc(s)
        for c, name in m.classes.items():
            second = "keep::Vector{Any}" if name == "Body" else "dim::Int64"
            out += ["", '"""Owns a %s."""' % c, "mutable struct %s" % name, "    handle::Ptr{Cvoid}", "    " + second,
                    "    function %s(handle::Ptr{Cvoid}, %s)" % (name, second.split("::")[0]), "        return finalizer(destroy, new(handle, %s))" % second.split("::")[0], "    end", "end",
                    "", '"""Frees it at once; else the collector does."""', "function destroy(one::%s)" % name,
                    "    one.handle == C_NULL || ccall((:%s_destroy, LIB), Cvoid, (Ptr{Cvoid},), one.handle)" % c, "    one.handle = C_NULL", "    return nothing", "end"]
        out += ["", "function last_error(body::Body)", "    record = Ref{peri_error}()",
                "    GC.@preserve body ccall((:peri_get_error, LIB), Int32, (Ptr{Cvoid}, Ref{peri_error}), body.handle, record)", "    return record[]", "end"]
        made = set()
        for s in m.api["structs"]:
            for g in m.calls(s["name"]):
                if (g["type"], g["name"]) not in made:
                    made.add((g["type"], g["name"]))
                    out += self.trampoline(g["type"], g["name"])
        for f in m.functions:
            for p in f["params"]:
                if p["kind"] == "callback" and p["type"] not in RAW and (p["type"], "call") not in made:
                    made.add((p["type"], "call"))
                    out += self.trampoline(p["type"], "call")
        for f in m.functions:
            if not f["inner"]:
                out += self.function(f)
        out += ["", "Body(desc::Desc{peri_body_desc}) = body_create(desc)", "", "end # module"]
        return "\n".join(out) + "\n"


def files(model):
    return {"bindings/julia/Peri.jl": Julia(model).text()}
