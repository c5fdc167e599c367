// The paper's line search for the position of one vertex (Algorithm 5), by the library's public functions, so that each
// search can be seen: steepest descent, golden section within the patch radius, short of turning a triangle over.
#pragma once

#include <vector>

#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

/// The tolerance of a search, relative to its interval: what golden section can tell apart in doubles.
inline constexpr double kSearchTolerance = 1e-8;

/// Root mean square of the distances to v's neighbours.
[[nodiscard]] double patch_radius(const Mesh& mesh, VertexId v);

struct LineSearch {
  Vec2 from, to;
  double part = 0;  ///< of the interval that was searched; 1: stopped by its end, not at a minimum
};

/// So many searches, one after the other, each from where the last one ended; fewer when the energy falls no more.
[[nodiscard]] std::vector<LineSearch> line_searches(Mesh mesh, const EnergyModel& model, VertexId v, int searches = 3);

}  // namespace temper::gallery
