#include "reports/json_of.hpp"

#include <fmt/format.h>

#include <cmath>

#include "files/input.hpp"
#include "temper/detail/certificate_io.hpp"

namespace temper::app {
namespace {

/// Makes JSON of each kind of value.
struct Writer {
  Points points;

  [[nodiscard]] std::size_t point(VertexId v) const { return v.index < points.size() ? points[v.index] : v.index; }
  [[nodiscard]] Json item(VertexId v) const { return v.valid() ? Json(point(v)) : Json(nullptr); }
  [[nodiscard]] static Json item(TriangleId t) { return t.index; }
  [[nodiscard]] static Json item(std::size_t count) { return count; }
  [[nodiscard]] static Json item(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(bool value) const { return value; }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(double value) const { return item(value); }
  Json operator()(const std::string& text) const { return text; }
  Json operator()(const TextWithOptions& text) const { return text.text; }
  Json operator()(const NumberedText& text) const {
    return renumber(text.text, [this](VertexId v) { return std::to_string(point(v)); });
  }
  Json operator()(VertexId v) const { return item(v); }
  Json operator()(const Certificate* proof) const {
    return proof->terms.empty() ? Json(nullptr) : Json::parse(io::certificate_to_json(*proof, points));
  }
  template <class T>
  Json operator()(std::span<const T> values) const {
    Json list = Json::array();
    for (const T& value : values) list.push_back(item(value));
    return list;
  }
  Json operator()(const FieldList& values) const {
    Json list = Json::array();
    for (const FieldValue& value : values.items) list.push_back(std::visit(*this, value.is));
    return list;
  }
  Json operator()(const ReportView& view) const {
    Json json = Json::object();
    for (const ReportRow& row : view.table->rows) {
      if (row.display.shown == ShownIn::libraries) continue;
      const FieldValue value = row.of(view.report.get());
      if (row.display.shown != ShownIn::if_any || !std::holds_alternative<std::monostate>(value.is))
        json[std::string(row.key)] = std::visit(*this, value.is);
    }
    return json;
  }
};

std::string csv_cell(const FieldValue& value) {
  if (const auto* number = std::get_if<double>(&value.is)) return fmt::format("{}", *number);
  if (const auto* count = std::get_if<std::int64_t>(&value.is)) return fmt::format("{}", *count);
  return std::get<std::string>(value.is);
}

}  // namespace

Json json_of(const FieldValue& value, Points points) { return std::visit(Writer{points}, value.is); }

Json json_of(const ReportView& report, Points points) { return Writer{points}(report); }

std::string csv_of(const ReportTable& table, std::span<const ReportView> reports) {
  std::string csv;
  for (const ReportRow& row : table.rows) csv.append(csv.empty() ? "" : ",").append(row.key);
  for (const ReportView& report : reports) {
    char before = '\n';
    for (const ReportRow& row : table.rows) {
      csv += before + csv_cell(row.of(report.report.get()));
      before = ',';
    }
  }
  return csv + "\n";
}

std::string dump(const Json& json) {
  // A path need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace temper::app
