// Points for packs: what goes into each lane, and comes out of it.
#pragma once

#include <cstdint>

#include "energy/edge_kernels.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

// Plain arrays, since what uses them is compiled for several instruction sets: they come with no functions.

/// A coordinate: one value for each lane.
using Lane = double[kLanes];
/// A mask: all bits of a lane are set where something holds.
using LaneMask = std::int64_t[kLanes];

struct LanePoints {
  Lane x, y, w;
  void set(std::size_t lane, const WeightedPoint& p) { x[lane] = p.x, y[lane] = p.y, w[lane] = p.w; }
  [[nodiscard]] WeightedPoint at(std::size_t lane) const { return {x[lane], y[lane], w[lane]}; }
};

/// Triangles, one a lane.
struct TriangleLanes {
  LanePoints p, q, r;
};

}  // namespace temper
