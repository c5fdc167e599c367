// Tensors whose axes turn from triangle to triangle. Each edge would be an interface, and no vertex could move. So a
// run takes the mean tensor of each region, and moves vertices in the plane of that tensor. Then each triangle has its
// own tensor again, and weights of corners that keep the equations of all edges.
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "optimize/run/end_of_run.hpp"
#include "optimize/tensors.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/location.hpp"
#include "temper/feasibility.hpp"

namespace temper {
namespace {

// Part of the edges inside that are interfaces where axes turn everywhere. Layers have interfaces at few edges.
constexpr double kManyInterfaces = 0.2;

/// The mean tensor of the region of each triangle, of tensors with the determinant 1.
std::vector<Tensor> means_of_regions(const Mesh& mesh, const std::vector<Tensor>& tensors) {
  std::map<std::int32_t, Tensor> sums;
  for (const TriangleId t : mesh.triangles()) {
    const Tensor& k = tensors[t.index];
    const double scale = 1 / std::sqrt(k.xx * k.yy - k.xy * k.xy);
    Tensor& sum = sums.try_emplace(mesh.region(t), Tensor{0, 0, 0}).first->second;
    sum = {sum.xx + scale * k.xx, sum.xy + scale * k.xy, sum.yy + scale * k.yy};
  }
  std::vector<Tensor> result;
  for (const TriangleId t : mesh.triangles()) result.push_back(sums[mesh.region(t)]);
  return result;
}

/// The tensor of each triangle of a changed mesh: that of the former triangle at its middle.
std::vector<Tensor> tensors_at(const Mesh& before, const std::vector<Tensor>& tensors, const Mesh& after,
                               const IdVector<VertexId, VertexId>& vertices, Executor* executor) {
  const auto places = positions_of_vertices(before, after, vertices, executor);
  std::vector<Tensor> result;
  for (const TriangleId t : sources_of_triangles(before, after, places, executor)) result.push_back(tensors[t.index]);
  return result;
}

}  // namespace

bool turns_everywhere(const Mesh& mesh, const Metrics& metrics) {
  std::size_t inside = 0, interfaces = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    ++inside;
    const Metric &a = metrics.of(Mesh::triangle(h)), &b = metrics.of(Mesh::triangle(mesh.twin(h)));
    interfaces += a.shares_plane(b) ? 0 : 1;
  }
  return static_cast<double>(interfaces) > kManyInterfaces * static_cast<double>(inside);
}

Expected<OptimizeReport> optimize_with_means(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                                             const PlaneRun& run) {
  const Mesh before = mesh;
  OptimizeOptions there = options;
  there.triangle_tensors = means_of_regions(mesh, options.triangle_tensors);
  there.corner_weights.clear();
  auto report = run(mesh, there, hooks);
  if (!report) return report;
  const Criterion criterion = criterion_of(options.scheme);
  const auto pieces_of = [](const Mesh& of, const std::vector<Tensor>& tensors, const std::vector<double>& weights) {
    return mapped(of, *Metrics::of(tensors), weights);
  };
  const auto n_bad = [&](const MetricMesh& pieces) {
    return cells_at_violations(pieces.mesh, criterion, hooks.executor).size();
  };
  report->triangle_tensors = tensors_at(before, options.triangle_tensors, mesh, report->vertices, hooks.executor);
  auto pieces = pieces_of(mesh, report->triangle_tensors, report->corner_weights);
  const auto given = pieces_of(before, options.triangle_tensors, options.corner_weights);
  if (!pieces || !given) return pieces ? given.error() : pieces.error();
  close_gaps(*pieces);
  const bool is_worse = n_bad(*pieces) > n_bad(*given);
  const auto whole = mapped_back(is_worse ? *given : *pieces, is_worse ? before : mesh, is_worse ? *given : *pieces);
  if (!whole) return whole.error();
  if (is_worse) {
    report->vertices.clear();
    report->notes.push_back("the tensors turn so fast that the run made more triangles bad; the input is returned");
    report->triangle_tensors = options.triangle_tensors;
  }
  report->corner_weights = whole->corner_weights;
  count_vertices(*report, report->vertices, before.n_vertices());
  mesh = whole->mesh;
  return report;
}

}  // namespace temper
