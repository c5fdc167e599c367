#include "mesh/curve.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/hilbert.hpp"
#include "mesh/blocks.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

/// The place of each vertex along the curve, and its number of bits.
struct Keys {
  IdVector<VertexId, std::uint64_t> of;
  int bits;
};
Keys keys_on_sphere(const Mesh& mesh, Executor* executor) {
  Keys keys{IdVector<VertexId, std::uint64_t>(mesh.n_vertices()), kCubeBits};
  for_each_index(mesh.n_vertices(), executor,
                 [&](std::size_t i) { keys.of[VertexId(i)] = cube_hilbert_index(mesh.weighted_vector(VertexId(i))); });
  return keys;
}
Keys keys_in_plane(const Mesh& mesh, Executor* executor) {
  Box box;
  for (const VertexId v : mesh.vertices()) box.add(mesh.position(v));
  const HilbertGrid curve(box);
  Keys keys{IdVector<VertexId, std::uint64_t>(mesh.n_vertices()), 2 * kHilbertBits};
  for_each_index(mesh.n_vertices(), executor,
                 [&](std::size_t i) { keys.of[VertexId(i)] = curve(mesh.position(VertexId(i))); });
  return keys;
}

constexpr std::size_t kLot = std::size_t{1} << 20;  // vertices that are dealt out by one thread

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

// Splits keys into lots with common leading digits, then sorts each lot: both on all threads.
IdVector<VertexId, VertexId> vertices_by_hilbert(const Mesh& mesh, Executor* executor) {
  constexpr int kFew = 8, kMostDigits = 12;  // of which lots have about 2⁸ keys, or more
  const auto [of, bits] =
      mesh.space().dimension() == 2 ? keys_in_plane(mesh, executor) : keys_on_sphere(mesh, executor);
  const IdVector<VertexId, std::uint64_t>& keys = of;  // lambdas may not capture structured bindings before clang 16
  const std::size_t n = mesh.n_vertices(), blocks = (n + kLot - 1) / kLot;
  const int digits = std::clamp(static_cast<int>(std::bit_width(n)) - kFew, 0, kMostDigits);
  const std::size_t lots = std::size_t{1} << digits;
  const auto lot_of = [&keys, shift = bits - digits](std::size_t i) { return keys[VertexId(i)] >> shift; };
  const auto for_lots_of = [&](auto&& visit) {  // each index of a block with its lot
    or_serial(executor).run(blocks, [&](std::size_t b) {
      for (std::size_t i = b * kLot; i < std::min(n, (b + 1) * kLot); ++i) visit(b, lot_of(i), i);
    });
  };
  std::vector<std::uint32_t> place(blocks * lots, 0);  // of the next one of this block in this lot
  for_lots_of([&](std::size_t b, std::size_t lot, std::size_t) { ++place[b * lots + lot]; });
  std::vector<std::uint32_t> first(lots + 1, 0);
  std::uint32_t next = 0;
  for (std::size_t lot = 0; lot < lots; ++lot) {
    first[lot] = next;
    for (std::size_t b = 0; b < blocks; ++b) next += std::exchange(place[b * lots + lot], next);
  }
  first[lots] = next;
  struct Keyed {
    std::uint64_t key;
    VertexId v;
    bool operator<(const Keyed& other) const { return key != other.key ? key < other.key : v < other.v; }
  };
  std::vector<Keyed> sorted(n);
  for_lots_of([&](std::size_t b, std::size_t lot, std::size_t i) {
    sorted[place[b * lots + lot]++] = {keys[VertexId(i)], VertexId(i)};
  });
  IdVector<VertexId, VertexId> order(n);
  or_serial(executor).run(lots, [&](std::size_t lot) {
    std::sort(sorted.begin() + first[lot], sorted.begin() + first[lot + 1]);
    for (std::size_t i = first[lot]; i < first[lot + 1]; ++i) order[VertexId(i)] = sorted[i].v;
  });
  return order;
}

Walk::Walk(const Mesh& mesh, Executor* executor) {
  if (is_scattered(mesh)) order_ = vertices_by_hilbert(mesh, executor);
}

NearbyCopy::NearbyCopy(const Mesh& mesh, Executor* executor) : mesh_(&mesh) {
  if (is_scattered(mesh)) mesh_ = &copy_.emplace(hilbert_ordered(mesh, executor)).mesh;
}

// Hilbert order: neighbors in the plane, or on the sphere, become neighbors in memory.

namespace {

/// Triangles by their least corner in the new numbering, then by number. Each is found in the star of that corner, from
/// vertex to vertex along the curve: neighbors of neighbors are in the cache.
IdVector<TriangleId, TriangleId> triangles_by_vertex(const Mesh& mesh, const IdVector<VertexId, VertexId>& order,
                                                     const IdVector<VertexId, VertexId>& new_vertex,
                                                     Executor* executor) {
  const std::size_t n = mesh.n_vertices();
  const auto for_triangles_of = [&](std::size_t i, auto&& visit) {
    const VertexId first(i);
    for (const HalfedgeId h : mesh.star(order[first])) {
      if (first < new_vertex[mesh.target(h)] && first < new_vertex[mesh.opposite(h)]) visit(Mesh::triangle(h));
    }
  };
  std::vector<std::vector<TriangleId>> of_blocks((n + kLoopBlock - 1) / kLoopBlock);
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    std::vector<TriangleId>& found = of_blocks[first / kLoopBlock];
    found.reserve(2 * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      const auto before = static_cast<std::ptrdiff_t>(found.size());
      for_triangles_of(i, [&](TriangleId t) { found.push_back(t); });
      std::sort(found.begin() + before, found.end());
    }
  });
  std::vector<std::size_t> place;  // of each block, among all triangles
  place.reserve(of_blocks.size());
  std::size_t count = 0;
  for (const std::vector<TriangleId>& found : of_blocks) place.push_back(std::exchange(count, count + found.size()));
  IdVector<TriangleId, TriangleId> triangles(count);
  or_serial(executor).run(of_blocks.size(), [&](std::size_t b) {
    std::size_t next = place[b];
    for (const TriangleId t : of_blocks[b]) triangles[TriangleId(next++)] = t;
    of_blocks[b] = {};
  });
  return triangles;
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
  found.order.triangles = triangles_by_vertex(mesh, found.order.vertices, found.new_vertex, executor);
  return found;
}

}  // namespace

/// Has access to the arrays of meshes.
class MeshPermuter {
 public:
  static Mesh copy(const Mesh& mesh, Found& found, Executor* executor);
  static void restore(Mesh& mesh, const MeshOrder& order, Executor* executor);
};

/// Copies one array after the other, and drops each renumbering before it makes the next one: on the largest meshes the
/// memory in use at once counts.
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
  const auto new_triangle = inverse(order.triangles, executor);
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
  result.repair_outgoing();
  return result;
}

/// The halfedge that stands for a vertex depends on the numbering (Mesh::repair_outgoing): the boundary halfedge, or at
/// an inner vertex the halfedge of the greatest number. As in copy(), one array after the other.
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
  Mesh ordered = MeshPermuter::copy(mesh, found, executor);
  return {std::move(ordered), std::move(found.order)};
}

MeshOrder hilbert_order(Mesh& mesh) {
  OrderedMesh ordered = hilbert_ordered(mesh);
  mesh = std::move(ordered.mesh);
  return std::move(ordered.order);
}

void restore_order(Mesh& mesh, const MeshOrder& order, Executor* executor) {
  MeshPermuter::restore(mesh, order, executor);
}

}  // namespace temper
