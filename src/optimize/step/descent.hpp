// Steps of one vertex that lower its energy: Newton's; and the paper's Algorithm 5, downhill by finite differences,
// golden section along the line.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "energy/patch.hpp"
#include "optimize/step/dofs.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// A step in (x, y, w); on the sphere in the chart of its vertex (geometry/triangle_kernel.hpp).
using Step = std::array<double, 3>;

struct NewtonStep {
  Step step = {};
  double predicted = 0;  ///< −∇E · step > 0: twice the decrease of a quadratic model
};

/// −|H|⁻¹ ∇E along the free directions, with unknowns scaled by (R, R, R²), eigenvalues taken absolute and floored,
/// and the length limited to the trust radius R/2.
[[nodiscard]] NewtonStep newton_step(const VertexDerivatives& d, const Dofs& dofs, double radius);

/// The t in [0, limit] where f is least, up to `tolerance` × limit, when f has one minimum there; else a local one.
/// f may be +∞. Costs 2 + log(1/tolerance)/log(1.618) evaluations.
template <class Function>
double golden_section(Function&& f, double limit, double tolerance) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);
  double low = 0, high = limit;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double fa = f(a), fb = f(b);
  while (high - low > tolerance * limit) {
    if (fb < fa) {
      low = a, a = b, fa = fb;
      b = low + ratio * (high - low);
      fb = f(b);
    } else {  // ties, and both infinite: towards the start, where the energy is finite
      high = b, b = a, fb = fa;
      a = high - ratio * (high - low);
      fa = f(a);
    }
  }
  return fa <= fb ? a : b;
}

/// −∇E at p along the free directions, of length `reach`, R for positions, so many times R² for a weight. Nothing where
/// E is infinite around p, or stationary.
[[nodiscard]] std::optional<Step> steepest_descent(const Patch& patch, const EnergyModel& model, const WeightedPoint& p,
                                                   const Dofs& dofs, double reach);

/// The t in [0, limit] where E(p + t step) is least, by golden section.
[[nodiscard]] double line_minimum(const Patch& patch, const EnergyModel& model, const WeightedPoint& p,
                                  const Step& step, double limit);

/// The largest t ≤ 1 along step that stays clear of inverting a triangle of the patch.
[[nodiscard]] double inversion_limit(const Patch& patch, const WeightedPoint& p, const Step& step);

/// The patch's radius R, which the paper leaves undefined: that of the spokes' lengths which is asked for.
[[nodiscard]] double patch_radius(const Patch& patch, const WeightedPoint& p, SearchRadius which = SearchRadius::rms);

/// The paper's search count: gradients are no Newton steps, so positions are searched thrice.
inline constexpr int kPositionSearches = 3;

}  // namespace temper
