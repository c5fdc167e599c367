// A Newton step of one vertex in (x, y, z, w).
#pragma once

#include <cstdint>

#include "tets/energy/star_kernel.hpp"

namespace temper::tets {

/// Where a vertex may move, and whether its weight may change.
struct Mobility {
  std::uint8_t dimensions = 0;  ///< 3: anywhere; 2: in a plane; 1: along a line; 0: nowhere
  bool weighs = false;          ///< The weight may change
  Vec3 direction = {};          ///< Unit vector along the line, or normal of the plane

  [[nodiscard]] bool moves() const { return dimensions > 0; }
  /// Says whether the vertex stays in a plane or on a line.
  [[nodiscard]] bool slides() const { return dimensions == 1 || dimensions == 2; }
  /// The part of a displacement that the vertex may take; all of it unless it slides. Parts along axes are exact.
  [[nodiscard]] Vec3 allowed(Vec3 by) const {
    if (!slides()) return by;
    const Vec3 along = dot(direction, by) * direction;
    return dimensions == 1 ? along : by - along;
  }

  static const Mobility none, weight, position, free;
  friend constexpr bool operator==(const Mobility&, const Mobility&) = default;
};
inline constexpr Mobility Mobility::none = {0, false}, Mobility::weight = {0, true}, Mobility::position = {3, false},
                          Mobility::free = {3, true};

struct NewtonStep {
  WeightedPoint step;
  double predicted = 0;  ///< −∇E · step > 0: twice the decrease of a quadratic model
};

/// Returns −|H|⁻¹ ∇E along the unknowns. They are scaled by (R, R, R, R²), eigenvalues are taken absolute and floored,
/// and the trust radius R/2 limits the length.
[[nodiscard]] NewtonStep newton_step(const PointDerivatives<double>& d, const Mobility& mobility, double radius);

}  // namespace temper::tets
