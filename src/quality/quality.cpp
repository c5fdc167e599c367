// The report: one pass over the triangles in blocks of a fixed size, then another one for all energies. Blocks go to
// the executor; the merge is in their order, so the report does not depend on threads.
#include "temper/quality.hpp"

#include <algorithm>
#include <set>

#include "base/assert.hpp"
#include "energy/whole_mesh.hpp"
#include "mesh/curve.hpp"
#include "mesh/erased.hpp"
#include "quality/solver_measures.hpp"
#include "quality/tally.hpp"
#include "quality/transmissibility.hpp"
#include "temper/detail/executor.hpp"

namespace temper {
namespace {

constexpr std::size_t kBlock = 8192;  // triangles: some milliseconds of work, some hundred blocks for a million

Tally tally(const NearbyCopy& near, const QualityOptions& options) {
  const Mesh& mesh = near.mesh();
  const std::size_t n = mesh.n_triangles();
  std::vector<Tally> blocks((n + kBlock - 1) / kBlock, Tally(options.worst));
  or_serial(options.executor).run(blocks.size(), [&](std::size_t i) {
    const std::size_t end = std::min(n, (i + 1) * kBlock);
    for (std::size_t t = i * kBlock; t < end; ++t) blocks[i].add(mesh, TriangleId(t), near.original(TriangleId(t)));
  });
  Tally all(options.worst);
  for (const Tally& block : blocks) all.merge(block);
  return all;
}

EnergyTable all_energies(const Mesh& mesh, const QualityOptions& options) {
  EnergyTable table = {};
  std::vector<EnergyModel> models(table.size() * 3);
  for (std::size_t i = 0; i < models.size(); ++i) {
    models[i].kind = static_cast<EnergyKind>(i / 3);
    models[i].star = static_cast<Star>(i % 3);
    models[i].gamma = options.gamma;
    models[i].h0 = options.h0;
  }
  const std::vector<double> totals = total_energies(mesh, models, options.executor);
  for (std::size_t i = 0; i < totals.size(); ++i) table[i / 3][i % 3] = totals[i];
  return table;
}

std::size_t count_regions(const Mesh& mesh) {
  std::set<std::int32_t> regions;
  for (TriangleId t : mesh.triangles()) regions.insert(mesh.region(t));
  return regions.size();
}

}  // namespace

Quality quality(const Mesh& original, const QualityOptions& options) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(original));
  const NearbyCopy near(original, options.executor);
  const Mesh& mesh = near.mesh();
  const Tally sums = tally(near, options);
  Quality q;
  static_cast<SolverMeasures&>(q) = solver_measures(mesh, options.executor);
  q.vertices = mesh.n_vertices();
  q.triangles = mesh.n_triangles();
  q.edges = sums.edges;
  q.boundary_edges = sums.boundary_edges;
  q.regions = count_regions(mesh);
  q.angles = sums.angles;
  q.h_over_l = sums.h_over_l;
  q.d_over_l = sums.d_over_l;
  if (q.triangles == 0) return q;

  q.inverted_triangles = sums.inverted_triangles;
  q.non_regular_edges = sums.non_regular_edges;
  q.negative_boundary_duals = sums.negative_boundary_duals;
  q.orthocenters_outside = sums.orthocenters_outside;
  q.edges_not_crossed = sums.edges_not_crossed;
  q.well_centered_fraction = static_cast<double>(sums.well_centered) / static_cast<double>(q.triangles);
  q.min_h_over_l = sums.min_h_over_l;
  q.min_d_over_l = sums.min_d_over_l;
  q.min_angle_deg = sums.min_angle_deg;
  q.max_angle_deg = sums.max_angle_deg;
  const Transmissibilities transmissibilities = compare_transmissibilities(mesh, options.executor);
  q.max_transmissibility_over_median = transmissibilities.max_over_median;
  q.transmissibility_ratio = transmissibilities.max_over_min;
  q.energy = all_energies(mesh, options);
  for (const Ranked& ranked : sums.worst.sorted()) q.worst.push_back(describe(original, ranked.triangle));
  return q;
}

}  // namespace temper
