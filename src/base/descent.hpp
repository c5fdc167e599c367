// Directions of descent by L-BFGS (Nocedal 1980). The last steps and changes of the gradient give the inverse Hessian.
#pragma once

#include <vector>

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

 private:
  struct Pair {
    Vector step, change;
    double inverse = 0;  // 1 / (step · change)
  };
  std::vector<Pair> pairs_;  // oldest first
};

/// Adds in order, so that the sum does not depend on the number of threads.
[[nodiscard]] double dot(const std::vector<double>& a, const std::vector<double>& b);
[[nodiscard]] double largest(const std::vector<double>& a);

}  // namespace temper
