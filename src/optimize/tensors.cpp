#include "optimize/tensors.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/bad_triangles.hpp"
#include "optimize/repair/local_copy.hpp"
#include "optimize/run/run_in_pieces.hpp"
#include "temper/detail/necessity.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

// Bounds of a conflict (necessity.hpp) up to this sum leave so little room that sweeps hardly find it.
constexpr double kRoomAtInterfaces = 1.3;

/// Refuses options that only a mesh in its own plane can have.
std::optional<InputError> check_metric(const OptimizeOptions& options, const OptimizeHooks& hooks) {
  const auto refused = [](const char* what) {
    return InputError{ErrorCode::invalid_option, {}, std::string("a tensor cannot go with ") + what};
  };
  if (options.size_field) return refused("`size_field`: sizes are lengths of the plane of the mesh");
  if (options.problem) return refused("a problem, whose coefficients are numbers");
  if (hooks.tracer) return refused("a trace: its events would be in the plane of the metric");
  return std::nullopt;
}

/// The metric of each triangle, or of all.
Expected<Metrics> metrics_of(const OptimizeOptions& options, const InputNames& names) {
  if (!options.triangle_tensors.empty()) return Metrics::of(options.triangle_tensors, names);
  const auto metric = Metric::of(*options.tensor);
  if (!metric) return metric.error();
  return Metrics(*metric);
}

/// The parts of a run in pieces that are of triangles.
struct Triangles {
  using Mesh = temper::Mesh;
  using Pieces = MetricMesh;
  using Numbers = IdVector<VertexId, VertexId>;
  using Hooks = OptimizeHooks;
  using Report = OptimizeReport;
  using BestSoFar = temper::BestSoFar;
  using BestListener = temper::BestListener;
  using Run = PlaneRun;
  static constexpr bool kTriesWellCentered = true;
  static constexpr BoundaryVertices kChangesSeams = BoundaryVertices::split;
  static constexpr double kFewBad = 0;  // a round of splits may need the next one

  const OptimizeOptions& options;
  const OptimizeHooks& hooks;
  const PlaneRun& run_there;

  static auto& numbers_of(auto& found) { return found.vertices; }
  static auto& vertices(auto& numbers) { return numbers; }
  static auto& tensors_of(OptimizeReport& report) { return report.triangle_tensors; }
  static std::array<VertexId, 2> vertices_of(const Mesh& mesh, HalfedgeId h) {
    return {mesh.origin(h), mesh.target(h)};
  }

  Expected<OptimizeReport> run(Mesh& there, const std::vector<VertexId>& frozen) const {
    IdVector<VertexId, std::uint8_t> was_frozen;
    for (const VertexId v : there.vertices()) was_frozen.push_back(there.is_frozen(v) ? 1 : 0);
    for (const VertexId v : frozen) there.set_frozen(v);
    auto report = run_there(there, options, hooks);
    if (!report) return report;
    for (const VertexId v : there.vertices()) {
      const VertexId old = report->vertices.empty() ? v : report->vertices[v];
      there.set_frozen(v, old.valid() && was_frozen[old] != 0);
    }
    return report;
  }

  [[nodiscard]] std::size_t n_bad(const Mesh& mesh) const {
    return cells_at_violations(mesh, criterion_of(options.scheme), hooks.executor).size();
  }
  /// Cells at violations of the criterion, then triangles that are not well-centered.
  [[nodiscard]] std::pair<std::size_t, std::size_t> faults_of(const Mesh& mesh) const {
    return {n_bad(mesh), bad_triangles(mesh).size()};
  }
  static std::size_t reported(const std::pair<std::size_t, std::size_t>& faults) { return faults.second; }
  [[nodiscard]] static double largest_gap(const MetricMesh& pieces) { return temper::largest_gap(pieces); }

  static double n_cells(const Mesh& mesh) { return static_cast<double>(mesh.n_triangles()); }
  static bool becomes_regular(Mesh& mesh) { return restore_regularity(mesh).hidden.empty(); }
  /// Sets all weights to zero if vertices would be hidden.
  static void settle_weights(Mesh& mesh) {
    if (Mesh copy = mesh; becomes_regular(copy)) return;
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0);
  }

  /// An edge of an interface to be split: its ends on both sides, and the part of the way from the first.
  struct Cut {
    VertexId from, to, copy_of_from, copy_of_to;
    double part = 0.5;
  };
  [[nodiscard]] static Cut cut_of(const Mesh& mesh, const SeamEdge& seam, double part) {
    return {mesh.origin(seam.one), mesh.target(seam.one), mesh.target(seam.other), mesh.origin(seam.other), part};
  }

  /// The edges of interfaces that leave their dual little room on a side.
  [[nodiscard]] static std::vector<Cut> conflicts(const MetricMesh& pieces) {
    std::vector<Cut> cuts;
    for (const SeamEdge& seam : seams_of(pieces)) {
      const auto one = edge_conflict(pieces.mesh, seam.one, kRoomAtInterfaces);
      const auto other = edge_conflict(pieces.mesh, seam.other, kRoomAtInterfaces);
      if (!one && !other) continue;
      const bool first = one && (!other || one->sum <= other->sum);
      cuts.push_back(cut_of(pieces.mesh, seam, first ? one->split_at : 1 - other->split_at));
    }
    return cuts;
  }
  /// The edges of interfaces at bad triangles, to be halved.
  [[nodiscard]] std::vector<Cut> seams_at_bad(const MetricMesh& pieces) const {
    IdVector<TriangleId, std::uint8_t> bad(pieces.mesh.n_triangles(), 0);
    for (const TriangleId t : cells_at_violations(pieces.mesh, criterion_of(options.scheme), hooks.executor))
      bad[t] = 1;
    std::vector<Cut> cuts;
    for (const SeamEdge& seam : seams_of(pieces)) {
      if (bad[Mesh::triangle(seam.one)] != 0 || bad[Mesh::triangle(seam.other)] != 0)
        cuts.push_back(cut_of(pieces.mesh, seam, 0.5));
    }
    return cuts;
  }

  /// Splits edges that leave their dual little room. Returns the numbers before, if there were any.
  static std::optional<Numbers> change_seams(MetricMesh& pieces) {
    const std::vector<Cut> cuts = conflicts(pieces);
    return cuts.empty() ? std::nullopt : std::optional(split(pieces, cuts));
  }
  /// Splits edges at bad triangles.
  template <class Whole, class MustStop>
  std::optional<Numbers> change_seams_at_bad(MetricMesh& pieces, const Whole&, const MustStop&) const {
    const std::vector<Cut> cuts = seams_at_bad(pieces);
    return cuts.empty() ? std::nullopt : std::optional(split(pieces, cuts));
  }
  /// Splits edges of interfaces on both sides. Weights that are linear along an edge keep its equation in both parts.
  static Numbers split(MetricMesh& pieces, const std::vector<Cut>& cuts) {
    Numbers numbers;
    for (const VertexId v : pieces.mesh.vertices()) numbers.push_back(v);
    for (const Cut& cut : cuts) {
      const VertexId first = split_edge_of(pieces.mesh, cut.from, cut.to, cut.part);
      split_edge_of(pieces.mesh, cut.copy_of_from, cut.copy_of_to, cut.part);
      for (int copy = 0; copy < 2; ++copy) {
        pieces.first_copies.push_back(first);
        numbers.push_back(VertexId());
      }
    }
    return numbers;
  }
  static VertexId split_edge_of(Mesh& mesh, VertexId a, VertexId b, double part) {
    const HalfedgeId h = mesh.find_halfedge(a, b), back = mesh.find_halfedge(b, a);
    const WeightedPoint p = mesh.point(a), q = mesh.point(b);
    const auto between = [part](double x, double y) { return x + part * (y - x); };
    return split_edge(mesh, h.valid() ? h : back, {between(p.x, q.x), between(p.y, q.y), between(p.w, q.w)});
  }
};

}  // namespace

Expected<OptimizeReport> optimize_in_metrics(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                                             const PlaneRun& run) {
  if (auto error = check_metric(options, hooks)) return *std::move(error);
  const InputNames from_zero;
  const InputNames& names = hooks.names != nullptr ? *hooks.names : from_zero;
  const auto metrics = metrics_of(options, names);
  if (!metrics) return metrics.error();
  const auto run_in_pieces = [&](Mesh& there, const Metrics& of_there, const OptimizeOptions& o,
                                 const OptimizeHooks& h) -> Expected<OptimizeReport> {
    auto pieces = mapped(there, of_there, o.corner_weights, names);
    if (!pieces) return pieces.error();
    return RunInPieces<Triangles>(there, *std::move(pieces), o, h, run).run(there);
  };
  const bool fits = metrics->n_cells() == mesh.n_triangles();
  if (!fits || !turns_everywhere(mesh, *metrics)) return run_in_pieces(mesh, *metrics, options, hooks);
  return optimize_with_means(mesh, options, hooks,
                             [&](Mesh& there, const OptimizeOptions& means, const OptimizeHooks& h) {
                               const auto of_means = Metrics::of(means.triangle_tensors, names);
                               return of_means ? run_in_pieces(there, *of_means, means, h) : of_means.error();
                             });
}

}  // namespace temper
