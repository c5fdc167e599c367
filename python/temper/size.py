"""Size: the desired length of edges at each place, and how far the edges of a mesh differ from it."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, _doubles, as_mesh
from ._records import expect
from ._reports import SizeReport, Spread

__all__ = ["SizeReport", "Spread", "input_size_field", "local_size", "measure_size", "relative_lengths",
           "sizes_from_depths"]


class SizeField:
    """A length at every point of the plane, or of a sphere. It is linear on each triangle of a mesh; outside the mesh
    it is the value at the nearest point.

    >>> import numpy, temper
    >>> mesh = temper.generate.annulus()
    >>> field = temper.SizeField.from_values(mesh, numpy.full(mesh.n_vertices, 0.1))
    >>> field.at([(0.7, 0.0)])
    array([0.1])
    """

    __slots__ = ("_handle",)

    def __init__(self, handle: _temper.SizeField) -> None:
        self._handle = handle

    @classmethod
    def from_values(cls, mesh: MeshLike, sizes: npt.ArrayLike) -> SizeField:
        """The field of these sizes, (n,) float64 > 0 [length], at the vertices of the mesh, which is copied.
        TemperError names a vertex whose size is not finite and positive."""
        return cls(_temper.size_field_from_values(as_mesh(mesh)._handle, _doubles(sizes, 0, "sizes")))

    def at(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The field at points, (k, 2), on a sphere (k, 3) of any length. Returns (k,) float64 [length]; at a vertex
        exactly the given value."""
        return self._handle.at(self._points(points))[0]

    def outside(self, points: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Says for each point, as in ``at``, whether it is outside the mesh. There the field is extended."""
        return self._handle.at(self._points(points))[1]

    def _points(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        return _doubles(points, 2 if self._handle.radius() == 0 else 3, "points")

    @property
    def mesh(self) -> Mesh:
        """The mesh on which the field is linear."""
        return Mesh._of(self._handle.mesh())

    @property
    def values(self) -> npt.NDArray[np.float64]:
        """The sizes at the vertices of that mesh."""
        return self._handle.values()


def input_size_field(mesh: MeshLike) -> SizeField:
    """The field of the mesh's own local sizes."""
    return SizeField(_temper.input_size_field(as_mesh(mesh)._handle))


def sizes_from_depths(
    depths: npt.ArrayLike,
    *,
    least: float,
    largest: float = 0.0,
    per_wavelength: float = 0.0,
    period: float = 44714.16,
    time_step: float = 0.0,
    courant: float = 1.0,
) -> npt.NDArray[np.float64]:
    """Sizes from depths of water, for ``SizeField.from_values``.

    Parameters
    ----------
    depths : array of float
        Depths H [m], (n,), positive down. Land (H ≤ 0) and missing depths (NaN) have the least size.
    least, largest : float
        Bounds of the sizes [m]; a ``largest`` of 0 is no bound.
    per_wavelength : float
        Least number of edges per wave of length T √(g H); 0: no rule.
    period : float
        Period T of the wave [s]: by default of the principal lunar tide M2.
    time_step, courant : float
        Edges are at least √(g H) Δt / courant long, with this Δt [s]. This counts more than ``largest``. 0: no rule.

    Returns
    -------
    array of float, (n,) [m]

    Examples
    --------
    >>> from temper.size import sizes_from_depths
    >>> sizes_from_depths([-2, 10, 1000], per_wavelength=100, least=500, largest=30000).round()
    array([  500.,  4429., 30000.])
    """
    return _temper.sizes_from_depths(
        _doubles(depths, 0, "depths"), per_wavelength, period, time_step, courant, least, largest
    )


def local_size(mesh: MeshLike) -> npt.NDArray[np.float64]:
    """The local size √(4/√3 A) of each vertex, with A the mean area of its triangles: the edge of an equilateral
    triangle of that area. (n,) float64 [length]."""
    return _temper.local_size(as_mesh(mesh)._handle)


def relative_lengths(mesh: MeshLike) -> npt.NDArray[np.float64]:
    """The lengths of each interior edge and of its dual, over the mean of the local sizes at its ends. Equilateral
    triangles have 1 and 1/√3. A negative dual edge has a negative value. (n_edges, 2) float64, in the order of
    Mesh.edges, NaN on the boundary."""
    return _temper.relative_lengths(as_mesh(mesh)._handle)


def measure_size(mesh: MeshLike, field: SizeField) -> SizeReport:
    """Compares the local sizes of a mesh with a field."""
    return _temper.measure_size(as_mesh(mesh)._handle, expect("field", field, SizeField)._handle)
