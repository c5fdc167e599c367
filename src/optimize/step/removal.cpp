#include "optimize/step/removal.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "optimize/step/cavity.hpp"
#include "optimize/step/line_search.hpp"

namespace temper {
namespace {

/// The energy of an equilateral triangle of that doubled area, weights zero.
double equilateral_energy(const EnergyModel& model, double doubled_area) {
  const double side = std::sqrt(2 * std::abs(doubled_area) / std::sqrt(3.0));
  return triangle_energy(model, {0, 0, 0}, {side, 0, 0}, {side / 2, side * std::sqrt(3.0) / 2, 0});
}

/// The point of least E_c that three line searches find.
WeightedPoint best_position(const Patch& patch, const EnergyModel& model, WeightedPoint p, Inversion inversion) {
  const Freedom plane{2, {{{1, 0, 0}, {0, 1, 0}, {}}}};
  for (int i = 0; i < kPositionSearches; ++i) {
    const double energy = patch_energy(patch, model, p);
    const auto direction = steepest_descent(patch, model, p, plane, patch_radius(patch, p));
    if (!direction) break;
    const double limit = inversion == Inversion::allow ? 1 : inversion_limit(patch, p, *direction);
    const WeightedPoint there = along(p, *direction, line_minimum(patch, model, p, *direction, limit));
    if (!(patch_energy(patch, model, there) < energy)) break;
    p = there;
  }
  return p;
}

}  // namespace

bool nearly_collapses(const Patch& patch, const EnergyModel& collapse_model, const WeightedPoint& p, double ratio,
                      Inversion inversion) {
  TEMPER_ASSERT(patch.closed && (!needs_outer(collapse_model.kind) || patch.outer_g.size() == patch.size()));
  const Vec2 best = best_position(patch, collapse_model, p, inversion).position();
  const std::size_t n = patch.link.size();
  std::size_t nearest = 0;
  const auto distance2 = [&](std::size_t i) { return squared_length(patch.q(i).position() - best); };
  for (std::size_t i = 1; i < n; ++i) {
    if (distance2(i) < distance2(nearest)) nearest = i;
  }
  const Vec2 q = patch.q(nearest).position();
  const Vec2 before = patch.q((nearest + n - 1) % n).position(), after = patch.q((nearest + 1) % n).position();
  const double shorter2 = std::min(squared_length(before - q), squared_length(after - q));
  return distance2(nearest) < ratio * ratio * shorter2;
}

bool PatchComparison::better_without(double margin) const {
  return without < with - margin * std::abs(with) && std::isfinite(without);
}

PatchComparison compare_patch(const Mesh& mesh, const Patch& patch, const EnergyModel& model, const RemovalPlan& plan,
                              RemovalMeasure measure) {
  const WeightedPoint p = mesh.point(patch.center);
  PatchComparison e{patch_energy(patch, model, p), cavity_energy(mesh, model, plan)};
  if (measure == RemovalMeasure::mean) {
    e.with /= static_cast<double>(patch.size());
    e.without /= static_cast<double>(plan.triangles.size());
  }
  if (measure == RemovalMeasure::excess) {
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const Vec2 q = patch.q(i).position(), r = patch.r(i).position();
      e.with -= equilateral_energy(model, cross(q - p.position(), r - p.position()));
    }
    for (const auto& [a, b, c] : plan.triangles) {
      const Vec2 o = mesh.position(a);
      e.without -= equilateral_energy(model, cross(mesh.position(b) - o, mesh.position(c) - o));
    }
  }
  return e;
}

}  // namespace temper
