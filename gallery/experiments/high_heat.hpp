// The high-heat run of §6.6.3: the dense horseshoe under a barrier, with collapses by E_F from iteration 0, positions,
// weights from iteration 40, flips after the inner iterations have converged, outer iterations until none are needed.
//
// Left open by the paper and chosen here: vertices in their order as numbered, vertex 0 as anchor, γ = 1 (which it
// uses for figure 9 and 16), and for E_BHs the least −h° that the input allows with a quarter to spare.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/recording.hpp"
#include "experiments/short_edge.hpp"
#include "gallery.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

/// The options of the run. "BP" or "BHs".
[[nodiscard]] OptimizeOptions high_heat_options(std::string_view energy);

/// The run under E_BP, every sweep kept, and under E_BHs, its outer iterations.
[[nodiscard]] const Recording& high_heat_bp();
[[nodiscard]] const Recording& high_heat_bhs();

/// The meshes of the former before and after the flips of its outer iterations, and those that the paper shows.
[[nodiscard]] std::vector<const Moment*> high_heat_optimal();
[[nodiscard]] std::vector<const Moment*> high_heat_flipped();
inline constexpr std::size_t kShownOuter[] = {0, 1, 5};

/// A collapse of a run.
struct CollapseEvent {
  int sweep = 0;
  int outer = 0;        ///< outer iteration
  int since_flips = 0;  ///< sweeps of that outer iteration, this one included
  VertexId vertex;      ///< number in the input
  std::size_t event = 0;
};
[[nodiscard]] std::vector<CollapseEvent> collapses(const Recording& run);
/// The number of collapses in each outer iteration, to the last.
[[nodiscard]] std::vector<std::size_t> collapses_by_outer(const Recording& run);

/// The same run under E_BP with another vertex order.
struct OrderedHeat {
  std::string order;
  std::vector<std::size_t> collapses;  ///< by outer iteration
  std::vector<Mesh> optimal;           ///< at the end of each outer iteration, before flips
};
/// As numbered and in reverse; with full effort also along a Hilbert curve and at random. Each at most `kSurveySweeps`
/// sweeps.
inline constexpr int kSurveySweeps = 600;
[[nodiscard]] const std::vector<OrderedHeat>& high_heat_by_order(Effort effort);

/// The short-edge rule on the mesh in the instant before a collapse; `nearest` numbered as in the input.
[[nodiscard]] ShortEdge rule_before(const Recording& run, const CollapseEvent& collapse);

/// "4, 2, 0".
[[nodiscard]] std::string listed(const std::vector<std::size_t>& counts);

}  // namespace temper::gallery
