// The dense horseshoe whose outer iterations oscillate (§6.6.1): positions and collapses under E_∂T ★1, flips deferred
// until the inner iterations have converged.
//
// The paper leaves open in which order vertices are visited; all that were tried oscillate (oscillation_table). Here it
// is from the last to the first, with E_F for collapses, as the caption of figure 19 says.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "experiments/recording.hpp"
#include "gallery.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

/// E_∂T of ★1.
[[nodiscard]] EnergyModel energy_dt();

/// A vertex order by name.
struct VertexOrder {
  std::string name;
  SweepOrder order = SweepOrder::input;
  std::uint64_t seed = 1;
};
/// Makes the sweeps of a run visit the vertices in that order.
inline void visit_in(const VertexOrder& order, OptimizeOptions& options) {
  options.paper.order = order.order;
  options.paper.seed = order.seed;
}
/// As numbered, reverse, along a Hilbert curve, and so many at random.
[[nodiscard]] std::vector<VertexOrder> vertex_orders(int random);

/// The paper's Algorithm 1 with positions and collapses under E_∂T: flips after converged inner iterations, unlimited
/// searches. No step turns a triangle over.
[[nodiscard]] OptimizeOptions positions_and_collapses();

/// The vertex order of the runs that are drawn.
[[nodiscard]] VertexOrder shown_order();

/// The run of figures 19 and 20: outer iterations 0 to 6, every sweep kept.
[[nodiscard]] const Recording& oscillating_run();

/// The mesh at the lower right of figure 20, from which figures 22 to 25 start.
[[nodiscard]] const Mesh& oscillating_mesh();

/// a and b: the vertices left and right of the middle that move most between the last two outer iterations, by their
/// number in the input.
[[nodiscard]] std::array<VertexId, 2> oscillating_vertices();

/// Energies by outer iteration, and whether they end in a cycle: the triangles after flips are those of `period` outer
/// iterations before, for two periods and more.
struct Oscillation {
  std::vector<double> before, after;  ///< flips
  std::size_t period = 0;             ///< the shortest one; 1: converged; 0: no cycle seen
  std::size_t first = 0;              ///< outer iteration at which the cycle begins
  double low = 0, high = 0;           ///< energies after flips over the last period
  std::size_t vertices = 0;           ///< of the last mesh
  std::size_t flipped = 0;            ///< triangles of the last mesh that were not there one outer iteration before
  std::array<Vec2, 2> places_low = {}, places_high = {};  ///< of a and b in the state of less energy and in the other
};
[[nodiscard]] Oscillation oscillation_of(const Recording& run);
/// Says whether the run ends in a cycle of two whose energies are within 5 % of the paper's, 3.41 and 4.08.
[[nodiscard]] bool as_in_the_paper(const Oscillation& oscillation);

/// The experiment with each vertex order and each energy for collapses. Computed once.
struct OrderedRun {
  std::string order, collapse_energy;
  Oscillation oscillation;
};
[[nodiscard]] const std::vector<OrderedRun>& oscillations_by_order(Effort effort);

}  // namespace temper::gallery
