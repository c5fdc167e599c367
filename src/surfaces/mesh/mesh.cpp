// The invariants of a surface mesh.
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

std::string text(const char* kind, std::size_t index) { return std::string(kind) + " " + std::to_string(index); }

std::optional<std::string> wrong_halfedge(const Mesh& mesh, HalfedgeId h) {
  if (mesh.origin(h).index >= mesh.n_vertices()) return text("halfedge", h.index) + " starts at no vertex";
  const HalfedgeId other = mesh.twin(h);
  if (!other.valid()) return std::nullopt;
  if (other.index >= mesh.n_halfedges() || mesh.twin(other) != h)
    return text("halfedge", h.index) + " is not the twin of its twin";
  if (mesh.origin(other) != mesh.target(h) || mesh.target(other) != mesh.origin(h))
    return text("halfedge", h.index) + " and its twin join different vertices";
  if (mesh.is_constrained(h) != mesh.is_constrained(other))
    return text("halfedge", h.index) + " is constrained on one side only";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> SurfaceMesh::validate() const {
  if (z_.size() != mesh_.n_vertices()) return "arrays have different lengths";
  std::vector<std::size_t> missing(mesh_.n_vertices(), 0);
  for (const HalfedgeId h : mesh_.halfedges()) {
    if (auto wrong = wrong_halfedge(mesh_, h)) return wrong;
    ++missing[mesh_.origin(h).index];
  }
  for (const VertexId v : mesh_.vertices()) {
    const std::size_t expected = missing[v.index];
    if (mesh_.is_isolated(v)) return text("vertex", v.index) + " has no halfedge";
    std::size_t size = 0;
    for (const HalfedgeId h : mesh_.star(v)) {
      if (mesh_.origin(h) != v) return text("vertex", v.index) + " has a foreign halfedge in its star";
      if (++size > expected) return text("vertex", v.index) + " has an endless star";
    }
    if (size != expected) return text("vertex", v.index) + " does not reach all its triangles";
  }
  for (const TriangleId t : mesh_.triangles()) {
    const auto [a, b, c] = mesh_.corners(t);
    if (is_flat(position(a), position(b), position(c))) return text("triangle", t.index) + " is flat";
  }
  return std::nullopt;
}

}  // namespace temper::surfaces
