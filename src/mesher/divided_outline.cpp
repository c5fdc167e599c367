// Division of edges by the integral of 1/size, and how far sharp corners reach.
#include "mesher/divided_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/box_tree.hpp"

namespace temper::mesher {
namespace {

/// Distances along a segment of given length where it is to be divided: equal parts of the integral of 1/size.
std::vector<double> divisions(Vec2 from, Vec2 to, const GradedSize& size, Deadline& deadline) {
  constexpr double kStep = 0.125;      // of the local size: the integrand changes by less than grade/8 in a step
  constexpr double kStretch = 0.25;    // a piece may be longer than its size by this part, rather than be halved
  constexpr double kLeastStep = 1e-7;  // of the segment: what is finer takes fewer samples, not all memory
  const double whole = length(to - from);
  const Vec2 direction = (1 / whole) * (to - from);
  std::vector<double> at = {0}, integral = {0};
  double density = 1 / size(from);
  while (at.back() < whole && !deadline.asked_to_stop()) {
    // The first step must not run past a finer stretch: the size falls by at most grade times the step.
    const double next = std::min(whole, at.back() + std::max(kStep / density, kLeastStep * whole));
    const double next_density = 1 / size(from + next * direction);
    integral.push_back(integral.back() + 0.5 * (density + next_density) * (next - at.back()));
    at.push_back(next);
    density = next_density;
  }
  if (deadline.stopped()) return {};
  const auto n = static_cast<std::size_t>(std::max(1.0, std::ceil(integral.back() - kStretch)));
  std::vector<double> result;
  std::size_t k = 1;
  for (std::size_t i = 1; i < n; ++i) {
    const double wanted = integral.back() * static_cast<double>(i) / static_cast<double>(n);
    while (integral[k] < wanted) ++k;
    const double part = (wanted - integral[k - 1]) / (integral[k] - integral[k - 1]);
    result.push_back(at[k - 1] + part * (at[k] - at[k - 1]));
  }
  return result;
}

double squared_distance(Vec2 p, Vec2 a, Vec2 b) {
  const double along = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
  return squared_length(p - a - along * (b - a));
}

/// The other ends of the edges at each point, sorted by direction.
std::vector<std::vector<std::int32_t>> neighbours(const std::vector<Vec2>& points,
                                                  const std::vector<OutlineEdge>& edges) {
  std::vector<std::vector<std::int32_t>> result(points.size());
  for (const OutlineEdge& e : edges) {
    result[static_cast<std::size_t>(e.ends[0])].push_back(e.ends[1]);
    result[static_cast<std::size_t>(e.ends[1])].push_back(e.ends[0]);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto angle = [&](std::int32_t j) {
      const Vec2 d = points[static_cast<std::size_t>(j)] - points[i];
      return std::atan2(d.y, d.x);
    };
    std::sort(result[i].begin(), result[i].end(),
              [&](std::int32_t a, std::int32_t b) { return angle(a) < angle(b) || (angle(a) == angle(b) && a < b); });
  }
  return result;
}

bool is_sharp(const std::vector<Vec2>& points, std::size_t apex, const std::vector<std::int32_t>& around) {
  const auto direction = [&](std::size_t k) {
    const Vec2 d = points[static_cast<std::size_t>(around[k % around.size()])] - points[apex];
    return (1 / length(d)) * d;
  };
  for (std::size_t k = 0; around.size() > 1 && k < around.size(); ++k) {
    if (dot(direction(k), direction(k + 1)) > kSharpCosine) return true;
  }
  return false;
}

/// The nearest edge that does not end at the point, or `within`.
double clearance(const std::vector<Vec2>& points, const std::vector<OutlineEdge>& edges, const BoxTree& tree,
                 std::size_t apex, double within) {
  double least = within * within;
  const Vec2 p = points[apex];
  tree.visit(Box{p, p}.grown(within), [&](std::size_t i) {
    const auto [a, b] = edges[i].ends;
    if (static_cast<std::size_t>(a) != apex && static_cast<std::size_t>(b) != apex) {
      least = std::min(least,
                       squared_distance(p, points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]));
    }
    return true;
  });
  return std::sqrt(least);
}

}  // namespace

CornerRadii corner_radii(const std::vector<Vec2>& points, const std::vector<OutlineEdge>& edges, double largest) {
  const auto around = neighbours(points, edges);
  std::vector<std::uint8_t> sharp(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) sharp[i] = is_sharp(points, i, around[i]) ? 1 : 0;
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const OutlineEdge& e : edges) {
    boxes.push_back(box_of(points[static_cast<std::size_t>(e.ends[0])], points[static_cast<std::size_t>(e.ends[1])]));
  }
  const BoxTree tree(boxes);
  CornerRadii radii(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sharp[i] == 0) continue;
    double radius = largest;
    for (const std::int32_t j : around[i]) {
      const double reach = sharp[static_cast<std::size_t>(j)] != 0 ? 1.0 / 3 : 0.5;
      radius = std::min(radius, reach * length(points[static_cast<std::size_t>(j)] - points[i]));
    }
    constexpr double kApart = 0.5;  // of the way to the next thing
    radii[i] = std::min(radius, kApart * clearance(points, edges, tree, i, radius / kApart));
  }
  return radii;
}

DividedOutline divide(const std::vector<Vec2>& points, const std::vector<OutlineEdge>& edges, const GradedSize& size,
                      const CornerRadii& corners, Deadline& deadline) {
  DividedOutline divided{points, {}};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto a = static_cast<std::uint32_t>(edges[e].ends[0]), b = static_cast<std::uint32_t>(edges[e].ends[1]);
    const double whole = length(points[b] - points[a]);
    const Vec2 direction = (1 / whole) * (points[b] - points[a]);
    const double first = corners[a], last = whole - corners[b];
    std::vector<double> at;
    if (first > 0) at.push_back(first);
    for (const double t : divisions(points[a] + first * direction, points[a] + last * direction, size, deadline)) {
      at.push_back(first + t);
    }
    if (last < whole) at.push_back(last);
    std::uint32_t from = a;
    for (const double t : at) {
      const auto p = static_cast<std::uint32_t>(divided.points.size());
      divided.points.push_back(points[a] + t * direction);
      divided.pieces.push_back({{from, p}, static_cast<std::uint32_t>(e)});
      from = p;
    }
    divided.pieces.push_back({{from, b}, static_cast<std::uint32_t>(e)});
  }
  return divided;
}

double count_pieces(const std::vector<Vec2>& points, const std::vector<OutlineEdge>& edges, double size) {
  double pieces = 0;
  for (const OutlineEdge& e : edges) {
    const double whole =
        length(points[static_cast<std::size_t>(e.ends[1])] - points[static_cast<std::size_t>(e.ends[0])]);
    pieces += std::max(1.0, std::ceil(whole / size));
  }
  return pieces;
}

}  // namespace temper::mesher
