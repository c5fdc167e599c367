// Points for packs: what goes into each lane, and comes out of it.
#pragma once

#include <cstdint>

#include "energy/accuracy_edge.hpp"
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

// Triangles and edges in lanes, for the energy and the barrier of the accuracy objective on whole meshes.

/// Edges of triangles, pq, qr and rp, as EdgeShape has them.
struct ShapeLanes {
  struct alignas(64) Edge {
    Lane l2, dw, g;
    [[nodiscard]] EdgeShape at(std::size_t lane) const { return {l2[lane], dw[lane], g[lane]}; }
  };
  Edge edges[3];
};

/// Edges ab, one a lane, each seen from a triangle on its left, with d across where it is inner.
struct alignas(64) EdgeLanes {
  Lane l2, dw, left;    ///< as that triangle has them
  Lane size_a, size_b;  ///< of the local sizes
  Lane height;          ///< q
  LaneMask inner;       ///< there is a triangle bad
  LanePoints b, a, d;
};

}  // namespace temper
