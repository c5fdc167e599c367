// Flips of edges in space, where the dual of an edge is negative.
#pragma once

#include <cstddef>

#include "surfaces/optimize/closest_point.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// The limits of flips.
struct FlipRules {
  const ClosestPoints& input;
  double most_distance = 0;  ///< Largest distance of the new triangles from the input surface
};

/// The largest distance between a triangle and a surface, at its center and the midpoints of its edges.
[[nodiscard]] double distance_of(const ClosestPoints& surface, Vec3 a, Vec3 b, Vec3 c);

/// Flips edges whose dual is negative, the least first, if the dual of the new edge is larger. The new triangles have
/// nearly the normals of the old ones, no edge twice, and keep the rules. Returns the number of flips.
std::size_t flip_negative_duals(SurfaceMesh& mesh, const FlipRules& rules);

}  // namespace temper::surfaces
