// The two-disc condition of one edge. A walk from its triangles finds the vertices that stay and see the edge. They are
// sorted by their bounds, exactly, and the first visible vertex on each end decides.
//
// With a + b ≤ S both bounds are below S. So both vertices lie in the discs with diameters from u to u + S (v − u) and
// from v to v + S (u − v). For S ≥ 1 the triangles u v X lie there, too, and all that hides X. So the smallest disc
// around both discs contains everything; on the sphere it is a cap. There a point between u and v is the direction of
// (1 − s) U + s V, U and V their weighted vectors. The points that see a diameter at a right angle form a cone of the
// second order.
#include "temper/detail/necessity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <type_traits>
#include <unordered_set>
#include <utility>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "feasibility/exact_number.hpp"
#include "geometry/predicates_inline.hpp"
#include "mesh/bad_triangles.hpp"

namespace temper {
namespace {

using exact::Number;

// Relative to the largest distance involved: far more than the dozen roundings of a distance. The walk may go a bit too
// far, never too short.
constexpr double kWalkSlack = 1e-12;
// Relative roundings of |X − u|² and of a quotient: below 8 units; of a product of vectors, relative to its permanent.
constexpr double kRounding = 8 * 0x1p-53;
// The bound for two products of vectors that are multiplied, relative to the four lengths: below 40 units.
constexpr double kRoundingOnSphere = 64 * 0x1p-53;

/// A double, and an upper bound of its distance from the exact number.
struct Rounded {
  double value = 0, error = 0;
};

// a(X) as a quotient, rounded and exact: |X − near|² / ((far − near)·(X − near)).

Rounded numerator_of(Vec2 near, Vec2 /*far*/, Vec2 at) {
  const double value = squared_length(at - near);
  return {value, kRounding * value};
}
Rounded denominator_of(Vec2 near, Vec2 far, Vec2 at) {
  const Vec2 along = far - near, to = at - near;
  return {dot(along, to), kRounding * (std::abs(along.x * to.x) + std::abs(along.y * to.y))};
}

Number product(Vec2 from, Vec2 a, Vec2 b) {
  return Number::difference(a.x, from.x) * Number::difference(b.x, from.x) +
         Number::difference(a.y, from.y) * Number::difference(b.y, from.y);
}
Number exact_numerator_of(Vec2 near, Vec2 /*far*/, Vec2 at) { return product(near, at, at); }
Number exact_denominator_of(Vec2 near, Vec2 far, Vec2 at) { return product(near, far, at); }

// On the sphere |near × X|² / ((near × X)·((near − far) × X)). Products with X − near lose no digits if X is near.

Rounded numerator_of(Vec3 near, Vec3 /*far*/, Vec3 at) {
  const Vec3 to = at - near;
  return {squared_length(cross(near, to)), kRoundingOnSphere * squared_length(near) * squared_length(to)};
}
Rounded denominator_of(Vec3 near, Vec3 far, Vec3 at) {
  const Vec3 back = near - far, to = at - near;
  return {dot(cross(near, to), cross(back, at)),
          kRoundingOnSphere * length(near) * length(to) * length(back) * length(at)};
}

std::array<Number, 3> exact_cross(Vec3 a, Vec3 b) {
  const auto minor = [](double a0, double b1, double a1, double b0) {
    return Number(a0) * Number(b1) - Number(a1) * Number(b0);
  };
  return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}
Number exact_dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Number exact_numerator_of(Vec3 near, Vec3 /*far*/, Vec3 at) {
  const auto normal = exact_cross(near, at);
  return exact_dot(normal, normal);
}
Number exact_denominator_of(Vec3 near, Vec3 far, Vec3 at) {
  const auto normal = exact_cross(near, at);
  return exact_dot(normal, normal) - exact_dot(normal, exact_cross(far, at));
}

/// A vertex a quarter of a great circle away, or further, does not bound the crossing.
bool can_bound(Vec2 /*near*/, Vec2 /*at*/) { return true; }
bool can_bound(Vec3 near, Vec3 at) { return dot(near, at) > kRoundingOnSphere * length(near) * length(at); }

/// The part of the edge, from `near`, in which the dual must cross it.
template <class Point>
struct CrossingBound {
  VertexId vertex;
  double value = 0, error = 0;  ///< rounded, and by how much at most
  Point near, far, at;

  [[nodiscard]] Number numerator() const { return exact_numerator_of(near, far, at); }
  [[nodiscard]] Number denominator() const { return exact_denominator_of(near, far, at); }

  friend bool operator<(const CrossingBound& x, const CrossingBound& y) {
    if (std::abs(x.value - y.value) > x.error + y.error) return x.value < y.value;
    const Sign sign = (x.numerator() * y.denominator() - y.numerator() * x.denominator()).sign();
    return sign == Sign::zero ? x.vertex < y.vertex : sign == Sign::negative;
  }
};

/// a + b ≤ up_to, exactly.
template <class Point>
bool is_at_most(const CrossingBound<Point>& a, const CrossingBound<Point>& b, double up_to) {
  const double sum = a.value + b.value, error = a.error + b.error + kRounding * sum;
  if (std::abs(sum - up_to) > error) return sum < up_to;
  const Number da = a.denominator(), db = b.denominator();
  const Number limit = up_to == 1 ? da * db : Number(up_to) * (da * db);
  return (a.numerator() * db + b.numerator() * da - limit).sign() != Sign::positive;
}

/// None when X does not bound the crossing below up_to, and so cannot be part of a conflict.
template <class Point>
std::optional<CrossingBound<Point>> bound_of(VertexId vertex, Point at, Point near, Point far, double up_to) {
  if (!can_bound(near, at)) return std::nullopt;
  const Rounded numerator = numerator_of(near, far, at), denominator = denominator_of(near, far, at);
  const double error = denominator.error;
  if (denominator.value + error < 0 || numerator.value > 2 * up_to * (denominator.value + error)) return std::nullopt;
  CrossingBound<Point> bound = {vertex, numerator.value / denominator.value, 0, near, far, at};
  if (denominator.value <= 2 * error) {  // even the sign is not known
    if (bound.denominator().sign() != Sign::positive) return std::nullopt;
    bound.value = bound.numerator().approximation() / bound.denominator().approximation();
    bound.error = kRounding * bound.value;
  } else {
    bound.error = bound.value * (numerator.error / numerator.value + 2 * error / denominator.value);
  }
  return bound;
}

/// A vertex that no optimization moves, except along its line.
bool stays(const Mesh& mesh, VertexId v) {
  if (mesh.is_fixed(v) || mesh.is_boundary(v)) return true;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_constrained(h)) return true;
  }
  return false;
}

bool is_left(Vec2 x, Vec2 y, Vec2 z) { return inlined::orient2d(x, y, z) == Sign::positive; }
bool is_left(Vec3 x, Vec3 y, Vec3 z) { return orientation(x, y, z) == Sign::positive; }

template <class Point>
Point point_of(const Mesh& mesh, VertexId v) {
  if constexpr (std::is_same_v<Point, Vec2>)
    return mesh.position(v);
  else
    return mesh.weighted_vector(v);
}

template <class Point>
struct Segment {
  Point p, q;
};

/// Says whether pq meets the inside of the counter-clockwise triangle abc. It does if no line along one of the four
/// separates them.
template <class Point>
bool meets_inside(const Segment<Point>& s, Point a, Point b, Point c) {
  const auto side_separates = [&](Point x, Point y) { return !is_left(x, y, s.p) && !is_left(x, y, s.q); };
  if (side_separates(a, b) || side_separates(b, c) || side_separates(c, a)) return false;
  const bool any_left = is_left(s.p, s.q, a) || is_left(s.p, s.q, b) || is_left(s.p, s.q, c);
  const bool any_right = is_left(s.q, s.p, a) || is_left(s.q, s.p, b) || is_left(s.q, s.p, c);
  return any_left && any_right;
}

/// A disc with everything that can bound the crossing of uv below up_to, from u or from v.
class Disc {
 public:
  Disc(Vec2 u, Vec2 v, double up_to) : u_(u), along_(v - u), radius_((up_to - 0.5) * length(along_)) {}
  [[nodiscard]] bool meets(Vec2 p, Vec2 q) const {
    const Vec2 center = 0.5 * along_;  // seen from u: differences round relative to themselves
    const Vec2 from = (p - u_) - center, pq = q - p;
    const double t = std::clamp(-dot(from, pq) / squared_length(pq), 0.0, 1.0);
    const double slack = kWalkSlack * (length(from) + length(pq) + length(along_));
    return length(from + t * pq) <= radius_ + slack;
  }

 private:
  Vec2 u_, along_;
  double radius_;
};

/// The search region on the sphere, a cap; the whole sphere if the cap is not smaller than a hemisphere.
class Cap {
 public:
  Cap(Vec3 u, Vec3 v, double up_to) : center_(middle(u, v)), radius_(kWalkSlack) {
    for (const auto& [near, far] : {std::pair(u, v), std::pair(v, u)}) {
      const Vec3 end = (1 - up_to) * near + up_to * far;
      const double diameter = arc_length(near, end);
      // Points that see the diameter at a right angle or a wider one are at most this far from its midpoint.
      const double reach =
          std::cos(diameter) > 0 ? std::atan(std::sin(diameter / 2) / std::sqrt(std::cos(diameter))) : std::numbers::pi;
      radius_ = std::max(radius_, arc_length(center_, middle(near, end)) + reach + kWalkSlack);
    }
    if (radius_ > std::numbers::pi / 2) radius_ = 2 * std::numbers::pi;
  }
  [[nodiscard]] bool meets(Vec3 p, Vec3 q) const {
    const Vec3 normal = cross(p, q);
    if (dot(cross(normal, p), center_) > 0 && dot(cross(q, normal), center_) > 0) {
      return std::asin(std::min(1.0, std::abs(dot(normal, center_)) / length(normal))) <= radius_;
    }
    return std::min(arc_length(center_, p), arc_length(center_, q)) <= radius_;
  }

 private:
  [[nodiscard]] static Vec3 middle(Vec3 a, Vec3 b) {
    const Vec3 sum = (1 / length(a)) * a + (1 / length(b)) * b;
    return (1 / length(sum)) * sum;
  }

  Vec3 center_;
  double radius_;
};

/// The vertices and edges in the disc on the left side of an edge u → v.
template <class Point>
class Surroundings {
 public:
  Surroundings(const Mesh& mesh, HalfedgeId h, double up_to)
      : mesh_(mesh), u_(at(mesh.origin(h))), v_(at(mesh.target(h))), up_to_(up_to), disc_(u_, v_, up_to) {
    walk(h);
  }

  /// The least bound from u or from v by a vertex that sees the edge.
  [[nodiscard]] std::optional<CrossingBound<Point>> least(bool from_u) const {
    std::vector<CrossingBound<Point>> bounds;
    for (const VertexId x : vertices_) {
      if (!stays(mesh_, x)) continue;
      const auto bound = bound_of(x, at(x), from_u ? u_ : v_, from_u ? v_ : u_, up_to_);
      if (bound) bounds.push_back(*bound);
    }
    std::sort(bounds.begin(), bounds.end());
    for (const CrossingBound<Point>& bound : bounds) {
      if (is_visible(bound.at)) return bound;
    }
    return std::nullopt;
  }

 private:
  void walk(HalfedgeId first) {
    std::vector<HalfedgeId> entered = {first};
    std::unordered_set<std::uint32_t> seen = {Mesh::triangle(first).index};
    while (!entered.empty()) {
      const HalfedgeId in = entered.back();
      entered.pop_back();
      vertices_.push_back(mesh_.opposite(in));
      for (const HalfedgeId h : {Mesh::next(in), Mesh::prev(in)}) {
        if (mesh_.is_boundary(h)) {
          walls_.push_back({at(mesh_.origin(h)), at(mesh_.target(h))});
        } else if (reaches(h) && seen.insert(Mesh::triangle(mesh_.twin(h)).index).second) {
          entered.push_back(mesh_.twin(h));
        }
      }
    }
    sort_unique(vertices_);
    std::erase_if(vertices_, [&](VertexId x) { return !is_left(u_, v_, at(x)); });
  }

  [[nodiscard]] Point at(VertexId v) const { return point_of<Point>(mesh_, v); }

  /// Says whether the edge has points in the disc and on the left of u → v.
  [[nodiscard]] bool reaches(HalfedgeId h) const {
    const Point p = at(mesh_.origin(h)), q = at(mesh_.target(h));
    return (is_left(u_, v_, p) || is_left(u_, v_, q)) && disc_.meets(p, q);
  }

  /// Says whether the triangle u v x is in the domain: no boundary edge enters it.
  [[nodiscard]] bool is_visible(Point x) const {
    return std::none_of(walls_.begin(), walls_.end(),
                        [&](const Segment<Point>& s) { return meets_inside(s, u_, v_, x); });
  }

  const Mesh& mesh_;
  Point u_, v_;
  double up_to_;
  std::conditional_t<std::is_same_v<Point, Vec2>, Disc, Cap> disc_;
  std::vector<VertexId> vertices_;
  std::vector<Segment<Point>> walls_;
};

template <class Bound>
std::optional<Bound> lesser(const std::optional<Bound>& x, const std::optional<Bound>& y) {
  if (!x || !y) return x ? x : y;
  return *y < *x ? y : x;
}

/// The part of the edge's length that a bound leaves.
double part_of_length(const CrossingBound<Vec2>& bound) { return bound.value; }
double part_of_length(const CrossingBound<Vec3>& bound) {
  const Vec3 end = (1 - bound.value) * bound.near + bound.value * bound.far;
  return arc_length(bound.near, end) / arc_length(bound.near, bound.far);
}

template <class Point>
std::optional<EdgeConflict> conflict_of(const Mesh& mesh, HalfedgeId edge, double up_to) {
  const double reach = std::max(up_to, 1.0);
  const Surroundings<Point> left(mesh, edge, reach);
  auto a = left.least(true), b = left.least(false);
  if (!mesh.is_boundary(edge)) {  // one crossing serves both sides
    const Surroundings<Point> right(mesh, mesh.twin(edge), reach);
    a = lesser(a, right.least(false));
    b = lesser(b, right.least(true));
  }
  if (!a || !b || !is_at_most(*a, *b, up_to)) return std::nullopt;
  EdgeConflict conflict = {edge, a->vertex, b->vertex, part_of_length(*a), part_of_length(*b)};
  conflict.sum = conflict.a + conflict.b;
  conflict.split_at =
      std::clamp((conflict.a + (1 - conflict.b)) / 2, EdgeConflict::kLeastPiece, 1 - EdgeConflict::kLeastPiece);
  return conflict;
}

}  // namespace

std::optional<EdgeConflict> edge_conflict(const Mesh& mesh, HalfedgeId h, double up_to) {
  const HalfedgeId edge = mesh.is_edge_representative(h) ? h : mesh.twin(h);
  return mesh.space().dimension() == 2 ? conflict_of<Vec2>(mesh, edge, up_to) : conflict_of<Vec3>(mesh, edge, up_to);
}

std::vector<EdgeConflict> edges_that_must_be_split(const Mesh& mesh, double up_to) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  std::vector<EdgeConflict> conflicts;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || !mesh.is_unflippable(h)) continue;
    if (const auto conflict = edge_conflict(mesh, h, up_to)) conflicts.push_back(*conflict);
  }
  const auto key = [&](const EdgeConflict& c) {
    return std::tuple(c.sum, std::minmax({mesh.origin(c.edge), mesh.target(c.edge)}));
  };
  std::sort(conflicts.begin(), conflicts.end(),
            [&](const EdgeConflict& x, const EdgeConflict& y) { return key(x) < key(y); });
  return conflicts;
}

}  // namespace temper
