// The table of the summary of operators.
#include "dec/coefficient_rows.hpp"
#include "temper/dec.hpp"

namespace temper {

const ReportTable& table_of(const DecSummary*) {
  using S = DecSummary;
  static const ReportTable table = [] {
    ReportTable made = report_table<S>(
        "DecSummary", "A summary of the operators, for a check before a solver uses them.",
        {{"vertices", "Number of vertices", "", &S::vertices, "vertices"},
         {"edges", "Number of edges", "", &S::edges, "edges"},
         {"boundary_edges", "Number of edges on the boundary", "", &S::boundary_edges, "  on the boundary"},
         {"triangles", "Number of triangles", "", &S::triangles, "triangles"},
         {"not_well_centered", "Number of triangles that are not well-centered, exact", "", &S::not_well_centered,
          "  not well-centered"},
         {"area", "Area of the domain", "length²", &S::area, "area of the domain"},
         {"star0_sum", "Sum of ★0: the area, except for rounding", "length²", &S::star0_sum, "sum of star0"},
         {"negative_star0", "Number of negative ★0", "", &S::negative_star0, "negative star0"},
         {"negative_star1", "Number of interior edges that are not regular, exact", "", &S::negative_star1,
          "negative star1, interior edges"},
         {"negative_boundary_star1", "Number of boundary edges with the orthocenter outside the domain, exact", "",
          &S::negative_boundary_star1, "negative star1, boundary edges"},
         {"zero_star1", "Number of interior edges that are cocircular, exact", "", &S::zero_star1,
          "zero star1, interior edges"},
         {"min_star0", "Least ★0", "", &S::min_star0, "least star0"},
         {"min_star1", "Least ★1", "", &S::min_star1, "least star1"}});
    add_coefficient_rows<S>(made);
    return made;
  }();
  return table;
}

}  // namespace temper
