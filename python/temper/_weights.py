"""Weights alone: can a mesh become well-centered when neither its positions nor its connectivity may change?"""

from __future__ import annotations

import dataclasses
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike, _ints, as_mesh
from ._records import Record, merged

Conditions = Literal["well_centered", "heights_only"]


@dataclasses.dataclass(frozen=True)
class WeightConstraint:
    """One inequality that a well-centered mesh keeps."""

    kind: Literal["height", "split"]
    """height: h over edge pq of the triangle pqr, counter-clockwise; split: d from p towards q, for any edge pq."""
    p: int
    q: int
    r: int
    """−1 for a split."""


@dataclasses.dataclass(frozen=True)
class Certificate(Record):
    """Why no weights exist (Farkas): constraints with multipliers ≥ 0 whose sum contradicts itself. The polynomials are
    in ``temper/feasibility.hpp`` and docs/weights.md."""

    margin: float
    """Refuted: no weights have all h > margin ℓ and margin ℓ < d < (1 − margin) ℓ."""
    terms: list[tuple[WeightConstraint, float]]
    """Constraints and their multipliers; none: no certificate."""

    def _plain(self) -> dict[str, Any]:
        return {"margin": self.margin, "terms": [((c.kind, c.p, c.q, c.r), float(m)) for c, m in self.terms]}

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Certificate:
        return cls(d["margin"], [(WeightConstraint(*c), m) for c, m in d["terms"]])


@dataclasses.dataclass(frozen=True, eq=False)
class BestMargin(Record):
    """The largest margin that any weights attain."""

    status: Literal["optimal", "infeasible", "unbounded", "failed"]
    margin: float
    """t*; negative: no weights are good."""
    tight: list[WeightConstraint]
    """The constraints that keep it from being larger."""
    certificate: Certificate
    """Refutes margin 0; no terms unless t* ≤ 0 and the checker agrees."""
    vertices: npt.NDArray[np.int32]
    """Of the triangles asked about."""
    weights: npt.NDArray[np.float64]
    """Of these vertices, with margin t* [length²]: for proofs, not for meshes, where weights go far for its sake."""


@dataclasses.dataclass(frozen=True)
class Violation(Record):
    """A constraint that elastic weights do not keep."""

    constraint: WeightConstraint
    value: float
    """h/ℓ or d/ℓ that the weights give."""
    shortfall: float
    """Of the margin asked for."""
    angle_deg: float
    """height: of the triangle at r, across from the edge."""


@dataclasses.dataclass(frozen=True, eq=False)
class WeightReport(Record):
    """What ``find_weights`` found."""

    verdict: Literal["feasible", "infeasible", "undecided"]
    """feasible: the weights found make every triangle well-centered, by the exact predicate; infeasible: no weights do,
    by a certificate that the exact checker accepts."""
    margin: float
    """Best margin."""
    margin_is: Literal["exact", "at_least", "at_most"]
    """What is known of it: up to rounding; attained, more was not tried; of the worst neighbourhood."""
    solved: bool
    """``weights`` are an answer to what was asked."""
    asked: float
    attained: float
    moved: int
    """Weights that differ from where change is measured from."""
    change: float
    """Σ over edges \\|Δw_i − Δw_j\\| / (2ℓ) [length]."""
    programmes: int
    largest: int
    """Triangles of the largest programme."""
    weights: npt.NDArray[np.float64]
    """One a vertex of the mesh [length²]: ``mesh.weights = report.weights``."""
    violations: list[Violation]
    """elastic: worst first."""
    certificate: Certificate


def find_weights(
    mesh: MeshLike,
    *,
    goal: Literal["feasible", "minimal", "elastic"] = "minimal",
    margin: float = 0.01,
    from_input: bool = False,
    whole: int = 3000,
    rings: int = 2,
) -> WeightReport:
    """Finds weights for a mesh whose positions and connectivity stay, by linear programming (Clp). The mesh is not
    changed.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
    goal : {"minimal", "feasible", "elastic"}
        The least change for the margin asked for; the best margin, and the least change for the margin asked for or for
        half of the best one; the least violation, and then the least change.
    margin : float
        t in [0, 1/2): all h ≥ tℓ and tℓ ≤ d ≤ (1 − t)ℓ.
    from_input : bool
        Change is measured from the mesh's weights; else from zero.
    whole : int
        Components of at most this many triangles are one linear programme; larger ones are solved around their bad
        triangles only.
    rings : int
        Of vertices around bad triangles, at first.

    Notes
    -----
    For fixed positions and connectivity every h and d is linear in the weights. What the solver says is never believed:
    verdicts rest on exact predicates and on ``check_certificate``.

    >>> import temper
    >>> mesh = temper.generate.sparse_horseshoe()
    >>> report = temper.find_weights(mesh, goal="feasible")
    >>> report.verdict, round(report.margin, 10)
    ('infeasible', -0.0592592593)
    >>> temper.check_certificate(mesh, report.certificate)
    'proves'
    """
    d = _temper.find_weights(as_mesh(mesh)._handle, goal, margin, from_input, whole, rings)
    violations = [Violation(**merged(v, constraint=WeightConstraint(*v["constraint"]))) for v in d["violations"]]
    return WeightReport(**merged(d, violations=violations, certificate=Certificate._of(d["certificate"])))


def best_margin(
    mesh: MeshLike, triangles: npt.ArrayLike | None = None, *, conditions: Conditions = "well_centered"
) -> BestMargin:
    """The best margin of some triangles, (k,) int, the rest of the mesh being left out; None: of the whole mesh. An
    upper bound for any set that has them."""
    chosen = None if triangles is None else _ints(triangles, 0, "triangles").astype(np.int64)
    d = _temper.best_margin(as_mesh(mesh)._handle, chosen, conditions)
    tight = [WeightConstraint(*c) for c in d["tight"]]
    return BestMargin(**merged(d, tight=tight, certificate=Certificate._of(d["certificate"])))


def weight_margin(mesh: MeshLike, *, conditions: Conditions = "well_centered") -> float:
    """The least h/ℓ, d/ℓ and 1 − d/ℓ of the mesh's own weights, in doubles."""
    return _temper.weight_margin(as_mesh(mesh)._handle, conditions)


def check_certificate(
    mesh: MeshLike, certificate: Certificate
) -> str:
    """Verifies a certificate in exact arithmetic, from the positions alone: ``"proves"`` when no weights exist, else
    what is wrong with it."""
    return _temper.check_certificate(as_mesh(mesh)._handle, certificate._plain())


# --- necessity -------------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class EdgeConflict(Record):
    """An edge u → v whose dual must cross it near u for the sake of one vertex, and near v for the sake of another."""

    edge: tuple[int, int]
    """u, v."""
    halfedge: int
    near_u: int
    near_v: int
    a: float
    """Parts of the edge's length."""
    b: float
    sum: float
    """a + b: at most 1 when there is no place for the crossing."""
    split_at: float
    """Part of the way from u: the middle of what is left out, but no closer to an end than 0.2."""


def edge_conflict(mesh: MeshLike, halfedge: int, *, up_to: float = 1.0) -> EdgeConflict | None:
    """The conflict of one edge when a + b ≤ up_to, exactly: with up_to = 1, no well-centered mesh has this edge and
    these two vertices (docs/explain.md)."""
    d = _temper.edge_conflict(as_mesh(mesh)._handle, halfedge, up_to)
    return None if d is None else EdgeConflict(**d)


def edges_that_must_be_split(mesh: MeshLike, *, up_to: float = 1.0) -> list[EdgeConflict]:
    """All edges of the boundary and of constrained lines with such a conflict, least sum first. None does not mean that
    there is a well-centered mesh."""
    return [EdgeConflict(**d) for d in _temper.edges_that_must_be_split(as_mesh(mesh)._handle, up_to)]
