#include "optimize/run/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "base/rng.hpp"
#include "geometry/predicates_inline.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/detail/version.hpp"

namespace temper {
namespace {

/// A hash that any changed byte changes.
struct Fingerprint {
  std::uint64_t hash = 0;

  void add(std::uint64_t word) { hash = mix64(hash ^ word); }
  template <class T>
  void add(const T* values, std::size_t n) {
    const auto* bytes = reinterpret_cast<const char*>(values);
    const std::size_t size = n * sizeof(T);
    add(size);
    for (std::size_t begin = 0; begin < size; begin += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + begin, std::min(sizeof word, size - begin));
      add(word);
    }
  }
};

void add_mesh(Fingerprint& all, const Mesh& mesh) {
  const Vec2 period = mesh.space().period();
  const double space[] = {mesh.space().radius(), period.x, period.y};
  all.add(space, std::size(space));
  all.add(mesh.vertex_data(), mesh.n_vertices() * Mesh::kVertexStride / sizeof(double));
  all.add(mesh.corner_data().data(), mesh.n_halfedges());
  all.add(mesh.twin_data().data(), mesh.n_halfedges());
  for (const TriangleId t : mesh.triangles()) all.add(static_cast<std::uint64_t>(mesh.region(t)));
  for (const HalfedgeId h : mesh.halfedges()) all.add(mesh.is_constrained(h) ? 1 : 0);
}

void add_options(Fingerprint& all, const OptimizeOptions& options) {
  std::string text;
  for (const OptionRow& row : option_rows()) {
    if (row.name != "time_limit") text.append(row.name).append(option_text(row, row.get(options))).append("\n");
  }
  all.add(text.data(), text.size());
  if (options.problem) {
    all.add(options.problem->coefficient.data(), options.problem->coefficient.size());
    all.add(options.problem->source.data(), options.problem->source.size());
    for (const BoundaryValue& part : options.problem->boundary) {
      all.add(&part.value, 1);
      all.add(part.is_flux ? 1 : 0);
      for (const auto& [a, b] : part.edges) all.add(a.index), all.add(b.index);
    }
  }
  if (!options.size_field) return;
  add_mesh(all, options.size_field->mesh());
  for (const VertexId v : options.size_field->mesh().vertices()) {
    const double size = options.size_field->at(v);
    all.add(&size, 1);
  }
}

constexpr std::size_t kGains = 4;  // gains for one factor, from first to last: two alone are noisy

/// The limits of a sweep's stage.
struct Limits {
  double tolerance = 0;  ///< relative
  int sweeps = 0;        ///< of the run, at most
  int after = 0;         ///< sweeps of the stage that follows
};

Limits limits_of(std::span<const SweepRecord> history, const OptimizeOptions& o) {
  if (history.back().objective == Objective::energy) {
    if (objective_of(o) == Objective::energy) return {o.paper.tolerance, o.max_sweeps};
    return {std::max(o.paper.tolerance, kGainOfLastSweep), o.max_sweeps, o.accuracy.sweeps};
  }
  if (history.back().objective == Objective::solver_error) {
    const auto first = std::ranges::find(history, Objective::solver_error, &SweepRecord::objective);
    return {o.solver_error.tolerance, std::min(o.max_sweeps, first->sweep + most_solver_error_steps(o))};
  }
  const auto first = std::ranges::find(history, Objective::accuracy, &SweepRecord::objective);
  return {o.accuracy.tolerance, std::min(o.max_sweeps, first->sweep + o.accuracy.sweeps)};
}

bool one_stage(const SweepRecord& a, const SweepRecord& b) {
  return a.length_parameter == b.length_parameter && a.objective == b.objective;
}

}  // namespace

void Run::offer(const WorkingCopy& now, const Settings& settings, const SweepState& state) const {
  RunOf::offer([&](const std::function<void(const BestSoFar&)>& use) {
    const WorkingCopy* best = &now;
    if (best_before != nullptr && !replaces(now, *best_before, Requirement::not_worse, settings, state.model)) {
      best = best_before;
    }
    const MeshScore found = score(best->mesh, settings, state.model, nullptr, best->units);
    if (found.inverted > 0 || (found.non_regular > 0 && !settings.policy.keeps_connectivity())) return;
    Mesh mesh = best->in_user_terms(settings.executor());
    IdVector<VertexId, VertexId> vertices;
    if (best->has_gaps || best->has_inserted()) vertices = best->user_vertices();
    take_back_rounding(input_, vertices, mesh);
    use({mesh, vertices});
  });
}

bool Run::asked_to_stop(double fraction_of_sweep, bool alone) {
  if (hooks_.communicator == nullptr || hooks_.communicator->rank() == 0) {
    ask(fraction_of_sweep, [&](Progress& progress) {
      progress.sweeps_left = estimate_sweeps_left(report.history, options_);
      progress.n_vertices = n_vertices;
      progress.share_of_phase = share_of_phase(report.history, options_, fraction_of_sweep);
    });
  }
  if (hooks_.communicator != nullptr && !alone) sync_stop();
  return stopped_early();
}

void Run::sync_stop() {
  std::string message;
  ByteWriter(message).write(report.stopped);
  hooks_.communicator->broadcast(message, 0);
  Stopped stopped = report.stopped;
  ByteReader(message).read(stopped);
  if (temper::stopped_early(stopped)) report.stopped = stopped;
}

std::size_t count_inverted(const Mesh& mesh) {
  std::size_t count = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (inlined::orientation(mesh, a, b, c) != Sign::positive) ++count;
  }
  return count;
}

/// Public meshes need at most 500 triangles of trials per triangle of the mesh, or 130,000 if it is small. In thin
/// triangles a neighborhood reaches across the mesh: without this limit, a mesh of 483 triangles took 50 s.
double Run::most_trial_triangles(const OptimizeOptions& options, const Mesh& input) {
  // If lines may be split, hardly a place is beyond cure, so in small meshes the search may take longer.
  constexpr double kLeast = 150'000, kLeastWithSplits = 600'000, kPerTriangle = 750;
  const bool splits = options.boundary == BoundaryVertices::split && options.repair == Repair::vertices;
  const double more = static_cast<double>(options.repair_trials) / OptimizeOptions().repair_trials;
  return std::max(1.0, more) *
         ((splits ? kLeastWithSplits : kLeast) + kPerTriangle * static_cast<double>(input.n_triangles()));
}

std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                           const Mesh& mesh) {
  if (hooks.communicator == nullptr) return std::nullopt;
  Fingerprint mine;
  add_mesh(mine, mesh);
  add_options(mine, options);
  mine.add(hooks.tracer ? 1 : 0);
  const std::string given = std::string(version()) + ' ' + std::to_string(mine.hash);
  const std::vector<std::string> all = hooks.communicator->all_gather(given);
  const auto other = std::find_if(all.begin(), all.end(), [&](const std::string& each) { return each != all[0]; });
  if (other == all.end()) return std::nullopt;
  return InputError{ErrorCode::rank_mismatch,
                    {},
                    "rank " + std::to_string(other - all.begin()) +
                        " has another mesh, other options or another version of temper than rank 0: all ranks of a run "
                        "must be given the same, and files may not change while they read them"};
}

std::optional<double> share_of_phase(std::span<const SweepRecord> history, const OptimizeOptions& options,
                                     double fraction_of_sweep) {
  const SweepRecord& last = history.back();
  const Limits limits = limits_of(history, options);
  const auto first = std::ranges::find(history, last.objective, &SweepRecord::objective);
  const double done = last.sweep - first->sweep + fraction_of_sweep;
  double all = limits.sweeps - first->sweep;
  if (last.objective == Objective::energy) {  // its limit is far away
    const std::optional<double> left = estimate_sweeps_left(history, options);
    if (!left) return std::nullopt;
    all = last.sweep - first->sweep + std::max(1.0, *left - limits.after);
  }
  return all > 0 ? std::optional(std::min(1.0, done / all)) : std::nullopt;
}

std::optional<double> estimate_sweeps_left(std::span<const SweepRecord> history, const OptimizeOptions& options) {
  if (history.size() <= kGains || options.paper.stopping == StoppingRule::paper) return std::nullopt;
  const std::span<const SweepRecord> last = history.last(kGains + 1);
  double gains[kGains];
  for (std::size_t i = 0; i < kGains; ++i) {
    gains[i] = last[i].energy - last[i + 1].energy;
    if (!one_stage(last[i], last[i + 1]) || !(gains[i] > 0)) return std::nullopt;
  }
  const double shrinking = std::log(gains[0] / gains[kGains - 1]) / (kGains - 1);  // of the gain's logarithm per sweep
  if (!(shrinking > 0)) return std::nullopt;
  const Limits limits = limits_of(history, options);
  const double target = limits.tolerance * std::abs(last.back().energy);
  const double sweeps = target > 0 ? std::log(gains[kGains - 1] / target) / shrinking : limits.sweeps;
  return std::clamp(std::max(0.0, sweeps) + limits.after, 0.0,
                    static_cast<double>(std::max(0, limits.sweeps - last.back().sweep)));
}

}  // namespace temper
