#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "console.hpp"
#include "reports/reports.hpp"
#include "temper/tets/geometry.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kTetIndent = 4;

/// A face of a bad tetrahedron.
struct Face {
  std::array<VertexId, 3> vertices;
  bool boundary = false;
  double h = 0, h_over_l = 0;
  bool outside = false;  ///< h ≤ 0, exact
  bool crossed = false;  ///< The orthocenter of the face is strictly inside it, exact
};

bool is_crossed(const tets::WeightedPoint& a, const tets::WeightedPoint& b, const tets::WeightedPoint& c) {
  return signed_height_sign(a, b, c) == Sign::positive && signed_height_sign(b, c, a) == Sign::positive &&
         signed_height_sign(c, a, b) == Sign::positive;
}

/// Precondition: not flat.
std::array<Face, 4> faces_of(const tets::TetMesh& mesh, tets::TetId t) {
  std::array<Face, 4> faces;
  for (int f = 0; f < 4; ++f) {
    const tets::HalffaceId half = tets::TetMesh::halfface(t, f);
    Face& face = faces[static_cast<std::size_t>(f)];
    face.vertices = mesh.vertices(half);
    face.boundary = mesh.is_boundary(half);
    const tets::WeightedPoint a = mesh.point(face.vertices[0]), b = mesh.point(face.vertices[1]),
                              c = mesh.point(face.vertices[2]), d = mesh.point(mesh.opposite(half));
    const double twice_area = length(cross(b.position() - a.position(), c.position() - a.position()));
    face.outside = signed_height_sign(a, b, c, d) != Sign::positive;
    face.h = signed_height(a, b, c, d);
    face.h_over_l = face.h / std::sqrt(2 / std::numbers::sqrt3 * twice_area);
    face.crossed = is_crossed(a, b, c);
  }
  return faces;
}

bool all_on_boundary(const TetExplanation& e, const tets::WorstTet& worst) {
  return std::ranges::all_of(worst.vertices, [&](VertexId v) { return e.on_boundary[v] != 0; });
}

/// The command that may cure a tetrahedron.
std::string command(const TetExplanation& e, bool all_on_boundary) {
  if (e.weights && e.weights->verdict == Feasibility::feasible) return "temper weights";
  return all_on_boundary ? "temper optimize --boundary split" : "temper optimize";
}

std::string on_weights(const TetExplanation& e) {
  if (!e.weights || e.weights->verdict == Feasibility::undecided)
    return "It is not known if weights alone can make all of them well-centered.\n";
  if (e.weights->verdict == Feasibility::infeasible)
    return "If no vertex moves and no face flips, no weights make all of them well-centered.\n";
  return fmt::format("If no vertex moves, weights make all of them well-centered: {} of {} change (margin {:.4g}).\n",
                     e.weights->moved, e.input.mesh().n_vertices(), e.weights->margin);
}

std::string summary(const TetExplanation& e) {
  const std::size_t movable = e.quality.orthocenters_outside - e.on_boundary_alone;
  std::string text;
  if (movable > 0)
    text += fmt::format("  {} with an inner vertex, whose move may help. Try: {}\n", movable, command(e, false));
  if (e.on_boundary_alone > 0)
    text += fmt::format("  {} with all corners on the boundary: weights, flips and new vertices may help. Try: {}\n",
                        e.on_boundary_alone, command(e, true));
  return text;
}

std::string joined(const TetExplanation& e, std::span<const VertexId> vertices, std::string_view between) {
  std::string text;
  for (const VertexId v : vertices) text += (text.empty() ? "" : std::string(between)) + e.input.vertex_number(v);
  return text;
}

std::string paragraph(const TetExplanation& e, const tets::WorstTet& worst, std::size_t number,
                      const TextStyle& style) {
  const tets::TetMesh& mesh = e.input.mesh();
  const std::string blank(kTetIndent, ' ');
  const auto name = [&](VertexId v) { return e.input.vertex_number(v); };
  std::string why =
      fmt::format("Tetrahedron {} ({}) at ({:.9g}, {:.9g}, {:.9g}): {}.", e.input.tetrahedron_number(worst.tetrahedron),
                  joined(e, worst.vertices, " "), worst.at.x, worst.at.y, worst.at.z, renumber(worst.why, name));
  if (!style.utf8) why = in_ascii(why);
  std::string text = pad_left(std::to_string(number) + ". ", kTetIndent);
  bool first = true;
  for (const std::string& line : wrap(why, style.columns > kTetIndent + 40 ? style.columns - kTetIndent : 40))
    text += (std::exchange(first, false) ? "" : blank) + line + "\n";
  const auto [a, b, c, d] = mesh.points(worst.tetrahedron);
  const Vec3 center = orthocenter(a, b, c, d);
  text += fmt::format("{}orthocenter ({:.9g}, {:.9g}, {:.9g}), weights {:.6g} {:.6g} {:.6g} {:.6g}\n", blank, center.x,
                      center.y, center.z, a.w, b.w, c.w, d.w);
  for (const Face& face : faces_of(mesh, worst.tetrahedron)) {
    text += fmt::format("{}{} {}: h = {:.4g}, h/l = {:.4g}{}{}\n", blank, face.boundary ? "boundary face" : "face",
                        joined(e, face.vertices, "-"), face.h, face.h_over_l, face.outside ? ", outside" : "",
                        face.crossed ? "" : ", does not contain its own orthocenter");
  }
  return text + blank + "- Try: " + command(e, all_on_boundary(e, worst)) + "\n";
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json to_json(Vec3 p) { return {finite_or_null(p.x), finite_or_null(p.y), finite_or_null(p.z)}; }

Json to_json(const TetExplanation& e, const tets::WorstTet& worst) {
  const tets::TetMesh& mesh = e.input.mesh();
  const auto point = [&](VertexId v) {
    return e.input.points.empty() ? std::size_t{v.index} : e.input.points[v.index];
  };
  const auto points = [&](std::span<const VertexId> vertices) {
    Json json = Json::array();
    for (const VertexId v : vertices) json.push_back(point(v));
    return json;
  };
  const auto [a, b, c, d] = mesh.points(worst.tetrahedron);
  Json faces = Json::array();
  for (const Face& face : faces_of(mesh, worst.tetrahedron)) {
    faces.push_back({{"vertices", points(face.vertices)},
                     {"boundary", face.boundary},
                     {"h", finite_or_null(face.h)},
                     {"h_over_l", finite_or_null(face.h_over_l)},
                     {"outside", face.outside},
                     {"crossed", face.crossed}});
  }
  const bool on_boundary = all_on_boundary(e, worst);
  return {{"tetrahedron", worst.tetrahedron.index},
          {"vertices", points(worst.vertices)},
          {"weights", {a.w, b.w, c.w, d.w}},
          {"at", to_json(worst.at)},
          {"orthocenter", to_json(orthocenter(a, b, c, d))},
          {"h_over_l", finite_or_null(worst.h_over_l)},
          {"dihedral_deg", finite_or_null(worst.dihedral_deg)},
          {"faces", std::move(faces)},
          {"all_on_boundary", on_boundary},
          {"text", renumber(worst.why, [&](VertexId v) { return std::to_string(point(v)); })},
          {"command", command(e, on_boundary)}};
}

}  // namespace

std::string explanation_text(const TetExplanation& e, const TextStyle& style) {
  const std::size_t bad = e.quality.orthocenters_outside, shown = std::min(bad, e.quality.worst.size());
  std::string text = fmt::format("{}: {}\n", e.input.path, verdict(e.quality));
  if (bad == 0) return text;
  text += on_weights(e) + summary(e);
  if (shown == 0) return text;
  text += bad > 1 ? "\nBad tetrahedra, worst first\n" : "\nThe bad tetrahedron\n";
  for (std::size_t i = 0; i < shown; ++i) text += paragraph(e, e.quality.worst[i], i + 1, style);
  if (bad > shown) text += fmt::format("and {} more (--limit {} or --json has all)\n", bad - shown, bad);
  return text;
}

std::string explanation_json(const TetExplanation& e) {
  Json json;
  json["schema"] = kSchema;
  json["tetrahedra"] = e.quality.tetrahedra;
  json["bad"] = e.quality.orthocenters_outside;
  json["verdict"] = name(e.weights ? e.weights->verdict : Feasibility::undecided);
  const bool feasible = e.weights && e.weights->verdict == Feasibility::feasible;
  json["weights_changed"] = feasible ? Json(e.weights->moved) : Json(nullptr);
  json["all_on_boundary"] = e.on_boundary_alone;
  json["reasons"] = Json::array();
  for (const tets::WorstTet& worst : e.quality.worst) json["reasons"].push_back(to_json(e, worst));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace temper::app
