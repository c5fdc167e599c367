// The outline as a planar graph: checked, joined within a tolerance, segments cut where places lie on them, equal edges
// merged.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/deadline.hpp"
#include "mesher/problem.hpp"

namespace temper::mesher {

/// An edge between two places of the outline that has no other place on it.
struct OutlineEdge {
  std::array<std::int32_t, 2> ends = {};
  std::vector<std::int32_t> tags;   ///< of its segments, each once, without 0
  std::vector<std::int32_t> parts;  ///< sorted: crossing the edge enters or leaves these parts, then rings
  std::uint32_t segment = 0;        ///< the first given one
  LineKind as = LineKind::edges;    ///< faces if one of its segments becomes faces
};

struct Arrangement {
  static constexpr std::uint32_t kNoPoint = 0xffffffffu;
  static constexpr std::int32_t kOnFace = -2;  ///< the place of a point that is on a face, and no vertex
  std::vector<Vec3> places;                    ///< first of points, in their order; then of crossings
  std::vector<std::uint32_t> point;            ///< the first given point at each place, or kNoPoint
  std::vector<std::int32_t> place_of_point;    ///< of each given point; -1 if it was left out, or kOnFace
  std::vector<std::int32_t> origin;            ///< of each place: itself, or the place that it was split from
  std::vector<OutlineEdge> edges;              ///< in the order of the segments
  std::vector<std::uint8_t> kept;              ///< of each part, then ring: does it have an edge?
  std::vector<std::string> notes, warnings;    ///< on joins

  [[nodiscard]] Vec3 place(std::int32_t i) const { return places[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::array<Vec3, 2> ends(std::size_t edge) const {
    return {place(edges[edge].ends[0]), place(edges[edge].ends[1])};
  }
};

/// Leaves out rings whose extent is below the option `drop_below`. Joins, divides and merges. Errors: everything that
/// makes segments no planar graph. A whole sphere needs no segments.
[[nodiscard]] Expected<Arrangement> arrange(const Problem& problem, Deadline& deadline);

}  // namespace temper::mesher
