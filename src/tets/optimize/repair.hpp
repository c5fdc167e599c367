// Changes of connectivity at bad tetrahedra, between sweeps.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tets/optimize/newton_step.hpp"
#include "tets/topology/cavity.hpp"

namespace temper::tets {

// A new vertex may raise the excess of its cavity by this much: the vertices around it have not yet made room for it.
// On 5 public meshes 10 leaves bad tetrahedra that 20 makes good, and 100 inserts three times the vertices.
inline constexpr double kAllowance = 20, kAllowanceOfTrial = 40;

struct RepairOptions {
  double allowance = kAllowance;
  std::size_t rank = 0;                  ///< Place of the candidate that is taken at a tetrahedron; 0 is the best
  std::function<bool()> must_stop = {};  ///< Called often
};

/// A cone for each bad tetrahedron, if one lowers the excess: the energy beyond the energy of regular tetrahedra, so
/// that their number does not count. The cones share no tetrahedron; the largest gain comes first.
[[nodiscard]] std::vector<Filling> repairs(const TetMesh& mesh, const std::vector<TetId>& bad,
                                           const IdVector<VertexId, Mobility>& mobility, const RepairOptions& options);

}  // namespace temper::tets
