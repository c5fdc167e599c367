// A mesh of tetrahedra that no weights make regular.
#pragma once

#include <cmath>
#include <numbers>

#include "support/tet_lattice.hpp"

namespace temper::tets {

/// Two nested triangles, the ring between them divided like a pinwheel, and an apex above all. No weights make the base
/// regular, and so none the tetrahedra.
inline TetMesh pinwheel_cone(double turn = 0.1) {
  test::TetArrays a;
  const double third = 2 * std::numbers::pi / 3;
  for (int k = 0; k < 3; ++k) a.points.push_back({4 * std::cos(k * third), 4 * std::sin(k * third), 0});
  for (int k = 0; k < 3; ++k) a.points.push_back({std::cos(k * third + turn), std::sin(k * third + turn), 0});
  a.points.push_back({0.5, 0.25, 3});
  a.tetrahedra = {{3, 4, 5, 6}, {0, 1, 4, 6}, {0, 4, 3, 6}, {1, 2, 5, 6}, {1, 5, 4, 6}, {2, 0, 3, 6}, {2, 3, 5, 6}};
  return test::mesh_of(a);
}

}  // namespace temper::tets
