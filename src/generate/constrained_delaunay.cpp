// The constrained Delaunay triangulation: points, segments, carving and numbering, one stage per file.
#include <utility>

#include "generate/triangulation.hpp"
#include "temper/generate.hpp"

namespace temper {

namespace generate {

Expected<Mesh> in_input_order(Triangulation triangulation, const std::function<bool()>& stop) {
  Mesh mesh = std::move(triangulation.mesh);
  // Boundary edges need no constraint to stay.
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_erased(Mesh::triangle(h)) && mesh.is_boundary(h)) mesh.set_constrained(h, false);
  }
  if (stop && stop()) return stopped_error();
  mesh.compact();
  if (stop && stop()) return stopped_error();
  MeshOrder order;
  order.vertices.reserve(mesh.n_vertices());
  for (const std::uint32_t number : triangulation.number) order.vertices.push_back(VertexId(number));
  order.triangles.reserve(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) order.triangles.push_back(t);
  if (stop && stop()) return stopped_error();
  restore_order(mesh, order);
  return mesh;
}

}  // namespace generate

Expected<Mesh> constrained_delaunay(const DelaunayInput& input) {
  Expected<generate::Triangulation> triangulation = generate::triangulate_points(input.points, input.stop);
  if (!triangulation) return triangulation.error();
  if (auto error = generate::insert_segments(*triangulation, input.segments, input.stop)) return *error;
  if (input.carve && !input.segments.empty()) {
    if (auto error = generate::carve(*triangulation)) return *error;
  }
  return generate::in_input_order(*std::move(triangulation), input.stop);
}

}  // namespace temper
