# SPDX-License-Identifier: MIT
"""Fields in place."""
# mypy: ignore-errors
from __future__ import annotations

import ctypes as C
from typing import Any

import numpy as np


class LiveField(np.lib.mixins.NDArrayOperatorsMixin):
    """A field that the body stores, in place: what is read from it is the present state, in your units.

    It is used as an array of the shape (points, components), or (points,): indexed, calculated with, handed to NumPy. `raw` is the
    body's own memory, without a copy, in the library's units: component k is offset[k] + scale*raw[:, k]. Displacement and velocity
    can be set: field[points] = value. What you keep, copy: field.copy()."""

    def __init__(self, body: Any, which: Any) -> None:
        view = body.view_field(which)
        self._body, self._which = body, which
        dtype = np.dtype({1601: np.float64, 1602: np.float32, 1603: np.int32}[int(view.type)])
        n, m = view.count, view.components
        last = (n - 1) * view.point_stride + (m - 1) * view.component_stride + 1
        memory = (C.c_char * (last * dtype.itemsize)).from_address(view.data)
        memory._held = body._handle  # lives as long as any array of it
        self.raw = np.ndarray((n, m), dtype, memory, 0, (view.point_stride * dtype.itemsize, view.component_stride * dtype.itemsize))
        self.raw.flags.writeable = False
        self.scale, self.offset = view.scale, view.offset[:m].copy()
        if m == 1:
            self.raw = self.raw[:, 0]

    @property
    def shape(self) -> tuple:
        return self.raw.shape

    @property
    def ndim(self) -> int:
        return self.raw.ndim

    @property
    def size(self) -> int:
        return self.raw.size

    @property
    def dtype(self) -> np.dtype:
        return np.dtype(np.float64)

    def copy(self) -> np.ndarray:
        """All of it, in your units, as double."""
        raw = self.raw.astype(np.float64, order="C")
        return (self.offset[0] if raw.ndim == 1 else self.offset) + self.scale * raw

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        whole = self.copy()
        return whole if dtype is None else whole.astype(dtype)

    def __getitem__(self, which: Any) -> Any:
        if self.offset.any() or self.raw.ndim == 1:
            return self.copy()[which] if self.raw.ndim > 1 else self.offset[0] + self.scale * np.float64(self.raw[which])
        return 0.0 + self.scale * np.asarray(self.raw[which], np.float64)[()]

    def __setitem__(self, which: Any, value: Any) -> None:
        whole = self.copy()
        whole[which] = value
        self._body._set_whole(self._which, whole)

    def __len__(self) -> int:
        return len(self.raw)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Any:
        if any(isinstance(x, LiveField) for x in kwargs.get("out", ())):
            return NotImplemented
        return getattr(ufunc, method)(*[x.copy() if isinstance(x, LiveField) else x for x in inputs], **kwargs)

    def _inplace(self, other: Any, ufunc: Any) -> LiveField:
        self._body._set_whole(self._which, ufunc(self.copy(), other))
        return self

    def __iadd__(self, other: Any) -> LiveField:
        return self._inplace(other, np.add)

    def __isub__(self, other: Any) -> LiveField:
        return self._inplace(other, np.subtract)

    def __imul__(self, other: Any) -> LiveField:
        return self._inplace(other, np.multiply)

    def __itruediv__(self, other: Any) -> LiveField:
        return self._inplace(other, np.true_divide)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or not hasattr(np.ndarray, name):
            raise AttributeError(name)
        return getattr(self.copy(), name)

    def __repr__(self) -> str:
        return "LiveField(%s,\n%r)" % (self._which.name.lower(), self.copy())
