// What rounding has done to vertices that were not to change.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

/// On the sphere each change of a weight rounds a vertex's place, and each move its weight: of what has not changed but
/// for that, vertices get the input's again. `vertices`: the input's number of
/// each vertex, no vertex's where it is new; empty: the same.
void take_back_rounding(const Mesh& input, const IdVector<VertexId, VertexId>& vertices, Mesh& mesh);

}  // namespace temper
