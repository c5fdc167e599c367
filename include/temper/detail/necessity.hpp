// A necessary condition for well-centered meshes of a domain, for any inner vertices, weights and connectivity. It
// names the edges of the boundary and of constrained lines that must be split first.
//
// The dual of an edge uv crosses it at one place, a part s of the way from u. A vertex X that sees the edge requires
//
//   s < a(X) = |X − u|² / ((v − u)·(X − u))       the foot m lies outside the disc through X that has um as a diameter:
//                                                 its diameter on uv is a ℓ
//   1 − s < b(X) = |X − v|² / ((u − v)·(X − v))   the same from v
//
// if the product is positive. If the least a and the least b add up to 1 or less, no s is possible. The proof needs no
// weight and no other vertex (docs/explanation/proofs.md): |p|² − w_p, linear in each triangle, is a convex function
// along every segment inside the domain.
//
// On the sphere the foot is the direction of (1 − s) u + s v, and a(X) = |u × X|² / ((u × X)·((u − v) × X)). X must be
// less than a quarter of a great circle from u. As an arc, tan um < tan uX / cos U, where U is the angle at u between v
// and X.
#pragma once

#include <optional>
#include <vector>

#include "temper/detail/ids.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct ReportTable;

/// An edge u → v with contradictory vertices: one requires that the dual crosses it near u, another near v.
struct EdgeConflict {
  /// Least part of the edge in each piece of a split: a shorter piece would soon need the next split.
  static constexpr double kLeastPiece = 0.2;

  HalfedgeId edge;      ///< Edge from u to v: the boundary halfedge, or the smaller of two twins
  VertexId near_u;      ///< Vertex that requires the crossing less than a ℓ from u
  VertexId near_v;      ///< Vertex that requires the crossing less than b ℓ from v
  double a = 0, b = 0;  ///< Parts of the length ℓ of the edge; on the sphere, of the arc
  double sum = 0;       ///< Sum a + b: at most 1 if there is no place for the crossing
  /// Part of the way from u: the middle between a and 1 − b; each piece is at least kLeastPiece.
  double split_at = 0.5;
};
/// A conflict as a report, with the mesh of its edge.
struct EdgeConflictReport {
  const Mesh& mesh;
  const EdgeConflict& conflict;
};
[[nodiscard]] const ReportTable& table_of(const EdgeConflictReport*);

/// Returns the conflict of one edge if a + b ≤ up_to, decided exactly in the range of is_exact_coordinate. The edge may
/// be on the boundary, constrained or neither.
///
/// The vertices that stay are tested: boundary vertices, fixed vertices, and vertices of constrained lines. The
/// triangle u v X must lie in the domain (exact); constrained lines in between do not matter. With up_to = 1 a conflict
/// means: no well-centered mesh has this edge and these two vertices. Larger values find edges that leave little room.
/// The search looks at the triangles that meet the disc around the edge. On the sphere up_to is for chords between
/// weighted vectors, which is the same for 1. There coordinates 0 or of 2^-82 … 2^120 are exact.
[[nodiscard]] std::optional<EdgeConflict> edge_conflict(const Mesh& mesh, HalfedgeId h, double up_to = 1);

/// Returns the edges of the boundary and of constrained lines with such a conflict, least sum first. An empty list does
/// not mean that a well-centered mesh exists. Preconditions: no erased triangles, all counter-clockwise; no periods.
/// O(n) and the triangles near the edges.
///
///     for (const EdgeConflict& c : edges_that_must_be_split(mesh)) split(c.edge, c.split_at);
[[nodiscard]] std::vector<EdgeConflict> edges_that_must_be_split(const Mesh& mesh, double up_to = 1);

}  // namespace temper
