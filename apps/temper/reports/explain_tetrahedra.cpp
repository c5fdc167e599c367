#include <fmt/format.h>

#include <cmath>

#include "console.hpp"
#include "reports/json_of.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kTetIndent = 4;

/// The command that may cure a tetrahedron.
std::string command(tets::Cure cure) {
  if (cure == tets::Cure::weights) return "temper weights";
  return cure == tets::Cure::optimize ? "temper optimize" : "temper optimize --boundary split";
}

std::string on_weights(const tets::Explanation& e) {
  if (e.verdict() == Feasibility::undecided)
    return "It is not known if weights alone can make all of them well-centered.\n";
  if (e.verdict() == Feasibility::infeasible)
    return "If no vertex moves and no face flips, no weights make all of them well-centered.\n";
  return fmt::format("If no vertex moves, weights make all of them well-centered: {} of {} change (margin {:.4g}).\n",
                     e.weights->moved, e.quality.vertices, e.weights->margin);
}

std::string summary(const tets::Explanation& e) {
  const std::size_t movable = e.bad - e.all_on_boundary;
  std::string text;
  if (movable > 0)
    text += fmt::format("  {} with an inner vertex, whose move may help. Try: {}\n", movable, command(e.cure(false)));
  if (e.all_on_boundary > 0)
    text += fmt::format("  {} with all corners on the boundary: weights, flips and new vertices may help. Try: {}\n",
                        e.all_on_boundary, command(e.cure(true)));
  return text;
}

std::string joined(const TetInput& input, std::span<const VertexId> vertices, std::string_view between) {
  std::string text;
  for (const VertexId v : vertices) text += (text.empty() ? "" : std::string(between)) + input.vertex_number(v);
  return text;
}

std::string paragraph(const TetInput& input, const tets::Reason& reason, std::size_t number, const TextStyle& style) {
  const std::string blank(kTetIndent, ' ');
  const auto name = [&](VertexId v) { return input.vertex_number(v); };
  std::string why = fmt::format("Tetrahedron {} ({}) at ({:.9g}, {:.9g}, {:.9g}): {}.",
                                input.element_number(reason.tetrahedron), joined(input, reason.vertices, " "),
                                reason.at.x, reason.at.y, reason.at.z, renumber(reason.why, name));
  if (!style.utf8) why = in_ascii(why);
  std::string text = pad_left(std::to_string(number) + ". ", kTetIndent);
  bool first = true;
  for (const std::string& line : wrap(why, style.columns > kTetIndent + 40 ? style.columns - kTetIndent : 40))
    text += (std::exchange(first, false) ? "" : blank) + line + "\n";
  const auto [a, b, c, d] = input.mesh().points(reason.tetrahedron);
  const Vec3 center = reason.orthocenter;
  text += fmt::format("{}orthocenter ({:.9g}, {:.9g}, {:.9g}), weights {:.6g} {:.6g} {:.6g} {:.6g}\n", blank, center.x,
                      center.y, center.z, a.w, b.w, c.w, d.w);
  for (const tets::FaceHeight& face : reason.faces) {
    text += fmt::format("{}{} {}: h = {:.4g}, h/l = {:.4g}{}{}\n", blank, face.boundary ? "boundary face" : "face",
                        joined(input, face.vertices, "-"), face.h, face.h_over_l, face.outside ? ", outside" : "",
                        face.crossed ? "" : ", does not contain its own orthocenter");
  }
  return text + blank + "- Try: " + command(reason.cure) + "\n";
}

}  // namespace

std::string explanation_text(const tets::Explanation& e, const TetInput& input, const TextStyle& style) {
  std::string text = fmt::format("{}: {}\n", input.path, verdict(e.quality));
  if (e.bad == 0) return text;
  text += on_weights(e) + summary(e);
  const std::size_t shown = e.reasons.size();
  if (shown == 0) return text;
  text += e.bad > 1 ? "\nBad tetrahedra, worst first\n" : "\nThe bad tetrahedron\n";
  for (std::size_t i = 0; i < shown; ++i) text += paragraph(input, e.reasons[i], i + 1, style);
  if (e.bad > shown) text += fmt::format("and {} more (--limit {} or --json has all)\n", e.bad - shown, e.bad);
  return text;
}

std::string explanation_json(const tets::Explanation& e, const TetInput& input) {
  Json json = {{"schema", kSchema}};
  json.update(json_of(tets::ExplanationReport{input.mesh(), e}, input.points));
  for (std::size_t i = 0; i < e.reasons.size(); ++i) json["reasons"][i]["command"] = command(e.reasons[i].cure);
  return dump(json);
}

}  // namespace temper::app
