#include "optimize/repair/repair_search.hpp"

#include <algorithm>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "temper/detail/necessity.hpp"
#include "topology/locate.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

constexpr int kKicks = 3;
// Largest number of bad triangles of a neighborhood at which edits begin.
constexpr std::size_t kMostBad = 6;
constexpr std::size_t kMostRemovals = 12;
// Gradations of sizes: the first sizes hardly grow, the last ones double within their own length.
constexpr double kGradations[] = {0.3, 0.6, 1};

/// Returns the seed of the neighborhood, and other bad triangles.
std::vector<TriangleId> some_bad_triangles(const Neighborhood& around) {
  std::vector<TriangleId> bad = {around.seed};
  for (const TriangleId t : around.mesh.triangles()) {
    if (bad.size() == kMostBad) break;
    if (t != around.seed && is_bad(around.mesh, t)) bad.push_back(t);
  }
  return bad;
}

void add_insertions(const Mesh& mesh, TriangleId t, std::vector<Edit>& edits) {
  const auto [a, b, c] = mesh.points(t);
  edits.push_back({.kind = Edit::insert, .triangle = t, .place = middle(mesh.space(), a, b, c)});
  const WeightedPoint o = orthocenter(mesh.space(), a, b, c);
  const Location at = locate(mesh, o, t);
  if (at.kind == Location::Kind::in_triangle) {
    edits.push_back({.kind = Edit::insert, .triangle = at.triangle, .place = o});
  }
  for (int side = 0; side < 3; ++side) {
    const HalfedgeId h = Mesh::halfedge(t, side);
    if (!mesh.is_boundary(h) && !mesh.is_constrained(h)) edits.push_back({.kind = Edit::split, .edge = h});
  }
}

/// Returns the corners of these triangles and their neighbors, each once.
std::vector<VertexId> vertices_near(const Mesh& mesh, const std::vector<TriangleId>& triangles) {
  std::vector<VertexId> near;
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) {
      near.push_back(v);
      for (const HalfedgeId h : mesh.star(v)) near.push_back(mesh.target(h));
    }
  }
  sort_unique(near);
  return near;
}

void add_removals(const Neighborhood& around, const std::vector<TriangleId>& bad, std::vector<Edit>& edits) {
  std::size_t count = 0;
  for (const VertexId v : vertices_near(around.mesh, bad)) {
    if (!may_be_removed(around.mesh, around.frozen, v)) continue;
    if (plan_removal(around.mesh, v).status != RemovalStatus::possible) continue;
    if (++count > kMostRemovals) return;
    edits.push_back({.kind = Edit::remove, .vertex = v});
  }
}

/// Returns edits in tiers. A tier is tried if no edit of the tier before helps. The first tier changes least: sweeps
/// alone, and random perturbations, which keep every vertex. With `assigns_weights`, weights by a linear program
/// follow. With `vertices`, the next tier removes a vertex near a bad triangle, or inserts one at its centroid, at its
/// orthocenter or on an edge. The next tier inserts all missing vertices, and the last one replaces all. Fixed,
/// boundary and constrained vertices stay.
std::vector<std::vector<Edit>> edits_for(const Neighborhood& around, bool assigns_weights, bool vertices, Rng& rng) {
  std::vector<Edit> moves = {{.kind = Edit::nothing}}, weights, one, many, anew;
  for (int i = 0; i < kKicks; ++i) moves.push_back({.kind = Edit::kick, .seed = rng.next()});
  if (assigns_weights) weights.push_back({.kind = Edit::assign_weights});
  if (!vertices) return {moves, weights};
  const std::vector<TriangleId> bad = some_bad_triangles(around);
  add_removals(around, bad, one);
  for (const TriangleId t : bad) add_insertions(around.mesh, t, one);
  if (around.mesh.space().is_periodic()) return {moves, weights, one};  // refinement measures across the neighborhood
  for (const double gradation : kGradations) {
    many.push_back({.kind = Edit::refine, .gradation = gradation});
    anew.push_back({.kind = Edit::remesh, .gradation = gradation});
  }
  return {moves, weights, one, many, anew};
}

constexpr int kRings = 3;
// After this number of failures the neighborhood gets one more ring.
constexpr int kFailuresBeforeWider = 6;
constexpr int kFailuresBeforeSideways = 5;
// Enough for the random walk of sideways edits. After this number the search gives a place up.
constexpr int kMostFailures = 60, kMostFailuresOfMoves = 10;
// An edit that helps lowers the violation by this part, or the number of bad triangles.
constexpr double kHelps = 0.01;
constexpr std::uint32_t kSidewaysChoice = 4;
// Cost of a linear program, in trials.
constexpr int kTrialsOfAProgram = 20;
// With a guard a trial takes this many times as long.
constexpr std::size_t kVisitsByGuard = 2;
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

bool RepairSearch::improve_one_place() {
  const bool vertices = settings_.options.repair == Repair::vertices;
  find_bad();
  const std::vector<TriangleId> lacking =
      bad_.empty() && vertices ? triangles_lacking_length(work_.mesh, settings_.accuracy) : std::vector<TriangleId>();
  const std::vector<TriangleId>& bad = bad_.empty() ? lacking : bad_;
  // With many bad places, each gets a try; but a guard may leave none of them room, as in a grid of equal triangles.
  const int places = settings_.guard == nullptr ? static_cast<int>(bad.size()) : 0;
  const int most_failures = std::max(vertices ? kMostFailures : kMostFailuresOfMoves, places);
  while (!bad.empty() && failures_ < most_failures && run_.repair_trials_left() > 0) {
    const TriangleId seed = bad[rng_.below(static_cast<std::uint32_t>(bad.size()))];
    const Neighborhood around = neighborhood_of(work_.mesh, seed, kRings + (failures_ >= kFailuresBeforeWider ? 1 : 0));
    const auto edit = choose(around, seed);
    if (run_.stopped_early()) return false;
    if (!edit) continue;
    const TrialResult result = try_edit(around, *edit, settings_, work_.units, true);
    TEMPER_ASSERT(result.valid);  // as without a listener
    const std::vector<VertexId> there = splice(work_, flipper_, recorder_, around, result.events);
    changed_.reset();
    if (!flipper_.has_removed()) changed_ = triangles_at(work_.mesh, there);
    std::erase_if(weighed_, [&](TriangleId t) { return !changed_ || is_changed(t); });
    return true;
  }
  return false;
}

/// If the last edit kept all numbers, looks only at its place.
void RepairSearch::find_bad() {
  if (!changed_) {
    bad_ = bad_triangles(work_.mesh);
    return;
  }
  std::erase_if(bad_, [&](TriangleId t) { return is_changed(t); });
  for (const TriangleId t : *changed_) {
    if (is_bad(work_.mesh, t)) bad_.push_back(t);
  }
  std::sort(bad_.begin(), bad_.end());
  TEMPER_ASSERT_SLOW(bad_ == bad_triangles(work_.mesh));
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

/// Returns the edit that makes the neighborhood best, if it helps, from the first tier that has one.
std::optional<Edit> RepairSearch::choose(const Neighborhood& around, TriangleId seed) {
  const LocalDefect before = defect_of(around.mesh, settings_.accuracy);
  std::optional<Edit> best;
  LocalDefect least = before;
  std::vector<Tried> tried;
  for (const auto& tier :
       edits_for(around, assigns_weights(seed), settings_.options.repair == Repair::vertices, rng_)) {
    for (const Edit& edit : tier) {
      if (run_.repair_trials_left() == 0 || run_.asked_to_stop(0)) return best;
      const bool program = edit.kind == Edit::assign_weights;
      if (program) weighed_.push_back(seed);
      const std::size_t visits = (settings_.guard != nullptr ? kVisitsByGuard : 1) *
                                 (2 * bad_.size() > work_.mesh.n_triangles() ? kVisitsWhereMostAreBad : 1) *
                                 around.mesh.n_triangles();
      run_.count_trials(program ? 1 + kTrialsOfAProgram : 1, visits);
      const TrialResult result = try_edit(around, edit, settings_, work_.units, false);
      if (!result.valid) continue;
      tried.push_back({edit, result.defect});
      if (!helps(least, result.defect)) continue;
      best = edit;
      least = result.defect;
      if (least == LocalDefect{}) break;
    }
    if (best) break;
  }
  if (best) {
    failures_ = 0;
  } else if (++failures_ % kFailuresBeforeSideways == 0) {
    best = sideways(std::move(tried), before);
  }
  return best;
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
