"""Records that show more than their fields. The fields come from the tables of reports (_reports.py)."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._records import Record, table

if TYPE_CHECKING:
    from ._mesh import Mesh


class Histogram(Record):
    @property
    def edges(self: Any) -> npt.NDArray[np.float64]:
        """The ends of the bins for ``matplotlib.pyplot.stairs``, one more than bins."""
        return np.linspace(self.low, self.high, len(self.counts) + 1)


class Quality(Record):
    def _repr_html_(self: Any) -> str:
        rows = [row for row in self._rows() if row[0] not in ("worst", "energy")]
        worst = [(f"triangle {w.triangle}", w.why) for w in self.worst]
        return table("Quality", rows, table("worst triangles", worst) if worst else "")


class TetQuality(Record):
    def _repr_html_(self: Any) -> str:
        rows = [row for row in self._rows() if row[0] != "worst"]
        worst = [(f"tetrahedron {w.tetrahedron}", w.why) for w in self.worst]
        return table("TetQuality", rows, table("worst tetrahedra", worst) if worst else "")


class FieldFrame(Record):
    def _plain(self: Any) -> tuple[float, ...]:
        return (*self.center, self.half_size)


class Explanation(Record):
    def __str__(self: Any) -> str:
        return "\n".join([Record.__str__(self), *(f"  {r.kind}: {r.text}" for r in self.reasons)])

    def _repr_html_(self: Any) -> str:
        rows = [row for row in self._rows() if row[0] != "reasons"]
        reasons = [(str(r.kind), r.text + (" Cure: " + r.cures[0].text if r.cures else "")) for r in self.reasons]
        return table("Explanation", rows, table("reasons", reasons) if reasons else "")


class TetExplanation(Record):
    def __str__(self: Any) -> str:
        return "\n".join([Record.__str__(self), *(f"  tetrahedron {r.tetrahedron}: {r.text}" for r in self.reasons)])


def _rows_of_run(report: Any, elements: str) -> list[tuple[str, str]]:
    shown_below = ("vertices", "hidden_vertices", "bad_before", "bad_after", "size", "changed", "data", "notes")
    rows = [row for row in Record._rows(report) if row[0] not in shown_below]
    rows.insert(1, (f"bad {elements}", f"{report.bad_before} → {report.bad_after}"))
    return rows


@dataclasses.dataclass(frozen=True, eq=False)
class OptimizeReport(Record):
    _meshes: tuple[Mesh, Mesh] | None = dataclasses.field(default=None, repr=False, compare=False, kw_only=True)
    """The mesh before and after, for notebooks."""

    def _rows(self: Any) -> list[tuple[str, str]]:
        rows = _rows_of_run(self, "triangles" if self.size else "tetrahedra")
        if self.size:
            rows.append(("sizes within", f"1/{self.size.after.band:.3g} to {self.size.after.band:.3g} of the field"))
        if self.data is not None and self.data.interpolated:
            moved = f"of {self.data.points_moved} moved points: {', '.join(self.data.interpolated)}"
            rows.append(("interpolated", moved))
        return rows + [("note", note) for note in self.notes]

    def as_dict(self: Any) -> dict[str, Any]:
        """Adds the history to ``Record.as_dict``."""
        return {**Record.as_dict(self), "history": [record.as_dict() for record in self.history]}


class SurfaceOptimizeReport(Record):
    def _rows(self: Any) -> list[tuple[str, str]]:
        return _rows_of_run(self, "triangles") + [("note", note) for note in self.notes]

    as_dict = OptimizeReport.as_dict
