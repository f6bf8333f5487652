# SPDX-License-Identifier: MIT
"""World: bodies that advance together and touch. Written by hand, for it keeps other handles alive."""
from __future__ import annotations

import contextlib
import ctypes as C
import weakref
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _generated as g
from ._body import Body
from ._core import Handle, PeriError, _error, call, lib
from ._runs import watched
from ._values import described

if TYPE_CHECKING:
    from collections.abc import Iterable


def _described(cls: Any, desc: Any, fields: dict[str, Any], owner: Any = None) -> Any:
    for name in fields:
        if name not in cls._meta_:
            raise TypeError("%s: %s has no such field" % (name, cls.__name__))
    return described(cls, desc, fields, owner)


class World(Handle):
    """Built bodies of one dimension that advance by one step and touch. It keeps its bodies alive; a body that is closed has left.

        with peri.World([ball, pane], friction=0.3) as world:
            world.advance(duration=1e-3)
    """

    _destroy = "peri_world_destroy"
    _handle: Any

    def __init__(self, bodies: Iterable[Body] = (), *, sleep_speed: float | None = None, sleep_time: float | None = None,
                 **contact: Any) -> None:
        self._handle, self._bodies = None, []
        desc, new, error = described(g.WorldDesc, None, {"sleep_speed": sleep_speed, "sleep_time": sleep_time}), C.c_void_p(), g.Error()
        call(None, lib.peri_world_create, (C.byref(desc), C.byref(new), C.byref(error)), error=error)
        self._take(new.value or 0)
        if contact:
            self.set_contact(**contact)
        for body in bodies:
            self.add(body)

    # ---- what callbacks and runs ask

    @property
    def bodies(self) -> list[Body]:
        """Those that are in the world, in the order in which they came."""
        for body, held in [one for one in self._bodies if one[0]._handle is None]:  # closed, though arrays may show it yet
            alive = held()
            if alive is not None:
                lib.peri_world_remove(self._pointer, alive.pointer)
            self._bodies.remove((body, held))
        return [body for body, _ in self._bodies]

    @property
    def dimension(self) -> int:
        return self.bodies[0].dimension if self.bodies else 0

    @property
    def entry_count(self) -> int:
        return sum(body.entry_count for body in self.bodies)

    @property
    def time(self) -> float:
        return self.bodies[0].time if self.bodies else 0.0

    @property
    def step_count(self) -> int:
        return self.bodies[0].step_count if self.bodies else 0

    def _body_at(self, pointer: int) -> Body:
        return next(body for body in self.bodies if body._handle.pointer == pointer)

    def _call(self, function: Callable[..., int], *arguments: Any, guard: bool = False, keep: tuple = ()) -> int:
        """As _core.call, with the locks of all bodies; the record is the world's."""
        with contextlib.ExitStack() as stack:
            for body in sorted(self.bodies, key=lambda b: b._handle.pointer):
                stack.enter_context(body._handle.lock)
            try:
                return call(self, function, (self._pointer,) + arguments, guard=guard, keep=keep)
            except PeriError as error:
                record = g.Error()
                lib.peri_world_get_error(self._pointer, C.byref(record), None)
                raise _error(None, error.status, record) from None

    # ---- bodies and contact

    def add(self, body: Body) -> None:
        """Points do not touch at the distance that they have now.

        C: peri_world_add
        """
        self._call(lib.peri_world_add, body._pointer)
        self._bodies.append((body, weakref.ref(body._handle)))

    def remove(self, body: Body) -> None:
        """C: peri_world_remove"""
        self._call(lib.peri_world_remove, body._pointer)
        self._bodies = [one for one in self._bodies if one[0] is not body]

    def set_contact(self, a: Body | None = None, b: Body | None = None, desc: g.ContactDesc | None = None, *, none: bool = False,
                    **fields: Any) -> None:
        """Contact of bodies a and b, None: any, those yet to come too. Fields are those of ContactDesc; none=True: they do not touch.

        C: peri_world_set_contact
        """
        made = None if none else _described(g.ContactDesc, desc, fields)
        self._call(lib.peri_world_set_contact, a._pointer if a else None, b._pointer if b else None, C.byref(made) if made else None)

    # ---- motion

    @property
    def stable_step(self) -> float:
        """C: peri_world_stable_step"""
        return lib.peri_world_stable_step(self._pointer)

    def advance(self, desc: g.AdvanceDesc | None = None, *, progress: bool = False, **fields: Any) -> int:
        """As Body.advance, whose keywords it takes, for all by one step. on_frame comes for each body.

        C: peri_world_advance
        """
        run = _described(g.AdvanceDesc, desc, fields, self)
        if self.bodies:
            watched(self, run, progress)
        return self._call(lib.peri_world_advance, C.byref(run), guard=True, keep=(run,))

    def asleep(self, body: Body | None = None) -> int:
        """How many bodies sleep; of one: whether it does.

        C: peri_world_asleep
        """
        return self._call(lib.peri_world_asleep, body._pointer if body else None)

    @property
    def bytes(self) -> int:
        """What it holds, beside its bodies.

        C: peri_world_bytes
        """
        return lib.peri_world_bytes(self._pointer)

    def get_energy(self) -> g.Energy:
        """The ledger of all bodies, and of what is between them.

        C: peri_world_get_energy
        """
        energy = g.Energy()
        self._call(lib.peri_world_get_energy, C.byref(energy))
        return energy

    def get_force(self, body: Body) -> np.ndarray:
        """[M L T^-2] of the others on a body, in the last step.

        C: peri_world_get_force
        """
        force = np.zeros(3)
        self._call(lib.peri_world_get_force, body._pointer, force.ctypes.data)
        return force[:body.dimension]


__all__ = ["World"]
