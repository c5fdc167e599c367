// Reports as JSON, by the rows of their tables.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "temper/detail/report.hpp"

namespace temper::app {

using Json = nlohmann::ordered_json;
/// Mesh vertex → point of the file; empty if they are the same.
using Points = std::span<const std::size_t>;

/// A value with its vertices as points of the file. Numbers that are not finite and absent values are null.
[[nodiscard]] Json json_of(const FieldValue& value, Points points = {});
/// An object with the rows that the program shows.
[[nodiscard]] Json json_of(const ReportView& report, Points points = {});
template <class Report>
[[nodiscard]] Json json_of(const Report& report, Points points = {}) {
  return json_of(view_of(report), points);
}

/// Lines with the values of reports, below a line with the keys.
[[nodiscard]] std::string csv_of(const ReportTable& table, std::span<const ReportView> reports);

/// The text of a file.
[[nodiscard]] std::string dump(const Json& json);

}  // namespace temper::app
