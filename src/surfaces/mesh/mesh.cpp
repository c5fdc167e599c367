// The invariants of a surface mesh.
#include "mesh/shared_steps.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

std::optional<std::string> SurfaceMesh::validate() const {
  if (z_.size() != mesh_.n_vertices()) return "arrays have different lengths";
  if (auto broken = broken_connectivity(mesh_)) return broken;
  for (const TriangleId t : mesh_.triangles()) {
    const auto [a, b, c] = points(t);
    if (is_flat(a.position(), b.position(), c.position())) return "triangle " + std::to_string(t.index) + " is flat";
  }
  return std::nullopt;
}

}  // namespace temper::surfaces
