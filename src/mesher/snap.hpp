// Joins of what is nearly the same place, before the outline becomes a planar graph.
//
// Files round coordinates. So a line ends beside the border that it should end on, and two polygons have different
// points on the border that they share. Within a tolerance
//   - a place is joined to the first one that is nearer than the tolerance;
//   - a segment that passes a place is divided there.
// This repeats until nothing is left to join. Places never move: a joined point takes the place of an earlier point.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/surface.hpp"
#include "mesher/deadline.hpp"

namespace temper::mesher {

/// A part of a segment, between two places.
struct SegmentPart {
  std::array<std::int32_t, 2> ends = {};
  std::uint32_t segment = 0;
};

struct SnapOptions {
  double within = 0;             ///< Tolerance [length]; 0: only places that lie exactly on segments divide them
  bool split_crossings = false;  ///< Divide segments where they cross; else given segments that cross are reported
  std::vector<std::uint8_t> ignored = {};  ///< Places that take no part; empty: none
};

/// Two given segments that cross.
struct Crossing {
  std::uint32_t first = 0, second = 0;
  Vec3 at;
};

struct Snapped {
  std::vector<Vec3> places;  ///< the given ones with their numbers, then crossings
  std::vector<std::int32_t>
      joined;  ///< of each place, the place that it is joined to, which is itself or an earlier one; -1 if ignored
  std::vector<SegmentPart> parts;  ///< in the order of the segments, and along each; none of length 0
  std::size_t joins = 0;           ///< number of given places that were joined to another or to a segment
  double largest = 0;              ///< the largest distance of a join, more than rounding
  std::int32_t farthest = -1;      ///< the place of that join
  std::optional<Crossing> crossing;
};

/// `segments`: each with two different ends. The result has no crossing, and no place in a part, exactly; unless there
/// is a `crossing` or the deadline has stopped. O(n log n) per round, unless segments lie across each other's boxes.
[[nodiscard]] Snapped snap(const Surface& surface, std::vector<Vec3> places, std::vector<SegmentPart> segments,
                           const SnapOptions& options, Deadline& deadline);

}  // namespace temper::mesher
