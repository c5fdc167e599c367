// The mesh's arrays: sizes, flags, compacting. Everything geometric is elsewhere.
#include "temper/mesh.hpp"

namespace temper {

void Mesh::set_fixed(VertexId v, bool fixed) {
  record(v).flags = fixed ? (record(v).flags | kFixed) : (record(v).flags & ~kFixed);
}

void Mesh::set_frozen(VertexId v, bool frozen) {
  record(v).flags = frozen ? (record(v).flags | kFrozen) : (record(v).flags & ~kFrozen);
}

std::size_t Mesh::n_edges() const {
  std::size_t count = 0;
  for (const HalfedgeId h : halfedges()) count += !is_erased(triangle(h)) && is_edge_representative(h) ? 1 : 0;
  return count;
}

/// Walks around both ends at once, as one of them may have as many triangles as the mesh. a and b may be any numbers.
HalfedgeId Mesh::find_halfedge(VertexId a, VertexId b) const {
  if (a.index >= n_vertices() || b.index >= n_vertices()) return {};
  const Star around_a = star(a), around_b = star(b);
  auto out = around_a.begin(), back = around_b.begin();
  for (; out != around_a.end() && back != around_b.end(); ++out, ++back) {
    if (target(*out) == b) return *out;
    if (opposite(*back) == a) return prev(*back);
  }
  return {};
}

std::size_t Mesh::memory_bytes() const {
  return vertices_.size() * sizeof(VertexRecord) + corners_.size() * sizeof(VertexId) +
         twins_.size() * sizeof(HalfedgeId) + constrained_.memory_bytes() + regions_.memory_bytes();
}

Compaction Mesh::compact() {
  Compaction kept;
  IdVector<VertexId, VertexId> new_vertex(n_vertices());
  IdVector<TriangleId, TriangleId> new_triangle(n_triangles());
  IdVector<VertexId, std::uint8_t> used(n_vertices(), 0);
  for (const TriangleId t : triangles()) {
    if (is_erased(t)) continue;
    new_triangle[t] = TriangleId(kept.triangles.size());
    kept.triangles.push_back(t);
    for (const VertexId v : corners(t)) used[v] = 1;
  }
  for (const VertexId v : vertices()) {
    if (used[v] == 0) continue;
    new_vertex[v] = VertexId(kept.vertices.size());
    kept.vertices.push_back(v);
    vertices_[new_vertex[v]] = vertices_[v];  // new ids never overtake old ones
  }
  for (const TriangleId to : IdRange<TriangleId>(kept.triangles.size())) {
    const TriangleId from = kept.triangles[to];
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(from, k);
      const HalfedgeId other = twin(h);
      corners_[halfedge(to, k)] = new_vertex[corners_[h]];
      constrained_.set(halfedge(to, k), constrained_[h], n_halfedges());
      // Twins of triangles that have not moved yet keep their old numbers: all go through new_triangle.
      twins_[halfedge(to, k)] =
          other.valid() ? halfedge(new_triangle[triangle(other)], static_cast<int>(other.index % 3)) : HalfedgeId();
    }
    set_region(to, region(from));
  }
  const std::size_t n_kept = kept.triangles.size();
  vertices_.resize(kept.vertices.size());
  corners_.resize(3 * n_kept);
  twins_.resize(3 * n_kept);
  constrained_.truncate(3 * n_kept);
  regions_.truncate(n_kept);
  repair_outgoing();
  return kept;
}

void Mesh::repair_outgoing() {
  for (const HalfedgeId h : halfedges()) record(origin(h)).outgoing = h.index;
  for (const HalfedgeId h : halfedges()) {
    if (!twin(h).valid()) record(origin(h)).outgoing = h.index;
  }
}

std::optional<InputError> expect_plane(const Mesh& mesh, std::string_view what) {
  if (mesh.space().is_periodic()) return expect_no_period(mesh, what);
  if (mesh.space().kind() == SpaceKind::plane) return std::nullopt;
  return InputError{
      ErrorCode::unsupported, {}, "the mesh is on a sphere, but " + std::string(what) + " needs a mesh of the plane"};
}

std::optional<InputError> expect_no_period(const Mesh& mesh, std::string_view what) {
  if (!mesh.space().is_periodic()) return std::nullopt;
  return InputError{ErrorCode::unsupported,
                    {},
                    "the mesh is in a periodic plane, but " + std::string(what) + " needs a mesh without periods"};
}

}  // namespace temper
