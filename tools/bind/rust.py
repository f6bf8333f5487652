# SPDX-License-Identifier: MIT
"""rust.py - bindings/rust: peri-sys, the functions and structs of peri.h as they are, and peri, which is safe."""
import os
import re

from model import PASSING, RAW, camel, short, wrap

TYPES = {"double": "f64", "float": "f32", "int32_t": "i32", "int64_t": "i64", "uint32_t": "u32", "uint64_t": "u64", "char": "c_char",
         "void": "c_void"}
WORDS = {"in", "type", "fn", "move", "ref", "box", "loop", "use", "match", "where", "as", "dyn"}
EMPTY = {"f64": "0.0", "i32": "0", "i64": "0", "u64": "0", "f32": "0.0"}

SYS = r"""// SPDX-License-Identifier: MIT
//! peri.h as it is: constants, structs and functions of C. Made from peri.h by tools/bind.py: edit that.
#![no_std]
#![allow(non_camel_case_types, non_upper_case_globals)]
use core::ffi::{c_char, c_void};
"""

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "safe.rs"), encoding="utf-8") as opened:
    SAFE = opened.read()  # the head of the safe crate


def doc(text, indent=""):
    """Brackets and stars of formulas are no markup."""
    text = re.sub(r"([\[\]<>*_`|\\])", r"\\\1", text)
    return [indent + "/// " + line for line in wrap(text, 130 - len(indent))]


def word(name):
    return "r#" + name if name in WORDS else name


class Rust:
    def __init__(self, model):
        self.m = model
        self.wrapped = {s["name"] for s in model.api["structs"] if self.needs_wrapper(s)}
        self.unsafe_structs = {s["name"] for s in model.api["structs"] if any(f["kind"] == "data" for f in s["fields"])}
        self.wrapped -= self.unsafe_structs | {"peri_error"}

    def needs_wrapper(self, s):
        return any(f["kind"] in ("cookie", "text") for f in s["fields"])

    # ---- peri-sys ------------------------------------------------------------------------------------------------------

    def c_type(self, p, inside=False):
        base = TYPES.get(p["type"], p["type"])
        if p["type"] in self.m.callbacks:
            return base
        if p.get("length") and not p["pointer"]:
            return "[%s; %d]" % (base, p["length"]) if inside else "*%s %s" % ("const" if p["const"] else "mut", base)
        for k in range(p["pointer"]):
            base = "*%s %s" % ("const" if p["const"] and k == 0 else "mut", base)
        return base

    def sys(self):
        out = SYS.rstrip("\n").split("\n") + [""]
        for c in self.m.api["constants"]:
            if isinstance(c["value"], int):
                out += doc(c["doc"]) + ["pub const %s: i32 = %d;" % (c["name"], c["value"])]
        for e in self.m.api["enums"]:
            out += ["", "// %s" % e["name"]]
            for v in e["values"]:
                out += doc(v["doc"]) + ["pub const %s: i32 = %d;" % (v["name"], v["value"])]
        out.append("")
        for o in self.m.api["opaque"]:
            out += doc("" if o["doc"] == "opaque" else o["doc"]) + ["#[repr(C)]", "pub struct %s {" % o["name"], "    _private: [u8; 0],", "}", ""]
        for c in self.m.api["callbacks"]:
            out += doc(c["doc"])
            returns = {"void": "", "void *": " -> *mut c_void"}.get(c["returns"], " -> " + TYPES.get(c["returns"], c["returns"]))
            out += ["pub type %s = Option<unsafe extern \"C\" fn(%s)%s>;" % (c["name"], ", ".join(
                "%s: %s" % (word(p["name"] or "p%d" % k), self.c_type(p)) for k, p in enumerate(c["params"])), returns)]
        for s in self.m.api["structs"]:
            out += [""] + doc(s["doc"]) + ["#[repr(C)]", "#[derive(Debug, Clone, Copy)]", "pub struct %s {" % s["name"]]
            for f in s["fields"]:
                out += doc(f["doc"], "    ") + ["    pub %s: %s," % (word(f["name"]), self.c_type(f, True))]
            out.append("}")
        out += ["", 'unsafe extern "C" {']
        for f in self.m.functions:
            out += doc(f["doc"], "    ")
            returns = {"void": "", "const char *": " -> *const c_char"}.get(f["returns"], " -> " + TYPES.get(f["returns"], f["returns"]))
            out += ["    pub fn %s(%s)%s;" % (f["name"], ", ".join("%s: %s" % (word(p["name"]), self.c_type(p)) for p in f["params"]), returns)]
        return "\n".join(out + ["}", ""])

    # ---- closures ------------------------------------------------------------------------------------------------------

    def shown_params(self, c):
        """The arguments of a closure; counts are in the slices."""
        counted = any(q.get("entries", "").startswith("count") or q["role"] == "bytes" for q in c["params"])
        return [p for p in c["params"] if p.get("kind") != "user" and not (p["name"] == "count" and counted)]

    def closure_arg(self, p):
        mut = "" if p["const"] else "mut "
        if p["role"] == "handle":
            return "&" + self.m.classes[p["type"]]
        if p["role"] == "bytes":
            return "&%s[u8]" % mut
        if p["role"] in ("array in", "array out"):
            one = p.get("entries") == "1" and not p["const"]
            return "&%s%s" % (mut, TYPES[p["type"]] if one else "[%s]" % TYPES[p["type"]])
        if p["role"].startswith("struct"):
            return "&%ssys::%s" % (mut, p["type"])
        return "&str" if p["role"] == "text" else self.c_type(p)

    def signature(self, name):
        c = self.m.callbacks[name]
        returns = "" if c["returns"] == "void" else " -> i32"
        return "(%s)%s" % (", ".join(self.closure_arg(p) for p in self.shown_params(c)), returns)

    def trampoline(self, name, holder, member, passing):
        c = self.m.callbacks[name]
        names = {"user": "user"}
        for p in c["params"]:
            names[p["name"]] = "user" if p.get("kind") == "user" else "_" + p["name"] if p["role"] == "handle" else word(p["name"])
        params = ", ".join("%s: %s" % (names[p["name"]], self.sys_type(p)) for p in c["params"])
        args = []
        for p in self.shown_params(c):
            own = word(p["name"])
            if p["role"] == "handle":
                args.append("&*this.owner")
            elif p["role"] == "bytes":
                args.append("slice%s(%s as *%s u8, count)" % ("" if p["const"] else "_mut", own, "const" if p["const"] else "mut"))
            elif p["role"] in ("array in", "array out"):
                if p.get("entries") == "1" and not p["const"]:
                    args.append("&mut *" + own)
                else:
                    size = re.sub(r"\bturns\b", "(2 * this.dim - 3)", re.sub(r"\bdim\b", "this.dim", p["entries"]))
                    args.append("slice%s(%s, %s)" % ("" if p["const"] else "_mut", own, size))
            elif p["role"].startswith("struct"):
                args.append("&%s*%s" % ("" if p["const"] else "mut ", own))
            else:
                args.append("constant(%s)" % own if p["role"] == "text" else own)
        void = c["returns"] == "void"
        option = "if let Some(f) = this.%s.as_%s() { f(%s)" % (member, "mut" if passing else "ref", ", ".join(args))
        call = option + ("; 0 } else { 0 }" if void else " } else { -1 }")
        cast = "&mut *(user as *mut %s)" if passing else "&*(user as *const %s)"
        tail = " -> i32" if not void else ""
        body = "guarded(|| unsafe { %s })%s" % (call, "" if not void else ";")
        return ["    unsafe extern \"C\" fn %s_c(%s)%s {" % (member, params, tail), "        let this = unsafe { %s };" % (cast % holder),
                "        " + body, "    }"]

    def sys_type(self, p):
        text = self.c_type(p)
        return re.sub(r"\bperi_\w+", lambda m: "sys::" + m.group(), text)

    def holder(self, name, fields, title, user):
        """A struct of closures that share a user pointer, with their functions of C."""
        passing = all(f["type"] in PASSING for f in fields)
        life = "<'a>" if passing else ""
        handle = any(p["role"] == "handle" for f in fields for p in self.m.callbacks[f["type"]]["params"])
        out = ["", "struct %s%s {" % (name, life)] + (["    owner: *const Body,"] if handle else [])
        if any("dim" in q.get("entries", "") or "turns" in q.get("entries", "") for f in fields for q in self.m.callbacks[f["type"]]["params"]):
            out.append("    dim: i64,")
        for f in fields:
            kind = "Option<&'a mut dyn FnMut%s>" if passing else "Option<Box<dyn Fn%s + Send + Sync>>"
            out.append("    %s: %s," % (word(f["name"]), kind % self.signature(f["type"])))
        out += ["}", "", "impl %s%s {" % (name, "<'_>" if passing else "")]
        for f in fields:
            out += self.trampoline(f["type"], name, word(f["name"]), passing)
        if title:
            out += ["    fn fill(&self, raw: &mut sys::%s, user: *mut c_void) {" % title, "        raw.%s = user;" % user]
            for f in fields:
                out += ["        if self.%s.is_some() {" % word(f["name"]), "            raw.%s = Some(Self::%s_c);" % (word(f["name"]), word(f["name"])), "        }"]
            out.append("    }")
        return out + ["}"]

    def needs_dim(self, fields):
        return any("dim" in q.get("entries", "") or "turns" in q.get("entries", "") for f in fields for q in self.m.callbacks[f["type"]]["params"])

    def needs_owner(self, fields):
        return any(p["role"] == "handle" for f in fields for p in self.m.callbacks[f["type"]]["params"])

    def contexts(self, s):
        out = {}
        for f in s["fields"]:
            if f["kind"] == "callback":
                out.setdefault(f["user"], []).append(f)
        return out

    # ---- structs -------------------------------------------------------------------------------------------------------

    def life(self, s):
        return "<'a>" if any(f["kind"] in ("array", "struct pointer") or f["kind"] == "callback" and f["type"] in PASSING
                             for f in s["fields"]) else ""

    def field(self, f):
        base = TYPES.get(f["type"], "sys::" + f["type"])
        if f["kind"] == "callback":
            if f["type"] in PASSING:
                return "Option<&'a mut dyn FnMut%s>" % self.signature(f["type"]), "None"
            return "Option<Box<dyn Fn%s + Send + Sync>>" % self.signature(f["type"]), "None"
        if f["kind"] == "array":
            return "&'a %s[%s]" % ("" if f["const"] else "mut ", base), "&[]" if f["const"] else "&mut []"
        if f["kind"] == "struct pointer":
            other = self.m.structs[f["type"]]
            return "Option<&'a %s%s>" % (camel(f["type"]), "<'a>" if self.life(other) else ""), "None"
        if f["kind"] == "text":
            return "&'static str", "constant(raw.%s)" % word(f["name"])
        if f["length"]:
            return "[%s; %d]" % (base, f["length"]), "raw." + word(f["name"])
        return base, "raw." + word(f["name"])

    def struct(self, s):
        name = s["name"]
        own = camel(name)
        if name in self.unsafe_structs or name == "peri_error":
            return []
        if name not in self.wrapped:
            return doc(s["doc"]) + ["pub type %s = sys::%s;" % (own, name)] if name != "peri_view" else []
        life = self.life(s)
        fields = [f for f in s["fields"] if f["kind"] not in ("cookie", "reserved", "user", "length", "hook")]
        out = [""] + doc(s["doc"]) + ["pub struct %s%s {" % (own, life)]
        for f in fields:
            said = f["doc"]
            if f["kind"] == "callback":
                said += " (" + ", ".join(p["name"] for p in self.shown_params(self.m.callbacks[f["type"]])) + ")"
            out += doc(said, "    ") + ["    pub %s: %s," % (word(f["name"]), self.field(f)[0])]
        out += ["}", "", "impl%s %s%s {" % (life, own, life)]
        init = next((f for f in self.m.functions if f["name"] == name + "_init"), None)
        if init:
            extra = [p for p in init["params"] if p["kind"] == "value"]
            out += ["    /// The defaults.", "    pub fn new(%s) -> Self {" % ", ".join("%s: %s" % (word(p["name"]), TYPES[p["type"]]) for p in extra),
                    "        let raw = Self::start(%s);" % ", ".join(word(p["name"]) for p in extra), "        Self {"]
            out += ["            %s: %s," % (word(f["name"]), self.field(f)[1]) for f in fields] + ["        }", "    }"]
            out += ["    fn start(%s) -> sys::%s {" % (", ".join("%s: %s" % (word(p["name"]), TYPES[p["type"]]) for p in extra), name),
                    "        let mut raw = std::mem::MaybeUninit::<sys::%s>::zeroed();" % name, "        unsafe {",
                    "            sys::%s_init(raw.as_mut_ptr()%s);" % (name, "".join(", " + word(p["name"]) for p in extra)),
                    "            raw.assume_init()", "        }", "    }"]
            out += self.raw(s, fields, extra)
        else:
            out += ["    fn of(raw: &sys::%s) -> Self {" % name, "        Self {"]
            out += ["            %s: %s," % (word(f["name"]), self.field(f)[1]) for f in fields] + ["        }", "    }"]
        out.append("}")
        if init and not extra:
            out += ["", "impl%s Default for %s%s {" % (life, own, life), "    fn default() -> Self {", "        Self::new()", "    }", "}"]
        for user, called in self.contexts(s).items():
            out += self.holder(own + camel("peri_" + user), called, name, user)
        return out

    def raw(self, s, fields, extra):
        """What C takes, without the closures and the structs that it points to."""
        arrays = [f for f in fields if f["kind"] == "array"]
        out = ["    #[allow(unused_mut)]", "    fn raw(&%sself%s) -> sys::%s {" % ("mut " if any(not f["const"] for f in arrays) else "", ", dim: i64" if arrays else "", s["name"]),
               "        let mut raw = Self::start(%s);" % ", ".join("self." + word(p["name"]) for p in extra)]
        for f in fields:
            own = word(f["name"])
            if f["kind"] == "value":
                out.append("        raw.%s = self.%s;" % (own, own))
            elif f["kind"] == "array":
                out.append("        raw.%s = self.%s.as_%sptr();" % (own, own, "" if f["const"] else "mut_"))
                if f.get("counted"):
                    factor = f["entries"][len(f["counted"]) + 1:] or "1"
                    out.append("        raw.%s = self.%s.len() as i64 / %s;" % (word(f["counted"]), own, factor if " " not in factor else factor))
        out += ["        raw", "    }"]
        if arrays and not any(re.search(r"\bdim\b", line) for line in out[2:]):
            out[1] = out[1].replace(", dim: i64", ", _dim: i64")
        if any(f["kind"] == "value" for f in fields) and s["name"] in self.changed():
            out += ["    fn take(&mut self, raw: &sys::%s) {" % s["name"]]
            out += ["        self.%s = raw.%s;" % (word(f["name"]), word(f["name"])) for f in fields if f["kind"] == "value"] + ["    }"]
        return out

    def changed(self):
        return {p["type"] for f in self.m.functions if not f["inner"] for p in f["params"] if p["kind"] == "struct in out"}

    # ---- methods -------------------------------------------------------------------------------------------------------

    def size_word(self, f):
        values = {p["name"] for p in f["params"] if p["kind"] == "value"}
        body = f["class"] == "Body"
        dim = "i64::from(self.dimension())" if body else "self.dim"

        def of(w):
            if w in values:
                return "i64::from(%s)" % word(w)
            return {"dim": dim, "turns": "(2 * %s - 3)" % dim, "points": "self.point_count()", "width": "i64::from(self.family_width())",
                    "rows": "self.rows()", "entries": "self.entries()", "paths": "self.paths()",
                    "vertices": None if body else "self.vertices()", "tips": "self.tips()",
                    "size_of_field": "self.size_of_field(field)?", "size_of_set": "self.size_of_set(set)?",
                    "fragments": "self.find_fragments(None)?"}.get(w)
        return of

    def dim_of(self, f):
        if f["name"] == "peri_body_create":
            return "if desc.space == SPACE_SOLID { 3 } else { 2 }"
        return "i64::from(self.dimension())" if f["class"] == "Body" else "self.dim" if f["class"] else "2"

    def arg(self, p):
        if p["kind"] == "text":
            return "&str"
        if p["kind"] in ("array in", "array out"):
            base = TYPES.get(p["type"], "sys::" + p["type"])
            one = p["kind"] == "array out" and p["entries"] == "1"
            text = "&%s%s" % ("" if p["const"] else "mut ", base if one else "[%s]" % base)
            return "Option<%s>" % text if p.get("optional") else text
        if p["kind"] == "callback":
            if p["type"] in PASSING:
                return "&mut dyn FnMut" + self.signature(p["type"])
            return "Option<Box<dyn Fn%s + Send + Sync>>" % self.signature(p["type"])
        if p["kind"] in ("struct in", "struct in out"):
            s = self.m.structs[p["type"]]
            if p["type"] in self.wrapped:
                by = p["kind"] == "struct in" and (self.m.calls(p["type"]) or any(f["kind"] == "array" and not f["const"] for f in s["fields"]))
                text = ("" if by else "&" if p["kind"] == "struct in" else "&mut ") + camel(p["type"])
            else:
                text = "&%ssys::%s" % ("" if p["const"] else "mut ", p["type"])
            return "Option<%s>" % text if p.get("optional") and p["kind"] == "struct in" else text
        return TYPES[p["type"]]

    def method(self, f):
        m, body = self.m, []
        shown = m.visible(f)
        of = self.size_word(f)
        lengths, params, args, after = {}, [], [], []
        for p in f["params"]:
            if p["kind"] == "length":
                factor = "" if p["factor"] == "1" else " / (%s)" % re.sub(r"[a-z]\w*", lambda x: of(x.group()) or x.group(), p["factor"])
                source = next(q for q in f["params"] if q["name"] == p["source"])
                has = "%s.as_deref().map_or(0, |a| a.len())" % word(p["source"]) if source.get("optional") else "%s.len()" % word(p["source"])
                lengths[p["name"]] = "(%s as i64%s)" % (has, factor)
                if source.get("optional"):
                    body.append("let %s = %s;" % (p["name"], lengths[p["name"]]))
                    lengths[p["name"]] = p["name"]
        checks = m.sizes(f, lambda w: lengths.get(w) or of(w))
        unsafe = False
        returned, record = [], "record"
        for p in f["params"]:
            k, own = p["kind"], word(p["name"])
            if k == "self":
                args.append("self.handle")
            elif k == "new":
                body.append("let mut made = std::ptr::null_mut();")
                args.append("&mut made")
            elif k == "length":
                args.append(lengths[p["name"]])
            elif k == "error":
                body.append("let mut record = blank();")
                args.append("&mut record")
            elif k == "user":
                continue
            elif k in ("array in", "array out"):
                if k == "array out" and p["entries"] == "1" and not p.get("optional"):
                    body.append("let mut %s = %s;" % (own, EMPTY[TYPES[p["type"]]]))
                    args.append("&mut " + own)
                    returned.append((own, TYPES[p["type"]]))
                    continue
                params.append("%s: %s" % (own, self.arg(p)))
                if k == "array out" and p["entries"] == "1":
                    args.append("%s.map_or(std::ptr::null_mut(), |a| a as *mut _)" % own)
                    continue
                sources = [q for q in f["params"] if q["kind"] == "length" and q["source"] == p["name"]]
                size = checks.get(p["name"])
                if sources and sources[0]["factor"] != "1":
                    factor = re.sub(r"[a-z]\w*", lambda x: of(x.group()) or x.group(), sources[0]["factor"])
                    body.append("if %s.len() as i64 %% (%s) != 0 {\n            return Err(refused(\"%s\"));\n        }" % (own, factor, p["name"]))
                elif not sources and size:
                    if p.get("optional"):
                        body.append("if let Some(a) = %s.as_deref() {\n            sized(a.len(), %s, \"%s\")?;\n        }" % (own, size, p["name"]))
                    else:
                        body.append("sized(%s.len(), %s, \"%s\")?;" % (own, size, p["name"]))
                elif not sources:
                    unsafe = True
                pointer = "as_ptr()" if p["const"] else "as_mut_ptr()"
                null = "std::ptr::null()" if p["const"] else "std::ptr::null_mut()"
                args.append("%s.map_or(%s, |a| a.%s)" % (own, null, pointer) if p.get("optional") else "%s.%s" % (own, pointer))
            elif k == "struct out":
                body.append("let mut %s = std::mem::MaybeUninit::<sys::%s>::zeroed();" % (own, p["type"]))
                args.append("%s.as_mut_ptr()" % own)
                wrapped = p["type"] in self.wrapped
                returned.append(("%s::of(&unsafe { %s.assume_init() })" % (camel(p["type"]), own) if wrapped else "unsafe { %s.assume_init() }" % own,
                                 camel(p["type"])))
            elif k in ("struct in", "struct in out"):
                unsafe = unsafe or p["type"] in self.unsafe_structs
                calls = self.needs_mut(p)
                params.append("%s%s: %s" % ("mut " if calls else "", own, self.arg(p)))
                text, more = self.struct_argument(f, p)
                body += more
                args.append(text)
                if k == "struct in out":
                    after.append("%s.take(&%s_raw);" % (own, p["name"]))
            elif k == "callback":
                params.append("%s: %s" % (own, self.arg(p)))
                body += self.callback_argument(f, p)
                args += ["call_c", "user"]
            elif k == "text":
                params.append("%s: %s" % (own, self.arg(p)))
                body.append("let %s_c = c_text(%s, \"%s\")?;" % (p["name"], own, p["name"]))
                args.append("if %s.is_empty() { std::ptr::null() } else { %s_c.as_ptr() }" % (own, p["name"]) if p.get("optional") else "%s_c.as_ptr()" % p["name"])
            else:
                params.append("%s: %s" % (own, TYPES[p["type"]]))
                args.append(own)
        return self.emit(f, shown, params, args, body, after, returned, unsafe, m.sizes(f, of))

    def needs_mut(self, p):
        if p["type"] not in self.wrapped or p["kind"] != "struct in":
            return False
        fields = self.m.structs[p["type"]]["fields"]
        return any(f["kind"] == "array" and not f["const"] for f in fields)

    def struct_argument(self, f, p):
        own, s = word(p["name"]), self.m.structs[p["type"]]
        if p["type"] not in self.wrapped:
            return "%s%s" % (own, "" if not p.get("optional") else ".map_or(std::ptr::null(), |d| d as *const _)"), []
        arrays = any(g["kind"] == "array" for g in s["fields"])
        dim = "dim" if arrays else ""
        lines = ["let dim = %s;" % self.dim_of(f)] if arrays or self.contexts(s) and any(self.needs_dim(x) for x in self.contexts(s).values()) else []
        if p.get("optional"):
            lines.append("let %s_raw = %s.map(|d| d.raw());" % (p["name"], own))
            return "%s_raw.as_ref().map_or(std::ptr::null(), |d| d as *const _)" % p["name"], lines
        for g in s["fields"]:
            if g["kind"] == "array" and g.get("counted") and g["entries"] != g["counted"]:
                factor = g["entries"][len(g["counted"]) + 1:]
                lines.append("if %s.%s.len() as i64 %% %s != 0 {\n            return Err(refused(\"%s\"));\n        }"
                             % (own, word(g["name"]), "(%s)" % factor, g["name"]))
        mut = "mut " if p["kind"] == "struct in out" or self.contexts(s) or any(g["kind"] == "struct pointer" for g in s["fields"]) else ""
        lines.append("let %s%s_raw = %s.raw(%s);" % (mut, p["name"], own, dim))
        for g in s["fields"]:
            if g["kind"] == "struct pointer":
                lines += ["let %s_pointed = %s.%s.map(|d| d.raw());" % (g["name"], own, g["name"]),
                          "%s_raw.%s = %s_pointed.as_ref().map_or(std::ptr::null(), |d| d as *const _);" % (p["name"], g["name"], g["name"])]
        if p["kind"] == "struct in":
            for user, fields in self.contexts(s).items():
                holder = camel(p["type"]) + camel("peri_" + user)
                values = (["owner: self"] if self.needs_owner(fields) else []) + (["dim"] if self.needs_dim(fields) else [])
                values += ["%s: %s.%s" % (word(g["name"]), own, word(g["name"])) for g in fields]
                if all(g["type"] in PASSING for g in fields):
                    lines += ["let mut %s_holder = %s { %s };" % (user, holder, ", ".join(values)),
                              "let %s_pointer = &mut %s_holder as *mut _ as *mut c_void;" % (user, user),
                              "%s_holder.fill(&mut %s_raw, %s_pointer);" % (user, p["name"], user)]
                else:
                    lines += ["let %s_holder = Arc::new(%s { %s });" % (user, holder, ", ".join(values)),
                              "%s_holder.fill(&mut %s_raw, Arc::as_ptr(&%s_holder) as *mut c_void);" % (user, p["name"], user),
                              "keep(&%s, %s_holder);" % ("self.keep" if f["class"] else "all", user)]
        return "&%s%s_raw" % ("mut " if p["kind"] == "struct in out" else "", p["name"]), lines

    def callback_argument(self, f, p):
        fields = [{"name": "call", "type": p["type"]}]
        holder = camel(p["type"]) + "Holder"
        values = (["owner: self"] if self.needs_owner(fields) else [])
        values += ["dim: %s" % self.dim_of(f)] if self.needs_dim(fields) else []
        if p["type"] in PASSING:
            return ["let mut holder = %s { %s };" % (holder, ", ".join(values + ["call: Some(%s)" % word(p["name"])])),
                    "let user = &mut holder as *mut _ as *mut c_void;",
                    "let call_c: sys::%s = Some(%s::call_c);" % (p["type"], holder)]
        return ["let call_c: sys::%s = if %s.is_some() { Some(%s::call_c) } else { None };" % (p["type"], word(p["name"]), holder),
                "let holder = Arc::new(%s { %s });" % (holder, ", ".join(values + ["call: " + word(p["name"])])),
                "let user = Arc::as_ptr(&holder) as *mut c_void;",
                "if call_c.is_some() {\n            keep(&self.keep, holder.clone());\n        }"]

    def emit(self, f, shown, params, args, body, after, returned, unsafe, sizes):
        name = word(f["method"])
        pad = "    " if f["class"] else ""
        view = any(p["type"] == "peri_view" for p in f["outs"])
        selfarg = [("&mut self" if view else "&self")] if f["class"] else []
        said = doc(f["doc"], pad)
        call = "unsafe { sys::%s(%s) }" % (f["name"], ", ".join(args))
        if f["plain"]:
            returns = {"const char *": "&'static str"}.get(f["returns"]) or TYPES[f["returns"]]
            text = "constant(%s)" % call if f["result"] == "text" else call
            return said + [pad + "pub fn %s(%s) -> %s {" % (name, ", ".join(selfarg + params), returns), pad + "    " + text, pad + "}"]
        out_arrays = [p for p in f["outs"] if p["kind"] == "array out" and p["entries"] != "1"]
        single = len(f["outs"]) == 1 and out_arrays and not out_arrays[0].get("optional") and \
            (sizes.get(out_arrays[0]["name"]) or out_arrays[0]["entries"] == "count")
        fn = name + "_into" if single else name
        wide = f["returns"] == "int64_t"
        result = "result" if wide else "i64::from(result)"
        own_record = any(p["kind"] == "error" for p in f["params"])
        lines = list(body)
        lines.append("let result = %s;" % call)
        if own_record:
            lines.append("known(%s, &record)?;" % result)
        elif f["class"] == "Body":
            lines.append("self.check(%s)?;" % result)
        else:
            lines.append("known(%s, &blank())?;" % result)
        lines += after
        value, kind = "result", TYPES[f["returns"]]
        if f["makes"]:
            kind = self.m.classes[f["makes"]["type"]]
            if kind == "Body":
                value = "Body { handle: made, keep: %s }" % ("self.keep.clone()" if f["class"] else "all")
            else:
                value = "%s { handle: made, dim: i64::from(self.dimension()) }" % kind
        elif view:
            value, kind = "View { raw: %s, body: std::marker::PhantomData }" % returned[0][0], "View<'_>"
        elif len(returned) == 1:
            value, kind = returned[0]
        elif returned:
            value, kind = "(%s)" % ", ".join(r[0] for r in returned), "(%s)" % ", ".join(r[1] for r in returned)
        if f["name"] == "peri_body_create":
            lines.insert(0, "let all: Keep = Arc::default();")
        safety = [pad + "///", pad + "/// # Safety", pad + "/// The arrays that it points to are as long as peri.h says."] if unsafe else []
        out = said + safety + [pad + "pub %sfn %s(%s) -> Result<%s> {" % ("unsafe " if unsafe else "", fn, ", ".join(selfarg + params), kind)]
        out += [pad + "    " + x for line in lines for x in line.split("\n")]
        out += [pad + "    Ok(%s)" % value, pad + "}"]
        if single:
            p = out_arrays[0]
            rest = [x for x in params if not re.match(r"%s: " % re.escape(word(p["name"])), x)]
            size = sizes.get(p["name"]) or next("%s.len() as i64" % word(q["name"]) for q in shown if q["kind"] == "array in" and q["entries"] == "count")
            zero = EMPTY.get(TYPES.get(p["type"]), "unsafe { std::mem::zeroed::<sys::%s>() }" % p["type"])
            element = TYPES.get(p["type"], camel(p["type"]))
            names = ", ".join("&mut out_array" if q is p else word(q["name"]) for q in shown)
            out += said + [pad + "pub fn %s(%s) -> Result<Vec<%s>> {" % (name, ", ".join(selfarg + rest), element),
                           pad + "    let mut out_array = vec![%s; (%s) as usize];" % (zero, size),
                           pad + "    self.%s(%s)?;" % (fn, names), pad + "    Ok(out_array)", pad + "}"]
        return out

    def classes(self):
        out = []
        for c, name in self.m.classes.items():
            said = next(o["doc"] for o in self.m.api["opaque"] if o["name"] == c)
            out += [""] + doc("Owns a %s. %s" % (c, "" if said == "opaque" else said))
            out += ["pub struct %s {" % name, "    handle: *mut sys::%s," % c, "    keep: Keep," if name == "Body" else "    #[allow(dead_code)]\n    dim: i64,", "}", "",
                    "// Any thread may use it, one at a time.", "unsafe impl Send for %s {}" % name, "",
                    "impl Drop for %s {" % name, "    fn drop(&mut self) {", "        unsafe { sys::%s_destroy(self.handle) }" % c, "    }", "}", "",
                    "impl %s {" % name]
            if name == "Body":
                out += ["    pub fn new(desc: BodyDesc) -> Result<Self> {", "        body_create(desc)", "    }",
                        "    fn check(&self, result: i64) -> Result<()> {", "        go_on();", "        if result >= 0 {", "            return Ok(());", "        }",
                        "        let mut record = blank();", "        unsafe { sys::peri_get_error(self.handle, &mut record) };",
                        "        Err(failed(result, &record))", "    }"]
            for f in self.m.functions:
                if f["class"] == name and not f["inner"]:
                    out += self.method(f)
            out.append("}")
        return out

    def safe(self):
        m = self.m
        out = SAFE.rstrip("\n").split("\n") + [""]
        for c in m.api["constants"]:
            if isinstance(c["value"], int):
                out += doc(c["doc"]) + ["pub const %s: i32 = sys::%s;" % (short(c["name"]), c["name"])]
        for e in m.api["enums"]:
            for v in e["values"]:
                out += doc(v["doc"]) + ["pub const %s: i32 = sys::%s;" % (short(v["name"]), v["name"])]
        out.append("")
        for s in m.api["structs"]:
            out += self.struct(s)
        for s in sorted(self.unsafe_structs - {"peri_view"}):
            out += ["", "/// The defaults.", "pub fn %s() -> sys::%s {" % (short(s), s), "    let mut raw = std::mem::MaybeUninit::<sys::%s>::zeroed();" % s,
                    "    unsafe {", "        sys::%s_init(raw.as_mut_ptr());" % s, "        raw.assume_init()", "    }", "}"] \
                if any(f["name"] == s + "_init" for f in m.functions) else []
        used = {p["type"] for f in m.functions for p in f["params"] if p["kind"] == "callback"}
        for c in m.api["callbacks"]:
            if c["name"] in used and c["name"] not in RAW:
                out += self.holder(camel(c["name"]) + "Holder", [{"name": "call", "type": c["name"]}], None, None)
        out += self.classes()
        for f in m.functions:
            if not f["class"] and not f["inner"]:
                out += [""] + self.method(f)
        return "\n".join(out) + "\n"


def files(model):
    rust = Rust(model)
    return {"bindings/rust/peri-sys/src/lib.rs": rust.sys(), "bindings/rust/peri/src/lib.rs": rust.safe()}
