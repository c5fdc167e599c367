// What edges and dual edges stay longer than, for the barrier of the accuracy objective: time steps of explicit schemes
// are as short as the shortest of them.
//
// With s the mean of the local sizes at its ends, an interior edge stays longer than X s, and its dual longer than Y s,
// where they are. What is shorter stays longer than a part of what it is, behind a barrier that is higher from sweep to
// sweep, and so grows. Local sizes are those of the mesh as it is, but no floor falls when they do: else edges and
// sizes chase each other.
#pragma once

#include <cstddef>

#include "energy/accuracy_edge.hpp"
#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

class LengthFloors {
 public:
  /// Raises the floors to what the mesh has now; they never fall. Returns how many of the edges that lack length have
  /// gained since the last call. `sizes`: local ones, of the mesh.
  std::size_t raise(const Mesh& mesh, const IdVector<VertexId, double>& sizes, const AccuracyModel& model,
                    Executor* executor = nullptr);

  /// Of an interior edge.
  [[nodiscard]] const LengthBarrier<double>& operator()(const Mesh& mesh, HalfedgeId h) const {
    return floors_[mesh.is_edge_representative(h) ? h : mesh.twin(h)];
  }

 private:
  IdVector<HalfedgeId, LengthBarrier<double>> floors_;  // at the representative
};

}  // namespace temper
