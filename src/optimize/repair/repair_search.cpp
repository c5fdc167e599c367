#include "optimize/repair/repair_search.hpp"

#include <algorithm>

#include "base/assert.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/run/lengths.hpp"
#include "optimize/repair/edits.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/splice.hpp"
#include "temper/detail/necessity.hpp"

namespace temper {
namespace {

constexpr int kRings = 3;
// After so many failures the neighbourhood has one ring more.
constexpr int kFailuresBeforeWider = 6;
constexpr int kFailuresBeforeSideways = 5;
// Enough for the random walk of sideways edits to come around; hopeless places are left after that.
constexpr int kMostFailures = 60, kMostFailuresOfMoves = 10;
// An edit that helps lowers the violation by this part, or the number of bad triangles.
constexpr double kHelps = 0.01;
constexpr std::uint32_t kSidewaysChoice = 4;
// What a linear programme takes, in trials of sweeps.
constexpr int kTrialsOfAProgramme = 20;

bool helps(const Standing& before, const Standing& after) {
  return after.bad < before.bad || (after.bad == before.bad && after.violation < (1 - kHelps) * before.violation);
}

/// The triangles with one of these corners or more, in ascending order.
std::vector<TriangleId> triangles_at(const Mesh& mesh, const std::vector<VertexId>& corners) {
  std::vector<TriangleId> all;
  for (const VertexId v : corners) {
    for (const HalfedgeId h : mesh.star(v)) all.push_back(Mesh::triangle(h));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

bool repairs(const Settings& settings) {
  const OptimizeOptions& o = settings.options;
  if (o.repair == Repair::none || o.repair_trials == 0 || !settings.energy().barrier || settings.policy.keeps_connectivity ||
      o.unknowns == Unknowns::weights)
    return false;
  const Policy& policy = settings.policy;
  if (policy.allows_inversion || policy.keeps_hidden) return false;  // trials need regular meshes
  // A constant γ is a study of that γ; only who asks for vertices to change wants its mesh mended by another.
  return o.repair == Repair::vertices ||
         (!policy.gamma && !policy.h0 && policy.solver == Solver::newton && policy.weights_from == 0);
}

bool RepairSearch::improve_one_place() {
  const bool vertices = settings_.options.repair == Repair::vertices;
  find_bad();
  const std::vector<TriangleId> lacking =
      bad_.empty() && vertices ? triangles_lacking_length(work_.mesh, settings_.accuracy) : std::vector<TriangleId>();
  const std::vector<TriangleId>& bad = bad_.empty() ? lacking : bad_;
  // Each of many bad places gets its chance.
  const int most_failures = std::max(vertices ? kMostFailures : kMostFailuresOfMoves, static_cast<int>(bad.size()));
  while (!bad.empty() && failures_ < most_failures && run_.repair_trials_left > 0) {
    const TriangleId seed = bad[rng_.below(static_cast<std::uint32_t>(bad.size()))];
    const Neighborhood around = neighborhood_of(work_.mesh, seed, kRings + (failures_ >= kFailuresBeforeWider ? 1 : 0));
    const auto edit = choose(around, seed);
    if (run_.stopped_early()) return false;
    if (!edit) continue;
    const Outcome outcome = try_edit(around, *edit, settings_, work_.frame, true);
    TEMPER_ASSERT(outcome.valid);  // as it was without a listener
    const std::vector<VertexId> there = splice(work_, flipper_, recorder_, around, outcome.events);
    changed_.reset();
    if (!flipper_.has_removed()) changed_ = triangles_at(work_.mesh, there);
    std::erase_if(weighed_, [&](TriangleId t) { return !changed_ || is_changed(t); });
    return true;
  }
  return false;
}

/// Looks only where the last edit was, when it left the numbers as they were.
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

/// Says whether a linear programme is asked for weights, which is of places that do not go round: not twice for the
/// same ones, and not where no mesh with an edge of the triangle has any.
bool RepairSearch::weighs(TriangleId seed) const {
  const Mesh& mesh = work_.mesh;
  if (!asks_programmes_ || run_.repair_trials_left < kTrialsOfAProgramme ||
      settings_.options.unknowns == Unknowns::positions || mesh.space().is_periodic() ||
      std::find(weighed_.begin(), weighed_.end(), seed) != weighed_.end())
    return false;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(seed, k);
    if (mesh.keeps_its_place(h) && edge_conflict(mesh, h)) return false;
  }
  return true;
}

/// The edit after which the neighbourhood stands best, if that helps; of the least tier that has one.
std::optional<Edit> RepairSearch::choose(const Neighborhood& around, TriangleId seed) {
  const Standing before = standing(around.mesh, settings_.accuracy);
  std::optional<Edit> best;
  Standing least = before;
  std::vector<Tried> tried;
  for (const auto& tier : edits_for(around, weighs(seed), settings_.options.repair == Repair::vertices, rng_)) {
    for (const Edit& edit : tier) {
      if (run_.repair_trials_left-- <= 0 || run_.asked_to_stop(0)) return best;
      if (edit.kind == Edit::weigh) {
        weighed_.push_back(seed);
        run_.repair_trials_left -= kTrialsOfAProgramme;
      }
      const Outcome outcome = try_edit(around, edit, settings_, work_.frame, false);
      if (!outcome.valid) continue;
      tried.push_back({edit, outcome.standing});
      if (!helps(least, outcome.standing)) continue;
      best = edit;
      least = outcome.standing;
      if (least == Standing{}) break;
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

/// One of the best few that leave no more triangles bad.
std::optional<Edit> RepairSearch::sideways(std::vector<Tried> tried, Standing before) {
  std::erase_if(tried, [&](const Tried& t) { return t.standing.bad > before.bad; });
  if (tried.empty()) return std::nullopt;
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.standing < b.standing; });
  const auto choice = std::min(kSidewaysChoice, static_cast<std::uint32_t>(tried.size()));
  return tried[rng_.below(choice)].edit;
}

}  // namespace temper
