#include "optimize/step/descent.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/step/search.hpp"

namespace temper {
namespace {

// On 3 × 3 matrices, Jacobi sweeps converge quadratically: five of them reach rounding.
constexpr int kJacobiSweeps = 8;

// Steps of central differences, relative to the reach.
constexpr double kDifference = 1e-6;
// Golden section cannot tell energies apart below the root of the roundoff.
constexpr double kGoldenTolerance = 1e-8;

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

/// Rotates rows and columns p and q of the first n of a so that a_pq, which is not 0, becomes 0. Rotates the columns of
/// v, too, which become the eigenvectors.
void jacobi_rotation(Matrix& a, Matrix& v, std::size_t n, std::size_t p, std::size_t q) {
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const auto turn = [c, s](double& x, double& y) {
    const double old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  for (std::size_t k = 0; k < n; ++k) turn(a[k][p], a[k][q]);
  for (std::size_t k = 0; k < n; ++k) turn(a[p][k], a[q][k]);
  for (std::size_t k = 0; k < n; ++k) turn(v[k][p], v[k][q]);
}

/// Eigenvectors of a symmetric matrix as columns of v; a becomes diagonal (cyclic Jacobi).
void diagonalize(std::size_t n, Matrix& a, Matrix& v) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) v[i][j] = i == j ? 1 : 0;
  }
  for (int sweep = 0; sweep < kJacobiSweeps; ++sweep) {
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        if (a[p][q] != 0) jacobi_rotation(a, v, n, p, q);
      }
    }
  }
}

/// Returns −|H|⁻¹ g with floored eigenvalues, for a Hessian that is not positive definite.
Vector solve_absolute(int n, Matrix h, const Vector& minus_gradient) {
  Matrix v;
  diagonalize(static_cast<std::size_t>(n), h, v);
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(h[i][i]));
  Vector x = {};
  if (!(largest > 0)) return minus_gradient;  // no curvature at all: go downhill, the trust radius decides how far
  for (int i = 0; i < n; ++i) {
    double along = 0;
    for (int k = 0; k < n; ++k) along += v[k][i] * minus_gradient[k];
    along /= std::max(std::abs(h[i][i]), kEigenvalueFloor * largest);
    for (int k = 0; k < n; ++k) x[k] += along * v[k][i];
  }
  return x;
}

}  // namespace

NewtonStep newton_step(const VertexDerivatives& d, const Dofs& dofs, double radius) {
  const int n = dofs.n;
  const auto& [xx, xy, xw, yy, yw, ww] = d.hessian;
  const Matrix full = {{{xx, xy, xw}, {xy, yy, yw}, {xw, yw, ww}}};
  // Columns of the basis, scaled: unknown i moves the vertex by basis[i].
  Matrix basis = {};
  for (int i = 0; i < n; ++i) {
    const double scale = dofs.axis[i][2] == 0 ? radius : radius * radius;
    for (int k = 0; k < 3; ++k) basis[i][k] = scale * dofs.axis[i][k];
  }
  Matrix h = {};
  Vector g = {};
  for (int i = 0; i < n; ++i) {
    Vector row = {};
    for (int k = 0; k < 3; ++k) {
      g[i] -= basis[i][k] * d.gradient[k];
      for (int m = 0; m < 3; ++m) row[k] += full[k][m] * basis[i][m];
    }
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < 3; ++k) h[i][j] += basis[j][k] * row[k];
    }
  }
  for (int i = n; i < 3; ++i) h[i][i] = h[0][0];
  const CornerVector<double> slope = {g[0], g[1], g[2]};
  NewtonStepOf<double> x = scaled_newton_step({h[0][0], h[0][1], h[0][2], h[1][1], h[1][2], h[2][2]}, slope);
  if (!x.definite) {
    const Vector y = solve_absolute(n, h, g);
    x = within_trust_radius(y[0], y[1], y[2], slope, false);
  }
  const Vector length = {x.x, x.y, x.w};
  NewtonStep result;
  result.predicted = x.predicted;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) result.step[k] += length[i] * basis[i][k];
  }
  return result;
}

std::optional<Step> steepest_descent(const Patch& patch, const EnergyModel& model, const WeightedPoint& p,
                                     const Dofs& dofs, double reach) {
  Step direction = {};
  double norm2 = 0;
  const double h = kDifference * reach;
  for (int i = 0; i < dofs.n; ++i) {
    const Step& axis = dofs.axis[static_cast<std::size_t>(i)];
    const auto at = [&](double t) { return patch_energy(patch, model, along(patch.space, p, axis, t)); };
    const double slope = (at(h) - at(-h)) / (2 * h);
    if (!std::isfinite(slope)) return std::nullopt;
    norm2 += slope * slope;
    for (std::size_t k = 0; k < 3; ++k) direction[k] -= slope * axis[k];
  }
  if (!(norm2 > 0)) return std::nullopt;
  for (double& s : direction) s *= reach / std::sqrt(norm2);
  return direction;
}

double line_minimum(const Patch& patch, const EnergyModel& model, const WeightedPoint& p, const Step& step,
                    double limit) {
  return golden_section([&](double t) { return patch_energy(patch, model, along(patch.space, p, step, t)); }, limit,
                        kGoldenTolerance);
}

double inversion_limit(const Patch& patch, const WeightedPoint& p, const Step& step) {
  double limit = 1;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const Vec2 a = direction_to(patch.space, p, patch.q(i)), b = direction_to(patch.space, p, patch.r(i));
    limit = before_inversion(limit, {a.x, a.y}, {b.x, b.y}, {step[0], step[1]}, true);
  }
  return limit;
}

double patch_radius(const Patch& patch, const WeightedPoint& p, SearchRadius which) {
  const std::size_t n = patch.link.size();
  double sum = 0, largest = 0, least = kInfinity;
  for (std::size_t i = 0; i < n; ++i) {
    const double l2 = edge_measures(patch.space, p, patch.q(i)).l2;
    sum += l2;
    largest = std::max(largest, l2);
    least = std::min(least, l2);
  }
  const double mean = sum / static_cast<double>(n);
  return std::sqrt(which == SearchRadius::max ? largest : which == SearchRadius::min ? least : mean);
}

}  // namespace temper
