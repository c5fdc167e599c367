"""The report on a primal-dual mesh, and the energies."""

from __future__ import annotations

import dataclasses
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike, _doubles, as_mesh
from ._optimize_options import EnergyName
from ._options import Softening, SofteningLike, _softening
from ._records import Record, merged, table
from ._space import Space


@dataclasses.dataclass(frozen=True, eq=False)
class Histogram(Record):
    """Counts in equal bins over [low, high]. What lies outside goes to the end bins; each bin holds its lower end."""

    low: float
    high: float
    counts: npt.NDArray[np.uint64]

    @property
    def edges(self) -> npt.NDArray[np.float64]:
        """The ends of the bins, one more than bins, as ``matplotlib.pyplot.stairs`` takes them."""
        return np.linspace(self.low, self.high, len(self.counts) + 1)


@dataclasses.dataclass(frozen=True)
class WorstTriangle(Record):
    """One of the triangles with the least h/ℓ or d/ℓ."""

    triangle: int
    vertices: tuple[int, int, int]
    at: tuple[float, float]
    """Centroid; on a sphere its longitude and latitude [degrees]."""
    h_over_l: float
    """Least of its three."""
    angle_deg: float
    """Largest."""
    why: str


@dataclasses.dataclass(frozen=True, eq=False)
class Quality(Record):
    """What ``quality`` measures: counts decided exactly, margins and energies in doubles. On a sphere lengths and
    angles are those of arcs."""

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
    """Triangles with some h ≤ 0, and inverted ones."""
    edges_not_crossed: int
    """Edges without 0 < d < ℓ."""
    well_centered_fraction: float
    """Triangles with all h > 0 and 0 < d < ℓ."""
    min_h_over_l: float
    """Over triangles and their edges; −inf for an inverted triangle."""
    min_d_over_l: float
    """Over edges, the lesser of d/ℓ and 1 − d/ℓ."""
    min_angle_deg: float
    max_angle_deg: float
    max_transmissibility_over_median: float
    """Of ℓ/\\|h_k + h_l\\| of interior edges. inf when a dual edge has length zero, exactly; 1 without interior
    edges."""
    transmissibility_ratio: float
    """The largest over the least of them."""
    min_edge_over_size: float
    """Of interior edges, over the mean of the local sizes at their ends."""
    min_dual_over_size: float
    min_dual_over_cell_median: float
    """Of each closed cell the least signed dual over the median of their lengths."""
    max_orthogonality: float
    """D-Flow FM: \\|cosine\\| between an edge and the line of the circumcenters kept inside."""
    max_smoothness: float
    """D-Flow FM: ratio of areas on the sides of an edge."""
    min_flow_link: float
    """D-Flow FM: distance of these circumcenters over the mean root of their areas."""
    small_flow_links: int
    """D-Flow FM: where that is below 0.1."""
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
    """Distance of a vertex from the centroid of its closed cell."""
    energy: dict[str, tuple[float, float, float]]
    """Of each energy the totals for ★0, ★1, ★2; inf outside its domain."""
    worst: list[WorstTriangle]
    """Worst first."""
    angles: Histogram = dataclasses.field(repr=False)
    """Of all angles [degrees]."""
    h_over_l: Histogram = dataclasses.field(repr=False)
    d_over_l: Histogram = dataclasses.field(repr=False)

    def _repr_html_(self) -> str:
        rows = [row for row in self._rows() if row[0] not in ("worst", "energy")]
        worst = [(f"triangle {w.triangle}", w.why) for w in self.worst]
        return table("Quality", rows, table("worst triangles", worst) if worst else "")


def quality(
    mesh: MeshLike,
    *,
    gamma: SofteningLike = Softening(1.0, "absolute"),
    h0: SofteningLike = Softening(0.0, "absolute"),
    worst: int = 5,
    threads: int | None = None,
) -> Quality:
    """Measures a mesh: is it valid, regular, well-centered, and with what margins?

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
    gamma, h0 : Softening or float
        γ of E_BP and −h° of E_BHs in the report; plain numbers are relative to each edge.
    worst : int
        How many of the worst triangles to list.
    threads : int, optional
        None or 0: all of the machine. The report does not depend on it.

    Examples
    --------
    >>> import temper
    >>> temper.quality(temper.generate.horseshoe()).orthocenters_outside
    58
    """
    d = _temper.quality(as_mesh(mesh)._handle, _softening("gamma", gamma), _softening("h0", h0), worst, threads)
    histograms = {name: Histogram(**d[name]) for name in ("angles", "h_over_l", "d_over_l")}
    return Quality(**merged(d, worst=[WorstTriangle(**w) for w in d["worst"]], **histograms))


@dataclasses.dataclass(frozen=True)
class QualityMeasure(Record):
    """A row of ``quality_measures``: a number of ``Quality``."""

    key: str
    """Its name in ``Quality``, in reports and for ``--require``."""
    alias: str
    """A short name for ``--require``, or the one that its community uses; or empty."""
    label: str
    community: str
    """Whose codes look at it; empty for those of primal-dual meshes as such."""
    definition: str
    better: Literal["equal", "larger", "less"]
    count: bool
    wanted: float | None
    """What is asked for where nobody says more."""


def quality_measures() -> list[QualityMeasure]:
    """All numbers of ``Quality``, the energies aside.

    >>> import temper
    >>> {row.key: row.wanted for row in temper.quality_measures() if row.community == "D-Flow FM"}
    {'max_orthogonality': 0.01, 'max_smoothness': None, 'min_flow_link': 0.1, 'small_flow_links': 0.0}
    """
    return [QualityMeasure(**row) for row in _temper.quality_measures()]


check = quality
"""The same as ``quality``, by the name of the program's verb."""


@dataclasses.dataclass(frozen=True, eq=False)
class TriangleQuality(Record):
    """What ``Quality`` says of a mesh, of each triangle: arrays (m,), which VTU files have as cell data."""

    well_centered: npt.NDArray[np.bool_]
    """All h > 0 and 0 < d < ℓ, exact."""
    min_h_over_l: npt.NDArray[np.float64]
    """−inf for an inverted triangle."""
    min_d_over_l: npt.NDArray[np.float64]
    """Of each edge the lesser of d/ℓ and 1 − d/ℓ."""
    min_angle_deg: npt.NDArray[np.float64]


def triangle_quality(mesh: MeshLike) -> TriangleQuality:
    """Measures each triangle: arrays of what ``quality`` has the least of.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.horseshoe()
    >>> each = temper.triangle_quality(mesh)
    >>> bool(each.min_angle_deg.min() == temper.quality(mesh).min_angle_deg)
    True
    """
    return TriangleQuality(**_temper.triangle_quality(as_mesh(mesh)._handle))


def triangle_margins(mesh: MeshLike) -> npt.NDArray[np.float64]:
    """Of each triangle the least of its h/ℓ, d/ℓ and 1 − d/ℓ, in doubles, (m,) float64: above 0 where well-centered."""
    return _temper.triangle_margins(as_mesh(mesh)._handle)[0]


def well_centered_triangles(mesh: MeshLike) -> npt.NDArray[np.bool_]:
    """Of each triangle whether it is well-centered, (m,) bool. Exact."""
    return _temper.triangle_margins(as_mesh(mesh)._handle)[1]


# --- energies ------------------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class EnergyInfo(Record):
    """One row of the registry of energies."""

    name: EnergyName
    formula: str
    boundary_treatment: Literal["as_is", "absolute", "mirrored"]
    """The treatment of boundary duals that its definition asks for."""
    barrier: bool
    """Infinite outside 0 < d < ℓ."""
    softened_by_gamma: bool
    softened_by_h0: bool
    length_exponent: int
    """E(s · mesh) = s^this · E(mesh) with relative softening."""
    signed_by_dual: bool
    """The sign of an edge is that of its dual length."""
    normalized: bool
    """Each triangle over its squared area."""
    positions_alone: bool
    """For meshes without weights, which stay so."""


def energies() -> list[EnergyInfo]:
    """All energies, for ★s with α = (1/4, 1/3, 1/12), β = (1/12, 1/3, 1/4), per half-edge (eqs. 2 to 7 of the
    paper)."""
    return [EnergyInfo(**row) for row in _temper.energies()]


def find_energy(name: str) -> EnergyInfo:
    """The row of that name; TemperError lists the names when there is none."""
    found = _temper.find_energy(name)
    return next(row for row in energies() if row.name == found)


@dataclasses.dataclass(frozen=True)
class EnergyModel(Record):
    """An energy with everything it depends on."""

    energy: EnergyName = "BP"
    star: Literal[0, 1, 2] = 1
    boundary_treatment: Literal["as_is", "absolute", "mirrored"] = "as_is"
    """Of F and nF; the others define their own."""
    gamma: SofteningLike = Softening(1.0, "absolute")
    """γ of E_BP; the paper's examples use 1, absolute."""
    h0: SofteningLike = Softening(0.0, "absolute")
    """−h° of E_BHs, ≥ 0."""
    wall: bool = False
    """A barrier is infinite on inverted triangles too; the paper's E_BP and E_BHs are not."""

    def _plain(self) -> dict[str, Any]:
        values = {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}
        return {**values, "gamma": _softening("gamma", self.gamma), "h0": _softening("h0", self.h0)}


def total_energy(mesh: MeshLike, model: EnergyModel = EnergyModel(), *, threads: int | None = None) -> float:
    """The energy of a mesh; inf when any term is outside its domain. The same bits for any number of threads."""
    return _temper.total_energy(as_mesh(mesh)._handle, model._plain(), threads)


def triangle_energy(model: EnergyModel, corners: npt.ArrayLike, *, space: Space = Space()) -> float:
    """The energy of one triangle alone, all its edges boundary edges: ``corners`` is (3, 3), rows x, y, w; on a sphere
    lifted points. There this and all other energies are those of the flat triangles of the lifted points.

    >>> import temper
    >>> model = temper.EnergyModel("BH")
    >>> round(temper.triangle_energy(model, [(0, 0, 0), (1, 0, 0), (0.5, 0.75**0.5, 0)]), 12)
    4.618802153517
    """
    return _temper.triangle_energy(model._plain(), _doubles(corners, 3, "corners"), space.radius)


@dataclasses.dataclass(frozen=True)
class VertexDerivatives(Record):
    """The energy as a function of one vertex."""

    value: float
    """inf when not feasible."""
    feasible: bool
    """Inside the domain of the energy; else the rest is zero."""
    gradient: tuple[float, float, float]
    """∂E/∂x, ∂E/∂y, ∂E/∂w; on a sphere x and y are along two unit vectors at right angles to P and each other."""
    hessian: tuple[float, float, float, float, float, float]
    """xx, xy, xw, yy, yw, ww."""


def vertex_energy(mesh: MeshLike, model: EnergyModel, vertex: int) -> VertexDerivatives:
    """The part of the total energy that depends on a vertex, with its derivatives."""
    return VertexDerivatives(**_temper.vertex_energy(as_mesh(mesh)._handle, model._plain(), vertex))
