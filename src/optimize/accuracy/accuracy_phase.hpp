// The second phase of the accuracy objective. Its sweeps lower the energy of accuracy_energy.hpp. The first phase has
// made triangles well-centered, as far as it could. The connectivity stays.
#pragma once

#include <utility>

#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/stages/phase.hpp"

namespace temper {

/// A phase for accuracy with its own settings. The mesh has a size at each vertex and a floor of each triangle.
class SizedPhase : public Phase {
 public:
  SizedPhase(const SizedPhase&) = delete;
  SizedPhase& operator=(const SizedPhase&) = delete;
  ~SizedPhase() override = default;

  /// Settings and state for the driver's steps.
  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] SweepState& state() { return state_; }
  /// Returns the sizes that the phase got, after its end.
  [[nodiscard]] VertexSizes take_sizes() { return std::move(domain_.sizes); }

 protected:
  SizedPhase(WorkingCopy& work, Settings settings, Run& run, VertexSizes sizes);

  /// Returns true if new floors change the barrier.
  bool raise_floors() { return temper::raise_floors(domain_, mesh_, settings_.accuracy, settings_.executor()); }
  [[nodiscard]] AccuracyTotal sum(bool with_energy = true) const;

  Mesh& mesh_;
  AccuracyDomain domain_;
  const Settings settings_;
  SweepState state_;
  Run& run_;
  std::size_t bad_;  // constant during the phase
};

class AccuracyPhase final : public SizedPhase {
 public:
  /// `settings`: the first phase's, from which this phase makes its own.
  AccuracyPhase(WorkingCopy& work, const Settings& settings, Run& run, VertexSizes sizes);

  void begin() override;
  [[nodiscard]] bool may_sweep() const override;
  [[nodiscard]] double total() const override { return energy_unit_ * now_.energy; }
  SweepRecord measure() override;
  Verdict judge(bool changed) override;
  [[nodiscard]] Keeps keeps() const override { return Keeps::last; }

 private:
  double energy_unit_ = 1;
  AccuracyTotal before_, now_;  // before and after the last sweep
  bool has_raised_ = false;     // floors, after the last sweep
};

}  // namespace temper
