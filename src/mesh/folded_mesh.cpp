#include "mesh/folded_mesh.hpp"

#include <cmath>

#include "mesh/mesh_editor.hpp"
#include "mesh/twins.hpp"

namespace temper {

FoldedMesh::FoldedMesh(const Mesh& mesh) : space_(mesh.space()), n_triangles_(mesh.n_triangles()) {
  places_.reserve(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const auto [x, y, third] = mesh.point(v);
    places_.push_back({x, y});
    const bool is_zero = third == 0 && !std::signbit(third);
    if (!is_zero && thirds_.empty()) thirds_.resize(mesh.n_vertices());
    if (!thirds_.empty()) thirds_[v.index] = third;
    if (mesh.is_frozen(v))
      frozen_.push_back(v);
    else if (mesh.is_fixed(v))
      fixed_.push_back(v);
  }
  constexpr std::size_t kBytesPerTriangle = 5;  // along a curve
  corners_.reserve(kBytesPerTriangle * n_triangles_);
  std::int64_t before = 0;
  for (const TriangleId t : mesh.triangles()) {
    for (const VertexId v : mesh.corners(t)) {
      const std::int64_t corner{v.index};
      put(corner - before);
      before = corner;
    }
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (mesh.joins_halves(h))
        diagonals_.push_back(h);
      else if (mesh.is_face(h))
        faces_.push_back(h);
      else if (mesh.is_joint(h))
        joints_.push_back(h);
      else if (mesh.is_constrained(h))
        constrained_.push_back(h);
    }
    if (mesh.region(t) != 0 && regions_.empty()) regions_.resize(n_triangles_);
    if (!regions_.empty()) regions_[t.index] = mesh.region(t);
  }
  corners_.shrink_to_fit();
}

Mesh FoldedMesh::unfold(Executor* executor) const {
  Mesh mesh = MeshEditor::blank(space_, places_.size(), n_triangles_);
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = places_[v.index];
    mesh.set_point(v, {p.x, p.y, thirds_.empty() ? 0 : thirds_[v.index]});
  }
  for (const VertexId v : fixed_) mesh.set_fixed(v, true);
  for (const VertexId v : frozen_) mesh.set_frozen(v);
  std::size_t at = 0;
  std::int64_t corner = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    corner += get(at);
    MeshEditor(mesh).set_corner(h, VertexId(static_cast<std::size_t>(corner)));
  }
  find_twins(mesh, executor);
  MeshEditor(mesh).repair_outgoing();
  for (const HalfedgeId h : constrained_) mesh.set_constrained(h, true);
  for (const HalfedgeId h : diagonals_) mesh.set_diagonal(h);
  for (const HalfedgeId h : faces_) mesh.set_face(h);
  for (const HalfedgeId h : joints_) mesh.set_joint(h);
  for (std::size_t t = 0; t < regions_.size(); ++t) mesh.set_region(TriangleId(t), regions_[t]);
  return mesh;
}

void FoldedMesh::put(std::int64_t value) {
  // Small negative numbers must have few bits, too: 0, −1, 1, −2, … become 0, 1, 2, 3, …
  auto bits = static_cast<std::uint64_t>(value < 0 ? -2 * value - 1 : 2 * value);
  for (; bits >= 0x80; bits >>= 7) corners_.push_back(static_cast<std::uint8_t>(bits | 0x80));
  corners_.push_back(static_cast<std::uint8_t>(bits));
}

std::int64_t FoldedMesh::get(std::size_t& at) const {
  std::uint64_t bits = 0;
  for (int shift = 0;; shift += 7) {
    const std::uint64_t byte = corners_[at++];
    bits |= (byte & 0x7f) << shift;
    if (byte < 0x80) break;
  }
  const auto half = static_cast<std::int64_t>(bits >> 1);
  return (bits & 1) != 0 ? -half - 1 : half;
}

}  // namespace temper
