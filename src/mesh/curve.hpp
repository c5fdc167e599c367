// The vertices along a Hilbert curve, and walks over a mesh in that order.
#pragma once

#include <cstddef>
#include <optional>

#include "temper/mesh.hpp"

namespace temper {

class Executor;

/// The vertices, sorted along the curve; equal cells by number. O(n).
[[nodiscard]] IdVector<VertexId, VertexId> vertices_by_hilbert(const Mesh& mesh, Executor* executor);

/// Says whether a mesh is large, and numbered so that stars are scattered over memory.
[[nodiscard]] bool is_scattered(const Mesh& mesh);

/// An order in which to look at each vertex once, with its star. Where the numbers of neighbors are far apart, as
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

/// A mesh to be looked at many times: itself, or where it is scattered a copy along the curve, which soon pays.
class NearbyCopy {
 public:
  explicit NearbyCopy(const Mesh& mesh, Executor* executor);
  NearbyCopy(const NearbyCopy&) = delete;
  NearbyCopy& operator=(const NearbyCopy&) = delete;
  ~NearbyCopy() = default;

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  /// The ids in the original of what has these ids here.
  [[nodiscard]] VertexId original(VertexId v) const { return copy_ ? copy_->order.vertices[v] : v; }
  [[nodiscard]] TriangleId original(TriangleId t) const { return copy_ ? copy_->order.triangles[t] : t; }
  /// Says whether it is the original.
  [[nodiscard]] bool is_original() const { return !copy_.has_value(); }

 private:
  const Mesh* mesh_;
  std::optional<OrderedMesh> copy_;
};

}  // namespace temper
