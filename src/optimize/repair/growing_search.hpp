// Repairs that change as little as possible: they make each place good with the fewest rings of triangles around it.
//
//   for each number of rings
//     for each triangle that violates the criterion
//       try on a copy of that many rings, and take the first that leaves fewer violations:
//         weights by a linear program      positions stay
//         sweeps, from perturbed places    the vertices stay
//         new and removed vertices         if the options allow them
//
// The order is that of the triangles, so that the result does not depend on threads. An edit counts only what the whole
// mesh has there, and so the number of violations of the mesh falls with each change.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/rng.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/repair/trial.hpp"
#include "optimize/run/run.hpp"

namespace temper {

class GrowingSearch {
 public:
  /// `seed`: of all random choices.
  GrowingSearch(WorkingCopy& work, Run& run, Flipper& flipper, std::uint64_t seed)
      : work_(work), settings_(flipper.settings()), run_(run), flipper_(flipper), rng_(seed) {}

  /// Goes over all places with one number of rings. It ends early if vertices were removed: the caller must compact
  /// before the next call, which goes on with the same rings. Returns false if nothing was left to try.
  bool improve();

 private:
  void improve_place(TriangleId seed);
  [[nodiscard]] std::optional<Edit> choose(const Neighborhood& around);
  [[nodiscard]] std::vector<std::vector<Edit>> tiers_for(const Neighborhood& around);

  WorkingCopy& work_;
  const Settings& settings_;
  Run& run_;
  Flipper& flipper_;
  Rng rng_;
  std::size_t level_ = 0;  // of the number of rings
};

}  // namespace temper
