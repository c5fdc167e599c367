
#include "exit.hpp"
#include "reports/json_of.hpp"
#include "reports/quality_report.hpp"
#include "temper/detail/html.hpp"
#include "temper/detail/lp.hpp"
#include "temper/detail/version.hpp"
#include "temper/explain.hpp"

namespace temper::app {
namespace {

// To explain a bad triangle takes a millisecond, to search for its cures some ten: all together about a second.
constexpr std::size_t kMostExplained = 500;
constexpr std::size_t kCures = 20;

/// The reasons why triangles are not well-centered, in the user's numbers. None if too many are, or some are inverted.
Json reasons_json(const Mesh& mesh, const Quality& quality, const InputNames* names) {
  Json json = Json::array();
  const std::size_t bad = bad_elements(quality);
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
template <class AnyQuality>
void use_numbers(Json& json, const AnyQuality& quality, const InputNames* names) {
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

io::AnyHtmlMesh html_mesh(const Mesh& mesh, const InputNames* names) { return io::HtmlMesh{mesh, names}; }
io::AnyHtmlMesh html_mesh(const tets::TetMesh& mesh, const tets::InputNames* names) {
  return io::HtmlTets{mesh, names};
}

std::string in_a_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// The members of a page of `check`, with the user's numbers.
template <class AnyInput, class AnyQuality>
Json check_page(const std::string& command, const AnyInput& input, const AnyQuality& quality,
                const std::string& measures) {
  Json json = {{"verb", "check"},
               {"version", version()},
               {"command", command},
               {"after", Json::parse(measures)},
               {"warnings", input.warnings()}};
  use_numbers(json["after"], quality, input.names.get());
  return json;
}

template <class Page>
Json optimize_page(const Page& page) {
  Json json = {{"verb", "optimize"}};
  json.update(Json::parse(optimize_json(page.record)));
  forget_time(json);
  use_numbers(json["before"], page.record.before, page.input.names.get());
  use_numbers(json["after"], page.record.after, page.input.file.numbering.get());
  return json;
}

template <class Page>
std::string optimize_html(const Page& page, const Json& json) {
  return io::html_report({html_mesh(page.mesh, page.input.file.numbering.get()),
                          html_mesh(page.before, page.input.names.get()), page.input.path, in_a_line(json)});
}

template <class AnyInput>
std::string check_html(const AnyInput& input, const Json& json) {
  return io::html_report({html_mesh(input.mesh(), input.names.get()), std::nullopt, input.path, in_a_line(json)});
}

}  // namespace

std::string check_html(const std::string& command, const Input& input, const Quality& quality) {
  Json json = check_page(command, input, quality, quality_json(quality, input.points));
  json["reasons"] = reasons_json(input.mesh(), quality, input.names.get());
  return check_html(input, json);
}

std::string check_html(const std::string& command, const TetInput& input, const tets::Quality& quality) {
  return check_html(input, check_page(command, input, quality, quality_json(quality, input.points)));
}

std::string optimize_html(const OptimizePage& page) {
  Json json = optimize_page(page);
  // A run that has to end now searches for no reasons.
  const bool ends_now = stopped_early(page.record.report.stopped);
  json["reasons"] =
      ends_now ? Json::array() : reasons_json(page.mesh, page.record.after, page.input.file.numbering.get());
  return optimize_html(page, json);
}

std::string optimize_html(const TetOptimizePage& page) { return optimize_html(page, optimize_page(page)); }

}  // namespace temper::app
