#include "surfaces/optimize/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace temper::surfaces {
namespace {

Vec3 on_segment(Vec3 a, Vec3 b, Vec3 p) {
  return a + std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0) * (b - a);
}

double squared_distance(const BoundingBox& box, Vec3 p) {
  const auto outside = [](double x, double low, double high) { return std::max({low - x, 0.0, x - high}); };
  return squared_length(Vec3{outside(p.x, box.low.x, box.high.x), outside(p.y, box.low.y, box.high.y),
                             outside(p.z, box.low.z, box.high.z)});
}

std::vector<ClosestPoints::Triangle> triangles_of(const SurfaceMesh& mesh) {
  std::vector<ClosestPoints::Triangle> triangles;
  triangles.reserve(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    triangles.push_back({p.position(), q.position(), r.position()});
  }
  return triangles;
}

}  // namespace

Vec3 closest_point(const std::array<Vec3, 3>& triangle, Vec3 p) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double bb = squared_length(ab), bc = dot(ab, ac), cc = squared_length(ac), determinant = bb * cc - bc * bc;
  // No number for a segment.
  const double at_b = (cc * dot(ab, ap) - bc * dot(ac, ap)) / determinant;
  const double at_c = (bb * dot(ac, ap) - bc * dot(ab, ap)) / determinant;
  if (at_b >= 0 && at_c >= 0 && at_b + at_c <= 1) return a + at_b * ab + at_c * ac;
  Vec3 best = on_segment(a, b, p);
  if (cc == 0) return best;
  for (const Vec3 other : {on_segment(b, c, p), on_segment(c, a, p)}) {
    if (squared_length(other - p) < squared_length(best - p)) best = other;
  }
  return best;
}

ClosestPoints::ClosestPoints(const SurfaceMesh& mesh) : ClosestPoints(triangles_of(mesh)) {}

ClosestPoints::ClosestPoints(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!order_.empty()) build(0, 0, order_.size());
}

BoundingBox ClosestPoints::box_of(std::size_t first, std::size_t last) const {
  const auto box = [&](std::size_t i) {
    const auto& [a, b, c] = triangles_[order_[i]];
    return united(temper::box_of(a, b), {c, c});
  };
  BoundingBox all = box(first);
  for (std::size_t i = first + 1; i < last; ++i) all = united(all, box(i));
  return all;
}

void ClosestPoints::build(std::size_t node, std::size_t first, std::size_t last) {
  if (boxes_.size() <= node) boxes_.resize(node + 1);
  boxes_[node] = box_of(first, last);
  if (last - first <= kLeaf) return;
  double Vec3::*const axis = boxes_[node].longest();
  const auto middle = [&](std::uint32_t t) {
    const auto& [a, b, c] = triangles_[t];
    return a.*axis + b.*axis + c.*axis;
  };
  const auto before = [&](std::uint32_t s, std::uint32_t t) {
    return middle(s) != middle(t) ? middle(s) < middle(t) : s < t;
  };
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t half = (first + last) / 2;
  std::nth_element(at(first), at(half), at(last), before);
  build(2 * node + 1, first, half);
  build(2 * node + 2, half, last);
}

ClosestPoint ClosestPoints::find(Vec3 p, double enough) const {
  Search state{p, enough * enough, {}};
  state.best.squared_distance = std::numeric_limits<double>::infinity();
  if (!order_.empty()) search(0, 0, order_.size(), state);
  return state.best;
}

void ClosestPoints::search(std::size_t node, std::size_t first, std::size_t last, Search& state) const {
  if (last - first <= kLeaf) {
    ClosestPoint& best = state.best;
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t t = order_[i];
      const Vec3 at = closest_point(triangles_[t], state.p);
      const double distance = squared_length(at - state.p);
      if (distance < best.squared_distance || (distance == best.squared_distance && t < best.triangle))
        best = {at, distance, t};
    }
    return;
  }
  const std::size_t half = (first + last) / 2, left = 2 * node + 1, right = left + 1;
  const double to_left = squared_distance(boxes_[left], state.p), to_right = squared_distance(boxes_[right], state.p);
  const auto may_help = [&](double distance) {
    return distance <= state.best.squared_distance && !(state.best.squared_distance < state.enough2);
  };
  const auto visit_left = [&] {
    if (may_help(to_left)) search(left, first, half, state);
  };
  const auto visit_right = [&] {
    if (may_help(to_right)) search(right, half, last, state);
  };
  if (to_left <= to_right) {
    visit_left(), visit_right();
  } else {
    visit_right(), visit_left();
  }
}

}  // namespace temper::surfaces
