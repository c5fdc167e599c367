// Hilbert order: neighbours in the plane become neighbours in memory.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/hilbert.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
  friend bool operator<(const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; }
};

/// The vertices, sorted along the curve; equal cells by number.
IdVector<VertexId, VertexId> vertices_by_hilbert(const Mesh& mesh) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Vec2 low{kInf, kInf}, high{-kInf, -kInf};
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const HilbertGrid curve(low, high);
  std::vector<Keyed> keyed;
  keyed.reserve(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) keyed.push_back({curve(mesh.position(v)), v.index});
  std::sort(keyed.begin(), keyed.end());
  IdVector<VertexId, VertexId> order;
  order.reserve(keyed.size());
  for (const Keyed& k : keyed) order.push_back(VertexId(k.index));
  return order;
}

/// Triangles by their least corner in the new numbering; equal ones by number (counting sort).
IdVector<TriangleId, TriangleId> triangles_by_vertex(const Mesh& mesh, const IdVector<VertexId, VertexId>& new_vertex) {
  const auto least = [&](TriangleId t) {
    const auto [a, b, c] = mesh.corners(t);
    return std::min({new_vertex[a], new_vertex[b], new_vertex[c]});
  };
  std::vector<std::uint32_t> start(mesh.n_vertices() + 1, 0);
  for (const TriangleId t : mesh.triangles()) ++start[least(t).index + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  IdVector<TriangleId, TriangleId> order(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) order[TriangleId(start[least(t).index]++)] = t;
  return order;
}

template <class IdType>
IdVector<IdType, IdType> inverse(const IdVector<IdType, IdType>& order) {
  IdVector<IdType, IdType> result(order.size());
  for (const IdType i : IdRange<IdType>(order.size())) result[order[i]] = i;
  return result;
}

/// Moves value[order[i]] to place i.
template <class IdType, class T>
void gather(IdVector<IdType, T>& values, const IdVector<IdType, IdType>& order) {
  IdVector<IdType, T> moved;
  moved.reserve(values.size());
  for (const IdType from : order) moved.push_back(values[from]);
  values = std::move(moved);
}

}  // namespace

void permute(Mesh& mesh, const MeshOrder& order) {
  const auto new_vertex = inverse(order.vertices);
  const auto new_triangle = inverse(order.triangles);
  const auto moved = [&](HalfedgeId h) {
    return h.valid() ? Mesh::halfedge(new_triangle[Mesh::triangle(h)], static_cast<int>(h.index % 3)) : h;
  };
  gather(mesh.vertices_, order.vertices);
  gather(mesh.regions_, order.triangles);
  // Triples of halfedge data move with their triangle; one array at a time keeps the peak of memory low.
  const IdRange<TriangleId> new_slots(order.triangles.size());
  const auto gather_triples = [&](auto& values, auto&& map) {
    auto moved_values = values;
    for (const TriangleId to : new_slots) {
      for (int k = 0; k < 3; ++k) {
        moved_values[Mesh::halfedge(to, k)] = map(values[Mesh::halfedge(order.triangles[to], k)]);
      }
    }
    values = std::move(moved_values);
  };
  gather_triples(mesh.corners_, [&](VertexId v) { return new_vertex[v]; });
  gather_triples(mesh.twins_, moved);
  gather_triples(mesh.constrained_, [](std::uint8_t c) { return c; });
  mesh.repair_outgoing();  // which halfedge stands for a vertex depends on the numbering
}

MeshOrder hilbert_order(Mesh& mesh) {
  MeshOrder order;
  order.vertices = vertices_by_hilbert(mesh);
  order.triangles = triangles_by_vertex(mesh, inverse(order.vertices));
  permute(mesh, order);
  return order;
}

void restore_order(Mesh& mesh, const MeshOrder& order) {
  permute(mesh, {inverse(order.vertices), inverse(order.triangles)});
}

}  // namespace temper
