#include <algorithm>
#include <cmath>

#include "energy/whole_mesh.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/stages/phase.hpp"

namespace temper {
namespace {

// Largest number of sweeps at the last γ without progress. If bad triangles have not become fewer, another restart
// promises more; if the energy has not fallen, it will not fall.
constexpr int kPatience = 25;
// Number of sweeps in which single vertices may make a barrier's infinite energy finite, before all weights shrink.
constexpr int kInfinitePatience = 5;

}  // namespace

EnergyPhase::EnergyPhase(const WorkingCopy& work, const Settings& settings, SweepState& state, Run& run,
                         const Restart& restart)
    : work_(work), settings_(settings), state_(state), run_(run), restart_(restart) {}

void EnergyPhase::begin() {
  before_switch_ = restart_.first_energy.has_value();
  take_energy(restart_.first_energy.value_or(settings_.options.energy));
}

void EnergyPhase::take_energy(EnergyKind kind) {
  state_.set_energy(kind, settings_.policy);
  gamma_schedule_ = GammaSchedule(restart_, state_.energy, settings_.policy);
  gamma_schedule_.start(work_.mesh, state_.model);
  state_.relaxation = settings_.policy.relaxation.value_or(gamma_schedule_.relaxation());
  least_bad_ = work_.mesh.n_triangles();
  sweeps_since_fewer_bad_ = sweeps_since_lower_ = infinite_sweeps_ = 0;
  before_ = total();
  least_energy_ = kInfinity;
}

void EnergyPhase::take_last_energy() {
  if (!before_switch_) return;
  before_switch_ = false;
  take_energy(settings_.options.energy);
}

double EnergyPhase::total() const {
  return state_.energy_unit(work_.units) * total_energy(work_.mesh, state_.model, settings_.executor());
}

SweepRecord EnergyPhase::measure() {
  return record_of(energy_and_bad(work_.mesh, state_.model, engine_of(settings_.hooks)));
}

SweepRecord EnergyPhase::record_of(const EnergyAndBad& measured) const {
  const double length_parameter = state_.energy.softened_by_h0 ? state_.model.h0.value : state_.model.gamma.value;
  return {.energy = state_.energy_unit(work_.units) * measured.energy,
          .bad = measured.bad,
          .length_parameter = length_parameter};
}

/// Line 19 of Algorithm 1, with the extra cases of a softened barrier and an infinite energy.
Phase::Verdict EnergyPhase::judge(bool changed) {
  if (before_switch_ && iteration >= settings_.policy.switch_at) {
    take_last_energy();
    return Verdict::restarted;
  }
  if (is_ready_for_accuracy(changed)) {
    run_.report.stopped = Stopped::converged;  // the next phase needs no more of this energy
    return Verdict::settled;
  }
  const double after = run_.report.history.back().energy;
  if (!std::isfinite(after)) {
    if (++infinite_sweeps_ > kInfinitePatience) return Verdict::infinite;
    compare_from_here();
    return Verdict::improving;
  }
  if (gamma_schedule_.settled() && !changed && converged(before_, after)) {
    if (before_switch_) {
      take_last_energy();
      return Verdict::restarted;
    }
    if (!settings_.policy.defers_flips() && goes_on_with_weights()) return Verdict::improving;
    run_.report.stopped = Stopped::converged;
    return Verdict::settled;
  }
  if (gamma_schedule_.settled() && may_give_up_ && !before_switch_ && stagnates()) return Verdict::stopped;
  const double fall = (before_ - after) / std::abs(after);
  const bool sharper = gamma_schedule_.advance(work_.mesh, fall, run_.report.history.back().bad, state_.model);
  state_.relaxation = settings_.policy.relaxation.value_or(gamma_schedule_.relaxation());
  before_ = !sharper ? after : gamma_schedule_.compares_energies() ? total() : kInfinity;
  return Verdict::improving;
}

/// Says whether the accuracy phase may follow: nothing is bad, and the margins are there or grow slowly.
bool EnergyPhase::is_ready_for_accuracy(bool changed) const {
  const SweepRecord& last = run_.report.history.back();
  if (settings_.objective == Objective::energy || before_switch_ || last.bad > 0) return false;
  const bool is_late = gamma_schedule_.settled() && !changed && !settings_.accuracy.keeps_lengths();
  const bool gains_little = is_late && before_ - last.energy < kGainOfLastSweep * std::abs(before_);
  return gains_little || has_all_for_accuracy(work_.mesh, settings_);
}

/// The paper's rule takes a rise for convergence. The relative rule waits for the energy to fall again.
bool EnergyPhase::converged(double before, double after) {
  const double tolerance = settings_.policy.tolerance;
  if (settings_.policy.stopping == StoppingRule::paper) {
    return before - after < tolerance * static_cast<double>(work_.mesh.n_triangles());
  }
  const double change = tolerance * std::abs(after);
  const bool lower = after < least_energy_ - change;
  sweeps_since_lower_ = lower ? 0 : sweeps_since_lower_ + 1;
  least_energy_ = std::min(least_energy_, after);
  return std::abs(before - after) <= change || sweeps_since_lower_ >= kPatience;
}

bool EnergyPhase::stagnates() {
  const std::size_t bad = run_.report.history.back().bad;
  const bool fewer = static_cast<double>(bad) < restart_.fewer * static_cast<double>(least_bad_);
  sweeps_since_fewer_bad_ = fewer ? 0 : sweeps_since_fewer_bad_ + 1;
  if (fewer) least_bad_ = bad;
  return bad > 0 && sweeps_since_fewer_bad_ >= kPatience;
}

/// If positions converge before i_w, the weights become unknowns now.
bool EnergyPhase::goes_on_with_weights() {
  const int from = settings_.policy.weights_from;
  if (settings_.options.unknowns != Unknowns::positions_and_weights || iteration >= from) return false;
  iteration = from;
  return true;
}

}  // namespace temper
