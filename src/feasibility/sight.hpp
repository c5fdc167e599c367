// The domain of a mesh, whatever its connectivity: which vertices see each other, and which edges and triangles a
// triangulation of the same vertices can have. Boundary and constrained edges are the same in all of them.
// All answers are exact.
#pragma once

#include <cstdint>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Precondition: the mesh lies in the plane. For n vertices and m edges of the boundary and lines, memory is O(n²), and
/// time O(n² (n + m)).
class Sight {
 public:
  explicit Sight(const Mesh& mesh);

  /// Says whether the segment pq lies in the domain, and touches the boundary and other vertices at most with its ends.
  /// Edges of the mesh always do.
  [[nodiscard]] bool see_each_other(VertexId p, VertexId q) const { return kind(p, q) >= kSeen; }
  /// Says whether a triangulation can have the edge pq: p and q see each other across no constrained edge.
  [[nodiscard]] bool can_be_edge(VertexId p, VertexId q) const { return kind(p, q) >= kEdge; }
  /// Says whether all triangulations have the edge pq: it is on the boundary or constrained.
  [[nodiscard]] bool must_be_edge(VertexId p, VertexId q) const { return kind(p, q) == kKept; }
  /// Says whether pqr is counter-clockwise and lies in the domain. Other vertices may lie in it.
  [[nodiscard]] bool holds_triangle(VertexId p, VertexId q, VertexId r) const;
  /// Says whether a triangulation can have the triangle pqr, counter-clockwise.
  [[nodiscard]] bool can_be_triangle(VertexId p, VertexId q, VertexId r) const;
  /// Says whether the segments ab and cd meet in their insides. Precondition: both can be edges.
  [[nodiscard]] bool cross(VertexId a, VertexId b, VertexId c, VertexId d) const;

 private:
  enum Kind : std::uint8_t { kHidden, kSeen, kEdge, kKept };

  [[nodiscard]] Kind kind(VertexId p, VertexId q) const { return kinds_[p.index * n_ + q.index]; }
  [[nodiscard]] Kind kind_of(VertexId p, VertexId q) const;
  [[nodiscard]] bool leaves_into_domain(VertexId p, VertexId q) const;
  [[nodiscard]] bool is_on_segment(VertexId v, VertexId p, VertexId q) const;
  [[nodiscard]] bool is_inside(VertexId v, VertexId p, VertexId q, VertexId r) const;

  const Mesh& mesh_;
  std::size_t n_;
  std::vector<HalfedgeId> walls_, lines_;  ///< edges of the boundary, and constrained edges inside
  std::vector<Kind> kinds_;
};

}  // namespace temper
