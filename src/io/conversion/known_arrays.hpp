// Arrays of data that say something about the mesh, by the names that they have in files.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "temper/io.hpp"

namespace temper::io {

/// Flags of points, lines and faces: special places, and parts that must not change.
inline constexpr std::string_view kCorner = "medit:corner", kRequired = "medit:required";
/// Of marked points: 0 a point, 1 its partner across a levee, which stays opposite.
inline constexpr std::string_view kPairSide = "adcirc:side";
/// This array of lines has 1 if the dual of the edge is a face that must stay, such as a piece of a fault; else 0.
inline constexpr std::string_view kFace = "temper:face";
/// A weight for each corner of each cell, where tensors of several planes meet.
inline constexpr std::string_view kCornerWeights = "corner_weights";
/// The first group of each cell. Without it, this is the region.
inline constexpr std::string_view kFirstGroup = "gmsh:physical:first";
/// The cells in a group that is not their first: this and the tag, "gmsh:physical:7".
inline constexpr std::string_view kFurtherGroup = "gmsh:physical:";

/// The tag in the name gmsh:physical:TAG; nothing for other arrays.
[[nodiscard]] inline std::optional<std::int32_t> further_group(const DataArray& array) {
  const std::string_view name = array.name;
  if (array.components != 1 || !name.starts_with(kFurtherGroup)) return {};
  const std::string_view digits = name.substr(kFurtherGroup.size());
  std::int32_t tag = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), tag);
  if (error != std::errc() || end != digits.data() + digits.size() || tag == 0) return {};
  return tag;
}

}  // namespace temper::io
