// Meshes of the sphere for tests: whole ones, and ones with a coast.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "temper/generate.hpp"
#include "temper/mesh.hpp"

namespace temper::test {

inline Mesh globe(std::size_t vertices, std::uint64_t seed = 1, double radius = 1) {
  auto mesh = random_sphere({.vertices = vertices, .seed = seed, .radius = radius});
  EXPECT_TRUE(mesh) << mesh.error().what();
  return *std::move(mesh);
}

/// The triangles of a globe south of a latitude: with a coast.
inline Mesh ocean(const Mesh& globe, double northernmost) {
  std::vector<Vec3> points;  // lifted
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> number(globe.n_vertices(), -1);
  for (const TriangleId t : globe.triangles()) {
    const auto corners = globe.corners(t);
    const auto is_north = [&](VertexId v) { return globe.lifted_point(v).z > northernmost; };
    if (std::any_of(corners.begin(), corners.end(), is_north)) continue;
    triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& n = number[corners[k].index];
      if (n < 0) {
        n = static_cast<std::int32_t>(points.size());
        points.push_back(globe.lifted_point(corners[k]));
      }
      triangles.back()[k] = n;
    }
  }
  std::vector<Vec3> places;
  for (const Vec3 p : points) places.push_back(globe.space().radius() / length(p) * p);
  MeshInput input;
  input.space = globe.space();
  input.sphere_points = places;
  input.triangles = triangles;
  auto built = Mesh::build(input);
  EXPECT_TRUE(built) << built.error().what();
  for (std::size_t i = 0; i < points.size(); ++i) built->mesh.set_point(VertexId(i), as_point(points[i]));
  EXPECT_FALSE(built->mesh.validate());
  return std::move(built->mesh);
}

}  // namespace temper::test
