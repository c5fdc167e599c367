// Cures of a conflict: changes are tried one by one on a copy of its neighborhood, and judged by the linear program.
#pragma once

#include <span>
#include <vector>

#include "explain/conflict.hpp"
#include "temper/explain.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Cures for a conflict: of each way to change the mesh the best that was found, those that leave the boundary and the
/// vertices as they are first. `others` are bad triangles that other reasons own: they are not asked to be good.
/// When none is verified: the cures that may help.
[[nodiscard]] std::vector<Cure> find_cures(const Mesh& mesh, const Conflict& conflict,
                                           std::span<const TriangleId> others, LpSolver& solver);

/// Cures that may help and need no search.
[[nodiscard]] std::vector<Cure> suggested_cures(const Mesh& mesh, const Conflict& conflict);

/// Do the weights of the solved program make all these triangles well-centered? Exact.
[[nodiscard]] bool suits(const Mesh& mesh, std::span<const TriangleId> triangles, const BestMargin& best);

}  // namespace temper
