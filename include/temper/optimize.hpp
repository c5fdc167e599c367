// Algorithm 1 of the paper, in its production form: Gauss-Seidel over the vertices, each with its own
// Newton step in (x, y, w), edges flipped as soon as they stop being regular.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "temper/energy.hpp"
#include "temper/mesh.hpp"
#include "temper/progress.hpp"

namespace temper {

class Executor;

/// How one vertex is improved.
enum class Solver {
  newton,       ///< joint (x, y, w), analytic gradient and Hessian, one trial a step, over-relaxed
  golden,       ///< the paper's Algorithm 5: finite differences and golden section; three position searches, one weight
                ///< search
  alternating,  ///< Newton in (x, y), then Newton in w
};

/// How far a step may go past the point where an edge must flip (§2.4).
enum class FlipLimit {
  unlimited,  ///< wherever the energy leads; edges are flipped afterwards
  before,     ///< short of the first flip: the connectivity never changes
  at,         ///< to the first flip
  after,      ///< past it by an overshoot that shrinks each sweep: 1.1, 1.01, 1.001, …
};

/// When edges are flipped.
enum class FlipTiming { immediate, deferred };

/// Which unknowns of a vertex move.
enum class Unknowns { positions_and_weights, positions, weights };

/// Vertices of constrained edges (region interfaces, tagged lines).
enum class InterfaceVertices {
  fixed,    ///< stay where they are
  sliding,  ///< move along the line when their two constrained edges are collinear
};

enum class StoppingRule {
  relative,  ///< E fell by less than tolerance × E in one sweep
  paper,     ///< mean energy per triangle fell by less than tolerance
};

struct OptimizeOptions {
  std::string_view energy = "BP";  ///< a name of the registry
  int star = 1;                    ///< 0, 1 or 2
  /// γ of E_BP. Absent: relative to each edge, shrinking from 0.5 to 0.003; when triangles stay bad, a second attempt
  /// from 2. Given: constant.
  std::optional<Softening> gamma = {};
  /// −h° of E_BHs. Absent: relative, just beyond the worst h/ℓ of the mesh, shrinking as that improves. Given:
  /// constant.
  std::optional<Softening> h0 = {};
  BoundaryTreatment boundary = BoundaryTreatment::as_is;  ///< of E_F only

  Solver solver = Solver::newton;
  Unknowns unknowns = Unknowns::positions_and_weights;
  int weights_from = 0;  ///< i_w: first sweep that changes weights
  bool flips = true;     ///< false: the connectivity is frozen and no step may make an edge non-regular
  FlipTiming flip_timing = FlipTiming::immediate;
  std::optional<FlipLimit> flip_limit =
      {};                   ///< absent: unlimited for barriers (a flipping step must pay), after for HOT
  double overshoot = 1.1;   ///< of FlipLimit::after
  double relaxation = 1.7;  ///< over-relaxation of Newton steps, in (0, 2)
  InterfaceVertices interfaces = InterfaceVertices::fixed;
  std::optional<std::size_t> anchor =
      {};  ///< vertex whose weight is shifted to 0 after each sweep (Algorithm 1, line 17)

  int max_sweeps = 1000;
  double tolerance = 1e-5;
  StoppingRule stopping = StoppingRule::relative;
  double time_limit = 0;              ///< seconds; 0: none
  std::uint64_t seed = 1;             ///< of the jitter that frees symmetric grids
  const InputNames* names = nullptr;  ///< the user's numbering, for errors
  Executor* executor = nullptr;       ///< threads for sums over the mesh; results do not depend on it
};

enum class Stopped { converged, max_sweeps, time_limit, cancelled };
[[nodiscard]] std::string_view name(Stopped stopped);

struct OptimizeReport {
  Stopped stopped = Stopped::converged;
  int sweeps = 0;
  std::size_t flips = 0;
  std::size_t vertices_removed = 0;
  std::size_t vertices_inserted = 0;
  double seconds = 0;         ///< the optimisation alone
  double initial_energy = 0;  ///< of the input, at the final γ
  double final_energy = 0;
  std::vector<SweepRecord> history;  ///< history[0] is the input
  std::vector<std::string> notes;    ///< what the user should know, in sentences
};

/// Improves the mesh in place. The domain boundary, fixed vertices and constrained edges stay, bit for bit;
/// every triangle stays counter-clockwise. Never returns a worse mesh than the input's. Errors, which leave the
/// mesh as it was: an unknown energy, star or value out of range; weights that hide a vertex; a mesh outside
/// the barrier of E_BH or E_BHs. O(sweeps · n).
[[nodiscard]] Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options = {},
                                                const Observer& observer = {});

}  // namespace temper
