#include "tets/optimize/repair_run.hpp"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "optimize/run/changes.hpp"
#include "tets/optimize/local_search.hpp"

namespace temper::tets {
namespace {

// Rounds of changes at all bad tetrahedra at once end when kRoundsInVain of them have not lowered the number.
constexpr std::size_t kRoundsInVain = 4;
// Rounds at tetrahedra with smaller margins go on while they lower the energy by more than a part. On nine public
// meshes they lower errors by a fifth, with 7 % more tetrahedra; 0.02 adds 15 % and gains little.
constexpr double kSmallMargin = 0.01, kGainOfRound = 1e-3;
// Tetrahedra that repairs may improve, each time they do: with 5,000 tetrahedra some ten seconds on one core.
constexpr std::size_t kRepairWork = 300'000, kRepairWorkPerTet = 40;
// Where patches around places fill the mesh, as on thin shells, most places stay bad. So repairs may do less there.
constexpr std::size_t kWorkOfMany = 40'000;
// Trials in vain of a first pass over all patches: most of those that help are among the first.
constexpr int kFewTrials = 2;

}  // namespace

RepairRun::RepairRun(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                     std::span<const VertexId> frozen)
    : Run(mesh, options, hooks, frozen), work_(kRepairWork + kRepairWorkPerTet * draft_.mesh.n_tetrahedra()) {}

bool RepairRun::changes_connectivity() const {
  return options_.unknowns == temper::Unknowns::positions_and_weights && options_.flips != Flips::none &&
         options_.tets.repair_trials > 0;
}

void RepairRun::repair(Criterion sought) {
  const SearchOptions of_all = {.criterion = sought, .most_cosine = guarded_cosine()};
  for (std::size_t in_vain = 0; best_bad_ > 0 && in_vain < kRoundsInVain;) {
    const std::size_t before = best_bad_;
    if (!may_sweep() || !change_places(of_all)) break;
    in_vain = best_bad_ < before ? 0 : in_vain + 1;
  }
  repair_in_patches(sought);
  if (best_bad_ == 0 && criterion_ == Criterion::well_centered && lowers_errors() && !changes_least()) widen_margins();
  if (best_bad_ == 0 && options_.tets.small_margin > 0) {
    draft_ = *best_.kept;
    repair_patches({criterion_, options_.tets.repair_trials, options_.tets.small_margin, false,
                    options_.tets.patches == Patches::each});
  }
}

bool RepairRun::change_places(const SearchOptions& options) {
  const bool changes = change_all(
      draft_, options, [this](double) { return is_stopped(0); }, hooks_.executor);
  if (changes) end_round(false);
  return changes;
}

void RepairRun::widen_margins() {
  Draft widest = draft_ = *best_.kept;
  double least = state_of(widest.mesh, kLastGamma, hooks_.executor).energy;
  SearchOptions options = {.criterion = criterion_, .small_margin = kSmallMargin, .most_cosine = most_cosine_};
  for (std::size_t in_vain = 0; in_vain < kRoundsInVain && may_sweep();) {
    options.rank = in_vain;
    if (!change_places(options) || stopped_early()) break;
    const SweepRecord& now = report.history.back();
    const bool is_better = now.bad == 0 && now.energy < (1 - kGainOfRound) * least;
    in_vain = is_better ? 0 : in_vain + 1;
    if (is_better) {
      widest = draft_;
      least = now.energy;
    } else if (in_vain % 2 == 0) {
      draft_ = widest;
    }
  }
  draft_ = std::move(widest);
  keep_if_best(0, true);
}

void RepairRun::repair_in_patches(Criterion sought) {
  draft_ = *best_.kept;
  if (are_many(best_bad_, draft_.mesh.n_tetrahedra())) work_ = std::min(work_, kWorkOfMany);
  const int trials = options_.tets.repair_trials;
  const bool each = options_.tets.patches == Patches::each;
  for (const double most_cosine : {most_cosine_, guarded_cosine()}) {  // smaller angles only if there is no other way
    for (const int most : {std::min(kFewTrials, trials), trials}) {
      if (best_bad_ > 0) repair_patches({sought, most, 0, false, each, most_cosine});
    }
    if (best_bad_ > 0 && options_.boundary == BoundaryVertices::split)
      repair_patches({sought, trials, 0, true, each, most_cosine});
  }
}

void RepairRun::repair_patches(const SearchOptions& options) {
  if (options.most_in_vain == 0) return;
  for (Places places(options, work_); may_sweep();) {
    std::vector<Patch> patches = places.choose(draft_, hooks_.executor);
    if (patches.empty()) return;
    std::vector<SearchResult> found(patches.size());
    std::atomic<bool> stops = false, asks = false;
    const auto must_stop = [&](std::size_t i) {  // one thread asks at a time
      if (!stops && !asks.exchange(true)) {
        stops = is_stopped(double(i) / double(patches.size()));
        asks = false;
      }
      return stops.load();
    };
    or_serial(hooks_.executor).run(patches.size(), [&](std::size_t i) {
      found[i] = search(patches[i].draft, options, [&](double) { return must_stop(i); });
    });
    std::vector<Patch> chosen;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      places.spend(i, found[i]);
      if (found[i].is_better) chosen.push_back(std::move(patches[i]));
    }
    if (!chosen.empty() && !put_back(chosen, draft_)) return;
    end_round(true);
    if (stopped_early()) return;
    if (report.history.back().bad > best_bad_) {  // patches together violate the criterion
      draft_ = *best_.kept;
      continue;
    }
    for (std::size_t i = 0; i < patches.size(); ++i) {
      if (found[i].is_better) places.succeeded(i);
    }
  }
}

}  // namespace temper::tets
