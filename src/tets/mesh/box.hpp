// Boxes around vertices.
#pragma once

#include <algorithm>

#include "temper/tets/mesh.hpp"

namespace temper::tets {

struct Box3 {
  Vec3 low, high;
};

/// The box of some vertices; the origin if there are none.
template <class Vertices>
[[nodiscard]] Box3 bounding_box(const TetMesh& mesh, const Vertices& vertices) {
  if (vertices.begin() == vertices.end()) return {};
  const Vec3 first = mesh.position(*vertices.begin());
  Box3 box = {first, first};
  for (const VertexId v : vertices) {
    const Vec3 p = mesh.position(v);
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}
[[nodiscard]] inline Box3 bounding_box(const TetMesh& mesh) { return bounding_box(mesh, mesh.vertices()); }

}  // namespace temper::tets
