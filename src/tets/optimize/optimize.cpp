// The driver: weights alone, sweeps along the schedule of γ, repairs (repair_run.hpp), and the descent of errors.
#include "temper/tets/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "feasibility/demand.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/run/changes.hpp"
#include "temper/detail/convex.hpp"
#include "temper/feasibility.hpp"
#include "temper/tets/weights.hpp"
#include "tets/optimize/accuracy.hpp"
#include "tets/optimize/hot_sweeps.hpp"
#include "tets/optimize/near_sweeps.hpp"
#include "tets/optimize/repair.hpp"
#include "tets/optimize/repair_run.hpp"
#include "tets/optimize/sweeper.hpp"
#include "tets/optimize/tensors.hpp"

namespace temper::tets {
namespace {

// γ shrinks from level to level, as in the plane (optimize/run/schedule.hpp). On 13 public meshes a last γ of 0.01
// leaves 10 bad tetrahedra in a ball that Run::kLastGamma makes good, and steps of 0.85 gain nothing.
constexpr double kFirstGamma = 1, kGammaFactor = 0.7;
constexpr int kLevelSweeps = 3;
constexpr double kRelaxation = 1.7;
// The run ends at the last γ, when a sweep lowers the energy by less than the tolerance, a part of the energy. It ends
// after kLastSweeps at the latest.
constexpr double kTolerance = 1e-4;
constexpr int kLastSweeps = 100;
// A run without repairs ends earlier, if so many sweeps at the last γ cure at most this part of the bad tetrahedra. The
// others need another connectivity, and most sweeps would go there.
constexpr std::size_t kSweepsToCure = 10;
constexpr double kLeastCured = 0.01;
// Moves that do not bring errors below the input's must lower them by this part.
constexpr double kGainOfMoves = 0.2;
// Steps of weights alone, which go nearly as far as they can.
constexpr int kStepsOfWeights = 40;
// The most sweeps for a HOT energy.
constexpr int kMostHotSweeps = 32;

class Driver : RepairRun {
 public:
  Driver(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
         std::span<const VertexId> frozen = {})
      : RepairRun(mesh, options, hooks, frozen) {}

  OptimizeReport run() {
    if (changes_least()) {
      change_bad_places();
    } else {
      if (criterion_ == Criterion::well_centered || best_bad_ > 0) make_good();
      if (!stopped_early() && lowers_errors()) lower_errors();
      if (!stopped_early() && lowers_hot(options_)) lower_hot();
    }
    return end();
  }

 private:
  /// Changes places that violate the criterion alone, or the whole mesh if these are many or stay bad. Sweeps come
  /// first, then programs for weights, which are as small as the places.
  void change_bad_places() {
    many_are_bad_ = are_many(best_bad_, input_.mesh.n_tetrahedra());
    const std::size_t at_start = best_bad_;
    if (best_bad_ == 0 || made_good_nearby() || takes_least_weights() || split_surface()) return;
    if (!many_are_bad_ && changes_connectivity()) repair_in_patches(criterion_);
    const std::size_t left = best_bad_;
    if (left == 0 || stopped_early()) return;
    draft_ = input_;
    sweep_and_repair();
    if (best_bad_ < left) places_left_ = many_are_bad_ ? at_start : left;
  }

  /// Sweeps near bad tetrahedra. They keep the connectivity. They change less than programs for weights, and cost less.
  bool made_good_nearby() {
    if (many_are_bad_) return false;
    const auto must_stop = [this](double fraction) { return is_stopped(fraction); };
    (void)sweep_near_violations(draft_, {criterion_, guarded_cosine()}, must_stop, hooks_.executor);
    end_round(true);
    return best_bad_ == 0 || stopped_early();
  }

  /// Makes the mesh keep the criterion. Weights alone come first if the solver needs less than well-centered
  /// tetrahedra, then patches where weights do not suffice. For unknowns in cells sweeps go before: errors are less if
  /// most orthocenters are inside.
  void make_good() {
    if (criterion_ != Criterion::coefficients || !made_good_by_weights()) sweep_and_repair();
  }
  void sweep_and_repair() {
    const bool goes_on = anneal(best_bad_ == 0 ? kLastGamma : kFirstGamma);
    if (criterion_ == Criterion::distances && (best_bad_ == 0 || made_good_by_weights())) return;
    // Patches for distances were in vain: where all orthocenters get inside, distances are positive, too.
    if (goes_on && changes_connectivity())
      repair(criterion_ == Criterion::distances ? Criterion::well_centered : criterion_);
    if (criterion_ != Criterion::well_centered && !stopped_early()) (void)takes_least_weights();
  }
  bool made_good_by_weights() {
    const Draft start = draft_;
    if (takes_least_weights() || split_surface()) return true;
    if (!changes_connectivity()) return false;
    repair_in_patches(criterion_);
    if (best_bad_ == 0) {
      (void)takes_least_weights();
      return true;
    }
    if (!stopped_early()) draft_ = start;
    return stopped_early();
  }
  /// Gives the best mesh the least weights that keep the criterion, or those that violate it little. Says whether it is
  /// kept now.
  bool takes_least_weights() {
    if (!has_weights_alone()) return false;
    draft_ = *best_.kept;
    give_least_weights();
    return best_bad_ == 0;
  }
  [[nodiscard]] bool has_weights_alone() const {
    return options_.unknowns != temper::Unknowns::positions && !has_frozen_ && hooks_.solvers.lp &&
           hooks_.solvers.convex;
  }
  /// To the mesh that changes, which then counts as one more sweep.
  void give_least_weights() {
    WeightOptions wanted;
    wanted.goal = WeightGoal::least;
    wanted.constraints = constraints_of(criterion_);
    wanted.from_input = changes_least();
    if (changes_least()) {  // only the corners of bad places, in small meshes, too; more where these do not suffice
      wanted.whole = 0;
      wanted.rings = 0;
    }
    wanted.must_stop = [this] { return is_stopped(0); };
    const auto found = find_weights(draft_.mesh, *hooks_.solvers.lp(), wanted, hooks_.solvers.convex().get());
    if (!found || found->weights.size() != draft_.mesh.n_vertices()) return;
    for (const VertexId v : draft_.mesh.vertices()) draft_.mesh.set_weight(v, found->weights[v]);
    end_round(true);
  }

  /// Splits edges of the surface that have negative coefficients with all weights, as Delaunay refinement does, as long
  /// as violations get fewer. Says whether none is left.
  bool split_surface() {
    if (options_.boundary != BoundaryVertices::split || criterion_ != Criterion::coefficients || !has_weights_alone())
      return false;
    for (std::size_t before = best_bad_ + 1; best_bad_ > 0 && best_bad_ < before && may_sweep();) {
      before = best_bad_;
      if (!split_violated_edges(draft_, hooks_.executor)) break;
      give_least_weights();
    }
    return best_bad_ == 0;
  }

  /// Sweeps along the schedule of γ. False: the run must end.
  bool anneal(double first_gamma) {
    const auto all = draft_.mesh.vertices();  // by name, too: the connectivity is that of the input
    Sweeper sweeper(draft_.mesh, draft_.mobility, std::vector<VertexId>(all.begin(), all.end()), hooks_.executor);
    for (double gamma = first_gamma; gamma > kLastGamma; gamma *= kGammaFactor) {
      for (int i = 0; i < kLevelSweeps; ++i) {
        if (!sweep(sweeper, gamma)) return false;
      }
    }
    std::vector<std::size_t> bad = {best_bad_};
    for (int i = 0; i < kLastSweeps && !cures_little(bad); ++i) {
      if (!sweep(sweeper, kLastGamma)) return false;
      bad.push_back(best_bad_);
      const auto last = report.history.end() - 1;
      if (i > 0 && (last - 1)->energy - last->energy <= kTolerance * last->energy) break;
    }
    return true;
  }
  /// Says whether the last sweeps of a run without repairs cured little; `bad`: what was left after each.
  [[nodiscard]] bool cures_little(const std::vector<std::size_t>& bad) const {
    if (options_.tets.repair_trials > 0 || bad.size() <= kSweepsToCure || bad.back() == 0) return false;
    const auto before = static_cast<double>(bad[bad.size() - 1 - kSweepsToCure]);
    return static_cast<double>(bad.back()) >= (1 - kLeastCured) * before;
  }
  /// Returns false if no further sweep may follow. A sweep that was stopped is kept if it makes the mesh no worse.
  bool sweep(Sweeper& sweeper, double gamma) {
    if (!may_sweep()) return false;
    gamma_ = gamma;
    if (sweeper.sweep({gamma, kRelaxation, guarded_cosine()}, [this](double fraction) { return is_stopped(fraction); }))
      ++report.sweeps;
    record();
    return !stopped_early();
  }

  /// Lowers the errors of the scheme. The best mesh is the one with the least error.
  void lower_errors() {
    if (errors_.model != nullptr && errors_.unit.empty())  // the input had negative coefficients
      errors_.unit = errors_.model->errors(best_.kept->mesh);
    const auto error_of = [this](const TetMesh& mesh) { return error_ratio_of(mesh); };
    begin_phase(error_of);
    const bool has_gradient = !errors_.unit.empty() && errors_.model->has_gradient();
    const AccuracyErrors lowered = has_gradient ? errors_ : AccuracyErrors{};
    const Draft start = draft_;
    descend_from(start, lowered, false);
    if (has_gradient && best_.measure >= 1 && !stopped_early()) prefer_weights_alone(start, lowered);
    // A run that must stop does not measure any more: it keeps the mesh before these steps.
    if (lowered.model == nullptr && !(errors_.model && stopped_early())) keep_if_best(error_of(draft_.mesh));
  }
  /// Descends from a mesh, also again where corners must keep their place. Measures the best mesh.
  void descend_from(const Draft& start, const AccuracyErrors& lowered, bool weights_alone) {
    draft_ = start;
    IdVector<VertexId, Mobility> mobility = draft_.mobilities();
    for (Mobility& m : mobility) {
      if (weights_alone) m = m.weighs ? Mobility::weight : Mobility::none;
    }
    int steps = weights_alone ? std::max(0, options_.tets.accuracy_steps - kStepsOfWeights) : 0;
    while (descend(lowered, mobility, steps)) {
    }
  }
  /// Where errors of the input cancel, as on cubes that are cut in six, moves cannot bring them below the input's. Then
  /// positions stay, unless moves lower errors by more than a part.
  void prefer_weights_alone(const Draft& start, const AccuracyErrors& lowered) {
    const Best<Draft> moved = best_;
    best_ = {start, error_ratio_of(start.mesh)};
    descend_from(start, lowered, true);
    if (stopped_early() || moved.measure < (1 - kGainOfMoves) * best_.measure) best_ = moved;
  }
  /// Lets all corners of violating tetrahedra keep their place, if there are more than in the best mesh.
  bool kept_at_violations(IdVector<VertexId, Mobility>& mobility) {
    const std::vector<TetId> bad = violating(draft_, criterion_, hooks_.executor);
    if (bad.size() <= best_bad_) return false;
    for (const TetId t : bad) {
      for (const VertexId v : draft_.mesh.corners(t)) mobility[v] = Mobility::none;
    }
    return true;
  }
  /// Descends as far as it goes. The barrier is about faces, but coefficients of edges on the boundary and on
  /// interfaces have parts in faces, too. Where they become negative, all corners keep the place that they have in the
  /// best mesh. From there the descent begins again: then it returns true.
  bool descend(const AccuracyErrors& lowered, IdVector<VertexId, Mobility>& mobility, int& steps) {
    Accuracy accuracy(draft_.mesh, mobility, accuracy_model(options_.scheme), {criterion_, most_cosine_}, lowered,
                      hooks_.executor);
    for (; steps < options_.tets.accuracy_steps && may_sweep(); ++steps) {
      if (!accuracy.descend([this](double fraction) { return is_stopped(fraction); })) return false;
      ++report.sweeps;
      if (criterion_ == Criterion::coefficients && kept_at_violations(mobility)) {
        draft_ = *best_.kept;
        return true;
      }
      record(lowered.model != nullptr ? Objective::solver_error : Objective::accuracy, accuracy.measure());
      if (lowered.model != nullptr) keep_if_best(accuracy.measure());
    }
    return false;
  }

  /// Lowers a HOT energy. The best mesh is the one with the least.
  void lower_hot() {
    begin_phase([this](const TetMesh& mesh) { return objective_of(mesh); });
    HotSweeps sweeps(draft_.mesh, draft_.mobilities(), hot_, kRelaxation, hooks_.executor);
    for (int i = 0; i < std::min(kMostHotSweeps, options_.tets.accuracy_steps) && may_sweep(); ++i) {
      if (sweeps.sweep([this](double fraction) { return is_stopped(fraction); })) ++report.sweeps;
      const double before = report.history.back().energy, now = objective_of(draft_.mesh);
      keep_if_best(now);
      if (stopped_early()) return;
      record(Objective::accuracy, now);
      if (i > 0 && before - now <= kTolerance * before) return;
    }
  }
};

}  // namespace

Expected<OptimizeReport> optimize(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  if (auto right = check_together(options, CellKinds::tetrahedra); !right) return right.error();
  if (mesh.n_tetrahedra() == 0) return OptimizeReport{};
  if (options.tetrahedra_tensors.empty()) return Driver(mesh, options, hooks).run();
  return optimize_in_metrics(mesh, options, hooks, [](TetMesh& there, const PiecesRunOptions& run) {
    return Driver(there, run.options, run.hooks, run.frozen).run();
  });
}

}  // namespace temper::tets
