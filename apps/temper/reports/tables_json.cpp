// The tables of reports, measures and options as JSON: scripts/docs/records.py writes the schema, the classes of
// Python, the types of TypeScript and tables of the documentation from them.
#include <set>
#include <span>
#include <string>

#include "reports/json_of.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "subject.hpp"
#include "temper/detail/optimize_table.hpp"
#ifdef TEMPER_WITH_ERRORS
#include "temper/errors.hpp"
#include "temper/surface_errors.hpp"
#include "temper/tets/errors.hpp"
#endif

namespace temper::app {
namespace {

std::string_view word(OptionKind kind) {
  constexpr std::string_view kNames[] = {"count", "number", "choice", "length_parameter", "vertex"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view word(FieldType::Kind kind) {
  constexpr std::string_view kNames[] = {"flag",   "count",   "whole",       "number", "text",
                                         "vertex", "element", "certificate", "record"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view word(ShownIn shown) {
  constexpr std::string_view kNames[] = {"everywhere", "libraries", "by_key", "if_any"};
  return kNames[static_cast<std::size_t>(shown)];
}

/// Adds a table, and the tables of its records before it.
class Tables {
 public:
  void add(const ReportTable& table) {
    if (!added_.insert(&table).second) return;
    const Json json = json_of_table(table);
    list_.push_back(json);
  }
  [[nodiscard]] const Json& list() const { return list_; }

 private:
  Json json_of_type(const FieldType& type) {
    Json json = {{"kind", word(type.kind)}, {"optional", type.optional}, {"sizes", type.sizes}, {"words", type.words}};
    if (type.kind != FieldType::Kind::record) return json;
    const ReportTable& table = type.record();
    if (table.name.empty()) {
      json["fields"] = json_of_table(table)["fields"];
    } else {
      json["record"] = table.name;
      add(table);
    }
    return json;
  }
  Json json_of_table(const ReportTable& table) {
    Json fields = Json::array();
    for (const ReportRow& row : table.rows) {
      const Json field = {{"key", row.key},
                          {"sentence", row.sentence},
                          {"unit", row.unit},
                          {"shown", word(row.display.shown)},
                          {"type", json_of_type(row.type)}};
      fields.push_back(field);
    }
    return {{"name", table.name}, {"sentence", table.sentence}, {"fields", fields}};
  }

  std::set<const ReportTable*> added_;
  Json list_ = Json::array();
};

template <class... Reports>
void add_all(Tables& tables) {
  (tables.add(table_of(static_cast<const Reports*>(nullptr))), ...);
}

Json json_of_reports() {
  Tables tables;
  add_all<Quality, tets::Quality, surfaces::Quality, OptimizeReport, tets::OptimizeReport, surfaces::SurfaceReport,
          Progress, TraceEvent, io::DataReport, Outcome, Verdict, DecSummary, tets::DecSummary, DecRecord, TetDecRecord,
          ExplanationReport, tets::ExplanationReport, surfaces::Explanation, DualExplanation>(tables);
#ifdef TEMPER_WITH_ERRORS
  add_all<ErrorReport, tets::ErrorReport, surfaces::ErrorReport, DiffusionErrors>(tables);
#endif
  for (const CellKinds kind : kEachKind)
    tables.add(with_subject(
        kind, [](auto subject) -> const ReportTable& { return decltype(subject)::table_of_data(nullptr); }));
  return tables.list();
}

Json json_of_options() {
  Json rows = Json::array();
  for (const OptionRow& row : option_rows()) {
    rows.push_back({{"name", row.name},
                    {"sentence", row.sentence},
                    {"kind", word(row.kind)},
                    {"cells", name(row.cells)},
                    {"choices", row.choices},
                    {"optional", row.optional},
                    {"range", option_range_text(row)},
                    {"absent_name", row.absent_name},
                    {"absent", row.absent},
                    {"default", option_text(row, row.get({}))}});
  }
  return rows;
}

template <class Subject>
Json json_of_measures() {
  constexpr std::string_view kSigns[] = {"=", "≥", "≤"};
  Json rows = Json::array();
  for (const auto& row : Subject::measures()) {
    rows.push_back({{"key", row.key},
                    {"alias", row.alias},
                    {"community", row.community},
                    {"definition", row.definition},
                    {"sign", kSigns[static_cast<std::size_t>(row.better)]},
                    {"wanted", row.wanted ? Json(*row.wanted) : Json()}});
  }
  return rows;
}

Json json_of_words(std::span<const Preset> presets) {
  Json rows = Json::array();
  for (const Preset& preset : presets) rows.push_back({{"name", preset.name}, {"sentence", preset.sentence}});
  return rows;
}

}  // namespace

std::string tables_json() {
  Json measures = Json::array();
  for (const CellKinds cells : kEachKind)
    measures.push_back(with_subject(cells, [](auto subject) { return json_of_measures<decltype(subject)>(); }));
  return dump({{"measures", measures},
               {"reports", json_of_reports()},
               {"options", json_of_options()},
               {"targets", json_of_words(targets())},
               {"efforts", json_of_words(efforts())},
               {"keeps", json_of_words(keeps())}});
}

}  // namespace temper::app
