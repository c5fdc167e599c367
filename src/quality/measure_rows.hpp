// The measures of a report on a mesh as rows of its table.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "temper/detail/report.hpp"
#include "temper/quality.hpp"

namespace temper {

template <class Report>
[[nodiscard]] std::vector<ReportRow> measure_rows(std::span<const MeasureRow<Report>> measures) {
  std::vector<ReportRow> rows;
  for (const MeasureRow<Report>& m : measures) {
    const auto of = [of = m.of, count = m.count](const void* report) -> FieldValue {
      const double value = of(*static_cast<const Report*>(report));
      if (count) return {static_cast<std::int64_t>(value)};
      return {value};
    };
    const FieldType type = {.kind = m.count ? FieldType::Kind::count : FieldType::Kind::number};
    rows.push_back({m.key, m.definition, "", type, of});
  }
  return rows;
}

}  // namespace temper
