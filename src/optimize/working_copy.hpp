// The mesh being worked on: a copy in its frame and in an order of its own, that knows every name of the user's.
#pragma once

#include "optimize/frame.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

struct WorkingCopy {
  Mesh mesh;
  Frame frame;
  MeshOrder order;        ///< the user's numbers
  bool has_gaps = false;  ///< in them, once vertices have been removed

  WorkingCopy(const Mesh& user, SweepOrder sweeps);

  /// The vertex of that number in the user's mesh; invalid when it was removed. O(n).
  [[nodiscard]] VertexId from_user(VertexId v) const;
  /// Drops erased triangles and removed vertices from mesh and order.
  Compaction compact();
  /// Out of the frame, and in the user's order; what was removed leaves no gap. Names and frame stay usable.
  [[nodiscard]] Mesh in_user_terms() const&;
  [[nodiscard]] Mesh in_user_terms() &&;
  /// The number in the input of each vertex of in_user_terms().
  [[nodiscard]] IdVector<VertexId, VertexId> user_vertices() const;
};

}  // namespace temper
