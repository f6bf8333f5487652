# SPDX-License-Identifier: MIT
"""lua.py - bindings/lua/peri.lua: LuaJIT, by its FFI."""
from model import PASSING, short, wrap

HEAD = r"""-- SPDX-License-Identifier: MIT
-- peri.lua - peri for LuaJIT. Made from peri.h by tools/bind.py: edit that.
--   local peri = require "peri"      the shared library is that of the environment variable PERI, else libperi.so
-- Names are those of peri.h: peri_add_box(body, ...) is body:add_box(...), PERI_SPACE_SOLID is peri.SPACE_SOLID. Arrays are tables of numbers
-- or arrays of the FFI (peri.doubles(n), peri.integers(n)), which are not copied; those that come back are of the FFI: from 0 on. A call
-- that fails raises an error: a table with status, field, index, value and text. What a function of yours raises stops the call that it came
-- from and comes out of it. A function gets what C has, less `user`; of a body, the body.
local ffi = require "ffi"
jit.off(true, true) -- what calls back must not be called from compiled traces

ffi.cdef [[
%s]]

local C = ffi.load(os.getenv("PERI") or "peri")
local peri = {
%s}

-- ---- errors

local Error = {}
Error.__index = Error
Error.__tostring = function(e) return e.text end

local pending -- what a function of yours has raised, until the call that it came from has ended

local function guard(f)
    return function(...)
        local good, result = pcall(f, ...)
        if good then return result == true and 1 or tonumber(result) or 0 end
        pending = pending or { result }
        return -1
    end
end

local function raise(record)
    local text = ffi.new("char[300]")
    C.peri_format_error(record, text, 300)
    error(setmetatable({ status = record[0].code, field = ffi.string(record[0].field), index = tonumber(record[0].index),
        value = record[0].value, text = ffi.string(text) }, Error), 0)
end

local function blank(status, field)
    local record = ffi.new("peri_error[1]")
    record[0].code, record[0].index, record[0].field, record[0].text = status, -1, field, C.peri_status_text(status)
    return record
end

local function refuse(field) raise(blank(-1, field)) end

local function check(result, record, body)
    if pending then
        local raised = pending
        pending = nil
        error(raised[1], 0)
    end
    result = tonumber(result)
    if result < 0 then
        if body then
            record = blank(0, "")
            C.peri_get_error(body, record)
        end
        if not record or record[0].code ~= result then record = blank(result, "") end
        raise(record)
    end
    return result
end

-- ---- arrays

local sizes = { double = 8, int32_t = 4, int64_t = 8, peri_fragment = ffi.sizeof("peri_fragment"), peri_crack_tip = ffi.sizeof("peri_crack_tip") }

function peri.doubles(n) return ffi.new("double[?]", n) end
function peri.integers(n) return ffi.new("int32_t[?]", n) end

-- an array of the FFI and its entries, of a table or as it is
local function array(kind, given, field)
    if type(given) == "table" then
        local made = ffi.new(kind .. "[?]", math.max(#given, 1))
        for k = 1, #given do made[k - 1] = given[k] end
        return made, #given
    end
    if type(given) ~= "cdata" then refuse(field) end
    return given, ffi.sizeof(given) / (sizes[kind] or ffi.sizeof(kind))
end

local function sized(has, needs, field)
    if has ~= needs then refuse(field) end
end

local function text(given) return given ~= nil and ffi.string(given) or "" end

-- ---- descriptions: fields of C, and functions of yours in the place of callbacks

local function wrap(kind, raw, calls)
    local functions, anchors = {}, {}
    return setmetatable({}, {
        kind = kind,
        raw = raw,
        functions = functions,
        __index = function(_, name)
            if calls[name] then return functions[name] end
            return raw[0][name]
        end,
        __newindex = function(_, name, value)
            if calls[name] then
                functions[name] = value
            elseif type(value) == "table" and getmetatable(value) and getmetatable(value).raw then
                anchors[name], raw[0][name] = value, getmetatable(value).raw
            elseif type(value) == "table" then
                local to = raw[0][name]
                if tostring(ffi.typeof(to)):find("[", 1, true) then
                    for k = 1, #value do to[k - 1] = value[k] end
                else
                    local kind_of = tostring(ffi.typeof(to)):find("int", 1, true) and "int32_t" or "double"
                    anchors[name] = array(kind_of, value, name)
                    raw[0][name] = anchors[name]
                end
            else
                anchors[name], raw[0][name] = value, value
            end
        end,
    })
end

local function plain(desc, kind)
    local meta = getmetatable(desc)
    if type(desc) ~= "table" or not meta or meta.kind ~= kind then refuse("desc") end
    return meta.raw, meta.functions
end

-- functions that a body and its clones keep
local function keeper()
    local all = {}
    all.sentinel = ffi.gc(ffi.new("char[1]"), function()
        for k = 1, #all do all[k]:free() end
    end)
    return all
end

local function free(all)
    for k = 1, #all do all[k]:free() end
end
"""


def comment(doc):
    return ["-- " + x for x in wrap(doc, 130)] if doc else []


WORDS = {"end", "in", "function", "local", "repeat", "until", "then"}


def word(name):
    return name + "_" if name in WORDS else name


class Lua:
    def __init__(self, model):
        self.m = model

    # ---- C declarations ------------------------------------------------------------------------------------------------

    @staticmethod
    def c(p, inside=True):
        star = "*" * p["pointer"]
        tail = "[%d]" % p["length"] if p.get("length") else ""
        return "%s%s %s%s%s" % ("const " if p["const"] else "", p["type"], star, p["name"] if inside or tail else "", tail)

    def cdef(self):
        m, out = self.m, []
        for o in m.api["opaque"] + m.api["structs"]:
            out.append("typedef struct %s %s;" % (o["name"], o["name"]))
        for c in m.api["callbacks"]:
            out.append("typedef %s (*%s)(%s);" % (c["returns"], c["name"], ", ".join(self.c(p) for p in c["params"])))
        for s in m.api["structs"]:
            out.append("struct %s {" % s["name"])
            out += ["    %s;" % self.c(f) for f in s["fields"]] + ["};"]
        for f in m.functions:
            out.append("%s %s(%s);" % (f["returns"], f["name"], ", ".join(self.c(p) for p in f["params"]) or "void"))
        return "\n".join(out) + "\n"

    # ---- functions -----------------------------------------------------------------------------------------------------

    def size_word(self, f):
        values = {p["name"] for p in f["params"] if p["kind"] == "value"}
        body = f["class"] == "Body"

        def of(w):
            if w in values:
                return w
            return {"dim": "self:dimension()" if body else "self.dim", "turns": "(2 * %s - 3)" % ("self:dimension()" if body else "self.dim"),
                    "points": "self:point_count()", "width": "self:family_width()", "rows": "self:rows()", "entries": "self:entries()",
                    "paths": "self:paths()", "vertices": None if body else "self:vertices()", "tips": "self:tips()",
                    "size_of_field": "self:size_of_field(field)", "size_of_set": "self:size_of_set(set)",
                    "fragments": "self:find_fragments()"}.get(w)
        return of

    def trampoline(self, kind, name):
        """A closure of C's arguments that calls `name`."""
        c = self.m.callbacks[kind]
        takes, gives = [], []
        counted = any(p["role"] == "bytes" and p["const"] for p in c["params"])
        for p in c["params"]:
            own = word(p["name"])
            if p.get("kind") == "user":
                takes.append("_")
                continue
            takes.append(own if p["role"] != "handle" else "_")
            if p["role"] == "handle":
                gives.append("self")
            elif p["role"] == "bytes" and p["const"]:
                gives.append("ffi.string(%s, count)" % own)
            elif p["name"] == "count" and counted:
                continue
            elif p["type"] in ("int64_t", "uint64_t") and not p["pointer"]:
                gives.append("tonumber(%s)" % own)
            elif p["role"] == "text":
                gives.append("text(%s)" % own)
            else:
                gives.append(own)
        function = "guard(function(%s) return %s(%s) end)" % (", ".join(takes), name, ", ".join(gives))
        if c["returns"] == "void":
            function = "function(...) %s(...) end" % function
        return 'ffi.cast("%s", %s)' % (kind, function)

    def method(self, f):
        m = self.m
        of = self.size_word(f)
        lengths = {}
        for p in f["params"]:
            if p["kind"] == "length":
                factor = "" if p["factor"] == "1" else " / " + (of(p["factor"]) or p["factor"])
                lengths[p["name"]] = "%s_n%s" % (p["source"], factor)
        checks = m.sizes(f, lambda w: lengths.get(w) or of(w))
        sizes = m.sizes(f, of)
        shown = m.visible(f)
        if f["plain"]:
            call = "C.%s(%s)" % (f["name"], ", ".join("self.handle" if p["kind"] == "self" else word(p["name"]) for p in f["params"]))
            call = "text(%s)" % call if f["result"] == "text" else "tonumber(%s)" % call
            return self.head(f, shown) + ["    return " + call, "end"]
        body, args, after, returned, frees = [], [], [], [], []
        for p in f["params"]:
            k, own = p["kind"], word(p["name"])
            if k == "self":
                args.append("self.handle")
            elif k == "new":
                body.append('local made = ffi.new("%s *[1]")' % p["type"])
                args.append("made")
            elif k == "length":
                args.append(lengths[p["name"]])
            elif k == "error":
                body.append('local record = blank(0, "")')
                args.append("record")
            elif k == "user":
                args.append("nil")
            elif k in ("array in", "array out"):
                body.append("local %s_c, %s_n = nil, 0" % (p["name"], p["name"]))
                if k == "array out" and not p.get("optional"):
                    size = sizes.get(p["name"]) or ("1" if p["entries"] == "1" else None)
                    if p["entries"] == "count" and not size:
                        size = next(q["name"] + "_n" for q in shown if q["kind"] == "array in" and q["entries"] == "count")
                    if size:
                        body.append('%s = %s or ffi.new("%s[?]", %s)' % (own, own, p["type"], size))
                    returned.append((own, p["entries"] == "1"))
                body.append('if %s ~= nil then %s_c, %s_n = array("%s", %s, "%s") end' % (own, p["name"], p["name"], p["type"], own, p["name"]))
                sources = [q for q in f["params"] if q["kind"] == "length" and q["source"] == p["name"]]
                size = checks.get(p["name"])
                if sources and sources[0]["factor"] != "1":
                    body.append('if %s_n %% (%s) ~= 0 then refuse("%s") end' % (p["name"], of(sources[0]["factor"]) or sources[0]["factor"], p["name"]))
                elif not sources and (size or p["entries"] == "1"):
                    optional = "if %s ~= nil then " % own if p.get("optional") else ""
                    body.append('%ssized(%s_n, %s, "%s")%s' % (optional, p["name"], size or "1", p["name"], " end" if optional else ""))
                args.append(p["name"] + "_c")
            elif k == "struct out":
                body.append('local %s = ffi.new("%s")' % (own, p["type"]))
                args.append(own)
                returned.append((own, False))
            elif k in ("struct in", "struct in out"):
                if m.is_desc(p["type"]):
                    body.append("local %s_c%s" % (p["name"], ", %s_f" % p["name"] if m.calls(p["type"]) else ""))
                    get = '%s_c%s = plain(%s, "%s")' % (p["name"], ", %s_f" % p["name"] if m.calls(p["type"]) else "", own, p["type"])
                    body.append("if %s ~= nil then %s end" % (own, get) if p.get("optional") else get)
                    args.append(p["name"] + "_c")
                    for g in m.calls(p["type"]):
                        keep = "here" if g["type"] in PASSING else "keep"
                        body += ["if %s_f.%s then" % (p["name"], g["name"]), "    local call = %s_f.%s" % (p["name"], g["name"]),
                                 "    %s[#%s + 1] = %s" % (keep, keep, self.trampoline(g["type"], "call")),
                                 "    %s_c[0].%s = %s[#%s]" % (p["name"], g["name"], keep, keep), "end"]
                        after.append("%s_c[0].%s = nil" % (p["name"], g["name"]))
                        frees.append(keep)
                else:
                    args.append(own)
            elif k == "callback":
                keep = "here" if p["type"] in PASSING else "keep"
                body += ["local %s_c = nil" % p["name"], "if %s then" % own,
                         "    %s[#%s + 1] = %s" % (keep, keep, self.trampoline(p["type"], own)),
                         "    %s_c = %s[#%s]" % (p["name"], keep, keep), "end"]
                args.append(p["name"] + "_c")
                frees.append(keep)
            else:
                args.append(own)
        head = []
        if "here" in frees:
            head.append("local here = {}")
            after.append("free(here)")
        if "keep" in frees or f["makes"]:
            head.append("local keep = self.keep" if f["class"] else "local keep = keeper()")
        body = head + body
        body.append("local result = C.%s(%s)" % (f["name"], ", ".join(args)))
        body += after
        if any(p["kind"] == "error" for p in f["params"]):
            check = "check(result, record)"
        elif f["class"] == "Body":
            check = "check(result, nil, self.handle)"
        else:
            check = "check(result)"
        if f["makes"]:
            name = m.classes[f["makes"]["type"]]
            body += [check, "return own_%s(made[0], %s)" % (name.lower(), "keep" if name == "Body" else "self:dimension()")]
        elif returned:
            body += [check, "return " + ", ".join("tonumber(%s[0])" % r if one and self.is_number(f, r) else r + "[0]" if one else r for r, one in returned)]
        else:
            body.append("return " + check)
        return self.head(f, shown) + ["    " + b for b in body] + ["end"]

    @staticmethod
    def is_number(f, name):
        return any(p["kind"] == "array out" and word(p["name"]) == name for p in f["params"])

    def head(self, f, shown):
        names = ", ".join(word(p["name"]) for p in shown if p["kind"] != "struct out")
        where = "%s:%s" % (f["class"], f["method"]) if f["class"] else "peri." + f["method"]
        return [""] + comment(f["doc"]) + ["function %s(%s)" % (where, names)]

    def text(self):
        m = self.m
        constants = []
        for c in m.api["constants"] + [v for e in m.api["enums"] for v in e["values"]]:
            value = '"%s"' % c["value"] if isinstance(c["value"], str) else str(c["value"])
            constants.append("    %s = %s,%s" % (short(c["name"]), value, " -- " + c["doc"] if c["doc"] else ""))
        out = (HEAD % (self.cdef(), "\n".join(constants) + "\n")).rstrip("\n").split("\n")
        for s in m.api["structs"]:
            init = next((f for f in m.functions if f["name"] == s["name"] + "_init"), None)
            if not init:
                continue
            calls = ", ".join("%s = true" % f["name"] for f in m.calls(s["name"]))
            extra = [p["name"] for p in init["params"] if p["kind"] == "value"]
            out += [""] + comment("%s, filled with the defaults: %s. %s" % (s["name"], ", ".join(
                f["name"] for f in s["fields"] if f["kind"] not in ("cookie", "reserved", "user")), s["doc"]))
            out += ["function peri.%s(%s)" % (short(s["name"]), ", ".join(extra)), '    local raw = ffi.new("%s[1]")' % s["name"],
                    "    C.%s(%s)" % (init["name"], ", ".join(["raw"] + extra)),
                    '    return wrap("%s", raw, {%s})' % (s["name"], " %s " % calls if calls else ""), "end"]
        out += ["", "function peri.version() return C.peri_version() end", "function peri.status_text(status) return text(C.peri_status_text(status)) end",
                "function peri.struct(kind) return ffi.new(\"peri_\" .. kind) end -- all zero: peri.struct \"obstacle_state\"",
                "", "-- A field in place: component k of point i, in your units.", "function peri.at(view, i, k)",
                '    local kinds = { [1601] = "const double *", [1602] = "const float *", [1603] = "const int32_t *" }',
                "    local data = ffi.cast(kinds[view.type], view.data)",
                "    return view.offset[k < 3 and k or 0] + view.scale * data[i * tonumber(view.point_stride) + k * tonumber(view.component_stride)]", "end"]
        for c, name in m.classes.items():
            out += ["", "local %s = {}" % name, "%s.__index = %s" % (name, name), "peri.%s = %s" % (name, name),
                    "local function own_%s(handle, second)" % name.lower(),
                    "    return setmetatable({ handle = ffi.gc(handle, C.%s_destroy), %s = second }, %s)" % (c, "keep" if name == "Body" else "dim", name), "end",
                    "-- Frees it at once; else the collector does.", "function %s:destroy()" % name, "    if self.handle ~= nil then",
                    "        C.%s_destroy(ffi.gc(self.handle, nil))" % c, "        self.handle = nil", "    end", "end"]
        for f in m.functions:
            if not f["inner"]:
                out += self.method(f)
        out += ["", "function peri.body(desc) return peri.body_create(desc) end", "", "return peri"]
        return "\n".join(out) + "\n"


def files(model):
    return {"bindings/lua/peri.lua": Lua(model).text()}
