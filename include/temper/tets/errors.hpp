// The errors that a mesh of tetrahedra causes in users' solvers: temper/errors.hpp, with a dimension more.
//
//   ★0, ★1, ★2  on smooth forms; ★3 is a value at one point of a tetrahedron, and is not measured
//   Poisson     −Δu = f by discrete exterior calculus, unknowns at the vertices:  d0ᵀ ★1 d0 u = ★0 f
//   flux        −Δu = f by finite volumes, unknowns at the orthocenters:  Σ T (u_k − u_l) = ∫ f,  T = A / (h_k + h_l)
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/errors.hpp"
#include "temper/tets/mesh.hpp"
#include "temper/tets/optimize.hpp"

namespace temper::tets {

/// The manufactured solutions, most of which are plane waves. Formulas are in x, y and z of the frame.
[[nodiscard]] std::span<const ErrorField> error_fields();

/// The frame of the fields, which are functions of (p − center) / half_size.
struct FieldFrame {
  Vec3 center;
  double half_size = 1;  ///< > 0 [length]
  friend bool operator==(const FieldFrame&, const FieldFrame&) = default;
};
[[nodiscard]] const ReportTable& table_of(const FieldFrame*);
/// The frame of the bounding box of the vertices: its longest side goes from −1 to 1.
[[nodiscard]] FieldFrame field_frame(const TetMesh& mesh);

struct MeasureErrorsOptions {
  std::vector<std::string> fields = {};  ///< Names of fields or of groups, or "all"; empty: all
  std::optional<FieldFrame> frame = {};  ///< Frame of the fields; none: field_frame(mesh)
  bool condition = false;                ///< Also estimate the condition of both matrices
};

struct ErrorReport {
  std::size_t vertices = 0, edges = 0, faces = 0, tetrahedra = 0;
  std::size_t non_regular_faces = 0;        ///< Interior faces of negative dual length, exact
  std::size_t negative_boundary_duals = 0;  ///< Boundary faces with a negative dual length, exact
  std::size_t negative_star0 = 0;
  std::size_t not_well_centered = 0;  ///< Number of tetrahedra, exact
  FieldFrame frame;
  /// `negative` counts edges for Poisson, and faces for flux. `merged` counts faces.
  ErrorSystem poisson, flux;
  std::vector<FieldErrors> fields;
};
[[nodiscard]] const ReportTable& table_of(const ErrorReport*);

/// Measures a mesh. Errors: no tetrahedra, unknown fields, a frame of zero size. Two sparse factorizations: O(n²).
[[nodiscard]] Expected<ErrorReport> measure_errors(const TetMesh& mesh, const MeasureErrorsOptions& options = {});

/// Returns the ratio of errors, field by field, as error_ratios() of triangles does.
[[nodiscard]] Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before);

/// Makes a model of the errors of a scheme for OptimizeHooks. For Scheme::vertex and Scheme::all it has unknowns at the
/// vertices and derivatives. Its two errors are those of 32 plane waves in 16 directions, and of 64 steep fronts in 32
/// directions. For Scheme::cell it takes the flux errors of the chosen fields, without derivatives. Null: another
/// scheme.
[[nodiscard]] std::shared_ptr<const DiscretizationError> make_discretization_error(Scheme scheme);

}  // namespace temper::tets
