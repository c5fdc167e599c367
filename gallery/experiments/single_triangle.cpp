#include "experiments/single_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/minimize.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

constexpr double kShortSide = 0.5, kLongSide = 1;
// Beyond ± twice the square of the longest side E_T only grows; its best weights are well inside.
constexpr double kMostWeight = 2;
constexpr int kScan = 800;

double energy_at(const EnergyModel& model, double theta, double w) {
  const Corners p = angle_triangle(theta, w);
  return triangle_energy(model, p[0], p[1], p[2]);
}

}  // namespace

Corners angle_triangle(double theta, double weight) {
  return {
      WeightedPoint{0, 0, weight}, {kLongSide, 0, 0}, {kShortSide * std::cos(theta), kShortSide * std::sin(theta), 0}};
}

EnergyModel paper_model(EnergyKind kind, int star) {
  EnergyModel model;
  model.kind = kind;
  model.star = static_cast<Star>(star);
  model.gamma = {1.0, LengthScale::absolute};
  model.h0 = {0.15, LengthScale::absolute};
  return model;
}

Margins margins(const Corners& p) {
  Margins result{kLongSide, kLongSide};
  for (std::size_t k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    const double d = dual_crossing(a, b), l = length(b.position() - a.position());
    result.min_d = std::min({result.min_d, d, l - d});
    result.min_h = std::min(result.min_h, signed_height(a, b, c));
  }
  return result;
}

std::optional<WeightInterval> feasible_weights(double theta, double least_h) {
  const Corners at0 = angle_triangle(theta, 0), at1 = angle_triangle(theta, 1);
  WeightInterval interval{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  bool possible = true;
  const auto positive = [&](double value0, double value1) {  // value0 + (value1 − value0) w > 0
    const double slope = value1 - value0, root = -value0 / slope;
    if (slope == 0) {
      possible = possible && value0 > 0;
    } else if (slope > 0) {
      interval.low = std::max(interval.low, root);
    } else {
      interval.high = std::min(interval.high, root);
    }
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double l = length(at0[i].position() - at0[k].position());
    const double d0 = dual_crossing(at0[k], at0[i]), d1 = dual_crossing(at1[k], at1[i]);
    positive(d0, d1);
    positive(l - d0, l - d1);
    if (std::isinf(least_h)) continue;
    positive(signed_height(at0[k], at0[i], at0[j]) - least_h, signed_height(at1[k], at1[i], at1[j]) - least_h);
  }
  if (!possible || !(interval.low < interval.high)) return std::nullopt;
  return interval;
}

std::optional<BestWeight> best_weight(const EnergyModel& model, double theta) {
  const auto with_margins = [&](const Minimum1& m) {
    return BestWeight{m.at, m.value, margins(angle_triangle(theta, m.at))};
  };
  const auto energy = [&](double w) { return energy_at(model, theta, w); };
  if (model.kind == EnergyKind::F) {
    const auto at = extrema(weight_polynomial(static_cast<int>(model.star), theta));
    if (!at) return std::nullopt;
    return with_margins({at->minimum, energy(at->minimum)});
  }
  WeightInterval where{-kMostWeight, kMostWeight};
  if (model.kind == EnergyKind::BH || model.kind == EnergyKind::BHs || model.kind == EnergyKind::BP) {
    const double least_h = model.kind == EnergyKind::BH    ? 0
                           : model.kind == EnergyKind::BHs ? -model.h0.value
                                                           : -std::numeric_limits<double>::infinity();
    const auto feasible = feasible_weights(theta, least_h);
    if (!feasible) return std::nullopt;
    where = *feasible;
  }
  const auto least = scan_minimum(energy, where.low, where.high, kScan);
  if (!least) return std::nullopt;
  return with_margins(*least);
}

std::array<double, 4> weight_polynomial(int star, double theta) {
  const EnergyModel model = paper_model(EnergyKind::F, star);
  const auto f = [&](double w) { return energy_at(model, theta, w); };
  // Differences at −1, 0, 1, 2: exact for a cubic.
  const double a = f(-1), b = f(0), c = f(1), d = f(2);
  const double third = (d - 3 * c + 3 * b - a) / 6, second = (c - 2 * b + a) / 2;
  return {b, (c - a) / 2 - third, second, third};
}

std::optional<Extrema> extrema(const std::array<double, 4>& cubic) {
  // c1 + 2 c2 w + 3 c3 w² = 0; with c3 = 0 the one extremum of a parabola.
  const double a = 3 * cubic[3], b = 2 * cubic[2], c = cubic[1];
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant > 0)) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
  const double first = c / q, second = q / a;  // second is infinite for a parabola
  return b + 2 * a * first > 0 ? Extrema{first, second} : Extrema{second, first};
}

double evaluate(const std::array<double, 4>& c, double w) { return c[0] + w * (c[1] + w * (c[2] + w * c[3])); }

}  // namespace temper::gallery
