// The tables of reports on sizes.
#include "temper/detail/report.hpp"
#include "temper/detail/size.hpp"

namespace temper {

const ReportTable& table_of(const Spread*) {
  static const ReportTable table = report_table<Spread>(
      "Spread", "The distribution of many numbers: percentiles by nearest rank. All are 0 if there are no numbers.",
      {{"min", "", "", &Spread::min},
       {"p05", "", "", &Spread::p05},
       {"median", "", "", &Spread::median},
       {"p95", "", "", &Spread::p95},
       {"max", "", "", &Spread::max}});
  return table;
}

const ReportTable& table_of(const SizeReport*) {
  static const ReportTable table = report_table<SizeReport>(
      "SizeReport", "The comparison of a mesh with a size field. No number depends on the unit of length.",
      {{"over_field", "Local size over field at the vertices", "", &SizeReport::over_field},
       {"gradation", "Ratio of the greater to the smaller local size at the two ends of each edge", "",
        &SizeReport::gradation},
       {"largest_edge_ratio", "Largest ratio of the longest to the shortest edge of a triangle", "",
        &SizeReport::largest_edge_ratio},
       {"vertices_outside_field", "Number of vertices outside the field's mesh", "",
        &SizeReport::vertices_outside_field},
       {"band", "B of the smallest band [1/B, B] that holds all ratios of size to field", "", &SizeReport::band,
        ShownIn::libraries}});
  return table;
}

}  // namespace temper
