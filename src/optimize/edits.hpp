// What might cure the bad triangles of a neighbourhood: the edits worth a trial, cheapest first.
#pragma once

#include <vector>

#include "base/rng.hpp"
#include "optimize/trial.hpp"

namespace temper {

/// Sweeps alone and kicks, which keep every vertex; and with `vertices` also: a vertex less near a bad triangle, one
/// more in its middle, at its orthocenter, or on one of its edges. Fixed, boundary and constrained vertices stay.
[[nodiscard]] std::vector<Edit> edits_for(const Neighborhood& around, bool vertices, Rng& rng);

}  // namespace temper
