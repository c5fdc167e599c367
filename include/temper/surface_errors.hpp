// The errors that a curved surface causes in users' solvers: temper/errors.hpp, with the fields of tetrahedra.
//
// The domain is the surface of plane triangles itself, and a solution u is a smooth function of space on it. So each
// triangle has the part of ∇u in its plane. At an edge the parts across it differ, and −Δu = f has a source there: the
// sum of both outflows. A scheme takes this source as it takes f. In the plane it is zero, and the schemes, numbers and
// norms are those of temper/errors.hpp.
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

/// As for triangles of the plane, without refinements and local errors.
struct ErrorReport : temper::ErrorReport {
  FieldFrame frame;
};
[[nodiscard]] const ReportTable& table_of(const ErrorReport*);

/// Measures a mesh. Errors: no triangles, unknown fields, a frame of zero size. O(n^1.5): two sparse factorizations.
[[nodiscard]] Expected<ErrorReport> measure_errors(const SurfaceMesh& mesh, const MeasureErrorsOptions& options = {});

/// Returns the ratio of errors, field by field, as error_ratios() of the plane does.
[[nodiscard]] Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before);

}  // namespace temper::surfaces
