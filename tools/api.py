#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""api.py - peri.h as data: bindings/api.json, of which every binding is made.

  api.py              writes bindings/api.json (make bindings)
  api.py --check      ends with 1 where bindings/api.json is not what peri.h says, or a rule below is broken
  api.py --sizes      writes a C program that prints the size of every struct and the offset of every field, as JSON
  api.py --layout T   writes C that compiles where sizes and offsets are those of layout() for target T: x86-64, i386, aarch64, wasm32

The header is read by its own conventions, which lint holds: a comment before a declaration belongs to it, as does one after a member on the
same line or below it; a comment "---- title" begins a section. What a signature cannot say follows from the text and from names:

  length of an array   "name[expression]" in the comment, else the fixed length below; an expression of dim, points, other arguments
  result               status, id, count, number, text or void: from the type and the name
  out or in            a pointer to const is in; one to what is not is out
"""
import json
import os
import re
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
HEADER = os.path.join(ROOT, "peri.h")
OUT = os.path.join(ROOT, "bindings", "api.json")

# ---- reading ---------------------------------------------------------------------------------------------------------


def tokens(text):
    """(kind, text, line) of comments, directives and the code between them, in order."""
    line, out = 1, []
    pattern = re.compile(r"/\*.*?\*/|^#(?:[^\n\\]|\\\n|\\.)*|\"[^\"]*\"|[A-Za-z_0-9.]+|\S|\n|[^\S\n]+", re.S | re.M)
    for match in pattern.finditer(text):
        piece = match.group()
        kind = "comment" if piece.startswith("/*") else "directive" if piece.startswith("#") else "space" if piece.isspace() else "word"
        out.append((kind, piece, line))
        line += piece.count("\n")
    return out


def plain(comment):
    """The text of a comment, on one line."""
    text = re.sub(r"^/\*|\*/$", "", comment)
    return re.sub(r"\s+", " ", text).strip()


class Reader:
    def __init__(self, text):
        self.items = [t for t in tokens(text) if t[0] != "space"]
        self.at = 0
        self.section = ""
        self.conditions = []
        self.pending = ""
        self.group, self.group_ends = "", -1  # declarations that follow each other without a blank line share a comment

    def declarations(self):
        """(section, condition, doc, [tokens]) of each declaration; comments within it stay among the tokens."""
        while self.at < len(self.items):
            kind, text, line = self.items[self.at]
            if kind == "comment":
                title = re.match(r"/\* ---- (.*?) *-{3,} *\*/|/\* ---- (.*?) *\*/", text)
                if title:
                    self.section = re.sub(r"[;,(].*", "", title.group(1) or title.group(2)).strip()
                    self.pending = ""
                else:
                    self.pending = plain(text)
                self.at += 1
            elif kind == "directive":
                self.directive(text)
                self.at += 1
            else:
                yield self.one()

    def directive(self, text):
        if re.match(r"#if", text):
            self.conditions.append(text)
        elif re.match(r"#endif", text):
            self.conditions.pop()
        elif re.match(r"#(else|elif)", text):
            self.conditions[-1] = "#else of " + self.conditions[-1]

    def one(self):
        doc, self.pending = self.pending, ""
        if doc or self.items[self.at][2] != self.group_ends + 1:
            self.group = doc
        doc = self.group
        taken, depth = [], 0
        while True:
            kind, text, line = self.items[self.at]
            self.at += 1
            taken.append((kind, text, line))
            if kind != "word":
                continue
            depth += text in "{(" and len(text) == 1
            depth -= text in "})" and len(text) == 1
            if text == ";" and depth == 0:
                break
        last = taken[-1][2]
        if self.at < len(self.items) and self.items[self.at][0] == "comment" and self.items[self.at][2] == last \
                and not self.items[self.at][1].startswith("/* ----"):
            after = plain(self.items[self.at][1])
            doc = (doc + " " + after).strip() if doc else after
            last += self.items[self.at][1].count("\n")
            self.at += 1
        self.group_ends = last
        condition = [c for c in self.conditions if "PERI_NO_" in c]
        return self.section, condition[-1] if condition else "", doc, taken


def words(taken):
    return [t[1] for t in taken if t[0] == "word"]


def notes(doc):
    """Unit, range, default and need that a comment on a member states."""
    out = {}
    unit = re.search(r"\[((?:[LMT](?:\^-?\d+)?(?: (?=[LMT]))?)+|-|s)\]", doc)
    if unit:
        out["unit"] = unit.group(1)
    if re.search(r"\bRequired\b", doc):
        out["required"] = True
    default = re.search(r"Default (NULL|NaN|HUGE_VAL|[-+.\w]*[\w])|\b([-+.\w]*\w) \(default\)", doc)
    if default:
        out["default"] = default.group(1) or default.group(2)
    limits = re.search(r"([\[(][-\w./ ]+, ?[-\w./ ]+[\])])|((?:>|>=) 0)\b", doc)
    if limits:
        out["range"] = limits.group(1) or limits.group(2)
    return out


# ---- types -----------------------------------------------------------------------------------------------------------

def declarator(parts):
    """(type, const, pointers, name, length) of "const double *lo" or "double place[3]"."""
    length = 0
    if parts[-1] == "]":
        length = int(parts[-2])
        parts = parts[:-3]
    name = parts[-1] if re.match(r"[a-z_]\w*$", parts[-1]) and len([p for p in parts if p not in ("const", "*")]) > 1 else ""
    rest = parts[:-1] if name else parts
    base = [p for p in rest if p not in ("const", "*", "struct", "PERI_API")]
    assert len(base) == 1, parts
    return {"name": name, "type": base[0], "const": "const" in rest, "pointer": rest.count("*"), "length": length}


def split(parts, at):
    out, one, depth = [], [], 0
    for p in parts:
        depth += (p in "([{") - (p in ")]}")
        if p == at and depth == 0:
            out.append(one)
            one = []
        else:
            one.append(p)
    return out + [one] if one else out


# ---- what each declaration becomes -----------------------------------------------------------------------------------

def members(taken, separator):
    """[(words, comment)] of what is between the braces."""
    out, one, depth, ended_line = [], [], 0, -1
    for kind, text, line in taken:
        if kind == "comment":
            if depth != 1:
                continue
            if one and not out or (one and ended_line != line):
                target = one  # a comment after the last enumerator, which has no comma
                out.append([target, plain(text)])
                one = []
            elif out:
                out[-1][1] = (out[-1][1] + " " + plain(text)).strip()
            continue
        if text == "{":
            depth += 1
            continue
        if text == "}":
            depth -= 1
            continue
        if depth != 1:
            continue
        if text == separator:
            if one:
                out.append([one, ""])
            one, ended_line = [], line
        else:
            one.append(text)
    if one:
        out.append([one, ""])
    return out


def lead(taken):
    """The comment right after the opening brace on its own line, which is of the whole."""
    seen = None
    for k, (kind, text, line) in enumerate(taken):
        if kind == "word" and text == "{":
            seen = line
            if k + 1 < len(taken) and taken[k + 1][0] == "comment" and taken[k + 1][2] == line:
                return plain(taken[k + 1][1]), taken[:k + 1] + taken[k + 2:]
            return "", taken
    return "", taken


def read_enum(name, doc, taken, api):
    first, taken = lead(taken)
    values = []
    for parts, comment in members(taken, ","):
        values.append({"name": parts[0], "value": int("".join(parts[2:]), 0), "doc": comment})
    if name:
        flags = "or-ed" in (first + doc)
        api["enums"].append({"name": name, "doc": (first + " " + doc).strip(), "flags": flags, "values": values})
    else:
        for value in values:
            api["constants"].append(value)


def read_struct(name, doc, taken, api):
    first, taken = lead(taken)
    fields = []
    for parts, comment in members(taken, ";"):
        field = declarator(parts)
        field["doc"] = comment
        field.update(notes(comment))
        entries = re.search(r"\[([a-z_]+(?:\*\w+)?)\](?:\[([\w +*]+)\])?", comment)
        if field["pointer"] and entries:
            field["entries"] = entries.group(1) + ("*(" + entries.group(2) + ")" if entries.group(2) else "")
        fields.append(field)
    api["structs"].append({"name": name, "doc": (first + " " + doc).strip(), "fields": fields})


def read_callback(doc, taken, api):
    parts = words(taken)
    at = parts.index("(")
    name = parts[at + 2]
    api["callbacks"].append({"name": name, "doc": doc, "returns": declarator(parts[1:at])["type"] if parts[1:at] != ["void", "*"] else "void *",
                             "params": params(parts[at + 4:-1])})


def params(parts):
    inside = parts[1:-1] if parts[0] == "(" else parts
    if inside in (["void"], []):
        return []
    return [declarator(p) for p in split(inside, ",")]


# What neither text nor names say.
LENGTHS = {
    ("peri_get_outline", "vertices"): "vertex_capacity*dim",
    ("peri_get_outline", "faces"): "face_capacity*dim",
    ("peri_get_outline", "owners"): "face_capacity",
    ("peri_get_outline", "inner"): "face_capacity",
    ("peri_size_of_outline", "vertices"): "1",
    ("peri_size_of_outline", "faces"): "1",
    ("peri_prescribe_rigid", "motion"): "dim+turns",
    ("peri_rigid_fn", "motion"): "dim+turns",
    ("peri_motion_fn", "turn"): "3*dim-5",  # 1 in 2D, 4 in 3D
    ("peri_distance_fn", "distance"): "1",
}
NUMBERS = ("double", "float", "int32_t", "int64_t", "uint32_t", "uint64_t")


def length(function, p, arguments, doc):
    """How many entries an array has: an expression of dim, turns (1 in 2D, 3 in 3D), points, width (of the families), other arguments."""
    known = LENGTHS.get((function, p["name"]))
    if known:
        return known
    for said in re.finditer(r"\b" + p["name"] + r"`? ?\[([\w*+]+)\](?:,? (?:\(2D\) or|in 2D) \[[13]\])?", doc):
        if "2D" in said.group() or said.group(1) == "1":
            return "turns"
        if not re.fullmatch(r"[a-z](\+1)?|\d+", said.group(1)):  # out[k] is one of them
            return said.group(1)
    names = [q["name"] for q in arguments]
    counted = re.search(r"\[(count\*\w+)\]", doc)
    if p["const"] and "count" in names:
        return counted.group(1) if counted and p["type"] != "char" else "count"
    if p["const"]:
        return "dim"
    if p["type"] in NUMBERS and "count" in names and "capacity" not in names:
        return "count"
    return "capacity" if "capacity" in names else "1"


def is_optional(function, p, doc):
    if (function, p["name"]) in (
            ("peri_set_contact", "desc"), ("peri_prescribe_rigid", "motion"), ("peri_export_frame", "fields")) or (
            function.startswith("peri_select_") and p["name"] == "name"):
        return True
    name = r"\b" + p["name"] + r"\b"
    return bool(p["role"] in ("user", "callback") or re.search(name + r"(\[[^\]]*\])?[^.;:]{0,25}\bNULL\b", doc)
                or (p["role"].endswith("out") and re.search(r"([Ee]ither|[Aa]ny) may be NULL", doc)))


def roles(api):
    """What each argument is for, once all types are known."""
    kinds = {k: {x["name"] for x in api[k]} for k in ("enums", "structs", "callbacks", "opaque")}
    enum_of = {v["name"]: e["name"] for e in api["enums"] for v in e["values"]}
    for s in api["structs"]:
        for field in s["fields"]:
            if field["type"] == "int32_t":
                named = [n for n in re.findall(r"\bpe" r"ri_\w+\b", field["doc"], re.I) if n in kinds["enums"] or n in enum_of]
                if named:
                    field["enum"] = enum_of.get(named[0], named[0])
    for f in api["functions"] + api["callbacks"]:
        for p in f["params"]:
            stem = {"axes": "axis"}.get(p["name"], p["name"])
            if p["type"] in kinds["opaque"]:
                p["role"] = "handle" if p["pointer"] == 1 else "new handle"
            elif p["type"] in kinds["callbacks"]:
                p["role"] = "callback"
            elif p["type"] in kinds["structs"]:
                p["role"] = "struct in" if p["const"] else "struct out"
                p["entries"] = length(f["name"], p, f["params"], f["doc"]) if not p["const"] else "1"
            elif p["type"] == "void" and p["pointer"] == 2:
                p["role"] = "value" # addresses: what is there is for the caller to know
            elif p["type"] == "void" and p["pointer"]:
                p["role"] = "user" if p["name"] in ("user", "context") else "bytes"
            elif p["type"] == "char":
                p["role"] = "text" if p["const"] else "text out"
            elif p["pointer"] and p["type"] in NUMBERS:
                p["role"] = "array in" if p["const"] else "array out"
                p["entries"] = length(f["name"], p, f["params"], f["doc"])
            else:
                p["role"] = "value"
                if "pe" "ri_" + stem in kinds["enums"]:
                    p["enum"] = "pe" "ri_" + stem
            if p["role"] not in ("handle", "new handle", "value") and is_optional(f["name"], p, f["doc"]):
                p["optional"] = True
        f["result"] = ("text" if f["returns"] == "const char *" else "none" if f["returns"] == "void" else
                       "number" if f["returns"] == "double" else "pointer" if "*" in f["returns"] else "count or status")


def read_function(section, condition, doc, taken, api):
    parts = words(taken)[1:-1]
    at = parts.index("(")
    returned = parts[:at - 1]
    name = parts[at - 1]
    arguments = params(parts[at:])
    function = {"name": name, "section": section, "doc": doc,
                "returns": " ".join(p for p in returned if p != "PERI_API"), "params": arguments}
    if condition:
        function["unless"] = re.search(r"PERI_NO_\w+", condition).group()
    api["functions"].append(function)


def read(text):
    text = text[text.index("#define PERI_VERSION "):text.index("#endif /* PERI_H */")]
    api = {"constants": [], "enums": [], "structs": [], "callbacks": [], "functions": []}
    for name, value in re.findall(r"^#define (PERI_VERSION\w*) +(\S+)", text, re.M):
        api["constants"].append({"name": name, "value": json.loads(value), "doc": ""})
    text = re.sub(r'extern "C" \{|^\}$', "", text, flags=re.M)
    opaque = []
    for section, condition, doc, taken in Reader(text).declarations():
        parts = words(taken)
        if parts[:2] == ["typedef", "enum"]:
            read_enum(parts[2], doc, taken, api)
        elif parts[0] == "enum":
            read_enum("", doc, taken, api)
        elif parts[:2] == ["typedef", "struct"] and "{" not in parts:
            opaque.append({"name": parts[2], "doc": doc})
        elif parts[:2] == ["typedef", "struct"]:
            read_struct(parts[2], doc, taken, api)
        elif parts[0] == "typedef":
            read_callback(doc, taken, api)
        else:
            read_function(section, condition, doc, taken, api)
    api["opaque"] = opaque
    return api


def sizes(api):
    """A C program that prints {"pointer": bytes, "structs": {name: {"size": n, "fields": {name: [offset, size]}}}}."""
    lines = ['#include "peri.h"', "#include <stdio.h>", "int main(void) {", '    printf("{\\"pointer\\": %u, \\"structs\\": {", (unsigned)sizeof(void *));']
    for k, s in enumerate(api["structs"]):
        lines.append('    printf("%s\\"%s\\": {\\"size\\": %%u, \\"fields\\": {", (unsigned)sizeof(%s));' % (", " if k else "", s["name"], s["name"]))
        for n, f in enumerate(s["fields"]):
            lines.append('    printf("%s\\"%s\\": [%%u, %%u]", (unsigned)offsetof(%s, %s), (unsigned)sizeof(((%s *)0)->%s));'
                         % (", " if n else "", f["name"], s["name"], f["name"], s["name"], f["name"]))
        lines.append('    printf("}}");')
    return "\n".join(lines + ['    printf("}}\\n");', "    return 0;", "}", ""])


# Bytes of a pointer, and what numbers of 8 bytes are aligned to.
TARGETS = {"x86-64": (8, 8), "aarch64": (8, 8), "i386": (4, 4), "wasm32": (4, 8)}


def layout(api, target):
    """{struct: (size, alignment, {field: (offset, size)})} by the rules that C compilers share: each field at the next multiple of its
    alignment."""
    pointer, wide = TARGETS[target]
    basic = {"double": (8, wide), "int64_t": (8, wide), "uint64_t": (8, wide), "float": (4, 4), "int32_t": (4, 4), "uint32_t": (4, 4)}
    callbacks = {c["name"] for c in api["callbacks"]}
    out = {}
    for s in api["structs"]:
        at, most, fields = 0, 1, {}
        for f in s["fields"]:
            if f["pointer"] or f["type"] in callbacks:
                size, align = pointer, pointer
            else:
                size, align = basic[f["type"]] if f["type"] in basic else out[f["type"]][:2]
            at = -(-at // align) * align
            fields[f["name"]] = (at, size * (f["length"] or 1))
            at += size * (f["length"] or 1)
            most = max(most, align)
        out[s["name"]] = (-(-at // most) * most, most, fields)
    return out


def asserted(api, target):
    lines = ['#include "peri.h"']
    for name, (size, _, fields) in layout(api, target).items():
        tests = ["sizeof(%s) == %d" % (name, size)]
        tests += ["offsetof(%s, %s) == %d && sizeof(((%s *)0)->%s) == %d" % (name, f, at, name, f, n) for f, (at, n) in fields.items()]
        lines += ["typedef char %s_%d[%s ? 1 : -1];" % (name, k, t) for k, t in enumerate(tests)]
    return "\n".join(lines) + "\n"


def text_of(api):
    """JSON with an entry a line: differences are then read as such."""
    out = ["{"]
    for k, (name, entries) in enumerate(api.items()):
        out.append(" " + json.dumps(name) + ": [")
        for n, entry in enumerate(entries):
            inner = next((m for m in ("values", "fields", "params") if entry.get(m)), None)
            comma = "," if n + 1 < len(entries) else ""
            if not inner:
                out.append("  " + json.dumps(entry) + comma)
                continue
            head = json.dumps({m: v for m, v in entry.items() if m != inner})
            out.append("  " + head[:-1] + ", " + json.dumps(inner) + ": [")
            out += ["   " + json.dumps(one) + ("," if j + 1 < len(entry[inner]) else "") for j, one in enumerate(entry[inner])]
            out.append("  ]}" + comma)
        out.append(" ]" + ("," if k + 1 < len(api) else ""))
    return "\n".join(out + ["}", ""])


def load():
    with open(HEADER) as f:
        api = read(f.read())
    roles(api)
    return api


# Handles that join several others: classes that hold others alive are written by hand (Python's World), or left to the functions of C.
JOINING = ("peri_world",)


def without_joining(api):
    out = dict(api)
    for kind in ("functions", "structs", "opaque"):
        out[kind] = [entry for entry in api[kind] if not entry["name"].startswith(JOINING)]
    return out


def main(arguments):
    api = load()
    if "--sizes" in arguments:
        sys.stdout.write(sizes(api))
        return 0
    if "--layout" in arguments:
        sys.stdout.write(asserted(api, arguments[arguments.index("--layout") + 1]))
        return 0
    text = text_of(api)
    assert json.loads(text) == api
    if "--check" in arguments:
        with open(OUT) as f:
            if f.read() == text:
                return 0
        print("bindings/api.json is not what peri.h says: make bindings")
        return 1
    with open(OUT, "w") as f:
        f.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
