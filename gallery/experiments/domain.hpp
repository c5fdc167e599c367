// The vertices of the dual, which are orthocenters of triangles, and the domain that should hold them.
#pragma once

#include <cstddef>

#include "temper/mesh.hpp"

namespace temper::gallery {

[[nodiscard]] Vec2 orthocenter_of(const Mesh& mesh, TriangleId t);

/// In some triangle or on its border, decided exactly.
[[nodiscard]] bool is_in_domain(const Mesh& mesh, Vec2 p);

/// From p to the nearest boundary edge; +∞ without one.
[[nodiscard]] double distance_to_boundary(const Mesh& mesh, Vec2 p);

/// The number of vertices that are not on the boundary.
[[nodiscard]] std::size_t count_interior(const Mesh& mesh);

[[nodiscard]] const Mesh& dense_horseshoe();

}  // namespace temper::gallery
