# SPDX-License-Identifier: MIT
"""Worlds in the Python package, for test_python.py. SOURCES OF TRUTH: momentum and energy are conserved; an exception of a callback comes
out of the call; what cannot be added is named."""
import gc

import numpy as np


def bar(peri, x, speed, build=True):
    body = peri.Body(space="plane_strain", horizon=0.025, ledger=1)
    body.add_material("bond_based", young=1e6, density=1000)
    body.add_box([x, 0], [x + 0.1, 0.03], spacing=0.01)
    if build:
        body.build()
        body.add_velocity(peri.ALL, [speed, 0])
    return body


def run(check, raises, peri):
    left, right, seen = bar(peri, 0, 2), bar(peri, 0.11, -2), []
    with peri.World([left, right], restitution=1.0) as world:
        check(world.asleep() == 0 and world.asleep(left) == 0 and world.bytes > 0, "awake; what it holds")
        before = [left.get_momentum()[0][0], world.get_energy().kinetic]
        world.advance(duration=4e-3, frame_steps=10, on_frame=lambda body: seen.append(body))
        check(left.time == right.time and set(seen) == {left, right}, "frames of each body, one time")
        check(abs(world.get_force(left)[0]) > 0 and np.allclose(world.get_force(left), -world.get_force(right), rtol=1e-12),
              "what they push each other by")
        world.advance(duration=16e-3)
        after, energy = [b.get_momentum()[0][0] for b in (left, right)], world.get_energy()
        check(after[0] < 0 < after[1] and abs(sum(after)) < 1e-12 * before[0], "they bounce: %s" % after)
        check(abs(energy.error) < 0.01 * before[1] and 0 < energy.kinetic < before[1], "the ledger: %s" % energy.error)
        check(0 < world.stable_step < 1e-3, "the step of both")

        def fail(body):
            raise KeyError("a frame of " + repr(body is right or body is left))
        raises(KeyError, lambda: world.advance(steps=5, on_frame=fail), "a frame of True")
        raises(peri.PeriError, lambda: world.add(bar(peri, 1, 0, build=False)), "peri_build")
        raises(peri.PeriError, lambda: world.add(left), "body")
        raises(peri.PeriError, lambda: world.advance(steps=5, safety=2), "safety")
        raises(peri.PeriError, lambda: world.set_contact(left, bar(peri, 1, 0), friction=0.1))
        raises(TypeError, lambda: world.set_contact(frictoin=1))
        shows = np.asarray(left.displacement)  # what shows a body keeps it, and not in the world
        left.close()
        check(world.bodies == [right], "who is closed has left")
        world.advance(steps=3)
        check(np.isfinite(shows).all(), "its array still stands")
        third = bar(peri, 0.4, 0)
        world.add(third)
        world.set_contact(none=True)
        world.set_contact(right, third, friction=0.2)
        world.remove(third)
        check(world.bodies == [right] and third.advance(steps=2) == 0, "removed, and goes on alone")
    still = bar(peri, 0, 0)
    with peri.World([still], sleep_speed=1e-3, sleep_time=1e-4) as calm:
        calm.advance(duration=1e-3)
        check(calm.asleep(still) == 1 and still.time == 1e-3, "who rests falls asleep")
    raises(peri.PeriError, lambda: peri.World(sleep_speed=-1), "sleep_speed")
    del world
    gc.collect()
    right.advance(steps=2)
