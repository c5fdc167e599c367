// Places: where in a mesh a point is, and so what the data of the mesh are there.
//
// Data at vertices are taken to be linear on triangles, data of triangles constant on each. That makes both functions
// of the plane or the sphere, which do not care how a mesh is numbered. A mesh that has been changed gets its data from
// them: each vertex those at the place in the former mesh where it is now, each triangle those of the one there that
// its middle is in. On the sphere triangles are the flat ones between the places of their corners, whose weights do not
// count, and a point is in the one that its ray from the center meets.
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

/// A point of a mesh: a mean of the corners around it.
struct Place {
  TriangleId triangle;                    ///< that the point is in or on
  int n = 0;                              ///< how many corners count: 1 at a vertex, 2 on an edge, 3 within a triangle
  std::array<VertexId, 3> corners = {};   ///< the first n
  std::array<double, 3> shares = {1, 0};  ///< of each: not negative, and 1 in all but for rounding
  bool outside = false;                   ///< the point asked for is beyond the mesh, whose nearest point this is

  /// Exactly at a vertex.
  [[nodiscard]] static Place at(VertexId v, TriangleId t) { return {t, 1, {v}, {1}, false}; }
};

/// The value at a place of what is linear on triangles, and value_at(v) at vertices. Never beyond the values at the
/// corners that count; exactly that of them all where they agree.
template <class ValueAt>
[[nodiscard]] double interpolated(const Place& place, const ValueAt& value_at) {
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

/// Finds places in a mesh, which it looks at: it must be there, and stay as it is. Safe to ask from several threads.
class PointLocator {
 public:
  explicit PointLocator(const Mesh& mesh) : mesh_(mesh) {}
  PointLocator(const PointLocator&) = delete;
  PointLocator& operator=(const PointLocator&) = delete;
  ~PointLocator();

  /// The place of p, by exact tests; beyond the mesh, that of its nearest point. A function of p alone, whatever the
  /// triangle that it is looked for from. About O(distance from that one in triangles); O(log n) without or with a bad
  /// one. Precondition: the mesh has a triangle, and none that is erased. A point of the mesh's space: its weight does
  /// not count.
  [[nodiscard]] Place find(const WeightedPoint& p, TriangleId near = {}) const;
  /// Of a point of the plane.
  [[nodiscard]] Place find(Vec2 p, TriangleId near = {}) const { return find(WeightedPoint{p.x, p.y, 0}, near); }

 private:
  [[nodiscard]] const BoxTree& tree() const;

  const Mesh& mesh_;
  mutable std::atomic<const BoxTree*> made_tree_ = nullptr;
};

/// The place in `before` of each vertex of `after`, a mesh of the same domain. `vertices`: the number in `before` of
/// each vertex, invalid where there was none; empty: the same numbers. A vertex that is exactly where one of `before`
/// was is at that vertex; one that is off an edge by no more than rounding is on it, as those are that slid on a
/// boundary, so that what is across from the edge does not count. O(n log n), about O(n) where most have moved little.
[[nodiscard]] IdVector<VertexId, Place> positions_of_vertices(const Mesh& before, const Mesh& after,
                                                              const IdVector<VertexId, VertexId>& vertices = {},
                                                              Executor* executor = nullptr);

/// The triangle of `before` that the middle of each triangle of `after` is in, within the same region where there is
/// one around; exactly the same triangle, if `before` had it, its corners in the same places. `places`:
/// positions_of_vertices(). Costs the same.
[[nodiscard]] IdVector<TriangleId, TriangleId> sources_of_triangles(const Mesh& before, const Mesh& after,
                                                                    const IdVector<VertexId, Place>& places,
                                                                    Executor* executor = nullptr);

}  // namespace temper
