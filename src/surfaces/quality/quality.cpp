// The report on a surface: the rows of the plane's table, from the measures of triangles in space.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/median.hpp"
#include "quality/measure.hpp"
#include "quality/measures_table.hpp"
#include "regularity/duals.hpp"
#include "surfaces/quality/duals.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Corners = std::array<WeightedPoint, 3>;

std::array<double, 3> squared_lengths(const Corners& p) {
  std::array<double, 3> l2;
  for (int k = 0; k < 3; ++k) l2[k] = squared_length(p[corner_after(k)].position() - p[k].position());
  return l2;
}

TriangleMeasure measure_triangle(const Corners& p) {
  TriangleMeasure m;
  m.orientation = Sign::positive;
  const std::array<double, 3> l2 = squared_lengths(p);
  for (int k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[corner_after(k)], &c = p[corner_across(k)];
    const Vec3 ab = b.position() - a.position(), ac = c.position() - a.position();
    m.h_sign[k] = signed_height_sign(a, b, c);
    m.crossed[k] = dual_crossing_sign(a, b) == Sign::positive && dual_crossing_sign(b, a) == Sign::positive;
    m.h_over_l[k] = signed_height(a, b, c) / std::sqrt(l2[k]);
    m.d_over_l[k] = 0.5 - std::abs(a.w - b.w) / (2 * l2[k]);
    m.angle_deg[k] = std::atan2(length(cross(ab, ac)), dot(ab, ac)) * (180 / std::numbers::pi);
  }
  return m;
}

/// The sums of the report, triangle by triangle.
class Report {
 public:
  Report(const SurfaceMesh& mesh, std::size_t worst) : mesh_(mesh), worst_(worst) {
    sums_.report.histograms = {empty_angle_histogram(), empty_height_histogram(), empty_crossing_histogram()};
  }

  Quality take() {
    for (const TriangleId t : mesh_.triangles()) add(t);
    sums_.add(mesh_.connectivity());
    sums_.end(mesh_.n_triangles());
    Quality q = {std::move(sums_.report)};
    static_cast<SolverMeasures&>(q) = SolverMeasures();
    compare_transmissibilities(q);
    for (const auto& ranked : worst_.sorted()) q.worst.push_back(describe(ranked.element));
    if (least_dual_.element.valid()) {
      const auto [a, b] = ends_of(least_dual_.element);
      const Vec3 at = 0.5 * (mesh_.position(a) + mesh_.position(b));
      q.min_coefficient_place = {{a, b}, {at.x, at.y}, at.z};
    }
    return q;
  }

 private:
  [[nodiscard]] std::array<VertexId, 2> ends_of(HalfedgeId h) const {
    return {mesh_.connectivity().origin(h), mesh_.connectivity().target(h)};
  }

  void add(TriangleId t) {
    const Mesh& mesh = mesh_.connectivity();
    const TriangleMeasure m = measure_triangle(mesh_.points(t));
    Histograms& histograms = sums_.report.histograms;
    sums_.add(measured::Triangle{mesh, t, m});
    worst_.offer({m.margin(), t});
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      sums_.add(measured::Side{mesh, h, m, k});
      histograms.angles.add(m.angle_deg[k]);
      histograms.h_over_l.add(m.h_over_l[k]);
      if (!mesh.is_edge_representative(h)) continue;
      sums_.add(measured::Edge{mesh, h, m, k});
      histograms.d_over_l.add(m.d_over_l[k]);
      visit_duals(mesh_, h, [&](DualKind kind, HalfedgeId side, Sign sign) {
        const gathered::Dual dual = {kind, sign, dual_over_length(mesh_, side, kind, sign)};
        sums_.add(dual);
        least_dual_ = std::min(least_dual_, {dual.over_l, side});
        if (kind == DualKind::inside) transmissibilities_.push_back(std::abs(1 / dual.over_l));
      });
    }
  }

  void compare_transmissibilities(Quality& q) {
    q.max_transmissibility_over_median = q.transmissibility_ratio = transmissibilities_.empty() ? 1 : kInfinity;
    if (transmissibilities_.empty()) return;
    std::sort(transmissibilities_.begin(), transmissibilities_.end());
    const std::size_t n = transmissibilities_.size();
    const double most = transmissibilities_.back();
    const double median = median_of_middle(transmissibilities_[(n - 1) / 2], transmissibilities_[n / 2]);
    q.max_transmissibility_over_median = over_median(most, median);
    if (most < kInfinity) q.transmissibility_ratio = most / transmissibilities_.front();
  }

  [[nodiscard]] WorstTriangle describe(TriangleId t) const {
    const Corners p = mesh_.points(t);
    WorstTriangle worst = temper::describe(mesh_.connectivity(), t, measure_triangle(p), squared_lengths(p));
    const Vec3 at = (1.0 / 3) * (p[0].position() + p[1].position() + p[2].position());
    worst.at = {at.x, at.y}, worst.z = at.z;
    return worst;
  }

  const SurfaceMesh& mesh_;
  gathered::Sums<temper::Quality, measured::kMeasures> sums_;
  WorstList<TriangleId> worst_;
  Ranked<HalfedgeId> least_dual_ = {kInfinity, {}};
  std::vector<double> transmissibilities_;
};

}  // namespace

Quality quality(const SurfaceMesh& mesh, std::size_t worst) { return Report(mesh, worst).take(); }

std::span<const QualityMeasure> quality_measures() {
  const std::span<const QualityMeasure> all = temper::quality_measures();
  const auto first_of_solvers = std::ranges::find(all, "min_edge_over_size", &QualityMeasure::key);
  return all.first(static_cast<std::size_t>(first_of_solvers - all.begin()));
}

TriangleQuality triangle_quality(const Corners& corners) {
  const TriangleMeasure m = measure_triangle(corners);
  const auto least = [](const std::array<double, 3>& of) { return *std::min_element(of.begin(), of.end()); };
  return {m.well_centered(), least(m.h_over_l), least(m.d_over_l), least(m.angle_deg)};
}

double dual_over_length(const SurfaceMesh& mesh, HalfedgeId h, DualKind kind, Sign sign) {
  const Mesh& c = mesh.connectivity();
  const WeightedPoint p = mesh.point(c.origin(h)), q = mesh.point(c.target(h)), r = mesh.point(c.opposite(h));
  if (kind == DualKind::inside) return dual_over_length(p, q, r, mesh.point(c.opposite(c.twin(h))));
  return with_sign(signed_height(p, q, r) / length(q.position() - p.position()), sign);
}

std::vector<ViolatedEdge> violated_edges(const SurfaceMesh& mesh, Criterion criterion) {
  std::vector<ViolatedEdge> all;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.connectivity().is_edge_representative(h)) continue;
    visit_duals(mesh, h, [&](DualKind kind, HalfedgeId side, Sign sign) {
      if (!allows(criterion, sign)) all.push_back({side, kind, dual_over_length(mesh, side, kind, sign)});
    });
  }
  return all;
}

std::vector<TriangleId> cells_at_violations(const SurfaceMesh& mesh, Criterion criterion) {
  const Mesh& connectivity = mesh.connectivity();
  IdVector<TriangleId, std::uint8_t> marked(mesh.n_triangles(), 0);
  if (criterion == Criterion::well_centered) {
    for (const TriangleId t : mesh.triangles()) {
      const auto [p, q, r] = mesh.points(t);
      marked[t] = is_well_centered(p, q, r) ? 0 : 1;
    }
  } else {
    for (const ViolatedEdge& violated : violated_edges(mesh, criterion)) {
      marked[Mesh::triangle(violated.edge)] = 1;
      const HalfedgeId other = connectivity.twin(violated.edge);
      if (other.valid()) marked[Mesh::triangle(other)] = 1;
    }
  }
  std::vector<TriangleId> cells;
  for (const TriangleId t : mesh.triangles()) {
    if (marked[t] != 0) cells.push_back(t);
  }
  return cells;
}

bool meets(const SurfaceMesh& mesh, Criterion criterion) { return cells_at_violations(mesh, criterion).empty(); }

}  // namespace temper::surfaces
