#include "optimize/step/vertex_removal.hpp"

#include <utility>

#include "optimize/step/removal.hpp"

namespace temper {

bool VertexRemoval::collapse(VertexId v) {
  const EnergyModel& model = settings.collapse_model;
  gather_patch(mesh, v, needs_outer(model.kind), collapsing_);
  if (!nearly_collapses(collapsing_, model, mesh.point(v), settings.policy)) return false;
  plan_ = plan_removal(mesh, v, std::move(plan_));
  if (plan_.status != RemovalStatus::possible || !is_allowed()) return false;
  flipper_.remove(EventKind::collapse, plan_, patch_energy(collapsing_, model, mesh.point(v)),
                  cavity_energy(mesh, model, plan_));
  return true;
}

void VertexRemoval::remove_if_better(VertexId v, const Patch& patch) {
  const Policy& o = settings.policy;
  const bool by_weight = o.removal == Removal::weight;
  if (by_weight && !(relative_lightness(patch, mesh.point(v)) > o.hidden_threshold)) return;
  plan_ = plan_removal(mesh, v, std::move(plan_));
  if (plan_.status != RemovalStatus::possible) return;
  const PatchComparison e = compare_patch(mesh, patch, state.model, plan_, o.removal_measure);
  if (!by_weight && !is_better(e.without, e.with, o.removal_margin)) return;
  if (is_allowed()) flipper_.remove(EventKind::removal, plan_, e.with, e.without);
}

bool VertexRemoval::is_allowed() {
  return (settings.policy.defers_flips() || is_regular(mesh, plan_)) && guard_.allows(plan_);
}

}  // namespace temper
