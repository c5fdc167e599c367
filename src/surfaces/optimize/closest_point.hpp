// The point of a surface that is closest to a given point.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/bounding_boxes.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

struct ClosestPoint {
  Vec3 at;
  double squared_distance = 0;
  std::uint32_t triangle = 0;
};

/// Triangles in a tree of boxes, each halved by count along its longest side.
class ClosestPoints {
 public:
  using Triangle = std::array<Vec3, 3>;

  ClosestPoints() = default;
  /// A triangle may be a segment, with its third corner at the first.
  explicit ClosestPoints(std::vector<Triangle> triangles);
  explicit ClosestPoints(const SurfaceMesh& mesh);

  /// Of equally close points always the same. A point within `enough` of p, closest or not, ends the search. O(log n)
  /// for points near the surface.
  [[nodiscard]] ClosestPoint find(Vec3 p, double enough = 0) const;
  [[nodiscard]] bool is_within(double distance, Vec3 p) const {
    return find(p, distance).squared_distance <= distance * distance;
  }

 private:
  static constexpr std::size_t kLeaf = 4;

  [[nodiscard]] BoundingBox box_of(std::size_t first, std::size_t last) const;
  void build(std::size_t node, std::size_t first, std::size_t last);
  struct Search {
    Vec3 p;
    double enough2;
    ClosestPoint best;
  };
  void search(std::size_t node, std::size_t first, std::size_t last, Search& state) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<BoundingBox> boxes_;  ///< Of node i; its halves are 2 i + 1 and 2 i + 2
};

/// The point of a triangle that is closest to p. The triangle may be a segment, as above.
[[nodiscard]] Vec3 closest_point(const std::array<Vec3, 3>& triangle, Vec3 p);

}  // namespace temper::surfaces
