#include "optimize/accuracy/accuracy_phase.hpp"

#include <cmath>
#include <utility>

#include "base/assert.hpp"
#include "energy/whole_mesh.hpp"

namespace temper {
namespace {

// Edges that must become longer take this many times more sweeps.
constexpr int kSweepsForLengths = 3;
// Over-relaxation of the first sweeps: in 33 sweeps from random points it lowers the energy more than 1.7 does in 60.
// Near the minimum it overshoots, so sweeps that gain little go on with 1.7.
constexpr double kFirstRelaxation = 1.97;
constexpr double kLittleGain = 1e-4;  // part of the energy
// Factor of the tolerance if steps for the solver's error follow, because these steps lower this energy, too. With 100,
// errors are 1 % larger.
constexpr double kTolerancesBeforeError = 50;

/// Returns the settings of the second phase: always Newton steps along the curve, which keep all edges.
Settings of_accuracy(Settings s) {
  const OptimizeOptions first = std::exchange(s.options, {});
  s.options.accuracy = first.accuracy;
  s.options.unknowns = first.unknowns;
  s.options.interfaces = first.interfaces;
  s.options.boundary = first.boundary;
  s.options.size_band = first.size_band;
  s.options.flips = Flips::none;
  const Policy of_first = std::exchange(s.policy, Policy(s.options));
  s.policy.anchor = of_first.anchor;
  s.policy.relaxation = of_first.relaxation;
  return s;
}

}  // namespace

SizedPhase::SizedPhase(WorkingCopy& work, Settings settings, Run& run, VertexSizes sizes)
    : mesh_(work.mesh),
      domain_{std::move(sizes), {}},
      settings_(std::move(settings)),
      state_(settings_),
      run_(run),
      bad_(count_bad(mesh_, settings_.executor())) {
  state_.accuracy_domain = &domain_;
}

AccuracyTotal SizedPhase::sum(bool with_energy) const {
  return accuracy_total(mesh_, domain_, settings_.accuracy, engine_of(settings_.hooks), with_energy);
}

AccuracyPhase::AccuracyPhase(WorkingCopy& work, const Settings& settings, Run& run, VertexSizes sizes)
    : SizedPhase(work, of_accuracy(settings), run, std::move(sizes)) {
  state_.flip_limit = FlipLimit::unlimited;
  const double first = settings_.accuracy.keeps_lengths() ? kRelaxation : kFirstRelaxation;  // lengths need care
  state_.relaxation = settings_.policy.relaxation.value_or(first);
  energy_unit_ = state_.energy_unit(work.units);
}

void AccuracyPhase::begin() {
  raise_floors();
  now_ = sum();
}

bool AccuracyPhase::may_sweep() const {
  const int most = settings_.options.accuracy.sweeps * (settings_.accuracy.keeps_lengths() ? kSweepsForLengths : 1);
  const bool sweeps_left = iteration < most;
  if (!sweeps_left) run_.report.stopped = Stopped::sweep_limit;
  return sweeps_left && run_.sweeps_left();
}

SweepRecord AccuracyPhase::measure() {
  before_ = std::exchange(now_, sum());
  return {.energy = total(), .bad = bad_, .objective = Objective::accuracy};
}

Phase::Verdict AccuracyPhase::judge([[maybe_unused]] bool changed) {
  TEMPER_ASSERT(!changed && run_.report.history.back().flips == 0);  // the connectivity has not changed
  TEMPER_ASSERT_SLOW(count_bad(mesh_, nullptr) == bad_);
  const bool had_raised = std::exchange(has_raised_, raise_floors());
  const bool keeps_lengths = settings_.accuracy.keeps_lengths();
  if (keeps_lengths) now_.barrier = sum(false).barrier;  // the energy has not changed
  // Two barriers with different floors do not compare.
  if (has_raised_ || (had_raised && !keeps_lengths)) return Verdict::improving;
  const double change = (before_.energy + before_.barrier) - (now_.energy + now_.barrier);
  if (change < kLittleGain * std::abs(now_.energy))
    state_.relaxation = settings_.policy.relaxation.value_or(kRelaxation);
  const bool error_follows = settings_.objective == Objective::solver_error && bad_ == 0;
  const double tolerance = settings_.options.accuracy.tolerance * (error_follows ? kTolerancesBeforeError : 1);
  if (std::abs(change) > tolerance * std::abs(now_.energy)) return Verdict::improving;
  run_.report.stopped = Stopped::converged;
  return Verdict::settled;
}

}  // namespace temper
