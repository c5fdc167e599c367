// The changes of a mesh of tetrahedra that wait for an update.
#pragma once

#include "optimize/loop/update.hpp"
#include "temper/tets/optimizer.hpp"

namespace temper::tets {

using ChangedTetrahedra = ChangedMesh<TetMesh, Origins>;

/// Makes these changes: moves all vertices at once, then sets weights, then removes and inserts vertices by cones over
/// cavities. Error: a change is impossible.
[[nodiscard]] Expected<ChangedTetrahedra> changed(const TetMesh& mesh, const WaitingChanges& waiting,
                                                  const temper::InputNames* names);

}  // namespace temper::tets
