"""Diffusion tensors: of a mesh or of its regions; meshes in the plane of one metric, and back."""

from __future__ import annotations

from typing import Any, Mapping, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh
from ._surfaces import SurfaceMesh
from ._tets import TetMesh

TensorLike = Union[Sequence[float], npt.ArrayLike, Mapping[int, Sequence[float]], Mapping[str, Sequence[float]]]
"""kxx, kxy, kyy of one tensor; one for each triangle, (m, 3); or one for each region by its tag or name. For tetrahedra
kxx, kxy, kxz, kyy, kyz, kzz, and (m, 6)."""

CORNER_WEIGHTS = "corner_weights"
"""Cell data with a weight for each vertex and region: of each corner of each triangle, (m, 3), or tetrahedron, (m, 4)
[length²]."""


def values_of_regions(mesh: Mesh | TetMesh | SurfaceMesh, values: Mapping[Any, Any], what: str) -> npt.NDArray[np.float64]:
    """The value of the region of each triangle or tetrahedron. ``values``: by tag or name."""
    regions, which = np.unique(mesh.regions, return_inverse=True)
    dimension = 3 if isinstance(mesh, TetMesh) else 2
    names = [(name, tag) for of, tag, name in mesh._file()["names"] if of == dimension]
    values_of: dict[Any, Any] = {}
    for region, value in values.items():
        for tag in [tag for name, tag in names if name == region] or [region]:
            if tag in values_of:
                raise ValueError(f"{what}: region {tag} has two values. Next: give one, by the tag or by the name")
            values_of[tag] = value
    missing = [int(r) for r in regions if int(r) not in values_of]
    unknown = [r for r in values_of if isinstance(r, str) or r not in regions]
    if missing or unknown:
        name_of = {tag: name for name, tag in names}
        known = ", ".join(f"{r} ({name_of[r]!r})" if r in name_of else str(r) for r in regions.tolist())
        raise ValueError(
            f"{what}: expected a value for each of the regions {known}; "
            + (f"there is none for {missing}" if missing else f"the mesh has no region {unknown}")
        )
    return np.array([values_of[int(r)] for r in regions], dtype=np.float64)[which]


def plain_tensor(mesh: Mesh | TetMesh | SurfaceMesh, tensor: TensorLike | None) -> tuple[Any, ...] | None:
    """Tensors for the compiled module: three or six numbers, or an array (m, 3) or (m, 6) and the weights of corners."""
    if tensor is None:
        return None
    if isinstance(mesh, SurfaceMesh):
        raise TypeError("tensor is not for curved surfaces. Next: leave it out")
    is_tets = isinstance(mesh, TetMesh)
    names, n = ("kxx, kxy, kxz, kyy, kyz, kzz", 6) if is_tets else ("kxx, kxy, kyy", 3)
    m = mesh.n_tetrahedra if isinstance(mesh, TetMesh) else mesh.n_triangles
    if isinstance(tensor, Mapping):
        values = values_of_regions(mesh, tensor, "tensor")
    else:
        values = np.asarray(tensor, dtype=np.float64)
        if values.ndim == 1 and len(values) == n:
            return tuple(values.tolist())
        if values.ndim == 1:
            raise ValueError(f"tensor: expected {names}, found {len(values)} numbers")
    if values.shape != (m, n):
        cell = "tetrahedron" if is_tets else "triangle"
        raise ValueError(
            f"tensor: expected {names}, or one for each {cell}, shape ({m}, {n}), or a dictionary of regions; "
            f"found shape {values.shape}"
        )
    has_data = isinstance(mesh, TetMesh) or mesh._handle.has_data()
    weights = mesh.cell_data.get(CORNER_WEIGHTS) if has_data else None
    return np.ascontiguousarray(values), np.empty(0) if weights is None else np.ascontiguousarray(weights)


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
