// Changes of connectivity at bad tetrahedra, between sweeps.
#pragma once

#include <cstddef>
#include <vector>

#include "tets/optimize/draft.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {

// A new vertex may raise the excess of its cavity by this much: the vertices around it have not yet made room for it.
// On 5 public meshes 10 leaves bad tetrahedra that 20 makes good, and 100 inserts three times the vertices.
inline constexpr double kAllowance = 20;

struct RepairOptions {
  double allowance = kAllowance;
  std::size_t rank = 0;         ///< Place of the candidate that is taken at a tetrahedron; 0 is the best
  bool split_boundary = false;  ///< Faces and edges that stay may be split
};

/// A cone for each tetrahedron, if one lowers the excess: the energy beyond the energy of regular tetrahedra, so that
/// their number does not count. The cones share no tetrahedron; the largest gain comes first. must_stop is called
/// often; the result is empty if it says yes.
[[nodiscard]] std::vector<Filling> repairs(const Draft& draft, const std::vector<TetId>& tetrahedra,
                                           const RepairOptions& options, const MustStop& must_stop);

/// Splits edges of the boundary and of interfaces that have negative coefficients, at their midpoints, the worst first.
/// The pieces share no tetrahedron. False: there was none.
bool split_violated_edges(Draft& draft, Executor* executor);

}  // namespace temper::tets
