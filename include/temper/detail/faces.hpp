// Faces of power cells that must stay: the duals of single edges, which are pieces of a line.
//
// The dual of ab ends in the orthocenters p and q of the two triangles at ab. These depend on the corners of the two
// triangles alone. So the dual stays if these corners keep place and weight, and if no edge of the triangles flips.
//
//        a0------a1------a2        the line goes from left to right through p and q
//         |    / |     / |         ab: a1 and b1, or another pair
//       --|--p---|---q---|--       a0 a1 b1 b0 have the orthocenter p in common: their diagonal has a dual of length 0,
//         | /    | /     |         and either one is regular
//        b0------b1------b2
#pragma once

#include <span>

#include "temper/mesh.hpp"

namespace temper {

/// Keeps the duals of these edges through all changes of the mesh. It marks the edges as faces. Around each end of a
/// dual it takes the polygon of all triangles with this orthocenter. Corners of polygons become frozen, their sides
/// constrained, and edges inside become diagonals. So does an edge of the boundary on which a dual ends. O(n) in the
/// number of edges.
void keep_faces(Mesh& mesh, std::span<const HalfedgeId> faces);
/// Says whether the mesh has faces that must stay. O(n).
[[nodiscard]] bool keeps_faces(const Mesh& mesh);

}  // namespace temper
