// What a patch costs once its center is gone: the energy of the triangles that fill the cavity.
#pragma once

#include "temper/energy.hpp"
#include "temper/topology.hpp"

namespace temper {

/// The energy of the plan's triangles with everything that depends on them, so that
/// total(after) − total(before) = cavity_energy(mesh, model, plan) − patch_energy(patch, model, mesh.point(center)).
/// Asked before the removal; interior vertices. O(k²) for k triangles.
[[nodiscard]] double cavity_energy(const Mesh& mesh, const EnergyModel& model, const RemovalPlan& plan);

/// Will all edges of the plan, and the unconstrained ones around it, be regular? Exact. O(k²).
[[nodiscard]] bool is_regular(const Mesh& mesh, const RemovalPlan& plan);

}  // namespace temper
