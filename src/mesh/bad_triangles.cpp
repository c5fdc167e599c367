#include "mesh/bad_triangles.hpp"

#include "mesh/predicates.hpp"

namespace temper {

bool is_bad(const Mesh& mesh, TriangleId t) {
  if (mesh.is_erased(t)) return false;
  return !inlined::is_well_centered(mesh, t);
}

std::vector<TriangleId> bad_triangles(const Mesh& mesh) {
  std::vector<TriangleId> bad;
  for (const TriangleId t : mesh.triangles()) {
    if (is_bad(mesh, t)) bad.push_back(t);
  }
  return bad;
}

}  // namespace temper
