"""The weighted triangle mesh of a curved surface."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Triangles, _doubles, _ints, _tags, _warn, triangles_of
from ._others import meshio_of


class SurfaceMesh(Triangles):
    """A triangle mesh of a curved surface, closed or with boundary, whose vertices carry weights. ``read`` makes one if
    points are neither in a plane nor on a sphere.

    Parameters
    ----------
    points : (n, 3) float64
        Positions, in units of your choice.
    triangles : (m, 3) int32 or int64
        Corners, counted from 0. Triangles of one component get one orientation, with a warning if any is reversed.
    weights : (n,) float64, optional
        Squared lengths [length²]. The power of a place p to vertex i is \\|x_i − p\\|² − w_i. Default: all 0.
    constrained_edges : (k, 2) int, optional
        Edges that must stay, as pairs of vertices. Edges between regions are always constrained.
    regions : (m,) int32, optional
        A number for each triangle. Default: all 0.
    fixed : (k,) int, optional
        Vertices that must not move. (Vertices on the boundary and on creases stay without being named.)

    Raises
    ------
    TemperError
        Arrays that make no surface; the message names the element. Numbers are out of range or not finite. Points are in
        no triangle. Triangles have no area. Edges have more than two triangles, the surface touches itself at a vertex,
        or it has only one side.

    Warns
    -----
    TemperWarning
        Triangles that are reversed; points at the place of others.

    Notes
    -----
    Each triangle is plane. Its orthocenter, heights h and crossings d [length] are those of the plane, from three lengths
    and three weights. The dual of an edge has one part in each of its triangles, of length h_k + h_l. Signs are exact.
    ``weights``, ``triangles`` and ``twins`` are read-only views, as in ``Mesh``, and ``points`` is a copy.

    Halfedge 3 t + k runs from corner k to corner k + 1 of triangle t. Triangles are counter-clockwise as seen from one
    side.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.SurfaceMesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(1, 2, 3), (0, 1, 3), (0, 3, 2)])
    >>> mesh, mesh.n_edges
    (<temper.SurfaceMesh: 4 vertices, 3 triangles>, 6)
    >>> temper.quality(mesh).orthocenters_outside  # on longest edges
    2
    """

    __slots__ = ()

    _handle: _temper.SurfaceMesh

    def __init__(
        self,
        points: npt.ArrayLike,
        triangles: npt.ArrayLike,
        weights: npt.ArrayLike | None = None,
        *,
        constrained_edges: npt.ArrayLike | None = None,
        regions: npt.ArrayLike | None = None,
        fixed: npt.ArrayLike | None = None,
    ) -> None:
        lines = _ints(constrained_edges, 2, "constrained_edges")
        arrays = {
            "points": _doubles(points, 3, "points"), "triangles": _ints(triangles, 3, "triangles"),
            "weights": _doubles(weights, 0, "weights"), "regions": _tags(regions, "regions"),
            "lines": lines, "line_tags": np.zeros(len(lines), dtype=np.int32), "marked_points": _ints(None, 0, ""),
            "point_tags": np.empty(0, dtype=np.int32), "names": [],
            **{f"{kind}_data": {} for kind in ("point", "cell", "line", "marked_point", "field")},
        }  # fmt: skip
        self._handle, messages = _temper.surface_from_arrays(arrays, True)
        if len(lines):
            self.set_constrained(lines)
        if fixed is not None:
            self.fixed = fixed
        _warn(self, messages, 2)

    @classmethod
    def _of(cls, handle: _temper.SurfaceMesh) -> SurfaceMesh:
        mesh = cls.__new__(cls)
        mesh._handle = handle
        mesh.warnings = []
        return mesh

    @classmethod
    def from_meshio(cls, mesh: Any) -> SurfaceMesh:
        """A ``meshio.Mesh``, a mesh of PyVista or ``gmsh.model`` as a curved surface, with data as in
        ``temper.from_meshio``. TypeError if its points are in a plane or on a sphere, or for another class."""
        handle, messages = triangles_of(mesh)
        if not isinstance(handle, _temper.SurfaceMesh):
            raise TypeError("expected a curved surface, found points in a plane or on a sphere. Next: temper.as_mesh takes them")
        return _warn(cls._of(handle), messages, 2)

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Positions, (n, 3) float64 [length]. A copy."""
        return self._handle.points()

    @property
    def weights(self) -> npt.NDArray[np.float64]:
        """Weights, (n,) float64 [length²]. A read-only view. Assigning sets all at once, and the triangles stay. O(n)."""
        return self._handle.weights()

    @weights.setter
    def weights(self, weights: npt.ArrayLike) -> None:
        self._handle.set_weights(_doubles(weights, 0, "weights"))

    def to_meshio(self) -> Any:
        """The mesh as a ``meshio.Mesh``, with data and tags as in ``Mesh.to_meshio``. Needs meshio."""
        return meshio_of(self._form())

    def copy(self) -> SurfaceMesh:
        """An independent mesh; the memory is shared until one of the two changes."""
        mesh = SurfaceMesh._of(self._handle.copy())
        mesh.warnings = list(self.warnings)
        return mesh

    def __reduce__(self) -> Any:
        """Everything but the name and the format of the file, for another process. To keep a mesh, write it."""
        marks = (self.constrained_edges, self.fixed, self.point_data_rules, self.cell_data_rules, self.warnings)
        return _unpickle, (self._file(with_data=True), *marks)

    def __repr__(self) -> str:
        return self._shown()


def _unpickle(file: dict[str, Any], constrained: Any, fixed: Any, of_points: Any, of_cells: Any, messages: list[str]) -> SurfaceMesh:
    mesh = SurfaceMesh._of(_temper.surface_from_arrays(file, False)[0])
    mesh.set_constrained(mesh.constrained_edges, False)
    mesh.set_constrained(constrained)
    mesh.fixed, mesh.point_data_rules, mesh.cell_data_rules, mesh.warnings = fixed, of_points, of_cells, messages
    return mesh
