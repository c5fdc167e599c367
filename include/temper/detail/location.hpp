// Places: the position of a point in a mesh, and the data of the mesh there.
//
// Data at vertices are linear on triangles; data of triangles are constant on each. So both are functions on the plane
// or the sphere and do not depend on the numbering of a mesh. A changed mesh gets its data from them. Each vertex gets
// the data at its new place in the former mesh. Each triangle gets the data of the former triangle that contains its
// middle. On the sphere, triangles are flat between the places of their corners, without weights. A point is in the
// triangle that its ray from the center meets.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>

#include "temper/detail/ids.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

class BoxTree;
class Executor;

/// A point of a mesh as a weighted mean of the corners around it.
struct Place {
  TriangleId triangle;  ///< Triangle that the point is in or on
  int n = 0;            ///< Number of corners that count: 1 at a vertex, 2 on an edge, 3 inside a triangle
  std::array<VertexId, 3> corners = {};   ///< Corners; the first n count
  std::array<double, 3> shares = {1, 0};  ///< Share of each corner: not negative, with the sum 1 except for rounding
  bool outside = false;  ///< The requested point is outside the mesh, and this is the nearest point of the mesh

  /// The place exactly at a vertex.
  [[nodiscard]] static Place at(VertexId v, TriangleId t) { return {t, 1, {v}, {1}, false}; }
};

/// The value at a place of the linear function with value_at(v) at vertices. It is never outside the range of the
/// values at the corners that count. If they agree, it is exactly their value.
template <class AtPlace, class ValueAt>
[[nodiscard]] double interpolated(const AtPlace& place, const ValueAt& value_at) {
  const double first = value_at(place.corners[0]);
  double low = first, high = first, value = first;
  for (std::size_t k = 1; k < static_cast<std::size_t>(place.n); ++k) {
    const double here = value_at(place.corners[k]);
    value += place.shares[k] * (here - first);
    low = std::min(low, here);
    high = std::max(high, here);
  }
  return low == high ? first : std::clamp(value, low, high);
}

/// Finds places in a mesh. It keeps a reference: the mesh must exist and not change. Several threads may use it.
class PointLocator {
 public:
  explicit PointLocator(const Mesh& mesh) : mesh_(mesh) {}
  PointLocator(const PointLocator&) = delete;
  PointLocator& operator=(const PointLocator&) = delete;
  ~PointLocator();

  /// Finds the place of p by exact tests. If p is outside the mesh, this is the place of the nearest point. It depends
  /// on p alone, not on `nearby`. The weight of p does not count. Precondition: the mesh has a triangle, and none is
  /// erased. About O(distance from `nearby` in triangles); O(log n) without a `nearby` or with a bad one.
  [[nodiscard]] Place find(const WeightedPoint& p, TriangleId nearby = {}) const;
  /// Finds the place of a point of the plane.
  [[nodiscard]] Place find(Vec2 p, TriangleId nearby = {}) const { return find(WeightedPoint{p.x, p.y, 0}, nearby); }

 private:
  [[nodiscard]] const BoxTree& tree() const;

  const Mesh& mesh_;
  mutable std::atomic<const BoxTree*> made_tree_ = nullptr;
};

/// Returns the place in `before` of each vertex of `after`, a mesh of the same domain. `vertices`: number of each
/// vertex in `before`, invalid for new vertices; empty: the same numbers. If a vertex of `after` is exactly at a vertex
/// of `before`, its place is that vertex. If it is off an edge only by rounding, as after sliding on a boundary, its
/// place is on the edge. Then the corner opposite the edge does not count. O(n log n), about O(n) if most vertices have
/// moved little.
[[nodiscard]] IdVector<VertexId, Place> positions_of_vertices(const Mesh& before, const Mesh& after,
                                                              const IdVector<VertexId, VertexId>& vertices = {},
                                                              Executor* executor = nullptr);

/// Returns, for each triangle of `after`, the triangle of `before` that contains its centroid. If that is of
/// another region, a triangle of the same region that touches it replaces it, if there is one. If `before` had the same
/// triangle at the same places, the result is exactly that triangle. `places`: positions_of_vertices(). The cost is the
/// same.
[[nodiscard]] IdVector<TriangleId, TriangleId> sources_of_triangles(const Mesh& before, const Mesh& after,
                                                                    const IdVector<VertexId, Place>& places,
                                                                    Executor* executor = nullptr);

}  // namespace temper
