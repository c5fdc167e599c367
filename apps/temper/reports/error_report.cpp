#include "reports/error_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "console.hpp"
#include "exit.hpp"
#include "reports/json_of.hpp"
#include "temper/dec.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kMeasureColumns = 34;
constexpr std::size_t kColumns = 10;

// --- text ------------------------------------------------------------------------------------------------------------

enum class Shown { errors, ratios, orders };

std::string number_text(double value, Shown shown, const TextStyle& style) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return style.utf8 ? "∞" : "inf";
  switch (shown) {
    case Shown::errors:
      return fmt::format("{:.3e}", value);
    case Shown::ratios:
      return fmt::format("{:.4g}", value);
    case Shown::orders:
      return fmt::format("{:.2f}", value);
  }
  return "";
}

/// "★1, L2" for the terminal.
std::string label_of(const ErrorMeasure& measure, const TextStyle& style) {
  std::string label(measure.label);
  const std::string star = "★";
  if (const std::size_t at = label.find(star); !style.utf8 && at != std::string::npos) {
    label.replace(at, star.size(), "star ");
  }
  return label;
}

std::string row_text(const std::string& label, const std::vector<std::string>& cells) {
  std::string text = pad_right(label, kMeasureColumns);
  for (const std::string& cell : cells) text += pad_left(cell, kColumns);
  return text + "\n";
}

/// The measures of one norm: all keys with this ending.
std::vector<ErrorMeasure> measures_of(std::string_view norm) {
  std::vector<ErrorMeasure> chosen;
  for (const ErrorMeasure& measure : error_measures()) {
    if (measure.key.ends_with(norm)) chosen.push_back(measure);
  }
  return chosen;
}

OperatorErrors mean_of(const std::vector<FieldErrors>& fields, Shown shown, std::optional<FieldGroup> group) {
  return shown == Shown::orders ? arithmetic_mean(fields, group) : geometric_mean(fields, group);
}

bool has_group(const std::vector<FieldErrors>& fields, FieldGroup group) {
  for (const FieldErrors& row : fields) {
    if (row.field.group == group) return true;
  }
  return false;
}

std::vector<std::string> cells_of(const OperatorErrors& errors, std::string_view norm, Shown shown,
                                  const TextStyle& style) {
  std::vector<std::string> texts;
  for (const ErrorMeasure& measure : measures_of(norm)) texts.push_back(number_text(measure.of(errors), shown, style));
  return texts;
}

std::string title_row(const std::string& title, const TextStyle& style) {
  const std::string star = style.utf8 ? "★" : "star ";
  return "\n" + row_text(title, {star + "0", star + "1", star + "2", "Poisson", "flux"});
}

/// One line per norm: the means of all fields.
std::string means_table(std::string_view what, const std::vector<FieldErrors>& fields, Shown shown,
                        const TextStyle& style) {
  const std::string title = fields.size() == 1 ? fmt::format("{}, {}", what, fields[0].field.name)
                                               : fmt::format("mean {}, {} fields", what, fields.size());
  const OperatorErrors mean = mean_of(fields, shown, {});
  return title_row(title, style) + row_text("L2", cells_of(mean, ".l2", shown, style)) +
         row_text("maximum", cells_of(mean, ".max", shown, style));
}

/// One line per field, then means.
std::string table(const std::string& title, std::string_view norm, const std::vector<FieldErrors>& fields, Shown shown,
                  const TextStyle& style) {
  const auto cells = [&](const OperatorErrors& errors) { return cells_of(errors, norm, shown, style); };
  std::string text = title_row(title, style);
  for (const FieldErrors& row : fields) {
    text += row_text(fmt::format("{} ({})", row.field.name, name(row.field.group)), cells(row.errors));
  }
  if (fields.size() < 2) return text;
  for (const FieldGroup group : {FieldGroup::chosen, FieldGroup::held_back}) {
    if (!has_group(fields, group)) continue;
    text += row_text(fmt::format("mean, {}", name(group)), cells(mean_of(fields, shown, group)));
  }
  return text + row_text("mean", cells(mean_of(fields, shown, {})));
}

std::string yes_no(bool value) { return value ? "yes" : "no"; }

/// What solvers need of the matrix of their target.
std::string needs_text(const ErrorSystem& p, const ErrorSystem& f, const TextStyle& style) {
  const auto value = [&](double x) { return number_text(x, Shown::ratios, style); };
  std::string text = "\n" + row_text("matrix", {"Poisson", "flux"});
  text += row_text("target of its solvers (--for)", {"vertex", "cell"});
  text += row_text("M-matrix", {yes_no(p.m_matrix), yes_no(f.m_matrix)});
  text += row_text("negative coefficients", {std::to_string(p.negative), std::to_string(f.negative)});
  if (p.condition && f.condition) text += row_text("condition, at least", {value(*p.condition), value(*f.condition)});
  return text;
}

/// The other rows. `links`: what leads from one cell to the next, "edges" or "faces".
std::string matrices_text(const ErrorSystem& p, const ErrorSystem& f, std::string_view links, const TextStyle& style) {
  const auto value = [&](double x) { return number_text(x, Shown::ratios, style); };
  std::string text = row_text("unknowns", {std::to_string(p.unknowns), std::to_string(f.unknowns)});
  text += row_text("positive definite", {yes_no(p.definite), yes_no(f.definite)});
  text += row_text("singular", {yes_no(p.singular), yes_no(f.singular)});
  text += row_text(fmt::format("{} between merged cells", links), {"-", std::to_string(f.merged)});
  return text +
         row_text("largest coefficient over median", {value(p.largest_over_median), value(f.largest_over_median)});
}

std::string levels_text(const ErrorReport& report) {
  std::string text = "\n" + row_text("refined family", {"triangles", "bad", "irregular"});
  for (std::size_t i = 0; i < report.levels.size(); ++i) {
    const ErrorLevel& level = report.levels[i];
    text +=
        row_text(fmt::format("level {}", i), {std::to_string(level.triangles), std::to_string(level.not_well_centered),
                                              std::to_string(level.non_regular_edges)});
  }
  return text;
}

// --- JSON ------------------------------------------------------------------------------------------------------------

/// JSON has no infinite numbers: null means +∞ for errors, and undefined for orders.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json errors_json(const OperatorErrors& errors) {
  Json json;
  for (const ErrorMeasure& measure : error_measures()) {
    const std::size_t dot = measure.key.find('.');
    json[std::string(measure.key.substr(0, dot))][std::string(measure.key.substr(dot + 1))] =
        number_json(measure.of(errors));
  }
  return json;
}

/// {"fields": […], "mean": {…}}
Json fields_json(const std::vector<FieldErrors>& fields, Shown shown) {
  Json list = Json::array();
  for (const FieldErrors& row : fields) {
    Json item = {{"name", row.field.name}, {"group", name(row.field.group)}};
    item.update(errors_json(row.errors));
    list.push_back(std::move(item));
  }
  Json means = {{"all", errors_json(mean_of(fields, shown, {}))}};
  for (const FieldGroup group : {FieldGroup::chosen, FieldGroup::held_back}) {
    if (has_group(fields, group)) means[std::string(name(group))] = errors_json(mean_of(fields, shown, group));
  }
  return {{"fields", std::move(list)}, {"mean", std::move(means)}};
}

/// A row of both meshes: the mesh itself first.
std::string problem_row(const ProblemRecord& record, const std::string& label,
                        const std::function<std::string(const DiffusionErrors&)>& value) {
  std::vector<std::string> cells = {value(record.errors)};
  if (record.reference) cells.push_back(value(*record.reference));
  return row_text(label, cells);
}

}  // namespace

std::string problem_text(const ProblemRecord& r) {
  const TextStyle plain = {};
  const auto error = [&](double value) { return number_text(value, Shown::errors, plain); };
  std::string text = r.path + ": your problem, errors relative to finite elements after " +
                     fmt::format("{} refinements\n", r.errors.refinements);
  if (r.reference) text += row_text("", {"IN", "--against"});
  text += problem_row(r, "unknowns at vertices, L2", [&](const auto& e) { return error(e.vertex.l2); });
  text += problem_row(r, "unknowns at vertices, maximum", [&](const auto& e) { return error(e.vertex.max); });
  text += problem_row(r, "  negative coefficients",
                      [](const auto& e) { return fmt::format("{}", e.vertex_system.negative); });
  text += problem_row(r, "unknowns at orthocenters, L2", [&](const auto& e) { return error(e.cell.l2); });
  text += problem_row(r, "unknowns at orthocenters, maximum", [&](const auto& e) { return error(e.cell.max); });
  text += problem_row(r, "  negative coefficients",
                      [](const auto& e) { return fmt::format("{}", e.cell_system.negative); });
  text += problem_row(r, "error of the reference, L2, about", [&](const auto& e) { return error(e.reference.l2); });
  text += problem_row(r, "least u", [](const auto& e) { return fmt::format("{:.5g}", e.least); });
  text += problem_row(r, "largest u", [](const auto& e) { return fmt::format("{:.5g}", e.largest); });
  return text;
}

std::string problem_json(const ProblemRecord& record) {
  Json json;
  json["schema"] = kSchema;
  json["mesh"] = record.path;
  json["problem"] = json_of(record.errors);
  if (record.reference) json["against"] = {{"mesh", record.against}, {"problem", json_of(*record.reference)}};
  return dump(json);
}

template <class Subject>
std::string error_text(const ErrorRecord<Subject>& record, ErrorRows rows, const TextStyle& style) {
  const auto& report = record.report;
  const bool all = rows == ErrorRows::all;
  const auto fields = [&](const char* what, const std::vector<FieldErrors>& of, Shown shown) {
    if (!all) return means_table(what, of, shown, style);
    return table(fmt::format("{}, L2", what), ".l2", of, shown, style) +
           table(fmt::format("{}, maximum", what), ".max", of, shown, style);
  };
  std::string text =
      fmt::format("{}: {}, {} bad (not well-centered); {} not regular\n", record.path,
                  plural(n_elements(report), Subject::element, Subject::elements), report.not_well_centered,
                  plural(n_irregular_links(report), fmt::format("interior {}", Subject::link),
                         fmt::format("interior {}", Subject::links)));
  text += fields("relative error", report.fields, Shown::errors);
  text += needs_text(report.poisson, report.flux, style);
  if (all) text += matrices_text(report.poisson, report.flux, Subject::links, style);
  if (record.against) {
    text += fmt::format("\nover the errors of {}:\n", record.against->path);
    text += fields("ratio", record.against->ratios, Shown::ratios);
  }
  if constexpr (requires { report.levels; }) {
    if (!report.levels.empty()) text += levels_text(report) + fields("order", report.orders, Shown::orders);
  }
  return all ? text : text + "\n--details prints all fields and rows\n";
}

namespace {

/// The refined family.
void add_levels(Json& json, const ErrorReport& report) {
  if (report.levels.empty()) return;
  Json levels = Json::array();
  for (const ErrorLevel& level : report.levels) {
    Json item = {{"vertices", level.vertices},
                 {"triangles", level.triangles},
                 {"not_well_centered", level.not_well_centered},
                 {"non_regular_edges", level.non_regular_edges}};
    item.update(fields_json(level.fields, Shown::errors));
    levels.push_back(std::move(item));
  }
  json["levels"] = std::move(levels);
  json["orders"] = fields_json(report.orders, Shown::orders);
}

/// One report, as a part of other reports.
template <class Report>
Json error_report_json(const Report& report) {
  Json json = json_of(report);
  json["errors"] = fields_json(report.fields, Shown::errors);
  if constexpr (requires { report.levels; }) add_levels(json, report);
  return json;
}

}  // namespace

template <class Subject>
std::string error_json(const ErrorRecord<Subject>& record) {
  Json json = {{"schema", kSchema}};
  json.update(error_report_json(record.report));
  if (record.against) {
    json["against"] = {{"mesh", record.against->path},
                       {"report", error_report_json(record.against->report)},
                       {"ratios", fields_json(record.against->ratios, Shown::ratios)}};
  }
  return dump(json);
}

std::string edge_errors_csv(const ErrorReport& report, const Input& input) {
  const DecComplex complex = dec_operators(input.mesh());
  const auto point = [&](VertexId v) { return input.points.empty() ? std::size_t{v.index} : input.points[v.index]; };
  std::string text = "from,to,star1,error\n";
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const DecEdge& edge = complex.edges[EdgeId(e)];
    text +=
        fmt::format("{},{},{},{}\n", point(edge.from), point(edge.to), complex.star1[EdgeId(e)], report.local[1][e]);
  }
  return text;
}

namespace {

MeasureErrorsOptions options_in(const FieldFrame& frame, Executor* executor) {
  MeasureErrorsOptions options;
  options.frame = frame;
  options.executor = executor;
  return options;
}
tets::MeasureErrorsOptions options_in(const tets::FieldFrame& frame, Executor* /*executor*/) {
  return {.frame = frame};
}

}  // namespace

template <class Subject>
SolverErrors<Subject>::SolverErrors(const typename Subject::Mesh& input, Executor* executor) : executor_(executor) {
  before_ = after_ = measured(input, field_frame(input));
}

template <class Subject>
typename Subject::ErrorReport SolverErrors<Subject>::measured(const typename Subject::Mesh& mesh,
                                                              const decltype(Report::frame)& frame) const {
  return or_fail(measure_errors(mesh, options_in(frame, executor_)));
}

template <class Subject>
void SolverErrors<Subject>::measure_result(const typename Subject::Mesh& result) {
  after_ = measured(result, before_.frame);
}

template <class Subject>
std::string SolverErrors<Subject>::text(const TextStyle& style) const {
  const auto ratios = error_ratios(after_, before_);
  std::string text = row_text("mean relative error", {"before", "after", "ratio"});
  for (const ErrorMeasure& measure : error_measures()) {
    const double from = measure.of(geometric_mean(before_.fields)), to = measure.of(geometric_mean(after_.fields));
    const std::string ratio =
        ratios ? number_text(measure.of(geometric_mean(*ratios)), Shown::ratios, style) : std::string("-");
    text += row_text(label_of(measure, style),
                     {number_text(from, Shown::errors, style), number_text(to, Shown::errors, style), ratio});
  }
  return text;
}

template <class Subject>
std::string SolverErrors<Subject>::json() const {
  const Json json = {{"before", error_report_json(before_)}, {"after", error_report_json(after_)}};
  return json.dump();
}

#define TEMPER_MAKE(S)                                                                 \
  template std::string error_text(const ErrorRecord<S>&, ErrorRows, const TextStyle&); \
  template std::string error_json(const ErrorRecord<S>&);                              \
  template class SolverErrors<S>;
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

}  // namespace temper::app
