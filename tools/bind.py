#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bind.py - bindings of other languages, made from peri.h (tools/api.py reads it, tools/bind/model.py says what is a method of what).

  bind.py           writes them (make bindings)
  bind.py --check   ends with 1 where one is not what peri.h says, or lacks a name of it: functions, structs and fields, enumerators
  bind.py --list    the files that it writes
  bind.py --sizes D into folder D: sizes.c, .rs, .lua, .f90: programs that print "struct size" and "struct.field offset", a line each;
                    sizes.jl: those lines of the types in Peri.jl; TARGET.c: compiles where layouts are as tools/api.py says"""
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..")
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(HERE, "bind"))
import model as models  # noqa: E402

LANGUAGES = ("cpp", "rust", "lua", "fortran", "julia")


def made():
    out = {}
    for language in LANGUAGES:
        out.update(__import__(language).files(models.load()))
    return out


def lacking(name, text, api):
    """Names of peri.h that are not in a binding; those that it replaces by its own means are left out."""
    words = {w.lower() for w in re.findall(r"[A-Za-z_]\w*", text)}
    out = []
    for f in api["functions"]:
        if not ({f["name"], f["name"][5:], "c_" + f["name"][5:]} & words):
            out.append(f["name"])
    for s in api["structs"]:
        if s["name"] not in words and s["name"][5:].replace("_", "") not in words:
            out.append(s["name"])
        if "peri.hpp" in name or "/peri/src" in name:
            continue  # derived from those of C
        out += ["%s.%s" % (s["name"], f["name"]) for f in s["fields"] if f["name"] not in words]
    if "peri.hpp" not in name:
        out += [v["name"] for e in api["enums"] for v in e["values"] if not {v["name"].lower(), v["name"][5:].lower()} & words]
    return out


def sizes(language, api):
    fields = [(s["name"], [f["name"] for f in s["fields"]]) for s in api["structs"]]
    if language == "c":
        lines = ['#include "peri.h"', "#include <stdio.h>", "int main(void) {"]
        for s, names in fields:
            lines.append('    printf("%s %%ld\\n", (long)sizeof(%s));' % (s, s))
            lines += ['    printf("%s.%s %%ld\\n", (long)offsetof(%s, %s));' % (s, f, s, f) for f in names]
        return "\n".join(lines + ["    return 0;", "}"])
    if language == "rust":
        lines = ["use peri_sys as sys;", "fn main() {"]
        for s, names in fields:
            lines.append('    println!("%s {}", std::mem::size_of::<sys::%s>());' % (s, s))
            lines += ['    println!("%s.%s {}", std::mem::offset_of!(sys::%s, %s));' % (s, f, s, "r#type" if f == "type" else f) for f in names]
        return "\n".join(lines + ["}"])
    if language == "lua":
        lines = ['local ffi = require "ffi"', 'require "peri"']
        for s, names in fields:
            lines.append('print("%s " .. ffi.sizeof("%s"))' % (s, s))
            lines += ['print("%s.%s " .. ffi.offsetof("%s", "%s"))' % (s, f, s, f) for f in names]
        return "\n".join(lines)
    if language == "fortran":
        lines = ["program sizes", "use peri_c", "implicit none"]
        lines += ["type(%s), target :: s%d" % (s, k) for k, (s, _) in enumerate(fields)]
        for k, (s, names) in enumerate(fields):
            lines.append("print '(a, i0)', '%s ', c_sizeof(s%d)" % (s, k))
            lines += ["print '(a, i0)', '%s.%s ', transfer(c_loc(s%d%%%s), 0_c_intptr_t) - transfer(c_loc(s%d), 0_c_intptr_t)" % (s, f, k, f, k)
                      for f in names]
        return "\n".join(lines + ["end program"])
    with open(os.path.join(ROOT, "bindings", "julia", "Peri.jl"), encoding="utf-8") as f:
        structs = re.findall(r"^(?:mutable )?struct (peri_\w+)\n(.*?)^end", f.read(), re.M | re.S)
    known, lines = {"Float64": (8, 8), "Int64": (8, 8), "UInt64": (8, 8), "Int32": (4, 4)}, []
    for s, body in structs:
        at, most, offsets = 0, 1, []
        for name, kind in re.findall(r"^    (\w+)::([\w{},]+)", body, re.M):
            many = re.match(r"NTuple{(\d+),(\w+)}", kind)
            size, align = known[many.group(2)] if many else (8, 8) if kind.startswith("Ptr{") else known[kind]
            at = -(-at // align) * align
            offsets.append("%s.%s %d" % (s, name, at))
            at, most = at + size * (int(many.group(1)) if many else 1), max(most, align)
        known[s] = (-(-at // most) * most, most)
        lines += ["%s %d" % (s, known[s][0])] + offsets
    return "\n".join(lines)


def main(arguments):
    status = 0
    if "--sizes" in arguments:
        folder, api = arguments[arguments.index("--sizes") + 1], models.load().api
        written = {"sizes." + e: sizes(l, api) + "\n" for l, e in (("c", "c"), ("rust", "rs"), ("lua", "lua"), ("fortran", "f90"), ("julia", "jl"))}
        written.update({t + ".c": models.reader.asserted(api, t) for t in models.reader.TARGETS})
        for name, text in written.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as f:
                f.write(text)
        return 0
    api = models.load().api
    for name, text in made().items():
        path = os.path.join(ROOT, name)
        if "--list" in arguments:
            print(name)
        elif "--check" in arguments:
            missing = lacking(name, text, api)
            if missing:
                print("%s lacks %d names: %s" % (name, len(missing), " ".join(missing[:8])))
                status = 1
            if not os.path.exists(path) or open(path, encoding="utf-8").read() != text:
                print("%s is not what peri.h says: make bindings" % name)
                status = 1
        else:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as f:
                f.write(text)
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
