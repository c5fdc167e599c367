// The phase of Objective::solver_error: it lowers, over all vertices at once,
//
//     ln mean(errors over those at the start) + κ ln(E + B)
//
// The options' model gives the errors (temper/detail/discretization_error.hpp). E and B are the energy and barrier of
// the accuracy objective: they keep triangles well-centered with their margins, and other errors low. The method is
// L-BFGS. Its unknowns are places over the local size, and weights over its square. If a triangle is not well-centered,
// the phase does nothing. The connectivity stays. A step that would bring triangles to their floors is shortened at
// their vertices alone, since one such triangle in a large mesh would else end the way of all vertices.
#pragma once

#include <vector>

#include "base/descent.hpp"
#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/step/dofs.hpp"

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
  using Vector = Descent::Vector;
  struct Value {
    double lowered = 0;  ///< the objective; +∞ outside of the barrier
    double error = 0;    ///< geometric mean of the root mean squares of all schemes
    Vector gradient;     ///< of `lowered`, by the scaled unknowns
  };

  [[nodiscard]] Value value();
  void add_gradient_of_energy(double factor, IdVector<VertexId, WeightedPoint>& gradient) const;
  [[nodiscard]] bool is_inside() const;
  /// Shortens the step of each vertex so far that its triangles keep a part of their room above their floors.
  void shorten(const IdVector<VertexId, WeightedPoint>& from, Vector& step);
  /// Moves the vertices from `from` by t times the step.
  void place(const IdVector<VertexId, WeightedPoint>& from, const Vector& step, double t);
  [[nodiscard]] Vector scaled(const IdVector<VertexId, WeightedPoint>& gradient) const;

  const WorkingUnits& units_;
  IdVector<VertexId, Dofs> dofs_;
  std::vector<double> start_;     // errors at the first value
  std::size_t beyond_guard_ = 0;  // triangles at the start
  Value now_;
  Descent descent_;
  bool stuck_ = false;           // no step lowers the objective
  std::vector<double> history_;  // of the objective
};

}  // namespace temper
