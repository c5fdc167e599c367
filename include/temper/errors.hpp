// The errors that a mesh causes in users' solvers, measured with manufactured solutions. A library of its own
// (temper::errors), because it needs Eigen. docs/errors.md defines every norm.
//
//   ★s       the diagonal stars on smooth s-forms: what the HOT energies bound
//   Poisson  −Δu = f by discrete exterior calculus, unknowns at the vertices:  d0ᵀ ★1 d0 u = ★0 f
//   flux     −Δu = f by finite volumes, unknowns at the orthocenters:  Σ T (u_k − u_l) = ∫ f,  T = ℓ / (h_k + h_l)
//
// All errors are relative and have no unit: the fields are scaled with the domain's bounding box. On the sphere they
// are spherical harmonics about turned axes, edges and dual edges are arcs; in a periodic plane they are Fourier modes.
// On a closed mesh, where both problems leave a constant free, the mean of the error is 0.
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

/// The purpose of a field. An objective may be tuned on the chosen ones; those held back tell what it is worth.
enum class FieldGroup {
  chosen,
  held_back,
  exact,  ///< linear: both schemes must reproduce it on any mesh. Not among "all"
};
[[nodiscard]] std::string_view name(FieldGroup group);  ///< "chosen", "held-back", "exact"

/// A manufactured solution.
struct ErrorField {
  std::string_view name;
  FieldGroup group;
  /// In x and y of the frame; on the sphere in x, y and z of a turned unit vector; in a periodic plane in what grows by
  /// 2π along the periods.
  std::string_view formula;
};
[[nodiscard]] std::span<const ErrorField> error_fields(SpaceKind space = SpaceKind::plane);

/// The frame of the fields: they are functions of (p − center) / half_size.
struct FieldFrame {
  Vec2 center;
  double half_size = 1;  ///< > 0 [length]
  friend bool operator==(const FieldFrame&, const FieldFrame&) = default;
};
/// Around the bounding box of the vertices: its longer side goes from −1 to 1. On the sphere its radius; along a period
/// the domain.
[[nodiscard]] FieldFrame field_frame(const Mesh& mesh);

struct MeasureErrorsOptions {
  /// Names of fields, or of groups ("chosen", "held-back"), or "all"; none: all.
  std::vector<std::string> fields = {};
  std::optional<FieldFrame> frame = {};  ///< none: field_frame(mesh). Meshes are compared in one frame
  int refine = 0;                        ///< so many times each triangle becomes four, and orders are measured
  bool condition = false;                ///< also estimate the condition of both matrices
  bool local = false;                    ///< also list the errors of each vertex, edge and triangle
  Executor* executor = nullptr;
};

/// Relative: l2 over the field's root mean square, and the maximum over it. +∞ where the system is singular, or where
/// the field overflows far outside of the domain.
struct ErrorNorms {
  double l2 = 0;
  double max = 0;
};
/// The errors of one field, or their means over fields, or ratios or orders of them.
struct OperatorErrors {
  std::array<ErrorNorms, 3> star;  ///< ★0, ★1, ★2
  ErrorNorms poisson;
  ErrorNorms flux;
};
struct FieldErrors {
  ErrorField field;
  OperatorErrors errors;
};

/// The matrix of a scheme, without what the boundary fixes.
struct ErrorSystem {
  std::size_t unknowns = 0;
  /// The matrix has no positive entry off the diagonal and is diagonally dominant, by exact signs of the dual lengths.
  bool m_matrix = true;
  bool definite = true;                  ///< positive definite, by its pivots
  bool singular = false;                 ///< could not be solved: all errors are +∞
  std::size_t negative = 0;              ///< edges whose coefficient in it is < 0, exact
  std::size_t merged = 0;                ///< flux: edges whose orthocenters coincide, which makes them one unknown
  double largest_over_median = 1;        ///< of the |coefficients| of interior edges; 1 without any, +∞ where one is
  std::optional<double> condition = {};  ///< spectral, a lower bound that is near (by power iterations)
};

/// One mesh of a refined family.
struct ErrorLevel {
  std::size_t vertices = 0, triangles = 0;
  std::size_t non_regular_edges = 0;  ///< exact
  std::size_t not_well_centered = 0;  ///< triangles, exact
  std::vector<FieldErrors> fields;
};

struct ErrorReport {
  std::size_t vertices = 0, edges = 0, triangles = 0;
  std::size_t non_regular_edges = 0;        ///< interior edges of negative dual length, exact
  std::size_t negative_boundary_duals = 0;  ///< exact
  std::size_t negative_star0 = 0;
  std::size_t not_well_centered = 0;  ///< triangles, exact
  FieldFrame frame;
  ErrorSystem poisson, flux;
  std::vector<FieldErrors> fields;
  /// The mesh itself and its refinements, coarsest first; empty without refine.
  std::vector<ErrorLevel> levels;
  /// The order of the errors of each field in the edge length: the slope by least squares over the levels in
  /// logarithms. NaN where fewer than two levels have an error that is finite and more than rounding (1e-12). Empty
  /// without refine.
  std::vector<FieldErrors> orders;
  /// With `local`: of each vertex (★0), edge (★1, in the order of DecComplex) and triangle (★2) the relative error of
  /// the mean over it, its root mean square over the fields.
  std::array<std::vector<double>, 3> local;
};

/// Measures a mesh. The same report for any executor. Errors: no triangles, unknown fields, a frame of no size, more
/// refinement than memory is meant for. Precondition: no erased triangles. O(n^1.5): two sparse factorizations.
///
///     const Expected<ErrorReport> report = measure_errors(mesh, {.fields = {"held-back"}});
///     if (report) use(geometric_mean(report->fields).poisson.l2);
[[nodiscard]] Expected<ErrorReport> measure_errors(const Mesh& mesh, const MeasureErrorsOptions& options = {});

/// What a model of errors measures.
struct DiscretizationErrorOptions {
  Scheme scheme = Scheme::all;  ///< vertex: Poisson problems; cell: two-point flux; all: both
  std::size_t fields = 64;      ///< waves in all directions, whose squared errors are averaged
  std::uint64_t seed = 1;       ///< of their lengths and phases
};
/// The mean squared L2 errors of the schemes of this file over plane waves of 1 to 4 radians in half the bounding box,
/// each over the fourth power of its wave number, as such errors grow: for OptimizeOptions::discretization_error.
/// Derivatives by the discrete adjoint: one more solve each with the same factors. Errors: no field, Scheme::stars, a
/// mesh of the sphere. O(n^1.5 + fields n log n).
[[nodiscard]] Expected<std::shared_ptr<const DiscretizationError>> make_discretization_error(
    const Mesh& mesh, const DiscretizationErrorOptions& options = {});

/// One number of OperatorErrors: what tables, JSON and comparisons are made of.
struct ErrorMeasure {
  std::string_view key;    ///< "star1.l2"
  std::string_view label;  ///< "★1, L2"
  double (*of)(const OperatorErrors&);
  double& (*at)(OperatorErrors&);
};
[[nodiscard]] std::span<const ErrorMeasure> error_measures();

/// The geometric mean over fields, of all of them or of one group; 1 of none.
[[nodiscard]] OperatorErrors geometric_mean(std::span<const FieldErrors> fields, std::optional<FieldGroup> group = {});
/// The arithmetic mean, which is the one for orders; NaN where one is.
[[nodiscard]] OperatorErrors arithmetic_mean(std::span<const FieldErrors> fields, std::optional<FieldGroup> group = {});

/// Errors over errors, field by field: below 1 where `after` is better. 1 where both are the same, 0 and +∞ included.
/// Error: not the same fields in the same frame.
[[nodiscard]] Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before);

}  // namespace temper
