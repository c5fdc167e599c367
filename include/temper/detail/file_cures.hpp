// Cures of files whose points or triangles make no mesh: points that are nearly at one place, and flat triangles.
#pragma once

#include <array>
#include <cstddef>

#include "temper/io.hpp"

namespace temper::io {

/// Vertices of the boundary that are nearly at one place but not the same, as if the mesh had a crack.
struct Crack {
  std::size_t pairs = 0;          ///< Number of pairs of such vertices; 0: no crack
  std::array<VertexId, 2> first;  ///< One of them
  double widest = 0;              ///< Largest distance of a pair [length]
};
/// Finds pairs of boundary vertices that are nearer than 10⁻⁶ of the boundary edges at them. O(n log n).
[[nodiscard]] Crack find_crack(const Mesh& mesh);

/// Makes points one that are at most `radius` apart, in the units of the file; on a sphere along the chord. The first
/// point of each place stays. Triangles with two corners at exactly one place are dropped, with a warning. Returns the
/// number of points that are gone. Errors: another triangle or a tetrahedron loses a corner, a radius below 0. After an
/// error the file is of no use. O(n log n) if few points are near each other.
[[nodiscard]] Expected<std::size_t> merge_points(MeshFile& file, double radius);

/// Flips away the triangles in a plane that have no area or are turned over. The longest edge of such a triangle is
/// flipped, or the triangle is dropped if this edge is on the boundary. All points stay, and so does the domain, except
/// triangles that were turned over on its boundary. Lines along the edge are divided. A triangle that no flip can reach
/// stays. Returns the number of triangles that are cured. Errors: two corners at one place, a sphere, a periodic plane.
/// After an error the file is of no use. O(n log n).
[[nodiscard]] Expected<std::size_t> flip_flat_triangles(MeshFile& file);

}  // namespace temper::io
