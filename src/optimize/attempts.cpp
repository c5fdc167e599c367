// See attempts.hpp.
#include "optimize/attempts.hpp"

#include <algorithm>
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

// Each where the one before has made triangles good; more find little.
constexpr std::size_t kRoundsWhereBad = 4;
// Times as many bad triangles, which a more thorough attempt does not make up for.
constexpr std::size_t kFarMore = 2;
// Weights alone are seldom enough: they have to get on fast.
constexpr double kFewerByWeights = 0.75;
// A search that ends with triangles bad may have gone astray early on.
constexpr std::uint64_t kSearches = 4;
// The one more, where linear programmes can be asked: from what the first has left.
constexpr std::uint64_t kProgrammes = 1;

bool is_worse(const Candidate& a, const Candidate& b, const Settings& settings) {
  return rank(b.work.mesh, settings) < rank(a.work.mesh, settings);
}

/// Says whether what an attempt has made is kept instead of what there was. The user asks for cuts: without them fewer
/// triangles have to be bad.
bool replaces(const Candidate& now, const Candidate& best, const Attempt& attempt, const Settings& settings) {
  if (attempt.cuts == Cuts::graded) return !is_worse(now, best, settings);
  return rank(now.work.mesh, settings).bad < rank(best.work.mesh, settings).bad;
}

bool has_bad(const Candidate& c, const Settings& s) { return count_bad(c.work.mesh, s.hooks.executor) > 0; }

/// Says whether so few triangles of c are bad that each is a place of its own, far from all others. Another attempt
/// would leave as many elsewhere, where a repair of each is a matter of moments; a search need not give up what it has
/// cured to begin again with the others; and it needs no copy to return to, which the largest meshes have no room for:
/// it leaves no more bad than there were, and trials have swept each place by itself.
bool are_apart(const Candidate& c, const Settings& s) {
  constexpr double kMost = 1e-5;
  const auto bad = static_cast<double>(count_bad(c.work.mesh, s.hooks.executor));
  return bad > 0 && bad < kMost * static_cast<double>(c.work.mesh.n_triangles());
}

/// Vertices that came or went are taken back where they cured nothing.
bool keeps_vertices(const Settings& s) { return s.options.repair != Repair::vertices; }

/// Says whether c has what a repair could cure: bad triangles, or edges that vertices make too short.
bool needs_repair(const Candidate& c, const Settings& s) {
  return has_bad(c, s) ||
         (s.options.repair == Repair::vertices && missing_lengths(c.work.mesh, s.accuracy, s.hooks.executor) > 0);
}

/// What to try, for the working copy as it is. Where all attempts with a cut boundary leave triangles bad, they are
/// made again without: what lines leave no room for, cuts may make worse. After either there are cuts where triangles
/// are still bad, and sweeps from there.
std::vector<Attempt> attempts_for(const Mesh& mesh, const Settings& settings) {
  const OptimizeOptions& o = settings.options;
  const auto all = attempts(settings.energy, o, mesh, settings.hooks.executor);
  std::vector<Attempt> tries(all.begin(), all.end());
  const bool splits = o.boundary == BoundaryVertices::split;
  Attempt where_bad = kNearlyGood;
  where_bad.cuts = Cuts::where_bad;
  if (splits) {
    tries.insert(tries.end(), kRoundsWhereBad, where_bad);
    for (Attempt uncut : all) {
      uncut.cuts = Cuts::none;
      tries.push_back(uncut);
    }
    tries.insert(tries.end(), kRoundsWhereBad, where_bad);
  }
  for (Attempt& attempt : tries) attempt.first_energy = first_energy_of(o);
  return tries;
}

/// The quick ones of those for weights alone; none where nothing is softened.
std::vector<Attempt> attempts_by_weights(const Mesh& mesh, const Settings& settings) {
  std::vector<Attempt> tries;
  for (Attempt attempt : attempts(settings.energy, settings.options, mesh, settings.hooks.executor)) {
    if (!attempt.until_good) continue;
    attempt.fewer = std::min(attempt.fewer, kFewerByWeights);
    tries.push_back(attempt);
  }
  return tries;
}

/// The attempts of a run, and what came of those that were made.
struct Tries {
  std::vector<Attempt> all = std::vector<Attempt>(1);
  std::size_t i = 0;     ///< the one under way
  std::size_t left = 0;  ///< bad triangles of the last one that was not kept
  bool renewed = false;  ///< the best mesh, since cuts where it is bad were of no use

  [[nodiscard]] const Attempt& now() const { return all[i]; }
  [[nodiscard]] bool is_last() const { return i + 1 == all.size(); }
  /// Says whether the attempt may be of use. The second one from the same beginning is more thorough, and takes many
  /// sweeps: where the first left far more bad than there are in the best mesh it does not make up for that.
  [[nodiscard]] bool may_gain(const Candidate& best, const Settings& settings) const {
    if (now().cuts == Cuts::where_bad) return renewed;
    const Attempt& last = all[i - 1];
    if (last.cuts != now().cuts) return true;
    return left <= kFarMore * count_bad(best.work.mesh, settings.hooks.executor);
  }
};
void visit(Archive& archive, Tries& tries) {
  auto& [all, i, left, renewed] = tries;
  archive(all, i, left, renewed);
  archive.require(i < all.size());
}

/// The input made regular, and its boundary cut, as an attempt begins; or the best mesh, cut where it is bad.
std::optional<InputError> prepare(Driver& driver, const Mesh& input, const Settings& settings, const Attempt& attempt) {
  if (attempt.cuts == Cuts::where_bad) {
    driver.cut_where_bad();
    return std::nullopt;
  }
  if (settings.options.flips != Flips::none && !driver.make_regular()) {
    return hidden_vertices_error(input, settings.hooks.names);
  }
  if (attempt.cuts == Cuts::graded) driver.grade_boundary();
  return std::nullopt;
}

/// The cuts of the best mesh, which that attempt has made.
void tell_cuts(const Attempt& attempt, RunFacts& facts) {
  if (attempt.cuts == Cuts::where_bad) {
    const bool on_uncut = facts.stays_uncut || !facts.boundary_cuts;
    facts.boundary_cuts = on_uncut ? facts.cuts_where_bad : *facts.boundary_cuts + facts.cuts_where_bad;
  }
  facts.stays_uncut = attempt.cuts == Cuts::none;
}

}  // namespace

bool has_gained(const Candidate& c, const Candidate& before, const Settings& settings) {
  const Rank now = rank(c.work.mesh, settings), then = rank(before.work.mesh, settings);
  if (then < now) return false;
  const bool same_vertices = c.work.n_vertices_named == before.work.n_vertices_named &&
                             c.work.mesh.n_vertices() == before.work.mesh.n_vertices();
  return same_vertices || now.bad < then.bad || now.missing_lengths < then.missing_lengths;
}

Expected<Candidate> best_attempt(InputMesh& input, Settings& settings, Run& run) {
  const OptimizeOptions& o = settings.options;
  std::optional<Candidate> best;
  Candidate now;
  Tries tries;
  const Resumable here(run.checkpoints, best, now, tries);
  if (run.checkpoints.failed()) return *run.checkpoints.error();
  for (; tries.i < tries.all.size(); ++tries.i) {
    const bool begins = !run.checkpoints.resumes();
    if (begins && best && !tries.may_gain(*best, settings)) continue;
    const bool goes_on = tries.now().cuts == Cuts::where_bad;
    if (begins) now = goes_on ? *best : Candidate{WorkingCopy(input.whole(), o.paper.order, settings.hooks.executor)};
    Driver driver(now.work, settings, run);  // NOLINT(bugprone-use-after-move): what begins has been made anew
    if (begins && best) driver.recorder().returned_to(goes_on ? best->sweep : -1);
    if (begins) {
      if (auto error = prepare(driver, input.whole(), settings, tries.now())) return *std::move(error);
    }
    if (begins && !best) {
      if (auto error = outside_domain_error(now.work.mesh, settings)) return *std::move(error);
      tries.all = attempts_for(now.work.mesh, settings);
      run.facts.input_flips = run.report.flips;
    }
    input.fold();
    now.sweep = driver.attempt(tries.now(), !tries.is_last() || repairs(settings));
    if (auto error = run.checkpoints.error()) return *std::move(error);
    if (!best || replaces(now, *best, tries.now(), settings)) {
      best = std::move(now);
      tries.left = 0;
      tries.renewed = true;
      tell_cuts(tries.now(), run.facts);
    } else {
      driver.recorder().returned_to(best->sweep);
      tries.left = count_bad(now.work.mesh, settings.hooks.executor);
      if (goes_on) tries.renewed = false;
    }
    if (!has_bad(*best, settings) || !run.goes_on() || (repairs(settings) && are_apart(*best, settings))) break;
  }
  return *std::move(best);
}

Candidate weighed(Candidate best, InputMesh& input, const Settings& settings, Run& run) {
  Settings own = settings;
  own.options.unknowns = Unknowns::weights;
  std::vector<Attempt> tries(1);
  std::size_t i = 0;
  Candidate now;
  const Resumable here(run.checkpoints, best, own, tries, i, now);
  const bool may = settings.options.unknowns == Unknowns::positions_and_weights && repairs(settings) &&
                   run.report.sweeps <= settings.options.max_sweeps / 2;  // repairs need those that are left
  if (!here.resumed() && !(may && run.goes_on() && has_bad(best, settings) && !are_apart(best, settings))) return best;
  for (; i < tries.size(); ++i) {
    const bool begins = !run.checkpoints.resumes();
    if (begins) now = {WorkingCopy(input.whole(), own.options.paper.order, own.hooks.executor)};
    Driver driver(now.work, own, run);  // NOLINT(bugprone-use-after-move): what begins has been made anew
    if (begins) {
      driver.recorder().returned_to(-1);
      driver.make_regular();  // it could be at the first attempt
    }
    if (begins && i == 0) tries = attempts_by_weights(now.work.mesh, own);
    input.fold();
    if (tries.empty()) {
      driver.recorder().returned_to(best.sweep);
      break;
    }
    now.sweep = driver.attempt(tries[i], true);
    if (run.checkpoints.resumes()) return best;
    if (rank(now.work.mesh, own).bad < rank(best.work.mesh, own).bad) {
      best = std::move(now);
      run.facts.stays_uncut = settings.options.boundary == BoundaryVertices::split;
    } else {
      driver.recorder().returned_to(best.sweep);
    }
    if (!has_bad(best, settings) || !run.goes_on()) break;
  }
  return best;
}

Candidate repaired(Candidate best, Settings& settings, Run& run) {
  const auto is_done = [&](const Candidate& c) {
    return !run.goes_on() || run.repair_trials_left <= 0 || !needs_repair(c, settings);
  };
  const std::uint64_t searches = settings.hooks.lp != nullptr ? kSearches + 1 : kSearches;
  std::optional<Candidate> start;  // of all searches on copies, once it is not the best one
  Candidate copy;
  std::uint64_t i = 0;
  bool in_place = false, polishes = false;
  const Resumable here(run.checkpoints, best, start, copy, i, in_place, polishes);
  if (!here.resumed()) {
    if (!repairs(settings) || is_done(best) || !std::isfinite(total_energy(best.work.mesh, settings.model)))
      return best;
    in_place = keeps_vertices(settings) && are_apart(best, settings);
  }
  for (; !polishes && i < searches; ++i) {
    const bool begins = !run.checkpoints.resumes(), asks_programmes = i == kProgrammes && settings.hooks.lp != nullptr;
    if (begins && is_done(best)) break;
    if (asks_programmes) start.reset();  // they cost more than what is cured
    if (begins && !in_place) copy = start ? *start : best;
    Candidate& now = in_place ? best : copy;  // NOLINT(bugprone-use-after-move): what begins has been made anew
    Driver driver(now.work, settings, run);
    if (begins && start) driver.recorder().returned_to(start->sweep);
    const bool changed = driver.repair(settings.options.paper.seed + i, asks_programmes);
    now.sweep = run.report.sweeps;
    if (in_place) continue;
    if (changed && has_gained(now, best, settings)) {
      if (!start) start = std::move(best);
      best = std::move(now);
      if (are_apart(best, settings)) start.reset();
    } else {
      driver.recorder().returned_to(best.sweep);
    }
  }
  if (in_place) return best;
  start.reset();
  copy = {};
  polishes = true;
  if (run.checkpoints.resumes() || run.goes_on()) best.sweep = Driver(best.work, settings, run).polish(best.sweep);
  return best;
}

}  // namespace temper
