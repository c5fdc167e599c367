// Improves a tetrahedral mesh, as temper/optimize.hpp does for triangles: Gauss-Seidel sweeps over the vertices, each
// of which takes its own Newton step in (x, y, z, w).
//
// The energy keeps the orthocenter of each tetrahedron inside (src/tets/energy/star_kernel.hpp). Its γ shrinks from
// sweep to sweep, so that bad tetrahedra can first get better and then become good. Where some stay bad, cavities are
// filled in other ways (src/tets/topology/cavity.hpp).
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "temper/detail/discretization_error.hpp"
#include "temper/detail/progress.hpp"
#include "temper/optimize.hpp"
#include "temper/tets/mesh.hpp"

namespace temper {
class ConvexSolver;
}

namespace temper::tets {

using DiscretizationError = DiscretizationErrorOf<TetMesh, WeightedPoint>;

/// The mesh to keep if the run ends now.
struct BestSoFar {
  const TetMesh& mesh;
  const Origins& origins;  ///< Parts of the mesh in the input, as in OptimizeReport
};
/// A listener for which the mesh is not copied.
using BestListener = BestListenerOf<BestSoFar>;

/// The solvers of other libraries. solvers() returns those of this build (temper/solvers.hpp).
struct Solvers {
  /// Solvers that find the least weights. Empty: a run moves vertices where weights alone would do.
  std::function<std::unique_ptr<LpSolver>()> lp = {};
  std::function<std::unique_ptr<ConvexSolver>()> convex = {};
  std::shared_ptr<const DiscretizationError> error = {};  ///< Model of the errors of the scheme; null: none
};

struct OptimizeHooks {
  Observer observer = {};  ///< Observer of the progress, which may stop the run. Any thread calls it, one at a time
  Executor* executor = nullptr;  ///< Threads; the result does not depend on them
  /// Start of the time limit, as in temper::OptimizeHooks. Absent: the time of the call.
  std::optional<std::chrono::steady_clock::time_point> started = {};
  Solvers solvers = {};
  BestListener best_so_far = {};  ///< Listener that may get each new best mesh
};

/// The objective is the energy at the least γ, or the HOT energy.
struct OptimizeReport : RunReport {
  Origins origins;  ///< Parts of the result in the input
  /// Weight of each corner of each tetrahedron of the result, four each, if its tensors have several spaces. Else
  /// empty.
  std::vector<double> corner_weights;
  std::vector<Tensor3> tetrahedra_tensors;  ///< Tensor of each tetrahedron of the result, if they differ. Else empty.
};
[[nodiscard]] const ReportTable& table_of(const OptimizeReport*);

/// The energy of a tetrahedron that optimize() lowers, +∞ unless it is positive.
[[nodiscard]] double tetrahedron_energy(const std::array<WeightedPoint, 4>& corners, double gamma);

/// Improves the mesh in place. Rows of optimize_table.hpp for tetrahedra say which options have an effect;
/// EnergyKind::F stands for the HOT energy of `star`, and the scheme vertex or cell for its errors. Weights change
/// everywhere. Connectivity changes only around tetrahedra that moves alone leave bad, or with small margins on
/// request, by flips and by vertices that are inserted or removed; not if positions, weights or edges are kept. The
/// boundary, faces between regions, and tagged faces and lines keep their connectivity, unless they may be split. Some
/// vertices keep their position, bit for bit.
///   - They are on the boundary, or on faces between regions.
///   - They are on tagged faces or lines.
///   - They are fixed points.
///   - They are points with a tag other than 0. But a tag that all corners of some tetrahedron share fixes nothing.
/// With BoundaryVertices::slide, vertices of the first two kinds move in their plane or along their straight line, if
/// the parts around them are in one (src/tets/optimize/mobility.hpp). Moves are exact along axes, elsewhere to
/// rounding.
///
/// For a scheme the run then lowers the offsets between primal and dual elements (src/tets/energy/accuracy_energy.hpp).
/// It also lowers the error of the model, if the hooks have one with derivatives and no tetrahedron is bad. The result
/// is the mesh with the least measured error. It is the input if this has no bad tetrahedron and less error.
///
/// For a star the run then lowers its HOT energy (src/tets/energy/hot.hpp), and makes no tetrahedron bad.
///
/// With OptimizeOptions::tetrahedra_tensors all this is in the metrics of the tensors (temper/tets/tensor.hpp), and the
/// report, too. Interfaces are where tensors are no multiples of each other. Their vertices keep their place. If they
/// may slide, up to five runs follow each other while tetrahedra are bad, and between runs these vertices slide on both
/// sides. Weights keep the equations of interfaces. The input's weights there become 0 unless they keep them, and if
/// vertices slide. A linear program at the end may find better ones. The result is the best mesh of all. Error also:
/// BoundaryVertices::split with several tensors.
///
/// Every tetrahedron stays positive. The result never has more tetrahedra with outside orthocenters than the input.
/// Options that are out of range, for triangles alone or contradict each other are an error, which leaves the mesh
/// unchanged.
/// An exception of the observer, or for lack of memory, leaves it empty.
/// O((sweeps + changes) · n).
[[nodiscard]] Expected<OptimizeReport> optimize(TetMesh& mesh, const OptimizeOptions& options = {},
                                                const OptimizeHooks& hooks = {});

}  // namespace temper::tets
