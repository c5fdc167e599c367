// The star of a vertex: its tetrahedra, each as the face opposite the vertex, and the sum of their energies.
#pragma once

#include <span>
#include <vector>

#include "temper/tets/mesh.hpp"
#include "tets/energy/star_kernel.hpp"

namespace temper::tets {

/// The halffaces opposite v in the tetrahedra around v. The order follows from the mesh alone. O(degree²).
void collect_link(const TetMesh& mesh, VertexId v, std::vector<HalffaceId>& link);

/// A halfface as a face of the link of its opposite corner.
[[nodiscard]] LinkFace<double> link_face(const TetMesh& mesh, HalffaceId h);

/// The sum of the energies of the tetrahedra between p and the faces of a link, +∞ if one is not positive.
[[nodiscard]] double star_energy(std::span<const LinkFace<double>> link, const WeightedPoint& p, double gamma);
/// The energy of one tetrahedron.
[[nodiscard]] double energy_of(const TetMesh& mesh, TetId t, double gamma);

}  // namespace temper::tets
