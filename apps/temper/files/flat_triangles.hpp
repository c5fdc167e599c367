// Triangles of zero area or turned over, as coordinates with few digits make them, and their cure.
#pragma once

#include <cstddef>
#include <vector>

#include "temper/io.hpp"

namespace temper::app {

/// Removes the triangles that do not stay, with their regions and data. Numbers of the file no longer hold.
void keep_triangles(io::MeshFile& file, const std::vector<bool>& stays);

/// Flips away the triangles in a plane that have no area or are turned over. The longest edge of such a triangle is
/// flipped, or the triangle is dropped if this edge is on the boundary. All points stay, and so does the domain, except
/// triangles that were turned over on its boundary. Lines along the edge are divided. A triangle that no flip can reach
/// stays. Failure if two corners are at one place. Returns the number of triangles that are cured. O(n log n).
std::size_t flip_flat_triangles(io::MeshFile& file);

}  // namespace temper::app
