#include "topology/rings.hpp"

#include <algorithm>

#include "base/assert.hpp"

namespace temper {

std::vector<TriangleId> triangles_around(const Mesh& mesh, std::span<const TriangleId> triangles) {
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
