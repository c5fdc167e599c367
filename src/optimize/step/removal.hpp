// Tests for the removal of a vertex: the paper's short-edge rule (Algorithm 2), patch test (Algorithm 1, line 15) and,
// of §7, its weight; and the patch test of a new one. They only ask; others commit.
#pragma once

#include "energy/patch.hpp"
#include "temper/energy.hpp"
#include "temper/optimize.hpp"
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

/// Lines 3 to 5 of Algorithm 2: does the position that is best by E_c come nearer to a vertex of the link than
/// `collapse_ratio` times the shorter of that one's two link edges? The patch is closed and gathered with what E_c
/// needs.
[[nodiscard]] bool nearly_collapses(const Patch& patch, const EnergyModel& collapse_model, const WeightedPoint& p,
                                    const PaperSwitches& switches);

/// How far the weight of p is below the mean of its neighbors', relative to R², the mean squared length of the spokes.
[[nodiscard]] double relative_lightness(const Patch& patch, const WeightedPoint& p);

/// The energies of P and of P∖p, as `measure` compares them.
struct PatchComparison {
  double with = 0, without = 0;
};
/// Says whether an energy is better than what it is now, by at least `margin` relative to that.
[[nodiscard]] bool is_better(double energy, double now, double margin);
[[nodiscard]] PatchComparison compare_patch(const Mesh& mesh, const Patch& patch, const EnergyModel& model,
                                            const RemovalPlan& plan, RemovalMeasure measure);
/// The same of a vertex that is not there yet.
[[nodiscard]] PatchComparison compare_patch(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan,
                                            RemovalMeasure measure);

}  // namespace temper
