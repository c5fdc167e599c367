// The point of a surface that is closest to a given point, and the largest distance of a piece from a surface.
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

/// A bound of the distances of all points of a piece from a surface.
struct DistanceBound {
  double most = 0;  ///< infinity: one point, or all that is known of it, is farther than allowed
  Vec3 far = {};    ///< Such a point
};

/// A triangle or a segment, and planes across it: through its sides, or through its ends. Their normals face away.
struct Target {
  std::array<Vec3, 3> corners;  ///< A segment has its first corner as the third, too
  Vec3 normal;                  ///< Unit normal; zero for a segment, and for a triangle whose area is rounding
  std::array<Vec3, 3> away;     ///< Unit normal of the plane through corners k and k + 1, or corner k + 1

  explicit Target(const std::array<Vec3, 3>& triangle);
  [[nodiscard]] bool is_segment() const { return corners[2] == corners[0]; }
  /// The distance of p from plane k: positive beyond it.
  [[nodiscard]] double beyond(std::size_t k, Vec3 p) const { return dot(away[k], p - corners[(k + 1) % 3]); }
  /// The squared distance of p, or infinity if it is more than `most`.
  [[nodiscard]] double squared_distance(Vec3 p, double most) const;
};

/// Triangles in a tree of boxes, each halved by count along its longest side.
class ClosestPoints {
 public:
  using Triangle = std::array<Vec3, 3>;

  ClosestPoints() = default;
  /// A triangle may be a segment, with its third corner at the first.
  explicit ClosestPoints(const std::vector<Triangle>& triangles);
  explicit ClosestPoints(const SurfaceMesh& mesh);

  [[nodiscard]] const std::vector<Target>& targets() const { return targets_; }
  /// If several points are equally close, returns the same one each time. O(log n) for points near the surface.
  [[nodiscard]] ClosestPoint find(Vec3 p) const;

  /// Returns an upper bound of the distances of all points of a triangle, at least `enough`. It is infinity if it would
  /// be more than `allowed`. Usually it is at most 0.1 % above the larger of `enough` and the largest distance.
  ///
  /// The distance from a triangle T of the surface is a convex function. So no point of a piece is farther from T than
  /// its farthest corner is. Pieces are cut until one T is near enough to all of each.
  [[nodiscard]] DistanceBound bound(const Triangle& triangle, double enough, double allowed) const;
  /// The triangles whose boxes are within a distance of the box of a triangle.
  [[nodiscard]] std::vector<std::uint32_t> near(const Triangle& triangle, double distance) const;

 private:
  static constexpr std::size_t kLeaf = 4;

  [[nodiscard]] BoundingBox box_of(std::size_t first, std::size_t last) const;
  void build(std::size_t node, std::size_t first, std::size_t last);
  struct Search {
    Vec3 p;
    ClosestPoint best;
  };
  void search(std::size_t node, std::size_t first, std::size_t last, Search& state) const;
  void collect(std::size_t node, std::size_t first, std::size_t last, const BoundingBox& box,
               std::vector<std::uint32_t>& found) const;

  std::vector<Target> targets_;
  std::vector<std::uint32_t> order_;
  std::vector<BoundingBox> boxes_;  ///< Of node i; its halves are 2 i + 1 and 2 i + 2
};

[[nodiscard]] inline ClosestPoints::Triangle corners_of(const SurfaceMesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return {a.position(), b.position(), c.position()};
}

/// The point of a triangle that is closest to p. The triangle may be a segment, as above.
[[nodiscard]] Vec3 closest_point(const std::array<Vec3, 3>& triangle, Vec3 p);

}  // namespace temper::surfaces
