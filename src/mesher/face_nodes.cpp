#include "mesher/face_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace temper::mesher {
namespace {

// Part of the shortest piece. A larger radius keeps other vertices farther away; a smaller one needs larger weights.
constexpr double kRadius = 0.6;

Vec2 in_plane(Vec3 p) { return {p.x, p.y}; }

FaceNodes with_branches(const DividedOutline& divided) {
  FaceNodes result;
  result.of_point.assign(divided.points.size(), -1);
  for (const Piece& p : divided.pieces) {
    for (const std::uint32_t end : p.ends) {
      if (!p.is_face || result.of_point[end] >= 0) continue;
      result.of_point[end] = static_cast<std::int32_t>(result.nodes.size());
      result.nodes.push_back({end, in_plane(divided.points[end]), {}, 0, 0});
    }
  }
  for (std::uint32_t i = 0; i < divided.pieces.size(); ++i) {
    const Piece& p = divided.pieces[i];
    for (const std::size_t end : {0, 1}) {
      if (result.of_point[p.ends.at(end)] < 0) continue;
      FaceNode& node = result.nodes[static_cast<std::size_t>(result.of_point[p.ends.at(end)])];
      const std::uint32_t far = p.ends.at(1 - end);
      const Vec2 way = in_plane(divided.points[far]) - node.at;
      const double whole = length(way);
      node.branches.push_back({i, far, end == 0, p.is_face, (1 / whole) * way, whole, 0});
    }
  }
  return result;
}

void sort_branches(FaceNode& node) {
  const auto angle = [](const Branch& b) { return std::atan2(b.direction.y, b.direction.x); };
  std::sort(node.branches.begin(), node.branches.end(), [&](const Branch& a, const Branch& b) {
    return angle(a) < angle(b) || (angle(a) == angle(b) && a.piece < b.piece);
  });
  node.size = std::numeric_limits<double>::infinity();
  for (const Branch& b : node.branches) {
    if (b.is_face) node.size = std::min(node.size, b.length);
  }
  node.radius = kRadius * node.size;
}

bool is_joint(const FaceNode& node) {
  if (node.branches.size() != 2) return node.branches.size() > 2;
  const Branch &a = node.branches[0], &b = node.branches[1];
  return !a.is_face || !b.is_face || dot(a.direction, b.direction) > kSharedCosine;
}

/// The nodes next to a joint get one radius. A node may be next to two joints, so these make groups.
void make_equal_beside_joints(FaceNodes& all) {
  std::vector<std::size_t> group(all.nodes.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto first = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  for (const FaceNode& node : all.nodes) {
    if (!is_joint(node)) continue;
    std::size_t one = all.nodes.size();
    for (const Branch& b : node.branches) {
      if (!b.is_face) continue;
      const std::size_t other = first(static_cast<std::size_t>(all.of_point[b.far]));
      one = one == all.nodes.size() ? other : first(one);
      group[std::max(one, other)] = std::min(one, other);
    }
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    double& least = all.nodes[first(i)].radius;
    least = std::min(least, all.nodes[i].radius);
  }
  for (std::size_t i = 0; i < group.size(); ++i) all.nodes[i].radius = all.nodes[first(i)].radius;
}

void find_reaches(FaceNodes& all) {
  for (FaceNode& node : all.nodes) {
    double sum = 0;
    int faces = 0;
    for (Branch& b : node.branches) {
      if (!b.is_face) continue;
      const double far = all.at(b.far)->radius, l = b.length;
      b.reach = (l * l + node.radius * node.radius - far * far) / (2 * l);
      sum += b.reach;
      ++faces;
    }
    constexpr double kMost = 0.8;  // of a piece of a line: its next vertex is not far
    for (Branch& b : node.branches) {
      if (!b.is_face) b.reach = std::min(sum / faces, kMost * b.length);
    }
  }
}

}  // namespace

double angle_between(Vec2 u, Vec2 v) {
  const double angle = std::atan2(cross(u, v), dot(u, v));
  return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

double FaceNode::angle_after(std::size_t i) const {
  return branches.size() == 1 ? 2 * std::numbers::pi
                              : angle_between(branches[i].direction, branches[after(i)].direction);
}

std::size_t FaceNode::count_lines() const {
  return static_cast<std::size_t>(std::ranges::count_if(branches, [](const Branch& b) { return !b.is_face; }));
}

FaceNodes face_nodes(const DividedOutline& divided) {
  FaceNodes all = with_branches(divided);
  for (FaceNode& node : all.nodes) sort_branches(node);
  make_equal_beside_joints(all);
  find_reaches(all);
  return all;
}

}  // namespace temper::mesher
