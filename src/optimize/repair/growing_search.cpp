#include "optimize/repair/growing_search.hpp"

#include <algorithm>
#include <array>

#include "base/assert.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/repair/edits.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/repair_search.hpp"
#include "temper/detail/criterion.hpp"

namespace temper {
namespace {

// Each step takes about twice as many triangles: 13 with one ring, 250 with six.
constexpr std::array<int, 5> kLevels = {1, 2, 3, 4, 6};
// With fewer rings a place has no room for other vertices.
constexpr int kRingsForVertices = 3;

bool touches(const Mesh& mesh, TriangleId t, HalfedgeId h) {
  return Mesh::triangle(h) == t || (!mesh.is_boundary(h) && Mesh::triangle(mesh.twin(h)) == t);
}

/// Says whether the triangle at the center still violates the criterion.
bool is_violated(const Neighborhood& around, Criterion criterion) {
  if (criterion == Criterion::well_centered) return is_bad(around.mesh, around.seed);
  return std::ranges::any_of(violated_edges(around, around.mesh, criterion), [&](const ViolatedEdge& violated) {
    return touches(around.mesh, around.seed, violated.edge);
  });
}

bool moves_at_random(const Edit& edit) { return std::holds_alternative<Perturb>(edit); }

}  // namespace

bool GrowingSearch::improve() {
  if (level_ == kLevels.size() || run_.repair_trials_left() == 0 || run_.stopped_early()) return false;
  const std::vector<TriangleId> seeds = cells_at_violations(work_.mesh, settings_.criterion, settings_.executor());
  if (seeds.empty()) return false;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(seeds.size());
    if (run_.repair_trials_left() == 0 || run_.asked_to_stop(share)) break;
    improve_place(seeds[i]);
    if (flipper_.has_removed()) return true;
  }
  ++level_;
  return true;
}

/// Makes the first edit that leaves fewer violations, if there is one.
void GrowingSearch::improve_place(TriangleId seed) {
  if (work_.mesh.is_erased(seed)) return;
  const Neighborhood around = neighborhood_of(work_, seed, kLevels[level_]);
  if (!is_violated(around, settings_.criterion)) return;
  const std::optional<Edit> edit = choose(around);
  if (!edit) return;
  const TrialResult result = try_edit(around, *edit, settings_, work_.units, {.with_events = true});
  TEMPER_ASSERT(result.valid);  // as without a listener
  splice(work_, flipper_, around, result.events);
}

/// Returns the edit after which fewest violations are left, from the first tier with one that leaves fewer.
std::optional<Edit> GrowingSearch::choose(const Neighborhood& around) {
  std::optional<Edit> best;
  std::size_t least = defect_of(around, around.mesh, settings_).bad;
  for (const auto& tier : tiers_for(around)) {
    for (const Edit& edit : tier) {
      const bool program = std::holds_alternative<AssignWeights>(edit);
      run_.count_trials(program ? 1 + kTrialsOfAProgram : 1, around.mesh.n_triangles());
      const TrialResult result = try_edit(around, edit, settings_, work_.units);
      if (!result.valid || result.defect.bad >= least) continue;
      best = edit;
      least = result.defect.bad;
      if (least == 0) break;
    }
    if (best || run_.repair_trials_left() == 0) break;
  }
  return best;
}

/// Returns the edits in tiers. Weights come first, since then all positions stay.
std::vector<std::vector<Edit>> GrowingSearch::tiers_for(const Neighborhood& around) {
  const OptimizeOptions& o = settings_.options;
  const Space& space = work_.mesh.space();
  const Allowed allowed = {
      settings_.lp != nullptr && o.unknowns != Unknowns::positions && !space.is_periodic(),
      o.repair == Repair::vertices && o.unknowns != Unknowns::weights && kLevels[level_] >= kRingsForVertices,
      repairs_split_lines(settings_, space), settings_.policy.insertion_place};
  std::vector<std::vector<Edit>> tiers = edits_for(around, allowed, rng_);
  std::swap(tiers[0], tiers[1]);
  if (o.unknowns == Unknowns::weights) std::erase_if(tiers[1], moves_at_random);
  return tiers;
}

}  // namespace temper
