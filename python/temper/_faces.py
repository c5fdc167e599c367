"""Faces of power cells on a line of the outline, such as a fault."""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt

from ._records import Record


@dataclasses.dataclass(frozen=True, eq=False)
class LineFaces(Record):
    """The n faces of power cells that lie on a line, in the order of ``Mesh.lines``. All arrays are read-only views on one
    value, without copies."""

    vertices: npt.NDArray[np.int32]
    """Vertices of the two cells of each face, (n, 2). The first is on the left of the way between the ends."""
    ends: npt.NDArray[np.float64]
    """Ends of each face, (n, 2, 2): two points, each with x and y [length]."""
    length: npt.NDArray[np.float64]
    """Length of each face, (n,), > 0 [length]. Sum: the length of the line inside the domain."""
