// A mesh that nobody reads, in little memory: 26 bytes per vertex in place of 80 if it has no weights and is in the
// order of a Hilbert curve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

class FoldedMesh {
 public:
  FoldedMesh() = default;
  /// Precondition: no triangle is erased.
  explicit FoldedMesh(const Mesh& mesh);

  /// Returns the mesh. Precondition: its vertices have the halfedges of Mesh::repair_outgoing.
  [[nodiscard]] Mesh unfold(Executor* executor) const;

 private:
  /// Appends an integer of few bits in few bytes: seven bits in each, with a flag if another byte follows.
  void put(std::int64_t value);
  [[nodiscard]] std::int64_t get(std::size_t& at) const;

  Space space_;
  std::size_t n_triangles_ = 0;
  std::vector<Vec2> places_;
  std::vector<double> thirds_;         // the third number of each vertex; empty if all are 0
  std::vector<std::uint8_t> corners_;  // each as the difference from one before
  std::vector<VertexId> fixed_, frozen_;
  std::vector<HalfedgeId> constrained_, diagonals_, faces_, joints_;
  std::vector<std::int32_t> regions_;  // empty if all are 0
};

}  // namespace temper
