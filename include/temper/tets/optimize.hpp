// Improves a tetrahedral mesh, as temper/optimize.hpp does for triangles: Gauss-Seidel sweeps over the vertices, each
// of which takes its own Newton step in (x, y, z, w).
//
// The energy keeps the orthocenter of each tetrahedron inside (src/tets/energy/star_kernel.hpp). Its γ shrinks from
// sweep to sweep, so that bad tetrahedra can first get better and then become good.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "temper/detail/progress.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

struct OptimizeOptions {
  int max_sweeps = 1000;        ///< Largest number of sweeps
  double time_limit = 0;        ///< Time limit of the whole run [s]; 0: none
  bool keep_positions = false;  ///< All vertices stay, and only weights change
  bool keep_weights = false;    ///< All weights stay, and only positions change
};

struct OptimizeHooks {
  Observer observer = {};  ///< Observer of the progress, which may stop the run
  /// Start of the time limit, as in temper::OptimizeHooks. Absent: the time of the call.
  std::optional<std::chrono::steady_clock::time_point> started = {};
};

struct OptimizeReport {
  Stopped stopped = Stopped::converged;
  int sweeps = 0;
  double seconds = 0;           ///< Time of the optimization alone [s]
  double objective_before = 0;  ///< Energy of the input, at the least γ
  double objective_after = 0;
  std::vector<SweepRecord> history;  ///< History of the sweeps; history[0] is the input
};

/// Improves the mesh in place. The connectivity stays. Weights change everywhere. These vertices keep their position,
/// bit for bit:
///   - on the boundary, and on faces between regions
///   - of tagged faces and lines
///   - marked points, unless marks list all corners of a tetrahedron
///
/// Every tetrahedron stays positive. The result never has more tetrahedra with outside orthocenters than the input.
/// Wrong options (max_sweeps < 0, time_limit < 0, positions and weights both kept) are an error, which leaves the mesh
/// unchanged. O(sweeps · n).
[[nodiscard]] Expected<OptimizeReport> optimize(TetMesh& mesh, const OptimizeOptions& options = {},
                                                const OptimizeHooks& hooks = {});

}  // namespace temper::tets
