# SPDX-License-Identifier: MIT
"""What goes in and comes out: numbers, choices, arrays, the structs of peri.h."""
# mypy: ignore-errors
from __future__ import annotations

import ctypes as C
import operator
import os
from enum import IntEnum
from typing import Any, Callable

import numpy as np

from ._core import made


def as_enum(kind: Any, value: Any, name: str) -> int:
    """A member, its number, or its name, as "plane_stress"."""
    if isinstance(value, str):
        try:
            return kind[value.upper().replace("-", "_").replace(" ", "_")]
        except KeyError:
            raise ValueError("%s: no %s is called %r; there are %s" % (
                name, kind.__name__, value, ", ".join(m.lower() for m in kind.__members__))) from None
    return as_int(value, C.c_int32, name)


_LIMITS = {C.c_int32: (-2**31, 2**31), C.c_int64: (-2**63, 2**63), C.c_uint64: (0, 2**64), C.c_uint32: (0, 2**32)}


def as_int(value: Any, kind: Any, name: str) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        if isinstance(value, (float, np.floating)) and float(value).is_integer():
            number = int(value)
        elif isinstance(value, np.bool_):
            number = int(value)
        else:
            raise TypeError("%s: a whole number is needed, not %r" % (name, value)) from None
    lo, hi = _LIMITS[kind]
    if not lo <= number < hi:
        raise OverflowError("%s: %d does not fit" % (name, number))
    return number


def as_float(value: Any, name: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError("%s: a number is needed, not %r" % (name, value)) from None


def as_text(value: Any, name: str) -> bytes | None:
    return None if value is None else os.fsencode(value)


def input_array(value: Any, dtype: Any, name: str, entries: int | None = None, per: int = 1) -> tuple[Any, int]:
    """(the numbers one after the other, count) of what has that many entries, or count times `per`. None stays None."""
    if value is None:
        return None, 0
    array = np.asarray(value)
    if np.dtype(dtype).kind in "iu" and array.size and (array.dtype.kind not in "iub" or array.dtype == bool):
        raise TypeError("%s: whole numbers are needed, not %s" % (name, array.dtype))
    if np.dtype(dtype).kind in "iu" and array.size:
        info = np.iinfo(dtype)
        if array.min() < info.min or array.max() > info.max:
            raise OverflowError("%s: a number does not fit" % name)
    array = np.ascontiguousarray(array, dtype=dtype).reshape(-1)
    if entries is not None and array.size != entries:
        raise ValueError("%s: %d numbers are needed, %d were given" % (name, entries, array.size))
    if per > 1 and array.size % per:
        raise ValueError("%s: a multiple of %d numbers is needed, %d were given" % (name, per, array.size))
    return array, array.size // max(per, 1)


def output_array(shape: tuple, dtype: Any) -> np.ndarray:
    return np.zeros(shape, dtype)


# ---- structs ---------------------------------------------------------------------------------------------------------

class Struct(C.Structure):
    """A struct of peri.h. Enums, arrays and texts are shown as such; array fields are NumPy arrays in place."""

    _meta_: dict[str, tuple] = {}
    _initial_: tuple = ()

    def _begin(self, init: Callable[..., None], fields: dict[str, Any]) -> None:
        unknown = [as_enum(self._meta_[n][1], fields[n], n) if fields.get(n) is not None else 0 for n in self._initial_]
        super().__init__()
        init(C.byref(self), *unknown)
        self._keep = {}
        self._fill({n: v for n, v in fields.items() if n not in self._initial_}, None)

    def _fill(self, fields: dict[str, Any], owner: Any) -> None:
        for name, value in fields.items():
            if value is not None:
                _SETTERS[self._meta_[name][0]](self, name, value, self._meta_[name], owner)

    def _copied(self) -> Struct:
        """A copy, so that to fill in what belongs to one call leaves the original alone."""
        new = type(self).__new__(type(self))
        C.Structure.__init__(new)
        C.memmove(C.byref(new), C.byref(self), C.sizeof(self))
        new._keep = dict(getattr(self, "_keep", {}))
        return new

    def _attach(self, report: Any) -> None:
        """Arrays that the call filled go with its report."""
        for name, how in self._meta_.items():
            if how[0] == "array out" and name in self._keep:
                array, rows = self._keep[name], getattr(report, how[2], None)
                setattr(report, name, array if rows is None else array[:rows])

    def asdict(self) -> dict[str, Any]:
        return {name.lstrip("_"): getattr(self, name.lstrip("_")) for name, _ in self._fields_
                if name not in ("cookie", "reserved")}

    def __repr__(self) -> str:
        return "%s(%s)" % (type(self).__name__, ", ".join("%s=%s" % (n, v.name if isinstance(v, IntEnum) else v)
                                                           for n, v in self.asdict().items()))


def _set_array(self: Any, name: str, value: Any, how: tuple, owner: Any) -> None:
    dim = owner.dimension if owner is not None else 0
    if how[0] == "array in":
        per = how[3](dim) if "dim" not in how[3].__code__.co_varnames or dim else 1
        array, count = input_array(value, how[1], name, per=per)
        setattr(self, how[2], count)
    else:
        array = value
        width = how[3](dim)
        if not isinstance(array, np.ndarray) or array.dtype != how[1] or not array.flags.c_contiguous or not array.flags.writeable \
                or array.size % max(width, 1):
            raise ValueError("%s: an array of %s of the shape (%s, %d) is needed, which can be written" % (
                name, np.dtype(how[1]).name, how[2], width))
        setattr(self, how[2], array.size // width)
    self._keep[name] = array
    setattr(self, name, array.ctypes.data)


def _set_buffer(self: Any, name: str, value: Any, how: tuple, owner: Any) -> None:
    """An array of the body's points, double or float; what is written to must be of that type already."""
    array = np.asarray(value)
    if not how[1] and array.dtype not in (np.float64, np.float32):
        array = array.astype(np.float64)
    writable = not how[1] or array is value and array.flags.writeable and array.dtype in (np.float64, np.float32)
    if not writable or owner is not None and array.size != owner.point_count * owner.dimension:
        raise ValueError("%s: an array of points*dim numbers of type double or float is needed%s" % (
            name, ", which can be written" if how[1] else ""))
    self.type = "f32" if array.dtype == np.float32 else "f64"
    if any(a.dtype != array.dtype for n, a in self._keep.items() if isinstance(a, np.ndarray)):
        raise ValueError("%s: all arrays must be of one type" % name)
    rows = np.ascontiguousarray(array)
    if how[1] and rows is not array:  # in another order: copied back after the call
        self._back = getattr(self, "_back", []) + [(array, rows)]
    self._keep[name] = rows
    setattr(self, name, rows.ctypes.data)


def set_callback(self: Any, name: str, value: Any, how: tuple, owner: Any) -> None:
    self._keep[name] = made(how[1], value, name)
    setattr(self, name, self._keep[name])


def _set_struct(self: Any, name: str, value: Any, how: tuple, owner: Any) -> None:
    if not isinstance(value, how[1]):
        raise TypeError("%s: a %s is needed, not %r" % (name, how[1].__name__, value))
    self._keep[name] = value
    setattr(self, name, C.addressof(value))


def _set_vector(self: Any, name: str, value: Any, how: tuple, owner: Any) -> None:
    numbers = np.asarray(value, how[1]).reshape(-1)
    if numbers.size > how[2]:
        raise ValueError("%s: at most %d numbers are needed, %d were given" % (name, how[2], numbers.size))
    getattr(self, name)[:numbers.size] = numbers


def _set_number(self: Any, name: str, value: Any, how: tuple, owner: Any) -> None:
    kind = dict(self._fields_)[name]
    number = as_float(value, name) if how[1] is float else as_int(value, kind, name)
    if name.endswith("_rows") and owner is not None:  # room for as many rows
        for other, more in self._meta_.items():
            if more[0] == "array out" and more[2] == name and other not in self._keep:
                _set_array(self, other, np.full((number, more[3](owner.dimension)), np.nan), more, owner)
    setattr(self, name, number)


_SETTERS: dict[str, Callable] = {
    "number": _set_number, "enum": lambda s, n, v, how, _: setattr(s, n, v), "vector": _set_vector, "callback": set_callback,
    "struct": _set_struct, "array in": _set_array, "array out": _set_array, "buffer": _set_buffer,
    "text": lambda s, n, v, how, _: setattr(s, n, v)}


def _property(cls: Any, name: str, how: tuple) -> property:
    inner = "_" + name
    at = getattr(cls, inner, None)
    if how[0] == "enum":
        def get_enum(self: Any) -> Any:
            number = getattr(self, inner)
            return how[1](number) if number in how[1]._value2member_map_ else number
        return property(get_enum, lambda self, v: setattr(self, inner, as_enum(how[1], v, name)))
    if how[0] == "vector":
        def get_vector(self: Any) -> np.ndarray:
            return np.frombuffer(self, how[1], how[2], at.offset)

        def set_vector(self: Any, value: Any) -> None:
            get_vector(self)[...] = value
        return property(get_vector, set_vector)
    return property(lambda self: (getattr(self, inner) or b"").decode())


def dress(cls: Any) -> None:
    """Shows the enums, arrays and texts of a struct."""
    for name, how in cls._meta_.items():
        if how[0] in ("enum", "vector", "text"):
            setattr(cls, name, _property(cls, name, how))


def described(cls: Any, desc: Any, fields: dict[str, Any], owner: Any = None) -> Any:
    """The descriptor of a call: one that was given, or a new one, with the fields that are not None."""
    if isinstance(desc, cls):
        new = desc._copied()
        fields = {n: v for n, v in fields.items() if v is not desc}
    else:
        initial = {n: fields.get(n) for n in cls._initial_}
        if desc is not None and not cls._initial_:
            raise TypeError("desc: a %s is needed, not %r" % (cls.__name__, desc))
        new = cls(**{n: v for n, v in initial.items() if v is not None})
        fields = {n: v for n, v in fields.items() if n not in cls._initial_}
    # rows after what they are of
    new._fill({n: v for n, v in fields.items() if not n.endswith("_rows")}, owner)
    new._fill({n: v for n, v in fields.items() if n.endswith("_rows")}, owner)
    return new


def _record_type(cls: Any) -> np.dtype:
    names = [n.lstrip("_") for n, _ in cls._fields_]
    kinds = [np.dtype(t) for _, t in cls._fields_]
    return np.dtype({"names": names, "formats": kinds, "offsets": [getattr(cls, n).offset for n, _ in cls._fields_],
                     "itemsize": C.sizeof(cls)})


def records(cls: Any, n: int) -> Any:
    """n structs, as a NumPy array with their fields."""
    return np.zeros(n, _record_type(cls)).view(np.recarray)
