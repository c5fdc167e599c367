// The edits that a repair of a place tries.
#pragma once

#include <vector>

#include "base/rng.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/trial.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The changes that the options allow.
struct Allowed {
  bool weights = false;   ///< a linear program may find weights
  bool vertices = false;  ///< insertion and removal
  bool lines = false;     ///< splits of lines
  InsertionPlace place = InsertionPlace::best;
};

/// Returns edits in tiers. A tier is tried if no edit of the tier before helps. The first tier changes least: sweeps
/// alone, and random perturbations, which keep every vertex. If weights are allowed, those of a linear program follow.
/// If vertices are allowed, the next tier removes a vertex near a bad triangle, or inserts one at its centroid, at its
/// orthocenter or on an edge. The next tier inserts all missing vertices, and the last one replaces all. Vertices of
/// the input that are fixed or on lines stay.
[[nodiscard]] std::vector<std::vector<Edit>> edits_for(const Neighborhood& around, const Allowed& allowed, Rng& rng);

/// Returns splits of an edge of a line that must be split, given by its halfedge in the neighborhood: at this part of
/// the way; and of all lines at one of its ends, at the same distance.
[[nodiscard]] std::vector<Edit> splits_of(const Neighborhood& around, HalfedgeId h, double part);

}  // namespace temper
