#include <iterator>
#include <utility>

#include "options/requirement.hpp"
#include "reports/json_of.hpp"
#include "reports/quality_report.hpp"
#include "temper/detail/version.hpp"

namespace temper::app {

const ReportTable& table_of(const Outcome*) {
  static const ReportTable table = report_table<Outcome>(
      "Outcome", "The outcome of a requirement, of --require.",
      {{"text", "The requirement as it was given", "", [](const Outcome& o) { return o.requirement.text; }},
       {"key", "Key of a number of the mesh, or energy.NAME.STAR", "",
        [](const Outcome& o) { return o.requirement.key; }},
       {"wants", "=, >= or <=", "", [](const Outcome& o) { return std::string(sign(o.requirement.better)); }},
       {"value", "Value that the number is compared with", "", [](const Outcome& o) { return o.requirement.value; }},
       {"found", "The number", "", &Outcome::found},
       {"met", "The requirement is met", "", &Outcome::met}});
  return table;
}

const ReportTable& table_of(const Verdict*) {
  static const ReportTable table =
      report_table<Verdict>("Verdict", "Criterion of a target, and the number of its violations in the mesh.",
                            {{"target", "Target of --for", "", &Verdict::target},
                             {"criterion", "Criterion of the target: well_centered, coefficients or distances", "",
                              [](const Verdict& v) { return std::string(name(v.criterion)); }},
                             {"violations", "Places that violate the criterion; 0: the mesh has what the solver needs",
                              "", &Verdict::violations}});
  return table;
}

template <class AnyQuality>
std::string check_json(const std::string& path, const AnyQuality& quality, std::span<const std::size_t> points,
                       const Verdict& verdict, std::span<const Outcome> outcomes) {
  Json json = {{"schema", kSchema}, {"file", path}};
  json.update(json_of(quality, points));
  json["verdict"] = json_of(verdict);
  json["requirements"] = json_of({field_list(outcomes, false)});
  return dump(json);
}
std::string json_list(std::span<const std::string> reports) {
  std::string list;
  for (const std::string& report : reports)
    list += (list.empty() ? "[\n" : ",\n") + report.substr(0, report.size() - 1);
  return (list.empty() ? "[" : list + "\n") + "]\n";
}

/// The report of a run, with what else the program knows.
template <class Subject>
std::string optimize_json(const RunRecord<Subject>& record) {
  Json json = {{"schema", kSchema}, {"command", record.command}, {"version", version()}};
  json["options"] = Json::parse(record.options);
  json["settings"] = Json::parse(record.settings);
  json["before"] = json_of(record.before, record.points_before);
  json["after"] = json_of(record.after);
  json["requirements"] = json_of({field_list(record.outcomes, false)});
  const Json fields = json_of(record.report);
  for (const auto& [key, value] : fields.items()) {
    const bool is_history = key == "history";
    if ((key == "notes" || is_history) && !json.contains("data")) {
      json["data"] = json_of({&Subject::table_of_data(&record.data), view_of(record.data).report});
      if (!record.solver_errors.empty()) json["errors"] = Json::parse(record.solver_errors);
    }
    if (is_history) json["warnings"] = record.warnings;
    json[key] = value;
  }
  return dump(json);
}

#define TEMPER_MAKE(S)                                                                           \
  template std::string check_json(const std::string&, const S::Quality&, Points, const Verdict&, \
                                  std::span<const Outcome>);                                     \
  template std::string optimize_json(const RunRecord<S>&);
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

std::string history_csv(std::span<const SweepRecord> history) {
  std::vector<ReportView> sweeps;
  for (const SweepRecord& record : history) sweeps.push_back(view_of(record));
  return csv_of(table_of(history.data()), sweeps);
}

}  // namespace temper::app
