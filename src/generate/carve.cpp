// Removes the triangles outside the segments. Inside and outside alternate, counted from the outside in.
//
// Level 0 can be reached from outside the convex hull without crossing a segment, level 1 from level 0 across one
// segment, and so on. Odd levels are inside. A segment that encloses nothing, or divides the inside in two, has the
// same level on both sides and stays as a constrained edge.
#include <algorithm>

#include "generate/triangulation.hpp"
#include "mesh/mesh_editor.hpp"

namespace temper::generate {
namespace {

constexpr std::uint32_t kUnknown = 0xffffffffu;

/// The level of each triangle, by flooding one level after the other.
IdVector<TriangleId, std::uint32_t> levels(const Mesh& mesh) {
  IdVector<TriangleId, std::uint32_t> level(mesh.n_triangles(), kUnknown);
  std::vector<TriangleId> here, beyond;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) (mesh.is_constrained(h) ? beyond : here).push_back(Mesh::triangle(h));
  }
  for (std::uint32_t depth = 0; !here.empty() || !beyond.empty(); ++depth) {
    while (!here.empty()) {
      const TriangleId t = here.back();
      here.pop_back();
      if (level[t] != kUnknown) continue;
      level[t] = depth;
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(t, k);
        if (!mesh.is_boundary(h)) (mesh.is_constrained(h) ? beyond : here).push_back(Mesh::triangle(mesh.twin(h)));
      }
    }
    std::swap(here, beyond);
  }
  return level;
}

/// A vertex where the domain touches itself has two boundary halfedges or more.
std::optional<VertexId> bow_tie(const Mesh& mesh) {
  IdVector<VertexId, std::uint8_t> on_boundary(mesh.n_vertices(), 0);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h)) || !mesh.is_boundary(h)) continue;
    if (++on_boundary[mesh.origin(h)] == 2) return mesh.origin(h);
  }
  return std::nullopt;
}

std::optional<VertexId> unused(const Mesh& mesh) {
  IdVector<VertexId, std::uint8_t> used(mesh.n_vertices(), 0);
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    for (const VertexId v : mesh.corners(t)) used[v] = 1;
  }
  for (const VertexId v : mesh.vertices()) {
    if (used[v] == 0) return v;
  }
  return std::nullopt;
}

}  // namespace

std::optional<InputError> carve(Triangulation& triangulation) {
  Mesh& mesh = triangulation.mesh;
  const auto level = levels(mesh);
  if (std::none_of(level.begin(), level.end(), [](std::uint32_t depth) { return depth % 2 == 1; })) {
    return InputError{ErrorCode::empty_input, "", "the segments enclose nothing"};
  }
  for (const TriangleId t : mesh.triangles()) {
    if (level[t] % 2 == 0) MeshEditor(mesh).erase(t);
  }
  if (const auto v = unused(mesh)) {
    return InputError{ErrorCode::unused_point, "", triangulation.name(*v) + " lies outside the segments"};
  }
  if (const auto v = bow_tie(mesh)) {
    return InputError{ErrorCode::non_manifold_vertex, "", "the domain touches itself at " + triangulation.name(*v)};
  }
  return std::nullopt;
}

}  // namespace temper::generate
