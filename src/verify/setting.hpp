// A mesh, its operators, and the frame that fields lie in: what each measure is given. Lengths are those of the frame.
#pragma once

#include <cmath>

#include "temper/dec.hpp"
#include "temper/verify.hpp"
#include "verify/fields.hpp"

namespace temper::verify_detail {

struct Setting {
  const Mesh& mesh;
  const DecComplex& dec;
  VerifyFrame frame;
  double area = 0;  ///< of the domain, in the frame
  Executor* executor = nullptr;
  bool is_closed = false;  ///< without boundary: nothing is given on a boundary

  [[nodiscard]] bool is_plane() const { return mesh.space().is_plane(); }
  [[nodiscard]] Vec2 in_frame(Vec2 p) const { return (1 / frame.half_size) * (p - frame.center); }
  [[nodiscard]] double length_in_frame(double length) const { return length / frame.half_size; }
  [[nodiscard]] double area_in_frame(double area_of_mesh) const {
    return area_of_mesh / frame.half_size / frame.half_size;
  }
  [[nodiscard]] Place vertex(VertexId v) const {
    if (is_plane()) return in_frame(mesh.position(v));
    return unit(mesh.lifted_point(v));
  }
  [[nodiscard]] Place orthocenter(TriangleId t) const {
    if (is_plane()) return in_frame(dec.orthocenters[t]);
    return unit(dec.sphere_orthocenters[t]);
  }
  [[nodiscard]] Place midpoint(EdgeId e) const {
    if (is_plane()) return in_frame(dec.edges[e].midpoint);
    return unit(dec.sphere_midpoints[e]);
  }
  [[nodiscard]] static Vec3 unit(Vec3 p) { return (1 / length(p)) * p; }
};

/// +1 where the domain is on the left of a boundary edge, −1 where it is on the right.
inline double inner_side(const DecEdge& edge) { return edge.left.valid() ? 1 : -1; }

/// Unit vector from `from` to `to`, in the coordinates of the edge's means: those of the plane, or on the sphere along
/// the edge and to the left of it.
inline Vec2 direction(const Setting& setting, const DecEdge& edge) {
  if (!setting.is_plane()) return {1, 0};
  const WeightedPoint from = setting.mesh.point(edge.from), to = setting.mesh.point(edge.to, from);
  return (1 / edge.length) * (to.position() - from.position());
}
/// The same a quarter turn to the left.
inline Vec2 turned_left(Vec2 t) { return {-t.y, t.x}; }
/// And to the right.
inline Vec2 turned_right(Vec2 t) { return {t.y, -t.x}; }

/// Errors are reported as +∞ and never as NaN.
inline double finite_or_infinity(double value) { return std::isfinite(value) ? value : HUGE_VAL; }

}  // namespace temper::verify_detail
