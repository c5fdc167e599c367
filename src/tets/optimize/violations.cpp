#include "tets/optimize/violations.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/sort_unique.hpp"

namespace temper::tets {
namespace {

/// The faces at the rim of a patch, and their edges.
class Rim {
 public:
  explicit Rim(const Draft& draft) : draft_(draft) {
    for (const auto& [a, b, c] : draft.rim) {
      for (const auto& [i, j] : {std::pair(a, b), {b, c}, {a, c}}) edges_.push_back({i, j});
    }
    sort_unique(edges_);
  }
  [[nodiscard]] bool has_edge(const std::array<VertexId, 2>& ends) const {
    return std::binary_search(edges_.begin(), edges_.end(), named(ends));
  }
  [[nodiscard]] bool has_face(HalffaceId h) const {
    return draft_.mesh.is_boundary(h) &&
           std::binary_search(draft_.rim.begin(), draft_.rim.end(), named(draft_.mesh.vertices(h)));
  }

 private:
  template <std::size_t n>
  [[nodiscard]] std::array<VertexId, n> named(std::array<VertexId, n> vertices) const {
    for (VertexId& v : vertices) v = draft_.names.vertices[v];
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  }

  const Draft& draft_;
  std::vector<std::array<VertexId, 2>> edges_;
};

void add_at_faces(const Draft& draft, Criterion criterion, const Rim& rim, Executor* executor,
                  std::vector<TetId>& cells) {
  for (const ViolatedFace& f : violated_faces(draft.mesh, executor)) {
    const bool is_inside = f.kind == DualKind::inside;
    const bool counts = criterion == Criterion::distances || (is_inside && f.dual_over_l < 0);  // is not regular
    if (!counts || rim.has_face(f.face)) continue;
    cells.push_back(TetMesh::tetrahedron(f.face));
    if (is_inside) cells.push_back(TetMesh::tetrahedron(draft.mesh.twin(f.face)));
  }
}

void add_around_edges(const Draft& draft, const Rim& rim, Executor* executor, std::vector<TetId>& cells) {
  std::vector<ViolatedEdge> edges = violated_edges(draft.mesh, executor);
  std::erase_if(edges, [&rim](const ViolatedEdge& e) { return rim.has_edge(e.vertices); });
  if (edges.empty()) return;
  const VertexStars stars(draft.mesh);
  for (const ViolatedEdge& e : edges) {
    stars.for_each_around(draft.mesh, e.vertices, [&](TetId t) {
      if (e.kind != DualKind::region || draft.mesh.region(t) == e.region) cells.push_back(t);
    });
  }
}

}  // namespace

std::vector<TetId> violating(const Draft& draft, Criterion criterion, Executor* executor) {
  if (criterion == Criterion::well_centered) return bad_tetrahedra(draft.mesh, executor);
  const Rim rim(draft);
  std::vector<TetId> cells;
  add_at_faces(draft, criterion, rim, executor, cells);
  if (criterion == Criterion::coefficients) add_around_edges(draft, rim, executor, cells);
  sort_unique(cells);
  return cells;
}

MeshState state_of(const Draft& draft, Criterion criterion, double gamma, Executor* executor) {
  MeshState state = state_of(draft.mesh, gamma, executor);
  if (criterion != Criterion::well_centered) state.bad = violating(draft, criterion, executor).size();
  return state;
}

}  // namespace temper::tets
