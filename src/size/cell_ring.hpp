// The cell of a vertex, from its neighbors: the measures of MPAS-Tools. Their cells are vertices here.
#pragma once

#include <cstddef>
#include <vector>

#include "temper/detail/space.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A vertex with its neighbors, counter-clockwise. At a vertex on the boundary these are one more than its triangles.
struct CellRing {
  WeightedPoint center;
  std::vector<WeightedPoint> around;

  [[nodiscard]] const WeightedPoint& after(std::size_t k) const { return around[k + 1 < around.size() ? k + 1 : 0]; }
  [[nodiscard]] const WeightedPoint& before(std::size_t k) const { return around[(k > 0 ? k : around.size()) - 1]; }
};

/// Fills a ring, whose list has its memory already. `point(v, near)`: the place of a vertex, of its images the one near
/// a point.
template <class Point>
void gather(CellRing& ring, const Mesh& mesh, VertexId v, const Point& point) {
  ring.center = point(v, mesh.point(v));
  ring.around.clear();
  for (const HalfedgeId h : mesh.star(v)) {
    ring.around.push_back(point(mesh.target(h), ring.center));
    if (mesh.is_boundary(Mesh::prev(h))) ring.around.push_back(point(mesh.opposite(h), ring.center));
  }
}

/// Returns the mean distance of the neighbors: gridSpacing [length].
[[nodiscard]] double grid_spacing(const Space& space, const CellRing& ring);

/// Returns the length of the dual edge between the vertex and neighbor k, signed. Precondition: the ring is closed.
[[nodiscard]] double dual_length(const Space& space, const CellRing& ring, std::size_t k);
/// Returns the shortest over the longest dual of a closed ring: cellQuality.
[[nodiscard]] double cell_quality(const Space& space, const CellRing& ring);
/// Returns the distance of the centroid of the power cell from the vertex, for a closed ring [length]. It is measured
/// in the plane that touches the sphere there, and mapped back to the sphere; +∞ for a cell that is not
/// counter-clockwise.
[[nodiscard]] double centroid_offset(const Space& space, const CellRing& ring);

}  // namespace temper
