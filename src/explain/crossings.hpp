// The places where the dual may cross the edges of a triangle that is to be well-centered, for one triangle and for
// several that share edges.
//
// The orthocenter of a triangle is any point, by choice of weights, and determines the weights' differences. It must
// lie inside, and its foot on each edge between the ends: an open convex polygon with at most six corners. The foot
// divides the edge for the triangles on both sides alike, so triangles joined by shared edges, without a closed ring,
// admit weights just when feet can be chosen that agree: a constraint network that is a tree, which passing intervals
// decides. On the sphere it is the same with great circles: the polygon is a cone, cut by planes through the center,
// and feet are arcs.
//
//             r                 obtuse at r: o lies between the perpendiculars at r to rp and rq, which meet pq
//           /:  :\              in Y and X; the foot on pq is anywhere between X and Y, no further out
//         /  :   : \            obtuse at p: the same, so that on pq the foot stays within b sin A tan C of p
//       p----X----Y-----q
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "temper/explain.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Distances from p along pq, both exclusive.
struct Interval {
  double from = 0, to = 0;
  [[nodiscard]] bool empty() const { return !(from < to); }
};

/// The interval of d_pq over all weights that make the counter-clockwise triangle pqr well-centered. With angles A, B,
/// C at p, q, r and lengths a, b, c across: C obtuse (c − a / cos B, b / cos A); A obtuse (0, b sin A tan C); B obtuse
/// (c − a sin B tan C, c); else (0, c).
[[nodiscard]] Interval crossing_interval(Vec2 p, Vec2 q, Vec2 r);

/// The shared edge on which the two sides of a set of triangles disagree most, relative to its length; nothing when the
/// set is not joined into a tree by its shared edges, or when the sides agree up to rounding. `triangles` is sorted.
[[nodiscard]] std::optional<CrossingConflict> crossing_conflict(const Mesh& mesh,
                                                                std::span<const TriangleId> triangles);

}  // namespace temper
