// The lengths of edges and of their duals, on the sphere those of arcs.
#pragma once

#include "temper/geometry.hpp"
#include "temper/mesh.hpp"

namespace temper {

[[nodiscard]] inline double edge_length(const Mesh& mesh, HalfedgeId h) {
  const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h));
  if (mesh.space().is_plane()) return length(b.position() - a.position());
  return mesh.space().radius() * arc_length(lifted(a), lifted(b));
}

/// Signed. Precondition: h is not on the boundary.
[[nodiscard]] inline double dual_length(const Mesh& mesh, HalfedgeId h) {
  const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h));
  const WeightedPoint c = mesh.point(mesh.opposite(h)), d = mesh.point(mesh.opposite(mesh.twin(h)));
  if (mesh.space().is_plane()) return signed_height(a, b, c) + signed_height(b, a, d);
  const Vec3 p = lifted(a), q = lifted(b);
  return mesh.space().radius() * (signed_height(p, q, lifted(c)) + signed_height(q, p, lifted(d)));
}

}  // namespace temper
