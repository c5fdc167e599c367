"""Triangle geometry of the power diagram, and the exact predicates, over arrays.

Points are (…, 2), or (…, 3) with the weight last; two columns mean weight 0. Arguments are broadcast against each
other, and results have the shape that remains. Triangle ijk is counter-clockwise. h_k is positive on the left of i → j.
d_ij = ℓ/2 + (w_i − w_j)/(2ℓ) is measured from i towards j (docs/reference/symbols.md). Signs are −1, 0 or 1, int8.
They are right for all doubles in the range of ``is_exact_coordinate`` and ``is_exact_weight``.

On a sphere, with ``space=mesh.space``, points are ``mesh.weighted_vectors``, (…, 3): directions whose squared lengths
are R² + w (``temper.Space``). Triangles are counter-clockwise as seen from outside. Lengths and heights are arcs in
radians, signed as in the plane. Only the directions and the ratios of lengths count, not the radius.
"""

from __future__ import annotations

from typing import Any, Callable

import numpy as np
import numpy.typing as npt

from . import _temper
from ._space import Space

__all__ = [
    "arc_length", "corner_angle", "doubled_area", "dual_crossing", "dual_crossing_sign", "is_exact_coordinate",
    "is_exact_weight", "is_well_centered", "orientation", "orthocenter", "power_test",
    "power_test_perturbed", "scaled_heights", "signed_height", "signed_height_sign", "solid_angle",
]  # fmt: skip

_PLANE = Space()
_SPHERE = Space.sphere(1)  # any


def _vertices(points: npt.ArrayLike, name: str, space: Space) -> npt.NDArray[np.float64]:
    """Three numbers per vertex."""
    array = np.asarray(points, dtype=np.float64)
    columns, shapes = ((2, 3), "(…, 2) or (…, 3)") if space.is_plane else ((3,), "(…, 3)")
    if array.ndim == 0 or array.shape[-1] not in columns:
        raise ValueError(f"{name}: expected shape {shapes}, found {array.shape}")
    if array.shape[-1] == 2:
        array = np.concatenate([array, np.zeros((*array.shape[:-1], 1))], axis=-1)
    return array


def _over(function: Callable[..., Any], space: Space, *more: Any, **points: npt.ArrayLike) -> Any:
    arrays = np.broadcast_arrays(*(_vertices(p, name, space) for name, p in points.items()))
    shape = arrays[0].shape[:-1]
    flat = [np.ascontiguousarray(a.reshape(-1, 3)) for a in arrays]
    result = function(*flat, *more)
    return result.reshape(shape + result.shape[1:])[()]


def _in(space: Space, function: Callable[..., Any], **points: npt.ArrayLike) -> Any:
    """Calls functions of either space."""
    return _over(function, space, not space.is_plane, **points)


def orientation(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """Returns 1 if p, q, r turn counter-clockwise; on a sphere as seen from outside, by the sign of det(P, Q, R).
    Exact.

    >>> from temper import geometry
    >>> int(geometry.orientation((0, 0), (1, 0), (0, 1)))
    1
    """
    return _in(space, _temper.orientation, p=p, q=q, r=r)


def power_test(
    a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike, *, space: Space = _PLANE
) -> Any:
    """Power test for a, b, c counter-clockwise (eq. 9 of the paper). Exact. 1: d conflicts, so that the edge between
    abc and d is not regular. 0: all four are cocircular in the power sense. −1: the edge is regular."""
    return _in(space, _temper.power_test, a=a, b=b, c=c, d=d)


def power_test_perturbed(
    a: npt.ArrayLike,
    b: npt.ArrayLike,
    c: npt.ArrayLike,
    d: npt.ArrayLike,
    index: npt.ArrayLike,
    *,
    space: Space = _PLANE,
) -> Any:
    """``power_test`` with ties broken by the vertices' numbers, ``index`` (…, 4). Returns 0 only if all four points are
    collinear, or on a great circle."""
    arrays = [_vertices(p, name, space) for name, p in (("a", a), ("b", b), ("c", c), ("d", d))]
    shape = np.broadcast_shapes(*(array.shape for array in arrays))[:-1]
    numbers = np.broadcast_to(np.asarray(index), (*shape, 4)).reshape(-1, 4)
    more = (np.ascontiguousarray(numbers, dtype=np.uint32), not space.is_plane)
    return _over(_temper.power_test_perturbed, space, *more, a=a, b=b, c=c, d=d)


def signed_height_sign(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """Sign of h, the signed height of the orthocenter of the counter-clockwise triangle pqr over its edge pq. Exact."""
    return _in(space, _temper.signed_height_sign, p=p, q=q, r=r)


def dual_crossing_sign(p: npt.ArrayLike, q: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """Sign of d_pq = (ℓ² + w_p − w_q)/(2ℓ); on a sphere the sign of P · (P − Q). Exact."""
    return _in(space, _temper.dual_crossing_sign, p=p, q=q)


def is_well_centered(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """Says whether all h > 0 and all 0 < d < ℓ, and the triangle is counter-clockwise. Exact."""
    return _in(space, _temper.is_well_centered, p=p, q=q, r=r)


def is_exact_coordinate(x: float) -> bool:
    """Says whether predicates are exact with this coordinate: 0, or of magnitude 2^−214 to 2^250."""
    return _temper.is_exact_coordinate(x)


def is_exact_weight(w: float) -> bool:
    """Says whether predicates are exact with this weight: 0, or of magnitude 2^−428 to 2^500."""
    return _temper.is_exact_weight(w)


def orthocenter(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """The point of equal power to p, q and r, (…, 2); on a sphere its direction, of length 1, (…, 3)."""
    return _in(space, _temper.orthocenter, p=p, q=q, r=r)


def dual_crossing(p: npt.ArrayLike, q: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """d_pq: distance from p, towards q, of the weighted midpoint [length; on a sphere radians]."""
    return _in(space, _temper.dual_crossing, p=p, q=q)


def signed_height(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """Signed distance h from edge pq to the orthocenter of pqr, positive on the left of p → q [length; on a sphere
    radians]."""
    return _in(space, _temper.signed_height, p=p, q=q, r=r)


def scaled_heights(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike) -> Any:
    """The products h ℓ of the three edges qr, rp, pq, (…, 3) [length²]. Their sum is twice the area."""
    return _over(_temper.scaled_heights, _PLANE, p=p, q=q, r=r)


def doubled_area(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike) -> Any:
    """Twice the signed area [length²]."""
    return _over(_temper.doubled_area, _PLANE, p=p, q=q, r=r)


def arc_length(p: npt.ArrayLike, q: npt.ArrayLike) -> Any:
    """On a sphere: the arc between the directions of p and q [radians], 0 to π.

    >>> from temper import geometry
    >>> float(geometry.arc_length((1, 0, 0), (0, 0, 2)))
    1.5707963267948966
    """
    return _over(_temper.arc_length, _SPHERE, p=p, q=q)


def solid_angle(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike) -> Any:
    """The solid angle of a triangle on a sphere, its spherical excess [steradians]. It is positive if p, q, r turn
    counter-clockwise as seen from outside. The area of the triangle is R² times this."""
    return _over(_temper.solid_angle, _SPHERE, p=p, q=q, r=r)


def corner_angle(p: npt.ArrayLike, q: npt.ArrayLike, r: npt.ArrayLike, *, space: Space = _PLANE) -> Any:
    """The angle at p [radians]; on a sphere between the arcs to q and to r."""
    return _in(space, _temper.corner_angle, p=p, q=q, r=r)
