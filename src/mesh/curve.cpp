#include "mesh/curve.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/hilbert.hpp"
#include "mesh/blocks.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

constexpr std::size_t kLot = std::size_t{1} << 20;  // keys that are dealt out by one thread

/// The ids 0 … n − 1 by their keys of so many bits, and equal keys by number. Splits them into lots with common leading
/// digits, then sorts each lot: both on all threads.
template <class IdType, class Key, class KeyOf>
IdVector<IdType, IdType> sorted_by_key(std::size_t n, int bits, Executor* executor, KeyOf&& key_of) {
  constexpr int kFew = 8, kMostDigits = 12;  // of which lots have about 2⁸ keys, or more
  const std::size_t blocks = (n + kLot - 1) / kLot;
  const int digits = std::clamp(static_cast<int>(std::bit_width(n)) - kFew, 0, std::min(bits, kMostDigits));
  const std::size_t lots = std::size_t{1} << digits;
  const auto for_lots_of = [&, shift = bits - digits](auto&& visit) {  // each index of a block with its key and lot
    or_serial(executor).run(blocks, [&](std::size_t b) {
      for (std::size_t i = b * kLot; i < std::min(n, (b + 1) * kLot); ++i) {
        const Key key = key_of(i);
        visit(b, static_cast<std::size_t>(key >> shift), key, i);
      }
    });
  };
  std::vector<std::uint32_t> place(blocks * lots, 0);  // of the next one of this block in this lot
  for_lots_of([&](std::size_t b, std::size_t lot, Key, std::size_t) { ++place[b * lots + lot]; });
  std::vector<std::uint32_t> first(lots + 1, 0);
  std::uint32_t next = 0;
  for (std::size_t lot = 0; lot < lots; ++lot) {
    first[lot] = next;
    for (std::size_t b = 0; b < blocks; ++b) next += std::exchange(place[b * lots + lot], next);
  }
  first[lots] = next;
  struct Keyed {
    Key key;
    IdType id;
    bool operator<(const Keyed& other) const { return key != other.key ? key < other.key : id < other.id; }
  };
  std::vector<Keyed> sorted(n);
  for_lots_of([&](std::size_t b, std::size_t lot, Key key, std::size_t i) {
    sorted[place[b * lots + lot]++] = {key, IdType(i)};
  });
  IdVector<IdType, IdType> order(n);
  or_serial(executor).run(lots, [&](std::size_t lot) {
    std::sort(sorted.begin() + first[lot], sorted.begin() + first[lot + 1]);
    for (std::size_t i = first[lot]; i < first[lot + 1]; ++i) order[IdType(i)] = sorted[i].id;
  });
  return order;
}

}  // namespace

// Checks in a sample of the triangles how often corners are too far apart.
bool is_scattered(const Mesh& mesh) {
  constexpr std::size_t kNear = std::size_t{1}
                                << 15;  // vertices whose records and triangles a second-level cache holds
  constexpr std::size_t kSample = 1000;
  if (mesh.n_vertices() <= kNear) return false;
  const std::size_t step = mesh.n_triangles() / kSample + 1;
  std::size_t seen = 0, far = 0;
  for (std::size_t t = 0; t < mesh.n_triangles(); t += step) {
    if (mesh.is_erased(TriangleId(t))) continue;
    const auto [a, b, c] = mesh.corners(TriangleId(t));
    const auto [least, greatest] = std::minmax({a.index, b.index, c.index});
    ++seen;
    far += greatest - least > kNear ? 1 : 0;
  }
  return 4 * far > seen;
}

IdVector<VertexId, VertexId> vertices_by_hilbert(const Mesh& mesh, Executor* executor) {
  const std::size_t n = mesh.n_vertices();
  IdVector<VertexId, std::uint64_t> keys(n);
  const auto sorted = [&](int bits, auto&& key_of) {
    for_each_index(n, executor, [&](std::size_t i) { keys[VertexId(i)] = key_of(VertexId(i)); });
    return sorted_by_key<VertexId, std::uint64_t>(n, bits, executor, [&](std::size_t i) { return keys[VertexId(i)]; });
  };
  if (mesh.space().dimension() == 3)
    return sorted(kCubeBits, [&](VertexId v) { return cube_hilbert_index(mesh.weighted_vector(v)); });
  PlaneBox box;
  for (const VertexId v : mesh.vertices()) box.add(mesh.position(v));
  return sorted(2 * kHilbertBits, [&, curve = HilbertGrid(box)](VertexId v) { return curve(mesh.position(v)); });
}

Walk::Walk(const Mesh& mesh, Executor* executor) {
  if (is_scattered(mesh)) order_ = vertices_by_hilbert(mesh, executor);
}

NearbyCopy::NearbyCopy(const Mesh& mesh, Executor* executor) : mesh_(&mesh) {
  if (is_scattered(mesh)) mesh_ = &copy_.emplace(hilbert_ordered(mesh, executor)).mesh;
}

// Hilbert order: neighbors in the plane, or on the sphere, become neighbors in memory.

namespace {

/// Triangles by their least corner in the new numbering, then by number.
IdVector<TriangleId, TriangleId> triangles_by_vertex(const Mesh& mesh, const IdVector<VertexId, VertexId>& new_vertex,
                                                     Executor* executor) {
  const auto least_corner = [&](std::size_t i) {
    const auto [a, b, c] = mesh.corners(TriangleId(i));
    return std::min({new_vertex[a], new_vertex[b], new_vertex[c]}).index;
  };
  const int bits = static_cast<int>(std::bit_width(mesh.n_vertices()));
  return sorted_by_key<TriangleId, std::uint32_t>(mesh.n_triangles(), bits, executor, least_corner);
}

template <class IdType>
IdVector<IdType, IdType> inverse(const IdVector<IdType, IdType>& order, Executor* executor) {
  IdVector<IdType, IdType> result(order.size());
  for_each_index(order.size(), executor, [&](std::size_t i) { result[order[IdType(i)]] = IdType(i); });
  return result;
}

}  // namespace

/// Has access to the arrays of meshes.
class MeshPermuter {
 public:
  static void permute(Mesh& mesh, const IdVector<VertexId, VertexId>& new_vertex,
                      const IdVector<TriangleId, TriangleId>& new_triangle, Executor* executor);
};

/// Moves one array after the other: on the largest meshes the memory in use at once counts.
void MeshPermuter::permute(Mesh& mesh, const IdVector<VertexId, VertexId>& new_vertex,
                           const IdVector<TriangleId, TriangleId>& new_triangle, Executor* executor) {
  const auto renumbered = [&](HalfedgeId h) {
    return h.valid() ? Mesh::halfedge(new_triangle[Mesh::triangle(h)], static_cast<int>(h.index % 3)) : h;
  };
  IdVector<VertexId, Mesh::VertexRecord> vertices(mesh.n_vertices());
  for_each_index(vertices.size(), executor,
                 [&](std::size_t i) { vertices[new_vertex[VertexId(i)]] = mesh.vertices_[VertexId(i)]; });
  mesh.vertices_ = std::move(vertices);
  IdVector<HalfedgeId, VertexId> corners(mesh.n_halfedges());
  for_each_index(corners.size(), executor,
                 [&](std::size_t i) { corners[renumbered(HalfedgeId(i))] = new_vertex[mesh.corners_[HalfedgeId(i)]]; });
  mesh.corners_ = std::move(corners);
  IdVector<HalfedgeId, HalfedgeId> twins(mesh.n_halfedges());
  for_each_index(twins.size(), executor,
                 [&](std::size_t i) { twins[renumbered(HalfedgeId(i))] = renumbered(mesh.twins_[HalfedgeId(i)]); });
  mesh.twins_ = std::move(twins);
  if (const auto constrained = std::exchange(mesh.constrained_, {}); !constrained.all_zero()) {
    for (const HalfedgeId h : mesh.halfedges())
      mesh.constrained_.set(renumbered(h), constrained[h], mesh.n_halfedges());
  }
  if (const auto regions = std::exchange(mesh.regions_, {}); !regions.all_zero()) {
    for (const TriangleId t : mesh.triangles()) mesh.set_region(new_triangle[t], regions[t]);
  }
  mesh.repair_outgoing();
}

OrderedMesh hilbert_ordered(const Mesh& mesh, Executor* executor) {
  Mesh copy = mesh;
  MeshOrder order = hilbert_order_in_place(copy, executor);
  return {std::move(copy), std::move(order)};
}

MeshOrder hilbert_order_in_place(Mesh& mesh, Executor* executor) {
  MeshOrder order;
  order.vertices = vertices_by_hilbert(mesh, executor);
  const auto new_vertex = inverse(order.vertices, executor);
  order.triangles = triangles_by_vertex(mesh, new_vertex, executor);
  MeshPermuter::permute(mesh, new_vertex, inverse(order.triangles, executor), executor);
  return order;
}

MeshOrder hilbert_order(Mesh& mesh) { return hilbert_order_in_place(mesh, nullptr); }

void restore_order(Mesh& mesh, const MeshOrder& order, Executor* executor) {
  MeshPermuter::permute(mesh, order.vertices, order.triangles, executor);
}

}  // namespace temper
