// The tetrahedra of a run that its criterion does not allow.
#pragma once

#include <cstddef>
#include <vector>

#include "temper/tets/criterion.hpp"
#include "tets/optimize/draft.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {

/// The tetrahedra at violations of the criterion, or at faces that are not regular, ascending. The rim of a patch does
/// not count: the tetrahedra beyond it decide there, too.
[[nodiscard]] std::vector<TetId> violating(const Draft& draft, Criterion criterion, Executor* executor = nullptr);

/// The energy of a mesh, and the number of its violating tetrahedra.
[[nodiscard]] MeshState state_of(const Draft& draft, Criterion criterion, double gamma, Executor* executor = nullptr);

}  // namespace temper::tets
