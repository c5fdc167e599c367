#include <nlohmann/json.hpp>

#include "exit.hpp"
#include "reports/quality_report.hpp"
#include "temper/detail/html.hpp"
#include "temper/detail/lp.hpp"
#include "temper/detail/version.hpp"
#include "temper/explain.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;

// To explain a bad triangle takes a millisecond, to search for its cures some ten: all together about a second.
constexpr std::size_t kMostExplained = 500;
constexpr std::size_t kCures = 20;

/// The reasons why triangles are not well-centered, in the user's numbers. None if too many are, or some are inverted.
Json reasons_json(const Mesh& mesh, const Quality& quality, const InputNames* names) {
  Json json = Json::array();
  const std::size_t bad = bad_triangles(quality);
  if (bad == 0 || bad > kMostExplained || quality.inverted_triangles > 0) return json;
  const auto solver = clp_solver();
  ExplainOptions options;
  options.cures = kCures;
  const Explanation explanation = or_fail(explain(mesh, *solver, options));
  for (const Reason& reason : explanation.reasons) {
    Json triangles = Json::array(), cures = Json::array();
    for (const TriangleId t : reason.bad) triangles.push_back(t.index);
    for (const Cure& cure : reason.cures) cures.push_back(cure_text(mesh, cure, names));
    json.push_back({{"kind", name(reason.kind)},
                    {"triangles", std::move(triangles)},
                    {"text", reason_text(mesh, reason, names)},
                    {"cures", std::move(cures)}});
  }
  return json;
}

/// Puts sentences in the user's numbers into the measures of a mesh: numbers in `json` count from 0.
void use_numbers(Json& json, const Quality& quality, const InputNames* names) {
  const auto number = [names](VertexId v) {
    const std::string word = names == nullptr ? std::to_string(v.index) : names->point(v.index);
    return word.substr(word.rfind(' ') + 1);
  };
  for (std::size_t i = 0; i < quality.worst.size(); ++i)
    json["worst"][i]["why"] = renumber(quality.worst[i].why, number);
}

/// Removes all seconds: the same run writes the same page.
void forget_time(Json& json) {
  if (json.is_object()) json.erase("seconds");
  for (Json& item : json) {
    if (item.is_structured()) forget_time(item);
  }
}

std::string in_a_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string check_html(const std::string& command, const Input& input, const Quality& quality) {
  Json json = {{"verb", "check"},
               {"version", version()},
               {"command", command},
               {"after", Json::parse(quality_json(quality, input.points))},
               {"warnings", input.warnings()},
               {"reasons", reasons_json(input.mesh(), quality, input.names.get())}};
  use_numbers(json["after"], quality, input.names.get());
  return io::html_report({{input.mesh(), input.names.get()}, std::nullopt, input.path, in_a_line(json)});
}

std::string optimize_html(const OptimizePage& page) {
  Json json = {{"verb", "optimize"}};
  json.update(Json::parse(optimize_json(page.record)));
  forget_time(json);
  const InputNames* names = page.input.file.numbering.get();
  use_numbers(json["before"], page.record.before, page.input.names.get());
  use_numbers(json["after"], page.record.after, names);
  // A run that has to end now searches for no reasons.
  const bool ends_now = stopped_early(page.record.report.stopped);
  json["reasons"] = ends_now ? Json::array() : reasons_json(page.mesh, page.record.after, names);
  return io::html_report(
      {{page.mesh, names}, io::HtmlMesh{page.before, page.input.names.get()}, page.input.path, in_a_line(json)});
}

}  // namespace temper::app
