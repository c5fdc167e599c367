#include "explain/conflict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "feasibility/certify.hpp"
#include "feasibility/constraints.hpp"
#include "geometry/surface.hpp"
#include "quality/measure.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::size_t kFew = 60;  // a program for each is well below a second

/// Sorts triangles by the order in which to drop them: good ones before bad ones, whatever their numbers.
void sort_for_dropping(const Mesh& mesh, TriangleId kept, std::vector<TriangleId>& triangles) {
  struct Key {
    double margin;
    Vec2 at;
    TriangleId triangle;
  };
  std::vector<Key> keys;
  keys.reserve(triangles.size());
  for (const TriangleId t : triangles) keys.push_back({measure_triangle(mesh, t).margin(), middle_of(mesh, t), t});
  std::sort(keys.begin(), keys.end(), [kept](const Key& a, const Key& b) {
    if ((a.triangle == kept) != (b.triangle == kept)) return b.triangle == kept;
    if (a.margin != b.margin) return a.margin > b.margin;
    return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
  });
  for (std::size_t i = 0; i < keys.size(); ++i) triangles[i] = keys[i].triangle;
}

BestMargin best_of(const Weighing& weighing, std::span<const TriangleId> triangles, LpSolver& solver) {
  std::vector<TriangleId> sorted(triangles.begin(), triangles.end());
  std::sort(sorted.begin(), sorted.end());
  return best_margin_of(weighing.demand, as_cells(sorted), solver);
}

bool is_refuted(const BestMargin& best) { return !best.certificate.terms.empty(); }

std::optional<Conflict> drop_what_can_be(const Weighing& weighing, std::vector<TriangleId> triangles, TriangleId kept,
                                         LpSolver& solver) {
  BestMargin best = best_of(weighing, triangles, solver);
  if (!is_refuted(best)) return std::nullopt;
  sort_for_dropping(weighing.mesh, kept, triangles);
  for (std::size_t i = 0; i < triangles.size();) {
    std::vector<TriangleId> fewer = triangles;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    BestMargin without = fewer.empty() ? BestMargin() : best_of(weighing, fewer, solver);
    if (is_refuted(without)) {
      triangles = std::move(fewer);
      best = std::move(without);
    } else {
      ++i;
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return Conflict{std::move(triangles), std::move(best)};
}

/// The triangles that the terms name. A crossing names both sides of its edge, unless a height has named one already.
/// An equation of an interface does so for the edges on both of its sides. Only triangles of `among`, unless it is
/// empty.
std::vector<TriangleId> triangles_of(const Mesh& mesh, const Certificate& certificate,
                                     std::span<const TriangleId> among) {
  std::vector<TriangleId> triangles;
  const auto is_in = [](std::span<const TriangleId> set, TriangleId t) {
    return std::find(set.begin(), set.end(), t) != set.end();
  };
  const auto add = [&](TriangleId t) {
    if (!is_in(triangles, t) && (among.empty() || is_in(among, t))) triangles.push_back(t);
  };
  for (const auto& [constraint, multiplier] : certificate.terms) {
    if (constraint.kind == WeightConstraint::Kind::height) {
      add(Mesh::triangle(mesh.find_halfedge(constraint.p, constraint.q)));
    }
  }
  const std::size_t by_height = triangles.size();
  for (const auto& [constraint, multiplier] : certificate.terms) {
    if (constraint.kind == WeightConstraint::Kind::height) continue;
    const auto add_sides = [&](VertexId p, VertexId q) {
      std::vector<TriangleId> sides;
      for (const HalfedgeId h : {mesh.find_halfedge(p, q), mesh.find_halfedge(q, p)}) {
        if (h.valid()) sides.push_back(Mesh::triangle(h));
      }
      const auto named = [&](TriangleId t) { return is_in(std::span(triangles).first(by_height), t); };
      if (std::none_of(sides.begin(), sides.end(), named)) std::for_each(sides.begin(), sides.end(), add);
    };
    add_sides(constraint.p, constraint.q);
    if (is_equation(constraint)) add_sides(constraint.r, constraint.s);
  }
  return triangles;
}

bool has_corner(const Mesh& mesh, TriangleId t, VertexId v) {
  const auto corners = mesh.corners(t);
  return std::find(corners.begin(), corners.end(), v) != corners.end();
}

/// The angle of the domain at v; a full turn inside.
double angle_around(const Mesh& mesh, VertexId v) {
  if (!mesh.is_boundary(v)) return 360;
  double angle = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    angle += corner_angle(mesh.space(), mesh.point(v), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h)));
  }
  return angle * kDegrees;
}

}  // namespace

std::optional<Conflict> shrink(const Weighing& weighing, const Certificate& certificate, TriangleId kept,
                               LpSolver& solver) {
  return drop_what_can_be(weighing, triangles_of(weighing.mesh, certificate, {}), kept, solver);
}

std::optional<Conflict> find_conflict(const Weighing& weighing, std::span<const TriangleId> triangles, TriangleId kept,
                                      LpSolver& solver) {
  if (triangles.empty()) return std::nullopt;
  const BestMargin best = best_of(weighing, triangles, solver);
  if (!is_refuted(best)) return std::nullopt;
  if (auto conflict =
          drop_what_can_be(weighing, triangles_of(weighing.mesh, best.certificate, triangles), kept, solver)) {
    return conflict;
  }
  // The certificate used triangles without a term, to bound a residual.
  if (triangles.size() > kFew) return std::nullopt;
  return drop_what_can_be(weighing, std::vector<TriangleId>(triangles.begin(), triangles.end()), kept, solver);
}

std::optional<FanCenter> fan_center(const Mesh& mesh, std::span<const TriangleId> triangles) {
  const Surface surface(mesh.space());
  std::optional<FanCenter> center;
  double widest = -1;
  for (const VertexId v : mesh.corners(triangles.front())) {
    const auto has_v = [&](TriangleId t) { return has_corner(mesh, t, v); };
    if (!std::all_of(triangles.begin(), triangles.end(), has_v)) continue;
    FanCenter here;
    here.vertex = v;
    here.on_boundary = mesh.is_boundary(v);
    here.angle_deg = angle_around(mesh, v);
    here.shortest_length = kUnbounded;
    double angle = 0;
    for (const TriangleId t : triangles) {
      const auto corners = mesh.corners(t);
      const std::size_t k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
      const VertexId next = corners[(k + 1) % 3], last = corners[(k + 2) % 3];
      angle = std::max(angle, corner_angle(mesh.space(), mesh.point(v), mesh.point(next), mesh.point(last)));
      for (const VertexId u : {next, last}) {
        const double l = surface.distance(surface.place(mesh.point(v)), surface.place(mesh.point(u)));
        if (l < here.shortest_length) here.shortest_length = l, here.shortest = u;
        if (l > here.longest_length) here.longest_length = l, here.longest = u;
      }
    }
    // If there are two common vertices, a corner of the domain is preferred, then the larger angle.
    const double rank = angle + (here.on_boundary ? 10 : 0);
    if (rank <= widest) continue;
    widest = rank;
    center = here;
  }
  return center;
}

ReasonKind kind_of(const Conflict& conflict, bool has_center, bool has_crossing) {
  if (!has_crossing) return ReasonKind::patch;
  if (conflict.triangles.size() == 2) return ReasonKind::edge;
  return has_center ? ReasonKind::fan : ReasonKind::patch;
}

bool suits(const Mesh& mesh, std::span<const TriangleId> triangles, const BestMargin& best) {
  const auto at = [&](VertexId v) {
    const auto found = std::lower_bound(best.vertices.begin(), best.vertices.end(), v);
    return point_with_weight(mesh, v, best.weights[static_cast<std::size_t>(found - best.vertices.begin())]);
  };
  return std::all_of(triangles.begin(), triangles.end(), [&](TriangleId t) {
    const auto [p, q, r] = mesh.corners(t);
    return is_well_centered(mesh.space(), at(p), at(q), at(r));
  });
}

std::vector<VertexId> free_vertices(const Mesh& mesh, std::span<const TriangleId> triangles) {
  std::vector<VertexId> vertices;
  std::vector<TriangleId> sorted(triangles.begin(), triangles.end());
  std::sort(sorted.begin(), sorted.end());
  for (const VertexId v : vertices_of(mesh, sorted)) {
    bool free = !mesh.is_boundary(v) && !mesh.is_fixed(v);
    for (const HalfedgeId h : mesh.star(v)) free = free && !mesh.is_constrained(h);
    if (free) vertices.push_back(v);
  }
  return vertices;
}

namespace {

// Relative to the edge's length: less disagreement than this is rounding, and no sentence mentions it.
constexpr double kDisagreement = 1e-9;

/// A half plane or a hemisphere: n · x > 0. Here x is (x, y, 1) in the plane, and a direction on the sphere.
struct HalfSpace {
  Vec3 normal;
  [[nodiscard]] double height(Vec3 x) const { return dot(normal, x); }
};

using Polygon = std::vector<Vec3>;

/// Sutherland and Hodgman, one half space.
Polygon clip(const Polygon& polygon, const HalfSpace& space) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = space.height(a), at_b = space.height(b);
    if (at_a >= 0) result.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) result.push_back(a + (at_a / (at_a - at_b)) * (b - a));
  }
  return result;
}

/// The segment from p to q, and the interval of feet on it.
class Segment {
 public:
  Segment(const Space& space, Vec3 p, Vec3 q) : space_(space), p_(p) {
    const Vec3 way = space.is_plane() ? q - p : (q - p) - dot(q - p, p) * p;
    along_ = (1 / length(way)) * way;
  }
  /// d from p more than `least`.
  [[nodiscard]] HalfSpace beyond(double least) const {
    if (space_.is_plane()) return {{along_.x, along_.y, -(dot(along_, p_) + least)}};
    const double angle = least / space_.radius();
    return {std::cos(angle) * along_ - std::sin(angle) * p_};
  }
  /// d of the foot of the perpendicular from o.
  [[nodiscard]] double foot(Vec3 o) const {
    if (space_.is_plane()) return beyond(0).height(o);
    return space_.radius() * std::atan2(dot(o, along_), dot(o, p_));
  }
  /// d is monotone along every side of a polygon, so its range is between values at corners.
  [[nodiscard]] Interval feet(const Polygon& polygon) const {
    Interval interval = {kUnbounded, -kUnbounded};
    for (const Vec3 o : polygon) {
      interval.from = std::min(interval.from, foot(o));
      interval.to = std::max(interval.to, foot(o));
    }
    return interval;
  }

 private:
  const Space& space_;
  Vec3 p_, along_;  // on the sphere of length 1
};

/// Passes intervals through a tree of triangles. Positions in the plane are relative to a corner of the first triangle,
/// so that no digits are lost far from the origin.
class Tree {
 public:
  Tree(const Mesh& mesh, std::span<const TriangleId> triangles)
      : mesh_(mesh), triangles_(triangles), origin_(mesh.position(mesh.corners(triangles.front())[0])) {}

  [[nodiscard]] double length_of(HalfedgeId h) const {
    const Vec3 p = at(mesh_.origin(h)), q = at(mesh_.target(h));
    return space().is_plane() ? length(q - p) : space().radius() * arc_length(p, q);
  }

  [[nodiscard]] bool has(TriangleId t) const { return std::binary_search(triangles_.begin(), triangles_.end(), t); }

  /// The halfedges with a triangle of the set on both sides, one for each edge.
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

  /// Joined by shared edges, and by nothing else: each shared edge adds one triangle and one vertex.
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
    const Interval interval = from_origin(h).feet(inside);
    // Clipping moves the last digits beyond the ends.
    result.from = std::max(interval.from, 0.0), result.to = std::min(interval.to, length_of(h));
    return result;
  }

 private:
  [[nodiscard]] const Space& space() const { return mesh_.space(); }
  [[nodiscard]] Vec3 at(VertexId v) const {
    if (!space().is_plane()) return (1 / length(mesh_.weighted_vector(v))) * mesh_.weighted_vector(v);
    const Vec2 p = mesh_.position(v) - origin_;
    return {p.x, p.y, 1};
  }
  [[nodiscard]] Segment from_origin(HalfedgeId h) const { return {space(), at(mesh_.origin(h)), at(mesh_.target(h))}; }
  [[nodiscard]] Segment from_target(HalfedgeId h) const { return {space(), at(mesh_.target(h)), at(mesh_.origin(h))}; }
  [[nodiscard]] bool is_shared(HalfedgeId h) const {
    return mesh_.twin(h).valid() && has(Mesh::triangle(mesh_.twin(h)));
  }

  void note_angle(HalfedgeId h, CrossingSide& side) const {
    const VertexId p = mesh_.origin(h), q = mesh_.target(h), r = mesh_.opposite(h);
    const double angle =
        corner_angle(space(), mesh_.point(p), mesh_.point(q), mesh_.point(r)) * (180 / std::numbers::pi);
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
      region = clip(clip(region, from_origin(e).beyond(0)), from_target(e).beyond(0));
    }
    for (const HalfedgeId e : {Mesh::next(h), Mesh::prev(h)}) {
      if (!is_shared(e)) continue;
      const HalfedgeId across = mesh_.twin(e);  // q → p of e = p → q
      const Segment segment = from_origin(across);
      const Interval interval = segment.feet(region_of(across, side));
      region = clip(clip(region, segment.beyond(interval.from)),
                    from_target(across).beyond(length_of(across) - interval.to));
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
    conflict.length = tree.length_of(h);
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
