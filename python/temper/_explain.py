"""Why not: for every triangle that is not well-centered, the reason and what would cure it."""

from __future__ import annotations

import dataclasses
from typing import Any, Callable, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike, as_mesh
from ._records import Record, merged, table
from ._weights import Certificate, EdgeConflict


@dataclasses.dataclass(frozen=True, eq=False)
class CrossingSide(Record):
    """One side of the edge in a conflict: where its triangles let the dual cross, if they are to be well-centered."""

    triangles: npt.NDArray[np.int32]
    from_: float
    """Distances from the edge's first vertex, exclusive [length]."""
    to: float
    widest: int
    """Where the largest angle of these triangles is,"""
    angle_deg: float
    """and that angle."""


@dataclasses.dataclass(frozen=True, eq=False)
class CrossingConflict(Record):
    """An edge whose sides cannot agree: left.to ≤ right.from_ or right.to ≤ left.from_."""

    p: int
    q: int
    length: float
    left: CrossingSide
    right: CrossingSide


@dataclasses.dataclass(frozen=True)
class FanCenter(Record):
    """The corner that the triangles of a fan go around."""

    vertex: int
    on_boundary: bool
    angle_deg: float
    """Of the domain there, when on the boundary; else 360."""
    shortest: int
    longest: int
    shortest_length: float
    longest_length: float


@dataclasses.dataclass(frozen=True, eq=False)
class Cure(Record):
    """What would cure a reason."""

    action: str
    """What to do; see ``text``."""
    text: str
    """A sentence."""
    edge: npt.NDArray[np.int32]
    """Two vertices, or none."""
    vertex: int
    triangle: int
    at: tuple[float, float]
    """Where; on the sphere longitude and latitude, in degrees."""
    verified: bool
    """Tried: the triangles of the neighborhood then have weights that make them well-centered, exactly checked."""
    conflict_only: bool
    triangles: int
    ends_conflict: bool
    left_out: int
    margin: float
    changed: int


@dataclasses.dataclass(frozen=True, eq=False)
class Reason(Record):
    """Why triangles are not well-centered."""

    kind: Literal["split", "edge", "fan", "patch", "weights", "undecided"]
    text: str
    """What the reason says to people, with vertices counted from 0."""
    bad: npt.NDArray[np.int32]
    """Triangles not well-centered for this reason, worst first."""
    conflict: npt.NDArray[np.int32]
    """edge, fan, patch: the smallest set of triangles that no weights suit; ``bad`` are of these."""
    must_split: EdgeConflict | None
    certificate: Certificate
    """edge, fan, patch: the proof; ``check_certificate`` accepts it."""
    margin: float
    """edge, fan, patch: best margin of the conflict, at most 0. weights: of the neighborhood, above 0."""
    each: bool
    checked: int
    crossing: CrossingConflict | None
    center: FanCenter | None
    free: npt.NDArray[np.int32]
    """Corners that may move."""
    least_margin: float
    """Least h/ℓ or d/ℓ of the bad triangles as they are."""
    at: tuple[float, float]
    """Centroid of the worst of them; on the sphere its longitude and latitude, in degrees."""
    cures_searched: bool
    cures: list[Cure]
    """Best first."""


@dataclasses.dataclass(frozen=True, eq=False)
class Explanation(Record):
    """What ``explain`` found."""

    triangles: int
    bad: int
    verdict: Literal["feasible", "infeasible", "undecided"]
    """Of the whole mesh, positions and connectivity as they are. Feasible when nothing is bad."""
    changed: int
    margin: float
    reasons: list[Reason]
    """Certified ones first, least margin first; then by least_margin."""

    def __str__(self) -> str:
        return "\n".join([super().__str__(), *(f"  {r.kind}: {r.text}" for r in self.reasons)])

    def _repr_html_(self) -> str:
        rows = [row for row in self._rows() if row[0] != "reasons"]
        reasons = [(str(r.kind), r.text + (" Cure: " + r.cures[0].text if r.cures else "")) for r in self.reasons]
        return table("Explanation", rows, table("reasons", reasons) if reasons else "")


def _crossing(d: dict[str, Any] | None) -> CrossingConflict | None:
    if d is None:
        return None
    return CrossingConflict(**merged(d, left=CrossingSide(**d["left"]), right=CrossingSide(**d["right"])))


def _reason(d: dict[str, Any]) -> Reason:
    changed = {
        "must_split": EdgeConflict(**d["must_split"]) if d["must_split"] is not None else None,
        "certificate": Certificate._of(d["certificate"]),
        "crossing": _crossing(d["crossing"]),
        "center": FanCenter(**d["center"]) if d["center"] is not None else None,
        "cures": [Cure(**cure) for cure in d["cures"]],
    }
    return Reason(**merged(d, **changed))


def explain(
    mesh: MeshLike,
    *,
    cures: int = 20,
    whole: int = 1000,
    progress: Callable[[int, int], Any] | None = None,
) -> Explanation:
    """Explains each triangle that is not well-centered, by exactly one reason (docs/explain.md).

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
    cures : int
        Cures are searched for so many reasons, the worst.
    whole : int
        Weights are asked of the whole mesh when it has at most so many triangles, or so many bad ones.
    progress : callable, optional
        Called now and then with how many of the bad triangles are explained, and how many there are; returning False
        stops, with TemperError.

    Notes
    -----
    Verdicts rest on exact predicates and on ``check_certificate``. About a millisecond a bad triangle, and some ten
    more a reason whose cures are searched. Ctrl-C is honoured.

    >>> import temper
    >>> why = temper.explain(temper.generate.sparse_horseshoe())
    >>> why.verdict, len(why.reasons) > 0
    ('infeasible', True)
    """
    d = _temper.explain(as_mesh(mesh)._handle, cures, whole, progress)
    return Explanation(**merged(d, reasons=[_reason(r) for r in d["reasons"]]))
