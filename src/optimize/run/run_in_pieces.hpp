// A run in the planes of diffusion tensors (temper/detail/tensor.hpp), for triangles and for tetrahedra.
//
//     cut along interfaces     vertices of interfaces stay, with weight 0, which keeps all equations
//            │
//           run  <───────┐
//            │           │
//     bad at interfaces: split edges of them on all sides, or let their vertices slide
//            │
//     bad: a linear program with the equations of interfaces looks for better weights
//            │
//     the best of all these, and of the input, is joined
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/sort_unique.hpp"
#include "feasibility/demand.hpp"
#include "optimize/run/end_of_run.hpp"
#include "optimize/run/numbers.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/feasibility.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Cells is a kind of cells, in the way of Triangles in src/optimize/tensors.cpp: types of meshes and reports, and the
/// parts of a run that differ.
template <class Cells>
class RunInPieces {
 public:
  using Mesh = typename Cells::Mesh;
  using Pieces = typename Cells::Pieces;
  using Numbers = typename Cells::Numbers;
  using Hooks = typename Cells::Hooks;
  using Report = typename Cells::Report;
  using Faults = std::pair<std::size_t, std::size_t>;

  RunInPieces(const Mesh& original, Pieces pieces, OptimizeOptions options, const Hooks& hooks,
              const typename Cells::Run& run)
      : original_(original),
        first_(std::move(pieces)),
        now_{first_, {}},
        options_(std::move(options)),
        hooks_(hooks),
        cells_{options_, hooks_, run} {
    options_.tensor.reset();
    options_.triangle_tensors.clear();
    options_.tetrahedra_tensors.clear();
    options_.corner_weights.clear();
    options_.guard.depth.clear();                                            // waves do not know that plane
    if (!hooks_.started) hooks_.started = std::chrono::steady_clock::now();  // the limit is of all runs together
    if (hooks.best_so_far) listen(hooks.best_so_far);
  }
  RunInPieces(const RunInPieces&) = delete;
  RunInPieces& operator=(const RunInPieces&) = delete;
  ~RunInPieces() = default;

  /// Runs, and puts the result in the place of the mesh.
  Expected<Report> run(Mesh& mesh) {
    auto report = run_pieces();
    if (!report) return report;
    auto whole = mapped_back(now_.pieces, original_, first_, Cells::vertices(now_.numbers));
    if (!whole) return whole.error();
    Cells::numbers_of(*report) = std::move(now_.numbers);
    Cells::vertices(Cells::numbers_of(*report)) = std::move(whole->vertices);
    Cells::tensors_of(*report) = std::move(whole->tensors);
    report->corner_weights = std::move(whole->corner_weights);
    count_vertices(*report, Cells::vertices(Cells::numbers_of(*report)), original_.n_vertices());
    mesh = std::move(whole->mesh);
    return report;
  }

 private:
  // Largest number of runs; before each but the first, interfaces change at bad cells.
  static constexpr int kRuns = 5;
  // Linear programs of larger meshes are about the neighborhoods of bad cells alone.
  static constexpr std::size_t kWhole = 500;
  // If more cells are bad, programs take long and help little: vertices have to move.
  static constexpr std::size_t kMostBadForPrograms = 500;
  // Crossings of an interface edge that differ by less are one, up to the rounding of coordinates of maps.
  static constexpr double kClosed = 1e-7;

  struct State {
    Pieces pieces;
    Numbers numbers;  ///< in the first pieces; empty: the same
  };

  Expected<Report> run_pieces() {
    if (!first_.is_cut()) return run_once();
    first_faults_ = cells_.faults_of(first_.mesh);
    if (options_.change == Change::least && first_faults_.first == 0) return run_once();  // nothing to do
    const bool changes = options_.boundary == Cells::kChangesSeams;
    const bool keeps_equations = cells_.largest_gap(first_) <= kClosed;
    if (keeps_equations) start_with_input();
    if (!keeps_equations || changes) flatten();
    if (changes) (void)change_seams(nullptr);
    auto report = run_and_keep();
    for (int i = 1; i < kRuns && changes && report && !stopped_early(report->stopped); ++i) {
      const Faults before = last_faults_;
      if (before.first == 0) break;
      if (!change_seams(&*report)) break;
      auto next = run_and_keep();
      if (!next) return next;
      report = joined(*std::move(report), *std::move(next));
      const auto n_bad = static_cast<double>(last_faults_.first);
      if (last_faults_ >= before && n_bad < Cells::kFewBad * Cells::n_cells(now_.pieces.mesh)) break;
    }
    if (report && !stopped_early(report->stopped)) reweigh();
    if (report) return_best(*report);
    return report;
  }
  Expected<Report> run_and_keep() {
    auto report = run_once();
    if (report) keep_if_best();
    return report;
  }

  void listen(const typename Cells::BestListener& listener) {
    hooks_.best_so_far = [this, listener](const auto& best) {
      listener([&](const auto& use) {
        best([&](const typename Cells::BestSoFar& found) {
          const Numbers& there = Cells::numbers_of(found);
          const Pieces pieces = with_mesh(now_.pieces, found.mesh, Cells::vertices(there));
          Numbers numbers = numbers_before_both(there, now_.numbers);
          auto whole = mapped_back(pieces, original_, first_, Cells::vertices(numbers));
          if (!whole) return;
          Cells::vertices(numbers) = std::move(whole->vertices);
          use({whole->mesh, numbers});
        });
      });
    };
  }

  [[nodiscard]] static std::vector<VertexId> interface_vertices(const Pieces& pieces) {
    std::vector<VertexId> all;
    for (const auto& seam : seams_of(pieces)) {
      for (const auto side : {seam.one, seam.other}) {
        for (const VertexId v : Cells::vertices_of(pieces.mesh, side)) all.push_back(v);
      }
    }
    sort_unique(all);
    return all;
  }

  Expected<Report> run_once() {
    Mesh there = now_.pieces.mesh;
    auto report = cells_.run(there, interface_vertices(now_.pieces));
    if (!report) return report;
    const Numbers& numbers = Cells::numbers_of(*report);
    now_.pieces = with_mesh(now_.pieces, std::move(there), Cells::vertices(numbers));
    now_.numbers = numbers_before_both(numbers, now_.numbers);
    return report;
  }

  /// Sets the weights of interfaces to zero.
  void flatten() {
    for (const VertexId v : interface_vertices(now_.pieces)) now_.pieces.mesh.set_weight(v, 0);
    cells_.settle_weights(now_.pieces.mesh);
  }

  /// Splits edges of interfaces, or moves vertices along them, on all sides. `so_far`: the report of the runs before;
  /// null before all runs. Says whether there was something to do.
  bool change_seams(const Report* so_far) {
    const auto whole = [this]() -> Mesh {
      auto joined = mapped_back(now_.pieces, original_, first_, Cells::vertices(now_.numbers));
      return joined ? std::move(joined->mesh) : Mesh();
    };
    const auto must_stop = [&] {
      return is_late() ||
             (hooks_.observer && hooks_.observer({so_far->history.back(), 0, options_.max_sweeps}) == Continue::no);
    };
    const auto numbers = so_far == nullptr ? cells_.change_seams(now_.pieces)
                                           : cells_.change_seams_at_bad(now_.pieces, whole, must_stop);
    if (!numbers) return false;
    now_.numbers = numbers_before_both(*numbers, now_.numbers);
    cells_.settle_weights(now_.pieces.mesh);
    return true;
  }

  void start_with_input() {
    best_ = now_;
    least_faults_ = first_faults_;
    best_is_input_ = true;
  }
  void keep_if_best() {
    last_faults_ = cells_.faults_of(now_.pieces.mesh);
    if (!best_.pieces.is_cut() || last_faults_ <= least_faults_) keep(last_faults_);
  }
  void keep(const Faults& faults) {
    best_ = now_;
    least_faults_ = faults;
    best_is_input_ = false;
  }

  /// Finds weights that keep the equations of interfaces: those that make all cells well-centered, or those that
  /// violate the criterion least. Takes them if fewer cells are bad. The programs are of the best mesh, and of the last
  /// one, in which interfaces may have more room.
  void reweigh() {
    State last = std::exchange(now_, best_);
    reweigh_now();
    now_ = std::move(last);
    reweigh_now();
  }
  void reweigh_now() {
    if (Cells::kTriesWellCentered && least_faults_.second > 0) reweigh(WeightGoal::change, Constraints::well_centered);
    if (least_faults_.first > 0) reweigh(WeightGoal::elastic, constraints_of(criterion_of(options_.scheme)));
  }
  void reweigh(WeightGoal goal, Constraints constraints) {
    const bool may_change = options_.unknowns != Unknowns::positions;
    if (!hooks_.solvers.lp || !may_change || least_faults_.second > kMostBadForPrograms) return;
    WeightOptions wanted;
    wanted.goal = goal;
    wanted.constraints = constraints;
    wanted.from_input = true;
    wanted.whole = kWhole;
    wanted.must_stop = [this] { return is_late(); };
    const auto found = find_weights(now_.pieces, *hooks_.solvers.lp(), wanted);
    if (!found) return;
    Mesh weighted = now_.pieces.mesh;
    for (const VertexId v : weighted.vertices()) weighted.set_weight(v, found->weights[v]);
    if (!cells_.becomes_regular(weighted)) return;
    if (const Faults faults = cells_.faults_of(weighted); faults < least_faults_) {
      now_.pieces.mesh = std::move(weighted);
      keep(faults);
    }
  }
  [[nodiscard]] bool is_late() const {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - *hooks_.started;
    return options_.time_limit > 0 && seconds.count() >= options_.time_limit;
  }

  /// Returns the best state. It is the input if this has fewer faults, and its weights keep the equations of
  /// interfaces.
  void return_best(Report& report) {
    const bool is_input = best_is_input_;
    now_ = std::move(best_);
    report.bad_before = Cells::reported(first_faults_);
    report.bad_after = Cells::reported(least_faults_);
    if (is_input)
      report.notes.push_back("the input is returned: with its weights for each region it has fewer bad cells");
  }

  /// One report of two runs, one after the other.
  [[nodiscard]] static Report joined(Report first, Report next) {
    next.sweeps += first.sweeps;
    next.seconds += first.seconds;
    next.flips += first.flips;
    next.objective_before = first.objective_before;
    if constexpr (requires { next.size; }) next.size.before = first.size.before;
    first.history.insert(first.history.end(), next.history.begin(), next.history.end());
    next.history = std::move(first.history);
    return next;
  }

  const Mesh& original_;
  const Pieces first_;
  State now_, best_;  ///< best_ is empty before the first run, unless the input may be returned
  Faults first_faults_, least_faults_, last_faults_;  ///< of first_, of best_, and of the last run
  bool best_is_input_ = false;
  OptimizeOptions options_;
  Hooks hooks_;
  const Cells cells_;
};

}  // namespace temper
