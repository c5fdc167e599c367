// The lengths of an interior edge and of its dual.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/triangle_kernel.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct EdgeLengths {
  double edge = 0;
  double dual = 0;  ///< negative where the orthocenters of the triangles on its sides have changed places
};

/// In doubles: a dual of nearly zero length may have either sign. Precondition: h is not on the boundary.
[[nodiscard]] inline EdgeLengths edge_lengths(const Mesh& mesh, HalfedgeId h) {
  const auto side = [&](HalfedgeId s) {
    const auto [a, b, c] = mesh.points(mesh.origin(s), mesh.target(s), mesh.opposite(s));
    return triangle_shape(mesh.space(), a, b, c).edges[0];
  };
  const EdgeShape left = side(h), right = side(mesh.twin(h));
  const double length = std::sqrt(left.l2);
  return {length, (left.g + right.g) / length};
}

/// The squared length of the shortest edge at v, on the sphere between weighted vectors; +∞ at a vertex of no triangle.
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
