// Positions and weights by line searches whose reach in the weight can be chosen, sweep by sweep with deferred flips:
// figures 23 and 25.
//
// The paper's greatest search distance is the patch radius, a length; weights are lengths squared, and it does not say
// which square. The optimiser takes the mean square distance to the neighbours, r². How far a search may reach decides
// whether it leaves a local minimum for the unbounded side.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/oscillating_horseshoe.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

struct SearchLoop {
  EnergyKind energy = EnergyKind::dT;
  double weight_reach = 1;          ///< greatest change of a weight in one search, over r²
  bool limited = false;             ///< searches stop after the next flip: overshoot 1.1, 1.01, …
  bool positions = true;            ///< false: weights alone
  bool all_positions_first = true;  ///< all positions, then all weights; else both vertex by vertex
};

/// A mesh of the run.
struct LoopStage {
  std::string name;  ///< "weights 1": after the first sweep over the weights
  Mesh mesh;
  double energy = 0;
  std::size_t inverted = 0;     ///< triangles
  std::size_t non_regular = 0;  ///< edges
  double largest_weight = 0;
  std::size_t hidden_inside = 0, hidden_on_boundary = 0;  ///< after flips: vertices without a power cell
};

/// The stages of up to so many sweeps; it ends with the first in which a triangle is inverted, for flips cannot make
/// such a mesh regular, and one more sweep to show where that leads.
[[nodiscard]] std::vector<LoopStage> run_loop(const SearchLoop& loop, const Mesh& start, const VertexOrder& order,
                                              int sweeps);

}  // namespace temper::gallery
