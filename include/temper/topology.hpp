// Operations on connectivity. Ask, price, commit: can_flip, then flip. None mutates to find out.
//
// All keep twins, flags, regions and outgoing() right. They leave outgoing() as Mesh::build makes it: the boundary
// halfedge of a boundary vertex, the largest halfedge of an inner one. A value that the rest of the mesh determines
// is what lets a flip be undone bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// The answer of can_flip: the edge can be flipped, or why not.
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

/// The answer of plan_removal: the vertex can be removed, or why not.
enum class RemovalStatus {
  possible,
  fixed,             ///< the user wants it to stay
  boundary_corner,   ///< on the boundary, and not exactly on the line between its two neighbors there
  constrained,       ///< on constrained edges other than two in one straight line; or between regions not so parted
  no_triangulation,  ///< in no triangle, or the cavity has no triangulation whose edges are new to the mesh
};

/// The plan that remove_vertex commits: a value, to be priced, thrown away, or written down by the vertices' numbers.
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

/// Plans to remove v so that the domain and its interfaces keep their shape. The star becomes a cavity, whose new
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

/// Plans to collapse the edge between v and its neighbor `into`: v is removed, and all new triangles have `into` as a
/// corner. It is a removal, so that remove_vertex commits it. The status is plan_removal's for v; constrained also when
/// v is on a line inside the domain and `into` is not; no_triangulation when they have no edge, a new triangle would
/// not be counter-clockwise, or a new edge is there already (the link condition). O(k²).
[[nodiscard]] RemovalPlan plan_collapse(const Mesh& mesh, VertexId v, VertexId into, RemovalPlan storage = {});

// --- insertion and split ------------------------------------------------------------------------------------------

/// The answer of plan_insertion and plan_split: the vertex can be inserted, or why not.
enum class InsertionStatus {
  possible,
  outside,         ///< in no triangle
  at_vertex,       ///< on a vertex; of a split: rounded to an end of the edge
  on_boundary,     ///< exactly on a boundary edge, where plan_split is to be asked
  on_constrained,  ///< exactly on a constrained edge, where plan_split is to be asked
  hidden,          ///< its weight is too small: no regular triangulation would have it
  not_regular,     ///< its weight hides a neighbor, or the edges around were not regular: the plan is whole and may be
                   ///< committed, but leaves an edge that is not regular
  inverted,        ///< of a split: the point is rounded so far off the edge that a new triangle turns over
};

/// The plan that insert_vertex commits: a value, to be priced or thrown away.
struct InsertionPlan {
  InsertionStatus status = InsertionStatus::outside;
  WeightedPoint point;
  TriangleId triangle;  ///< that the point is in
  HalfedgeId edge;      ///< of this triangle, when the point is on it: will be split; else invalid
  /// The triangles that the new ones replace: `triangle`, the one across `edge`, then those that the flips reach.
  std::vector<TriangleId> cavity;
  /// Around the new vertex v, counter-clockwise; the new triangles are v, link[i], link[i + 1], also with link[0] after
  /// the last, unless `edge` is a boundary edge: then the link runs from its target to its origin.
  std::vector<VertexId> link;
  /// The cavity's outer edges, from inside it: link[i] → link[i + 1].
  std::vector<HalfedgeId> rim;
  /// The edges a→b that are flipped to v, in this order, after the insertion: v is on the left of a→b.
  std::vector<std::array<VertexId, 2>> flips;
};

/// Plans to insert a vertex at p, whose triangle an exact walk from `near` finds (any triangle that is not erased).
/// From there outwards, edges that would not be regular are flipped to the new vertex; never constrained ones. In a
/// mesh whose unconstrained edges are regular, so they are after the commit. Ties keep the edges that are there; the
/// order of the flips depends on the numbers of the vertices alone. About O(√n) for the walk (O(n) where the domain's
/// shape stops it), O(k²) for k flips. `storage` lends its memory.
///
///     plan = plan_insertion(mesh, {p.x, p.y, interpolated_weight(mesh, t, p)}, t, std::move(plan));
///     if (plan.status == InsertionStatus::possible) v = insert_vertex(mesh, plan);
[[nodiscard]] InsertionPlan plan_insertion(const Mesh& mesh, const WeightedPoint& p, TriangleId near,
                                           InsertionPlan storage = {});

/// Plans to split the edge of h, of the boundary, constrained or neither, a part t of the way from a to b, 0 < t < 1,
/// with the weight split_weight(…), or on the sphere one that leaves both pieces their d in the same way; flags and
/// regions are kept. The point is rounded: on an axis-parallel edge of the plane it lies exactly on it, as do midpoints
/// of few bits, and the domain is kept exactly; elsewhere the edge is bent by up to three units in the last place of
/// its ends' coordinates. The flips of either side keep to it.
[[nodiscard]] InsertionPlan plan_split(const Mesh& mesh, HalfedgeId h, double t, InsertionPlan storage = {});
/// The same at a point of the caller's, on the edge or near it.
[[nodiscard]] InsertionPlan plan_split(const Mesh& mesh, HalfedgeId h, const WeightedPoint& p,
                                       InsertionPlan storage = {});

/// An observer sees each change as it happens, for traces. Functions may be empty.
struct InsertionObserver {
  /// Just before insert_in_triangle(mesh, plan.triangle, plan.point) or split_edge(mesh, plan.edge, plan.point).
  std::function<void(const InsertionPlan& plan)> inserting;
  /// Just before: edge a→b, with c on its left and d on its right, is replaced by d→c in a→b's slot (flip()).
  std::function<void(VertexId a, VertexId b, VertexId c, VertexId d)> flipped;
};

/// Commits a plan with status possible or not_regular, made for the mesh as it is, and returns the new vertex: the last
/// one. Its triangles are the plan's. Slots are those of insert_in_triangle or split_edge, and of the flips. O(k²).
VertexId insert_vertex(Mesh& mesh, const InsertionPlan& plan, const InsertionObserver* observer = nullptr);

/// The weight at p of the linear function through the corners of t [length²]. A vertex of this weight strictly inside
/// the triangle is never hidden: |x|² lies below its linear interpolation. Precondition: the mesh lies in the plane.
[[nodiscard]] double interpolated_weight(const Mesh& mesh, TriangleId t, Vec2 p);

/// The weight for a point that divides an edge of length ℓ (squared_length = ℓ²) into tℓ and (1 − t)ℓ: linear between
/// w_a and w_b when both pieces then have 0 < d < their length; else in the middle half of the weights for which they
/// have; linear when none does.
[[nodiscard]] double split_weight(double w_a, double w_b, double squared_length, double t);

// --- boundary grading: for meshes of the plane, a precondition ------------------------------------------------------

/// One edge of the boundary or of constrained lines, and where to cut it.
struct EdgeSplits {
  VertexId a, b;           ///< a < b
  std::vector<double> at;  ///< fractions of the way from a to b, ascending, strictly between 0 and 1
};

/// A plan that cuts the edges of the boundary and of constrained lines so that neighbors are of like length.
struct GradingPlan {
  std::vector<EdgeSplits> cuts;  ///< by a, then b
  std::size_t vertices = 0;      ///< how many vertices that makes
  double ratio_before = 1;       ///< the largest ratio of the lengths of two such edges that meet at a vertex
  double ratio_after = 1;        ///< the same with the cuts, at most `ratio`
};

/// Cuts edges of the boundary and constrained edges until any two of them that meet at a vertex are within `ratio` of
/// each other's length (at least 2). No piece is shorter than the smaller of the shortest edges at its edge's two ends,
/// so the pieces only ever follow what is short already. Each edge is cut into the least number of pieces that its ends
/// allow. Edges that a corner across sees at more than `widest_angle_deg` are cut in two at least (180: none is): the
/// mesh is much finer beside them than along them. O(n log n).
[[nodiscard]] GradingPlan plan_boundary_grading(const Mesh& mesh, double ratio = 4, double widest_angle_deg = 180);

/// Triangles whose corners all are on the boundary or on constrained lines, where no vertex is free to make them well
/// centered: longest edge first. As corners, the smallest number first, which still name them when slots have changed.
[[nodiscard]] std::vector<std::array<VertexId, 3>> triangles_without_free_corner(const Mesh& mesh);

/// Plans to insert a vertex at the orthocenter of a triangle, with the weight interpolated there. outside also when the
/// triangle is no longer there, or would not be among those that are replaced (its orthocenter is behind a line).
[[nodiscard]] InsertionPlan plan_center(const Mesh& mesh, const std::array<VertexId, 3>& corners,
                                        InsertionPlan storage = {});

/// Constants of grade_boundary: above kWidestBoundaryAngle [degrees] an edge is halved, and kGradingPasses times the
/// new triangles are looked at. On the dense horseshoe any angle from 90 to 120 gives margins h/ℓ and d/ℓ above 0.05
/// after sweeps.
inline constexpr double kWidestBoundaryAngle = 120;
inline constexpr int kGradingPasses = 3;

/// The result of grade_boundary.
struct Grading {
  std::size_t vertices = 0;  ///< inserted on edges
  std::size_t inside = 0;    ///< inserted in triangles without free corner
  std::size_t flips = 0;
  std::size_t refused = 0;  ///< cuts that cannot be made: rounding turns a triangle over there
};
/// Makes the boundary fit for optimization: kGradingPasses times plan_boundary_grading(mesh, ratio,
/// kWidestBoundaryAngle), committed by plan_split and insert_vertex, then plan_center in all triangles without free
/// corner. Old vertices stay bit for bit. The mesh should be regular; then it stays so, but for splits that are
/// not_regular.
Grading grade_boundary(Mesh& mesh, double ratio = 4, const InsertionObserver* observer = nullptr);

}  // namespace temper
