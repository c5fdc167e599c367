"""What became of data where a mesh has changed."""

from __future__ import annotations

import dataclasses
from typing import Any

from . import _temper
from ._mesh import Mesh
from ._records import Record
from ._size import Spread


@dataclasses.dataclass(frozen=True)
class DataReport(Record):
    """Data of the points and triangles that came with a mesh, where it is another now. All 0 without such data."""

    points: int
    """Of those that the mesh came with, that are left."""
    points_moved: int
    """Of those, elsewhere than they were."""
    distance: Spread
    """By which the moved ones are [length]."""
    points_inserted: int
    interpolated: list[str]
    """Point data that are of the place: linear on the triangles that the mesh came with."""
    kept: list[str]
    """Point data that went with their points."""
    dropped: list[str]
    """Integer point data that differ around an inserted point."""
    triangles: int
    triangles_changed: int
    """Of those, with other corners or at other places than the mesh came with at this number."""
    of_triangles: list[str]
    """Data of triangles: those of the triangle that the mesh came with where the middle of each is now."""

    @classmethod
    def _of(cls, mesh: Mesh, threads: int | None) -> DataReport:
        report: dict[str, Any] = _temper.data_report(mesh._handle, threads)
        return cls(**{**report, "distance": Spread(**report["distance"])})
