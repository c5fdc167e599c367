// The precondition of whatever goes over all triangles: none of them is erased.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

/// Whether a triangle of the mesh is erased, until Mesh::compact drops it. O(n).
[[nodiscard]] inline bool has_erased_triangles(const Mesh& mesh) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) return true;
  }
  return false;
}

}  // namespace temper
