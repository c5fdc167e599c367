// Local sizes without their noise, for the accuracy objective.
#pragma once

#include "temper/detail/executor.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Averages each size with the neighbors' sizes ten times, since sizes of badly shaped triangles are noisy. Five times
/// leave the noise of bad meshes, and twenty are not better. Isolated vertices keep their sizes.
[[nodiscard]] IdVector<VertexId, double> averaged_sizes(const Mesh& mesh, IdVector<VertexId, double> sizes,
                                                        Executor* executor = nullptr);

}  // namespace temper
