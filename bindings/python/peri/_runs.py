# SPDX-License-Identifier: MIT
"""Runs that are watched: Ctrl-C ends them, a bar shows how far they have come."""
# mypy: ignore-errors
from __future__ import annotations

import sys
import time
from typing import Any

from ._values import set_callback


class _Progress:
    """A bar of tqdm where that is installed, else a line of text at the terminal, ten times a second at most."""

    def __init__(self, what: str) -> None:
        self.what, self.shown, self.last, self.bar = what, 0.0, 0.0, None
        try:
            from tqdm.auto import tqdm
            self.bar = tqdm(total=100, desc=what, bar_format="{l_bar}{bar}| {elapsed}<{remaining}", leave=True)
        except ImportError:
            pass

    def show(self, part: float) -> None:
        part = min(max(100 * part, self.shown), 100)
        if self.bar is not None:
            self.bar.update(part - self.shown)
        elif part >= 100 or time.monotonic() - self.last > 0.1:
            self.last = time.monotonic()
            sys.stderr.write("\r%s %3.0f %%%s" % (self.what, part, "\n" if part >= 100 and self.shown < 100 else ""))
            sys.stderr.flush()
        self.shown = part
        if part >= 100 and self.bar is not None:
            self.bar.close()
            self.bar = None


def watched(owner: Any, desc: Any, progress: bool) -> None:
    """Sees to it that a long run comes back to Python now and then, so that Ctrl-C ends it, and shows how far it has come."""
    if hasattr(desc, "frame_steps"):
        given = desc._keep.get("on_frame")
        if given is None:  # each tenth of a second or so
            desc.frame_steps = max(1, min(1000, 30_000_000 // max(owner.entry_count, 1)))
        elif not progress:
            return
        bar = _Progress("advance") if progress else None
        start, first, fn = owner.time, owner.step_count, getattr(given, "_peri_python", None)
        steps, duration = desc.steps, desc.duration

        def on_frame(body: Any) -> Any:
            if bar:
                bar.show((body.step_count - first) / steps if steps else (body.time - start) / (duration or 1))
            return fn(body) if fn else 0
        set_callback(desc, "on_frame", on_frame, desc._meta_["on_frame"], owner)
        return
    if not hasattr(desc, "on_step"):
        return
    if desc._keep.get("on_iteration") is None:
        set_callback(desc, "on_iteration", lambda iteration, residual: 0, desc._meta_["on_iteration"], owner)
    if progress:
        bar, given, done, steps = _Progress("solve"), desc._keep.get("on_step"), [0], max(desc.steps, 1)
        fn = getattr(given, "_peri_python", None)

        def on_step(body: Any) -> Any:
            done[0] += 1
            bar.show(done[0] / steps)
            return fn(body) if fn else 0
        set_callback(desc, "on_step", on_step, desc._meta_["on_step"], owner)
