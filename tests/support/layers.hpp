// Layers that grow by a factor: right triangles as thin as they have to be, all of which weights alone can cure.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "temper/mesh.hpp"

namespace temper::test {

struct LayerOptions {
  int columns = 10, rows = 20;
  double growth = 1.7;  ///< of a row's height, from one to the next
  double height = 0.5;  ///< of all of them; they are as wide as 1
};

/// Rectangles, each cut along the same diagonal.
inline Mesh layers(const LayerOptions& options = {}) {
  std::vector<double> ys = {0};
  for (double step = 1; static_cast<int>(ys.size()) <= options.rows; step *= options.growth) {
    ys.push_back(ys.back() + step);
  }
  std::vector<Vec2> points;
  for (const double y : ys) {
    for (int i = 0; i <= options.columns; ++i) {
      points.push_back({static_cast<double>(i) / options.columns, options.height * y / ys.back()});
    }
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j < options.rows; ++j) {
    for (int i = 0; i < options.columns; ++i) {
      const int a = j * (options.columns + 1) + i, b = a + 1, c = a + options.columns + 1, d = c + 1;
      triangles.push_back({a, b, d});
      triangles.push_back({a, d, c});
    }
  }
  auto built = Mesh::build({.points = points, .triangles = triangles});
  if (!built) {
    ADD_FAILURE() << built.error().what();
    return {};
  }
  return std::move(built->mesh);
}

}  // namespace temper::test
