// The duals of an edge of a surface with their exact signs, as regularity/duals.hpp for meshes.
#pragma once

#include "regularity/duals.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// Sign of the height over h in its triangle.
[[nodiscard]] inline Sign height_sign(const SurfaceMesh& mesh, HalfedgeId h) {
  const Mesh& c = mesh.connectivity();
  return signed_height_sign(mesh.point(c.origin(h)), mesh.point(c.target(h)), mesh.point(c.opposite(h)));
}

/// Sign of the dual length of an inner edge.
[[nodiscard]] inline Sign dual_sign(const SurfaceMesh& mesh, HalfedgeId h) {
  const Mesh& c = mesh.connectivity();
  return dual_length_sign(mesh.point(c.origin(h)), mesh.point(c.target(h)), mesh.point(c.opposite(h)),
                          mesh.point(c.opposite(c.twin(h))));
}

/// Signed length of the dual of an edge over the length of the edge, or of its part on the side of h.
[[nodiscard]] double dual_over_length(const SurfaceMesh& mesh, HalfedgeId h, DualKind kind, Sign sign);

/// Calls visit(kind, halfedge, sign) for the dual of an edge and for its parts. h represents the edge.
template <class Visit>
void visit_duals(const SurfaceMesh& mesh, HalfedgeId h, const Visit& visit) {
  const Mesh& connectivity = mesh.connectivity();
  if (connectivity.is_boundary(h)) return visit(DualKind::boundary, h, height_sign(mesh, h));
  visit(DualKind::inside, h, dual_sign(mesh, h));
  if (!is_interface(connectivity, h)) return;
  for (const HalfedgeId side : {h, connectivity.twin(h)}) visit(DualKind::region, side, height_sign(mesh, side));
}

}  // namespace temper::surfaces
