#include "optimize/sweep/insertion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimize/flips/guard.hpp"
#include "optimize/step/insertion_place.hpp"
#include "optimize/step/removal.hpp"
#include "temper/detail/geometry.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

double own_energy(const Mesh& mesh, const EnergyModel& model, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return triangle_energy(model, a, b, c);
}

/// Returns the mean of the finite magnitudes; E_F may be negative.
double mean_energy(const Mesh& mesh, const EnergyModel& model) {
  double sum = 0;
  std::size_t n = 0;
  for (const TriangleId t : mesh.triangles()) {
    const double energy = std::abs(own_energy(mesh, model, t));
    if (std::isfinite(energy)) sum += energy, ++n;
  }
  return n == 0 ? 0 : sum / static_cast<double>(n);
}

InsertionPlan plan_in(const Mesh& mesh, const WorkingUnits& units, InsertionPlace place, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  const Vec2 p = units.snap(insertion_point(mesh.space(), place, a, b, c).position());
  const Location at = std::isfinite(p.x) && std::isfinite(p.y) ? locate(mesh, p, t) : Location();
  if (at.kind != Location::Kind::in_triangle) return {};
  return plan_insertion(mesh, {p.x, p.y, interpolated_weight(mesh, at.triangle, p)}, at.triangle);
}

}  // namespace

bool insert_where_energy_is_large(WorkingCopy& work, Flipper& flipper, const Settings& settings,
                                  const EnergyModel& model) {
  const Mesh& mesh = work.mesh;
  const double limit = settings.policy.insertion_ratio * mean_energy(mesh, model);
  std::vector<std::pair<double, TriangleId>> large;
  for (const TriangleId t : mesh.triangles()) {
    if (const double energy = own_energy(mesh, model, t); energy > limit) large.emplace_back(energy, t);
  }
  std::stable_sort(large.begin(), large.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Guard guard(mesh, work.units, settings.guard);
  bool inserted = false;
  for (const auto& [energy_before, t] : large) {
    if (!(own_energy(mesh, model, t) > limit)) continue;  // earlier insertions may have changed it
    const InsertionPlan plan = plan_in(mesh, work.units, settings.policy.insertion_place, t);
    if (plan.status != InsertionStatus::possible) continue;
    const PatchComparison e = compare_patch(mesh, model, plan, settings.policy.removal_measure);
    if (!is_better(e.with, e.without, settings.policy.removal_margin)) continue;
    if (!guard.allows(plan)) continue;
    flipper.commit(work, plan, e.without, e.with);
    guard.grow();
    inserted = true;
  }
  return inserted;
}

}  // namespace temper
