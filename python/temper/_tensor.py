"""A constant diffusion tensor: meshes in the plane of its metric, and back."""

from __future__ import annotations

from typing import Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh


def mapped(mesh: MeshLike, tensor: Sequence[float]) -> Mesh:
    """The mesh in the plane where a constant diffusion tensor K is a number: what is a right angle there is one in the
    metric K⁻¹, as two-point fluxes of −div(K ∇u) need it.

    Parameters
    ----------
    mesh : Mesh or meshio.Mesh
        In the plane.
    tensor : sequence of float
        kxx, kxy, kyy: symmetric, positive definite.

    Returns
    -------
    Mesh
        The same numbers, flags and weights, places times (det K)^¼ K^−½: areas are the same. Without the data of a file.

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
    """A mesh that was ``mapped`` and changed, in the plane of the one that it comes from, with the data of its file.

    Vertices that are where ``original`` has them, as those of the boundary and fixed ones, get their places from there,
    bit for bit.

    Parameters
    ----------
    changed, original : Mesh or meshio.Mesh
    tensor : sequence of float
        That of ``mapped``.
    vertices : array_like of int, optional
        The number in ``original`` of each vertex, −1 for none: ``OptimizeReport.vertices``. By default, and when empty, the
        same numbers.
    """
    numbers = np.asarray([] if vertices is None else vertices, dtype=np.int64)
    return Mesh._of(_temper.mapped_back(as_mesh(changed)._handle, as_mesh(original)._handle, tuple(tensor), numbers))
