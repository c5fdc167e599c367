// Data of points and triangles, where a mesh has moved, gained or lost some.
#pragma once

#include "temper/io.hpp"

namespace temper::io {

/// The point of a file that each vertex was, invalid for one that was none; empty: the same numbers.
using Former = IdVector<VertexId, VertexId>;

/// Data of the file for the vertices and triangles of the mesh: see update(). Reads the points, triangles and regions
/// of before, which the file still has.
DataReport update_data(MeshFile& file, const Mesh& mesh, const Former& former, const UpdateOptions& options);

/// Cuts the lines of the file, which are numbered as the mesh is, where the mesh has inserted vertices (`vertices`
/// invalid) on them. In files where every boundary point carries a marker (Triangle, medit), a new point of the
/// boundary gets that of its neighbours when it is the same.
void cut_lines(MeshFile& file, const Mesh& mesh, const IdVector<VertexId, VertexId>& vertices);

}  // namespace temper::io
