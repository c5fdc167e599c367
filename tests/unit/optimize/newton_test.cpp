// The descent step on functions whose minimum is known, and golden section.
#include <gtest/gtest.h>

#include <cmath>

#include "optimize/step/descent.hpp"
#include "support/lattice.hpp"

namespace temper::test {
namespace {

Dofs everything() {
  Dofs f;
  f.n = 3;
  f.axis = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return f;
}

/// Derivatives at 0 of ½ (z − m)ᵀ A (z − m).
VertexDerivatives quadratic(const std::array<double, 6>& a, const std::array<double, 3>& m) {
  const auto& [xx, xy, xw, yy, yw, ww] = a;
  VertexDerivatives d;
  d.feasible = true;
  d.hessian = a;
  d.gradient = {-(xx * m[0] + xy * m[1] + xw * m[2]), -(xy * m[0] + yy * m[1] + yw * m[2]),
                -(xw * m[0] + yw * m[1] + ww * m[2])};
  return d;
}

double slope(const VertexDerivatives& d, const Step& s) {
  return d.gradient[0] * s[0] + d.gradient[1] * s[1] + d.gradient[2] * s[2];
}

TEST(NewtonStep, LandsOnTheMinimumOfAConvexQuadraticWithinTheTrustRadius) {
  Noise noise(1);
  for (int i = 0; i < 100; ++i) {
    // A = B Bᵀ + 1: safely positive definite.
    std::array<double, 6> b;
    for (double& x : b) x = noise();
    const auto& [p, q, r, s, t, u] = b;
    const std::array<double, 6> a = {p * p + q * q + r * r + 1, p * q + q * s + r * t, p * r + q * t + r * u,
                                     q * q + s * s + t * t + 1, q * r + s * t + t * u, r * r + t * t + u * u + 1};
    const std::array<double, 3> m = {0.2 * noise(), 0.2 * noise(), 0.2 * noise()};
    const NewtonStep step = newton_step(quadratic(a, m), everything(), 1);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(step.step[k], m[k], 1e-13);
  }
}

TEST(NewtonStep, GoesDownhillAndStaysInTheTrustRadiusWhateverTheCurvature) {
  Noise noise(2);
  for (int i = 0; i < 500; ++i) {
    VertexDerivatives d;
    d.feasible = true;
    for (double& g : d.gradient) g = noise();
    for (double& h : d.hessian) h = 10 * noise();
    const double radius = 1 + noise() * 0.9;
    const NewtonStep step = newton_step(d, everything(), radius);
    EXPECT_LT(slope(d, step.step), 0);
    EXPECT_NEAR(-slope(d, step.step), step.predicted, 1e-10 * step.predicted);
    const double scaled = std::hypot(step.step[0] / radius, step.step[1] / radius, step.step[2] / (radius * radius));
    EXPECT_LE(scaled, 0.5 * (1 + 1e-12));
  }
}

TEST(NewtonStep, MovesOnlyAlongFreeDirections) {
  const VertexDerivatives d = quadratic({2, 0.3, 0.1, 1, 0.2, 3}, {0.1, -0.2, 0.1});
  Dofs along;
  along.n = 1;
  along.axis[0] = {0.6, 0.8, 0};
  const NewtonStep step = newton_step(d, along, 1);
  EXPECT_NEAR(step.step[0] * 0.8, step.step[1] * 0.6, 1e-15);
  EXPECT_EQ(step.step[2], 0);
  const NewtonStep weight = newton_step(d, Dofs{1, {{{0, 0, 1}}}}, 1);
  EXPECT_EQ(weight.step[0], 0);
  EXPECT_EQ(weight.step[1], 0);
  EXPECT_NEAR(weight.step[2], -d.gradient[2] / d.hessian[5], 1e-15);
}

TEST(NewtonStep, DoesNotDependOnTheUnitOfLength) {
  // x → s x, w → s² w leaves the step the same in its own units.
  const VertexDerivatives d = quadratic({2, 0.3, 0.1, -1, 0.2, 3}, {0.3, -0.2, 0.1});
  constexpr double s = 1024;
  VertexDerivatives e = d;
  e.gradient = {d.gradient[0] / s, d.gradient[1] / s, d.gradient[2] / (s * s)};
  const auto& [xx, xy, xw, yy, yw, ww] = d.hessian;
  e.hessian = {xx / (s * s), xy / (s * s), xw / (s * s * s), yy / (s * s), yw / (s * s * s), ww / (s * s * s * s)};
  const NewtonStep one = newton_step(d, everything(), 0.7), two = newton_step(e, everything(), 0.7 * s);
  EXPECT_EQ(s * one.step[0], two.step[0]);
  EXPECT_EQ(s * one.step[1], two.step[1]);
  EXPECT_EQ(s * s * one.step[2], two.step[2]);
}

TEST(GoldenSection, FindsTheMinimumOfAUnimodalFunction) {
  for (const double at : {0.0, 0.1, 0.5, 0.77, 1.0}) {
    EXPECT_NEAR(golden_section([&](double t) { return std::abs(t - at); }, 1, 1e-10), at, 1e-9);
  }
}

TEST(GoldenSection, StaysWhereTheFunctionIsFinite) {
  const double t = golden_section([](double s) { return s < 0.3 ? -s : INFINITY; }, 1, 1e-8);
  EXPECT_LT(t, 0.3);
  EXPECT_GT(t, 0.29);
}

}  // namespace
}  // namespace temper::test
