// The paper's line search for the position of one vertex (Algorithm 5), by the library's public functions, so that each
// search can be seen: steepest descent, golden section within the patch radius, short of turning a triangle over.
#pragma once

#include <vector>

#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

struct LineSearch {
  Vec2 from, to;
  bool at_limit = false;  ///< stopped by the end of the interval, not at a minimum
};

/// Energy of the patch of v with v at p; connectivity as it is.
[[nodiscard]] double patch_energy_at(Mesh mesh, const EnergyModel& model, VertexId v, Vec2 p);

/// So many searches, one after the other, each from where the last one ended; fewer when the energy falls no more.
[[nodiscard]] std::vector<LineSearch> line_searches(Mesh mesh, const EnergyModel& model, VertexId v, int searches = 3);

}  // namespace temper::gallery
