"""Operations on connectivity. Ask, price, commit: ``can_flip``, then ``flip``; a plan, then what commits it.

All change a ``temper.Mesh`` in place. Halfedge 3 t + k runs from corner k to corner k + 1 of triangle t. A plan is for
the mesh as it is; TemperError when the mesh has changed since.
"""

from __future__ import annotations

import dataclasses
from typing import Literal, Sequence

import numpy as np
import numpy.typing as npt

from . import _temper
from ._mesh import Mesh, MeshLike, as_mesh, put_back
from ._records import Record
from ._temper import InsertionPlan, RemovalPlan

__all__ = [
    "Grading", "GradingPlan", "InsertionPlan", "RemovalPlan", "Restoration", "can_flip", "count_non_regular_edges",
    "flip", "flip_threshold", "grade_boundary", "insert_vertex", "interpolated_weight", "is_regular",
    "plan_boundary_grading", "plan_center", "plan_collapse", "plan_insertion", "plan_removal", "plan_split",
    "position_flip_threshold", "removal_from_names", "remove_vertex", "restore_regularity", "split_weight",
    "triangles_without_free_corner", "weight_flip_threshold",
]  # fmt: skip


def can_flip(mesh: Mesh, halfedge: int) -> Literal["possible", "boundary", "constrained", "not_convex"]:
    """Why the edge of a halfedge cannot be flipped, or that it can. Exact."""
    return _temper.can_flip(mesh._handle, halfedge)


def flip(mesh: Mesh, halfedge: int) -> int:
    """Replaces the edge by the other diagonal, and returns the halfedge of the new edge in the same triangle's slot;
    flipping it three more times restores every slot. TemperError when it cannot be flipped. O(1), unless an array that
    looks at the mesh is alive."""
    return _temper.flip(mesh._handle, halfedge)


def plan_removal(mesh: Mesh, vertex: int) -> RemovalPlan:
    """How to remove a vertex so that the domain and its interfaces keep their shape; ``status`` says whether it can."""
    return _temper.plan_removal(mesh._handle, vertex)


def plan_collapse(mesh: Mesh, vertex: int, into: int) -> RemovalPlan:
    """How to collapse the edge between a vertex and its neighbor ``into``: the vertex is removed, and all new
    triangles have ``into`` as a corner."""
    return _temper.plan_collapse(mesh._handle, vertex, into)


def removal_from_names(
    mesh: Mesh, vertex: int, link_first: int, triangles: Sequence[tuple[int, int, int]]
) -> RemovalPlan:
    """The plan that was written down as these numbers: ``plan.vertex``, ``plan.link[0]`` and ``plan.triangles``. All
    of it is checked."""
    return _temper.removal_from_names(mesh._handle, vertex, link_first, list(triangles))


def remove_vertex(mesh: Mesh, plan: RemovalPlan) -> None:
    """Commits a plan with status possible. All other numbers stay valid until ``mesh.compact()``, which other functions
    need, drops what is erased."""
    _temper.remove_vertex(mesh._handle, plan)


def plan_insertion(mesh: Mesh, point: tuple[float, float, float], near: int = 0) -> InsertionPlan:
    """How to insert a vertex at (x, y, w) [length, length, length²]: by a walk from triangle ``near``, exact."""
    return _temper.plan_insertion(mesh._handle, *point, near)


def plan_split(mesh: Mesh, halfedge: int, at: float | tuple[float, float, float]) -> InsertionPlan:
    """How to split an edge: at a part of the way, 0 < at < 1, with the weight that keeps its pieces crossed; or at a
    point (x, y, w) on it."""
    if isinstance(at, (int, float)):
        return _temper.plan_split(mesh._handle, halfedge, at)
    return _temper.plan_split_at(mesh._handle, halfedge, *at)


def plan_center(mesh: Mesh, triangle: int) -> InsertionPlan:
    """How to insert a vertex at the orthocenter of a triangle, with the weight interpolated there."""
    return _temper.plan_center(mesh._handle, triangle)


def insert_vertex(mesh: Mesh, plan: InsertionPlan) -> int:
    """Commits a plan with status possible or not_regular, and returns the new vertex: the last one."""
    return _temper.insert_vertex(mesh._handle, plan)


def interpolated_weight(mesh: Mesh, triangle: int, point: tuple[float, float]) -> float:
    """The weight at a point of the linear function through the corners of a triangle [length²]. A vertex of this weight
    strictly inside the triangle is never hidden."""
    return _temper.interpolated_weight(mesh._handle, triangle, *point)


def split_weight(w_a: float, w_b: float, squared_length: float, t: float) -> float:
    """The weight for a point that divides an edge of length ℓ (squared_length = ℓ²) into tℓ and (1 − t)ℓ [length²]."""
    return _temper.split_weight(w_a, w_b, squared_length, t)


@dataclasses.dataclass(frozen=True, eq=False)
class GradingPlan(Record):
    """How to cut the edges of the boundary and of constrained lines so that neighbors are of like length."""

    cuts: list[tuple[int, int, npt.NDArray[np.float64]]]
    """a < b, and fractions of the way from a to b, ascending."""
    vertices: int
    ratio_before: float
    """The largest ratio of the lengths of two such edges that meet at a vertex."""
    ratio_after: float


def plan_boundary_grading(mesh: Mesh, ratio: float = 4.0, widest_angle_deg: float = 180.0) -> GradingPlan:
    """Cuts that make any two edges of boundary and lines that meet at a vertex within ``ratio`` (at least 2) of each
    other's length; edges that a corner across sees at more than ``widest_angle_deg`` are cut in two at least."""
    return GradingPlan(**_temper.plan_boundary_grading(mesh._handle, ratio, widest_angle_deg))


def triangles_without_free_corner(mesh: Mesh) -> npt.NDArray[np.int32]:
    """Triangles whose corners all are on the boundary or on constrained lines, (k, 3) vertices: longest edge first."""
    return _temper.triangles_without_free_corner(mesh._handle)


@dataclasses.dataclass(frozen=True)
class Grading(Record):
    """What ``grade_boundary`` did."""

    vertices: int
    """Inserted on edges."""
    inside: int
    """Inserted in triangles without free corner."""
    flips: int
    refused: int
    """Cuts that cannot be made: rounding turns a triangle over there."""


def grade_boundary(mesh: Mesh, ratio: float = 4.0) -> Grading:
    """Makes the boundary fit for optimization: cuts long edges beside short ones, and gives triangles without free
    corner a vertex inside. Old vertices stay bit for bit."""
    return Grading(**_temper.grade_boundary(mesh._handle, ratio))


# --- regularity: the weighted Delaunay property ---------------------------------------------------------------


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
    [length, length, length²], on a sphere (X, Y, Z) of its weighted vector [length]; inf when there is none (eq. 10 of the
    paper)."""
    return _temper.flip_threshold(as_mesh(mesh)._handle, vertex, *step)


def weight_flip_threshold(mesh: MeshLike, vertex: int, direction: float) -> float:
    """The least change of a weight [length²], upwards when direction is positive and downwards when it is negative,
    past which an edge flips; inf when none does."""
    return _temper.weight_flip_threshold(as_mesh(mesh)._handle, vertex, direction)


def position_flip_threshold(mesh: MeshLike, vertex: int, direction: tuple[float, float]) -> float:
    """How far a vertex may go along ``direction`` before an edge flips, in units of its length; inf when none does."""
    return _temper.position_flip_threshold(as_mesh(mesh)._handle, vertex, *direction)
