// optimize(): attempts, repairs, and the phase of the accuracy objective, all on copies; the best mesh is given back.
#include "temper/optimize.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "energy/whole_mesh.hpp"
#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/driver.hpp"
#include "optimize/rank.hpp"
#include "optimize/refusal.hpp"
#include "optimize/repair/repair_search.hpp"
#include "optimize/report.hpp"

namespace temper {
namespace {

// A search that ends with triangles bad may have gone astray early on.
constexpr std::uint64_t kSearches = 4;

bool is_worse(const Candidate& a, const Candidate& b, const Settings& settings) {
  return rank(b.work.mesh, settings) < rank(a.work.mesh, settings);
}

bool has_bad(const Candidate& c, const Settings& s) { return count_bad(c.work.mesh, s.hooks.executor) > 0; }

/// Attempts from the input until one leaves nothing bad; the best of them.
Expected<Candidate> best_attempt(const Mesh& mesh, Settings& settings, Run& run) {
  const OptimizeOptions& o = settings.options;
  std::optional<Candidate> best;
  std::span<const Attempt> tries;
  for (std::size_t i = 0; i == 0 || i < tries.size(); ++i) {
    Candidate now{WorkingCopy(mesh, o.paper.order, settings.hooks.executor)};
    Driver driver(now.work, settings, run);
    if (i > 0) driver.recorder().returned_to(-1);
    if (o.flips != Flips::none && !driver.make_regular()) return hidden_vertices_error(mesh, settings.hooks.names);
    driver.grade_boundary();
    if (i == 0) {
      if (auto error = outside_domain_error(now.work.mesh, settings)) return *std::move(error);
      tries = attempts(settings.energy, o, now.work.mesh, settings.hooks.executor);
      run.facts.input_flips = run.report.flips;
    }
    now.sweep = driver.attempt(tries[i], i + 1 < tries.size() || repairs(settings));
    if (!best || !is_worse(now, *best, settings)) {
      best = std::move(now);
    } else {
      driver.recorder().returned_to(best->sweep);
    }
    if (!has_bad(*best, settings) || !run.goes_on()) break;
  }
  return *std::move(best);
}

/// Repairs, from the same beginning until a search leaves nothing bad; the best result is kept, and swept once more.
Candidate repaired(Candidate start, Settings& settings, Run& run) {
  const auto is_done = [&](const Candidate& c) {
    return !run.goes_on() || run.repair_trials_left <= 0 || !has_bad(c, settings);
  };
  if (!repairs(settings) || is_done(start) || !std::isfinite(total_energy(start.work.mesh, settings.model))) {
    return start;
  }
  Candidate best = start;
  for (std::uint64_t i = 0; i < kSearches && !is_done(best); ++i) {
    Candidate now = start;
    Driver driver(now.work, settings, run);
    if (best.sweep != start.sweep) driver.recorder().returned_to(start.sweep);
    const bool changed = driver.repair(settings.options.paper.seed + i);
    now.sweep = run.report.sweeps;
    if (changed && !is_worse(now, best, settings)) {
      best = std::move(now);
    } else {
      driver.recorder().returned_to(best.sweep);
    }
  }
  if (run.goes_on()) best.sweep = Driver(best.work, settings, run).polish(best.sweep);
  return best;
}

/// Says whether the second phase may begin at once with the input.
bool is_ready_for_accuracy(const Mesh& mesh, const OptimizeOptions& o, Executor* executor) {
  return o.objective == Objective::accuracy && o.boundary != BoundaryVertices::split &&
         has_margins(mesh, o.accuracy.margin, executor);
}

/// The size field of a run with a band; the input's own is seen where it is, since the run works on copies.
std::optional<SizeField> field_of_band(const Mesh& mesh, const OptimizeOptions& options, Executor* executor) {
  if (!options.size_band) return std::nullopt;
  return options.size_field ? options.size_field : input_size_field_of(mesh, executor);
}

}  // namespace

Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  Run run(options, hooks.observer);
  auto settings = make_settings(options, mesh, Frame::of(mesh), hooks);
  if (!settings) return settings.error();
  settings->size_field = field_of_band(mesh, options, hooks.executor);

  auto best = is_ready_for_accuracy(mesh, options, hooks.executor)
                  ? Candidate{WorkingCopy(mesh, options.paper.order, hooks.executor)}
                  : best_attempt(mesh, *settings, run);
  if (!best) return best.error();
  best = repaired(*std::move(best), *settings, run);
  std::optional<AccuracySizes> sizes;
  if (options.objective == Objective::accuracy) {
    sizes.emplace(mesh, options.size_field, hooks.executor);
    AccuracyPhase phase(best->work, *settings, run, *sizes);
    const bool goes_on = !run.stopped_by_caller() && run.report.stopped != Stopped::hidden;
    if (goes_on) best->sweep = Driver(best->work, phase.settings(), run).run(phase, best->sweep);
  }
  give_back(mesh, *std::move(best), *std::move(settings), sizes ? &*sizes : nullptr, run);
  return std::move(run.report);
}

}  // namespace temper
