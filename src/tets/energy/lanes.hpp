// Eight tetrahedra side by side, for kernels of all instruction sets.
#pragma once

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

template <class Pack>
TEMPER_INLINE PointVector<Pack> load(const LanePoints& p) {
  return {{Pack::load(p.x), Pack::load(p.y), Pack::load(p.z)}, Pack::load(p.w)};
}

}  // namespace temper::tets
