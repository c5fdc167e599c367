// validate(): the invariants of the arrays, and a sentence for the first one that does not hold.
#include <optional>
#include <string>

#include "mesh/predicates.hpp"
#include "mesh/shared_steps.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

std::string text(const char* kind, std::size_t index) { return std::string(kind) + " " + std::to_string(index); }

std::optional<std::string> wrong_halfedge(const Mesh& mesh, HalfedgeId h) {
  const VertexId a = mesh.origin(h);
  if (!a.valid() || a.index >= mesh.n_vertices()) return text("halfedge", h.index) + " starts at no vertex";
  const HalfedgeId other = mesh.twin(h);
  if (!other.valid()) return std::nullopt;
  if (other.index >= mesh.n_halfedges()) return text("halfedge", h.index) + " has a twin out of range";
  if (mesh.twin(other) != h) return text("halfedge", h.index) + " is not the twin of its twin";
  if (mesh.origin(other) != mesh.target(h) || mesh.target(other) != a) {
    return text("halfedge", h.index) + " and its twin join different vertices";
  }
  if (mesh.is_constrained(h) != mesh.is_constrained(other)) {
    return text("halfedge", h.index) + " is constrained on one side only";
  }
  return std::nullopt;
}

std::optional<std::string> wrong_star(const Mesh& mesh, VertexId v, std::size_t incident) {
  const HalfedgeId first = mesh.outgoing(v);
  if (!first.valid() || first.index >= mesh.n_halfedges()) return text("vertex", v.index) + " has no halfedge";
  std::size_t size = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.origin(h) != v) return text("vertex", v.index) + " has a foreign halfedge in its star";
    if (++size > incident) return text("vertex", v.index) + " has an endless star";
  }
  // A walk that starts past the boundary halfedge, or a bow tie, visits fewer triangles than there are.
  if (size != incident) return text("vertex", v.index) + " does not reach all its triangles";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> broken_connectivity(const Mesh& mesh) {
  IdVector<VertexId, std::uint32_t> incident(mesh.n_vertices(), 0);
  bool any_erased = false;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h))) {
      any_erased = true;
      continue;
    }
    if (auto wrong = wrong_halfedge(mesh, h)) return wrong;
    ++incident[mesh.origin(h)];
  }
  for (const VertexId v : mesh.vertices()) {
    const auto [x, y, w] = mesh.point(v);
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(w)) return text("vertex", v.index) + " is not finite";
    if (any_erased && incident[v] == 0 && mesh.is_isolated(v)) continue;
    if (auto wrong = wrong_star(mesh, v, incident[v])) return wrong;
  }
  return std::nullopt;
}

std::optional<std::string> Mesh::validate() const {
  if (corners_.size() % 3 != 0 || twins_.size() != corners_.size() || !constrained_.has_size(n_halfedges()) ||
      !regions_.has_size(n_triangles())) {
    return "arrays have different lengths";
  }
  if (auto broken = broken_connectivity(*this)) return broken;
  for (const TriangleId t : triangles()) {
    if (is_erased(t)) continue;
    const auto [a, b, c] = corners(t);
    if (inlined::orientation(*this, a, b, c) != Sign::positive) {
      return text("triangle", t.index) + " is not counter-clockwise";
    }
  }
  return std::nullopt;
}

}  // namespace temper
