// Algorithm 1 of the paper: sweeps over the vertices of a working copy until a phase has what it wants.
#pragma once

#include <optional>
#include <vector>

#include "optimize/flips/flipper.hpp"
#include "optimize/stages/phase.hpp"
#include "optimize/sweep/sweeper.hpp"

namespace temper {

class Driver {
 public:
  /// `state`: of the sweeps that it makes.
  Driver(WorkingCopy& work, const Settings& settings, SweepState& state, Run& run, std::size_t part_size = kPartSize);

  /// Lawson on the whole input, before any phase. False when its weights hide a vertex that may not be.
  bool make_regular();
  /// BoundarySplitting edges of the boundary and of lines, when the options ask for it.
  void grade_boundary();
  /// The same at bad triangles alone.
  void split_where_bad();
  /// One restart on the input. Returns the sweep whose mesh the working copy is then. `may_give_up`: as EnergyPhase.
  int restart(const Restart& restart, bool may_give_up);
  /// Sweeps of one phase. `sweep`: whose mesh the working copy is. Returns as above.
  int run(Phase& phase, int sweep);

  /// Local search for what all restarts have left bad. False when nothing was changed. `asks_programs`: for weights.
  bool repair(std::uint64_t seed, bool asks_programs = false);
  /// Sweeps at the sharpest γ, after repairs; taken back when they lose triangles again. `sweep` as above.
  int polish(int sweep);

  [[nodiscard]] const Recorder& recorder() const { return recorder_; }

 private:
  using Verdict = Phase::Verdict;

  /// Moves free vertices by up to `amount` of their shortest edge: symmetric grids are stationary in their positions.
  void jitter(double amount);
  /// Makes the heavier ends of ties (ties.hpp) heavier by `amount` of their shortest edge squared, and flips: a sweep
  /// of its own. True when that is all it takes: sweeps with a large γ would undo it.
  bool reweight_ties(double amount);
  /// Counts and records what was done to the mesh since the last sweep as one more.
  void end_sweep_of_its_own();
  void begin(Phase& phase, int sweep);
  Verdict sweep(Phase& phase);
  Verdict flip_if_deferred(Phase& phase, Verdict of_sweeps);
  bool improve_all_vertices(int iteration);
  void settle_updates(const IdVector<VertexId, WeightedPoint>& before);
  bool insert_vertices(int iteration);
  void compact();
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
  void record(SweepRecord measured);
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
  std::vector<VertexId> sequence_;                 // in which a sweep visits the vertices; empty: as they are numbered
  int inner_ = 0, outer_ = 0;                      // iterations since the last flips, and rounds of them
  std::optional<Candidate> best_;                  // where the phase keeps one
  IdVector<VertexId, WeightedPoint> best_points_;  // where the phase keeps points alone
  double best_energy_ = 0;
  int best_sweep_ = 0;
  std::optional<Candidate> regular_;  // where flips are deferred, and may fail: after the last that did not
};

}  // namespace temper
