// A phase of a run: what its sweeps lower, and when they have lowered it enough. The driver makes the sweeps.
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
  /// restarted: what is lowered from here on is another energy; no mesh so far compares.
  enum class Verdict { improving, restarted, infinite, settled, stopped };
  /// The mesh that the driver returns: the last one; that of the best sweep; that of the best sweep or the one before
  /// the first, of a phase that moves vertices alone, so that their points are all that is kept.
  enum class Keeps { last, best_sweep, best_points };

  virtual ~Phase() = default;

  /// Begins the phase; to be called before the first sweep.
  virtual void begin() = 0;
  /// Says whether there may be another sweep; if not, the report says why the run stopped.
  [[nodiscard]] virtual bool may_sweep() const = 0;
  /// The energy of the mesh as it is, in the user's units.
  [[nodiscard]] virtual double total() const = 0;
  /// The mesh as it is for the history of the run.
  virtual SweepRecord measure() = 0;
  /// Judges a sweep that the history has as its last. `changed`: vertices are gone, or new ones there.
  virtual Verdict judge(bool changed) = 0;
  /// Compares with the last of the history from now on: after flips, or when all weights have shrunk.
  virtual void compare_from_here() {}
  /// Says whether there is more to lower once all has settled: weights, after positions.
  virtual bool goes_on_with_weights() { return false; }
  /// Moves all vertices at once, where the phase does that in place of a sweep; none if it does not. False when it was
  /// cut short.
  virtual std::optional<bool> move_all(const Recorder& /*recorder*/) { return std::nullopt; }
  [[nodiscard]] virtual Keeps keeps() const = 0;

  int iteration = 0;  ///< the paper's i: sweeps of this phase
};

/// Lowers an energy of the registry: one restart, or a polish.
class EnergyPhase final : public Phase {
 public:
  /// `may_give_up`: the phase ends too when triangles stay bad for many sweeps.
  EnergyPhase(const WorkingCopy& work, const Settings& settings, SweepState& state, Run& run, const Restart& restart,
              bool may_give_up);

  void begin() override;
  [[nodiscard]] bool may_sweep() const override { return run_.sweeps_left(); }
  [[nodiscard]] double total() const override;
  SweepRecord measure() override;
  Verdict judge(bool changed) override;
  void compare_from_here() override { before_ = run_.report.history.back().energy; }
  bool goes_on_with_weights() override;
  [[nodiscard]] Keeps keeps() const override { return state_.energy.barrier ? Keeps::last : Keeps::best_sweep; }
  /// What has been measured of the mesh as it is, for the history of the run.
  [[nodiscard]] SweepRecord record_of(const EnergyAndBad& measured) const;
  /// From the restart's first energy to that of the options, if it has not been reached.
  void take_last_energy();

 private:
  void take_energy(EnergyKind kind);
  bool converged(double before, double after);
  bool stagnates();

  const WorkingCopy& work_;
  const Settings& settings_;
  SweepState& state_;
  Run& run_;
  Restart restart_;
  bool before_switch_ = false;  // from the first energy to that of the options
  GammaSchedule gamma_schedule_;
  bool may_give_up_;
  double before_ = 0;          // energy at the start of the sweep
  std::size_t least_bad_ = 0;  // when they last were fewer, and for how many sweeps
  int sweeps_since_fewer_bad_ = 0;
  double least_energy_ = 0;  // at the last γ, and for how many sweeps
  int sweeps_since_lower_ = 0;
  int infinite_sweeps_ = 0;
};

}  // namespace temper
