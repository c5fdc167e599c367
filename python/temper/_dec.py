"""Discrete exterior calculus: incidence, diagonal stars with signed power duals, the dual itself; columns under
layers."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, Literal, Mapping, Sequence, Union, overload

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh
from ._records import Record
from ._reports import DecSummary, TetDecSummary
from ._surfaces import SurfaceMesh
from ._tensor import TensorLike, plain_tensor, values_of_regions
from ._tets import AnyMeshLike, TetMesh, as_any_mesh

CoefficientLike = Union[npt.ArrayLike, Mapping[int, float], Mapping[str, float], Mapping[Union[str, int], float]]
"""A value for each triangle or tetrahedron, or for each region by its tag or name."""


@dataclasses.dataclass(frozen=True, eq=False)
class IncidenceMatrix(Record):
    """A sparse matrix with entries ±1 in compressed rows. Row r has ``columns[starts[r]:starts[r + 1]]``, ascending,
    and the ``signs`` at the same positions."""

    n_columns: int
    starts: npt.NDArray[np.int64]
    columns: npt.NDArray[np.int32]
    signs: npt.NDArray[np.int8]

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return len(self.starts) - 1, self.n_columns

    def tocsr(self) -> Any:
        """Converts to a ``scipy.sparse.csr_matrix`` of doubles. Needs SciPy."""
        from scipy import sparse

        return sparse.csr_matrix((self.signs.astype(np.float64), self.columns.copy(), self.starts.copy()), self.shape)

    def toarray(self) -> npt.NDArray[np.float64]:
        """Converts to a full array: for small meshes."""
        full = np.zeros(self.shape)
        rows = np.repeat(np.arange(self.shape[0]), np.diff(self.starts))
        full[rows, self.columns] = self.signs
        return full


@dataclasses.dataclass(frozen=True, eq=False)
class DecEdges(Record):
    """The edges, each once, from its lower vertex to its higher one, sorted by these. Arrays have one entry per
    edge."""

    vertices: npt.NDArray[np.int32]
    """Vertices from and to, (e, 2)."""
    triangles: npt.NDArray[np.int32]
    """Triangles on the left and right of from → to, (e, 2); −1 for none."""
    length: npt.NDArray[np.float64]
    """Length ℓ [length]."""
    crossing: npt.NDArray[np.float64]
    """Crossing d: signed distance of the weighted midpoint from ``from``, towards ``to`` [length]."""
    left_height: npt.NDArray[np.float64]
    """Height h of the orthocenter of the left triangle over this edge, > 0 on its side; 0 without it [length]."""
    right_height: npt.NDArray[np.float64]
    """Height h of the orthocenter of the right triangle, > 0 on its side; 0 without it [length]."""
    dual_length: npt.NDArray[np.float64]
    """Sum left_height + right_height, with the exact sign; accurate even if they cancel [length]."""
    midpoint: npt.NDArray[np.float64]
    """Point at which the line of the dual edge crosses the line of the edge, (e, 2). On a sphere (e, 3), at its
    radius."""
    named: dict[str, npt.NDArray[np.int32]]
    """Numbers of the edges of each name of lines, such as ``named["inflow"]``, ascending (``Mesh.names``)."""

    def __len__(self) -> int:
        return len(self.length)

    @property
    def is_boundary(self) -> npt.NDArray[np.bool_]:
        """Says for each edge whether it has only one triangle."""
        return (self.triangles < 0).any(axis=1)


@dataclasses.dataclass(frozen=True, eq=False)
class PowerCells(Record):
    """Power cells within the domain, as simple counter-clockwise polygons, ascending by vertex. A cell may have several
    polygons that do not overlap. It has none if it lies outside the domain."""

    vertices: npt.NDArray[np.int32]
    """Vertex of each polygon, (p,)."""
    starts: npt.NDArray[np.uint64]
    """Starts of the polygons, (p + 1,): polygon i has ``corners[starts[i]:starts[i + 1]]``."""
    corners: npt.NDArray[np.float64]
    """Corners, (c, 2); on a sphere (c, 3), at its radius."""
    polygon_areas: npt.NDArray[np.float64]
    """Area of each polygon, > 0 [length²]."""
    areas: npt.NDArray[np.float64]
    """Area of all polygons of each vertex. Sum: the area of the domain."""

    def polygons(self) -> list[npt.NDArray[np.float64]]:
        """The corners of each polygon, as views."""
        return np.split(self.corners, self.starts[1:-1].astype(np.int64)) if len(self.vertices) else []


class _Complex(Record):
    """Base class of the operators of triangles and of tetrahedra."""

    _handle: Any
    d0: IncidenceMatrix

    def star(self, s: int) -> Any:
        """★s as a diagonal ``scipy.sparse`` matrix. Needs SciPy."""
        from scipy import sparse

        return sparse.diags(getattr(self, f"star{s}"), format="csr")

    def laplacian(self) -> Any:
        """The matrix d0ᵀ ★1 d0 as a ``scipy.sparse.csr_matrix``, (n, n). On a regular mesh whose boundary duals are not
        negative it is positive semi-definite and an M-matrix. Needs SciPy."""
        d0 = self.d0.tocsr()
        return (d0.T @ self.star(1) @ d0).tocsr()

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        formats: Sequence[Literal["npz", "mtx", "vtu", "tough", "uge"]] = ("npz", "mtx", "vtu"),
        threads: int | None = None,
    ) -> list[str]:
        """Writes the operators into a folder (docs/reference/operators.md names every file and array). Tetrahedra also
        have ``MESH`` (TOUGH) and ``mesh.uge`` (PFLOTRAN): their cells are the power cells of vertices. On an error no
        file is written. Returns the paths of the files."""
        return self._handle.write(os.fspath(folder), list(formats), threads)


@dataclasses.dataclass(frozen=True, eq=False)
class DecComplex(_Complex):
    """The operators and the dual of a mesh. Vertices and triangles have the numbers of the mesh. All arrays are
    read-only views on one value, without copies.

    On a sphere lengths are measured along arcs, and areas are spherical excess. On a curved surface triangles are plane,
    and ``orthocenters`` and ``edges.midpoint`` are in space.

    Signs (docs/reference/symbols.md): a dual length is negative if the edge is not regular. On the boundary it is
    negative if the orthocenter is outside. It is zero exactly if the four points are cocircular in the power sense.
    """

    edges: DecEdges
    edge_of_halfedge: npt.NDArray[np.int32]
    d0: IncidenceMatrix
    """Incidence of edges × vertices: −1 at from, +1 at to."""
    d1: IncidenceMatrix
    """Incidence of triangles × edges: +1 if the triangle is on the left of the edge, −1 if it is on the right."""
    star0: npt.NDArray[np.float64]
    """Signed area of the dual cell, Σ d_ij h_k / 2, (n,) [length²]."""
    star1: npt.NDArray[np.float64]
    """Star (h_k + h_l)/ℓ, on the boundary h_k/ℓ, (e,) [1]. It is the transmissibility of a vertex-centered scheme."""
    star2: npt.NDArray[np.float64]
    """Star 1/area, (m,) [length⁻²]."""
    transmissibility: npt.NDArray[np.float64]
    """Transmissibility of a two-point flux between orthocenters, (e,) [1]: ℓ/(h_k + h_l), on the boundary ℓ/h_k; inf if
    ★1 is 0."""
    orthocenters: npt.NDArray[np.float64]
    """Dual vertices, (m, 2) [length]. On a sphere (m, 3), at its radius."""
    areas: npt.NDArray[np.float64]
    """Areas of the triangles, (m,), > 0 [length²]."""
    coefficient: npt.NDArray[np.float64]
    """Coefficient K of each triangle, (m,); empty without one."""
    capacity: npt.NDArray[np.float64]
    """★0 with K: Σ K d_ij h_k / 2, (n,) [K length²], for terms such as K ∂u/∂t; empty without a coefficient."""
    half_transmissibility: npt.NDArray[np.float64]
    """With several tensors, else empty: K ℓ/h of each halfedge, (3 m,), the transmissibility between the orthocenter of
    a triangle and its edge. That of an edge inside is 1/(1/a + 1/b) for its two halfedges (``edge_of_halfedge``)."""
    _handle: Any = dataclasses.field(repr=False, compare=False)
    _tensor: Any = dataclasses.field(repr=False, compare=False)

    def __reduce__(self) -> Any:
        lines = {name: self.edges.vertices[numbers] for name, numbers in self.edges.named.items()}
        coefficient = self.coefficient.copy() if len(self.coefficient) else np.empty(0)
        handle = self._handle.mesh()
        mesh = SurfaceMesh._of(handle) if isinstance(handle, _temper.SurfaceMesh) else Mesh._of(handle)
        return _dec_of, (mesh, self._tensor, coefficient, lines)

    def summarize(self) -> DecSummary:
        """Summarizes counts, signs and extremes."""
        return self._handle.summarize()

    def power_cells(self) -> PowerCells:
        """The power cell of each vertex, clipped to the domain. In any mesh the cells are disjoint and cover the
        domain. On a curved surface: the dual cells, a quadrilateral with a signed area in each triangle of a vertex."""
        return PowerCells(**self._handle.power_cells())


@dataclasses.dataclass(frozen=True, eq=False)
class TetDecEdges(Record):
    """The edges of tetrahedra, each once, from its lower vertex to its higher one, sorted by these. Arrays have one
    entry per edge."""

    vertices: npt.NDArray[np.int32]
    """Vertices from and to, (e, 2)."""
    is_boundary: npt.NDArray[np.bool_]
    """Says for each edge whether it is one of a boundary face."""
    length: npt.NDArray[np.float64]
    """Length ℓ [length]."""
    crossing: npt.NDArray[np.float64]
    """Crossing d: signed distance of the weighted midpoint from ``from``, towards ``to`` [length]."""
    dual_area: npt.NDArray[np.float64]
    """Signed area of the dual face [length²]."""
    midpoint: npt.NDArray[np.float64]
    """Point at which the plane of the dual face crosses the line of the edge, (e, 3)."""
    named: dict[str, npt.NDArray[np.int32]]
    """Numbers of the edges of each name of lines, ascending (``TetMesh.names``)."""

    def __len__(self) -> int:
        return len(self.length)


@dataclasses.dataclass(frozen=True, eq=False)
class TetDecFaces(Record):
    """The faces of tetrahedra, each once, sorted by their ascending vertices p, q, r. The normal is
    (q − p) × (r − p). Arrays have one entry per face."""

    vertices: npt.NDArray[np.int32]
    """Ascending vertices, (f, 3)."""
    tetrahedra: npt.NDArray[np.int32]
    """The tetrahedron behind, out of which the normal points, and the one ahead, (f, 2); −1 for none."""
    area: npt.NDArray[np.float64]
    """Area A [length²]."""
    behind_height: npt.NDArray[np.float64]
    """Height h of the orthocenter behind over this face, > 0 on its side; 0 without it [length]."""
    ahead_height: npt.NDArray[np.float64]
    """Height h of the orthocenter ahead, > 0 on its side; 0 without it [length]."""
    dual_length: npt.NDArray[np.float64]
    """Sum of both heights, with the exact sign; accurate even if they cancel [length]."""
    orthocenter: npt.NDArray[np.float64]
    """Orthocenter of the face, at which the line of the dual edge crosses its plane, (f, 3)."""
    named: dict[str, npt.NDArray[np.int32]]
    """Numbers of the faces of each name of tagged faces, such as ``named["inflow"]``, ascending (``TetMesh.names``)."""

    def __len__(self) -> int:
        return len(self.area)

    @property
    def is_boundary(self) -> npt.NDArray[np.bool_]:
        """Says for each face whether it has only one tetrahedron."""
        return (self.tetrahedra < 0).any(axis=1)


@dataclasses.dataclass(frozen=True, eq=False)
class TetDecComplex(_Complex):
    """The operators and the dual of a mesh of tetrahedra. Vertices and tetrahedra have the numbers of the mesh. All
    arrays are read-only views on one value, without copies.

    Signs (docs/reference/operators.md): a dual length is negative if the face is not regular. On the boundary it is
    negative if the orthocenter is outside. It is zero exactly if the five points are cospherical in the power sense.
    """

    edges: TetDecEdges
    faces: TetDecFaces
    d0: IncidenceMatrix
    """Incidence of edges × vertices: −1 at from, +1 at to."""
    d1: IncidenceMatrix
    """Incidence of faces × edges: pq and qr +1 in pqr, pr −1."""
    d2: IncidenceMatrix
    """Incidence of tetrahedra × faces: +1 for the tetrahedron behind the face, −1 for the one ahead."""
    star0: npt.NDArray[np.float64]
    """Signed volume of the dual cell, (n,) [length³]."""
    star1: npt.NDArray[np.float64]
    """Signed area of the dual face over ℓ, (e,) [length]. It is the transmissibility of a vertex-centered scheme."""
    star2: npt.NDArray[np.float64]
    """Signed length of the dual edge over A, (f,) [length⁻¹]."""
    star3: npt.NDArray[np.float64]
    """Star 1/volume, (m,) [length⁻³]."""
    transmissibility: npt.NDArray[np.float64]
    """Transmissibility of a two-point flux between orthocenters, (f,) [length]: A/(h_behind + h_ahead), on the boundary
    A/h, from the orthocenter of the face; inf if ★2 is 0."""
    orthocenters: npt.NDArray[np.float64]
    """Dual vertices, (m, 3) [length]."""
    volumes: npt.NDArray[np.float64]
    """Volumes of the tetrahedra, (m,), > 0 [length³]."""
    coefficient: npt.NDArray[np.float64]
    """Coefficient K of each tetrahedron, (m,); empty without one."""
    capacity: npt.NDArray[np.float64]
    """★0 with K, (n,) [K length³], for terms such as K ∂u/∂t; empty without a coefficient."""
    half_transmissibility: npt.NDArray[np.float64]
    """With a tensor, else empty: K A/h of each halfface, (4 m,), the transmissibility between the orthocenter of a
    tetrahedron and its face opposite each corner. That of a face inside is 1/(1/a + 1/b) for its two halffaces."""
    _handle: Any = dataclasses.field(repr=False, compare=False)
    _tensor: Any = dataclasses.field(repr=False, compare=False)

    def __reduce__(self) -> Any:
        return _tet_dec_of, (TetMesh._of(self._handle.mesh(), [], 2), self._tensor, self.coefficient.copy())

    def summarize(self) -> TetDecSummary:
        """Summarizes counts, signs and extremes."""
        return self._handle.summarize()


def _coefficient_of(mesh: Mesh | TetMesh | SurfaceMesh, coefficient: CoefficientLike | None) -> npt.NDArray[np.float64]:
    """One value per triangle or tetrahedron; empty for None."""
    if coefficient is None:
        return np.empty(0)
    if not isinstance(coefficient, Mapping):
        values = np.ascontiguousarray(coefficient, dtype=np.float64)
        n = len(mesh.regions)
        if values.shape != (n,):
            raise ValueError(
                f"coefficient: expected one value per {'tetrahedron' if isinstance(mesh, TetMesh) else 'triangle'}, "
                f"shape ({n},), or a dictionary of regions; found shape {values.shape}"
            )
        return values
    return values_of_regions(mesh, coefficient, "coefficient")


@overload
def dec_operators(
    mesh: TetMesh, *, tensor: TensorLike | None = ..., coefficient: CoefficientLike | None = ...
) -> TetDecComplex: ...
@overload
def dec_operators(
    mesh: MeshLike,
    *,
    tensor: TensorLike | None = ...,
    coefficient: CoefficientLike | None = ...,
) -> DecComplex: ...
def dec_operators(
    mesh: AnyMeshLike,
    *,
    tensor: TensorLike | None = None,
    coefficient: CoefficientLike | None = None,
) -> DecComplex | TetDecComplex:
    """The operators of a mesh, as exact as doubles allow.

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
    tensor : sequence of float, (m, 3) array, or dict of region to sequence, optional
        kxx, kxy, kyy of a diffusion tensor K, for −div(K ∇u): of the mesh, of each triangle, or of each region by its
        tag or name. Duals and lengths are measured in its metric. ★1 and transmissibility are multiplied by √(det K)
        (docs/howto/anisotropic.md). Several tensors take ``mesh.cell_data["corner_weights"]``. For tetrahedra kxx, kxy,
        kxz, kyy, kyz, kzz, (m, 6), and the factor ∛(det K).
    coefficient : array of float, or dict of region to float, optional
        K > 0 of −div(K ∇u) on each triangle or tetrahedron, (m,), or by region: its tag or its name. With it ★1 = (K_k
        h_k + K_l h_l)/ℓ, for unknowns at vertices. The transmissibility is ℓ/(h_k/K_k + h_l/K_l), the harmonic mean,
        for unknowns at orthocenters. On the boundary the missing term is left out. ``capacity`` is ★0 with K. A tensor
        is multiplied by K.

    Returns
    -------
    DecComplex, or TetDecComplex for tetrahedra
        Arrays d0, d1, ★0, ★1, ★2, transmissibilities and orthocenters, as NumPy arrays; methods make SciPy's sparse
        matrices. Tetrahedra have d2 and ★3, too.

    Notes
    -----
    Without weights ★1 is the cotangent formula. Σ★0 is the area of the domain. Linear functions are harmonic for any
    weights: (d0ᵀ ★1 d0 u)_i = 0 at interior vertices. O(n).

    Examples
    --------
    >>> import temper
    >>> complex = temper.dec_operators(temper.generate.sheared_grid())
    >>> abs(complex.star0.sum() - complex.areas.sum()) < 1e-12
    True
    >>> complex.d0.shape
    (1240, 441)
    """
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        return _tet_dec_of(any_mesh, plain_tensor(any_mesh, tensor), _coefficient_of(any_mesh, coefficient))
    return _dec_of(any_mesh, plain_tensor(any_mesh, tensor), _coefficient_of(any_mesh, coefficient), _named_lines(any_mesh))


def _named_lines(mesh: Mesh | SurfaceMesh) -> dict[str, npt.NDArray[np.int32]]:
    """The lines of each name, (k, 2)."""
    file = mesh._file()
    named: dict[str, list[Any]] = {}
    for dimension, tag, name in file["names"]:
        if dimension == 1:
            named.setdefault(name, []).append(file["lines"][file["line_tags"] == tag])
    return {name: np.concatenate(lines) for name, lines in named.items()}


def _dec_of(
    mesh: Mesh | SurfaceMesh,
    tensor: tuple[Any, ...] | None,
    coefficient: npt.NDArray[np.float64],
    named: dict[str, npt.NDArray[np.int32]],
) -> DecComplex:
    handle = _temper.dec_operators(mesh._handle, tensor, coefficient)
    arrays = handle.arrays()
    edges = DecEdges(**arrays.pop("edges"), named={})
    keys = edges.vertices[:, 0].astype(np.int64) * mesh.n_vertices + edges.vertices[:, 1]  # ascending
    for name, lines in named.items():
        low, high = np.sort(lines.astype(np.int64), axis=1).T
        edges.named[name] = np.flatnonzero(np.isin(keys, low * mesh.n_vertices + high)).astype(np.int32)
    d0, d1 = IncidenceMatrix(**arrays.pop("d0")), IncidenceMatrix(**arrays.pop("d1"))
    return DecComplex(edges=edges, d0=d0, d1=d1, _handle=handle, _tensor=tensor, **arrays)


def _tet_dec_of(
    mesh: TetMesh, tensor: tuple[Any, ...] | None, coefficient: npt.NDArray[np.float64]
) -> TetDecComplex:
    handle = _temper.tet_dec_operators(mesh._handle, tensor, coefficient)
    arrays = handle.arrays()
    file = mesh._file()

    def named(dimension: int, vertices: npt.NDArray[np.int32], tagged: str, tags: str) -> dict[str, npt.NDArray[np.int32]]:
        def keys(of: npt.NDArray[Any]) -> list[tuple[int, ...]]:
            return [tuple(row) for row in np.sort(of, axis=1).tolist()]

        elements: dict[str, set[tuple[int, ...]]] = {}
        for of_dimension, tag, name in file["names"]:
            if of_dimension == dimension:
                elements.setdefault(name, set()).update(keys(file[tagged][file[tags] == tag]))
        all_keys = keys(vertices) if elements else []
        return {
            name: np.array([i for i, key in enumerate(all_keys) if key in chosen], dtype=np.int32)
            for name, chosen in elements.items()
        }

    edges, faces = arrays.pop("edges"), arrays.pop("faces")
    arrays["edges"] = TetDecEdges(**edges, named=named(1, edges["vertices"], "lines", "line_tags"))
    arrays["faces"] = TetDecFaces(**faces, named=named(2, faces["vertices"], "faces", "face_tags"))
    for name in ("d0", "d1", "d2"):
        arrays[name] = IncidenceMatrix(**arrays[name])
    return TetDecComplex(**arrays, _handle=handle, _tensor=tensor)


# --- barriers and columns of cells under layers ---------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class Barrier(Record):
    """A barrier to flow on the common face of two cells, such as a piece of a fault."""

    name: str
    first: int
    """Cells as seen from above, from 0: numbers of vertices or triangles."""
    second: int
    characteristic: float
    """Hydraulic characteristic: the conductivity of the barrier over its width [1/time]. If it is negative, its
    absolute value is a factor on the conductance between the two cells."""


def barriers_of_lines(
    mesh: MeshLike, characteristics: Mapping[str, float], cells: Literal["power", "triangles"] = "triangles"
) -> list[Barrier]:
    """The barriers on tagged lines. For ``columns(..., cells="triangles")`` each edge of a line is one, between the
    triangles on its two sides. For power cells the line must be faces: ``temper mesh --faces`` makes them.

    Parameters
    ----------
    mesh : MeshLike
        A mesh with tagged lines.
    characteristics : dict of str to float
        Hydraulic characteristic of each line, by its name or tag [1/time].
    cells : str
        The cells of ``columns``: ``power`` or ``triangles``.

    Raises
    ------
    TemperError
        No line inside the domain has the name or tag; the line is not on faces of these cells; a value that is not finite.
    """
    if not isinstance(characteristics, Mapping):
        raise TypeError(f"characteristics: expected a dict of str to float, found {type(characteristics).__name__}")
    named = [(str(name), float(value)) for name, value in characteristics.items()]
    return [Barrier(*row) for row in _temper.barriers_of_lines(as_mesh(mesh)._handle, named, cells)]


@dataclasses.dataclass(frozen=True, eq=False)
class Columns(Record):
    """Power cells or triangles under layers. Arrays of cells are (layers, columns); the number of a cell is
    ``layer * n_columns + column``. A column has the number of its vertex or triangle. All are read-only views on one
    value, without copies."""

    n_columns: int
    """Number of columns: of vertices, or of triangles."""
    n_layers: int
    states: npt.NDArray[np.int8]
    """State of each cell, with the numbers of MODFLOW's IDOMAIN: 1 active, 0 inactive, −1 pinched out."""
    tops: npt.NDArray[np.float64]
    """Top of each cell, also if its surface is missing [length]."""
    bottoms: npt.NDArray[np.float64]
    volumes: npt.NDArray[np.float64]
    """Volumes of active cells; 0 for others [length³]."""
    areas: npt.NDArray[np.float64]
    """Areas of the columns as seen from above, (n_columns,) [length²]."""
    cells: npt.NDArray[np.uint32]
    """Cells of each connection, (c, 2), the lower number first; ascending."""
    is_vertical: npt.NDArray[np.bool_]
    """Vertical connections, (c,)."""
    distances: npt.NDArray[np.float64]
    """Distances from the centers of the two cells to the face, (c, 2), > 0 [length]."""
    widths: npt.NDArray[np.float64]
    """Widths of the faces seen from above, (c,); 0 if vertical [length]."""
    face_areas: npt.NDArray[np.float64]
    """Areas of the faces, (c,) [length²]. For cells next to each other the thickness is linear between their
    centers."""
    groups: list[tuple[str, str, int, float]]
    """Columns of marked points and tagged lines: name or tag, ``"point"``, ``"line"`` or ``"boundary"``, column, and
    the length of the lines in it. Each name and kind has a column once. A point is in one power cell, but in all
    triangles around it; a line between two triangles is half in each."""
    _handle: Any = dataclasses.field(repr=False, compare=False)
    _arguments: Any = dataclasses.field(repr=False, compare=False)

    def __reduce__(self) -> Any:
        return _columns_of, self._arguments

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        formats: Sequence[Literal["npz", "mtx", "vtu", "disv", "disu", "tough", "uge"]] = (
            "disv",
            "disu",
            "tough",
            "vtu",
        ),
        barriers: Sequence[Barrier] | None = None,
        threads: int | None = None,
    ) -> list[str]:
        """Writes ``mesh.disv`` and ``mesh.disu`` (MODFLOW 6), ``MESH`` (TOUGH), ``mesh.uge`` (PFLOTRAN), and for
        ParaView ``columns.vtu`` and the dual, into a folder (docs/reference/formats/layers.md). If there are
        ``groups``, tables of their cells stand next to the first three: ``mesh.disv.csv`` and so on. With
        ``barriers``, ``mesh.disv.hfb`` and ``mesh.disu.hfb`` are packages HFB. On an error no file is written. Returns
        the paths of the files."""
        rows = None if barriers is None else [dataclasses.astuple(barrier) for barrier in barriers]
        return self._handle.write(os.fspath(folder), list(formats), threads, rows)

    def hfb_data(self, barriers: Sequence[Barrier]) -> list[tuple[tuple[int, int], tuple[int, int], float]]:
        """The barriers as ``stress_period_data`` of ``flopy.mf6.ModflowGwfhfb`` for DISV: ((layer, cell), (layer,
        cell), hydraulic characteristic), from 0. Each barrier is in all layers in which both of its cells are active.

        Raises
        ------
        ValueError
            Two cells without a common face.
        """
        beside = self.cells[~self.is_vertical] % self.n_columns
        faces = {tuple(pair) for pair in np.sort(beside, axis=1).tolist()}
        rows = []
        for b in barriers:
            if (min(b.first, b.second), max(b.first, b.second)) not in faces:
                raise ValueError(f"hfb_data: barrier {b.name!r}: cells {b.first} and {b.second} have no common face in any layer")
            for layer in np.flatnonzero((self.states[:, [b.first, b.second]] == 1).all(axis=1)).tolist():
                rows.append(((layer, b.first), (layer, b.second), b.characteristic))
        return rows


def columns(
    mesh: MeshLike,
    surfaces: npt.ArrayLike,
    active: npt.ArrayLike | None = None,
    pinch_out: float = 0.0,
    *,
    cells: Literal["power", "triangles"] = "power",
) -> Columns:
    """The columns of a mesh: its cells between the surfaces of layers, with their neighbors.

    Parameters
    ----------
    mesh : MeshLike
        A regular mesh in the plane.
    surfaces : array_like
        Heights, (n_columns, layers + 1): the top and then the bottom of each layer, going down [length]; or (layers +
        1,), the same in all columns. NaN means no surface; then the layers above and below it are inactive.
    active : array_like, optional
        Activity of the layers, bool, (n_columns, layers) or (layers,). By default all are active.
    pinch_out : float
        Layers no thicker than this are pinched out [length]. Such a layer has no cell, and the cells above and below it
        are neighbors.
    cells : {"power", "triangles"}
        Cells as seen from above: the power cells of vertices, with the vertices as centers, or the triangles, with
        their orthocenters. There are as many columns as vertices or triangles.

    Raises
    ------
    TemperError
        Surfaces that are not one above the other; for power cells edges that are not regular; a face that is not
        between the centers of its two cells; a mesh of the sphere; no active cell.

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
        raise ValueError(f"surfaces: expected (n_columns, layers + 1) or (layers + 1,) numbers, found {heights.shape}")
    n, n_layers = given.n_triangles if cells == "triangles" else given.n_vertices, heights.shape[-1] - 1
    heights = _for_all(heights, (n, n_layers + 1), "surfaces")
    flags = np.zeros((0, n_layers), dtype=np.int32)
    if active is not None:
        flags = _for_all(np.asarray(active, dtype=bool).astype(np.int32), (n, n_layers), "active")
    handle = _temper.columns(given._handle, n_layers, heights, flags, float(pinch_out), cells)
    arguments = (given.copy(), heights, None if active is None else flags, float(pinch_out), cells)
    return Columns(**handle.arrays(), _handle=handle, _arguments=arguments)


def _columns_of(
    mesh: Mesh, surfaces: npt.ArrayLike, active: npt.ArrayLike | None, pinch_out: float, cells: Any
) -> Columns:
    return columns(mesh, surfaces, active, pinch_out, cells=cells)


def _for_all(values: npt.NDArray[Any], shape: tuple[int, int], name: str) -> npt.NDArray[Any]:
    """The values of each column, from an array for each column or one for all."""
    if values.shape not in (shape, shape[1:]):
        raise ValueError(f"{name}: expected {shape} or {shape[1:]} numbers, found {values.shape}")
    return np.ascontiguousarray(np.broadcast_to(values, shape))
