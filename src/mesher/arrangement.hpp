// The outline as a planar graph: checked, joined within a tolerance, segments cut where places lie on them, equal edges
// merged.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/surface.hpp"
#include "mesher/deadline.hpp"
#include "mesher/snap.hpp"
#include "temper/detail/error.hpp"
#include "temper/detail/outline.hpp"

namespace temper::mesher {

/// An edge between two places of the outline that has no other place on it.
struct OutlineEdge {
  std::array<std::int32_t, 2> ends = {};
  std::vector<std::int32_t> tags;   ///< of its segments, each once, without 0
  std::vector<std::int32_t> parts;  ///< sorted: crossing the edge enters or leaves these parts, then rings
  std::uint32_t segment = 0;        ///< the first given one
};

struct Arrangement {
  static constexpr std::uint32_t kNoPoint = 0xffffffffu;
  std::vector<Vec3> places;                  ///< first of points, in their order; then of crossings
  std::vector<std::uint32_t> point;          ///< the first given point at each place, or kNoPoint
  std::vector<std::int32_t> place_of_point;  ///< of each given point; -1 if it was left out
  std::vector<std::int32_t> origin;          ///< of each place: itself, or the place that it was split from
  std::vector<OutlineEdge> edges;            ///< in the order of the segments
  std::vector<std::uint8_t> kept;            ///< of each part, then ring: does it have an edge?
  std::vector<std::string> notes, warnings;  ///< on joins
};

/// Leaves out rings whose extent is below `drop_below`. Joins, divides and merges. Errors: everything that makes
/// segments no planar graph. `places`: of the points. A whole sphere needs no segments.
[[nodiscard]] Expected<Arrangement> arrange(const Surface& surface, const Outline& outline,
                                            const std::vector<Vec3>& places, const SnapOptions& options,
                                            double drop_below, Deadline& deadline);

/// An error if a tag is for none of the n elements of the outline.
[[nodiscard]] std::optional<InputError> check_tags(const std::vector<OutlineTag>& tags, const std::string& what,
                                                   std::size_t n);

/// An error if a size is for no point of the outline, or no length.
[[nodiscard]] std::optional<InputError> check_sizes(const Outline& outline);

/// The names of the outline, or names that count from 0.
[[nodiscard]] const OutlineNames& names_of(const Outline& outline);

/// "'river'", or "tag 5" without a name.
[[nodiscard]] std::string name_of_tag(const Outline& outline, int dimension, std::int32_t tag);

/// "(8.5, 53.25)": a place in the coordinates of the file.
[[nodiscard]] std::string text_of(const Surface& surface, const OutlineNames& names, Vec3 place);

}  // namespace temper::mesher
