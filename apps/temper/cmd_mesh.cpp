// temper mesh OUTLINE -o MESH --size h: divides the outline, places points inside, optimises, writes, reports.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "console.hpp"
#include "help.hpp"
#include "interrupt.hpp"
#include "mesh_report.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "progress_line.hpp"
#include "projection_option.hpp"
#include "report_text.hpp"
#include "temper/draw.hpp"
#include "temper/mesher.hpp"
#include "temper/projection.hpp"
#include "temper/quality.hpp"
#include "threads.hpp"
#include "time_limit.hpp"

namespace temper::app {
namespace {

constexpr Choice<Enclosed> kEnclosed[] = {
    {"by-points", Enclosed::by_points}, {"all", Enclosed::all}, {"alternate", Enclosed::alternate}};

struct MeshSettings {
  TimeLimit since;
  std::string input, report, picture, projection, region_sizes;
  MeshOutput output;
  MesherOptions options;
  std::uint64_t threads = 0;
  bool no_optimize = false, quiet = false;
};

void add_files(Command& command, MeshSettings& s) {
  add_argument(command, "OUTLINE", s.input,
               "the outline: .poly of Triangle, geometry of JIGSAW, or GeoJSON; its content tells which")
      .require();
  add_mesh_output(command, s.output, "MESH");
  command.option("--output").require();
  add_text(command, "--report", "FILE", s.report, "a JSON report: what was read and made, before and after optimising");
  add_text(command, "--draw", "FILE", s.picture, "a picture (.svg, .png, .pdf) of the mesh and its dual");
  command.add_flag("--quiet", s.quiet, "print warnings and errors only");
}

void add_sizes(Command& command, MeshSettings& s) {
  add_number(command, "--size", s.options.size, kPositive,
             "edge length wanted, in the units of the outline or in metres")
      .require();
  add_number(command, "--grade", s.options.grade, kPositive,
             "growth of the size per unit of length, away from short edges and narrow places");
  add_text(command, "--region-size", "REGION,SIZE,...", s.region_sizes,
           "edge length wanted in these regions, where it is less than --size");
  add_choice(command, "--enclosed", kEnclosed, s.options.enclosed,
             "what counts as inside. all: everything that segments enclose, except holes; alternate: nested loops "
             "take turns (land, lake, island); by-points: as all when the file has hole or region points, else as "
             "alternate. Files with polygons or parts say it themselves");
  add_text(command, "--projection", "NAME[:lon,lat]", s.projection,
           "the map for points in longitude and latitude: stereographic, mercator or transverse-mercator about "
           "this center (default: the middle of the points), to metres; none: treat degrees as coordinates of a "
           "plane");
}

void add_optimisation(Command& command, MeshSettings& s) {
  command.add_flag("--no-optimize", s.no_optimize, "write the Delaunay mesh as it is");
  add_count(command, "--attempts", s.options.attempts, 1,
            "while triangles stay bad, divide the outline finer around them and mesh it again; at most this many "
            "times");
  add_number(command, "--time-limit", s.options.time_limit, kNotNegative,
             "stop after this many seconds, with the best mesh so far, if there is one; 0: no limit");
  add_count(command, "--threads", s.threads, 0, "threads; 0: as many as the machine has; the result is the same");
}

void add_options(Command& command, MeshSettings& s) {
  command.group("Files");
  add_files(command, s);
  command.group("Sizes and shape");
  add_sizes(command, s);
  command.group("Optimisation");
  add_optimisation(command, s);
  command.group("Help");
  command.add_help({"OUTLINE -o MESH --size h [options]",
                    "  temper mesh lake.poly -o lake.vtu --size 0.05\n"
                    "  temper mesh lake.poly -o lake.msh --size 0.05 --grade 0.15 --draw lake.svg\n"
                    "  temper mesh plan.poly -o plan.vtu --size 1 --region-size 2,0.25\n"
                    "  temper mesh coast.geojson -o coast.vtu --size 2000 --projection stereographic\n"
                    "  temper mesh basin.msh -o basin.vtu --size 500 --projection transverse-mercator:9,0\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::stopped_early, Exit::internal}});
}

std::vector<RegionSize> region_sizes(const std::string& text) {
  if (text.empty()) return {};
  const auto numbers = parse_numbers(text);
  std::vector<RegionSize> sizes;
  for (std::size_t i = 0; numbers && i + 1 < numbers->size(); i += 2) {
    const double region = (*numbers)[i], size = (*numbers)[i + 1];
    if (region != std::floor(region) || std::abs(region) > 2e9 || !(size > 0)) break;
    sizes.push_back({static_cast<std::int32_t>(region), size});
  }
  if (!numbers || numbers->empty() || 2 * sizes.size() != numbers->size()) {
    throw Failure(Exit::bad_usage, fmt::format("mesh: --region-size: expected REGION,SIZE,... with whole regions and "
                                               "sizes above 0, found '{}'\nSee temper mesh --help",
                                               text));
  }
  return sizes;
}

/// The outline in the plane, and how it got there. Longitude and latitude are no plane: nobody's angles are right
/// there.
MapUsed take_to_plane(const MeshSettings& s, io::OutlineFile& file) {
  expect_projection(s.input, file.geographic, s.projection);
  if (s.projection.empty() || s.projection == io::kNoProjection) return {};
  MapUsed map;
  map.projection = or_fail(parse_projection(s.projection, file.outline.points));
  map.lon_lat = file.outline.points;
  file.outline = or_fail(project(file.outline, *map.projection));
  return map;
}

void measure_distortion(MapUsed& map, const Mesh& mesh) {
  if (!map.projection) return;
  for (const VertexId v : mesh.vertices()) {
    const double scale = scale_factor(*map.projection, inverse(*map.projection, mesh.position(v)));
    const bool first = v.index == 0;
    map.least_scale = first ? scale : std::min(map.least_scale, scale);
    map.largest_scale = first ? scale : std::max(map.largest_scale, scale);
  }
}

/// The mesh with the edges of the outline as tagged lines. Segments without a tag get one all the same, or they would
/// be lost in a file: 1 on the boundary, as Triangle does, and the first number that is free inside.
io::MeshFile file_of(const OutlineMesh& made, const MapUsed& map) {
  io::MeshFile file = io::from_mesh(made.mesh);
  file.lines.clear();
  file.line_tags.clear();
  std::int32_t inside = 2;
  for (const MeshLine& line : made.lines) inside = std::max(inside, line.tag + 1);
  for (const MeshLine& line : made.lines) {
    const HalfedgeId h = made.mesh.find_halfedge(line.a, line.b);
    const bool boundary = !h.valid() || made.mesh.is_boundary(h);
    file.lines.push_back({static_cast<std::int32_t>(line.a.index), static_cast<std::int32_t>(line.b.index)});
    file.line_tags.push_back(line.tag != 0 ? line.tag : boundary ? 1 : inside);
  }
  if (!map.projection) return file;
  std::vector<double> longitudes, latitudes;
  const LongitudeTurn turn(map.lon_lat);
  for (const VertexId v : made.mesh.vertices()) {
    const Vec2 place = turn(inverse(*map.projection, made.mesh.position(v)));
    longitudes.push_back(place.x);
    latitudes.push_back(place.y);
  }
  for (std::size_t p = 0; p < map.lon_lat.size(); ++p) {  // bit for bit
    const VertexId v = made.vertex_of_point[p];
    if (v.valid()) longitudes[v.index] = map.lon_lat[p].x, latitudes[v.index] = map.lon_lat[p].y;
  }
  file.point_data.push_back({"longitude", 1, std::move(longitudes)});
  file.point_data.push_back({"latitude", 1, std::move(latitudes)});
  return file;
}

OutlineMesh run_library(const MeshSettings& s, const Outline& outline, Executor* executor) {
  ProgressLine line(!s.quiet && error_is_terminal());
  const Observer observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  MesherOptions options = s.options;
  options.time_limit = s.since.left(options.time_limit);
  options.region_sizes = region_sizes(s.region_sizes);
  if (s.no_optimize) options.optimize.reset();
  return or_fail(mesh_outline(outline, options, {.executor = executor, .observer = observer}));
}

Exit mesh(const Command& command, const MeshSettings& s, Outputs& outputs) {
  io::OutlineFile input = or_fail(io::read_outline(s.input));
  print_warnings(input.warnings);
  MapUsed map = take_to_plane(s, input);
  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  catch_interrupts();
  const OutlineMesh made = run_library(s, input.outline, threads.get());
  measure_distortion(map, made.mesh);
  QualityOptions measuring;
  measuring.executor = threads.get();
  const Quality after = quality(made.mesh, measuring);

  print_warnings(outputs.write_mesh(s.output, file_of(made, map), threads.get()));
  const std::vector<UsedOption> options = used_options(command);
  const MeshRecord record = {command_line("mesh", {s.input}, options), options, input, map, made, after};
  if (!s.report.empty()) outputs.write_text(s.report, mesh_json(record));
  if (!s.picture.empty()) {
    DrawOptions drawing;
    drawing.title =
        fmt::format("{}: {} triangles, {} not well-centered", s.input, after.triangles, bad_triangles(after));
    outputs.write_picture(s.picture, draw_svg(made.mesh, drawing));
  }
  if (!s.quiet) print(mesh_text(record) + fmt::format("\n{}: {}\n", s.output.path, verdict(after)));
  const bool early = made.report.stopped == Stopped::time_limit || made.report.stopped == Stopped::cancelled;
  return early ? Exit::stopped_early : Exit::done;
}

}  // namespace

Exit run_mesh(const Arguments& arguments) {
  Command command(
      "mesh",
      "Meshes the inside of an outline and optimises that until every triangle is well-centered. Points of the outline "
      "stay bit for bit; of one in longitude and latitude, these do.");
  MeshSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  Outputs outputs("mesh");
  // The points of a .poly may be in the .node beside it.
  const std::vector<std::string> inputs = {s.input, std::filesystem::path(s.input).replace_extension(".node").string()};
  outputs.expect_mesh(s.output, inputs);
  outputs.expect_text("--report", s.report, inputs);
  outputs.expect_picture("--draw", s.picture, inputs);
  return mesh(command, s, outputs);
}

}  // namespace temper::app
