// Triangles and edges in lanes, for the energy and the barrier of the accuracy objective on whole meshes.
#pragma once

#include "energy/accuracy_edge.hpp"
#include "energy/lanes.hpp"

namespace temper {

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
