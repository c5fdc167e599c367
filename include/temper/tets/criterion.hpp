// The criteria of targets for tetrahedra. temper/detail/criterion.hpp has the same for triangles.
//
// The coefficient of an edge is the signed area of its dual over its length. Each face around the edge adds the area
// k h/2. Here k is the height in the face of its orthocenter over the edge, and h is the dual length of the face: the
// sum of the heights of the orthocenters on its two sides. Between two regions each height is a part of its own.
//
// The distance between two centers is the dual length of the face between them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "temper/detail/criterion.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// An edge with a negative coefficient.
struct ViolatedEdge {
  std::array<VertexId, 2> vertices;  ///< Ascending
  DualKind kind = DualKind::inside;
  std::int32_t region = 0;  ///< Region of a part; else 0
  double dual_over_l2 = 0;  ///< Signed area of the dual, or of its part, over the squared length of the edge
};

/// A face with a distance that is not positive.
struct ViolatedFace {
  HalffaceId face;  ///< The halfface that represents the face; for a part, the halfface on its side
  DualKind kind = DualKind::inside;
  /// Signed length of the dual, or of its part, over the side of the equilateral triangle with the area of the face
  double dual_over_l = 0;
};

/// Edges with negative coefficients, decided exactly, sorted by their vertices. Each edge comes before its parts.
/// Precondition: all tetrahedra are positive. O(n).
[[nodiscard]] std::vector<ViolatedEdge> violated_edges(const TetMesh& mesh, Executor* executor = nullptr);
/// Faces with distances that are not positive, decided exactly, by number of halfface. O(n).
[[nodiscard]] std::vector<ViolatedFace> violated_faces(const TetMesh& mesh, Executor* executor = nullptr);
/// The tetrahedra around violated edges, next to violated faces, or that are not well-centered. Ascending. O(n).
[[nodiscard]] std::vector<TetId> cells_at_violations(const TetMesh& mesh, Criterion criterion,
                                                     Executor* executor = nullptr);
/// Says whether a mesh meets a criterion. O(n).
[[nodiscard]] bool meets(const TetMesh& mesh, Criterion criterion, Executor* executor = nullptr);

}  // namespace temper::tets
