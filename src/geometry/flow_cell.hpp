// Triangles as the finite volumes of D-Flow FM, by the definitions of MeshKernel, the library of its grid editor. It
// has no weights, and its centers of cells are circumcenters kept inside.
//
//        c            The circumcenter o of an obtuse triangle is outside. In its place D-Flow FM takes the point x at
//       / \           which the way from the centroid m to o leaves the triangle. On the sphere all this holds for the
//      / m \          flat triangle. MeshKernel itself has no circumcenters there, except in longitude and latitude.
//     a--x--b
//         o
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "temper/detail/vec.hpp"

namespace temper {

/// D-Flow FM removes flow links below this length, the default of its removeSmallLinksTrsh.
inline constexpr double kSmallFlowLink = 0.1;
/// Advice of D-Flow FM for the orthogonality of a grid.
inline constexpr double kAdvisedOrthogonality = 0.01;

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

/// The line between the centers of two cells that share an edge.
struct FlowLink {
  double orthogonality = 0;  ///< |cosine| of its angle with the edge; 0 if rounding determines its direction
  double length = 0;         ///< over the mean square root of both areas
};

[[nodiscard]] inline FlowLink flow_link(Vec3 edge, const FlowCell& left, const FlowCell& right) {
  // Rounding determines the direction of a shorter link. It is a small flow link anyway.
  constexpr double kHasDirection = 0x1p-40;  // of the edge
  const Vec3 link = right.center - left.center;
  const double edge_length = length(edge), link_length = length(link);
  FlowLink result;
  if (link_length > kHasDirection * edge_length)
    result.orthogonality = std::min(1.0, std::abs(dot(edge, link)) / (edge_length * link_length));
  result.length = link_length / (0.5 * (std::sqrt(left.area) + std::sqrt(right.area)));
  return result;
}

}  // namespace temper
