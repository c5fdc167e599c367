// Operations on connectivity. Ask, price, commit: can_flip, then flip. None mutates to find out.
//
// All keep twins, flags, regions and outgoing() right. They leave outgoing() as Mesh::build makes it: the boundary
// halfedge of a boundary vertex, the largest halfedge of an inner one. A value that the rest of the mesh determines
// is what lets a flip be undone bit for bit.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Why an edge cannot be flipped, or that it can.
enum class FlipStatus { possible, boundary, constrained, not_convex };
/// Decided by exact predicates.
[[nodiscard]] FlipStatus can_flip(const Mesh& mesh, HalfedgeId h);

/// Replaces the edge of h by the other diagonal. Precondition: can_flip(mesh, h) == possible. O(1), no allocation.
/// Returns the halfedge of the new edge in triangle(h)'s slot; flipping it three more times restores every slot.
HalfedgeId flip(Mesh& mesh, HalfedgeId h);

/// Undoes flip(mesh, h), bit for bit. `flipped` is what flip returned; later flips must have been undone first.
void unflip(Mesh& mesh, HalfedgeId flipped);

/// Splits a triangle into three at p. Precondition: p is strictly inside. Returns the new vertex. O(1).
VertexId insert_in_triangle(Mesh& mesh, TriangleId t, WeightedPoint p);

/// Splits the edge of h, and its one or two triangles, at p on the edge: so near that the new triangles are
/// counter-clockwise. Flags of the edge go to both halves. Returns the new vertex. O(1).
VertexId split_edge(Mesh& mesh, HalfedgeId h, WeightedPoint p);

/// Why a vertex cannot be removed, or that it can.
enum class RemovalStatus {
  possible,
  fixed,             ///< the user wants it to stay
  boundary_corner,   ///< on the boundary, and not exactly on the line between its two neighbours there
  constrained,       ///< on constrained edges other than two in one straight line; or between regions not so parted
  no_triangulation,  ///< in no triangle, or the cavity has no triangulation whose edges are new to the mesh
};

/// What remove_vertex will do: a value, to be priced, thrown away, or written down by the vertices' numbers.
struct RemovalPlan {
  RemovalStatus status = RemovalStatus::no_triangulation;
  VertexId vertex;
  /// A halfedge out of vertex, to link[0]. The triangles of the star from its own on, counter-clockwise, give their
  /// slots to the new triangles, in this order.
  HalfedgeId first;
  /// The targets of the star's halfedges from first on, counter-clockwise; on the boundary also the last vertex.
  std::vector<VertexId> link;
  /// The new triangles, counter-clockwise.
  std::vector<std::array<VertexId, 3>> triangles;
};

/// How to remove v so that the domain and its interfaces keep their shape. The star becomes a cavity, whose new
/// triangles are counter-clockwise by the exact test and, of all such triangulations, have the least volume under the
/// lifted surface z = |x|² − w: the regular triangulation of the cavity, up to rounding. Lawson's algorithm on the
/// edges of the new triangles mends what rounding chose wrongly. A vertex with exactly two boundary edges, or two
/// constrained ones, in one line gives its place to one edge with their flag. Ties and `first` depend on the numbers
/// of the vertices alone, not on slots. O(k³) for k triangles around v. `storage` lends its memory: a caller that asks
/// for many vertices allocates nothing (k ≤ 24).
///
///     plan = plan_removal(mesh, v, std::move(plan));
///     if (plan.status == RemovalStatus::possible) remove_vertex(mesh, plan);
[[nodiscard]] RemovalPlan plan_removal(const Mesh& mesh, VertexId v, RemovalPlan storage = {});

/// The plan that was written down as these numbers: plan.vertex, plan.link[0] and plan.triangles. Checks all of it,
/// whatever the numbers: the status is what plan_removal says of a vertex that cannot be removed, and no_triangulation
/// when the triangles do not fill the cavity of v exactly, all counter-clockwise, with edges new to the mesh.
[[nodiscard]] RemovalPlan removal_from_names(const Mesh& mesh, VertexId vertex, VertexId link_first,
                                             std::span<const std::array<VertexId, 3>> triangles,
                                             RemovalPlan storage = {});

/// Commits a plan with status possible, made for the mesh as it is. The slots of the star take the new triangles;
/// the one slot (on the boundary) or two left over are erased, and the vertex is left isolated. Nothing else moves:
/// all other ids stay valid, until Mesh::compact() drops what is erased. O(k).
void remove_vertex(Mesh& mesh, const RemovalPlan& plan);

}  // namespace temper
