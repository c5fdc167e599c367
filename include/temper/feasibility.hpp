// Weights alone: can a mesh become well-centered if neither its positions nor its connectivity may change?
//
// For fixed positions and connectivity every h/ℓ and d/ℓ is linear in the weights. So these conditions are linear
// programs:
//   - all h ≥ tℓ and all tℓ ≤ d ≤ (1 − t)ℓ
//   - all h ≥ tℓ
//   - the dual lengths of given edges ≥ tℓ
//   - dual lengths inside, and heights over the boundary and over both sides of interfaces between regions
//
// A linear program finds the best margin t, the least change of weights for a given margin, or the least violation. If
// no weights exist, a certificate proves it. Exact arithmetic verifies the certificate without linear programming.
// Convex programs find the one best point of all weights: their analytic center, or the least offsets between the
// midpoints of edges and their duals. Solvers have small interfaces, which temper/detail/lp.hpp implements.
// temper/detail/connectivity.hpp searches over connectivities.
//
// On the sphere these conditions are linear in σ = R/|P|. A common factor of all σ changes nothing
// (docs/explanation/best-weights.md). There h/ℓ and d/ℓ are ratios of linear functions of σ. They have the signs of h
// and d, and differ from the values along arcs by a relative error of order (ℓ/R)².
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "temper/detail/convex.hpp"
#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/mesh.hpp"

namespace temper {

// --- linear programs --------------------------------------------------------------------------------

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// A linear program: minimize cost · x with lower ≤ x ≤ upper for columns and lower ≤ A x ≤ upper for rows. A is stored
/// by rows, compressed.
struct LpProblem {
  std::vector<double> cost, column_lower, column_upper;
  std::vector<double> row_lower, row_upper;
  std::vector<int> row_start = {0};
  std::vector<int> column;
  std::vector<double> value;

  [[nodiscard]] std::size_t n_columns() const { return cost.size(); }
  [[nodiscard]] std::size_t n_rows() const { return row_lower.size(); }
};

enum class LpStatus {
  optimal,
  infeasible,  ///< No x satisfies all bounds
  unbounded,
  failed,  ///< The solver gave up
};

struct LpSolution {
  LpStatus status = LpStatus::failed;
  std::vector<double> primal;  ///< Values of x, when optimal
  std::vector<double> dual;    ///< One multiplier per row, when optimal: how fast the cost grows with the row's bound
  double objective = 0;
};

/// The interface of solvers of linear programs. Each call is independent of the calls before.
class LpSolver {
 public:
  virtual ~LpSolver() = default;
  [[nodiscard]] virtual LpSolution solve(const LpProblem& problem) = 0;
};

// --- constraints ---------------------------------------------------------------------------------------

/// The inequalities to satisfy.
enum class Constraints {
  well_centered,  ///< Heights and crossings
  heights_only,   ///< Orthocenters inside their triangles; dual edges need not cross their own edges
  regular,        ///< Dual lengths of interior edges: all of them, or the prescribed ones
  coefficients,  ///< For unknowns at vertices: dual lengths of interior edges ≥ tℓ. A smaller one may stay as it is, if
                 ///< it is not negative. Heights over the boundary and over both sides of interfaces ≥ 0
  distances,                 ///< For unknowns in cells: these dual lengths and these heights, all of them ≥ tℓ
  completely_well_centered,  ///< Of tetrahedra alone (temper/tets/weights.hpp)
};

/// A row of the table of constraints.
struct ConstraintsInfo {
  Constraints constraints;
  std::string_view name;     ///< "well_centered", …: stable across versions
  std::string_view keeps;    ///< The inequalities for a margin t
  std::string_view success;  ///< Sentence about success: "weights make every triangle well-centered"
  std::string_view failure;  ///< Sentence about failure: "no weights make every triangle well-centered"
};
/// One row for each of Constraints that triangles can have, in the same order.
[[nodiscard]] std::span<const ConstraintsInfo> constraints_table();
[[nodiscard]] std::string_view name(Constraints constraints);

// --- certificates -------------------------------------------------------------------------------------

/// One inequality of the constraints.
struct WeightConstraint {
  enum class Kind {
    height,    ///< Height h over edge pq of the triangle pqr, counter-clockwise
    crossing,  ///< Crossing d from p towards q, for any edge pq
    dual,      ///< Dual length of pq: the sum of h over pq in the triangles pqr and qps, both counter-clockwise. Of
               ///< tetrahedra, the two triangles are faces of the surface (temper/tets/weights.hpp)
    height_over_face,  ///< Height over the face pqr of the positive tetrahedron pqrs
    dual_of_face,      ///< Dual length of pqr: the sum of the heights over it in the tetrahedra pqrs and prqt
    equal_crossing,    ///< Equation: d/ℓ of pq is that of rs, the same edge on the other side of an interface
  };
  Kind kind = Kind::height;
  VertexId p, q, r;  ///< Vertices; r is invalid for a crossing
  VertexId s = {};   ///< Invalid for a crossing and a height
  VertexId t = {};   ///< Only for a dual of a face

  friend bool operator==(const WeightConstraint&, const WeightConstraint&) = default;
};
/// "height", "crossing", "dual", "height_over_face", "dual_of_face", "equal_crossing".
[[nodiscard]] std::string_view name(WeightConstraint::Kind kind);

/// Reach of certificates about dual lengths (`regular`, `coefficients`, `distances`): they assume that weights differ
/// by less than this many ℓ² along the edges of their triangles. (The other constraints bound these differences
/// themselves.) With larger differences h would lose 20 of its 53 bits.
inline constexpr double kWeightReach = 0x1p20;
/// Margin that certificates about dual lengths refute in the plane. With w = |x|² − z all dual lengths are linear in z,
/// so weights that attain one positive margin can be scaled to attain any. If heights count, too, and their best margin
/// is negative, a certificate refutes margin 0.
inline constexpr double kRefutedDual = 0x1p-10;
/// Least margin that certificates about dual lengths refute on the sphere, where weights cannot be scaled this way.
/// check_certificate has enough bits for this margin.
inline constexpr double kLeastRefutedDual = 0x1p-20;

/// A proof that no weights exist (Farkas). Each constraint c is a polynomial N_c > margin · M_c, linear in the weights:
///
///   height  N = D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r) = 2 h ℓ S,               M = 2 ℓ² S
///   crossing   N = ℓ² + w_p − w_q                                = 2 d ℓ,                 M = 2 ℓ²
///   dual    N = λ_q (r × s) + λ_r (s × q) + λ_s (q × r)       = 2 (h_r + h_s) S T / ℓ, M = 2 S T
///   equal crossing  N = |r − s|² (w_p − w_q) − |p − q|² (w_r − w_s) = 0, with a multiplier of either sign
///
/// Constraints of `coefficients` are N_c ≥ margin · M_c, and only dual lengths of interior edges have a margin. Their
/// sum is a contradiction if the rest is < 0.
///
/// with D_p = (q − p)·(r − p) and so on, and S twice the area of pqr. For a dual, p is the origin, λ_v = |v|² − w_v +
/// w_p, and T is twice the area of qps. The proof is a sum of the constraints with multipliers ≥ 0. If the weights
/// cancel in it and the rest is ≤ 0, it is a contradiction.
///
/// On the sphere N and M are linear in σ: N > margin · M (σ_p + σ_q)/2. Here p, q, r are the places and M is a double:
///
///   height  N = (p×q)·(q×r) σ_p + (p×q)·(r×p) σ_q + |p×q|² σ_r,      M = |p×q|² det(p, q, r)/R³
///   crossing   N = |p|² σ_q − p·q σ_p,                                  M = |p − q|²
///   dual    N = det(p, q, r) σ_s + det(q, p, s) σ_r + …,             M = det(p, q, r) det(q, p, s)/R³
///
/// For a dual, N is the determinant of the four (p, σ_p). A sum in which no σ has a positive coefficient is a
/// contradiction.
struct Certificate {
  struct Term {
    WeightConstraint constraint;
    double multiplier = 0;
    friend bool operator==(const Term&, const Term&) = default;
  };
  double margin = 0;  ///< Refuted margin: no weights keep the constraints with more than this margin
  std::vector<Term> terms;
  Constraints constraints = Constraints::well_centered;
  friend bool operator==(const Certificate&, const Certificate&) = default;
};

/// The verdicts of check_certificate.
enum class CertificateCheck {
  proves,            ///< No weights exist
  proves_nothing,    ///< The sum is not a contradiction
  not_of_this_mesh,  ///< A triangle or an edge of a constraint is not in the mesh, or the kind of constraint is not one
                     ///< of these constraints
  bad_multiplier,  ///< A multiplier is negative or not finite, all of them are zero, or the margin is outside [0, 1/2)
  out_of_range,    ///< Numbers are so far apart that exact arithmetic could underflow
};
[[nodiscard]] std::string_view name(CertificateCheck check);

/// Verifies a certificate in exact arithmetic, from the positions alone. About O(n) for n terms, with a large factor.
///
/// Multipliers are doubles, so the weights cancel only nearly. The rest is bounded by how much weights can differ along
/// an edge pq of a triangle pqr:
///   - with crossings: |w_p − w_q| < ℓ²
///   - with heights alone: the greater of ℓ² and ||r − p|² − |r − q|²|, because the orthocenter is in the triangle and
///     both distances are squares minus weights
///   - with dual lengths: kWeightReach ℓ², an assumption
///
/// On the sphere σ_q/σ_p is bounded:
///   - with crossings: by p·q/|p|² and |q|²/p·q
///   - with heights alone: by q·r/p·r
///   - with dual lengths: |σ_q/σ_p − 1| < the lesser of 1 and kWeightReach (|q|²/p·q − 1)
[[nodiscard]] CertificateCheck check_certificate(const Mesh& mesh, const Certificate& certificate);
/// The same in the planes of several tensors, with the equations of interfaces. Certificates of `heights_only` prove
/// nothing there.
[[nodiscard]] CertificateCheck check_certificate(const MetricMesh& pieces, const Certificate& certificate);

// --- margins ------------------------------------------------------------------------------------------

/// The margin at which linear programs for `regular` stop. In the plane any margin can be attained if one above 0
/// can, so the best margin is this value or 0. On the sphere it is an attained margin, above zero if any is.
inline constexpr double kMostMargin = 0.5;

/// The margin of the mesh's own weights, in doubles: the least h/ℓ, d/ℓ, 1 − d/ℓ or dual length/ℓ that the constraints
/// have. kUnbounded if they have none. `edges` selects edges of `regular`, each by either halfedge; empty: all.
/// Boundary edges are always regular. O(n).
[[nodiscard]] double weight_margin(const Mesh& mesh, Constraints constraints = Constraints::well_centered,
                                   std::span<const HalfedgeId> edges = {});

struct BestMargin {
  LpStatus status = LpStatus::failed;
  double margin = 0;  ///< Largest margin t* that any weights attain; negative: no weights satisfy the constraints
  std::vector<WeightConstraint> tight;  ///< Constraints that keep the margin from being larger
  Certificate certificate;  ///< Refutation of margin 0, for `regular` of kRefutedDual. It has terms only if t* ≤ 0 and
                            ///< the checker agrees
  std::vector<VertexId> vertices;  ///< Vertices of the selected triangles
  std::vector<double> weights;     ///< Weights of these vertices with margin t*: for proofs, not for meshes (see below)
};

/// Returns the best margin of the selected triangles, without the rest of the mesh. It is an upper bound for any larger
/// set of triangles. Do not use its weights for meshes: they become extreme to gain the last bit of margin, and the
/// mesh is worse than with a small margin.
[[nodiscard]] BestMargin best_margin(const Mesh& mesh, std::span<const TriangleId> triangles, LpSolver& solver,
                                     Constraints constraints = Constraints::well_centered,
                                     std::span<const HalfedgeId> edges = {});
/// Returns the best margin of the whole mesh: the least over its components.
[[nodiscard]] BestMargin best_margin(const Mesh& mesh, LpSolver& solver,
                                     Constraints constraints = Constraints::well_centered,
                                     std::span<const HalfedgeId> edges = {});

// --- weights ------------------------------------------------------------------------------------------

enum class WeightGoal {
  margin,    ///< Best margin, and the least change for the requested margin or for half of the best one
  change,    ///< Least change for the requested margin
  elastic,   ///< Least violation of the requested margin, but none is bad if good weights exist; then the least change
  center,    ///< Analytic center: the greatest product of all h/ℓ, d/ℓ, 1 − d/ℓ or dual lengths/ℓ
  accuracy,  ///< Least sum of squared offsets with the requested margin, or with half of the best one
  least,  ///< Least sum of squared changes of d/ℓ over all edges, with the requested margin, or with half of the best
  fewest,  ///< As elastic, with few violated constraints instead of the least sum
};

/// For `regular`, center and accuracy also keep crossings d between −kCrossingReach ℓ and (1 + kCrossingReach) ℓ.
/// Otherwise there would be no greatest product, because dual lengths can always be stretched.
inline constexpr double kCrossingReach = 1;

/// A term of the sum of squared offsets between the midpoints of edges and their duals: factor (value − target)².
///
///   crossing          value = d/ℓ; its distance from 1/2 is the offset along an edge
///   height            value = h/ℓ of a boundary edge
///   dual              value = (h_r − h_s)/(2ℓ), from the middle of the dual to the edge
///   height_over_face  value = h/ℓ, of a boundary face
///   dual_of_face      value = (h_s − h_t)/(2ℓ)
///
/// In faces, crossing and height give the offset between orthocenter and centroid. On the sphere a value is a ratio of
/// linear functions. There it is replaced by its linear part at equal σ, with an error of order (w/R²)².
struct OffsetTerm {
  WeightConstraint at;
  double factor = 0, target = 0;
  friend bool operator==(const OffsetTerm&, const OffsetTerm&) = default;
};

/// A proof that weights are best. Let s_c be the slack of a constraint: its value less the margin. Let y_c ≥ 0 be its
/// multiplier, and f the objective. f(v) − Σ y_c s_c(v) is convex in the weights v. So for all v that keep the
/// constraints
///
///     f(v) ≥ f(w) − Σ y_c s_c(w) − |r · (v − w)|                  accuracy
///     f(v) ≥ f(w) − Σ (y_c s_c(w) − 1 − ln y_c s_c(w)) − |r · (v − w)|        center, f = −Σ ln s_c
///
/// Here r is the slope of f − Σ y_c s_c at w, zero up to rounding. It is multiplied by bounds of the differences of
/// weights along edges, as for certificates.
struct Optimality {
  WeightGoal goal = WeightGoal::center;
  Constraints constraints = Constraints::well_centered;
  double margin = 0;     ///< Margin t of the slacks; 0 for center
  double objective = 0;  ///< f: −Σ ln s_c, or Σ factor (value − target)² [length²]
  double gap = 0;        ///< No weights have an objective below `objective` − `gap`
  std::size_t iterations = 0;
  std::vector<Certificate::Term> terms;  ///< The constraints with the multipliers of N_c − margin M_c
  std::vector<OffsetTerm> offsets;       ///< Of accuracy
  /// The gap over the objective.
  [[nodiscard]] double relative_gap() const;
};

struct WeightOptions {
  WeightGoal goal = WeightGoal::change;
  double margin = 0.01;     ///< Requested margin t, in [0, 1/2)
  bool from_input = false;  ///< Measure change from the mesh's weights; else from zero
  /// Components of at most this many triangles are one linear program. In larger components only the neighborhoods of
  /// bad triangles are solved. They grow until everything outside can stay as it is.
  std::size_t whole = 3000;
  int rings = 2;  ///< Number of rings of vertices around bad triangles, at first
  Constraints constraints = Constraints::well_centered;
  std::vector<HalfedgeId> edges = {};  ///< Prescribed edges of `regular`, each by either halfedge; empty: all
  /// Factors c and c_b of WeightGoal::accuracy: of the offsets inside and of heights on the boundary (AccuracyOptions).
  double offset_factor = 10, boundary_offset_factor = 5;
  /// The search asks it between programs, and within those of `least`. If it says yes, the other regions keep their
  /// weights.
  std::function<bool()> must_stop = {};
};

enum class Feasibility {
  feasible,    ///< The weights satisfy the constraints, by exact predicates
  infeasible,  ///< No weights exist: the exact checker accepts a certificate
  undecided,   ///< The best margin is zero up to rounding, or the solver failed
};
[[nodiscard]] std::string_view name(Feasibility verdict);
[[nodiscard]] std::span<const std::string_view> words_of(Feasibility);

/// The meaning of the reported best margin of the mesh.
enum class MarginKind {
  exact,     ///< The margin is the best one, up to rounding
  at_least,  ///< The margin is attained; larger ones were not tried
  at_most,   ///< The margin is the best one of the worst neighborhood
};
[[nodiscard]] std::string_view name(MarginKind is);

/// A constraint that elastic weights violate.
struct Violation {
  WeightConstraint constraint;
  double value = 0;      ///< Value of h/ℓ, d/ℓ or dual length/ℓ with the weights
  double shortfall = 0;  ///< Requested margin minus `value`, > 0
  double angle_deg = 0;  ///< For a height: angle of the triangle at r, opposite the edge
};

struct WeightReport {
  Feasibility verdict = Feasibility::undecided;
  double margin = 0;  ///< Best margin
  MarginKind margin_kind = MarginKind::at_least;
  bool solved = false;                 ///< `weights` answer the request; elastic ones may violate constraints
  double asked = 0;                    ///< Margin that the weights were made for
  double attained = 0;                 ///< Margin that the weights have: weight_margin
  std::size_t moved = 0;               ///< Number of weights that differ from the reference (`from_input`)
  double change = 0;                   ///< Value of weight_change [length]
  std::size_t programs = 0;            ///< Number of regions, each with its own linear program
  std::size_t largest = 0;             ///< Number of triangles of the largest region
  IdVector<VertexId, double> weights;  ///< Weight of each vertex of the mesh
  std::vector<Violation> violations;   ///< Violations of elastic and fewest, worst first
  /// Certificate against the margin. It may have no terms. If infeasible, it refutes margin 0. For `regular` it refutes
  /// the requested margin in the plane, but at most kRefutedDual and at least kLeastRefutedDual; on the sphere
  /// kLeastRefutedDual. If only the requested margin cannot be attained, it refutes that margin.
  Certificate certificate;
  std::optional<Optimality> optimality =
      {};  ///< Proof that the weights are best; only for center and accuracy, if solved
};

/// Σ over edges |Δw_i − Δw_j| / (2ℓ): the total shift of the weighted midpoints. On the sphere ℓ is the length of
/// chords.
[[nodiscard]] double weight_change(const Mesh& mesh, const IdVector<VertexId, double>& from,
                                   const IdVector<VertexId, double>& to);

/// Finds weights for a mesh with fixed positions and connectivity. The answers of solvers are not trusted: exact
/// predicates and check_certificate decide. `convex` is for center, accuracy and least, which take the linear programs
/// only if it finds no weights, and for fewest. If elastic has it, regions with more than `whole` triangles or a rim
/// take it. Errors: a margin out of range, a goal without its solver. Precondition: no erased triangles.
[[nodiscard]] Expected<WeightReport> find_weights(const Mesh& mesh, LpSolver& solver, const WeightOptions& options = {},
                                                  ConvexSolver* convex = nullptr);
/// The largest difference between the crossings d/ℓ of an interface edge, as its two sides have them; 0 without
/// interfaces. With rounding alone, dual edges have one crossing with each interface.
[[nodiscard]] double largest_gap(const MetricMesh& pieces);
/// Changes the weights of interfaces as little as possible, so that largest_gap() is rounding.
void close_gaps(MetricMesh& pieces);
/// The same in the planes of several tensors: one weight for each vertex and region, and the equations of interfaces.
/// Change is measured from weights that keep them. Error also: center, accuracy and least across interfaces.
[[nodiscard]] Expected<WeightReport> find_weights(const MetricMesh& pieces, LpSolver& solver,
                                                  const WeightOptions& options = {}, ConvexSolver* convex = nullptr);

}  // namespace temper
