// Edges that a user names: all of a mesh, its lines, or those of a file.
//
//   # two vertices a line, as the mesh file counts them
//   3 9
//   9 12
#pragma once

#include <string>
#include <vector>

#include "input.hpp"

namespace temper::app {

/// "all": all edges inside the mesh; "lines": those on tagged lines and between regions; else a path. Failure when the
/// file cannot be read or names something else than edges of the mesh, with its line; or when no edge is inside the
/// mesh.
[[nodiscard]] std::vector<HalfedgeId> prescribed_edges(const std::string& which, const Input& input);

}  // namespace temper::app
