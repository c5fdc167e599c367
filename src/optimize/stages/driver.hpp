// Algorithm 1 of the paper: sweeps over the vertices of a working copy until a phase is finished.
#pragma once

#include <optional>
#include <vector>

#include "optimize/flips/flipper.hpp"
#include "optimize/repair/trial_memo.hpp"
#include "optimize/stages/phase.hpp"
#include "optimize/sweep/sweeper.hpp"

namespace temper {

class Driver {
 public:
  /// `state`: the state of its sweeps.
  Driver(WorkingCopy& work, const Settings& settings, SweepState& state, Run& run, std::size_t part_size = kPartSize);

  /// Makes the whole input regular, before any phase. Returns false if weights hide a vertex against the policy.
  bool make_regular();
  /// Splits edges of the boundary and of lines, if the options ask for it.
  void grade_boundary();
  /// Splits such edges at bad triangles alone.
  void split_where_bad();
  /// Gives all vertices one weight, and inserts vertices around the bad triangles until none is larger than `factor`
  /// times the size that its place requires, as one sweep. Lines are split, too. Returns the number of new vertices.
  std::size_t refine_where_bad(double factor);
  /// Adds `amount` of their shortest edge squared to the heavier ends of ties (ties.hpp), and flips, as one sweep.
  /// Returns true if this is enough: then sweeps with a large γ would undo it.
  bool reweight_ties(double amount);
  /// Makes one restart on the input. Returns the sweep whose mesh the copy is then. `may_give_up`: lets EnergyPhase
  /// give up.
  int restart(const Restart& restart, bool may_give_up);
  /// Makes the sweeps of one phase. `sweep`: the sweep whose mesh the working copy is. Returns as restart().
  int run(Phase& phase, int sweep);
  /// Returns the least measure in the phase that was run last: the returned mesh has it, unless the phase keeps none.
  [[nodiscard]] double least_measure() const { return best_.measure; }

  /// Searches locally for repairs of triangles that all restarts left bad. Returns false if nothing changed.
  /// `asks_programs`: use linear programs for weights. `memo`: trials of this run with the
  /// same settings. `pace`: of trials with a guard.
  bool repair(TrialMemo& memo, std::uint64_t seed, Pace pace, bool asks_programs = false);
  /// Makes the places that violate the criterion good, with as few changes as possible. Returns as restart().
  int mend();
  /// Cures bad triangles, then searches for a mesh with fewer vertices.
  void coarsen(int moves_of_cure);
  /// Sweeps at the sharpest γ, after repairs. If triangles turn bad again, the sweeps are undone. `sweep` as in run().
  int polish(int sweep);

  [[nodiscard]] const Recorder& recorder() const { return recorder_; }

 private:
  using Verdict = Phase::Verdict;

  /// Moves free vertices by up to `amount` of their shortest edge, since symmetric grids are stationary in positions.
  void jitter(double amount);
  /// Counts and records the changes since the last sweep as one more sweep.
  void end_sweep_of_its_own();
  /// The same for changes by a search.
  template <class Measure>
  void end_round(const Phase& phase, const Measure& measure);
  void begin(Phase& phase, int sweep);
  Verdict sweep(Phase& phase);
  Verdict flip_if_deferred(Phase& phase, Verdict of_sweeps);
  bool improve_all_vertices(int iteration);
  void settle_updates(const IdVector<VertexId, WeightedPoint>& before);
  bool insert_vertices(int iteration);
  std::optional<Compaction> compact();
  void grow();
  bool halve_weights();
  void shift_weights_to_anchor();
  [[nodiscard]] IdVector<VertexId, WeightedPoint> points() const;
  void set_point(VertexId v, const WeightedPoint& p);
  void set_weight(VertexId v, double w);
  bool restore_regularity();
  void keep_if_best(const Phase& phase);
  void keep(const Phase& phase, double energy, int sweep);
  void keep_regular(int sweep);
  int return_best(const Phase& phase, int last_sweep);
  int return_regular(int last_sweep);
  void record(const SweepRecord& measured);
  void amend_record(const SweepRecord& measured);
  void show(Snapshot::Moment moment, const Phase& phase) const;

  WorkingCopy& work_;
  Mesh& mesh_;
  const Settings& settings_;
  SweepState& state_;
  Run& run_;
  Recorder recorder_;
  Flipper flipper_;
  Sweeper sweeper_;
  std::vector<VertexId> sequence_;                 // order in which a sweep visits the vertices; empty: by number
  int inner_ = 0, outer_ = 0;                      // iterations since the last flips, and rounds of flips
  Best<Candidate> best_;                           // by energy; with a mesh if the phase keeps one
  IdVector<VertexId, WeightedPoint> best_points_;  // if the phase keeps points alone
  int best_sweep_ = 0;
  std::optional<Candidate> regular_;  // mesh after the last deferred flips that did not fail
};

}  // namespace temper
