// The potential of a vertex [length²]: constraints are linear in it, for fixed places.
//
// In the plane it is the weight. On the sphere, constraints on P = p R/σ become linear in σ = R/|P| when multiplied by
// the σ of their vertices. The potential is 2 R² (1 − σ). This is the weight up to a relative difference w/R², so that
// coefficients tend to the plane's for small cells. A factor on all σ changes nothing, as a constant on all weights in
// the plane: a condition is the ratio of a linear function and the mean σ of its edge (constraints.hpp).
#pragma once

#include <cmath>

#include "temper/mesh.hpp"

namespace temper {

/// 1/(2 R²): the decrease of σ per unit of the potential; 0 in the plane.
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

/// The weight whose potential is greater by `change` than the potential of w.
[[nodiscard]] inline double changed_weight(const Space& space, double w, double change) {
  return weight_of_potential(space, potential_of(space, w) + change);
}

/// σ of a vertex with a weight; one in the plane.
[[nodiscard]] inline double scale_at(const Space& space, double w) {
  return 1 - slope_of_scale(space) * potential_of(space, w);
}

/// The place of a vertex on the sphere, whatever its weight.
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v) { return mesh.space().place(mesh.point(v)); }

}  // namespace temper
