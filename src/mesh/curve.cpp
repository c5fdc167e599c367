// See curve.hpp.
#include "mesh/curve.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
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

/// Says whether stars are scattered over memory: in a sample of the triangles, how often corners are too far apart.
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

}  // namespace

// A counting sort by the leading digits of the place along the curve, about as many buckets as vertices, and a sort of
// what is in each.
IdVector<VertexId, VertexId> vertices_by_hilbert(const Mesh& mesh, Executor* executor) {
  const auto [of, bits] = mesh.space().is_plane() ? keys_in_plane(mesh, executor) : keys_on_sphere(mesh, executor);
  const IdVector<VertexId, std::uint64_t>& keys = of;  // lambdas may not capture structured bindings before clang 16
  const std::size_t n = mesh.n_vertices();
  const int digits = std::min(static_cast<int>(std::bit_width(n)), bits);
  const auto bucket = [shift = bits - digits](std::uint64_t key) { return key >> shift; };
  std::vector<std::uint32_t> start((std::size_t{1} << digits) + 1, 0);
  for (const std::uint64_t key : keys) ++start[bucket(key) + 1];
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  IdVector<VertexId, VertexId> order(n);
  for (const VertexId v : mesh.vertices()) order[VertexId(start[bucket(keys[v])]++)] = v;
  for_each_index(start.size() - 1, executor, [&](std::size_t b) {  // each start has moved to the end of its bucket
    const auto first = order.begin() + (b == 0 ? 0 : start[b - 1]), last = order.begin() + start[b];
    if (last - first > 1) {
      std::sort(first, last,
                [&keys](VertexId u, VertexId v) { return keys[u] != keys[v] ? keys[u] < keys[v] : u < v; });
    }
  });
  return order;
}

Walk::Walk(const Mesh& mesh, Executor* executor) {
  if (is_scattered(mesh)) order_ = vertices_by_hilbert(mesh, executor);
}

}  // namespace temper
