#include "explain/crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "feasibility/constraints.hpp"
#include "temper/geometry.hpp"

namespace temper {
namespace {

// Relative to the edge's length: less disagreement than this is rounding, and no sentence is made of it.
constexpr double kDisagreement = 1e-9;

/// A half plane n · x > offset.
struct HalfPlane {
  Vec2 normal;
  double offset = 0;
  [[nodiscard]] double height(Vec2 x) const { return dot(normal, x) - offset; }
};

/// d from p towards q more than `least`.
HalfPlane beyond(Vec2 p, Vec2 q, double least) {
  const Vec2 along = (1 / length(q - p)) * (q - p);
  return {along, dot(along, p) + least};
}

using Polygon = std::vector<Vec2>;

/// Sutherland and Hodgman, one half plane.
Polygon clip(const Polygon& polygon, const HalfPlane& plane) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = plane.height(a), at_b = plane.height(b);
    if (at_a >= 0) result.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) result.push_back(a + (at_a / (at_a - at_b)) * (b - a));
  }
  return result;
}

Interval feet(const Polygon& polygon, Vec2 p, Vec2 q) {
  const HalfPlane from_p = beyond(p, q, 0);
  Interval interval = {kUnbounded, -kUnbounded};
  for (const Vec2 o : polygon) {
    interval.from = std::min(interval.from, from_p.height(o));
    interval.to = std::max(interval.to, from_p.height(o));
  }
  return interval;
}

/// Passes intervals through a tree of triangles. Positions are taken from a corner of the first triangle on, so that
/// far from the origin no digits are lost.
class Tree {
 public:
  Tree(const Mesh& mesh, std::span<const TriangleId> triangles)
      : mesh_(mesh), triangles_(triangles), origin_(mesh.position(mesh.corners(triangles.front())[0])) {}

  [[nodiscard]] bool has(TriangleId t) const { return std::binary_search(triangles_.begin(), triangles_.end(), t); }

  /// The halfedges with a triangle of the set on both sides, one an edge.
  [[nodiscard]] std::vector<HalfedgeId> shared() const {
    std::vector<HalfedgeId> edges;
    for (const TriangleId t : triangles_) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(t, k);
        if (is_shared(h) && h < mesh_.twin(h)) edges.push_back(h);
      }
    }
    return edges;
  }

  /// Joined by shared edges, and by nothing else: each edge that is passed adds one triangle and one vertex.
  [[nodiscard]] bool is_tree() const {
    std::vector<TriangleId> reached = {triangles_.front()};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(reached[i], k);
        if (!is_shared(h)) continue;
        const TriangleId t = Mesh::triangle(mesh_.twin(h));
        if (std::find(reached.begin(), reached.end(), t) == reached.end()) reached.push_back(t);
      }
    }
    return reached.size() == triangles_.size() && shared().size() + 1 == triangles_.size() &&
           vertices_of(mesh_, triangles_).size() == triangles_.size() + 2;
  }

  /// The crossings of h that suit its triangle and all triangles that hang on it, but not across h, as an interval of
  /// d. Precondition: is_tree().
  [[nodiscard]] CrossingSide side(HalfedgeId h) const {
    CrossingSide result;
    Polygon inside = region_of(h, result);
    const Interval interval = feet(inside, at(mesh_.origin(h)), at(mesh_.target(h)));
    // Clipping leaves the last digits beyond the ends.
    const double l = length(at(mesh_.target(h)) - at(mesh_.origin(h)));
    result.from = std::max(interval.from, 0.0), result.to = std::min(interval.to, l);
    return result;
  }

 private:
  [[nodiscard]] Vec2 at(VertexId v) const { return mesh_.position(v) - origin_; }
  [[nodiscard]] bool is_shared(HalfedgeId h) const {
    return mesh_.twin(h).valid() && has(Mesh::triangle(mesh_.twin(h)));
  }

  void note_angle(HalfedgeId h, CrossingSide& side) const {
    const VertexId p = mesh_.origin(h), q = mesh_.target(h), r = mesh_.opposite(h);
    const double angle = corner_angle(at(p), at(q), at(r)) * (180 / std::numbers::pi);
    if (angle <= side.angle_deg) return;
    side.angle_deg = angle;
    side.widest = p;
  }

  /// The places where the orthocenter of h's triangle may be, given the triangles that hang on its other two edges.
  Polygon region_of(HalfedgeId h, CrossingSide& side) const {
    side.triangles.push_back(Mesh::triangle(h));
    Polygon region;
    for (const HalfedgeId e : {h, Mesh::next(h), Mesh::prev(h)}) region.push_back(at(mesh_.origin(e)));
    for (const HalfedgeId e : {h, Mesh::next(h), Mesh::prev(h)}) {
      note_angle(e, side);
      const Vec2 p = at(mesh_.origin(e)), q = at(mesh_.target(e));
      region = clip(clip(region, beyond(p, q, 0)), beyond(q, p, 0));
    }
    for (const HalfedgeId e : {Mesh::next(h), Mesh::prev(h)}) {
      if (!is_shared(e)) continue;
      const HalfedgeId across = mesh_.twin(e);  // q → p of e = p → q
      const Vec2 p = at(mesh_.origin(across)), q = at(mesh_.target(across));
      const Interval interval = feet(region_of(across, side), p, q);
      region = clip(clip(region, beyond(p, q, interval.from)), beyond(q, p, length(q - p) - interval.to));
    }
    return region;
  }

  const Mesh& mesh_;
  std::span<const TriangleId> triangles_;
  Vec2 origin_;
};

}  // namespace

Interval crossing_interval(Vec2 p, Vec2 q, Vec2 r) {
  const Vec2 pq = q - p, pr = r - p, qr = r - q;
  const double c = length(pq);
  const double at_p = dot(pq, pr), at_q = -dot(pq, qr), at_r = dot(pr, qr);  // b c cos A, a c cos B, a b cos C
  const double doubled = cross(pq, pr);                                      // b c sin A = a c sin B = a b sin C
  if (at_r < 0) return {c - squared_length(qr) * c / at_q, squared_length(pr) * c / at_p};
  if (at_p < 0) return {0, doubled / c * (doubled / at_r)};
  if (at_q < 0) return {c - doubled / c * (doubled / at_r), c};
  return {0, c};
}

std::optional<CrossingConflict> crossing_conflict(const Mesh& mesh, std::span<const TriangleId> triangles) {
  if (triangles.size() < 2) return std::nullopt;
  const Tree tree(mesh, triangles);
  if (!tree.is_tree()) return std::nullopt;
  std::optional<CrossingConflict> worst;
  double most = kDisagreement;
  for (const HalfedgeId h : tree.shared()) {
    CrossingConflict conflict;
    conflict.p = mesh.origin(h), conflict.q = mesh.target(h);
    conflict.length = length(mesh.position(conflict.q) - mesh.position(conflict.p));
    conflict.left = tree.side(h);
    conflict.right = tree.side(mesh.twin(h));  // along q → p
    std::swap(conflict.right.from, conflict.right.to);
    conflict.right.from = conflict.length - conflict.right.from;
    conflict.right.to = conflict.length - conflict.right.to;
    const double gap = std::max(conflict.right.from - conflict.left.to, conflict.left.from - conflict.right.to);
    // A side that admits no crossing at all is no smallest set: its interval is infinite.
    if (!std::isfinite(gap) || gap / conflict.length <= most) continue;
    most = gap / conflict.length;
    worst = std::move(conflict);
  }
  return worst;
}

}  // namespace temper
