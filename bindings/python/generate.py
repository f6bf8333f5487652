#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""generate.py - writes peri/_generated.py, of peri.h as tools/api.py reads it: what the package has for each declaration.

  generate.py ROOT OUT     ROOT has peri.h and tools/api.py

What a function becomes follows from the roles of its arguments, so that a field or a function that is added to peri.h needs no edit here:

  the first argument is a handle    a method of its class, without "peri_" and the name of the class; const and alone: a property
  peri_x_create                     body.x(...), or Body(...)
  a descriptor                      its fields as keywords
  arrays and structs that it fills  allocated, and returned
  counts and capacities             taken from the arrays; a size from peri_size_of_x or peri_find_x
  callback and user                 one Python callable
  name, material, standing          keywords at the end, which may be left out
"""
import importlib.util
import os
import re
import sys
import textwrap

sys.dont_write_bytecode = True
KEYWORDS = {"in", "from", "is", "as", "pass", "with", "lambda", "global"}
C_TYPES = {"double": "C.c_double", "float": "C.c_float", "int32_t": "C.c_int32", "int64_t": "C.c_int64", "uint32_t": "C.c_uint32",
           "uint64_t": "C.c_uint64", "char": "C.c_char", "void": "None"}
D_TYPES = {"double": "np.float64", "float": "np.float32", "int32_t": "np.int32", "int64_t": "np.int64", "uint32_t": "np.uint32",
           "uint64_t": "np.uint64"}
HINTS = {"double": "float", "float": "float", "char": "str"}
# what Python has other means for: exceptions
LEFT_OUT = {"peri_format_error", "peri_get_error", "peri_unlock"}
# of the body itself, by their names in the lengths of arrays
SIZES = {"dim": "self.dimension", "turns": "(1 if self.dimension == 2 else 3)", "points": "self.point_count", "width": "self.family_width"}


def camel(name):
    return "".join(word.capitalize() for word in re.sub(r"^peri_", "", name).split("_"))


def safe(name):
    return name + "_" if name in KEYWORDS else name


def members_of(enum):
    """[(name, value)]: without what the names of all have in common, up to an underscore."""
    names = [v["name"] for v in enum["values"]]
    stem = os.path.commonprefix(names)
    stem = stem[:stem.rfind("_") + 1] if len(names) > 1 else "PERI_"
    return [(n[len(stem):], v["value"], v["doc"]) for n, v in zip(names, enum["values"])]


def doc_lines(text, indent, extra=()):
    """A docstring."""
    width = 116 - len(indent)
    lines = textwrap.wrap(text, width) if text else []
    for part in extra:
        if lines and part and (not lines[-1].startswith("    ") or not part.startswith("    ")):
            lines.append("")
        lines += textwrap.wrap(part, width, subsequent_indent="        " if part.startswith("    ") else "") or [""]
    if not lines:
        return []
    lines = [line.replace("\\", "\\\\").replace('"""', "'''") for line in lines]
    quoted = [indent + '"""' + lines[0]] + [(indent + line).rstrip() for line in lines[1:]]
    if len(quoted) == 1 and not lines[0].endswith('"'):
        return [quoted[0] + '"""']
    return quoted + [indent + '"""']


def wrapped(line):
    """A long statement on lines of its own: tracebacks show one of them."""
    indent = " " * (len(line) - len(line.lstrip()) + 4)
    return textwrap.wrap(line, 120, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False, drop_whitespace=True)


class Writer:
    def __init__(self, api, by_hand=()):
        self.api = api
        self.enums = {e["name"] for e in api["enums"]}
        self.structs = {s["name"]: s for s in api["structs"]}
        self.callbacks = {c["name"]: c for c in api["callbacks"]}
        self.by_hand = [o["name"] for o in api["opaque"] if o["name"].startswith(by_hand)]
        self.opaque = [o["name"] for o in api["opaque"] if o["name"] not in self.by_hand]
        self.functions = {f["name"]: f for f in api["functions"]}
        self.out = []
        self.exported = []

    def line(self, text=""):
        self.out.append(text)

    # ---- types -------------------------------------------------------------------------------------------------------

    def c_type(self, p):
        """The ctypes of an argument or a field. Pointers are addresses."""
        if p["type"] in self.callbacks and not p["pointer"]:
            return camel(p["type"])
        if p["type"] == "char" and p["pointer"]:
            return "C.c_char_p"
        if p["pointer"]:
            return "C.c_void_p"
        base = camel(p["type"]) if p["type"] in self.structs else C_TYPES[p["type"]]
        return "%s * %d" % (base, p["length"]) if p["length"] else base

    def hint(self, p):
        if "enum" in p:
            return camel(p["enum"]) + " | str | int"
        if p["type"] in self.callbacks:
            return "Callable[..., Any]"
        return HINTS.get(p["type"], "int")

    # ---- enums, structs, callbacks -----------------------------------------------------------------------------------

    def write_enums(self):
        for c in self.api["constants"]:
            self.line("%s = %r" % (re.sub(r"^PERI_", "", c["name"]), c["value"]))
            self.exported.append(re.sub(r"^PERI_", "", c["name"]))
        for e in self.api["enums"]:
            name = camel(e["name"])
            self.exported.append(name)
            self.line("\n\nclass %s(%s):" % (name, "IntFlag" if e["flags"] else "IntEnum"))
            listed = ["    %s: %s" % (m, doc) for m, _, doc in members_of(e) if doc]
            self.out += doc_lines(e["doc"] or e["name"] + ".", "    ", listed)
            for member, value, _ in members_of(e):
                self.line("    %s = %d" % (member, value))
        self.line("\n")

    def write_errors(self):
        status = next(e for e in self.api["enums"] if e["name"] == "peri_status")
        names = {}
        for v in status["values"]:
            if v["value"] >= 0:
                continue
            name = camel(v["name"].replace("PERI_ERROR_", "").lower()) + "Error"
            base = {"MemoryError": ", builtins.MemoryError", "IndexError": ", builtins.IndexError"}.get(name, "")
            self.line("\nclass %s(PeriError%s):" % (name, base))
            self.out += doc_lines(v["doc"], "    ")
            self.line()
            names[v["value"]] = name
            self.exported.append(name)
        self.line("\nERRORS.update({%s})" % ", ".join("%d: %s" % n for n in names.items()))

    def callback_argument(self, p, params):
        """(how it is handed to Python, more) of an argument of a callback."""
        dtype, shape = D_TYPES.get(p["type"]), self.shape(p.get("entries", "1"))
        if p["role"] == "user":
            return None
        if p["name"] == "count" and any("count" in q.get("entries", "") or q["role"] == "bytes" and q["type"] == "void" for q in params):
            return None
        if p["role"] == "array in":
            return '("in", %s, lambda dim, turns, count: %s)' % (dtype, shape)
        if p["role"] == "array out":
            returned = any(q["role"] == "array out" and q.get("entries") == "1" for q in params)
            return '("%s", %s, lambda dim, turns, count: %s)' % ("returned" if returned else "in out", dtype, shape)
        if p["role"] == "bytes":
            return '("%s",)' % ("bytes in" if p["const"] else "bytes out" if any(q["name"] == "count" for q in params) else "value")
        return '("%s",)' % {"handle": "body", "text": "text", "callback": "task"}.get(p["role"], "value")

    def shape(self, entries):
        if entries == "1":
            return "()"
        parts = entries.split("*")
        if "-" in entries or "+" in entries:
            return "(%s,)" % entries
        return "(%s,)" % ", ".join(parts)

    def write_callbacks(self):
        self.line("# ---- callbacks\n")
        for c in self.api["callbacks"]:
            returns = {"void": "None", "void *": "C.c_void_p"}.get(c["returns"]) or C_TYPES[c["returns"]]
            types = [self.c_type(p) for p in c["params"]]
            name = camel(c["name"])
            self.line('%s = function_type("%s", %s, [%s])' % (name, name, returns, ", ".join(types)))
            specs = [(k, p["name"], self.callback_argument(p, c["params"])) for k, p in enumerate(c["params"])]
            count = next((k for k, n, spec in specs if n == "count" and spec is None), -1)
            context = next((k for k, n, _ in specs if n == "context"), -1)
            self.line("CALLBACKS[%s] = Callback(%r, [%s], count=%d, context=%d)" % (
                name, c["name"], ", ".join("(%d, %s)" % (k, spec) for k, _, spec in specs if spec), count, context))
        self.line()

    def is_user(self, struct, f):
        return f["type"] == "void" and f["pointer"] == 1 and (f["name"] == "user" or f["name"].endswith("_user"))

    def meta(self, struct, f):
        """How a keyword sets a field, as an entry of _meta_; None where it is no keyword."""
        if f["name"] in ("cookie", "reserved") or self.is_user(struct, f):
            return None
        if f["type"] in self.callbacks:
            return '("callback", %s)' % camel(f["type"])
        if "enum" in f:
            return '("enum", %s)' % camel(f["enum"])
        if f["type"] in self.structs and f["pointer"]:
            return '("struct", %s)' % camel(f["type"])
        if f["type"] == "void" and f["pointer"]:
            return '("buffer", %s)' % (not f["const"])
        if f["type"] == "char":
            return '("text",)'
        if f["pointer"]:
            count, _, rest = f.get("entries", "").partition("*")
            return '("%s", %s, %r, lambda dim: %s)' % ("array in" if f["const"] else "array out", D_TYPES[f["type"]], count,
                                                         rest or "1")
        if f["length"]:
            return '("vector", %s, %d)' % (D_TYPES[f["type"]], f["length"])
        if f["type"] in self.structs:
            return '("nested",)'
        return '("number", %s)' % ("float" if f["type"] in ("double", "float") else "int")

    def counted(self, struct):
        """Fields that tell the length of an array, which tells them."""
        return {f["entries"].partition("*")[0] for f in struct["fields"] if f.get("entries") and f["const"]}

    def keywords(self, struct):
        return [f for f in struct["fields"] if self.meta(struct, f) and f["name"] not in self.counted(struct)]

    def field_hint(self, f):
        if f["type"] in self.structs:
            return camel(f["type"])
        if f["pointer"] and f["type"] != "char" or f["length"]:
            return "ArrayLike"
        return self.hint(f)

    def write_structs(self):
        for s in self.api["structs"]:
            name = camel(s["name"])
            self.exported.append(name)
            desc = s["name"] + "_init" in self.functions
            self.line("\nclass %s(Struct):" % name)
            self.out += doc_lines(s["doc"] or s["name"] + ".", "    ", self.field_docs(s["fields"]))
            for f in s["fields"]:
                if f["name"] in ("cookie", "reserved") or self.is_user(s, f):
                    continue
                kind = "np.ndarray" if f["length"] else self.field_hint(f) if "enum" not in f else camel(f["enum"])
                self.line("    %s: %s" % (f["name"], kind if kind != "ArrayLike" else "Any"))
            self.line("    _fields_ = [%s]" % ",\n                ".join(
                '("%s", %s)' % (self.stored(f), self.c_type(f)) for f in s["fields"]))
            self.line("    _meta_ = {%s}" % ",\n              ".join(
                '"%s": %s' % (f["name"], self.meta(s, f)) for f in s["fields"] if self.meta(s, f)))
            if desc:
                self.line("    _initial_ = (%s)" % "".join('"%s", ' % p["name"] for p in self.functions[s["name"] + "_init"]["params"][1:]))
                fields = self.keywords(s)
                self.line()
                self.line("    def __init__(self, *, %s) -> None:" % ",\n                 ".join(
                    "%s: %s | None = None" % (safe(f["name"]), self.field_hint(f)) for f in fields))
                self.out += wrapped("        self._begin(lib.%s_init, {%s})" % (s["name"], ", ".join(
                    '"%s": %s' % (f["name"], safe(f["name"])) for f in fields)))
            self.line("\n\ndress(%s)\n" % name)

    def stored(self, f):
        """Arrays, enums and texts lie under a name of their own; properties show them."""
        return "_" + f["name"] if f["length"] or "enum" in f or f["type"] == "char" else f["name"]

    def field_docs(self, fields):
        return ["    %s: %s" % (safe(f["name"]), f["doc"] or "likewise") for f in fields if f["name"] not in ("cookie", "reserved")
                and not (f["type"] == "void" and f["name"].endswith("user"))]

    # ---- functions ---------------------------------------------------------------------------------------------------

    def write_prototypes(self):
        self.line("# ---- functions of the library\n")
        self.line("PROTOTYPES = {")
        for f in self.api["functions"]:
            result = {"const char *": "C.c_char_p", "void": "None"}.get(f["returns"]) or C_TYPES[f["returns"]]
            self.line('    "%s": (%s, [%s]),' % (f["name"], result, ", ".join(self.c_type(p) for p in f["params"])))
        self.line("}\ndeclare(PROTOTYPES)\n")

    def expression(self, entries, local):
        """Python for the length of an array."""
        return re.sub(r"[a-z_]\w*", lambda m: m.group() if m.group() in local else SIZES.get(m.group(), "self." + m.group()), entries)

    def method_name(self, f, handle):
        name, short = re.sub(r"^peri_", "", f["name"]), re.sub(r"^peri_", "", handle or "")
        if handle and short != "body":
            name = re.sub(r"^(get|export)_%s" % short, r"\1", re.sub(r"^%s_" % short, "", name))
        elif handle:
            name = re.sub(r"^body_", "", name)
        return safe(name)

    def is_property(self, f):
        return len(f["params"]) == 1 and f["params"][0]["role"] == "handle" and f["params"][0]["const"] and f["returns"] != "void"

    def write_property(self, f, name):
        hint = {"double": "float", "const char *": "str"}.get(f["returns"], "int")
        self.line("    @property")
        self.line("    def %s(self) -> %s:" % (name, hint))
        self.out += doc_lines(f["doc"], "        ", ["C: %s" % f["name"]])
        call = "lib.%s(self._pointer)" % f["name"]
        self.line("        return %s\n" % ("%s.decode()" % call if hint == "str" else call))

    def write_function(self, f, handle):
        name = self.method_name(f, handle)
        if handle and self.is_property(f):
            return self.write_property(f, name)
        text = Function(self, f, handle).text(name)
        self.out += text
        return None

    def write_classes(self):
        for handle in self.opaque:
            of_it = [f for f in self.api["functions"] if f["params"] and f["params"][0]["type"] == handle
                     and f["params"][0]["role"] == "handle" and f["name"] not in LEFT_OUT and not f["name"].endswith("_destroy")]
            name = camel(handle)
            self.line("\nclass %s(Handle):" % (name + "Calls"))
            self.out += doc_lines("What peri.h declares of %s." % handle, "    ")
            self.line('    _destroy = "%s_destroy"\n' % handle)
            if handle == "peri_body":
                self.write_body_init()
            for f in of_it:
                self.write_function(f, handle)
            if handle == "peri_body":
                self.write_fields()

    def write_body_init(self):
        create, desc = self.functions["peri_body_create"], self.structs["peri_body_desc"]
        fields = self.keywords(desc)
        self.line("    def __init__(self, *, desc: BodyDesc | None = None, %s) -> None:" % ",\n                 ".join(
            "%s: %s | None = None" % (f["name"], self.field_hint(f)) for f in fields))
        self.out += doc_lines("An empty body; its space and horizon are required. " + create["doc"], "        ", self.field_docs(fields))
        self.out += wrapped("        self._create(described(BodyDesc, desc, {%s}))" % ", ".join(
            '"%s": %s' % (f["name"], f["name"]) for f in fields)) + [""]

    def write_fields(self):
        fields = next(e for e in self.api["enums"] if e["name"] == "peri_field")
        for member, _, doc in members_of(fields):
            stored, settable = re.match(r"S", doc) is not None, re.match(r"SW", doc) is not None
            name = member.lower()
            self.line("    @property")
            self.line("    def %s(self) -> %s:" % (name, "LiveField" if stored else "np.ndarray"))
            what = "%s. %s" % (re.sub(r"^SW? ", "", doc) or name, "Live: shows the present state; see LiveField" if stored else "A copy")
            self.out += doc_lines(what + (", can be set." if settable else "."), "        ")
            self.line("        return self.%s(Field.%s)" % ("_live" if stored else "field", member))
            if settable:
                self.line("\n    @%s.setter" % name)
                self.line("    def %s(self, value: ArrayLike) -> None:" % name)
                self.line("        self._set_whole(Field.%s, value)" % member)
            self.line()

    def write_module(self):
        for f in self.api["functions"]:
            if f["name"] in LEFT_OUT or f["name"].endswith(("_init", "_create")):
                continue
            if not f["params"] or f["params"][0]["type"] not in self.opaque + self.by_hand:
                self.line()
                self.write_function(f, None)
                self.exported.append(self.method_name(f, None))

    def text(self):
        self.line("# Made by generate.py of peri.h: not to be edited.")
        self.line("# mypy: ignore-errors")
        self.out += ['"""What peri.h declares: enums, structs, errors, and the methods of Body, Cracks and Matrix."""',
                     "from __future__ import annotations", "", "import builtins", "import ctypes as C", "import os",
                     "from enum import IntEnum, IntFlag", "from typing import TYPE_CHECKING, Any, Callable", "", "import numpy as np", "",
                     "from ._core import CALLBACKS, ERRORS, Callback, Handle, PeriError, call, declare, function_type, lib, made",
                     "from ._fields import LiveField", "from ._runs import watched",
                     "from ._values import (Struct, as_enum, as_float, as_int, as_text, described, dress, input_array, output_array, "
                     "records)", "",
                     "if TYPE_CHECKING:", "    from numpy.typing import ArrayLike", "",
                     "    from ._body import Body, Cracks, Matrix", ""]
        self.write_enums()
        self.write_errors()
        self.line()
        self.write_callbacks()
        self.write_structs()
        self.write_prototypes()
        self.write_classes()
        self.write_module()
        self.line("\n__all__ = [%s]" % ",\n           ".join('"%s"' % n for n in self.exported))
        return "\n".join(self.out) + "\n"


class Function:
    """The Python text of one function."""

    def __init__(self, writer, f, handle):
        self.w, self.f, self.handle = writer, f, handle
        self.params = f["params"][1:] if handle else f["params"]
        self.names = {p["name"] for p in f["params"]}
        self.required, self.optional = [], []  # of the signature
        self.body, self.arguments, self.results, self.docs = [], [], [], []
        self.desc = None
        self.local = set()  # names that are Python variables
        self.counted = False
        self.guard, self.watch, self.keep = False, False, []

    def takes(self, name, hint, default=None):
        if default is None:
            self.required.append("%s: %s" % (name, hint))
        else:
            self.optional.append("%s: %s = %s" % (name, hint, default))

    def do(self, text):
        self.body.append("        " + text)

    # ---- arguments

    def value(self, p):
        name = safe(p["name"])
        if p["name"] == "count" and self.is_count():
            self.arguments.append("count")
            return
        if p["name"].endswith("capacity"):
            self.arguments.append(p["name"])
            return
        self.local.add(p["name"])
        if "enum" in p:
            enum = camel(p["enum"])
            if p["name"] == "standing":
                self.takes(name, enum + " | str | int", '"initial"')
            else:
                self.takes(name, enum + " | str | int")
            self.do('%s = as_enum(%s, %s, "%s")' % (name, enum, name, name))
        elif p["name"] == "material" and self.handle:
            self.takes(name, "int | None", "None")
            self.do("material = self._material(material)")
        elif p["name"] == "set" and self.handle:
            self.takes(name, "int | str")
            self.do("set = self._set(set)")
        elif p["type"] in ("double", "float"):
            self.takes(name, "float")
            self.do('%s = as_float(%s, "%s")' % (name, name, name))
        else:
            self.takes(name, "int")
            self.do('%s = as_int(%s, %s, "%s")' % (name, name, C_TYPES[p["type"]], name))
        self.arguments.append(name)

    def is_count(self):
        return any(re.match(r"count\b", p.get("entries", "")) and p["role"] == "array in" for p in self.params)

    def array_in(self, p):
        name = safe(p["name"])
        optional = p.get("optional")
        self.takes(name, "ArrayLike | None" if optional else "ArrayLike", "None" if optional else None)
        dtype, entries = D_TYPES[p["type"]], p["entries"]
        first, _, rest = entries.partition("*")
        if first == "count" and not self.counted:
            self.counted = True
            self.do('%s, count = input_array(%s, %s, "%s", per=%s)' % (name, name, dtype, name, self.w.expression(rest or "1", self.local)))
            self.local.add("count")
        else:
            self.do('%s, _ = input_array(%s, %s, "%s", entries=%s)' % (name, name, dtype, name, self.w.expression(entries, self.local)))
        self.arguments.append("None if %s is None else %s.ctypes.data" % (name, name) if optional else "%s.ctypes.data" % name)

    def array_out(self, p):
        name = safe(p["name"])
        entries = p["entries"]
        if entries == "1":
            self.do("%s = %s()" % (name, C_TYPES[p["type"]]))
            self.arguments.append("C.byref(%s)" % name)
            self.results.append(("%s.value" % name, HINTS.get(p["type"], "int")))
            return
        sizes = [self.w.expression(e, self.local) for e in ([entries] if re.search(r"[-+]", entries) else entries.split("*"))]
        self.do("%s = output_array((%s,), %s)" % (name, ", ".join(sizes), D_TYPES[p["type"]]))
        self.arguments.append("%s.ctypes.data" % name)
        self.results.append((name, "np.ndarray"))
        if "capacity" in self.names and "capacity" not in self.local:
            self.do("capacity = %s.size" % name)
            self.local.add("capacity")

    def struct_in(self, p):
        struct = self.w.structs[p["type"]]
        if p["type"] + "_init" not in self.w.functions:
            self.takes(p["name"], camel(p["type"]))
            self.arguments.append("C.byref(%s)" % p["name"])
            return
        owner = "self" if self.handle else "None"
        if self.desc is not None:  # the first has its fields as keywords; another is one by itself
            name = safe(p["name"])
            self.optional.append("%s: %s | None = None" % (name, camel(p["type"])))
            self.do("%s = described(%s, %s, {}, %s)" % (name, camel(p["type"]), name, owner))
            self.arguments.append("C.byref(%s)" % name)
            self.keep.append(name)
            return
        fields = self.w.keywords(struct)
        initial = [q["name"] for q in self.w.functions[p["type"] + "_init"]["params"][1:]]
        for f in fields:
            if f["name"] in initial and f["name"] not in self.local:
                self.optional.append("%s: %s | %s | None = None" % (f["name"], self.w.field_hint(f), camel(p["type"])))
        marks = [] if initial else ["desc: %s | None = None" % camel(p["type"])]
        self.optional += marks + ["*"] + ["%s: %s | None = None" % (safe(f["name"]), self.w.field_hint(f)) for f in fields
                                          if f["name"] not in initial]
        self.docs += self.w.field_docs(fields)
        given = "{%s}" % ", ".join('"%s": %s' % (f["name"], safe(f["name"])) for f in fields)
        if p.get("optional"):
            self.do("given = %s" % given)
            self.do("desc = None if desc is None and all(v is None for v in given.values()) else described(%s, desc, given, %s)"
                    % (camel(p["type"]), owner))
            self.arguments.append("None if desc is None else C.byref(desc)")
        else:
            self.do("desc = described(%s, %s, %s, %s)" % (camel(p["type"]), initial[0] if initial else "desc", given, owner))
            self.arguments.append("C.byref(desc)")
        self.desc = struct
        kinds = {f["type"] for f in struct["fields"]}
        self.guard = self.guard or bool(kinds & set(self.w.callbacks))
        self.watch = "peri_frame_fn" in kinds
        self.keep.append("desc")

    def struct_out(self, p):
        name = safe(p["name"])
        if p["type"] == "peri_error":
            self.do("record = Error()")
            self.arguments.append("C.byref(record)")
        elif p["entries"] != "1":
            self.do("%s = records(%s, %s)" % (name, camel(p["type"]), self.w.expression(p["entries"], self.local)))
            self.arguments.append("%s.ctypes.data" % name)
            self.results.append((name, "np.recarray"))
        elif p["type"] + "_init" in self.w.functions:  # filled in further
            self.takes(name, camel(p["type"]))
            self.arguments.append("C.byref(%s)" % name)
        else:
            self.do("%s = %s()" % (name, camel(p["type"])))
            self.arguments.append("C.byref(%s)" % name)
            self.results.append((name, camel(p["type"])))

    def callback(self, p):
        name = safe(p["name"])
        needed = p["name"] not in ("fn",)
        self.takes(name, "Callable[..., Any]" if needed else "Callable[..., Any] | None", None if needed else "None")
        self.do('%s = made(%s, %s, "%s")' % (name, camel(p["type"]), name, name))
        self.arguments.append(name)
        self.guard = True
        self.keep.append(name)

    def capacities(self):
        """What peri_size_of_x or peri_find_x says is to be had."""
        wanted = [p["name"] for p in self.params if p["name"].endswith("capacity")]
        if not wanted or not any("capacity" in p.get("entries", "") for p in self.params):
            return
        thing = re.sub(r"^peri_get_", "", self.f["name"])
        asked = self.w.functions.get("peri_size_of_" + thing) or self.w.functions.get("peri_find_" + thing)
        if not asked and {"field", "count"} <= set(self.names):
            self.do("capacity = count * (self.size_of_field(field) // self.point_count)")
            self.local.add("capacity")
            return
        if not asked:
            raise SystemExit("generate.py: %s: how large is what it writes? There is no peri_size_of_%s" % (self.f["name"], thing))
        leading = [safe(p["name"]) for p in asked["params"][1:] if p["role"] == "value" and not p["name"].endswith("capacity")]
        ask = "self.%s(%s)" % (self.w.method_name(asked, self.handle), ", ".join(leading))
        if asked["name"].startswith("peri_find_"):
            ask += "[0]"
        self.do("%s = %s" % (", ".join(wanted), ask))
        self.local |= set(wanted)

    def prepare(self):
        handlers = {"value": self.value, "array in": self.array_in, "array out": self.array_out, "struct in": self.struct_in,
                    "struct out": self.struct_out, "callback": self.callback}
        ahead = [p for p in self.params if p["role"] in ("value", "array in") and not p["name"].endswith("capacity")]
        asked = False
        for p in self.params:
            if p["role"] in ("array out", "struct out") and not asked and all(
                    q["name"] in self.local or q["role"] == "array in" or q["name"] == "count" for q in ahead
                    if self.params.index(q) < self.params.index(p)):
                self.capacities()
                asked = True
            if p["role"] == "user":
                self.arguments.append("None")
            elif p["role"] == "text":
                optional = p.get("optional")
                self.takes(safe(p["name"]), "str | None" if optional else "str | os.PathLike[str]" if p["name"] == "path" else "str",
                           "None" if optional else None)
                self.do('%s = as_text(%s, "%s")' % (p["name"], p["name"], p["name"]))
                self.arguments.append(p["name"])
            elif p["role"] == "new handle":
                self.do("new = C.c_void_p()")
                self.arguments.append("C.byref(new)")
            else:
                handlers[p["role"]](p)

    # ---- the text

    def result_hint(self):
        new = next((p for p in self.params if p["role"] == "new handle"), None)
        if new:
            return camel(new["type"])
        hints = [h for _, h in self.results]
        if self.f["result"] == "text":
            return "str"
        if self.f["returns"] == "double":
            return "float"
        if self.f["returns"] == "int64_t" and hints:
            hints.insert(0, "int")
        if not hints:
            return "int"
        return hints[0] if len(hints) == 1 else "tuple[%s]" % ", ".join(hints)

    def text(self, name):
        self.prepare()
        create = next((p for p in self.params if p["role"] == "new handle"), None)
        if create:
            name = re.sub(r"_create$", "", re.sub(r"^peri_", "", self.f["name"])) if name.endswith("create") else name
        optional = list(self.optional)
        if self.watch:
            optional.append("progress: bool = False")
        if "*" in optional:  # keywords last
            star = optional.index("*")
            optional = [o for o in optional[:star]] + optional[star:]
        signature = (["self"] if self.handle else []) + self.required + optional
        pad = "    " if self.handle else ""
        lines = [pad + "def %s(%s) -> %s:" % (name, (",\n" + pad + " " * (len(name) + 5)).join(signature), self.result_hint())]
        lines += doc_lines(self.f["doc"], pad + "    ", self.docs + ["C: %s" % self.f["name"]])
        if self.watch:
            self.do("watched(self, desc, progress)")
        pointer = ["self._pointer"] if self.handle else []
        where = "self" if self.handle else "None"
        arguments = ", ".join(pointer + self.arguments)
        if self.f["result"] == "text":
            self.do("return lib.%s(%s).decode()" % (self.f["name"], arguments))
        elif self.f["returns"] == "double" or not self.params and not self.handle:
            self.do("return lib.%s(%s)" % (self.f["name"], arguments))
        else:
            self.finish(where, arguments, create)
        for line in self.body:
            lines += wrapped(line if self.handle else line[4:])
        return lines + [""]

    def finish(self, where, arguments, create):
        error = ", error=record" if any(p["type"] == "peri_error" for p in self.params) else ""
        guard = ", guard=True" if self.guard else ""
        keep = ", keep=(%s,)" % ", ".join(self.keep) if self.keep and self.handle else ""
        needed = not create and (not self.results or self.f["returns"] == "int64_t")
        self.do(("result = " if needed else "") + "call(%s, lib.%s, (%s,)%s%s%s)" % (where, self.f["name"], arguments, error, guard, keep))
        if create:
            self.do("return self._new(%s, new)" % repr(camel(create["type"])))
            return
        outs = [text for text, _ in self.results]
        if self.watch and outs:
            self.do("desc._attach(%s)" % outs[0])
        if self.f["returns"] == "int64_t" and outs:
            outs.insert(0, "result")
        if self.f["name"].startswith("peri_remove_"):
            self.do("self._forget(%s)" % safe(self.params[0]["name"]))
        self.do("return %s" % (", ".join(outs) if outs else "result"))


def load_api(root):
    path = os.path.join(root, "tools", "api.py")
    spec = importlib.util.spec_from_file_location("peri_api", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.load(), module.JOINING


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    text = Writer(*load_api(arguments[0])).text()
    with open(arguments[1], "w") as f:
        f.write(text)


if __name__ == "__main__":
    main(sys.argv[1:])
