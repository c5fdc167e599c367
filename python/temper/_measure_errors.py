"""The errors that a mesh causes in users' solvers, measured with manufactured solutions."""

from __future__ import annotations

import dataclasses
from typing import Any, Literal, Mapping, Sequence, TypedDict, overload

import numpy as np
import numpy.typing as npt

from . import _temper
from ._dec import CoefficientLike, _coefficient_of, _named_lines
from ._mesh import Mesh, MeshLike, _doubles, as_mesh
from ._records import Record, expect, merged
from ._reports import DiffusionErrors, ErrorCounts, ErrorNorms, FieldFrame, TetErrorCounts
from ._surfaces import SurfaceMesh
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, expect_no_options_of_planes

FieldGroup = Literal["chosen", "held-back", "exact"]


@dataclasses.dataclass(frozen=True)
class ErrorField(Record):
    """A manufactured solution."""

    name: str
    group: FieldGroup
    """Purpose of the field. An objective may be tuned on the chosen fields. The fields held back then show its true
    value. exact: linear fields, which both schemes must reproduce on any mesh."""
    formula: str
    """Formula in x and y of the frame; for tetrahedra and curved surfaces also in z."""


@dataclasses.dataclass(frozen=True)
class OperatorErrors(Record):
    """The errors of one field; also means over fields, ratios or orders."""

    star: tuple[ErrorNorms, ErrorNorms, ErrorNorms]
    """★0, ★1, ★2."""
    poisson: ErrorNorms
    """−Δu = f at the vertices: d0ᵀ ★1 d0 u = ★0 f."""
    flux: ErrorNorms
    """−Δu = f at the orthocenters: Σ T (u_k − u_l) = ∫ f."""

    @classmethod
    def _of(cls, row: npt.NDArray[np.float64]) -> OperatorErrors:
        norms = [ErrorNorms(float(row[i]), float(row[i + 1])) for i in range(0, 10, 2)]
        return cls((norms[0], norms[1], norms[2]), norms[3], norms[4])

    def _row(self) -> list[float]:
        return [value for norm in (*self.star, self.poisson, self.flux) for value in (norm.l2, norm.max)]


@dataclasses.dataclass(frozen=True)
class FieldErrors(Record):
    field: ErrorField
    errors: OperatorErrors


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorLevel(Record):
    """One mesh of a refined family."""

    vertices: int
    triangles: int
    non_regular_edges: int
    not_well_centered: int
    fields: list[FieldErrors]


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorReport(ErrorCounts):
    """The result of ``measure_errors``."""

    fields: list[FieldErrors]
    levels: list[ErrorLevel]
    """The mesh itself and its refinements, coarsest first; empty without refine."""
    orders: list[FieldErrors]
    """Order of the errors of each field in the edge length: the least-squares slope in logarithms; NaN if it is not
    defined. Empty without refine."""
    local: list[npt.NDArray[np.float64]] = dataclasses.field(repr=False)
    """Errors at single elements, with ``local=True``: the root mean square over the fields of the relative errors at
    each vertex (★0), edge (★1, in the order of ``dec_operators``) and triangle (★2). Each is the error of the mean over
    the element."""

    def _rows(self) -> list[tuple[str, str]]:
        return _report_rows(self, super()._rows())


@dataclasses.dataclass(frozen=True, eq=False)
class TetErrorReport(TetErrorCounts):
    """The result of ``measure_errors`` for tetrahedra. ``negative`` of the matrix ``poisson`` counts edges, and that of
    ``flux`` faces."""

    fields: list[FieldErrors]

    def _rows(self) -> list[tuple[str, str]]:
        return _report_rows(self, super()._rows())


def _report_rows(report: ErrorReport | TetErrorReport, rows: list[tuple[str, str]]) -> list[tuple[str, str]]:
    """The rows of plain numbers, then those of mean errors."""
    nested = ("frame", "matrices", "fields", "levels", "orders")
    mean = dict(zip(_KEYS, geometric_mean(report.fields)._row()))
    errors = [(label, f"{mean[key]:.4g}") for key, label in error_measures()]
    return [row for row in rows if row[0] not in nested] + errors + [("Poisson, M-matrix", str(report.matrices.poisson.m_matrix))]


_KEYS = [f"{name}.{norm}" for name in ("star0", "star1", "star2", "poisson", "flux") for norm in ("l2", "max")]


def error_fields(*, sphere: bool = False, periodic: bool = False, tetrahedra: bool = False) -> list[ErrorField]:
    """The manufactured solutions of the plane, the sphere, a periodic plane or of tetrahedra: curved surfaces have these."""
    rows = _temper.tet_error_fields() if tetrahedra else _temper.error_fields(sphere, periodic)
    return [ErrorField(**row) for row in rows]


def field_frame(mesh: AnyMeshLike) -> FieldFrame:
    """The frame of the bounding box of the vertices: its longest side goes from −1 to 1. On a sphere its radius
    counts."""
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        return _temper.tet_field_frame(any_mesh._handle)
    return _temper.field_frame(any_mesh._handle)


def error_measures() -> list[tuple[str, str]]:
    """Key and label of the ten numbers of ``OperatorErrors``: ``("star1.l2", "★1, L2")``, …"""
    return list(_temper.error_measures())


def _fields(d: dict[str, Any], fields: Sequence[ErrorField] = ()) -> list[FieldErrors]:
    """Rows of errors; without ``fields`` those of triangles."""
    fields = fields or error_fields() + error_fields(sphere=True) + error_fields(periodic=True)
    known = {field.name: field for field in fields}
    return [FieldErrors(known[name], OperatorErrors._of(row)) for name, row in zip(d["names"], d["values"])]


def _plain(fields: Sequence[FieldErrors]) -> tuple[list[str], npt.NDArray[np.float64]]:
    values = np.array([expect("fields", row, FieldErrors).errors._row() for row in fields], dtype=np.float64).reshape(-1, 10)
    return [row.field.name for row in fields], values


def measure_diffusion_errors(
    mesh: MeshLike,
    *,
    dirichlet: Mapping[str | int, float],
    neumann: Mapping[str | int, float] | None = None,
    source: npt.ArrayLike = 0.0,
    coefficient: CoefficientLike | None = None,
    refinements: int = 2,
) -> DiffusionErrors:
    """Measures the errors of both schemes for your own problem −div(K ∇u) = f in the plane. The reference is a solution
    by linear finite elements on a refined mesh (docs/reference/errors.md).

    Parameters
    ----------
    mesh : Mesh, meshio.Mesh, …
    dirichlet : mapping of name or tag to value
        Values of u on parts of the boundary: the names or tags of ``mesh.lines``, or ``"boundary"`` for the rest of it.
    neumann : mapping of name or tag to value, optional
        Fluxes K ∂u/∂n into the domain. Other boundary edges have no flux.
    source : float or array of float
        Source f, one number or one per vertex, (n,).
    coefficient : array of float, or dict of region to float, optional
        K > 0, as in ``dec_operators``.
    refinements : int
        Refinements for the reference, each triangle into four.

    Raises
    ------
    TemperError
        Values that do not fit the mesh, no part with a value of u, a mesh that is not of the plane.
    ValueError
        A name that is no part of the boundary, or an edge with two values.

    Examples
    --------
    >>> import temper
    >>> ring = temper.generate.annulus()
    >>> errors = temper.measure_diffusion_errors(ring, dirichlet={"boundary": 0.0}, source=1.0)
    >>> errors.vertex.l2 < 0.01
    True
    """
    given = as_mesh(mesh)
    plain = _plain_problem(given, dirichlet=dirichlet, neumann=neumann, source=source, coefficient=coefficient)
    return _temper.measure_diffusion_errors(given._handle, plain, refinements)


class DiffusionProblem(TypedDict, total=False):
    """The user's own problem −div(K ∇u) = f. ``measure_diffusion_errors`` explains each; ``dirichlet`` is needed."""

    dirichlet: Mapping[str | int, float]
    neumann: Mapping[str | int, float] | None
    source: npt.ArrayLike
    coefficient: CoefficientLike | None


def _plain_problem(
    mesh: Mesh,
    *,
    dirichlet: Mapping[str | int, float],
    neumann: Mapping[str | int, float] | None = None,
    source: npt.ArrayLike = 0.0,
    coefficient: CoefficientLike | None = None,
) -> tuple[Any, ...]:
    """Coefficient, source and parts of the boundary for the compiled module."""
    for name, values in (("dirichlet", dirichlet), ("neumann", neumann or {})):
        if not isinstance(values, Mapping):
            raise TypeError(f"{name}: expected a dict of names and values, found {type(values).__name__}")
    given = [
        (name, float(value), is_flux)
        for values, is_flux in ((neumann or {}, True), (dirichlet, False))
        for name, value in values.items()
    ]
    parts = []
    names: dict[frozenset[int], str | int] = {}
    for name, value, is_flux in sorted(given, key=lambda row: row[0] != "boundary"):  # later parts count more
        edges = _boundary_part(mesh, name)
        parts.append((edges, value, is_flux))
        for edge in map(frozenset, edges.tolist() if name != "boundary" else ()):
            if edge in names:
                raise ValueError(f"the boundary edge {sorted(edge)} has two values: by {names[edge]!r} and by {name!r}")
            names[edge] = name
    f = np.broadcast_to(np.asarray(source, dtype=np.float64), mesh.n_vertices) if np.ndim(source) == 0 else source
    return _coefficient_of(mesh, coefficient), _doubles(f, 0, "source"), parts


def _boundary_part(mesh: Mesh, name: str | int) -> npt.NDArray[np.int32]:
    """The boundary edges of a name or tag, (k, 2)."""
    boundary = mesh.boundary_edges
    if name == "boundary":
        return boundary
    named = _named_lines(mesh)
    lines = named[name] if name in named else mesh.lines[mesh.tags == name] if not isinstance(name, str) else ()
    on_boundary = {frozenset(edge) for edge in boundary.tolist()}
    edges = np.array([edge for edge in np.asarray(lines).tolist() if frozenset(edge) in on_boundary], dtype=np.int32)
    if not len(edges):
        names = sorted(named)
        raise ValueError(
            f"no boundary edge has the name or tag {name!r}; expected 'boundary', a tag of {sorted(set(mesh.tags.tolist()))}"
            + (f", or one of {', '.join(names)}" if names else "")
        )
    return edges.reshape(-1, 2)


@overload
def measure_errors(
    mesh: TetMesh, *, fields: Sequence[str] = ..., frame: FieldFrame | None = ..., condition: bool = ..., threads: int | None = ...
) -> TetErrorReport: ...
@overload
def measure_errors(
    mesh: SurfaceMesh, *, fields: Sequence[str] = ..., frame: FieldFrame | None = ..., condition: bool = ..., threads: int | None = ...
) -> ErrorReport: ...
@overload
def measure_errors(
    mesh: MeshLike,
    *,
    fields: Sequence[str] = ...,
    frame: FieldFrame | None = ...,
    refine: int = ...,
    condition: bool = ...,
    local: bool = ...,
    threads: int | None = ...,
) -> ErrorReport: ...
def measure_errors(
    mesh: AnyMeshLike,
    *,
    fields: Sequence[str] = (),
    frame: FieldFrame | None = None,
    refine: int = 0,
    condition: bool = False,
    local: bool = False,
    threads: int | None = None,
) -> ErrorReport | TetErrorReport:
    """Measures the errors that solvers make on a mesh, with manufactured solutions (docs/reference/errors.md defines
    every norm).

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
    fields : sequence of str
        Names of fields or of groups (``"chosen"``, ``"held-back"``), or ``"all"``; empty: all.
    frame : FieldFrame, optional
        Frame of the fields; None: ``field_frame(mesh)``. Use one frame to compare meshes.
    refine : int
        Number of refinements, each triangle into four; then orders are measured too. Neither this nor
        ``local`` is for tetrahedra or curved surfaces.
    condition : bool
        Also estimate the condition of both matrices.
    local : bool
        Also list the errors of each vertex, edge and triangle.
    threads : int, optional
        Number of threads. The report does not depend on it.

    Raises
    ------
    TemperError
        Unknown fields, a frame of zero size, too many refinements for the memory.

    Examples
    --------
    >>> import temper
    >>> before = temper.generate.annulus()
    >>> frame = temper.field_frame(before)
    >>> a = temper.measure_errors(before, fields=["held-back"], frame=frame)
    >>> after = before.copy()
    >>> report = temper.optimize(after)
    >>> b = temper.measure_errors(after, fields=["held-back"], frame=frame)
    >>> ratio = temper.geometric_mean(temper.error_ratios(b, a)).flux.l2
    """
    if isinstance(fields, str):
        fields = [fields]
    plain_frame = expect("frame", frame, FieldFrame)._plain() if frame is not None else None
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, SurfaceMesh):
        expect_no_options_of_planes(measure_errors, refine=refine, local=local)
        d = _temper.measure_errors(any_mesh._handle, list(fields), plain_frame, condition)
        return ErrorReport(**merged(d, fields=_fields(d["fields"], error_fields(tetrahedra=True)), orders=[]))
    if isinstance(any_mesh, TetMesh):
        if refine or local:
            raise TypeError("refine and local are for triangles alone. Next: leave them out")
        d = _temper.tet_measure_errors(any_mesh._handle, list(fields), plain_frame, condition)
        return TetErrorReport(**merged(d, fields=_fields(d["fields"], error_fields(tetrahedra=True))))
    d = _temper.measure_errors(any_mesh._handle, list(fields), plain_frame, refine, condition, local, threads)
    levels = [ErrorLevel(**merged(level, fields=_fields(level["fields"]))) for level in d["levels"]]
    return ErrorReport(**merged(d, fields=_fields(d["fields"]), orders=_fields(d["orders"]), levels=levels))


def geometric_mean(fields: Sequence[FieldErrors], group: FieldGroup | None = None) -> OperatorErrors:
    """The geometric mean over all fields or over one group; 1 if there is none."""
    return OperatorErrors._of(_temper.geometric_mean(*_plain(fields), group))


def arithmetic_mean(fields: Sequence[FieldErrors], group: FieldGroup | None = None) -> OperatorErrors:
    """The arithmetic mean over fields, the right mean for orders; NaN if one is NaN."""
    return OperatorErrors._of(_temper.arithmetic_mean(*_plain(fields), group))


def error_ratios(after: ErrorReport | TetErrorReport, before: ErrorReport | TetErrorReport) -> list[FieldErrors]:
    """The ratio of errors, field by field: below 1 if ``after`` is better. TemperError if fields or frames differ."""
    for name, report in (("after", after), ("before", before)):
        if not isinstance(report, (ErrorReport, TetErrorReport)):
            raise TypeError(f"{name}: expected an ErrorReport or a TetErrorReport, found {type(report).__name__}")
    frames = (0.0, 0.0, 1.0), (0.0, 0.0, 1.0 if after.frame == before.frame else 2.0)  # equal if those are
    d = _temper.error_ratios(*_plain(after.fields), frames[0], *_plain(before.fields), frames[1])
    return _fields(d, [row.field for row in after.fields])
