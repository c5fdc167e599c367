// Division of edges by the integral of 1/size, and the radii of sharp corners.
#include "mesher/divided_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace temper::mesher {

namespace {

constexpr double kStretch = 0.25;  // a piece may be longer than its size by this part, rather than be halved

/// Says whether the sizes at both ends show that the segment is one piece, since sizes fall by at most the grade.
bool is_surely_one_piece(const SurfacePath& path, const GradedSize& size) {
  constexpr double kRounding = 0.01;  // of the sums in divisions(), too
  if (size.has_field()) return false;
  const double whole = path.length(), grade = size.grade();
  const double a = size(path.at(0)), b = size(path.at(whole));
  const double lowest = 0.5 * (a + b - grade * whole);  // where the sizes from both ends meet
  if (!(lowest > 0)) return false;
  return std::log(a / lowest) + std::log(b / lowest) < (1 + kStretch - kRounding) * grade;
}

/// Distances of the division points along a segment of given length: equal parts of the integral of 1/size.
std::vector<double> divisions(const SurfacePath& path, const GradedSize& size, double most, Deadline& deadline) {
  constexpr double kStep = 0.125;      // of the local size: the integrand changes by less than grade/8 in a step
  constexpr double kLeastStep = 1e-7;  // of the segment: what is finer takes fewer samples, not all memory
  if (is_surely_one_piece(path, size)) return {};
  const double whole = path.length();
  std::vector<double> at = {0}, integral = {0};
  double density = 1 / size(path.at(0));
  while (at.back() < whole && integral.back() < most && !deadline.asked_to_stop()) {
    // The first step must not run past a finer stretch: the size falls by at most grade times the step.
    const double next = std::min(whole, at.back() + std::max(kStep / density, kLeastStep * whole));
    const double next_density = 1 / size(path.at(next));
    integral.push_back(integral.back() + 0.5 * (density + next_density) * (next - at.back()));
    at.push_back(next);
    density = next_density;
  }
  if (deadline.stopped()) return {};
  const auto n = static_cast<std::size_t>(std::clamp(std::ceil(integral.back() - kStretch), 1.0, most));
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

/// The other ends of the edges at each point, sorted by direction.
std::vector<std::vector<std::int32_t>> neighbors(const Surface& surface, const std::vector<Vec3>& points,
                                                 const std::vector<OutlineEdge>& edges) {
  std::vector<std::vector<std::int32_t>> result(points.size());
  for (const OutlineEdge& e : edges) {
    result[static_cast<std::size_t>(e.ends[0])].push_back(e.ends[1]);
    result[static_cast<std::size_t>(e.ends[1])].push_back(e.ends[0]);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 first = surface.some_direction(points[i]), second = surface.to_the_left(first, points[i]);
    const auto angle = [&](std::int32_t j) {
      const Vec3 d = points[static_cast<std::size_t>(j)] - points[i];
      return std::atan2(dot(d, second), dot(d, first));
    };
    std::sort(result[i].begin(), result[i].end(),
              [&](std::int32_t a, std::int32_t b) { return angle(a) < angle(b) || (angle(a) == angle(b) && a < b); });
  }
  return result;
}

/// Says whether a line that becomes faces meets another line here, ends on it, or turns so much that a site serves both
/// sides of the turn.
bool is_joint_of_faces(const Surface& surface, const std::vector<Vec3>& points, std::size_t place,
                       const std::vector<std::int32_t>& around, int faces) {
  if (faces == 0 || around.size() < 2) return false;
  if (around.size() > 2 || faces < 2) return true;
  const auto direction = [&](std::size_t k) {
    return surface.direction(points[place], points[static_cast<std::size_t>(around[k])]);
  };
  return dot(direction(0), direction(1)) > kSharedCosine;
}

std::vector<int> count_faces(const Arrangement& arrangement) {
  std::vector<int> faces(arrangement.places.size(), 0);
  for (const OutlineEdge& e : arrangement.edges) {
    for (const std::int32_t end : e.ends) faces[static_cast<std::size_t>(end)] += e.as == LineKind::faces ? 1 : 0;
  }
  return faces;
}

bool is_sharp(const Surface& surface, const std::vector<Vec3>& points, std::size_t apex,
              const std::vector<std::int32_t>& around) {
  const auto direction = [&](std::size_t k) {
    return surface.direction(points[apex], points[static_cast<std::size_t>(around[k % around.size()])]);
  };
  for (std::size_t k = 0; around.size() > 1 && k < around.size(); ++k) {
    if (dot(direction(k), direction(k + 1)) > kSharpCosine) return true;
  }
  return false;
}

}  // namespace

NearEdge nearest_edge(const Surface& surface, const Arrangement& arrangement, const BoundingBoxTree& tree,
                      std::size_t place, double within) {
  double least = within * within;
  NearEdge nearest;
  const Vec3 p = arrangement.places[place];
  tree.visit(BoundingBox{p, p}.grown(within), [&](std::size_t i) {
    const auto a = static_cast<std::size_t>(arrangement.edges[i].ends[0]),
               b = static_cast<std::size_t>(arrangement.edges[i].ends[1]);
    const std::int32_t origin = arrangement.origin[place];
    if (arrangement.origin[a] == origin || arrangement.origin[b] == origin) return true;
    const double squared = surface.squared_distance(p, arrangement.places[a], arrangement.places[b]);
    if (squared < least) {
      least = squared;
      nearest.edge = static_cast<std::uint32_t>(i);
    }
    return true;
  });
  nearest.distance = std::sqrt(least);
  return nearest;
}

BoundingBoxTree tree_of_edges(const Surface& surface, const Arrangement& arrangement) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(arrangement.edges.size());
  for (std::size_t i = 0; i < arrangement.edges.size(); ++i) {
    const auto [a, b] = arrangement.ends(i);
    boxes.push_back(box_around(surface, a, b));
  }
  return BoundingBoxTree(boxes);
}

CornerRadii corner_radii(const Surface& surface, const Arrangement& arrangement, double largest) {
  const std::vector<Vec3>& points = arrangement.places;
  const std::vector<OutlineEdge>& edges = arrangement.edges;
  const auto around = neighbors(surface, points, edges);
  std::vector<std::uint8_t> sharp(points.size());
  const std::vector<int> faces = count_faces(arrangement);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_joint = is_joint_of_faces(surface, points, i, around[i], faces[i]);
    sharp[i] = is_joint || is_sharp(surface, points, i, around[i]) ? 1 : 0;
  }
  const BoundingBoxTree tree = tree_of_edges(surface, arrangement);
  CornerRadii radii(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sharp[i] == 0) continue;
    double radius = largest;
    for (const std::int32_t j : around[i]) {
      const double reach = sharp[static_cast<std::size_t>(j)] != 0 ? 1.0 / 3 : 0.5;
      radius = std::min(radius, reach * surface.distance(points[i], points[static_cast<std::size_t>(j)]));
    }
    constexpr double kApart = 0.5;  // of the way to the next thing
    radii[i] = std::min(radius, kApart * nearest_edge(surface, arrangement, tree, i, radius / kApart).distance);
  }
  return radii;
}

CornerRadii within_size(const Arrangement& arrangement, CornerRadii corners, const GradedSize& size) {
  for (const OutlineEdge& e : arrangement.edges) {
    if (e.as != LineKind::faces) continue;
    for (const std::int32_t end : e.ends) {
      double& radius = corners[static_cast<std::size_t>(end)];
      radius = std::min(radius, size(arrangement.place(end)));
    }
  }
  return corners;
}

DividedOutline undivided(const Arrangement& arrangement) {
  DividedOutline whole{arrangement.places, {}};
  for (std::size_t e = 0; e < arrangement.edges.size(); ++e) {
    const auto [a, b] = arrangement.edges[e].ends;
    whole.pieces.push_back(
        {{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)}, static_cast<std::uint32_t>(e), false});
  }
  return whole;
}

DividedOutline divide(const Arrangement& arrangement, const GradedSize& size, const CornerRadii& corners,
                      std::size_t most, Deadline& deadline) {
  // A line that a face meets has its first site at half of the radius, and no division between.
  constexpr double kBesideFaces = 1.3;
  const std::vector<Vec3>& points = arrangement.places;
  const std::vector<OutlineEdge>& edges = arrangement.edges;
  const std::vector<int> faces = count_faces(arrangement);
  const Surface& surface = size.surface();
  DividedOutline divided{points, {}};
  for (std::size_t e = 0; e < edges.size() && divided.pieces.size() <= most && !deadline.stopped(); ++e) {
    const auto a = static_cast<std::uint32_t>(edges[e].ends[0]), b = static_cast<std::uint32_t>(edges[e].ends[1]);
    const SurfacePath path(surface, points[a], points[b]);
    const double whole = path.length();
    const bool is_face = edges[e].as == LineKind::faces;
    const auto radius = [&](std::uint32_t end) {
      return corners[end] * (faces[end] > 0 && !is_face ? kBesideFaces : 1.0);
    };
    const double first = radius(a), last = whole - radius(b);
    std::vector<double> at;
    if (first > 0) at.push_back(first);
    for (const double t : divisions(SurfacePath(surface, path.at(first), path.at(last)), size,
                                    2.0 + static_cast<double>(most), deadline)) {
      at.push_back(first + t);
    }
    if (last < whole) at.push_back(last);
    std::uint32_t from = a;
    for (const double t : at) {
      const auto p = static_cast<std::uint32_t>(divided.points.size());
      divided.points.push_back(path.at(t));
      divided.pieces.push_back({{from, p}, static_cast<std::uint32_t>(e), is_face});
      from = p;
    }
    divided.pieces.push_back({{from, b}, static_cast<std::uint32_t>(e), is_face});
  }
  return divided;
}

double count_pieces(const Surface& surface, const Arrangement& arrangement, double size) {
  double pieces = 0;
  for (std::size_t i = 0; i < arrangement.edges.size(); ++i) {
    const auto [a, b] = arrangement.ends(i);
    const double whole = surface.distance(a, b);
    pieces += std::max(1.0, std::ceil(whole / size));
  }
  return pieces;
}

}  // namespace temper::mesher
