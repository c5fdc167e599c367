// Small meshes by hand, for tests of what looks at meshes.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "temper/mesh.hpp"
#include "temper/regularity.hpp"

namespace temper::test {

inline Mesh mesh_of(const std::vector<Vec2>& points, const std::vector<std::array<std::int32_t, 3>>& triangles,
                    const std::vector<double>& weights = {}, const std::vector<std::int32_t>& regions = {}) {
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  input.weights = weights;
  input.regions = regions;
  auto built = Mesh::build(input);
  if (!built) {
    ADD_FAILURE() << built.error().what();
    return {};
  }
  return std::move(built->mesh);
}

inline Mesh one_triangle(Vec2 a, Vec2 b, Vec2 c, std::vector<double> weights = {}) {
  return mesh_of({a, b, c}, {{0, 1, 2}}, std::move(weights));
}

/// The paper's dense horseshoe (§6.5), 7 × 9 points, constrained Delaunay by flips from a grid.
inline Mesh dense_horseshoe() {
  constexpr int kAround = 7, kAcross = 9;
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j < kAcross; ++j) {
    for (int i = 0; i < kAround; ++i) {
      const double b = j / (kAcross - 1.0), angle = std::numbers::pi * (1 - i / (kAround - 1.0));
      points.push_back({(1 - b + 2 * b) * std::cos(angle), (1 - b + 4 * b) * std::sin(angle)});
    }
  }
  const auto turns_right = [&](int p, int q, int r) { return cross(points[q] - points[p], points[r] - points[p]) < 0; };
  for (int j = 0; j + 1 < kAcross; ++j) {
    for (int i = 0; i + 1 < kAround; ++i) {
      const int a = j * kAround + i, b = a + 1, c = b + kAround, d = a + kAround;  // clockwise
      if (turns_right(a, b, c) && turns_right(a, c, d)) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      }
    }
  }
  Mesh mesh = mesh_of(points, triangles);
  EXPECT_TRUE(restore_regularity(mesh).regular());
  return mesh;
}

}  // namespace temper::test
