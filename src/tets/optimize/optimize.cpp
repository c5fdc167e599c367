// The driver: sweeps along the schedule of γ, the history, and the best mesh.
#include "temper/tets/optimize.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "optimize/options/settings.hpp"
#include "optimize/run/run_of.hpp"
#include "temper/detail/convex.hpp"
#include "temper/feasibility.hpp"
#include "temper/tets/criterion.hpp"
#include "temper/tets/weights.hpp"
#include "tets/optimize/accuracy.hpp"
#include "tets/optimize/hot_sweeps.hpp"
#include "tets/optimize/local_search.hpp"
#include "tets/optimize/mobility.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {
namespace {

// γ shrinks from level to level, as in the plane (optimize/run/schedule.hpp). On 13 public meshes a last γ of 0.01
// leaves 10 bad tetrahedra in a ball that 0.003 makes good, and steps of 0.85 gain nothing.
constexpr double kFirstGamma = 1, kGammaFactor = 0.7, kLastGamma = 0.003;
constexpr int kLevelSweeps = 3;
constexpr double kRelaxation = 1.7;
// The run ends at the last γ, when a sweep lowers the energy by less than the tolerance, a part of the energy. It ends
// after kLastSweeps at the latest.
constexpr double kTolerance = 1e-4;
constexpr int kLastSweeps = 100;
// Rounds of changes at all bad tetrahedra at once end when kRoundsInVain of them have not lowered the number.
constexpr int kRoundsInVain = 4;
// The most sweeps for a HOT energy.
constexpr int kMostHotSweeps = 32;
// Tetrahedra that trials of repairs may try, some seconds of work.
constexpr std::size_t kRepairWork = 100'000, kRepairWorkPerTet = 20;
// No dihedral angle becomes less than about 0.8 of the least one: 1 − cosine falls to this part of it at most.
constexpr double kAngleKept = 0.7;

[[nodiscard]] bool lowers_hot(const OptimizeOptions& o) { return o.energy == EnergyKind::F; }
[[nodiscard]] bool changes_connectivity(const OptimizeOptions& o) {
  return o.unknowns == temper::Unknowns::positions_and_weights && o.flips != Flips::none && o.tets.repair_trials > 0;
}

class Run : RunOf<OptimizeHooks, OptimizeReport> {
 public:
  Run(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks)
      : RunOf(options, hooks), result_(mesh), draft_(mesh, mobilities(mesh, options)) {
    best_.kept.emplace(std::move(mesh), draft_.mobility);
    begin_sweeps();
  }

  OptimizeReport run() {
    report.objective_before = objective_of(draft_.mesh);
    if (error_ != nullptr) unit_ = error_->errors(draft_.mesh);
    most_cosine_ = limit_of_angles(draft_.mesh);
    record();
    if ((error_ != nullptr || lowers_hot(options_)) && best_bad_ == 0) input_ = draft_;
    if (criterion_ == Criterion::well_centered || best_bad_ > 0) make_good();
    if (!stopped_early() && lowers_errors()) lower_errors();
    if (!stopped_early() && lowers_hot(options_)) lower_hot();
    return end();
  }

 private:
  /// Makes the mesh keep the criterion. Weights alone come first if the solver needs less than well-centered
  /// tetrahedra, then patches where weights do not suffice. For unknowns in cells sweeps go before: errors are less if
  /// most orthocenters are inside.
  void make_good() {
    if (criterion_ == Criterion::coefficients && made_good_by_weights()) return;
    const bool goes_on = anneal(best_bad_ == 0 ? kLastGamma : kFirstGamma);
    if (criterion_ == Criterion::distances && (best_bad_ == 0 || made_good_by_weights())) return;
    if (goes_on && changes_connectivity(options_)) repair();
    if (criterion_ != Criterion::well_centered && !stopped_early()) (void)takes_least_weights();
  }
  bool made_good_by_weights() {
    const Draft start = draft_;
    if (takes_least_weights()) return true;
    if (!changes_connectivity(options_)) return false;
    repair_in_patches();
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
    if (options_.unknowns == temper::Unknowns::positions || !hooks_.solvers.lp || !hooks_.solvers.convex) return false;
    draft_ = *best_.kept;
    WeightOptions wanted;
    wanted.goal = WeightGoal::least;
    wanted.constraints = criterion_ == Criterion::distances ? Constraints::distances : Constraints::coefficients;
    const auto found = find_weights(draft_.mesh, *hooks_.solvers.lp(), wanted, hooks_.solvers.convex().get());
    if (!found || found->weights.size() != draft_.mesh.n_vertices()) return false;
    for (const VertexId v : draft_.mesh.vertices()) draft_.mesh.set_weight(v, found->weights[v]);
    end_round(true);
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
    for (int i = 0; i < kLastSweeps; ++i) {
      if (!sweep(sweeper, kLastGamma)) return false;
      const auto last = report.history.end() - 1;
      if (i > 0 && (last - 1)->energy - last->energy <= kTolerance * last->energy) break;
    }
    return true;
  }
  /// Returns false if no further sweep may follow. A sweep that was stopped is kept if it makes the mesh no worse.
  bool sweep(Sweeper& sweeper, double gamma) {
    if (!may_sweep()) return false;
    gamma_ = gamma;
    if (sweeper.sweep({gamma, kRelaxation}, [this](double fraction) { return is_stopped(fraction); })) ++report.sweeps;
    record();
    return !stopped_early();
  }
  [[nodiscard]] bool may_sweep() {
    if (!stopped_early() && !sweeps_left()) report.stopped = Stopped::max_sweeps;
    return goes_on();
  }

  /// Changes the connectivity where sweeps alone are not enough: first at all bad tetrahedra at once, then, from the
  /// best mesh, in patches. Each round counts as one sweep.
  void repair() {
    const auto must_stop = [this](double) { return is_stopped(0); };
    for (int in_vain = 0; best_bad_ > 0 && in_vain < kRoundsInVain;) {
      const std::size_t before = best_bad_;
      if (!may_sweep() || !change_all(draft_, criterion_, must_stop, hooks_.executor)) break;
      end_round(false);
      in_vain = best_bad_ < before ? 0 : in_vain + 1;
    }
    repair_in_patches();
  }
  void repair_in_patches() {
    draft_ = *best_.kept;
    const int trials = options_.tets.repair_trials;
    const double small_margin = options_.tets.small_margin;
    const bool each = options_.tets.patches == Patches::each;
    for (const double most_cosine : {most_cosine_, 1.0}) {  // smaller angles only if the criterion asks for them
      if (best_bad_ > 0) repair_patches({criterion_, trials, 0, false, each, most_cosine});
      if (best_bad_ > 0 && options_.boundary == BoundaryVertices::split)
        repair_patches({criterion_, trials, 0, true, each, most_cosine});
    }
    if (best_bad_ == 0 && small_margin > 0) repair_patches({criterion_, trials, small_margin, false, each});
  }
  void repair_patches(const SearchOptions& options) {
    if (options.most_in_vain == 0) return;
    for (Places places(options, repair_work_); may_sweep();) {
      std::vector<Patch> patches = places.choose(draft_, hooks_.executor);
      if (patches.empty()) return;
      std::vector<std::uint8_t> is_better(patches.size(), 0);
      std::atomic<bool> stops = false, asks = false;
      const auto must_stop = [&](std::size_t i) {  // one thread asks at a time
        if (!stops && !asks.exchange(true)) {
          stops = is_stopped(double(i) / double(patches.size()));
          asks = false;
        }
        return stops.load();
      };
      or_serial(hooks_.executor).run(patches.size(), [&](std::size_t i) {
        is_better[i] = search(patches[i].draft, options, [&](double) { return must_stop(i); });
      });
      std::vector<Patch> chosen;
      for (std::size_t i = 0; i < patches.size(); ++i) {
        if (is_better[i] != 0) chosen.push_back(std::move(patches[i]));
      }
      if (!chosen.empty() && !put_back(chosen, draft_)) return;
      end_round(true);
      if (stopped_early()) return;
      if (report.history.back().bad > best_bad_) {  // patches together violate the criterion
        draft_ = *best_.kept;
        continue;
      }
      for (std::size_t i = 0; i < patches.size(); ++i) {
        if (is_better[i] != 0) places.succeeded(i);
      }
    }
  }
  void end_round(bool takes_equal) {
    gamma_ = kLastGamma;
    if (!stopped_early()) ++report.sweeps;
    record(takes_equal);
  }

  /// Goes on from the best mesh. An input without bad tetrahedra is the best one if `measure` of it is less.
  template <class Measure>
  void begin_phase(const Measure& measure) {
    draft_ = *best_.kept;
    best_.measure = measure(draft_.mesh);
    if (input_.mesh.n_vertices() == 0 || is_stopped(0)) return;
    const double of_input = measure(input_.mesh);
    if (best_.is_beaten_by(of_input)) best_ = {input_, of_input};
  }
  /// Lowers the errors of the scheme. The best mesh is the one with the least error.
  void lower_errors() {
    if (error_ != nullptr && unit_.empty()) unit_ = error_->errors(best_.kept->mesh);  // has no negative coefficient
    const auto error_of = [this](const TetMesh& mesh) {
      if (unit_.empty()) return 0.0;
      const std::vector<double> errors = error_->errors(mesh);
      return errors.empty() ? HUGE_VAL : mean_ratio(errors, unit_);
    };
    begin_phase(error_of);
    const bool has_gradient = !unit_.empty() && error_->has_gradient();
    const AccuracyErrors lowered = has_gradient ? AccuracyErrors{error_, unit_} : AccuracyErrors{};
    Accuracy accuracy(draft_.mesh, draft_.mobilities(), accuracy_model(options_.scheme), {criterion_, most_cosine_},
                      lowered, hooks_.executor);
    for (int i = 0; i < options_.tets.accuracy_steps && may_sweep(); ++i) {
      if (!accuracy.descend([this](double fraction) { return is_stopped(fraction); })) break;
      ++report.sweeps;
      record(lowered.model != nullptr ? Objective::solver_error : Objective::accuracy, accuracy.measure());
      if (lowered.model != nullptr) keep_if_best(accuracy.measure());
    }
    // A run that must stop does not measure any more: it keeps the mesh before these steps.
    if (lowered.model == nullptr && !(error_ && stopped_early())) keep_if_best(error_of(draft_.mesh));
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
  /// The HOT energy to lower, or the energy at the last γ.
  [[nodiscard]] double objective_of(const TetMesh& mesh) const {
    return lowers_hot(options_) ? hot_energy(mesh, hot_, hooks_.executor)
                                : state_of(mesh, kLastGamma, hooks_.executor).energy;
  }

  /// The largest cosine that dihedral angles may get.
  [[nodiscard]] double limit_of_angles(const TetMesh& mesh) const {
    return 1 - kAngleKept * (1 - largest_dihedral_cosine(mesh, hooks_.executor));
  }
  /// A run without a scheme lowers errors if there is a model of them: offsets alone cost as much as all sweeps.
  [[nodiscard]] bool lowers_errors() const {
    return criterion_ != Criterion::well_centered || (error_ != nullptr && !lowers_hot(options_));
  }
  bool is_stopped(double fraction) {
    ask(fraction, [](Progress&) {});
    return stopped_early();
  }

  /// Measures the mesh, and keeps it if it is the best so far: by the number of bad tetrahedra, and of equals the last
  /// one if `takes_equal`, else the first one.
  void record(bool takes_equal = true) {
    const auto [energy, bad] = state_of(draft_, criterion_, gamma_, hooks_.executor);
    keep_if_best(static_cast<double>(bad), takes_equal);
    best_bad_ = static_cast<std::size_t>(best_.measure);
    if (!stopped_early()) RunOf::record({.energy = energy, .bad = bad, .length_parameter = gamma_});
  }
  /// Of a mesh with the number of bad tetrahedra of the best one.
  void record(Objective objective, double energy) {
    RunOf::record({.energy = energy, .bad = best_bad_, .objective = objective});
  }
  void keep_if_best(double measure, bool takes_equal = true) {
    if (!best_.is_beaten_by(measure, takes_equal)) return;
    best_.kept = draft_;  // in its memory
    best_.measure = measure;
    if (!report.history.empty())
      offer([this](const std::function<void(const BestSoFar&)>& use) {
        use({best_.kept->mesh, origins_of(*best_.kept)});
      });
  }

  /// Says whether a good input has a smaller error of some kind than the best mesh.
  [[nodiscard]] bool is_input_better() const {
    if (input_.mesh.n_vertices() == 0 || unit_.empty() || stopped_early()) return false;
    const std::vector<double> errors = error_->errors(best_.kept->mesh);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (errors[i] > unit_[i]) return true;
    }
    return errors.empty();
  }
  OptimizeReport end() {
    if (is_input_better()) best_.kept = std::move(input_);
    Draft best = *std::move(best_.kept);
    report.flips = best.flips;
    report.origins = origins_of(best);
    report.count_vertices(n_before_, report.origins.vertices);
    report.objective_after = objective_of(best.mesh);
    result_ = std::move(best.mesh);
    report.seconds = seconds();
    return std::move(report);
  }
  [[nodiscard]] bool is_of_input(VertexId name) const { return name.index < n_before_; }
  [[nodiscard]] std::size_t count_kept(const Draft& draft) const {
    const auto& names = draft.names.vertices;
    return static_cast<std::size_t>(
        std::count_if(names.begin(), names.end(), [this](VertexId v) { return is_of_input(v); }));
  }
  [[nodiscard]] Origins origins_of(const Draft& draft) const {
    if (count_kept(draft) == n_before_ && draft.mesh.n_vertices() == n_before_) return {};
    Origins origins = {draft.names.vertices, draft.names.faces, draft.names.lines};
    for (VertexId& v : origins.vertices) {
      if (!is_of_input(v)) v = {};
    }
    return origins;
  }

  TetMesh& result_;  // empty until the end: best_ has the mesh
  std::size_t n_before_ = result_.n_vertices();
  const DiscretizationError* error_ =  // absent for large meshes
      n_before_ <= static_cast<std::size_t>(options_.tets.most_error_vertices) ? hooks_.solvers.error.get() : nullptr;
  Criterion criterion_ = lowers_hot(options_) ? Criterion::well_centered : criterion_of(options_.scheme);
  HotEnergy hot_ = kHotEnergies[static_cast<std::size_t>(options_.star)];
  std::vector<double> unit_;  // the errors of the input
  double most_cosine_ = 1;
  std::size_t repair_work_ = kRepairWork + kRepairWorkPerTet * result_.n_tetrahedra();
  Draft draft_;
  Best<Draft> best_;
  double gamma_ = kFirstGamma;
  std::size_t best_bad_ = 0;
  Draft input_;  // if it may be the best by its error or HOT energy
};

}  // namespace

Expected<OptimizeReport> optimize(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  if (auto right = check_together(options, CellKinds::tetrahedra); !right) return right.error();
  if (mesh.n_tetrahedra() == 0) return OptimizeReport{};
  return Run(mesh, options, hooks).run();
}

}  // namespace temper::tets
