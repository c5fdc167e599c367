"""The report on a primal-dual mesh."""

from __future__ import annotations

import dataclasses
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike, as_mesh
from ._options import LengthParameter, LengthParameterLike, _length_parameter
from ._records import Record, merged, table
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, expect_no_options_of_triangles


_GAMMA, _H0 = LengthParameter(1.0, "absolute"), LengthParameter(0.0, "absolute")


@dataclasses.dataclass(frozen=True, eq=False)
class Histogram(Record):
    """Counts in equal bins over [low, high]. Each bin includes its lower end. Values outside go to the end bins."""

    low: float
    high: float
    counts: npt.NDArray[np.uint64]

    @property
    def edges(self) -> npt.NDArray[np.float64]:
        """The ends of the bins for ``matplotlib.pyplot.stairs``, one more than bins."""
        return np.linspace(self.low, self.high, len(self.counts) + 1)


@dataclasses.dataclass(frozen=True)
class WorstTriangle(Record):
    """A triangle whose least h/ℓ or d/ℓ is among the smallest of the mesh."""

    triangle: int
    vertices: tuple[int, int, int]
    at: tuple[float, float]
    """Centroid; on a sphere its longitude and latitude [degrees]."""
    h_over_l: float
    """Least h/ℓ of its three edges."""
    angle_deg: float
    """Largest of its three angles."""
    why: str


@dataclasses.dataclass(frozen=True, eq=False)
class Quality(Record):
    """The result of ``quality``: counts decided exactly, margins and energies in doubles. On a sphere lengths and
    angles are measured along arcs."""

    vertices: int
    triangles: int
    edges: int
    boundary_edges: int
    regions: int
    inverted_triangles: int
    non_regular_edges: int
    """Interior edges with negative dual."""
    negative_boundary_duals: int
    """Boundary edges with h < 0."""
    orthocenters_outside: int
    """Triangles with some h ≤ 0, and inverted triangles."""
    edges_not_crossed: int
    """Edges without 0 < d < ℓ."""
    well_centered_fraction: float
    """Fraction of triangles with all h > 0 and 0 < d < ℓ."""
    min_h_over_l: float
    """Least over triangles and their edges; −inf for an inverted triangle."""
    min_d_over_l: float
    """Least of d/ℓ and 1 − d/ℓ over edges."""
    min_angle_deg: float
    max_angle_deg: float
    max_transmissibility_over_median: float
    """Largest over median transmissibility ℓ/\\|h_k + h_l\\| of interior edges. inf if a dual edge has exactly length
    zero; 1 without interior edges."""
    transmissibility_ratio: float
    """Largest over least transmissibility."""
    min_edge_over_size: float
    """Least length of interior edges, over the mean of the local sizes at their ends."""
    min_dual_over_size: float
    min_dual_over_cell_median: float
    """Least signed dual of a closed cell over the median of its dual lengths; the least over closed cells."""
    max_orthogonality: float
    """D-Flow FM: largest \\|cosine\\| between an edge and the line of the circumcenters on its sides, kept inside."""
    max_smoothness: float
    """D-Flow FM: largest ratio of the areas on the two sides of an edge."""
    min_flow_link: float
    """D-Flow FM: least distance of these circumcenters over the mean of the roots of both areas."""
    small_flow_links: int
    """D-Flow FM: number of edges with a flow link below 0.1."""
    min_cell_quality: float
    """MPAS-Tools' cellQuality."""
    min_grid_spacing: float
    """MPAS-Tools' gridSpacing."""
    max_grid_spacing: float
    min_triangle_quality: float
    """MPAS-Tools' triangleQuality."""
    min_triangle_angle_quality: float
    """MPAS-Tools' triangleAngleQuality."""
    obtuse_triangles: int
    """MPAS-Tools' obtuseTriangle."""
    max_centroid_offset_over_size: float
    """Largest distance of a vertex from the centroid of its closed cell, over local size."""
    energy: dict[str, tuple[float, float, float]]
    """Total of each energy for ★0, ★1, ★2; inf outside its domain."""
    worst: list[WorstTriangle]
    """Worst triangles, the worst first."""
    angles: Histogram = dataclasses.field(repr=False)
    """Histogram of all angles [degrees]."""
    h_over_l: Histogram = dataclasses.field(repr=False)
    d_over_l: Histogram = dataclasses.field(repr=False)

    def _repr_html_(self) -> str:
        rows = [row for row in self._rows() if row[0] not in ("worst", "energy")]
        worst = [(f"triangle {w.triangle}", w.why) for w in self.worst]
        return table("Quality", rows, table("worst triangles", worst) if worst else "")


@dataclasses.dataclass(frozen=True)
class WorstTet(Record):
    """A tetrahedron whose least h/ℓ is among the smallest of the mesh."""

    tetrahedron: int
    vertices: tuple[int, int, int, int]
    at: tuple[float, float, float]
    """Centroid."""
    h_over_l: float
    """Least h/ℓ of its four faces."""
    dihedral_deg: float
    """Largest of its six dihedral angles."""
    why: str


@dataclasses.dataclass(frozen=True, eq=False)
class TetQuality(Record):
    """The result of ``quality`` for tetrahedra: counts decided exactly, margins in doubles. The length ℓ of a face is
    the side of the equilateral triangle with its area, the length ℓ of an edge its own."""

    vertices: int
    inner_vertices: int
    tetrahedra: int
    faces: int
    boundary_faces: int
    edges: int
    regions: int
    inverted_tetrahedra: int
    non_regular_faces: int
    """Interior faces with negative dual edge."""
    negative_boundary_duals: int
    """Boundary faces with h < 0."""
    orthocenters_outside: int
    """Tetrahedra with some h ≤ 0."""
    faces_not_crossed: int
    """Faces whose orthocenter is not strictly inside."""
    edges_not_crossed: int
    """Edges without 0 < d < ℓ, where d = (ℓ² + w_p − w_q)/(2 ℓ) for the edge from p to q."""
    well_centered_fraction: float
    """Fraction of tetrahedra with all h > 0."""
    completely_well_centered_fraction: float
    """The same, if all four faces and all six edges are crossed, too."""
    min_h_over_l: float
    """Least h/ℓ of tetrahedra over their faces."""
    min_face_h_over_l: float
    """Least h/ℓ of faces over their edges."""
    min_d_over_l: float
    """Least of d/ℓ and 1 − d/ℓ over edges."""
    min_dihedral_deg: float
    max_dihedral_deg: float
    volume: float
    """Of all tetrahedra together [length³]."""
    min_volume: float
    max_volume: float
    max_transmissibility_over_median: float
    """Largest over median transmissibility A/\\|h_k + h_l\\| of interior faces. inf if a dual edge has exactly length
    zero; 1 without interior faces."""
    transmissibility_ratio: float
    """Largest over least transmissibility."""
    worst: list[WorstTet]
    """Worst tetrahedra, the worst first."""
    dihedrals: Histogram = dataclasses.field(repr=False)
    """Histogram of all dihedral angles [degrees]."""
    h_over_l: Histogram = dataclasses.field(repr=False)

    def _repr_html_(self) -> str:
        rows = [row for row in self._rows() if row[0] != "worst"]
        worst = [(f"tetrahedron {w.tetrahedron}", w.why) for w in self.worst]
        return table("TetQuality", rows, table("worst tetrahedra", worst) if worst else "")


@overload
def quality(
    mesh: TetMesh, *, gamma: LengthParameterLike = ..., h0: LengthParameterLike = ..., worst: int = ..., threads: int | None = ...
) -> TetQuality: ...
@overload
def quality(
    mesh: MeshLike, *, gamma: LengthParameterLike = ..., h0: LengthParameterLike = ..., worst: int = ..., threads: int | None = ...
) -> Quality: ...
def quality(
    mesh: AnyMeshLike,
    *,
    gamma: LengthParameterLike = _GAMMA,
    h0: LengthParameterLike = _H0,
    worst: int = 5,
    threads: int | None = None,
) -> Quality | TetQuality:
    """Measures a mesh: is it valid, regular, well-centered, and with what margins?

    Parameters
    ----------
    mesh : Mesh, TetMesh, or of another library
    gamma, h0 : LengthParameter or float
        Parameters γ of E_BP and −h° of E_BHs in the report; plain numbers are relative to each edge. They are for
        triangles alone.
    worst : int
        Number of the worst triangles or tetrahedra to list.
    threads : int, optional
        Number of threads; None or 0: all of the machine. The report does not depend on it.

    Returns
    -------
    Quality, or TetQuality for tetrahedra

    Examples
    --------
    >>> import temper
    >>> temper.quality(temper.generate.horseshoe()).orthocenters_outside
    58
    """
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(quality, gamma=gamma, h0=h0)
        d = _temper.tet_quality(any_mesh._handle, worst, threads)
        histograms = {name: Histogram(**d[name]) for name in ("dihedrals", "h_over_l")}
        return TetQuality(**merged(d, worst=[WorstTet(**w) for w in d["worst"]], **histograms))
    d = _temper.quality(any_mesh._handle, _length_parameter("gamma", gamma), _length_parameter("h0", h0), worst, threads)
    histograms = {name: Histogram(**d[name]) for name in ("angles", "h_over_l", "d_over_l")}
    return Quality(**merged(d, worst=[WorstTriangle(**w) for w in d["worst"]], **histograms))


@dataclasses.dataclass(frozen=True)
class QualityMeasure(Record):
    """A row of ``quality_measures``: a number of ``Quality``."""

    key: str
    """Name of the number in ``Quality``, in reports and for ``--require``."""
    alias: str
    """Short name for ``--require``, or the name that its community uses; or empty."""
    label: str
    community: str
    """Community whose codes use the measure; empty for measures of primal-dual meshes in general."""
    definition: str
    better: Literal["equal", "larger", "less"]
    count: bool
    wanted: float | None
    """Requirement by default, if the user gives no other."""


def quality_measures(*, tetrahedra: bool = False) -> list[QualityMeasure]:
    """All numbers of ``Quality`` except energies, or of ``TetQuality``.

    >>> import temper
    >>> {row.key: row.wanted for row in temper.quality_measures() if row.community == "D-Flow FM"}
    {'max_orthogonality': 0.01, 'max_smoothness': None, 'min_flow_link': 0.1, 'small_flow_links': 0.0}
    """
    rows = _temper.tet_quality_measures() if tetrahedra else _temper.quality_measures()
    return [QualityMeasure(**row) for row in rows]


@dataclasses.dataclass(frozen=True, eq=False)
class TriangleQuality(Record):
    """Quality of each triangle: arrays (m,), which VTU files have as cell data."""

    well_centered: npt.NDArray[np.bool_]
    """All h > 0 and 0 < d < ℓ, exact."""
    min_h_over_l: npt.NDArray[np.float64]
    """−inf for an inverted triangle."""
    min_d_over_l: npt.NDArray[np.float64]
    """Lesser of d/ℓ and 1 − d/ℓ, least over the edges."""
    min_angle_deg: npt.NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class TetrahedronQuality(Record):
    """Quality of each tetrahedron: arrays (m,), which VTU files have as cell data."""

    well_centered: npt.NDArray[np.bool_]
    """All h > 0, exact."""
    min_h_over_l: npt.NDArray[np.float64]
    """Least h/ℓ over its faces."""
    min_dihedral_deg: npt.NDArray[np.float64]


def tetrahedron_quality(mesh: AnyMeshLike) -> TetrahedronQuality:
    """Measures each tetrahedron: arrays whose least values are in ``quality``.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.TetMesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2, 3)])
    >>> temper.tetrahedron_quality(mesh).min_dihedral_deg.round(2)
    array([54.74])
    """
    any_mesh = as_any_mesh(mesh)
    if not isinstance(any_mesh, TetMesh):
        raise TypeError("expected a mesh of tetrahedra, found triangles. Next: temper.triangle_quality takes them")
    return TetrahedronQuality(**_temper.tetrahedron_quality(any_mesh._handle))


def triangle_quality(mesh: MeshLike) -> TriangleQuality:
    """Measures each triangle: arrays whose least values are in ``quality``.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.horseshoe()
    >>> each = temper.triangle_quality(mesh)
    >>> bool(each.min_angle_deg.min() == temper.quality(mesh).min_angle_deg)
    True
    """
    return TriangleQuality(**_temper.triangle_quality(as_mesh(mesh)._handle))
