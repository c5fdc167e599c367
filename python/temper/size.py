"""Size: how long edges are meant to be where, and how far those of a mesh are from that."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, _doubles, as_mesh
from ._records import Record

__all__ = ["SizeReport", "Spread", "input_size_field", "local_size", "measure_size", "relative_lengths"]


@dataclasses.dataclass(frozen=True)
class Spread(Record):
    """Of many numbers: percentiles by nearest rank. All 0 when there are none."""

    min: float
    p05: float
    median: float
    p95: float
    max: float


@dataclasses.dataclass(frozen=True)
class SizeReport(Record):
    """One mesh, compared with a size field. No number depends on the unit of length."""

    over_field: Spread
    """At each vertex, local size over field: the band that the sizes are in."""
    gradation: Spread
    """At each edge, the greater over the smaller of the local sizes at its two ends."""
    largest_edge_ratio: float
    """Over triangles, longest over shortest edge."""
    outside: int
    """Vertices where the field was extended."""
    band: float
    """B of the least band [1/B, B] that holds all sizes over field."""


def _size_report(d: dict[str, Any]) -> SizeReport:
    over, gradation = Spread(**d["over_field"]), Spread(**d["gradation"])
    return SizeReport(over, gradation, d["largest_edge_ratio"], d["outside"], d["band"])


class SizeField:
    """A length at every point of the plane, or of a sphere: linear on each triangle of a mesh; beyond it, that of its
    nearest point.

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
        TemperError names the vertex whose size makes no sense."""
        return cls(_temper.size_field_from_values(as_mesh(mesh)._handle, _doubles(sizes, 0, "sizes")))

    def at(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The field at points, (k, 2), on a sphere (k, 3) of any length: (k,) float64 [length]. Exactly the given value
        at a vertex."""
        return self._handle.at(self._points(points))[0]

    def outside(self, points: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Whether points, as for ``at``, are beyond the mesh, where the field is extended."""
        return self._handle.at(self._points(points))[1]

    def _points(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        return _doubles(points, 2 if self._handle.radius() == 0 else 3, "points")

    @property
    def mesh(self) -> Mesh:
        """The mesh that it is linear on."""
        return Mesh._of(self._handle.mesh())

    @property
    def values(self) -> npt.NDArray[np.float64]:
        """The sizes at the vertices of that mesh."""
        return self._handle.values()


def input_size_field(mesh: MeshLike) -> SizeField:
    """The field of the mesh's own local sizes."""
    return SizeField(_temper.input_size_field(as_mesh(mesh)._handle))


def local_size(mesh: MeshLike) -> npt.NDArray[np.float64]:
    """At each vertex √(4/√3 A), A the mean area of its triangles: the edge of an equilateral triangle of that area.
    (n,) float64 [length]."""
    return _temper.local_size(as_mesh(mesh)._handle)


def relative_lengths(mesh: MeshLike) -> npt.NDArray[np.float64]:
    """The length of each interior edge and that of its dual, over the mean of the local sizes at its ends: equilateral
    triangles have 1 and 1/√3; the dual is negative where the dual edge is. (n_edges, 2) float64, in the order of
    Mesh.edges, NaN on the boundary."""
    return _temper.relative_lengths(as_mesh(mesh)._handle)


def measure_size(mesh: MeshLike, field: SizeField) -> SizeReport:
    """Compares the local sizes of a mesh with a field."""
    return _size_report(_temper.measure_size(as_mesh(mesh)._handle, field._handle))
