// Pictures of meshes of tetrahedra: cuts by a plane, as SVG text.
#pragma once

#include <span>
#include <string>

#include "temper/draw.hpp"
#include "temper/tets/mesh.hpp"
#include "temper/tets/tensor.hpp"

namespace temper::tets {

/// A plane across an axis: x, y or z is constant.
struct Plane {
  int axis = 2;   ///< 0, 1, 2: x, y, z
  double at = 0;  ///< This coordinate
  friend bool operator==(const Plane&, const Plane&) = default;
};

/// The plane in the middle of the mesh, across its shortest side.
[[nodiscard]] Plane middle_plane(const TetMesh& mesh);
/// The plane in the middle of the mesh across an axis.
[[nodiscard]] Plane middle_plane(const TetMesh& mesh, int axis);
/// The plane across an axis at a coordinate. Error if it misses the mesh.
[[nodiscard]] Expected<Plane> plane_through(const TetMesh& mesh, int axis, double at);

/// Draws the cut of a mesh by a plane. Tetrahedra are colored by their margin, the least h/ℓ, and bad ones are hatched.
/// The axes of the picture are y and z, x and z, or x and y. A vertex on the plane counts as above it, so a plane along
/// faces shows the tetrahedra below. Only the options `primal`, `fill`, `zoom`, `width` and
/// `title` apply. `pieces`: none, or each mesh in the spaces of its tensors, whose margins are drawn. O(n).
[[nodiscard]] std::string draw_svg(const TetMesh& mesh, const Plane& plane, const DrawOptions& options = {},
                                   std::span<const MetricMesh> pieces = {});
/// Draws the cuts of two meshes next to each other.
[[nodiscard]] std::string draw_before_after_svg(const TetMesh& before, const TetMesh& after, const Plane& plane,
                                                const DrawOptions& options = {},
                                                std::span<const MetricMesh> pieces = {});

}  // namespace temper::tets
