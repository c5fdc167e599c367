// A descent step from gradient and Hessian in up to three scaled unknowns.
#pragma once

#include <array>

#include "energy/patch.hpp"
#include "optimize/step/freedom.hpp"

namespace temper {

/// A step in (x, y, w); on the sphere in the chart of its vertex (geometry/triangle_kernel.hpp).
using Step = std::array<double, 3>;

struct NewtonStep {
  Step step = {};
  double predicted = 0;  ///< −∇E · step > 0: twice the decrease of a quadratic model
};

/// −|H|⁻¹ ∇E along the free directions, with unknowns scaled by (R, R, R²), eigenvalues taken absolute and floored,
/// and the length limited to the trust radius R/2.
[[nodiscard]] NewtonStep newton_step(const VertexDerivatives& d, const Freedom& freedom, double radius);

}  // namespace temper
