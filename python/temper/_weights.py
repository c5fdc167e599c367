"""Weights alone: can a mesh become well-centered when neither its positions nor its connectivity may change? And with
which connectivity does it have better weights?"""

from __future__ import annotations

import dataclasses
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, _ints, as_mesh
from ._records import Record, merged

Constraints = Literal["well_centered", "heights_only", "regular"]


@dataclasses.dataclass(frozen=True)
class ConstraintsInfo(Record):
    """A row of the table of constraints: the inequalities that count."""

    name: Constraints
    keeps: str
    """The inequalities for a margin t."""
    success: str
    """A sentence of what was found."""
    failure: str


def constraints_table() -> list[ConstraintsInfo]:
    """well_centered: all h and d; heights_only: all h, so that orthocenters are inside their triangles; regular: the dual
    lengths of edges inside the mesh, of all of them or of those prescribed."""
    return [ConstraintsInfo(**row) for row in _temper.constraints_table()]


def _edges(edges: npt.ArrayLike | None) -> npt.NDArray[np.int64] | None:
    return None if edges is None else _ints(edges, 2, "edges").astype(np.int64)


@dataclasses.dataclass(frozen=True)
class WeightConstraint:
    """One inequality of some constraints."""

    kind: Literal["height", "crossing", "dual"]
    """height: h over edge pq of the triangle pqr, counter-clockwise; crossing: d from p towards q, for any edge pq; dual:
    the dual length of pq between the triangles pqr and qps."""
    p: int
    q: int
    r: int
    """−1 for a crossing."""
    s: int = -1
    """Of a dual only, else −1."""


@dataclasses.dataclass(frozen=True)
class Certificate(Record):
    """Why no weights exist (Farkas): constraints with multipliers ≥ 0 whose sum contradicts itself. The polynomials are
    in ``temper/feasibility.hpp`` and docs/weights.md."""

    margin: float
    """Refuted: no weights keep the constraints with more than this margin."""
    terms: list[tuple[WeightConstraint, float]]
    """Constraints and their multipliers; none: no certificate."""
    constraints: Constraints = "well_centered"
    """Those of ``regular`` speak of weights that differ by less than 2²⁰ ℓ² along edges."""

    def _plain(self) -> dict[str, Any]:
        terms = [((c.kind, c.p, c.q, c.r, c.s), float(m)) for c, m in self.terms]
        return {"margin": self.margin, "terms": terms, "constraints": self.constraints}

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Certificate:
        return cls(d["margin"], [(WeightConstraint(*c), m) for c, m in d["terms"]], d["constraints"])


@dataclasses.dataclass(frozen=True, eq=False)
class BestMargin(Record):
    """The largest margin that any weights attain."""

    status: Literal["optimal", "infeasible", "unbounded", "failed"]
    margin: float
    """t*; negative: no weights are good."""
    tight: list[WeightConstraint]
    """The constraints that keep it from being larger."""
    certificate: Certificate
    """Refutes margin 0, of ``regular`` 2⁻¹⁰; no terms unless t* ≤ 0 and the checker agrees."""
    vertices: npt.NDArray[np.int32]
    """Of the triangles asked about."""
    weights: npt.NDArray[np.float64]
    """Of these vertices, with margin t* [length²]: for proofs, not for meshes, where weights go far for its sake."""


@dataclasses.dataclass(frozen=True)
class Violation(Record):
    """A constraint that elastic weights do not keep."""

    constraint: WeightConstraint
    value: float
    """h/ℓ, d/ℓ or dual length/ℓ that the weights give."""
    shortfall: float
    """Of the margin asked for."""
    angle_deg: float
    """height: of the triangle at r, across from the edge."""


@dataclasses.dataclass(frozen=True, eq=False)
class WeightReport(Record):
    """What ``find_weights`` found."""

    verdict: Literal["feasible", "infeasible", "undecided"]
    """feasible: the weights found keep the constraints, by exact predicates; infeasible: no weights do, by a certificate
    that the exact checker accepts."""
    margin: float
    """Best margin."""
    margin_kind: Literal["exact", "at_least", "at_most"]
    """What is known of it: up to rounding; attained, more was not tried; of the worst neighborhood."""
    solved: bool
    """``weights`` are an answer to what was asked."""
    asked: float
    attained: float
    moved: int
    """Weights that differ from where change is measured from."""
    change: float
    """Σ over edges \\|Δw_i − Δw_j\\| / (2ℓ) [length]."""
    programs: int
    largest: int
    """Triangles of the largest program."""
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
    constraints: Constraints = "well_centered",
    edges: npt.ArrayLike | None = None,
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
        t in [0, 1/2): all h ≥ tℓ and tℓ ≤ d ≤ (1 − t)ℓ, or what the constraints are.
    from_input : bool
        Change is measured from the mesh's weights; else from zero.
    whole : int
        Components of at most this many triangles are one linear program; larger ones are solved around their bad
        triangles only.
    rings : int
        Of vertices around bad triangles, at first.
    constraints : {"well_centered", "heights_only", "regular"}
        What the weights have to keep: see ``constraints_table``.
    edges : (k, 2) int, optional
        Of ``regular``: the edges prescribed, by their vertices; None: all. Those on the boundary always are regular.

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
    >>> temper.find_weights(mesh, constraints="heights_only").verdict
    'feasible'
    """
    handle = as_mesh(mesh)._handle
    d = _temper.find_weights(handle, goal, margin, from_input, whole, rings, constraints, _edges(edges))
    violations = [Violation(**merged(v, constraint=WeightConstraint(*v["constraint"]))) for v in d["violations"]]
    return WeightReport(**merged(d, violations=violations, certificate=Certificate._of(d["certificate"])))


def best_margin(
    mesh: MeshLike,
    triangles: npt.ArrayLike | None = None,
    *,
    constraints: Constraints = "well_centered",
    edges: npt.ArrayLike | None = None,
) -> BestMargin:
    """The best margin of some triangles, (k,) int, the rest of the mesh being left out; None: of the whole mesh. An
    upper bound for any set that has them. ``edges`` as for ``find_weights``; of ``regular`` it is 1/2, where programs
    stop, or 0."""
    chosen = None if triangles is None else _ints(triangles, 0, "triangles").astype(np.int64)
    d = _temper.best_margin(as_mesh(mesh)._handle, chosen, constraints, _edges(edges))
    tight = [WeightConstraint(*c) for c in d["tight"]]
    return BestMargin(**merged(d, tight=tight, certificate=Certificate._of(d["certificate"])))


def weight_margin(
    mesh: MeshLike, *, constraints: Constraints = "well_centered", edges: npt.ArrayLike | None = None
) -> float:
    """The least h/ℓ, d/ℓ, 1 − d/ℓ or dual length/ℓ that the constraints have, of the mesh's own weights, in doubles;
    infinite when they have none."""
    return _temper.weight_margin(as_mesh(mesh)._handle, constraints, _edges(edges))


def weight_change(mesh: MeshLike, before: npt.ArrayLike, after: npt.ArrayLike) -> float:
    """Σ over edges |Δw_i − Δw_j| / (2ℓ), of chords on the sphere: how far weighted midpoints are moved, in all."""
    return _temper.weight_change(as_mesh(mesh)._handle, before, after)


def check_certificate(mesh: MeshLike, certificate: Certificate) -> str:
    """Verifies a certificate in exact arithmetic, from the positions alone: ``"proves"`` when no weights exist, else
    what is wrong with it."""
    return _temper.check_certificate(as_mesh(mesh)._handle, certificate._plain())


# --- connectivity ----------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class ConnectivityStep(Record):
    """A change of connectivity that made the best margin greater."""

    kind: Literal["regular", "flip"]
    """regular: to the regular triangulation of the weights that have the best margin; flip: of one edge."""
    flips: int
    margin: float
    """The best one, after it."""


@dataclasses.dataclass(frozen=True, eq=False)
class ConnectivityReport(Record):
    """What ``best_connectivity`` found."""

    mesh: Mesh
    """With the connectivity found; positions, weights and all else are the input's."""
    end: Literal["no_better_neighbor", "limit", "failed"]
    before: float
    """The best margin of the input's connectivity."""
    margin: float
    """That of the one found."""
    steps: list[ConnectivityStep]
    """Their margins grow."""
    programs: int
    weights: npt.NDArray[np.float64]
    """With margin ``margin`` [length²]: for proofs, not for meshes."""


def best_connectivity(
    mesh: MeshLike,
    *,
    constraints: Literal["well_centered", "heights_only"] = "well_centered",
    programs: int = 10000,
) -> ConnectivityReport:
    """Looks for a connectivity with a greater best margin: from the best one so far, the regular triangulation of the
    weights of its best margin, else the one flip that raises it most. A local search: there may be better ones. The mesh
    is not changed; ``programs`` is the most linear programs of the whole mesh.

    >>> import temper
    >>> report = temper.best_connectivity(temper.generate.sparse_horseshoe())
    >>> report.end, len(report.steps), report.margin == report.before
    ('no_better_neighbor', 0, True)
    """
    d = _temper.best_connectivity(as_mesh(mesh)._handle, constraints, programs)
    steps = [ConnectivityStep(**step) for step in d["steps"]]
    return ConnectivityReport(**merged(d, mesh=Mesh._of(d["mesh"]), steps=steps))


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
