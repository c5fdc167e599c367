// Random triangulations of small point sets, by splitting and flipping: meshes whose every part is known to be valid.
#pragma once

#include <vector>

#include "base/rng.hpp"
#include "temper/topology.hpp"
#include "unit/mesh/inputs.hpp"

namespace temper::test {

/// A square with random points inside, then random flips.
inline Mesh random_triangulation(Rng& rng, int n_points) {
  Mesh mesh = built({{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {{0, 1, 2}, {0, 2, 3}}});
  for (int i = 0; i < n_points; ++i) {
    // Random barycentric coordinates well inside a random triangle.
    const TriangleId t(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_triangles()))});
    const auto [a, b, c] = mesh.corners(t);
    const double u = rng.uniform(0.2, 0.4), v = rng.uniform(0.2, 0.4);
    const Vec2 p = u * mesh.position(a) + v * mesh.position(b) + (1 - u - v) * mesh.position(c);
    insert_in_triangle(mesh, t, {p.x, p.y, rng.uniform(-1, 1)});
  }
  for (int i = 0; i < 4 * n_points; ++i) {
    const HalfedgeId h(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_halfedges()))});
    if (can_flip(mesh, h) == FlipStatus::possible) flip(mesh, h);
  }
  return mesh;
}

/// The arrays of a mesh; unused points are left out.
inline Arrays arrays_of(const Mesh& mesh, const std::vector<TriangleId>& triangles) {
  Arrays arrays;
  std::vector<std::int32_t> number(mesh.n_vertices(), -1);
  for (const TriangleId t : triangles) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = mesh.corners(t)[k];
      if (number[v.index] < 0) {
        number[v.index] = static_cast<std::int32_t>(arrays.points.size());
        arrays.points.push_back(mesh.position(v));
      }
      corners[k] = number[v.index];
    }
    arrays.triangles.push_back(corners);
  }
  return arrays;
}

}  // namespace temper::test
