// The names that the reader and the writer of Gmsh files share, and what they say of groups.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string_view>

#include "io/conversion/known_arrays.hpp"

namespace temper::io {

inline constexpr std::int32_t kGmshLine = 1, kGmshTriangle = 2, kGmshQuadrilateral = 3, kGmshTetrahedron = 4,
                              kGmshPoint = 15;
/// Data array with the number of the geometric entity of each element, as meshio names it.
inline constexpr std::string_view kGmshEntity = "gmsh:geometrical";
/// Data array with the partition of each triangle.
inline constexpr std::string_view kGmshPartition = "gmsh:partition";
/// By dimension, the name of the group of all elements without another one. Readers know it, and take it for no group.
inline constexpr std::array<std::string_view, 4> kGmshUngrouped = {
    "temper_ungrouped_points", "temper_ungrouped_lines", "temper_ungrouped_faces", "temper_ungrouped_tetrahedra"};

/// A positive tag that is not taken: one above the largest, while there is one.
[[nodiscard]] inline std::int32_t free_tag(const std::set<std::int32_t>& taken) {
  if (taken.empty() || *taken.rbegin() < 0) return 1;
  if (*taken.rbegin() < std::numeric_limits<std::int32_t>::max()) return *taken.rbegin() + 1;
  std::int32_t tag = 1;
  while (taken.contains(tag)) ++tag;
  return tag;
}

}  // namespace temper::io
