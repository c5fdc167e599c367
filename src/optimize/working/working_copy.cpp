#include "optimize/working/working_copy.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace temper {
namespace {

/// Renumbers the ids that are left of an order 0, 1, 2, …, in the order of their numbers.
template <class IdType>
IdVector<IdType, IdType> ranks(const IdVector<IdType, IdType>& order) {
  std::vector<IdType> sorted(order.begin(), order.end());
  std::sort(sorted.begin(), sorted.end());
  IdVector<IdType, IdType> result;
  result.reserve(order.size());
  for (const IdType i : order) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), i);
    result.push_back(IdType(static_cast<std::size_t>(at - sorted.begin())));
  }
  return result;
}

}  // namespace

WorkingCopy::WorkingCopy(const Mesh& user, SweepOrder sweeps, Executor* executor) : units(WorkingUnits::of(user)) {
  if (sweeps == SweepOrder::hilbert) {
    OrderedMesh ordered = hilbert_ordered(user, executor);
    *this = WorkingCopy(std::move(ordered.mesh), SharedOrder(std::move(ordered.order)));
  } else {
    mesh = user;
    name_new();
    n_input_vertices = n_vertices_named;
    units.enter(mesh);
  }
}

WorkingCopy::WorkingCopy(Mesh ordered, SharedOrder of)
    : mesh(std::move(ordered)),
      units(WorkingUnits::of(mesh)),
      order(std::move(of)),
      n_input_vertices(mesh.n_vertices()),
      n_vertices_named(mesh.n_vertices()),
      n_triangles_named(mesh.n_triangles()) {
  units.enter(mesh);
}

WorkingCopy WorkingCopy::part(const Mesh& part, DividedEdges divided) {
  WorkingCopy work;
  work.mesh = part;
  work.divided = std::move(divided);
  work.name_new();
  work.n_input_vertices = work.n_vertices_named;
  return work;
}

VertexId WorkingCopy::from_user(VertexId v) const {
  const auto found = std::find(order->vertices.begin(), order->vertices.end(), v);
  if (found == order->vertices.end()) return {};
  return VertexId(static_cast<std::size_t>(found - order->vertices.begin()));
}

void WorkingCopy::name_new() {
  if (order->vertices.size() == mesh.n_vertices() && order->triangles.size() == mesh.n_triangles()) return;
  auto& [vertices, triangles] = order.own();
  while (vertices.size() < mesh.n_vertices()) vertices.push_back(VertexId(n_vertices_named++));
  while (triangles.size() < mesh.n_triangles()) triangles.push_back(TriangleId(n_triangles_named++));
}

const DividedEdge* WorkingCopy::divided_edge(VertexId v) const {
  if (divided.empty()) return nullptr;
  const auto found = divided.find(order->vertices[v]);
  return found == divided.end() ? nullptr : &found->second;
}

DividedEdge WorkingCopy::divided_by(HalfedgeId h) const {
  const VertexId a = mesh.origin(h), b = mesh.target(h);
  for (const VertexId v : {a, b}) {
    if (const DividedEdge* edge = divided_edge(v)) return *edge;
  }
  const Vec2 p = mesh.position(a), q = mesh.position(b);  // both halfedges give the same bits
  return std::pair(p.x, p.y) < std::pair(q.x, q.y) ? DividedEdge{p, q} : DividedEdge{q, p};
}

Compaction WorkingCopy::compact() {
  Compaction kept = mesh.compact();
  order = SharedOrder({kept_of(order->vertices, kept.vertices), kept_of(order->triangles, kept.triangles)});
  has_gaps = true;
  return kept;
}

Mesh WorkingCopy::in_user_terms(Executor* executor) const& {
  WorkingCopy copy = *this;
  return std::move(copy).in_user_terms(executor);
}

Mesh WorkingCopy::in_user_terms(Executor* executor) && {
  leave_frame();
  take_user_order(executor);
  return std::move(mesh);
}

void WorkingCopy::leave_frame() {
  units.leave(mesh);
  units = {};
  units.space = mesh.space();
}

void WorkingCopy::take_user_order(Executor* executor) {
  if (order->vertices.empty()) return;
  if (has_gaps) {
    restore_order(mesh, {ranks(order->vertices), ranks(order->triangles)}, executor);
  } else {
    restore_order(mesh, *order, executor);
  }
  order = {};
}

IdVector<VertexId, VertexId> WorkingCopy::user_vertices() const {
  IdVector<VertexId, VertexId> numbers = order->vertices;
  for (VertexId& v : numbers) {
    if (v.index >= n_input_vertices) v = VertexId();
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace temper
