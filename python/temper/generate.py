"""Example meshes: the meshes of the paper, and the classes of meshes on which a method should be tested.

Each is made here, from its parameters and a seed, by a constrained Delaunay triangulation with temper's own predicates.
``graded_sphere``, ``icosahedral``, ``random_sphere`` and ``spherical_delaunay`` are on the sphere. Meshes with
``periodic`` in their name are in periodic planes. All weights are zero. TemperError names a parameter that makes no
sense.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, _doubles, _ints
from ._records import pair

__all__ = [
    "airfoil", "annulus", "constrained_delaunay", "graded_mesh", "graded_sphere", "graded_sphere_size",
    "horseshoe", "icosahedral", "letter_a", "periodic_delaunay", "periodic_hexagons", "random_periodic",
    "random_mesh", "random_sphere", "regular_polygon", "sheared_grid", "single_triangle", "sparse_horseshoe",
    "spherical_delaunay", "wedge",
]  # fmt: skip


def constrained_delaunay(points: npt.ArrayLike, segments: npt.ArrayLike | None = None, *, carve: bool = True) -> Mesh:
    """The constrained Delaunay triangulation of points.

    Parameters
    ----------
    points : (n, 2) float64
        Coordinates; points keep their numbers.
    segments : (k, 2) int, optional
        Constrained edges, as pairs of points. A segment through other points becomes a chain of edges.
    carve : bool
        Drop the triangles outside the outermost closed segments, and inside holes (by parity). If False, or without
        segments, the result is the convex hull.

    Raises
    ------
    TemperError
        An error, with the number of the element. Points: fewer than three, all on one line, not finite, two at one
        place, or outside. Segments: out of range, of zero length, crossing, or enclosing nothing. The domain must not
        touch itself at a point.
    """
    ends = _ints(segments, 2, "segments").astype(np.int64)
    return Mesh._of(_temper.constrained_delaunay(_doubles(points, 2, "points"), ends, carve))


def sparse_horseshoe() -> Mesh:
    """The paper's sparse horseshoe (fig. 11 left): 5 vertices, 4 triangles."""
    return Mesh._of(_temper.sparse_horseshoe())


def horseshoe(
    a: int = 7, b: int = 9, x: tuple[float, float] = (1.0, 2.0), y: tuple[float, float] = (1.0, 4.0)
) -> Mesh:
    """The parameterized horseshoe (§6.5) with a × b points. x and y are the semi-axes of the inner and the outer
    arch."""
    return Mesh._of(_temper.horseshoe(a, b, *x, *y))


def single_triangle(a: float = 0.5, b: float = 1.0, angle_deg: float = 120.0) -> Mesh:
    """Triangle with sides of length a and b from vertex 0, and an angle in degrees between them (§3.1.2, fig. 9)."""
    return Mesh._of(_temper.single_triangle(a, b, angle_deg))


def random_mesh(vertices: int = 1000, seed: int = 1, polygon: npt.ArrayLike | None = None) -> Mesh:
    """Uniformly random points in a polygon, (k, 2), counter-clockwise; ``vertices`` is their number in all. The default
    is a non-convex L shape with a notch. About half of the triangles are bad."""
    return Mesh._of(_temper.random_mesh(vertices, seed, _doubles(polygon, 2, "polygon")))


def spherical_delaunay(points: npt.ArrayLike, radius: float = 1.0) -> Mesh:
    """The Delaunay triangulation of points around the sphere: the convex hull of the points at the radius.

    Parameters
    ----------
    points : (n, 3) float64
        Directions, of any length; points keep their numbers.
    radius : float
        Radius of the sphere [length].

    Raises
    ------
    TemperError
        An error, with the number of the point: no direction, or two in one direction. Points must not leave half of the
        sphere empty.
    """
    return Mesh._of(_temper.spherical_delaunay(_doubles(points, 3, "points"), radius))


def icosahedral(level: int = 4, radius: float = 1.0) -> Mesh:
    """The icosahedron on a sphere of this radius [length], with each triangle cut into four, ``level`` times: 10 ·
    4^level + 2 vertices."""
    return Mesh._of(_temper.icosahedral(level, radius))


def periodic_delaunay(points: npt.ArrayLike, period: tuple[float, float] = (1.0, 1.0)) -> Mesh:
    """The Delaunay triangulation of points, (n, 2), in a plane that is periodic along both axes. Points may be any
    images, and keep their numbers. TemperError if there are too few for triangles that fit into half a period."""
    return Mesh._of(_temper.periodic_delaunay(_doubles(points, 2, "points"), *pair("period", period)))


def random_periodic(vertices: int = 1000, seed: int = 1, period: tuple[float, float] = (1.0, 1.0)) -> Mesh:
    """Delaunay triangulation of uniformly random points in a periodic plane. About half of the triangles are bad."""
    return Mesh._of(_temper.random_periodic(vertices, seed, *pair("period", period)))


def periodic_hexagons(nx: int = 16, ny: int = 16, distance: float = 1.0, channel: bool = False) -> Mesh:
    """A periodic plane with ``ny`` rows of ``nx`` hexagons as power cells. The distances between neighboring vertices
    are equal [length]. A channel has no period along y."""
    return Mesh._of(_temper.periodic_hexagons(nx, ny, distance, channel))


def random_sphere(vertices: int = 1000, seed: int = 1, radius: float = 1.0) -> Mesh:
    """Delaunay triangulation of uniformly random points around a sphere of this radius [length]. About half of the
    triangles are bad."""
    return Mesh._of(_temper.random_sphere(vertices, seed, radius))


def graded_sphere(
    vertices: int = 10000,
    ratio: float = 30.0,
    at: tuple[float, float] = (0.0, 0.0),
    seed: int = 1,
    radius: float = 1.0,
) -> Mesh:
    """Delaunay triangulation of random points around a sphere of this radius [length]. Sizes grow by ``ratio``, 1 to
    1000, from a place at longitude and latitude ``at`` [degrees] to the opposite place. About half of the triangles are
    bad."""
    return Mesh._of(_temper.graded_sphere(vertices, ratio, *pair("at", at), seed, radius))


def graded_sphere_size(
    directions: npt.ArrayLike,
    vertices: int = 10000,
    ratio: float = 30.0,
    at: tuple[float, float] = (0.0, 0.0),
    radius: float = 1.0,
) -> npt.NDArray[np.float64]:
    """The sizes that the points of ``graded_sphere`` follow [length], (k,), in (k, 3) directions of any length. They
    are the edges of equilateral triangles of the same number."""
    return _temper.graded_sphere_size(vertices, ratio, *pair("at", at), radius, _doubles(directions, 3, "directions"))


def sheared_grid(nx: int = 20, ny: int = 20, shear: float = 0.5) -> Mesh:
    """nx × ny squares, each cut along the same diagonal, then sheared by x += shear · y."""
    return Mesh._of(_temper.sheared_grid(nx, ny, shear))


def annulus(
    inner: float = 0.4, outer: float = 1.0, around: int = 48, rings: int = 6, jitter: float = 0.3, seed: int = 1
) -> Mesh:
    """Rings of points between two circles, with the middle rings turned and jittered."""
    return Mesh._of(_temper.annulus(inner, outer, around, rings, jitter, seed))


def airfoil(around: int = 80, growth: float = 1.25, seed: int = 1) -> Mesh:
    """A box with a hole like an airfoil, graded from fine at the foil to coarse at the box. ``around`` is the number of
    points on the foil. ``growth`` is the ratio of the spacing of one layer to the layer before."""
    return Mesh._of(_temper.airfoil(around, growth, seed))


def regular_polygon(corners: int = 60) -> Mesh:
    """A regular polygon of radius 1 with no vertex inside: hard."""
    return Mesh._of(_temper.regular_polygon(corners))


def letter_a() -> Mesh:
    """A letter A: 29 vertices, 29 triangles, a hole, no vertex inside: hard."""
    return Mesh._of(_temper.letter_a())


def wedge(angle_deg: float = 5.0, pieces: int = 8, seed: int = 1) -> Mesh:
    """A triangle with a sharp corner between two sides of length 1. Each of these sides has ``pieces`` edges, and there
    are as many random points inside."""
    return Mesh._of(_temper.wedge(angle_deg, pieces, seed))


def graded_mesh(finest: float = 1.0 / 64, growth: float = 0.2, seed: int = 1) -> Mesh:
    """Random points in the unit square. Their size grows with the distance from a corner: finest + growth ·
    distance."""
    return Mesh._of(_temper.graded_mesh(finest, growth, seed))
