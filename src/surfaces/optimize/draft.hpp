// A surface, or a part of it, while its vertices move; and what steps may do to its triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surfaces/optimize/closest_point.hpp"
#include "surfaces/optimize/lines.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

struct Draft {
  IdVector<VertexId, WeightedPoint> points;
  std::vector<std::array<VertexId, 3>> triangles;
  IdVector<VertexId, Track> tracks;         ///< Where a vertex may move
  IdVector<VertexId, std::uint8_t> weighs;  ///< Says whether its weight may change
  const Lines* lines = nullptr;             ///< For tracks that are lines

  [[nodiscard]] std::array<WeightedPoint, 3> corners(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {points[a], points[b], points[c]};
  }
};

/// The direction of a; 0 if it has none.
[[nodiscard]] inline Vec3 unit(Vec3 a) { return squared_length(a) > 0 ? (1 / length(a)) * a : Vec3{}; }
[[nodiscard]] inline Vec3 normal_of(Vec3 a, Vec3 b, Vec3 c) { return cross(b - a, c - a); }

/// Twice the area over the square of the longest side: 0.87 for equilateral triangles.
[[nodiscard]] double width_of(const std::array<Vec3, 3>& triangle);
/// Widths below this are thin: a step makes no triangle thin, and no thin one thinner.
inline constexpr double kThin = 0.2;
[[nodiscard]] inline Vec3 normal_at(const SurfaceMesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return normal_of(a.position(), b.position(), c.position());
}
/// The angle by which the surface turns at an edge: between the normals of its triangles [degrees].
[[nodiscard]] double turn_deg(Vec3 normal, Vec3 other);

/// The largest turns that a step may make [degrees]. Without sharp turns of the input a surface cannot stay near it,
/// and bad triangles between them need others.
struct TurnLimit {
  double sharp = 180;     ///< At edges that do not turn more before the step
  double at_bad = 180;    ///< At the edges of triangles that are not well-centered before it
  double sharpest = 180;  ///< At edges that turn more than `sharp` before it
  [[nodiscard]] double at(double before, bool is_bad) const {
    return std::max({sharp, is_bad ? at_bad : 0, before > sharp ? sharpest : 0});
  }
};

/// Takes vertices back to their first places, until no triangle folds over or becomes thin, and no edge turns too much.
void go_back(Draft& draft, const IdVector<VertexId, WeightedPoint>& first, const TurnLimit& limit);

/// The two triangles of an edge; on the boundary, its triangle twice.
struct DraftEdge {
  struct Side {
    std::size_t triangle, corner;  ///< The corner opposite the edge
  };
  std::array<Side, 2> sides;
  bool is_boundary;
};
/// Ascending by the numbers of the ends. O(n log n).
[[nodiscard]] std::vector<DraftEdge> edges_of(const std::vector<std::array<VertexId, 3>>& triangles);

}  // namespace temper::surfaces
