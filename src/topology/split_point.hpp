// Where an edge is divided, and with which weight.
#pragma once

#include "temper/detail/space.hpp"

namespace temper {

/// The vertex that divides the edge ab a part t of the way, 0 < t < 1: in the plane of split_weight(). On the sphere tℓ
/// is an arc, and weights are compared as σ = R/|P|: what is |w − w_a| < t²ℓ² in the plane is there
/// σ_a cos(tℓ) < σ < σ_a / cos(tℓ).
[[nodiscard]] WeightedPoint split_point(const Space& space, const WeightedPoint& a, const WeightedPoint& b, double t);

}  // namespace temper
