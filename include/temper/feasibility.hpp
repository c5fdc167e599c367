// Weights alone: can a mesh become well-centered when neither its positions nor its connectivity may change?
//
// For fixed positions and connectivity every h/ℓ and d/ℓ is linear in the weights, so that "all h ≥ tℓ and all
// tℓ ≤ d ≤ (1 − t)ℓ" is a linear program; so is "all h ≥ tℓ" alone, and "these edges have dual lengths ≥ tℓ". It
// finds the best margin t, the least change of weights that attains a given margin, or the least violation; and when no
// weights exist it says why, with a certificate that exact arithmetic verifies without any linear programming. Solvers
// come through one small interface (temper/detail/lp.hpp has Clp). Over connectivities: temper/detail/connectivity.hpp.
//
// On the sphere all this is linear in σ = R/|P|, up to a factor of all σ (docs/sphere.md). Its h/ℓ and d/ℓ are ratios
// of functions linear in σ that have the signs of h and d, do not change with that factor, and differ from the arcs' by
// a part of (ℓ/R)².
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/mesh.hpp"

namespace temper {

// --- linear programs --------------------------------------------------------------------------------

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Minimize cost · x with lower ≤ x ≤ upper for columns, and lower ≤ A x ≤ upper for rows; A by rows, compressed.
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
  infeasible,  ///< no x keeps all bounds
  unbounded,
  failed,  ///< the solver gave up
};

struct LpSolution {
  LpStatus status = LpStatus::failed;
  std::vector<double> primal;  ///< x, when optimal
  std::vector<double> dual;    ///< a multiplier a row, when optimal: how much the cost grows with the row's bound
  double objective = 0;
};

/// Whoever solves linear programs: once, with no memory of the last.
class LpSolver {
 public:
  virtual ~LpSolver() = default;
  [[nodiscard]] virtual LpSolution solve(const LpProblem& problem) = 0;
};

// --- constraints ---------------------------------------------------------------------------------------

/// The inequalities that count.
enum class Constraints {
  well_centered,  ///< heights and crossings
  heights_only,   ///< orthocenters inside their triangles; dual edges need not cross their own edges
  regular,        ///< dual lengths of edges inside the mesh: of all of them, or of those prescribed
};

/// A row of the table of constraints.
struct ConstraintsInfo {
  Constraints constraints;
  std::string_view name;     ///< "well_centered", …: stable across versions
  std::string_view keeps;    ///< the inequalities for a margin t
  std::string_view success;  ///< "weights make every triangle well-centered", a sentence of what was found
  std::string_view failure;  ///< "no weights make every triangle well-centered"
};
/// One row for each of Constraints, in their order.
[[nodiscard]] std::span<const ConstraintsInfo> constraints_table();
[[nodiscard]] std::string_view name(Constraints constraints);

// --- certificates -------------------------------------------------------------------------------------

/// One inequality of some constraints.
struct WeightConstraint {
  enum class Kind {
    height,    ///< h over edge pq of the triangle pqr, counter-clockwise
    crossing,  ///< d from p towards q, for any edge pq
    dual,      ///< dual length of pq: h over it in the triangle pqr and in qps, both counter-clockwise
  };
  Kind kind = Kind::height;
  VertexId p, q, r;  ///< r is invalid for a crossing
  VertexId s = {};   ///< of a dual only

  friend bool operator==(const WeightConstraint&, const WeightConstraint&) = default;
};
/// "height", "crossing", "dual".
[[nodiscard]] std::string_view name(WeightConstraint::Kind kind);

/// Certificates of `regular` speak of weights that differ by less than this many ℓ² along the edges of their triangles.
/// (The other constraints bound these differences themselves.) With greater ones h would have lost 20 of its 53 bits.
inline constexpr double kWeightReach = 0x1p20;
/// … and of margins no greater than this one: with w = |x|² − z all dual lengths are linear in z, so that who attains
/// one margin attains any.
inline constexpr double kRefutedDual = 0x1p-10;
/// On the sphere they do not: there margins above this one are refuted, what check_certificate has bits for.
inline constexpr double kLeastRefutedDual = 0x1p-20;

/// A proof that no weights exist (Farkas). Each constraint c is a polynomial N_c > margin · M_c, linear in the weights:
///
///   height  N = D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r) = 2 h ℓ S,               M = 2 ℓ² S
///   crossing   N = ℓ² + w_p − w_q                                = 2 d ℓ,                 M = 2 ℓ²
///   dual    N = λ_q (r × s) + λ_r (s × q) + λ_s (q × r)       = 2 (h_r + h_s) S T / ℓ, M = 2 S T
///
/// with D_p = (q − p)·(r − p) and so on, and S twice the area of pqr; for a dual p is the origin, λ_v = |v|² − w_v +
/// w_p, and T twice the area of qps. A sum of the constraints with multipliers ≥ 0 in which the weights cancel and the
/// rest is ≤ 0 contradicts itself.
///
/// On the sphere N and M are linear in σ, and N > margin · M (σ_p + σ_q)/2, with p, q, r the places and M a double:
///
///   height  N = (p×q)·(q×r) σ_p + (p×q)·(r×p) σ_q + |p×q|² σ_r,      M = |p×q|² det(p, q, r)/R³
///   crossing   N = |p|² σ_q − p·q σ_p,                                  M = |p − q|²
///   dual    N = det(p, q, r) σ_s + det(q, p, s) σ_r + …,             M = det(p, q, r) det(q, p, s)/R³
///
/// N of a dual is the determinant of the four (p, σ_p). A sum in which no σ has a coefficient above 0 contradicts
/// itself.
struct Certificate {
  struct Term {
    WeightConstraint constraint;
    double multiplier = 0;
    friend bool operator==(const Term&, const Term&) = default;
  };
  double margin = 0;  ///< refuted: no weights keep the constraints with more than this margin
  std::vector<Term> terms;
  Constraints constraints = Constraints::well_centered;
  friend bool operator==(const Certificate&, const Certificate&) = default;
};

/// The verdicts of check_certificate.
enum class CertificateCheck {
  proves,            ///< no weights exist
  proves_nothing,    ///< the sum is not a contradiction
  not_of_this_mesh,  ///< a constraint of a triangle or an edge that the mesh does not have, or not of the constraints
  bad_multiplier,    ///< not finite, negative, all of them zero, or a margin outside [0, 1/2)
  out_of_range,      ///< numbers so far apart that exact arithmetic could underflow
};
[[nodiscard]] std::string_view name(CertificateCheck check);

/// Verifies a certificate in exact arithmetic, from the positions alone. Multipliers are doubles, so the weights need
/// not cancel quite: what is left of each is bounded by how much weights can differ. Along an edge pq of a triangle pqr
/// that is |w_p − w_q| < ℓ² when the constraints have crossings; the greater of ℓ² and ||r − p|² − |r − q|²| when they
/// have heights alone (the orthocenter is in the triangle, and both distances are squares minus weights); kWeightReach
/// ℓ², without a reason, when they are dual lengths. On the sphere the bounds are of σ_q/σ_p: p·q/|p|² and |q|²/p·q
/// when the constraints have crossings, and q·r/p·r when they have heights alone; of dual lengths |σ_q/σ_p − 1| < the
/// lesser of 1 and kWeightReach (|q|²/p·q − 1). About O(n) for n terms, with a large factor.
[[nodiscard]] CertificateCheck check_certificate(const Mesh& mesh, const Certificate& certificate);

// --- margins ------------------------------------------------------------------------------------------

/// `regular`: in the plane any margin can be attained when one can, and this is what programs stop at. Its best
/// margin is this or 0; on the sphere one that is attained, above zero when any is.
inline constexpr double kMostMargin = 0.5;

/// The least h/ℓ, d/ℓ, 1 − d/ℓ or dual length/ℓ that the constraints have, of the mesh's own weights, in doubles;
/// kUnbounded when they have none. `edges`: of `regular`, by either of their halfedges; none: all. Those on the
/// boundary are regular whatever the weights. O(n).
[[nodiscard]] double weight_margin(const Mesh& mesh, Constraints constraints = Constraints::well_centered,
                                   std::span<const HalfedgeId> edges = {});

struct BestMargin {
  LpStatus status = LpStatus::failed;
  double margin = 0;                    ///< t*: the largest margin that any weights attain; negative: none are good
  std::vector<WeightConstraint> tight;  ///< the constraints that keep it from being larger
  Certificate certificate;         ///< refutes margin 0, of `regular` kRefutedDual; no terms unless t* ≤ 0 and the
                                   ///< checker agrees
  std::vector<VertexId> vertices;  ///< of the triangles asked about
  std::vector<double> weights;     ///< of these vertices, with margin t*: for proofs, not for meshes (see below)
};

/// The best margin of some triangles, the rest of the mesh being left out: an upper bound for any set that has them.
/// The largest margin makes a worse mesh than a small one: weights go far for its sake.
[[nodiscard]] BestMargin best_margin(const Mesh& mesh, std::span<const TriangleId> triangles, LpSolver& solver,
                                     Constraints constraints = Constraints::well_centered,
                                     std::span<const HalfedgeId> edges = {});
/// The best margin of the whole mesh: the least of its components.
[[nodiscard]] BestMargin best_margin(const Mesh& mesh, LpSolver& solver,
                                     Constraints constraints = Constraints::well_centered,
                                     std::span<const HalfedgeId> edges = {});

// --- weights ------------------------------------------------------------------------------------------

enum class WeightGoal {
  feasible,  ///< the best margin, and the least change for the margin asked for, or for half of the best one
  minimal,   ///< the least change for the margin asked for
  elastic,   ///< the least violation of the margin asked for, and then the least change
};

struct WeightOptions {
  WeightGoal goal = WeightGoal::minimal;
  double margin = 0.01;     ///< t, in [0, 1/2)
  bool from_input = false;  ///< change is measured from the mesh's weights; else from zero
  /// Components of at most this many triangles are one linear program. Larger ones are solved around their bad
  /// triangles only, in neighborhoods that grow until everything outside can stay as it is.
  std::size_t whole = 3000;
  int rings = 2;  ///< of vertices around bad triangles, at first
  Constraints constraints = Constraints::well_centered;
  std::vector<HalfedgeId> edges = {};  ///< of `regular`: those prescribed, by either of their halfedges; none: all
};

enum class Feasibility {
  feasible,    ///< the weights found keep the constraints, by exact predicates
  infeasible,  ///< no weights do, by a certificate that the exact checker accepts
  undecided,   ///< the best margin is zero up to rounding, or the solver failed
};
[[nodiscard]] std::string_view name(Feasibility verdict);

/// The meaning of a margin that is reported as the best of the mesh.
enum class MarginKind {
  exact,     ///< up to rounding
  at_least,  ///< attained; more was not tried
  at_most,   ///< of the worst neighborhood
};
[[nodiscard]] std::string_view name(MarginKind is);

/// A constraint that elastic weights do not keep.
struct Violation {
  WeightConstraint constraint;
  double value = 0;      ///< h/ℓ, d/ℓ or dual length/ℓ that the weights give
  double shortfall = 0;  ///< of the margin asked for
  double angle_deg = 0;  ///< height: of the triangle at r, across from the edge
};

struct WeightReport {
  Feasibility verdict = Feasibility::undecided;
  double margin = 0;  ///< best margin
  MarginKind margin_kind = MarginKind::at_least;
  bool solved = false;                 ///< `weights` are an answer to what was asked
  double asked = 0;                    ///< margin that the weights were made for
  double attained = 0;                 ///< margin that they have: weight_margin
  std::size_t moved = 0;               ///< weights that differ from where change is measured from
  double change = 0;                   ///< weight_change [length]
  std::size_t programs = 0;            ///< regions, each with a linear program of its own
  std::size_t largest = 0;             ///< triangles of the largest one
  IdVector<VertexId, double> weights;  ///< one a vertex of the mesh
  std::vector<Violation> violations;   ///< elastic: worst first
  /// Refutes margin 0 (of `regular`: kRefutedDual, or what was asked for when that is less; kLeastRefutedDual on the
  /// sphere) when infeasible, or the
  /// margin asked for when only that cannot be had. May have no terms.
  Certificate certificate;
};

/// Σ over edges |Δw_i − Δw_j| / (2ℓ), of chords on the sphere: how far weighted midpoints are moved, in all.
[[nodiscard]] double weight_change(const Mesh& mesh, const IdVector<VertexId, double>& from,
                                   const IdVector<VertexId, double>& to);

/// Finds weights for a mesh whose positions and connectivity stay. What solvers say is never believed: verdicts rest on
/// exact predicates and on check_certificate. Errors: a margin out of range, a periodic plane. Precondition: no erased
/// triangles.
[[nodiscard]] Expected<WeightReport> find_weights(const Mesh& mesh, LpSolver& solver,
                                                  const WeightOptions& options = {});

}  // namespace temper
