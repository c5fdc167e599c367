"""Written by scripts/docs/records.py --write from the tables in the library. Do not edit."""

from __future__ import annotations

import dataclasses
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _looks
from ._certificate import Certificate
from ._records import CLASSES, Record


@dataclasses.dataclass(frozen=True, eq=False)
class EdgePlace(Record):
    """An edge as a place."""

    vertices: tuple[int, int]
    """Its vertices."""
    at: tuple[float, float]
    """Its midpoint; on a sphere longitude and latitude [degrees]."""
    z: float | None
    """Third coordinate of the midpoint, on a curved surface."""


@dataclasses.dataclass(frozen=True, eq=False)
class Histogram(_looks.Histogram):
    """Counts in equal bins over [low, high]. Each bin includes its lower end. Values outside go to the end bins."""

    low: float
    high: float
    counts: npt.NDArray[np.uint64]


@dataclasses.dataclass(frozen=True, eq=False)
class Histograms(Record):
    """Histograms of a mesh."""

    angles: Histogram
    """Angles of all triangles [degrees]."""
    h_over_l: Histogram
    """h/ℓ of each triangle and edge."""
    d_over_l: Histogram
    """Lesser of d/ℓ and 1 − d/ℓ of each edge."""


@dataclasses.dataclass(frozen=True, eq=False)
class WorstTriangle(Record):
    """A triangle whose least h/ℓ or d/ℓ is among the smallest of the mesh."""

    triangle: int
    """Number of the triangle, from 0."""
    vertices: tuple[int, int, int]
    """Its vertices."""
    at: tuple[float, float]
    """Its centroid; on a sphere longitude and latitude [degrees]."""
    h_over_l: float
    """Least h/ℓ of its three edges."""
    angle_deg: float
    """Largest of its three angles [degrees]."""
    why: str
    """The reason, such as "orthocenter outside across edge 3-9: angle of 138.3° at vertex 10"."""
    z: float | None
    """Third coordinate of the centroid, on a curved surface."""


@dataclasses.dataclass(frozen=True, eq=False)
class Quality(_looks.Quality):
    """The result of ``quality``: counts decided exactly, margins and energies in doubles. On a sphere lengths and
    angles are measured along arcs."""

    vertices: int
    """Vertices."""
    triangles: int
    """Triangles."""
    edges: int
    """Edges."""
    boundary_edges: int
    """Edges of one triangle."""
    regions: int
    """Different regions of triangles."""
    inverted_triangles: int
    """Triangles that are clockwise, exact."""
    non_regular_edges: int
    """Interior edges with negative dual, exact."""
    negative_boundary_duals: int
    """Boundary edges with h < 0, exact."""
    negative_region_coefficients: int
    """Sides of interfaces between regions with h < 0, exact: the coefficient of this region alone is negative."""
    nonpositive_distances: int
    """Interior edges with dual ≤ 0, exact."""
    nonpositive_boundary_distances: int
    """Boundary edges with h ≤ 0, exact."""
    nonpositive_region_distances: int
    """Sides of interfaces between regions with h ≤ 0, exact."""
    orthocenters_outside: int
    """Triangles with some h ≤ 0, exact."""
    edges_not_crossed: int
    """Edges without 0 < d < ℓ, exact."""
    well_centered_fraction: float
    """Triangles with all h > 0 and 0 < d < ℓ."""
    min_coefficient: float
    """Least coefficient, which is dual/ℓ of edges, and h/ℓ on the sides of interfaces; also the least distance over
    ℓ."""
    min_h_over_l: float
    """Least h/ℓ of triangles and their edges."""
    min_d_over_l: float
    """Least d/ℓ or 1 − d/ℓ of edges."""
    min_angle_deg: float
    """Least angle of triangles."""
    max_angle_deg: float
    """Largest angle of triangles."""
    max_transmissibility_over_median: float
    """Largest over median ℓ/\\|dual\\| of interior edges."""
    transmissibility_ratio: float
    """Largest over least ℓ/\\|dual\\| of interior edges."""
    min_edge_over_size: float
    """Least length of interior edges over local size, as in --min-edge."""
    min_dual_over_size: float
    """Least signed length of interior duals over local size, as in --min-dual."""
    min_dual_over_cell_median: float
    """Least signed dual of a closed cell over the median length of its duals."""
    max_orthogonality: float
    """Largest \\|cosine\\| between an interior edge and the line between the circumcenters on its sides, kept inside
    their triangles (MeshKernel, MeshOrthogonality). Advice: 0.01. D-Flow FM refuses 0.5 (cosPhiUTrsh)."""
    max_smoothness: float
    """Largest ratio of the areas on the sides of an interior edge (MeshKernel, MeshSmoothness)."""
    min_flow_link: float
    """Least distance between neighboring circumcenters, kept inside their triangles, over the mean square root of both
    areas (MeshKernel, GetEdgesCrossingSmallFlowEdges)."""
    small_flow_links: int
    """Interior edges with a flow link below 0.1, which D-Flow FM removes (removeSmallLinksTrsh)."""
    min_cell_quality: float
    """Shortest over longest dvEdge of a closed cell (MPAS-Tools, mpas_mesh_converter)."""
    min_grid_spacing: float
    """Mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]."""
    max_grid_spacing: float
    """Mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]."""
    min_triangle_quality: float
    """Shortest over longest dcEdge of a triangle (MPAS-Tools, mpas_mesh_converter)."""
    min_triangle_angle_quality: float
    """Least over largest angle of a triangle, by the law of cosines (MPAS-Tools, mpas_mesh_converter)."""
    obtuse_triangles: int
    """Triangles with an angle above 90° (MPAS-Tools, mpas_mesh_converter), exact."""
    max_centroid_offset_over_size: float
    """Largest distance of a vertex from the centroid of its closed cell, over local size; 0 in centroidal Voronoi
    meshes."""
    energy: dict[str, tuple[float, float, float]]
    """Total of each energy for ★0, ★1, ★2; infinite outside its domain."""
    min_coefficient_place: EdgePlace
    """Edge with the least coefficient."""
    histograms: Histograms = dataclasses.field(repr=False)
    """Histograms of angles, h/ℓ and d/ℓ."""
    worst: list[WorstTriangle]
    """Worst triangles, the worst first."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetEdgePlace(Record):
    """An edge of tetrahedra as a place."""

    vertices: tuple[int, int]
    """Its vertices."""
    at: tuple[float, float, float]
    """Its midpoint."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetFacePlace(Record):
    """A face of tetrahedra as a place."""

    vertices: tuple[int, int, int]
    """Its vertices."""
    at: tuple[float, float, float]
    """Its centroid."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetHistograms(Record):
    """Histograms of a mesh of tetrahedra."""

    dihedrals: Histogram
    """All dihedral angles [degrees]."""
    h_over_l: Histogram
    """h/ℓ of each tetrahedron and face."""


@dataclasses.dataclass(frozen=True, eq=False)
class WorstTet(Record):
    """A tetrahedron whose least h/ℓ is among the smallest of the mesh."""

    tetrahedron: int
    """Number of the tetrahedron, from 0."""
    vertices: tuple[int, int, int, int]
    """Its vertices."""
    at: tuple[float, float, float]
    """Its centroid."""
    h_over_l: float
    """Least h/ℓ of its four faces."""
    dihedral_deg: float
    """Largest of its six dihedral angles [degrees]."""
    why: str
    """The reason, such as "orthocenter outside across face 3-9-12: h/ℓ = -0.2"."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetQuality(_looks.TetQuality):
    """The result of ``quality`` for tetrahedra: counts decided exactly, margins in doubles. The length ℓ of a face is
    the side of the equilateral triangle with its area, the length ℓ of an edge its own."""

    vertices: int
    """Vertices."""
    inner_vertices: int
    """Vertices that are not on the boundary."""
    tetrahedra: int
    """Tetrahedra."""
    faces: int
    """Faces."""
    boundary_faces: int
    """Faces of one tetrahedron."""
    edges: int
    """Edges."""
    regions: int
    """Different regions of tetrahedra."""
    inverted_tetrahedra: int
    """Tetrahedra that are not positive, exact."""
    non_regular_faces: int
    """Interior faces with negative dual edge, exact."""
    negative_boundary_duals: int
    """Boundary faces with h < 0, exact."""
    negative_coefficients: int
    """Interior edges with a negative coefficient, the area of the dual over ℓ, exact."""
    negative_boundary_coefficients: int
    """Boundary edges with a negative coefficient, exact."""
    negative_region_coefficients: int
    """Edges between regions with a negative coefficient of one region alone, counted once per region, exact."""
    nonpositive_distances: int
    """Interior faces with dual edge ≤ 0, exact."""
    nonpositive_boundary_distances: int
    """Boundary faces with h ≤ 0, exact."""
    nonpositive_region_distances: int
    """Sides of faces between regions with h ≤ 0, exact."""
    orthocenters_outside: int
    """Tetrahedra with some h ≤ 0, exact."""
    faces_not_crossed: int
    """Faces whose orthocenter is not strictly inside, exact."""
    edges_not_crossed: int
    """Edges without 0 < d < ℓ, exact."""
    well_centered_fraction: float
    """Tetrahedra with all h > 0."""
    completely_well_centered_fraction: float
    """Tetrahedra with all h > 0 whose faces and edges are crossed."""
    min_coefficient: float
    """Least area of the dual of an edge over ℓ², also of each region alone."""
    min_distance: float
    """Least dual edge over ℓ of its face, and h/ℓ on the sides of interfaces."""
    min_h_over_l: float
    """Least h/ℓ of tetrahedra and their faces, ℓ the side of the equilateral triangle with the area of the face."""
    min_face_h_over_l: float
    """Least h/ℓ of faces and their edges."""
    min_d_over_l: float
    """Least d/ℓ or 1 − d/ℓ of edges."""
    min_dihedral_deg: float
    """Least angle between two faces."""
    max_dihedral_deg: float
    """Largest angle between two faces."""
    volume: float
    """Volume of all tetrahedra [length³]."""
    min_volume: float
    """Least volume of a tetrahedron [length³]."""
    max_volume: float
    """Largest volume of a tetrahedron [length³]."""
    max_transmissibility_over_median: float
    """Largest over median A/\\|dual\\| of interior faces."""
    transmissibility_ratio: float
    """Largest over least A/\\|dual\\| of interior faces."""
    min_coefficient_place: TetEdgePlace
    """Edge with the least coefficient."""
    min_distance_place: TetFacePlace
    """Face with the least distance."""
    histograms: TetHistograms = dataclasses.field(repr=False)
    """Histograms of dihedral angles and h/ℓ."""
    worst: list[WorstTet]
    """Worst tetrahedra, the worst first."""


@dataclasses.dataclass(frozen=True, eq=False)
class SurfaceQuality(Record):
    """The quality of a curved surface: counts decided exactly, margins in doubles."""

    vertices: int
    """Vertices."""
    triangles: int
    """Triangles."""
    edges: int
    """Edges."""
    boundary_edges: int
    """Edges of one triangle."""
    regions: int
    """Different regions of triangles."""
    inverted_triangles: int
    """Triangles that are clockwise, exact."""
    non_regular_edges: int
    """Interior edges with negative dual, exact."""
    negative_boundary_duals: int
    """Boundary edges with h < 0, exact."""
    negative_region_coefficients: int
    """Sides of interfaces between regions with h < 0, exact: the coefficient of this region alone is negative."""
    nonpositive_distances: int
    """Interior edges with dual ≤ 0, exact."""
    nonpositive_boundary_distances: int
    """Boundary edges with h ≤ 0, exact."""
    nonpositive_region_distances: int
    """Sides of interfaces between regions with h ≤ 0, exact."""
    orthocenters_outside: int
    """Triangles with some h ≤ 0, exact."""
    edges_not_crossed: int
    """Edges without 0 < d < ℓ, exact."""
    well_centered_fraction: float
    """Triangles with all h > 0 and 0 < d < ℓ."""
    min_coefficient: float
    """Least coefficient, which is dual/ℓ of edges, and h/ℓ on the sides of interfaces; also the least distance over
    ℓ."""
    min_h_over_l: float
    """Least h/ℓ of triangles and their edges."""
    min_d_over_l: float
    """Least d/ℓ or 1 − d/ℓ of edges."""
    min_angle_deg: float
    """Least angle of triangles."""
    max_angle_deg: float
    """Largest angle of triangles."""
    max_transmissibility_over_median: float
    """Largest over median ℓ/\\|dual\\| of interior edges."""
    transmissibility_ratio: float
    """Largest over least ℓ/\\|dual\\| of interior edges."""
    min_coefficient_place: EdgePlace
    """Edge with the least coefficient."""
    histograms: Histograms = dataclasses.field(repr=False)
    """Histograms of angles, h/ℓ and d/ℓ."""
    worst: list[WorstTriangle]
    """Worst triangles, the worst first."""


@dataclasses.dataclass(frozen=True, eq=False)
class Spread(Record):
    """The distribution of many numbers: percentiles by nearest rank. All are 0 if there are no numbers."""

    min: float
    p05: float
    median: float
    p95: float
    max: float


@dataclasses.dataclass(frozen=True, eq=False)
class SizeReport(Record):
    """The comparison of a mesh with a size field. No number depends on the unit of length."""

    over_field: Spread
    """Local size over field at the vertices."""
    gradation: Spread
    """Ratio of the greater to the smaller local size at the two ends of each edge."""
    largest_edge_ratio: float
    """Largest ratio of the longest to the shortest edge of a triangle."""
    vertices_outside_field: int
    """Number of vertices outside the field's mesh."""
    band: float
    """B of the smallest band [1/B, B] that holds all ratios of size to field."""


@dataclasses.dataclass(frozen=True, eq=False)
class SizeChange(Record):
    """The change of the sizes: both meshes compared with the size field."""

    before: SizeReport
    """The input."""
    after: SizeReport
    """The result."""


@dataclasses.dataclass(frozen=True, eq=False)
class ChangeCounts(Record):
    """Counts of the changes of a run, by the numbers of the input."""

    vertices_moved: int
    """Vertices of the input at another place."""
    weights_changed: int
    """Vertices of the input with another weight."""
    edges_changed: int
    """Edges of the result that the input does not have."""


@dataclasses.dataclass(frozen=True, eq=False)
class SweepRecord(Record):
    """One sweep over all vertices."""

    sweep: int
    """Number of the sweep; 0 is the input."""
    energy: float
    """Value of the objective at the end of the sweep, at its γ."""
    bad: int
    """Number of triangles or tetrahedra that are not well-centered."""
    flips: int
    """Number of flips in this sweep."""
    length_parameter: float
    """Value of γ or −h° in this sweep, relative to ℓ by default."""
    seconds: float
    """Time since the start of the optimization [s]."""
    objective: Literal["energy", "accuracy", "solver_error"]
    """Objective that the sweep lowered."""


@dataclasses.dataclass(frozen=True, eq=False)
class OptimizeReport(_looks.OptimizeReport):
    """The result of ``optimize``."""

    sweeps: int
    """Number of sweeps."""
    seconds: float
    """Time of the optimization alone [s]."""
    stopped: Literal["converged", "max_sweeps", "max_outer", "time_limit", "canceled", "tangled", "sweep_limit", "hidden"]
    """Reason for the end of the run. tangled: triangles are inverted and no flips can make the mesh regular. hidden:
    deferred flips hid a vertex against the policy, and the mesh is an earlier one. sweep_limit: all sweeps for the
    accuracy are done, a normal end."""
    objective: Literal["energy", "accuracy", "solver_error"]
    """Objective that the run lowered."""
    objective_before: float
    """Objective of the input, at the final γ."""
    objective_after: float
    """Objective of the result."""
    vertices_removed: int
    """Number of vertices of the input that were removed."""
    hidden_vertices: npt.NDArray[np.int32]
    """Vertices without a power cell that the option hidden = keep left."""
    vertices_inserted: int
    """Number of new vertices."""
    flips: int
    """Number of changes of connectivity without a new or removed vertex."""
    bad_before: int
    """Number of triangles or tetrahedra of the input that are not well-centered, before any flip."""
    bad_after: int
    """Number of these in the result."""
    vertices: npt.NDArray[np.int32]
    """Number of each vertex in the input; inserted vertices follow, with −1. Empty if none was removed or inserted."""
    size: SizeChange | None
    """Change of the sizes; absent for tetrahedra."""
    changed: ChangeCounts | None
    """Changes of the run, with change = least."""
    notes: list[str]
    """Notes for the user, in sentences."""
    history: list[SweepRecord] = dataclasses.field(repr=False)
    """One record per sweep; history[0] is the input. Triangles are flipped to be regular before."""
    data: DataReport | TetDataReport | None = dataclasses.field(default=None, kw_only=True)
    """Report on the data of the mesh; None without data."""


@dataclasses.dataclass(frozen=True, eq=False)
class SurfaceOptimizeReport(_looks.SurfaceOptimizeReport):
    """The result of ``optimize``."""

    sweeps: int
    """Number of sweeps."""
    seconds: float
    """Time of the optimization alone [s]."""
    stopped: Literal["converged", "max_sweeps", "max_outer", "time_limit", "canceled", "tangled", "sweep_limit", "hidden"]
    """Reason for the end of the run. tangled: triangles are inverted and no flips can make the mesh regular. hidden:
    deferred flips hid a vertex against the policy, and the mesh is an earlier one. sweep_limit: all sweeps for the
    accuracy are done, a normal end."""
    objective: Literal["energy", "accuracy", "solver_error"]
    """Objective that the run lowered."""
    objective_before: float
    """Objective of the input, at the final γ."""
    objective_after: float
    """Objective of the result."""
    vertices_removed: int
    """Number of vertices of the input that were removed."""
    hidden_vertices: npt.NDArray[np.int32]
    """None."""
    vertices_inserted: int
    """Number of new vertices."""
    flips: int
    """Number of changes of connectivity without a new or removed vertex."""
    bad_before: int
    """Number of triangles or tetrahedra of the input that are not well-centered, before any flip."""
    bad_after: int
    """Number of these in the result."""
    vertices: npt.NDArray[np.int32]
    """Number of each vertex in the input, −1 for inserted ones."""
    surface_distance: float
    """Bound of the distance between all points of input and result, both ways [length]."""
    diagonal: float
    """Diagonal of the bounding box of the input [length]."""
    repairs: int
    """Number of edits next to bad triangles."""
    crease_edges: int
    """Number of edges of creases, which stay."""
    sharp_edges_before: int
    """Number of edges that turn more than crease_angle, in the input."""
    sharp_edges_after: int
    """Number of these edges in the result."""
    max_turn_before_deg: float
    """Largest angle between normals of neighbors, in the input [degrees]."""
    max_turn_after_deg: float
    """Largest of these angles in the result [degrees]."""
    changed: ChangeCounts | None
    """Changes of the run, with change = least."""
    notes: list[str]
    """Notes for the user, in sentences."""
    history: list[SweepRecord] = dataclasses.field(repr=False)
    """One record per sweep; history[0] is the input. Triangles are flipped to be regular before."""
    data: DataReport | TetDataReport | None = dataclasses.field(default=None, kw_only=True)
    """Report on the data of the mesh; None without data."""


@dataclasses.dataclass(frozen=True, eq=False)
class Progress(Record):
    """Progress of a run. Observers get it at least once per sweep, and more often on large meshes."""

    last: SweepRecord
    """Last whole sweep."""
    fraction: float
    """Fraction of the current sweep, in [0, 1)."""
    max_sweeps: int
    """Largest number of sweeps."""
    sweeps_left: float | None
    """Estimate of the sweeps after the last one, while the energy converges. Absent in the first sweeps of a stage."""
    n_vertices: int | None
    """Number of vertices, while the run searches for a mesh with fewer."""
    share_of_phase: float | None
    """Estimate of the share of the present phase that is done, in [0, 1]. Each objective of `last` is a phase, and its
    energy has another meaning than in the phase before."""
    phase: str
    """Phase of the mesher before an optimization, such as "placing points"; `fraction` is then the share of the phase
    that is done, as far as it is known. Empty in an optimization."""


@dataclasses.dataclass(frozen=True, eq=False)
class TraceEvent(Record):
    """An event of a run. Vertices are numbered as in the input, also after removals; new vertices get the next numbers.
    Coordinates and weights are in the user's units."""

    kind: Literal["move", "weight", "flip", "collapse", "removal", "insertion", "split", "hidden", "undo"]
    """Kind of the event."""
    sweep: int
    """Sweep of the event; 0: the input is made regular and its boundary cut."""
    vertex: int
    """Vertex of the event; −1 for flip, and for undo of whole sweeps. For insertion and split, the new vertex."""
    before: float
    """Energy before the event, of the vertex's patch or of all edges that a flip changes; NaN if the event has none."""
    after: float
    """Energy after the event."""
    point: tuple[float, float, float]
    """New x, y, w of the vertex for move, weight, insertion, split; on a sphere its weighted vector."""
    quad: tuple[int, int, int, int]
    """For flip: edge a→b, with c on its left and d on its right, becomes d→c. For split: a→b was cut; d is −1 on the
    boundary."""
    link: npt.NDArray[np.int32]
    """Neighbors, counter-clockwise, for collapse and removal; corners of the triangle for insertion."""
    triangles: list[tuple[int, int, int]]
    """New triangles of the cavity, in slot order, for collapse and removal."""
    to_sweep: int
    """For undo without a vertex: the sweep at whose end the mesh was the same; −1: the input as given."""


@dataclasses.dataclass(frozen=True, eq=False)
class DataReport(Record):
    """The fate of the data of points and cells after the mesh has changed. All 0 without such data."""

    points: int
    """Points of the file that are still there."""
    points_moved: int
    """Points among these that have moved."""
    distance: Spread
    """Distances that these have moved [length]."""
    points_inserted: int
    """New points that the file did not have."""
    interpolated: list[str]
    """Point data that belong to the place: linear in the cells of the file."""
    kept: list[str]
    """Point data that stayed with their points."""
    conserved: list[str]
    """Point data whose integrals stay: means over power cells."""
    dropped: list[str]
    """Integer point data that differ around an inserted point."""
    triangles: int
    """Number of cells."""
    triangles_changed: int
    """Cells among these that the file does not have at the same number and places."""
    of_triangles: list[str]
    """Data of cells: each cell has the data of the file's cell that contains its middle."""
    conserved_of_triangles: list[str]
    """Data of cells whose integrals stay: means over the file's cells."""
    integral_change: float
    """Largest change of the integral of conserved data over the domain or a region, over the integral of \\|u\\|
    there."""
    out_of_range: float
    """Largest distance of conserved data from the range of the file's data, over the largest \\|u\\|; 0 unless the
    boundary moved."""


@dataclasses.dataclass(frozen=True, eq=False)
class DecSummary(Record):
    """A summary of the operators, for a check before a solver uses them."""

    vertices: int
    """Number of vertices."""
    edges: int
    """Number of edges."""
    boundary_edges: int
    """Number of edges on the boundary."""
    triangles: int
    """Number of triangles."""
    not_well_centered: int
    """Number of triangles that are not well-centered, exact."""
    area: float
    """Area of the domain [length²]."""
    star0_sum: float
    """Sum of ★0: the area, except for rounding [length²]."""
    negative_star0: int
    """Number of negative ★0."""
    negative_star1: int
    """Number of interior edges that are not regular, exact."""
    negative_boundary_star1: int
    """Number of boundary edges with the orthocenter outside the domain, exact."""
    zero_star1: int
    """Number of interior edges that are cocircular, exact."""
    min_star0: float
    """Least ★0."""
    min_star1: float
    """Least ★1."""
    median_star1: float
    """Median of \\|★1\\| over all edges."""
    max_star1: float
    """Largest \\|★1\\|."""
    max_star1_over_median: float
    """Largest over median \\|★1\\|."""
    median_transmissibility: float
    """Median of \\|transmissibility\\| inside."""
    max_transmissibility: float
    """Largest \\|transmissibility\\| inside; infinite if a dual edge has length 0."""
    max_transmissibility_over_median: float
    """Largest over median \\|transmissibility\\|."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetDecSummary(Record):
    """A summary of the operators of tetrahedra, for a check before a solver uses them."""

    vertices: int
    """Number of vertices."""
    edges: int
    """Number of edges."""
    faces: int
    """Number of faces."""
    boundary_faces: int
    """Number of faces on the boundary."""
    tetrahedra: int
    """Number of tetrahedra."""
    not_well_centered: int
    """Number of tetrahedra that are not well-centered, exact."""
    volume: float
    """Volume of the domain [length³]."""
    star0_sum: float
    """Sum of ★0: the volume, except for rounding [length³]."""
    negative_star0: int
    """Number of negative ★0."""
    negative_star1: int
    """Number of negative ★1."""
    negative_star2: int
    """Number of interior faces that are not regular, exact."""
    negative_boundary_star2: int
    """Number of boundary faces with the orthocenter outside the domain, exact."""
    zero_star2: int
    """Number of interior faces that are cospherical, exact."""
    min_star0: float
    """Least ★0."""
    min_star1: float
    """Least ★1."""
    min_star2: float
    """Least ★2."""
    median_star1: float
    """Median of \\|★1\\| over all edges."""
    max_star1: float
    """Largest \\|★1\\|."""
    max_star1_over_median: float
    """Largest over median \\|★1\\|."""
    median_transmissibility: float
    """Median of \\|transmissibility\\| inside."""
    max_transmissibility: float
    """Largest \\|transmissibility\\| inside; infinite if a dual edge has length 0."""
    max_transmissibility_over_median: float
    """Largest over median \\|transmissibility\\|."""


@dataclasses.dataclass(frozen=True, eq=False)
class CrossingSide(Record):
    """One side of the edge of a conflict: the interval in which well-centered triangles let the dual cross the edge."""

    triangles: npt.NDArray[np.int32]
    """Triangles of this side; the first one has the edge."""
    from_: float
    """Begin of the interval, as a distance from the edge's first vertex, exclusive [length]."""
    to: float
    """End of the interval [length]."""
    widest_at: int
    """Vertex of the largest angle of these triangles."""
    angle_deg: float
    """Largest angle of these triangles [degrees]."""


@dataclasses.dataclass(frozen=True, eq=False)
class CrossingConflict(Record):
    """An edge whose two sides have disjoint intervals."""

    edge: tuple[int, int]
    """Vertices p and q of the edge."""
    length: float
    """Length of the edge [length]."""
    left: CrossingSide
    """Left side of p → q."""
    right: CrossingSide
    """Right side of p → q."""


@dataclasses.dataclass(frozen=True, eq=False)
class FanCenter(Record):
    """The common corner of the triangles of a fan."""

    vertex: int
    """The corner."""
    on_boundary: bool
    """The corner is on the boundary."""
    angle_deg: float
    """Angle of the domain at a boundary vertex; else 360 [degrees]."""
    shortest_edge: tuple[int, int]
    """Shortest edge of the fan at the corner."""
    shortest_length: float
    """Its length [length]."""
    longest_edge: tuple[int, int]
    """Longest edge of the fan at the corner."""
    longest_length: float
    """Its length [length]."""


@dataclasses.dataclass(frozen=True, eq=False)
class EdgeConflict(Record):
    """An edge u → v with contradictory vertices: one requires that the dual crosses it near u, another near v."""

    edge: tuple[int, int]
    """Vertices u and v."""
    halfedge: int
    """Halfedge from u to v."""
    length: float
    """Length of the edge [length]."""
    near: tuple[int, int]
    """The vertex that requires a crossing near u, and the one near v."""
    within: tuple[float, float]
    """Largest distances of these crossings from u, and from v [length]."""
    sum: float
    """Sum of these distances over the length: at most 1 if there is no place for the crossing."""
    split_at: float
    """Part of the way from u: the middle of what is left, but at least 0.2 from each end."""


@dataclasses.dataclass(frozen=True, eq=False)
class Cure(Record):
    """A change that would cure a reason."""

    action: Literal["find_weights", "optimize", "move_vertex", "flip_edge", "insert_vertex", "split_edge", "split_boundary", "split_interface"]
    """Kind of the change."""
    edge: tuple[int, int] | None
    """Edge that is flipped or split."""
    vertex: int | None
    """Vertex that is moved."""
    triangle: int | None
    """Triangle that gets a vertex."""
    at: tuple[float, float] | None
    """Place of the change; on the sphere longitude and latitude [degrees]."""
    verified: bool
    """A trial on a copy succeeded: the triangles of the neighborhood then have weights that make them well-centered,
    checked exactly."""
    conflict_only: bool
    """Only the triangles of the conflict, and those that the change touches, were tested."""
    ends_conflict: bool
    """For a split: neither half of the edge must be split again, checked exactly."""
    margin: float | None
    """Best margin of h/ℓ and d/ℓ after the cure."""
    margin_of: int
    """Number of triangles that `margin` is for."""
    left_out: int
    """Number of bad triangles nearby that belong to other conflicts and were not tested."""
    weights_changed: int
    """For find_weights: number of nonzero weights around the bad triangles."""
    text: str
    """The cure in one sentence."""


@dataclasses.dataclass(frozen=True, eq=False)
class Reason(Record):
    """A reason why triangles are not well-centered."""

    kind: Literal["split", "edge", "fan", "patch", "interface", "weights", "undecided"]
    """Kind of the reason."""
    at: tuple[float, float]
    """Centroid of the worst triangle; on the sphere longitude and latitude [degrees]."""
    triangles: npt.NDArray[np.int32]
    """Triangles that are not well-centered for this reason, worst first."""
    least_margin: float
    """Least h/ℓ or d/ℓ of these triangles as they are."""
    conflict: npt.NDArray[np.int32]
    """For edge, fan, patch: smallest set of triangles for which no weights exist; `triangles` is a part of it."""
    margin: float
    """Best margin. For edge, fan, patch: of the conflict, at most 0. For weights: of the neighborhood, above 0."""
    margin_of: int
    """Number of triangles that `margin` is for."""
    each: bool
    """`margin` is the least over bad triangles, each with the triangles that touch it."""
    free: npt.NDArray[np.int32]
    """Corners that may move."""
    crossing: CrossingConflict | None
    """Crossings, for edge, fan, and patches without closed rings."""
    center: FanCenter | None
    """Common vertex of all triangles, for edge, fan, patch, if there is one."""
    must_split: EdgeConflict | None
    """Conflict of the edge, for split."""
    certificate: Certificate
    """Proof for edge, fan, patch, interface; `check_certificate` accepts it."""
    cures_searched: bool
    """Cures were searched for; else `cures` has only those that need no search."""
    cures: list[Cure]
    """Cures, best first."""
    text: str
    """The reason in words."""


@dataclasses.dataclass(frozen=True, eq=False)
class Explanation(_looks.Explanation):
    """The result of ``explain``."""

    triangles: int
    """Number of triangles."""
    bad: int
    """Number of triangles that are not well-centered."""
    verdict: Literal["feasible", "infeasible", "undecided"]
    """Verdict on the whole mesh with its positions and connectivity. Feasible if no triangle is bad."""
    weights_changed: int | None
    """For feasible: number of nonzero weights in the result of find_weights."""
    margin: float
    """Requested margin of these weights: 0.01, or half of the best margin if that is less."""
    reasons: list[Reason]
    """Reasons: certified ones first, by least margin; then by least_margin."""


@dataclasses.dataclass(frozen=True, eq=False)
class FaceHeight(Record):
    """The height of the orthocenter of a tetrahedron over one of its faces."""

    vertices: tuple[int, int, int]
    """Vertices of the face."""
    boundary: bool
    """The face is on the boundary."""
    at_interface: bool
    """The face is on an interface between tensors."""
    h: float
    """Signed height, positive inside [length]."""
    h_over_l: float
    """The height over the length of the face."""
    outside: bool
    """H ≤ 0, exact."""
    crossed: bool
    """Its own orthocenter is strictly inside it, exact."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetReason(Record):
    """A tetrahedron that is not well-centered."""

    tetrahedron: int
    """Number of the tetrahedron, from 0."""
    vertices: tuple[int, int, int, int]
    """Its vertices."""
    weights: tuple[float, float, float, float]
    """Their weights [length²]."""
    at: tuple[float, float, float]
    """Its centroid."""
    orthocenter: tuple[float, float, float]
    """Its orthocenter; not finite if it is flat."""
    h_over_l: float
    """Least h/ℓ of its faces."""
    dihedral_deg: float
    """Largest of its dihedral angles [degrees]."""
    faces: list[FaceHeight]
    """Its faces."""
    all_on_boundary: bool
    """All corners are on the boundary, or on interfaces between tensors."""
    text: str
    """The reason in words."""
    cure: Literal["weights", "optimize", "split_boundary", "slide"]
    """The change that may cure it; it is not tried."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetExplanation(_looks.TetExplanation):
    """The result of ``explain`` for tetrahedra."""

    tetrahedra: int
    """Number of tetrahedra."""
    bad: int
    """Number of tetrahedra with orthocenters outside."""
    verdict: Literal["feasible", "infeasible", "undecided"]
    """Verdict on the whole mesh with its positions and connectivity; undecided if no weights were searched for."""
    weights_changed: int | None
    """For feasible: number of weights that change."""
    certificate: Certificate
    """Proof that no weights exist, if they were searched for and there are none."""
    all_on_boundary: int
    """Number of bad tetrahedra with all corners on the boundary."""
    reasons: list[TetReason]
    """Bad tetrahedra, the worst first."""


@dataclasses.dataclass(frozen=True, eq=False)
class SurfaceExplanation(Record):
    """The bad triangles of a curved surface, and what weights alone can do."""

    triangles: int
    """Number of triangles."""
    bad: int
    """Number of triangles that are not well-centered, exact."""
    verdict: Literal["feasible", "infeasible", "undecided"]
    """Verdict on weights of the whole mesh, if nothing else changes."""
    changed: int
    """Number of weights that change, if the verdict is feasible."""
    margin: float
    """Best margin of weights, or a bound of it."""
    certificate: Certificate
    """Proof that there are no weights; null: there is none."""
    worst: list[WorstTriangle]
    """Worst bad triangles with their reasons, the worst first."""


@dataclasses.dataclass(frozen=True, eq=False)
class DualReason(Record):
    """A dual that a criterion does not allow, with the reason."""

    vertices: npt.NDArray[np.int32]
    """Vertices of its edge or face."""
    kind: Literal["inside", "boundary", "region"]
    """Kind of the dual; region: its part in one region."""
    over_l: float
    """Signed length of the dual over ℓ of the edge or face; signed area of the dual over ℓ²."""
    at: tuple[float, float, float]
    """Centroid of the edge or face; on a sphere longitude and latitude [degrees], and 0."""
    why: str
    """The reason: heights, and the angles across."""


@dataclasses.dataclass(frozen=True, eq=False)
class DualExplanation(Record):
    """The violations of a criterion of duals."""

    criterion: Literal["well_centered", "coefficients", "distances"]
    """The criterion."""
    violations: int
    """Number of duals that the criterion does not allow."""
    reasons: list[DualReason]
    """Reasons, the worst first."""


@dataclasses.dataclass(frozen=True, eq=False)
class FieldFrame(_looks.FieldFrame):
    """The frame of the fields, which are functions of (p − center) / half_size."""

    center: tuple[float, ...]
    """Its center."""
    half_size: float
    """> 0 [length]."""


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorSystem(Record):
    """The matrix of a scheme, without the unknowns that the boundary fixes."""

    unknowns: int
    """Number of unknowns."""
    m_matrix: bool
    """No positive entry is off the diagonal, and the matrix is diagonally dominant, by exact signs of the dual
    lengths."""
    positive_definite: bool
    """The matrix is positive definite, by its pivots."""
    singular: bool
    """The system could not be solved: all errors are infinite."""
    negative: int
    """Number of edges, or faces of tetrahedra, with a negative coefficient, exact."""
    merged: int
    """For flux: number of edges or faces whose two orthocenters coincide, so that they are one unknown."""
    largest_over_median: float
    """Largest over median \\|coefficient\\| inside; infinite if one is."""
    condition: float | None
    """Spectral condition, a lower bound near the true value; absent if it was not requested."""


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorMatrices(Record):
    """The matrices of both schemes."""

    poisson: ErrorSystem
    """−Δu = f at the vertices."""
    flux: ErrorSystem
    """−Δu = f at the orthocenters."""


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorCounts(Record):
    """The mesh and the matrices of ``measure_errors``."""

    vertices: int
    """Number of vertices."""
    edges: int
    """Number of edges."""
    triangles: int
    """Number of triangles."""
    not_well_centered: int
    """Number of triangles that are not well-centered, exact."""
    non_regular_edges: int
    """Number of interior edges of negative dual length, exact."""
    negative_boundary_duals: int
    """Number of boundary edges with a negative dual length, exact."""
    negative_star0: int
    """Number of negative ★0."""
    frame: FieldFrame
    """Frame of the fields."""
    matrices: ErrorMatrices
    """Matrices of both schemes."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetErrorCounts(Record):
    """The mesh and the matrices of ``measure_errors``, of tetrahedra."""

    vertices: int
    """Number of vertices."""
    edges: int
    """Number of edges."""
    faces: int
    """Number of faces."""
    tetrahedra: int
    """Number of tetrahedra."""
    not_well_centered: int
    """Number of tetrahedra that are not well-centered, exact."""
    non_regular_faces: int
    """Number of interior faces of negative dual length, exact."""
    negative_boundary_duals: int
    """Number of boundary faces with a negative dual length, exact."""
    negative_star0: int
    """Number of negative ★0."""
    frame: TetFieldFrame
    """Frame of the fields."""
    matrices: ErrorMatrices
    """Matrices of both schemes."""


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorNorms(Record):
    """Relative errors: l2 over the field's root mean square, and the maximum over it. Infinite if the system is
    singular."""

    l2: float
    max: float


@dataclasses.dataclass(frozen=True, eq=False)
class DiffusionMatrices(Record):
    """The matrices of both schemes for one problem."""

    vertex: ErrorSystem
    """Unknowns at vertices."""
    cell: ErrorSystem
    """Unknowns at orthocenters."""


@dataclasses.dataclass(frozen=True, eq=False)
class DiffusionErrors(Record):
    """The errors of both schemes for one problem."""

    vertex: ErrorNorms
    """Errors at vertices, relative to the reference: its L2 norm, and its largest absolute value."""
    cell: ErrorNorms
    """Errors at orthocenters."""
    reference: ErrorNorms
    """Change of the reference by its last refinement: how much of the errors is its own."""
    matrices: DiffusionMatrices
    """Matrices of both schemes."""
    refinements: int
    """Refinements of the mesh for the reference."""
    least: float
    """Least value of the reference at the vertices."""
    largest: float
    """Largest value of the reference at the vertices."""


@dataclasses.dataclass(frozen=True, eq=False)
class TetDataReport(Record):
    """The fate of the data of points and cells after the mesh has changed. All 0 without such data."""

    points: int
    """Points of the file that are still there."""
    points_moved: int
    """Points among these that have moved."""
    distance: Spread
    """Distances that these have moved [length]."""
    points_inserted: int
    """New points that the file did not have."""
    interpolated: list[str]
    """Point data that belong to the place: linear in the cells of the file."""
    kept: list[str]
    """Point data that stayed with their points."""
    conserved: list[str]
    """Point data whose integrals stay: means over power cells."""
    dropped: list[str]
    """Integer point data that differ around an inserted point."""
    tetrahedra: int
    """Number of cells."""
    tetrahedra_changed: int
    """Cells among these that the file does not have at the same number and places."""
    of_tetrahedra: list[str]
    """Data of cells: each cell has the data of the file's cell that contains its middle."""
    conserved_of_tetrahedra: list[str]
    """Data of cells whose integrals stay: means over the file's cells."""
    integral_change: float
    """Largest change of the integral of conserved data over the domain or a region, over the integral of \\|u\\|
    there."""
    out_of_range: float
    """Largest distance of conserved data from the range of the file's data, over the largest \\|u\\|; 0 unless the
    boundary moved."""


CLASSES["TetOptimizeReport"] = OptimizeReport
CLASSES["TetFieldFrame"] = FieldFrame
CLASSES["SurfaceErrorCounts"] = ErrorCounts
