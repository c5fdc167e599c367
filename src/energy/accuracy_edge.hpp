// The energy of one edge for the accuracy objective, and its derivatives: see accuracy_energy.hpp.
//
//     W(L, G, H, δw) = (G/L) (a L² + b G² + p δw² + q H²) = a G L + K/L,    K = G (b G² + p δw² + q H²)
//
// Domain L > 0. Scaling exponent 4. Odd in G and H together, even in δw.
#pragma once

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <numbers>

namespace temper {

/// E of an edge is scale · (G/L) (length L² + dual G² + split δw² + height H²).
struct EdgeWeights {
  double length = 0, dual = 0, split = 0, height = 0;
};

/// What an edge is made of.
struct AccuracyEdge {
  double l2, inverse_l2;
  double sum, difference;  ///< G, H: of the heights times ℓ on the two sides
  double dw2;              ///< δw²
};

[[nodiscard]] inline double edge_value(const EdgeWeights& k, const AccuracyEdge& e) {
  return e.sum * (k.length * e.l2 +
                  (k.dual * e.sum * e.sum + k.split * e.dw2 + k.height * e.difference * e.difference) * e.inverse_l2);
}

/// ∂ and ∂² of W in L, the g on the left, the g on the right (G = left + right, H = left − right) and δw.
struct EdgeSlopes {
  double l = 0, left = 0, right = 0, dw = 0;
  double l_l = 0, l_left = 0, l_right = 0, l_dw = 0;
  double left_left = 0, left_right = 0, right_right = 0, side_dw = 0, dw_dw = 0;  // side: left or right, the same
};

[[nodiscard]] inline EdgeSlopes edge_slopes(const EdgeWeights& k, const AccuracyEdge& e, double dw) {
  const double g = e.sum, h = e.difference, inv = e.inverse_l2, inv2 = inv * inv;
  const double rest = k.split * e.dw2 + k.height * h * h;
  const double cubic = g * (k.dual * g * g + rest);  // K
  const double by_g = 3 * k.dual * g * g + rest;     // K_G
  const double by_h = 2 * k.height * g * h;          // K_H
  const double by_dw = 2 * k.split * g * dw;         // K_δw
  const double w_g = k.length * e.l2 + by_g * inv, w_h = by_h * inv;
  const double w_lg = k.length - by_g * inv2, w_lh = -by_h * inv2;
  const double w_gg = 6 * k.dual * g * inv, w_hh = 2 * k.height * g * inv, w_gh = 2 * k.height * h * inv;
  EdgeSlopes s;
  s.l = k.length * g - cubic * inv2;
  s.left = w_g + w_h, s.right = w_g - w_h;
  s.dw = by_dw * inv;
  s.l_l = 2 * cubic * inv2 * inv;
  s.l_left = w_lg + w_lh, s.l_right = w_lg - w_lh;
  s.l_dw = -by_dw * inv2;
  s.left_left = w_gg + 2 * w_gh + w_hh, s.right_right = w_gg - 2 * w_gh + w_hh, s.left_right = w_gg - w_hh;
  s.side_dw = 2 * k.split * dw * inv;
  s.dw_dw = 2 * k.split * g * inv;
  return s;
}

/// The natural logarithm of a normal x > 0, to 2⁻⁵¹ or so: with the same bits wherever IEEE arithmetic is, which those
/// of C libraries do not have.
[[nodiscard]] inline double portable_log(double x) {
  // x = m 2^k with m in [√½, √2); ln m = 2 artanh z, z = (m − 1)/(m + 1), z² < 0.0295: eleven terms reach rounding.
  constexpr std::uint64_t kHalfRoot = 0x3fe6a09e667f3bcd;  // √½
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const std::int64_t k = static_cast<std::int64_t>(bits - kHalfRoot) >> 52;
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(k) << 52));
  const double z = (m - 1) / (m + 1), z2 = z * z;
  double series = 1.0 / 21;
  for (const double term : {1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3}) {
    series = series * z2 + term;
  }
  return static_cast<double>(k) * std::numbers::ln2 + 2 * (z + z * z2 * series);
}

}  // namespace temper
