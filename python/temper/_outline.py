"""From an outline to a mesh with only well-centered triangles."""

from __future__ import annotations

import dataclasses
import os
import warnings
from typing import Any, Callable, Literal, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._errors import TemperWarning
from ._mesh import Mesh, _doubles, _ints, _tags
from ._optimize import _observer
from ._options import OptimizeOptions, options_for
from ._progress import Line
from ._records import Record, expect
from ._reports import OptimizeReport, Progress
from .size import SizeField


@dataclasses.dataclass
class Outline:
    """The area to mesh: points, segments between them, and the areas that they enclose.

    Segments may be long or short, enclose holes and islands, separate regions, end anywhere inside, or branch. Points
    keep their place, bit for bit, in every mesh of the outline; points of no segment become fixed vertices.
    """

    points: npt.ArrayLike
    """Coordinates, (n, 2) float64 [length]."""
    segments: npt.ArrayLike
    """Numbers of the two end points, (k, 2) int."""
    segment_tags: npt.ArrayLike | None = None
    """Boundary markers, (k,) int32, which the edges of each segment carry; None: 0."""
    holes: npt.ArrayLike | None = None
    """A place in each hole, (h, 2)."""
    regions: Sequence[tuple[float, float, int, float | None]] = ()
    """x, y, region number, and the desired edge length or None, for everything that can be reached from (x, y)."""
    parts: Sequence[tuple[int, Sequence[int], float | None]] = ()
    """Region number, segments of its boundary, edge length or None. If there are any, they alone define the inside."""
    point_tags: npt.ArrayLike | None = None
    """Point and tag, (t, 2) int32. Vertices of these points are fixed and carry the tag."""
    further_tags: npt.ArrayLike | None = None
    """Segment and tag, (t, 2) int32, of segments that have more than one tag."""
    groups: Sequence[tuple[int, int, str]] = ()
    """Dimension, tag and name, for ``Mesh.names``: dimension 0 for points, 1 for segments, 2 for regions."""
    sizes: Sequence[tuple[int, int, float]] = ()
    """Two points and a size, > 0 [length]: desired edge length along the line between them, or at a point that is given
    twice. Away from it lengths grow by the grade."""
    rings: Sequence[tuple[Sequence[int], int]] = ()
    """Segments of each ring of polygons, and the ring around it, or −1 for shells. They only serve checks."""
    faces: npt.ArrayLike | None = None
    """Numbers of the segments that become faces of power cells, (f,) int. Others become edges of triangles."""
    _names: Any = dataclasses.field(default=None, repr=False)
    _degrees: Any = dataclasses.field(default=None, repr=False)
    """Projection, and the points before it."""

    def _plain(self) -> dict[str, Any]:
        segments = _ints(self.segments, 2, "segments").astype(np.int32)
        tags = np.zeros(len(segments), dtype=np.int32)
        if self.segment_tags is not None:
            tags = _tags(self.segment_tags, "segment_tags")
        return {
            "points": _doubles(self.points, 2, "points"),
            "segments": segments,
            "segment_tags": tags,
            "holes": _doubles(self.holes, 2, "holes"),
            "regions": [(float(x), float(y), int(number), size) for x, y, number, size in self.regions],
            "parts": [(int(n), _ints(list(s), 0, "parts").astype(np.int32), size) for n, s, size in self.parts],
            "point_tags": _ints(self.point_tags, 2, "point_tags").astype(np.int32),
            "further_tags": _ints(self.further_tags, 2, "further_tags").astype(np.int32),
            "groups": [(int(dimension), int(tag), str(name)) for dimension, tag, name in self.groups],
            "sizes": [(int(a), int(b), float(size)) for a, b, size in self.sizes],
            "rings": [(_ints(list(s), 0, "rings").astype(np.int32), int(shell)) for s, shell in self.rings],
            "faces": _ints(self.faces, 0, "faces").astype(np.int32),
            "names": self._names,
            "degrees": self._degrees,
        }

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Outline:
        names = d.pop("names")
        return cls(**d, _names=names)


@dataclasses.dataclass(frozen=True)
class OutlineFile(Record):
    """The result of ``read_outline``."""

    outline: Outline
    path: str
    format: str
    """``"poly"``, ``"jigsaw"`` or ``"geojson"``."""
    geographic: bool
    """Points are longitude and latitude, in degrees: see ``temper.projection``."""
    warnings: list[str]


def read_outline(path: str | os.PathLike[str]) -> OutlineFile:
    """Reads an outline: Triangle's .poly (with its .node), JIGSAW's geometry, or GeoJSON. Its content decides the
    format."""
    outline, rest = _temper.read_outline(os.fspath(path))
    for message in rest["warnings"]:
        warnings.warn(message, TemperWarning, stacklevel=2)
    return OutlineFile(Outline._of(outline), **rest)


@dataclasses.dataclass(frozen=True, eq=False)
class OutlineMesh(Record):
    """The result of ``mesh_outline`` or ``mesh_sphere``."""

    mesh: Mesh
    """The mesh, with its lines, tags and names as the program writes them."""
    lines: npt.NDArray[np.int32]
    """Each edge on the outline, (k, 2), in the order of the segments: once for each of its tags."""
    line_tags: npt.NDArray[np.int32]
    """Tag of the segment of each line, (k,)."""
    marked: npt.NDArray[np.int32]
    """Vertices that are tagged points, or points of no segment, with their tags, (p, 2)."""
    groups: list[tuple[int, int, str]]
    """Dimension, tag and name of all names."""
    vertex_of_point: npt.NDArray[np.int32]
    """Vertex of each point of the outline; −1 for points outside."""
    bad: int
    """Number of triangles that are not well-centered."""
    delaunay_bad: int
    """Number of such triangles before the optimization."""
    attempts: int
    """Number of divisions of the outline that were tried."""
    report: OptimizeReport = dataclasses.field(repr=False)
    """Report of the optimization, from the attempt that was kept."""
    notes: list[str]
    warnings: list[str]
    """Narrow places, and points that are lost; also given as ``TemperWarning``."""


def mesh_outline(
    outline: Outline,
    size: float | SizeField | None,
    *,
    grade: float = 0.3,
    region_sizes: Mapping[int, float] | None = None,
    enclosed: Literal["by_points", "all", "alternate"] = "by_points",
    snap: float | None = None,
    drop_below: float = 0.0,
    split_crossings: bool = False,
    target: str = "any",
    optimize: OptimizeOptions | bool = True,
    attempts: int = 8,
    most_triangles: int = 200_000_000,
    memory: int | None = None,
    time_limit: float = 0.0,
    threads: int | None = None,
    observer: Callable[[Progress], Any] | None = None,
    progress: bool | None = None,
) -> OutlineMesh:
    """Meshes the inside of an outline, and optimizes the mesh until every triangle is well-centered.

    Parameters
    ----------
    outline : Outline
    size : float or SizeField or None
        Desired edge length, > 0 [length]. None: there are no sizes, and the mesh has as few vertices as the search finds
        until the time limit.
    grade : float
        Largest growth rate of the size with the distance from smaller edges, > 0.
    region_sizes : mapping of region number to size, optional
        Desired edge lengths of these regions, if less than ``size``.
    enclosed : {"by_points", "all", "alternate"}
        Area that an outline without parts encloses. ``all``: everything that segments enclose, except the holes (as in
        Triangle). ``alternate``: nested loops alternate. ``by_points``: ``all`` if there are hole or region points,
        else ``alternate``.
    snap : float, optional
        Tolerance of joins [length]: points that are nearer to each other, or to a segment, are joined. 0: nothing is
        joined. None: 1e-9 of the extent of the outline, or 1e-7 of the radius of the sphere.
    drop_below : float
        Rings of polygons whose extent is less, such as small islands, are left out, and so are rings that ``snap``
        leaves nothing of.
    split_crossings : bool
        Divide segments where they cross, and leave out what is outside. Else crossings are errors.
    target : str
        Use of the mesh, as in ``options_for``. A target without weights, such as "mpas", makes a mesh without weights.
    optimize : OptimizeOptions or bool
        Options of the optimization, instead of those for the target; False: the Delaunay mesh is returned.
    attempts : int
        Largest number of divisions of the outline while triangles stay bad.
    most_triangles : int
        Largest number of triangles; sizes that would make more are refused.
    memory : int, optional
        Memory that the call may take [bytes]; meshes that would need more are refused. None: the free memory of the
        machine, or of the limits of the process and its container.
    time_limit : float
        Time limit of the whole call [s]; 0: none.
    threads, observer, progress
        The same as in ``optimize``.

    Raises
    ------
    TemperError
        An error in the outline, by its names, or in the sizes. The ``code`` "stopped" means that there was no mesh yet
        when the time limit was reached.
    KeyboardInterrupt

    Examples
    --------
    >>> import temper
    >>> square = temper.Outline([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> temper.mesh_outline(square, 0.2).bad
    0
    """
    joins = (snap, drop_below, split_crossings)
    options = _mesher_options(size, grade, region_sizes, joins, attempts, (most_triangles, memory), time_limit, enclosed)
    return _meshed(_temper.mesh_outline, expect("outline", outline, Outline)._plain(), options, target, optimize, threads, observer, progress)


def mesh_sphere(
    size: float | SizeField,
    *,
    basins: Outline | None = None,
    coasts: Outline | None = None,
    lines: Outline | None = None,
    radius: float | None = None,
    grade: float = 0.3,
    region_sizes: Mapping[int, float] | None = None,
    snap: float | None = None,
    drop_below: float = 0.0,
    split_crossings: bool = False,
    target: str = "any",
    optimize: OptimizeOptions | bool = True,
    attempts: int = 8,
    most_triangles: int = 200_000_000,
    memory: int | None = None,
    time_limit: float = 0.0,
    threads: int | None = None,
    observer: Callable[[Progress], Any] | None = None,
    progress: bool | None = None,
) -> OutlineMesh:
    """Meshes a sphere, or the part outside the coasts, and optimizes the mesh until every triangle is well-centered.

    Points of outlines are longitude and latitude [degrees], and their segments are the shorter arcs of great circles. A
    closed line encloses the smaller of its two sides, in either direction.

    Parameters
    ----------
    size : float or SizeField
        Desired edge length, > 0 [length].
    basins : Outline, optional
        Closed lines around the area to mesh; None: the whole sphere.
    coasts : Outline, optional
        Closed lines around areas to leave out.
    lines : Outline, optional
        Rivers and other lines that become constrained edges.
    radius : float, optional
        Radius of the sphere [length]; None: the radius of the size field, or 6371000.
    grade, region_sizes, snap, drop_below, split_crossings, target, optimize, attempts, most_triangles, memory,
    time_limit, threads, observer, progress
        The same as in ``mesh_outline``.

    Returns
    -------
    OutlineMesh
        The mesh. Its ``vertex_of_point`` has the points of basins, coasts and lines, in this order.

    Raises
    ------
    TemperError
        The errors of ``mesh_outline``; also coasts that are not closed, divide the sphere into halves, or leave nothing
        of it.
    KeyboardInterrupt

    Examples
    --------
    >>> import temper
    >>> island = temper.Outline([(0, 0), (40, 5), (35, 40), (5, 30)], [(0, 1), (1, 2), (2, 3), (3, 0)])
    >>> temper.mesh_sphere(1e6, coasts=island).bad
    0
    """
    if radius is None:
        radius = size.mesh.space.radius if isinstance(size, SizeField) else 6371000.0
    nothing = Outline([], [])
    sphere = {
        "radius": float(radius),
        "basins": expect("basins", basins or nothing, Outline)._plain(),
        "coasts": expect("coasts", coasts or nothing, Outline)._plain(),
        "lines": expect("lines", lines or nothing, Outline)._plain(),
    }
    joins = (snap, drop_below, split_crossings)
    options = _mesher_options(size, grade, region_sizes, joins, attempts, (most_triangles, memory), time_limit)
    return _meshed(_temper.mesh_sphere, sphere, options, target, optimize, threads, observer, progress)


def _mesher_options(
    size: float | SizeField | None,
    grade: float,
    region_sizes: Mapping[int, float] | None,
    joins: tuple[float | None, float, bool],
    attempts: int,
    limits: tuple[int, int | None],
    time_limit: float,
    enclosed: str = "by_points",
) -> dict[str, Any]:
    field = size._handle if isinstance(size, SizeField) else None
    return {
        "size": 0.0 if size is None or isinstance(size, SizeField) else float(size),
        "few_points": size is None,
        "field": field,
        "grade": float(grade),
        "region_sizes": [(int(r), float(s)) for r, s in (region_sizes or {}).items()],
        "enclosed": enclosed,
        "snap": None if joins[0] is None else float(joins[0]),
        "drop_below": float(joins[1]),
        "split_crossings": joins[2],
        "attempts": attempts,
        "most_triangles": limits[0],
        "memory": limits[1],
        "time_limit": float(time_limit),
    }


def _meshed(
    mesher: Callable[..., Any],
    outline: dict[str, Any],
    options: dict[str, Any],
    target: str,
    optimize: OptimizeOptions | bool,
    threads: int | None,
    observer: Callable[[Progress], Any] | None,
    progress: bool | None,
) -> OutlineMesh:
    if isinstance(optimize, bool):
        plain = options_for(target)._plain() if optimize else None
    elif target != "any":
        raise ValueError("expected target or optimize, found both")
    else:
        plain = optimize._plain()
    line = Line(progress)
    try:
        handle, rest = mesher(outline, options, plain, threads, _observer(line, observer))
    finally:
        line.clear()
    for message in rest["warnings"]:
        warnings.warn(message, TemperWarning, stacklevel=3)
    return OutlineMesh(**rest, mesh=Mesh._of(handle))
