"""Discrete exterior calculus: incidence, diagonal stars with signed power duals, the dual itself; columns under layers."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, Literal, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh
from ._records import Record


@dataclasses.dataclass(frozen=True, eq=False)
class IncidenceMatrix(Record):
    """A sparse matrix of entries ±1, in compressed rows: row r has ``columns[starts[r]:starts[r + 1]]``, ascending, and
    the ``signs`` beside them."""

    n_columns: int
    starts: npt.NDArray[np.int64]
    columns: npt.NDArray[np.int32]
    signs: npt.NDArray[np.int8]

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return len(self.starts) - 1, self.n_columns

    def tocsr(self) -> Any:
        """As a ``scipy.sparse.csr_matrix`` of doubles. Needs SciPy."""
        from scipy import sparse

        return sparse.csr_matrix((self.signs.astype(np.float64), self.columns.copy(), self.starts.copy()), self.shape)

    def toarray(self) -> npt.NDArray[np.float64]:
        """As a full array: for small meshes."""
        full = np.zeros(self.shape)
        rows = np.repeat(np.arange(self.shape[0]), np.diff(self.starts))
        full[rows, self.columns] = self.signs
        return full


@dataclasses.dataclass(frozen=True, eq=False)
class DecEdges(Record):
    """The edges, each once, from its lower vertex to its higher one, sorted by these. Arrays, one entry an edge."""

    vertices: npt.NDArray[np.int32]
    """(e, 2): from, to."""
    triangles: npt.NDArray[np.int32]
    """(e, 2): left and right of from → to; −1 for none."""
    length: npt.NDArray[np.float64]
    """ℓ [length]."""
    crossing: npt.NDArray[np.float64]
    """d, signed distance from ``from``, towards ``to``, of the weighted midpoint [length]."""
    left_height: npt.NDArray[np.float64]
    """h of the orthocenter of the left triangle over this edge, > 0 on its side; 0 without it [length]."""
    right_height: npt.NDArray[np.float64]
    """The same of the right triangle."""
    dual_length: npt.NDArray[np.float64]
    """left_height + right_height, with the exact sign, and accurate where they cancel [length]."""
    midpoint: npt.NDArray[np.float64]
    """(e, 2): where the line of the dual edge crosses the line of the edge. On a sphere (e, 3), at its radius."""

    def __len__(self) -> int:
        return len(self.length)

    @property
    def is_boundary(self) -> npt.NDArray[np.bool_]:
        """Edges of one triangle."""
        return (self.triangles < 0).any(axis=1)


@dataclasses.dataclass(frozen=True)
class DecSummary(Record):
    """What to know of the operators before a solver uses them."""

    vertices: int
    edges: int
    triangles: int
    boundary_edges: int
    negative_star0: int
    negative_star1: int
    """Interior edges, exact: not regular."""
    zero_star1: int
    """Interior edges, exact: cocircular."""
    negative_boundary_star1: int
    """Boundary edges, exact: orthocenter outside of the domain."""
    not_well_centered: int
    """Triangles, exact."""
    area: float
    """Of the domain [length²]."""
    star0_sum: float
    """Equal to it but for rounding."""
    min_star0: float
    min_star1: float
    median_star1: float
    """Of \\|★1\\| of all edges."""
    max_star1: float
    median_transmissibility: float
    """Of \\|transmissibility\\| of interior edges."""
    max_transmissibility: float
    """inf where a dual edge has length 0."""


@dataclasses.dataclass(frozen=True, eq=False)
class PowerCells(Record):
    """Power cells within the domain, as simple polygons, counter-clockwise, ascending by vertex. A cell has one
    polygon, or several that do not overlap, or none when it lies outside of the domain."""

    vertices: npt.NDArray[np.int32]
    """The vertex of each polygon, (p,)."""
    starts: npt.NDArray[np.uint64]
    """Polygon i has ``corners[starts[i]:starts[i + 1]]``; (p + 1,)."""
    corners: npt.NDArray[np.float64]
    """(c, 2); on a sphere (c, 3), at its radius."""
    polygon_areas: npt.NDArray[np.float64]
    """Of each polygon, > 0 [length²]."""
    areas: npt.NDArray[np.float64]
    """Of each vertex: of all its polygons. Sum: the area of the domain."""

    def polygons(self) -> list[npt.NDArray[np.float64]]:
        """The corners of each polygon, views."""
        return np.crossing(self.corners, self.starts[1:-1].astype(np.int64)) if len(self.vertices) else []


@dataclasses.dataclass(frozen=True, eq=False)
class DecComplex(Record):
    """Operators and dual of a mesh; vertices and triangles have the numbers of the mesh. All arrays are read-only views
    on one value, without copies.

    On a sphere lengths are those of arcs, and areas spherical excess.

    Signs (docs/concepts.md): a dual length is negative where the edge is not regular, or, on the boundary, where the
    orthocenter is outside; zero exactly where the four points are cocircular in the power sense.
    """

    edges: DecEdges
    edge_of_halfedge: npt.NDArray[np.int32]
    d0: IncidenceMatrix
    """edges × vertices: −1 at from, +1 at to."""
    d1: IncidenceMatrix
    """triangles × edges: +1 where the triangle is on the left of the edge, −1 where it is on the right."""
    star0: npt.NDArray[np.float64]
    """(n,) signed area of the dual cell, Σ d_ij h_k / 2 [length²]."""
    star1: npt.NDArray[np.float64]
    """(e,) (h_k + h_l)/ℓ; on the boundary h_k/ℓ. The transmissibility of a vertex-centered scheme [1]."""
    star2: npt.NDArray[np.float64]
    """(m,) 1/area [length⁻²]."""
    transmissibility: npt.NDArray[np.float64]
    """(e,) ℓ/(h_k + h_l), on the boundary ℓ/h_k: the transmissibility of a two-point flux between orthocenters; inf
    where ★1 is 0 [1]."""
    orthocenters: npt.NDArray[np.float64]
    """(m, 2) the dual vertices [length]. On a sphere (m, 3), at its radius."""
    areas: npt.NDArray[np.float64]
    """(m,) of the triangles, > 0 [length²]."""
    _handle: Any = dataclasses.field(repr=False, compare=False)

    def __reduce__(self) -> Any:
        return _dec_of, (Mesh._of(self._handle.mesh()), self._handle.tensor())

    def star(self, s: Literal[0, 1, 2]) -> Any:
        """★s as a diagonal ``scipy.sparse`` matrix. Needs SciPy."""
        from scipy import sparse

        return sparse.diags([self.star0, self.star1, self.star2][s], format="csr")

    def laplacian(self) -> Any:
        """d0ᵀ ★1 d0 as a ``scipy.sparse.csr_matrix``, (n, n): positive semi-definite on a regular mesh whose boundary
        duals are not negative; an M-matrix then. Needs SciPy."""
        d0 = self.d0.tocsr()
        return (d0.T @ self.star(1) @ d0).tocsr()

    def summarize(self) -> DecSummary:
        """Counts, signs and extremes."""
        return DecSummary(**self._handle.summarize())

    def power_cells(self) -> PowerCells:
        """The power cell of each vertex, clipped to the domain; disjoint, and covering it, whatever the mesh."""
        return PowerCells(**self._handle.power_cells())

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        formats: Sequence[Literal["npz", "mtx", "vtu"]] = ("npz", "mtx", "vtu"),
        threads: int | None = None,
    ) -> list[str]:
        """Writes the operators into a folder (docs/operators.md names every file and array), all or none of the files.
        Returns their paths."""
        return self._handle.write(os.fspath(folder), list(formats), threads)


def _dec_of(mesh: Mesh, tensor: tuple[float, float, float] | None) -> DecComplex:
    return dec_operators(mesh, tensor=tensor)


def dec_operators(mesh: MeshLike, *, tensor: Sequence[float] | None = None) -> DecComplex:
    """The operators of a mesh, as exact as doubles are.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
    tensor : sequence of float, optional
        kxx, kxy, kyy of a constant diffusion tensor K, for −div(K ∇u): duals are those of its metric, ★1 and transmissibility are times
        √(det K), and lengths are of the metric (docs/tensor.md).

    Returns
    -------
    DecComplex
        d0, d1, ★0, ★1, ★2, transmissibilities, orthocenters: NumPy arrays, and SciPy's sparse matrices on request.

    Notes
    -----
    Without weights ★1 is the cotangent formula; Σ★0 is the area of the domain; linear functions are harmonic,
    (d0ᵀ ★1 d0 u)_i = 0 at interior vertices, for arbitrary weights. O(n).

    Examples
    --------
    >>> import temper
    >>> complex = temper.dec_operators(temper.generate.sheared_grid())
    >>> abs(complex.star0.sum() - complex.areas.sum()) < 1e-12
    True
    >>> complex.d0.shape
    (1240, 441)
    """
    handle = _temper.dec_operators(as_mesh(mesh)._handle, None if tensor is None else tuple(tensor))
    arrays = handle.arrays()
    edges = DecEdges(**arrays.pop("edges"))
    d0, d1 = IncidenceMatrix(**arrays.pop("d0")), IncidenceMatrix(**arrays.pop("d1"))
    return DecComplex(edges=edges, d0=d0, d1=d1, _handle=handle, **arrays)


# --- columns of cells under layers ---------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False)
class Columns(Record):
    """Power cells under layers. Arrays of cells are (layers, vertices); the number of a cell is
    ``layer * n_vertices + vertex``. All are read-only views on one value, without copies."""

    n_vertices: int
    n_layers: int
    states: npt.NDArray[np.int8]
    """With the numbers of MODFLOW's IDOMAIN: 1 active, 0 inactive, −1 pinched out."""
    tops: npt.NDArray[np.float64]
    """Numbers, also where a surface is not there [length]."""
    bottoms: npt.NDArray[np.float64]
    volumes: npt.NDArray[np.float64]
    """Of active cells; 0 of others [length³]."""
    areas: npt.NDArray[np.float64]
    """Of the power cells, (n_vertices,) [length²]."""
    cells: npt.NDArray[np.uint32]
    """(c, 2): the cells of each connection, the lower number first; ascending."""
    is_vertical: npt.NDArray[np.bool_]
    """(c,)"""
    distances: npt.NDArray[np.float64]
    """(c, 2): from the centers of the two cells to the face, > 0 [length]."""
    widths: npt.NDArray[np.float64]
    """(c,) of the face seen from above; 0 of vertical ones [length]."""
    face_areas: npt.NDArray[np.float64]
    """(c,) [length²]. Of cells beside each other the thickness is linear between their centers."""
    _handle: Any = dataclasses.field(repr=False, compare=False)
    _arguments: Any = dataclasses.field(repr=False, compare=False)

    def __reduce__(self) -> Any:
        return columns, self._arguments

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        formats: Sequence[Literal["npz", "mtx", "vtu", "disv", "disu", "tough"]] = ("disv", "disu", "tough", "vtu"),
        threads: int | None = None,
    ) -> list[str]:
        """Writes ``mesh.disv`` and ``mesh.disu`` (MODFLOW 6), ``MESH`` (TOUGH), and for ParaView ``columns.vtu`` with
        the dual, into a folder (docs/layers.md), all or none of the files. Returns their paths."""
        return self._handle.write(os.fspath(folder), list(formats), threads)


def columns(
    mesh: MeshLike, surfaces: npt.ArrayLike, active: npt.ArrayLike | None = None, pinch_out: float = 0.0
) -> Columns:
    """The columns of a mesh: its power cells between the surfaces of layers, and which are neighbors.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
        In the plane, and regular.
    surfaces : array_like
        (n_vertices, layers + 1): the top and then the bottom of each layer, going down [length]; or (layers + 1,), the
        same at all vertices. NaN: a surface that is not there; the layers above and below it are inactive.
    active : array_like, optional
        (n_vertices, layers) or (layers,) of bool: where layers are active. By default everywhere.
    pinch_out : float
        A layer is pinched out where it is not thicker: it has no cell, and what is above and what is below it are
        neighbors [length].

    Raises
    ------
    TemperError
        Surfaces that are not one above the other; edges that are not regular, or a face that is not between its two
        vertices; a mesh of the sphere; no active cell.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.annulus()
    >>> report = temper.optimize(mesh)
    >>> columns = temper.columns(mesh, [10, 8, 8, 0])
    >>> columns.states[:, 0]
    array([ 1, -1,  1], dtype=int8)
    >>> bool(abs(columns.volumes.sum() - 10 * columns.areas.sum()) < 1e-9)
    True
    """
    given = as_mesh(mesh)
    heights = np.asarray(surfaces, dtype=np.float64)
    if heights.ndim not in (1, 2) or heights.shape[-1] < 2:
        raise ValueError(f"surfaces: expected (n_vertices, layers + 1) or (layers + 1,) numbers, found {heights.shape}")
    n, n_layers = given.n_vertices, heights.shape[-1] - 1
    heights = _for_all(heights, (n, n_layers + 1), "surfaces")
    flags = np.zeros((0, n_layers), dtype=np.int32)
    if active is not None:
        flags = _for_all(np.asarray(active, dtype=bool).astype(np.int32), (n, n_layers), "active")
    handle = _temper.columns(given._handle, n_layers, heights, flags, float(pinch_out))
    arguments = (given.copy(), heights, None if active is None else flags, float(pinch_out))
    return Columns(**handle.arrays(), _handle=handle, _arguments=arguments)


def _for_all(values: npt.NDArray[Any], shape: tuple[int, int], name: str) -> npt.NDArray[Any]:
    """The values of each vertex, of an array that may be of one for all."""
    if values.shape not in (shape, shape[1:]):
        raise ValueError(f"{name}: expected {shape} or {shape[1:]} numbers, found {values.shape}")
    return np.ascontiguousarray(np.broadcast_to(values, shape))
