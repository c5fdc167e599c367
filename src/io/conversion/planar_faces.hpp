// The faces of a mesh that is given by its edges alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper::io {

using EdgeEnds = std::array<std::int32_t, 2>;

/// The triangles and quadrilaterals between edges that cross nowhere, counter-clockwise and in the order of their
/// edges. The fourth corner of a triangle is kNoCorner. Faces with five or six sides are cells that temper does not
/// have: an error names the first one. (D-Flow FM has cells of up to six sides.) Faces with more are holes. Points may
/// be in degrees. Ends must be points. O(n log n).
[[nodiscard]] std::vector<std::array<std::int32_t, 4>> planar_faces(std::span<const Vec2> points,
                                                                    std::span<const EdgeEnds> edges,
                                                                    const InputNames& names, const std::string& path);

}  // namespace temper::io
