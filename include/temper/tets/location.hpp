// Places in a mesh of tetrahedra: temper/detail/location.hpp, with a dimension more.
//
// Data at vertices are linear on tetrahedra; data of tetrahedra are constant on each. After a change, a
// vertex gets the data at its new place in the former mesh. A tetrahedron gets those of the former tetrahedron that
// contains its middle.
#pragma once

#include <array>

#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// A point of a mesh as a weighted mean of the corners around it.
struct Place {
  TetId tetrahedron;                            ///< Tetrahedron that the point is in or on
  int n = 0;                                    ///< Number of corners that count
  std::array<VertexId, 4> corners = {};         ///< Corners; the first n count
  std::array<double, 4> shares = {1, 0, 0, 0};  ///< Share of each corner: positive, with the sum 1
};

/// Returns the tetrahedron that contains p, or that p is outside of by rounding alone. Without one, the result is
/// `near`. The walk begins at `near`: about O(distance in tetrahedra), at most O(n).
[[nodiscard]] TetId find_tetrahedron(const TetMesh& mesh, Vec3 p, TetId near);

/// Returns the place in `before` of each vertex of `after`. `vertices`: number of each vertex in `before`, invalid for
/// new vertices; empty: the same numbers. O(n) if vertices have moved little.
[[nodiscard]] IdVector<VertexId, Place> positions_of_vertices(const TetMesh& before, const TetMesh& after,
                                                              const IdVector<VertexId, VertexId>& vertices = {},
                                                              Executor* executor = nullptr);

/// Returns, for each tetrahedron of `after`, the tetrahedron of `before` that contains its centroid. If `before` has
/// the same tetrahedron with the same number and at the same places, the result is exactly that one. The cost is the
/// same.
[[nodiscard]] IdVector<TetId, TetId> sources_of_tetrahedra(const TetMesh& before, const TetMesh& after,
                                                           const IdVector<VertexId, VertexId>& vertices = {},
                                                           Executor* executor = nullptr);

/// Returns a tetrahedron of `before` at a corner of t, one of `after`, to begin a walk from.
[[nodiscard]] TetId tetrahedron_near(const TetMesh& before, const TetMesh& after,
                                     const IdVector<VertexId, VertexId>& vertices, TetId t);

}  // namespace temper::tets
