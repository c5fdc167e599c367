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
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// A value with its derivatives by the three corners and weights.
struct BarrierValue {
  double value = 0;
  std::array<Vec3, 3> by_corner = {};
  std::array<double, 3> by_weight = {};
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
    const std::size_t i = (c + 1) % 3, j = (c + 2) % 3;
    const Vec3 u = points[j].position() - points[i].position(), v = points[c].position() - points[i].position();
    const double l = squared_length(u), r = squared_length(v), q = dot(u, v), s2 = squared_length(cross(u, v));
    const double s = std::sqrt(s2), m = points[i].w - points[j].w;
    // h/ℓ = N/(2 S), with N a function of l, r, q and the weights.
    const double n = r - q + points[i].w - points[c].w - q / l * m;
    const SmoothLog height = smooth_log(n / (2 * s), gamma);
    e.value -= height.value;
    const double by_n = -height.slope / (2 * s), by_s = height.slope * n / (2 * s2);
    double by_r = by_n + by_s * l / (2 * s), by_q = -by_n * (1 + m / l) - by_s * q / s;
    double by_l = by_n * q * m / (l * l) + by_s * r / (2 * s) + 1 / squares;
    double by_i = by_n * (1 - q / l), by_j = by_n * q / l;
    e.by_weight[c] -= by_n;
    if (c == 0) {
      e.value += portable_log(squares / (6 * s));
      by_r -= l / (2 * s2), by_q += q / s2, by_l -= r / (2 * s2);
    }
    for (const double side : {0.5, -0.5}) {
      const SmoothLog crossing = smooth_log(0.5 + side * m / l, gamma);
      e.value -= crossing.value;
      const double slope = -crossing.slope * side;
      by_i += slope / l, by_j -= slope / l, by_l -= slope * m / (l * l);
    }
    e.by_weight[i] += by_i;
    e.by_weight[j] += by_j;
    const Vec3 at_j = 2 * by_l * u + by_q * v, at_c = 2 * by_r * v + by_q * u;
    e.by_corner[j] = e.by_corner[j] + at_j;
    e.by_corner[c] = e.by_corner[c] + at_c;
    e.by_corner[i] = e.by_corner[i] - at_j - at_c;
  }
  return e;
}

}  // namespace temper::surfaces
