// Hilbert order: neighbours in the plane, or on the sphere, become neighbours in memory.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/blocks.hpp"
#include "mesh/curve.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

/// Triangles by their least corner in the new numbering; equal ones by number (counting sort).
IdVector<TriangleId, TriangleId> triangles_by_vertex(const Mesh& mesh, const IdVector<VertexId, VertexId>& new_vertex,
                                                     Executor* executor) {
  IdVector<TriangleId, std::uint32_t> least(mesh.n_triangles());
  for_each_index(mesh.n_triangles(), executor, [&](std::size_t i) {
    const auto [a, b, c] = mesh.corners(TriangleId(i));
    least[TriangleId(i)] = std::min({new_vertex[a], new_vertex[b], new_vertex[c]}).index;
  });
  std::vector<std::uint32_t> start(mesh.n_vertices() + 1, 0);
  for (const std::uint32_t v : least) ++start[v + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  IdVector<TriangleId, TriangleId> order(mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) order[TriangleId(start[least[t]]++)] = t;
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

/// A halfedge by the new number of its triangle; none stays none.
HalfedgeId renumbered(HalfedgeId h, const IdVector<TriangleId, TriangleId>& new_triangle) {
  return h.valid() ? Mesh::halfedge(new_triangle[Mesh::triangle(h)], static_cast<int>(h.index % 3)) : h;
}

/// The order along the curve, and the new number of every vertex, which finding it takes.
struct Found {
  MeshOrder order;
  IdVector<VertexId, VertexId> new_vertex;
};
Found find_order(const Mesh& mesh, Executor* executor) {
  Found found;
  found.order.vertices = vertices_by_hilbert(mesh, executor);
  found.new_vertex = inverse(found.order.vertices);
  found.order.triangles = triangles_by_vertex(mesh, found.new_vertex, executor);
  return found;
}

}  // namespace

/// Sees the arrays of meshes.
class MeshPermuter {
 public:
  static void move_vertices(Mesh& mesh, const IdVector<VertexId, VertexId>& order) {
    gather(
        order, [&](VertexId v) { return mesh.vertices_[v]; },
        [&](VertexId v, const Mesh::VertexRecord& record) { mesh.vertices_[v] = record; });
  }
  static void move_triangles(Mesh& mesh, const IdVector<TriangleId, TriangleId>& order,
                             const IdVector<VertexId, VertexId>& new_vertex,
                             const IdVector<TriangleId, TriangleId>& new_triangle);
  static Mesh copy(const Mesh& mesh, Found& found, Executor* executor);
  /// Renews outgoing(): the halfedge that stands for a vertex depends on the numbering.
  static void finish(Mesh& mesh) { mesh.repair_outgoing(); }
};

void MeshPermuter::move_triangles(Mesh& mesh, const IdVector<TriangleId, TriangleId>& order,
                                  const IdVector<VertexId, VertexId>& new_vertex,
                                  const IdVector<TriangleId, TriangleId>& new_triangle) {
  struct Triangle {
    std::array<VertexId, 3> corners;
    std::array<HalfedgeId, 3> twins;
    std::array<std::uint8_t, 3> constrained;
    std::int32_t region;
  };
  const std::size_t n = mesh.n_halfedges();
  gather(
      order,
      [&](TriangleId t) {
        const HalfedgeId a = Mesh::halfedge(t, 0), b = Mesh::halfedge(t, 1), c = Mesh::halfedge(t, 2);
        return Triangle{mesh.corners(t),
                        {mesh.twin(a), mesh.twin(b), mesh.twin(c)},
                        {mesh.constrained_[a], mesh.constrained_[b], mesh.constrained_[c]},
                        mesh.region(t)};
      },
      [&](TriangleId t, const Triangle& triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
          const HalfedgeId h = Mesh::halfedge(t, static_cast<int>(k));
          mesh.corners_[h] = new_vertex[triangle.corners[k]];
          mesh.constrained_.set(h, triangle.constrained[k], n);
          mesh.twins_[h] = renumbered(triangle.twins[k], new_triangle);
        }
        mesh.set_region(t, triangle.region);
      });
}

/// One array after the other, and each renumbering gone before the next one is made: what is there at once counts on
/// the largest meshes.
Mesh MeshPermuter::copy(const Mesh& mesh, Found& found, Executor* executor) {
  Mesh result;
  result.space_ = mesh.space();
  const MeshOrder& order = found.order;
  result.vertices_.resize(mesh.n_vertices());
  for_each_index(mesh.n_vertices(), executor,
                 [&](std::size_t i) { result.vertices_[VertexId(i)] = mesh.vertices_[order.vertices[VertexId(i)]]; });
  result.corners_.resize(mesh.n_halfedges());
  for_each_index(mesh.n_triangles(), executor, [&](std::size_t i) {
    const auto corners = mesh.corners(order.triangles[TriangleId(i)]);
    for (std::size_t k = 0; k < 3; ++k) result.corners_[HalfedgeId(3 * i + k)] = found.new_vertex[corners[k]];
  });
  found.new_vertex = {};
  const auto new_triangle = inverse(order.triangles);
  result.twins_.resize(mesh.n_halfedges());
  for_each_index(mesh.n_triangles(), executor, [&](std::size_t i) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(order.triangles[TriangleId(i)], k);
      result.twins_[Mesh::halfedge(TriangleId(i), k)] = renumbered(mesh.twin(h), new_triangle);
    }
  });
  if (!mesh.constrained_.all_zero()) {
    for (const HalfedgeId h : result.halfedges()) {
      const HalfedgeId from = Mesh::halfedge(order.triangles[Mesh::triangle(h)], static_cast<int>(h.index % 3));
      result.constrained_.set(h, mesh.constrained_[from], mesh.n_halfedges());
    }
  }
  if (!mesh.regions_.all_zero()) {
    for (const TriangleId t : result.triangles()) result.set_region(t, mesh.region(order.triangles[t]));
  }
  finish(result);
  return result;
}

MeshOrder hilbert_order(Mesh& mesh) {
  Found found = find_order(mesh, nullptr);
  MeshPermuter::move_vertices(mesh, found.order.vertices);
  MeshPermuter::move_triangles(mesh, found.order.triangles, found.new_vertex, inverse(found.order.triangles));
  MeshPermuter::finish(mesh);
  return std::move(found.order);
}

OrderedMesh hilbert_ordered(const Mesh& mesh, Executor* executor) {
  Found found = find_order(mesh, executor);
  Mesh ordered = MeshPermuter::copy(mesh, found, executor);
  return {std::move(ordered), std::move(found.order)};
}

void restore_order(Mesh& mesh, const MeshOrder& order) {
  MeshPermuter::move_vertices(mesh, inverse(order.vertices));
  MeshPermuter::move_triangles(mesh, inverse(order.triangles), order.vertices, order.triangles);
  MeshPermuter::finish(mesh);
}

}  // namespace temper
