// Flips of edges in space, where the dual of an edge is negative.
#pragma once

#include <cstddef>

#include "surfaces/optimize/draft.hpp"
#include "surfaces/optimize/nearness.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// Flips edges whose dual is negative, the least first, if the dual of the new edge is larger. The new triangles have
/// nearly the normals of the old ones, no edge twice, turn less than the limit, and are near the input. Returns the
/// number of flips.
std::size_t flip_negative_duals(SurfaceMesh& mesh, const Nearness& nearness, const TurnLimit& limit);

}  // namespace temper::surfaces
