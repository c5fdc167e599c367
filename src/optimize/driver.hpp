// Algorithm 1 of the paper: sweeps over the vertices of a working copy until the energy no longer falls.
#pragma once

#include <optional>
#include <vector>

#include "optimize/run.hpp"
#include "optimize/schedule.hpp"
#include "optimize/settings.hpp"
#include "optimize/step/flipper.hpp"
#include "optimize/sweep/sweeper.hpp"
#include "optimize/trace/recorder.hpp"
#include "optimize/working_copy.hpp"
#include "temper/optimize.hpp"

namespace temper {

class Driver {
 public:
  /// `part_size`: of sweeps, see sweeper.hpp.
  Driver(WorkingCopy& work, Settings& settings, Run& run, std::size_t part_size = kPartSize);

  /// One attempt. With `may_give_up`, it ends too when triangles stay bad for many sweeps.
  void optimize(const Attempt& attempt, bool may_give_up);

  /// Lawson on the whole input, before any attempt. False when its weights hide a vertex that may not be.
  bool make_regular();
  /// Cuts edges of the boundary and of lines, when the options ask for it.
  void grade_boundary();
  /// Moves free vertices by up to `amount` of their shortest edge: symmetric grids are stationary in their positions.
  void jitter(double amount);

  /// Local search for what all attempts have left bad. False when nothing was changed.
  bool repair(std::uint64_t seed);
  /// Sweeps at the sharpest γ, after repairs; taken back when they lose triangles again. `sweep`: whose mesh it is.
  /// Returns the sweep whose mesh it is then.
  int polish(int sweep);

  /// The sweep whose mesh the attempt ended with: the last one, or with HOT the best.
  [[nodiscard]] int final_sweep() const { return final_sweep_; }
  [[nodiscard]] const Recorder& recorder() const { return recorder_; }

 private:
  enum class Verdict { improving, settled, stopped };

  void begin(const Attempt& attempt);
  Verdict sweep(bool may_give_up);
  Verdict judge_sweep(bool removed, bool may_give_up);
  Verdict flip_if_deferred(Verdict of_sweeps);
  bool improve_all_vertices();
  [[nodiscard]] bool newton_passes_help() const;
  bool newton_pass();
  void compact();
  void grow();
  bool halve_weights();
  void shift_weights_to_anchor();
  void set_weight(VertexId v, double w);
  bool restore_regularity();
  bool converged(double before, double after);
  bool begin_weights();
  bool stagnates();
  void keep_if_best();
  void return_best();
  [[nodiscard]] double total() const;
  void record();
  void amend_record();
  void show(Snapshot::Moment moment) const;

  WorkingCopy& work_;
  Mesh& mesh_;
  Settings& settings_;
  double energy_unit_;  // the user's energy of one unit in the frame
  Run& run_;
  Recorder recorder_;
  Flipper flipper_;
  Sweeper sweeper_;
  Softener softener_;
  std::vector<VertexId> sequence_;  // in which a sweep visits the vertices; empty: as they are numbered
  int iteration_ = 0;               // the paper's i, of this attempt
  int inner_ = 0, outer_ = 0;       // iterations since the last flips, and rounds of them
  double before_ = 0;               // energy at the start of the sweep
  std::size_t least_bad_ = 0;       // of this attempt so far, and for how many sweeps
  int sweeps_since_fewer_bad_ = 0;
  double least_energy_ = 0;  // at the last γ, and for how many sweeps
  int sweeps_since_lower_ = 0;
  int infinite_sweeps_ = 0;
  bool shrunk_ = false;
  double fall_ = 0;                  // of the energy in the last step at the last γ, relative
  bool passes_pay_ = true;           // Newton passes of this attempt, more than sweeps do
  std::optional<WorkingCopy> best_;  // of HOT energies: the best sweep
  double best_energy_ = 0;
  int best_sweep_ = 0, final_sweep_ = 0;
};

}  // namespace temper
