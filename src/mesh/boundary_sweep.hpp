// The boundary of a mesh from left to right: do its edges cross or touch, does a component lie on another one?
//
// A line sweeps over the boundary edges and keeps those that it crosses in their order on it. Two edges that meet are
// neighbours on the line just before (Shamos and Hoey), so it suffices to look at neighbours. And while none meet,
// each edge that has the mesh above it is followed by one that has it below. The leftmost point that is covered twice
// is a vertex where triangles begin, and just below it the line crosses an edge that has the mesh above it.
#pragma once

#include <optional>

#include "temper/mesh.hpp"

namespace temper {

/// Two boundary edges that say that the mesh is not embedded.
struct BoundaryClash {
  enum Kind {
    meeting,  ///< they cross, or touch away from a common vertex
    covered,  ///< triangles begin at the first one's lesser end, and those of the second are there already
  } kind;
  HalfedgeId first, second;
};

/// Finds a clash, in a periodic plane only of edges that meet, the leftmost or one before it; nothing where the
/// boundary is as it should be. Exact. Preconditions: the mesh lies in the plane; stars are whole and wind once, which
/// leaves two boundary edges at a vertex, in different directions. O(m log m) for m boundary edges, whatever their
/// shape.
[[nodiscard]] std::optional<BoundaryClash> find_boundary_clash(const Mesh& mesh);

}  // namespace temper
