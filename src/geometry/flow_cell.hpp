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
  double area = 0, size = 0;  ///< size²: the area

  FlowCell() = default;
  FlowCell(Vec3 at, double area_there) : center(at), area(area_there), size(std::sqrt(area_there)) {}
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

/// The cell of a convex quadrilateral. Its center lies as near as possible to the perpendicular bisectors of the sides
/// that have a neighbor: least squares, nearest to the mean of the corners. With less than two such sides it is this
/// mean. A center outside is where the way from the mean leaves the cell.
[[nodiscard]] inline FlowCell flow_cell(const std::array<Vec3, 4>& corners, const std::array<bool, 4>& has_neighbor) {
  const Vec3 normal = cross(corners[2] - corners[0], corners[3] - corners[1]);
  const Vec3 mean = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const Vec3 x = (1 / length(corners[1] - corners[0])) * (corners[1] - corners[0]),
             y = (1 / length(normal)) * cross(normal, x);
  const auto in_plane = [&](Vec3 v) { return Vec2{dot(v, x), dot(v, y)}; };
  // The bisector of side k: (c − middle) · along = 0, for the step c from the mean.
  double xx = 0, xy = 0, yy = 0;
  Vec2 right;
  int n = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!has_neighbor[k]) continue;
    const Vec3 side = corners[(k + 1) % 4] - corners[k];
    const Vec2 along = in_plane((1 / length(side)) * side), middle = in_plane(corners[k] + 0.5 * side - mean);
    xx += along.x * along.x, xy += along.x * along.y, yy += along.y * along.y;
    right = right + dot(middle, along) * along;
    ++n;
  }
  Vec2 step;
  const double determinant = xx * yy - xy * xy, trace = xx + yy;
  constexpr double kParallel = 1e-9;  // of the sides with neighbors: there is no second direction
  if (n > 1 && determinant > kParallel * trace * trace)
    step = (1 / determinant) * Vec2{yy * right.x - xy * right.y, xx * right.y - xy * right.x};
  else if (n > 1)
    step = (1 / trace) * right;
  double way = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 from = in_plane(corners[k] - mean), to = in_plane(corners[(k + 1) % 4] - mean);
    const double inside = cross(from, to), across = cross(step, to - from);
    if (across > inside) way = std::min(way, inside / across);
  }
  return {mean + (way * step.x) * x + (way * step.y) * y, 0.5 * length(normal)};
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
  result.length = link_length / (0.5 * (left.size + right.size));
  return result;
}

}  // namespace temper
