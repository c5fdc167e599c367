// Triangles as the finite volumes of D-Flow FM, by the definitions of MeshKernel, the library of its grid editor: it
// knows no weights, and its centers of cells are circumcenters kept inside.
//
//        c            The circumcenter o of an obtuse triangle is outside. In its place D-Flow FM takes the point x
//       / \           where the way from the centroid m to o leaves the triangle.
//      / m \          On the sphere all this is of the flat triangle: MeshKernel itself has no circumcenters there but
//     a--x--b         in longitude and latitude.
//         o
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "temper/mesh.hpp"

namespace temper {

/// Where a vertex is, without its weight; of images the one near a point.
[[nodiscard]] inline Vec3 place_of(const Mesh& mesh, VertexId v, const WeightedPoint& near) {
  return mesh.space().place(mesh.point(v, near));
}

struct FlowCell {
  Vec3 center;
  double area = 0;
};

[[nodiscard]] inline FlowCell flow_cell(Vec3 a, Vec3 b, Vec3 c) {
  const double la = squared_length(c - b), lb = squared_length(a - c), lc = squared_length(b - a);
  // Barycentric coordinates of the circumcenter, times 16 A².
  const std::array<double, 3> at = {la * (lb + lc - la), lb * (lc + la - lb), lc * (la + lb - lc)};
  const double sum = at[0] + at[1] + at[2];
  constexpr double kThird = 1.0 / 3;
  double way = 1;  // from the centroid to the circumcenter, as far as it is inside
  for (const double x : at) {
    if (x < 0) way = std::min(way, kThird / (kThird - x / sum));
  }
  if (!(sum > 0)) way = 0;
  const auto weight = [&](std::size_t k) { return way == 0 ? kThird : kThird + way * (at[k] / sum - kThird); };
  return {a + weight(1) * (b - a) + weight(2) * (c - a), 0.5 * length(cross(b - a, c - a))};
}

}  // namespace temper
