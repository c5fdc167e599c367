#include "optimize/step/removal.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "geometry/triangle_kernel.hpp"
#include "optimize/step/cavity.hpp"
#include "optimize/step/line_search.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

/// The energy of an equilateral triangle of that doubled area, weights zero.
double equilateral_energy(const EnergyModel& model, double doubled_area) {
  const double side = std::sqrt(2 * std::abs(doubled_area) / std::sqrt(3.0));
  return triangle_energy(model, {0, 0, 0}, {side, 0, 0}, {side / 2, side * std::sqrt(3.0) / 2, 0});
}

/// Triangles, and the energy of as many equilateral ones of the same areas.
struct Ideal {
  std::size_t n = 0;
  double energy = 0;
  void add(const EnergyModel& model, const Space& space, const WeightedPoint& a, const WeightedPoint& b,
           const WeightedPoint& c) {
    ++n;
    const double area = space.is_plane() ? doubled_area(a.position(), b.position(), c.position())
                                         : triangle_shape(space, a, b, c).doubled_area;
    energy += equilateral_energy(model, area);
  }
};

double measured(double energy, const Ideal& ideal, RemovalMeasure measure) {
  switch (measure) {
    case RemovalMeasure::sum:
      return energy;
    case RemovalMeasure::mean:
      return energy / static_cast<double>(ideal.n);
    case RemovalMeasure::excess:
      return energy - ideal.energy;
  }
  return energy;
}

/// The point of least E_c that three line searches find.
WeightedPoint best_position(const Patch& patch, const EnergyModel& model, WeightedPoint p,
                            const PaperSwitches& switches) {
  const Freedom plane{2, {{{1, 0, 0}, {0, 1, 0}, {}}}};
  for (int i = 0; i < kPositionSearches; ++i) {
    const double energy = patch_energy(patch, model, p);
    const auto direction = steepest_descent(patch, model, p, plane, patch_radius(patch, p, switches.search_radius));
    if (!direction) break;
    const double limit = switches.inversion == Inversion::refuse ? inversion_limit(patch, p, *direction) : 1;
    const WeightedPoint there = along(patch.space, p, *direction, line_minimum(patch, model, p, *direction, limit));
    if (!(patch_energy(patch, model, there) < energy)) break;
    p = there;
  }
  return p;
}

}  // namespace

double relative_lightness(const Patch& patch, const WeightedPoint& p) {
  double sum = 0;
  for (std::size_t i = 0; i < patch.link.size(); ++i) sum += patch.space.weight(patch.q(i));
  const double r = patch_radius(patch, p);
  return (sum / static_cast<double>(patch.link.size()) - patch.space.weight(p)) / (r * r);
}

bool nearly_collapses(const Patch& patch, const EnergyModel& collapse_model, const WeightedPoint& p,
                      const PaperSwitches& switches) {
  TEMPER_ASSERT(patch.closed && (!needs_outer(collapse_model.kind) || patch.outer_g.size() == patch.size()));
  const WeightedPoint best = best_position(patch, collapse_model, p, switches);
  const std::size_t n = patch.link.size();
  std::size_t nearest = 0;
  const auto between2 = [&](const WeightedPoint& a, const WeightedPoint& b) {
    return edge_measures(patch.space, a, b).l2;
  };
  const auto distance2 = [&](std::size_t i) { return between2(best, patch.q(i)); };
  for (std::size_t i = 1; i < n; ++i) {
    if (distance2(i) < distance2(nearest)) nearest = i;
  }
  const WeightedPoint q = patch.q(nearest);
  const double shorter2 =
      std::min(between2(q, patch.q((nearest + n - 1) % n)), between2(q, patch.q((nearest + 1) % n)));
  return distance2(nearest) < switches.collapse_ratio * switches.collapse_ratio * shorter2;
}

bool PatchComparison::better_without(double margin) const {
  return without < with - margin * std::abs(with) && std::isfinite(without);
}

bool PatchComparison::better_with(double margin) const { return PatchComparison{without, with}.better_without(margin); }

PatchComparison compare_patch(const Mesh& mesh, const Patch& patch, const EnergyModel& model, const RemovalPlan& plan,
                              RemovalMeasure measure) {
  const WeightedPoint p = mesh.point(patch.center);
  Ideal with, without;
  for (std::size_t i = 0; i < patch.size(); ++i) with.add(model, mesh.space(), p, patch.q(i), patch.r(i));
  for (const auto& [i, j, k] : plan.triangles) {
    const auto [a, b, c] = mesh.points(i, j, k);
    without.add(model, mesh.space(), a, b, c);
  }
  return {measured(patch_energy(patch, model, p), with, measure),
          measured(cavity_energy(mesh, model, plan), without, measure)};
}

PatchComparison compare_patch(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan,
                              RemovalMeasure measure) {
  Ideal with, without;
  for (std::size_t i = 0; i < plan.rim.size(); ++i) {
    with.add(model, mesh.space(), plan.point, mesh.point(plan.link[i], plan.point),
             mesh.point(plan.link[(i + 1) % plan.link.size()], plan.point));
  }
  for (const TriangleId t : plan.cavity) {
    const auto [a, b, c] = mesh.points(t);
    without.add(model, mesh.space(), a, b, c);
  }
  return {measured(insertion_energy(mesh, model, plan), with, measure),
          measured(replaced_energy(mesh, model, plan), without, measure)};
}

}  // namespace temper
