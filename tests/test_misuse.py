#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The rows of misuse.h through a foreign function interface: python3 tests/test_misuse.py path/to/libperi.so path/to/test_misuse

Reads peri.h for what calls, structures and constants there are, asks `test_misuse --rows` for the rows, and tries each as the C program
does: status, field and value as there, and nothing has changed. SOURCE OF TRUTH: the rows, see misuse.h. No packages beyond Python.
"""
import ctypes as C
import os
import re
import subprocess
import sys

SCALARS = {"int32_t": C.c_int32, "int64_t": C.c_int64, "uint64_t": C.c_uint64, "double": C.c_double, "void": None}


def number(text):
    """As C writes it: whole in any base, or not."""
    try:
        return float(int(text, 0))
    except ValueError:
        return float(text)


def header(path):
    """peri.h without comments and what the preprocessor reads."""
    with open(path, encoding="ascii") as file:
        text = re.sub(r"/\*.*?\*/", " ", file.read(), flags=re.S)
    constants = {name: eval(value) for name, value in re.findall(r"enum \{ (PERI_ALL) = (\w+) \};", text)}
    text = re.sub(r"^#.*$", " ", text, flags=re.M)
    for body in re.findall(r"typedef enum \w+ \{(.*?)\}", text, flags=re.S):
        for name, value in re.findall(r"(\w+) = (-?\w+)", body):
            constants[name] = int(value, 0)
    return re.sub(r"\s+", " ", text), constants


def type_of(text):
    """Of a parameter, a member or a result: every pointer and callback but text is an address."""
    text = text.replace("const ", "").strip()
    if text.startswith("char *"):
        return C.c_char_p
    return C.c_void_p if "*" in text or text.split()[0].endswith("_fn") else SCALARS[text.split()[0]]


def declare(lib, text):
    """The types of the calls; returns their names."""
    names = []
    for result, name, parameters in re.findall(r"PERI_API ([\w ]+\*?) ?(peri_\w+)\(([^)]*)\);", text):
        function = getattr(lib, name)
        function.restype = type_of(result)
        function.argtypes = [] if parameters == "void" else [type_of(p) for p in parameters.split(",")]
        names.append(name)
    return names


def structures(text):
    found = {}
    for name, body in re.findall(r"typedef struct (peri_\w+) \{(.*?)\} \w+;", text):
        fields = []
        for member in body.split(";"):
            match = re.match(r" *(.*?[ *])(\w+)(?:\[(\d+)\])?$", member.rstrip())
            if not match:
                continue
            kind, member_name, count = match.groups()
            kind = found[kind.strip()] if kind.strip() in found else type_of(kind)
            fields.append((member_name, kind * int(count) if count else kind))
        found[name] = type(name, (C.Structure,), {"_fields_": fields})
    return found


def callback(answer, *arguments):
    return C.CFUNCTYPE(C.c_int32, C.c_void_p, *arguments)(answer)


class Scene:
    """The names that the rows are written with, as test_misuse.c makes them."""

    def __init__(self, lib, calls, types, constants):
        doubles, ints = lambda *v: (C.c_double * len(v))(*v), lambda *v: (C.c_int32 * len(v))(*v)
        point, pair = (C.c_int64, C.c_void_p), (C.c_int32, C.c_int32, C.c_void_p, C.c_void_p)
        self.lib, self.constants, self.failures = lib, constants, []
        self.made, self.record = C.c_void_p(), types["peri_error"]()
        nan = float("nan")
        self.names = dict(
            constants, NULL=None, small=doubles(1e-3, 0, 0), up=doubles(0, 1, 0), up3=doubles(0, 0, 1), lo=doubles(0, 0, 0),
            hi=doubles(6, 4, 3), coords=doubles(0, 0, 1, 0), volumes=doubles(1, 1), nans=doubles(nan, nan, nan),
            out=(C.c_double * 500)(), sevens=ints(7, 7), pair=ints(0, 1), far_pair=ints(0, 23), wrong_points=ints(0, -1),
            ints=(C.c_int32 * 500)(), made=C.byref(self.made), error=self.record, plan=types["peri_plan_report"](),
            choice=types["peri_choose_report"](), view=types["peri_view"](), bd=types["peri_body_desc"](),
            md=types["peri_material_desc"](), ad=types["peri_advance_desc"](), sd=types["peri_solve_desc"](),
            pd=types["peri_plan_desc"](), cd=types["peri_choose_desc"](), kd=types["peri_contact_desc"](),
            od=types["peri_obstacle_desc"](), state=types["peri_obstacle_state"](),
            take_all=callback(lambda user, index, x: 1, *point), take_none=callback(lambda user, index, x: 0, *point),
            fail_point=callback(lambda user, index, x: -7 if index == 5 else 1, *point),
            cut_all=callback(lambda user, i, j, xi, xj: 1, *pair),
            fail_pair=callback(lambda user, i, j, xi, xj: -7 if i == 5 else 1, *pair),
            write_none=callback(lambda user, count, size: 1, C.c_void_p, C.c_int64))
        for name in calls:
            self.names[name] = self.caller(name)
        self.memory = types["peri_memory"]()
        self.make_all()

    def caller(self, name):
        function = getattr(self.lib, name)

        def call(*arguments):
            return function(*[a.encode() if isinstance(a, str) else C.cast(a, C.c_void_p) if isinstance(a, C._CFuncPtr) else
                              C.addressof(a) if isinstance(a, (C.Structure, C.Array)) else a for a in arguments])
        return call

    def run(self, text, **more):
        return eval(text, {"__builtins__": {}}, dict(self.names, **more))

    def must(self, text, **more):
        result = self.run(text, **more)
        if result is not None and result < 0:
            self.failures.append("%s: %d" % (text, result))
        return result

    def good_settings(self):
        n, c = self.names, self.constants
        self.lib.peri_body_desc_init(C.addressof(n["bd"]))
        n["bd"].space, n["bd"].horizon = c["PERI_SPACE_PLANE_STRESS"], 2.2
        self.lib.peri_material_desc_init(C.addressof(n["md"]), c["PERI_LAW_BOND_BASED"])
        n["md"].young = n["md"].density = 1
        self.lib.peri_advance_desc_init(C.addressof(n["ad"]))
        n["ad"].steps = 2
        self.lib.peri_solve_desc_init(C.addressof(n["sd"]))
        self.lib.peri_contact_desc_init(C.addressof(n["kd"]))
        self.lib.peri_plan_desc_init(C.addressof(n["pd"]))
        n["pd"].body, n["pd"].material, n["pd"].spacing = C.addressof(n["bd"]), C.addressof(n["md"]), 1
        n["pd"].hi[0] = n["pd"].hi[1] = 6
        self.lib.peri_choose_desc_init(C.addressof(n["cd"]))
        n["cd"].preset, n["cd"].quantity = c["PERI_PRESET_TEACHING"], c["PERI_QUANTITY_DEFORMATION"]
        n["cd"].feature, n["cd"].hi[0], n["cd"].hi[1] = 1, 6, 6
        self.lib.peri_obstacle_desc_init(C.addressof(n["od"]), c["PERI_SHAPE_PLANE"])
        n["od"].place[1], n["od"].normal[1] = -1, 1

    def begin(self, number, space):
        body = C.c_void_p()
        self.good_settings()
        self.names["bd"].number, self.names["bd"].space = number, self.constants[space]
        self.must("peri_body_create(bd, body, NULL)", body=C.byref(body))
        return body

    def build(self, number, space):
        body = self.begin(number, space)
        material = self.must("peri_add_material(body, md)", body=body)
        self.must("peri_add_box(body, id, lo, hi, 1)", body=body, id=material)
        self.must("peri_build(body)", body=body)
        return body, material

    def load_body(self, body):
        left = (C.c_double * 2)(2, 4)
        its = [self.must("peri_select_box(body, 'left', lo, left)", body=body, left=left)]
        its.append(self.must("peri_apply_body_force(body, set, small, NULL, NULL)", body=body, set=its[0]))
        its.append(self.must("peri_prescribe_velocity(body, set, PERI_AXIS_X, NULL, NULL, NULL)", body=body, set=its[0]))
        its.append(self.must("peri_add_obstacle(body, od)", body=body))
        its.append(self.must("peri_apply_body_force(body, PERI_ALL, small, NULL, NULL)", body=body))
        its.append(self.must("peri_add_obstacle(body, od)", body=body))
        self.must("peri_remove_load(body, load)", body=body, load=its[4])
        self.must("peri_remove_obstacle(body, wall)", body=body, wall=its[5])
        return its

    def make_all(self):
        n, plane = self.names, "PERI_SPACE_PLANE_STRESS"
        n["b"], n["material"] = self.build(1, plane)
        n["set"], n["load"], n["support"], n["wall"], n["gone_load"], n["gone_wall"] = self.load_body(n["b"])
        self.must("peri_advance(b, ad)")
        n["other"], n["its_material"] = self.build(2, plane)
        n["its_set"], n["its_load"], _, n["its_wall"], _, _ = self.load_body(n["other"])
        n["draft"] = self.begin(3, plane)
        n["draft_material"] = self.must("peri_add_material(draft, md)")
        self.must("peri_add_material(draft, md)")
        self.must("peri_add_box(draft, draft_material, lo, hi, 1)")
        n["bare"] = self.begin(4, plane)
        n["full"] = self.begin(5, plane)
        for _ in range(120):
            self.must("peri_add_material(full, md)")
        n["solid"], _ = self.build(6, "PERI_SPACE_SOLID")

    def digest(self):
        """All that the bodies hold and show."""
        shown = []
        for name in ("b", "draft", "bare", "full", "solid"):
            body = self.names[name]
            self.must("peri_get_memory(body, memory)", body=body, memory=self.memory)
            shown.append(self.memory.total)
            shown += [self.run("peri_%s_count(body)" % of, body=body) for of in ("point", "bond", "cut", "broken", "step")]
            for kind in range(2201, 2205):
                index = 1
                while self.run("peri_id(body, kind, index)", body=body, kind=kind, index=index) > 0:
                    index += 1
                shown.append(index)
            for field in range(2001, 2017) if self.run("peri_family_width(body)", body=body) > 0 else ():
                self.must("peri_get_field(body, field, out, 500)", body=body, field=field)
                size = self.run("peri_size_of_field(body, field)", body=body, field=field)
                shown.append(bytes(self.names["out"])[:8 * size])
        return shown

    def attempt(self, row):
        """What is wrong with a row, or None."""
        whose, status, field, value, settings, member, setting, call = row
        self.good_settings()
        self.record.code, self.record.field = 0, b""
        if settings:
            setattr(self.names[settings], member, self.run(setting))
        result = self.run(call)
        e = self.record
        if whose in ("b", "draft", "bare", "full", "solid"):
            self.must("peri_get_error(body, error)", body=self.names[whose])
        told = result == int(status) and not self.made.value
        if whose != "NONE":
            told = told and e.code == result and e.field.decode() == field and (value == "ANY" or e.value == number(value))
        return None if told else "%s %s: %d, %s, %g; expected %s, %s, %s" % (member, call, result, e.field, e.value, status, field, value)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    text, constants = header(os.path.join(os.path.dirname(__file__), "..", "peri.h"))
    lib = C.CDLL(os.path.abspath(sys.argv[1]))
    scene = Scene(lib, declare(lib, text), structures(text), constants)
    rows = subprocess.run([sys.argv[2], "--rows"], stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout.splitlines()
    wrong, before = list(scene.failures), scene.digest()
    for row in rows:
        told = scene.attempt(row.split("\t"))
        after = scene.digest()
        if told or after != before:
            wrong.append(told or "%s: it has changed something" % row)
        before = after
    for line in wrong[:10]:
        print("    " + line)
    failed = bool(wrong or scene.failures or len(rows) < 60)
    print("    %d rows" % len(rows))
    print("test_misuse.py: %d passed, %d failed" % (not failed, failed))
    sys.exit(failed)


main()
