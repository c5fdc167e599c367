// Quadrilaterals: one face each in a file, two triangles each in a mesh.
//
//     d-------c      The reader gives the face (a, b, c) and its fourth corner d. The mesh has abc and acd, or abd and
//     |     / |      bcd if these are better. Both have the number of the quadrilateral as cell data, so that the pair
//     |   /   |      goes wherever data of triangles go. The writer makes the face from it again.
//     a-------b
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "io/text/file_names.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// Instead of the fourth corner of a triangle. Other numbers below 0 are errors of the file.
inline constexpr std::int32_t kNoCorner = std::numeric_limits<std::int32_t>::min();

/// The corners of a face in a cycle. A triangle has its first corner twice.
[[nodiscard]] inline std::array<std::int32_t, 4> corners_of_face(const std::array<std::int32_t, 3>& first,
                                                                 const std::vector<std::int32_t>& fourth_corners,
                                                                 std::size_t face) {
  const std::int32_t fourth = face < fourth_corners.size() ? fourth_corners[face] : kNoCorner;
  return {first[0], first[1], first[2], fourth == kNoCorner ? first[0] : fourth};
}

/// Cell data: the number of the quadrilateral, counted from 1, or 0 for a triangle.
inline constexpr std::string_view kQuadrilateral = "temper:quadrilateral";

/// Cuts the faces that have a fourth corner. Regions, cell data and names are those of faces before, and of
/// triangles after it. `heights`: z of each point, or empty.
void cut_quadrilaterals(MeshFile& file, FileNames& names, const std::vector<std::int32_t>& fourth_corners,
                        const std::vector<double>& heights);

/// Half of a quadrilateral, and the other one. The diagonal is from corner (k + 1) % 3 to corner (k + 2) % 3.
struct Halves {
  std::size_t triangle, other;
  std::size_t k;        ///< the corner that the other triangle does not have
  std::int32_t fourth;  ///< the corner that the triangle does not have
};
/// The quadrilaterals of a file, in the order of their first triangles. Numbers that are not on two triangles with a
/// common edge count for nothing.
[[nodiscard]] std::vector<Halves> quadrilaterals_of(const MeshFile& file);

/// Takes regions and cell data to other faces, without the numbers of quadrilaterals: `from` has the old face of each.
void gather_faces(MeshFile& file, const RunLength& from);

/// Makes faces of halves: triangles come first, then the quadrilaterals without their fourth corners, which are
/// returned.
[[nodiscard]] std::vector<std::int32_t> join_quadrilaterals(MeshFile& file, const std::vector<Halves>& quadrilaterals);

}  // namespace temper::io
