// The tables of reports on errors of solvers. Errors of single fields follow error_measures() instead.
#include "temper/detail/report.hpp"

#include <initializer_list>
#include <string_view>

#include "temper/errors.hpp"
#include "temper/surface_errors.hpp"

namespace temper {
namespace {

/// The systems of a report: of Poisson's equation at the vertices, and of the flux at the orthocenters.
struct ErrorMatrices {
  const ErrorSystem& poisson;
  const ErrorSystem& flux;
};
const ReportTable& table_of(const ErrorMatrices*) {
  using M = ErrorMatrices;
  static const ReportTable table = report_table<M>(
      "ErrorMatrices", "The matrices of both schemes.",
      {{"poisson", "−Δu = f at the vertices", "", [](const M& m) -> const ErrorSystem& { return m.poisson; }},
       {"flux", "−Δu = f at the orthocenters", "", [](const M& m) -> const ErrorSystem& { return m.flux; }}});
  return table;
}

struct DiffusionMatrices {
  const ErrorSystem& vertex;
  const ErrorSystem& cell;
};
const ReportTable& table_of(const DiffusionMatrices*) {
  using M = DiffusionMatrices;
  static const ReportTable table = report_table<M>(
      "DiffusionMatrices", "The matrices of both schemes for one problem.",
      {{"vertex", "Unknowns at vertices", "", [](const M& m) -> const ErrorSystem& { return m.vertex; }},
       {"cell", "Unknowns at orthocenters", "", [](const M& m) -> const ErrorSystem& { return m.cell; }}});
  return table;
}

/// The table of a frame, in the plane or in space.
template <class Frame>
ReportTable frame_table(std::string_view name) {
  return report_table<Frame>(
      name, "The frame of the fields, which are functions of (p − center) / half_size.",
      {{"center", "Its center", "", &Frame::center}, {"half_size", "> 0", "length", &Frame::half_size}});
}

/// The table of a report on errors. `of_elements`: the rows that only its kind of cells has.
template <class R>
ReportTable counts_table(std::string_view name, std::string_view sentence,
                         std::initializer_list<Field<R>> of_elements) {
  ReportTable table = report_table<R>(
      name, sentence,
      {{"vertices", "Number of vertices", "", &R::vertices}, {"edges", "Number of edges", "", &R::edges}});
  table.rows.insert(table.rows.end(), of_elements.begin(), of_elements.end());
  const std::initializer_list<Field<R>> of_both = {{"negative_star0", "Number of negative ★0", "", &R::negative_star0},
                                                   {"frame", "Frame of the fields", "", &R::frame},
                                                   {"matrices", "Matrices of both schemes", "", [](const R& r) {
                                                      return ErrorMatrices{r.poisson, r.flux};
                                                    }}};
  table.rows.insert(table.rows.end(), of_both.begin(), of_both.end());
  return table;
}

}  // namespace

const ReportTable& table_of(const ErrorNorms*) {
  static const ReportTable table = report_table<ErrorNorms>(
      "ErrorNorms",
      "Relative errors: l2 over the field's root mean square, and the maximum over it. Infinite if the system is "
      "singular.",
      {{"l2", "", "", &ErrorNorms::l2}, {"max", "", "", &ErrorNorms::max}});
  return table;
}

const ReportTable& table_of(const FieldFrame*) {
  static const ReportTable table = frame_table<FieldFrame>("FieldFrame");
  return table;
}

const ReportTable& table_of(const ErrorSystem*) {
  using S = ErrorSystem;
  static const ReportTable table = report_table<S>(
      "ErrorSystem", "The matrix of a scheme, without the unknowns that the boundary fixes.",
      {{"unknowns", "Number of unknowns", "", &S::unknowns},
       {"m_matrix",
        "No positive entry is off the diagonal, and the matrix is diagonally dominant, by exact signs of the dual "
        "lengths",
        "", &S::m_matrix},
       {"positive_definite", "The matrix is positive definite, by its pivots", "", &S::definite},
       {"singular", "The system could not be solved: all errors are infinite", "", &S::singular},
       {"negative", "Number of edges, or faces of tetrahedra, with a negative coefficient, exact", "", &S::negative},
       {"merged", "For flux: number of edges or faces whose two orthocenters coincide, so that they are one unknown",
        "", &S::merged},
       {"largest_over_median", "Largest over median |coefficient| inside; infinite if one is", "",
        &S::largest_over_median},
       {"condition", "Spectral condition, a lower bound near the true value; absent if it was not requested", "",
        &S::condition}});
  return table;
}

const ReportTable& table_of(const DiffusionErrors*) {
  using E = DiffusionErrors;
  static const ReportTable table = report_table<E>(
      "DiffusionErrors", "The errors of both schemes for one problem.",
      {{"vertex", "Errors at vertices, relative to the reference: its L2 norm, and its largest absolute value", "",
        &E::vertex},
       {"cell", "Errors at orthocenters", "", &E::cell},
       {"reference", "Change of the reference by its last refinement: how much of the errors is its own", "",
        &E::reference},
       {"matrices", "Matrices of both schemes", "",
        [](const E& e) {
          return DiffusionMatrices{e.vertex_system, e.cell_system};
        }},
       {"refinements", "Refinements of the mesh for the reference", "", &E::refinements},
       {"least", "Least value of the reference at the vertices", "", &E::least},
       {"largest", "Largest value of the reference at the vertices", "", &E::largest}});
  return table;
}

namespace {

template <class R>
ReportTable counts_of_triangles(std::string_view name, std::string_view sentence) {
  return counts_table<R>(
      name, sentence,
      {{"triangles", "Number of triangles", "", &R::triangles},
       {"not_well_centered", "Number of triangles that are not well-centered, exact", "", &R::not_well_centered},
       {"non_regular_edges", "Number of interior edges of negative dual length, exact", "", &R::non_regular_edges},
       {"negative_boundary_duals", "Number of boundary edges with a negative dual length, exact", "",
        &R::negative_boundary_duals}});
}

}  // namespace

const ReportTable& table_of(const ErrorReport*) {
  static const ReportTable table =
      counts_of_triangles<ErrorReport>("ErrorCounts", "The mesh and the matrices of ``measure_errors``.");
  return table;
}

const ReportTable& surfaces::table_of(const ErrorReport*) {
  static const ReportTable table = counts_of_triangles<ErrorReport>(
      "SurfaceErrorCounts", "The mesh and the matrices of ``measure_errors``, of a curved surface.");
  return table;
}

namespace tets {

const ReportTable& table_of(const FieldFrame*) {
  static const ReportTable table = frame_table<FieldFrame>("TetFieldFrame");
  return table;
}

const ReportTable& table_of(const ErrorReport*) {
  using R = ErrorReport;
  static const ReportTable table = counts_table<R>(
      "TetErrorCounts", "The mesh and the matrices of ``measure_errors``, of tetrahedra.",
      {{"faces", "Number of faces", "", &R::faces},
       {"tetrahedra", "Number of tetrahedra", "", &R::tetrahedra},
       {"not_well_centered", "Number of tetrahedra that are not well-centered, exact", "", &R::not_well_centered},
       {"non_regular_faces", "Number of interior faces of negative dual length, exact", "", &R::non_regular_faces},
       {"negative_boundary_duals", "Number of boundary faces with a negative dual length, exact", "",
        &R::negative_boundary_duals}});
  return table;
}

}  // namespace tets
}  // namespace temper
