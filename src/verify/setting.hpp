// A mesh, its operators, and the frame that fields lie in: what each measure is given. Lengths are those of the frame.
#pragma once

#include <cmath>

#include "temper/dec.hpp"
#include "temper/verify.hpp"

namespace temper::verify_detail {

struct Setting {
  const Mesh& mesh;
  const DecComplex& dec;
  VerifyFrame frame;
  double area = 0;  ///< of the domain, in the frame
  Executor* executor = nullptr;

  [[nodiscard]] Vec2 in_frame(Vec2 p) const { return (1 / frame.half_size) * (p - frame.center); }
  [[nodiscard]] double length_in_frame(double length) const { return length / frame.half_size; }
  [[nodiscard]] double area_in_frame(double area_of_mesh) const {
    return area_of_mesh / frame.half_size / frame.half_size;
  }
  [[nodiscard]] Vec2 vertex(VertexId v) const { return in_frame(mesh.position(v)); }
  [[nodiscard]] Vec2 orthocenter(TriangleId t) const { return in_frame(dec.orthocenters[t]); }
};

/// +1 where the domain is on the left of a boundary edge, −1 where it is on the right.
inline double inner_side(const DecEdge& edge) { return edge.left.valid() ? 1 : -1; }

/// Unit vector from `from` to `to`.
inline Vec2 direction(const Setting& setting, const DecEdge& edge) {
  return (1 / edge.length) * (setting.mesh.position(edge.to) - setting.mesh.position(edge.from));
}
/// The same a quarter turn to the left.
inline Vec2 turned_left(Vec2 t) { return {-t.y, t.x}; }

/// Errors are reported as +∞ and never as NaN.
inline double finite_or_infinity(double value) { return std::isfinite(value) ? value : HUGE_VAL; }

}  // namespace temper::verify_detail
