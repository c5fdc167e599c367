#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "console.hpp"
#include "options/options.hpp"
#include "reports/json_of.hpp"
#include "reports/reports.hpp"
#include "temper/detail/certificate_io.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;
using Kind = WeightConstraint::Kind;

constexpr std::size_t kListed = 12;  // what fits on a screen; the JSON has all

std::string listed(const std::vector<std::string>& lines) {
  std::string text;
  for (std::size_t i = 0; i < std::min(lines.size(), kListed); ++i) text += "  " + lines[i] + "\n";
  if (lines.size() > kListed) text += fmt::format("  and {} more (--json has all)\n", lines.size() - kListed);
  return text;
}

std::string verdict_text(const WeightsRecord& r) {
  const ConstraintsInfo& row = r.constraints;
  switch (r.report.verdict) {
    case Feasibility::feasible:
      return fmt::format("feasible: {}", row.success);
    case Feasibility::infeasible:
      if (!r.search) return fmt::format("infeasible: {}", row.failure);
      return fmt::format("infeasible: {}, with {} connectivity", row.failure,
                         r.search->end == SearchEnd::none_exists ? "any" : "this");
    case Feasibility::undecided:
      return "undecided: the best margin is zero up to rounding, or the solver failed";
  }
  return {};
}

std::string margin_text(const WeightReport& report) {
  switch (report.margin_kind) {
    case MarginKind::exact:
      return fmt::format("best margin {:.10g}", report.margin);
    case MarginKind::at_least:
      return fmt::format("best margin at least {:.10g}", report.margin);
    case MarginKind::at_most:
      return fmt::format("best margin at most {:.10g}, the best margin of the worst neighborhood", report.margin);
  }
  return {};
}

std::string certificate_text(const WeightsRecord& r) {
  const Certificate& certificate = r.report.certificate;
  if (certificate.terms.empty()) return {};
  std::vector<std::string> lines;
  std::size_t equations = 0;
  for (const auto& [constraint, multiplier] : certificate.terms) {
    if (constraint.kind == Kind::equal_crossing)
      ++equations;
    else
      lines.push_back(r.text(constraint));
  }
  const std::string what = certificate.margin == 0 ? "all positive" : fmt::format("all above {}", certificate.margin);
  const std::string with =
      equations == 0 ? "" : " with equal crossings of " + plural(equations, "interface edge", "interface edges");
  return fmt::format("These {} cannot be {}{} (a certificate, verified exactly):\n", lines.size(), what, with) +
         listed(lines);
}

std::string_view end_text(SearchEnd end) {
  switch (end) {
    case SearchEnd::no_better_neighbor:
      return "no flip raises it further";
    case SearchEnd::none_exists:
      return "no connectivity has weights";
    case SearchEnd::limit:
      return "stopped by --programs";
    case SearchEnd::stopped:
      return "stopped early";
    case SearchEnd::failed:
      return "the solver failed";
  }
  return {};
}

std::string_view kept_text(Constraints constraints) {
  switch (constraints) {
    case Constraints::regular:
      return "dual lengths/l";
    case Constraints::coefficients:
    case Constraints::distances:
      return "dual lengths/l and h/l";
    default:
      return "h/l and d/l";
  }
}

std::string violations_text(const WeightsRecord& r) {
  if (r.report.violations.empty()) return {};
  std::vector<std::string> lines;
  double total = 0;
  for (const Violation& v : r.report.violations) {
    lines.push_back(fmt::format("{:.4g}, {:.2g} below {:.4g}: {}", v.value, v.shortfall, v.value + v.shortfall,
                                r.text(v.constraint)));
    total += v.shortfall;
  }
  return fmt::format("{} of the {} violate their bound, by {:.6g} in all:\n", lines.size(),
                     kept_text(r.options.constraints), total) +
         listed(lines);
}

std::string search_text(const WeightsRecord& r) {
  if (!r.search) return {};
  std::size_t flips = 0;
  for (const ConnectivityStep& step : r.search->steps) flips += step.flips;
  std::string text =
      fmt::format("search over connectivities: best margin {:.10g} -> {:.10g}, {} steps, {} flips, {} programs; {}\n",
                  r.search->before, r.search->margin, r.search->steps.size(), flips,
                  r.search->programs + r.search->complete_programs, end_text(r.search->end));
  if (r.search->end == SearchEnd::none_exists) {
    text += fmt::format("proof over connectivities: {}, verified exactly\n",
                        plural(r.search->proof.lemmas.size(), "lemma", "lemmas"));
  } else if (r.search->margin <= 0 && r.search->bound < kUnbounded) {
    text += fmt::format("undecided over connectivities: no connectivity has a margin above {:.6g}\n", r.search->bound);
  }
  return text;
}

std::string intrinsic_text(const WeightsRecord& r) {
  if (r.intrinsic == nullptr) return {};
  const auto& [report, flips, before, after, rounds] = *r.intrinsic;
  const std::string blocked =
      flips.blocked == 0 ? "" : fmt::format(", {} negative that cannot flip", plural(flips.blocked, "edge", "edges"));
  return fmt::format("intrinsic flips: bad triangles {} -> {}, {} in {}{}\n", before, after,
                     plural(flips.flips, "flip", "flips"), plural(rounds, "round", "rounds"), blocked);
}

Json intrinsic_json(const surfaces::IntrinsicWeights& found) {
  const auto& [report, flips, before, after, rounds] = found;
  return {{"flips", flips.flips},
          {"blocked", flips.blocked},
          {"bad_before", before},
          {"bad_after", after},
          {"rounds", rounds}};
}

std::string optimality_text(const WeightsRecord& r) {
  if (!r.report.optimality) return {};
  const Optimality& proof = *r.report.optimality;
  const bool center = proof.goal == WeightGoal::center;
  return fmt::format("{} {:.10g}, duality gap {:.2g} of it, {} iterations\n",
                     center ? "center: the sum of the logarithms is" : "squared offsets",
                     center ? -proof.objective : proof.objective, proof.relative_gap(), proof.iterations);
}

/// Says what to do if no weights were found.
std::string next_text(const WeightsRecord& r) {
  if (r.report.solved) return {};
  const bool stopped = r.search && r.search->end == SearchEnd::stopped;
  const bool limited = r.search && r.search->end == SearchEnd::limit;
  std::string text = stopped ? "a longer --time-limit" : limited ? "a larger --programs" : "";
  if (r.report.verdict == Feasibility::feasible) {
    const bool linear = r.options.goal != WeightGoal::center && r.options.goal != WeightGoal::accuracy;
    text = linear ? "a --margin of at most the best margin, or --mode elastic" : "--mode margin";
  } else {
    const bool any = r.search && r.search->end == SearchEnd::none_exists;
    if (!text.empty()) text += ", ";
    text += any ? "temper optimize with --set repair=vertices, which adds vertices"
                : command_line("explain", std::string(r.path), {});
    if (r.options.goal != WeightGoal::elastic && r.options.goal != WeightGoal::fewest)
      text += ", or --mode elastic for the least violation";
  }
  return fmt::format("Next: {}\n", text);
}

Json optimality_json(const WeightReport& report) {
  if (!report.optimality) return nullptr;
  const Optimality& proof = *report.optimality;
  return {{"objective", proof.objective},
          {"gap", proof.gap},
          {"relative_gap", proof.relative_gap()},
          {"iterations", proof.iterations}};
}

Json search_json(const WeightsRecord& r) {
  if (!r.search) return nullptr;
  Json json;
  json["before"] = r.search->before;
  json["margin"] = r.search->margin;
  json["end"] = name(r.search->end);
  json["programs"] = r.search->programs;
  json["complete_programs"] = r.search->complete_programs;
  json["bound"] = r.search->bound < kUnbounded ? Json(r.search->bound) : Json(nullptr);
  json["lemmas"] = r.search->proof.lemmas.size();
  json["steps"] = Json::array();
  for (const ConnectivityStep& step : r.search->steps) {
    json["steps"].push_back({{"kind", name(step.kind)}, {"flips", step.flips}, {"margin", step.margin}});
  }
  return json;
}

Json violation_json(const Violation& v, const WeightsRecord& record) {
  const auto point = [&](VertexId u) { return record.points.empty() ? std::size_t{u.index} : record.points[u.index]; };
  const auto& [kind, p, q, r, s, t] = v.constraint;
  const bool of_face = kind == Kind::height_over_face || kind == Kind::dual_of_face;
  Json json;
  json["kind"] = name(kind);
  if (of_face) {
    json["face"] = {point(p), point(q), point(r)};
    json["vertex"] = point(s);
  } else {
    json["edge"] = {point(p), point(q)};
  }
  if (kind == Kind::dual_of_face) json["across"] = point(t);
  if (kind == Kind::height) {
    if (record.triangle) json["triangle"] = record.triangle(v.constraint).index;
    json["vertex"] = point(r);
    if (record.triangle) json["angle_deg"] = v.angle_deg;
  }
  json["value"] = v.value;
  json["shortfall"] = v.shortfall;
  return json;
}

}  // namespace

TriangleId triangle_of(const Mesh& mesh, const WeightConstraint& c) {
  return Mesh::triangle(mesh.find_halfedge(c.p, c.q));
}

std::string constraint_text(const WeightConstraint& c, const TetInput& input, const tets::TetMesh& /*mesh*/) {
  const auto number = [&](VertexId v) { return input.vertex_number(v); };
  const std::string edge = fmt::format("{}-{}", number(c.p), number(c.q));
  if (c.kind == Kind::crossing) return fmt::format("d of edge {} from vertex {}", edge, number(c.p));
  const std::string face = fmt::format("{}-{}", edge, number(c.r));
  if (c.kind == Kind::height) return fmt::format("h over edge {} in face {}", edge, face);
  if (c.kind == Kind::dual) {
    return fmt::format("sum of h over edge {} in faces {} and {}-{}", edge, face, edge, number(c.s));
  }
  if (c.kind == Kind::height_over_face) return fmt::format("h over face {} towards vertex {}", face, number(c.s));
  return fmt::format("dual length of face {} between vertices {} and {}", face, number(c.s), number(c.t));
}

namespace {

double angle_at(const Mesh& mesh, const WeightConstraint& c) {
  return corner_angle(mesh.space(), mesh.point(c.r), mesh.point(c.p), mesh.point(c.q));
}
double angle_at(const surfaces::SurfaceMesh& mesh, const WeightConstraint& c) {
  const Vec3 at = mesh.position(c.r), p = mesh.position(c.p) - at, q = mesh.position(c.q) - at;
  return std::atan2(length(cross(p, q)), dot(p, q));
}
double angle_at(const surfaces::IntrinsicMesh& mesh, const WeightConstraint& c) {
  const surfaces::MetricTriangle t = mesh.triangle(mesh.connectivity().find_halfedge(c.p, c.q));
  return std::atan2(surfaces::doubled_area(t), t.dots()[2]);
}
const Mesh& connectivity_of(const Mesh& mesh) { return mesh; }
template <class Surface>
const Mesh& connectivity_of(const Surface& mesh) {
  return mesh.connectivity();
}

template <class Subject, class AnyMesh>
std::string text_of_constraint(const WeightConstraint& c, const InputOf<Subject>& input, const AnyMesh& mesh) {
  const std::string p = input.vertex_number(c.p), q = input.vertex_number(c.q);
  if (c.kind == Kind::crossing) return fmt::format("d of edge {}-{} from vertex {}", p, q, p);
  if (c.kind == Kind::dual) {
    return fmt::format("dual length of edge {}-{} between vertices {} and {}", p, q, input.vertex_number(c.r),
                       input.vertex_number(c.s));
  }
  return fmt::format("h over edge {}-{} in triangle {} (angle of {:.1f} degrees at vertex {})", p, q,
                     input.element_number(triangle_of(connectivity_of(mesh), c)),
                     angle_at(mesh, c) * 180 / std::numbers::pi, input.vertex_number(c.r));
}

}  // namespace

std::string constraint_text(const WeightConstraint& c, const Input& input, const Mesh& mesh) {
  return text_of_constraint<Triangles>(c, input, mesh);
}
std::string constraint_text(const WeightConstraint& c, const SurfaceInput& input, const surfaces::SurfaceMesh& mesh) {
  return text_of_constraint<Surfaces>(c, input, mesh);
}
std::string constraint_text(const WeightConstraint& c, const SurfaceInput& input, const surfaces::IntrinsicMesh& mesh) {
  return text_of_constraint<Surfaces>(c, input, mesh);
}

std::string weights_text(const WeightsRecord& r) {
  const WeightReport& report = r.report;
  std::string text = fmt::format("{}: {}\n{}{}\n{}\n", r.path, r.size, search_text(r) + intrinsic_text(r),
                                 verdict_text(r), margin_text(report));
  if (!report.solved && report.verdict == Feasibility::feasible) {
    const bool linear = r.options.goal != WeightGoal::center && r.options.goal != WeightGoal::accuracy;
    text += linear ? fmt::format("no weights give a margin of {}\n", r.options.margin)
                   : "the search for the best weights failed\n";
  }
  text += certificate_text(r) + violations_text(r);
  if (report.solved) {
    text +=
        fmt::format("{} of {} weights change, margin {:.6g}\n", report.moved, report.weights.size(), report.attained);
  }
  text += optimality_text(r);
  if (!r.output.empty()) text += fmt::format("wrote {}\n", r.output);
  if (!r.certificate.empty()) text += fmt::format("wrote {}\n", r.certificate);
  return text + next_text(r);
}

std::string weights_json(const WeightsRecord& r) {
  const WeightReport& report = r.report;
  Json json;
  json["schema"] = kSchema;
  json["mode"] = r.mode;
  json["constraints"] = name(r.options.constraints);
  json["edges"] = r.options.edges.empty() ? Json(nullptr) : Json(r.options.edges.size());
  json["search"] = search_json(r);
  if (r.intrinsic != nullptr) json["intrinsic"] = intrinsic_json(*r.intrinsic);
  json["verdict"] = name(report.verdict);
  json["feasible"] =
      report.verdict == Feasibility::undecided ? Json(nullptr) : Json(report.verdict == Feasibility::feasible);
  json["margin"] = report.margin;
  json["margin_kind"] = name(report.margin_kind);
  json["wanted"] = r.options.margin;
  json["solved"] = report.solved;
  json["attained"] = report.solved ? Json(report.attained) : Json(nullptr);
  json["weights"] = report.weights.size();
  json["moved"] = report.solved ? Json(report.moved) : Json(nullptr);
  json["change"] = report.solved ? Json(report.change) : Json(nullptr);
  json["programs"] = report.programs;
  json["largest_program"] = report.largest;
  json["optimality"] = optimality_json(report);
  json["violations"] = Json::array();
  for (const Violation& v : report.violations) json["violations"].push_back(violation_json(v, r));
  json["certificate"] =
      report.certificate.terms.empty()
          ? Json(nullptr)
          : Json::parse(io::certificate_to_json(report.certificate, r.numbers.points, r.numbers.copies));
  return dump(json);
}

}  // namespace temper::app
