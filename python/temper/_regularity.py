"""Regularity (the weighted Delaunay property): test it, restore it, and how far a vertex may go before it is lost."""

from __future__ import annotations

import dataclasses
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import MeshLike, as_mesh, put_back
from ._records import Record


@dataclasses.dataclass(frozen=True, eq=False)
class Restoration(Record):
    """What ``restore_regularity`` did. Vertices are those of before the call."""

    flips: int
    stuck: npt.NDArray[np.int32]
    """(k, 2) edges that are not regular and that no flip sequence cures: they run into a vertex hidden by its
    weight."""
    hidden: npt.NDArray[np.int32]
    """The vertices whose power cell is empty in the regular triangulation of the domain."""
    removed: npt.NDArray[np.int32]
    """Those of them that were removed."""
    undone: bool
    """The mesh is what it was (``policy="undo"``, and some vertex hidden)."""
    regular: bool
    """Every unconstrained interior edge is regular now."""
    vertices: npt.NDArray[np.int32]
    """Former number of each vertex; empty when none was removed."""


def is_regular(mesh: MeshLike, halfedge: int) -> bool:
    """Is the dual length of the edge zero or more? Exact; cocircular in the power sense is regular."""
    return _temper.is_regular(as_mesh(mesh)._handle, halfedge)


def count_non_regular_edges(mesh: MeshLike, *, with_constrained: bool = True, threads: int | None = None) -> int:
    """Interior edges that are not regular; with constrained ones or without. Exact."""
    return _temper.count_non_regular_edges(as_mesh(mesh)._handle, with_constrained, threads)


def restore_regularity(mesh: MeshLike, *, policy: Literal["undo", "remove", "keep"] = "keep") -> Restoration:
    """Flips edges of the mesh, in place, until every unconstrained interior edge is regular or stuck, then treats
    hidden vertices by the policy: put the mesh back as it was; remove them, inside the domain and on straight parts of
    lines; leave them in. Lawson's algorithm, exact: about n flips."""
    target = as_mesh(mesh)
    restoration = Restoration(**_temper.restore_regularity(target._handle, policy))
    if target is not mesh:
        put_back(mesh, target)
    return restoration


def flip_threshold(mesh: MeshLike, vertex: int, step: tuple[float, float, float]) -> float:
    """The least t ≥ 0 past which an edge around the vertex is not regular when it moves along ``step`` = (x, y, w)
    [length, length, length²], on a sphere (X, Y, Z) of its lifted point [length]; inf when there is none (eq. 10 of the
    paper)."""
    return _temper.flip_threshold(as_mesh(mesh)._handle, vertex, *step)


def weight_flip_threshold(mesh: MeshLike, vertex: int, direction: float) -> float:
    """The least change of a weight [length²], upwards when direction is positive and downwards when it is negative,
    past which an edge flips; inf when none does."""
    return _temper.weight_flip_threshold(as_mesh(mesh)._handle, vertex, direction)


def position_flip_threshold(mesh: MeshLike, vertex: int, direction: tuple[float, float]) -> float:
    """How far a vertex may go along ``direction`` before an edge flips, in units of its length; inf when none does."""
    return _temper.position_flip_threshold(as_mesh(mesh)._handle, vertex, *direction)
