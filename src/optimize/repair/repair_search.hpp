// Local search where sweeps alone leave triangles that are not well-centered.
//
// Inside the well-centered set no edge can flip: h > 0 on both sides of it, so each connectivity is an island, and
// sweeps, which go downhill, do not leave the one they are on. A repair takes a few rings around a bad triangle,
// planned every edit that might help on a copy of them (trial.hpp), and does the best one to the mesh. When none helps,
// now and then one that does no harm is done, so that the next try begins elsewhere.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "base/rng.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/repair/trial.hpp"
#include "optimize/run/run.hpp"

namespace temper {

class RepairSearch {
 public:
  /// `seed`: of all that is random. `asks_programs`: linear ones, for weights of places that nothing else cures.
  RepairSearch(WorkingCopy& work, const Settings& settings, Run& run, Flipper& flipper, const Recorder& recorder,
               std::uint64_t seed, bool asks_programs)
      : work_(work),
        settings_(settings),
        run_(run),
        flipper_(flipper),
        recorder_(recorder),
        rng_(seed),
        asks_programs_(asks_programs) {}

  /// Changes the mesh in one place: never to more bad triangles. False when none is left, none can be cured, or it was
  /// asked to stop. Removed vertices stay isolated until the caller compacts, which it must before the next call.
  bool improve_one_place();
  /// The triangles of that place as it is now; none given: they and others have new numbers.
  [[nodiscard]] const std::optional<std::vector<TriangleId>>& changed() const { return changed_; }

 private:
  struct Tried {
    Edit edit;
    LocalDefect defect;
  };
  [[nodiscard]] bool assigns_weights(TriangleId seed) const;
  std::optional<Edit> choose(const Neighborhood& around, TriangleId seed);
  std::optional<Edit> sideways(std::vector<Tried> tried, LocalDefect before);
  void find_bad();
  [[nodiscard]] bool is_changed(TriangleId t) const {
    return std::binary_search(changed_->begin(), changed_->end(), t);
  }

  WorkingCopy& work_;
  const Settings& settings_;
  Run& run_;
  Flipper& flipper_;
  const Recorder& recorder_;
  Rng rng_;
  const bool asks_programs_;
  int failures_ = 0;                 // places without an edit that helps, since the last one with
  std::vector<TriangleId> weighed_;  // in vain, as their places are: a linear program takes long
  std::vector<TriangleId> bad_;      // when `changed_` was still to come
  std::optional<std::vector<TriangleId>> changed_;
};

/// Says whether these options ask for repairs, and leave room for them.
[[nodiscard]] bool repairs(const Settings& settings);

}  // namespace temper
