// Inputs of Mesh::build as values, and small meshes whose triangles and holes are counted by hand.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "temper/mesh.hpp"

namespace temper::test {

/// A MeshInput that owns its arrays.
struct Arrays {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<double> weights = {};
  std::vector<std::array<std::int32_t, 2>> constrained_edges = {};
  std::vector<std::int32_t> regions = {};
  std::vector<std::int32_t> fixed_vertices = {};

  [[nodiscard]] Expected<BuiltMesh> build(const InputNames* names = nullptr) const {
    return Mesh::build({points, weights, triangles, constrained_edges, regions, fixed_vertices, names});
  }
};

/// The mesh of valid arrays.
inline Mesh built(const Arrays& arrays) {
  auto result = arrays.build();
  if (!result) {
    ADD_FAILURE() << result.error().what();
    return {};
  }
  return std::move(result->mesh);
}

/// The square [−1, 1]² around a vertex in its middle.
///
///      3 ------- 2
///      | \  2  / |
///      | 3  4  1 |      triangles counter-clockwise, 0 at the bottom
///      | /  0  \ |
///      0 ------- 1
inline Arrays fan() {
  return {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

/// n × n unit squares from a corner, each cut from lower left to upper right; squares in `left_out` are holes.
inline Arrays squares(int n, Vec2 corner = {0, 0}, const std::vector<std::array<int, 2>>& left_out = {}) {
  Arrays arrays;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) arrays.points.push_back(corner + Vec2{double(i), double(j)});
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      bool hole = false;
      for (const auto& square : left_out) hole = hole || (square[0] == i && square[1] == j);
      if (hole) continue;
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      arrays.triangles.push_back({a, b, c});
      arrays.triangles.push_back({a, c, d});
    }
  }
  return arrays;
}

/// Both in one input, side by side in the arrays.
inline Arrays together(Arrays a, const Arrays& b) {
  const auto shift = static_cast<std::int32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& [p, q, r] : b.triangles) a.triangles.push_back({p + shift, q + shift, r + shift});
  return a;
}

/// Number of boundary loops, by walking each once.
inline std::size_t boundary_loops(const Mesh& mesh) {
  IdVector<HalfedgeId, std::uint8_t> seen(mesh.n_halfedges(), 0);
  std::size_t loops = 0;
  for (const HalfedgeId first : mesh.halfedges()) {
    if (!mesh.is_boundary(first) || seen[first] != 0) continue;
    ++loops;
    for (HalfedgeId h = first; seen[h] == 0; h = mesh.outgoing(mesh.target(h))) seen[h] = 1;
  }
  return loops;
}

}  // namespace temper::test
