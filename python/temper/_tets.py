"""The weighted tetrahedral mesh."""

from __future__ import annotations

import inspect
from typing import Any, Callable, Union

import numpy as np
import numpy.typing as npt

from . import _temper
from ._cells import Cells
from ._mesh import Mesh, MeshLike, Tagged, _doubles, _ints, _tags, _warn, as_mesh, repeat_warnings, triangles_of
from ._others import cells_of, meshio_form_of_tets, meshio_of, tet_arrays
from ._surfaces import SurfaceMesh

_OUTWARD = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # corners of the face opposite each corner


class TetMesh(Tagged):
    """A mesh of tetrahedra whose vertices carry weights.

    Parameters
    ----------
    points : (n, 3) float64
        Positions, in units of your choice.
    tetrahedra : (m, 4) int32 or int64
        Corners, counted from 0. Negative tetrahedra are reversed, with a warning. A tetrahedron a, b, c, d is positive
        if ((b − a) × (c − a))·(d − a) > 0, as in Gmsh and VTK.
    weights : (n,) float64, optional
        Squared lengths [length²]. The power of a place p to vertex i is \\|x_i − p\\|² − w_i, so a larger weight makes
        a larger power cell. Default: all 0.
    regions : (m,) int32, optional
        A number for each tetrahedron. Default: all 0.
    tagged_faces : (k, 3) int, optional
        Faces that carry a tag, on the boundary or inside, as three vertices each.
    face_tags : (k,) int32, optional
        Tag of each of ``tagged_faces``. Default: all 0.
    lines : (k, 2) int, optional
        Edges that carry a tag.
    line_tags : (k,) int32, optional
    marked_points : (k,) int, optional
        Vertices that carry a tag.
    point_tags : (k,) int32, optional
    threads : int, optional
        Threads for the checks; None or 0: all of the machine.

    Raises
    ------
    TemperError
        Arrays that make no mesh; the message names the element and its place. Numbers are out of range or not finite.
        Points occur twice or are in no tetrahedron. Tetrahedra are flat or inverted, or lie on top of others. Faces
        have more than two tetrahedra, or the mesh touches itself at an edge or a vertex.

    Warns
    -----
    TemperWarning
        Negative tetrahedra that are reversed; tagged faces and lines that are no face or edge of the mesh.

    Notes
    -----
    ``weights`` and ``tetrahedra`` are read-only views on the mesh's own memory. All other arrays are copies. ``optimize``
    changes the mesh in place, and so does assigning ``weights``. Views then show the former state.

    The orthocenter o of a tetrahedron has equal power to its four corners. h is the signed distance of o from the plane
    of a face, positive on the side of the tetrahedron. The tetrahedron is well-centered if all four h > 0 [length].

    Examples
    --------
    >>> import temper
    >>> mesh = temper.TetMesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2, 3)])
    >>> mesh
    <temper.TetMesh: 4 vertices, 1 tetrahedron>
    >>> report = temper.quality(mesh)
    >>> round(report.volume, 6), report.orthocenters_outside
    (0.166667, 1)
    """

    __slots__ = ()

    _handle: _temper.TetMesh

    def __init__(
        self,
        points: npt.ArrayLike,
        tetrahedra: npt.ArrayLike,
        weights: npt.ArrayLike | None = None,
        *,
        regions: npt.ArrayLike | None = None,
        tagged_faces: npt.ArrayLike | None = None,
        face_tags: npt.ArrayLike | None = None,
        lines: npt.ArrayLike | None = None,
        line_tags: npt.ArrayLike | None = None,
        marked_points: npt.ArrayLike | None = None,
        point_tags: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> None:
        def tags(values: npt.ArrayLike | None, elements: npt.NDArray[Any], name: str) -> npt.NDArray[Any]:
            return np.zeros(len(elements), dtype=np.int32) if values is None else _tags(values, name)

        faces, edges, marked = _ints(tagged_faces, 3, "tagged_faces"), _ints(lines, 2, "lines"), _ints(marked_points, 0, "marked_points")
        arrays = {
            "points": _doubles(points, 3, "points"), "tetrahedra": _ints(tetrahedra, 4, "tetrahedra"),
            "weights": _doubles(weights, 0, "weights"), "regions": _tags(regions, "regions"),
            "faces": faces, "face_tags": tags(face_tags, faces, "face_tags"),
            "lines": edges, "line_tags": tags(line_tags, edges, "line_tags"),
            "marked_points": marked, "point_tags": tags(point_tags, marked, "point_tags"),
            "names": [], **{f"{kind}_data": {} for kind in ("point", "cell", "face", "line", "marked_point", "field")},
        }  # fmt: skip
        self._handle, self.warnings = _temper.tet_mesh_from_arrays(arrays, True, threads)
        repeat_warnings(self.warnings, 2)

    @classmethod
    def _of(cls, handle: _temper.TetMesh, messages: list[str], level: int | None) -> TetMesh:
        """A mesh with its messages. They are warnings, too, at the line ``level`` calls up."""
        mesh = cls.__new__(cls)
        mesh._handle, mesh.warnings = handle, messages
        if level is not None:
            repeat_warnings(messages, level + 1)
        return mesh

    @classmethod
    def from_meshio(cls, mesh: Any) -> TetMesh:
        """A ``meshio.Mesh``, an ``UnstructuredGrid`` of PyVista or ``gmsh.model``, as a mesh of tetrahedra.

        Cells of type ``tetra`` become the mesh. Cells of type ``triangle``, ``line`` and ``vertex`` are tagged faces,
        lines and marked points. Other cells are left out, with a warning. Weights, regions, tags, names and data are as
        in ``temper.from_meshio``. Points of no tetrahedron are dropped, with a warning.

        Raises
        ------
        TemperError
            The errors of ``TetMesh``; also no tetrahedra.
        TypeError
            Another class.
        """
        return _from_cells(_cells(mesh), 2)

    # --- sizes ---------------------------------------------------------------------------------------------

    @property
    def n_tetrahedra(self) -> int:
        """Number of tetrahedra."""
        return self._handle.n_tetrahedra()

    @property
    def n_faces(self) -> int:
        """Number of faces, each counted once. O(n)."""
        return self._handle.n_faces()

    # --- arrays --------------------------------------------------------------------------------------------

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Positions, (n, 3) float64 [length]. A copy."""
        return self._handle.points()

    @property
    def weights(self) -> npt.NDArray[np.float64]:
        """Weights, (n,) float64 [length²]. A read-only view. Assigning sets all at once, and the tetrahedra stay. O(n).

        Assigning (m, 4) sets a weight for each corner of each tetrahedron, as ``find_weights`` finds them for several
        tensors: ``cell_data["corner_weights"]``.
        """
        return self._handle.weights()

    @weights.setter
    def weights(self, weights: npt.ArrayLike) -> None:
        if np.ndim(weights) == 2:
            self._handle.set_corner_weights(_doubles(weights, 4, "weights"))
        else:
            self._handle.set_weights(_doubles(weights, 0, "weights"))

    @property
    def tetrahedra(self) -> npt.NDArray[np.int32]:
        """Corners of each tetrahedron, positive, (m, 4) int32. A read-only view."""
        return self._handle.tetrahedra()

    @property
    def neighbors(self) -> npt.NDArray[np.int32]:
        """The tetrahedron across the face opposite corner k, (m, 4) int32; −1 on the boundary. A copy."""
        return self._handle.neighbors()

    @property
    def boundary_faces(self) -> npt.NDArray[np.int32]:
        """Faces of one tetrahedron, (b, 3) int32, counter-clockwise as seen from outside. A copy."""
        tetrahedron, corner = np.nonzero(self.neighbors < 0)
        return self.tetrahedra[tetrahedron[:, None], _OUTWARD[corner]]

    @property
    def regions(self) -> npt.NDArray[np.int32]:
        """Region number of each tetrahedron, (m,) int32. A copy."""
        return self._handle.regions()

    # --- tags, names and data -------------------------------------------------------------------------------

    def _file(self, *, with_data: bool = True) -> dict[str, Any]:
        """The contents of the file, in the numbers of the vertices. Elements that have lost a point are dropped."""
        file = self._handle.file()
        number = file.pop("vertices")
        for elements, tags, data in (
            ("faces", "face_tags", "face_data"), ("lines", "line_tags", "line_data"),
            ("marked_points", "point_tags", "marked_point_data"),
        ):  # fmt: skip
            numbered = number[file[elements]]
            kept = numbered >= 0 if numbered.ndim == 1 else (numbered >= 0).all(axis=1)
            file[elements], file[tags] = numbered[kept], file[tags][kept]
            file[data] = {name: values[kept] for name, values in file[data].items()}
        file["point_data"] = {name: values[number >= 0] for name, values in file["point_data"].items()}
        return file

    def _set_data(self, of_points: bool, name: str, array: npt.NDArray[Any] | None) -> None:
        _temper.tet_set_data(self._handle, of_points, name, array)

    @property
    def tagged_faces(self) -> npt.NDArray[np.int32]:
        """Faces that carry a tag, on the boundary or inside, (k, 3) int32, as they were given. A copy."""
        return self._file()["faces"]

    @property
    def face_tags(self) -> npt.NDArray[np.int32]:
        """Tag of each of ``tagged_faces``, (k,) int32. A copy."""
        return self._file()["face_tags"]

    @property
    def line_tags(self) -> npt.NDArray[np.int32]:
        """Tag of each of ``lines``, (k,) int32. A copy."""
        return self._file()["line_tags"]

    # --- methods --------------------------------------------------------------------------------------------

    def to_meshio(self) -> Any:
        """The mesh as a ``meshio.Mesh``, which meshio writes to any of its formats. Needs meshio. For PyVista:
        ``pyvista.from_meshio(mesh.to_meshio())``.

        Points have the data ``weight`` [length²]. The data ``region`` are the region of a cell of type ``tetra`` and
        the tag of a cell of type ``triangle``, ``line`` or ``vertex``. If there are tags, the cell data
        ``gmsh:physical`` are the same, and names are ``field_data``: tag and dimension. All other data of the mesh
        follow.
        """
        return meshio_of(self._form())

    def _form(self) -> Cells:
        return meshio_form_of_tets(self.points, self.weights, self.tetrahedra, self.regions, self._file())

    def _vertices_of_points(self) -> npt.NDArray[np.int32]:
        """Vertex of each original point, −1 if it is gone."""
        return self._handle.vertices_of_points()

    def copy(self) -> TetMesh:
        """An independent mesh; the memory is shared until one of the two changes."""
        return TetMesh._of(self._handle.copy(), list(self.warnings), None)

    def __reduce__(self) -> Any:
        """Everything but the name and the format of the file, for another process. To keep a mesh, write it."""
        arrays = {**self._file(), "points": self.points, "weights": np.array(self.weights)}
        arrays |= {"tetrahedra": np.array(self.tetrahedra), "regions": self.regions}
        return _unpickle, (arrays, self.warnings, (self.point_data_rules, self.cell_data_rules))

    def __repr__(self) -> str:
        vertices = "1 vertex" if self.n_vertices == 1 else f"{self.n_vertices} vertices"
        tetrahedra = "1 tetrahedron" if self.n_tetrahedra == 1 else f"{self.n_tetrahedra} tetrahedra"
        return f"<temper.TetMesh: {vertices}, {tetrahedra}>"


def _unpickle(arrays: dict[str, Any], messages: list[str], rules: tuple[tuple[str, ...], ...]) -> TetMesh:
    mesh = TetMesh._of(_temper.tet_mesh_from_arrays(arrays, False, None)[0], messages, None)
    mesh.point_data_rules, mesh.cell_data_rules = rules
    return mesh


def _cells(mesh: Any) -> Any:
    cells = cells_of(mesh)
    if cells is None:
        raise TypeError(f"expected a mesh of meshio, PyVista or Gmsh, found {type(mesh).__name__}")
    return cells


def _from_cells(cells: Any, level: int) -> TetMesh:
    arrays, dropped = tet_arrays(cells)
    handle, messages = _temper.tet_mesh_from_arrays(arrays, False, None)
    return TetMesh._of(handle, dropped + messages, level + 1)


AnyMeshLike = Union[TetMesh, SurfaceMesh, MeshLike]
"""A mesh of triangles, of tetrahedra or of a curved surface, of temper or of another library."""


def as_any_mesh(mesh: AnyMeshLike, *, in_place: bool = False) -> Mesh | TetMesh | SurfaceMesh:
    """The mesh itself, or the mesh of another library: a ``TetMesh`` if it has tetrahedra, a ``SurfaceMesh`` if it is
    curved. ``in_place``: as in ``as_mesh``."""
    if isinstance(mesh, (Mesh, TetMesh, SurfaceMesh)):
        return mesh
    cells = cells_of(mesh)
    if cells is not None and any(block.type == "tetra" and len(block.data) for block in cells.cells):
        return _from_cells(cells, 3)
    handle, messages = triangles_of(mesh, in_place)
    is_curved = isinstance(handle, _temper.SurfaceMesh)
    return _warn(SurfaceMesh._of(handle) if is_curved else Mesh._of(handle), messages, 3)


def as_triangles(mesh: AnyMeshLike) -> Mesh | SurfaceMesh:
    """As ``as_any_mesh``. TypeError for tetrahedra."""
    if isinstance(mesh, TetMesh):
        triangles_of(mesh)
    return as_any_mesh(mesh)  # type: ignore[return-value]


def as_flat_mesh(mesh: AnyMeshLike) -> Mesh | TetMesh:
    """As ``as_any_mesh``. TypeError for a curved surface."""
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, SurfaceMesh):
        as_mesh(any_mesh)
    return any_mesh  # type: ignore[return-value]


def expect_no_options_of_triangles(function: Callable[..., Any], **given: Any) -> None:
    """TypeError for the first of these arguments whose value is not its default in the function, or None."""
    _refuse("for triangles alone", function, given)


def expect_no_options_of_planes(function: Callable[..., Any], **given: Any) -> None:
    """Raises TypeError if an option is given that curved surfaces do not have."""
    _refuse("not for curved surfaces", function, given)


def _refuse(why: str, function: Callable[..., Any], given: dict[str, Any]) -> None:
    parameters = inspect.signature(function).parameters
    for name, value in given.items():
        default = parameters[name].default if name in parameters else None
        if value is not default and (default is None or value != default):
            raise TypeError(f"{name} is {why}. Next: leave it out")
