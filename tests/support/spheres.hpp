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
    const auto is_north = [&](VertexId v) { return globe.weighted_vector(v).z > northernmost; };
    if (std::any_of(corners.begin(), corners.end(), is_north)) continue;
    triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& n = number[corners[k].index];
      if (n < 0) {
        n = static_cast<std::int32_t>(points.size());
        points.push_back(globe.weighted_vector(corners[k]));
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

/// A mesh of the plane without weights, seen from the center on the sphere that it touches at the pole.
inline Mesh on_cap(const Mesh& plane, double radius) {
  std::vector<Vec3> places;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 2>> constrained;
  const auto number = [](VertexId v) { return static_cast<std::int32_t>(v.index); };
  for (const VertexId v : plane.vertices()) {
    const Vec3 p = {plane.position(v).x, plane.position(v).y, radius};
    places.push_back(radius / length(p) * p);
  }
  for (const TriangleId t : plane.triangles()) {
    const auto [a, b, c] = plane.corners(t);
    triangles.push_back({number(a), number(b), number(c)});
  }
  for (const HalfedgeId h : plane.halfedges()) {
    if (plane.is_constrained(h) && plane.is_edge_representative(h)) {
      constrained.push_back({number(plane.origin(h)), number(plane.target(h))});
    }
  }
  MeshInput input;
  input.space = Space::sphere(radius);
  input.sphere_points = places, input.triangles = triangles, input.constrained_edges = constrained;
  return Mesh::build(input)->mesh;
}

}  // namespace temper::test
