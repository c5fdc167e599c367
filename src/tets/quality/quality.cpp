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

namespace temper::tets {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kBlock = 4096;  // tetrahedra: some milliseconds of work

/// The sums of the report over a run of tetrahedra. Each face is counted by the halfface that stands for it.
struct Tally {
  explicit Tally(std::size_t n_worst) : worst(n_worst) {}

  std::size_t boundary_faces = 0, inverted = 0, outside = 0;
  std::array<std::size_t, 3> negative_duals = {}, nonpositive_duals = {};  // of each DualKind
  Ranked<HalffaceId> least_dual = {kInfinity, {}};
  std::size_t faces_not_crossed = 0, completely = 0;
  double min_h = kInfinity, min_face_h = kInfinity, min_dihedral = kInfinity, max_dihedral = 0;
  double volume = 0, min_volume = kInfinity, max_volume = -kInfinity;
  std::vector<double> transmissibilities = {};
  WorstList<TetId> worst;
  Histogram dihedrals = empty_angle_histogram(), h_over_l = empty_height_histogram();

  void add(const TetMesh& mesh, TetId t);
  void merge(const Tally& other);

 private:
  void add_face(const TetMesh& mesh, HalffaceId h, const TetMeasure& m);
  void add_dual(DualKind kind, Sign sign, double over_l, HalffaceId h);
};

void Tally::add(const TetMesh& mesh, TetId t) {
  const TetMeasure m = measure_tetrahedron(mesh.points(t));
  inverted += m.orientation != Sign::positive;
  outside += !m.orthocenter_inside();
  completely += m.orthocenter_inside() && has_all_crossed(mesh, t);
  worst.offer({m.margin(), t});
  volume += m.volume;
  min_volume = std::min(min_volume, m.volume), max_volume = std::max(max_volume, m.volume);
  for (const double angle : m.dihedral_deg) {
    min_dihedral = std::min(min_dihedral, angle), max_dihedral = std::max(max_dihedral, angle);
    dihedrals.add(angle);
  }
  for (int f = 0; f < 4; ++f) {
    min_h = std::min(min_h, m.h_over_l[std::size_t(f)]);
    h_over_l.add(m.h_over_l[std::size_t(f)]);
    const HalffaceId h = TetMesh::halfface(t, f);
    if (!mesh.is_boundary(h) && mesh.bounds_region(h))
      add_dual(DualKind::region, m.h_sign[std::size_t(f)], m.h_over_l[std::size_t(f)], h);
    if (mesh.is_face_representative(h)) add_face(mesh, h, m);
  }
}

void Tally::add_face(const TetMesh& mesh, HalffaceId h, const TetMeasure& m) {
  const FacePoints face = points_of(mesh, h);
  const auto& [a, b, c] = face;
  faces_not_crossed += !is_crossed(face);
  for (const auto& [p, q, r] : {FacePoints{a, b, c}, FacePoints{b, c, a}, FacePoints{c, a, b}})
    min_face_h = std::min(min_face_h, signed_height(p, q, r) / length(q.position() - p.position()));
  const std::size_t f = h.index % 4;
  if (mesh.is_boundary(h)) {
    ++boundary_faces;
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
  negative_duals[static_cast<std::size_t>(kind)] += sign == Sign::negative;
  nonpositive_duals[static_cast<std::size_t>(kind)] += sign != Sign::positive;
  least_dual = std::min(least_dual, {with_sign(over_l, sign), h});
}

void Tally::merge(const Tally& other) {
  boundary_faces += other.boundary_faces;
  inverted += other.inverted;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    negative_duals[kind] += other.negative_duals[kind];
    nonpositive_duals[kind] += other.nonpositive_duals[kind];
  }
  least_dual = std::min(least_dual, other.least_dual);
  outside += other.outside;
  faces_not_crossed += other.faces_not_crossed;
  completely += other.completely;
  min_h = std::min(min_h, other.min_h);
  min_face_h = std::min(min_face_h, other.min_face_h);
  min_dihedral = std::min(min_dihedral, other.min_dihedral);
  max_dihedral = std::max(max_dihedral, other.max_dihedral);
  volume += other.volume;
  min_volume = std::min(min_volume, other.min_volume);
  max_volume = std::max(max_volume, other.max_volume);
  transmissibilities.insert(transmissibilities.end(), other.transmissibilities.begin(), other.transmissibilities.end());
  worst.merge(other.worst);
  dihedrals.merge(other.dihedrals);
  h_over_l.merge(other.h_over_l);
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

struct EdgeTally {
  std::size_t not_crossed = 0;
  double min_d = kInfinity;
};

EdgeTally tally_edges(const TetMesh& mesh, const EdgeTable& edges, Executor* executor) {
  std::vector<EdgeTally> blocks((mesh.n_vertices() + kLoopBlock - 1) / kLoopBlock);
  for_blocks(mesh.n_vertices(), executor, [&](std::size_t first, std::size_t last) {
    EdgeTally& sums = blocks[first / kLoopBlock];
    for (std::size_t a = first; a < last; ++a) {
      const WeightedPoint p = mesh.point(VertexId(a));
      for (const VertexId b : edges.greater(VertexId(a))) {
        const WeightedPoint q = mesh.point(b);
        const double d = dual_crossing(p, q) / length(q.position() - p.position());
        sums.not_crossed += !is_crossed(p, q);
        sums.min_d = std::min({sums.min_d, d, 1 - d});
      }
    }
  });
  EdgeTally all;
  for (const EdgeTally& block : blocks) {
    all.not_crossed += block.not_crossed;
    all.min_d = std::min(all.min_d, block.min_d);
  }
  return all;
}

struct CoefficientTally {
  std::array<std::size_t, 3> negative = {};  // of each DualKind
  Ranked<std::array<VertexId, 2>> least = {kInfinity, {}};
};

CoefficientTally tally_coefficients(const TetMesh& mesh, Executor* executor) {
  const Coefficients coefficients(mesh, executor);
  std::vector<CoefficientTally> blocks(coefficients.n_blocks());
  coefficients.visit(executor, [&](std::size_t b, const EdgeCoefficient& c) {
    blocks[b].negative[static_cast<std::size_t>(c.kind)] += c.sign == Sign::negative;
    blocks[b].least = std::min(blocks[b].least, {c.over_l, c.vertices});
  });
  CoefficientTally all;
  for (const CoefficientTally& block : blocks) {
    for (std::size_t kind = 0; kind < 3; ++kind) all.negative[kind] += block.negative[kind];
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

void set_duals(Quality& q, const TetMesh& mesh, const Tally& sums) {
  q.non_regular_faces = sums.negative_duals[0];
  q.negative_boundary_duals = sums.negative_duals[1];
  q.nonpositive_distances = sums.nonpositive_duals[0];
  q.nonpositive_boundary_distances = sums.nonpositive_duals[1];
  q.nonpositive_region_distances = sums.nonpositive_duals[2];
  q.min_distance = sums.least_dual.margin;
  q.min_distance_place = place_of(mesh, mesh.vertices(sums.least_dual.element));
}

void set_coefficients(Quality& q, const TetMesh& mesh, const CoefficientTally& sums) {
  q.negative_coefficients = sums.negative[0];
  q.negative_boundary_coefficients = sums.negative[1];
  q.negative_region_coefficients = sums.negative[2];
  q.min_coefficient = sums.least.margin;
  q.min_coefficient_place = place_of(mesh, sums.least.element);
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

std::size_t violations(const Quality& q, Criterion criterion) {
  if (criterion == Criterion::well_centered) return q.orthocenters_outside;
  if (criterion == Criterion::coefficients)
    return q.inverted_tetrahedra + q.negative_coefficients + q.negative_boundary_coefficients +
           q.negative_region_coefficients;
  return q.inverted_tetrahedra + q.nonpositive_distances + q.nonpositive_boundary_distances +
         q.nonpositive_region_distances;
}

Quality quality(const TetMesh& mesh, const QualityOptions& options) {
  Quality q;
  Tally sums = tally(mesh, options);
  const EdgeTable edges(mesh, options.executor);
  const EdgeTally of_edges = tally_edges(mesh, edges, options.executor);
  const auto on_boundary = boundary_vertices(mesh);
  q.vertices = mesh.n_vertices();
  q.inner_vertices = static_cast<std::size_t>(std::count(on_boundary.begin(), on_boundary.end(), 0));
  q.tetrahedra = mesh.n_tetrahedra();
  q.faces = mesh.n_faces();
  q.boundary_faces = sums.boundary_faces;
  q.edges = edges.n_edges();
  q.regions = count_regions(mesh, mesh.tetrahedra());
  q.histograms.dihedrals = sums.dihedrals;
  q.histograms.h_over_l = sums.h_over_l;
  if (q.tetrahedra == 0) return q;

  const auto fraction = [&](std::size_t n) { return static_cast<double>(n) / static_cast<double>(q.tetrahedra); };
  q.inverted_tetrahedra = sums.inverted;
  set_duals(q, mesh, sums);
  set_coefficients(q, mesh, tally_coefficients(mesh, options.executor));
  q.orthocenters_outside = sums.outside;
  q.faces_not_crossed = sums.faces_not_crossed;
  q.edges_not_crossed = of_edges.not_crossed;
  q.well_centered_fraction = fraction(q.tetrahedra - sums.outside);
  q.completely_well_centered_fraction = fraction(sums.completely);
  q.min_h_over_l = sums.min_h;
  q.min_face_h_over_l = sums.min_face_h;
  q.min_d_over_l = of_edges.min_d;
  q.min_dihedral_deg = sums.min_dihedral;
  q.max_dihedral_deg = sums.max_dihedral;
  q.volume = sums.volume;
  q.min_volume = sums.min_volume;
  q.max_volume = sums.max_volume;
  compare_transmissibilities(q, sums.transmissibilities);
  for (const auto& [margin, t] : sums.worst.sorted()) q.worst.push_back(describe(mesh, t, on_boundary));
  return q;
}

}  // namespace temper::tets
