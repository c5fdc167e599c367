"""Operations on connectivity. Each has two steps: ask, then commit. Ask ``can_flip``, then ``flip``; or make a plan,
then commit it.

All change a ``temper.Mesh`` in place. Halfedge 3 t + k runs from corner k to corner k + 1 of triangle t. A plan is for
the current mesh; TemperError if the mesh has changed since.
"""

from __future__ import annotations

import dataclasses
from typing import Literal, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh, put_back
from ._records import Record, expect
from ._temper import InsertionPlan, RemovalPlan

__all__ = [
    "Grading", "GradingPlan", "InsertionPlan", "RemovalPlan", "Restoration", "can_flip", "count_non_regular_edges",
    "flip", "flip_threshold", "grade_boundary", "insert_vertex", "interpolated_weight", "is_regular",
    "plan_boundary_grading", "plan_center", "plan_collapse", "plan_insertion", "plan_removal", "plan_split",
    "position_flip_threshold", "removal_from_names", "remove_vertex", "restore_regularity", "split_weight",
    "triangles_without_free_corner", "weight_flip_threshold",
]  # fmt: skip


def can_flip(mesh: Mesh, halfedge: int) -> Literal["possible", "boundary", "constrained", "not_convex"]:
    """Says that the edge of a halfedge can be flipped, or why not. Exact."""
    return _temper.can_flip(expect("mesh", mesh, Mesh)._handle, halfedge)


def flip(mesh: Mesh, halfedge: int) -> int:
    """Replaces the edge by the other diagonal, and returns the halfedge of the new edge in the same triangle's slot.
    Three more flips of it restore every slot. TemperError if it cannot be flipped. O(1), unless a view of the mesh
    exists."""
    return _temper.flip(expect("mesh", mesh, Mesh)._handle, halfedge)


def plan_removal(mesh: Mesh, vertex: int) -> RemovalPlan:
    """Plans to remove a vertex so that the domain and its interfaces keep their shape. ``status`` tells you if it can
    be removed."""
    return _temper.plan_removal(expect("mesh", mesh, Mesh)._handle, vertex)


def plan_collapse(mesh: Mesh, vertex: int, into: int) -> RemovalPlan:
    """Plans to collapse the edge between a vertex and its neighbor ``into``: the vertex is removed, and all new
    triangles have ``into`` as a corner."""
    return _temper.plan_collapse(expect("mesh", mesh, Mesh)._handle, vertex, into)


def removal_from_names(
    mesh: Mesh, vertex: int, link_first: int, triangles: Sequence[tuple[int, int, int]]
) -> RemovalPlan:
    """Restores a plan from recorded numbers: ``plan.vertex``, ``plan.link[0]`` and ``plan.triangles``. It checks all of
    it."""
    return _temper.removal_from_names(expect("mesh", mesh, Mesh)._handle, vertex, link_first, list(triangles))


def remove_vertex(mesh: Mesh, plan: RemovalPlan) -> None:
    """Commits a plan with status possible. All other numbers stay valid until ``mesh.compact()`` drops what is erased.
    Most other functions need ``compact()`` first."""
    _temper.remove_vertex(expect("mesh", mesh, Mesh)._handle, plan)


def plan_insertion(mesh: Mesh, point: tuple[float, float, float], near: int = 0) -> InsertionPlan:
    """Plans to insert a vertex at (x, y, w) [length, length, length²]. An exact walk from triangle ``near`` finds its
    place."""
    return _temper.plan_insertion(expect("mesh", mesh, Mesh)._handle, *point, near)


def plan_split(mesh: Mesh, halfedge: int, at: float | tuple[float, float, float]) -> InsertionPlan:
    """Plans to split an edge: at a part of the way, 0 < at < 1, with a weight for which duals cross its pieces; or at a
    point (x, y, w) on it."""
    if isinstance(at, (int, float)):
        return _temper.plan_split(expect("mesh", mesh, Mesh)._handle, halfedge, at)
    return _temper.plan_split_at(expect("mesh", mesh, Mesh)._handle, halfedge, *at)


def plan_center(mesh: Mesh, triangle: int) -> InsertionPlan:
    """Plans to insert a vertex at the orthocenter of a triangle, with the interpolated weight."""
    return _temper.plan_center(expect("mesh", mesh, Mesh)._handle, triangle)


def insert_vertex(mesh: Mesh, plan: InsertionPlan) -> int:
    """Commits a plan with status possible or not_regular, and returns the new vertex, which is the last one."""
    return _temper.insert_vertex(expect("mesh", mesh, Mesh)._handle, plan)


def interpolated_weight(mesh: Mesh, triangle: int, point: tuple[float, float]) -> float:
    """The weight at a point of the linear function through the corners of a triangle [length²]. A vertex with this
    weight strictly inside the triangle is never hidden."""
    return _temper.interpolated_weight(expect("mesh", mesh, Mesh)._handle, triangle, *point)


def split_weight(w_a: float, w_b: float, squared_length: float, t: float) -> float:
    """The weight for a point that divides an edge of length ℓ (squared_length = ℓ²) into tℓ and (1 − t)ℓ [length²]."""
    return _temper.split_weight(w_a, w_b, squared_length, t)


@dataclasses.dataclass(frozen=True, eq=False)
class GradingPlan(Record):
    """A plan to cut edges of the boundary and of constrained lines, so that neighboring edges have similar lengths."""

    cuts: list[tuple[int, int, npt.NDArray[np.float64]]]
    """Vertices a < b of each cut edge, and fractions of the way from a to b, ascending."""
    vertices: int
    ratio_before: float
    """Largest ratio of the lengths of two such edges that meet at a vertex."""
    ratio_after: float


def plan_boundary_grading(mesh: Mesh, ratio: float = 4.0, widest_angle_deg: float = 180.0) -> GradingPlan:
    """Plans cuts so that the lengths of any two edges of boundary and lines that meet at a vertex differ at most by the
    factor ``ratio`` (at least 2). An edge whose opposite corner has an angle of more than ``widest_angle_deg`` is cut
    into at least two pieces."""
    return GradingPlan(**_temper.plan_boundary_grading(expect("mesh", mesh, Mesh)._handle, ratio, widest_angle_deg))


def triangles_without_free_corner(mesh: Mesh) -> npt.NDArray[np.int32]:
    """Triangles with all corners on the boundary or on constrained lines, (k, 3) vertices, longest edge first."""
    return _temper.triangles_without_free_corner(expect("mesh", mesh, Mesh)._handle)


@dataclasses.dataclass(frozen=True)
class Grading(Record):
    """The result of ``grade_boundary``."""

    vertices: int
    """Number of vertices inserted on edges."""
    inside: int
    """Number of vertices inserted in triangles without free corner."""
    flips: int
    refused: int
    """Number of impossible cuts: rounding turns a triangle over there."""


def grade_boundary(mesh: Mesh, ratio: float = 4.0) -> Grading:
    """Prepares the boundary for optimization. It cuts long edges next to short ones, and inserts a vertex in triangles
    without free corner. Old vertices stay bit for bit."""
    return Grading(**_temper.grade_boundary(expect("mesh", mesh, Mesh)._handle, ratio))


# --- regularity: the weighted Delaunay property ---------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False)
class Restoration(Record):
    """The result of ``restore_regularity``. Vertices have their numbers before the call."""

    flips: int
    stuck: npt.NDArray[np.int32]
    """Edges that are not regular, and that no sequence of flips makes regular, (k, 2). They end at a vertex that its
    weight hides."""
    hidden: npt.NDArray[np.int32]
    """Vertices whose power cell is empty in the regular triangulation of the domain."""
    removed: npt.NDArray[np.int32]
    """Hidden vertices that were removed."""
    undone: bool
    """The mesh is unchanged, because a vertex was hidden (``policy="undo"``)."""
    regular: bool
    """Every unconstrained interior edge is regular now."""
    vertices: npt.NDArray[np.int32]
    """Former number of each vertex; empty if none was removed."""


def is_regular(mesh: MeshLike, halfedge: int) -> bool:
    """Says whether the dual length of the edge is zero or more. Exact. Cocircular in the power sense is regular."""
    return _temper.is_regular(as_mesh(mesh)._handle, halfedge)


def count_non_regular_edges(mesh: MeshLike, *, with_constrained: bool = True, threads: int | None = None) -> int:
    """The number of interior edges that are not regular, with or without constrained ones. Exact."""
    return _temper.count_non_regular_edges(as_mesh(mesh)._handle, with_constrained, threads)


def restore_regularity(mesh: MeshLike, *, policy: Literal["undo", "remove", "keep"] = "keep") -> Restoration:
    """Flips edges of the mesh, in place, until every unconstrained interior edge is regular or stuck. Then it treats
    hidden vertices by the policy. Lawson's algorithm, exact: about n flips.

    - undo: put the mesh back as it was.
    - remove: remove them inside the domain and on straight parts of lines.
    - keep: leave them in."""
    target = as_mesh(mesh, in_place=True)
    restoration = Restoration(**_temper.restore_regularity(target._handle, policy))
    if target is not mesh:
        put_back(mesh, target)
    return restoration


def flip_threshold(mesh: MeshLike, vertex: int, step: tuple[float, float, float]) -> float:
    """The least t ≥ 0 beyond which an edge around the vertex stops being regular, when the vertex moves along ``step``
    (eq. 10 of the paper). The step is (x, y, w) [length, length, length²], on a sphere (X, Y, Z) of the weighted vector
    [length]. inf if there is none."""
    return _temper.flip_threshold(as_mesh(mesh)._handle, vertex, *step)


def weight_flip_threshold(mesh: MeshLike, vertex: int, direction: float) -> float:
    """The least change of a weight [length²] beyond which an edge flips. A positive direction means upwards, a negative
    one downwards. inf if no edge flips."""
    return _temper.weight_flip_threshold(as_mesh(mesh)._handle, vertex, direction)


def position_flip_threshold(mesh: MeshLike, vertex: int, direction: tuple[float, float]) -> float:
    """The distance that a vertex may move along ``direction`` before an edge flips, in units of its length; inf if none
    flips."""
    return _temper.position_flip_threshold(as_mesh(mesh)._handle, vertex, *direction)
