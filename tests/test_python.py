#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The Python package: python3 tests/test_python.py path/to/build/python path/to/binding_scenes [--long]

SOURCES OF TRUTH: the C program of bindings/scenes.md, number by number; peri.h, through sizes and offsets that a compiled program prints;
addresses; and what Python says of exceptions, signals and threads. `make python` builds what is tested.
"""
import ctypes as C
import gc
import importlib
import os
import signal
import subprocess
import sys
import threading
import time
import weakref

import numpy as np

sys.path.insert(0, sys.argv[1])
import peri  # noqa: E402

sys.dont_write_bytecode = True
import test_python_header  # noqa: E402

passed = failed = 0
CC = os.environ.get("CC", "cc").split()


def check(condition, text):
    global passed, failed
    passed, failed = passed + bool(condition), failed + (not condition)
    if not condition:
        print("    " + text)
    return condition


def raises(kind, call, text=""):
    """The exception of that kind that the call raises, or None."""
    try:
        call()
    except kind as e:
        check(text in str(e), "%r is not in %r" % (text, str(e)))
        return e
    except BaseException as e:  # noqa: B902
        check(False, "%s was expected, not %r" % (kind.__name__, e))
        return None
    check(False, "%s was expected, and nothing was raised: %s" % (kind.__name__, text))
    return None


def fnv(array):
    h = 2166136261
    for byte in np.ascontiguousarray(array).tobytes():
        h = (h ^ byte) * 16777619 & 0xffffffff
    return "%08x" % h


# ---- the scenes of bindings/scenes.md --------------------------------------------------------------------------------

def common(body):
    e = body.get_energy()
    return [("points", body.point_count), ("bonds", body.bond_count), ("cut", body.cut_count), ("steps", body.step_count),
            ("broken", body.broken_count), ("displacement", fnv(body.displacement)), ("velocity", fnv(body.velocity)),
            ("damage", fnv(body.damage)), ("kinetic", e.kinetic), ("elastic", e.elastic), ("external", e.external),
            ("fracture", e.fracture)]


def glass():
    with peri.Body(space="plane_stress", horizon=1.5e-3) as pane:
        pane.add_material("bond_based", young=72e9, density=2440, fracture_energy=3.8)
        pane.add_box([0, 0], [0.1, 0.04], 0.5e-3)
        pane.build()
        pane.cut_segment([0, 0.02], [0.05, 0.02])
        pane.select_box([0, 0.0395], [0.1, 0.04], "top")
        pane.select_box([0, 0], [0.1, 0.0005], "bottom")
        pane.apply_layer_traction("top", 0.1, [0, 2e6])
        pane.prescribe_velocity("bottom", "xy")
        pane.advance(duration=40e-6)
        return common(pane)


def ball():
    pairs, times, frames = [], [], []
    with peri.Body(space="solid", horizon=0.03) as block:
        stone = block.add_material("lps", young=30e9, poisson=0.2, density=2400, critical_stretch=3e-3)
        block.add_box([0, 0, 0], [0.1, 0.1, 0.04], 0.01, material=stone)
        block.build()
        block.cut_rectangle([0.07, -0.01, -0.01], [0, 0.12, 0], [0, 0, 0.06])
        striker = block.add_obstacle("ball", place=[0.05, 0.05, 0.055], radius=0.02, density=7800, friction=0.1, velocity=[0, 0, -60])

        def on_break(i, j, time, stretch):
            pairs.extend((i, j))
            times.append(time)
        block.on_break(on_break)
        block.advance(steps=80, time_step=1e-6, frame_steps=10, on_frame=lambda body: frames.append(body.time))
        out = common(block)
        state = block.get_obstacle_state(striker)
        n, of_point = block.find_fragments()
        pieces = block.get_fragments()
        return out + [("frames", len(frames)), ("breaks", len(times)), ("pairs", fnv(np.array(pairs, np.int32))),
                      ("times", fnv(np.array(times))), ("striker_z", state.place[2]), ("striker_speed", state.velocity[2]),
                      ("fragments", n), ("of_point", fnv(of_point)), ("first_points", pieces[0].points),
                      ("first_centre_z", pieces.centre[0, 2])]


def cantilever():
    calls = []

    def pull_down(time, points, value):
        calls.append(time)
        value[:, 1] = -2e4 * time * time
    with peri.Body(space="plane_stress", horizon=0.15) as beam:
        beam.add_material("lps", young=1e9, poisson=0.3, density=1000)
        beam.add_box([0, 0], [1, 0.25], 0.05)
        beam.build()
        held = beam.select_box([0, 0], [0.15, 0.25], name="held")
        beam.select_box([0.95, 0], [1, 0.25], name="tip")
        support = beam.prescribe_displacement(held, peri.Axis.XY)
        beam.apply_body_force("tip", [0, 0], pull_down)
        report = beam.solve(steps=2, curve_load=support, curve_rows=2)
        return common(beam) + [("load_steps", report.steps), ("curve_rows", report.curve_rows), ("curve", fnv(report.curve)),
                               ("reaction_y", beam.get_reaction(support)[1]), ("called", int(len(calls) > 0))]


def same_as_c():
    theirs = subprocess.run([sys.argv[2]], stdout=subprocess.PIPE, universal_newlines=True).stdout.splitlines()
    mine = [("%s.%s" % (scene.__name__, name), value) for scene in (glass, ball, cantilever) for name, value in scene()]
    check(len(theirs) == len(mine) and len(mine) > 40, "%d numbers from C, %d here" % (len(theirs), len(mine)))
    for line, (name, value) in zip(theirs, mine):
        said, number = line.split()
        same = number == value if isinstance(value, str) else float(number) == float(value)
        check(said == name and same, "C: %s; here: %s %r" % (line, name, value))


# ---- arrays ----------------------------------------------------------------------------------------------------------

def bar(n=12, height=0.2, **fields):
    """A bar of n columns of points, two high or so, with a set at its left and one at its right."""
    body = peri.Body(space="plane_stress", horizon=0.31, **fields)
    body.add_material("bond_based", young=1, density=1)
    body.add_box([0, 0], [n * 0.1, height], 0.1)
    body.build()
    body.select_box([0, 0], [0.3, 0.2], "held")
    body.select_box([n * 0.1 - 0.1, 0], [n * 0.1, 0.2], "end")
    return body


def arrays_without_copies():
    for precision in ("double", "single"):
        body = bar(precision=precision)
        live = body.displacement
        for name in ("displacement", "velocity", "position", "force_density", "volume"):
            at = getattr(body, name).raw.__array_interface__["data"][0]
            check(at == body.view_field(name).data, "%s, %s: another address" % (precision, name))
            check(not getattr(body, name).raw.flags.owndata, name + " is a copy")
        before = live.raw.copy()
        body.add_displacement("end", [0.01, 0.02])
        check(not np.array_equal(before, live.raw), "a live view shows a change")
        for name in ("displacement", "position", "velocity", "volume"):
            check(np.array_equal(np.asarray(getattr(body, name)), body.field(name)), name + ": units of a live view")
            check(np.array_equal(getattr(body, name)[3:5], body.field(name)[3:5]), name + ": units of a part")
            check(np.array_equal(getattr(body, name)[7], body.field(name)[7]), name + ": units of a point")
        check(body.field("damage").shape == (24,) and body.strain.shape == (24, 3), "shapes")
    body = bar()
    body.velocity = np.arange(48).reshape(24, 2)
    check(np.array_equal(body.velocity.copy(), np.arange(48).reshape(24, 2)), "a field is set whole")
    body.velocity[3] = [7, 8]
    body.velocity += 1
    body.velocity[5:7, 1] *= 2
    expected = np.arange(48.0).reshape(24, 2)
    expected[3] = [7, 8]
    expected += 1
    expected[5:7, 1] *= 2
    check(np.allclose(body.velocity, expected, rtol=1e-15, atol=0), "a field is set in part, added to")
    check(abs((body.velocity * 2 - expected).sum() - expected.sum()) < 1e-9 and abs(body.velocity.max() - expected.max()) < 1e-12,
          "a field is calculated with")
    raises(ValueError, lambda: body.displacement.raw.__setitem__(0, 1), "read-only")
    raw, held = body.velocity.raw[3:], weakref.ref(body._handle)
    kept = raw.copy()
    body.close()
    gc.collect()
    check(held() is not None and np.array_equal(raw, kept), "memory that is looked at outlives the body")
    del raw, live
    gc.collect()
    check(held() is None, "memory that nobody looks at is freed")
    raises(ValueError, lambda: body.point_count, "closed")


def arrays_are_checked():
    body = bar()
    raises(ValueError, lambda: body.select_box([0, 0, 0], [1, 1, 1]), "lo: 2 numbers are needed, 3 were given")
    raises(ValueError, lambda: body.select_box([0], [1, 1]), "lo: 2 numbers are needed, 1 were given")
    raises(ValueError, lambda: body.cut_polyline([0, 0, 1]), "a multiple of 2")
    raises(ValueError, lambda: body.set_field("velocity", 1) and None if False else body.displacement.__setitem__(0, [1, 2, 3]))
    raises(TypeError, lambda: body.select_points([0.5]), "whole numbers")
    raises(OverflowError, lambda: body.select_points([2**40]), "points")
    raises(OverflowError, lambda: body.size_of_set(2**40), "set")
    raises(TypeError, lambda: body.add_ball([0, 0], "wide", 1), "radius")
    raises(TypeError, lambda: peri.Body(space="plane_stress", horizn=1), "horizn")
    raises(ValueError, lambda: peri.Body(space="plane", horizon=1), "plane_stress, plane_strain, solid")
    raises(ValueError, lambda: body.evaluate(force=np.zeros(3)), "force")
    new = peri.Body(space="solid", horizon=1)
    raises(ValueError, lambda: new.add_box([0] * 3, [1] * 3, 0.5), "none yet")
    for _ in range(2):
        new.add_material("lps", young=1, poisson=0.2, density=1)
    raises(ValueError, lambda: new.add_box([0] * 3, [1] * 3, 0.5), "more than one")
    force = np.zeros((24, 2))
    u = np.zeros((24, 2))
    u[:, 0] = 0.01 * body.position[:, 0]
    body.evaluate(displacement=u, force=force)
    body.displacement = u
    check(np.allclose(force, body.force_density, rtol=1e-9, atol=1e-12) and abs(force).max() > 0, "forces at a displacement of mine")
    turned = np.zeros((24, 2), order="F")
    body.evaluate(displacement=np.asfortranarray(u), force=turned)
    check(np.array_equal(turned, force), "arrays of another order")
    product = body.multiply_stiffness(u)
    check(product.shape == (48,) and abs(product).max() > 0, "the stiffness times a vector")
    matrix = body.matrix()
    start, column, value = matrix.get()
    rows = np.repeat(np.arange(matrix.rows), np.diff(start))
    dense = np.zeros((48, 48))
    dense[rows, column] = value
    check(np.allclose(dense @ u.ravel(), product, rtol=1e-9, atol=1e-12), "the stiffness as a matrix")


def errors_say_where():
    body = bar()
    e = raises(peri.StepError, lambda: body.advance(steps=1, time_step=100), "time_step")
    check(e and e.field == "time_step" and e.status == peri.Status.ERROR_STEP and 0 < e.value < 100, "the record of an error")
    e = raises(peri.IndexError, lambda: body.select_points([0, 99]), "")
    check(e and e.index == 1 and isinstance(e, IndexError), "the entry at fault")
    e = raises(peri.RangeError, lambda: peri.Body(space="solid", horizon=-1), "horizon")
    check(e and e.field == "horizon" and e.value == -1 and isinstance(e, peri.PeriError), "the error of a body that is not made")
    raises(peri.IdKindError, lambda: body.remove_load(body.find_set("end")), "")
    raises(peri.NameError, lambda: body.find_set("nothing"), "")
    raises(peri.RangeError, lambda: peri.plan(body=peri.BodyDesc(space="solid", horizon=1),
                                              material=peri.MaterialDesc(law="lps", young=-1, density=1), lo=[0] * 3, hi=[1] * 3,
                                              spacing=0.4), "young")
    planned = peri.plan(body=peri.BodyDesc(space="plane_stress", horizon=0.31), lo=[0, 0], hi=[1.2, 0.2], spacing=0.1,
                        material=peri.MaterialDesc(law="bond_based", young=1, density=1))
    check(planned.points == 24 and planned.entries == body.entry_count, "what a scene costs")
    material = peri.MaterialDesc(law="bond_based", young=1, density=1)
    wanted = peri.BodyDesc(space="plane_stress")
    chosen = peri.choose(wanted, material, quantity="deformation", error=0.05, feature=0.5, lo=[0, 0], hi=[1, 1])
    check(chosen.error <= 0.05 and wanted.horizon > chosen.spacing > 0 and chosen.text, "what to choose: %s" % chosen)
    check({v["name"] for e in api["enums"] if e["name"] == "peri_status" for v in e["values"] if v["value"] < 0}
          == {"PERI_" + peri.Status(k).name for k in peri._core.ERRORS}, "an exception for each status")


# ---- callbacks -------------------------------------------------------------------------------------------------------

class Mine(Exception):
    pass


def exceptions_pass_through():
    """One in each kind of callback: the call ends with it, the callback is not called again, and nothing is printed."""
    libc = C.CDLL(None)
    libc.malloc.restype, libc.malloc.argtypes, libc.free.argtypes = C.c_void_p, [C.c_size_t], [C.c_void_p]
    calls, first = [], [True]

    def fail(*arguments):
        calls.append(arguments)
        raise Mine("from a callback")

    def releases(pointer, size):
        libc.free(pointer)
        calls.append(size)
        if first and first.pop():
            raise Mine("from a callback")

    def tough(**fields):
        body = bar(**fields)
        body.prescribe_displacement("held", "xy")
        return body

    def breaking():
        body = peri.Body(space="plane_stress", horizon=0.31)
        body.add_material("bond_based", young=1, density=1, critical_stretch=1e-3)
        body.add_box([0, 0], [1.2, 0.2], 0.1)
        body.build()
        body.on_break(fail)
        body.displacement = np.stack([0.1 * body.position[:, 0], np.zeros(24)], axis=1)
        body.advance(steps=5)

    def moved(function):
        body = tough()
        function(body)
        body.advance(steps=5)

    def unbuilt(**fields):
        body = peri.Body(space="plane_stress", horizon=0.31, **fields)
        body.add_material("bond_based", young=1, density=1)
        return body

    def released():
        body = unbuilt(allocate=lambda size: libc.malloc(size), release=releases)
        body.add_box([0, 0], [1.2, 0.2], 0.1)
        body.build()

    def built(length=1.2, **fields):
        body = unbuilt(**fields)
        body.add_box([0, 0], [length, 0.2], 0.1)
        body.build()

    def logged():
        body = unbuilt(log=fail)
        body.add_box([0, 0], [1.2, 0.1], 0.1)  # a row: it warns
        body.build()

    def inner(law, model=None, **fields):
        body = peri.Body(space="plane_stress", horizon=0.31, threads=1)
        material = body.add_material(model, young=1, density=1, **fields)
        if law:
            body.set_bond_law(material, material, 0, law)
        body.add_box([0, 0], [1.2, 0.2], 0.1)
        body.build()
        body.displacement = np.stack([1e-3 * body.position[:, 0], np.zeros(24)], axis=1)
        body.advance(steps=1)

    def part(**hook):
        body = unbuilt()
        body.add_box([0, 0], [1.2, 0.2], 0.1)
        body.set_part(origin=[0, 0, 0], length=0.1, mean_volume=0.01, **hook)
        body.build()
        body.advance(steps=1)

    kinds = {
        "exchange": lambda: part(exchange=fail, reduce=lambda reduction, values: 0),
        "reduce": lambda: part(exchange=lambda kind, planes, plane: 0, reduce=fail),
        "bond_law": lambda: inner(fail, "bond_based"),
        "stress": lambda: inner(None, "correspondence", poisson=0.3, stress=fail),
        "allocate": lambda: peri.Body(space="solid", horizon=1, allocate=fail, release=lambda pointer, size: None),
        "release": released,
        "parallel_for": lambda: built(length=400, parallel_for=fail),  # what is small is not shared out
        "log": logged,
        "influence": lambda: built(influence="user", influence_fn=fail),
        "point": lambda: bar().select_if(fail),
        "pair": lambda: bar().cut_if(fail),
        "load": lambda: moved(lambda b: b.apply_body_force("end", [1, 0], fail)),
        "motion": lambda: moved(lambda b: b.add_obstacle("ball", place=[9, 9], radius=1, motion=fail)),
        "distance": lambda: moved(lambda b: b.add_obstacle("distance", place=[1.2, 0.1], radius=1, distance=fail)),
        "rigid": lambda: moved(lambda b: b.prescribe_rigid("end", [1.1, 0.1], fn=fail)),
        "break": breaking,
        "write": lambda: bar().export_vtu_to(fail),
        "read": lambda: bar().load_state_from(fail),
        "frame": lambda: tough().advance(steps=50, frame_steps=1, on_frame=fail),
        "iteration": lambda: (lambda b: (b.apply_body_force("end", [1, 0]), b.solve(on_iteration=fail)))(tough()),
    }
    declared = {c["name"][5:-3] for c in api["callbacks"]} - {"task"}
    check(set(kinds) == declared, "kinds of callbacks: %s" % (set(kinds) ^ declared))
    printed = []
    hook, sys.unraisablehook = sys.unraisablehook, printed.append
    for name, run in kinds.items():
        del calls[:]
        e = raises(Mine, run, "from a callback")
        check(name in ("release",) or len(calls) == 1, "%s: called %d times" % (name, len(calls)))
        trace = e.__traceback__ if e else None
        while trace and trace.tb_next:
            trace = trace.tb_next
        check(trace and trace.tb_frame.f_code.co_name in ("fail", "releases"), name + ": the traceback ends elsewhere")
    gc.collect()
    sys.unraisablehook = hook
    check(not printed, "printed beside: %s" % printed[:2])


def callbacks_are_python():
    """Arguments are arrays of the right shape, results are taken, files are written to and read."""
    seen = []
    body = bar(influence="user", influence_fn=lambda q: 1 - q / 2)
    lines = bar(influence="linear")
    check(body.bond_count == lines.bond_count, "an influence function of mine")
    check(body.size_of_set(body.select_if(lambda index, x: x[0] > 0.95)) == 6, "points of a predicate")
    check(body.cut_if(lambda i, j, xi, xj: (xi[0] < 0.6) != (xj[0] < 0.6)) > 0, "bonds of a predicate")
    n, of_point = body.find_fragments()
    check(n == 2 and np.array_equal(of_point == 1, body.position[:, 0] > 0.6), "two pieces")

    def load(time, points, value):
        seen.append((time, points.tolist(), value.copy()))
        value[:, 0] = 5 * time
    body = bar()
    body.apply_body_force("end", [3, 4], load)
    body.advance(steps=2, time_step=0.01)
    check(seen[0][1] == body.get_set(body.find_set("end")).tolist() and np.array_equal(seen[0][2], [[3, 4]] * 2), "what a load is told")
    state, parts = [], []
    body.save_state_to(state.append)
    with open(os.devnull, "wb") as nothing:
        body.export_vtu_to(nothing)
    body.export_vtu_to(parts.append)
    check(b"VTKFile" in b"".join(parts), "a file in pieces")
    import io
    other = bar()
    other.apply_body_force("end", [3, 4], load)
    other.load_state_from(io.BytesIO(b"".join(state)))
    check(other.step_count == 2 and np.array_equal(other.velocity.copy(), body.velocity.copy()), "a state from a file")
    ball = body.add_obstacle("distance", place=[1.3, 0.1], radius=1, distance=lambda x: (np.hypot(*x) - 0.2, x))
    other_ball = other.add_obstacle("ball", place=[1.3, 0.1], radius=0.2)
    body.advance(steps=1, time_step=0.01), other.advance(steps=1, time_step=0.01)
    mine, theirs = body.get_obstacle_force(ball)[0], other.get_obstacle_force(other_ball)[0]
    check(np.allclose(mine, theirs, rtol=1e-9) and abs(mine).max() > 0, "a shape of mine: %s, %s" % (mine, theirs))
    clone = body.clone()
    del body
    gc.collect()
    clone.advance(steps=3)  # its callbacks are alive
    check(clone.step_count == 6, "a clone")
    tasks = []

    def shared(count, task):
        tasks.append(count)
        for k in reversed(range(count)):
            task(k)
    orders = iter([])

    def fails_once(count, task):
        for k in range(count - 1):
            task(k)
        if next(orders, 0):
            raise Mine("before the last task")
        task(count - 1)
    serial, mine, broken = (bar(2000, 2.0, **how) for how in ({"threads": 1}, {"parallel_for": shared}, {"parallel_for": fails_once}))
    orders = iter([1])
    for b in (serial, mine, broken):
        b.velocity = np.sin(np.arange(80000.0)).reshape(-1, 2)
        if b is broken:
            raises(Mine, lambda: b.advance(steps=20, time_step=0.01), "before the last task")
        else:
            b.advance(steps=20, time_step=0.01)
    check(np.array_equal(serial.displacement.copy(), broken.displacement.copy()), "no task is left out where a job system fails")
    check(tasks and np.array_equal(serial.displacement.copy(), mine.displacement.copy()), "a job system of mine")


def frames_leak_nothing():
    body = bar()

    def frame(body):
        body.displacement[0], body.damage, body.get_energy(), body.find_fragments(), body.velocity.raw
        return 0

    def resident():
        gc.collect()
        with open("/proc/self/statm") as f:
            return int(f.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    if not os.path.exists("/proc/self/statm"):
        return
    body.advance(steps=300, frame_steps=1, on_frame=frame)
    for k in range(50):
        body.advance(steps=1, on_frame=frame)
    before, objects = resident(), len(gc.get_objects())
    body.advance(steps=1000, frame_steps=1, on_frame=frame)
    for k in range(300):
        body.advance(steps=1, on_frame=frame)
    grown, more = resident() - before, len(gc.get_objects()) - objects
    check(grown < 300_000 and more < 100, "1,000 frames and 300 runs: %d bytes, %d objects more" % (grown, more))


def interrupted(run):
    """Seconds from Ctrl-C to the KeyboardInterrupt that leaves run(), or None."""
    sent = []

    def send():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    timer = threading.Timer(0.1, send)
    timer.start()
    try:
        run()
    except KeyboardInterrupt:
        return time.monotonic() - sent[0]
    finally:
        timer.cancel()
    return None


def control_c_stops():
    body = bar()
    for name, more in {"no callback": {}, "a short frame": {"on_frame": lambda b: 0, "frame_steps": 100},
                       "a long frame": {"on_frame": lambda b: [None for _ in range(10**9)], "frame_steps": 100}}.items():
        took = interrupted(lambda: body.advance(steps=10**9, **more))
        check(took is not None and took < 1, "%s: %s s after Ctrl-C" % (name, took))
        steps = body.step_count
        body.advance(steps=1)
        check(body.step_count == steps + 1, name + ": the body goes on")
    check(signal.getsignal(signal.SIGINT) is signal.default_int_handler, "the handler is the former one")


def the_lock_is_free():
    """Python counts while the library runs in another thread; and one thread waits for the other, of the same body."""
    body = bar()
    counted, threads = 0, [threading.Thread(target=lambda: body.advance(steps=60000, on_frame=lambda b: 0)) for _ in range(2)]
    interval = sys.getswitchinterval()
    threads[0].start()
    while threads[0].is_alive():
        counted += 1
    check(counted > 20000, "counted to %d while the library ran" % counted)
    threads[1].start()
    body.advance(steps=10)
    threads[1].join()
    check(body.step_count == 120010 and sys.getswitchinterval() == interval, "two threads, one body")


# ---- what is read in part --------------------------------------------------------------------------------------------

def probes_and_bonds():
    body = bar()
    body.displacement = 0.01 * body.field("position")
    strain, force = body.field("strain"), body.field("force_density")
    check(np.array_equal(body.get_field_at("strain", [3, 1]), strain[[3, 1]]), "strain of some points")
    check(np.array_equal(body.get_field_at("damage", [3, 1]), body.field("damage")[[3, 1]]), "damage of some points")
    places = body.field("position")[:5] + 0.01
    check(np.allclose(body.interpolate_field("displacement", 0, places), 0.01 * places, rtol=0, atol=1e-14),
          "displacement at places")
    i = body.get_bonds(peri.ALL, "point").astype(int)
    pulls = body.get_bonds(peri.ALL, "force").reshape(i.size, -1)
    total = np.zeros_like(force)
    np.add.at(total, i, pulls)
    check(np.allclose(total, force, rtol=0, atol=1e-12 * np.abs(pulls).max()), "bonds add up to the force density")


def worlds():
    import test_python_world
    test_python_world.run(check, raises, peri)


# ---- parts of their own ----------------------------------------------------------------------------------------------

def sizes_are_those_of_c():
    test_python_header.sizes(check, peri, CC)


def what_is_added_appears():
    test_python_header.added(check, peri, sys.argv[1])


def pictures():
    try:
        matplotlib = importlib.import_module("matplotlib")
    except ImportError:
        print("    skip: no matplotlib here")
        return
    matplotlib.use("Agg")
    import test_python_pictures
    test_python_pictures.run(check, raises, peri)


api = test_python_header.api
CASES = [same_as_c, arrays_without_copies, arrays_are_checked, errors_say_where, exceptions_pass_through, callbacks_are_python, probes_and_bonds,
         worlds, frames_leak_nothing, control_c_stops, the_lock_is_free, sizes_are_those_of_c, what_is_added_appears, pictures]


def main():
    wanted = [a for a in sys.argv[3:] if not a.startswith("-")]
    for case in CASES:
        if not wanted or case.__name__ in wanted:
            start = time.process_time()
            before = failed
            case()
            print("  %s %s %.1f s" % ("pass" if failed == before else "FAIL", case.__name__, time.process_time() - start))
    print("test_python: %d passed, %d failed" % (passed, failed))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
