"""Progress of long runs: a line on a terminal, the same line in a notebook, nothing in a pipe."""

from __future__ import annotations

import dataclasses
import sys
import time
from typing import Any, Literal

from ._records import Record

_INTERVAL = 0.1  # seconds; faster than this nobody reads


@dataclasses.dataclass(frozen=True)
class SweepRecord(Record):
    """One sweep over all vertices."""

    sweep: int
    """0 is the input."""
    energy: float
    """Total energy at the end of the sweep, at that sweep's γ; with the objective ``accuracy`` see docs/accuracy.md."""
    bad: int
    """Triangles that are not well-centered."""
    flips: int
    """Edge flips of this sweep."""
    length_parameter: float
    """γ or −h° of this sweep, as used (relative to ℓ by default)."""
    seconds: float
    """Since the start of the optimization."""
    objective: Literal["energy", "accuracy", "solver_error"] = "energy"
    """What the sweep lowered."""


@dataclasses.dataclass(frozen=True)
class Progress(Record):
    """What observers are told, at least once a sweep, and on large meshes more often."""

    last: SweepRecord
    """The last whole sweep."""
    fraction: float
    """Of the sweep under way, in [0, 1)."""
    max_sweeps: int
    sweeps_left: float | None = None
    """An estimate of the sweeps after the last one, while the energy converges; None in the first sweeps of a stage."""


def _duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def _in_notebook() -> bool:
    """Whether this runs in the kernel of a notebook, which shows displays."""
    if "IPython" not in sys.modules:
        return False
    shell = sys.modules["IPython"].get_ipython()
    return shell is not None and getattr(shell, "kernel", None) is not None


class Line:
    """The line that says how far a run is, and how long it will about take when that can be told."""

    def __init__(self, wanted: bool | None) -> None:
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

    @staticmethod
    def text(progress: Progress, seconds: float) -> str:
        last = progress.last
        text = (
            f"sweep {last.sweep} of at most {progress.max_sweeps}, {last.bad} triangles bad, "
            f"energy {last.energy:.6g}, {_duration(seconds)}"
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
