// The cut of a mesh of tetrahedra by a plane.
//
//      d -------- c        A plane with a, b below and c, d above cuts a tetrahedron in a quadrilateral,
//     / \  plane / \       one with a alone below in a triangle. Each corner of the polygon is on an edge of
//    /---\------/---\      the tetrahedron, and each side in a face: around the polygon one end of the edge
//   a ----\----/---- b     changes at a time.
#pragma once

#include <vector>

#include "draw/section.hpp"
#include "temper/tets/draw.hpp"

namespace temper::tets {

/// The polygon in which a plane cuts a tetrahedron.
struct CutTet {
  TetId tetrahedron;
  std::vector<Vec2> corners;      ///< In the axes of the picture, counter-clockwise or clockwise
  std::vector<HalffaceId> faces;  ///< Face of the side from each corner to the next one
};

/// The polygons of a cut, in the order of the tetrahedra. A tetrahedron below the plane with an edge on it has two
/// corners: its sides are that edge, once in each of two faces.
[[nodiscard]] std::vector<CutTet> cut(const TetMesh& mesh, const Plane& plane);

/// The cut as a picture shows it, with the margins of `measured`: the mesh, or the same tetrahedra in other spaces.
[[nodiscard]] Section section_of(const TetMesh& mesh, const Plane& plane, const TetMesh& measured);
[[nodiscard]] inline Section section_of(const TetMesh& mesh, const Plane& plane) {
  return section_of(mesh, plane, mesh);
}

}  // namespace temper::tets
