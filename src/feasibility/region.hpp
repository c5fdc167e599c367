// Parts of a mesh whose weights are found together.
//
// A region has free vertices and all cells that touch them. The other corners of these cells are its rim and
// keep their weights. Free vertices of one cell are in one region, so that regions are independent and can be
// solved one by one. If dual lengths count, free vertices on the two sides of an edge, or a face, are in one region,
// too.
//
//     . . r - r - r . .       f  free vertex
//     . r - f - f - r .       r  rim: its weight is a constant
//     . . r - r - r . .       .  not of the region
#pragma once

#include <cstdint>
#include <vector>

#include "feasibility/demand.hpp"

namespace temper {

struct Region {
  std::vector<VertexId> free;  ///< sorted
  std::vector<CellId> cells;   ///< sorted
  bool has_rim = false;        ///< else it is a connected component of the mesh
};

using VertexMask = IdVector<VertexId, std::uint8_t>;

/// The regions that these free vertices fall into, in the order of their least vertices. With `across` free
/// vertices on the two sides of an edge or a face belong together. O(n).
[[nodiscard]] std::vector<Region> regions_of(const Demand& demand, const VertexMask& free, bool across = false);

/// Adds the neighbors of these vertices to the mask, in this number of rings.
void grow(const Demand& demand, VertexMask& mask, std::vector<VertexId> front, int rings);

/// The cells that touch a cell, and this itself; sorted.
[[nodiscard]] std::vector<CellId> ring_of(const Demand& demand, CellId cell);

/// The cells of constraints: those that have p, q and another vertex of theirs; sorted.
[[nodiscard]] std::vector<CellId> cells_of(const Demand& demand, std::span<const WeightConstraint> constraints);

/// The connected components of the mesh: regions without rim.
[[nodiscard]] std::vector<Region> components_of(const Demand& demand);

}  // namespace temper
