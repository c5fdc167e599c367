// The driver: sweeps along the schedule of γ, the history, and the best mesh.
#include "temper/tets/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "tets/optimize/accuracy.hpp"
#include "tets/optimize/repair.hpp"
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
// Sweeps after changes of connectivity. Only vertices within some rings of tetrahedra move, and γ falls from the first
// to the last local one by kGammaFactor. The last one is smaller than in a whole mesh: some tetrahedra are good only by
// a margin of 0.001.
constexpr int kRings = 2, kRingsOfTrial = 3;
constexpr double kFirstLocalGamma = 0.3, kLastLocalGamma = 0.0005;
constexpr int kLocalSweeps = 2, kLastLocalSweeps = 10;
// Numbers of rounds and of trials without fewer bad tetrahedra, after which there are no more.
constexpr int kRoundsInVain = 4, kTrialsInVain = 40;
// Vertices between two looks at the clock, in the sweeps for accuracy.
constexpr std::size_t kVerticesBetweenLooks = 1024;
std::optional<InputError> wrong_option(const OptimizeOptions& options) {
  if (options.max_sweeps < 0)
    return InputError{
        ErrorCode::invalid_option, {}, "max_sweeps: expected at least 0, found " + std::to_string(options.max_sweeps)};
  if (options.keep_positions && options.keep_weights)
    return InputError{ErrorCode::invalid_option, {}, "positions and weights are both to be kept; expected one"};
  if (options.repair_trials < 0)
    return InputError{ErrorCode::invalid_option,
                      {},
                      "repair_trials: expected at least 0, found " + std::to_string(options.repair_trials)};
  if (!(options.time_limit >= 0))
    return InputError{
        ErrorCode::invalid_option, {}, "time_limit: expected at least 0, found " + to_text(options.time_limit)};
  return std::nullopt;
}

class Run {
 public:
  Run(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks)
      : mesh_(mesh), options_(options), hooks_(hooks), of_input_(mobilities(mesh, options)), mobility_(of_input_) {
    for (const VertexId v : mesh.vertices()) changes_.vertices.push_back(v);
  }

  OptimizeReport run() {
    report_.objective_before = state_of(mesh_, kLastGamma, hooks_.executor).energy;
    record();
    if (hooks_.error && best_bad_ == 0) input_ = mesh_;
    const bool repairs = !options_.keep_positions && !options_.keep_weights && !options_.keep_edges;
    if (anneal(best_bad_ == 0 ? kLastGamma : kFirstGamma, kLevelSweeps, kLastSweeps) && repairs) repair();
    if (!stopped_early(report_.stopped)) lower_errors();
    return end();
  }

 private:
  /// Changes of connectivity since the input.
  struct Changes {
    IdVector<VertexId, VertexId> vertices;  // the number of each vertex in the input
    std::size_t flips = 0;
  };

  /// Sweeps along the schedule of γ. False: the run must end.
  bool anneal(double first_gamma, int level_sweeps, int last_sweeps) {
    const auto all = mesh_.vertices();
    Sweeper sweeper(mesh_, mobility_, std::vector<VertexId>(all.begin(), all.end()), hooks_.executor);
    for (double gamma = first_gamma; gamma > kLastGamma; gamma *= kGammaFactor) {
      for (int i = 0; i < level_sweeps; ++i) {
        if (!sweep(sweeper, gamma)) return false;
      }
    }
    for (int i = 0; i < last_sweeps; ++i) {
      if (!sweep(sweeper, kLastGamma)) return false;
      const auto last = report_.history.end() - 1;
      if (i > 0 && (last - 1)->energy - last->energy <= kTolerance * last->energy) break;
    }
    return true;
  }

  /// Changes the connectivity at bad tetrahedra: first at all of them at once, then, from the best mesh, at one after
  /// the other.
  void repair() {
    for (int in_vain = 0; best_bad_ > 0 && in_vain < kRoundsInVain;) {
      const std::size_t before = best_bad_;
      if (!change(search_repairs(bad_tetrahedra(mesh_, hooks_.executor), kAllowance, 0), kRings)) break;
      in_vain = best_bad_ < before ? 0 : in_vain + 1;
    }
    int in_vain = 0;
    for (int trial = 0; trial < options_.repair_trials && in_vain < kTrialsInVain; ++trial) {
      if (best_bad_ == 0 || report_.stopped != Stopped::converged) break;
      const std::size_t before = best_bad_, k = static_cast<std::size_t>(in_vain);
      go_back_to_best();
      const std::vector<TetId> bad = bad_tetrahedra(mesh_, hooks_.executor);
      change(search_repairs({bad[k % bad.size()]}, kAllowanceOfTrial, k / bad.size()), kRingsOfTrial);
      in_vain = best_bad_ < before ? 0 : in_vain + 1;
    }
  }
  std::vector<Filling> search_repairs(const std::vector<TetId>& bad, double allowance, std::size_t rank) {
    return repairs(mesh_, bad, mobility_, {allowance, rank, [this] { return is_stopped(0); }});
  }
  void go_back_to_best() {
    mesh_ = best_;
    changes_ = best_changes_;
    number_mobility();
  }
  void number_mobility() {
    mobility_.clear();
    for (const VertexId v : changes_.vertices) mobility_.push_back(v.valid() ? of_input_[v] : Mobility::free);
  }

  /// Fills cavities and improves the vertices around them, which counts as one sweep. False: there was nothing to do,
  /// or the run must end.
  bool change(const std::vector<Filling>& fillings, int rings) {
    if (fillings.empty() || stopped_early(report_.stopped)) return false;
    if (report_.sweeps == options_.max_sweeps) {
      report_.stopped = Stopped::max_sweeps;
      return false;
    }
    const std::vector<VertexId> near = fill(fillings, rings);
    if (near.empty()) return false;
    Sweeper sweeper(mesh_, mobility_, near, hooks_.executor);
    for (double gamma = kFirstLocalGamma;; gamma = std::max(gamma * kGammaFactor, kLastLocalGamma)) {
      const bool last = gamma == kLastLocalGamma;
      for (int i = 0; i < (last ? kLastLocalSweeps : kLocalSweeps); ++i) {
        if (!sweeper.sweep({gamma, kRelaxation}, [this](double) { return is_stopped(0); })) return false;
      }
      if (last) break;
    }
    gamma_ = kLastGamma;
    ++report_.sweeps;
    record();
    return true;
  }
  /// Fills cavities. Returns the vertices within `rings` rings of tetrahedra around them.
  std::vector<VertexId> fill(const std::vector<Filling>& fillings, int rings) {
    IdVector<VertexId, std::uint8_t> near(mesh_.n_vertices()), removed(mesh_.n_vertices());
    for (const Filling& f : fillings) {
      for (const TetId t : f.cavity.tetrahedra) {
        for (const VertexId v : mesh_.corners(t)) near[v] = 1;
      }
      if (f.removed.valid()) removed[f.removed] = 1;
      changes_.flips += f.apex.valid() && !f.removed.valid() ? 1 : 0;
    }
    for (int ring = 0; ring < rings; ++ring) {
      const auto inner = near;
      for (const TetId t : mesh_.tetrahedra()) {
        const auto& corners = mesh_.corners(t);
        if (std::none_of(corners.begin(), corners.end(), [&](VertexId v) { return inner[v] != 0; })) continue;
        for (const VertexId v : corners) near[v] = 1;
      }
    }
    std::vector<VertexId> result;
    std::size_t next = 0;  // the number of a vertex in the next mesh
    for (const VertexId v : mesh_.vertices()) {
      if (removed[v] != 0) continue;
      if (near[v] != 0) result.emplace_back(next);
      ++next;
    }
    std::optional<TetMesh> changed = filled(mesh_, fillings, changes_.vertices);
    if (!changed) return {};
    mesh_ = *std::move(changed);
    number_mobility();
    for (; next < mesh_.n_vertices(); ++next) result.emplace_back(next);
    return result;
  }

  /// Lowers the errors of the scheme from the best mesh. Of this mesh, of the stages after it, and of an input without
  /// bad tetrahedra, the one with the least error is kept.
  void lower_errors() {
    if (options_.scheme != Scheme::vertex && options_.scheme != Scheme::cell) return;
    go_back_to_best();
    double least = HUGE_VAL;
    const auto keep_if_best = [&] {
      const double error = hooks_.error ? hooks_.error->squared_error(mesh_, nullptr) : 0;
      if (error > least) return;
      least = error;
      best_ = mesh_;
    };
    keep_if_best();
    Accuracy accuracy(mesh_, mobility_, accuracy_model(options_.scheme));
    for (int i = 0; i < options_.accuracy_sweeps && begin_sweep(); ++i) {
      for (const VertexId v : mesh_.vertices()) {
        if (v.index % kVerticesBetweenLooks == 0 && is_stopped(double(v.index) / double(mesh_.n_vertices()))) break;
        accuracy.improve(v, kRelaxation);
      }
      record(Objective::accuracy, accuracy.energy().energy);
    }
    keep_if_best();
    if (!hooks_.error) return;
    for (int i = 0; i < options_.error_steps && begin_sweep() && !is_stopped(0); ++i) {
      if (!accuracy.descend(*hooks_.error)) break;
      record(Objective::solver_error, std::sqrt(accuracy.error()));
    }
    keep_if_best();
    if (input_.n_vertices() == 0) return;
    mesh_ = std::move(input_);
    keep_if_best();
  }
  bool begin_sweep() {
    if (stopped_early(report_.stopped)) return false;
    const bool left = report_.sweeps < options_.max_sweeps;
    report_.sweeps += left ? 1 : 0;
    if (!left) report_.stopped = Stopped::max_sweeps;
    return left;
  }

  using Clock = std::chrono::steady_clock;
  [[nodiscard]] static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  /// Returns false if no further sweep may follow. A sweep that was stopped is kept if it makes the mesh no worse.
  bool sweep(Sweeper& sweeper, double gamma) {
    if (report_.sweeps == options_.max_sweeps) {
      report_.stopped = Stopped::max_sweeps;
      return false;
    }
    gamma_ = gamma;
    if (sweeper.sweep({gamma, kRelaxation}, [this](double fraction) { return is_stopped(fraction); })) ++report_.sweeps;
    record();
    return !stopped_early(report_.stopped);
  }

  bool is_stopped(double fraction) {
    if (options_.time_limit > 0 && seconds_since(start_) > options_.time_limit - 2 * seconds_before_) {
      report_.stopped = Stopped::time_limit;
    } else if (hooks_.observer &&
               hooks_.observer({report_.history.back(), fraction, options_.max_sweeps}) == Continue::no) {
      report_.stopped = Stopped::canceled;
    }
    return stopped_early(report_.stopped);
  }

  /// Measures the mesh, and keeps its points if it is the best so far. Of equals the last is the best.
  void record() {
    const auto [energy, bad] = state_of(mesh_, gamma_, hooks_.executor);
    if (report_.history.empty() || bad <= best_bad_) {
      best_bad_ = bad;
      best_ = mesh_;
      best_changes_ = changes_;
    }
    if (stopped_early(report_.stopped)) return;
    record(Objective::energy, energy);
    report_.history.back().bad = bad;
    report_.history.back().length_parameter = gamma_;
  }
  /// Of a mesh with the number of bad tetrahedra of the best one.
  void record(Objective objective, double energy) {
    SweepRecord now;
    now.sweep = report_.sweeps;
    now.objective = objective;
    now.energy = energy;
    now.bad = best_bad_;
    now.seconds = seconds_since(start_);
    report_.history.push_back(now);
  }

  OptimizeReport end() {
    mesh_ = std::move(best_);
    report_changes();
    report_.objective_after = state_of(mesh_, kLastGamma, hooks_.executor).energy;
    report_.seconds = seconds_since(start_);
    return std::move(report_);
  }

  void report_changes() {
    IdVector<VertexId, VertexId>& vertices = best_changes_.vertices;
    const auto kept =
        static_cast<std::size_t>(std::count_if(vertices.begin(), vertices.end(), [](VertexId v) { return v.valid(); }));
    report_.vertices_inserted = vertices.size() - kept;
    report_.vertices_removed = of_input_.size() - kept;
    report_.flips = best_changes_.flips;
    if (report_.vertices_inserted + report_.vertices_removed > 0) report_.vertices = std::move(vertices);
  }

  TetMesh& mesh_;
  const OptimizeOptions& options_;
  const OptimizeHooks& hooks_;
  IdVector<VertexId, Mobility> of_input_, mobility_;
  Changes changes_, best_changes_;
  Clock::time_point start_ = Clock::now();
  // The time limit includes reading and writing. Writing takes about as long as reading took.
  double seconds_before_ = std::chrono::duration<double>(start_ - hooks_.started.value_or(start_)).count();
  OptimizeReport report_;
  double gamma_ = kFirstGamma;
  std::size_t best_bad_ = 0;
  TetMesh best_;
  TetMesh input_;  // if it may be the best by its error
};

}  // namespace

Expected<OptimizeReport> optimize(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  if (auto wrong = wrong_option(options)) return *std::move(wrong);
  if (mesh.n_tetrahedra() == 0) return OptimizeReport{};
  return Run(mesh, options, hooks).run();
}

}  // namespace temper::tets
