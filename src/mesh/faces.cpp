#include "temper/detail/faces.hpp"

#include <cmath>
#include <vector>

#include "geometry/surface.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

/// Says whether both triangles of an edge have one orthocenter; on the boundary, whether it is on the edge.
bool has_no_dual(const Mesh& mesh, HalfedgeId h) {
  constexpr double kNone = 1e-7;  // of the length: coordinates of maps have ten digits or more within an edge
  const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  const double least = kNone * distance(mesh.space(), a, b);
  if (mesh.is_boundary(h)) return mesh.space().is_plane() && std::abs(signed_height(a, b, c)) < least;
  const WeightedPoint d = mesh.point(mesh.opposite(mesh.twin(h)), a);
  return std::abs(dual_length(mesh.space(), a, b, c, d)) < least;
}

}  // namespace

bool keeps_faces(const Mesh& mesh) {
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_face(h)) return true;
  }
  return false;
}

void keep_faces(Mesh& mesh, std::span<const HalfedgeId> faces) {
  std::vector<TriangleId> stack;
  IdVector<TriangleId, std::uint8_t> known(mesh.n_triangles(), 0);
  const auto push = [&](HalfedgeId h) {
    const TriangleId t = Mesh::triangle(h);
    if (known[t] == 0) stack.push_back(t);
    known[t] = 1;
  };
  for (const HalfedgeId h : faces) mesh.set_face(h);
  for (const HalfedgeId h : faces) push(h), push(mesh.twin(h));
  while (!stack.empty()) {
    const TriangleId t = stack.back();
    stack.pop_back();
    for (const VertexId v : mesh.corners(t)) mesh.set_frozen(v);
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (mesh.is_face(h)) continue;
      if (has_no_dual(mesh, h)) {
        mesh.set_joint(h);
        if (!mesh.is_boundary(h)) push(mesh.twin(h));
      } else if (!mesh.is_boundary(h)) {
        mesh.set_constrained(h, true);
      }
    }
  }
}

}  // namespace temper
