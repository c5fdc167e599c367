// One side of a triangle in space: its height over its length, and the chain rule from there to corners and weights.
//
//            c
//           / \        u = j − i    ℓ² = u·u   q = u·v     S = |u × v|, twice the area
//        v /   \       v = c − i    r = v·v    dw = w_i − w_j
//         /     \      h/ℓ = N / (2 S),  N = r − q + w_i − w_c − dw q/ℓ²
//        i───u───j
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// Derivatives by the three corners and weights.
struct CornerSlopes {
  std::array<Vec3, 3> by_corner = {};
  std::array<double, 3> by_weight = {};
};

/// Derivatives by ℓ², r, q and the weights at i, j and c.
struct SideSlopes {
  double l2, r, q, i, j, c;
};

/// The side opposite corner c.
struct TriangleSide {
  std::size_t i, j, c;
  Vec3 u, v;
  double l2, r, q, s2, dw;
  double n;       ///< N
  double height;  ///< h/ℓ; 0 if doubles have no area

  TriangleSide(const std::array<WeightedPoint, 3>& points, std::size_t corner)
      : i((corner + 1) % 3),
        j((corner + 2) % 3),
        c(corner),
        u(points[j].position() - points[i].position()),
        v(points[c].position() - points[i].position()),
        l2(squared_length(u)),
        r(squared_length(v)),
        q(dot(u, v)),
        s2(squared_length(cross(u, v))),
        dw(points[i].w - points[j].w),
        n(r - q + points[i].w - points[c].w - q / l2 * dw),
        height(s2 > 0 ? n / (2 * std::sqrt(s2)) : 0) {}

  /// The derivatives of a function that has this derivative by h/ℓ.
  [[nodiscard]] SideSlopes slopes_of_height(double by_height) const {
    const double s = std::sqrt(s2);
    const double by_n = by_height / (2 * s), by_s = -by_height * n / (2 * s2);
    return {by_n * q * dw / (l2 * l2) + by_s * r / (2 * s),
            by_n + by_s * l2 / (2 * s),
            -by_n * (1 + dw / l2) - by_s * q / s,
            by_n * (1 - q / l2),
            by_n * q / l2,
            -by_n};
  }
  /// Adds the derivatives by corners and weights.
  void add(const SideSlopes& by, CornerSlopes& e) const {
    e.by_weight[i] += by.i;
    e.by_weight[j] += by.j;
    e.by_weight[c] += by.c;
    const Vec3 at_j = 2 * by.l2 * u + by.q * v, at_c = 2 * by.r * v + by.q * u;
    e.by_corner[j] = e.by_corner[j] + at_j;
    e.by_corner[c] = e.by_corner[c] + at_c;
    e.by_corner[i] = e.by_corner[i] - at_j - at_c;
  }
};

}  // namespace temper::surfaces
