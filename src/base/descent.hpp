// Descent of a function of many points by L-BFGS (Nocedal 1980). The last steps and changes of the gradient give the
// inverse Hessian.
//
// Each point has the same number of scaled unknowns. Points are the corners of elements, and each element has a room
// above its floor. A step that takes too much room is shortened at the corners of that element alone. One such element
// in a large mesh would else end the way of all points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/loops.hpp"

namespace temper {

class Descent {
 public:
  using Vector = std::vector<double>;

  /// Returns the direction for this gradient; before any step it is a multiple of −gradient.
  [[nodiscard]] Vector direction(const Vector& gradient) const;
  /// Learns a step and its change of the gradient, if the curvature along the step is positive.
  void learn(Vector step, Vector change);
  void forget() { pairs_.clear(); }
  [[nodiscard]] bool knows_nothing() const { return pairs_.empty(); }

  enum class Outcome : std::uint8_t {
    taken,
    none,     ///< No part of the step lowers the function. The next step follows the gradient
    stuck,    ///< No part of a step along the gradient does
    stopped,  ///< All points are where they were
  };
  /// Takes one step, halved until it lowers the function, and sets `now` to the value there. `f` has
  ///   kUnknowns       the number of unknowns per point
  ///   n_elements(), corners(e), room(e)   elements; rooms are computed on threads
  ///   place(step, t)  moves all points by t times the step, from where they were before it
  ///   is_inside()     says whether exact tests allow the points
  ///   value()         has `lowered`, +∞ outside, and its `gradient` by the scaled unknowns, empty in the last step
  template <class Function, class Value, class MustStop>
  Outcome take_step(Function& f, Value& now, Executor* executor, const MustStop& must_stop);

 private:
  struct Pair {
    Vector step, change;
    double inverse = 0;  // 1 / (step · change)
  };
  static constexpr int kMostHalvings = 25;

  template <class Function>
  static void shorten(Function& f, Vector& step, Executor* executor);

  std::vector<Pair> pairs_;  // oldest first
};

/// Adds in order, so that the sum does not depend on the number of threads.
[[nodiscard]] double dot(const std::vector<double>& a, const std::vector<double>& b);
[[nodiscard]] double largest(const std::vector<double>& a);

/// ln mean(errors over those at the start) + share ln(total), with its derivatives.
struct LogObjective {
  double value = 0, by_total = 0;
  std::vector<double> by_error;
};
[[nodiscard]] LogObjective log_objective(const std::vector<double>& errors, const std::vector<double>& start,
                                         double total, double share);

template <class Function, class Value, class MustStop>
Descent::Outcome Descent::take_step(Function& f, Value& now, Executor* executor, const MustStop& must_stop) {
  constexpr double kArmijo = 1e-4;  // part of the gradient's prediction that a step must reach (Armijo)
  Vector step = direction(now.gradient);
  shorten(f, step, executor);
  const double slope = dot(now.gradient, step);
  if (!std::isfinite(slope)) step.assign(step.size(), 0);  // else all points become NaN; so they stay
  double t = 1;
  for (int i = 0; i < kMostHalvings && slope < 0; ++i, t *= 0.5) {
    if (must_stop()) {
      f.place(step, 0);
      return Outcome::stopped;
    }
    f.place(step, t);
    if (!f.is_inside()) continue;
    Value there = f.value();
    if (!(there.lowered <= now.lowered + kArmijo * t * slope)) continue;
    if (!there.gradient.empty()) {
      Vector change = there.gradient;
      for (std::size_t k = 0; k < change.size(); ++k) change[k] -= now.gradient[k], step[k] *= t;
      learn(std::move(step), std::move(change));
    }
    now = std::move(there);
    return Outcome::taken;
  }
  f.place(step, 0);
  if (knows_nothing()) return Outcome::stuck;
  forget();
  return Outcome::none;
}

/// Shortens the step of each point so far that its elements keep a part of their room.
template <class Function>
void Descent::shorten(Function& f, Vector& step, Executor* executor) {
  constexpr double kLongestStep = 0.3;  // of a scaled unknown
  constexpr double kKeptRoom = 0.2;     // part of an element's room
  constexpr std::size_t kUnknowns = Function::kUnknowns;
  const auto scale = [&step](std::size_t point, double factor) {
    for (std::size_t i = 0; i < kUnknowns; ++i) step[kUnknowns * point + i] *= factor;
  };
  const std::size_t n_points = step.size() / kUnknowns;
  for (std::size_t p = 0; p < n_points; ++p) {
    double most = 0;
    for (std::size_t i = 0; i < kUnknowns; ++i) most = std::max(most, std::abs(step[kUnknowns * p + i]));
    if (most > kLongestStep) scale(p, kLongestStep / most);
  }
  std::vector<double> least(f.n_elements());
  for_each_index(least.size(), executor, [&](std::size_t e) { least[e] = kKeptRoom * f.room(e); });
  std::vector<std::uint8_t> is_short(least.size()), is_halved(n_points, 1);
  for (int i = 0; i < kMostHalvings; ++i) {
    f.place(step, 1);
    for_each_index(least.size(), executor, [&](std::size_t e) {  // where no corner has moved there is still room
      const auto& corners = f.corners(e);
      const bool has_moved =
          std::any_of(corners.begin(), corners.end(), [&](auto v) { return is_halved[v.index] != 0; });
      is_short[e] = !has_moved || f.room(e) >= least[e] ? 0 : 1;
    });
    is_halved.assign(n_points, 0);
    for (std::size_t e = 0; e < least.size(); ++e) {
      if (is_short[e] == 0) continue;
      for (const auto corner : f.corners(e)) {
        if (std::exchange(is_halved[corner.index], 1) == 0) scale(corner.index, 0.5);
      }
    }
    if (std::find(is_short.begin(), is_short.end(), 1) == is_short.end()) return;
  }
}

}  // namespace temper
