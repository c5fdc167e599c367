// The predicates for vertices of a mesh, in its space.
#pragma once

#include "geometry/predicates_inline.hpp"
#include "temper/mesh.hpp"

namespace temper::inlined {

[[nodiscard]] inline Sign orientation(const Mesh& mesh, VertexId a, VertexId b, VertexId c) {
  return inlined::orientation(mesh.space(), mesh.point(a), mesh.point(b), mesh.point(c));
}

[[nodiscard]] inline Sign power_test(const Mesh& mesh, VertexId a, VertexId b, VertexId c, VertexId d) {
  return inlined::power_test(mesh.space(), mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(d));
}

[[nodiscard]] inline bool is_well_centered(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.corners(t);
  return inlined::is_well_centered(mesh.space(), mesh.point(p), mesh.point(q), mesh.point(r));
}

}  // namespace temper::inlined
