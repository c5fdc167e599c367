// Names in VTKHDF files, for the reader and the writer.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "io/text/file_names.hpp"
#include "temper/detail/vec.hpp"

namespace temper::io {

inline constexpr std::string_view kVtkhdfGroup = "VTKHDF", kVtkhdfType = "UnstructuredGrid";
/// An attribute of temper's own, for arrays whose name HDF5 does not accept.
inline constexpr const char* kVtkhdfName = "temper_name";

struct JoinedPoints {
  RunLength kept;                    ///< the points of the file that are left, in its order
  std::vector<std::int32_t> number;  ///< for each point of the file, its number among those
};
/// `sizes`: of each piece; `place(i)`: of each point of the file. Points of one piece stay apart, wherever they are.
/// Precondition: there are fewer than 2³¹ points.
[[nodiscard]] JoinedPoints join_points(const std::vector<std::size_t>& sizes,
                                       const std::function<Vec3(std::size_t)>& place);

}  // namespace temper::io
