// What must hold of the arrays of a mesh, wherever its vertices are.
#pragma once

#include <optional>
#include <string>

#include "temper/mesh.hpp"

namespace temper {

/// The first thing that is wrong with ids, twins, stars and flags, or a point that is not finite; nothing when all is
/// as it must be. Triangles may be inverted. Precondition: the arrays have lengths that fit. O(n).
[[nodiscard]] std::optional<std::string> broken_connectivity(const Mesh& mesh);

}  // namespace temper
