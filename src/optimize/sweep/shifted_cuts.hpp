// Cuts of a mesh into compact parts, others than by its numbers.
//
//     ┌────┬────┬────┐      The numbers are along a Hilbert curve, a part is a run of them. What lies at its border is
//     │  ┌─┼──┬─┼──┐ │      confined to no part. So more curves are laid through the mesh, on grids that are shifted by
//     ├──┼─┼──┼─┼──┤ │      1/5, 2/5 and 3/5 of its extent. A place is near a line of the grid of one direction, at
//     │  ├─┼──┼─┼──┤ │      whatever level, in one of the four shifts at most (T. M. Chan, "Approximate nearest
//     neighbor └──┴─┴──┴─┴──┘ ┘      queries revisited", 1998), near a line of either in two: it is inside a part of
//     the others.
//
// So nothing is left after three of the four, or little. On a sphere the curves are turned instead, around three axes;
// in a periodic plane they begin elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "optimize/flips/partition.hpp"
#include "temper/detail/executor.hpp"

namespace temper {

class ShiftedCuts {
 public:
  static constexpr std::size_t kCuts = 3;

  /// Each into about `count` parts of about the same size, by the vertices' places now. O(n log count).
  void cut(const Mesh& mesh, std::size_t count, Executor& executor);
  /// Says whether this is of a mesh that has so many vertices; after they were renumbered: call clear().
  [[nodiscard]] bool are_of(const Mesh& mesh) const { return part_of_[0].size() == mesh.n_vertices(); }
  void clear() { part_of_ = {}; }

  [[nodiscard]] std::size_t n_parts() const { return n_parts_; }
  /// Part i of cut k.
  [[nodiscard]] Part part(std::size_t k, std::size_t i) const {
    return {.part_of = part_of_[k].data(), .number = static_cast<PartNumber>(i)};
  }
  [[nodiscard]] std::size_t part_of(std::size_t k, VertexId v) const { return part_of_[k][v.index]; }

 private:
  std::size_t n_parts_ = 0;
  std::array<std::vector<PartNumber>, kCuts> part_of_;  // by each vertex
};

}  // namespace temper
