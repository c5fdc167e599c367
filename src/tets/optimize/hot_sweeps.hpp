// Sweeps that lower a HOT energy F. They begin where the sweeps of the pseudo-barrier E and the repairs end, and keep
// the connectivity. F has no barrier: vertices may meet, and weights have no bound. So the sweeps lower
//
//     F + κ E
//
// at a small γ, where κ is a part of the mean volume^(5/3), the unit of F. A tetrahedron whose orthocenter is inside
// stays so, by exact predicates. One that is bad stays as it is, with its corners.
#pragma once

#include "tets/energy/hot.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {

class HotSweeps {
 public:
  HotSweeps(TetMesh& mesh, IdVector<VertexId, Mobility> mobility, const HotEnergy& energy, double relaxation,
            Executor* executor);
  /// Returns false if it was stopped.
  bool sweep(const MustStop& must_stop);

 private:
  /// The memory that the steps of one task share.
  struct Room {
    std::vector<LinkLanes> link;
    HotStar hot;
  };
  [[nodiscard]] WeightedPoint improved(VertexId v, std::span<const HalffaceId> link, Room& room);

  TetMesh& mesh_;
  IdVector<VertexId, Mobility> mobility_;
  HotEnergy energy_;
  double relaxation_;
  double barrier_;  // κ
  Sweeper sweeper_;
};

}  // namespace temper::tets
