#include "tets/optimize/newton_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace temper::tets {
namespace {

// As in the plane (optimize/step/search.hpp): half a radius in position, half a squared one in weight; and eigenvalues
// below this part of the largest are raised to it.
constexpr double kTrustRadius = 0.5, kEigenvalueFloor = 1e-6;
// On 4 × 4 matrices, Jacobi sweeps converge quadratically: six of them reach rounding.
constexpr int kJacobiSweeps = 8;

using Unknowns = std::array<double, 4>;
using Matrix = std::array<Unknowns, 4>;

/// Rotates rows and columns p and q of a so that a_pq, which is not 0, becomes 0. Rotates the columns of v, too, which
/// become the eigenvectors.
void jacobi_rotation(Matrix& a, Matrix& v, std::size_t p, std::size_t q) {
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const auto turn = [c, s](double& x, double& y) {
    const double old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  for (std::size_t k = 0; k < 4; ++k) turn(a[k][p], a[k][q]);
  for (std::size_t k = 0; k < 4; ++k) turn(a[p][k], a[q][k]);
  for (std::size_t k = 0; k < 4; ++k) turn(v[k][p], v[k][q]);
}

/// Returns |H|⁻¹ g with floored eigenvalues (cyclic Jacobi).
Unknowns solve_absolute(Matrix h, const Unknowns& g) {
  Matrix v = {};
  for (std::size_t i = 0; i < 4; ++i) v[i][i] = 1;
  for (int sweep = 0; sweep < kJacobiSweeps; ++sweep) {
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (h[p][q] != 0) jacobi_rotation(h, v, p, q);
      }
    }
  }
  double largest = 0;
  for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::abs(h[i][i]));
  if (!(largest > 0)) return g;  // no curvature at all: go downhill, the trust radius decides how far
  Unknowns x = {};
  for (std::size_t i = 0; i < 4; ++i) {
    double along = 0;
    for (std::size_t k = 0; k < 4; ++k) along += v[k][i] * g[k];
    along /= std::max(std::abs(h[i][i]), kEigenvalueFloor * largest);
    for (std::size_t k = 0; k < 4; ++k) x[k] += along * v[k][i];
  }
  return x;
}

}  // namespace

NewtonStep newton_step(const PointDerivatives<double>& d, Mobility mobility, double radius) {
  const double r2 = radius * radius;
  const auto& [g, g_w] = d.gradient;
  const auto& [xx, xy, xz, xw, yy, yz, yw, zz, zw, ww] = d.hessian;
  if (mobility == Mobility::none) return {};
  if (mobility == Mobility::weight) {
    const double slope = -r2 * g_w, curvature = std::abs(r2 * r2 * ww);
    const double step = std::clamp(curvature > 0 ? slope / curvature : slope, -kTrustRadius, kTrustRadius);
    return {{0, 0, 0, r2 * step}, step * slope};
  }
  const Unknowns scale = {radius, radius, radius, r2},
                 down = {-g.x, -g.y, -g.z, mobility == Mobility::position ? 0 : -g_w};
  Matrix h = {{{xx, xy, xz, xw}, {xy, yy, yz, yw}, {xz, yz, zz, zw}, {xw, yw, zw, ww}}};
  if (mobility == Mobility::position) h[3] = {}, h[0][3] = h[1][3] = h[2][3] = 0;
  Unknowns slope;
  for (std::size_t i = 0; i < 4; ++i) {
    slope[i] = scale[i] * down[i];
    for (std::size_t j = 0; j < 4; ++j) h[i][j] *= scale[i] * scale[j];
  }
  Unknowns x = solve_absolute(h, slope);
  double norm2 = 0, predicted = 0;
  for (std::size_t i = 0; i < 4; ++i) norm2 += x[i] * x[i], predicted += x[i] * slope[i];
  const double shrink = norm2 > kTrustRadius * kTrustRadius ? kTrustRadius / std::sqrt(norm2) : 1;
  return {{shrink * radius * x[0], shrink * radius * x[1], shrink * radius * x[2], shrink * r2 * x[3]},
          shrink * predicted};
}

}  // namespace temper::tets
