// Stars of a mesh, eight together, as batches have them (optimize/batch/batch_step.hpp).
#pragma once

#include <array>
#include <vector>

#include "optimize/batch/star_batch.hpp"
#include "temper/mesh.hpp"

namespace temper::bench {

/// Puts the star of v into a lane. False, and the lane is to be used again, where it has too many triangles.
bool fill_lane(const Mesh& mesh, VertexId v, std::size_t lane, StarBatch& batch);

/// All free vertices of the mesh in batches of about as many triangles, in the order of their numbers.
[[nodiscard]] std::vector<std::array<VertexId, kLanes>> alike_vertices(const Mesh& mesh);

}  // namespace temper::bench
