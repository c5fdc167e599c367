// A smallest set of triangles that no weights suit: the program finds a set, and triangles are removed one by one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "feasibility/constraints.hpp"
#include "temper/explain.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Triangles that admit no weights together, with the proof; every proper subset admits weights.
struct Conflict {
  std::vector<TriangleId> triangles;  ///< sorted
  BestMargin best;                    ///< of these, with certificate
};

/// A mesh, and its constraints on weights: those of well_centered, with the equations of interfaces if it is cut.
struct Weighing {
  const Mesh& mesh;
  const TriangleDemand& demand;
};

/// A conflict among these triangles, when the checker accepts a certificate of one. A conflict with `kept`, when it is
/// valid, is preferred to others, then one whose triangles are bad now. O(k) programs for k terms of the certificate.
[[nodiscard]] std::optional<Conflict> find_conflict(const Weighing& weighing, std::span<const TriangleId> triangles,
                                                    TriangleId kept, LpSolver& solver);
/// A conflict from a certificate about the mesh that the checker has accepted.
[[nodiscard]] std::optional<Conflict> shrink(const Weighing& weighing, const Certificate& certificate, TriangleId kept,
                                             LpSolver& solver);

/// The vertex that all these triangles have, when there is one; of two vertices the one with the larger angle.
[[nodiscard]] std::optional<FanCenter> fan_center(const Mesh& mesh, std::span<const TriangleId> triangles);

/// edge, fan or patch.
[[nodiscard]] ReasonKind kind_of(const Conflict& conflict, bool has_center, bool has_crossing);

/// The vertices of these triangles that an optimization may move: inside, not fixed, on no constrained edge.
[[nodiscard]] std::vector<VertexId> free_vertices(const Mesh& mesh, std::span<const TriangleId> triangles);

/// Do the weights of the solved program make all these triangles well-centered? Exact.
[[nodiscard]] bool suits(const Mesh& mesh, std::span<const TriangleId> triangles, const BestMargin& best);

// The places where the dual may cross the edges of a well-centered triangle, for one triangle and for several that
// share edges.
//
// The orthocenter of a triangle is any point, by choice of weights, and determines the weights' differences. It must
// lie inside, and its foot on each edge between the ends: an open convex polygon with at most six corners. The foot
// divides the edge alike for the triangles on both sides. Consider triangles that are joined by shared edges, without a
// closed ring. They admit weights exactly if feet can be chosen that agree: a constraint network that is a tree, solved
// by passing intervals. On the sphere the lines are great circles: the polygon is a cone, cut by planes through the
// center, and feet are arcs.
//
//             r                 obtuse at r: o lies between the perpendiculars at r to rp and rq, which meet pq
//           /:  :\              in Y and X; the foot on pq is anywhere between X and Y, no further out
//         /  :   : \            obtuse at p: the same, so that on pq the foot stays within b sin A tan C of p
//       p----X----Y-----q

/// Distances from p along pq, both exclusive.
struct Interval {
  double from = 0, to = 0;
  [[nodiscard]] bool empty() const { return !(from < to); }
};

/// The interval of d_pq over all weights that make the counter-clockwise triangle pqr well-centered. Let A, B, C be
/// angles at p, q, r and a, b, c the lengths across. C obtuse: (c − a / cos B, b / cos A). A obtuse: (0, b sin A tan
/// C). B obtuse: (c − a sin B tan C, c). Otherwise: (0, c).
[[nodiscard]] Interval crossing_interval(Vec2 p, Vec2 q, Vec2 r);

/// The shared edge on which the two sides of a set of triangles disagree most, relative to its length. Nothing when the
/// set is not joined into a tree by its shared edges, or the sides agree up to rounding. `triangles` is sorted.
[[nodiscard]] std::optional<CrossingConflict> crossing_conflict(const Mesh& mesh,
                                                                std::span<const TriangleId> triangles);

}  // namespace temper
