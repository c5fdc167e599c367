// The triangles around a vertex, for its size: their number and total area.
#pragma once

#include <cmath>
#include <numbers>

#include "geometry/surface.hpp"
#include "mesh/curve.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct StarArea {
  double doubled = 0;  ///< twice the area of all, inverted ones too
  int triangles = 0;

  /// The squared edge of an equilateral triangle of their mean area: 4/√3 A.
  [[nodiscard]] double squared_size() const { return 2 * std::numbers::inv_sqrt3 * doubled / triangles; }
  [[nodiscard]] double size() const { return std::sqrt(squared_size()); }
};

[[nodiscard]] inline StarArea star_area(const Mesh& mesh, VertexId v) {
  StarArea star;
  const WeightedPoint p = mesh.point(v);
  for (const HalfedgeId h : mesh.star(v)) {
    const WeightedPoint q = mesh.point(mesh.target(h), p), r = mesh.point(mesh.opposite(h), p);
    star.doubled += unsigned_doubled_area(mesh.space(), p, q, r);
    ++star.triangles;
  }
  return star;
}

/// local_sizes() along a walk over the mesh.
[[nodiscard]] IdVector<VertexId, double> local_sizes(const Mesh& mesh, const Walk& walk, Executor* executor);

}  // namespace temper
