// The paper's line search for the position of one vertex (Algorithm 5), by the library's public functions, so that each
// search can be seen: steepest descent, golden section within the patch radius, short of turning a triangle over.
#pragma once

#include <vector>

#include "temper/energy.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper::gallery {

/// The tolerance of a search, relative to its interval: what golden section can tell apart in doubles.
inline constexpr double kSearchTolerance = 1e-8;

/// The root mean square of the distances to v's neighbors, or the greatest or least of them.
[[nodiscard]] double patch_radius(const Mesh& mesh, VertexId v, SearchRadius which = SearchRadius::rms);

struct LineSearch {
  Vec2 from, to;
  double part = 0;  ///< of the interval that was searched; 1: stopped by its end, not at a minimum
};

/// The paper's three searches, one after the other, each from where the last one ended; fewer when the energy falls no
/// more.
[[nodiscard]] std::vector<LineSearch> line_searches(Mesh mesh, const EnergyModel& model, VertexId v,
                                                    SearchRadius radius = SearchRadius::rms);

}  // namespace temper::gallery
