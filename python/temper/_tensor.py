"""A constant diffusion tensor: meshes in the plane of its metric, and back."""

from __future__ import annotations

from typing import Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh


def mapped(mesh: MeshLike, tensor: Sequence[float]) -> Mesh:
    """Maps a mesh to the plane in which a constant diffusion tensor K becomes a number. A right angle there is a right
    angle in the metric K⁻¹, as two-point fluxes of −div(K ∇u) need it.

    Parameters
    ----------
    mesh : MeshLike
        A mesh in the plane.
    tensor : sequence of float
        kxx, kxy, kyy: symmetric, positive definite.

    Returns
    -------
    Mesh
        A mesh with the same numbers, flags and weights, and places times (det K)^¼ K^−½. Areas do not change. It is
        without the data of a file.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.random_mesh(200)
    >>> report = temper.optimize(mesh, tensor=(1, 0, 100))
    >>> temper.quality(temper.mapped(mesh, (1, 0, 100))).well_centered_fraction
    1.0
    """
    return Mesh._of(_temper.mapped(as_mesh(mesh)._handle, tuple(tensor)))


def mapped_back(
    changed: MeshLike, original: MeshLike, tensor: Sequence[float], vertices: npt.ArrayLike | None = None
) -> Mesh:
    """Maps a changed mesh back to the plane of ``original``, with the data of its file.

    Vertices at the same place as in ``mapped(original)``, such as boundary and fixed vertices, get their places from
    ``original``, bit for bit.

    Parameters
    ----------
    changed, original : MeshLike
    tensor : sequence of float
        The tensor of ``mapped``.
    vertices : array_like of int, optional
        Number of each vertex in ``original``, −1 for none: ``OptimizeReport.vertices``. None or empty: the same
        numbers.
    """
    numbers = np.asarray([] if vertices is None else vertices, dtype=np.int64)
    return Mesh._of(_temper.mapped_back(as_mesh(changed)._handle, as_mesh(original)._handle, tuple(tensor), numbers))
