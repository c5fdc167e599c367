// Small meshes by hand, for tests of what looks at meshes.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "temper/mesh.hpp"

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

}  // namespace temper::test
