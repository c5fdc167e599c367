// The errors that a mesh causes in users' solvers, measured with manufactured solutions. It is a library of its own,
// temper::errors, because it needs Eigen. docs/reference/errors.md defines every norm.
//
//   ★s       the diagonal stars on smooth s-forms: the errors that the HOT energies bound
//   Poisson  −Δu = f by discrete exterior calculus, unknowns at the vertices:  d0ᵀ ★1 d0 u = ★0 f
//   flux     −Δu = f by finite volumes, unknowns at the orthocenters:  Σ T (u_k − u_l) = ∫ f,  T = ℓ / (h_k + h_l)
//
// All errors are relative and have no unit. The fields are scaled with the bounding box of the domain. On the sphere
// they are spherical harmonics about turned axes, and edges and dual edges are arcs. In a periodic plane they are
// Fourier modes. On a closed mesh both problems leave a constant free, and the mean error is set to 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/discretization_error.hpp"
#include "temper/detail/error.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;
struct ReportTable;

/// The purpose of a field. An objective may be tuned on the chosen fields. The fields held back then show its true
/// value.
enum class FieldGroup {
  chosen,
  held_back,
  exact,  ///< Linear fields that both schemes must reproduce on any mesh; not among "all"
};
[[nodiscard]] std::string_view name(FieldGroup group);  ///< "chosen", "held-back", "exact"

/// A manufactured solution.
struct ErrorField {
  std::string_view name;
  FieldGroup group;
  /// Formula in x and y of the frame. On the sphere x, y and z are the coordinates of a turned unit vector. In a
  /// periodic plane the coordinates grow by 2π along each period.
  std::string_view formula;
};
[[nodiscard]] std::span<const ErrorField> error_fields(SpaceKind space = SpaceKind::plane);

/// The frame of the fields, which are functions of (p − center) / half_size.
struct FieldFrame {
  Vec2 center;
  double half_size = 1;  ///< > 0 [length]
  friend bool operator==(const FieldFrame&, const FieldFrame&) = default;
};
[[nodiscard]] const ReportTable& table_of(const FieldFrame*);
/// The frame of the bounding box of the vertices: its longer side goes from −1 to 1. On the sphere the radius counts,
/// and along a period the domain.
[[nodiscard]] FieldFrame field_frame(const Mesh& mesh);

struct MeasureErrorsOptions {
  /// Names of fields or of groups ("chosen", "held-back"), or "all"; empty: all.
  std::vector<std::string> fields = {};
  /// Frame of the fields; none: field_frame(mesh). Use one frame to compare meshes.
  std::optional<FieldFrame> frame = {};
  int refine = 0;          ///< Number of refinements, each triangle into four; then orders are measured too
  bool condition = false;  ///< Also estimate the condition of both matrices
  bool local = false;      ///< Also list the errors of each vertex, edge and triangle
  Executor* executor = nullptr;
};

/// Relative errors: l2 over the field's root mean square, and the maximum over it. +∞ if the system is singular, or if
/// the field overflows far outside the domain.
struct ErrorNorms {
  double l2 = 0;
  double max = 0;
};
[[nodiscard]] const ReportTable& table_of(const ErrorNorms*);
/// The errors of one field; also means over fields, ratios or orders.
struct OperatorErrors {
  std::array<ErrorNorms, 3> star;  ///< ★0, ★1, ★2
  ErrorNorms poisson;
  ErrorNorms flux;
};
struct FieldErrors {
  ErrorField field;
  OperatorErrors errors;
};

/// The matrix of a scheme, without the unknowns that the boundary fixes.
struct ErrorSystem {
  std::size_t unknowns = 0;
  /// The matrix has no positive entry off the diagonal and is diagonally dominant, by exact signs of the dual lengths.
  bool m_matrix = true;
  bool definite = true;      ///< Matrix is positive definite, by its pivots
  bool singular = false;     ///< System could not be solved: all errors are +∞
  std::size_t negative = 0;  ///< Number of edges with a negative coefficient, exact
  std::size_t merged = 0;  ///< For flux: number of edges whose two orthocenters coincide, so that they are one unknown
  /// Largest over median |coefficient| of interior edges; 1 without any, +∞ if one is +∞.
  double largest_over_median = 1;
  std::optional<double> condition = {};  ///< Spectral condition: a lower bound near the true value (power iterations)
};
[[nodiscard]] const ReportTable& table_of(const ErrorSystem*);

/// One mesh of a refined family.
struct ErrorLevel {
  std::size_t vertices = 0, triangles = 0;
  std::size_t non_regular_edges = 0;  ///< Exact number
  std::size_t not_well_centered = 0;  ///< Number of triangles, exact
  std::vector<FieldErrors> fields;
};

struct ErrorReport {
  std::size_t vertices = 0, edges = 0, triangles = 0;
  std::size_t non_regular_edges = 0;        ///< Interior edges of negative dual length, exact
  std::size_t negative_boundary_duals = 0;  ///< Boundary edges with a negative dual length, exact
  std::size_t negative_star0 = 0;
  std::size_t not_well_centered = 0;  ///< Number of triangles, exact
  FieldFrame frame;
  ErrorSystem poisson, flux;
  std::vector<FieldErrors> fields;
  /// The mesh itself and its refinements, coarsest first; empty without refine.
  std::vector<ErrorLevel> levels;
  /// The order of the errors of each field in the edge length: the least-squares slope over the levels in logarithms.
  /// NaN unless at least two levels have a finite error above rounding (1e-12). Empty without refine.
  std::vector<FieldErrors> orders;
  /// For `local`: the root mean square over the fields of the relative errors at each vertex (★0), edge (★1, in the
  /// order of DecComplex) and triangle (★2). Each is the error of the mean over the element.
  std::array<std::vector<double>, 3> local;
};
[[nodiscard]] const ReportTable& table_of(const ErrorReport*);

/// Measures a mesh. The report does not depend on the executor. Errors: no triangles, unknown fields, a frame of zero
/// size, too many refinements for the memory. Precondition: no erased triangles. O(n^1.5): two sparse factorizations.
///
///     const Expected<ErrorReport> report = measure_errors(mesh, {.fields = {"held-back"}});
///     if (report) use(geometric_mean(report->fields).poisson.l2);
[[nodiscard]] Expected<ErrorReport> measure_errors(const Mesh& mesh, const MeasureErrorsOptions& options = {});

// --- the user's own problem -----------------------------------------------------------------------------------------

/// The errors of both schemes for one problem.
struct DiffusionErrors {
  ErrorNorms vertex, cell;  ///< Relative to the reference: its L2 norm, and its largest absolute value
  ErrorNorms reference;     ///< Change of the reference by its last refinement: how much of the errors is its own
  ErrorSystem vertex_system, cell_system;
  int refinements = 0;            ///< Refinements of the mesh for the reference
  double least = 0, largest = 0;  ///< Least and largest value of the reference at the vertices
};
[[nodiscard]] const ReportTable& table_of(const DiffusionErrors*);

/// Solves a problem by the two schemes of this file, with the coefficients of with_coefficient(). The reference is a
/// solution by linear finite elements on the mesh without weights, refined `refinements` times, each triangle into
/// four. Errors are those at vertices (weighted by |★0|) and at orthocenters (weighted by the area). Errors: sizes that
/// do not fit the mesh, numbers that are not finite, edges that are not on the boundary, no piece with a value of u, a
/// mesh that is not of the plane, too many refinements for the memory. O(n^1.5).
[[nodiscard]] Expected<DiffusionErrors> measure_diffusion_errors(const Mesh& mesh, const DiffusionProblem& problem,
                                                                 int refinements = 3,
                                                                 const InputNames* names = nullptr);

/// The choices of a model of errors.
struct DiscretizationErrorOptions {
  Scheme scheme = Scheme::all;  ///< Scheme; vertex: Poisson problems; cell: two-point flux; all: both
  /// A problem in place of the waves, on the mesh of the model. The squared error is that against the
  /// reference of measure_diffusion_errors(), plus the square of the reference's own. A triangle of any mesh has the
  /// coefficient at its centroid.
  const DiffusionProblem* problem = nullptr;
  const InputNames* names = nullptr;  ///< Numbering of the user, for errors
};
/// Makes a model of errors for OptimizeOptions: the mean squared L2 errors of the schemes of this file over 16 plane
/// waves. They are sines and cosines in eight directions, with 1.5 or 3.5 radians in half the bounding box. Each error
/// is divided by the fourth power of its wave number, as such errors grow with it. Derivatives come from the discrete
/// adjoint: one more solve each with the same factors. Errors: Scheme::stars, a mesh of the sphere, a wrong problem.
/// O(n^1.5).
[[nodiscard]] Expected<std::shared_ptr<const DiscretizationError>> make_discretization_error(
    const Mesh& mesh, const DiscretizationErrorOptions& options = {});

/// One number of OperatorErrors. Tables, JSON and comparisons loop over these.
struct ErrorMeasure {
  std::string_view key;    ///< "star1.l2"
  std::string_view label;  ///< "★1, L2"
  double (*of)(const OperatorErrors&);
  double& (*at)(OperatorErrors&);
};
[[nodiscard]] std::span<const ErrorMeasure> error_measures();

/// The geometric mean over all fields or over one group; 1 if there is none.
[[nodiscard]] OperatorErrors geometric_mean(std::span<const FieldErrors> fields, std::optional<FieldGroup> group = {});
/// The arithmetic mean, the right mean for orders; NaN if one is NaN.
[[nodiscard]] OperatorErrors arithmetic_mean(std::span<const FieldErrors> fields, std::optional<FieldGroup> group = {});

/// The ratio of errors, field by field: below 1 if `after` is better. It is 1 for equal errors, 0 and +∞ included.
/// Error: different fields or frames.
[[nodiscard]] Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before);

/// The squared errors of Poisson problems at vertices (Scheme::vertex), of two-point flux (Scheme::cell), of both
/// (Scheme::all), or of stars (Scheme::stars): in L2 and at most, of each. They are sums over the chosen fields,
/// because a grid solves some fields exactly. Empty if the mesh cannot be measured. O(n^1.5).
[[nodiscard]] std::vector<double> squared_solver_errors(const Mesh& mesh, Scheme scheme, Executor* executor = nullptr);

}  // namespace temper
