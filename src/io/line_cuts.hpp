// Tagged lines whose edges were split.
//
//     a ------- b      becomes    a --- x --- b      with x inserted on the edge; the tag and the data go to both
#pragma once

#include "temper/io.hpp"

namespace temper::io {

/// Cuts the lines of the file, which are numbered as the mesh is, where the mesh has inserted vertices (`vertices`
/// invalid) on them. In files where every boundary point carries a marker (Triangle, medit), a new point of the
/// boundary gets that of its neighbours when it is the same.
void cut_lines(MeshFile& file, const Mesh& mesh, const IdVector<VertexId, VertexId>& vertices);

}  // namespace temper::io
