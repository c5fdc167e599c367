"""Progress of long runs: a line on a terminal or in a notebook, nothing in a pipe."""

from __future__ import annotations

import sys
import time
from typing import Any

from ._reports import Progress

_INTERVAL = 0.1  # seconds; nobody can read faster
# The phase that lowers an objective, and what its energy is. At the change of the phase the number jumps.
_PHASES = {
    "energy": ("centering phase", "energy"),
    "accuracy": ("accuracy phase", "accuracy energy"),
    "solver_error": ("solver phase", "error"),
}


def _duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def _in_notebook() -> bool:
    """Says whether this runs in the kernel of a notebook, which shows displays."""
    if "IPython" not in sys.modules:
        return False
    shell = sys.modules["IPython"].get_ipython()
    return shell is not None and getattr(shell, "kernel", None) is not None


class Line:
    """The line that shows the progress of a run and, if known, the remaining time."""

    def __init__(self, wanted: bool | None, elements: str = "triangles") -> None:
        self._elements = elements
        notebook = wanted is not False and _in_notebook()
        terminal = sys.stderr is not None and hasattr(sys.stderr, "isatty") and sys.stderr.isatty()
        self._way: Literal["notebook", "terminal", "lines", "none"] = "none"
        if notebook:
            self._way = "notebook"
        elif wanted is not False and terminal:
            self._way = "terminal"
        elif wanted:
            self._way = "lines"
        self._start = self._last = time.monotonic()
        self._handle: Any = None
        self._shown = False

    @property
    def enabled(self) -> bool:
        return self._way != "none"

    def show(self, progress: Progress) -> None:
        now = time.monotonic()
        interval = _INTERVAL if self._way != "lines" else 100 * _INTERVAL
        if not self.enabled or (self._shown and now - self._last < interval):
            return
        self._last = now
        self._put(self.text(progress, now - self._start))

    def text(self, progress: Progress, seconds: float) -> str:
        if progress.phase:
            share = f", {100 * progress.fraction:.0f} %" if progress.fraction > 0 else ""
            return f"{progress.phase}{share}, {_duration(seconds)}"
        last = progress.last
        phase, measure = _PHASES[last.objective]
        share = "" if progress.share_of_phase is None else f" {int(100 * progress.share_of_phase)} %"
        text = (
            f"{phase}{share}: sweep {last.sweep}, {last.bad} {self._elements} bad, "
            f"{measure} {last.energy:.6g}, {_duration(seconds)}"
        )
        sweeps = last.sweep + progress.fraction
        if sweeps > 0 and progress.sweeps_left is not None:
            left = max(0.0, progress.sweeps_left - progress.fraction)
            text += f", about {_duration(seconds / sweeps * left)} left"
        return text

    def _put(self, text: str) -> None:
        self._shown = True
        if self._way == "terminal":
            sys.stderr.write(f"\r{text}\x1b[K")
            sys.stderr.flush()
        elif self._way == "lines":
            sys.stderr.write(text + "\n")
        elif self._handle is None:
            from IPython.display import display

            self._handle = display({"text/plain": text}, raw=True, display_id=True)
        else:
            self._handle.update({"text/plain": text}, raw=True)

    def clear(self) -> None:
        if self._shown and self._way == "terminal":
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()
        elif self._shown and self._way == "notebook" and self._handle is not None:
            self._handle.update({"text/plain": ""}, raw=True)
