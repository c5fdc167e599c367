// A phase of a run: it sets the energy of sweeps, and decides when they are finished. The driver makes them.
#pragma once

#include <optional>

#include "energy/whole_mesh.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/run/run.hpp"
#include "optimize/run/schedule.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {

class Recorder;

class Phase {
 public:
  /// restarted: later sweeps lower another energy, so no earlier mesh can be compared.
  enum class Verdict { improving, restarted, infinite, settled, stopped };
  /// The mesh that the driver returns. `best_points` is for a phase that moves vertices alone, so that only points are
  /// kept; the mesh before its first sweep counts, too.
  enum class Keeps { last, best_sweep, best_points };

  virtual ~Phase() = default;

  /// Begins the phase. Call it before the first sweep.
  virtual void begin() = 0;
  /// Says whether another sweep may follow. If not, the report has the reason.
  [[nodiscard]] virtual bool may_sweep() const = 0;
  /// Returns the energy of the present mesh in the user's units.
  [[nodiscard]] virtual double total() const = 0;
  /// Measures the present mesh for the history of the run.
  virtual SweepRecord measure() = 0;
  /// Judges the last sweep of the history. `changed`: vertices were removed or inserted.
  virtual Verdict judge(bool changed) = 0;
  /// Makes later sweeps compare with the last record of the history, after flips or when all weights have shrunk.
  virtual void compare_from_here() {}
  /// Says, after positions have settled, whether weights can still lower the energy.
  virtual bool goes_on_with_weights() { return false; }
  /// Moves all vertices at once, if the phase does this instead of a sweep, else returns none. False: it was stopped.
  virtual std::optional<bool> move_all(const Recorder& /*recorder*/) { return std::nullopt; }
  [[nodiscard]] virtual Keeps keeps() const = 0;

  int iteration = 0;  ///< the paper's i: sweeps of this phase
};

/// Lowers an energy of the registry: one restart, or a polish.
class EnergyPhase final : public Phase {
 public:
  EnergyPhase(const WorkingCopy& work, const Settings& settings, SweepState& state, Run& run, const Restart& restart);
  /// From now on the phase also ends if triangles stay bad for many sweeps.
  void let_give_up() { may_give_up_ = true; }

  void begin() override;
  [[nodiscard]] bool may_sweep() const override { return run_.sweeps_left(); }
  [[nodiscard]] double total() const override;
  SweepRecord measure() override;
  Verdict judge(bool changed) override;
  void compare_from_here() override { before_ = run_.report.history.back().energy; }
  bool goes_on_with_weights() override;
  [[nodiscard]] Keeps keeps() const override { return state_.energy.barrier ? Keeps::last : Keeps::best_sweep; }
  /// Returns the record of these measures of the present mesh, for the history of the run.
  [[nodiscard]] SweepRecord record_of(const EnergyAndBad& measured) const;
  /// Switches from the restart's first energy to options.energy, if that has not happened yet.
  void take_last_energy();

 private:
  void take_energy(EnergyKind kind);
  [[nodiscard]] bool is_ready_for_accuracy(bool changed) const;
  bool converged(double before, double after);
  bool stagnates();

  const WorkingCopy& work_;
  const Settings& settings_;
  SweepState& state_;
  Run& run_;
  Restart restart_;
  bool before_switch_ = false;  // from the first energy to options.energy
  GammaSchedule gamma_schedule_;
  bool may_give_up_ = false;
  double before_ = 0;          // energy at the start of the sweep
  std::size_t least_bad_ = 0;  // least number of bad triangles, and sweeps since then
  int sweeps_since_fewer_bad_ = 0;
  double least_energy_ = 0;  // least energy at the last γ, and sweeps since then
  int sweeps_since_lower_ = 0;
  int infinite_sweeps_ = 0;
};

}  // namespace temper
