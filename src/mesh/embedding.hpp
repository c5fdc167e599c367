// Does a mesh cover its space at most once? The global half of Mesh::build's checks.
#pragma once

#include <optional>
#include <string>

#include "temper/mesh.hpp"

namespace temper {

/// Two places where the mesh covers the same spot twice, for an error message.
struct Overlap {
  TriangleId triangle;  ///< one of the triangles involved
  std::string message;  ///< of what lies on what, in the user's names
};

/// Two boundary edges at v in the same direction, said in the user's names: what a hanging node at their ends makes of
/// v. Empty when there are none. O(n), for error messages.
[[nodiscard]] std::string edges_on_each_other(const Mesh& mesh, VertexId v, const InputNames& names);

/// Finds why the mesh is not embedded in its space; nothing when it is. Preconditions: all triangles counter-clockwise,
/// manifold.
///
/// In the plane a connected mesh whose stars wind once and whose boundary loops neither cross nor touch covers every
/// point at most once: the turning numbers of its loops sum to its Euler characteristic, which leaves
/// one outer loop. What then remains is a component inside another one's triangles. (On the sphere:
/// boundary_sweep.hpp.)
[[nodiscard]] std::optional<Overlap> find_overlap(const Mesh& mesh, const InputNames& names,
                                                  Executor* executor = nullptr);

}  // namespace temper
