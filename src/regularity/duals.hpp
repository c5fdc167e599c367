// The duals of an edge with their exact signs, for criteria and reports.
#pragma once

#include "mesh/predicates.hpp"
#include "temper/detail/criterion.hpp"
#include "topology/flip_inline.hpp"

namespace temper {

/// Says whether the dual has a sign that the criterion allows. Precondition: the criterion is not well_centered.
[[nodiscard]] constexpr bool allows(Criterion criterion, Sign dual) {
  return dual == Sign::positive || (dual == Sign::zero && criterion == Criterion::coefficients);
}

/// Sign of the height over h of its triangle. Exact. Negative in a triangle that is not counter-clockwise.
[[nodiscard]] inline Sign height_sign(const Mesh& mesh, HalfedgeId h) {
  const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  if (inlined::orientation(mesh.space(), a, b, c) != Sign::positive) return Sign::negative;
  return signed_height_sign(mesh.space(), a, b, c);
}

/// Sign of the length of the dual of an inner edge. Exact. Precondition: its triangles are counter-clockwise.
[[nodiscard]] inline Sign dual_sign(const Mesh& mesh, HalfedgeId h) {
  const inlined::Quad q = inlined::quad(mesh, h);
  return -inlined::power_test(mesh, q.a, q.b, q.c, q.d);
}

/// Says whether h is inside and the regions on its sides are different.
[[nodiscard]] inline bool is_interface(const Mesh& mesh, HalfedgeId h) {
  return !mesh.is_boundary(h) && mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)));
}

/// A rounded length with its exact sign. NaN becomes −∞, the worst.
[[nodiscard]] double with_sign(double rounded, Sign sign);

/// Signed length of the dual of an edge over the length of the edge, or of its part on the side of h.
[[nodiscard]] double dual_over_length(const Mesh& mesh, HalfedgeId h, DualKind kind, Sign sign);

/// Calls visit(kind, halfedge, sign) for the dual of an edge and for its parts. h represents the edge.
template <class Visit>
void visit_duals(const Mesh& mesh, HalfedgeId h, const Visit& visit) {
  if (mesh.is_diagonal(h)) return;
  if (mesh.is_boundary(h)) return visit(DualKind::boundary, h, height_sign(mesh, h));
  visit(DualKind::inside, h, dual_sign(mesh, h));
  if (!is_interface(mesh, h)) return;
  for (const HalfedgeId side : {h, mesh.twin(h)}) visit(DualKind::region, side, height_sign(mesh, side));
}

}  // namespace temper
