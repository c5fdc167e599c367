// Newton steps of one vertex that keep tetrahedra valid, for energies without a wall.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "temper/tets/mesh.hpp"
#include "tets/optimize/newton_step.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {

/// Says exactly whether t is positive, with its orthocenter inside.
inline bool is_good(const TetMesh& mesh, TetId t) {
  const auto [a, b, c, d] = mesh.points(t);
  return orientation(a.position(), b.position(), c.position(), d.position()) == Sign::positive && !is_bad(mesh, t);
}

/// Takes one step of v that lowers the energy of `star`: over-relaxed, then plain, then halved. All tetrahedra between
/// v and its link are good then. Otherwise v stays.
template <class Star>
void take_valid_step(TetMesh& mesh, VertexId v, std::span<const HalffaceId> link, const Star& star,
                     const Mobility& mobility, double radius, double relaxation) {
  constexpr int kTrials = 6;
  constexpr double kRounding = 1e-15;  // a smaller part of the energy is rounding
  const WeightedPoint origin = mesh.point(v);
  const PointDerivatives<double> here = star.derivatives(origin);
  if (!std::isfinite(here.value)) return;
  const auto [step, predicted] = newton_step(here, mobility, radius);
  if (!(predicted > kRounding * here.value)) return;
  double t = relaxation;
  for (int trial = 0; trial < kTrials; ++trial, t = trial == 1 ? 1 : 0.5 * t) {
    WeightedPoint p = {origin.x, origin.y, origin.z, origin.w + t * step.w};  // -0.0 + 0 is another zero
    if (mobility.moves()) p.x += t * step.x, p.y += t * step.y, p.z += t * step.z;
    if (!is_exact(p) || !(star.value(p) < here.value)) continue;
    mesh.set_point(v, p);
    if (std::all_of(link.begin(), link.end(), [&](HalffaceId h) { return is_good(mesh, TetMesh::tetrahedron(h)); }))
      return;
    mesh.set_point(v, origin);
  }
}

}  // namespace temper::tets
