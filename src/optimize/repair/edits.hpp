// Edits that might cure the bad triangles of a neighbourhood: those worth a trial, those that change least first.
#pragma once

#include <vector>

#include "base/rng.hpp"
#include "optimize/repair/trial.hpp"

namespace temper {

/// The edits in tiers; a tier is tried when none of the one before helps. Sweeps alone and kicks, which keep every
/// vertex; with `weighs` then weights by a linear programme. With `vertices` also: one vertex less near a bad triangle,
/// or one more in its middle, at its orthocenter or on an edge; then as many more as are missing; then all of them
/// anew. Fixed, boundary and constrained vertices stay.
[[nodiscard]] std::vector<std::vector<Edit>> edits_for(const Neighborhood& around, bool weighs, bool vertices,
                                                       Rng& rng);

}  // namespace temper
