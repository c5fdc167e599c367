// The rows of coefficients in a summary of operators, of triangles or tetrahedra.
#pragma once

#include <iterator>

#include "temper/detail/report.hpp"

namespace temper {

/// 1 where there is nothing to compare with.
inline double ratio_to_median(double largest, double median) {
  return largest > median && median > 0 ? largest / median : 1;
}

template <class Summary>
void add_coefficient_rows(ReportTable& table) {
  using S = Summary;
  const Field<S> rows[] = {
      {"median_star1", "Median of |★1| over all edges", "", &S::median_star1, "median |star1|"},
      {"max_star1", "Largest |★1|", "", &S::max_star1, "largest |star1|"},
      {"max_star1_over_median", "Largest over median |★1|", "",
       [](const S& s) { return ratio_to_median(s.max_star1, s.median_star1); }, "  over the median"},
      {"median_transmissibility", "Median of |transmissibility| inside", "", &S::median_transmissibility},
      {"max_transmissibility", "Largest |transmissibility| inside; infinite if a dual edge has length 0", "",
       &S::max_transmissibility, "largest |transmissibility|"},
      {"max_transmissibility_over_median", "Largest over median |transmissibility|", "",
       [](const S& s) { return ratio_to_median(s.max_transmissibility, s.median_transmissibility); },
       "  over the median"}};
  table.rows.insert(table.rows.end(), std::begin(rows), std::end(rows));
}

}  // namespace temper
