// The names that the reader and the writer of Gmsh files share.
#pragma once

#include <cstdint>
#include <string_view>

namespace temper::io {

inline constexpr std::int32_t kGmshLine = 1, kGmshTriangle = 2, kGmshQuadrilateral = 3, kGmshTetrahedron = 4,
                              kGmshPoint = 15;
/// Data array with the number of the geometric entity of each element, as meshio names it.
inline constexpr std::string_view kGmshEntity = "gmsh:geometrical";
/// Data array with the partition of each triangle.
inline constexpr std::string_view kGmshPartition = "gmsh:partition";
/// Data array of the cells in a physical group that is not their first: this and the tag, "gmsh:physical:7".
inline constexpr std::string_view kGmshFurtherGroup = "gmsh:physical:";

}  // namespace temper::io
