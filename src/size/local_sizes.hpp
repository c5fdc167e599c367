// Local sizes along a walk that the caller has, for what looks at more than sizes.
#pragma once

#include "mesh/curve.hpp"
#include "temper/detail/size.hpp"

namespace temper {

/// local_sizes() along a walk over the mesh.
[[nodiscard]] IdVector<VertexId, double> local_sizes(const Mesh& mesh, const Walk& walk, Executor* executor);

}  // namespace temper
