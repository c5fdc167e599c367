// Distances between neighbours.
#pragma once

#include <algorithm>
#include <limits>

#include "temper/mesh.hpp"

namespace temper {

/// The squared length of the shortest edge at v, on the sphere between lifted points; +∞ at a vertex of no triangle.
[[nodiscard]] inline double squared_shortest_edge(const Mesh& mesh, VertexId v) {
  const WeightedPoint p = mesh.point(v);
  double least = std::numeric_limits<double>::infinity();
  for (const HalfedgeId h : mesh.star(v)) {
    for (const VertexId u : {mesh.target(h), mesh.opposite(h)}) {
      least = std::min(least, squared_length(mesh.space().chord(p, mesh.point(u, p))));
    }
  }
  return least;
}

}  // namespace temper
