// Algorithm 1 of the paper. By default it runs in its production form: Gauss-Seidel over the vertices. Each vertex
// takes its own Newton step in (x, y, w), and edges flip as soon as they stop being regular. options_for("paper") gives
// the paper's form.
//
// Options come in groups. OptimizeOptions has the options of every run, AccuracyOptions the options of the accuracy
// objective, PaperSwitches the options of the algorithm, and TetrahedraOptions what tetrahedra alone have
// (temper/tets/optimize.hpp). Each has a row in optimize_table.hpp. It defines the checks, and the command line, Python
// and the documentation are made from it. OptimizeHooks has the listeners of a run.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
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

/// The method that improves one vertex.
enum class Solver {
  newton,  ///< Joint Newton step in (x, y, w): analytic gradient and Hessian, one trial per step, over-relaxed
  golden,  ///< The paper's Algorithm 5: finite differences and golden section; three searches for position, one for
           ///< weight
  alternating,  ///< Newton step in (x, y), then Newton step in w
};

/// The limit of a step beyond the point where an edge must flip (§2.4).
enum class FlipLimit {
  unlimited,  ///< The energy alone decides; edges are flipped afterwards
  before,     ///< The step ends before the first flip: the connectivity never changes
  at,         ///< The step ends at the first flip
  after,      ///< The step ends beyond it by an overshoot that shrinks each sweep: 1.1, 1.01, 1.001, …
};

/// The time at which edges flip after they stop being regular.
enum class Flips {
  immediate,  ///< At once
  deferred,   ///< In rounds, after the inner sweeps; until then edges may be not regular
  none,       ///< Never: the connectivity is frozen, and no step may make an edge non-regular
};

/// The unknowns of a vertex that may change.
enum class Unknowns { positions_and_weights, positions, weights };

/// The treatment of vertices of constrained edges (region interfaces, tagged lines).
enum class InterfaceVertices {
  fixed,    ///< Stay at their place
  sliding,  ///< Move along the line if their two constrained edges are collinear
};

/// The treatment of the boundary of the domain. Its corners stay. Its shape stays, except at bends of sliding lines of
/// curved surfaces.
enum class BoundaryVertices {
  keep,   ///< Keep the same vertices, bit for bit
  slide,  ///< Vertices whose two boundary edges are collinear may move along them; corners and ends of interfaces stay
  split,  ///< Cut long edges of boundary and lines next to short ones before the sweeps, and insert a vertex in
          ///< triangles with all corners there. The old vertices stay bit for bit
};

/// The part of the mesh that a run may change.
enum class Change {
  all,    ///< The whole mesh
  least,  ///< Places that violate the criterion of the scheme (temper/detail/criterion.hpp). All else stays, bit for
          ///< bit
};

/// The time at which neighbors see a new position or weight (§5.2, §6.6.2).
enum class Updates {
  immediate,  ///< At once
  deferred,   ///< At the end of the sweep: each vertex uses the values of the sweep before
};

/// The number of visits to a vertex in one sweep (§5.2).
enum class Visits {
  once,   ///< One visit for its position and its weight
  twice,  ///< The positions of all vertices first, then all weights
};

/// The radius in which golden section searches for a position: the paper's "patch radius", which it does not define
/// (§5.2).
enum class SearchRadius {
  rms,  ///< Root mean square distance to the neighbors
  max,  ///< Distance to the farthest neighbor
  min,  ///< Distance to the nearest neighbor
};

/// Removal of vertices in addition to the collapses of Algorithm 2.
enum class Removal {
  none,
  patch,   ///< Remove a vertex if its patch is better without it (Algorithm 1, line 15)
  weight,  ///< Remove a vertex if its weight is far below the mean weight of its neighbors, so that it will soon be
           ///< hidden (§7)
};

/// The measure that compares a patch of k triangles with the k − 2 triangles that fill it without its center.
enum class RemovalMeasure {
  sum,     ///< The paper's test E(P∖p) < E(P); for barriers any removal lowers the sum
  mean,    ///< Energy per triangle
  excess,  ///< Energy beyond the energy of equilateral triangles of the same areas
};

/// The places of new vertices: of insertions between sweeps, in triangles of large energy, and of repairs, near bad
/// triangles (§7 leaves the rule open).
enum class InsertionPlace {
  best,          ///< Sweeps take the orthocenter. Repairs try centroid, orthocenter and midpoints of edges, and refine
  orthocenter,   ///< The orthocenter alone: the circumcenter, where no weights differ
  circumcenter,  ///< The circumcenter alone
  centroid,      ///< The centroid alone
};

/// The treatment of steps that would turn a triangle over.
enum class Inversion {
  refuse,    ///< Refuse them; searches end at nine tenths of the way to the first inversion
  allow,     ///< Allow them, as in the paper: energies extrapolate, and the mesh may end as a tangle (a "HOT mess")
  infinite,  ///< For barriers: the energy is +∞ there, so that searches pass over such places but never stop there
};

/// The treatment of triangles that are not well-centered after the sweeps of a barrier, one neighborhood at a time.
enum class Repair {
  none,
  perturb,  ///< Sweep from a larger γ and perturb vertices randomly; every vertex stays. Not if the user sets γ, h° or
            ///< a solver
  vertices,  ///< Also remove and insert vertices
};

/// The order in which a sweep visits the vertices.
enum class SweepOrder {
  hilbert,  ///< Along a Hilbert curve
  input,    ///< In the order of the input
  reverse,  ///< The last number first
  random,   ///< Shuffled once by the seed
};

enum class StoppingRule {
  relative,  ///< Stop if E changed by less than tolerance × E in one sweep, or has not been lower for 25 sweeps
  paper,     ///< Stop if the mean energy per triangle fell by less than tolerance, or rose
};

/// Options of Objective::accuracy. It lowers
///
///     E = Σ_edges s⁻² (G/L) [ (α L² + β G²)/4 + ¾ c (α δw² + β H²) ]
///
/// For each edge:
///   - L is its squared length.
///   - G is its length times its dual length. This is a sum: on each side, the height times the length.
///   - H is the difference of these two products.
///   - δw is the difference of the weights of its ends.
///   - s is the local size.
///
/// The star sets α and β. For c = 1, E is E_F / s² (eq. 2 of the paper). The first term is a moment of edge and dual,
/// which every mesh of this size has. The second is c times the offset between their midpoints, which is the
/// first-order error of a diagonal ★. docs/explanation/accuracy.md derives it. [length²]
struct AccuracyOptions {
  std::optional<double> offset_factor = {};  ///< Factor c ≥ 0 of the offset: 1 is HOT itself. Absent: set by the scheme
  /// Factor of H² on the boundary, ≥ 0. No mesh avoids this term. A smaller factor is better for vertex-centered
  /// solvers, a larger one for cell-centered solvers. Absent: set by the scheme.
  std::optional<double> boundary_offset_factor = {};
  /// Margin ε: all h/ℓ, d/ℓ and 1 − d/ℓ stay above it. 0 < ε < 1/4 (equilateral: h/ℓ = 0.289). Absent: set by the
  /// scheme.
  std::optional<double> margin = {};
  /// Least length of interior edges, as a multiple of the mean local size at their ends. Shorter edges are lengthened
  /// as far as connectivity and fixed vertices allow. Repair::vertices removes and inserts vertices for this. In [0,
  /// 0.95]; equilateral triangles have 1. 0: no limit.
  double min_edge = 0;
  /// Least length of their dual edges in the same unit, in [0, 0.55]; equilateral triangles have 1/√3.
  double min_dual = 0;
  /// Factor μ > 0 of the logarithms that keep the margins and lengths, in units of s² per triangle.
  double barrier = 0.003;
  /// Largest number of sweeps, ≥ 0, after the sweeps that make every triangle well-centered. Three times as many if a
  /// least length is set.
  int sweeps = 32;
  /// Relative tolerance, ≥ 0: the sweeps end after one that changes E and barrier by less than this part of E; before
  /// steps for the solver's error, by less than 50 times this part.
  double tolerance = 1e-5;
};

/// The values of a scheme for absent AccuracyOptions.
struct SchemeWeights {
  double offset_factor, boundary_offset_factor, margin;
};
/// These values come from measurements: docs/explanation/accuracy.md.
[[nodiscard]] SchemeWeights scheme_weights(Scheme scheme);

/// Options of Objective::solver_error. It lowers  ln mean(errors / initial errors) + κ ln(E + barrier)  over all
/// vertices at once. E and its barrier are those in AccuracyOptions.
struct SolverErrorOptions {
  double offset_share = 1;   ///< Factor κ ≥ 0, which keeps other errors from rising
  int steps = 15;            ///< Largest number of steps, ≥ 0. Ten times as many for the user's own problem
  double tolerance = 0.005;  ///< Tolerance ≥ 0: stop if ten steps lower the sum of logarithms by less than this
  /// Largest number of vertices for which the errors of a scheme are modeled, unless `objective` is solver_error.
  int most_vertices = 200'000;
};

/// The switches of Algorithm 1, for choices in the paper and for differences from the production form. The defaults are
/// the production form; options_for("paper") has the paper's values.
struct PaperSwitches {
  /// γ of E_BP. A given value is constant. Absent: relative to each edge and shrinking from sweep to sweep,
  /// from 0.5 to 0.003. It starts from 1 if there are 100 or more triangles and at least a quarter of them is bad. As
  /// soon as no triangle is bad, it becomes 0.003. If some stay bad, a later start begins from 2 and shrinks more
  /// slowly.
  std::optional<LengthParameter> gamma = {};
  /// Parameter −h° of E_BHs. A given value is constant. Absent: relative, just beyond the worst h/ℓ of the mesh, and
  /// shrinking as that improves.
  std::optional<LengthParameter> h0 = {};
  BoundaryTreatment boundary_treatment = BoundaryTreatment::as_is;  ///< Boundary treatment, for E_F only

  Solver solver = Solver::newton;
  /// Over-relaxation of Newton steps, in (0, 2). A given value is constant. Absent: 1.7, but 1.97 while γ shrinks from
  /// 1.
  std::optional<double> relaxation = {};
  SweepOrder order = SweepOrder::hilbert;
  std::uint64_t seed = 1;  ///< Seed of SweepOrder::random, of the jitter that frees symmetric grids, and of repairs
  int weights_from = 0;    ///< First sweep that changes weights (i_w)
  /// Updates of weights. Deferred is not allowed with Solver::newton, which is joint, unless positions are deferred
  /// too.
  Updates weight_updates = Updates::immediate;
  /// Updates of positions. Deferred: all unknowns use the state at the beginning of the sweep (Jacobi instead of
  /// Gauss-Seidel); weights that move must be deferred too. With Inversion::refuse a vertex stays if its neighbors have
  /// moved so that it would turn a triangle over.
  Updates position_updates = Updates::immediate;
  Visits visits = Visits::once;
  SearchRadius search_radius = SearchRadius::rms;  ///< Radius R of Solver::golden, and of the search for E_c
  double weight_search_radius = 1;                 ///< Radius of Solver::golden for weights, relative to R². > 0
  VertexId anchor = {};  ///< Vertex whose weight is shifted to 0 after each sweep (Algorithm 1, line 17); invalid: none

  int inner = 1;  ///< With deferred flips: largest number of sweeps before edges flip; 0: until the sweeps converge
  int outer = 0;  ///< With deferred flips: largest number of rounds of sweeps and flips; 0: until no edge must flip
  /// Limit of a step beyond a flip. Absent: unlimited for barriers (a flipping step must lower the energy), after for
  /// HOT.
  std::optional<FlipLimit> flip_limit = {};
  double overshoot = 1.1;         ///< Overshoot k of Algorithm 5, with FlipLimit::after; > 0
  double overshoot_factor = 0.1;  ///< Factor on k − 1 from sweep to sweep, down to ±1e-6; 1: k is constant. In [0, 1]
  Inversion inversion = Inversion::refuse;
  HiddenPolicy hidden = HiddenPolicy::undo;

  // Only these options remove vertices. Boundary vertices, fixed vertices and vertices of constrained edges stay.
  std::optional<int> collapse_from = {};        ///< First sweep with short-edge collapses (Algorithm 2), i_c
  EnergyKind collapse_energy = EnergyKind::dT;  ///< Energy E_c of collapses: F, T or dT
  /// Ratio below which a vertex collapses: the distance to its nearest neighbor, over the shorter edge of that neighbor
  /// on the link.
  double collapse_ratio = 0.1;
  Removal removal = Removal::none;
  RemovalMeasure removal_measure = RemovalMeasure::mean;  ///< Measure of removals and insertions
  double removal_margin = 0.1;                            ///< Relative gain that the patch must have
  double hidden_threshold = 1;  ///< Distance below the mean weight for Removal::weight, relative to R² (rms). > 0
  int removal_from = 10;        ///< First sweep with removals
  /// First sweep after which vertices are inserted, in triangles of large energy, if that makes the mesh better (§7).
  /// Absent: never.
  std::optional<int> insertion_from = {};
  double insertion_ratio = 4;  ///< Ratio to the mean energy above which an energy is large; > 1
  InsertionPlace insertion_place = InsertionPlace::best;

  /// Energy of the first sweeps, before `energy`: "E_∂T, then switching to E_BP" (§7). Both energies use the same γ and
  /// h°. Absent: `energy` from the first sweep on, with one exception. Ten sweeps with E_ODT come first under these
  /// conditions:
  ///   - the accuracy objective is for one scheme
  ///   - the mesh lies in the plane and has no weights
  ///   - steps are Newton steps, with flips at once
  std::optional<EnergyKind> first_energy = {};
  int switch_at = 20;  ///< First sweep that lowers `energy`; earlier if the first energy has converged
  double tolerance = 1e-5;
  StoppingRule stopping = StoppingRule::relative;

  friend bool operator==(const PaperSwitches&, const PaperSwitches&) = default;
};

/// The solver whose measures the guard keeps, in addition to those of GuardOptions. They are of SolverMeasures.
enum class Client {
  none,
  fem,      ///< Linear finite elements: the number of obtuse triangles
  adcirc,   ///< ADCIRC: the number of obtuse triangles
  dflowfm,  ///< D-Flow FM: orthogonality, smoothness, flow links, the number of obtuse triangles
  mpas,     ///< MPAS: quality of cells and triangles, grid spacing, the number of obtuse triangles
};

/// The guard: a run for accuracy or the error of a solver makes none of these measures worse than in the input, or than
/// a bound. The worse of the two is the limit. If a run cannot keep the limits, the input is returned. By default there
/// are no limits.
struct GuardOptions {
  /// Client. If the input meets the limits of D-Flow FM, ADCIRC or MPAS, it is returned as it is.
  Client client = Client::none;
  /// Bound of the least angle a [degrees], in [0, 60], and 180 − 2a of the largest angle. 60: the input's. 0: no limit.
  double angle = 0;
  /// Bound of the least length of an inner edge over the size of its two triangles, in [0, 1]. 1: the input's. 0: no
  /// limit.
  double edge = 0;
  /// Bound of the largest ratio of the areas of two triangles that share an edge, >= 1. 1: the input's. Absent: no
  /// limit.
  std::optional<double> areas = {};
  /// Bound of the shortest edge [length]. Absent: the input's, if there is another limit.
  std::optional<double> length = {};
  /// Bound of the least time [s] in which a long wave crosses a triangle or an edge, where there is a depth. Absent:
  /// the input's, if there is another limit.
  std::optional<double> step = {};
  /// Water depth at each vertex of the input [m], positive down; NaN: land. A vertex that moves gets the depth of its
  /// place. Waves have the speed √(9.81 H), with H the mean depth of a triangle, at least 1 m. Empty: no limits of
  /// times.
  std::vector<double> depth = {};
};

/// The places where trials change a mesh of tetrahedra.
enum class Patches {
  shared,  ///< Bad tetrahedra near each other have trials together
  each,    ///< Each bad tetrahedron has trials of its own
};

/// Options of meshes of tetrahedra alone.
struct TetrahedraOptions {
  /// Trials in vain in one patch, >= 0; after four patches a place is left as it is. 0: the connectivity stays.
  int repair_trials = 20;
  Patches patches = Patches::shared;
  /// Least h/ℓ, >= 0: tetrahedra with a smaller one are improved in trials, too, if none is bad.
  double small_margin = 0;
  /// Largest number of steps, >= 0, that lower the errors of `scheme`. A HOT energy has at most 32.
  int accuracy_steps = 300;
  int most_error_vertices = 10'000;  ///< Largest number of vertices for a model of errors, >= 0
};

/// Options of curved surfaces alone (temper/surfaces.hpp).
struct CurvedSurfaceOptions {
  /// Largest distance between input and result, in parts of the diagonal of the bounding box, in [0, 1).
  double distance = 0.005;
  /// Creases are edges whose triangles turn by more than this angle [degrees], in (0, 180]. They stay.
  double crease_angle = 70;
};

struct OptimizeOptions;

/// The solvers of other libraries. temper::solvers() returns the solvers of this build (temper/solvers.hpp).
struct Solvers {
  /// Linear program solver for repairs. It finds weights for places that sweeps leave bad. Empty: repairs do not use
  /// it.
  std::function<std::unique_ptr<LpSolver>()> lp = {};
  /// Model of the errors of a scheme on a mesh. Empty: accuracy is lowered instead of the error, and a note reports it.
  std::function<Expected<std::shared_ptr<const DiscretizationError>>(const Mesh& mesh, const OptimizeOptions& options,
                                                                     const InputNames* names)>
      discretization_error = {};
  /// Squared errors of a scheme on a mesh, in L2 and at most, of each scheme that is meant; empty if there are none.
  /// Without this function a run returns its mesh even if the errors of the input are smaller.
  std::function<std::vector<double>(const Mesh& mesh, Scheme scheme, Executor* executor)> squared_errors = {};
};

struct OptimizeOptions {
  /// Objective of the run. Absent: objective_of().
  ///   - energy: the run lowers `energy` to the end.
  ///   - accuracy: the run first lowers `energy`, which must be a barrier, until all margins are above accuracy.margin
  ///     or the phase ends. Then it lowers E of AccuracyOptions with fixed connectivity. If all margins hold in the
  ///     input, the second phase begins at once, unless the boundary is to be split.
  ///   - solver_error: a third phase lowers the errors of the solver.
  ///
  /// `solver`, `order`, `tolerance` and `stopping` apply to the first phase.
  std::optional<Objective> objective = {};
  Scheme scheme = Scheme::all;  ///< Scheme of Objective::accuracy and solver_error, and of the criterion
  /// Part of the mesh that may change. Change::least begins at the places that violate criterion_of(scheme). It flips
  /// edges there, finds weights, moves vertices, and takes more rings until the place is good. An input that meets the
  /// criterion comes back bit for bit. Only if many places are bad, or stay bad, the whole mesh changes.
  Change change = Change::all;
  AccuracyOptions accuracy = {};
  SolverErrorOptions solver_error = {};
  EnergyKind energy = EnergyKind::BP;
  Star star = Star::one;  ///< Star whose error should be small; sweeps before Objective::accuracy use ★1
  Unknowns unknowns = Unknowns::positions_and_weights;
  Flips flips = Flips::immediate;
  BoundaryVertices boundary = BoundaryVertices::keep;
  /// Largest ratio of the lengths of edges that meet there, with BoundaryVertices::split; at least 2.
  double boundary_ratio = 4;
  InterfaceVertices interfaces = InterfaceVertices::fixed;
  std::optional<SizeField> size_field = {};  ///< Size field to compare sizes with; absent: the input's own sizes
  /// Size band B ≥ 1. Let s be the size field at a vertex. No step or flip moves the local size out of [s/B, B s], or
  /// further out if it is outside. Exceptions: removals, insertions, deferred flips, and the flips that make the input
  /// regular. A repair checks only the triangles of its neighborhood. With a band, sweeps go vertex by vertex on one
  /// thread. Absent: no limit.
  std::optional<double> size_band = {};
  /// Factor B ≥ 1 of coarsening, in the plane. The run searches for a mesh with fewer vertices in which all triangles
  /// are well-centered. No removal makes a local size larger than B times the size field. Fixed vertices stay, and so
  /// do the input's vertices on boundary and lines. Absent: no coarsening.
  std::optional<double> coarsen = {};
  /// Largest number of random moves of that search, which follow the removal of single vertices. Each takes 0.1 to 10
  /// ms.
  int coarsen_moves = 2000;
  GuardOptions guard = {};
  Repair repair = Repair::perturb;
  int repair_trials = 20000;  ///< Largest number of edits that repairs try, each on a copy of a neighborhood, 1 to 3 ms
                              ///< each. A linear program counts as 20
  /// Constant diffusion tensor K: the mesh is improved in the plane of its metric (temper/detail/tensor.hpp). The
  /// report and snapshots are in that plane. Absent: K = 1.
  std::optional<Tensor> tensor = {};
  /// Tensor of each triangle of the input, instead of `tensor`. Vertices between triangles with different tensors stay.
  /// They get a weight for each region (temper/detail/tensor.hpp). Empty: one tensor for all.
  std::vector<Tensor> triangle_tensors = {};
  /// Tensor of each tetrahedron of the input, or one for all. Empty: K = 1 (temper/tets/tensor.hpp).
  std::vector<Tensor3> tetrahedra_tensors = {};
  /// Weight of each corner of each cell of the input, as in OptimizeReport; only with tensors of the cells. Empty: the
  /// weights of the vertices.
  std::vector<double> corner_weights = {};
  /// The user's own problem. The run lowers its error, or says why it cannot: see wants_error_model(). Absent: the
  /// mean error of many smooth solutions with K = 1.
  std::optional<DiffusionProblem> problem = {};
  int max_sweeps = 1000;  ///< Largest number of sweeps; each repair counts as a sweep
  double time_limit = 0;  ///< Time limit of the whole run [s]; 0: none
  PaperSwitches paper = {};
  TetrahedraOptions tets = {};
  CurvedSurfaceOptions surfaces = {};
};

/// The objective that a run lowers. If the options have none, it is accuracy. It is `energy` alone if `energy` or
/// switches other than `order` and `seed` differ from their defaults.
[[nodiscard]] Objective objective_of(const OptimizeOptions& options);

/// Says whether a run needs a model of errors. Objective::solver_error does, because it lowers these errors.
/// Objective::accuracy does if `scheme` is vertex or cell and the mesh lies in the plane and has at most
/// solver_error.most_vertices vertices. Then it becomes solver_error if the options have no objective. If they name
/// accuracy, the model selects the mesh of least error; the input is compared too if it is well-centered.
[[nodiscard]] bool wants_error_model(const OptimizeOptions& options, const Mesh& mesh);

/// Warnings about a problem, as sentences. The run may move an edge across which the coefficient changes, unless the
/// edge is constrained.
[[nodiscard]] std::vector<std::string> problem_warnings(const Mesh& mesh, const DiffusionProblem& problem);

/// Returns the options for a target, an effort, and parts of the mesh to keep. Their names and meanings are in
/// targets(), efforts() and keeps() of optimize_table.hpp: `options_for("mpas", "high", {{"boundary"}})`. An unknown
/// name, or parts that leave nothing to change, are an error.
[[nodiscard]] Expected<OptimizeOptions> options_for(std::string_view target, std::string_view effort = "normal",
                                                    std::span<const std::string_view> keep = {});

/// The mesh at one moment of a run.
struct Snapshot {
  enum class Moment { start, after_sweep, before_flips, after_flips };
  Moment moment = Moment::start;
  int sweep = 0;      ///< Number of sweeps done
  int outer = 0;      ///< Number of rounds of deferred flips done
  double energy = 0;  ///< Energy of the mesh, at the γ of the sweep
  const Mesh& mesh;   ///< Mesh in the user's units; it may hold inverted triangles if they are allowed
  const IdVector<VertexId, VertexId>& vertices;  ///< Number of each vertex in the input; invalid: inserted
};

/// The mesh to keep if the run ends now.
struct BestSoFar {
  const Mesh& mesh;                              ///< Mesh in the user's units
  const IdVector<VertexId, VertexId>& vertices;  ///< Numbers of the vertices, as in OptimizeReport::vertices
};
/// A listener for which the mesh is copied.
using BestListener = BestListenerOf<BestSoFar>;

/// Tools and listeners of a run. The result does not depend on them, unless the observer stops the run.
struct OptimizeHooks {
  Executor* executor = nullptr;  ///< Threads for sweeps and sums
  /// Communicator of the ranks that make this run together. All ranks pass the same mesh and options, and each gets the
  /// result. The observer and the time limit of rank 0 count. Null: this process is alone.
  Communicator* communicator = nullptr;
  const InputNames* names = nullptr;  ///< Numbering of the user, for errors and notes
  Observer observer = {};             ///< Observer of the progress, which may stop the run
  Tracer tracer = {};                 ///< Tracer that receives every event of the run
  /// Function that receives the mesh between sweeps, as a copy each time.
  std::function<void(const Snapshot&)> snapshots = {};
  /// Function that may save the best mesh so far; called between sweeps and between repairs.
  BestListener best_so_far = {};
  /// Nobody reads the mesh before optimize() returns, not even observers. Then the run needs memory for one mesh less.
  bool exclusive = false;
  /// Function that looks at the input, and at the result if it is another mesh. Vertices and triangles may have other
  /// numbers there.
  std::function<void(const Mesh&)> viewer = {};
  bool measures_sizes = true;  ///< Measure OptimizeReport::size, which takes time. Notes on a size field need it anyway
  Solvers solvers = {};
  /// Start of the time limit. A program may have read files before, and may need as long to write them. Absent: the
  /// time of the call.
  std::optional<std::chrono::steady_clock::time_point> started = {};
};

/// The change of the sizes: both meshes compared with the size field.
struct SizeChange {
  SizeReport before, after;
};
[[nodiscard]] const ReportTable& table_of(const SizeChange*);

/// Counts of the changes of a run, by the numbers of the input.
struct ChangeCounts {
  std::size_t vertices_moved = 0;   ///< Vertices of the input at another place
  std::size_t weights_changed = 0;  ///< Vertices of the input with another weight
  std::size_t edges_changed = 0;    ///< Edges of the result that the input does not have
};
[[nodiscard]] const ReportTable& table_of(const ChangeCounts*);

/// The part of a report that runs of triangles and of tetrahedra share.
struct RunReport {
  Stopped stopped = Stopped::converged;
  int sweeps = 0;
  double seconds = 0;                         ///< Time of the optimization alone [s]
  Objective objective = Objective::accuracy;  ///< Objective that the run lowered
  double objective_before = 0;                ///< Objective of the input, at the final γ
  double objective_after = 0;                 ///< Objective of the result
  std::size_t bad_before = 0;  ///< Triangles or tetrahedra of the input that are not well-centered, before any flip
  std::size_t bad_after = 0;   ///< The same of the result
  std::size_t flips = 0;       ///< Changes of connectivity without a new or removed vertex
  std::size_t vertices_removed = 0;
  std::size_t vertices_inserted = 0;
  std::vector<SweepRecord> history;          ///< History of the sweeps; history[0] is the input
  std::optional<ChangeCounts> changed = {};  ///< With Change::least
  std::vector<std::string> notes;            ///< Notes for the user, in sentences
};

/// For Objective::accuracy the objective is E of AccuracyOptions with absolute values for its edges, and with the same
/// sizes before and after. With an error model it is the root mean square error. history[0] is the input, flipped to be
/// regular.
struct OptimizeReport : RunReport {
  /// Number of each vertex in the input, in the order of the result. Inserted vertices follow in the order of their
  /// insertion, with an invalid number. Empty if no vertex was removed or inserted.
  IdVector<VertexId, VertexId> vertices;
  /// Vertices without power cell that HiddenPolicy::keep left; empty while triangles are inverted.
  std::vector<VertexId> hidden_vertices;
  SizeChange size;
  /// Weight of each corner of each triangle of the result, three each, if its tensors have several planes. Else empty.
  std::vector<double> corner_weights;
  std::vector<Tensor>
      triangle_tensors;  ///< Tensor of each triangle of the result, with OptimizeOptions::triangle_tensors
};
[[nodiscard]] const ReportTable& table_of(const OptimizeReport*);

/// Improves the mesh in place. The domain boundary, fixed vertices and constrained edges stay, bit for bit, unless
/// `boundary` and `interfaces` allow changes. Every triangle stays counter-clockwise. O(sweeps · n).
///
/// The result is never worse than the input, whose edges are first flipped to be regular if possible. Meshes are
/// compared by these criteria, in this order:
///   - inverted triangles
///   - edges that are not regular, unless hidden vertices are kept
///   - for barriers, triangles that are not well-centered
///   - for accuracy, whether margins are kept
///   - the energy
///
/// So a HOT energy may leave more triangles that are not well-centered; a note then reports it. Errors leave the mesh
/// unchanged: a value out of range; weights that hide a vertex; a mesh outside the barrier of E_BH or E_BHs.
///
/// Measured errors come first for some inputs: those that are well-centered with margins, and grids with ties. Then the
/// run returns the mesh with the least errors, which may be the input. The target must have a solver, and the hooks
/// must be able to measure.
[[nodiscard]] Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options = {},
                                                const OptimizeHooks& hooks = {});

}  // namespace temper
