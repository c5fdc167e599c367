"""The weighted triangle mesh."""

from __future__ import annotations

import functools
import warnings
from typing import Any, Iterator, Literal, MutableMapping, Sequence, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _temper
from ._cells import Cells
from ._errors import TemperError, TemperWarning
from ._faces import LineFaces
from ._gmsh import is_model, put_back_model
from ._others import cells_of, data_of, handle_of, meshio_form, meshio_of, put_back_vtk, tags_of_32_bits
from ._space import Space
from ._ugrid import dataset_from, is_ugrid

PICTURE = 2000  # triangles: notebooks draw no larger meshes
PICTURE_WIDTH = 240.0  # [px]


def _ints(values: Any, columns: int, name: str) -> npt.NDArray[Any]:
    """Whole numbers with the given number of columns (0: one dimension). int32 stays, all others become int64."""
    if values is None:
        return np.empty((0, columns) if columns else 0, dtype=np.int64)
    array = np.asarray(values)
    if array.size == 0:
        return np.empty((0, columns) if columns else 0, dtype=np.int64)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: expected whole numbers, found {array.dtype}")
    wanted = "(n,)" if columns == 0 else f"(n, {columns})"
    if array.ndim != (2 if columns else 1) or (columns and array.shape[1] != columns):
        raise ValueError(f"{name}: expected shape {wanted}, found {array.shape}")
    return np.ascontiguousarray(array, dtype=np.int32 if array.dtype == np.int32 else np.int64)


def _tags(values: Any, name: str) -> npt.NDArray[np.int32]:
    """Whole numbers of 32 bits. TemperError if one does not fit."""
    array = np.asarray(values)
    whole = array.ndim == 1 and array.dtype.kind in "iu"
    return tags_of_32_bits(name, array if whole else _ints(values, 0, name))


def _doubles(values: Any, columns: int, name: str) -> npt.NDArray[np.float64]:
    """Doubles with the given number of columns (0: one dimension), without a copy if they are doubles already."""
    if values is None:
        return np.empty((0, columns) if columns else 0)
    array = np.asarray(values)
    if array.size == 0 and array.ndim <= 2:
        return np.empty((0, columns) if columns else 0)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: expected numbers, found {array.dtype}")
    wanted = "(n,)" if columns == 0 else f"(n, {columns})"
    if array.ndim != (2 if columns else 1) or (columns and array.shape[1] != columns):
        raise ValueError(f"{name}: expected shape {wanted}, found {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


DataRules = Union[str, Sequence[str]]
"""The treatment of data when a mesh changes: see ``Mesh.point_data_rules`` and ``Mesh.cell_data_rules``."""


def _planar(points: Any) -> npt.NDArray[np.float64]:
    """Points as (n, 2). Points (n, 3) must have the same z."""
    array = np.asarray(points)
    if array.ndim != 2 or array.shape[1] != 3 or array.size == 0 or array.dtype.kind not in "iuf":
        return _doubles(points, 2, "points")
    z = np.asarray(array[:, 2], dtype=np.float64)
    if (off := np.flatnonzero(~(z == z[0]))).size:
        found = f"point {off[0]} has z = {z[off[0]]}, but point 0 has z = {z[0]}"
        raise TemperError("not_planar", "", f"{found}; expected one z, or a sphere as the space")
    if z[0] != 0:
        warnings.warn(f"points: z = {z[0]} of all of them is dropped", TemperWarning, stacklevel=4)
    return np.ascontiguousarray(array[:, :2], dtype=np.float64)


def _places(points: Any, space: Space) -> npt.NDArray[np.float64]:
    """Points of the space: two columns, or three on the sphere."""
    return _planar(points) if space.is_plane else _doubles(points, 3, "points")


class Data(MutableMapping[str, npt.NDArray[Any]]):
    """Named arrays of a mesh, with a row for each point or cell. They show the state of the mesh at the time of the
    call. Assigning or deleting an array changes the mesh. The arrays themselves are read-only copies."""

    def __init__(self, mesh: Tagged, kind: Literal["point_data", "cell_data"]) -> None:
        self._mesh, self._kind = mesh, kind
        self._state = mesh.copy()

    @functools.cached_property
    def _arrays(self) -> dict[str, npt.NDArray[Any]]:
        """Computed when the first array is read: data have to follow the mesh."""
        arrays = self._state._file(with_data=True)[self._kind]
        for array in arrays.values():
            array.flags.writeable = False
        return arrays

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def __setitem__(self, name: str, values: npt.ArrayLike) -> None:
        refused: list[str] = []
        array = data_of(name, values, refused)
        if not isinstance(name, str) or array is None:
            raise TypeError(f"{self._kind}: expected a name and an array of numbers, found {name!r} and {type(values).__name__}")
        self._store(name, array)

    def __delitem__(self, name: str) -> None:
        self._store(name, None)

    def __repr__(self) -> str:
        return repr(self._arrays)

    def _store(self, name: str, array: npt.NDArray[Any] | None) -> None:
        self._mesh._set_data(self._kind == "point_data", name, array)
        self._state = self._mesh.copy()
        self.__dict__.pop("_arrays", None)


class Tagged:
    """Parts that meshes of triangles and of tetrahedra share."""

    __slots__ = ("_handle", "warnings", "__weakref__")

    _handle: Any
    warnings: list[str]
    """Repairs and losses when the mesh was made or read, in sentences."""

    def _file(self, *, with_data: bool = False) -> dict[str, Any]:
        raise NotImplementedError

    def _set_data(self, of_points: bool, name: str, array: npt.NDArray[Any] | None) -> None:
        raise NotImplementedError

    def copy(self) -> Any:
        raise NotImplementedError

    @property
    def n_vertices(self) -> int:
        """Number of vertices."""
        return self._handle.n_vertices()

    @property
    def lines(self) -> npt.NDArray[np.int32]:
        """Tagged lines, on the boundary or inside, as two vertices each, (k, 2) int32: those of the mesh's file or
        outline, as they are now. A ``Mesh`` of arrays has its constrained edges inside regions. A copy."""
        return self._file()["lines"]

    @property
    def marked_points(self) -> npt.NDArray[np.int32]:
        """Vertices that carry a tag, such as wells, (p,) int32. A copy."""
        return self._file()["marked_points"]

    @property
    def point_tags(self) -> npt.NDArray[np.int32]:
        """Tag of each of ``marked_points``, (p,) int32. A copy."""
        return self._file()["point_tags"]

    @property
    def names(self) -> dict[str, tuple[int, int]]:
        """The names of tags, each with its dimension and tag. The dimension is 0 for ``point_tags`` and 1 for tags of
        ``lines``. Regions of triangles and ``face_tags`` have 2, and regions of tetrahedra have 3. A name of several
        dimensions has the highest. A copy.

        >>> import temper
        >>> square = temper.Outline([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)], [7, 8, 7, 8])
        >>> mesh = temper.mesh_outline(square, 0.5).mesh
        >>> mesh.lines.shape, sorted(set(mesh.tags.tolist())), mesh.names
        ((8, 2), [7, 8], {})
        """
        return {name: (dimension, tag) for dimension, tag, name in sorted(self._file()["names"])}

    @property
    def point_data(self) -> Data:
        """Data of the points, from the mesh's file or assigned, in their present state (``point_data_rules``):
        ``mesh.point_data["depth"] = depth``."""
        return Data(self, "point_data")

    @property
    def cell_data(self) -> Data:
        """Data of the triangles or tetrahedra, from the mesh's file or assigned, in their present state
        (``cell_data_rules``)."""
        return Data(self, "cell_data")

    @property
    def point_data_rules(self) -> tuple[str, ...]:
        """Rules for floating point data of points when the mesh changes, in the words of ``--point-data``.

        ``"interpolate"``, the default: data belong to the place and are linear on the original cells, so that a depth
        stays where it was measured. ``"keep"``: data stay with their point. ``"conserve"``: data are means over power
        cells, and their integrals stay. ``"keep=NAME"``, ``"interpolate=NAME"`` and ``"conserve=NAME"`` are for one
        array. Integers always stay with their points. Assigning one word or several replaces all rules, and so does
        ``()``. In a ``TetMesh`` the rules hold for later changes. In a ``Mesh`` they hold for all changes since data
        were last read from a file or assigned.

        TemperError lists the rules or the arrays that exist if a word names another. A rule that does not fit its array
        is an error, too.
        """
        return tuple(self._handle.data_rules(True))

    @point_data_rules.setter
    def point_data_rules(self, words: DataRules) -> None:
        self._set_rules("point_data_rules", words)

    @property
    def cell_data_rules(self) -> tuple[str, ...]:
        """Rules for floating point data of triangles or tetrahedra, in the words of ``--cell-data``.

        ``"sample"``, the default: a cell has the data of the original cell that contains its middle. ``"conserve"``:
        data are means over cells, and their integrals over the domain and each region stay. ``"sample=NAME"`` and
        ``"conserve=NAME"`` are for one array. Integers are always sampled. All else is as in ``point_data_rules``.

        >>> import numpy as np, temper
        >>> mesh = temper.generate.annulus()
        >>> mesh.cell_data["u"] = mesh.points[mesh.triangles].mean(axis=1)[:, 0]
        >>> mesh.cell_data_rules = "conserve"
        >>> before = np.sum(temper.dec_operators(mesh).areas * mesh.cell_data["u"])
        >>> report = temper.optimize(mesh)
        >>> after = np.sum(temper.dec_operators(mesh).areas * mesh.cell_data["u"])
        >>> bool(abs(after - before) < 1e-13 * mesh.n_triangles), report.data.conserved_of_triangles
        (True, ['u'])
        """
        return tuple(self._handle.data_rules(False))

    @cell_data_rules.setter
    def cell_data_rules(self, words: DataRules) -> None:
        self._set_rules("cell_data_rules", words)

    def _set_rules(self, name: Literal["point_data_rules", "cell_data_rules"], words: DataRules) -> None:
        rules = (words,) if isinstance(words, str) else tuple(words)
        if not all(isinstance(word, str) for word in rules):
            raise TypeError(f"{name}: expected a word or a sequence of words, found {words!r}")
        self._handle.set_data_rules(name == "point_data_rules", rules)

    def validate(self) -> str | None:
        """Checks the mesh, for example that every triangle or tetrahedron is positive (exact). Returns the first fault,
        or None. O(n)."""
        return self._handle.validate()

    def __copy__(self) -> Any:
        return self.copy()  # type: ignore[attr-defined]

    def __deepcopy__(self, memo: Any) -> Any:
        return self.copy()  # type: ignore[attr-defined]

    def __eq__(self, other: object) -> bool:
        """Says whether all arrays are equal, bit for bit."""
        return isinstance(other, type(self)) and self._handle.equal(other._handle)

    __hash__ = None  # type: ignore[assignment]


class Triangles(Tagged):
    """Parts that meshes of triangles share: in the plane, on a sphere or in space."""

    __slots__ = ()

    @property
    def n_triangles(self) -> int:
        """Number of triangles."""
        return self._handle.n_triangles()

    @property
    def n_halfedges(self) -> int:
        """Three times the number of triangles."""
        return 3 * self._handle.n_triangles()

    @property
    def n_edges(self) -> int:
        """Number of edges. O(n)."""
        return self._handle.n_edges()

    @property
    def triangles(self) -> npt.NDArray[np.int32]:
        """Corners of each triangle, counter-clockwise, (m, 3) int32. A read-only view."""
        return self._handle.triangles()

    @property
    def twins(self) -> npt.NDArray[np.int32]:
        """The halfedge on the other side of each halfedge, (3 m,) int32; −1 on the boundary. A read-only view."""
        return self._handle.twins()

    @property
    def neighbors(self) -> npt.NDArray[np.int32]:
        """The triangle across the edge from corner k to corner k + 1, (m, 3) int32; −1 on the boundary. A copy."""
        twins = self._handle.twins().reshape(-1, 3)
        return np.where(twins < 0, np.int32(-1), twins // 3)

    @property
    def regions(self) -> npt.NDArray[np.int32]:
        """Region number of each triangle, (m,) int32. A copy."""
        return self._handle.regions()

    @property
    def edges(self) -> npt.NDArray[np.int32]:
        """Each edge once, as two vertices, (e, 2) int32, in the order of the halfedges (``dec_operators`` has another
        order). A copy."""
        return self._handle.edges()

    @property
    def boundary_edges(self) -> npt.NDArray[np.int32]:
        """Edges of one triangle, (b, 2) int32, with the domain on their left. A copy."""
        return self._handle.boundary_edges()

    @property
    def constrained_edges(self) -> npt.NDArray[np.int32]:
        """Edges that never flip, (k, 2) int32: your lines, and interfaces of regions. A copy."""
        return self._handle.constrained_edges()

    @property
    def fixed(self) -> npt.NDArray[np.int32]:
        """Vertices that must never move, (k,) int32, ascending. A copy. Assigning replaces these marks."""
        return self._handle.fixed()

    @fixed.setter
    def fixed(self, vertices: npt.ArrayLike) -> None:
        self._handle.set_fixed(_ints(vertices, 0, "fixed").astype(np.int64))

    # --- tags and names -------------------------------------------------------------------------------------

    def _file(self, *, with_data: bool = False) -> dict[str, Any]:
        return _temper.file_as_dict(self._handle, with_data)

    def _set_data(self, of_points: bool, name: str, array: npt.NDArray[Any] | None) -> None:
        _temper.set_data(self._handle, of_points, name, array)

    @property
    def tags(self) -> npt.NDArray[np.int32]:
        """Tag of each of ``lines``, (k,) int32. A copy. (Tags of triangles are ``regions``, tags of points are
        ``point_tags``.)"""
        return self._file()["line_tags"]

    def set_constrained(self, edges: npt.ArrayLike, constrained: bool = True) -> None:
        """Marks edges, (k, 2) pairs of vertices, so that they never flip, or removes the mark. TemperError if the mesh
        has no such edge."""
        self._handle.set_constrained(_ints(edges, 2, "edges").astype(np.int64), constrained)

    def find_halfedge(self, a: int, b: int) -> int:
        """The halfedge from vertex a to vertex b, or −1. O(degree)."""
        return self._handle.find_halfedge(a, b)

    def star(self, vertex: int) -> npt.NDArray[np.int32]:
        """The halfedges that leave a vertex, counter-clockwise."""
        return self._handle.star(vertex)

    def _form(self) -> Cells:
        return meshio_form(self._handle)

    def _vertices_of_points(self) -> npt.NDArray[np.int32]:
        """Vertex of each original point, −1 if it is gone."""
        return np.asarray(_temper.vertices_of_points(self._handle))

    def _shown(self, where: str = "") -> str:
        vertices = "1 vertex" if self.n_vertices == 1 else f"{self.n_vertices} vertices"
        triangles = "1 triangle" if self.n_triangles == 1 else f"{self.n_triangles} triangles"
        return f"<temper.{type(self).__name__}: {vertices}, {triangles}{where}>"

    def _repr_svg_(self) -> str | None:
        if not 0 < self.n_triangles <= PICTURE:
            return None
        return _temper.draw_svg(self._handle, {"dual": False, "near_coincident": False, "width": PICTURE_WIDTH})


class Mesh(Triangles):
    """A triangle mesh whose vertices carry weights.

    Parameters
    ----------
    points : (n, 2) float64
        Positions, in units of your choice; read without a copy if C-contiguous. Or (n, 3) with the same z. On a sphere
        (n, 3), at its radius to one part in a million.
    triangles : (m, 3) int32 or int64
        Corners, counted from 0. Clockwise triangles are reversed, with a warning; ``reversed_triangles`` counts them.
    weights : (n,) float64, optional
        Squared lengths [length²]. The power of a place p to vertex i is \\|x_i − p\\|² − w_i, so a larger weight makes
        a larger power cell. Default: all 0. On a sphere weights must be more than −R²: see ``Space``.
    constrained_edges : (k, 2) int, optional
        Edges that must stay, as pairs of vertices: feature lines. Edges between regions are always constrained.
    regions : (m,) int32, optional
        A number for each triangle. Default: all 0.
    fixed : (k,) int, optional
        Vertices that must not move. (Boundary vertices stay without being named.)
    space : Space
        ``Space.sphere(radius)`` for a mesh of the whole sphere, or of a part with a boundary; edges are arcs of less
        than half a great circle. ``Space.periodic(x, y)``: each point may be any of its images. Default: the plane.
    threads : int, optional
        Threads for the checks; None or 0: all of the machine.

    Raises
    ------
    TemperError
        Arrays that make no mesh of the space; the message names the element. Numbers are out of range or not finite.
        Points occur twice, are in no triangle or are not on the sphere. Triangles have no area or lie on top of
        another. Edges have more than two triangles, or the mesh touches itself at a vertex.

    Notes
    -----
    ``points``, ``weights``, ``triangles`` and ``twins`` are read-only views on the mesh's own memory, without copies. A
    view keeps its values: when the mesh changes, the mesh gets new memory, and the view shows the former state. All
    other arrays are copies. On a sphere ``points`` and ``weights`` are copies too, and ``weighted_vectors`` is the
    view. To change a mesh, assign: ``mesh.weights = w``.

    Halfedge 3 t + k runs from corner k to corner k + 1 of triangle t. Triangles are counter-clockwise, on a sphere as
    seen from outside.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.Mesh([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
    >>> mesh.n_vertices, mesh.n_triangles, mesh.n_edges
    (4, 2, 5)
    >>> corners = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> octant = temper.Mesh(corners, [(0, 1, 2)], space=temper.Space.sphere(1))
    >>> octant.points.shape, octant.space
    ((3, 3), Space.sphere(1.0))
    """

    __slots__ = ("reversed_triangles",)

    _handle: _temper.Mesh
    reversed_triangles: int
    """Number of triangles that were clockwise in the input."""

    def __init__(
        self,
        points: npt.ArrayLike,
        triangles: npt.ArrayLike,
        weights: npt.ArrayLike | None = None,
        *,
        constrained_edges: npt.ArrayLike | None = None,
        regions: npt.ArrayLike | None = None,
        fixed: npt.ArrayLike | None = None,
        space: Space = Space(),
        threads: int | None = None,
    ) -> None:
        self._handle, self.reversed_triangles = _temper.mesh_from_arrays(
            space.radius,
            space.period,
            _places(points, space),
            _ints(triangles, 3, "triangles"),
            _doubles(weights, 0, "weights"),
            _ints(constrained_edges, 2, "constrained_edges"),
            _tags(regions, "regions"),
            _ints(fixed, 0, "fixed"),
            threads,
        )
        self.warnings = []
        if n := self.reversed_triangles:
            _warn(self, [f"{n} clockwise {'triangle is' if n == 1 else 'triangles are'} reversed"], 2)

    @classmethod
    def _of(cls, handle: _temper.Mesh) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._handle = handle
        mesh.reversed_triangles = 0
        mesh.warnings = []
        return mesh

    # --- sizes ---------------------------------------------------------------------------------------------

    @property
    def memory_bytes(self) -> int:
        """Size of the mesh's arrays in bytes."""
        return self._handle.memory_bytes()

    # --- arrays --------------------------------------------------------------------------------------------

    @property
    def space(self) -> Space:
        """The space that the mesh lies in."""
        return Space(self._handle.radius(), self._handle.period())

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Positions, (n, 2) float64 [length]. A read-only view, rows 32 bytes apart. On a sphere a copy, (n, 3), of the
        places of the vertices.

        Assigning moves all vertices at once and keeps their weights. TemperError if a triangle would not be
        counter-clockwise, or a point is off the sphere; then nothing changes. O(n).
        """
        return self._handle.points()

    @points.setter
    def points(self, points: npt.ArrayLike) -> None:
        self._handle.set_points(_places(points, self.space))

    @property
    def weights(self) -> npt.NDArray[np.float64]:
        """Weights, (n,) float64 [length²]. A read-only view, 32 bytes apart; on a sphere a copy. Assigning sets all at
        once; the connectivity stays (see ``restore_regularity``). O(n)."""
        return self._handle.weights()

    @weights.setter
    def weights(self, weights: npt.ArrayLike) -> None:
        self._handle.set_weights(_doubles(weights, 0, "weights"))

    @property
    def weighted_vectors(self) -> npt.NDArray[np.float64]:
        """Weighted vector P of each vertex on a sphere, (n, 3) float64 [length]. Its direction is the place, and
        \\|P\\|² = R² + w. A read-only view, rows 32 bytes apart, for ``temper.geometry``. Assigning sets places and
        weights at once, with the errors of ``points``. TemperError in the plane."""
        return self._handle.weighted_vectors()

    @weighted_vectors.setter
    def weighted_vectors(self, points: npt.ArrayLike) -> None:
        self._handle.set_weighted_vectors(_doubles(points, 3, "weighted_vectors"))

    # --- methods --------------------------------------------------------------------------------------------

    def faces_of(self, name: str | int) -> LineFaces:
        """The faces of power cells on a line, such as a fault: pairs of vertices, ends and lengths.

        Parameters
        ----------
        name : str or int
            The name or tag of a line that ``temper mesh --faces`` or ``mesh_outline`` has made faces.

        Raises
        ------
        TemperError
            No line inside the domain has the name or tag, or the line runs through the centers of cells.
        ValueError
            The mesh is not in the plane.
        """
        return LineFaces(**_temper.faces_of_line(self._handle, str(name)))

    def compact(self) -> npt.NDArray[np.int32]:
        """Drops everything that ``topology.remove_vertex`` erased. Returns the former number of each vertex."""
        return self._handle.compact()

    def copy(self) -> Mesh:
        """An independent mesh; the memory is shared until one of the two changes."""
        mesh = Mesh._of(self._handle.copy())
        mesh.reversed_triangles = self.reversed_triangles
        mesh.warnings = list(self.warnings)
        return mesh

    def __reduce__(self) -> Any:
        """Everything that ``copy`` keeps, for another process. To keep a mesh, write it."""
        vectors = None if self.space.is_plane else np.array(self.weighted_vectors)
        vertices = (self.space, np.array(self.points), np.array(self.weights), vectors, self.fixed)
        triangles = (np.array(self.triangles), self.constrained_edges, self.regions)
        source = (_temper.source_as_dict(self._handle), (self.point_data_rules, self.cell_data_rules))
        state = {"reversed_triangles": self.reversed_triangles, "warnings": self.warnings}
        return _unpickle, (vertices, triangles, source), (None, state)

    # --- other libraries --------------------------------------------------------------------------------------

    def to_meshio(self) -> Any:
        """The mesh as a ``meshio.Mesh``, which meshio writes to any of its formats. Needs meshio.

        Points are (n, 3) float64 (with the original z, or 0; on a sphere the places), with point data ``weight``
        (float64, [length²]). Triangles have cell data ``region``. ``lines`` are cells of type ``line``, and
        ``marked_points`` of type ``vertex``; their ``region`` is their tag. If there are tags, the cell data
        ``gmsh:physical`` are the same, and names are ``field_data``: tag and dimension. All other data of the mesh
        follow.
        """
        self._handle.require_no_period("to_meshio()")
        return meshio_of(self._form())

    def to_xarray(self, like: Any = None) -> Any:
        """The mesh as an ``xarray.Dataset`` by the UGRID conventions. Needs xarray.

        Parameters
        ----------
        like : xarray.Dataset, or of xugrid, optional
            The dataset that the mesh came from. The result has its names, dimensions and attributes, and its variables
            that are on no node, edge or face. Without it, names begin with ``mesh2d``.

        Returns
        -------
        xarray.Dataset
            Nodes, faces and edges, with data of points and triangles. Weights are the variable ``NAME_node_weight``
            [length²] of the topology ``NAME``. Centers of faces are the orthocenters; with quadrilaterals there are
            none.

        Warns
        -----
        TemperWarning
            Tags of lines and of points, and names, which have no place there.
        """
        self._handle.require_no_period("to_xarray()")
        if not self.space.is_plane:
            raise TemperError("unsupported", "", "to_xarray(): the mesh is on a sphere. Next: temper.write a .ugrid.nc, and open that")
        form = self._form()
        lost = [what for what in ("lines", "marked_points", "names") if len(getattr(self, what))]
        if lost:
            repeat_warnings([f"{' and '.join(lost).replace('_', ' ')} are left out. Next: temper.write keeps them"], 2)
        has_quads = any(block.type == "quad" for block in form.cells)
        weighted = np.column_stack([self.points, self.weights])[self.triangles].swapaxes(0, 1)
        return dataset_from(form, None if has_quads else _temper.orthocenter(*map(np.ascontiguousarray, weighted), False), like)

    def to_xugrid(self, like: Any = None) -> Any:
        """The mesh as an ``xugrid.UgridDataset``: see ``to_xarray``. Needs xugrid."""
        import xugrid

        return xugrid.UgridDataset(self.to_xarray(like))

    # --- how it looks -------------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        where = "" if self.space == Space() else f" on {self.space!r}"
        return self._shown(where)


def _unpickle(vertices: tuple[Any, ...], triangles: tuple[Any, ...], source: tuple[Any, ...]) -> Mesh:
    space, points, weights, vectors, fixed = vertices
    corners, constrained, regions = triangles
    mesh = Mesh(points, corners, weights, constrained_edges=constrained, regions=regions, fixed=fixed, space=space)
    if vectors is not None:
        mesh.weighted_vectors = vectors  # bit for bit, because points and weights are rounded
    file, rules = source
    if file is not None:
        _temper.set_source_from_dict(mesh._handle, file)
    mesh.point_data_rules, mesh.cell_data_rules = rules
    return mesh


MeshLike = Union[Mesh, Any]
"""A ``temper.Mesh``, or a mesh of meshio, PyVista, Gmsh, xarray or xugrid (``as_mesh``), for every function that takes a mesh."""


def as_mesh(mesh: MeshLike, *, in_place: bool = False) -> Mesh:
    """The mesh itself, or the mesh of another library as a ``temper.Mesh``. Every function that takes a mesh does this.

    Parameters
    ----------
    mesh : Mesh, or of another library
        ``meshio.Mesh`` (``from_meshio`` has the rules, which hold for all), PyVista's ``PolyData`` and
        ``UnstructuredGrid``, ``gmsh.model``, ``xarray.Dataset`` by the UGRID conventions, xugrid's ``Ugrid2d``,
        ``UgridDataset`` and ``UgridDataArray``.
    in_place : bool
        The caller will change the mesh. Meshes of xarray and xugrid cannot.

    Raises
    ------
    TypeError
        Another class.
    TemperError
        The errors of ``from_meshio``; a grid in degrees.
    """
    if isinstance(mesh, Mesh):
        return mesh
    handle, messages = triangles_of(mesh, in_place, curved=False)
    return _warn(Mesh._of(handle), messages, 3)


_TAKERS = "temper.quality, optimize, find_weights, dec_operators, write and "


def triangles_of(mesh: Any, in_place: bool = False, *, curved: bool = True) -> tuple[Any, list[str]]:
    """The handle of a mesh of triangles of another library, and messages. See ``as_mesh``. ``curved``: a
    curved surface is no error."""
    handle = getattr(mesh, "_handle", None)
    if isinstance(handle, _temper.TetMesh):
        raise TypeError(f"expected a mesh of triangles, found a TetMesh. Next: {_TAKERS}measure_errors take it")
    if isinstance(handle, _temper.SurfaceMesh):
        raise TypeError(f"expected a mesh of the plane or a sphere, found a SurfaceMesh. Next: {_TAKERS}explain take it")
    cells = cells_of(mesh)
    if cells is None:
        raise TypeError(f"expected a temper.Mesh, or a mesh of meshio, PyVista, Gmsh, xarray or xugrid, found {type(mesh).__name__}")
    if in_place and is_ugrid(mesh):
        raise TypeError(f"a {type(mesh).__name__} cannot change in place. Next: change temper.as_mesh(grid)")
    return handle_of(cells, curved=curved)


AnyTriangles = TypeVar("AnyTriangles", bound=Triangles)


def _warn(mesh: AnyTriangles, messages: list[str], level: int) -> AnyTriangles:
    """The mesh, with its messages also as warnings at the line ``level`` calls up."""
    mesh.warnings = messages
    repeat_warnings(messages, level + 1)
    return mesh


def repeat_warnings(messages: list[str], level: int) -> None:
    """Gives the messages as warnings at the line ``level`` calls up."""
    for message in messages:
        warnings.warn(message, TemperWarning, stacklevel=level + 1)


# --- meshio's meshes ------------------------------------------------------------------------------------------


def from_meshio(mesh: Any, *, fixed_tags: tuple[str | int, ...] = ()) -> Mesh:
    """A ``meshio.Mesh`` as a ``temper.Mesh``.

    Parameters
    ----------
    mesh : meshio.Mesh
        Its triangles and quadrilaterals become the mesh, and lines inside the domain become constrained edges. A
        quadrilateral becomes two triangles, whose corners stay in place. So do points of vertex cells. Other cells,
        ``point_sets`` and ``cell_sets`` are left out, with a warning. Points may have a third coordinate if it is the
        same for all. If all points have the same distance from the origin, to one part in a million, they are a mesh of
        the sphere. Point data ``weight`` are the weights [length²]. The regions are the
        integer cell data ``region``, ``gmsh:physical``, ``medit:ref`` or ``cell_tags``, the first that exists; tags of
        lines and vertex cells too. ``field_data`` of a tag and a dimension are ``names``. All other data are kept:
        ``to_meshio`` and ``write`` return them.
    fixed_tags : sequence of str or int
        Tags of lines whose points must not move.

    Raises
    ------
    TemperError
        The errors of ``Mesh``; also no triangles, and points in space that are on no sphere.
    TypeError
        Another class.

    Warns
    -----
    TemperWarning
        Points of no triangle that are dropped; clockwise triangles that are reversed; data and cells left out.
    """
    if not all(hasattr(mesh, name) for name in ("points", "cells", "point_data", "point_sets", "cell_sets")):
        raise TypeError(f"mesh: expected a meshio.Mesh, found {type(mesh).__name__}. Next: temper.as_mesh takes other classes")
    sets = {"point_sets": mesh.point_sets, "cell_sets": mesh.cell_sets}
    lost = [f"{kind} {', '.join(map(repr, names))} are left out" for kind, names in sets.items() if names]
    handle, messages = handle_of(mesh, fixed_tags, curved=False)
    return _warn(Mesh._of(handle), lost + messages, 2)


def put_back(mesh: Any, changed: Any) -> None:
    """Writes a mesh that was changed in place into the mesh of meshio, PyVista or Gmsh that it came from. Sets of
    points stay, with their new numbers. Sets of cells are lost, because flips change the cells."""
    if is_model(mesh):
        return put_back_model(mesh, changed._form(), changed._vertices_of_points())
    if not hasattr(mesh, "point_sets"):
        return put_back_vtk(mesh, changed._form())
    new = changed.to_meshio()
    now = changed._vertices_of_points()
    sets = {name: now[np.asarray(points, dtype=np.int64)] for name, points in mesh.point_sets.items()}
    sets = {name: vertices[vertices >= 0] for name, vertices in sets.items()}
    lost = ", ".join(f"'{name}'" for name in mesh.cell_sets)
    mesh.points, mesh.cells = new.points, new.cells
    mesh.point_data, mesh.cell_data = new.point_data, new.cell_data
    mesh.point_sets, mesh.cell_sets = sets, {}
    if lost:
        warnings.warn(f"the cells are others: cell_sets {lost} are dropped", TemperWarning, stacklevel=4)
