"""For each triangle or tetrahedron that is not well-centered, the reason and a cure."""

from __future__ import annotations

import dataclasses
from typing import Any, Callable, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _temper
from ._measure import WorstTet
from ._mesh import MeshLike
from ._records import Record, merged, table
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, expect_no_options_of_triangles
from ._weights import Certificate, EdgeConflict, WeightReport


@dataclasses.dataclass(frozen=True, eq=False)
class CrossingSide(Record):
    """One side of the edge of a conflict: the interval in which well-centered triangles let the dual cross the edge."""

    triangles: npt.NDArray[np.int32]
    from_: float
    """Ends of the interval, as distances from the edge's first vertex, exclusive [length]."""
    to: float
    widest: int
    """Vertex of the largest angle of these triangles."""
    angle_deg: float
    """Largest angle of these triangles."""


@dataclasses.dataclass(frozen=True, eq=False)
class CrossingConflict(Record):
    """An edge whose two sides have disjoint intervals: left.to ≤ right.from_ or right.to ≤ left.from_."""

    p: int
    q: int
    length: float
    left: CrossingSide
    right: CrossingSide


@dataclasses.dataclass(frozen=True)
class FanCenter(Record):
    """The common corner of the triangles of a fan."""

    vertex: int
    on_boundary: bool
    angle_deg: float
    """Angle of the domain at a boundary vertex; else 360."""
    shortest: int
    longest: int
    shortest_length: float
    longest_length: float


@dataclasses.dataclass(frozen=True, eq=False)
class Cure(Record):
    """A change that would cure a reason."""

    action: str
    """Kind of the change; see ``text``."""
    text: str
    """The cure in one sentence."""
    edge: npt.NDArray[np.int32]
    """Two vertices, or none."""
    vertex: int
    triangle: int
    at: tuple[float, float]
    """Place of the change; on the sphere longitude and latitude, in degrees."""
    verified: bool
    """A trial on a copy succeeded: the triangles of the neighborhood then have weights that make them well-centered,
    checked exactly."""
    conflict_only: bool
    triangles: int
    ends_conflict: bool
    left_out: int
    margin: float
    changed: int


@dataclasses.dataclass(frozen=True, eq=False)
class Reason(Record):
    """A reason why triangles are not well-centered."""

    kind: Literal["split", "edge", "fan", "patch", "weights", "undecided"]
    text: str
    """The reason in words, with vertices counted from 0."""
    bad: npt.NDArray[np.int32]
    """Triangles that are not well-centered for this reason, worst first."""
    conflict: npt.NDArray[np.int32]
    """Smallest set of triangles for which no weights exist, for edge, fan, patch; ``bad`` is a part of it."""
    must_split: EdgeConflict | None
    certificate: Certificate
    """Proof for edge, fan, patch; ``check_certificate`` accepts it."""
    margin: float
    """Best margin. For edge, fan, patch: of the conflict, at most 0. For weights: of the neighborhood, above 0."""
    each: bool
    checked: int
    crossing: CrossingConflict | None
    center: FanCenter | None
    free: npt.NDArray[np.int32]
    """Corners that may move."""
    least_margin: float
    """Least h/ℓ or d/ℓ of the bad triangles as they are."""
    at: tuple[float, float]
    """Centroid of the worst triangle; on the sphere its longitude and latitude, in degrees."""
    cures_searched: bool
    cures: list[Cure]
    """Cures, best first."""


@dataclasses.dataclass(frozen=True, eq=False)
class Explanation(Record):
    """The result of ``explain``."""

    triangles: int
    bad: int
    verdict: Literal["feasible", "infeasible", "undecided"]
    """Verdict on the whole mesh with its positions and connectivity. Feasible if no triangle is bad."""
    changed: int
    margin: float
    reasons: list[Reason]
    """Reasons: certified ones first, by least margin; then by least_margin."""

    def __str__(self) -> str:
        return "\n".join([super().__str__(), *(f"  {r.kind}: {r.text}" for r in self.reasons)])

    def _repr_html_(self) -> str:
        rows = [row for row in self._rows() if row[0] != "reasons"]
        reasons = [(str(r.kind), r.text + (" Cure: " + r.cures[0].text if r.cures else "")) for r in self.reasons]
        return table("Explanation", rows, table("reasons", reasons) if reasons else "")


@dataclasses.dataclass(frozen=True)
class FaceHeight(Record):
    """The height of the orthocenter of a tetrahedron over one of its faces."""

    vertices: tuple[int, int, int]
    boundary: bool
    h: float
    """Height, positive inside [length]."""
    h_over_l: float
    """Height over the side of the equilateral triangle with the area of the face."""
    outside: bool
    """h ≤ 0, exact."""
    crossed: bool
    """The orthocenter of the face is strictly inside it, exact."""


@dataclasses.dataclass(frozen=True)
class TetReason(WorstTet):
    """A tetrahedron that is not well-centered."""

    orthocenter: tuple[float, float, float]
    faces: list[FaceHeight]
    """Heights over its four faces."""
    all_on_boundary: bool
    """All corners are on the boundary."""
    cure: Literal["weights", "optimize", "split_boundary"]
    """What may help: ``find_weights``, ``optimize``, or ``optimize`` with ``boundary="split"``. It is not tried."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetExplanation(Record):
    """The result of ``explain`` for tetrahedra."""

    tetrahedra: int
    bad: int
    verdict: Literal["feasible", "infeasible", "undecided"]
    """Verdict on the whole mesh with its positions and connectivity; undecided if no weights were searched for."""
    all_on_boundary: int
    """Number of bad tetrahedra with all corners on the boundary."""
    weights: WeightReport | None
    """Weights of the whole mesh, or the certificate that none exist; None if they were not searched for."""
    reasons: list[TetReason]
    """Bad tetrahedra, worst first."""

    def __str__(self) -> str:
        return "\n".join([super().__str__(), *(f"  tetrahedron {r.tetrahedron}: {r.why}" for r in self.reasons)])


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


@overload
def explain(
    mesh: TetMesh, *, cures: int = ..., whole: int = ..., progress: Callable[[int, int], Any] | None = ...
) -> TetExplanation: ...
@overload
def explain(
    mesh: MeshLike, *, cures: int = ..., whole: int = ..., progress: Callable[[int, int], Any] | None = ...
) -> Explanation: ...
def explain(
    mesh: AnyMeshLike,
    *,
    cures: int = 20,
    whole: int = 1000,
    progress: Callable[[int, int], Any] | None = None,
) -> Explanation | TetExplanation:
    """Explains each triangle that is not well-centered by exactly one reason (docs/explanation/proofs.md). For each
    tetrahedron that is not well-centered, it gives the heights over its faces, and what may help.

    Parameters
    ----------
    mesh : Mesh, TetMesh, or of another library
    cures : int
        Largest number of reasons, the worst, for which cures are searched. For triangles alone.
    whole : int
        Size limit of the search for weights of the whole mesh: at most this many triangles or tetrahedra, or this many
        bad ones.
    progress : callable, optional
        Function that is called now and then with the number of explained bad triangles, and the number of all. If it
        returns False, the call stops with TemperError. For triangles alone.

    Returns
    -------
    Explanation, or TetExplanation for tetrahedra

    Notes
    -----
    Verdicts rest on exact predicates and on ``check_certificate``. About 1 ms per bad triangle, and some 10 ms more per
    reason whose cures are searched. Ctrl-C stops the call.

    >>> import temper
    >>> why = temper.explain(temper.generate.sparse_horseshoe())
    >>> why.verdict, len(why.reasons) > 0
    ('infeasible', True)
    """
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(explain, cures=cures, progress=progress)
        d = _temper.tet_explain(any_mesh._handle, whole)
        weights = None if d["weights"] is None else WeightReport._of(d["weights"])
        reasons = [TetReason(**merged(r, faces=[FaceHeight(**f) for f in r["faces"]])) for r in d["reasons"]]
        return TetExplanation(**merged(d, weights=weights, reasons=reasons))
    d = _temper.explain(any_mesh._handle, cures, whole, progress)
    return Explanation(**merged(d, reasons=[_reason(r) for r in d["reasons"]]))
