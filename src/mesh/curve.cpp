#include "mesh/curve.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>
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

/// A halfedge by the new number of its triangle; none stays none.
HalfedgeId renumbered(HalfedgeId h, const IdVector<TriangleId, TriangleId>& new_triangle) {
  return h.valid() ? Mesh::halfedge(new_triangle[Mesh::triangle(h)], static_cast<int>(h.index % 3)) : h;
}

/// The order along the curve, and the new number of every vertex, a by-product of the search.
struct Found {
  MeshOrder order;
  IdVector<VertexId, VertexId> new_vertex;
};
Found find_order(const Mesh& mesh, Executor* executor) {
  Found found;
  found.order.vertices = vertices_by_hilbert(mesh, executor);
  found.new_vertex = inverse(found.order.vertices, executor);
  found.order.triangles = triangles_by_vertex(mesh, found.new_vertex, executor);
  return found;
}

}  // namespace

/// Has access to the arrays of meshes.
class MeshPermuter {
 public:
  template <class M>
  static Mesh ordered(M& mesh, Found& found, Executor* executor);
  static void restore(Mesh& mesh, const MeshOrder& order, Executor* executor);
};

/// Copies one array after the other, and drops each renumbering before it makes the next one: on the largest meshes the
/// memory in use at once counts. If M is not const, it uses the mesh up.
template <class M>
Mesh MeshPermuter::ordered(M& mesh, Found& found, Executor* executor) {
  Mesh result;
  result.space_ = mesh.space();
  const MeshOrder& order = found.order;
  const std::size_t n = mesh.n_triangles();
  const auto release = []([[maybe_unused]] auto& array) {
    if constexpr (!std::is_const_v<M>) array = {};
  };
  result.vertices_.resize(mesh.n_vertices());
  for_each_index(mesh.n_vertices(), executor,
                 [&](std::size_t i) { result.vertices_[VertexId(i)] = mesh.vertices_[order.vertices[VertexId(i)]]; });
  release(mesh.vertices_);
  result.corners_.resize(3 * n);
  for_each_index(n, executor, [&](std::size_t i) {
    const auto corners = mesh.corners(order.triangles[TriangleId(i)]);
    for (std::size_t k = 0; k < 3; ++k) result.corners_[HalfedgeId(3 * i + k)] = found.new_vertex[corners[k]];
  });
  found.new_vertex = {};
  release(mesh.corners_);
  const auto new_triangle = inverse(order.triangles, executor);
  result.twins_.resize(3 * n);
  for_each_index(n, executor, [&](std::size_t i) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(order.triangles[TriangleId(i)], k);
      result.twins_[Mesh::halfedge(TriangleId(i), k)] = renumbered(mesh.twin(h), new_triangle);
    }
  });
  release(mesh.twins_);
  if (!mesh.constrained_.all_zero()) {
    for (const HalfedgeId h : result.halfedges()) {
      const HalfedgeId from = Mesh::halfedge(order.triangles[Mesh::triangle(h)], static_cast<int>(h.index % 3));
      result.constrained_.set(h, mesh.constrained_[from], 3 * n);
    }
  }
  if (!mesh.regions_.all_zero()) {
    for (const TriangleId t : result.triangles()) result.set_region(t, mesh.regions_[order.triangles[t]]);
  }
  result.repair_outgoing();
  return result;
}

/// The halfedge that stands for a vertex depends on the numbering (Mesh::repair_outgoing): the boundary halfedge, or at
/// an inner vertex the halfedge of the greatest number. As in ordered(), one array after the other.
void MeshPermuter::restore(Mesh& mesh, const MeshOrder& order, Executor* executor) {
  const std::size_t n = mesh.n_triangles();
  const auto former = [&](HalfedgeId h) { return renumbered(h, order.triangles); };
  const auto former_outgoing = [&](VertexId v) {
    HalfedgeId last = former(mesh.outgoing(v));
    if (!last.valid() || mesh.is_boundary(v)) return last;
    for (const HalfedgeId h : mesh.star(v)) last = std::max(last, former(h));
    return last;
  };
  IdVector<VertexId, Mesh::VertexRecord> vertices(mesh.n_vertices());
  for_each_index(vertices.size(), executor, [&](std::size_t i) {
    Mesh::VertexRecord& record = vertices[order.vertices[VertexId(i)]];
    record = mesh.vertices_[VertexId(i)];
    record.outgoing = former_outgoing(VertexId(i)).index;
  });
  mesh.vertices_ = std::move(vertices);
  IdVector<HalfedgeId, VertexId> corners(mesh.n_halfedges());
  for_each_index(n, executor, [&](std::size_t t) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(TriangleId(t), k);
      corners[former(h)] = order.vertices[mesh.corners_[h]];
    }
  });
  mesh.corners_ = std::move(corners);
  IdVector<HalfedgeId, HalfedgeId> twins(mesh.n_halfedges());
  for_each_index(n, executor, [&](std::size_t t) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(TriangleId(t), k);
      twins[former(h)] = former(mesh.twins_[h]);
    }
  });
  mesh.twins_ = std::move(twins);
  if (const auto constrained = std::exchange(mesh.constrained_, {}); !constrained.all_zero()) {
    for (const HalfedgeId h : mesh.halfedges()) mesh.constrained_.set(former(h), constrained[h], mesh.n_halfedges());
  }
  if (const auto regions = std::exchange(mesh.regions_, {}); !regions.all_zero()) {
    for (const TriangleId t : mesh.triangles()) mesh.set_region(order.triangles[t], regions[t]);
  }
}

OrderedMesh hilbert_ordered(const Mesh& mesh, Executor* executor) {
  Found found = find_order(mesh, executor);
  Mesh ordered = MeshPermuter::ordered(mesh, found, executor);
  return {std::move(ordered), std::move(found.order)};
}

MeshOrder hilbert_order_in_place(Mesh& mesh, Executor* executor) {
  Found found = find_order(mesh, executor);
  mesh = MeshPermuter::ordered(mesh, found, executor);
  return std::move(found.order);
}

MeshOrder hilbert_order(Mesh& mesh) { return hilbert_order_in_place(mesh, nullptr); }

void restore_order(Mesh& mesh, const MeshOrder& order, Executor* executor) {
  MeshPermuter::restore(mesh, order, executor);
}

}  // namespace temper
