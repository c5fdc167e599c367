"""Cells of finite volumes as polygons: power cells or triangles, for maps and for MODFLOW."""

from __future__ import annotations

import dataclasses
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh
from ._records import Record


@dataclasses.dataclass(frozen=True, eq=False)
class CellPolygons(Record):
    """Cells as polygons whose corners are shared points. There are n cells, one for each vertex or triangle, and k
    polygons. A cell has one polygon, several that do not overlap, or none if it lies outside the domain. All arrays are
    read-only views on one value, without copies."""

    cells: Literal["power", "triangles"]
    points: npt.NDArray[np.float64]
    """Corners of polygons, each once, (p, 2); on a sphere (p, 3), at its radius [length]."""
    connectivity: npt.NDArray[np.uint32]
    """Points of the polygons, one polygon after the other, counter-clockwise."""
    offsets: npt.NDArray[np.uint64]
    """Starts of the polygons, (k + 1,): polygon i has ``connectivity[offsets[i]:offsets[i + 1]]``."""
    cell: npt.NDArray[np.uint32]
    """Cell of each polygon, (k,), ascending."""
    center: npt.NDArray[np.float64]
    """Center of each cell, (n, 2) or (n, 3): the vertex, or the orthocenter of the triangle [length]."""
    area: npt.NDArray[np.float64]
    """Area of all polygons of each cell, (n,) [length²]. Sum: the area of the domain."""
    region: npt.NDArray[np.int32]
    """Region of each cell, (n,). For a power cell in several regions: the one with the largest part of its area."""
    region_share: npt.NDArray[np.float64]
    """Part of each cell's area that lies in its region, (n,), from 0 to 1."""
    name: list[str]
    """Name of each cell: for a power cell the names of its vertex, such as of a well, else empty."""
    polygon_area: npt.NDArray[np.float64]
    """Area of each polygon, (k,), > 0 [length²]."""
    faces: npt.NDArray[np.uint32]
    """Cells of each common face, (f, 2), the lower number first; ascending. None on a sphere."""
    face_width: npt.NDArray[np.float64]
    """Width of each face, (f,), > 0 [length]."""
    face_distances: npt.NDArray[np.float64]
    """Distances from the two centers to the line of the face, (f, 2), each > 0 if the center is on the side of its
    cell [length]."""
    _mesh: Mesh = dataclasses.field(repr=False, compare=False)

    def __reduce__(self) -> Any:
        return _polygons_of, (self._mesh.copy(), self.cells)

    def polygons(self) -> list[npt.NDArray[np.float64]]:
        """The corners of each polygon, k arrays (corners, 2) or (corners, 3)."""
        if not len(self.cell):
            return []
        return np.split(self.points[self.connectivity], self.offsets[1:-1].astype(np.int64))

    def to_geodataframe(self, crs: Any = None) -> Any:
        """Converts to a ``geopandas.GeoDataFrame`` with a row for each cell that has polygons. Needs GeoPandas.

        Parameters
        ----------
        crs : optional
            Coordinate system of the points, as GeoPandas takes it, such as ``"EPSG:25832"``. A mesh does not know it.

        Returns
        -------
        geopandas.GeoDataFrame
            Columns ``region``, ``region_share``, ``name``, ``area``, ``center_x``, ``center_y`` and ``geometry``. The
            index is the number of the cell.

        Raises
        ------
        ValueError
            Cells on a sphere, whose points are not in a plane.
        """
        import geopandas
        import shapely

        if self.points.shape[1] != 2:
            raise ValueError("to_geodataframe: expected cells in a plane, found cells on a sphere. Next: temper.write(path, mesh, cells='power')")
        starts, index = np.unique(self.cell, return_index=True)
        shapes = [shapely.Polygon(corners) for corners in self.polygons()]
        ends = np.append(index[1:], len(shapes))
        parts = [shapes[first:end] for first, end in zip(index, ends)]
        columns = {
            "region": self.region[starts],
            "region_share": self.region_share[starts],
            "name": [self.name[i] for i in starts],
            "area": self.area[starts],
            "center_x": self.center[starts, 0],
            "center_y": self.center[starts, 1],
        }
        geometry = [part[0] if len(part) == 1 else shapely.MultiPolygon(part) for part in parts]
        return geopandas.GeoDataFrame(columns, geometry=geometry, crs=crs, index=starts)

    def gridprops(self) -> dict[str, Any]:
        """The arguments of ``flopy.mf6.ModflowGwfdisv`` that describe the cells: ``ncpl``, ``nvert``, ``vertices`` and
        ``cell2d``. Cell i of FloPy is cell i here. Corners are clockwise, as in MODFLOW.

        Raises
        ------
        ValueError
            A cell that is not one polygon, which DISV needs; cells on a sphere.

        Examples
        --------
        >>> import temper
        >>> mesh = temper.generate.annulus()
        >>> report = temper.optimize(mesh)
        >>> grid = temper.power_cells(mesh).gridprops()
        >>> grid["ncpl"] == mesh.n_vertices
        True
        """
        if self.points.shape[1] != 2:
            raise ValueError("gridprops: expected cells in a plane, found cells on a sphere")
        wrong = np.flatnonzero(np.bincount(self.cell, minlength=len(self.area)) != 1)
        if len(wrong):
            raise ValueError(f"gridprops: the cell of vertex {wrong[0]} is not one polygon, which DISV needs. Next: temper.columns(...).write writes DISU")
        ends = self.offsets.astype(np.int64)
        corners = [self.connectivity[a:b][::-1].tolist() for a, b in zip(ends, ends[1:])]
        return {
            "ncpl": len(corners),
            "nvert": len(self.points),
            "vertices": [[i, x, y] for i, (x, y) in enumerate(self.points.tolist())],
            "cell2d": [[i, x, y, len(c), *c] for i, ((x, y), c) in enumerate(zip(self.center.tolist(), corners))],
        }


def power_cells(mesh: MeshLike) -> CellPolygons:
    """The power cells of a mesh within its domain, as polygons with their regions, areas and centers.

    Parameters
    ----------
    mesh : MeshLike
        A mesh of triangles in any space.

    Returns
    -------
    CellPolygons
        Cell i is the cell of vertex i. In any mesh the cells are disjoint and cover the domain.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.annulus()
    >>> cells = temper.power_cells(mesh)
    >>> bool(abs(cells.area.sum() - temper.dec_operators(mesh).areas.sum()) < 1e-9)
    True
    """
    return _polygons_of(as_mesh(mesh), "power")


def triangle_cells(mesh: MeshLike) -> CellPolygons:
    """The triangles of a mesh as cells, with their orthocenters as centers.

    Two-point fluxes between orthocenters need all ``face_distances`` above 0. ``temper.optimize(mesh, target="cell")``
    makes such meshes.

    Parameters
    ----------
    mesh : MeshLike
        A mesh of triangles in any space.

    Returns
    -------
    CellPolygons
        Cell i is triangle i.
    """
    return _polygons_of(as_mesh(mesh), "triangles")


def _polygons_of(mesh: Mesh, cells: Literal["power", "triangles"]) -> CellPolygons:
    arrays = _temper.cell_polygons(mesh._handle, cells)
    names: list[str] = [""] * len(arrays["area"])
    if cells == "power":
        file = mesh._file()
        of_tag: dict[int, list[str]] = {}
        for dimension, tag, name in file["names"]:
            if dimension == 0:
                of_tag.setdefault(tag, []).append(name)
        for point, tag in zip(file["marked_points"].tolist(), file["point_tags"].tolist()):
            for name in of_tag.get(tag, []):
                names[point] += f"; {name}" if names[point] else name
    return CellPolygons(cells=cells, name=names, _mesh=mesh.copy(), **arrays)
