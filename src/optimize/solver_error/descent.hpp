// Directions of descent by L-BFGS (Nocedal 1980): the inverse Hessian by the last steps and what they changed in the
// gradient.
#pragma once

#include <cstddef>
#include <vector>

namespace temper {

class Descent {
 public:
  using Vector = std::vector<double>;

  /// The direction to go for that gradient; without any step so far a multiple of −gradient.
  [[nodiscard]] Vector direction(const Vector& gradient) const;
  /// Learns a step, and what it changed in the gradient; not where the curvature along it is not positive.
  void learn(Vector step, Vector change);
  void forget() { pairs_.clear(); }
  [[nodiscard]] bool knows_nothing() const { return pairs_.empty(); }

 private:
  struct Pair {
    Vector step, change;
    double inverse = 0;  // 1 / (step · change)
  };
  std::vector<Pair> pairs_;  // oldest first
};

/// In order, so that it is the same on any number of threads.
[[nodiscard]] double dot(const std::vector<double>& a, const std::vector<double>& b);
[[nodiscard]] double largest(const std::vector<double>& a);

}  // namespace temper
