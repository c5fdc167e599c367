// Points that are nearly at one place: cracks in a mesh, and their cure.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/input.hpp"
#include "temper/detail/vec.hpp"

namespace temper::app {

/// The pairs of points that are at most `radius` apart, in ascending order. O(n log n) if there are few.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs_within(std::span<const Vec3> points,
                                                                            double radius);

/// Says which vertices of the boundary are nearly at one place but not the same, and how to merge them. Empty: none.
[[nodiscard]] std::string crack_warning(const Input& input);

/// Makes points one that are at most `radius` apart, in the file's units; on a sphere along the chord. The first point
/// of each place stays. Triangles with two corners at exactly one place are dropped, with a warning. Failure if another
/// triangle or a tetrahedron loses a corner. Returns the number of points that are gone.
std::size_t merge_points(io::MeshFile& file, double radius);

}  // namespace temper::app
