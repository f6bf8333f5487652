# SPDX-License-Identifier: MIT
"""Body, Cracks and Matrix: what _generated.py declares, and what Python adds."""
from __future__ import annotations

import ctypes as C
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _generated as g
from ._core import Handle, call, lib
from ._fields import LiveField
from ._values import as_enum

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike


class Body(g.BodyCalls):
    __doc__ = g.BodyCalls.__init__.__doc__
    _handle: Any

    def _create(self, desc: g.BodyDesc) -> None:
        self._handle = None
        error, new = g.Error(), C.c_void_p()
        call(None, lib.peri_body_create, (C.byref(desc), C.byref(new), C.byref(error)), error=error, guard=True)
        self._take(new.value or 0, {"create": list(desc._keep.values())})

    def _new(self, kind: str, pointer: C.c_void_p) -> Any:
        cls: Any = {"Body": Body, "Cracks": Cracks, "Matrix": Matrix}[kind]
        new: Any = cls.__new__(cls)
        new._take(pointer.value, self._handle.kept if kind == "Body" else None)
        if kind != "Body":
            new.dimension = self.dimension
        return new

    def _forget(self, id: int) -> None:
        for key in [k for k in self._handle.kept if k[1] == id and k[0].startswith(("peri_apply", "peri_prescribe", "peri_add"))]:
            del self._handle.kept[key]

    def _material(self, material: Any) -> int:
        """The material that is meant where none is given: the only one."""
        if material is not None:
            return g.as_int(material, C.c_int32, "material")
        ids = [lib.peri_id(self._pointer, g.Kind.MATERIAL, k) for k in (1, 2)]
        if ids[0] < 0 or ids[1] >= 0:
            raise ValueError("material: the body has %s; say which, by the id that add_material returned"
                             % ("none yet" if ids[0] < 0 else "more than one"))
        return ids[0]

    def _set(self, set: Any) -> int:
        return self.find_set(set) if isinstance(set, str) else g.as_int(set, C.c_int32, "set")

    # ---- fields

    def field(self, which: Any) -> np.ndarray:
        """A copy of a field, as double, by its name or number: of the shape (points,) or (points, components)."""
        which = as_enum(g.Field, which, "field")
        values, points = super().get_field(which), self.point_count
        return values if values.size == points else values.reshape(points, -1)

    def get_field(self, field: Any) -> np.ndarray:
        return self.field(field)

    get_field.__doc__ = g.BodyCalls.get_field.__doc__

    def get_field_at(self, field: Any, points: Any) -> np.ndarray:
        values = super().get_field_at(field, points)
        return values if values.size == np.size(points) else values.reshape(np.size(points), -1)

    get_field_at.__doc__ = g.BodyCalls.get_field_at.__doc__

    def interpolate_field(self, field: Any, in_place: int, places: Any) -> np.ndarray:
        values, count = super().interpolate_field(field, in_place, places), np.size(places) // self.dimension
        return values if values.size == count else values.reshape(count, -1)

    interpolate_field.__doc__ = g.BodyCalls.interpolate_field.__doc__

    def _live(self, which: Any) -> LiveField:
        return LiveField(self, which)

    def _set_whole(self, which: Any, value: Any) -> None:
        if isinstance(value, LiveField) and value._body is self and value._which == which:
            return  # after body.velocity += ..., which has set it
        self.set_field(which, np.broadcast_to(np.asarray(value, np.float64), (self.point_count, self.dimension)))

    # ---- pictures and other programs

    def plot(self, field: Any = "damage", **options: Any) -> Any:
        """Draws the body by a field with matplotlib, and returns the axes. See peri.plotting.plot."""
        from . import plotting
        return plotting.plot(self, field, **options)

    def animate(self, path: str | os.PathLike[str] | None = None, **options: Any) -> Any:
        """Advances the body and draws its frames: to a GIF or an HTML file, or for a notebook. See peri.plotting.animate."""
        from . import plotting
        return plotting.animate(self, path, **options)

    def _point_data(self) -> dict[str, np.ndarray]:
        flat = self.dimension == 2
        data = {}
        for name in ("displacement", "velocity", "damage", "energy_density", "material", "volume", "fragment"):
            values = self.field(name)
            data[name] = np.pad(values, ((0, 0), (0, 1))) if flat and values.ndim == 2 else values
        return data

    def _places(self) -> np.ndarray:
        x = self.field("position")
        return np.pad(x, ((0, 0), (0, 1))) if self.dimension == 2 else x

    def to_meshio(self) -> Any:
        """A meshio.Mesh: a vertex per point, at its reference position, with the fields."""
        import meshio
        return meshio.Mesh(self._places(), [("vertex", np.arange(self.point_count)[:, None])], point_data=self._point_data())

    def to_pyvista(self) -> Any:
        """A pyvista.PolyData: a vertex per point, at its reference position, with the fields."""
        import pyvista
        mesh = pyvista.PolyData(self._places())
        for name, values in self._point_data().items():
            mesh.point_data[name] = values
        return mesh

    def __repr__(self) -> str:
        if self._handle is None:
            return "Body(closed)"
        if not self.point_count:
            return "Body(%dD, empty)" % self.dimension
        return "Body(%dD, %d points, %d bonds, %d broken, time %g)" % (
            self.dimension, self.point_count, self.bond_count, self.broken_count, self.time)


class Cracks(g.CracksCalls):
    __doc__ = g.CracksCalls.__doc__
    dimension: int

    def lines(self) -> list[np.ndarray]:
        """The vertices of each path."""
        start, vertex, _, _ = self.get()
        return [vertex[a:b] for a, b in zip(start[:-1], start[1:])]


class Matrix(g.MatrixCalls):
    __doc__ = g.MatrixCalls.__doc__
    dimension: int

    def to_scipy(self) -> Any:
        """A scipy.sparse.csr_matrix."""
        import scipy.sparse
        start, column, value = self.get()
        return scipy.sparse.csr_matrix((value, column, start), shape=(self.rows, self.rows))


__all__ = ["Body", "Cracks", "Matrix", "Handle"]
