// Cures of a conflict: changes are tried one by one on a copy of its neighborhood, and judged by the linear program.
#pragma once

#include <span>
#include <vector>

#include "explain/conflict.hpp"
#include "temper/explain.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Cures for a conflict, the best one for each way to change the mesh. Cures that keep the boundary and the vertices
/// come first. `others` are bad triangles of other reasons, which may stay bad. If no cure is verified, these are the
/// cures that may help.
[[nodiscard]] std::vector<Cure> find_cures(const Mesh& mesh, const Conflict& conflict,
                                           std::span<const TriangleId> others, LpSolver& solver);

/// Cures that may help and need no search.
[[nodiscard]] std::vector<Cure> suggested_cures(const Mesh& mesh, const Conflict& conflict);

}  // namespace temper
