// Checks that linked tetrahedra are a mesh of a part of space, covered once.
#pragma once

#include <optional>

#include "tets/mesh/input_errors.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {

/// An error if the mesh touches itself at a vertex or an edge, or if tetrahedra overlap around one.
[[nodiscard]] std::optional<InputError> check_embedding(const TetMesh& mesh, const EdgeTable& edges,
                                                        const InputErrors& errors);

}  // namespace temper::tets
