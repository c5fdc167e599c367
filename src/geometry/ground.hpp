// The plane, or the sphere around the origin, as what is walked on. Places are points of space: those of the plane have
// z = 0, those of the sphere are at its radius, and a step along a direction is followed by a step back onto it.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/bounding_boxes.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/space.hpp"

namespace temper {

class Ground {
 public:
  Ground() = default;
  explicit Ground(const Space& space) : space_(space) {}

  [[nodiscard]] const Space& space() const { return space_; }
  [[nodiscard]] bool is_plane() const { return space_.is_plane(); }

  /// The vertex at a place, without a weight; and the place of a vertex.
  [[nodiscard]] WeightedPoint vertex(Vec3 p) const { return is_plane() ? WeightedPoint{p.x, p.y, 0} : as_point(p); }
  [[nodiscard]] Vec3 place(const WeightedPoint& p) const { return is_plane() ? Vec3{p.x, p.y, 0} : space_.place(p); }

  [[nodiscard]] Sign orientation(Vec3 a, Vec3 b, Vec3 c) const {
    return is_plane() ? orient2d({a.x, a.y}, {b.x, b.y}, {c.x, c.y}) : temper::orientation(a, b, c);
  }

  /// Along the ground.
  [[nodiscard]] double distance(Vec3 a, Vec3 b) const {
    return is_plane() ? length(b - a) : space_.radius() * arc_length(a, b);
  }
  /// The unit vector at `from` towards another place.
  [[nodiscard]] Vec3 direction(Vec3 from, Vec3 to) const {
    const Vec3 way = is_plane() ? to - from : along_ground(to - from, from);
    return (1 / length(way)) * way;
  }
  /// A direction at a place, a quarter turn to the left.
  [[nodiscard]] Vec3 to_the_left(Vec3 direction, Vec3 at) const {
    return is_plane() ? Vec3{-direction.y, direction.x, 0} : cross((1 / length(at)) * at, direction);
  }
  /// The place where a step from the ground ends.
  [[nodiscard]] Vec3 below(Vec3 p) const { return is_plane() ? p : (space_.radius() / length(p)) * p; }
  /// Any direction at a place.
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

  /// Of p from the segment ab; beside long arcs that of their plane.
  [[nodiscard]] double squared_distance(Vec3 p, Vec3 a, Vec3 b) const {
    if (is_plane()) {
      const double along = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
      return squared_length(p - a - along * (b - a));
    }
    const Vec3 normal = cross(a, b);
    if (dot(cross(normal, a), p) > 0 && dot(cross(b, normal), p) > 0) {
      const double height = dot(p, normal);
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

  /// p on the line of ab: is it between them, neither of both?
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
  [[nodiscard]] static Vec3 along_ground(Vec3 way, Vec3 at) { return way - (dot(way, at) / squared_length(at)) * at; }

  Space space_;
};

/// A box around the segment from a to b.
[[nodiscard]] inline BoundingBox box_around(const Ground& ground, Vec3 a, Vec3 b) {
  const BoundingBox ends = box_of(a, b);
  if (ground.is_plane()) return ends;
  // The arc is above its chord by no more than the radius less the distance of the chord; rounding doubles that.
  const double radius = ground.space().radius(), middle = 0.5 * length(a + b);
  constexpr double kRounding = 1e-12;  // of the radius: the middle of the chord is not known better
  return ends.grown(radius - std::min(radius, middle) + kRounding * radius);
}

/// The straight way from one place to another.
class GroundPath {
 public:
  GroundPath(const Ground& ground, Vec3 from, Vec3 to)
      : ground_(ground), from_(from), length_(ground.distance(from, to)), direction_(ground.direction(from, to)) {}
  [[nodiscard]] double length() const { return length_; }
  /// The place at a distance from the beginning.
  [[nodiscard]] Vec3 at(double distance) const {
    if (ground_.is_plane()) return from_ + distance * direction_;
    const double angle = distance / ground_.space().radius();
    return ground_.below(std::cos(angle) * from_ + (std::sin(angle) * ground_.space().radius()) * direction_);
  }

 private:
  const Ground& ground_;
  Vec3 from_;
  double length_;
  Vec3 direction_;
};

}  // namespace temper
