// The single triangle of §3.1 and §6.1: sides 0.5 and 1 with an angle θ between them. The vertex at that angle has a
// weight, the other two none.
//
//        2            p0 = (0, 0), weight w       p1 = (1, 0)      p2 = 0.5 (cos θ, sin θ)
//       /  ·
//      0 ---- 1
//
// (Of the three vertices this is the one for which the paper's remarks on fig. 10 hold: E_F, E_T and E_BP agree at
// moderate angles, and large angles ask for negative weights.)
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "experiments/numbers.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/vec.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

using Corners = std::array<WeightedPoint, 3>;

[[nodiscard]] Corners angle_triangle(double theta, double weight);

/// The ★1 model of figs. 8 to 10: γ = 1 and h° = −0.15, lengths.
[[nodiscard]] EnergyModel paper_model(EnergyKind kind, int star = 1);

/// The margins by which a triangle is well-centered.
struct Margins {
  double min_d = 0;  ///< least d_ij over the six half-edges
  double min_h = 0;  ///< least h_k
};
[[nodiscard]] Margins margins(const Corners& p);

/// The weights w for which 0 < d < ℓ on all edges and all h > least_h: an interval, as d and h are linear in w.
/// Nothing when it is empty. least_h = −∞ asks for d alone.
struct WeightInterval {
  double low = 0, high = 0;
};
[[nodiscard]] std::optional<WeightInterval> feasible_weights(double theta, double least_h);

struct BestWeight {
  double weight = 0, energy = 0;
  Margins margins;
};

/// The best weight of the vertex at angle θ; the best local minimum for E_F, which has no least value. Nothing
/// when no weight is inside the barrier.
[[nodiscard]] std::optional<BestWeight> best_weight(const EnergyModel& model, double theta);

/// E_F by weight is a cubic polynomial, E_F of ★2 a quadratic one: c[0] + c[1] w + c[2] w² + c[3] w³, through four
/// values.
[[nodiscard]] std::array<double, 4> weight_polynomial(int star, double theta);
/// The places of the local minimum and maximum of the cubic; nothing when it has none.
struct Extrema {
  double minimum = 0, maximum = 0;
};
[[nodiscard]] std::optional<Extrema> extrema(const std::array<double, 4>& cubic);
[[nodiscard]] double evaluate(const std::array<double, 4>& cubic, double w);

/// Counter-clockwise, corners in [−1, 1]², weights between −w and w. Slivers are left out: they keep few digits.
inline Corners random_triangle(Random& random, double w) {
  constexpr double kLeastDoubledArea = 0.1;
  Corners p;
  do {
    for (WeightedPoint& corner : p) corner = {random(-1, 1), random(-1, 1), w > 0 ? random(-w, w) : 0};
  } while (doubled_area(p[0].position(), p[1].position(), p[2].position()) < kLeastDoubledArea);
  return p;
}

}  // namespace temper::gallery
