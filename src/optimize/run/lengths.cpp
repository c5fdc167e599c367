#include "optimize/run/lengths.hpp"

#include <algorithm>

#include "base/sum.hpp"
#include "temper/detail/size.hpp"

namespace temper {
namespace {

using Sizes = IdVector<VertexId, double>;

double missing(double length, double least) {
  const double part = length < least ? 1 - std::max(length, 0.0) / least : 0;
  return part * part;
}

/// Of an edge that the halfedge stands for; none of the boundary's.
double missing_of(const Mesh& mesh, const Sizes& sizes, const AccuracyModel& model, HalfedgeId h) {
  if (mesh.is_erased(Mesh::triangle(h)) || mesh.is_boundary(h) || !mesh.is_edge_representative(h)) return 0;
  const auto [edge, dual] = relative_lengths(mesh, sizes, h);
  return missing(edge, model.min_edge) + missing(dual, model.min_dual);
}

}  // namespace

double missing_lengths(const Mesh& mesh, const AccuracyModel& model, Executor* executor) {
  if (!model.keeps_lengths()) return 0;
  const Sizes sizes = local_sizes(mesh, executor);
  return blockwise_sum(mesh.n_halfedges(), executor,
                       [&](std::size_t i) { return missing_of(mesh, sizes, model, HalfedgeId(i)); });
}

std::vector<TriangleId> triangles_lacking_length(const Mesh& mesh, const AccuracyModel& model) {
  std::vector<TriangleId> lacking;
  if (!model.keeps_lengths()) return lacking;
  const Sizes sizes = local_sizes(mesh);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (missing_of(mesh, sizes, model, h) > 0) lacking.push_back(Mesh::triangle(h));
  }
  lacking.erase(std::unique(lacking.begin(), lacking.end()), lacking.end());
  return lacking;
}

}  // namespace temper
