// Eight tetrahedra side by side, for kernels of all instruction sets.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/pack.hpp"
#include "temper/tets/mesh.hpp"
#include "tets/energy/matrix.hpp"

namespace temper::tets {

// Plain arrays, since the code that uses them is compiled for several instruction sets.

/// A coordinate: one value for each lane.
using Lane = double[kLanes];

struct LanePoints {
  Lane x, y, z, w;
  void set(std::size_t lane, const WeightedPoint& p) { x[lane] = p.x, y[lane] = p.y, z[lane] = p.z, w[lane] = p.w; }
  [[nodiscard]] WeightedPoint at(std::size_t lane) const { return {x[lane], y[lane], z[lane], w[lane]}; }
};

/// Eight tetrahedra. Lanes that are not used repeat others.
struct alignas(64) TetLanes {
  LanePoints corners[4];
};

/// The tetrahedra from `first` on, at most to the one before `last`.
inline TetLanes lanes_of(const TetMesh& mesh, std::size_t first, std::size_t last) {
  TetLanes lanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto points = mesh.points(TetId(std::min(first + lane, last - 1)));
    for (std::size_t k = 0; k < 4; ++k) lanes.corners[k].set(lane, points[k]);
  }
  return lanes;
}

template <class Pack>
TEMPER_INLINE PointVector<Pack> load(const LanePoints& p) {
  return {{Pack::load(p.x), Pack::load(p.y), Pack::load(p.z)}, Pack::load(p.w)};
}

}  // namespace temper::tets
