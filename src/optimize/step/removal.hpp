// Tests for the removal of a vertex. They are the paper's short-edge rule (Algorithm 2), its patch test (Algorithm 1,
// line 15), and its test of the weight in §7. A new vertex has a patch test, too. These tests change nothing.
#pragma once

#include "energy/patch.hpp"
#include "temper/energy.hpp"
#include "temper/optimize.hpp"
#include "temper/topology.hpp"

namespace temper {

/// Returns the energy of the plan's triangles with everything that depends on them, so that total(after) −
/// total(before) = cavity_energy(…) − patch_energy(…). Call it before the removal of an inner vertex. O(k²) for k
/// triangles.
[[nodiscard]] double cavity_energy(const Mesh& mesh, const EnergyModel& model, const RemovalPlan& plan);

/// The energies of the triangles that an insertion or split makes, and of the triangles that it replaces. Everything
/// that depends on them is included: total(after) − total(before) = insertion_energy(…) − replaced_energy(…). Call them
/// before the commit. Outside the domain of a barrier they are +∞. O(k²) for k triangles.
[[nodiscard]] double insertion_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan);
[[nodiscard]] double replaced_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan);

/// Says exactly whether all edges of the plan, and the unconstrained edges around it, will be regular. O(k²).
[[nodiscard]] bool is_regular(const Mesh& mesh, const RemovalPlan& plan);

/// Lines 3 to 5 of Algorithm 2. Says whether the position with the least E_c is too near to a link vertex. The limit is
/// `collapse_ratio` times the shorter link edge there. The patch is closed and gathered for E_c.
[[nodiscard]] bool nearly_collapses(const Patch& patch, const EnergyModel& collapse_model, const WeightedPoint& p,
                                    const PaperSwitches& switches);

/// Returns the mean weight of the neighbors minus the weight of p, over R², the mean squared length of the spokes.
[[nodiscard]] double relative_lightness(const Patch& patch, const WeightedPoint& p);

/// The energies of P and of P∖p, as `measure` compares them.
struct PatchComparison {
  double with = 0, without = 0;
};
/// Says whether `energy` is below `now` by at least `margin`, relative to `now`.
[[nodiscard]] bool is_better(double energy, double now, double margin);
[[nodiscard]] PatchComparison compare_patch(const Mesh& mesh, const Patch& patch, const EnergyModel& model,
                                            const RemovalPlan& plan, RemovalMeasure measure);
/// Compares the patch of a vertex that a plan inserts.
[[nodiscard]] PatchComparison compare_patch(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan,
                                            RemovalMeasure measure);

}  // namespace temper
