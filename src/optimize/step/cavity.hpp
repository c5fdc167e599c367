// Prices of plans before they are committed: the energy of the triangles that fill a removed vertex's cavity, or that
// surround an inserted one.
#pragma once

#include "temper/energy.hpp"
#include "temper/topology.hpp"

namespace temper {

/// The energy of the plan's triangles with everything that depends on them, so that
/// total(after) − total(before) = cavity_energy(mesh, model, plan) − patch_energy(patch, model, mesh.point(center)).
/// Asked before the removal; interior vertices. O(k²) for k triangles.
[[nodiscard]] double cavity_energy(const Mesh& mesh, const EnergyModel& model, const RemovalPlan& plan);

/// The energy of the new triangles of an insertion or a split, and of those that they replace, with everything that
/// depends on them: total(after) − total(before) = insertion_energy(…) − replaced_energy(…). Asked before the commit.
/// +∞ outside the domain of a barrier. O(k²) for k triangles.
[[nodiscard]] double insertion_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan);
[[nodiscard]] double replaced_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan);

/// Will all edges of the plan, and the unconstrained ones around it, be regular? Exact. O(k²).
[[nodiscard]] bool is_regular(const Mesh& mesh, const RemovalPlan& plan);

}  // namespace temper
