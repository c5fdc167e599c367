// The outline as a planar graph: checked, segments cut where points lie on them, equal edges merged.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/surface.hpp"
#include "temper/detail/error.hpp"
#include "temper/detail/outline.hpp"

namespace temper::mesher {

/// An edge between two points of the outline that has no other point on it.
struct OutlineEdge {
  std::array<std::int32_t, 2> ends = {};
  std::vector<std::int32_t> tags;   ///< of its segments, each once, without 0
  std::vector<std::int32_t> parts;  ///< sorted: crossing the edge enters or leaves these
};

/// The edges, in the order of the segments. Errors: everything that makes segments no planar graph. Exact predicates
/// decide if points lie on segments and if segments cross. O(n log n) unless segments lie across each other's boxes.
/// `places`: of the points. A whole sphere needs no segments.
[[nodiscard]] Expected<std::vector<OutlineEdge>> arrange(const Surface& surface, const Outline& outline,
                                                         const std::vector<Vec3>& places);

/// An error if a tag is for none of the n elements of the outline.
[[nodiscard]] std::optional<InputError> check_tags(const std::vector<OutlineTag>& tags, const std::string& what,
                                                   std::size_t n);

/// An error if a size is for no point of the outline, or no length.
[[nodiscard]] std::optional<InputError> check_sizes(const Outline& outline);

/// The names of the outline, or names that count from 0.
[[nodiscard]] const OutlineNames& names_of(const Outline& outline);

}  // namespace temper::mesher
