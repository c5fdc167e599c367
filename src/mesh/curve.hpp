// The vertices along a Hilbert curve, and walks over a mesh in that order.
#pragma once

#include <cstddef>

#include "temper/mesh.hpp"

namespace temper {

class Executor;

/// The vertices, sorted along the curve; equal cells by number. O(n).
[[nodiscard]] IdVector<VertexId, VertexId> vertices_by_hilbert(const Mesh& mesh, Executor* executor);

/// An order in which to look at each vertex once, with its star. Where the numbers of neighbours are far apart, as
/// those of random points, it is that of the curve: what one star has brought into the cache serves the next ones, and
/// looking at all of them is some four times faster. Else it is that of the numbers, and takes no room.
class Walk {
 public:
  explicit Walk(const Mesh& mesh, Executor* executor = nullptr);

  [[nodiscard]] VertexId operator[](std::size_t i) const { return order_.empty() ? VertexId(i) : order_[VertexId(i)]; }
  /// Says whether it is the order of the numbers.
  [[nodiscard]] bool is_by_number() const { return order_.empty(); }

 private:
  IdVector<VertexId, VertexId> order_;  // empty: by number
};

}  // namespace temper
