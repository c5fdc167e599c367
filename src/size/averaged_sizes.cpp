#include "size/averaged_sizes.hpp"

#include <utility>

#include "mesh/blocks.hpp"

namespace temper {
namespace {

using Sizes = IdVector<VertexId, double>;

constexpr int kAverages = 10;
// Weight of a vertex in an average, if each neighbor has weight 1.
constexpr double kOwnPart = 2;

double averaged(const Mesh& mesh, const Sizes& sizes, VertexId v) {
  if (mesh.is_isolated(v)) return sizes[v];
  double sum = kOwnPart * sizes[v], count = kOwnPart;
  const auto add = [&](VertexId u) {
    sum += sizes[u];
    ++count;
  };
  for (const HalfedgeId h : mesh.star(v)) {
    add(mesh.target(h));
    if (mesh.is_boundary(Mesh::prev(h))) add(mesh.opposite(h));
  }
  return sum / count;
}

}  // namespace

Sizes averaged_sizes(const Mesh& mesh, Sizes sizes, Executor* executor) {
  const std::size_t n = mesh.n_vertices();
  Sizes next(n);
  for (int k = 0; k < kAverages; ++k) {
    for_each_index(n, executor, [&](std::size_t i) { next[VertexId(i)] = averaged(mesh, sizes, VertexId(i)); });
    std::swap(sizes, next);
  }
  return sizes;
}

}  // namespace temper
