// A Newton step of one vertex in (x, y, z, w).
#pragma once

#include <cstdint>

#include "tets/energy/star_kernel.hpp"

namespace temper::tets {

/// The unknowns of a vertex that may change.
enum class Mobility : std::uint8_t { none, weight, position, free };

struct NewtonStep {
  WeightedPoint step;
  double predicted = 0;  ///< −∇E · step > 0: twice the decrease of a quadratic model
};

/// Returns −|H|⁻¹ ∇E along the unknowns. They are scaled by (R, R, R, R²), eigenvalues are taken absolute and floored,
/// and the trust radius R/2 limits the length.
[[nodiscard]] NewtonStep newton_step(const PointDerivatives<double>& d, Mobility mobility, double radius);

}  // namespace temper::tets
