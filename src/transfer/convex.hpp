// Convex polygons of the plane and of the sphere, as rays: corners are (x, y, 1) in the plane near an origin, and unit
// vectors on the sphere. Then lines and great circles have one formula.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "temper/detail/geometry.hpp"
#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

/// Counter-clockwise. Empty: nothing.
using RayPolygon = std::vector<Vec3>;

/// A circle around a polygon, for a first look at what may overlap.
struct RayCircle {
  RayCircle() = default;
  RayCircle(const Space& space, std::span<const Vec3> polygon) {
    for (const Vec3 p : polygon) center = center + p;
    const double n = static_cast<double>(polygon.size());
    center = (1 / (space.is_plane() ? n : length(center))) * center;
    for (const Vec3 p : polygon) radius = std::max(radius, length(p - center));
    constexpr double kWide = 1.2;  // on the sphere a wider polygon may reach beyond its corners
    if (!space.is_plane() && radius > kWide) radius = 2;
  }
  /// Says whether another circle, moved by a step, is near enough.
  [[nodiscard]] bool may_meet(const RayCircle& other, Vec3 step) const {
    constexpr double kRounding = 1e-6;
    const double reach = (1 + kRounding) * (radius + other.radius);
    return squared_length(other.center + step - center) <= reach * reach;
  }

  Vec3 center;
  double radius = 0;
};

/// Cuts polygons, with storage that is kept.
class PolygonCutter {
 public:
  /// Keeps the part on the left of the line from a to b.
  void cut(RayPolygon& polygon, Vec3 a, Vec3 b) {
    const Vec3 normal = cross(a, b - a);
    const std::size_t n = polygon.size();
    sides_.resize(n);
    bool any_out = false, any_in = false;
    for (std::size_t i = 0; i < n; ++i) {
      sides_[i] = dot(normal, polygon[i] - a);
      (sides_[i] < 0 ? any_out : any_in) = true;
    }
    if (!any_out) return;
    if (!any_in) return polygon.clear();
    kept_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      if (sides_[i] >= 0) kept_.push_back(polygon[i]);
      if ((sides_[i] >= 0) != (sides_[j] >= 0))
        kept_.push_back(polygon[i] + (sides_[i] / (sides_[i] - sides_[j])) * (polygon[j] - polygon[i]));
    }
    polygon.swap(kept_);
  }
  /// Keeps the part in a convex polygon, which is moved by a step before.
  void cut(RayPolygon& polygon, std::span<const Vec3> other, Vec3 step = {}) {
    for (std::size_t i = 0; i < other.size() && !polygon.empty(); ++i)
      cut(polygon, other[i] + step, other[i + 1 == other.size() ? 0 : i + 1] + step);
  }

 private:
  std::vector<double> sides_;
  RayPolygon kept_;
};

/// The area of a polygon, of great circles on the sphere.
[[nodiscard]] inline double area_of(const Space& space, std::span<const Vec3> polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 a = polygon[0], b = polygon[i - 1], c = polygon[i];
    sum += space.is_plane() ? 0.5 * dot(a, cross(b - a, c - a)) : solid_angle(a, b, c);
  }
  return space.is_plane() ? sum : space.radius() * space.radius() * sum;
}

/// An area below which an overlap is rounding: as wide as some roundings of the coordinates.
[[nodiscard]] inline double negligible_area(const Space& space, std::span<const Vec3> polygon) {
  constexpr double kRounding = 0x1p-46;
  double extent = 0, largest = 0;
  for (const Vec3 p : polygon) {
    extent = std::max(extent, length(p - polygon[0]));
    largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  }
  return space.is_plane() ? kRounding * extent * largest : kRounding * extent * space.radius() * space.radius();
}

}  // namespace temper
