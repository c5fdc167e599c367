// The energy of one triangle in space, with its derivatives by the corners and weights.
//
//   E = −Σ φ(h/ℓ) − Σ φ(d/ℓ) − Σ φ(1 − d/ℓ) + ln(Σ ℓ²/(6 S)),   φ(f) = ln((f + √(f² + γ²))/2)
//
// over the three edges; S is twice the area. φ is finite for all f: a triangle that is not well-centered has a finite
// energy, which grows as γ → 0. The last term is the least in equilateral triangles. E does not change with the unit of
// length.
#pragma once

#include <array>
#include <cmath>

#include "base/portable_log.hpp"
#include "surfaces/optimize/triangle_side.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// A value with its derivatives by the three corners and weights.
struct BarrierValue : CornerSlopes {
  double value = 0;
};

/// φ and its derivative.
struct SmoothLog {
  double value, slope;
};
[[nodiscard]] inline SmoothLog smooth_log(double f, double gamma) {
  const double root = std::sqrt(f * f + gamma * gamma);
  const double sum = f > 0 ? f + root : gamma * gamma / (root - f);
  return {portable_log(0.5 * sum), 1 / root};
}

[[nodiscard]] inline BarrierValue barrier(const std::array<WeightedPoint, 3>& points, double gamma) {
  BarrierValue e;
  double squares = 0;
  for (std::size_t c = 0; c < 3; ++c) squares += squared_length(points[(c + 1) % 3].position() - points[c].position());
  for (std::size_t c = 0; c < 3; ++c) {
    const TriangleSide side(points, c);
    const SmoothLog height = smooth_log(side.height, gamma);
    e.value -= height.value;
    SideSlopes by = side.slopes_of_height(-height.slope);
    by.l2 += 1 / squares;
    if (c == 0) {
      e.value += portable_log(squares / (6 * std::sqrt(side.s2)));
      by.r -= side.l2 / (2 * side.s2), by.q += side.q / side.s2, by.l2 -= side.r / (2 * side.s2);
    }
    for (const double half : {0.5, -0.5}) {
      const SmoothLog crossing = smooth_log(0.5 + half * side.dw / side.l2, gamma);
      e.value -= crossing.value;
      const double slope = -crossing.slope * half;
      by.i += slope / side.l2, by.j -= slope / side.l2, by.l2 -= slope * side.dw / (side.l2 * side.l2);
    }
    side.add(by, e);
  }
  return e;
}

}  // namespace temper::surfaces
