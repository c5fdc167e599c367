#include "optimize/repair/repair_search.hpp"

#include <algorithm>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/repair/edits.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/necessity.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

// The neighborhood gets one more ring after each number of failures, up to the most. Quick trials that measure cells or
// flow links take long, so they begin with less room: with new vertices it is enough for most places.
constexpr int kRings = 3, kMostRings = 4, kQuickRings = 2;
constexpr int kFailuresBeforeWider = 6;
constexpr int kFailuresBeforeSideways = 5;
// After this number of failures a vertex is inserted even if more triangles become bad: more vertices leave more room.
constexpr int kFailuresBeforeFiner = 10;
// Enough for the random walk of sideways edits. After this number the search gives a place up.
constexpr int kMostFailures = 60, kMostFailuresOfMoves = 10;
// An edit that helps lowers the violation by this part, or the number of bad triangles.
constexpr double kHelps = 0.01;
constexpr std::uint32_t kSidewaysChoice = 4;
// With a guard a trial takes this many times as long; more if it measures cells or flow links, so that quick trials end
// soon.
constexpr std::size_t kVisitsByGuard = 2, kVisitsByGuardOfCells = 6;
// Repairs are local. Where most triangles are bad they gain little, so a trial counts this many times.
constexpr std::size_t kVisitsWhereMostAreBad = 8;

bool helps(const LocalDefect& before, const LocalDefect& after) {
  return after.bad < before.bad || (after.bad == before.bad && after.violation < (1 - kHelps) * before.violation);
}

}  // namespace

bool repairs(const Settings& settings) {
  const OptimizeOptions& o = settings.options;
  if (o.repair == Repair::none || o.repair_trials == 0 || !settings.energy().barrier ||
      settings.policy.keeps_connectivity() || o.unknowns == Unknowns::weights)
    return false;
  const Policy& policy = settings.policy;
  if (policy.allows_inversion() || policy.keeps_hidden()) return false;  // trials need regular meshes
  // A user who sets a constant γ studies this γ. Only an option to change vertices allows repairs with another γ.
  return o.repair == Repair::vertices ||
         (!policy.gamma && !policy.h0 && policy.solver == Solver::newton && policy.weights_from == 0);
}

bool repairs_split_lines(const Settings& settings, const Space& space) {
  const OptimizeOptions& o = settings.options;
  return repairs(settings) && o.repair == Repair::vertices && o.boundary == BoundaryVertices::split &&
         space.is_plane() && !space.is_periodic();
}

bool RepairSearch::improve_one_place() {
  const bool vertices = settings_.options.repair == Repair::vertices;
  find_bad();
  if (!bad_.empty()) short_.reset();
  if (bad_.empty() && vertices) find_short();
  const std::vector<TriangleId>& bad = short_ ? *short_ : bad_;
  // With many bad places, each gets a try; but a guard may leave none of them room, as in a grid of equal triangles.
  const int places = settings_.guard == nullptr ? static_cast<int>(bad.size()) : 0;
  const int most_failures = std::max(vertices ? kMostFailures : kMostFailuresOfMoves, places);
  const int rings = vertices && is_quick_by_cells() ? kQuickRings : kRings;
  while (!bad.empty() && failures_ < most_failures && run_.repair_trials_left() > 0) {
    const TriangleId seed = bad[rng_.below(static_cast<std::uint32_t>(bad.size()))];
    const Neighborhood around =
        neighborhood_of(work_, seed, std::min(kMostRings, rings + failures_ / kFailuresBeforeWider));
    auto edit = choose_forced(around, seed);
    if (!edit) edit = choose(around, seed);
    if (run_.stopped_early()) return false;
    if (!edit) continue;
    const TrialResult result = try_edit(around, *edit, settings_, work_.units, {.with_events = true, .pace = pace()});
    TEMPER_ASSERT(result.valid);  // as without a listener
    const std::vector<VertexId> there = splice(work_, flipper_, around, result.events);
    changed_ = triangles_at(work_.mesh, there);
    std::erase_if(weighed_, [&](TriangleId t) { return flipper_.has_removed() || is_changed(t); });
    return true;
  }
  return false;
}

void RepairSearch::renumber(const Compaction& kept) {
  const auto follow = [&](std::vector<TriangleId>& list) {
    std::size_t n = 0;
    for (const TriangleId t : list) {  // kept triangles have kept their order
      const auto at = std::lower_bound(kept.triangles.begin(), kept.triangles.end(), t);
      if (at != kept.triangles.end() && *at == t) list[n++] = TriangleId(at - kept.triangles.begin());
    }
    list.resize(n);
  };
  follow(bad_);
  if (short_) follow(*short_);
  if (changed_) follow(*changed_);
}

/// Looks again at the place of the last edit. Duals also change next to it.
template <class Is>
void RepairSearch::follow_change(std::vector<TriangleId>& list, const Is& is) const {
  std::erase_if(list, [&](TriangleId t) { return is_changed(t); });
  for (const TriangleId t : *changed_) {
    if (is(t)) list.push_back(t);
  }
  std::sort(list.begin(), list.end());
}

void RepairSearch::find_bad() {
  if (!changed_ || settings_.criterion != Criterion::well_centered) {
    bad_ = cells_at_violations(work_.mesh, settings_.criterion, settings_.executor());
    return;
  }
  follow_change(bad_, [&](TriangleId t) { return is_bad(work_.mesh, t); });
  TEMPER_ASSERT_SLOW(bad_ == bad_triangles(work_.mesh));
}

void RepairSearch::find_short() {
  if (!changed_ || !short_) {
    short_ = triangles_lacking_length(work_.mesh, settings_.accuracy);
    return;
  }
  follow_change(*short_, [&](TriangleId t) { return lacks_length(work_.mesh, t, settings_.accuracy); });
  TEMPER_ASSERT_SLOW(*short_ == triangles_lacking_length(work_.mesh, settings_.accuracy));
}

/// Says whether a linear program may find weights. It is not solved in periodic planes, or twice for the same place. It
/// is not solved either if no mesh with an edge of the triangle has such weights.
bool RepairSearch::assigns_weights(TriangleId seed) const {
  const Mesh& mesh = work_.mesh;
  if (!asks_programs_ || run_.repair_trials_left() < kTrialsOfAProgram ||
      settings_.options.unknowns == Unknowns::positions || mesh.space().is_periodic() ||
      std::find(weighed_.begin(), weighed_.end(), seed) != weighed_.end())
    return false;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(seed, k);
    if (mesh.is_unflippable(h) && edge_conflict(mesh, h)) return false;
  }
  return true;
}

/// Trials that the memo has count, too, so that a search with it ends as one without.
void RepairSearch::count_trial(const Neighborhood& around, const Edit& edit) {
  const bool program = std::holds_alternative<AssignWeights>(edit);
  const std::size_t by_guard = settings_.guard == nullptr ? 1
                               : is_quick_by_cells()      ? kVisitsByGuardOfCells
                                                          : kVisitsByGuard;
  const std::size_t visits =
      by_guard * (2 * bad_.size() > work_.mesh.n_triangles() ? kVisitsWhereMostAreBad : 1) * around.mesh.n_triangles();
  run_.count_trials(program ? 1 + kTrialsOfAProgram : 1, visits);
}

/// Returns the line at a corner of the seed that must be split most urgently, whatever is done inside.
std::optional<EdgeConflict> RepairSearch::worst_conflict(TriangleId seed) const {
  const Mesh& mesh = work_.mesh;
  std::optional<EdgeConflict> worst;
  for (const VertexId v : mesh.corners(seed)) {
    for (const HalfedgeId h : lines_at(mesh, v)) {
      if (mesh.is_diagonal(h)) continue;
      const auto conflict = edge_conflict(mesh, h);
      if (conflict && (!worst || conflict->sum < worst->sum)) worst = conflict;
    }
  }
  return worst;
}

/// If there is a line that must be split, returns the best of its splits, even if more triangles become bad.
std::optional<Edit> RepairSearch::choose_forced(const Neighborhood& around, TriangleId seed) {
  if (!repairs_split_lines(settings_, work_.mesh.space())) return std::nullopt;
  const auto conflict = worst_conflict(seed);
  if (!conflict) return std::nullopt;
  const auto local = [&](VertexId whole) {
    const auto found = std::find(around.vertices.begin(), around.vertices.end(), whole);
    return VertexId(static_cast<std::size_t>(found - around.vertices.begin()));
  };
  const VertexId u = local(work_.mesh.origin(conflict->edge)), v = local(work_.mesh.target(conflict->edge));
  const HalfedgeId h = around.mesh.find_halfedge(u, v);
  if (!h.valid() || around.is_rim(u, v)) return std::nullopt;
  std::vector<Tried> all;
  for (const Edit& edit : splits_of(around, h, conflict->split_at)) {
    if (run_.repair_trials_left() == 0 || run_.asked_to_stop(0)) return std::nullopt;
    count_trial(around, edit);
    const TrialResult result = try_edit(around, edit, settings_, work_.units, {.pace = pace()});
    if (result.valid) all.push_back({edit, result.defect});
  }
  return finer(std::move(all));
}

/// Returns the edit that makes the neighborhood best, if it helps, from the first tier that has one.
std::optional<Edit> RepairSearch::choose(const Neighborhood& around, TriangleId seed) {
  const LocalDefect before = defect_of(around, around.mesh, settings_);
  std::optional<Edit> best;
  LocalDefect least = before;
  std::vector<Tried> all;
  const Allowed allowed = {assigns_weights(seed), settings_.options.repair == Repair::vertices,
                           repairs_split_lines(settings_, work_.mesh.space()), settings_.policy.insertion_place};
  TrialMemo::Results& memo = memo_.at(around, pace());
  const auto tiers = edits_for(around, allowed, rng_);
  for (std::size_t i = 0; i < tiers.size() && !best; ++i) {
    for (std::size_t k = 0; k < tiers[i].size(); ++k) {
      const Edit& edit = tiers[i][k];
      if (run_.repair_trials_left() == 0 || run_.asked_to_stop(0)) return best;
      if (std::holds_alternative<AssignWeights>(edit)) weighed_.push_back(seed);
      count_trial(around, edit);
      std::optional<TrialResult>& result = memo[{i, k}];
      if (!result || std::holds_alternative<Perturb>(edit))
        result = try_edit(around, edit, settings_, work_.units, {.pace = pace()});
      if (!result->valid) continue;
      all.push_back({edit, result->defect});
      if (!helps(least, result->defect)) continue;
      best = edit;
      least = result->defect;
      if (least == LocalDefect{}) break;
    }
  }
  if (best) {
    failures_ = 0;
    return best;
  }
  ++failures_;
  if (repairs_split_lines(settings_, work_.mesh.space()) && failures_ % kFailuresBeforeFiner == 0)
    return finer(std::move(all));
  if (failures_ % kFailuresBeforeSideways == 0) return sideways(std::move(all), before);
  return std::nullopt;
}

/// Returns the best edit that inserts a vertex, if there is one.
std::optional<Edit> RepairSearch::finer(std::vector<Tried> tried) {
  std::erase_if(tried, [](const Tried& t) { return !inserts_vertices(t.edit); });
  const auto best = std::ranges::min_element(tried, {}, &Tried::defect);
  if (best == tried.end()) return std::nullopt;
  return best->edit;
}

/// Returns one of the best few edits after which no more triangles are bad than before.
std::optional<Edit> RepairSearch::sideways(std::vector<Tried> tried, LocalDefect before) {
  std::erase_if(tried, [&](const Tried& t) { return t.defect.bad > before.bad; });
  if (tried.empty()) return std::nullopt;
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.defect < b.defect; });
  const auto choice = std::min(kSidewaysChoice, static_cast<std::uint32_t>(tried.size()));
  return tried[rng_.below(choice)].edit;
}

}  // namespace temper
