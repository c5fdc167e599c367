// The phase of Objective::solver_error: it lowers, over all vertices at once,
//
//     ln mean(errors over those at the start) + κ ln(E + B)
//
// The options' model gives the errors (temper/detail/discretization_error.hpp). E and B are the energy and barrier of
// the accuracy objective: they keep triangles well-centered with their margins, and other errors low. The method is
// L-BFGS. If a triangle is not well-centered, the phase does nothing. The connectivity stays.
#pragma once

#include <vector>

#include "base/descent.hpp"
#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/step/dofs.hpp"
#include "temper/detail/discretization_error.hpp"

namespace temper {

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
  friend class Descent;  // which takes steps
  using Vector = Descent::Vector;
  using Gradient = DiscretizationError::Gradient;
  static constexpr std::size_t kUnknowns = 3;  // x and y over the local size, the weight over its square
  struct Value {
    double lowered = 0;  ///< the objective; +∞ outside of the barrier
    double error = 0;    ///< geometric mean of the root mean squares of all schemes
    Vector gradient;     ///< of `lowered`, by the scaled unknowns
  };

  [[nodiscard]] Value value();
  [[nodiscard]] Vector scaled(const Gradient& gradient) const;
  [[nodiscard]] bool is_inside() const;
  [[nodiscard]] std::size_t n_elements() const { return mesh_.n_triangles(); }
  [[nodiscard]] auto corners(std::size_t triangle) const { return mesh_.corners(TriangleId(triangle)); }
  [[nodiscard]] double room(std::size_t triangle) const;
  /// Moves the vertices from before_ by t times the step.
  void place(const Vector& step, double t);

  const WorkingUnits& units_;
  IdVector<VertexId, Dofs> dofs_;
  IdVector<VertexId, WeightedPoint> before_;  // the step
  std::vector<double> start_;                 // errors at the first value
  std::size_t beyond_guard_ = 0;              // triangles at the start
  Value now_;
  Descent descent_;
  bool stuck_ = false;           // no step lowers the objective
  bool is_last_step_ = false;    // then nobody needs the gradient after it
  std::vector<double> history_;  // of the objective
};

}  // namespace temper
