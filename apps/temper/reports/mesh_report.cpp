#include <fmt/format.h>

#include "console.hpp"
#include "reports/json_of.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "temper/detail/version.hpp"

namespace temper::app {
namespace {

std::string_view name(ProjectionKind kind) {
  switch (kind) {
    case ProjectionKind::stereographic:
      return "stereographic";
    case ProjectionKind::mercator:
      return "mercator";
    case ProjectionKind::transverse_mercator:
      return "transverse-mercator";
  }
  return "";
}

}  // namespace

std::string spell(const Projection& projection) {
  return fmt::format("{}:{},{}", name(projection.kind), projection.center.x, projection.center.y);
}

namespace {

/// An edge with several tags is several lines, one after the other.
std::size_t count_edges(const OutlineMesh& made) {
  std::size_t n = 0;
  const MeshLine* last = nullptr;
  for (const MeshLine& line : made.lines) {
    n += last != nullptr && last->a == line.a && last->b == line.b ? 0 : 1;
    last = &line;
  }
  return n;
}

}  // namespace

std::string mesh_text(const MeshRecord& r) {
  std::string text;
  for (const NamedOutline& input : r.inputs) {
    const Outline& o = input.file.outline;
    text += fmt::format("{}: {}, {} ({})\n", input.file.path, plural(o.points.size(), "point", "points"),
                        plural(o.segments.size(), "segment", "segments"), input.file.format);
  }
  if (r.map.projection) {
    text += fmt::format("projection {}, lengths on the map are {:.5f} to {:.5f} of those on the globe\n",
                        spell(*r.map.projection), r.map.least_scale, r.map.largest_scale);
  }
  if (r.map.radius > 0) {
    text += fmt::format("sphere of radius {}, {:.4g} % of it meshed\n", r.map.radius, 100 * r.map.covered);
  }
  text += fmt::format("{}, {}, {} of the outline; {} of the Delaunay triangles were bad\n",
                      plural(r.quality.vertices, "vertex", "vertices"),
                      plural(r.quality.triangles, "triangle", "triangles"),
                      plural(count_edges(r.made), "edge", "edges"), r.made.delaunay_bad);
  if (r.made.report.sweeps > 0) {
    text += fmt::format("optimized in {}, {:.3g} s\n", plural(std::size_t(r.made.report.sweeps), "sweep", "sweeps"),
                        r.made.report.seconds);
  }
  if (r.made.attempts > 1) {
    text += fmt::format("the outline was divided {} times, finer around triangles that stayed bad\n", r.made.attempts);
  }
  for (const std::string& note : r.made.notes) text += "note: " + note + "\n";
  return text;
}

std::string mesh_json(const MeshRecord& r) {
  Json json;
  json["schema"] = kSchema;
  json["command"] = r.command;
  json["version"] = version();
  for (const NamedOutline& input : r.inputs) {
    const Outline& o = input.file.outline;
    json[input.name] = {{"format", input.file.format},    {"points", o.points.size()},
                        {"segments", o.segments.size()},  {"holes", o.holes.size()},
                        {"regions", o.regions.size()},    {"parts", o.parts.size()},
                        {"warnings", input.file.warnings}};
  }
  json["projection"] = nullptr;
  if (r.map.projection) {
    json["projection"] = {{"name", name(r.map.projection->kind)},
                          {"center", {r.map.projection->center.x, r.map.projection->center.y}},
                          {"radius", r.map.projection->radius},
                          {"least_scale", r.map.least_scale},
                          {"largest_scale", r.map.largest_scale}};
  }
  if (r.map.radius > 0) json["sphere"] = {{"radius", r.map.radius}, {"covered", r.map.covered}};
  json["attempts"] = r.made.attempts;
  json["outline_edges"] = count_edges(r.made);
  json["delaunay_bad"] = r.made.delaunay_bad;
  json["bad"] = r.made.bad;
  json["sweeps"] = r.made.report.sweeps;
  json["seconds"] = r.made.report.seconds;
  json["stopped"] = temper::name(r.made.report.stopped);
  json["notes"] = r.made.notes;
  json["mesh"] = json_of(r.quality);
  return dump(json);
}

}  // namespace temper::app
