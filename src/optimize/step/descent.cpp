#include "optimize/step/descent.hpp"

#include <algorithm>
#include <cmath>

#include "base/solve_absolute.hpp"
#include "optimize/step/search.hpp"

namespace temper {
namespace {

// Steps of central differences, relative to the reach.
constexpr double kDifference = 1e-6;
// Golden section cannot tell energies apart below the root of the roundoff.
constexpr double kGoldenTolerance = 1e-8;

using Vector = std::array<double, 3>;
using Matrix = SquareMatrix<3>;

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
    const Vector y = solve_absolute<3>(static_cast<std::size_t>(n), h, g, kEigenvalueFloor);
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
