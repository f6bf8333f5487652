#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The library through a foreign function interface: python3 tests/test_ctypes.py path/to/libperi.so path/to/ctypes_scene

Runs the scene of ctypes_scene.c through ctypes, callbacks in Python included, and compares every number with what the C
program prints. SOURCE OF TRUTH: the C program, linked against the same library: exact equality. No packages beyond Python.
"""
import ctypes as C
import subprocess
import sys

ALLOC = C.CFUNCTYPE(C.c_void_p, C.c_void_p, C.c_uint64)
RELEASE = C.CFUNCTYPE(None, C.c_void_p, C.c_void_p, C.c_uint64)
LOAD = C.CFUNCTYPE(C.c_int32, C.c_void_p, C.c_double, C.c_int64, C.POINTER(C.c_int32), C.POINTER(C.c_double))
FRAME = C.CFUNCTYPE(C.c_int32, C.c_void_p, C.c_void_p)
ITERATION = C.CFUNCTYPE(C.c_int32, C.c_void_p, C.c_int64, C.c_double)
BREAK = C.CFUNCTYPE(C.c_int32, C.c_void_p, C.c_int32, C.c_int32, C.c_double, C.c_double)
PLANE_STRESS, BOND_BASED, CUT_INITIAL, AXIS_XY = 101, 1001, 2101, 0x1003
DISPLACEMENT, VELOCITY, FAMILY_SIZE, DAMAGE = 2002, 2003, 2007, 2008
KIND_LOAD = 2203


class Error(C.Structure):
    _fields_ = [("code", C.c_int32), ("reserved", C.c_int32), ("index", C.c_int64), ("value", C.c_double),
                ("field", C.c_char_p), ("text", C.c_char_p)]


class BodyDesc(C.Structure):
    _fields_ = ([("cookie", C.c_uint64)]
                + [(n, C.c_int32) for n in ("space", "precision", "geometry", "influence", "quadrature", "correction",
                                            "break_timing", "moments", "kernel", "instructions", "threads", "ledger",
                                            "number", "reserved")]
                + [("horizon", C.c_double), ("thickness", C.c_double)]
                + [(n, C.c_void_p) for n in ("influence_fn", "influence_user")]
                + [("allocate", ALLOC), ("release", RELEASE)]
                + [(n, C.c_void_p) for n in ("memory_user", "parallel_for", "parallel_user", "log", "log_user")])


class Material(C.Structure):
    _fields_ = ([("cookie", C.c_uint64), ("law", C.c_int32), ("criterion", C.c_int32)]
                + [(n, C.c_double) for n in ("young", "bulk", "poisson", "density", "fracture_energy", "critical_stretch",
                                            "stabilization", "strength", "cohesion", "friction_angle", "compression",
                                            "rate", "rate_power", "delay", "yield_shear")]
                + [("relaxations", C.c_int32), ("history", C.c_int32), ("relaxation_part", C.c_double * 4),
                   ("relaxation_time", C.c_double * 4), ("stress", C.c_void_p), ("stress_user", C.c_void_p)])


class Run(C.Structure):
    _fields_ = ([("cookie", C.c_uint64), ("integrator", C.c_int32), ("force_step", C.c_int32), ("steps", C.c_int64)]
                + [(n, C.c_double) for n in ("duration", "time_step", "safety", "damping", "load_factor")]
                + [("frame_steps", C.c_int64), ("on_frame", FRAME), ("user", C.c_void_p)])


class Statics(C.Structure):
    _fields_ = ([("cookie", C.c_uint64)]
                + [(n, C.c_int32) for n in ("method", "preconditioner", "loose", "fracture", "control", "curve_load", "keep", "reserved")]
                + [(n, C.c_double) for n in ("criticality", "tolerance", "energy_tolerance")]
                + [(n, C.c_int64) for n in ("iterations", "newton", "breaks")]
                + [("load_from", C.c_double), ("load_to", C.c_double), ("steps", C.c_int64), ("duration", C.c_double),
                   ("halvings", C.c_int64),
                   ("curve", C.POINTER(C.c_double)), ("curve_rows", C.c_int64),
                   ("on_iteration", ITERATION), ("on_step", FRAME), ("user", C.c_void_p)])


class Report(C.Structure):
    _fields_ = ([(n, C.c_int64) for n in ("iterations", "passes", "newton", "steps", "broken", "curve_rows", "loose", "lost_parts",
                                        "lost_points", "bytes")]
                + [("ended", C.c_int32), ("reserved", C.c_int32)]
                + [("residual", C.c_double), ("load_factor", C.c_double)])


class View(C.Structure):
    _fields_ = [("data", C.c_void_p), ("count", C.c_int64), ("point_stride", C.c_int64), ("component_stride", C.c_int64),
                ("components", C.c_int32), ("type", C.c_int32), ("scale", C.c_double), ("offset", C.c_double * 3)]


class Energy(C.Structure):
    _fields_ = [(n, C.c_double) for n in ("kinetic", "elastic", "contact", "external", "obstacle", "damping", "fracture", "initial",
                                          "error")]


class Memory(C.Structure):
    _fields_ = [(n, C.c_int64) for n in ("points", "families", "damage", "state", "laws", "loads", "fields", "total", "shared")]


class PlanDesc(C.Structure):
    _fields_ = [("cookie", C.c_uint64), ("body", C.POINTER(BodyDesc)), ("material", C.POINTER(Material)), ("source", C.c_int32),
                ("measure", C.c_int32), ("amount", C.c_double), ("lo", C.c_double * 3), ("hi", C.c_double * 3), ("spacing", C.c_double)]


class PlanReport(C.Structure):
    _fields_ = ([(n, C.c_int64) for n in ("points", "entries", "width", "columns", "bytes", "peak")]
                + [("stable_step", C.c_double), ("seconds", C.c_double)])


def doubles(*values):
    return (C.c_double * len(values))(*values)


def declare(lib):
    p, i32, i64, f64 = C.c_void_p, C.c_int32, C.c_int64, C.c_double
    signatures = {
        "peri_status_text": (C.c_char_p, [i32]), "peri_body_desc_init": (None, [p]), "peri_body_destroy": (None, [p]),
        "peri_body_create": (i32, [p, p, p]), "peri_get_error": (i32, [p, p]), "peri_material_desc_init": (None, [p, i32]),
        "peri_add_material": (i32, [p, p]), "peri_add_box": (i64, [p, i32, p, p, f64]), "peri_build": (i32, [p]),
        "peri_entry_count": (i64, [p]), "peri_cut_segment": (i64, [p, i32, p, p]), "peri_id": (i32, [p, i32, i64]),
        "peri_select_box": (i32, [p, C.c_char_p, p, p]), "peri_find_set": (i32, [p, C.c_char_p]),
        "peri_prescribe_displacement": (i32, [p, i32, i32, p, p, p]),
        "peri_apply_layer_traction": (i32, [p, i32, f64, p, LOAD, p]), "peri_set_no_fail": (i32, [p, i32, i32]),
        "peri_on_break": (i32, [p, BREAK, p]), "peri_stable_step": (f64, [p]), "peri_advance_desc_init": (None, [p]),
        "peri_advance": (i32, [p, p]), "peri_time": (f64, [p]), "peri_size_of_field": (i64, [p, i32]),
        "peri_get_field": (i32, [p, i32, p, i64]), "peri_get_energy": (i32, [p, p]), "peri_get_reaction": (i32, [p, i32, p]),
        "peri_view_field": (i32, [p, i32, p]), "peri_solve_desc_init": (None, [p]), "peri_solve": (i32, [p, p, p]),
        "peri_reset": (i32, [p]), "peri_get_memory": (i32, [p, p]), "peri_plan_desc_init": (None, [p]), "peri_plan": (i32, [p, p, p])}
    for name, (result, arguments) in signatures.items():
        function = getattr(lib, name)
        function.restype, function.argtypes = result, arguments


def scene(lib):
    """The numbers of ctypes_scene.c, in its order; and what failed on the way."""
    out, counts = [], {"load": 0, "frame": 0, "break": 0}
    failures = []

    def must(result):
        if result < 0:
            failures.append(lib.peri_status_text(result).decode())
        return result

    @LOAD
    def pull(_user, time, count, points, value):
        counts["load"] += 1
        for i in range(count):
            value[2 * i] = value[2 * i] * (1.0 + 0.25 * time) + points[i] * 0.0001
        return 0

    @FRAME
    def on_frame(_user, handle):
        counts["frame"] += 1
        u = (C.c_double * (2 * 96))()
        must(lib.peri_get_field(handle, DISPLACEMENT, u, 2 * 96))
        out.extend([lib.peri_time(handle), u[2 * 95]])
        return 0

    @BREAK
    def on_break(_user, i, j, time, stretch):
        counts["break"] += 1
        out.extend([i, j, time, stretch])
        return 0

    out += [C.sizeof(s) for s in (Error, BodyDesc, Material, Run, View, Energy)]
    out += [BodyDesc.horizon.offset, BodyDesc.log_user.offset, Run.on_frame.offset]
    d, m, run, e, view, error, body = BodyDesc(), Material(), Run(), Energy(), View(), Error(), C.c_void_p()
    lib.peri_body_desc_init(C.byref(d))
    out += [d.precision, d.thickness]
    d.space, d.horizon, d.thickness = PLANE_STRESS, 0.3, 0.5
    must(lib.peri_body_create(C.byref(d), C.byref(body), C.byref(error)))
    lib.peri_material_desc_init(C.byref(m), BOND_BASED)
    m.young, m.density, m.critical_stretch = 3, 2, 0.02
    stuff = must(lib.peri_add_material(body, C.byref(m)))
    out.append(must(lib.peri_add_box(body, stuff, doubles(0, 0), doubles(1.6, 0.6), 0.1)))
    must(lib.peri_build(body))
    out.append(lib.peri_entry_count(body))
    out.append(must(lib.peri_cut_segment(body, CUT_INITIAL, doubles(0.8, 0), doubles(0.8, 0.2))))
    left = must(lib.peri_select_box(body, b"left", doubles(0, 0), doubles(0.2, 0.6)))
    right = must(lib.peri_select_box(body, b"right", doubles(1.4, 0), doubles(1.6, 0.6)))
    must(lib.peri_prescribe_displacement(body, lib.peri_find_set(body, b"left"), AXIS_XY, None, None, None))
    must(lib.peri_apply_layer_traction(body, lib.peri_find_set(body, b"right"), 0.6, doubles(0.09, 0), pull, None))
    must(lib.peri_set_no_fail(body, left, 1))
    must(lib.peri_set_no_fail(body, right, 1))
    must(lib.peri_on_break(body, on_break, None))
    out.append(lib.peri_stable_step(body))
    lib.peri_advance_desc_init(C.byref(run))
    out.append(run.safety)
    run.duration, run.frame_steps, run.on_frame = 8, 20, on_frame
    must(lib.peri_advance(body, C.byref(run)))
    for field in (DISPLACEMENT, VELOCITY, DAMAGE, FAMILY_SIZE):
        n = lib.peri_size_of_field(body, field)
        v = (C.c_double * n)()
        must(lib.peri_get_field(body, field, v, n))
        out += list(v)
    must(lib.peri_get_energy(body, C.byref(e)))
    force = doubles(0, 0)
    must(lib.peri_get_reaction(body, lib.peri_id(body, KIND_LOAD, 1), force))
    out += [e.kinetic, e.elastic, e.external, e.fracture, e.initial, e.error, force[0], force[1]]
    must(lib.peri_view_field(body, VELOCITY, C.byref(view)))
    data = C.cast(view.data, C.POINTER(C.c_double))
    out.append(view.scale * data[95 * view.point_stride + view.component_stride] + view.offset[1])
    out += [counts["load"], counts["frame"], counts["break"]]
    run.time_step = 1
    out.append(lib.peri_advance(body, C.byref(run)))
    must(lib.peri_get_error(body, C.byref(error)))
    out += [error.code, error.value]
    if b"step" not in error.text or b"time_step" not in error.field:
        failures.append("error record: %r, %r" % (error.text, error.field))
    out += [C.sizeof(Statics), C.sizeof(Report), Statics.on_iteration.offset]
    statics, report, curve, told = Statics(), Report(), (C.c_double * 12)(), [0.0]

    @ITERATION
    def on_iteration(_user, iteration, residual):
        told[0] += iteration * residual
        return 0

    lib.peri_solve_desc_init(C.byref(statics))
    out.append(statics.iterations)
    statics.fracture, statics.steps, statics.curve_load, statics.curve, statics.curve_rows = 0, 2, lib.peri_id(body, KIND_LOAD, 1), curve, 2
    statics.on_iteration = on_iteration
    must(lib.peri_reset(body))
    must(lib.peri_solve(body, C.byref(statics), C.byref(report)))
    out += list(curve) + [report.iterations, report.passes, report.residual, told[0]]
    out += [C.sizeof(Memory), C.sizeof(PlanDesc), C.sizeof(PlanReport), PlanDesc.spacing.offset]
    memory, plan, planned = Memory(), PlanDesc(), PlanReport()
    must(lib.peri_get_memory(body, C.byref(memory)))
    out += [memory.points, memory.families, memory.damage, memory.state, memory.loads, memory.total, memory.shared]
    lib.peri_plan_desc_init(C.byref(plan))
    plan.body, plan.material, plan.spacing = C.pointer(d), C.pointer(m), 0.1
    plan.hi[0], plan.hi[1] = 1.6, 0.6
    must(lib.peri_plan(C.byref(plan), C.byref(planned), C.byref(error)))
    out += [planned.points, planned.entries, planned.width, planned.bytes, planned.peak, planned.stable_step]
    lib.peri_body_destroy(body)
    return out, counts, failures


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    passed, failed = 0, 0

    def check(condition, text):
        nonlocal passed, failed
        passed, failed = passed + bool(condition), failed + (not condition)
        if not condition and failed <= 10:
            print("    " + text)

    lib = C.CDLL(sys.argv[1])
    declare(lib)
    mine, counts, failures = scene(lib)
    run = subprocess.run([sys.argv[2]], stdout=subprocess.PIPE, universal_newlines=True)
    theirs = [float(line) for line in run.stdout.split()]
    check(run.returncode == 0, "%s returned %d" % (sys.argv[2], run.returncode))
    check(not failures, "through ctypes: %s" % failures)
    check(len(mine) == len(theirs), "%d numbers through ctypes, %d from C" % (len(mine), len(theirs)))
    wrong = ["number %d: %.17g through ctypes, %.17g from C" % (k, a, b)
             for k, (a, b) in enumerate(zip(mine, theirs)) if float(a) != b]
    check(len(mine) > 1000 and not wrong, "; ".join(wrong[:10]))
    check(counts["load"] > 20 and counts["frame"] > 2 and counts["break"] > 5, "callbacks: %s" % counts)
    print("test_ctypes: %d passed, %d failed" % (passed, failed))
    sys.exit(1 if failed else 0)


main()
