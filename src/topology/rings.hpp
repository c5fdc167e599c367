// The triangles around triangles.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/assert.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// The triangles at the corners of these, themselves included; sorted. Precondition: none is erased.
[[nodiscard]] inline std::vector<TriangleId> triangles_around(const Mesh& mesh, std::span<const TriangleId> triangles) {
  TEMPER_ASSERT_SLOW(std::none_of(triangles.begin(), triangles.end(), [&](TriangleId t) { return mesh.is_erased(t); }));
  std::vector<TriangleId> around;
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) {
      for (const HalfedgeId h : mesh.star(v)) around.push_back(Mesh::triangle(h));
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

}  // namespace temper
