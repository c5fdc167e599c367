"""Weights alone: can a mesh become well-centered if neither its positions nor its connectivity may change? And which
connectivity has better weights?"""

from __future__ import annotations

import dataclasses
import math
import os
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._certificate import Certificate, Constraints, WeightConstraint, read_certificate
from ._dec import DecEdges, IncidenceMatrix, _Complex
from ._mesh import Mesh, MeshLike, _ints, as_mesh
from ._records import Record, expect, merged
from ._reports import EdgeConflict
from ._tensor import TensorLike, plain_tensor
from ._surfaces import SurfaceMesh
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, as_triangles, expect_no_options_of_triangles


@dataclasses.dataclass(frozen=True)
class ConstraintsInfo(Record):
    """A row of the table of constraints: the inequalities to satisfy."""

    name: Constraints
    keeps: str
    """The inequalities for a margin t."""
    success: str
    """A sentence about success."""
    failure: str


def constraints_table(*, tetrahedra: bool = False) -> list[ConstraintsInfo]:
    """The kinds of constraints, of triangles or of tetrahedra.

    In triangles: well_centered: all h and d. heights_only: all h, so that orthocenters are inside their triangles.
    regular: the dual lengths of interior edges, of all of them or of the prescribed ones.

    In tetrahedra: well_centered: all h over faces. completely_well_centered: also all h and d in the faces. regular:
    the dual lengths of interior faces.
    """
    return [ConstraintsInfo(**row) for row in (_temper.tet_constraints_table() if tetrahedra else _temper.constraints_table())]


def _edges(edges: npt.ArrayLike | None) -> npt.NDArray[np.int64] | None:
    return None if edges is None else _ints(edges, 2, "edges").astype(np.int64)


@dataclasses.dataclass(frozen=True, eq=False)
class BestMargin(Record):
    """The largest margin that any weights attain."""

    status: Literal["optimal", "infeasible", "unbounded", "failed"]
    margin: float
    """Largest margin t*; negative: no weights satisfy the constraints."""
    tight: list[WeightConstraint]
    """Constraints that keep the margin from being larger."""
    certificate: Certificate
    """Proof against margin 0, for ``regular`` 2⁻¹⁰. It has terms only if t* ≤ 0 and the checker agrees."""
    vertices: npt.NDArray[np.int32]
    """Vertices of the selected triangles."""
    weights: npt.NDArray[np.float64]
    """Weights of these vertices with margin t* [length²]. They are for proofs, not for meshes, because they are
    extreme."""


@dataclasses.dataclass(frozen=True)
class Violation(Record):
    """A constraint that the weights of elastic or fewest violate."""

    constraint: WeightConstraint
    value: float
    """Value of h/ℓ, d/ℓ or dual length/ℓ with the weights."""
    shortfall: float
    """Requested margin minus ``value``, > 0."""
    angle_deg: float
    """For height: angle of the triangle at r, opposite the edge."""


@dataclasses.dataclass(frozen=True)
class OffsetTerm(Record):
    """A term of the sum of squared offsets: factor (value − target)². The values are in ``temper/feasibility.hpp``."""

    at: WeightConstraint
    factor: float
    target: float


@dataclasses.dataclass(frozen=True)
class Optimality(Record):
    """A proof that weights are best: multipliers that bound the objective of all other weights."""

    goal: Literal["center", "accuracy"]
    constraints: Constraints
    margin: float
    """Margin of the slacks; 0 for center."""
    objective: float
    """−Σ ln of the slacks, or Σ factor (value − target)² [length²]."""
    gap: float
    """No weights have an objective below ``objective − gap``."""
    iterations: int
    terms: list[tuple[WeightConstraint, float]]
    """Constraints and their multipliers."""
    offsets: list[OffsetTerm]
    """Of accuracy."""

    @property
    def relative_gap(self) -> float:
        """The gap over the objective; infinite if the objective is 0 and the gap is not."""
        if self.objective == 0:
            return 0.0 if self.gap == 0 else math.inf
        return self.gap / abs(self.objective)

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Optimality:
        terms = [(WeightConstraint(*c), m) for c, m in d["terms"]]
        offsets = [OffsetTerm(WeightConstraint(*c), factor, target) for c, factor, target in d["offsets"]]
        return cls(**merged(d, terms=terms, offsets=offsets))


@dataclasses.dataclass(frozen=True, eq=False)
class IntrinsicMesh(_Complex):
    """A triangulation of a curved surface after intrinsic flips, with its operators. An edge is straight across two
    unfolded triangles, and known by its length. Vertices are those of the mesh. Arrays are as in ``DecComplex``; nothing
    but vertices has a place, so ``edges.midpoint`` is empty."""

    flips: int
    blocked: int
    """Number of edges whose dual lengths stay negative, because they cannot flip."""
    bad_before: int
    """Number of bad triangles before the first flip."""
    bad_after: int
    """Number of bad triangles with the weights found."""
    rounds: int
    """Number of triangulations that were tried up to this one."""
    triangles: npt.NDArray[np.int32]
    """Corners of each triangle, (m, 3)."""
    weights: npt.NDArray[np.float64]
    """Weight of each vertex, (n,) [length²]."""
    edges: DecEdges
    edge_of_halfedge: npt.NDArray[np.int32]
    d0: IncidenceMatrix
    d1: IncidenceMatrix
    star0: npt.NDArray[np.float64]
    star1: npt.NDArray[np.float64]
    star2: npt.NDArray[np.float64]
    transmissibility: npt.NDArray[np.float64]
    areas: npt.NDArray[np.float64]
    _handle: Any = dataclasses.field(repr=False, compare=False)

    @classmethod
    def _of(cls, handle: Any, numbers: dict[str, int]) -> IntrinsicMesh:
        d = handle.arrays()
        d["edges"] = DecEdges(**merged(d["edges"], midpoint=np.empty((0, 3))), named={})
        d["d0"], d["d1"] = IncidenceMatrix(**d["d0"]), IncidenceMatrix(**d["d1"])
        names = {field.name for field in dataclasses.fields(cls)}
        return cls(**{name: values for name, values in d.items() if name in names}, **numbers, _handle=handle)

    def write(self, folder: str | os.PathLike[str], **_: Any) -> list[str]:
        """Writes ``operators.npz`` and the matrices for SciPy into a folder, as ``temper weights --flips intrinsic``.
        Returns the paths of the files."""
        return self._handle.write(os.fspath(folder))


@dataclasses.dataclass(frozen=True, eq=False)
class WeightReport(Record):
    """The result of ``find_weights``."""

    verdict: Literal["feasible", "infeasible", "undecided"]
    """feasible: the weights satisfy the constraints, by exact predicates. infeasible: no weights exist, and the exact
    checker accepts a certificate."""
    margin: float
    """Best margin."""
    margin_kind: Literal["exact", "at_least", "at_most"]
    """exact: the best margin, up to rounding; at_least: attained, larger ones were not tried; at_most: the best margin
    of the worst neighborhood."""
    solved: bool
    """The ``weights`` answer the request; elastic ones may violate constraints."""
    asked: float
    attained: float
    moved: int
    """Number of weights that differ from the reference (``from_input``)."""
    change: float
    """Σ over edges \\|Δw_i − Δw_j\\| / (2ℓ) [length]."""
    programs: int
    largest: int
    """Number of triangles of the largest program."""
    weights: npt.NDArray[np.float64]
    """Weight of each vertex of the mesh [length²]: ``mesh.weights = report.weights``."""
    violations: list[Violation]
    """Violations of the goals elastic and fewest, worst first."""
    certificate: Certificate
    optimality: Optimality | None = None
    """Proof that the weights are best; only for center and accuracy, if solved."""
    corner_weights: npt.NDArray[np.float64] | None = None
    """With tensors that differ: weight of each corner of each triangle, (m, 3) [length²], for
    ``mesh.cell_data["corner_weights"]``. Of each tetrahedron, (m, 4), for ``mesh.weights``. ``weights`` then has one of
    the weights of each vertex."""
    intrinsic: IntrinsicMesh | None = None
    """With intrinsic flips: the triangulation that has the ``weights``. The mesh itself has other triangles."""

    @classmethod
    def _of(cls, d: dict[str, Any]) -> WeightReport:
        violations = [Violation(**merged(v, constraint=WeightConstraint(*v["constraint"]))) for v in d["violations"]]
        proof = d["optimality"]
        optimality = None if proof is None else Optimality._of(proof)
        return cls(**merged(d, violations=violations, certificate=Certificate._of(d["certificate"]), optimality=optimality))


def find_weights(
    mesh: AnyMeshLike,
    *,
    goal: Literal["margin", "change", "elastic", "center", "accuracy", "least", "fewest"] = "change",
    margin: float = 0.01,
    from_input: bool = False,
    whole: int = 3000,
    rings: int = 2,
    constraints: Constraints = "well_centered",
    edges: npt.ArrayLike | None = None,
    offset_factor: float = 10.0,
    boundary_offset_factor: float = 5.0,
    tensor: TensorLike | None = None,
    flips: Literal["none", "intrinsic"] = "none",
) -> WeightReport:
    """Finds weights for a mesh with fixed positions and connectivity, by linear programming (Clp) or by an interior
    point method. The mesh does not change.

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
    goal : {"change", "margin", "elastic", "center", "accuracy", "least", "fewest"}
        change: the least change for the requested margin. margin: the best margin, and the least change for the
        requested margin or for half of the best one. elastic: the least violation, but at least half of the best margin
        if that is positive; then the least change. center: the greatest product of all h/ℓ, d/ℓ and 1 − d/ℓ, or of all
        dual lengths/ℓ. accuracy: the least sum of squared offsets between the midpoints of edges and their duals, with
        the requested margin or half of the best one. center and accuracy are unique, and come with a proof. least: the
        least sum of squared changes of d/ℓ over all edges, with the requested margin or a smaller one. If there are no
        such weights, its weights violate the constraints little. fewest: as elastic, with few violated constraints
        instead of the least violation.
    margin : float
        Margin t in [0, 1/2): all h ≥ tℓ and tℓ ≤ d ≤ (1 − t)ℓ, or the inequalities of the other constraints.
    from_input : bool
        Measure change from the mesh's weights; else from zero.
    whole : int
        Components of at most this many triangles or tetrahedra are one linear program. In larger components only the
        neighborhoods of bad ones are solved.
    rings : int
        Number of rings of vertices around bad triangles or tetrahedra, at first.
    constraints : {"well_centered", "heights_only", "regular", "coefficients", "distances", "completely_well_centered"}
        Constraints on the weights: see ``constraints_table``, which lists those of triangles and of tetrahedra. A solver
        with unknowns at vertices needs coefficients, with unknowns in cells distances. goal "least" fits both.
    edges : (k, 2) int, optional
        Prescribed edges for ``regular``, by their vertices; None: all. Boundary edges are always regular. For triangles
        alone.
    offset_factor, boundary_offset_factor : float
        Factors of the offsets inside and of the heights on the boundary, for ``accuracy``. 10 and 5 are for any scheme,
        10 and 0.5 for unknowns at vertices, 10 and 30 for two-point fluxes, 20 and 18 for diagonal stars.
    tensor : sequence of float, (m, 3) array, or dict of region to sequence, optional
        Diffusion tensors, as in ``optimize``: constraints hold in their metrics. If they differ, weights keep the
        equations of interfaces, and ``corner_weights`` has them; goals center, accuracy, least and fewest are refused.
    flips : {"none", "intrinsic"}
        intrinsic: flips edges of a curved surface on it, while the number of bad triangles falls. The surface stays, and
        ``intrinsic`` of the report has the triangulation, because no mesh of points has its edges.

    Notes
    -----
    For fixed positions and connectivity every h and d is linear in the weights. The answers of the solver are not
    trusted: exact predicates and ``check_certificate`` decide.

    >>> import temper
    >>> mesh = temper.generate.sparse_horseshoe()
    >>> report = temper.find_weights(mesh, goal="margin")
    >>> report.verdict, round(report.margin, 10)
    ('infeasible', -0.0592592593)
    >>> temper.check_certificate(mesh, report.certificate)
    'proves'
    >>> temper.find_weights(mesh, constraints="heights_only").verdict
    'feasible'
    >>> temper.find_weights(mesh, constraints="coefficients", goal="least").verdict
    'feasible'
    """
    any_mesh = as_any_mesh(mesh)
    if flips not in ("none", "intrinsic"):
        raise ValueError(f"flips: expected 'none' or 'intrinsic', found {flips!r}")
    if flips == "intrinsic" and not isinstance(any_mesh, SurfaceMesh):
        raise TypeError("flips is for curved surfaces alone. Next: leave it out")
    wanted = goal, margin, from_input, whole, rings, constraints, offset_factor, boundary_offset_factor
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(find_weights, edges=edges)
        d = _temper.tet_find_weights(any_mesh._handle, *wanted, plain_tensor(any_mesh, tensor))
    elif flips == "intrinsic":
        plain_tensor(any_mesh, tensor)
        if edges is not None:
            raise TypeError("edges is not for intrinsic flips. Next: leave it out")
        d, numbers, handle = _temper.find_intrinsic_weights(any_mesh._handle, *wanted)
        return dataclasses.replace(WeightReport._of(d), intrinsic=IntrinsicMesh._of(handle, numbers))
    else:
        d = _temper.find_weights(any_mesh._handle, *wanted, _edges(edges), plain_tensor(any_mesh, tensor))
    return WeightReport._of(d)


def best_margin(
    mesh: MeshLike,
    triangles: npt.ArrayLike | None = None,
    *,
    constraints: Constraints = "well_centered",
    edges: npt.ArrayLike | None = None,
) -> BestMargin:
    """The best margin of the selected triangles, (k,) int, without the rest of the mesh; None: of the whole mesh. It is
    an upper bound for any larger set of triangles. ``edges`` as for ``find_weights``. For ``regular`` it is 1/2, where
    programs stop, or 0."""
    chosen = None if triangles is None else _ints(triangles, 0, "triangles").astype(np.int64)
    d = _temper.best_margin(as_mesh(mesh)._handle, chosen, constraints, _edges(edges))
    tight = [WeightConstraint(*c) for c in d["tight"]]
    return BestMargin(**merged(d, tight=tight, certificate=Certificate._of(d["certificate"])))


def weight_margin(
    mesh: AnyMeshLike, *, constraints: Constraints = "well_centered", edges: npt.ArrayLike | None = None
) -> float:
    """The margin of the mesh's own weights, in doubles: the least h/ℓ, d/ℓ, 1 − d/ℓ or dual length/ℓ that the
    constraints have. Infinite if they have none."""
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(weight_margin, edges=edges)
        return _temper.tet_weight_margin(any_mesh._handle, constraints)
    return _temper.weight_margin(any_mesh._handle, constraints, _edges(edges))


def weight_change(mesh: AnyMeshLike, before: npt.ArrayLike, after: npt.ArrayLike) -> float:
    """Σ over edges |Δw_i − Δw_j| / (2ℓ): the total shift of the weighted midpoints. On the sphere ℓ is the length of
    chords."""
    return _temper.weight_change(as_triangles(mesh)._handle, before, after)


@dataclasses.dataclass(frozen=True)
class Lemma(Record):
    """A lemma of a ``ConnectivityProof``: no triangulation with these edges has weights."""

    edges: list[tuple[int, int]]
    """Edges, by their vertices. Edges of the boundary and constrained edges are not named."""
    terms: list[tuple[WeightConstraint, float]]
    """Constraints and their multipliers, whose sum is a contradiction; empty if there are cases."""
    side: tuple[int, int] | None
    """Edge whose left triangle has one of several apexes; None if there are terms."""
    cases: list[tuple[int, int]]
    """Apexes, each with the number of an earlier lemma that excludes it. Other apexes need an edge that crosses one of
    ``edges``."""


@dataclasses.dataclass(frozen=True)
class ConnectivityProof(Record):
    """A proof that no connectivity has weights. The last lemma needs no edges. docs/explanation/connectivities.md has the
    reasons."""

    constraints: Constraints
    lemmas: list[Lemma]

    def _plain(self) -> dict[str, Any]:
        plain = lambda terms: [(dataclasses.astuple(c), float(m)) for c, m in terms]  # noqa: E731
        lemmas = [{"edges": lemma.edges, "terms": plain(lemma.terms), "side": lemma.side, "cases": lemma.cases}
                  for lemma in self.lemmas]  # fmt: skip
        return {"constraints": self.constraints, "lemmas": lemmas}

    @classmethod
    def _of(cls, d: dict[str, Any]) -> ConnectivityProof:
        terms = lambda row: [(WeightConstraint(*c), m) for c, m in row["terms"]]  # noqa: E731
        return cls(d["constraints"], [Lemma(row["edges"], terms(row), row["side"], row["cases"]) for row in d["lemmas"]])

    def to_json(self) -> str:
        """The proof as JSON, which ``temper weights --check-certificate`` reads. Vertices count from 0."""
        return str(_temper.certificate_to_json(self._plain()))

    @classmethod
    def from_json(cls, text: str) -> ConnectivityProof:
        """Reads the text of ``to_json``. TemperError: no such proof; the message names the wrong lemma."""
        return cls._of(read_certificate(text, "lemmas"))


def check_certificate(
    mesh: AnyMeshLike | IntrinsicMesh, certificate: Certificate | ConnectivityProof, *, tensor: TensorLike | None = None
) -> str:
    """Verifies a certificate, or a proof over connectivities, in exact arithmetic, from the positions and the diffusion
    tensors alone. Returns ``"proves"`` if no weights exist, else the fault of the certificate. A certificate of intrinsic
    flips is for ``WeightReport.intrinsic``."""
    if isinstance(mesh, IntrinsicMesh):
        return _temper.check_certificate(mesh._handle, expect("certificate", certificate, Certificate)._plain(), None)
    any_mesh = as_any_mesh(mesh)
    if isinstance(certificate, ConnectivityProof) and tensor is not None:
        raise ValueError("tensor: proofs over connectivities are for meshes without tensors. Next: leave it out")
    if isinstance(certificate, ConnectivityProof):
        return _temper.check_proof(as_mesh(mesh)._handle, certificate._plain())
    check = _temper.tet_check_certificate if isinstance(any_mesh, TetMesh) else _temper.check_certificate
    return check(any_mesh._handle, expect("certificate", certificate, Certificate)._plain(), plain_tensor(any_mesh, tensor))


# --- connectivity ----------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class ConnectivityStep(Record):
    """A change of connectivity that made the best margin greater."""

    kind: Literal["regular", "flip", "complete"]
    """regular: to the regular triangulation of the weights with the best margin; flip: a flip of one edge; complete: to
    the triangulation that the complete search found."""
    flips: int
    margin: float
    """Best margin after the step."""


@dataclasses.dataclass(frozen=True, eq=False)
class ConnectivityReport(Record):
    """The result of ``best_connectivity``."""

    mesh: Mesh
    """Mesh with the connectivity found; positions, weights and all else are those in the input."""
    end: Literal["no_better_neighbor", "none_exists", "limit", "stopped", "failed"]
    """none_exists: ``proof`` shows that no connectivity has weights."""
    before: float
    """Best margin of the input's connectivity."""
    margin: float
    """Best margin of the connectivity found."""
    steps: list[ConnectivityStep]
    """Steps with growing margins."""
    programs: int
    weights: npt.NDArray[np.float64]
    """Weights with margin ``margin`` [length²]: for proofs, not for meshes."""
    bound: float
    """Margin that no connectivity exceeds, up to rounding; 0 if none has weights, infinity without complete search."""
    complete_programs: int
    """Number of linear programs of the complete search."""
    proof: ConnectivityProof | None
    """Proof that no connectivity has weights; ``check_certificate`` accepts it."""


def best_connectivity(
    mesh: MeshLike,
    *,
    constraints: Literal["well_centered", "heights_only"] = "well_centered",
    programs: int = 10000,
    time_limit: float = 60.0,
) -> ConnectivityReport:
    """Searches for a connectivity with a greater best margin. Each step takes the regular triangulation of the weights
    with the best margin so far. If that is no better, it takes the flip that raises the margin most. The mesh does not
    change. ``programs`` is the largest number of linear programs of the whole mesh.

    Before the first flip, a complete search finds a connectivity with a margin above zero, or proves that none exists.
    It needs a mesh of the plane with at most 300 vertices. After ``time_limit`` seconds the search stops with the best
    connectivity so far; 0 sets no limit.

    >>> import temper
    >>> mesh = temper.generate.sparse_horseshoe()
    >>> report = temper.best_connectivity(mesh)
    >>> report.end, len(report.proof.lemmas), temper.check_certificate(mesh, report.proof)
    ('none_exists', 1, 'proves')
    """
    d = _temper.best_connectivity(as_mesh(mesh)._handle, constraints, programs, float(time_limit))
    steps = [ConnectivityStep(**step) for step in d["steps"]]
    proof = None if d["proof"] is None else ConnectivityProof._of(d["proof"])
    return ConnectivityReport(**merged(d, mesh=Mesh._of(d["mesh"]), steps=steps, proof=proof))


# --- necessity -------------------------------------------------------------------------------------------------


def edge_conflict(mesh: MeshLike, halfedge: int, *, up_to: float = 1.0) -> EdgeConflict | None:
    """The conflict of one edge if a + b ≤ up_to, exactly. With up_to = 1, no well-centered mesh has this edge and these
    two vertices (docs/explanation/proofs.md)."""
    return _temper.edge_conflict(as_mesh(mesh)._handle, halfedge, up_to)


def edges_that_must_be_split(mesh: MeshLike, *, up_to: float = 1.0) -> list[EdgeConflict]:
    """All edges of the boundary and of constrained lines with such a conflict, least sum first. An empty list does not
    mean that a well-centered mesh exists."""
    return _temper.edges_that_must_be_split(as_mesh(mesh)._handle, up_to)
