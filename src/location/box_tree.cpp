#include "location/box_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/assert.hpp"
#include "base/hilbert.hpp"
#include "geometry/predicates_inline.hpp"
#include "location/position_of.hpp"

namespace temper {
namespace {

constexpr std::size_t kFan = 8;  // boxes under one: their four comparisons each are cheaper than a level more
constexpr double kInfinite = std::numeric_limits<double>::infinity();

Vec3 min_of(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 max_of(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

/// The point of segment ab that is nearest to p: its parameter and squared distance.
std::pair<double, double> nearest_on_segment(Vec3 a, Vec3 b, Vec3 p) {
  const Vec3 ab = b - a, ap = p - a;
  const double t = std::clamp(dot(ap, ab) / squared_length(ab), 0.0, 1.0);
  return {t, squared_length(ap - t * ab)};
}

}  // namespace

std::vector<TriangleId> along_curve(const Mesh& mesh) {
  Vec3 low{kInfinite, kInfinite, kInfinite}, high = -1 * low;
  for (const VertexId v : mesh.vertices()) {
    low = min_of(low, position_of(mesh, v));
    high = max_of(high, position_of(mesh, v));
  }
  const HilbertGrid curve(PlaneBox{{low.x, low.y}, {high.x, high.y}});
  std::vector<std::pair<std::uint64_t, TriangleId>> keyed;
  keyed.reserve(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = positions_of(mesh, t);
    const Vec3 third = (1.0 / 3) * a + (1.0 / 3) * b + (1.0 / 3) * c;
    const Vec3 inside = min_of(max_of(third, low), high);
    keyed.emplace_back(mesh.space().dimension() == 2 ? curve({inside.x, inside.y}) : cube_hilbert_index(third), t);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<TriangleId> triangles;
  triangles.reserve(keyed.size());
  for (const auto& [key, t] : keyed) triangles.push_back(t);
  return triangles;
}

/// On the sphere the box also covers the part of the sphere above the triangle.
BoxTree::Box BoxTree::box_of(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = positions_of(mesh, t);
  Box box = {min_of(min_of(a, b), c), max_of(max_of(a, b), c)};
  if (mesh.space().dimension() == 2) return box;
  const Vec3 n = cross(b - a, c - a);
  const double above = 1 - std::abs(dot(n, a)) / length(n);
  const Vec3 margin = {above, above, above};
  return {box.low - margin, box.high + margin};
}

BoxTree::Box BoxTree::around(const Box& a, const Box& b) { return {min_of(a.low, b.low), max_of(a.high, b.high)}; }

BoxTree::BoxTree(const Mesh& mesh) : triangles_(along_curve(mesh)) {
  const auto boxes_for = [](std::size_t n) { return (n + kFan - 1) / kFan; };
  const Vec3 end{kInfinite, kInfinite, kInfinite};
  const Box nothing{end, -1 * end};
  levels_.emplace_back(boxes_for(triangles_.size()), nothing);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    Box& box = levels_[0][i / kFan];
    box = around(box, box_of(mesh, triangles_[i]));
  }
  while (levels_.back().size() > 1) {
    std::vector<Box> above(boxes_for(levels_.back().size()), nothing);
    for (std::size_t i = 0; i < levels_.back().size(); ++i) {
      above[i / kFan] = around(above[i / kFan], levels_.back()[i]);
    }
    levels_.push_back(std::move(above));
  }
}

NearestPoint BoxTree::nearest_in(const Mesh& mesh, TriangleId t, const Asked& p) {
  NearestPoint best{t, kInfinite, {}, 0};
  bool inside = true;
  const std::array<WeightedPoint, 3> corners = mesh.points(t);
  for (std::size_t k = 0; k < 3; ++k) {
    const WeightedPoint &a = corners[k], &b = corners[k == 2 ? 0 : k + 1];
    inside = inside && inlined::orientation(mesh.space(), a, b, p.point) != Sign::negative;
    const auto [along, d2] = nearest_on_segment(position_of(mesh.space(), a), position_of(mesh.space(), b), p.place);
    if (d2 < best.distance2) best = {t, d2, Mesh::halfedge(t, static_cast<int>(k)), along};
  }
  if (inside) return {t, 0, {}, 0};
  // A point that is outside by less than rounding still is outside.
  best.distance2 = std::max(best.distance2, std::numeric_limits<double>::denorm_min());
  return best;
}

NearestPoint BoxTree::nearest(const Mesh& mesh, const WeightedPoint& p) const {
  TEMPER_ASSERT(!triangles_.empty() && triangles_.size() == mesh.n_triangles());
  NearestPoint best;
  best.distance2 = kInfinite;
  const auto look_for = [&](const WeightedPoint& q) {
    search(mesh, {q, position_of(mesh.space(), q)}, levels_.size() - 1, 0, best);
  };
  if (!mesh.space().is_periodic()) {
    look_for(p);
    return best;
  }
  // Boxes are of triangles as seen from their first corner, which is in the domain: less than half a period around it.
  const WeightedPoint q = mesh.space().in_domain(p);
  const auto [x, y] = mesh.space().period();
  for (int i = x > 0 ? -1 : 0; i <= (x > 0 ? 1 : 0); ++i) {
    for (int j = y > 0 ? -1 : 0; j <= (y > 0 ? 1 : 0); ++j) look_for({q.x + i * x, q.y + j * y, q.w});
  }
  return best;
}

double BoxTree::distance2(const Box& box, Vec3 p) {
  const double dx = std::max({box.low.x - p.x, 0.0, p.x - box.high.x});
  const double dy = std::max({box.low.y - p.y, 0.0, p.y - box.high.y});
  const double dz = std::max({box.low.z - p.z, 0.0, p.z - box.high.z});
  return dx * dx + dy * dy + dz * dz;
}

/// Searches nearer boxes first, so that most others are skipped.
void BoxTree::search(const Mesh& mesh, const Asked& p, std::size_t level, std::size_t box, NearestPoint& best) const {
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
  for (std::size_t i = first; i < std::min(first + kFan, below.size()); ++i)
    near[n++] = {distance2(below[i], p.place), i};
  std::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t i = 0; i < n; ++i) {
    if (near[i].first < best.distance2) search(mesh, p, level - 1, near[i].second, best);
  }
}

}  // namespace temper
