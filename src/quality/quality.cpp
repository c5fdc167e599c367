// The report: one pass over the triangles in blocks of a fixed size, then another one for all energies. Blocks go to
// the executor; the merge is in their order, so the report does not depend on threads.
#include "temper/quality.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "base/median.hpp"
#include "energy/whole_mesh.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesh/blocks.hpp"
#include "mesh/curve.hpp"
#include "quality/measure.hpp"
#include "quality/measures_table.hpp"
#include "regularity/duals.hpp"
#include "size/solver_measures.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

using namespace measured;

/// Ratios of ℓ / |dual| over all interior edges; 1 without any.
struct Transmissibilities {
  double max_over_median = 1;
  double max_over_min = 1;
};

// The length of the face over the distance between the orthocenters on its two sides. Doubles cannot distinguish a dual
// of length zero from one of 1e-17; the exact test can.
double transmissibility(const Mesh& mesh, HalfedgeId h) {
  const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  const WeightedPoint d = mesh.point(mesh.opposite(mesh.twin(h)), a);
  if (power_test(mesh.space(), a, b, c, d) == Sign::zero) return std::numeric_limits<double>::infinity();
  const double ratio = distance(mesh.space(), a, b) / std::abs(dual_length(mesh.space(), a, b, c, d));
  return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;  // it has to have a rank
}

/// Calls take(b, value) for each interior edge; b is the number of its block.
template <class Take>
void for_transmissibilities(const Mesh& mesh, Executor* executor, Take&& take) {
  for_blocks(mesh.n_halfedges(), executor, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const HalfedgeId h(i);
      if (mesh.is_boundary(h) || !mesh.is_edge_representative(h) || mesh.is_diagonal(h)) continue;
      take(first / kLoopBlock, transmissibility(mesh, h));
    }
  });
}

/// Numbers that are not negative are in the order of their bits: the upper half of these is a coarse rank.
std::size_t coarse_rank(double value) { return std::bit_cast<std::uint64_t>(value) >> 48; }

/// O(n), with two passes over the edges: the first finds the extremes and the coarse rank of the median, the second
/// keeps the values of that rank. An array of all values would raise the memory of `temper check` by a twelfth.
Transmissibilities compare_transmissibilities(const Mesh& mesh, Executor* executor) {
  constexpr std::size_t kRanks = std::size_t{1} << 15;
  std::vector<std::atomic<std::uint32_t>> counts(kRanks);
  const std::size_t blocks = (mesh.n_halfedges() + kLoopBlock - 1) / kLoopBlock;
  std::vector<double> least(blocks, std::numeric_limits<double>::infinity()), largest(blocks, 0.0);
  for_transmissibilities(mesh, executor, [&](std::size_t b, double value) {
    counts[coarse_rank(value)].fetch_add(1, std::memory_order_relaxed);
    least[b] = std::min(least[b], value), largest[b] = std::max(largest[b], value);
  });
  std::size_t n = 0;
  for (const auto& count : counts) n += count;
  if (n == 0) return {};

  // The middle value, or the middle two: all values of their ranks, and of those between.
  std::size_t first = 0, below = 0;
  while (below + counts[first] <= (n - 1) / 2) below += counts[first++];
  std::size_t last = first, up_to = below + counts[first];
  while (up_to <= n / 2) up_to += counts[++last];
  std::vector<std::vector<double>> of_blocks(blocks);
  for_transmissibilities(mesh, executor, [&](std::size_t b, double value) {
    if (const std::size_t rank = coarse_rank(value); first <= rank && rank <= last) of_blocks[b].push_back(value);
  });
  std::vector<double> middle;
  for (const std::vector<double>& values : of_blocks) middle.insert(middle.end(), values.begin(), values.end());
  std::sort(middle.begin(), middle.end());
  const double most = *std::max_element(largest.begin(), largest.end());
  Transmissibilities all;
  all.max_over_min =
      most < std::numeric_limits<double>::infinity() ? most / *std::min_element(least.begin(), least.end()) : most;
  all.max_over_median = over_median(most, median_of_middle(middle[(n - 1) / 2 - below], middle[n / 2 - below]));
  return all;
}

// The sums of the report over a run of triangles: one Tally per block, merged in the order of the blocks.
//
// Everything here is a count, an extreme or a short list, so any division into blocks gives the same merged result.
// Each edge is counted by the halfedge that stands for it, in the block of that halfedge's triangle.

/// The edge of a dual, by its triangle in the user's order.
struct LeastDual {
  TriangleId triangle;
  int k = 0;
  friend auto operator<=>(const LeastDual&, const LeastDual&) = default;
};

struct Tally : gathered::Sums<Quality, kMeasures> {
  explicit Tally(std::size_t n_worst) : worst(n_worst) {
    report.histograms = {empty_angle_histogram(), empty_height_histogram(), empty_crossing_histogram()};
  }

  Ranked<LeastDual> least_dual = {std::numeric_limits<double>::infinity(), {}};
  WorstList<TriangleId> worst;

  using Sums::add;
  /// `original`: the number of the triangle in messages.
  void add(const Mesh& mesh, TriangleId t, TriangleId original);
  void merge(const Tally& other);

 private:
  void add_dual(DualKind kind, Sign sign, Ranked<LeastDual> dual);
};

void Tally::add(const Mesh& mesh, TriangleId t, TriangleId original) {
  const TriangleMeasure m = measure_triangle(mesh, t);
  add(Triangle{mesh, t, m});
  worst.offer({m.margin(), original});
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    add(Side{mesh, h, m, k});
    report.histograms.angles.add(m.angle_deg[k]);
    if (mesh.is_diagonal(h)) continue;
    report.histograms.h_over_l.add(m.h_over_l[k]);
    if (is_interface(mesh, h)) add_dual(DualKind::region, m.h_sign[k], {m.h_over_l[k], {original, k}});
    if (!mesh.is_edge_representative(h)) continue;
    add(Edge{mesh, h, m, k});
    report.histograms.d_over_l.add(m.d_over_l[k]);
    const DualKind kind = mesh.is_boundary(h) ? DualKind::boundary : DualKind::inside;
    const Sign sign = mesh.is_boundary(h) ? m.h_sign[k] : dual_sign(mesh, h);
    const double dual = mesh.is_boundary(h) ? m.h_over_l[k] : dual_over_length(mesh, h, kind, sign);
    add_dual(kind, sign, {dual, {original, k}});
  }
}

void Tally::add_dual(DualKind kind, Sign sign, Ranked<LeastDual> dual) {
  dual.margin = with_sign(dual.margin, sign);
  add(gathered::Dual{kind, sign, dual.margin});
  least_dual = std::min(least_dual, dual);
}

void Tally::merge(const Tally& other) {
  Sums::merge(other);
  least_dual = std::min(least_dual, other.least_dual);
  worst.merge(other.worst);
  report.histograms.angles.merge(other.report.histograms.angles);
  report.histograms.h_over_l.merge(other.report.histograms.h_over_l);
  report.histograms.d_over_l.merge(other.report.histograms.d_over_l);
}

constexpr std::size_t kBlock = 8192;  // triangles: some milliseconds of work, some hundred blocks for a million

/// All but SolverMeasures, transmissibilities and energies. `originals`: the number of each triangle in messages; empty
/// if all are equal.
Tally tally(const Mesh& mesh, const IdVector<TriangleId, TriangleId>& originals, const QualityOptions& options) {
  const std::size_t n = mesh.n_triangles();
  std::vector<Tally> blocks((n + kBlock - 1) / kBlock, Tally(options.worst));
  or_serial(options.executor).run(blocks.size(), [&](std::size_t i) {
    const std::size_t end = std::min(n, (i + 1) * kBlock);
    for (std::size_t t = i * kBlock; t < end; ++t)
      blocks[i].add(mesh, TriangleId(t), originals.empty() ? TriangleId(t) : originals[TriangleId(t)]);
  });
  Tally all(options.worst);
  for (const Tally& block : blocks) all.merge(block);
  all.add(mesh);
  all.end(n);
  return all;
}

EnergiesByStar all_energies(const Mesh& mesh, const QualityOptions& options) {
  EnergiesByStar table = {};
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

/// What is described in the user's mesh.
struct Places {
  WorstList<TriangleId> worst;
  LeastDual least_dual;
};

/// All but places, which it returns.
Places measure(Quality& q, const Mesh& mesh, const IdVector<TriangleId, TriangleId>& originals,
               const QualityOptions& options) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  const Tally sums = tally(mesh, originals, options);
  q = sums.report;
  Places places = {sums.worst, sums.least_dual.element};
  if (options.detail == QualityDetail::criterion) {
    const Quality none;
    static_cast<SolverMeasures&>(q) = SolverMeasures{};
    q.max_transmissibility_over_median = none.max_transmissibility_over_median;
    q.transmissibility_ratio = none.transmissibility_ratio;
    return places;
  }
  const bool brief = options.detail == QualityDetail::brief;
  static_cast<SolverMeasures&>(q) = solver_measures(mesh, brief, options.executor);
  if (q.triangles == 0) return places;
  const Transmissibilities transmissibilities = compare_transmissibilities(mesh, options.executor);
  q.max_transmissibility_over_median = transmissibilities.max_over_median;
  q.transmissibility_ratio = transmissibilities.max_over_min;
  if (!brief) q.energy = all_energies(mesh, options);
  return places;
}

void describe_all(Quality& q, const Mesh& original, const Places& places) {
  for (const auto& ranked : places.worst.sorted()) q.worst.push_back(describe(original, ranked.element));
  if (q.triangles > 0)
    q.min_coefficient_place = place_of(original, Mesh::halfedge(places.least_dual.triangle, places.least_dual.k));
}

}  // namespace

std::span<const QualityMeasure> quality_measures() { return gathered::plain_rows<kMeasures>(); }

std::size_t violations(const Quality& q, Criterion criterion) {
  if (criterion == Criterion::coefficients)
    return q.inverted_triangles + q.non_regular_edges + q.negative_boundary_duals + q.negative_region_coefficients;
  if (criterion == Criterion::distances)
    return q.inverted_triangles + q.nonpositive_distances + q.nonpositive_boundary_distances +
           q.nonpositive_region_distances;
  const double good = std::round(q.well_centered_fraction * static_cast<double>(q.triangles));
  return q.triangles - static_cast<std::size_t>(good);
}

Quality quality(const Mesh& original, const QualityOptions& options) {
  const NearbyCopy near(original, options.executor);
  Quality q;
  describe_all(q, original, measure(q, near.mesh(), near.original_triangles(), options));
  return q;
}

Quality quality_in_place(Mesh& mesh, const QualityOptions& options) {
  if (!is_scattered(mesh)) return quality(mesh, options);
  Quality q;
  const MeshOrder order = hilbert_order_in_place(mesh, options.executor);
  const Places places = measure(q, mesh, order.triangles, options);
  restore_order(mesh, order, options.executor);
  describe_all(q, mesh, places);
  return q;
}

}  // namespace temper
