// From the user's coordinates to the page: box, scale and grid of the picture.
//
// Points of long paths are integers on a grid that is fine enough for the mesh, so that a path takes few bytes. The
// group around the paths scales the grid to pixels. Everything is clipped to a little more than the box before it is
// written, as orthocenters of flat triangles lie anywhere.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "draw/section.hpp"
#include "temper/draw.hpp"
#include "temper/mesh.hpp"

namespace temper {

// From a mesh to its flat picture: the plane as it is, or the near half of a sphere seen from far away.
//
// A sphere is projected along parallel lines: a disc of its radius, north up. Arcs become chains of segments too short
// to tell from curves, and end at the limb.
//
//        .-- y --.
//      /     ^     \      the picture: x and y, in the unit of length of the mesh;
//     |      +-> x  |     z: towards the viewer, in parts of the radius; points with z < 0 are behind the limb.
//      \           /
//        '-------'  limb

class View {
 public:
  /// Of the plane.
  View() = default;
  /// The view of a sphere, with longitude and latitude of the middle of the picture [degrees].
  View(double radius, Vec2 middle);

  /// True for the plane, which is shown as it is.
  [[nodiscard]] bool is_flat() const { return radius_ == 0; }
  /// The radius of the disc of a sphere; 0 in the plane.
  [[nodiscard]] double radius() const { return radius_; }

  // Points are points of the mesh's space; on the sphere only the direction counts.

  /// The place of a point in the picture.
  [[nodiscard]] Vec2 at(const WeightedPoint& p) const;
  /// Says whether a point is not behind the limb.
  [[nodiscard]] bool shows(const WeightedPoint& p) const;
  /// The visible part of the edge from p to q: a chain of points, empty when it is behind the limb.
  [[nodiscard]] std::vector<Vec2> line(const WeightedPoint& p, const WeightedPoint& q) const;
  /// The visible part of a triangle: a polygon, empty when it is behind the limb.
  [[nodiscard]] std::vector<Vec2> polygon(const std::array<WeightedPoint, 3>& triangle) const;
  /// Points around one of the sphere, whose arcs are a circle of this radius [length]. Precondition: a sphere.
  [[nodiscard]] std::vector<WeightedPoint> circle(const WeightedPoint& p, double radius) const;

 private:
  [[nodiscard]] Vec3 seen(const WeightedPoint& p) const;
  void add_arc(std::vector<Vec2>& chain, Vec3 a, Vec3 b) const;

  double radius_ = 0;
  Vec3 right_, up_, towards_;
};

/// The requested view of meshes of one space. The default view of a sphere is centered on the middle of the mesh, or on
/// 0° E, 0° N if the mesh covers all of it.
[[nodiscard]] View make_view(std::span<const Mesh* const> meshes, const DrawOptions& options);

/// A point of the grid, y down.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

struct Segment {
  Vec2 from, to;
};

struct Viewport {
  static constexpr double kLeastDetail = 6;   ///< pixels of a median edge, for duals and weights
  static constexpr double kLeastEdges = 1.5;  ///< for the edges themselves: closer lines are one gray
  static constexpr double kGapEms = 1.5;      ///< between panels and around the picture

  View view;                     ///< from the mesh to the plane of the picture
  Box box;                       ///< what the panel shows, in this plane: of a mesh of the plane the user's coordinates
  Box clip;                      ///< a little more: what is written
  double scale = 1;              ///< pixels per unit of the user's
  double unit = 0.01;            ///< pixels per step of the grid
  double width = 0, height = 0;  ///< of the panel, pixels
  double edge = 0;               ///< median length of the edges that are drawn, pixels
  double em = 0;                 ///< font size, pixels: 12 when the picture is scaled to a width of 700

  /// Is there room for duals and weights between the edges, and for more edges than the kept ones?
  [[nodiscard]] bool shows_detail() const { return edge == 0 || edge >= kLeastDetail; }
  [[nodiscard]] bool shows_edges() const { return edge == 0 || edge >= kLeastEdges; }
  [[nodiscard]] GridPoint grid(Vec2 p) const;
  [[nodiscard]] std::int64_t steps(double pixels) const;
};

/// One viewport for all meshes: the zoom box, or the box of all their visible vertices.
[[nodiscard]] Viewport make_viewport(std::span<const Mesh* const> meshes, const DrawOptions& options);
/// One viewport for all sections: the zoom box, or the box of all their cells.
[[nodiscard]] Viewport make_viewport(std::span<const Section> sections, const DrawOptions& options);

/// The part of a segment inside the box; nothing when it misses it or is not finite.
[[nodiscard]] std::optional<Segment> clip(const Segment& segment, const Box& box);
/// The part of a polygon inside the box, empty when it misses it.
[[nodiscard]] std::vector<Vec2> clip(std::vector<Vec2> polygon, const Box& box);
[[nodiscard]] bool meets(Vec2 center, double radius, const Box& box);

// The d attribute of an SVG path in few bytes: relative integer coordinates, and no byte that SVG's grammar does not
// need. "m3 4l-1-2 5 0z": a minus sign separates numbers, and a repeated l is omitted.

class PathText {
 public:
  void move_to(GridPoint p);
  void line_to(GridPoint p);
  void close();
  void circle(GridPoint center, std::int64_t radius);
  /// A separate segment, from the end that is nearer to the current point of the path.
  void segment(GridPoint a, GridPoint b);

  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void command(char c);
  void number(std::int64_t value);
  void step_to(GridPoint p);

  std::string text_;
  GridPoint at_;      // the current end of the path
  GridPoint start_;   // the beginning of its subpath
  char last_ = '\0';  // the command that a bare pair of numbers would repeat
};

}  // namespace temper
