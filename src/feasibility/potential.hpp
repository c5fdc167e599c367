// What the constraints are linear in, for fixed places: the potential of a vertex [length²].
//
// In the plane that is its weight. On the sphere the constraints on P = p R/σ, multiplied by the σ of the vertices that
// they are about, are linear in σ = R/|P|; its potential is 2 R² (1 − σ), the weight but for a part w/R² of it, so that
// coefficients tend to the plane's where cells are small. All σ times a number changes nothing: a condition is the
// ratio of a linear function and the mean σ of its edge (constraints.hpp), where a constant on all weights changes
// nothing in the plane.
#pragma once

#include <cmath>

#include "temper/mesh.hpp"

namespace temper {

/// 1/(2 R²): what a unit of the potential takes from σ; 0 in the plane.
[[nodiscard]] inline double slope_of_scale(const Space& space) {
  return space.is_plane() ? 0 : 0.5 / (space.radius() * space.radius());
}

/// Precondition: on the sphere w > −R².
[[nodiscard]] inline double potential_of(const Space& space, double w) {
  if (space.is_plane()) return w;
  const double root = std::sqrt(1 + w / (space.radius() * space.radius()));  // 1/σ
  return 2 * w / (root * (root + 1));
}

/// Precondition: on the sphere σ > 0.
[[nodiscard]] inline double weight_of_potential(const Space& space, double potential) {
  if (space.is_plane()) return potential;
  const double taken = slope_of_scale(space) * potential, scale = 1 - taken;
  return potential * (1 - 0.5 * taken) / (scale * scale);
}

/// The weight whose potential is more than that of w by so much.
[[nodiscard]] inline double changed_weight(const Space& space, double w, double change) {
  return weight_of_potential(space, potential_of(space, w) + change);
}

/// σ of a vertex with a weight; one in the plane.
[[nodiscard]] inline double scale_at(const Space& space, double w) {
  return 1 - slope_of_scale(space) * potential_of(space, w);
}

/// Where a vertex is on the sphere, whatever its weight.
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v) { return mesh.space().place(mesh.point(v)); }

}  // namespace temper
