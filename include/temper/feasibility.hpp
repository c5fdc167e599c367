// Weights alone: can a mesh become well-centered when neither its positions nor its connectivity may change?
//
// For fixed positions and connectivity every h/ℓ and d/ℓ is linear in the weights, so that "all h ≥ tℓ and all
// tℓ ≤ d ≤ (1 − t)ℓ" is a linear programme. It finds the best margin t, the least change of weights that attains a
// given margin, or the least violation; and when no weights exist it says why, with a certificate that exact
// arithmetic verifies without any linear programming. Solvers come through one small interface (temper/lp.hpp has Clp).
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "temper/error.hpp"
#include "temper/ids.hpp"
#include "temper/mesh.hpp"

namespace temper {

// --- linear programmes --------------------------------------------------------------------------------

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Minimise cost · x with lower ≤ x ≤ upper for columns, and lower ≤ A x ≤ upper for rows; A by rows, compressed.
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

/// Whoever solves linear programmes: once, with no memory of the last.
class LpSolver {
 public:
  virtual ~LpSolver() = default;
  [[nodiscard]] virtual LpSolution solve(const LpProblem& problem) = 0;
};

// --- certificates -------------------------------------------------------------------------------------

/// One inequality that a well-centered mesh keeps.
struct WeightConstraint {
  enum class Kind {
    height,  ///< h over edge pq of the triangle pqr, counter-clockwise
    split,   ///< d from p towards q, for any edge pq
  };
  Kind kind = Kind::height;
  VertexId p, q, r;  ///< r is invalid for a split

  friend bool operator==(const WeightConstraint&, const WeightConstraint&) = default;
};

/// A proof that no weights exist (Farkas). Each constraint c is a polynomial N_c > margin · M_c, linear in the weights:
///
///   height  N = D_p (D_r + w_q − w_r) + D_q (D_r + w_p − w_r) = 2 h ℓ S,   M = 2 ℓ² S
///   split   N = ℓ² + w_p − w_q                                = 2 d ℓ,     M = 2 ℓ²
///
/// with D_p = (q − p)·(r − p) and so on, and S twice the area. A sum of the constraints with multipliers ≥ 0 in which
/// the weights cancel and the rest is ≤ 0 contradicts itself.
struct Certificate {
  struct Term {
    WeightConstraint constraint;
    double multiplier = 0;
    friend bool operator==(const Term&, const Term&) = default;
  };
  double margin = 0;  ///< refuted: no weights have all h > margin ℓ and margin ℓ < d < (1 − margin) ℓ
  std::vector<Term> terms;
  friend bool operator==(const Certificate&, const Certificate&) = default;
};

/// The verdicts of check_certificate.
enum class CertificateCheck {
  proves,            ///< no weights exist
  proves_nothing,    ///< the sum is not a contradiction
  not_of_this_mesh,  ///< a constraint of a triangle or an edge that the mesh does not have
  bad_multiplier,    ///< not finite, negative, all of them zero, or a margin outside [0, 1/2)
  out_of_range,      ///< numbers so far apart that exact arithmetic could underflow
};
[[nodiscard]] std::string_view name(CertificateCheck check);

/// Verifies a certificate in exact arithmetic, from the positions alone. Multipliers are doubles, so the weights need
/// not cancel quite: what is left of each is bounded by the splits themselves, |w_p − w_q| < ℓ² along the edges of the
/// certificate, which every well-centered mesh keeps. About O(n) for n terms, with a large factor.
[[nodiscard]] CertificateCheck check_certificate(const Mesh& mesh, const Certificate& certificate);

// --- margins ------------------------------------------------------------------------------------------

/// The inequalities that count.
enum class Conditions {
  well_centered,  ///< heights and splits
  heights_only,   ///< orthocenters inside; dual edges need not cross their own edges
};

/// The least h/ℓ, d/ℓ and 1 − d/ℓ of the mesh's own weights, in doubles. O(n).
[[nodiscard]] double weight_margin(const Mesh& mesh, Conditions conditions = Conditions::well_centered);

struct BestMargin {
  LpStatus status = LpStatus::failed;
  double margin = 0;                    ///< t*: the largest margin that any weights attain; negative: none are good
  std::vector<WeightConstraint> tight;  ///< the constraints that keep it from being larger
  Certificate certificate;              ///< refutes margin 0; no terms unless t* ≤ 0 and the checker agrees
  std::vector<VertexId> vertices;       ///< of the triangles asked about
  std::vector<double> weights;          ///< of these vertices, with margin t*: for proofs, not for meshes (see below)
};

/// The best margin of some triangles, the rest of the mesh being left out: an upper bound for any set that has them.
/// The largest margin makes a worse mesh than a small one: weights go far for its sake.
[[nodiscard]] BestMargin best_margin(const Mesh& mesh, std::span<const TriangleId> triangles, LpSolver& solver,
                                     Conditions conditions = Conditions::well_centered);
/// The best margin of the whole mesh: the least of its components.
[[nodiscard]] BestMargin best_margin(const Mesh& mesh, LpSolver& solver,
                                     Conditions conditions = Conditions::well_centered);

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
  /// Components of at most this many triangles are one linear programme. Larger ones are solved around their bad
  /// triangles only, in neighbourhoods that grow until everything outside can stay as it is.
  std::size_t whole = 3000;
  int rings = 2;  ///< of vertices around bad triangles, at first
};

enum class Feasibility {
  feasible,    ///< the weights found make every triangle well-centered, by the exact predicate
  infeasible,  ///< no weights do, by a certificate that the exact checker accepts
  undecided,   ///< the best margin is zero up to rounding, or the solver failed
};
[[nodiscard]] std::string_view name(Feasibility verdict);

/// The meaning of a margin that is reported as the best of the mesh.
enum class MarginIs {
  exact,     ///< up to rounding
  at_least,  ///< attained; more was not tried
  at_most,   ///< of the worst neighbourhood
};
[[nodiscard]] std::string_view name(MarginIs is);

/// A constraint that elastic weights do not keep.
struct Violation {
  WeightConstraint constraint;
  double value = 0;      ///< h/ℓ or d/ℓ that the weights give
  double shortfall = 0;  ///< of the margin asked for
  double angle_deg = 0;  ///< height: of the triangle at r, across from the edge
};

struct WeightReport {
  Feasibility verdict = Feasibility::undecided;
  double margin = 0;  ///< best margin
  MarginIs margin_is = MarginIs::at_least;
  bool solved = false;                 ///< `weights` are an answer to what was asked
  double asked = 0;                    ///< margin that the weights were made for
  double attained = 0;                 ///< margin that they have: weight_margin
  std::size_t moved = 0;               ///< weights that differ from where change is measured from
  double change = 0;                   ///< Σ over edges |Δw_i − Δw_j| / (2ℓ) [length]
  std::size_t programmes = 0;          ///< regions, each with a linear programme of its own
  std::size_t largest = 0;             ///< triangles of the largest one
  IdVector<VertexId, double> weights;  ///< one a vertex of the mesh
  std::vector<Violation> violations;   ///< elastic: worst first
  /// Refutes margin 0 when infeasible, or the margin asked for when only that cannot be had. May have no terms.
  Certificate certificate;
};

/// Finds weights for a mesh whose positions and connectivity stay. What solvers say is never believed: verdicts rest on
/// exact predicates and on check_certificate. Error: a margin out of range. Precondition: no erased triangles.
[[nodiscard]] Expected<WeightReport> find_weights(const Mesh& mesh, LpSolver& solver,
                                                  const WeightOptions& options = {});

}  // namespace temper
