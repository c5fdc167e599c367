// The predicates for vertices of a mesh, in its space.
#pragma once

#include "geometry/predicates_inline.hpp"
#include "temper/mesh.hpp"

namespace temper::inlined {

[[nodiscard]] inline Sign orientation(const Mesh& mesh, VertexId a, VertexId b, VertexId c) {
  return inlined::orientation(mesh.space(), mesh.point(a), mesh.point(b), mesh.point(c));
}

[[gnu::noinline]] inline Sign power_test_on_sphere(const Mesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  return temper::power_test(mesh.lifted_point(a), mesh.lifted_point(b), mesh.lifted_point(c), mesh.lifted_point(d));
}

// Which space it is, is asked before points are fetched: in the plane they never leave the registers.
TEMPER_INLINE Sign power_test(const Mesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  if (mesh.space().is_plane()) [[likely]]
    return inlined::power_test(mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(d));
  return power_test_on_sphere(mesh, a, b, c, d);
}

[[nodiscard]] inline bool is_well_centered(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.corners(t);
  return inlined::is_well_centered(mesh.space(), mesh.point(p), mesh.point(q), mesh.point(r));
}

}  // namespace temper::inlined
