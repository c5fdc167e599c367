// A mesh from arrays that come from another mesh, and are known to be right.
#pragma once

#include <optional>

#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// As TetMesh::build, without its checks of sizes, places and stars: parts of a mesh may touch themselves. Tags that
/// are not in the mesh are dropped. Nothing if a coordinate is out of range, or a tetrahedron is not positive. O(n).
[[nodiscard]] std::optional<TetMesh> rebuilt(const TetMeshInput& input);

}  // namespace temper::tets
