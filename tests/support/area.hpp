// The area that a mesh covers, for tests that compare it with the domain's.
#pragma once

#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"

namespace temper::test {

inline double area(const Mesh& mesh) {
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    const auto [a, b, c] = mesh.corners(t);
    sum += 0.5 * doubled_area(mesh.position(a), mesh.position(b), mesh.position(c));
  }
  return sum;
}

}  // namespace temper::test
