#include "temper/tets/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace temper::tets {

std::size_t TetMesh::n_faces() const {
  const auto boundary = static_cast<std::size_t>(std::count(twins_.begin(), twins_.end(), HalffaceId()));
  return (n_halffaces() + boundary) / 2;
}

namespace {

std::string numbered(const char* kind, std::size_t index) { return std::string(kind) + " " + std::to_string(index); }

/// Says whether g has the vertices of h in the other direction.
bool is_opposite_side(const TetMesh& mesh, HalffaceId g, HalffaceId h) {
  const auto a = mesh.vertices(g), b = mesh.vertices(h);
  const auto first = std::find(b.begin(), b.end(), a[0]);
  if (first == b.end()) return false;
  const auto i = static_cast<std::size_t>(first - b.begin());
  return a[1] == b[(i + 2) % 3] && a[2] == b[(i + 1) % 3];
}

std::optional<std::string> wrong_tetrahedron(const TetMesh& mesh, TetId t) {
  for (const VertexId v : mesh.corners(t)) {
    if (!v.valid() || v.index >= mesh.n_vertices())
      return numbered("tetrahedron", t.index) + " has no vertex at a corner";
  }
  const auto [a, b, c, d] = mesh.corners(t);
  if (orientation(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(d)) != Sign::positive)
    return numbered("tetrahedron", t.index) + " is not positive";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> TetMesh::validate() const {
  if (incident_.size() != n_vertices() || twins_.size() != 4 * n_tetrahedra() || !regions_.has_size(n_tetrahedra()))
    return "arrays have different lengths";
  for (const VertexId v : vertices()) {
    const WeightedPoint p = point(v);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !std::isfinite(p.w))
      return numbered("vertex", v.index) + " is not finite";
  }
  for (const TetId t : tetrahedra()) {
    if (auto wrong = wrong_tetrahedron(*this, t)) return wrong;
  }
  for (const HalffaceId h : halffaces()) {
    const HalffaceId other = twin(h);
    if (!other.valid()) continue;
    if (other.index >= n_halffaces()) return numbered("halfface", h.index) + " has a twin out of range";
    if (twin(other) != h) return numbered("halfface", h.index) + " is not the twin of its twin";
    if (!is_opposite_side(*this, h, other)) return numbered("halfface", h.index) + " and its twin are no one face";
  }
  for (const VertexId v : vertices()) {
    const TetId t = incident(v);
    if (!t.valid() || t.index >= n_tetrahedra() || std::count(corners_[t].begin(), corners_[t].end(), v) != 1)
      return numbered("vertex", v.index) + " is no corner of its tetrahedron";
  }
  return std::nullopt;
}

IdVector<VertexId, std::uint8_t> boundary_vertices(const TetMesh& mesh) {
  IdVector<VertexId, std::uint8_t> marks(mesh.n_vertices());
  for (const HalffaceId h : mesh.halffaces()) {
    if (!mesh.is_boundary(h)) continue;
    for (const VertexId v : mesh.vertices(h)) marks[v] = 1;
  }
  return marks;
}

}  // namespace temper::tets
