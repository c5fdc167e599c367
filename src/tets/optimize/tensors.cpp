#include "tets/optimize/tensors.hpp"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "optimize/run/run_in_pieces.hpp"
#include "temper/tets/tensor.hpp"
#include "temper/tets/weights.hpp"
#include "tets/optimize/origins.hpp"
#include "tets/optimize/seam_slide.hpp"
#include "tets/optimize/violations.hpp"

namespace temper::tets {
namespace {

/// The parts of a run in pieces that are of tetrahedra.
struct Tetrahedra {
  using Mesh = TetMesh;
  using Pieces = MetricMesh;
  using Numbers = Origins;
  using Hooks = OptimizeHooks;
  using Report = OptimizeReport;
  using BestSoFar = tets::BestSoFar;
  using BestListener = tets::BestListener;
  using Run = PiecesRun;
  static constexpr bool kTriesWellCentered = false;  // the repairs of a run did
  static constexpr BoundaryVertices kChangesSeams = BoundaryVertices::slide;
  // Part of the tetrahedra. If fewer are bad, rounds end when one leaves as many as it found. Else others may help yet.
  static constexpr double kFewBad = 0.01;
  using Faults = std::pair<std::size_t, std::size_t>;

  const OptimizeOptions& options;
  const OptimizeHooks& hooks;
  const PiecesRun& run_there;

  static auto& numbers_of(auto& found) { return found.origins; }
  static auto& vertices(auto& numbers) { return numbers.vertices; }
  static auto& tensors_of(OptimizeReport& report) { return report.tetrahedra_tensors; }
  static std::array<VertexId, 3> vertices_of(const TetMesh& mesh, HalffaceId h) { return mesh.vertices(h); }

  Expected<OptimizeReport> run(TetMesh& there, const std::vector<VertexId>& frozen) const {
    return run_there(there, {options, hooks, frozen});
  }

  [[nodiscard]] std::vector<TetId> bad(const TetMesh& mesh, Criterion criterion) const {
    const Draft draft(mesh, IdVector<VertexId, Mobility>(mesh.n_vertices()));
    return violating(draft, criterion, hooks.executor);
  }
  /// Tetrahedra at violations of the criterion, then those that are not well-centered.
  [[nodiscard]] Faults faults_of(const TetMesh& mesh) const {
    return {bad(mesh, criterion_of(options.scheme)).size(), bad(mesh, Criterion::well_centered).size()};
  }
  static std::size_t reported(const Faults& faults) { return faults.first; }
  [[nodiscard]] static double largest_gap(const MetricMesh& pieces) { return largest_gap_of_edges(pieces); }

  static std::optional<Origins> change_seams(MetricMesh& /*pieces*/) { return std::nullopt; }
  /// Lets vertices of interfaces slide.
  template <class Whole, class MustStop>
  std::optional<Origins> change_seams_at_bad(MetricMesh& pieces, const Whole& whole, const MustStop& must_stop) const {
    const TetMesh joined = whole();
    if (joined.n_tetrahedra() == 0 || !slide_seams(pieces, joined, options, must_stop)) return std::nullopt;
    return Origins();
  }

  static double n_cells(const TetMesh& mesh) { return static_cast<double>(mesh.n_tetrahedra()); }
  static bool becomes_regular(TetMesh& /*mesh*/) { return true; }  // that is among the criteria
  /// Sets all weights to zero if that leaves fewer bad tetrahedra.
  void settle_weights(TetMesh& mesh) const {
    TetMesh zero = mesh;
    for (const VertexId v : zero.vertices()) zero.set_weight(v, 0);
    if (faults_of(zero) < faults_of(mesh)) mesh = std::move(zero);
  }
};

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

}  // namespace

Expected<OptimizeReport> optimize_in_metrics(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                                             const PiecesRun& run) {
  auto pieces = pieces_of(mesh, options);
  if (!pieces) return pieces.error();
  // New vertices on interfaces, at bad tetrahedra, made more of them bad in all cases of bench/tensors_tets.py.
  if (pieces->is_cut() && options.boundary == BoundaryVertices::split) {
    return InputError{
        ErrorCode::invalid_option, "",
        "`boundary=split` does not split interfaces between tensors. Next: slide, which moves vertices of "
        "the boundary, or keep"};
  }
  return RunInPieces<Tetrahedra>(mesh, *std::move(pieces), options, hooks, run).run(mesh);
}

}  // namespace temper::tets
