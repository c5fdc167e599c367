#include "places/box_tree.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/assert.hpp"
#include "base/hilbert.hpp"
#include "geometry/predicates_inline.hpp"

namespace temper {
namespace {

constexpr std::size_t kFan = 8;  // boxes under one: their four comparisons each are cheaper than a level more
constexpr double kInfinite = std::numeric_limits<double>::infinity();

Vec2 min_of(Vec2 a, Vec2 b) { return {std::min(a.x, b.x), std::min(a.y, b.y)}; }
Vec2 max_of(Vec2 a, Vec2 b) { return {std::max(a.x, b.x), std::max(a.y, b.y)}; }

/// The point of segment ab that is nearest to p: its parameter and squared distance.
std::pair<double, double> nearest_on_segment(Vec2 a, Vec2 b, Vec2 p) {
  const Vec2 ab = b - a, ap = p - a;
  const double t = std::clamp(dot(ap, ab) / squared_length(ab), 0.0, 1.0);
  return {t, squared_length(ap - t * ab)};
}

NearestPoint nearest_in(const Mesh& mesh, TriangleId t, Vec2 p) {
  NearestPoint best{t, kInfinite, {}, 0};
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
    inside = inside && inlined::orient2d(a, b, p) != Sign::negative;
    const auto [along, d2] = nearest_on_segment(a, b, p);
    if (d2 < best.distance2) best = {t, d2, h, along};
  }
  if (inside) return {t, 0, {}, 0};
  // Outside by less than rounding is outside still.
  best.distance2 = std::max(best.distance2, std::numeric_limits<double>::denorm_min());
  return best;
}

std::vector<TriangleId> along_curve(const Mesh& mesh) {
  Vec2 low{kInfinite, kInfinite}, high{-kInfinite, -kInfinite};
  for (const VertexId v : mesh.vertices()) {
    low = min_of(low, mesh.position(v));
    high = max_of(high, mesh.position(v));
  }
  const HilbertGrid curve(low, high);
  std::vector<std::pair<std::uint64_t, TriangleId>> keyed;
  keyed.reserve(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 third = (1.0 / 3) * mesh.position(a) + (1.0 / 3) * mesh.position(b) + (1.0 / 3) * mesh.position(c);
    keyed.push_back({curve(min_of(max_of(third, low), high)), t});
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<TriangleId> triangles;
  triangles.reserve(keyed.size());
  for (const auto& [key, t] : keyed) triangles.push_back(t);
  return triangles;
}

}  // namespace

BoxTree::BoxTree(const Mesh& mesh) : triangles_(along_curve(mesh)) {
  const auto boxes_for = [](std::size_t n) { return (n + kFan - 1) / kFan; };
  const Box nothing{{kInfinite, kInfinite}, {-kInfinite, -kInfinite}};
  levels_.emplace_back(boxes_for(triangles_.size()), nothing);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    Box& box = levels_[0][i / kFan];
    for (const VertexId v : mesh.corners(triangles_[i])) {
      box = {min_of(box.low, mesh.position(v)), max_of(box.high, mesh.position(v))};
    }
  }
  while (levels_.back().size() > 1) {
    std::vector<Box> above(boxes_for(levels_.back().size()), nothing);
    for (std::size_t i = 0; i < levels_.back().size(); ++i) {
      const Box& below = levels_.back()[i];
      Box& box = above[i / kFan];
      box = {min_of(box.low, below.low), max_of(box.high, below.high)};
    }
    levels_.push_back(std::move(above));
  }
}

NearestPoint BoxTree::nearest(const Mesh& mesh, Vec2 p) const {
  TEMPER_ASSERT(!triangles_.empty() && triangles_.size() == mesh.n_triangles());
  NearestPoint best;
  best.distance2 = kInfinite;
  search(mesh, p, levels_.size() - 1, 0, best);
  return best;
}

double BoxTree::distance2(const Box& box, Vec2 p) {
  const double dx = std::max({box.low.x - p.x, 0.0, p.x - box.high.x});
  const double dy = std::max({box.low.y - p.y, 0.0, p.y - box.high.y});
  return dx * dx + dy * dy;
}

/// Nearer boxes first, so that most others need no look.
void BoxTree::search(const Mesh& mesh, Vec2 p, std::size_t level, std::size_t box, NearestPoint& best) const {
  const std::size_t first = kFan * box;
  if (level == 0) {
    for (std::size_t i = first; i < std::min(first + kFan, triangles_.size()); ++i) {
      const NearestPoint found = nearest_in(mesh, triangles_[i], p);
      if (found.distance2 < best.distance2) best = found;
    }
    return;
  }
  const std::vector<Box>& below = levels_[level - 1];
  std::array<std::pair<double, std::size_t>, kFan> near;
  std::size_t n = 0;
  for (std::size_t i = first; i < std::min(first + kFan, below.size()); ++i) near[n++] = {distance2(below[i], p), i};
  std::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t i = 0; i < n; ++i) {
    if (near[i].first < best.distance2) search(mesh, p, level - 1, near[i].second, best);
  }
}

}  // namespace temper
