// The second phase of the accuracy objective: sweeps that lower the energy of accuracy_energy.hpp on a mesh whose
// triangles are well-centered, as far as the first phase could make them so. The connectivity stays.
#pragma once

#include <utility>

#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/stages/phase.hpp"

namespace temper {

class AccuracyPhase final : public Phase {
 public:
  /// `settings`: those of the first phase, of which this one keeps its own.
  AccuracyPhase(const WorkingCopy& work, const Settings& settings, Run& run, VertexSizes sizes);
  AccuracyPhase(const AccuracyPhase&) = delete;
  AccuracyPhase& operator=(const AccuracyPhase&) = delete;
  ~AccuracyPhase() override = default;

  /// For the driver's steps.
  [[nodiscard]] const Settings& settings() const { return settings_; }
  [[nodiscard]] SweepState& state() { return state_; }
  /// What it was given, once it has ended.
  [[nodiscard]] VertexSizes take_sizes() { return std::move(domain_.sizes); }

  void begin() override;
  [[nodiscard]] bool may_sweep() const override;
  [[nodiscard]] double total() const override { return energy_unit_ * now_.energy; }
  SweepRecord measure() override;
  Verdict judge(bool changed) override;
  void compare_from_here() override {}
  [[nodiscard]] Keeps keeps() const override {
    return settings_.accuracy.keeps_lengths() ? Keeps::last : Keeps::best_points;
  }
  int& iteration() override { return iteration_; }
 private:
  [[nodiscard]] AccuracyTotal sum() const;

  const Mesh& mesh_;
  AccuracyDomain domain_;
  const Settings settings_;
  SweepState state_;
  Run& run_;
  double energy_unit_ = 1;
  int iteration_ = 0;
  std::size_t bad_;             // all through the phase
  AccuracyTotal before_, now_;  // the last sweep
};

}  // namespace temper
