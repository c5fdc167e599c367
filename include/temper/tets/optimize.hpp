// Improves a tetrahedral mesh, as temper/optimize.hpp does for triangles: Gauss-Seidel sweeps over the vertices, each
// of which takes its own Newton step in (x, y, z, w).
//
// The energy keeps the orthocenter of each tetrahedron inside (src/tets/energy/star_kernel.hpp). Its γ shrinks from
// sweep to sweep, so that bad tetrahedra can first get better and then become good. Where some stay bad, cavities are
// filled in other ways (src/tets/topology/cavity.hpp).
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "temper/detail/discretization_error.hpp"
#include "temper/detail/progress.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

struct OptimizeOptions {
  int max_sweeps = 1000;        ///< Largest number of sweeps
  double time_limit = 0;        ///< Time limit of the whole run [s]; 0: none
  bool keep_positions = false;  ///< All vertices stay, and only weights change
  bool keep_weights = false;    ///< All weights stay, and only positions change
  bool keep_edges = false;      ///< The connectivity stays: no flips, no new vertices
  int repair_trials = 100;      ///< Largest number of changes that are tried one by one, after those at once
  Scheme scheme = Scheme::all;  ///< Scheme whose errors the run lowers after that: vertex or cell; others: none
  int accuracy_sweeps = 32;     ///< Largest number of sweeps for this
  int error_steps = 100;        ///< Largest number of steps that lower the error of a model
};

/// The error of a scheme on a mesh and its derivatives, as temper::DiscretizationError for triangles.
class DiscretizationError {
 public:
  virtual ~DiscretizationError() = default;

  /// Returns the mean squared error, without unit; +∞ if the matrix of the scheme is not positive definite. `gradient`,
  /// unless null, gets the derivatives by x, y, z and w of every vertex.
  [[nodiscard]] virtual double squared_error(const TetMesh& mesh,
                                             IdVector<VertexId, WeightedPoint>* gradient) const = 0;
};

struct OptimizeHooks {
  Observer observer = {};        ///< Observer of the progress, which may stop the run
  Executor* executor = nullptr;  ///< Threads; the result does not depend on them
  /// Start of the time limit, as in temper::OptimizeHooks. Absent: the time of the call.
  std::optional<std::chrono::steady_clock::time_point> started = {};
  std::shared_ptr<const DiscretizationError> error = {};  ///< Model of the errors of the scheme; null: none
};

struct OptimizeReport {
  Stopped stopped = Stopped::converged;
  int sweeps = 0;
  double seconds = 0;           ///< Time of the optimization alone [s]
  double objective_before = 0;  ///< Energy of the input, at the least γ
  double objective_after = 0;
  std::size_t vertices_inserted = 0, vertices_removed = 0;
  std::size_t flips = 0;  ///< Changes of connectivity without a new or removed vertex
  /// Number of each vertex in the input, invalid for new ones. Empty: all are the input's.
  IdVector<VertexId, VertexId> vertices;
  std::vector<SweepRecord> history;  ///< History of the sweeps; history[0] is the input
};

/// Improves the mesh in place. Weights change everywhere. Connectivity changes only around tetrahedra that moves alone
/// leave bad, by flips and by vertices that are inserted or removed; not if positions, weights or edges are kept. The
/// boundary, faces between regions, and tagged faces and lines keep their connectivity, and these vertices their
/// position, bit for bit:
///   - on the boundary, and on faces between regions
///   - of tagged faces and lines
///   - points marked with a tag other than 0, unless all corners of some tetrahedron have the same tag: then this tag
///     lists the vertices of a part
///
/// For a scheme the run then lowers the offsets between primal and dual elements (src/tets/energy/accuracy_star.hpp),
/// and the error of the model, if the hooks have one and no tetrahedron is bad. Of the meshes before and after each
/// stage, it returns the one with the least error by the model. An input without bad tetrahedra is one of them.
///
/// Every tetrahedron stays positive. The result never has more tetrahedra with outside orthocenters than the input.
/// Wrong options (numbers < 0, positions and weights both kept) are an error, which leaves the mesh unchanged.
/// O((sweeps + changes) · n).
[[nodiscard]] Expected<OptimizeReport> optimize(TetMesh& mesh, const OptimizeOptions& options = {},
                                                const OptimizeHooks& hooks = {});

}  // namespace temper::tets
