#include "tets/optimize/newton_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/solve_absolute.hpp"

namespace temper::tets {
namespace {

// As in the plane (optimize/step/search.hpp): half a radius in position, half a squared one in weight; and eigenvalues
// below this part of the largest are raised to it.
constexpr double kTrustRadius = 0.5, kEigenvalueFloor = 1e-6;

using Unknowns = std::array<double, 4>;
using Matrix = SquareMatrix<4>;

/// Returns H⁻¹ g by H = L D Lᵀ, or nothing unless H is positive definite, by more than the floor.
std::optional<Unknowns> solve_definite(Matrix h, Unknowns g) {
  const double least = kEigenvalueFloor * std::max({h[0][0], h[1][1], h[2][2], h[3][3]});
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(h[k][k] > least)) return std::nullopt;
    for (std::size_t i = k + 1; i < 4; ++i) {
      const double factor = h[k][i] / h[k][k];
      for (std::size_t j = i; j < 4; ++j) h[i][j] -= factor * h[k][j];
      g[i] -= factor * g[k];
    }
  }
  for (std::size_t k = 4; k-- > 0;) {
    for (std::size_t j = k + 1; j < 4; ++j) g[k] -= h[k][j] * g[j];
    g[k] /= h[k][k];
  }
  return g;
}

/// Leaves a quadratic model only what it has along the places that the vertex may take, and adds a steep valley there.
void restrict_to(const Mobility& mobility, Matrix& h, Unknowns& slope) {
  const auto restrict_places = [&](double& x, double& y, double& z) {
    const Vec3 along = mobility.allowed({x, y, z});
    x = along.x, y = along.y, z = along.z;
  };
  const double steep = std::max({std::abs(h[0][0]), std::abs(h[1][1]), std::abs(h[2][2]), std::abs(h[3][3])});
  restrict_places(slope[0], slope[1], slope[2]);
  for (auto& row : h) restrict_places(row[0], row[1], row[2]);
  for (std::size_t j = 0; j < 4; ++j) restrict_places(h[0][j], h[1][j], h[2][j]);
  for (std::size_t i = 0; i < 3; ++i) {
    Unknowns across = {};
    across[i] = 1;
    Unknowns along = across;
    restrict_places(along[0], along[1], along[2]);
    for (std::size_t j = 0; j < 3; ++j) h[i][j] += steep * (across[j] - along[j]);
  }
}

}  // namespace

NewtonStep newton_step(const PointDerivatives<double>& d, const Mobility& mobility, double radius) {
  const double r2 = radius * radius;
  const auto& [g, g_w] = d.gradient;
  const auto& [xx, xy, xz, xw, yy, yz, yw, zz, zw, ww] = d.hessian;
  if (mobility == Mobility::none) return {};
  if (mobility == Mobility::weight) {
    const double slope = -r2 * g_w, curvature = std::abs(r2 * r2 * ww);
    const double step = std::clamp(curvature > 0 ? slope / curvature : slope, -kTrustRadius, kTrustRadius);
    return {{0, 0, 0, r2 * step}, step * slope};
  }
  const Unknowns scale = {radius, radius, radius, r2}, down = {-g.x, -g.y, -g.z, mobility.weighs ? -g_w : 0};
  Matrix h = {{{xx, xy, xz, xw}, {xy, yy, yz, yw}, {xz, yz, zz, zw}, {xw, yw, zw, ww}}};
  if (!mobility.weighs) h[3] = {}, h[0][3] = h[1][3] = h[2][3] = 0;
  Unknowns slope;
  for (std::size_t i = 0; i < 4; ++i) {
    slope[i] = scale[i] * down[i];
    for (std::size_t j = 0; j < 4; ++j) h[i][j] *= scale[i] * scale[j];
  }
  if (mobility.slides()) restrict_to(mobility, h, slope);
  const std::optional<Unknowns> definite = solve_definite(h, slope);
  const Unknowns x = definite ? *definite : solve_absolute<4>(4, h, slope, kEigenvalueFloor);
  double norm2 = 0, predicted = 0;
  for (std::size_t i = 0; i < 4; ++i) norm2 += x[i] * x[i], predicted += x[i] * slope[i];
  const double shrink = norm2 > kTrustRadius * kTrustRadius ? kTrustRadius / std::sqrt(norm2) : 1;
  const Vec3 by = mobility.allowed({shrink * radius * x[0], shrink * radius * x[1], shrink * radius * x[2]});
  return {{by.x, by.y, by.z, shrink * r2 * x[3]}, shrink * predicted};
}

}  // namespace temper::tets
