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

/// An order in which to look at each vertex once, with its star. If the numbers of neighbors are far apart, as with
/// random points, the order is the curve's. Then one star brings the next ones into the cache, and looking at all stars
/// is some four times faster. Otherwise it is the order of the numbers, and takes no memory.
class Walk {
 public:
  explicit Walk(const Mesh& mesh, Executor* executor = nullptr);

  [[nodiscard]] VertexId operator[](std::size_t i) const { return order_.empty() ? VertexId(i) : order_[VertexId(i)]; }
  /// Says whether it is the order of the numbers.
  [[nodiscard]] bool is_by_number() const { return order_.empty(); }

 private:
  IdVector<VertexId, VertexId> order_;  // empty: by number
};

/// hilbert_order() on threads. It takes 48 bytes per vertex meanwhile.
[[nodiscard]] MeshOrder hilbert_order_in_place(Mesh& mesh, Executor* executor);

/// A mesh for many looks: itself, or if it is scattered a copy along the curve, which soon pays.
class NearbyCopy {
 public:
  explicit NearbyCopy(const Mesh& mesh, Executor* executor);
  NearbyCopy(const NearbyCopy&) = delete;
  NearbyCopy& operator=(const NearbyCopy&) = delete;
  ~NearbyCopy() = default;

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  /// The vertex in the original.
  [[nodiscard]] VertexId original(VertexId v) const { return copy_ ? copy_->order.vertices[v] : v; }
  /// The triangles in the original, or none if it is the original.
  [[nodiscard]] const IdVector<TriangleId, TriangleId>& original_triangles() const {
    static const IdVector<TriangleId, TriangleId> none;
    return copy_ ? copy_->order.triangles : none;
  }
  /// Says whether it is the original.
  [[nodiscard]] bool is_original() const { return !copy_.has_value(); }

 private:
  const Mesh* mesh_;
  std::optional<OrderedMesh> copy_;
};

}  // namespace temper
