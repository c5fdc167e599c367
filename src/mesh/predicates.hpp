// The predicates for vertices of a mesh, in its space.
#pragma once

#include "geometry/predicates_inline.hpp"
#include "temper/mesh.hpp"

namespace temper::inlined {

/// Zero if the corners do not fit into half a period along each axis: then it is unknown which images are meant.
[[gnu::noinline]] inline Sign orientation_of_images(const Mesh& mesh, VertexId a, VertexId b, VertexId c) {
  const auto [p, q, r] = mesh.points(a, b, c);
  const Space& space = mesh.space();
  if (!space.are_near(p, q) || !space.are_near(q, r) || !space.are_near(r, p)) return Sign::zero;
  return temper::orient2d(p.position(), q.position(), r.position());
}

[[nodiscard]] inline Sign orientation(const Mesh& mesh, VertexId a, VertexId b, VertexId c) {
  if (mesh.space().is_periodic()) [[unlikely]]
    return orientation_of_images(mesh, a, b, c);
  return inlined::orientation(mesh.space(), mesh.point(a), mesh.point(b), mesh.point(c));
}

[[gnu::noinline]] inline Sign power_test_elsewhere(const Mesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  if (mesh.space().is_periodic()) {
    const auto [p, q, r] = mesh.points(a, b, c);
    return temper::power_test(p, q, r, mesh.point(d, p));
  }
  return temper::power_test(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c),
                            mesh.weighted_vector(d));
}

/// The power test of edge ab, with c on its left and d on its right. The space is checked before points are fetched: in
/// the plane they never leave the registers.
TEMPER_INLINE Sign power_test(const Mesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  if (mesh.space().kind() == SpaceKind::plane) [[likely]]
    return inlined::power_test(mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(d));
  return power_test_elsewhere(mesh, a, b, c, d);
}

[[nodiscard]] inline bool is_well_centered(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  return inlined::is_well_centered(mesh.space(), p, q, r);
}

}  // namespace temper::inlined
