// The duals of a face with their exact signs, for criteria and reports: the words of regularity/duals.hpp.
#pragma once

#include "regularity/duals.hpp"
#include "temper/tets/criterion.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {

/// Sign of the height over h of its tetrahedron. Exact.
[[nodiscard]] inline Sign height_sign(const TetMesh& mesh, HalffaceId h) {
  const auto [a, b, c] = points_of(mesh, h);
  return signed_height_sign(a, b, c, mesh.point(mesh.opposite(h)));
}

/// Says whether the orthocenter of a tetrahedron, in either orientation, is inside. Exact.
[[nodiscard]] inline bool is_well_centered(const TetMesh& mesh, TetId t) {
  for (int f = 0; f < 4; ++f) {
    if (height_sign(mesh, TetMesh::halfface(t, f)) != Sign::positive) return false;
  }
  return true;
}

/// Sign of the length of the dual of an inner face. Exact.
[[nodiscard]] inline Sign dual_sign(const TetMesh& mesh, HalffaceId h) {
  const auto [a, b, c] = points_of(mesh, h);
  return -power_test(a, b, c, mesh.point(mesh.opposite(h)), mesh.point(mesh.opposite(mesh.twin(h))));
}

/// Signed length of the dual of a face over the length of the face, or of its part on the side of h.
[[nodiscard]] inline double dual_over_length(const TetMesh& mesh, HalffaceId h, DualKind kind, Sign sign) {
  const FacePoints face = points_of(mesh, h);
  const auto& [a, b, c] = face;
  double dual = signed_height(a, b, c, mesh.point(mesh.opposite(h)));
  if (kind == DualKind::inside) dual += signed_height(a, c, b, mesh.point(mesh.opposite(mesh.twin(h))));
  return with_sign(dual / length_of_area(area(face)), sign);
}

/// Calls visit(kind, halfface, sign) for the dual of a face and for its parts. h represents the face.
template <class Visit>
void visit_duals(const TetMesh& mesh, HalffaceId h, const Visit& visit) {
  if (mesh.is_boundary(h)) return visit(DualKind::boundary, h, height_sign(mesh, h));
  visit(DualKind::inside, h, dual_sign(mesh, h));
  if (!mesh.bounds_region(h)) return;
  for (const HalffaceId side : {h, mesh.twin(h)}) visit(DualKind::region, side, height_sign(mesh, side));
}

}  // namespace temper::tets
