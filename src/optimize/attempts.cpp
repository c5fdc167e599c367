// See attempts.hpp.
#include "optimize/attempts.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "energy/whole_mesh.hpp"
#include "optimize/driver.hpp"
#include "optimize/lengths.hpp"
#include "optimize/rank.hpp"
#include "optimize/refusal.hpp"
#include "optimize/repair/repair_search.hpp"

namespace temper {
namespace {

// A search that ends with triangles bad may have gone astray early on.
constexpr std::uint64_t kSearches = 4;

bool is_worse(const Candidate& a, const Candidate& b, const Settings& settings) {
  return rank(b.work.mesh, settings) < rank(a.work.mesh, settings);
}

bool has_bad(const Candidate& c, const Settings& s) { return count_bad(c.work.mesh, s.hooks.executor) > 0; }

/// Says whether so few triangles of c are bad that each is a place of its own, far from all others. Another attempt
/// would leave as many elsewhere, where a repair of each is a matter of moments; and a search need not give up what it
/// has cured to begin again with the others.
bool are_apart(const Candidate& c, const Settings& s) {
  constexpr double kMost = 1e-5;
  const auto bad = static_cast<double>(count_bad(c.work.mesh, s.hooks.executor));
  return bad > 0 && bad < kMost * static_cast<double>(c.work.mesh.n_triangles());
}

/// Says whether c has what a repair could cure: bad triangles, or edges that vertices make too short.
bool needs_repair(const Candidate& c, const Settings& s) {
  return has_bad(c, s) ||
         (s.options.repair == Repair::vertices && missing_lengths(c.work.mesh, s.accuracy, s.hooks.executor) > 0);
}

/// The input made regular, and its boundary cut, as every attempt begins.
std::optional<InputError> prepare(Driver& driver, const Mesh& input, const Settings& settings) {
  if (settings.options.flips != Flips::none && !driver.make_regular()) {
    return hidden_vertices_error(input, settings.hooks.names);
  }
  driver.grade_boundary();
  return std::nullopt;
}

}  // namespace

Expected<Candidate> best_attempt(InputMesh& input, Settings& settings, Run& run) {
  const OptimizeOptions& o = settings.options;
  std::optional<Candidate> best;
  Candidate now;
  std::vector<Attempt> tries(1);
  std::size_t i = 0;
  const Resumable here(run.checkpoints, best, now, tries, i);
  if (run.checkpoints.failed() || i >= tries.size()) return *run.checkpoints.error();
  for (; i < tries.size(); ++i) {
    const bool begins = !run.checkpoints.resumes();
    if (begins) now = {WorkingCopy(input.whole(), o.paper.order, settings.hooks.executor)};
    Driver driver(now.work, settings, run);  // NOLINT(bugprone-use-after-move): what begins has been made anew
    if (begins && i > 0) driver.recorder().returned_to(-1);
    if (begins) {
      if (auto error = prepare(driver, input.whole(), settings)) return *std::move(error);
    }
    if (begins && i == 0) {
      if (auto error = outside_domain_error(now.work.mesh, settings)) return *std::move(error);
      const auto all = attempts(settings.energy, o, now.work.mesh, settings.hooks.executor);
      tries.assign(all.begin(), all.end());
      for (Attempt& attempt : tries) attempt.first_energy = first_energy_of(o);
      run.facts.input_flips = run.report.flips;
    }
    input.fold();
    now.sweep = driver.attempt(tries[i], i + 1 < tries.size() || repairs(settings));
    if (auto error = run.checkpoints.error()) return *std::move(error);
    if (!best || !is_worse(now, *best, settings)) {
      best = std::move(now);
    } else {
      driver.recorder().returned_to(best->sweep);
    }
    if (!has_bad(*best, settings) || !run.goes_on() || (repairs(settings) && are_apart(*best, settings))) break;
  }
  return *std::move(best);
}

Candidate repaired(Candidate best, Settings& settings, Run& run) {
  const auto is_done = [&](const Candidate& c) {
    return !run.goes_on() || run.repair_trials_left <= 0 || !needs_repair(c, settings);
  };
  std::optional<Candidate> start;  // of all searches, once it is not the best one
  Candidate now;
  std::uint64_t i = 0;
  bool polishes = false;
  const Resumable here(run.checkpoints, best, start, now, i, polishes);
  if (!here.resumed() &&
      (!repairs(settings) || is_done(best) || !std::isfinite(total_energy(best.work.mesh, settings.model)))) {
    return best;
  }
  for (; !polishes && i < kSearches; ++i) {
    const bool begins = !run.checkpoints.resumes();
    if (begins && is_done(best)) break;
    if (begins) now = start ? *start : best;
    Driver driver(now.work, settings, run);  // NOLINT(bugprone-use-after-move): what begins has been made anew
    if (begins && start) driver.recorder().returned_to(start->sweep);
    const bool changed = driver.repair(settings.options.paper.seed + i);
    now.sweep = run.report.sweeps;
    if (changed && !is_worse(now, best, settings)) {
      if (!start) start = std::move(best);
      best = std::move(now);
      if (are_apart(best, settings)) start.reset();
    } else {
      driver.recorder().returned_to(best.sweep);
    }
  }
  start.reset();
  now = {};
  polishes = true;
  if (run.checkpoints.resumes() || run.goes_on()) best.sweep = Driver(best.work, settings, run).polish(best.sweep);
  return best;
}

}  // namespace temper
