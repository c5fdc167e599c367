#include "optimize/step/line_search.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/step/search.hpp"

namespace temper {
namespace {

// Steps of central differences, relative to the reach.
constexpr double kDifference = 1e-6;
// Golden section cannot tell energies apart below the root of the roundoff.
constexpr double kGoldenTolerance = 1e-8;

}  // namespace

std::optional<Step> steepest_descent(const Patch& patch, const EnergyModel& model, const WeightedPoint& p,
                                     const Freedom& freedom, double reach) {
  Step direction = {};
  double norm2 = 0;
  const double h = kDifference * reach;
  for (int i = 0; i < freedom.n; ++i) {
    const Step& axis = freedom.axis[static_cast<std::size_t>(i)];
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
