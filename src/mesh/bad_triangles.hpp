// The triangles that are not well-centered: optimization repairs them, explain explains them, and meshing counts them.
// Also the erased triangles, which loops over all triangles must skip.
#pragma once

#include <vector>

#include "mesh/predicates.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// is_bad says whether triangle t is not well-centered, exactly. An erased triangle is not bad.
[[nodiscard]] inline bool is_bad(const Mesh& mesh, TriangleId t) {
  if (mesh.is_erased(t)) return false;
  return !inlined::is_well_centered(mesh, t);
}
/// bad_triangles lists the triangles for which is_bad holds, in ascending order.
[[nodiscard]] inline std::vector<TriangleId> bad_triangles(const Mesh& mesh) {
  std::vector<TriangleId> bad;
  for (const TriangleId t : mesh.triangles()) {
    if (is_bad(mesh, t)) bad.push_back(t);
  }
  return bad;
}

/// Returns true if a triangle of the mesh is erased: it stays until Mesh::compact drops it. O(n).
[[nodiscard]] inline bool has_erased_triangles(const Mesh& mesh) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) return true;
  }
  return false;
}

}  // namespace temper
