#include "tets/mesh/tables.hpp"

#include <iterator>
#include <numeric>

#include "mesh/blocks.hpp"

namespace temper::tets {
namespace {

/// Sorts the items of a mesh by key: ends of the buckets, then place(key) gives the next place of each. `each` calls
/// its argument with all keys, in the same order each time.
template <class Each>
std::vector<std::uint32_t> bucket_starts(std::size_t n_keys, const Each& each) {
  std::vector<std::uint32_t> start(n_keys + 1, 0);
  each([&](VertexId key) { ++start[key.index + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  start.pop_back();
  return start;
}

VertexId least(const std::array<VertexId, 3>& face) { return std::min({face[0], face[1], face[2]}); }

}  // namespace

FaceBuckets::FaceBuckets(const TetMesh& mesh) : mesh_(mesh), sorted_(mesh.n_halffaces()) {
  end_ = bucket_starts(mesh.n_vertices(), [&](auto count) {
    for (const HalffaceId h : mesh.halffaces()) count(least(mesh.vertices(h)));
  });
  for (const HalffaceId h : mesh.halffaces()) sorted_[end_[least(mesh.vertices(h)).index]++] = h;
}

void FaceBuckets::collect(VertexId v, std::vector<Side>& sides) const {
  sides.clear();
  for (std::size_t i = v.index == 0 ? 0 : end_[v.index - 1]; i < end_[v.index]; ++i) {
    auto corners = mesh_.vertices(sorted_[i]);
    const auto other = [&](std::size_t k) { return corners[k] == v ? corners[2] : corners[k]; };
    const VertexId a = other(0), b = other(1);
    sides.push_back({std::min(a, b), std::max(a, b), sorted_[i]});
  }
  std::sort(sides.begin(), sides.end());
}

VertexStars::VertexStars(const TetMesh& mesh) : sorted_(mesh.n_halffaces()) {
  end_ = bucket_starts(mesh.n_vertices(), [&](auto count) {
    for (const HalffaceId h : mesh.halffaces()) count(mesh.opposite(h));
  });
  for (const HalffaceId h : mesh.halffaces()) sorted_[end_[mesh.opposite(h).index]++] = h;
}

VertexStars::VertexStars(const VertexStars& stars, std::span<const VertexId> sequence) {
  end_.reserve(sequence.size());
  std::size_t n = 0;
  for (const VertexId v : sequence) end_.push_back(static_cast<std::uint32_t>(n += stars.link(v).size()));
  sorted_.reserve(n);
  for (const VertexId v : sequence) std::ranges::copy(stars.link(v), std::back_inserter(sorted_));
}

EdgeTable::EdgeTable(const TetMesh& mesh, Executor* executor)
    : greater_(6 * mesh.n_tetrahedra()), n_(mesh.n_vertices()) {
  const auto each_edge = [&](auto use) {
    for (const TetId t : mesh.tetrahedra()) {
      const auto& corners = mesh.corners(t);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) use(std::min(corners[i], corners[j]), std::max(corners[i], corners[j]));
      }
    }
  };
  end_ = bucket_starts(mesh.n_vertices(), [&](auto count) { each_edge([&](VertexId a, VertexId) { count(a); }); });
  each_edge([&](VertexId a, VertexId b) { greater_[end_[a.index]++] = b; });
  for_each_index(mesh.n_vertices(), executor, [&](std::size_t v) {
    const auto first = greater_.begin() + (v == 0 ? 0 : end_[v - 1]), last = greater_.begin() + end_[v];
    std::sort(first, last);
    n_[VertexId(v)] = static_cast<std::uint32_t>(std::unique(first, last) - first);
  });
  n_edges_ = std::accumulate(n_.begin(), n_.end(), std::size_t{0});
}

}  // namespace temper::tets
