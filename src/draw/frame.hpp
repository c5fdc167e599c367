// From the user's coordinates to the page: which box is drawn, at what scale, on what grid.
//
// Points of long paths are integers on a grid fine enough for the mesh at hand, so that a path takes few bytes;
// the group around the paths scales the grid to pixels. Everything is clipped to a little more than the box
// before it is written: orthocenters of flat triangles lie anywhere.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "draw/view.hpp"
#include "temper/draw.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A point of the grid, y down.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

struct Segment {
  Vec2 from, to;
};

struct PageFrame {
  static constexpr double kLeastDetail = 6;   ///< pixels of a median edge, for duals and weights
  static constexpr double kLeastEdges = 1.5;  ///< for the edges themselves: closer lines are one grey

  View view;                     ///< from the mesh to the plane of the picture
  Box box;                       ///< what the panel shows, in this plane: of a mesh of the plane the user's coordinates
  Box clip;                      ///< a little more: what is written
  double scale = 1;              ///< pixels per unit of the user's
  double unit = 0.01;            ///< pixels per step of the grid
  double width = 0, height = 0;  ///< of the panel, pixels
  double edge = 0;               ///< median length of the edges that are drawn, pixels

  /// Is there room for duals and weights between the edges, and for more edges than the kept ones?
  [[nodiscard]] bool shows_detail() const { return edge == 0 || edge >= kLeastDetail; }
  [[nodiscard]] bool shows_edges() const { return edge == 0 || edge >= kLeastEdges; }
  [[nodiscard]] GridPoint grid(Vec2 p) const;
  [[nodiscard]] std::int64_t steps(double pixels) const;
};

/// One frame for all meshes: the zoom box, or what holds all their vertices that are seen.
[[nodiscard]] PageFrame make_frame(std::span<const Mesh* const> meshes, const DrawOptions& options);

/// The part of a segment inside the box; nothing when it misses it or is not finite.
[[nodiscard]] std::optional<Segment> clip(const Segment& segment, const Box& box);
/// The part of a polygon inside the box, empty when it misses it.
[[nodiscard]] std::vector<Vec2> clip(std::vector<Vec2> polygon, const Box& box);
/// Does the disc meet the box?
[[nodiscard]] bool meets(Vec2 center, double radius, const Box& box);

}  // namespace temper
