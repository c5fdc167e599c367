"""A mesh in the form of meshio: points, blocks of cells of one type, and data for each block."""

from __future__ import annotations

import dataclasses
from typing import Any


@dataclasses.dataclass
class Block:
    """Cells of one type."""

    type: str
    data: Any


@dataclasses.dataclass
class Cells:
    """A mesh as meshio has it."""

    points: Any
    cells: list[Block]
    point_data: dict[str, Any] = dataclasses.field(default_factory=dict)
    cell_data: dict[str, list[Any]] = dataclasses.field(default_factory=dict)
    field_data: dict[str, Any] = dataclasses.field(default_factory=dict)
    left_out: list[str] = dataclasses.field(default_factory=list)
    """Messages about what a mesh cannot hold."""
    held: Any = ()
    """Points that must not move."""
