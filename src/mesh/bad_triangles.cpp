#include "mesh/bad_triangles.hpp"

#include "geometry/predicates_inline.hpp"

namespace temper {

bool is_bad(const Mesh& mesh, TriangleId t) {
  if (mesh.is_erased(t)) return false;
  const auto [p, q, r] = mesh.corners(t);
  return !inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r));
}

std::vector<TriangleId> bad_triangles(const Mesh& mesh) {
  std::vector<TriangleId> bad;
  for (const TriangleId t : mesh.triangles()) {
    if (is_bad(mesh, t)) bad.push_back(t);
  }
  return bad;
}

}  // namespace temper
