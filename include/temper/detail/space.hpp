// The space of a mesh: the plane, a periodic plane, or a sphere around the origin.
//
// The periodic plane has period a along x, b along y, or both. A vertex at (x, y) is also at (x + m a, y + n b) for all
// integers m and n: these are its images. The mesh stores the image in the domain 0 ≤ x < a, 0 ≤ y < b. An edge is the
// shortest way between images of its ends, less than half a period along each axis, so nothing is stored for it. Code
// that gets the points of a triangle or a star takes the images nearest to one of them. It then works in the plane.
// Periods, and coordinates along them, are multiples of 2⁻⁴⁷ of the power of two at the period. So images and
// differences of points are exact.
//
// On the sphere of radius R a vertex at p, |p| = R, with weight w is the weighted vector P = p √(R² + w)/R. Its
// direction is the place, and |P|² = R² + w. The regular triangulation is the boundary of the convex hull of all P.
// Take a face PQR in its own plane with the weights |P|², |Q|² and |R|². Its orthocenter is the foot of the
// perpendicular from the center of the sphere. If the face is well-centered or regular, so is the triangle on the
// sphere (Sugihara, Laguerre Voronoi diagram on the sphere, J. Geom. Graphics 6, 2002). In the plane an equal shift of
// all weights changes nothing. On the sphere a common factor of all P changes nothing.
//
//                 P         All spaces keep a vertex as three numbers, a WeightedPoint: x, y and w in the plane,
//               /           and X, Y, Z of P, in this order, on the sphere. Code for any space passes them on,
//        R   p +            and calls Space for their meaning.
//            /
//          0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "temper/detail/vec.hpp"

namespace temper {

enum class SpaceKind : std::uint8_t { plane, sphere, periodic_plane };

/// Converts a vertex on the sphere to its vector P, and back.
[[nodiscard]] constexpr Vec3 as_vector(const WeightedPoint& p) { return {p.x, p.y, p.w}; }
[[nodiscard]] constexpr WeightedPoint as_point(Vec3 p) { return {p.x, p.y, p.z}; }

class Space {
 public:
  /// The plane.
  constexpr Space() = default;
  /// The sphere around the origin. Precondition: radius > 0.
  [[nodiscard]] static constexpr Space sphere(double radius) {
    Space s;
    s.kind_ = SpaceKind::sphere;
    s.radius_ = radius;
    return s;
  }
  /// The plane with these periods along x and y, rounded to the grid of their images. 0 means none along that axis.
  /// Preconditions: the periods are finite, none is negative, one is positive.
  [[nodiscard]] static Space periodic(Vec2 period) {
    Space s;
    s.kind_ = SpaceKind::periodic_plane;
    const Vec2 c = {rounding_of(period.x), rounding_of(period.y)};
    s.period_ = {(period.x + c.x) - c.x, (period.y + c.y) - c.y};
    return s;
  }

  [[nodiscard]] constexpr SpaceKind kind() const { return kind_; }
  /// Says whether this is a plane, periodic or not. Then vertices are x, y and w, and images near one point lie in one
  /// plane.
  [[nodiscard]] constexpr bool is_plane() const { return kind_ != SpaceKind::sphere; }
  [[nodiscard]] constexpr bool is_periodic() const { return kind_ == SpaceKind::periodic_plane; }
  /// The radius of the sphere; 0 for the plane.
  [[nodiscard]] constexpr double radius() const { return radius_; }
  /// The periods of the periodic plane along x and y; 0 if there is none.
  [[nodiscard]] constexpr Vec2 period() const { return period_; }
  /// The number of coordinates of a place: 2 in the plane, 3 on the sphere.
  [[nodiscard]] constexpr int dimension() const { return is_plane() ? 2 : 3; }
  /// Says whether the space is finite and has no outside: the sphere, and a plane with two periods.
  [[nodiscard]] constexpr bool is_closed() const { return !is_plane() || (period_.x > 0 && period_.y > 0); }
  /// Converts the space to another unit of length, `unit` times the present one. In the periodic plane it must be a
  /// power of two.
  [[nodiscard]] constexpr Space in_units_of(double unit) const {
    Space s = *this;
    s.radius_ /= unit;
    s.period_ = {period_.x / unit, period_.y / unit};
    return s;
  }

  /// The image of p that is nearest to a point; in other spaces p.
  [[nodiscard]] WeightedPoint image(const WeightedPoint& p, const WeightedPoint& nearby) const {
    if (!is_periodic()) return p;
    return {nearest(p.x, nearby.x, period_.x), nearest(p.y, nearby.y, period_.y), p.w};
  }
  /// The image of p in the domain, on the grid; in other spaces p.
  [[nodiscard]] WeightedPoint in_domain(const WeightedPoint& p) const {
    if (!is_periodic()) return p;
    return {wrapped(p.x, period_.x), wrapped(p.y, period_.y), p.w};
  }
  /// Says whether two points are less than half a period apart along each axis, as the ends of an edge must be.
  [[nodiscard]] bool are_near(const WeightedPoint& p, const WeightedPoint& q) const {
    if (!is_periodic()) return true;
    return (period_.x == 0 || 2 * std::abs(q.x - p.x) < period_.x) &&
           (period_.y == 0 || 2 * std::abs(q.y - p.y) < period_.y);
  }
  /// The number that rounds coordinates along an axis to the grid, when it is added and subtracted. It is exact up to
  /// 16 periods away. 0 without a period.
  [[nodiscard]] static double rounding_of(double period) {
    return period == 0 ? 0 : std::ldexp(1.5, std::ilogb(period) + 5);
  }

  /// The weight of a vertex [length²]. On the sphere a weight that is only rounding of P becomes 0.
  [[nodiscard]] double weight(const WeightedPoint& p) const {
    if (is_plane()) return p.w;
    constexpr double kRounded = 0x1p-48;
    const double r2 = radius_ * radius_, w = squared_length(as_vector(p)) - r2;
    return std::abs(w) < kRounded * r2 ? 0 : w;
  }
  /// The vertex at the same place with another weight; on the sphere the weight must be more than −R².
  [[nodiscard]] WeightedPoint with_weight(const WeightedPoint& p, double w) const {
    if (is_plane()) return {p.x, p.y, w};
    const double factor = std::sqrt((radius_ * radius_ + w) / squared_length(as_vector(p)));
    return as_point(factor * as_vector(p));
  }

  /// The vertex at a place with a weight. In the plane any z is allowed. On the sphere the distance of `place` from the
  /// center does not count. If it is the radius except for rounding and w is 0, the result is the place itself, bit for
  /// bit. Precondition: w > −R².
  [[nodiscard]] WeightedPoint vertex_at(Vec3 place, double w) const {
    if (is_plane()) return {place.x, place.y, w};
    constexpr double kRounded = 0x1p-50;
    const bool at_radius = std::abs(length(place) - radius_) <= kRounded * radius_;
    return w == 0 && at_radius ? as_point(place) : with_weight(as_point(place), w);
  }
  /// The place of a vertex, without its weight: bit for bit the place that it was made from. In the plane z = 0.
  [[nodiscard]] Vec3 place(const WeightedPoint& p) const {
    if (is_plane()) return {p.x, p.y, 0};
    return weight(p) == 0 ? as_vector(p) : as_vector(with_weight(p, 0));
  }

  /// The unit vector that points away from the ground.
  [[nodiscard]] Vec3 up(const WeightedPoint& p) const {
    return is_plane() ? Vec3{0, 0, 1} : (1 / length(as_vector(p))) * as_vector(p);
  }
  /// The distance along the ground [length] of a place that is `across` from a point along a tangent, and `height`
  /// above the point.
  [[nodiscard]] double along_surface(double across, double height) const {
    return is_plane() ? across : radius_ * std::atan2(across, radius_ + height);
  }
  /// A place as users see it: x and y, or longitude and latitude [degrees].
  [[nodiscard]] Vec2 as_shown(Vec3 place) const {
    if (is_plane()) return {place.x, place.y};
    constexpr double kDegrees = 180 / std::numbers::pi;
    return {kDegrees * std::atan2(place.y, place.x), kDegrees * std::atan2(place.z, std::hypot(place.x, place.y))};
  }
  /// The straight line from one vertex to another: on the sphere between weighted vectors, in the plane with z = 0.
  [[nodiscard]] Vec3 chord(const WeightedPoint& p, const WeightedPoint& q) const {
    return is_plane() ? Vec3{q.x - p.x, q.y - p.y, 0} : as_vector(q) - as_vector(p);
  }

  /// The area of the right triangle with legs d and h, with the sign of d·h. Dual cells and kites consist of such
  /// triangles. On the sphere legs are arcs [length], and tan(E/2) = tan(d/2R) tan(h/2R) with E its excess.
  [[nodiscard]] double right_triangle_area(double d, double h) const {
    if (is_plane()) return 0.5 * d * h;
    return radius_ * radius_ * 2 * std::atan(std::tan(0.5 * d / radius_) * std::tan(0.5 * h / radius_));
  }

  /// Says whether two vertices are at the same place. On the sphere the rounding of with_weight(), even of many calls,
  /// is tolerated.
  [[nodiscard]] bool same_place(const WeightedPoint& p, const WeightedPoint& q, double rounding = 0x1p-49) const {
    if (is_plane()) return p.x == q.x && p.y == q.y;
    return squared_length(cross(as_vector(p), as_vector(q))) <=
           rounding * rounding * squared_length(as_vector(p)) * squared_length(as_vector(q));
  }

  friend constexpr bool operator==(const Space&, const Space&) = default;

 private:
  [[nodiscard]] static double nearest(double x, double to, double period) {
    if (period == 0 || !(2 * std::abs(x - to) > period)) return x;
    return x - period * std::nearbyint((x - to) / period);
  }
  [[nodiscard]] static double wrapped(double x, double period) {
    if (period == 0) return x;
    const double within = std::fmod(x, period), c = rounding_of(period);
    const double rounded = ((within < 0 ? within + period : within) + c) - c;
    return rounded < period ? rounded : rounded - period;
  }

  SpaceKind kind_ = SpaceKind::plane;
  double radius_ = 0;
  Vec2 period_;
};

}  // namespace temper
