// Algorithm 1 of the paper. By default in its production form: Gauss-Seidel over the vertices, each with its own
// Newton step in (x, y, w), edges flipped as soon as they stop being regular. paper_method() gives the paper's own.
//
// Options come in groups: OptimizeOptions are those of every run, AccuracyOptions those of its second objective,
// PaperSwitches those of the algorithm. Each has a row in optimize_table.hpp, by which it is checked, and from which
// the command line, Python and the documentation take it. Who listens to a run is apart from them, in OptimizeHooks.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/discretization_error.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/progress.hpp"
#include "temper/detail/size.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/detail/trace.hpp"
#include "temper/energy.hpp"
#include "temper/mesh.hpp"
#include "temper/regularity.hpp"

namespace temper {

class Executor;
class LpSolver;

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

/// When edges that have stopped being regular are flipped.
enum class Flips {
  immediate,  ///< at once
  deferred,   ///< in rounds, after the inner sweeps; until then edges may be not regular
  none,       ///< never: the connectivity is frozen, and no step may make an edge non-regular
};

/// Which unknowns of a vertex move.
enum class Unknowns { positions_and_weights, positions, weights };

/// Vertices of constrained edges (region interfaces, tagged lines).
enum class InterfaceVertices {
  fixed,    ///< stay where they are
  sliding,  ///< move along the line when their two constrained edges are collinear
};

/// What may become of the boundary of the domain. Its shape stays, whatever is chosen, and so do its corners.
enum class BoundaryVertices {
  keep,   ///< the same vertices, bit for bit
  slide,  ///< a vertex whose two boundary edges are in one line may move along it; never corners, or ends of interfaces
  split,  ///< long edges of boundary and lines beside short ones are cut before the sweeps, and triangles with all
          ///< corners there get a vertex inside; the vertices that were there stay bit for bit
};

/// When a new position or weight is seen by the neighbors (§5.2, §6.6.2).
enum class Updates {
  immediate,  ///< at once
  deferred,   ///< at the end of the sweep: each is optimized against those of the sweep before
};

/// How often a sweep visits a vertex (§5.2).
enum class Visits {
  once,   ///< for its position and its weight
  twice,  ///< the positions of all vertices first, then the weights of all
};

/// How far golden section searches for a position: the paper's "patch radius", which it does not define (§5.2).
enum class SearchRadius {
  rms,  ///< the root mean square distance to the neighbors
  max,  ///< the distance to the farthest one
  min,  ///< to the nearest one
};

/// Removing vertices besides the collapses of Algorithm 2.
enum class Removal {
  none,
  patch,   ///< those whose patch is better without them (Algorithm 1, line 15)
  weight,  ///< those whose weight is so far below the mean of their neighbors' that they are on the way to be hidden
           ///< (§7)
};

/// By what a patch with k triangles is compared with the k − 2 that fill it without its center.
enum class RemovalMeasure {
  sum,     ///< E(P∖p) < E(P), the paper's; for barriers any removal lowers it
  mean,    ///< energy per triangle
  excess,  ///< energy beyond that of equilateral triangles of the same areas
};

/// Steps that would turn a triangle over.
enum class Inversion {
  refuse,    ///< are not taken, and searches end at nine tenths of the way to the first of them
  allow,     ///< are, as in the paper: energies extrapolate, and the mesh may end as a tangle (a "HOT mess")
  infinite,  ///< of barriers: their energy is +∞ there, so that searches step over such places, but never onto one
};

/// What is done, one neighborhood at a time, about triangles that sweeps of a barrier leave not well-centered.
enum class Repair {
  none,
  perturb,  ///< sweeps from a larger γ and random kicks; every vertex stays. Not where γ, h° or a solver is the user's
  vertices,  ///< the same, and vertices are removed and inserted
};

/// In which order a sweep visits the vertices.
enum class SweepOrder {
  hilbert,  ///< along a Hilbert curve
  input,    ///< as numbered
  reverse,  ///< last number first
  random,   ///< shuffled once by the seed
};

enum class StoppingRule {
  relative,  ///< E changed by less than tolerance × E in one sweep, or has not been lower for 25
  paper,     ///< mean energy per triangle fell by less than tolerance, or rose
};

/// Of Objective::accuracy. With L the squared length of an edge, G that times its dual length over its length, H the
/// difference where G is the sum of the heights times the length on its two sides, δw the difference of the weights of
/// its ends and s the local size there, what is lowered is
///
///     E = Σ_edges s⁻² (G/L) [ (α L² + β G²)/4 + ¾ c (α δw² + β H²) ]
///
/// which for c = 1 is E_F / s² (eq. 2 of the paper): a moment of edge and dual, which every mesh of this size has, and
/// c times as much of the offset between their middles, which is what a diagonal ★ errs by at first order. The star
/// picks α and β. docs/accuracy.md derives it. [length²]
struct AccuracyOptions {
  std::optional<double> offset_factor = {};  ///< c ≥ 0: 1 is HOT itself. Absent: by the scheme
  /// Of H² of edges on the boundary, which no mesh avoids: a smaller one is better for vertex-centered solvers, a
  /// larger one for cell-centered ones. ≥ 0. Absent: by the scheme.
  std::optional<double> boundary_offset_factor = {};
  /// ε: all h/ℓ, d/ℓ and 1 − d/ℓ stay above it. 0 < ε < 1/4 (equilateral: h/ℓ = 0.289). Absent: by the scheme.
  std::optional<double> margin = {};
  /// Interior edges stay longer than so many times the local size, the mean of those at their ends, and where they are
  /// shorter become longer, as far as the connectivity and what is fixed allow; Repair::vertices removes and inserts
  /// vertices for them. In [0, 0.95]; equilateral triangles have 1. 0: no limit.
  double min_edge = 0;
  double min_dual = 0;     ///< the same of their dual edges; in [0, 0.55], of 1/√3
  double barrier = 0.003;  ///< μ > 0 of the logarithms that keep them there, in units of s² a triangle
  /// At most, after those that make every triangle well-centered; three times as many where lengths are asked for. ≥ 0
  int sweeps = 30;
  double tolerance = 1e-5;  ///< a sweep that changes E and barrier by less than this part of E is the last. ≥ 0
};

/// What AccuracyOptions are for a scheme where they are absent.
struct SchemeWeights {
  double offset_factor, boundary_offset_factor, margin;
};
/// By measurement, docs/accuracy.md.
[[nodiscard]] SchemeWeights scheme_weights(Scheme scheme);

/// Of Objective::solver_error, which lowers  ln mean(errors over those at its start) + κ ln(E + barrier)  over all
/// vertices at once, E and its barrier those of AccuracyOptions.
struct SolverErrorOptions {
  double offset_share = 1;  ///< κ ≥ 0: what keeps other errors from rising
  int steps = 200;          ///< at most; ≥ 0
  double tolerance = 0.01;  ///< ten steps that gain less than this of the sum of logarithms are the last. ≥ 0
};

/// The switches of Algorithm 1: where the paper offers a choice, or does otherwise than the production form. The
/// defaults are the latter's, paper_method() has the paper's.
struct PaperSwitches {
  /// γ of E_BP. Absent: relative to each edge, shrinking from 0.5, or from 1 where a quarter of 100 or more
  /// triangles is bad, to 0.003, there as soon as none is; when some stay bad, a second start from 2. Given:
  /// constant.
  std::optional<LengthParameter> gamma = {};
  /// −h° of E_BHs. Absent: relative, just beyond the worst h/ℓ of the mesh, shrinking as that improves. Given:
  /// constant.
  std::optional<LengthParameter> h0 = {};
  BoundaryTreatment boundary_treatment = BoundaryTreatment::as_is;  ///< of E_F only

  Solver solver = Solver::newton;
  /// Over-relaxation of Newton steps, in (0, 2). Absent: 1.7, but 1.97 while γ shrinks from 1. Given: constant.
  std::optional<double> relaxation = {};
  SweepOrder order = SweepOrder::hilbert;
  std::uint64_t seed = 1;  ///< of SweepOrder::random, of the jitter that frees symmetric grids, and of repairs
  int weights_from = 0;    ///< i_w: first sweep that changes weights
  /// Deferred: not with Solver::newton, which is joint, unless positions are deferred too.
  Updates weight_updates = Updates::immediate;
  /// Deferred: all unknowns from the state at the beginning of the sweep (Jacobi instead of Gauss-Seidel); weights, if
  /// they move, have to be deferred too. With Inversion::refuse a vertex stays whose neighbors have moved so that it
  /// would turn a triangle over.
  Updates position_updates = Updates::immediate;
  Visits visits = Visits::once;
  SearchRadius search_radius = SearchRadius::rms;  ///< R of Solver::golden, and of the search for E_c
  double weight_search_radius = 1;  ///< Solver::golden searches for a weight as far as this times R². > 0
  VertexId anchor = {};  ///< whose weight is shifted to 0 after each sweep (Algorithm 1, line 17); invalid: none

  int inner = 1;  ///< with deferred flips: most sweeps before edges are flipped; 0: until they converge
  int outer = 0;  ///< with deferred flips: most rounds of sweeps and flips; 0: until no flips are needed
  std::optional<FlipLimit> flip_limit =
      {};                         ///< absent: unlimited for barriers (a flipping step must pay), after for HOT
  double overshoot = 1.1;         ///< k of Algorithm 5, with FlipLimit::after; > 0
  double overshoot_factor = 0.1;  ///< by which k − 1 shrinks from sweep to sweep, to ±1e-6; 1: k is constant. In [0, 1]
  Inversion inversion = Inversion::refuse;
  HiddenPolicy hidden = HiddenPolicy::undo;

  // Only with these are vertices removed: never on the boundary, on constrained edges or where fixed.
  std::optional<int> collapse_from = {};        ///< i_c: first sweep with short-edge collapses (Algorithm 2)
  EnergyKind collapse_energy = EnergyKind::dT;  ///< E_c: F, T or dT
  double collapse_ratio = 0.1;  ///< of the distance to the nearest neighbor to that one's shorter edge on the link
  Removal removal = Removal::none;
  RemovalMeasure removal_measure = RemovalMeasure::mean;  ///< of insertions too
  double removal_margin = 0.1;                            ///< by which the patch must be better, relative
  double hidden_threshold = 1;                            ///< Removal::weight: how far below, relative to R², rms. > 0
  int removal_from = 10;                                  ///< first sweep with removals
  /// First sweep after which vertices are inserted: at the orthocenters of triangles of large energy, where the mesh is
  /// better with them (§7). Absent: never.
  std::optional<int> insertion_from = {};
  double insertion_ratio = 4;  ///< an energy above so many times the mean is large; > 1

  /// What the first sweeps lower, before `energy`: "E_∂T, then switching to E_BP" (§7). Absent: `energy` from the first
  /// sweep on; but E_ODT for ten sweeps where the accuracy objective is for one scheme, the mesh in the plane and
  /// without weights, and steps are Newton's with flips at once. The γ and h° of both are the same options.
  std::optional<EnergyKind> first_energy = {};
  int switch_at = 20;  ///< the first sweep that lowers `energy`; an earlier one when the first energy has converged
  double tolerance = 1e-5;
  StoppingRule stopping = StoppingRule::relative;

  friend bool operator==(const PaperSwitches&, const PaperSwitches&) = default;
};

/// What other libraries bring: temper::solvers() has what this build has (temper/solvers.hpp).
struct Solvers {
  /// For repairs: solves for the weights of a place that sweeps leave bad. Empty: repairs do without.
  std::function<std::unique_ptr<LpSolver>()> lp = {};
  /// The model of the errors of a scheme on a mesh. Empty: accuracy is lowered instead of the error, and a note says
  /// so.
  std::function<Expected<std::shared_ptr<const DiscretizationError>>(const Mesh& mesh, Scheme scheme)>
      discretization_error = {};
};

struct OptimizeOptions {
  /// accuracy: the run lowers `energy`, which has to be a barrier, until all margins are above accuracy.margin, or it
  /// ends; then E of AccuracyOptions, with the connectivity as it is; error: after that the errors of the solver. A
  /// mesh that has all margins at first goes on to the second phase at once, unless its boundary is to be split.
  /// `solver`, `order`, `tolerance` and `stopping` are of the first phase. energy: `energy` is lowered
  /// to the end. Absent: objective_of().
  std::optional<Objective> objective = {};
  Scheme target = Scheme::all;  ///< of Objective::accuracy and error
  AccuracyOptions accuracy = {};
  SolverErrorOptions solver_error = {};
  EnergyKind energy = EnergyKind::BP;
  Star star = Star::one;  ///< whose error is to be small; sweeps before Objective::accuracy are for ★1
  Unknowns unknowns = Unknowns::positions_and_weights;
  Flips flips = Flips::immediate;
  BoundaryVertices boundary = BoundaryVertices::keep;
  double boundary_ratio =
      4;  ///< BoundaryVertices::split: most between the lengths of edges that meet there; at least 2
  InterfaceVertices interfaces = InterfaceVertices::fixed;
  std::optional<SizeField> size_field = {};  ///< that sizes are compared with; absent: the input's own
  /// B ≥ 1: no step or flip takes the local size of a vertex out of [s/B, B s], s the size field there, or further out
  /// than it is. Removals, insertions, deferred flips, and those that make the input regular are not asked; a repair
  /// asks, but sees only the triangles of its neighborhood. With a band sweeps go vertex by vertex, on one
  /// thread. Absent: no limit.
  std::optional<double> size_band = {};
  Repair repair = Repair::perturb;
  int repair_trials = 20000;  ///< most edits that are tried, each on a copy of a neighborhood; 1 to 3 ms each; a
                              ///< linear program counts as 20
  /// A constant diffusion tensor K: the mesh is improved in the plane of its metric (temper/detail/tensor.hpp). The
  /// report and snapshots are of that plane. Absent: K = 1.
  std::optional<Tensor> tensor = {};
  int max_sweeps = 1000;  ///< each repair counts as a sweep of its own
  double time_limit = 0;  ///< of all of it, seconds; 0: none
  PaperSwitches paper = {};
};

/// What a run lowers: the objective of the options. If that is absent, accuracy; or `energy` alone if `energy` or
/// switches other than `order` and `seed` are not the default ones.
[[nodiscard]] Objective objective_of(const OptimizeOptions& options);

/// Says whether a run asks for a model of errors: Objective::solver_error lowers them. On a mesh of the plane for one
/// scheme, of at most kMostJudged vertices, an absent objective is the error, and with accuracy the model is the judge:
/// the mesh of least error is kept, the input too if it is well-centered.
inline constexpr std::size_t kMostJudged = 20'000;
[[nodiscard]] bool wants_error_model(const OptimizeOptions& options, const Mesh& mesh);

/// The options of the paper's Algorithm 1 with all its parts: golden section, flips after the inner iterations have
/// converged, unlimited steps, inversions allowed, hidden vertices kept, collapses and the patch test from the first
/// sweep, vertex 0 as anchor, γ = 1, vertices in their order, convergence by mean energy.
[[nodiscard]] OptimizeOptions paper_method();
/// The options of two older methods of §1.2, for comparison. Both move positions alone and keep edges Delaunay; the
/// weights have to be equal.
/// Optimal Delaunay triangulations (Chen and Xu 2004): E_ODT.
[[nodiscard]] OptimizeOptions odt_method();
/// Centroidal Voronoi tessellations (Du, Faber and Gunzburger 1999): E_F for ★0, the moment of the Voronoi cells about
/// their vertices, which Lloyd's iterations lower.
[[nodiscard]] OptimizeOptions cvt_method();

/// The mesh as it is at one moment of a run.
struct Snapshot {
  enum class Moment { start, after_sweep, before_flips, after_flips };
  Moment moment = Moment::start;
  int sweep = 0;      ///< sweeps done
  int outer = 0;      ///< rounds of deferred flips done
  double energy = 0;  ///< of the mesh, at the γ of the sweep
  const Mesh& mesh;   ///< in the user's units; may hold inverted triangles when those are allowed
  const IdVector<VertexId, VertexId>& vertices;  ///< number in the input of each vertex; invalid: inserted
};

/// The mesh that is worth keeping, should the run end now.
struct BestSoFar {
  const Mesh& mesh;                              ///< in the user's units
  const IdVector<VertexId, VertexId>& vertices;  ///< as OptimizeReport::vertices
};
/// `best` passes the best valid mesh so far to its argument, and nothing if there is none yet. It copies the mesh.
using BestListener = std::function<void(const std::function<void(const std::function<void(const BestSoFar&)>&)>& best)>;

/// What a run works with, and who listens: the result does not depend on any of it, unless the observer stops the run.
struct OptimizeHooks {
  Executor* executor = nullptr;  ///< threads for sweeps and sums
  /// Of the ranks that make this run together. All have the same mesh and options, and each gets the result.
  /// The observer and the time limit are those of rank 0. Null: this process is alone.
  Communicator* communicator = nullptr;
  const InputNames* names = nullptr;                    ///< the user's numbering, for errors and notes
  Observer observer = {};                               ///< hears of the progress, and may stop the run
  Tracer tracer = {};                                   ///< sees every event of the run
  std::function<void(const Snapshot&)> snapshots = {};  ///< sees the mesh between sweeps; a copy each time
  BestListener best_so_far = {};  ///< may save the best mesh so far: called between sweeps and between repairs
  /// Nobody looks at the mesh before optimize() has returned, observers neither: what it can be without meanwhile is
  /// released, 24 bytes a vertex.
  bool exclusive = false;
  Solvers solvers = {};
  /// The moment from which the time limit counts: a program may have read files before, and writing them may take as
  /// long. Absent: the call.
  std::optional<std::chrono::steady_clock::time_point> started = {};
};

enum class Stopped {
  converged,
  max_sweeps,
  max_outer,
  time_limit,
  canceled,
  tangled,      ///< triangles are inverted (Inversion::allow): no flips can make the mesh regular
  sweep_limit,  ///< all sweeps of AccuracyOptions, or steps of SolverErrorOptions, are made: a normal end
  hidden,       ///< deferred flips hid a vertex that may not be: the mesh is the last or best one that was regular
};
[[nodiscard]] std::string_view name(Stopped stopped);
/// Whether the caller ended the run, by its time limit or by its observer: a run with more time would have gone on.
[[nodiscard]] constexpr bool stopped_early(Stopped stopped) {
  return stopped == Stopped::time_limit || stopped == Stopped::canceled;
}

/// What a run did to the sizes: both compared with the size field.
struct SizeChange {
  SizeReport before, after;
};

struct OptimizeReport {
  Stopped stopped = Stopped::converged;
  int sweeps = 0;
  std::size_t flips = 0;
  std::size_t vertices_removed = 0;
  std::size_t vertices_inserted = 0;
  /// Number in the input of each vertex, in its order. Inserted vertices follow, in the order in which they came, with
  /// an invalid one. Empty when no vertex was removed or inserted.
  IdVector<VertexId, VertexId> vertices;
  /// Vertices that HiddenPolicy::keep left without a power cell; none while triangles are inverted.
  std::vector<VertexId> hidden;
  Objective objective = Objective::accuracy;  ///< that the run lowered
  double seconds = 0;                         ///< the optimization alone
  double objective_before = 0;  ///< of the input, at the final γ; with Objective::accuracy that of AccuracyOptions,
                                ///< its edges taken absolute, with the same sizes before and after; where there is an
                                ///< error model the root mean square error
  double objective_after = 0;
  SizeChange size;
  std::vector<SweepRecord> history;  ///< history[0] is the input
  std::vector<std::string> notes;    ///< what the user should know, in sentences
};

/// Improves the mesh in place. The domain boundary, fixed vertices and constrained edges stay, bit for bit, unless
/// `boundary` and `interfaces` say otherwise; every triangle stays counter-clockwise. Never returns a worse
/// mesh than the input, its edges flipped to be regular where that can be. Compared are, in this order: inverted
/// triangles; edges that are not regular, unless hidden vertices are kept; for barriers, triangles that are not
/// well-centered; for accuracy, whether margins are kept; the energy. So a HOT energy may leave more triangles not
/// well-centered, which a note says. Errors, which leave the mesh as it was: a value out of range; weights that hide a
/// vertex; a mesh outside the barrier of E_BH or E_BHs. O(sweeps · n).
[[nodiscard]] Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options = {},
                                                const OptimizeHooks& hooks = {});

}  // namespace temper
