// Steps of building and checking that meshes of the plane, of the sphere and of surfaces share: they need no positions.
#pragma once

#include <optional>
#include <string>

#include "mesh/input_check.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Marks the constrained edges of the input, and the edges between different regions. An error names an edge that is
/// not in the mesh.
[[nodiscard]] std::optional<InputError> constrain_edges(Mesh& mesh, const NamedInput& input);
/// Marks the fixed vertices of the input.
[[nodiscard]] std::optional<InputError> fix_vertices(Mesh& mesh, const NamedInput& input);

/// The first error in ids, twins, stars and flags, or a point that is not finite; nothing when all is right. Triangles
/// may be inverted. Precondition: the arrays have lengths that fit. O(n).
[[nodiscard]] std::optional<std::string> broken_connectivity(const Mesh& mesh);

}  // namespace temper
