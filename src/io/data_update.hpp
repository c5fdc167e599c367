// Data of points and triangles, where a mesh has moved, gained or lost some.
#pragma once

#include "temper/io.hpp"

namespace temper::io {

/// The point of a file that each vertex was, invalid for one that was none; empty: the same numbers.
using Former = IdVector<VertexId, VertexId>;

/// Data of the file for the vertices and triangles of the mesh: see update(). Reads the points, triangles and regions
/// of before, which the file still has.
DataReport update_data(MeshFile& file, const Mesh& mesh, const Former& former, const UpdateOptions& options);

}  // namespace temper::io
