// The patch test of §6.6.4 on the dense horseshoe: under E_BP a vertex is removed when its patch has less energy
// without it, flips take place at once, collapses by the short-edge rule are off. And what figures 30 and 31 have in
// common.
//
// Left open by the paper and chosen here: vertices in their order as numbered, γ = 1, sums of energies compared, as
// line 15 of Algorithm 1 says.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/recording.hpp"
#include "gallery.hpp"

namespace temper::gallery {

/// By which a vertex may be removed.
enum class RemovalRule { none, short_edge, patch };

/// Flips at once, no step turns a triangle over.
[[nodiscard]] OptimizeOptions immediate_options(Unknowns unknowns, RemovalRule rule);

/// The runs of figure 30 (positions) and 31 (positions and weights), every sweep kept.
[[nodiscard]] const Recording& patch_test_run(Unknowns unknowns);

/// The vertices that a run removed, by iteration from 0, numbered as in the input.
using Removals = std::map<int, std::vector<VertexId>>;
[[nodiscard]] Removals removals(const Recording& run);
[[nodiscard]] std::set<VertexId> all_of(const Removals& removals);
/// Mean iteration; 0 when there are none.
[[nodiscard]] double mean_iteration(const Removals& removals);

/// The removals of each rule with one vertex order.
struct RuleComparison {
  std::string order;
  Removals patch_positions, patch_weights;            ///< the patch test, without and with weights
  Removals short_edge_positions, short_edge_weights;  ///< the short-edge rule
};
[[nodiscard]] const std::vector<RuleComparison>& rule_comparisons(Effort effort);

/// A panel for each iteration that removes vertices, those in red, and the final mesh.
[[nodiscard]] std::string removal_panels(const Recording& run, double weight_scale);
/// Removals by iteration and the mesh before and after.
[[nodiscard]] Table removal_table(const Recording& run);
/// Coarse but of high quality: fewer vertices, better shapes than in the input and than without removals.
[[nodiscard]] Claim coarse_but_good(Unknowns unknowns, const std::string& figure);

}  // namespace temper::gallery
