#include <fmt/format.h>

#include <algorithm>

#include "console.hpp"
#include "files/input.hpp"
#include "reports/json_of.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

constexpr std::size_t kIndent = 4;
constexpr std::size_t kQuestion = 6;  // "what: "

bool is_split(const Reason& reason) { return reason.kind == ReasonKind::split; }
bool is_conflict(const Reason& reason) {
  return !is_split(reason) && reason.kind != ReasonKind::weights && reason.kind != ReasonKind::undecided;
}

/// Reasons of one sort, and the triangles that they are for.
struct Count {
  std::size_t reasons = 0, bad = 0;
};
template <class Which>
Count count(const Explanation& e, const Which& which) {
  Count c;
  for (const Reason& reason : e.reasons) {
    if (!which(reason)) continue;
    ++c.reasons;
    c.bad += reason.bad.size();
  }
  return c;
}
std::string wrapped(const std::string& text, std::size_t indent, const TextStyle& style) {
  const std::size_t width = style.columns > indent + 40 ? style.columns - indent : 40;
  std::string result;
  for (const std::string& line : wrap(style.utf8 ? text : in_ascii(text), width)) {
    result += (result.empty() ? "" : std::string(indent, ' ')) + line + "\n";
  }
  return result;
}

/// " 3. at (1, 2)", the first line of a place.
std::string place_text(std::size_t number, const std::string& at) {
  return fmt::format("{}at ({})\n", pad_left(std::to_string(number) + ". ", kIndent), at);
}
/// "    why:  …", a line of a place.
std::string answer(std::string_view question, const std::string& text, const TextStyle& style) {
  return std::string(kIndent, ' ') + pad_right(std::string(question) + ":", kQuestion) +
         wrapped(text, kIndent + kQuestion, style);
}

/// The verdict on weights alone, if nothing else changes.
template <class Subject>
std::string on_weights(Feasibility verdict, std::size_t changed, std::size_t vertices, double margin) {
  if (verdict == Feasibility::undecided)
    return "It is not known if weights alone can make all of them well-centered.\n";
  if (verdict == Feasibility::infeasible)
    return fmt::format("If no vertex moves and no {} flips, no weights make all of them well-centered.\n",
                       Subject::link);
  return fmt::format("If no vertex moves, weights make all of them well-centered: {} of {} change (margin {:.4g}).\n",
                     changed, vertices, margin);
}

std::string rest(std::size_t shown, std::size_t all) {
  return all > shown ? fmt::format("and {} more (--limit {} or --json has all)\n", all - shown, all) : "";
}

// Of triangles.

constexpr const char* kKeepsWeights =
    "The mesh has quadrilaterals, so weights cannot change. Vertices have to move. Next: temper optimize IN -o OUT\n";

std::string headline(const Explanation& e, const Input& input) {
  std::string text = fmt::format("{}: {}\n", input.path, well_centered<Triangles>(e.bad, e.triangles));
  if (e.bad == 0) return text;
  if (e.verdict == Feasibility::undecided && count_quadrilaterals(input.mesh()) > 0) return text + kKeepsWeights;
  return text + on_weights<Triangles>(e.verdict, e.changed, input.mesh().n_vertices(), e.margin);
}

std::string summary(const Explanation& e) {
  const Count conflicts = count(e, is_conflict);
  const Count weights = count(e, [](const Reason& r) { return r.kind == ReasonKind::weights; });
  const Count undecided = count(e, [](const Reason& r) { return r.kind == ReasonKind::undecided; });
  const Count splits = count(e, is_split);
  std::string text;
  if (splits.reasons > 0) {
    text += fmt::format("  {} at {} that must be split: no well-centered mesh keeps {}\n", splits.bad,
                        plural(splits.reasons, "edge", "edges"), splits.reasons == 1 ? "it" : "them");
  }
  if (conflicts.reasons > 0) {
    text += fmt::format("  {} in {}: small sets of triangles for which no weights exist\n", conflicts.bad,
                        plural(conflicts.reasons, "conflict", "conflicts"));
  }
  if (weights.reasons > 0) {
    text += fmt::format("  {} in {} for which weights exist, but have not been found yet\n", weights.bad,
                        plural(weights.reasons, "place", "places"));
  }
  if (undecided.reasons > 0) {
    text += fmt::format("  {} in {} for which neither weights nor a proof were found\n", undecided.bad,
                        plural(undecided.reasons, "place", "places"));
  }
  return text;
}

/// The command that applies the cure, perhaps with other changes; empty when no command does.
std::string command(const Mesh& mesh, const Cure& cure) {
  using Action = Cure::Action;
  const auto on_line = [&] {  // inside the domain, but repairs do not split such edges
    const HalfedgeId h = mesh.find_halfedge(cure.edge[0], cure.edge[1]);
    return h.valid() && mesh.is_constrained(h);
  };
  std::string split_of_lines = mesh.space().is_plane() ? "temper optimize --boundary split" : "";
  switch (cure.action) {
    case Action::find_weights:
      if (cure.changed == 0) return "";
      return cure.margin < WeightOptions().margin ? "temper weights --mode margin" : "temper weights";
    case Action::optimize:
    case Action::move_vertex:
    case Action::flip_edge:
      return "temper optimize";
    case Action::insert_vertex:
      return "temper optimize --set repair=vertices";
    case Action::split_edge:
      return on_line() ? split_of_lines : "temper optimize --set repair=vertices";
    case Action::split_boundary:
    case Action::split_interface:
      return split_of_lines;
  }
  return "";
}

std::string paragraph(const Reason& reason, std::size_t number, const Input& input, const TextStyle& style) {
  const ReasonWords words = reason_words(input.mesh(), reason, input.names.get());
  std::string text = place_text(number, fmt::format("{:.9g}, {:.9g}", reason.at.x, reason.at.y)) +
                     answer("what", words.what, style) + answer("why", words.why, style);
  for (const Cure& cure : reason.cures) {
    const std::string how = command(input.mesh(), cure);
    text +=
        answer("cure", cure_text(input.mesh(), cure, input.names.get()) + (how.empty() ? "" : " Try: " + how), style);
  }
  return text;
}

/// A sort of reasons, and its introduction for new users.
struct Section {
  std::string title, about;
};
const Section kSplits = {"Edges that must be split",
                         "The dual of an edge crosses it in one place. A fixed vertex near the edge allows a crossing "
                         "near one end only, and two such vertices can leave no place. Then no change inside helps: "
                         "split the edge, or move one of these vertices."};
const Section kConflicts = {"Conflicts",
                            "A dual edge crosses its edge in one place, the same for the triangles on both sides. An "
                            "obtuse triangle is well-centered only if the edges at its obtuse corner are crossed close "
                            "to that corner. The edge across from the corner must be crossed away from both ends. If "
                            "the two sides need different places, no weights help: a vertex or an edge "
                            "has to change."};
const Section kUndecided = {"Not known", "Neither weights nor a proof that there are none were found."};
const Section kWeights = {"Weights exist",
                          "No vertex has to move here and no edge has to flip: the weights have to change."};
const Section kKeptWeights = {"Weights would help",
                              "A mesh with quadrilaterals keeps its weights, so a vertex has to move."};

template <class Which>
std::string section(const Section& kind, const Explanation& e, const Input& input, std::size_t limit,
                    const TextStyle& style, const Which& which) {
  const std::size_t all = count(e, which).reasons;
  if (all == 0 || limit == 0) return "";
  std::string text = fmt::format("\n{}{}\n", kind.title, all > 1 ? ", worst first" : "");
  text += wrapped(kind.about, 0, style);
  std::size_t number = 0;
  for (const Reason& reason : e.reasons) {
    if (!which(reason) || number == limit) continue;
    text += paragraph(reason, ++number, input, style);
  }
  return text + rest(limit, all);
}

// Of tetrahedra.

/// The command that may cure a tetrahedron.
std::string command(tets::Cure cure) {
  if (cure == tets::Cure::weights) return "temper weights";
  if (cure == tets::Cure::optimize) return "temper optimize";
  return cure == tets::Cure::slide ? "temper optimize --boundary slide" : "temper optimize --boundary split";
}

std::string summary(const tets::Explanation& e) {
  const std::size_t movable = e.bad - e.all_on_boundary;
  std::string text;
  if (movable > 0)
    text += fmt::format("  {} with an inner vertex, whose move may help. Try: {}\n", movable, command(e.cure(false)));
  if (e.all_on_boundary > 0)
    text += fmt::format("  {} with all corners on the boundary{} may help. Try: {}\n", e.all_on_boundary,
                        e.has_interfaces ? " or on interfaces: weights, and vertices that slide there,"
                                         : ": weights, flips and new vertices",
                        command(e.cure(true)));
  return text;
}

std::string paragraph(const TetInput& input, const tets::Reason& reason, std::size_t number, const TextStyle& style) {
  const auto name = [&](VertexId v) { return input.vertex_number(v); };
  const auto [a, b, c, d] = input.mesh().points(reason.tetrahedron);
  const Vec3 at = reason.at, center = reason.orthocenter;
  std::string text =
      place_text(number, fmt::format("{:.9g}, {:.9g}, {:.9g}", at.x, at.y, at.z)) +
      answer("what",
             fmt::format("Tetrahedron {} ({}) with the weights {:.6g} {:.6g} {:.6g} {:.6g} and its orthocenter at "
                         "({:.9g}, {:.9g}, {:.9g}).",
                         input.element_number(reason.tetrahedron), input.vertex_numbers(reason.vertices, " "), a.w, b.w,
                         c.w, d.w, center.x, center.y, center.z),
             style) +
      answer("why", renumber(reason.why, name) + ".", style);
  for (const tets::FaceHeight& face : reason.faces) {
    text += fmt::format("{}{} {}: h = {:.4g}, h/l = {:.4g}{}{}\n", std::string(kIndent + kQuestion, ' '),
                        face.at_interface ? "interface face"
                        : face.boundary   ? "boundary face"
                                          : "face",
                        input.vertex_numbers(face.vertices, "-"), face.h, face.h_over_l,
                        face.outside ? ", outside" : "", face.crossed ? "" : ", does not contain its own orthocenter");
  }
  return text + answer("cure", "Try: " + command(reason.cure), style);
}

// Of duals.

std::string_view dual_name(Criterion criterion, DualKind kind) {
  const bool coefficient = criterion == Criterion::coefficients;
  if (kind == DualKind::region) return coefficient ? "coefficient of one region" : "distance from the interface";
  if (kind == DualKind::boundary && !coefficient) return "distance from the boundary";
  return coefficient ? "coefficient" : "distance";
}

template <class Subject>
std::string paragraph(const InputOf<Subject>& input, const DualReason& reason, Criterion criterion, std::size_t number,
                      const TextStyle& style) {
  const std::string third = Subject::cells == CellKinds::triangles ? "" : fmt::format(", {:.9g}", reason.at.z);
  const bool is_edge = reason.vertices.size() == 2;
  const auto name = [&](VertexId v) { return input.vertex_number(v); };
  return place_text(number, fmt::format("{:.9g}, {:.9g}{}", reason.at.x, reason.at.y, third)) +
         answer(
             "what",
             fmt::format("{} {}: {}{} {:.4g}.", is_edge ? "Edge" : "Face", input.vertex_numbers(reason.vertices, "-"),
                         dual_name(criterion, reason.kind), over_length<Subject>(criterion), reason.over_l),
             style) +
         answer("why", renumber(reason.why, name) + ".", style) +
         answer("cure",
                reason.kind == DualKind::inside
                    ? "Other weights, a flip or moved vertices may help."
                    : fmt::format("Other weights, moved vertices or a new vertex on this {} may help.",
                                  is_edge ? "edge" : "face"),
                style);
}

}  // namespace

template <class Subject>
std::string explanation_text(const DualExplanation& e, const InputOf<Subject>& input, const TextStyle& style) {
  std::string text = fmt::format("{}: {}\n", input.path, count_of_duals(e.violations, e.criterion));
  if (e.reasons.empty()) return text;
  text += e.violations > 1 ? "\nThe worst first\n" : "\n";
  for (std::size_t i = 0; i < e.reasons.size(); ++i)
    text += paragraph<Subject>(input, e.reasons[i], e.criterion, i + 1, style);
  return text + rest(e.reasons.size(), e.violations);
}
#define TEMPER_MAKE(S) \
  template std::string explanation_text(const DualExplanation&, const InputOf<S>&, const TextStyle&);
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

std::string explanation_json(const DualExplanation& e, std::span<const std::size_t> points) {
  Json json = {{"schema", kSchema}};
  json.update(json_of(e, points));
  return dump(json);
}

std::string explanation_text(const Explanation& e, const Input& input, std::size_t limit, const TextStyle& style) {
  std::string text = headline(e, input) + summary(e);
  text += section(kSplits, e, input, limit, style, is_split);
  text += section(kConflicts, e, input, limit, style, is_conflict);
  text += section(kUndecided, e, input, limit, style, [](const Reason& r) { return r.kind == ReasonKind::undecided; });
  const Section& weights = count_quadrilaterals(input.mesh()) > 0 ? kKeptWeights : kWeights;
  text += section(weights, e, input, limit, style, [](const Reason& r) { return r.kind == ReasonKind::weights; });
  return text;
}

std::string explanation_json(const Explanation& e, const Input& input, const CopyNumbers& numbers) {
  const VertexNames names(nullptr, input.points, input.mesh().n_vertices());
  Json json = {{"schema", kSchema}};
  json.update(json_of(ExplanationReport{input.mesh(), e, &names}, input.points));
  for (std::size_t i = 0; i < e.reasons.size(); ++i) {
    if (const Certificate& proof = e.reasons[i].certificate; !proof.terms.empty())
      json["reasons"][i]["certificate"] = Json::parse(io::certificate_to_json(proof, numbers.points, numbers.copies));
    Json& cures = json["reasons"][i]["cures"];
    for (std::size_t k = 0; k < cures.size(); ++k) {
      const std::string how = command(input.mesh(), e.reasons[i].cures[k]);
      cures[k]["command"] = how.empty() ? Json(nullptr) : Json(how);
    }
  }
  return dump(json);
}

std::string explanation_text(const tets::Explanation& e, const TetInput& input, std::size_t /*limit*/,
                             const TextStyle& style) {
  std::string text = fmt::format("{}: {}\n", input.path, verdict(e.quality));
  if (e.bad == 0) return text;
  text += on_weights<Tetrahedra>(e.verdict(), e.weights ? e.weights->moved : 0, e.quality.vertices,
                                 e.weights ? e.weights->margin : 0);
  text += summary(e);
  const std::size_t shown = e.reasons.size();
  if (shown == 0) return text;
  text += e.bad > 1 ? "\nBad tetrahedra, worst first\n" : "\nThe bad tetrahedron\n";
  for (std::size_t i = 0; i < shown; ++i) text += paragraph(input, e.reasons[i], i + 1, style);
  text += rest(shown, e.bad);
  return text;
}

std::string explanation_text(const surfaces::Explanation& e, const SurfaceInput& input, std::size_t /*limit*/,
                             const TextStyle& style) {
  std::string text = fmt::format("{}: {}\n", input.path, well_centered<Surfaces>(e.bad, e.triangles));
  if (e.bad == 0) return text;
  text += on_weights<Surfaces>(e.verdict, e.changed, input.mesh().n_vertices(), e.margin);
  const auto name = [&](VertexId v) { return input.vertex_number(v); };
  for (std::size_t i = 0; i < e.worst.size(); ++i) {
    const WorstTriangle& worst = e.worst[i];
    const auto [a, b, c] = input.mesh().points(worst.triangle);
    const Vec3 at = (1.0 / 3) * (a.position() + b.position() + c.position());
    text +=
        (i == 0 ? "\nThe worst first\n" : "") +
        place_text(i + 1, fmt::format("{:.9g}, {:.9g}, {:.9g}", at.x, at.y, at.z)) +
        answer("what",
               fmt::format("Triangle {} ({}): h/l {:.4g}, largest angle {:.4g}.", input.element_number(worst.triangle),
                           input.vertex_numbers(worst.vertices, " "), worst.h_over_l, worst.angle_deg),
               style) +
        answer("why", renumber(worst.why, name) + ".", style);
  }
  return text + rest(e.worst.size(), e.bad) +
         fmt::format("Next: {} -o OUT\n", command_line("optimize", input.path, {}));
}

std::string explanation_json(const surfaces::Explanation& e, const SurfaceInput& input) {
  Json json = {{"schema", kSchema}};
  json.update(json_of(e, input.points));
  return dump(json);
}

std::string explanation_json(const tets::Explanation& e, const TetInput& input) {
  Json json = {{"schema", kSchema}};
  json.update(json_of(tets::ExplanationReport{input.mesh(), e}, input.points));
  for (std::size_t i = 0; i < e.reasons.size(); ++i) json["reasons"][i]["command"] = command(e.reasons[i].cure);
  return dump(json);
}

}  // namespace temper::app
