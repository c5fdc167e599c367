// A mesh from arrays that come from another mesh, and are known to be right.
#pragma once

#include <optional>

#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// As TetMesh::build, without a look for overlaps: so also for parts of a mesh, which may touch themselves. Nothing if
/// a coordinate is out of range, or a tetrahedron is not positive. O(n).
[[nodiscard]] std::optional<TetMesh> rebuilt(const TetMeshInput& input);

}  // namespace temper::tets
