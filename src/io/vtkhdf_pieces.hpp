// Pieces of a mesh, each with points of its own, as one mesh: points of two pieces in one place are one point.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "io/file_names.hpp"
#include "temper/vec3.hpp"

namespace temper::io {

struct JoinedPoints {
  RunLength kept;                    ///< the points of the file that are left, in its order
  std::vector<std::int32_t> number;  ///< for each point of the file, its number among those
};
/// `sizes`: of each piece; `place(i)`: of each point of the file. Points of one piece stay apart, wherever they are.
/// Precondition: there are fewer than 2³¹ points.
[[nodiscard]] JoinedPoints join_points(const std::vector<std::size_t>& sizes,
                                       const std::function<Vec3(std::size_t)>& place);

}  // namespace temper::io
