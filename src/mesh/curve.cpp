// See curve.hpp.
#include "mesh/curve.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/hilbert.hpp"
#include "mesh/blocks.hpp"

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
                 [&](std::size_t i) { keys.of[VertexId(i)] = cube_hilbert_index(mesh.lifted_point(VertexId(i))); });
  return keys;
}
Keys keys_in_plane(const Mesh& mesh, Executor* executor) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Vec2 low{kInf, kInf}, high{-kInf, -kInf};
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const HilbertGrid curve(low, high);
  Keys keys{IdVector<VertexId, std::uint64_t>(mesh.n_vertices()), 2 * kHilbertBits};
  for_each_index(mesh.n_vertices(), executor,
                 [&](std::size_t i) { keys.of[VertexId(i)] = curve(mesh.position(VertexId(i))); });
  return keys;
}

constexpr std::size_t kLot = std::size_t{1} << 20;  // vertices that are dealt out by one thread

}  // namespace

// In a sample of the triangles, how often corners are too far apart.
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

// Keys with their leading digits in common, as they come, then a sort of each such lot: both on all threads.
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

}  // namespace temper
