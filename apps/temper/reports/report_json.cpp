#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "files/input.hpp"
#include "reports/quality_report.hpp"
#include "temper/detail/version.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::span<const std::size_t>;

std::size_t point_of(Points points, VertexId v) { return v.index < points.size() ? points[v.index] : v.index; }

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json worst_triangle(const WorstTriangle& worst, Points points) {
  Json vertices = Json::array();
  for (const VertexId v : worst.vertices) vertices.push_back(point_of(points, v));
  const auto name = [points](VertexId v) { return std::to_string(point_of(points, v)); };
  return {{"triangle", worst.triangle.index},
          {"vertices", std::move(vertices)},
          {"at", {worst.at.x, worst.at.y}},
          {"h_over_l", number_or_null(worst.h_over_l)},
          {"angle_deg", number_or_null(worst.angle_deg)},
          {"why", renumber(worst.why, name)}};
}

Json worst_tetrahedron(const tets::WorstTet& worst, Points points) {
  Json vertices = Json::array();
  for (const VertexId v : worst.vertices) vertices.push_back(point_of(points, v));
  const auto name = [points](VertexId v) { return std::to_string(point_of(points, v)); };
  return {{"tetrahedron", worst.tetrahedron.index},
          {"vertices", std::move(vertices)},
          {"at", {worst.at.x, worst.at.y, worst.at.z}},
          {"h_over_l", number_or_null(worst.h_over_l)},
          {"dihedral_deg", number_or_null(worst.dihedral_deg)},
          {"why", renumber(worst.why, name)}};
}

template <class Report>
Json measures_json(std::span<const MeasureRow<Report>> rows, const Report& quality) {
  Json json;
  for (const MeasureRow<Report>& measure : rows) {
    const double value = measure.of(quality);
    json[std::string(measure.key)] = measure.count ? Json(static_cast<std::uint64_t>(value)) : number_or_null(value);
  }
  return json;
}

Json to_json(const Histogram& h) { return {{"low", h.low}, {"high", h.high}, {"counts", h.counts}}; }

Json to_json(const tets::Quality& quality, Points points) {
  Json json = measures_json(tets::quality_measures(), quality);
  json["histograms"] = {{"dihedrals", to_json(quality.dihedrals)}, {"h_over_l", to_json(quality.h_over_l)}};
  json["worst"] = Json::array();
  for (const tets::WorstTet& worst : quality.worst) json["worst"].push_back(worst_tetrahedron(worst, points));
  return json;
}

Json to_json(const Quality& quality, Points points) {
  Json json = measures_json(quality_measures(), quality);
  Json& energy = json["energy"];
  for (std::size_t row = 0; row < energies().size(); ++row) {
    Json& stars = energy[std::string(energies()[row].name)] = Json::array();
    for (const double value : quality.energy[row]) stars.push_back(number_or_null(value));
  }
  json["histograms"] = {{"angles", to_json(quality.angles)},
                        {"h_over_l", to_json(quality.h_over_l)},
                        {"d_over_l", to_json(quality.d_over_l)}};
  json["worst"] = Json::array();
  for (const WorstTriangle& worst : quality.worst) json["worst"].push_back(worst_triangle(worst, points));
  return json;
}

Json to_json(const Outcome& outcome) {
  const Requirement& requirement = outcome.requirement;
  return {{"text", requirement.text},
          {"key", requirement.key},
          {"wants", sign(requirement.better)},
          {"value", requirement.value},
          {"found", number_or_null(outcome.found)},
          {"met", outcome.met}};
}

Json to_json(std::span<const Outcome> outcomes) {
  Json list = Json::array();
  for (const Outcome& outcome : outcomes) list.push_back(to_json(outcome));
  return list;
}

Json to_json(const Spread& s) {
  return {{"min", number_or_null(s.min)},
          {"p05", number_or_null(s.p05)},
          {"median", number_or_null(s.median)},
          {"p95", number_or_null(s.p95)},
          {"max", number_or_null(s.max)}};
}

Json to_json(const SizeReport& size) {
  return {{"over_field", to_json(size.over_field)},
          {"gradation", to_json(size.gradation)},
          {"largest_edge_ratio", number_or_null(size.largest_edge_ratio)},
          {"vertices_outside_field", size.outside}};
}

/// `elements`: "triangles" or "tetrahedra".
Json to_json(const io::DataReport& data, const std::string& elements) {
  return {{"points", data.points},
          {"points_moved", data.points_moved},
          {"distance", to_json(data.distance)},
          {"points_inserted", data.points_inserted},
          {"interpolated", data.interpolated},
          {"kept", data.kept},
          {"dropped", data.dropped},
          {elements, data.triangles},
          {elements + "_changed", data.triangles_changed},
          {"of_" + elements, data.of_triangles}};
}

Json to_json(const SweepRecord& record) {
  return {{"sweep", record.sweep},
          {"energy", number_or_null(record.energy)},
          {"bad", record.bad},
          {"flips", record.flips},
          {"length_parameter", number_or_null(record.length_parameter)},
          {"seconds", record.seconds},
          {"objective", name(record.objective)}};
}

std::string dump(const Json& json) {
  // A path need not be UTF-8; JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string quality_json(const Quality& quality, std::span<const std::size_t> points) {
  return dump(to_json(quality, points));
}

std::string quality_json(const tets::Quality& quality, std::span<const std::size_t> points) {
  return dump(to_json(quality, points));
}

namespace {

template <class Report>
std::string dump_check(const std::string& path, const Report& quality, Points points,
                       std::span<const Outcome> outcomes) {
  Json json = {{"schema", kSchema}, {"file", path}};
  json.update(to_json(quality, points));
  json["requirements"] = to_json(outcomes);
  return dump(json);
}

}  // namespace

std::string check_json(const std::string& path, const Quality& quality, std::span<const std::size_t> points,
                       std::span<const Outcome> outcomes) {
  return dump_check(path, quality, points, outcomes);
}

std::string check_json(const std::string& path, const tets::Quality& quality, std::span<const std::size_t> points,
                       std::span<const Outcome> outcomes) {
  return dump_check(path, quality, points, outcomes);
}

std::string json_list(std::span<const std::string> reports) {
  std::string list;
  for (const std::string& report : reports)
    list += (list.empty() ? "[\n" : ",\n") + report.substr(0, report.size() - 1);
  return (list.empty() ? "[" : list + "\n") + "]\n";
}

namespace {

/// The members that the reports of both kinds of meshes begin with.
template <class Record>
Json begin_report(const Record& record) {
  Json json;
  json["schema"] = kSchema;
  json["command"] = record.command;
  json["version"] = version();
  json["options"] = Json::parse(record.options);
  json["settings"] = Json::parse(record.settings);
  json["before"] = to_json(record.before, record.points_before);
  json["after"] = to_json(record.after, Points());
  json["requirements"] = to_json(record.outcomes);
  json["sweeps"] = record.report.sweeps;
  json["seconds"] = record.report.seconds;
  json["stopped"] = name(record.report.stopped);
  return json;
}

/// The members that they end with.
template <class Record>
std::string end_report(Json json, const Record& record) {
  json["warnings"] = record.warnings;
  json["history"] = Json::array();
  for (const SweepRecord& sweep : record.report.history) json["history"].push_back(to_json(sweep));
  return dump(json);
}

}  // namespace

std::string optimize_json(const TetOptimizeRecord& record) {
  Json json = begin_report(record);
  json["objective_before"] = number_or_null(record.report.objective_before);
  json["objective_after"] = number_or_null(record.report.objective_after);
  json["vertices_removed"] = record.report.vertices_removed;
  json["vertices_inserted"] = record.report.vertices_inserted;
  json["flips"] = record.report.flips;
  json["data"] = to_json(record.data, "tetrahedra");
  return end_report(std::move(json), record);
}

std::string optimize_json(const OptimizeRecord& record) {
  Json json = begin_report(record);
  json["objective"] = name(record.report.objective);
  json["objective_before"] = number_or_null(record.report.objective_before);
  json["objective_after"] = number_or_null(record.report.objective_after);
  json["vertices_removed"] = record.report.vertices_removed;
  json["hidden_vertices"] = Json::array();
  for (const VertexId v : record.report.hidden) json["hidden_vertices"].push_back(v.index);
  json["vertices_inserted"] = record.report.vertices_inserted;
  json["flips"] = record.report.flips;
  json["size"] = {{"before", to_json(record.report.size.before)}, {"after", to_json(record.report.size.after)}};
  json["data"] = to_json(record.data, "triangles");
  if (!record.solver_errors.empty()) json["errors"] = Json::parse(record.solver_errors);
  json["notes"] = record.report.notes;
  return end_report(std::move(json), record);
}

std::string history_csv(std::span<const SweepRecord> history) {
  std::string csv = "sweep,energy,bad,flips,length_parameter,seconds,objective\n";
  for (const SweepRecord& record : history) {
    csv += fmt::format("{},{},{},{},{},{},{}\n", record.sweep, record.energy, record.bad, record.flips,
                       record.length_parameter, record.seconds, name(record.objective));
  }
  return csv;
}

}  // namespace temper::app
