// The report: one pass over the tetrahedra with their faces, and one over the edges, in blocks of a fixed size. Blocks
// go to the executor; the merge is in their order, so the report does not depend on threads.
#include "temper/tets/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/median.hpp"
#include "mesh/blocks.hpp"
#include "quality/measure.hpp"
#include "tets/mesh/tables.hpp"
#include "tets/quality/coefficients.hpp"
#include "tets/quality/duals.hpp"
#include "tets/quality/measure.hpp"
#include "tets/quality/measures_table.hpp"

namespace temper::tets {
namespace {

using namespace measured;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kBlock = 4096;  // tetrahedra: some milliseconds of work

using Sums = gathered::Sums<Quality, kMeasures>;

/// A run of tetrahedra. Each face is counted by the halfface that stands for it.
struct Tally : Sums {
  explicit Tally(std::size_t n_worst) : worst(n_worst) {
    report.histograms = {empty_angle_histogram(), empty_height_histogram()};
  }

  Ranked<HalffaceId> least_dual = {kInfinity, {}};
  std::vector<double> transmissibilities = {};
  WorstList<TetId> worst;

  using Sums::add;
  void add(const TetMesh& mesh, TetId t);
  void merge(const Tally& other);

 private:
  void add_face(const TetMesh& mesh, HalffaceId h, const TetMeasure& m);
  void add_dual(DualKind kind, Sign sign, double over_l, HalffaceId h);
};

void Tally::add(const TetMesh& mesh, TetId t) {
  const TetMeasure m = measure_tetrahedron(mesh.points(t));
  add(Tetrahedron{mesh, t, m});
  worst.offer({m.margin(), t});
  for (const double angle : m.dihedral_deg) {
    add(Dihedral{angle});
    report.histograms.dihedrals.add(angle);
  }
  for (std::size_t f = 0; f < 4; ++f) {
    const HalffaceId h = TetMesh::halfface(t, static_cast<int>(f));
    add(Side{mesh, h, m, f});
    report.histograms.h_over_l.add(m.h_over_l[f]);
    if (!mesh.is_boundary(h) && mesh.bounds_region(h)) add_dual(DualKind::region, m.h_sign[f], m.h_over_l[f], h);
    if (mesh.is_face_representative(h)) add_face(mesh, h, m);
  }
}

void Tally::add_face(const TetMesh& mesh, HalffaceId h, const TetMeasure& m) {
  const FacePoints face = points_of(mesh, h);
  const auto& [a, b, c] = face;
  add(Face{mesh, h, face});
  for (const auto& [p, q, r] : {FacePoints{a, b, c}, FacePoints{b, c, a}, FacePoints{c, a, b}}) add(FaceEdge{p, q, r});
  const std::size_t f = h.index % 4;
  if (mesh.is_boundary(h)) {
    add_dual(DualKind::boundary, m.h_sign[f], m.h_over_l[f], h);
    return;
  }
  const Sign sign = dual_sign(mesh, h);
  const double dual = m.h[f] + signed_height(a, c, b, mesh.point(mesh.opposite(mesh.twin(h))));
  const double face_area = area(face);
  add_dual(DualKind::inside, sign, dual / length_of_area(face_area), h);
  transmissibilities.push_back(sign == Sign::zero || !(std::abs(dual) > 0) ? kInfinity : face_area / std::abs(dual));
}

void Tally::add_dual(DualKind kind, Sign sign, double over_l, HalffaceId h) {
  const gathered::Dual dual = {kind, sign, with_sign(over_l, sign)};
  add(dual);
  least_dual = std::min(least_dual, {dual.over_l, h});
}

void Tally::merge(const Tally& other) {
  Sums::merge(other);
  report.histograms.dihedrals.merge(other.report.histograms.dihedrals);
  report.histograms.h_over_l.merge(other.report.histograms.h_over_l);
  least_dual = std::min(least_dual, other.least_dual);
  transmissibilities.insert(transmissibilities.end(), other.transmissibilities.begin(), other.transmissibilities.end());
  worst.merge(other.worst);
}

Tally tally(const TetMesh& mesh, const QualityOptions& options) {
  const std::size_t n = mesh.n_tetrahedra();
  std::vector<Tally> blocks((n + kBlock - 1) / kBlock, Tally(options.worst));
  or_serial(options.executor).run(blocks.size(), [&](std::size_t i) {
    for (std::size_t t = i * kBlock; t < std::min(n, (i + 1) * kBlock); ++t) blocks[i].add(mesh, TetId(t));
  });
  Tally all(options.worst);
  for (const Tally& block : blocks) all.merge(block);
  return all;
}

Sums tally_edges(const TetMesh& mesh, Executor* executor) {
  const EdgeTable edges(mesh, executor);
  std::vector<Sums> blocks((mesh.n_vertices() + kLoopBlock - 1) / kLoopBlock);
  for_blocks(mesh.n_vertices(), executor, [&](std::size_t first, std::size_t last) {
    Sums& sums = blocks[first / kLoopBlock];
    for (std::size_t a = first; a < last; ++a) {
      const WeightedPoint p = mesh.point(VertexId(a));
      for (const VertexId b : edges.greater(VertexId(a))) sums.add(Edge{p, mesh.point(b)});
    }
  });
  Sums all;
  for (const Sums& block : blocks) all.merge(block);
  return all;
}

struct CoefficientTally : Sums {
  Ranked<std::array<VertexId, 2>> least = {kInfinity, {}};
};

CoefficientTally tally_coefficients(const TetMesh& mesh, Executor* executor) {
  const Coefficients coefficients(mesh, executor);
  std::vector<CoefficientTally> blocks(coefficients.n_blocks());
  coefficients.visit(executor, [&](std::size_t b, const EdgeCoefficient& c) {
    blocks[b].add(c);
    blocks[b].least = std::min(blocks[b].least, {c.over_l, c.vertices});
  });
  CoefficientTally all;
  for (const CoefficientTally& block : blocks) {
    all.merge(block);
    all.least = std::min(all.least, block.least);
  }
  return all;
}

template <std::size_t n>
PlaceOf<n> place_of(const TetMesh& mesh, const std::array<VertexId, n>& vertices) {
  PlaceOf<n> place = {vertices, {}};
  for (const VertexId v : vertices) place.at = place.at + 1.0 / n * mesh.position(v);
  return place;
}

void compare_transmissibilities(Quality& q, std::vector<double>& values) {
  q.max_transmissibility_over_median = q.transmissibility_ratio = 1;
  if (values.empty()) return;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double min = *least, max = *most;
  q.transmissibility_ratio = max < kInfinity ? max / min : max;
  q.max_transmissibility_over_median = over_median(max, median_of(values));
}

}  // namespace

std::span<const QualityMeasure> quality_measures() { return gathered::plain_rows<kMeasures>(); }

std::size_t violations(const Quality& q, Criterion criterion) {
  if (criterion == Criterion::well_centered) return q.orthocenters_outside;
  if (criterion == Criterion::coefficients)
    return q.inverted_tetrahedra + q.negative_coefficients + q.negative_boundary_coefficients +
           q.negative_region_coefficients;
  return q.inverted_tetrahedra + q.nonpositive_distances + q.nonpositive_boundary_distances +
         q.nonpositive_region_distances;
}

Quality quality(const TetMesh& mesh, const QualityOptions& options) {
  Tally sums = tally(mesh, options);
  sums.Sums::merge(tally_edges(mesh, options.executor));
  const CoefficientTally coefficients = tally_coefficients(mesh, options.executor);
  sums.Sums::merge(coefficients);
  Quality& q = sums.report;
  const auto on_boundary = boundary_vertices(mesh);
  for (const std::uint8_t is_on : on_boundary) sums.add(Vertex{is_on != 0});
  sums.add(mesh);
  sums.end(mesh.n_tetrahedra());
  if (mesh.n_tetrahedra() == 0) return q;
  q.min_coefficient_place = place_of(mesh, coefficients.least.element);
  q.min_distance_place = place_of(mesh, mesh.vertices(sums.least_dual.element));
  compare_transmissibilities(q, sums.transmissibilities);
  for (const auto& [margin, t] : sums.worst.sorted()) q.worst.push_back(describe(mesh, t, on_boundary));
  return q;
}

}  // namespace temper::tets
