#include "mesh/input_check.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/box.hpp"
#include "mesh/exact_range.hpp"

namespace temper {
namespace {

// Within these bounds nothing over- or underflows in the exact predicates (geometry.hpp), in the user's units and after
// scaling to an extent of about 1, whatever the other coordinates are. They are far beyond any unit of length.
constexpr double kLargestCoordinate = 1e60;
constexpr double kSmallestExtent = 1e-60;
constexpr double kLargestWeight = 1e120;    // absolute, and relative to the extent squared
constexpr double kSmallestWeight = 1e-120;  // absolute, and relative to the largest coordinate squared

// Points of the sphere may be off its radius by this part of it: the precision of coordinates with seven digits.
constexpr double kOffRadius = 1e-6;

std::optional<InputError> check_periods(const NamedInput& input) {
  const Vec2 period = input.in.space.period();
  for (const double length : {period.x, period.y}) {
    if (length == 0 || ExactRange{kSmallestExtent, kLargestCoordinate}.allows(length)) continue;
    return InputError{ErrorCode::out_of_scale,
                      {},
                      "the plane has period " + to_text(length) + ", expected one from " + to_text(kSmallestExtent) +
                          " to " + to_text(kLargestCoordinate)};
  }
  return std::nullopt;
}

std::optional<InputError> check_sphere(const NamedInput& input) {
  const double radius = input.in.space.radius(), lightest = -radius * radius;
  if (!ExactRange{kSmallestExtent, kLargestCoordinate}.allows(radius)) {
    return InputError{ErrorCode::out_of_scale,
                      {},
                      "the sphere has radius " + to_text(radius) + ", expected one from " + to_text(kSmallestExtent) +
                          " to " + to_text(kLargestCoordinate)};
  }
  for (std::size_t i = 0; i < input.n_points(); ++i) {
    const double distance = length(input.in.sphere_points[i]), w = input.weight(i);
    if (!(std::abs(distance - radius) <= kOffRadius * radius)) {
      return input.point_error(ErrorCode::not_on_sphere, i,
                               input.names.point(i) + " is at " + input.place_text(i) + ", " + to_text(distance) +
                                   " from the center of the sphere; expected its radius, " + to_text(radius) +
                                   ", to one part in a million");
    }
    if (!(w > lightest)) {
      return input.point_error(ErrorCode::out_of_scale, i,
                               input.names.point(i) + " has weight " + to_text(w) + "; expected more than " +
                                   to_text(lightest) + ", minus the square of the radius");
    }
  }
  return std::nullopt;
}

std::optional<InputError> check_coordinates(const NamedInput& input, ExactRange range) {
  for (std::size_t i = 0; i < input.in.points.size(); ++i) {
    const Vec2 p = input.in.points[i];
    if (range.allows(p.x) && range.allows(p.y)) continue;
    return input.point_error(ErrorCode::out_of_scale, i,
                             input.names.point(i) + " has coordinates " + coordinates(p) + "; " + range.text());
  }
  return std::nullopt;
}

std::optional<InputError> check_weights(const NamedInput& input, ExactRange range) {
  for (std::size_t i = 0; i < input.in.weights.size(); ++i) {
    if (range.allows(input.in.weights[i])) continue;
    return input.point_error(
        ErrorCode::out_of_scale, i,
        input.names.point(i) + " has weight " + to_text(input.in.weights[i]) + "; " + range.text());
  }
  return std::nullopt;
}

}  // namespace

std::optional<InputError> check_sizes(const NamedInput& input) {
  const std::size_t n = input.n_points(), m = input.in.triangles.size();
  if (n == 0) return InputError{ErrorCode::empty_input, {}, "the mesh has no points"};
  if (m == 0) return InputError{ErrorCode::empty_input, {}, "the mesh has no triangles"};
  if (!input.in.weights.empty() && input.in.weights.size() != n) {
    return InputError{ErrorCode::size_mismatch,
                      {},
                      quantity(input.in.weights.size(), "weights") + " given for " + quantity(n, "points")};
  }
  if (!input.in.regions.empty() && input.in.regions.size() != m) {
    return InputError{ErrorCode::size_mismatch,
                      {},
                      quantity(input.in.regions.size(), "regions") + " given for " + quantity(m, "triangles")};
  }
  return std::nullopt;
}

std::optional<InputError> check_scale(const NamedInput& input) {
  if (input.on_sphere()) return check_sphere(input);
  if (auto error = check_periods(input)) return error;
  if (auto error = check_coordinates(input, {kSmallestCoordinate, kLargestCoordinate})) return error;
  PlaneBox box;
  double largest = 0;
  for (const Vec2 p : input.in.points) {
    box.add(p);
    largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  }
  const double extent = box.longer_side();
  if (extent == 0) return std::nullopt;  // the zero areas will be named
  if (extent < kSmallestExtent) {
    return InputError{ErrorCode::out_of_scale,
                      {},
                      "the points lie within " + to_text(extent) + "; expected an extent of at least " +
                          to_text(kSmallestExtent) + ", which exact arithmetic needs"};
  }
  const double large = std::max(1.0, largest);
  if (auto error = check_coordinates(input, {kSmallestCoordinate * large, kLargestCoordinate})) return error;
  return check_weights(input, {kSmallestWeight * large * large, kLargestWeight * std::min(1.0, extent * extent)});
}

std::optional<InputError> find_duplicate(const NamedInput& input) {
  std::vector<std::uint32_t> order(input.n_points());
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::uint32_t i) { return as_vector(input.in.space.in_domain(as_point(input.place(i)))); };
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = at(a), q = at(b);
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    return p.z != q.z ? p.z < q.z : a < b;
  };
  std::sort(order.begin(), order.end(), before);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::uint32_t a = order[i - 1], b = order[i];
    if (at(a) == at(b)) {
      return input.point_error(ErrorCode::duplicate_point, b,
                               input.names.point(a) + " and " + input.names.point(b) + " are both at " +
                                   input.place_text(b) + "; expected distinct points");
    }
  }
  return std::nullopt;
}

}  // namespace temper
