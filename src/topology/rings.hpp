// The triangles around triangles.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// The triangles at these vertices; sorted.
[[nodiscard]] inline std::vector<TriangleId> triangles_at(const Mesh& mesh, std::span<const VertexId> vertices) {
  std::vector<TriangleId> all;
  for (const VertexId v : vertices) {
    for (const HalfedgeId h : mesh.star(v)) all.push_back(Mesh::triangle(h));
  }
  sort_unique(all);
  return all;
}

/// The triangles at the corners of these, themselves included; sorted. Precondition: none is erased.
[[nodiscard]] inline std::vector<TriangleId> triangles_around(const Mesh& mesh, std::span<const TriangleId> triangles) {
  TEMPER_ASSERT_SLOW(std::none_of(triangles.begin(), triangles.end(), [&](TriangleId t) { return mesh.is_erased(t); }));
  std::vector<VertexId> corners;
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(v);
  }
  return triangles_at(mesh, corners);
}

}  // namespace temper
