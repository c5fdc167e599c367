// An outline is the input of the mesher: a planar straight-line graph (PSLG). It has points, segments between them, and
// the areas that they enclose.
//
// Segments may be long or short, enclose holes and islands, separate regions, end anywhere inside, or branch. Points
// keep their place bit for bit in every mesh of the outline.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "temper/detail/vec.hpp"

namespace temper {

/// A named group of elements: Gmsh physical names.
struct PhysicalName {
  int dimension = 0;  ///< 0 points, 1 lines, 2 triangles
  std::int32_t tag = 0;
  std::string name;
};

/// The parts of a mesh that lines can become.
enum class LineKind : std::uint8_t {
  edges,  ///< Edges of triangles: centers of power cells lie on the line
  faces,  ///< Faces of power cells: centers lie on both sides. Only inside the domain, in the plane
};

struct OutlineSegment {
  std::array<std::int32_t, 2> ends = {};  ///< Numbers of its end points, from 0
  std::int32_t tag = 0;                   ///< Boundary marker; edges of the segment, or of its faces, carry it
  LineKind as = LineKind::edges;
};

/// A tag of a point or of a segment, beside those that it has.
struct OutlineTag {
  std::int32_t element = 0;  ///< Number of the point or segment, from 0
  std::int32_t tag = 0;
};

/// Desired edge length at a point, or along the line between two points. Away from it lengths grow by the grade.
struct OutlineSize {
  std::array<std::int32_t, 2> points = {};  ///< Numbers of points of the outline, from 0; twice the same: at that point
  double size = 0;                          ///< Length, > 0; it counts if it is less than elsewhere
};

/// A place in a region. Its data hold for everything that can be reached from it without crossing a segment.
struct OutlineRegion {
  Vec2 at;
  std::int32_t region = 0;
  std::optional<double> size = {};  ///< Desired edge length there, if less than elsewhere
};

/// An area given by its boundary. A point is inside if a ray from it crosses an odd number of these segments. (The
/// sphere has no outside: there the inside is the smaller side.)
struct OutlinePart {
  std::int32_t region = 0;
  std::vector<std::int32_t> segments;
  std::optional<double> size = {};  ///< Desired edge length inside, if less than elsewhere
  bool cut = false;                 ///< Leave out the area; only for parts on the sphere
};

/// A closed ring of a polygon. Rings only serve checks: each hole lies in its shell, and holes do not overlap.
struct OutlineRing {
  std::vector<std::int32_t> segments;
  std::int32_t shell = -1;  ///< The ring around this hole; -1: this ring is a shell
};

/// The user's numbers of the elements of an outline, for errors. (Inline, as InputNames.)
class OutlineNames {
 public:
  virtual ~OutlineNames() = default;
  [[nodiscard]] virtual std::string point(std::size_t index) const { return "point " + std::to_string(index); }
  [[nodiscard]] virtual std::string segment(std::size_t index) const { return "segment " + std::to_string(index); }
  [[nodiscard]] virtual std::string hole(std::size_t index) const { return "hole " + std::to_string(index); }
  [[nodiscard]] virtual std::string region(std::size_t index) const { return "region " + std::to_string(index); }
  [[nodiscard]] virtual std::string part(std::size_t index) const { return "part " + std::to_string(index); }
  [[nodiscard]] virtual std::string ring(std::size_t index) const { return "ring " + std::to_string(index); }
  /// A place in the coordinates of the file, if the outline was projected.
  [[nodiscard]] virtual Vec2 in_file(Vec2 place) const { return place; }
  /// The place of the element in its file, such as "lake.poly:7", or nothing.
  [[nodiscard]] virtual std::string point_where(std::size_t /*index*/) const { return {}; }
  [[nodiscard]] virtual std::string segment_where(std::size_t /*index*/) const { return {}; }
  [[nodiscard]] virtual std::string hole_where(std::size_t /*index*/) const { return {}; }
  [[nodiscard]] virtual std::string region_where(std::size_t /*index*/) const { return {}; }
};

struct Outline {
  std::vector<Vec2> points;
  std::vector<OutlineSegment> segments;
  std::vector<Vec2> holes;  ///< A place in each hole
  std::vector<OutlineRegion> regions;
  std::vector<OutlinePart> parts;             ///< Parts; if there are any, they alone define the inside
  std::vector<OutlineRing> rings;             ///< Rings of polygons
  std::shared_ptr<const OutlineNames> names;  ///< Names for errors; null: counted from 0
  std::vector<OutlineTag> point_tags;         ///< Tags of points; their vertices are fixed and carry them
  std::vector<OutlineTag> further_tags;       ///< Tags of segments that have more than one
  std::vector<OutlineSize> sizes;             ///< Desired edge lengths at points and along lines
  std::vector<PhysicalName> groups;           ///< Names of the tags of points and segments, and of regions
};

}  // namespace temper
