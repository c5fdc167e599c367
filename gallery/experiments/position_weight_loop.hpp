// Positions, then weights, sweep by sweep with deferred flips, from the mesh that oscillates (figure 25): Algorithm 1
// with all positions first, so that it can be seen what each does. How far a search for a weight reaches decides
// whether it leaves a local minimum for the unbounded side.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/oscillating_horseshoe.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

struct PositionWeightLoop {
  EnergyKind energy = EnergyKind::dT;
  double weight_reach = 1;  ///< greatest change of a weight in one search, over r²
  bool limited = false;     ///< searches stop after the next flip: overshoot 1.1, 1.01, …
};

/// A mesh of the run.
struct LoopStage {
  std::string name;  ///< "positions 1", "weights 1", "flips 1": after that part of the first sweep
  Mesh mesh;
  double energy = 0;
  std::size_t inverted = 0;     ///< triangles
  std::size_t non_regular = 0;  ///< edges; 0 where triangles are inverted
  double largest_weight = 0;
};

/// The stages of up to so many sweeps; it ends with the sweep after which a triangle is inverted, for flips cannot make
/// such a mesh regular.
[[nodiscard]] std::vector<LoopStage> run_loop(const PositionWeightLoop& loop, const Mesh& start,
                                              const VertexOrder& order, int sweeps);

}  // namespace temper::gallery
