
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

/// Adds reasons, for the kinds of cells whose pages have them. `searched`: otherwise the list is empty.
void add_reasons(Json& json, const Mesh& mesh, const Quality& quality, const InputNames* names, bool searched = true) {
  json["reasons"] = searched ? reasons_json(mesh, quality, names) : Json::array();
}
void add_reasons(Json& /*json*/, const tets::TetMesh& /*mesh*/, const tets::Quality& /*quality*/,
                 const tets::InputNames* /*names*/, bool /*searched*/ = true) {}

}  // namespace

template <class Subject>
std::string check_html(const std::string& command, const InputOf<Subject>& input,
                       const typename Subject::Quality& quality) {
  Json json = {{"verb", "check"},
               {"version", version()},
               {"command", command},
               {"after", json_of(quality, input.points)},
               {"warnings", input.warnings()}};
  use_numbers(json["after"], quality, input.names.get());
  add_reasons(json, input.mesh(), quality, input.names.get());
  return io::html_report({html_mesh(input.mesh(), input.names.get()), std::nullopt, input.path, in_a_line(json)});
}
template <class Subject>
std::string optimize_html(const RunPage<Subject>& page) {
  const auto& [record, input, before, mesh] = page;
  const auto* const names = input.file.numbering.get();
  Json json = {{"verb", "optimize"}};
  json.update(Json::parse(optimize_json(record)));
  forget_time(json);
  use_numbers(json["before"], record.before, input.names.get());
  use_numbers(json["after"], record.after, names);
  // A run that has to end now searches for no reasons.
  add_reasons(json, mesh, record.after, names, !stopped_early(record.report.stopped));
  return io::html_report({html_mesh(mesh, names), html_mesh(before, input.names.get()), input.path, in_a_line(json)});
}
#define TEMPER_MAKE(S)                                                                       \
  template std::string check_html(const std::string&, const InputOf<S>&, const S::Quality&); \
  template std::string optimize_html(const RunPage<S>&);
TEMPER_EACH_FLAT_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

}  // namespace temper::app
