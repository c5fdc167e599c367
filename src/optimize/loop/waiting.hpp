// The changes of a mesh of triangles that wait for an update.
#pragma once

#include "optimize/loop/update.hpp"

namespace temper {

using ChangedTriangles = ChangedMesh<Mesh, IdVector<VertexId, VertexId>>;

/// Makes these changes: moves all vertices at once as far as triangles allow, and the rest one by one with flips, then
/// sets weights, then removes, then inserts. All edges that may flip are regular then. Where weights would hide a
/// vertex, they change. Error: a change is impossible.
[[nodiscard]] Expected<ChangedTriangles> changed(const Mesh& mesh, const WaitingChanges& waiting,
                                                 const InputNames* names);

}  // namespace temper
