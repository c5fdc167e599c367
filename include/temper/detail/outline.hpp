// An outline is the input of the mesher: a planar straight-line graph (PSLG), that is points and segments between them,
// with what they enclose.
//
// Its segments may be long or short, enclose holes and islands, separate regions, end anywhere inside or branch. Points
// keep their place bit for bit in every mesh made of it.
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

struct OutlineSegment {
  std::array<std::int32_t, 2> ends = {};  ///< points, from 0
  std::int32_t tag = 0;                   ///< boundary marker; edges made of the segment carry it
};

/// A place, and what is said of all that can be reached from it without crossing a segment.
struct OutlineRegion {
  Vec2 at;
  std::int32_t region = 0;
  std::optional<double> size = {};  ///< edge length wanted there, when less than elsewhere
};

/// An area given by its boundary: inside is what a ray leaves across an odd number of these segments. (On the sphere,
/// which has no outside: the smaller of what they leave.)
struct OutlinePart {
  std::int32_t region = 0;
  std::vector<std::int32_t> segments;
  std::optional<double> size = {};  ///< edge length wanted inside, when less than elsewhere
  bool cut = false;                 ///< what it encloses is left out: of parts on the sphere
};

/// The user's numbers of the elements of an outline, so that errors speak them. (Inline, as InputNames.)
class OutlineNames {
 public:
  virtual ~OutlineNames() = default;
  [[nodiscard]] virtual std::string point(std::size_t index) const { return "point " + std::to_string(index); }
  [[nodiscard]] virtual std::string segment(std::size_t index) const { return "segment " + std::to_string(index); }
  [[nodiscard]] virtual std::string hole(std::size_t index) const { return "hole " + std::to_string(index); }
  [[nodiscard]] virtual std::string region(std::size_t index) const { return "region " + std::to_string(index); }
  [[nodiscard]] virtual std::string part(std::size_t index) const { return "part " + std::to_string(index); }
  /// "lake.poly:7", the place of the element in its file, or nothing.
  [[nodiscard]] virtual std::string point_where(std::size_t /*index*/) const { return {}; }
  [[nodiscard]] virtual std::string segment_where(std::size_t /*index*/) const { return {}; }
  [[nodiscard]] virtual std::string hole_where(std::size_t /*index*/) const { return {}; }
  [[nodiscard]] virtual std::string region_where(std::size_t /*index*/) const { return {}; }
};

struct Outline {
  std::vector<Vec2> points;
  std::vector<OutlineSegment> segments;
  std::vector<Vec2> holes;  ///< a place in each hole
  std::vector<OutlineRegion> regions;
  std::vector<OutlinePart> parts;             ///< when there are any they alone say what is inside
  std::shared_ptr<const OutlineNames> names;  ///< null: counted from 0
};

}  // namespace temper
