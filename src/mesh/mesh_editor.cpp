#include "mesh/mesh_editor.hpp"

namespace temper {

Mesh MeshEditor::blank(const Space& space, std::size_t n_vertices, std::size_t n_triangles) {
  Mesh mesh;
  mesh.space_ = space;
  mesh.vertices_.resize(n_vertices);
  mesh.corners_.resize(3 * n_triangles);
  mesh.twins_.resize(3 * n_triangles);
  return mesh;
}

VertexId MeshEditor::add_vertex(WeightedPoint p) {
  mesh_.vertices_.push_back({p.x, p.y, p.w, HalfedgeId::kInvalid, 0});
  return VertexId(mesh_.n_vertices() - 1);
}

TriangleId MeshEditor::add_triangle(std::array<VertexId, 3> corners, std::int32_t region) {
  const TriangleId t(mesh_.n_triangles());
  for (const VertexId v : corners) {
    mesh_.constrained_.push_back(0, mesh_.n_halfedges());
    mesh_.corners_.push_back(v);
    mesh_.twins_.push_back(HalfedgeId());
  }
  mesh_.regions_.push_back(region, t.index);
  return t;
}

void MeshEditor::erase(TriangleId t) {
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (mesh_.twin(h).valid()) mesh_.twins_[mesh_.twin(h)] = HalfedgeId();
    mesh_.twins_[h] = HalfedgeId();
    mesh_.corners_[h] = VertexId();
    mesh_.constrained_.set(h, 0, mesh_.n_halfedges());
  }
  mesh_.set_region(t, 0);
}

}  // namespace temper
