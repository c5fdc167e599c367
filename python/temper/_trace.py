"""What an optimisation did, event by event: enough to do it again, bit for bit, without any energy."""

from __future__ import annotations

import dataclasses
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh


@dataclasses.dataclass(frozen=True, eq=False)
class TraceEvent:
    """Vertices are numbered as in the input, also after removals; new ones get the numbers after those of the input.
    Coordinates and weights are in the user's units."""

    kind: Literal["move", "weight", "flip", "collapse", "removal", "insertion", "split", "hidden", "undo"]
    sweep: int
    """0: making the input regular, and cutting its boundary."""
    vertex: int
    """−1 for flip, and for undo of whole sweeps; insertion, split: the new one."""
    before: float
    """Energy of the vertex's patch, or of all edges that a flip changes, before the event; NaN where none belongs."""
    after: float
    point: tuple[float, float, float]
    """move, weight, insertion, split: x, y, w of the vertex now; on a sphere its lifted point."""
    quad: tuple[int, int, int, int]
    """flip: edge a→b, with c on its left and d on its right, becomes d→c; split: a→b was cut (d −1 on the boundary)."""
    link: npt.NDArray[np.int32]
    """collapse, removal: neighbours, counter-clockwise; insertion: corners of the triangle."""
    triangles: list[tuple[int, int, int]]
    """collapse, removal: that fill the cavity, in slot order."""
    to_sweep: int
    """undo without a vertex: the sweep at whose end the mesh was so; −1: the input as given."""

    def _plain(self) -> dict[str, Any]:
        return {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}


@dataclasses.dataclass(frozen=True, eq=False)
class Snapshot:
    """The mesh as it is at one moment of a run."""

    moment: Literal["start", "after_sweep", "before_flips", "after_flips"]
    sweep: int
    """Sweeps done."""
    outer: int
    """Rounds of deferred flips done."""
    energy: float
    """Of the mesh, at the γ of the sweep."""
    mesh: Mesh
    """A copy; may hold inverted triangles when those are allowed."""
    vertices: npt.NDArray[np.int32]
    """Number in the input of each vertex; −1: inserted."""

    @classmethod
    def _of(cls, d: dict[str, Any]) -> Snapshot:
        handle: _temper.Mesh = d.pop("mesh")
        return cls(**d, mesh=Mesh._of(handle))
