// Layers that grow by a factor: right triangles as thin as they have to be, all of which weights alone can cure.
#pragma once

#include <cstddef>
#include <vector>

#include "temper/generate.hpp"

namespace temper::test {

struct LayerOptions {
  int columns = 10, rows = 20;
  double growth = 1.7;  ///< of a row's height, from one to the next
  double height = 0.5;  ///< of all of them; they are as wide as 1
};

/// Rectangles, each cut along the same diagonal.
inline Mesh layers(const LayerOptions& options = {}) {
  Mesh mesh = *sheared_grid({.nx = options.columns, .ny = options.rows, .shear = 0});
  std::vector<double> ys = {0};
  for (double step = 1; static_cast<int>(ys.size()) <= options.rows; step *= options.growth) {
    ys.push_back(ys.back() + step);
  }
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    mesh.set_position(v, {p.x / options.columns, options.height * ys[static_cast<std::size_t>(p.y)] / ys.back()});
  }
  return mesh;
}

}  // namespace temper::test
