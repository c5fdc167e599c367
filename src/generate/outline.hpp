// Points and segments of an example on their way to constrained_delaunay.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/generate.hpp"

namespace temper::generate {

struct Outline {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 2>> segments;

  /// A closed loop through these points, in order.
  void add_loop(const std::vector<Vec2>& loop);
  [[nodiscard]] Expected<Mesh> triangulate() const { return constrained_delaunay({points, segments}); }
};

/// Area, positive when counter-clockwise.
[[nodiscard]] double signed_area(const Polygon& polygon);
/// The polygon with each side cut into equal pieces of about `spacing`, at least one.
[[nodiscard]] Polygon divide_sides(const Polygon& polygon, double spacing);
/// The number of points that divide_sides makes.
[[nodiscard]] std::size_t count_pieces(const Polygon& polygon, double spacing);
[[nodiscard]] bool contains(const Polygon& polygon, Vec2 p);
[[nodiscard]] double squared_distance(const Polygon& polygon, Vec2 p);
/// A point on the bisector of each convex corner of a counter-clockwise polygon, at `distance` from it. Without it the
/// corner and its two neighbors could be a triangle of three boundary vertices, which no optimization can improve.
[[nodiscard]] std::vector<Vec2> corner_points(const Polygon& polygon, double distance);

[[nodiscard]] inline InputError invalid(std::string message) {
  return {ErrorCode::invalid_option, "", std::move(message)};
}

}  // namespace temper::generate
