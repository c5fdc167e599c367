// The conventions that the reader and the writer of UGRID share.
#pragma once

#include <string_view>

namespace temper::io {

inline constexpr std::string_view kUgridConventions = "CF-1.8 UGRID-1.0", kUsualTopology = "mesh",
                                  kNodesLongName = "vertices", kProjectedX = "projection_x_coordinate",
                                  kProjectedY = "projection_y_coordinate";

[[nodiscard]] inline bool is_radian(std::string_view units) { return units.starts_with("rad"); }

}  // namespace temper::io
