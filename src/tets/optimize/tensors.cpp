#include "tets/optimize/tensors.hpp"

#include <string>
#include <utility>
#include <vector>

#include "base/sort_unique.hpp"
#include "feasibility/demand.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/feasibility.hpp"
#include "temper/tets/tensor.hpp"
#include "temper/tets/weights.hpp"
#include "tets/optimize/violations.hpp"

namespace temper::tets {
namespace {

// Linear programs of larger meshes are about the neighborhoods of bad tetrahedra alone.
constexpr std::size_t kWhole = 500;
// Difference of crossings up to which weights keep the equations of interfaces: rounding of a file.
constexpr double kSameCrossing = 1e-9;

Expected<MetricMesh> pieces_of(const TetMesh& mesh, const OptimizeOptions& options) {
  const std::vector<Tensor3>& tensors = options.tetrahedra_tensors;
  if (tensors.size() == 1) {
    const auto metric = Metric::of(tensors.front());
    if (!metric) return metric.error();
    return mapped(mesh, *metric);
  }
  const auto metrics = Metrics::of(tensors);
  if (!metrics) return metrics.error();
  return mapped(mesh, *metrics, options.corner_weights);
}

/// The vertices of interfaces.
std::vector<VertexId> interface_vertices(const MetricMesh& pieces) {
  std::vector<VertexId> all;
  for (const SeamFace& seam : seams_of(pieces)) {
    for (const HalffaceId h : {seam.one, seam.other}) {
      for (const VertexId v : pieces.mesh.vertices(h)) all.push_back(v);
    }
  }
  sort_unique(all);
  return all;
}

/// The run of a mesh in pieces.
class RunInMetrics {
 public:
  RunInMetrics(const TetMesh& original, MetricMesh pieces, const OptimizeOptions& options, const OptimizeHooks& hooks)
      : original_(original), first_(std::move(pieces)), now_(first_), options_(options), hooks_(hooks) {
    options_.tetrahedra_tensors.clear();
    options_.corner_weights.clear();
    if (hooks.best_so_far) listen(hooks.best_so_far);
  }

  Expected<OptimizeReport> run(const PiecesRun& run_there) {
    const bool comes_back = options_.change == Change::least && n_bad(now_.mesh) == 0;
    const bool goes_on = first_.is_cut() && !comes_back;
    if (goes_on && largest_gap_of_edges(now_) > kSameCrossing) flatten();
    const std::vector<VertexId> frozen = interface_vertices(now_);
    TetMesh there = now_.mesh;
    OptimizeReport report = run_there(there, {options_, hooks_, frozen});
    now_ = with_mesh(now_, std::move(there), report.origins.vertices);
    if (goes_on && !stopped_early(report.stopped)) reweigh(report);
    auto whole = mapped_back(now_, original_, first_, report.origins.vertices);
    if (!whole) return whole.error();
    report.origins.vertices = std::move(whole->vertices);
    report.corner_weights = std::move(whole->corner_weights);
    report.tetrahedra_tensors = std::move(whole->tensors);
    count_vertices(report, report.origins.vertices, original_.n_vertices());
    result_ = std::move(whole->mesh);
    return report;
  }
  /// The mesh in its own space, after a run.
  [[nodiscard]] TetMesh result() { return std::move(result_); }

 private:
  void listen(const BestListener& listener) {
    hooks_.best_so_far = [this, listener](const auto& best) {
      listener([&](const auto& use) {
        best([&](const BestSoFar& found) {
          const MetricMesh there = with_mesh(now_, found.mesh, found.origins.vertices);
          auto whole = mapped_back(there, original_, first_, found.origins.vertices);
          if (whole) use({whole->mesh, {whole->vertices, found.origins.faces, found.origins.lines}});
        });
      });
    };
  }

  [[nodiscard]] std::size_t n_bad(const TetMesh& mesh) const {
    const Draft draft(mesh, IdVector<VertexId, Mobility>(mesh.n_vertices()));
    return violating(draft, criterion_of(options_.scheme), hooks_.executor).size();
  }

  /// Sets the weights of interfaces to zero, or all if that leaves fewer bad tetrahedra.
  void flatten() {
    TetMesh zero = now_.mesh;
    for (const VertexId v : zero.vertices()) zero.set_weight(v, 0);
    for (const VertexId v : interface_vertices(now_)) now_.mesh.set_weight(v, 0);
    if (n_bad(zero) < n_bad(now_.mesh)) now_.mesh = std::move(zero);
  }

  /// Finds weights that violate the criterion least and keep the equations of interfaces. Takes them if fewer
  /// tetrahedra are bad.
  void reweigh(OptimizeReport& report) {
    const std::size_t before = n_bad(now_.mesh);
    const bool may_change = options_.unknowns != temper::Unknowns::positions;
    if (!hooks_.solvers.lp || !may_change || before == 0) return;
    WeightOptions wanted;
    wanted.goal = WeightGoal::elastic;
    wanted.constraints = constraints_of(criterion_of(options_.scheme));
    wanted.from_input = true;
    wanted.whole = kWhole;
    const auto found = find_weights(now_, *hooks_.solvers.lp(), wanted);
    if (!found) return;
    TetMesh weighted = now_.mesh;
    for (const VertexId v : weighted.vertices()) weighted.set_weight(v, found->weights[v]);
    const std::size_t after = n_bad(weighted);
    if (after >= before) return;
    now_.mesh = std::move(weighted);
    report.notes.push_back("weights of interfaces from a linear program lowered the number of bad tetrahedra from " +
                           std::to_string(before) + " to " + std::to_string(after));
  }

  const TetMesh& original_;
  const MetricMesh first_;
  MetricMesh now_;
  OptimizeOptions options_;
  OptimizeHooks hooks_;
  TetMesh result_;
};

}  // namespace

Expected<OptimizeReport> optimize_in_metrics(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                                             const PiecesRun& run) {
  auto pieces = pieces_of(mesh, options);
  if (!pieces) return pieces.error();
  if (pieces->is_cut() && options.boundary == BoundaryVertices::split) {
    return InputError{ErrorCode::invalid_option, "",
                      "`boundary=split` would split interfaces between tensors on one side alone. Next: keep or slide"};
  }
  RunInMetrics in_metrics(mesh, *std::move(pieces), options, hooks);
  auto report = in_metrics.run(run);
  if (report) mesh = in_metrics.result();
  return report;
}

}  // namespace temper::tets
