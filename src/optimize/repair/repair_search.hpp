// Local search around triangles that are not well-centered after sweeps alone.
//
// Inside the well-centered set no edge can flip, since h > 0 on both sides. So each connectivity is an island, and
// sweeps, which go downhill, do not leave theirs. A repair takes a few rings around a bad triangle and tries edits on a
// copy (trial.hpp). Then it applies the best edit to the mesh. If no edit helps, it sometimes applies a harmless one,
// so that the next try begins elsewhere.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "base/rng.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/repair/trial.hpp"
#include "optimize/repair/trial_memo.hpp"
#include "optimize/run/run.hpp"
#include "temper/detail/necessity.hpp"

namespace temper {

class RepairSearch {
 public:
  /// `seed`: of all random choices. `asks_programs`: linear programs find weights for places that nothing else cures.
  /// `memo`: trials of this run with the same settings. `pace`: of trials at bad triangles by a guard.
  RepairSearch(WorkingCopy& work, Run& run, Flipper& flipper, TrialMemo& memo, std::uint64_t seed, bool asks_programs,
               Pace pace)
      : work_(work),
        settings_(flipper.settings()),
        run_(run),
        flipper_(flipper),
        memo_(memo),
        rng_(seed),
        asks_programs_(asks_programs),
        pace_(pace) {}

  /// Changes the mesh in one place, never to more bad triangles. Returns false if none is left, none can be cured, or
  /// the run must stop. Removed vertices stay isolated. The caller must compact before the next call.
  bool improve_one_place();
  /// Follows that compaction.
  void renumber(const Compaction& kept);
  /// Returns the present triangles of that place.
  [[nodiscard]] const std::optional<std::vector<TriangleId>>& changed() const { return changed_; }

 private:
  struct Tried {
    Edit edit;
    LocalDefect defect;
  };
  [[nodiscard]] bool assigns_weights(TriangleId seed) const;
  [[nodiscard]] std::optional<EdgeConflict> worst_conflict(TriangleId seed) const;
  std::optional<Edit> choose(const Neighborhood& around, TriangleId seed);
  std::optional<Edit> choose_forced(const Neighborhood& around, TriangleId seed);
  std::optional<Edit> sideways(std::vector<Tried> tried, LocalDefect before);
  static std::optional<Edit> finer(std::vector<Tried> tried);
  void count_trial(const Neighborhood& around, const Edit& edit);
  void find_bad();
  void find_short();
  template <class Is>
  void follow_change(std::vector<TriangleId>& list, const Is& is) const;
  /// Without a guard, trials are fast anyway. To make edges longer, the quick ones are enough.
  [[nodiscard]] Pace pace() const {
    return settings_.guard != nullptr && (pace_ == Pace::quick || bad_.empty()) ? Pace::quick : Pace::thorough;
  }
  [[nodiscard]] bool is_quick_by_cells() const { return pace() == Pace::quick && settings_.guard->has_cells_or_flow(); }
  [[nodiscard]] bool is_changed(TriangleId t) const {
    return std::binary_search(changed_->begin(), changed_->end(), t);
  }

  WorkingCopy& work_;
  const Settings& settings_;
  Run& run_;
  Flipper& flipper_;
  TrialMemo& memo_;
  Rng rng_;
  const bool asks_programs_;
  const Pace pace_;
  int failures_ = 0;                 // places without a helpful edit since the last success
  std::vector<TriangleId> weighed_;  // seeds of places for which a linear program has failed, since programs are slow
  // These are sorted. After improve_one_place() the first two are as before its edit, which has changed the third.
  std::vector<TriangleId> bad_;
  std::optional<std::vector<TriangleId>> short_;  // triangles whose edges lack length, once all bad ones are cured
  std::optional<std::vector<TriangleId>> changed_;
};

/// Says whether these options ask for repairs and allow them.
[[nodiscard]] bool repairs(const Settings& settings);
/// Says whether repairs may split edges of the boundary and of lines, too. Then nothing else splits them. The sphere
/// and periodic planes have no such splits.
[[nodiscard]] bool repairs_split_lines(const Settings& settings, const Space& space);

}  // namespace temper
