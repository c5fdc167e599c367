"""The report on a primal-dual mesh."""

from __future__ import annotations

import dataclasses
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike
from ._options import LengthParameter, LengthParameterLike, _length_parameter
from ._records import Record
from ._reports import Quality, SurfaceQuality, TetQuality
from ._surfaces import SurfaceMesh
from ._tets import AnyMeshLike, TetMesh, as_any_mesh, as_triangles, expect_no_options_of_planes, expect_no_options_of_triangles


_GAMMA, _H0 = LengthParameter(1.0, "absolute"), LengthParameter(0.0, "absolute")


@overload
def quality(
    mesh: TetMesh, *, gamma: LengthParameterLike = ..., h0: LengthParameterLike = ..., worst: int = ..., threads: int | None = ...
) -> TetQuality: ...
@overload
def quality(
    mesh: SurfaceMesh, *, gamma: LengthParameterLike = ..., h0: LengthParameterLike = ..., worst: int = ..., threads: int | None = ...
) -> SurfaceQuality: ...
@overload
def quality(
    mesh: MeshLike, *, gamma: LengthParameterLike = ..., h0: LengthParameterLike = ..., worst: int = ..., threads: int | None = ...
) -> Quality: ...
def quality(
    mesh: AnyMeshLike,
    *,
    gamma: LengthParameterLike = _GAMMA,
    h0: LengthParameterLike = _H0,
    worst: int = 5,
    threads: int | None = None,
) -> Quality | TetQuality | SurfaceQuality:
    """Measures a mesh: is it valid, regular, well-centered, and with what margins?

    Parameters
    ----------
    mesh : Mesh, TetMesh, SurfaceMesh, or of another library
    gamma, h0 : LengthParameter or float
        Parameters γ of E_BP and −h° of E_BHs in the report; plain numbers are relative to each edge. They are for
        triangles of the plane or the sphere alone.
    worst : int
        Number of the worst triangles or tetrahedra to list.
    threads : int, optional
        Number of threads; None or 0: all of the machine. The report does not depend on it.

    Returns
    -------
    Quality, or TetQuality for tetrahedra, or SurfaceQuality for a curved surface

    Examples
    --------
    >>> import temper
    >>> temper.quality(temper.generate.horseshoe()).orthocenters_outside
    58
    """
    any_mesh = as_any_mesh(mesh)
    if isinstance(any_mesh, TetMesh):
        expect_no_options_of_triangles(quality, gamma=gamma, h0=h0)
        return _temper.tet_quality(any_mesh._handle, worst, threads)
    if isinstance(any_mesh, SurfaceMesh):
        expect_no_options_of_planes(quality, gamma=gamma, h0=h0)
    return _temper.quality(any_mesh._handle, _length_parameter("gamma", gamma), _length_parameter("h0", h0), worst, threads)


@dataclasses.dataclass(frozen=True)
class QualityMeasure(Record):
    """A row of ``quality_measures``: a number of ``Quality``."""

    key: str
    """Name of the number in ``Quality``, in reports and for ``--require``."""
    alias: str
    """Short name for ``--require``, or the name that its community uses; or empty."""
    label: str
    community: str
    """Community whose codes use the measure; empty for measures of primal-dual meshes in general."""
    definition: str
    better: Literal["equal", "larger", "less"]
    count: bool
    wanted: float | None
    """Requirement by default, if the user gives no other."""


def quality_measures(*, tetrahedra: bool = False) -> list[QualityMeasure]:
    """All numbers of ``Quality`` except energies, or of ``TetQuality``.

    >>> import temper
    >>> {row.key: row.wanted for row in temper.quality_measures() if row.community == "D-Flow FM"}
    {'max_orthogonality': 0.01, 'max_smoothness': None, 'min_flow_link': 0.1, 'small_flow_links': 0.0}
    """
    return [QualityMeasure(**row) for row in _temper.quality_measures(tetrahedra)]


@dataclasses.dataclass(frozen=True, eq=False)
class TriangleQuality(Record):
    """Quality of each triangle: arrays (m,), which VTU files have as cell data."""

    well_centered: npt.NDArray[np.bool_]
    """All h > 0 and 0 < d < ℓ, exact."""
    min_h_over_l: npt.NDArray[np.float64]
    """−inf for an inverted triangle."""
    min_d_over_l: npt.NDArray[np.float64]
    """Lesser of d/ℓ and 1 − d/ℓ, least over the edges."""
    min_angle_deg: npt.NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class TetrahedronQuality(Record):
    """Quality of each tetrahedron: arrays (m,), which VTU files have as cell data."""

    well_centered: npt.NDArray[np.bool_]
    """All h > 0, exact."""
    min_h_over_l: npt.NDArray[np.float64]
    """Least h/ℓ over its faces."""
    min_dihedral_deg: npt.NDArray[np.float64]


def tetrahedron_quality(mesh: AnyMeshLike) -> TetrahedronQuality:
    """Measures each tetrahedron: arrays whose least values are in ``quality``.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.TetMesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2, 3)])
    >>> temper.tetrahedron_quality(mesh).min_dihedral_deg.round(2)
    array([54.74])
    """
    any_mesh = as_any_mesh(mesh)
    if not isinstance(any_mesh, TetMesh):
        raise TypeError("expected a mesh of tetrahedra, found triangles. Next: temper.triangle_quality takes them")
    return TetrahedronQuality(**_temper.tetrahedron_quality(any_mesh._handle))


def triangle_quality(mesh: AnyMeshLike) -> TriangleQuality:
    """Measures each triangle: arrays whose least values are in ``quality``.

    Examples
    --------
    >>> import temper
    >>> mesh = temper.generate.horseshoe()
    >>> each = temper.triangle_quality(mesh)
    >>> bool(each.min_angle_deg.min() == temper.quality(mesh).min_angle_deg)
    True
    """
    return TriangleQuality(**_temper.triangle_quality(as_triangles(mesh)._handle))
