# SPDX-License-Identifier: MIT
"""What the Python package has of peri.h, for test_python.py. SOURCES OF TRUTH: sizes and offsets that a compiled program prints, for this
machine and for i386; a header that the test adds to."""
import ctypes as C
import json
import os
import struct
import subprocess
import sys

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
sys.path.insert(0, os.path.join(ROOT, "tools"))
import api as header  # noqa: E402

api = header.load()


def layout(struct_of, api, words):
    """Offsets and sizes by the rules of C: each member at a multiple of its alignment."""
    known = {s["name"]: s for s in api["structs"]}
    offset, most, fields = 0, 1, {}
    for f in struct_of["fields"]:
        if f["pointer"] or f["type"] in {c["name"] for c in api["callbacks"]}:
            size = align = words["pointer"]
        elif f["type"] in known:
            size, align, _ = layout(known[f["type"]], api, words)
        else:
            size = struct.calcsize({"double": "d", "int32_t": "i", "int64_t": "q", "uint64_t": "Q"}[f["type"]])
            align = min(size, words["eight"])
        offset = -(-offset // align) * align
        fields[f["name"]] = [offset, size * (f["length"] or 1)]
        offset, most = offset + size * (f["length"] or 1), max(most, align)
    return -(-offset // most) * most, most, fields


def sizes(check, peri, compiler):
    out = os.path.join(ROOT, "build", "checks")
    os.makedirs(out, exist_ok=True)
    with open(os.path.join(out, "sizes.c"), "w") as f:
        f.write(header.sizes(api))
    for target, words in (("", None), ("-m32", {"pointer": 4, "eight": 4})):
        program = os.path.join(out, "sizes" + target)
        build = subprocess.run(compiler + ["-I" + ROOT] + target.split() + [os.path.join(out, "sizes.c"), "-o", program],
                               stderr=subprocess.DEVNULL)
        if build.returncode:
            print("    skip: no compiler%s here" % (" for " + target if target else ""))
            continue
        said = json.loads(subprocess.run([program], stdout=subprocess.PIPE).stdout)
        for s in api["structs"]:
            theirs = said["structs"][s["name"]]
            if words:
                size, _, fields = layout(s, api, words)
                check(size == theirs["size"] and fields == theirs["fields"], "%s%s: %s" % (s["name"], target, theirs))
                continue
            cls = getattr(peri, "".join(w.capitalize() for w in s["name"].split("_")[1:]))
            mine = {n.lstrip("_"): [getattr(cls, n).offset, getattr(cls, n).size] for n, _ in cls._fields_}
            check(C.sizeof(cls) == theirs["size"] and mine == theirs["fields"], "%s: %s, in C %s" % (s["name"], mine, theirs))
    mine = {n: getattr(peri._core._ErrorRecord, n).offset for n, _ in peri._core._ErrorRecord._fields_}
    check(mine == {f: at for f, (at, _) in layout(next(s for s in api["structs"] if s["name"] == "peri_error"), api, {
        "pointer": C.sizeof(C.c_void_p), "eight": 8})[2].items()}, "the record of errors")


ADDED = {  # after this text of peri.h: this
    "    double stabilization;": "    double novelty;          /* [L T^-1] >= 0. Default 0.5 */\n",
    "PERI_API int32_t peri_add_material(": "PERI_API double peri_novel_number(const peri_body *body);\n"
                                           "PERI_API int64_t peri_size_of_novelty(const peri_body *body, int32_t set);\n"
                                           "/* Novelty [L] of a set. */\n"
                                           "PERI_API int32_t peri_get_novelty(peri_body *body, int32_t set, double *out,\n"
                                           "    int64_t capacity);\n\n"
                                           "PERI_API int32_t peri_add_novelty(peri_body *body, int64_t count, const double *where,\n"
                                           "    peri_load_fn fn, void *user);\n\n",
    "    PERI_ERROR_STATE = -38": "    PERI_ERROR_NOVEL = -99, /* too new */\n",
    "    PERI_FIELD_POSITION = 2001,": "    PERI_FIELD_NOVELTY = 2999, /* SW [dim] as never seen */\n",
}


def added(check, peri, package):
    """A field, functions, a status and a field of the body in a copy of peri.h: the package has them, by no other change."""
    scratch = os.path.join(ROOT, "build", "checks", "python_added")
    os.makedirs(os.path.join(scratch, "peri"), exist_ok=True)
    with open(os.path.join(ROOT, "peri.h")) as f:
        text = f.read()
    for place, more in ADDED.items():
        check(text.count(place) == 1, "peri.h has %r %d times" % (place, text.count(place)))
        text = text.replace(place, more + place)
    os.makedirs(os.path.join(scratch, "tools"), exist_ok=True)
    for source, target in (("tools/api.py", "tools/api.py"), ("bindings/python/generate.py", "generate.py")):
        with open(os.path.join(ROOT, source)) as f, open(os.path.join(scratch, target), "w") as g:
            g.write(f.read())
    with open(os.path.join(scratch, "peri.h"), "w") as f:
        f.write(text)
    for name in os.listdir(os.path.join(package, "peri")):
        if name.endswith(".py"):
            with open(os.path.join(package, "peri", name)) as f, open(os.path.join(scratch, "peri", name), "w") as g:
                g.write(f.read())
    run = subprocess.run([sys.executable, os.path.join(scratch, "generate.py"), scratch, os.path.join(scratch, "peri", "_generated.py")])
    check(run.returncode == 0, "generate.py of a changed peri.h")
    program = """if 1:
        import inspect, os, peri
        signature = lambda f: list(inspect.signature(f).parameters)
        assert "novelty" in signature(peri.Body.add_material) and "novelty" in signature(peri.MaterialDesc)
        assert "novelty: [L T^-1] >= 0" in peri.Body.add_material.__doc__
        assert peri.MaterialDesc.novelty.offset == peri.MaterialDesc.stabilization.offset - 8
        assert isinstance(peri.Body.novel_number, property) and isinstance(peri.Body.novelty, property) and peri.Body.novelty.fset
        assert signature(peri.Body.get_novelty) == ["self", "set"] and "Novelty [L] of a set." in peri.Body.get_novelty.__doc__
        assert signature(peri.Body.add_novelty) == ["self", "where", "fn"]
        assert issubclass(peri.NovelError, peri.PeriError) and peri.Field.NOVELTY == 2999
        print("all there")
    """
    library = next(os.path.join(package, "peri", n) for n in os.listdir(os.path.join(package, "peri")) if n.startswith("libperi"))
    run = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                         env=dict(os.environ, PYTHONPATH=scratch, PERI_LIBRARY=os.path.abspath(library)))
    check(run.stdout.strip() == "all there", run.stdout)
    functions = [f["name"] for f in api["functions"] if not f["name"].endswith(("_init", "_destroy", "_create"))]
    everywhere = {n for c in (peri, peri.Body, peri.Cracks, peri.Matrix, peri.World) for n in dir(c)}
    missing = [f for f in functions if not {f[5:], f[5:].replace("body_", ""), f[5:].replace("cracks_", ""), f[5:].replace("matrix_", ""),
                                            f[5:].replace("_cracks", ""), f[5:].replace("_matrix", ""),
                                            f[5:].replace("world_", "")} & everywhere]
    check(missing == ["peri_format_error", "peri_unlock", "peri_get_error", "peri_world_get_error"], "functions that Python lacks: %s" % missing)
    undocumented = [n for n in dir(peri.Body) if not n.startswith("_") and not getattr(peri.Body, n).__doc__]
    check(not undocumented, "without a docstring: %s" % undocumented)
