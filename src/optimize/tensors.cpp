#include "optimize/tensors.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/bad_triangles.hpp"
#include "optimize/repair/local_copy.hpp"
#include "optimize/run/end_of_run.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/necessity.hpp"
#include "temper/feasibility.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

// Largest number of runs; before each but the first, edges of interfaces at bad triangles are split.
constexpr int kRuns = 5;
// Bounds of a conflict (necessity.hpp) up to this sum leave so little room that sweeps hardly find it.
constexpr double kRoomAtInterfaces = 1.3;
// Linear programs of larger meshes are about the neighborhoods of bad triangles alone.
constexpr std::size_t kWhole = 500;
// If more triangles are bad, programs take long and help little: vertices have to move.
constexpr std::size_t kMostBadForPrograms = 500;
// Crossings of an interface edge that differ by less are one, up to the rounding of coordinates of maps.
constexpr double kClosed = 1e-7;

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

Expected<MetricMesh> pieces_of(const Mesh& mesh, const OptimizeOptions& options, const InputNames& names) {
  if (!options.triangle_tensors.empty()) {
    const auto metrics = Metrics::of(options.triangle_tensors, names);
    if (!metrics) return metrics.error();
    return mapped(mesh, *metrics, options.corner_weights, names);
  }
  const auto metric = Metric::of(*options.tensor);
  if (!metric) return metric.error();
  return mapped(mesh, *metric, {}, names);
}

/// The run of a mesh in pieces, which may take several runs in their planes.
class PiecesRun {
 public:
  PiecesRun(const Mesh& original, MetricMesh pieces, const OptimizeOptions& options, const OptimizeHooks& hooks,
            const PlaneRun& run)
      : original_(original), first_(std::move(pieces)), now_(first_), options_(options), hooks_(hooks), run_(run) {
    options_.tensor.reset();
    options_.triangle_tensors.clear();
    options_.corner_weights.clear();
    options_.guard.depth.clear();                                            // waves do not know that plane
    if (!hooks_.started) hooks_.started = std::chrono::steady_clock::now();  // the limit is of all runs together
    if (hooks.best_so_far) listen(hooks.best_so_far);
  }

  Expected<OptimizeReport> run() {
    const bool comes_back = options_.change == Change::least && n_bad(now_.mesh) == 0;
    if (!first_.is_cut() || comes_back) return run_once();
    flatten();
    const bool splits = options_.boundary == BoundaryVertices::split;
    if (splits) split(conflicts());
    auto report = run_once();
    for (int i = 1; i < kRuns && report && goes_on(*report) && splits && split(edges_at_bad()); ++i) {
      auto next = run_once();
      if (!next) return next;
      report = joined(*std::move(report), *std::move(next));
    }
    if (report && goes_on(*report)) reweigh(*report);
    if (report) keep_better(*report);
    return report;
  }

  /// The mesh in its own plane.
  [[nodiscard]] Expected<WholeMesh> whole() const { return mapped_back(now_, original_, first_, vertices_); }

 private:
  void listen(const BestListener& listener) {
    hooks_.best_so_far = [this, listener](const auto& best) {
      listener([&](const auto& use) {
        best([&](const BestSoFar& found) {
          const MetricMesh there = with_mesh(now_, found.mesh, found.vertices);
          if (auto back = mapped_back(there, original_, first_, numbers_in_first(found.vertices)))
            use({back->mesh, back->vertices});
        });
      });
    };
  }

  Expected<OptimizeReport> run_once() {
    MetricMesh there = now_;
    for (const SeamEdge& seam : seams_of(there)) {
      for (const HalfedgeId h : {seam.one, seam.other})
        there.mesh.set_frozen(there.mesh.origin(h)), there.mesh.set_frozen(there.mesh.target(h));
    }
    auto report = run_(there.mesh, options_, hooks_);
    if (!report) return report;
    for (const VertexId v : there.mesh.vertices()) {
      const VertexId old = report->vertices.empty() ? v : report->vertices[v];
      there.mesh.set_frozen(v, old.valid() && now_.mesh.is_frozen(old));
    }
    now_ = with_mesh(now_, std::move(there.mesh), report->vertices);
    vertices_ = numbers_in_first(report->vertices);
    return report;
  }

  /// The numbers in the first pieces, from those before the last run.
  [[nodiscard]] IdVector<VertexId, VertexId> numbers_in_first(const IdVector<VertexId, VertexId>& numbers) const {
    if (numbers.empty() || vertices_.empty()) return numbers.empty() ? vertices_ : numbers;
    IdVector<VertexId, VertexId> result;
    for (const VertexId v : numbers) result.push_back(v.valid() ? vertices_[v] : v);
    return result;
  }

  [[nodiscard]] static bool goes_on(const OptimizeReport& report) {
    return report.stopped != Stopped::canceled && report.stopped != Stopped::time_limit;
  }
  [[nodiscard]] bool is_late() const {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - *hooks_.started;
    return options_.time_limit > 0 && seconds.count() >= options_.time_limit;
  }
  [[nodiscard]] std::size_t n_bad(const Mesh& mesh) const {
    return cells_at_violations(mesh, criterion_of(options_.scheme), hooks_.executor).size();
  }

  /// Sets the weights of interfaces to zero.
  void flatten() {
    for (const SeamEdge& seam : seams_of(now_)) {
      for (const HalfedgeId h : {seam.one, seam.other})
        now_.mesh.set_weight(now_.mesh.origin(h), 0), now_.mesh.set_weight(now_.mesh.target(h), 0);
    }
    show_all();
  }
  /// Sets all weights to zero if vertices would be hidden.
  void show_all() {
    if (!hides_vertices(now_.mesh)) return;
    for (const VertexId v : now_.mesh.vertices()) now_.mesh.set_weight(v, 0);
  }

  [[nodiscard]] static bool hides_vertices(Mesh mesh) { return !restore_regularity(mesh).hidden.empty(); }

  /// Cells at violations of the criterion, then triangles that are not well-centered.
  [[nodiscard]] std::pair<std::size_t, std::size_t> faults_of(const Mesh& mesh) const {
    return {n_bad(mesh), bad_triangles(mesh).size()};
  }

  /// Returns the input if it has fewer faults, and its weights keep the equations of interfaces.
  void keep_better(OptimizeReport& report) {
    if (largest_gap(first_) > kClosed || faults_of(first_.mesh) >= faults_of(now_.mesh)) return;
    now_ = first_;
    vertices_ = {};
    report.vertices.clear();
    report.bad_after = report.bad_before;
    report.notes.push_back("the input is returned: with its weights for each region it has fewer bad triangles");
  }

  /// Finds weights that keep the equations of interfaces: those that make all triangles well-centered, or those that
  /// violate the criterion least. Takes them if fewer triangles are bad.
  void reweigh(OptimizeReport& report) {
    reweigh(report, WeightGoal::change, Constraints::well_centered);
    reweigh(report, WeightGoal::elastic, constraints_of(criterion_of(options_.scheme)));
  }
  void reweigh(OptimizeReport& report, WeightGoal goal, Constraints constraints) {
    const auto before = faults_of(now_.mesh);
    const bool is_good = goal == WeightGoal::elastic ? before.first == 0 : before.second == 0;
    if (!hooks_.solvers.lp || is_good || before.second > kMostBadForPrograms) return;
    WeightOptions wanted;
    wanted.goal = goal;
    wanted.constraints = constraints;
    wanted.from_input = true;
    wanted.whole = kWhole;
    wanted.must_stop = [this] { return is_late(); };
    const auto found = find_weights(now_, *hooks_.solvers.lp(), wanted);
    if (!found) return;
    Mesh weighted = now_.mesh;
    for (const VertexId v : weighted.vertices()) weighted.set_weight(v, found->weights[v]);
    if (faults_of(weighted) >= before || !restore_regularity(weighted).hidden.empty() || faults_of(weighted) >= before)
      return;
    now_.mesh = std::move(weighted);
    report.bad_after = bad_triangles(now_.mesh).size();
  }

  /// An edge of an interface to be split: its ends on both sides, and the part of the way from the first.
  struct Cut {
    VertexId from, to, copy_of_from, copy_of_to;
    double part = 0.5;
  };
  [[nodiscard]] Cut cut_of(const SeamEdge& seam, double part) const {
    const Mesh& mesh = now_.mesh;
    return {mesh.origin(seam.one), mesh.target(seam.one), mesh.target(seam.other), mesh.origin(seam.other), part};
  }

  /// The edges of interfaces that leave their dual little room on a side.
  [[nodiscard]] std::vector<Cut> conflicts() const {
    std::vector<Cut> cuts;
    for (const SeamEdge& seam : seams_of(now_)) {
      const auto one = edge_conflict(now_.mesh, seam.one, kRoomAtInterfaces);
      const auto other = edge_conflict(now_.mesh, seam.other, kRoomAtInterfaces);
      if (!one && !other) continue;
      const bool first = one && (!other || one->sum <= other->sum);
      cuts.push_back(cut_of(seam, first ? one->split_at : 1 - other->split_at));
    }
    return cuts;
  }
  /// The edges of interfaces at bad triangles, to be halved.
  [[nodiscard]] std::vector<Cut> edges_at_bad() const {
    IdVector<TriangleId, std::uint8_t> bad(now_.mesh.n_triangles(), 0);
    for (const TriangleId t : cells_at_violations(now_.mesh, criterion_of(options_.scheme), hooks_.executor))
      bad[t] = 1;
    std::vector<Cut> cuts;
    for (const SeamEdge& seam : seams_of(now_)) {
      if (bad[Mesh::triangle(seam.one)] != 0 || bad[Mesh::triangle(seam.other)] != 0) cuts.push_back(cut_of(seam, 0.5));
    }
    return cuts;
  }

  /// Splits edges of interfaces on both sides. Says whether there were any. Weights that are linear along an edge keep
  /// its equation in both parts.
  bool split(const std::vector<Cut>& cuts) {
    if (vertices_.empty() && !cuts.empty()) {
      for (const VertexId v : now_.mesh.vertices()) vertices_.push_back(v);
    }
    for (const Cut& cut : cuts) {
      const VertexId first = split_edge_of(cut.from, cut.to, cut.part);
      split_edge_of(cut.copy_of_from, cut.copy_of_to, cut.part);
      for (int copy = 0; copy < 2; ++copy) {
        now_.first_copies.push_back(first);
        vertices_.push_back(VertexId());
      }
    }
    show_all();
    return !cuts.empty();
  }
  VertexId split_edge_of(VertexId a, VertexId b, double part) {
    Mesh& mesh = now_.mesh;
    const HalfedgeId h = mesh.find_halfedge(a, b), back = mesh.find_halfedge(b, a);
    const WeightedPoint p = mesh.point(a), q = mesh.point(b);
    const auto between = [part](double x, double y) { return x + part * (y - x); };
    return split_edge(mesh, h.valid() ? h : back, {between(p.x, q.x), between(p.y, q.y), between(p.w, q.w)});
  }

  /// One report of two runs, one after the other.
  [[nodiscard]] static OptimizeReport joined(OptimizeReport first, OptimizeReport next) {
    next.sweeps += first.sweeps;
    next.seconds += first.seconds;
    next.flips += first.flips;
    next.objective_before = first.objective_before;
    next.bad_before = first.bad_before;
    next.size.before = first.size.before;
    first.history.insert(first.history.end(), next.history.begin(), next.history.end());
    next.history = std::move(first.history);
    return next;
  }

  const Mesh& original_;
  const MetricMesh first_;
  MetricMesh now_;
  IdVector<VertexId, VertexId> vertices_;  ///< of now_, in first_; empty: the same
  OptimizeOptions options_;
  OptimizeHooks hooks_;
  const PlaneRun& run_;
};

/// Runs in the pieces of a mesh.
Expected<OptimizeReport> optimize_pieces(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                                         const PlaneRun& run) {
  const InputNames from_zero;
  auto pieces = pieces_of(mesh, options, hooks.names != nullptr ? *hooks.names : from_zero);
  if (!pieces) return pieces.error();
  PiecesRun pieces_run(mesh, *std::move(pieces), options, hooks, run);
  auto report = pieces_run.run();
  if (!report) return report;
  auto whole = pieces_run.whole();
  if (!whole) return whole.error();
  report->vertices = std::move(whole->vertices);
  report->corner_weights = std::move(whole->corner_weights);
  report->triangle_tensors = std::move(whole->tensors);
  count_vertices(*report, report->vertices, mesh.n_vertices());
  mesh = std::move(whole->mesh);
  return report;
}

}  // namespace

Expected<OptimizeReport> optimize_in_metrics(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                                             const PlaneRun& run) {
  if (auto error = check_metric(options, hooks)) return *std::move(error);
  const bool fits = options.triangle_tensors.size() == mesh.n_triangles();
  const auto metrics = Metrics::of(options.triangle_tensors);
  if (!fits || !metrics || !turns_everywhere(mesh, *metrics)) return optimize_pieces(mesh, options, hooks, run);
  return optimize_with_means(mesh, options, hooks,
                             [&](Mesh& there, const OptimizeOptions& means, const OptimizeHooks& h) {
                               return optimize_pieces(there, means, h, run);
                             });
}

}  // namespace temper
