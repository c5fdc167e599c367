#include "optimize/stages/restarts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "energy/whole_mesh.hpp"
#include "optimize/repair/repair_search.hpp"
#include "optimize/repair/trial_memo.hpp"
#include "optimize/run/changes.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/stages/driver.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

// Largest number of rounds of cuts at bad triangles, each after a successful one. More rounds find little.
constexpr std::size_t kRoundsWhereBad = 4;
// With this factor more bad triangles, a more thorough restart does not help.
constexpr std::size_t kFarMore = 2;
// Weights alone are seldom enough, so they must make fast progress.
constexpr double kFewerByWeights = 0.75;
// A search that ends with bad triangles may have made a wrong choice early, so more searches follow.
constexpr std::uint64_t kSearches = 4;
// With a guard trials are slow, so quick ones come first. If 1 to this number of triangles stay bad, a thorough search
// follows from the mesh before. The run keeps the better result.
constexpr std::size_t kFew = 6;
// This search, if there is an LP solver, uses linear programs, and goes on from the result of the first.
constexpr std::uint64_t kPrograms = 1;

/// Hidden vertices have no power cell, so no regular triangulation has them. The error names them.
InputError hidden_vertices_error(const Mesh& input, const InputNames* names) {
  constexpr std::size_t kNamed = 5;
  Mesh copy = input;
  const std::vector<VertexId> hidden = restore_regularity(copy).hidden;
  const InputNames numbers_from_0;
  const InputNames& named = names != nullptr ? *names : numbers_from_0;
  std::string list;
  for (std::size_t i = 0; i < std::min(hidden.size(), kNamed); ++i) {
    if (i > 0) list += ", ";
    list += named.point(hidden[i].index) + " (weight " + to_text(input.weight(hidden[i])) + ")";
  }
  if (hidden.size() > kNamed) list += " and " + std::to_string(hidden.size() - kNamed) + " more";
  // A flip that would make an edge of half a period fails as a flip at a hidden vertex does.
  const char* const or_too_few = input.space().is_periodic() ? ", and edges shorter than half a period" : "";
  return {ErrorCode::hidden_vertex, hidden.empty() ? std::string() : named.point_where(hidden[0].index),
          "weights hide " + list + "; expected weights that leave every vertex a power cell" + or_too_few};
}

/// E_BH, and E_BHs with the user's h°, can only stay inside their barrier. Other energies can enter it from anywhere.
std::optional<InputError> outside_domain_error(const Mesh& mesh, const Settings& settings) {
  const EnergyInfo& energy = energy_info(settings.policy.first_energy.value_or(settings.model.kind));
  EnergyModel model = settings.model;
  model.kind = energy.kind;
  const bool gets_in = energy.softened_by_gamma || (energy.softened_by_h0 && !settings.policy.h0);
  if (!energy.barrier || gets_in || std::isfinite(total_energy(mesh, model))) return std::nullopt;
  return InputError{
      ErrorCode::invalid_option,
      {},
      "energy " + std::string(energy.name) + " is infinite on this mesh, where " +
          std::to_string(count_bad(mesh, settings.executor())) + " of " + std::to_string(mesh.n_triangles()) +
          " triangles are not well-centered; expected a mesh inside its barrier, or energy BP, which needs none"};
}

bool has_bad(const Candidate& c, const Settings& s) { return is_unfinished(c.work.mesh, s); }

/// Says whether so few triangles of c are bad that each is far from all others. Another restart would leave as many bad
/// triangles elsewhere, while a repair of each is quick. A search can keep each place that it has cured. It needs no
/// copy to return to, for which large meshes leave no memory: it never makes more triangles bad, and trials sweep each
/// place.
/// Next to faces that stay, another restart finds the same sites in its way.
bool are_apart(const Candidate& c, const Settings& s) {
  constexpr double kMost = 1e-5, kMostAtFaces = 1e-2;
  const bool at_faces = s.criterion != Criterion::well_centered;
  const std::size_t bad = at_faces ? count_violations(c.work.mesh, s) : count_bad(c.work.mesh, s.executor());
  const auto n = static_cast<double>(c.work.mesh.n_triangles());
  return bad > 0 && static_cast<double>(bad) < (at_faces ? kMostAtFaces : kMost) * n;
}

/// Says whether a repair could improve c: it has bad triangles, or edges that are too short.
bool needs_repair(const Candidate& c, const Settings& s) {
  return has_bad(c, s) ||
         (s.options.repair == Repair::vertices && missing_lengths(c.work.mesh, s.accuracy, s.executor()) > 0);
}

bool may_repair(const Candidate& c, const Settings& settings, const Run& run) {
  return run.goes_on() && run.repair_trials_left() > 0 && needs_repair(c, settings);
}

/// If new or removed vertices cured nothing, they are undone, which takes a copy.
bool repairs_in_place(const Candidate& c, const Settings& settings) {
  return settings.options.repair != Repair::vertices && are_apart(c, settings);
}

/// Searches for repairs several times, each with other random choices, and returns the best mesh.
Candidate searched(Candidate best, Pace pace, const Settings& settings, SweepState& state, Run& run) {
  TrialMemo memo;
  const std::uint64_t searches = settings.lp != nullptr ? kSearches + 1 : kSearches;
  std::optional<Candidate> start;  // beginning of all searches on copies, if it is no longer the best mesh
  const bool in_place = repairs_in_place(best, settings);
  for (std::uint64_t i = 0; i < searches && may_repair(best, settings, run); ++i) {
    const BestBefore kept(run.best_before, in_place ? nullptr : &best.work);
    const bool asks_programs = i == kPrograms && settings.lp != nullptr;
    if (i == kPrograms && settings.lp == nullptr) run.facts.lacks_programs = true;
    if (asks_programs) start.reset();  // programs for cured places would cost too much
    Candidate copy;
    if (!in_place) copy = start ? *start : best;
    Candidate& now = in_place ? best : copy;
    Driver driver(now.work, settings, state, run);
    if (start) driver.recorder().returned_to(start->sweep);
    const bool changed = driver.repair(memo, settings.policy.seed + i, pace, asks_programs);
    now.sweep = run.report.sweeps;
    if (in_place) continue;
    if (changed && has_gained(now, best, settings, state.model)) {
      if (!start) start = std::move(best);
      best = std::move(now);
      if (are_apart(best, settings)) start.reset();
    } else {
      driver.recorder().returned_to(best.sweep);
    }
  }
  return best;
}

Candidate polished(Candidate best, const Settings& settings, SweepState& state, Run& run) {
  if (run.goes_on()) best.sweep = Driver(best.work, settings, state, run).polish(best.sweep);
  return best;
}

/// Returns the restarts to try from the present working copy. If all restarts with a cut boundary leave triangles bad,
/// they are repeated without cuts: near lines that leave no room, cuts may do harm. Afterwards come cuts at triangles
/// that are still bad, and sweeps from there.
std::vector<Restart> restarts_for(const Mesh& mesh, const Settings& settings) {
  const auto all = restarts(settings, mesh);
  std::vector<Restart> planned(all.begin(), all.end());
  const bool splits = settings.options.boundary == BoundaryVertices::split;
  Restart where_bad = kNearlyGood;
  where_bad.splitting = BoundarySplitting::where_bad;
  if (splits) {
    planned.insert(planned.end(), kRoundsWhereBad, where_bad);
    for (Restart unsplit : all) {
      unsplit.splitting = BoundarySplitting::none;
      planned.push_back(unsplit);
    }
    planned.insert(planned.end(), kRoundsWhereBad, where_bad);
  }
  for (Restart& restart : planned) restart.first_energy = settings.policy.first_energy;
  return planned;
}

/// Returns the quick restarts for weights alone; none if the energy is not softened.
std::vector<Restart> restarts_by_weights(const Mesh& mesh, const Settings& settings) {
  std::vector<Restart> planned;
  for (Restart restart : restarts(settings, mesh)) {
    if (!restart.until_good) continue;
    restart.fewer = std::min(restart.fewer, kFewerByWeights);
    planned.push_back(restart);
  }
  return planned;
}

/// Makes the input regular and cuts its boundary for a restart; or cuts the best mesh at its bad triangles.
std::optional<InputError> prepare(Driver& driver, InputMesh& input, const Settings& settings, const Restart& restart) {
  if (restart.splitting == BoundarySplitting::where_bad) {
    driver.split_where_bad();
    return std::nullopt;
  }
  if (!settings.policy.keeps_connectivity() && !driver.make_regular()) {
    return hidden_vertices_error(input.whole(), settings.hooks.names);
  }
  if (restart.splitting == BoundarySplitting::graded) driver.grade_boundary();
  return std::nullopt;
}

/// Notes the cuts of the best mesh that this restart made.
void note_splits(const Restart& restart, RunFacts& facts) {
  if (restart.splitting == BoundarySplitting::where_bad) {
    const bool on_unsplit = facts.stays_unsplit || !facts.boundary_splits;
    facts.boundary_splits = on_unsplit ? facts.splits_where_bad : *facts.boundary_splits + facts.splits_where_bad;
  }
  facts.stays_unsplit = restart.splitting == BoundarySplitting::none;
}

/// Says whether a restart from the same beginning as the one before may help. It is more thorough and takes many
/// sweeps. It does not help if the one before left far more triangles bad, `left`, than the best mesh has.
bool may_gain(const Restart& restart, const Restart& before, std::size_t left, const Candidate& best,
              const Settings& settings) {
  return before.splitting != restart.splitting || left <= kFarMore * count_bad(best.work.mesh, settings.executor());
}

}  // namespace

bool has_gained(const Candidate& now, const Candidate& before, const Settings& settings, const EnergyModel& model) {
  const bool same_vertices = now.work.n_vertices_named == before.work.n_vertices_named &&
                             now.work.mesh.n_vertices() == before.work.mesh.n_vertices();
  return replaces(now.work, before.work, same_vertices ? Requirement::not_worse : Requirement::cures, settings, model);
}

Expected<Candidate> best_restart(InputMesh& input, const Settings& settings, SweepState& state, Run& run) {
  std::optional<Candidate> best;
  std::vector<Restart> all(1);
  const std::size_t flips_before = run.report.flips;
  std::size_t left = 0;  // bad triangles of the last restart that was not kept
  bool renewed = false;  // whether the best mesh is new since cuts at bad triangles failed
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool goes_on = all[i].splitting == BoundarySplitting::where_bad;
    if (best && !(goes_on ? renewed : may_gain(all[i], all[i - 1], left, *best, settings))) continue;
    const BestBefore kept(run.best_before, best ? &best->work : nullptr);
    Candidate now = goes_on ? *best : Candidate{input.copy()};
    Driver driver(now.work, settings, state, run);
    if (best) driver.recorder().returned_to(goes_on ? best->sweep : -1);
    if (auto error = prepare(driver, input, settings, all[i])) return *std::move(error);
    if (!best) {
      if (auto error = outside_domain_error(now.work.mesh, settings)) return *std::move(error);
      all = restarts_for(now.work.mesh, settings);
      run.facts.input_flips = run.report.flips - flips_before;
    }
    const Restart& restart = all[i];
    now.sweep = driver.restart(restart, i + 1 < all.size() || repairs(settings));
    // The user asks for cuts, so a mesh without them must have fewer bad triangles.
    const Requirement required =
        restart.splitting == BoundarySplitting::graded ? Requirement::not_worse : Requirement::fewer_bad;
    if (!best || replaces(now.work, best->work, required, settings, state.model)) {
      best = std::move(now);
      left = 0;
      renewed = true;
      note_splits(restart, run.facts);
    } else {
      driver.recorder().returned_to(best->sweep);
      left = count_bad(now.work.mesh, settings.executor());
      if (goes_on) renewed = false;
    }
    if (!has_bad(*best, settings) || !run.goes_on() || (repairs(settings) && are_apart(*best, settings))) break;
  }
  return *std::move(best);
}

Expected<Mended> mended(InputMesh& input, const Settings& settings, SweepState& state, Run& run) {
  Mended best{{WorkingCopy(input.whole(), SweepOrder::input)}};  // few vertices are visited, so that no order pays
  WorkingCopy& work = best.candidate.work;
  Driver driver(work, settings, state, run);
  if (!driver.make_regular()) return hidden_vertices_error(input.whole(), settings.hooks.names);
  run.facts.input_flips = run.report.flips;
  const auto n_bad = [&] { return cells_at_violations(work.mesh, settings.criterion, settings.executor()).size(); };
  best.left = n_bad();
  best.many = are_many(best.left, work.mesh.n_triangles());
  if (best.many) return best;
  best.candidate.sweep = driver.mend();
  best.left = n_bad();
  return best;
}

Candidate reweighted(Candidate best, InputMesh& input, const Settings& settings, SweepState state, Run& run) {
  Settings own = settings;
  own.options.unknowns = Unknowns::weights;
  std::vector<Restart> planned(1);
  const bool may = settings.options.unknowns == Unknowns::positions_and_weights && repairs(settings) &&
                   run.report.sweeps <= settings.options.max_sweeps / 2;  // the rest is for repairs
  if (!may || !run.goes_on() || !has_bad(best, settings) || are_apart(best, settings)) return best;
  const BestBefore kept(run.best_before, &best.work);
  for (std::size_t i = 0; i < planned.size(); ++i) {
    Candidate now{input.copy()};
    Driver driver(now.work, own, state, run);
    driver.recorder().returned_to(-1);
    driver.make_regular();  // cannot fail: it succeeded in the first restart
    if (i == 0) planned = restarts_by_weights(now.work.mesh, own);
    if (planned.empty()) {
      driver.recorder().returned_to(best.sweep);
      break;
    }
    now.sweep = driver.restart(planned[i], true);
    if (replaces(now.work, best.work, Requirement::fewer_bad, settings, state.model)) {
      best = std::move(now);
      run.facts.stays_unsplit = settings.options.boundary == BoundaryVertices::split;
    } else {
      driver.recorder().returned_to(best.sweep);
    }
    if (!has_bad(best, settings) || !run.goes_on()) break;
  }
  return best;
}

Candidate coarsened(Candidate best, const Settings& settings, SweepState& state, Run& run, int moves_of_cure) {
  if (!settings.options.coarsen || run.stopped_early()) return best;
  Driver(best.work, settings, state, run).coarsen(moves_of_cure);
  best.sweep = run.report.sweeps;
  return best;
}

Candidate repaired(Candidate best, const Settings& settings, SweepState& state, Run& run) {
  if (!repairs(settings) || !may_repair(best, settings, run) ||
      !std::isfinite(total_energy(best.work.mesh, state.model))) {
    return best;
  }
  if (repairs_in_place(best, settings)) return searched(std::move(best), Pace::thorough, settings, state, run);
  std::optional<Candidate> quick;
  if (settings.guard != nullptr) {
    quick = searched(best, Pace::quick, settings, state, run);
    const std::size_t left = count_bad(quick->work.mesh, settings.executor());
    if (left == 0 || left > kFew || !run.goes_on()) return polished(*std::move(quick), settings, state, run);
    run.renew_trials();
    Driver(best.work, settings, state, run).recorder().returned_to(best.sweep);
  }
  best = searched(std::move(best), Pace::thorough, settings, state, run);
  if (quick && !replaces(best.work, quick->work, Requirement::fewer_bad, settings, state.model)) {
    best = *std::move(quick);
    Driver(best.work, settings, state, run).recorder().returned_to(best.sweep);
  }
  return polished(std::move(best), settings, state, run);
}

Candidate refined(Candidate best, const Settings& settings, SweepState& state, Run& run) {
  constexpr int kRounds = 20;
  constexpr double kSmaller = 0.8;
  const bool may = repairs_split_lines(settings, best.work.mesh.space()) &&
                   settings.options.unknowns == Unknowns::positions_and_weights &&
                   settings.policy.insertion_place == InsertionPlace::best;
  if (!may || !run.goes_on() || !has_bad(best, settings)) return best;
  run.renew_trials();
  Candidate last = best;
  double factor = 1;
  bool is_best = true;
  TrialMemo memo;
  for (int i = 0; i < kRounds && has_bad(best, settings) && run.goes_on(); ++i, factor *= kSmaller) {
    const BestBefore kept(run.best_before, &best.work);
    Driver driver(last.work, settings, state, run);
    is_best = false;
    if (driver.refine_where_bad(factor) == 0) continue;
    last.sweep = driver.restart(restarts(settings, last.work.mesh).front(), true);
    if (has_bad(last, settings) && run.goes_on()) {
      driver.repair(memo, settings.policy.seed, Pace::thorough);
      last.sweep = run.report.sweeps;
    }
    is_best = replaces(last.work, best.work, Requirement::fewer_bad, settings, state.model);
    if (is_best) best = last;
  }
  if (!is_best) Driver(best.work, settings, state, run).recorder().returned_to(best.sweep);
  return best;
}

}  // namespace temper
