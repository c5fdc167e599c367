// Small meshes by hand, for tests of what looks at meshes.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
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

inline double area(const Mesh& mesh) {
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    const auto [a, b, c] = mesh.corners(t);
    sum += 0.5 * doubled_area(mesh.position(a), mesh.position(b), mesh.position(c));
  }
  return sum;
}

/// Random points in two regions, and so a line of constrained edges between them, some of them in line.
inline Mesh mesh_with_regions(std::size_t vertices, std::uint64_t seed) {
  Mesh mesh = *random_mesh({.vertices = vertices, .seed = seed});
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    mesh.set_region(t, mesh.position(a).x + mesh.position(b).x + mesh.position(c).x > 1.2 ? 1 : 0);
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h) && mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)))) {
      mesh.set_constrained(h, true);
    }
  }
  return mesh;
}

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
