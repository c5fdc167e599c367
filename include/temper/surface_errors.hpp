// Measures the errors of solvers on a curved surface, as temper/errors.hpp does, with the fields of tetrahedra.
//
// The domain is the surface of plane triangles itself, and a solution u is a smooth function of space on it. The
// gradient in a triangle is ∇u projected to its plane. At an edge the two projections differ, so −Δu = f has a source
// there: the outflow of both triangles. Both schemes add it to the right side; docs/reference/errors.md says how. In
// the plane it is zero, so schemes and norms are as in temper/errors.hpp.
#pragma once

#include <span>
#include <vector>

#include "temper/surfaces.hpp"
#include "temper/tets/errors.hpp"

namespace temper::surfaces {

using tets::error_fields;
using tets::FieldFrame;
using tets::MeasureErrorsOptions;

/// The frame of the bounding box of the vertices: its longest side goes from −1 to 1.
[[nodiscard]] FieldFrame field_frame(const SurfaceMesh& mesh);

/// The report has no refinements and no local errors.
struct ErrorReport : temper::ErrorReport {
  FieldFrame frame;
};
[[nodiscard]] const ReportTable& table_of(const ErrorReport*);

/// Measures a mesh. Errors: no triangles, unknown fields, a frame of zero size. O(n^1.5): two sparse factorizations.
[[nodiscard]] Expected<ErrorReport> measure_errors(const SurfaceMesh& mesh, const MeasureErrorsOptions& options = {});

/// Returns the ratio of errors, field by field, as error_ratios() of the plane does.
[[nodiscard]] Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before);

/// Does for a surface what temper::squared_solver_errors does in the plane. Behind the sums it gives the geometric
/// means over the fields, because in a sum one field with large errors hides the others.
[[nodiscard]] std::vector<double> squared_solver_errors(const SurfaceMesh& mesh, Scheme scheme);

}  // namespace temper::surfaces
