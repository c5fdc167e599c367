// The vertices of a file that must not move.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "temper/io.hpp"

namespace temper::io {

/// The vertices of points that the file calls required, and of those with a wanted tag, ascending. Failure: nothing has
/// a wanted tag.
[[nodiscard]] std::vector<std::int32_t> fixed_points(const MeshFile& file, const VertexOfPoint& vertex,
                                                     std::span<const std::string> wanted);

/// The vertices where tagged lines of the boundary, or of constrained edges, end or change their tag. If such a vertex
/// slid, the user's groups would change their shape. `edges`: of each line of the file; invalid: it is left out.
[[nodiscard]] std::vector<VertexId> ends_of_tags(const MeshFile& file, std::span<const HalfedgeId> edges,
                                                 const Mesh& mesh);
/// Fixes these vertices on straight pieces of the boundary.
void fix_ends_of_tags(const MeshFile& file, std::span<const HalfedgeId> edges, Mesh& mesh);

/// The vertices of marked points, which must not move: they are places that the user chose, such as wells. But marks
/// may also list vertices, and then they fix nothing:
///   - if all vertices are marked
///   - tags of vertices of the boundary, if all of these are marked (Triangle)
///   - tags of lines that pass through one of their points, unless they have a name for points
///
/// A tag of 0 is none. Pairs across levees stay opposite: they are fixed.
[[nodiscard]] std::vector<VertexId> fixed_marks(const MeshFile& file, const VertexOfPoint& vertex, const Mesh& mesh);

}  // namespace temper::io
