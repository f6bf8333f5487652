# SPDX-License-Identifier: MIT
"""What _generated.py stands on: the library, its errors, calls, callbacks that carry exceptions, handles."""
# mypy: ignore-errors
from __future__ import annotations

import ctypes as C
import glob
import operator
import os
import signal
import threading
import weakref
from typing import Any, Callable, TypeVar

import numpy as np


def _load() -> C.CDLL:
    """The library beside this file, or what PERI_LIBRARY names. While it is loaded OpenMP is told that threads that wait shall sleep:
    where others share the machine, waiting would cost more than it gives."""
    here = os.path.dirname(os.path.abspath(__file__))
    found = sorted(f for f in glob.glob(os.path.join(here, "libperi*")) if f.endswith((".so", ".dylib", ".dll", ".pyd")))
    path = os.environ.get("PERI_LIBRARY") or (found[0] if found else "")
    if not path:
        raise ImportError("peri: no compiled library in %s: is this the source folder? Install the package by pip, or set PERI_LIBRARY"
                          % here)
    policy = os.environ.get("OMP_WAIT_POLICY")
    if policy is None:
        os.environ["OMP_WAIT_POLICY"] = "passive"
    try:
        return C.CDLL(path)
    finally:
        if policy is None:
            del os.environ["OMP_WAIT_POLICY"]


lib = _load()


def declare(prototypes: dict[str, tuple]) -> None:
    for name, (result, arguments) in prototypes.items():
        function = getattr(lib, name, None)
        if function is not None:  # left out of this build
            function.restype, function.argtypes = result, arguments


# ---- errors ----------------------------------------------------------------------------------------------------------

class PeriError(Exception):
    """A call that failed. status: what happened; field: the name in peri.h of what is at fault, or ""; index: the first offending point,
    entry or id, or -1; value: the offending value, or the limit that was passed."""

    def __init__(self, text: str, status: int = 0, field: str = "", index: int = -1, value: float = 0.0) -> None:
        super().__init__(text)
        self.status, self.field, self.index, self.value = status, field, index, value


ERRORS: dict[int, type[PeriError]] = {}


class _ErrorRecord(C.Structure):  # peri_error, needed before structs are declared; tests compare it
    _fields_ = [("code", C.c_int32), ("reserved", C.c_int32), ("index", C.c_int64), ("value", C.c_double), ("field", C.c_char_p),
                ("text", C.c_char_p)]


def _error(owner: Any, result: int, record: Any = None) -> PeriError:
    """The exception of a result below 0: by the record that the call filled, or that its body keeps."""
    if record is None and owner is not None and owner._destroy == "peri_body_destroy":
        record = _ErrorRecord()
        lib.peri_get_error(owner._pointer, C.byref(record))
    kind = ERRORS.get(result, PeriError)
    if record is None or record.code != result:
        return kind(lib.peri_status_text(result).decode(), result)
    text = C.create_string_buffer(400)
    lib.peri_format_error(C.byref(record), text, 400)
    field = record.field if isinstance(record.field, str) else (record.field or b"").decode()
    return kind(text.value.decode(), result, field, record.index, record.value)


# ---- calls and callbacks ---------------------------------------------------------------------------------------------

class _Call:
    """One call into the library. A callback that raises leaves its exception here and fails, which ends the call; then it goes on."""

    __slots__ = ("owner", "raised", "interrupted", "inside")

    def __init__(self, owner: Any) -> None:
        self.owner, self.raised, self.interrupted, self.inside = owner, None, False, False


class _Threads(threading.local):
    def __init__(self) -> None:
        self.calls: list[_Call] = []


_threads = _Threads()


class _Guard:
    """Ctrl-C while the library runs. The interpreter may raise KeyboardInterrupt at the first line of a callback, where nothing can
    catch it; so the signal is noted, and the next callback fails. Within a callback of the user it is raised where it came."""

    def __init__(self, one: _Call) -> None:
        self.one, self.before = one, None

    def __enter__(self) -> None:
        if threading.current_thread() is threading.main_thread() and callable(signal.getsignal(signal.SIGINT)):
            self.before = signal.signal(signal.SIGINT, self.came)

    def came(self, number: int, frame: Any) -> None:
        if self.one.inside:
            self.before(number, frame)
        else:
            self.one.interrupted = True

    def __exit__(self, *_: Any) -> None:
        if self.before is not None:
            signal.signal(signal.SIGINT, self.before)
            if self.one.interrupted and self.one.raised is None:
                try:
                    self.before(signal.SIGINT, None)
                except BaseException as e:  # noqa: B902
                    self.one.raised = e


def call(owner: Any, function: Callable[..., int], arguments: tuple, error: Any = None, guard: bool = False, keep: tuple = ()) -> int:
    """Calls the library: without the interpreter's lock, one thread at a time per body. Raises what a callback raised, or PeriError."""
    one = _Call(owner)
    handle = owner._handle if owner is not None else None  # lives as long as the call
    _threads.calls.append(one)
    try:
        if handle is not None:
            handle.lock.acquire()
        try:
            if guard:
                with _Guard(one):
                    result = function(*arguments)
            else:
                result = function(*arguments)
            for desc in keep:
                for array, rows in getattr(desc, "_back", ()):
                    array[...] = rows.reshape(array.shape)
            if one.raised is not None:
                raise one.raised
            if result < 0:
                raise _error(owner, result, error)
            if handle is not None and keep:
                handle.keep_alive(function.__name__, result, keep)
            return result
        finally:
            if handle is not None:
                handle.lock.release()
    finally:
        _threads.calls.pop()
        one.raised = None


# Called within the one call that got them; all others stay with the body.
_TRANSIENT = ["peri_%s_fn" % name for name in ("point", "pair", "write", "read", "frame", "iteration")]


class Callback:
    """How the arguments of a callback are handed to Python: (which, how, type, shape) of those that Python sees."""

    def __init__(self, name: str, arguments: list, count: int, context: int) -> None:
        self.name, self.count, self.context = name, count, context
        self.arguments = [(k,) + tuple(a) for k, a in arguments]
        self.returned = [a for a in self.arguments if a[1] == "returned"]
        self.writes = name == "peri_write_fn"
        self.transient = name in _TRANSIENT


CALLBACKS: dict[Any, Callback] = {}


def function_type(name: str, result: Any, arguments: list) -> Any:
    """A type of its own for each kind of callback: C.CFUNCTYPE gives the same one to all of a signature."""
    base = C.CFUNCTYPE(result, *arguments)
    return type(name, (C._CFuncPtr,), {"_flags_": base._flags_, "_restype_": result, "_argtypes_": tuple(arguments)})


def _memory(address: int, dtype: Any, shape: tuple) -> np.ndarray:
    n = int(np.prod(shape))
    return np.frombuffer((C.c_char * (n * np.dtype(dtype).itemsize)).from_address(address), dtype).reshape(shape)


def made(kind: Any, fn: Any, name: str) -> Any:
    """The C function that calls fn. None stays NULL. An object that reads or writes, as an open file, stands for its method."""
    if fn is None:
        return kind()
    if isinstance(fn, kind):
        return fn
    spec = CALLBACKS[kind]
    if not callable(fn):
        method = getattr(fn, "write" if spec.writes else "read" if spec.name == "peri_read_fn" else "", None)
        if method is None:
            raise TypeError("%s: not a function: %r" % (name, fn))
        fn = method
    failed = None if kind._restype_ is None else 0 if kind._restype_ is C.c_void_p else -1

    def enter(*given: Any) -> Any:
        calls = _threads.calls
        one = calls[-1] if calls else _Call(None)
        if (one.raised is not None or one.interrupted) and failed is not None:
            return failed
        try:
            if spec.name == "peri_parallel_for_fn":
                return _tasks(fn, given, one)
            arguments, outs = _arguments(spec, given, one)
            try:
                one.inside = True
                answer = fn(*arguments)
            finally:
                one.inside = False
            for address, array in outs:
                _memory(address, array.dtype, array.shape)[...] = array
            return _answer(spec, answer, given, one, kind._restype_)
        except BaseException as e:  # noqa: B902
            if not calls:
                raise
            one.raised = one.raised or e
            return failed

    function = kind(enter)
    function._peri_python = fn
    return function


def _arguments(spec: Callback, given: tuple, one: _Call) -> tuple[list, list]:
    arguments, outs = [], []
    for k, how, *more in spec.arguments:
        value = given[k]
        if how == "value":
            arguments.append(value)
        elif how in ("in", "in out"):
            dim = one.owner.dimension
            shape = more[1](dim, 1 if dim == 2 else 3, given[spec.count] if spec.count >= 0 else 0)
            array = _memory(value, more[0], shape).copy()
            arguments.append(array)
            if how == "in out":
                outs.append((value, array))
        elif how == "body":
            arguments.append(one.owner._body_at(value) if hasattr(one.owner, "_body_at") else one.owner)
        elif how == "text":
            arguments.append(value.decode())
        elif how == "bytes in":
            arguments.append(C.string_at(value, given[spec.count]) if value else b"")
        elif how == "bytes out":
            arguments.append(given[spec.count])
    return arguments, outs


def _tasks(fn: Callable, given: tuple, one: _Call) -> None:
    """A job system of the user, fn(count, task). The library needs every task done: those that an exception kept it from are done here."""
    _, count, task, context = given
    done = bytearray(count)

    def run(k: int) -> None:
        done[k] = 1
        task(context, k)
    try:
        if one.raised is None:
            one.inside = True
            fn(count, run)
    finally:
        one.inside = False
        for k in range(count):
            if not done[k]:
                task(context, k)


def _answer(spec: Callback, answer: Any, given: tuple, one: _Call, restype: Any) -> Any:
    if restype is None:
        return None
    if spec.returned:
        answer = answer if len(spec.returned) > 1 else (answer,)
        for (k, _, dtype, shape), value in zip(spec.returned, answer):
            dim = one.owner.dimension if one.owner is not None else 0
            _memory(given[k], dtype, shape(dim, 1 if dim == 2 else 3, 0))[...] = value
        return 0
    if spec.writes:
        return 0
    if spec.name == "peri_read_fn":
        if len(answer) != given[2]:
            return -1
        C.memmove(given[1], bytes(answer), given[2])
        return 0
    if answer is None:
        return 0
    return operator.index(answer) if not isinstance(answer, np.bool_) else int(answer)


# ---- handles ---------------------------------------------------------------------------------------------------------

class _Held:
    """What a pointer of the library needs: destroyed when nothing that looks at its memory is left."""

    def __init__(self, pointer: int, destroy: str) -> None:
        self.pointer, self.lock, self.kept = pointer, threading.RLock(), {}
        weakref.finalize(self, getattr(lib, destroy), pointer).atexit = False

    def keep_alive(self, function: str, result: int, keep: tuple) -> None:
        """Callbacks stay with the body until what they belong to is removed, or another takes its place."""
        functions = [f for one in keep for f in (one._keep.values() if hasattr(one, "_keep") else (one,)) if isinstance(f, C._CFuncPtr)]
        stay = [f for f in functions if not CALLBACKS[type(f)].transient]
        if stay:
            self.kept[(function, result)] = stay


_H = TypeVar("_H", bound="Handle")


class Handle:
    """A thing of the library. `with` closes it; so does the end of its last reference."""

    _destroy = ""
    _handle: _Held | None

    def _take(self, pointer: int, keep: Any = None) -> None:
        self._handle = _Held(pointer, self._destroy)
        if keep is not None:
            self._handle.kept.update(keep)

    @property
    def _pointer(self) -> int:
        if self._handle is None:
            raise ValueError("this %s is closed" % type(self).__name__)
        return self._handle.pointer

    def close(self) -> None:
        """Gives it back. Its memory is freed when no array that shows it is left."""
        self._handle = None

    def __enter__(self: _H) -> _H:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()
