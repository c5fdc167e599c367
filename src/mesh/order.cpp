// Hilbert order: neighbours in the plane become neighbours in memory.
#include <algorithm>
#include <array>
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

/// Moves what is at order[i] to place i for all i, along the cycles of the order: in place but for one bit an item.
template <class IdType, class Read, class Write>
void gather(const IdVector<IdType, IdType>& order, Read&& read, Write&& write) {
  std::vector<bool> done(order.size(), false);
  for (const IdType first : IdRange<IdType>(order.size())) {
    if (done[first.index]) continue;
    const auto held = read(first);
    IdType to = first;
    for (IdType from = order[to]; from != first; to = from, from = order[to]) {
      write(to, read(from));
      done[to.index] = true;
    }
    write(to, held);
    done[to.index] = true;
  }
}

MeshOrder inverse(const MeshOrder& order) { return {inverse(order.vertices), inverse(order.triangles)}; }

}  // namespace

void permute(Mesh& mesh, const MeshOrder& order, const MeshOrder& inverse) {
  struct Triangle {
    std::array<VertexId, 3> corners;
    std::array<HalfedgeId, 3> twins;
    std::array<std::uint8_t, 3> constrained;
    std::int32_t region;
  };
  gather(
      order.vertices, [&](VertexId v) { return mesh.vertices_[v]; },
      [&](VertexId v, const Mesh::VertexRecord& record) { mesh.vertices_[v] = record; });
  gather(
      order.triangles,
      [&](TriangleId t) {
        const HalfedgeId a = Mesh::halfedge(t, 0), b = Mesh::halfedge(t, 1), c = Mesh::halfedge(t, 2);
        return Triangle{mesh.corners(t),
                        {mesh.twin(a), mesh.twin(b), mesh.twin(c)},
                        {mesh.constrained_[a], mesh.constrained_[b], mesh.constrained_[c]},
                        mesh.region(t)};
      },
      [&](TriangleId t, const Triangle& triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
          const HalfedgeId h = Mesh::halfedge(t, static_cast<int>(k)), twin = triangle.twins[k];
          mesh.corners_[h] = inverse.vertices[triangle.corners[k]];
          mesh.constrained_[h] = triangle.constrained[k];
          mesh.twins_[h] =
              !twin.valid() ? twin
                            : Mesh::halfedge(inverse.triangles[Mesh::triangle(twin)], static_cast<int>(twin.index % 3));
        }
        mesh.regions_[t] = triangle.region;
      });
  mesh.repair_outgoing();  // which halfedge stands for a vertex depends on the numbering
}

MeshOrder hilbert_order(Mesh& mesh) {
  MeshOrder order, new_ids;
  order.vertices = vertices_by_hilbert(mesh);
  new_ids.vertices = inverse(order.vertices);
  order.triangles = triangles_by_vertex(mesh, new_ids.vertices);
  new_ids.triangles = inverse(order.triangles);
  permute(mesh, order, new_ids);
  return order;
}

void restore_order(Mesh& mesh, const MeshOrder& order) { permute(mesh, inverse(order), order); }

}  // namespace temper
