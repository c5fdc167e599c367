// The derivatives of scaled heights: those of a naive twin, to which differences converge with order two; and what
// belongs to one corner is a contraction of what belongs to all.
#include "geometry/height_derivatives.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "unit/energy/naive.hpp"

namespace temper::test {
namespace {

/// (q − p, w_q − w_p, r − p, w_r − w_p).
using Differences = std::array<Real, 6>;

constexpr Differences kTriangles[] = {{1.0L, 0.1L, 0.05L, 0.4L, 0.9L, -0.1L},
                                      {0.3L, -0.8L, 0.2L, 1.1L, 0.2L, 0.4L},
                                      {-0.7L, 0.4L, -0.3L, -0.1L, -1.2L, 0.1L},
                                      {1.0L, 0.0L, 0.0L, -0.9L, 0.2L, 0.0L}};
// Of the three heights: each by itself, and all.
constexpr std::array<double, 3> kFactors[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.7, -1.3, 2.1}};

/// f_pq g_pq + f_qr g_qr + f_rp g_rp.
Real twin(const Differences& u, const std::array<double, 3>& f) {
  const NaivePoint p{0, 0, 0}, q{u[0], u[1], u[2]}, r{u[3], u[4], u[5]};
  const NaiveEdge pq = naive_edge(p, q, r), qr = naive_edge(q, r, p), rp = naive_edge(r, p, q);
  return f[0] * pq.h_left * pq.l + f[1] * qr.h_left * qr.l + f[2] * rp.h_left * rp.l;
}

struct Derivatives {
  std::array<double, 6> gradient;
  std::array<std::array<double, 6>, 6> hessian;
};

struct Spokes {
  Spoke<double> a, b;
  double inverse_area;
};

Spokes spokes_of(const Differences& u) {
  const auto number = [&](std::size_t i) { return static_cast<double>(u[i]); };
  const PointOf<double> p{0, 0, 0}, q{number(0), number(1), number(2)}, r{number(3), number(4), number(5)};
  const Spoke<double> a = spoke(p, q), b = spoke(p, r);
  return {a, b, triangle_shape(a, b, q, r).inverse_area};
}

Derivatives of_triangle(const Differences& u, const std::array<double, 3>& f) {
  const auto [a, b, inverse_area] = spokes_of(u);
  const HeightsOfTriangle<double> heights = heights_of_triangle(a, b, inverse_area);
  Symmetric6<double> hessian = {};
  heights.add_hessian(f[0], f[1], f[2], hessian);
  Derivatives d;
  for (std::size_t i = 0; i < 6; ++i) {
    d.gradient[i] = f[0] * heights.pq[i] + f[1] * heights.qr[i] + f[2] * heights.rp[i];
    for (std::size_t j = 0; j <= i; ++j) d.hessian[i][j] = d.hessian[j][i] = hessian.v[hessian_entry(i, j)];
  }
  return d;
}

Real largest_error(const Differences& u, const std::array<double, 3>& f, const Derivatives& exact, Real h) {
  const auto at = [&](std::size_t i, Real di, std::size_t j, Real dj) {
    Differences there = u;
    there[i] += di;
    there[j] += dj;
    return twin(there, f);
  };
  Real worst = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    worst = std::max(worst, std::abs((at(i, h, i, 0) - at(i, -h, i, 0)) / (2 * h) - exact.gradient[i]));
    for (std::size_t j = 0; j < 6; ++j) {
      const Real mixed = (at(i, h, j, h) - at(i, h, j, -h) - at(i, -h, j, h) + at(i, -h, j, -h)) / (4 * h * h);
      worst = std::max(worst, std::abs(mixed - exact.hessian[i][j]));
    }
  }
  return worst;
}

TEST(HeightDerivatives, AreThoseToWhichDifferencesConvergeWithOrderTwo) {
  for (const Differences& u : kTriangles) {
    for (const auto& f : kFactors) {
      const Derivatives exact = of_triangle(u, f);
      const Real coarse = largest_error(u, f, exact, 2e-4L), fine = largest_error(u, f, exact, 1e-4L);
      EXPECT_NEAR(static_cast<double>(coarse / fine), 4, 0.05);
      EXPECT_LT(fine, 2e-3L);
    }
  }
}

TEST(HeightDerivatives, OfOneCornerAreAContractionOfThoseOfAll) {
  for (const Differences& u : kTriangles) {
    for (const auto& f : kFactors) {
      const auto [a, b, inverse_area] = spokes_of(u);
      const HeightsAtCorner<double> heights = heights_at_corner(a, b, inverse_area);
      CornerMatrix<double> hessian = {};
      heights.add_hessian(f[0], f[1], f[2], hessian);
      const CornerVector<double> gradient = f[0] * heights.pq + f[1] * heights.qr + f[2] * heights.rp;
      const std::array<double, 3> slopes = {gradient.x, gradient.y, gradient.w};
      const auto& [xx, xy, xw, yy, yw, ww] = hessian;
      const std::array<std::array<double, 3>, 3> rows = {{{xx, xy, xw}, {xy, yy, yw}, {xw, yw, ww}}};
      const Derivatives all = of_triangle(u, f);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(slopes[i], -all.gradient[i] - all.gradient[3 + i], 1e-13);
        for (std::size_t j = 0; j < 3; ++j) {
          const double sum =
              all.hessian[i][j] + all.hessian[3 + i][j] + all.hessian[i][3 + j] + all.hessian[3 + i][3 + j];
          EXPECT_NEAR(rows[i][j], sum, 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace temper::test
