// The state of a run: the mesh that changes, the best mesh so far, the input, the errors and angles to compare with,
// and the report. optimize.cpp has the steps of the run.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "optimize/run/run_of.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/energy/hot.hpp"
#include "tets/optimize/accuracy.hpp"
#include "tets/optimize/draft.hpp"

namespace temper::tets {

[[nodiscard]] inline bool lowers_hot(const OptimizeOptions& o) { return o.energy == EnergyKind::F; }

class Run : protected RunOf<OptimizeHooks, OptimizeReport> {
 protected:
  static constexpr double kLastGamma = 0.003;

  /// `frozen`: vertices that keep their position and weight.
  Run(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks, std::span<const VertexId> frozen);

  [[nodiscard]] bool changes_least() const { return options_.change == Change::least; }
  /// A run without a scheme lowers errors if there is a model of them: offsets alone cost as much as all sweeps.
  [[nodiscard]] bool lowers_errors() const {
    return criterion_ != Criterion::well_centered || (errors_.model != nullptr && !lowers_hot(options_));
  }
  /// The HOT energy to lower, or the energy at the last γ.
  [[nodiscard]] double objective_of(const TetMesh& mesh) const;
  /// The errors of a mesh over those of the input, or of the first mesh that has a solution.
  [[nodiscard]] double error_ratio_of(const TetMesh& mesh) const;
  /// The largest cosine of a dihedral angle with the guard, and 1 without.
  [[nodiscard]] double guarded_cosine() const { return guards_angles() ? most_cosine_ : 1; }

  [[nodiscard]] bool may_sweep() {
    if (!stopped_early() && !sweeps_left()) report.stopped = Stopped::max_sweeps;
    return goes_on();
  }
  bool is_stopped(double fraction);
  /// Measures the mesh, and keeps it if it is the best so far: by the number of bad tetrahedra, and of equals the last
  /// one if `takes_equal`, else the first one.
  void record(bool takes_equal = true);
  /// The same after a round of repairs, which counts as a sweep.
  void end_round(bool takes_equal);
  /// Of a mesh with the number of bad tetrahedra of the best one.
  void record(Objective objective, double energy);
  /// The guard refuses meshes of smaller angles.
  void keep_if_best(double measure, bool takes_equal = true);

  /// Goes on from the best mesh. An input without bad tetrahedra is the best one if `measure` of it is less.
  template <class Measure>
  void begin_phase(const Measure& measure) {
    draft_ = *best_.kept;
    best_.measure = measure(draft_.mesh);
    if (input_.mesh.n_vertices() == 0 || is_stopped(0)) return;
    const double of_input = measure(input_.mesh);
    if (best_.is_beaten_by(of_input)) best_ = {input_, of_input};
  }
  /// Gives the best mesh back, or the input if an error of it is smaller.
  OptimizeReport end();

 private:
  [[nodiscard]] bool guards_angles() const { return options_.guard.angle > 0; }
  [[nodiscard]] double limit_of_angles() const;
  [[nodiscard]] bool is_input_better() const;
  void add_notes(const TetMesh& mesh, bool returns_input);
  [[nodiscard]] Origins origins_of(const Draft& draft) const;

  TetMesh& result_;  // empty until the end: best_ has the mesh
  std::size_t n_before_ = result_.n_vertices();
  double objective_before_ = 0;

 protected:
  const bool has_frozen_;  ///< Weights of some vertices must not change
  AccuracyErrors errors_;  ///< The model is null for large meshes, and where few places change
  const Criterion criterion_;
  const HotEnergy hot_;
  Draft draft_, input_;  ///< input_: empty, unless it may be given back or compared with
  Best<Draft> best_;
  std::size_t best_bad_ = 0;
  double gamma_ = 1;
  double cosine_before_, most_cosine_;  ///< of dihedral angles: the largest one of the input, and the limit
  bool many_are_bad_ = false;
  std::size_t places_left_ = 0;  ///< Bad tetrahedra that made the whole mesh change, with Change::least
};

}  // namespace temper::tets
