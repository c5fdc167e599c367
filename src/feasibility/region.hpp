// Parts of a mesh whose weights are found together.
//
// A region has free vertices and all triangles that touch them. The other corners of these triangles are its rim and
// keep their weights. Free vertices of one triangle are in one region, so that regions are independent and can be
// solved one by one. If dual lengths count, free vertices on the two sides of an edge are in one region, too.
//
//     . . r - r - r . .       f  free vertex
//     . r - f - f - r .       r  rim: its weight is a constant
//     . . r - r - r . .       .  not of the region
#pragma once

#include <cstdint>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

struct Region {
  std::vector<VertexId> free;         ///< sorted
  std::vector<TriangleId> triangles;  ///< sorted
  bool has_rim = false;               ///< else it is a connected component of the mesh
};

using VertexMask = IdVector<VertexId, std::uint8_t>;

/// The regions that these free vertices fall into, in the order of their least vertices. With across_edges free
/// vertices on the two sides of an edge belong together. O(n).
[[nodiscard]] std::vector<Region> regions_of(const Mesh& mesh, const VertexMask& free, bool across_edges = false);

/// Adds the neighbors of these vertices to the mask, in this number of rings.
void grow(const Mesh& mesh, VertexMask& mask, std::vector<VertexId> front, int rings);

/// The triangles that touch t, and t itself; sorted.
[[nodiscard]] std::vector<TriangleId> ring_of(const Mesh& mesh, TriangleId t);

/// The connected components of the mesh: regions without rim.
[[nodiscard]] std::vector<Region> components_of(const Mesh& mesh);

}  // namespace temper
