#include "quality/transmissibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/median.hpp"
#include "geometry/in_space.hpp"
#include "mesh/blocks.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

// The length of the face over the distance between the orthocenters on its two sides. Doubles cannot tell a dual of
// length zero from one of 1e-17, the exact test can.
double transmissibility(const Mesh& mesh, HalfedgeId h) {
  const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  const WeightedPoint d = mesh.point(mesh.opposite(mesh.twin(h)), a);
  if (power_test(mesh.space(), a, b, c, d) == Sign::zero) return std::numeric_limits<double>::infinity();
  return distance(mesh.space(), a, b) / std::abs(dual_length(mesh.space(), a, b, c, d));
}

/// Those of all interior edges, in an array that is made once: lists that grow would take twice its room.
std::vector<double> transmissibilities(const Mesh& mesh, Executor* executor) {
  const std::size_t n = mesh.n_halfedges();
  const auto for_edges = [&](std::size_t first, std::size_t last, auto&& visit) {
    for (std::size_t i = first; i < last; ++i) {
      const HalfedgeId h(i);
      if (!mesh.is_boundary(h) && mesh.is_edge_representative(h)) visit(h);
    }
  };
  std::vector<std::size_t> place((n + kLoopBlock - 1) / kLoopBlock);  // of each block, in the array
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    for_edges(first, last, [&](HalfedgeId) { ++place[first / kLoopBlock]; });
  });
  std::size_t count = 0;
  for (std::size_t& of_block : place) count += std::exchange(of_block, count);
  std::vector<double> values(count);
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    std::size_t next = place[first / kLoopBlock];
    for_edges(first, last, [&](HalfedgeId h) { values[next++] = transmissibility(mesh, h); });
  });
  return values;
}

}  // namespace

Transmissibilities compare_transmissibilities(const Mesh& mesh, Executor* executor) {
  std::vector<double> values = transmissibilities(mesh, executor);
  if (values.empty()) return {};
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  Transmissibilities all;
  all.max_over_min = *largest < std::numeric_limits<double>::infinity() ? *largest / *least : *largest;
  all.max_over_median = largest_over_median(std::move(values));
  return all;
}

}  // namespace temper
