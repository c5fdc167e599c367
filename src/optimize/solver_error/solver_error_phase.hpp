// The phase of Objective::solver_error: it lowers, over all vertices at once,
//
//     ln mean(errors over those at the start) + κ ln(E + B)
//
// the errors those of the options' model (temper/detail/discretization_error.hpp), E and B energy and barrier of the
// accuracy objective, which keep triangles well-centered with their margins, and other errors from rising. By L-BFGS in
// places over the local size and weights over its square. Nothing where a triangle is not well-centered. The
// connectivity stays.
#pragma once

#include <vector>

#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/step/dofs.hpp"

namespace temper {

/// Directions of descent by L-BFGS (Nocedal 1980): the inverse Hessian by the last steps and what they changed in the
/// gradient.
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

class SolverErrorPhase final : public SizedPhase {
 public:
  SolverErrorPhase(WorkingCopy& work, const Settings& settings, Run& run, VertexSizes sizes);

  void begin() override;
  [[nodiscard]] bool may_sweep() const override;
  [[nodiscard]] std::optional<bool> move_all(const Recorder& recorder) override;
  [[nodiscard]] double total() const override { return now_.error; }
  SweepRecord measure() override;
  Verdict judge(bool changed) override;
  [[nodiscard]] Keeps keeps() const override { return Keeps::best_points; }

 private:
  using Vector = Descent::Vector;
  struct Value {
    double lowered = 0;  ///< what is lowered; +∞ outside of the barrier
    double error = 0;    ///< root mean square, the geometric mean of all schemes'
    Vector gradient;     ///< of `lowered`, by the scaled unknowns
  };

  [[nodiscard]] Value value() const;
  void add_gradient_of_energy(double factor, IdVector<VertexId, WeightedPoint>& gradient) const;
  [[nodiscard]] bool is_inside() const;
  /// Puts the vertices to t of the step from `from`.
  void place(const IdVector<VertexId, WeightedPoint>& from, const Vector& step, double t);
  [[nodiscard]] Vector scaled(const IdVector<VertexId, WeightedPoint>& gradient) const;

  const WorkingUnits& units_;
  IdVector<VertexId, Dofs> dofs_;
  std::vector<double> start_;  // the errors then
  Value now_;
  Descent descent_;
  bool stuck_ = false;           // no step lowers it
  std::vector<double> history_;  // of what is lowered
};

}  // namespace temper
