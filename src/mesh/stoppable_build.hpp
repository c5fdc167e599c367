// Mesh::build for callers that may want to stop: a mesh of many millions of triangles takes several seconds.
#pragma once

#include <functional>

#include "temper/mesh.hpp"

namespace temper {

/// Mesh::build, which asks `stop` now and then. After true it ends with ErrorCode::stopped.
[[nodiscard]] Expected<BuiltMesh> build_or_stop(const MeshInput& input, const std::function<bool()>& stop);

}  // namespace temper
