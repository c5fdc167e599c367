// The space that a mesh lies in: the plane, a plane that repeats itself, or a sphere around the origin.
//
// In the periodic plane, of period a along x, b along y, or both, a vertex at (x, y) is at (x + m a, y + n b), too, for
// all whole m and n: these are its images. A mesh has one of them, in the domain 0 ≤ x < a, 0 ≤ y < b. An edge is the
// shortest way between images of its ends, less than half a period along each axis; so nothing needs to be kept for it,
// and who fetches the points of a triangle or a star asks for those images that are nearest to one of them, and then
// is in the plane. Periods, and coordinates along them, are multiples of 2⁻⁴⁷ of the power of two at the period, so
// that images and the differences of points are exact.
//
// On the sphere of radius R a vertex at p, |p| = R, with weight w is the weighted vector P = p √(R² + w)/R: its
// direction is the place, and |P|² = R² + w. The regular triangulation is the boundary of the convex hull of all P, and
// the face PQR, read in its own plane with the weights |P|², |Q|² and |R|², has its orthocenter at the foot of the
// perpendicular from the center of the sphere: what is well-centered and what is regular there is so on the sphere
// (Sugihara, Laguerre Voronoi diagram on the sphere, J. Geom. Graphics 6, 2002). Equal shifts of all |P|², which change
// nothing in the plane, are here all P times a number.
//
//                 P         A vertex is kept as three numbers in all spaces, a WeightedPoint: x, y and w in the plane,
//               /           and X, Y, Z of P, in this order, on the sphere. Who works on vertices in any space
//        R   p +            hands them on as they are, and asks the space what they mean.
//            /
//          0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "temper/detail/vec.hpp"

namespace temper {

enum class SpaceKind : std::uint8_t { plane, sphere, periodic_plane };

/// P of a vertex on the sphere, and the vertex of P.
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
  /// The plane with these periods along x and y, rounded to the grid of their images; 0: none along that axis.
  /// Precondition: they are finite, none is negative, one is positive.
  [[nodiscard]] static Space periodic(Vec2 period) {
    Space s;
    s.kind_ = SpaceKind::periodic_plane;
    const Vec2 c = {rounding_of(period.x), rounding_of(period.y)};
    s.period_ = {(period.x + c.x) - c.x, (period.y + c.y) - c.y};
    return s;
  }

  [[nodiscard]] constexpr SpaceKind kind() const { return kind_; }
  /// The plane, periodic or not: vertices are x, y and w, and images near one point are points of one plane.
  [[nodiscard]] constexpr bool is_plane() const { return kind_ != SpaceKind::sphere; }
  [[nodiscard]] constexpr bool is_periodic() const { return kind_ == SpaceKind::periodic_plane; }
  /// Of the sphere; 0 of the plane.
  [[nodiscard]] constexpr double radius() const { return radius_; }
  /// Of the periodic plane, along x and y; 0 where there is none.
  [[nodiscard]] constexpr Vec2 period() const { return period_; }
  /// Coordinates of a place: 2 of the plane, 3 of the sphere.
  [[nodiscard]] constexpr int dimension() const { return is_plane() ? 2 : 3; }
  /// Says whether the whole of it is finite and has no outside: the sphere, and a plane with two periods.
  [[nodiscard]] constexpr bool is_closed() const { return !is_plane() || (period_.x > 0 && period_.y > 0); }
  /// The same with another unit of length, a `unit` of the present one; of the periodic plane a power of two.
  [[nodiscard]] constexpr Space in_units_of(double unit) const {
    Space s = *this;
    s.radius_ /= unit;
    s.period_ = {period_.x / unit, period_.y / unit};
    return s;
  }

  /// The image of p that is nearest to a point; in other spaces p.
  [[nodiscard]] WeightedPoint image(const WeightedPoint& p, const WeightedPoint& near) const {
    if (!is_periodic()) return p;
    return {nearest(p.x, near.x, period_.x), nearest(p.y, near.y, period_.y), p.w};
  }
  /// The image of p in the domain, on the grid; in other spaces p.
  [[nodiscard]] WeightedPoint in_domain(const WeightedPoint& p) const {
    if (!is_periodic()) return p;
    return {wrapped(p.x, period_.x), wrapped(p.y, period_.y), p.w};
  }
  /// Says whether points are less than half a period apart along each axis, as the ends of an edge must be.
  [[nodiscard]] bool are_near(const WeightedPoint& p, const WeightedPoint& q) const {
    if (!is_periodic()) return true;
    return (period_.x == 0 || 2 * std::abs(q.x - p.x) < period_.x) &&
           (period_.y == 0 || 2 * std::abs(q.y - p.y) < period_.y);
  }
  /// What added to and taken from coordinates along an axis of that period rounds them to the grid: exact up to 16
  /// periods away. 0 without a period.
  [[nodiscard]] static double rounding_of(double period) {
    return period == 0 ? 0 : std::ldexp(1.5, std::ilogb(period) + 5);
  }

  /// The weight of a vertex [length²]. On the sphere what is only rounding of P is 0.
  [[nodiscard]] double weight(const WeightedPoint& p) const {
    if (is_plane()) return p.w;
    constexpr double kRounded = 0x1p-48;
    const double r2 = radius_ * radius_, w = squared_length(as_vector(p)) - r2;
    return std::abs(w) < kRounded * r2 ? 0 : w;
  }
  /// The vertex at the same place with another weight; on the sphere more than −R².
  [[nodiscard]] WeightedPoint with_weight(const WeightedPoint& p, double w) const {
    if (is_plane()) return {p.x, p.y, w};
    const double factor = std::sqrt((radius_ * radius_ + w) / squared_length(as_vector(p)));
    return as_point(factor * as_vector(p));
  }

  /// The vertex at a place, of the plane with any z; on the sphere its distance from the center is not looked at: the
  /// place itself, bit for bit, where that is the radius but for rounding and there is no weight. Precondition: w >
  /// −R².
  [[nodiscard]] WeightedPoint vertex_at(Vec3 place, double w) const {
    if (is_plane()) return {place.x, place.y, w};
    constexpr double kRounded = 0x1p-50;
    const bool at_radius = std::abs(length(place) - radius_) <= kRounded * radius_;
    return w == 0 && at_radius ? as_point(place) : with_weight(as_point(place), w);
  }
  /// Where a vertex is: bit for bit what it was made of, without a weight; in the plane with z = 0.
  [[nodiscard]] Vec3 place(const WeightedPoint& p) const {
    if (is_plane()) return {p.x, p.y, 0};
    return weight(p) == 0 ? as_vector(p) : as_vector(with_weight(p, 0));
  }

  /// The unit vector away from the ground.
  [[nodiscard]] Vec3 up(const WeightedPoint& p) const {
    return is_plane() ? Vec3{0, 0, 1} : (1 / length(as_vector(p))) * as_vector(p);
  }
  /// How far along the ground what is `across` and this high from a point is [length]. Across is a tangent.
  [[nodiscard]] double along_surface(double across, double height) const {
    return is_plane() ? across : radius_ * std::atan2(across, radius_ + height);
  }
  /// A place as users see it: x and y, or longitude and latitude [degrees].
  [[nodiscard]] Vec2 as_shown(Vec3 place) const {
    if (is_plane()) return {place.x, place.y};
    constexpr double kDegrees = 180 / std::numbers::pi;
    return {kDegrees * std::atan2(place.y, place.x), kDegrees * std::atan2(place.z, std::hypot(place.x, place.y))};
  }
  /// From one vertex to another on a straight line: of the sphere between weighted vectors, in the plane with z = 0.
  [[nodiscard]] Vec3 chord(const WeightedPoint& p, const WeightedPoint& q) const {
    return is_plane() ? Vec3{q.x - p.x, q.y - p.y, 0} : as_vector(q) - as_vector(p);
  }

  /// The area of the right triangle with legs d and h, with the sign of d·h: dual cells and kites are made of these. On
  /// the sphere legs are arcs [length], and tan(E/2) = tan(d/2R) tan(h/2R), E its excess.
  [[nodiscard]] double right_triangle_area(double d, double h) const {
    if (is_plane()) return 0.5 * d * h;
    return radius_ * radius_ * 2 * std::atan(std::tan(0.5 * d / radius_) * std::tan(0.5 * h / radius_));
  }

  /// Says whether two vertices are at the same place; on the sphere but for the rounding of with_weight(), or of many
  /// calls of it.
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
