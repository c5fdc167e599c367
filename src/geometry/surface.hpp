// The plane, or the sphere around the origin, as a surface to walk on. Places are points of space. In the plane z = 0;
// on the sphere each step along a direction ends with a step back onto the radius.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/bounding_boxes.hpp"
#include "geometry/predicates_inline.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

class Surface {
 public:
  Surface() = default;
  explicit Surface(const Space& space) : space_(space) {}

  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] bool is_plane() const { return space_.is_plane(); }

  /// The vertex at a place, without a weight; and the place of a vertex.
  [[nodiscard]] WeightedPoint vertex(Vec3 p) const { return is_plane() ? WeightedPoint{p.x, p.y, 0} : as_point(p); }
  [[nodiscard]] Vec3 place(const WeightedPoint& p) const { return is_plane() ? Vec3{p.x, p.y, 0} : space_.place(p); }

  [[nodiscard]] Sign orientation(Vec3 a, Vec3 b, Vec3 c) const {
    return is_plane() ? orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) : temper::orientation(a, b, c);
  }

  /// Along the surface.
  [[nodiscard]] double distance(Vec3 a, Vec3 b) const {
    return is_plane() ? length(b - a) : space_.radius() * arc_length(a, b);
  }
  /// The unit vector at `from` towards another place.
  [[nodiscard]] Vec3 direction(Vec3 from, Vec3 to) const {
    const Vec3 way = is_plane() ? to - from : along_surface(to - from, from);
    return (1 / length(way)) * way;
  }
  /// A direction at a place, a quarter turn to the left.
  [[nodiscard]] Vec3 to_the_left(Vec3 direction, Vec3 at) const {
    return is_plane() ? Vec3{-direction.y, direction.x, 0} : cross((1 / length(at)) * at, direction);
  }
  /// The place on the surface for the end of a step.
  [[nodiscard]] Vec3 below(Vec3 p) const { return is_plane() ? p : (space_.radius() / length(p)) * p; }
  [[nodiscard]] Vec3 some_direction(Vec3 at) const {
    if (is_plane()) return {1, 0, 0};
    const Vec3 axis = std::abs(at.z) < 0.5 * length(at) ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    const Vec3 way = cross(axis, at);
    return (1 / length(way)) * way;
  }

  /// A place on the segment from a to b, a part of the way from a.
  [[nodiscard]] Vec3 between(Vec3 a, Vec3 b, double part) const {
    if (is_plane()) return a + part * (b - a);
    const double angle = part * arc_length(a, b);
    return below(std::cos(angle) * a + (std::sin(angle) * length(a)) * direction(a, b));
  }

  /// The squared distance of p from the segment ab; next to long arcs its distance from their plane.
  [[nodiscard]] double squared_distance(Vec3 p, Vec3 a, Vec3 b) const {
    if (is_plane()) {
      const double along = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
      return squared_length(p - a - along * (b - a));
    }
    const Vec3 normal = cross(a, b - a);  // differences keep the digits of short arcs
    if (dot(cross(normal, a), p) > 0 && dot(cross(b, normal), p) > 0) {
      const double height = dot(p - a, normal);
      return height * height / squared_length(normal);
    }
    return std::min(squared_length(p - a), squared_length(p - b));
  }

  /// The part of pq from p to the foot of the perpendicular from x.
  [[nodiscard]] double part_below(Vec3 p, Vec3 q, Vec3 x) const {
    if (is_plane()) return dot(x - p, q - p) / squared_length(q - p);
    return std::atan2(dot(x, direction(p, q)), dot(x, p) / length(p)) / arc_length(p, q);
  }
  /// A number that grows with the area of a triangle: twice that, or the solid angle.
  [[nodiscard]] double extent(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) const {
    return is_plane() ? doubled_area(p.position(), q.position(), r.position())
                      : solid_angle(as_vector(p), as_vector(q), as_vector(r));
  }

  /// For p on the line of ab: is it strictly between them?
  [[nodiscard]] bool is_between(Vec3 p, Vec3 a, Vec3 b) const {
    if (p == a || p == b) return false;
    const auto in_range = [](double x, double from, double to) {
      return std::min(from, to) <= x && x <= std::max(from, to);
    };
    if (is_plane()) return in_range(p.x, a.x, b.x) && in_range(p.y, a.y, b.y);
    const Vec3 normal = cross(a, b);
    return dot(cross(normal, a), p) > 0 && dot(cross(b, normal), p) > 0;
  }

 private:
  [[nodiscard]] static Vec3 along_surface(Vec3 way, Vec3 at) { return way - (dot(way, at) / squared_length(at)) * at; }

  Space space_;
};

[[nodiscard]] inline BoundingBox box_around(const Surface& surface, Vec3 a, Vec3 b) {
  const BoundingBox ends = box_of(a, b);
  if (surface.is_plane()) return ends;
  // The distance from arc to chord is at most the radius less the distance of the chord; rounding doubles that.
  const double radius = surface.space().radius(), middle = 0.5 * length(a + b);
  constexpr double kChordRounding = 1e-12;  // of the radius: the middle of the chord is not known better
  return ends.grown(radius - std::min(radius, middle) + kChordRounding * radius);
}

/// The straight way from one place to another.
class SurfacePath {
 public:
  SurfacePath(const Surface& surface, Vec3 from, Vec3 to)
      : surface_(surface), from_(from), length_(surface.distance(from, to)), direction_(surface.direction(from, to)) {}
  [[nodiscard]] double length() const { return length_; }
  /// The place at a distance from the beginning.
  [[nodiscard]] Vec3 at(double distance) const {
    if (surface_.is_plane()) return from_ + distance * direction_;
    const double angle = distance / surface_.space().radius();
    return surface_.below(std::cos(angle) * from_ + (std::sin(angle) * surface_.space().radius()) * direction_);
  }

 private:
  const Surface& surface_;
  Vec3 from_;
  double length_;
  Vec3 direction_;
};

// --- constructions; on the sphere a place is any point in its direction ---------------------------------------------

/// The places midway; their weights mean nothing.
[[nodiscard]] inline WeightedPoint middle(const Space& space, const WeightedPoint& a, const WeightedPoint& b) {
  if (!space.is_plane()) return as_point(0.5 * (as_vector(a) + as_vector(b)));
  const Vec2 p = 0.5 * (a.position() + b.position());
  return {p.x, p.y, 0};
}
[[nodiscard]] inline WeightedPoint middle(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                          const WeightedPoint& c) {
  if (!space.is_plane()) return as_point((1.0 / 3) * (as_vector(a) + as_vector(b) + as_vector(c)));
  const Vec2 p = (1.0 / 3) * (a.position() + b.position() + c.position());
  return {p.x, p.y, 0};
}

/// The place of the orthocenter, with weight 0.
[[nodiscard]] inline WeightedPoint orthocenter(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                               const WeightedPoint& c) {
  if (!space.is_plane()) return as_point(space.radius() * orthocenter(as_vector(a), as_vector(b), as_vector(c)));
  const Vec2 o = orthocenter(a, b, c);
  return {o.x, o.y, 0};
}

/// The vertex at a place inside triangle abc, its weight linear between the weights of the corners. It is never hidden,
/// since the plane through the weighted vectors of the corners is beyond.
[[nodiscard]] inline WeightedPoint with_interpolated_weight(const Space& space, const WeightedPoint& p,
                                                            const WeightedPoint& a, const WeightedPoint& b,
                                                            const WeightedPoint& c) {
  const auto across = [&](const WeightedPoint& q, const WeightedPoint& r) {  // of the triangle pqr, or of 0pqr
    return space.is_plane() ? cross(q.position() - p.position(), r.position() - p.position())
                            : dot(as_vector(p), cross(as_vector(q), as_vector(r)));
  };
  const double at_a = across(b, c), at_b = across(c, a), at_c = across(a, b);
  return space.with_weight(
      p, (at_a * space.weight(a) + at_b * space.weight(b) + at_c * space.weight(c)) / (at_a + at_b + at_c));
}

/// The place in the coordinates of its space, without its weight: of the plane with z = 0.
[[nodiscard]] inline Vec3 position_in_space(const Space& space, const WeightedPoint& p) {
  return space.is_plane() ? Vec3{p.x, p.y, 0} : as_vector(space.with_weight(p, 0));
}

/// The dual of the edge ab with c on its left and d on its right [length]. Signed.
[[nodiscard]] inline double dual_length(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                        const WeightedPoint& c, const WeightedPoint& d) {
  if (space.is_plane()) return signed_height(a, b, c) + signed_height(b, a, d);
  const Vec3 p = as_vector(a), q = as_vector(b);
  return space.radius() * (signed_height(p, q, as_vector(c)) + signed_height(q, p, as_vector(d)));
}

/// The weighted midpoint of an edge; on the sphere the foot of the perpendicular from its center.
[[nodiscard]] inline WeightedPoint weighted_midpoint(const Space& space, const WeightedPoint& a,
                                                     const WeightedPoint& b) {
  const Vec3 p = as_vector(a), along = space.chord(a, b);
  if (!space.is_plane()) return as_point(p - (dot(p, along) / squared_length(along)) * along);
  const double part = dual_crossing(a, b) / length(along);
  return {a.x + part * along.x, a.y + part * along.y, 0};
}

/// Twice the area of a triangle with corner p; on the sphere, of the flat triangle of its weighted vectors.
[[nodiscard]] inline double unsigned_doubled_area(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                                  const WeightedPoint& r) {
  const Vec3 across = cross(space.chord(p, q), space.chord(p, r));
  return space.is_plane() ? std::abs(across.z) : length(across);
}

/// For three vertices on one line: is b on a's side of v? On the sphere the three span less than half a great circle,
/// and the normals of both arcs are equal or opposite. Exact.
[[nodiscard]] inline bool is_ahead(const Space& space, const WeightedPoint& v, const WeightedPoint& a,
                                   const WeightedPoint& b) {
  if (!space.is_plane()) return dot(cross(as_vector(v), as_vector(a)), cross(as_vector(v), as_vector(b))) > 0;
  return (v.x < a.x) == (v.x < b.x) && (v.x > a.x) == (v.x > b.x) && (v.y < a.y) == (v.y < b.y) &&
         (v.y > a.y) == (v.y > b.y);
}

/// A vertex seen from the origin on the lifted surface: in the plane with its height there.
[[nodiscard]] inline Vec3 on_lifted_surface(const Space& space, const WeightedPoint& p, const WeightedPoint& origin) {
  const double x = p.x - origin.x, y = p.y - origin.y, w = p.w - origin.w;
  return {x, y, space.is_plane() ? x * x + y * y - w : w};
}
/// Six times the volume between a triangle of such points and the plane z = 0. On the sphere the surface of least
/// volume is farthest out: so the result is minus the volume of the tetrahedron with the origin. In the sum over a
/// cavity it differs only by a constant from minus the volume with the center of the sphere.
[[nodiscard]] inline double volume_under(const Space& space, Vec3 a, Vec3 b, Vec3 c) {
  if (!space.is_plane()) return -dot(a, cross(b, c));
  const double doubled_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return doubled_area * (a.z + b.z + c.z);
}

/// The solid angle of PQR with a given determinant, which may be more accurate than the determinant of differences. Van
/// Oosterom and Strackee (1983): tan(E/2) = det(P, Q, R)/(|P||Q||R| + (P·Q)|R| + (Q·R)|P| + (R·P)|Q|).
inline double solid_angle(double determinant, Vec3 p, Vec3 q, Vec3 r) {
  const double a = length(p), b = length(q), c = length(r);
  return 2 * std::atan2(determinant, a * b * c + dot(p, q) * c + dot(q, r) * a + dot(r, p) * b);
}

/// The areas of the right triangles on both sides of an edge, at its end at distance d from the weighted midpoint.
inline double right_triangle_areas(const Space& space, double d, double left, double right) {
  if (space.is_plane()) return 0.5 * d * (left + right);
  return space.right_triangle_area(d, left) + space.right_triangle_area(d, right);
}

/// Says whether p is on the closed segment ab, given that the three are collinear.
[[nodiscard]] inline bool is_between(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Says whether the direction of p is on the closed arc from a to b, which is shorter than half a great circle.
/// Precondition: the three are on one great circle. Exact: in one of the coordinate planes they are not all on a line
/// through 0.
[[nodiscard]] inline bool is_between(Vec3 a, Vec3 b, Vec3 p) {
  constexpr Vec2 kOrigin = {0, 0};
  const auto from_a_to_b = [&](auto shadow) -> std::optional<bool> {
    const Sign turn = inlined::orient2d(kOrigin, shadow(a), shadow(b));
    if (turn == Sign::zero) return std::nullopt;
    return inlined::orient2d(kOrigin, shadow(a), shadow(p)) != -turn &&
           inlined::orient2d(kOrigin, shadow(p), shadow(b)) != -turn;
  };
  if (const auto xy = from_a_to_b([](Vec3 q) { return Vec2{q.x, q.y}; })) return *xy;
  if (const auto yz = from_a_to_b([](Vec3 q) { return Vec2{q.y, q.z}; })) return *yz;
  return from_a_to_b([](Vec3 q) { return Vec2{q.z, q.x}; }).value_or(false);
}

/// Is p on the closed segment ab, in the space of a mesh?
[[nodiscard]] inline bool is_between(const Space& space, const WeightedPoint& a, const WeightedPoint& b,
                                     const WeightedPoint& p) {
  return space.is_plane() ? is_between(a.position(), b.position(), p.position())
                          : is_between(as_vector(a), as_vector(b), as_vector(p));
}

}  // namespace temper
