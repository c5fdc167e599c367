// What the mesher works on: places and steps on the ground (geometry/ground.hpp), and boxes around them.
//
// Distances are arcs where they are measured along the outline, and chords where only what is near counts.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/bounding_boxes.hpp"
#include "geometry/ground.hpp"

namespace temper::mesher {

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
class Path {
 public:
  Path(const Ground& ground, Vec3 from, Vec3 to)
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

}  // namespace temper::mesher
