// A necessary condition for well-centered meshes of a domain, whatever their inner vertices, weights and connectivity:
// it names the edges of the boundary and of constrained lines that have to be split before there can be one.
//
// The dual of an edge uv crosses it at one place, a part s of the way from u. A vertex X that sees the edge wants
//
//   s < a(X) = |X − u|² / ((v − u)·(X − u))       the foot m lies outside the disc through X that has um as a diameter:
//                                                 its diameter on uv is a ℓ
//   1 − s < b(X) = |X − v|² / ((u − v)·(X − v))   the same from v
//
// where the product is positive. If the least a and the least b add up to 1 or less, no s is left. The proof needs no
// weight and no other vertex (docs/explain.md): |p|² − w_p, linear in each triangle, is a convex function along every
// segment inside the domain.
//
// On the sphere the foot is the direction of (1 − s) u + s v, and a(X) = |u × X|² / ((u × X)·((u − v) × X)), for X less
// than a quarter of a great circle from u: as an arc, tan um < tan uX / cos U, where U is the angle at u between v
// and X.
#pragma once

#include <optional>
#include <vector>

#include "temper/detail/ids.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// An edge u → v whose dual must cross it near u for the sake of one vertex, and near v for the sake of another.
struct EdgeConflict {
  /// A piece of a split edge is this part of it at least: shorter ones would only ask for the next split.
  static constexpr double kLeastPiece = 0.2;

  HalfedgeId edge;        ///< from u to v: the boundary halfedge, or the smaller of two twins
  VertexId near_u;        ///< which wants the crossing less than a ℓ from u,
  VertexId near_v;        ///< and which wants it less than b ℓ from v
  double a = 0, b = 0;    ///< parts of the edge's length ℓ, on the sphere of the arc
  double sum = 0;         ///< a + b: at most 1 when there is no place for the crossing
  double split_at = 0.5;  ///< part of the way from u: the middle of what is left out; each piece at least kLeastPiece
};

/// The conflict of one edge, of the boundary, constrained or neither, when a + b ≤ up_to: decided exactly in the range
/// of is_exact_coordinate. Asked are the vertices that stay, on the boundary, on constrained lines or fixed, for which
/// the triangle u v X lies in the domain (exact); constrained lines in between do not matter. So, with up_to = 1: no
/// well-centered mesh has this edge and these two vertices. Larger values find edges that leave little room. Looks at
/// the triangles that meet the disc around the edge. On the sphere up_to is of chords between weighted vectors, which
/// is the same for 1, and exact are coordinates that are 0 or of 2^-82 … 2^120.
[[nodiscard]] std::optional<EdgeConflict> edge_conflict(const Mesh& mesh, HalfedgeId h, double up_to = 1);

/// The edges of the boundary and of constrained lines with such a conflict, least sum first. None does not mean that
/// there is a well-centered mesh. Precondition: no erased triangles, all counter-clockwise; no periods. O(n) and the
/// triangles near the edges.
///
///     for (const EdgeConflict& c : edges_that_must_be_split(mesh)) split(c.edge, c.split_at);
[[nodiscard]] std::vector<EdgeConflict> edges_that_must_be_split(const Mesh& mesh, double up_to = 1);

}  // namespace temper
