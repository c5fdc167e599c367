// Operations on connectivity. Each has two steps: ask, then commit, such as can_flip, then flip. The questions never
// change the mesh.
//
// All operations keep twins, flags, regions and outgoing() right. They leave outgoing() as Mesh::build makes it: the
// boundary halfedge of a boundary vertex, the largest halfedge of an inner vertex. The rest of the mesh determines this
// value, so a flip can be undone bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// The answer of can_flip: the edge can be flipped, or the reason why not.
enum class FlipStatus { possible, boundary, constrained, not_convex };
/// Says whether the edge of h can be flipped, by exact predicates.
[[nodiscard]] FlipStatus can_flip(const Mesh& mesh, HalfedgeId h);

/// Replaces the edge of h by the other diagonal. Precondition: can_flip(mesh, h) == possible. Returns the halfedge of
/// the new edge in triangle(h)'s slot. Three more flips of it restore every slot. O(1), no allocation.
HalfedgeId flip(Mesh& mesh, HalfedgeId h);

/// Undoes flip(mesh, h), bit for bit. `flipped` is the result of that flip. Undo later flips first.
void unflip(Mesh& mesh, HalfedgeId flipped);

/// Splits a triangle into three at p. Precondition: p is strictly inside. Returns the new vertex. O(1).
VertexId insert_in_triangle(Mesh& mesh, TriangleId t, WeightedPoint p);

/// Splits the edge of h and its one or two triangles at p. p is so near the edge that the new triangles are
/// counter-clockwise. Both halves get the flags of the edge. Returns the new vertex. O(1).
VertexId split_edge(Mesh& mesh, HalfedgeId h, WeightedPoint p);

/// The answer of plan_removal: the vertex can be removed, or the reason why not.
enum class RemovalStatus {
  possible,
  fixed,            ///< The user fixed the vertex
  boundary_corner,  ///< The vertex is on the boundary, but not exactly on the line between its two neighbors there
  constrained,  ///< The vertex is on constrained edges that are not two in one straight line, or between regions with
                ///< no such line
  no_triangulation,  ///< The vertex is in no triangle, or its cavity has no triangulation whose edges are new to the
                     ///< mesh
};

/// The plan that remove_vertex commits. It is a value: evaluate it, throw it away, or record the numbers of its
/// vertices.
struct RemovalPlan {
  RemovalStatus status = RemovalStatus::no_triangulation;
  VertexId vertex;
  /// A halfedge from vertex to link[0]. The triangles of the star, counter-clockwise from the triangle of this
  /// halfedge, give their slots to the new triangles in this order.
  HalfedgeId first;
  /// The targets of the star's halfedges, counter-clockwise from first; on the boundary also the last vertex.
  std::vector<VertexId> link;
  /// The new triangles, counter-clockwise.
  std::vector<std::array<VertexId, 3>> triangles;
};

/// Plans to remove v so that the domain and its interfaces keep their shape. The star becomes a cavity, and new
/// triangles fill it. They are counter-clockwise by the exact test. Among all such triangulations they have the least
/// volume under the lifted surface z = |x|² − w. Up to rounding this is the regular triangulation of the cavity.
/// Lawson's algorithm on the new edges corrects the effect of rounding. If v has exactly two boundary edges, or two
/// constrained edges, and they are in one line, one edge with their flag replaces them. Ties and `first` depend on the
/// numbers of the vertices alone, not on slots. `storage` lends its memory: a caller that plans for many vertices
/// allocates nothing (k ≤ 24). O(k³) for k triangles around v.
///
///     plan = plan_removal(mesh, v, std::move(plan));
///     if (plan.status == RemovalStatus::possible) remove_vertex(mesh, plan);
[[nodiscard]] RemovalPlan plan_removal(const Mesh& mesh, VertexId v, RemovalPlan storage = {});

/// Restores a plan from recorded numbers: plan.vertex, plan.link[0] and plan.triangles. It checks all of it for any
/// numbers. If the vertex cannot be removed, the status gives the reason, as from plan_removal. The status is
/// no_triangulation unless the triangles fill the cavity of v exactly, are all counter-clockwise, and have edges that
/// are new to the mesh.
[[nodiscard]] RemovalPlan removal_from_names(const Mesh& mesh, VertexId vertex, VertexId link_first,
                                             std::span<const std::array<VertexId, 3>> triangles,
                                             RemovalPlan storage = {});

/// Commits a plan with status possible, made for the current mesh. The new triangles take the slots of the star. Two
/// slots are left over (one on the boundary) and erased. The vertex becomes isolated. All other ids stay valid until
/// Mesh::compact() drops what is erased. O(k).
void remove_vertex(Mesh& mesh, const RemovalPlan& plan);

/// Plans to collapse the edge between v and its neighbor `into`: v is removed, and all new triangles have `into` as a
/// corner. remove_vertex commits this plan too. O(k²). The status is as from plan_removal for v, with two additions:
///   - constrained, if v is on a line inside the domain and `into` is not
///   - no_triangulation, if the two have no edge, a new triangle would not be counter-clockwise, or a new edge exists
///     already (the link condition)
[[nodiscard]] RemovalPlan plan_collapse(const Mesh& mesh, VertexId v, VertexId into, RemovalPlan storage = {});

// --- insertion and split ------------------------------------------------------------------------------------------

/// The answer of plan_insertion and plan_split: the vertex can be inserted, or the reason why not.
enum class InsertionStatus {
  possible,
  outside,         ///< The point is in no triangle
  at_vertex,       ///< The point is on a vertex; for a split, it is rounded to an end of the edge
  on_boundary,     ///< The point is exactly on a boundary edge; use plan_split
  on_constrained,  ///< The point is exactly on a constrained edge; use plan_split
  hidden,          ///< The weight is too small: no regular triangulation would have the vertex
  not_regular,  ///< The weight hides a neighbor, or the edges around were not regular. The plan is complete and may be
                ///< committed, but leaves an edge that is not regular
  in_quadrilateral,  ///< The point is in or on a quadrilateral, which stays whole, or a new triangle shares its side
  inverted,          ///< For a split, the point is rounded so far off the edge that a new triangle turns over
};

/// The plan that insert_vertex commits. It is a value: evaluate it or throw it away.
struct InsertionPlan {
  InsertionStatus status = InsertionStatus::outside;
  WeightedPoint point;
  TriangleId triangle;  ///< Triangle that contains the point
  HalfedgeId edge;      ///< Edge of this triangle, to be split, if the point is on it; else invalid
  /// The triangles to replace: `triangle`, the triangle across `edge`, then the triangles that the flips reach.
  std::vector<TriangleId> cavity;
  /// The neighbors of the new vertex v, counter-clockwise. The new triangles are v, link[i], link[i + 1], and
  /// v, link.back(), link[0]. This last triangle is absent if `edge` is a boundary edge; then the link runs from its
  /// target to its origin.
  std::vector<VertexId> link;
  /// The cavity's outer edges, from inside it: link[i] → link[i + 1].
  std::vector<HalfedgeId> rim;
  /// The edges a→b to flip after the insertion, in this order: v is on the left of a→b, and the new edge ends at v.
  std::vector<std::array<VertexId, 2>> flips;
};

/// Plans to insert a vertex at p. An exact walk from `near`, any triangle that is not erased, finds its triangle. From
/// there outwards, edges that would not be regular are flipped to the new vertex; constrained edges stay. If all
/// unconstrained edges of the mesh are regular, they are regular after the commit too. Ties keep the existing edges.
/// The order of the flips depends on the numbers of the vertices alone. `storage` lends its memory. About O(√n) for the
/// walk, O(n) if the shape of the domain stops it; O(k²) for k flips.
///
///     plan = plan_insertion(mesh, {p.x, p.y, interpolated_weight(mesh, t, p)}, t, std::move(plan));
///     if (plan.status == InsertionStatus::possible) v = insert_vertex(mesh, plan);
[[nodiscard]] InsertionPlan plan_insertion(const Mesh& mesh, const WeightedPoint& p, TriangleId near,
                                           InsertionPlan storage = {});

/// Plans to split the edge of h at the part t of the way from a to b, 0 < t < 1. The edge may be on the boundary,
/// constrained or neither. The weight is split_weight(…); on the sphere it is chosen by the same rule. Flags and
/// regions are kept.
///
/// The point is rounded. It is exactly on an edge of the plane that is parallel to an axis, and so are midpoints with
/// few bits; then the domain is kept exactly. Otherwise the edge bends by up to three units in the last place of the
/// coordinates of its ends. Flips stay on their side of the edge.
[[nodiscard]] InsertionPlan plan_split(const Mesh& mesh, HalfedgeId h, double t, InsertionPlan storage = {});
/// Plans the split at a point of the caller, on the edge or near it.
[[nodiscard]] InsertionPlan plan_split(const Mesh& mesh, HalfedgeId h, const WeightedPoint& p,
                                       InsertionPlan storage = {});

/// An observer of each change as it happens, for traces. Functions may be empty.
struct InsertionObserver {
  /// Called just before insert_in_triangle(mesh, plan.triangle, plan.point) or split_edge(mesh, plan.edge, plan.point).
  std::function<void(const InsertionPlan& plan)> inserting;
  /// Called just before a flip. Edge a→b has c on its left and d on its right; d→c replaces it in a→b's slot (flip()).
  std::function<void(VertexId a, VertexId b, VertexId c, VertexId d)> flipped;
};

/// Commits a plan with status possible or not_regular, made for the current mesh. Returns the new vertex, which is the
/// last one. The triangles are those in the plan. Slots follow from insert_in_triangle or split_edge, and from the
/// flips. O(k²).
VertexId insert_vertex(Mesh& mesh, const InsertionPlan& plan, const InsertionObserver* observer = nullptr);

/// The weight at p of the linear function through the corners of t [length²]. A vertex with this weight strictly inside
/// the triangle is never hidden, because |x|² lies below its linear interpolation. Precondition: the mesh lies in the
/// plane.
[[nodiscard]] double interpolated_weight(const Mesh& mesh, TriangleId t, Vec2 p);

/// The weight for a point that divides an edge of length ℓ (squared_length = ℓ²) into tℓ and (1 − t)ℓ. It is linear
/// between w_a and w_b if both pieces then have 0 < d < their length, or if no weight gives them this. Else it is in
/// the middle half of the weights that do.
[[nodiscard]] double split_weight(double w_a, double w_b, double squared_length, double t);

// --- boundary grading: for meshes of the plane, a precondition ------------------------------------------------------

/// The cuts of one edge of the boundary or of constrained lines.
struct EdgeSplits {
  VertexId a, b;           ///< a < b
  std::vector<double> at;  ///< Fractions of the way from a to b, ascending, strictly between 0 and 1
};

/// A plan to cut edges of the boundary and of constrained lines, so that neighboring edges have similar lengths.
struct GradingPlan {
  std::vector<EdgeSplits> cuts;  ///< Cut edges, sorted by a, then b
  std::size_t vertices = 0;      ///< Number of new vertices
  double ratio_before = 1;       ///< Largest ratio of the lengths of two such edges that meet at a vertex
  double ratio_after = 1;        ///< Largest ratio after the cuts, at most `ratio`
};

/// Cuts edges of the boundary and constrained edges until the lengths of any two that meet at a vertex differ at most
/// by the factor `ratio` (at least 2). No piece is shorter than the smaller of the shortest edges at the two ends of
/// its edge. So the pieces never become shorter than the edges that are short already. Each edge gets the least number
/// of pieces that its ends allow. An edge whose opposite corner has an angle of more than `widest_angle_deg` is cut
/// into at least two pieces (180: none), because the mesh next to it is much finer than the edge. O(n log n).
[[nodiscard]] GradingPlan plan_boundary_grading(const Mesh& mesh, double ratio = 4, double widest_angle_deg = 180);

/// Triangles with all corners on the boundary or on constrained lines. No vertex is free to make them well-centered.
/// The triangle with the longest edge comes first. Each is given by its corners, the smallest number first, so the
/// names stay valid when slots change.
[[nodiscard]] std::vector<std::array<VertexId, 3>> triangles_without_free_corner(const Mesh& mesh);

/// Plans to insert a vertex at the orthocenter of a triangle, with the interpolated weight. If that would be beside a
/// line, as for a right angle opposite the boundary, it takes the centroid. The status is `outside` also if the
/// triangle no longer exists, or would not be replaced because its orthocenter is behind a line.
[[nodiscard]] InsertionPlan plan_center(const Mesh& mesh, const std::array<VertexId, 3>& corners,
                                        InsertionPlan storage = {});

/// Constants of grade_boundary. An edge is halved if an angle across from it exceeds kWidestBoundaryAngle [degrees].
/// The new triangles are checked kGradingPasses times. On the dense horseshoe any angle from 90 to 120 gives margins
/// h/ℓ and d/ℓ above 0.05 after sweeps.
inline constexpr double kWidestBoundaryAngle = 120;
inline constexpr int kGradingPasses = 3;

/// The result of grade_boundary.
struct Grading {
  std::size_t vertices = 0;  ///< Number of vertices inserted on edges
  std::size_t inside = 0;    ///< Number of vertices inserted in triangles without free corner
  std::size_t flips = 0;
  std::size_t refused = 0;  ///< Number of impossible cuts: rounding turns a triangle over there
};
/// Prepares the boundary for optimization. It repeats these steps kGradingPasses times: plan_boundary_grading(mesh,
/// ratio, kWidestBoundaryAngle), committed by plan_split and insert_vertex, then plan_center in all triangles without
/// free corner. Old vertices stay bit for bit. If the mesh is regular, it stays regular, except at splits that are
/// not_regular.
Grading grade_boundary(Mesh& mesh, double ratio = 4, const InsertionObserver* observer = nullptr);

}  // namespace temper
