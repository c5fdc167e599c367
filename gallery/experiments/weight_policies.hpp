// Weights alone over the oscillating horseshoe, E_∂T ★1 (§6.6.2): weights and flips at once or deferred to the end of
// the sweep, weights unlimited or stopped before or after the next flip.
//
// Each run takes the same number of sweeps whether or not its energy falls: the paper's stopping rule would end an
// oscillation at the first rise. Vertices that the weights hide are removed where the domain keeps its shape.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/oscillating_horseshoe.hpp"
#include "temper/optimize.hpp"

namespace temper::gallery {

struct WeightPolicy {
  std::string limit_name, update_name;  ///< row and column of figure 23
  FlipLimit limit = FlipLimit::after;
  Updates weights = Updates::immediate;
  Flips flips = Flips::immediate;
};

/// Row by row as in figure 23: unlimited, before, after; in each immediate, deferred flips, deferred weights and flips.
[[nodiscard]] std::vector<WeightPolicy> weight_policies();
inline constexpr std::size_t kPolicyColumns = 3;
inline constexpr FlipLimit kPolicyRows[] = {FlipLimit::unlimited, FlipLimit::before, FlipLimit::after};

/// What the paper leaves open: how far a search for a weight reaches, over r², the mean square distance to the
/// neighbors; and whether it is E_∂T that is lowered, as the captions say, or "the normalized energy" of the text.
struct WeightReading {
  double reach = 1;
  EnergyKind energy = EnergyKind::dT;
  friend bool operator<(const WeightReading& a, const WeightReading& b) {
    return std::pair(a.reach, a.energy) < std::pair(b.reach, b.energy);
  }
};
inline constexpr WeightReading kFarSearches{4, EnergyKind::dT}, kNormalized{1, EnergyKind::ndT};

struct PolicyRun {
  WeightPolicy policy;
  std::vector<double> energies;  ///< of the start and after each sweep, flips done
  Mesh end;
  std::vector<VertexId> vertices;  ///< of `end`: numbers in the start
  std::size_t flips = 0;
  std::map<VertexId, std::size_t>
      flips_by_vertex;  ///< flips that follow a change of the vertex's weight, by its number
  /// Flips that bring back an edge that a flip had taken away, by that vertex, too.
  std::map<VertexId, std::size_t> flips_back_by_vertex;
  std::size_t hidden_inside = 0, hidden_on_boundary = 0;
  std::size_t rises = 0;  ///< sweeps after which the energy was higher
  double reversals = 0;   ///< part of all weight changes that undo some of the vertex's last one
  int settled = 0;        ///< first sweep from which on the energy stays within kSettled of its last value, relative
  static constexpr double kSettled = 1e-3;
  [[nodiscard]] double energy() const { return energies.back(); }
  [[nodiscard]] double least() const { return *std::min_element(energies.begin(), energies.end()); }
};

/// One policy from a mesh.
[[nodiscard]] PolicyRun run_policy(const WeightPolicy& policy, const Mesh& start, const VertexOrder& order, int sweeps,
                                   const WeightReading& reading = {});

/// All nine from oscillating_mesh(), one vertex order, as many sweeps as in figure 24.
[[nodiscard]] std::vector<PolicyRun> run_policies(const VertexOrder& order, const WeightReading& reading = {});

/// Those of figures 23 and 24: in the order of the run that led to the start. Computed once for each reading.
[[nodiscard]] const std::vector<PolicyRun>& policy_runs(const WeightReading& reading = {});

/// One of the nine, by its place in figure 23.
[[nodiscard]] const PolicyRun& policy_run(const std::vector<PolicyRun>& runs, FlipLimit limit, std::size_t column);

/// The optimizer's options for the first sweep of a policy.
[[nodiscard]] OptimizeOptions policy_options(const WeightPolicy& policy, const VertexOrder& order);

}  // namespace temper::gallery
