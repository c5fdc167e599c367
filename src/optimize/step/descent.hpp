// Steps of one vertex that lower its energy. One is Newton's step. The other is the paper's Algorithm 5: downhill by
// finite differences, with golden section along the line.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "energy/patch.hpp"
#include "optimize/step/dofs.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// A step in (x, y, w). On the sphere it is in the chart of its vertex: geometry/triangle_kernel.hpp.
using Step = std::array<double, 3>;

struct NewtonStep {
  Step step = {};
  double predicted = 0;  ///< −∇E · step > 0: twice the decrease of a quadratic model
};

/// Returns −|H|⁻¹ ∇E along the free directions. Unknowns are scaled by (R, R, R²), eigenvalues are taken absolute and
/// floored, and the trust radius R/2 limits the length.
[[nodiscard]] NewtonStep newton_step(const VertexDerivatives& d, const Dofs& dofs, double radius);

/// Returns the t in [0, limit] where f is least, up to `tolerance` × limit. If f has several minima, this is a local
/// one. f may be +∞. A search takes 2 + log_1.618(1/tolerance) evaluations.
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
    } else {  // equal or both infinite: go towards the start, at which the energy is finite
      high = b, b = a, fb = fa;
      a = high - ratio * (high - low);
      fa = f(a);
    }
  }
  return fa <= fb ? a : b;
}

/// Returns the direction of −∇E at p along the free directions, with length `reach`: R for positions, a multiple of R²
/// for a weight. Returns nothing if E is infinite around p, or stationary.
[[nodiscard]] std::optional<Step> steepest_descent(const Patch& patch, const EnergyModel& model, const WeightedPoint& p,
                                                   const Dofs& dofs, double reach);

/// Returns the t in [0, limit] at which golden section finds the least E(p + t step).
[[nodiscard]] double line_minimum(const Patch& patch, const EnergyModel& model, const WeightedPoint& p,
                                  const Step& step, double limit);

/// The largest t ≤ 1 along step that stays clear of inverting a triangle of the patch.
[[nodiscard]] double inversion_limit(const Patch& patch, const WeightedPoint& p, const Step& step);

/// Returns the patch's radius R, which the paper leaves undefined, from the lengths of the spokes.
[[nodiscard]] double patch_radius(const Patch& patch, const WeightedPoint& p, SearchRadius which = SearchRadius::rms);

/// The paper searches positions three times, because its steps follow gradients, not Newton's method.
inline constexpr int kPositionSearches = 3;

}  // namespace temper
