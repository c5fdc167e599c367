// temper mesh OUTLINE -o MESH --size h: divides the outline, places points inside, optimizes, writes, reports. With
// --sphere it meshes the globe, or the part of it that an outline and coasts leave.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

#include "console.hpp"
#include "exit.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/size_hint.hpp"
#include "files/size_options.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/faces.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/detail/path.hpp"
#include "temper/detail/projection.hpp"
#include "temper/draw.hpp"
#include "temper/mesher.hpp"
#include "temper/quality.hpp"
#include "temper/solvers.hpp"
#include "threads.hpp"
#include "verbs/optimize_settings.hpp"
#include "verbs/progress_line.hpp"

namespace temper::app {
namespace {

constexpr Choice<Enclosed> kEnclosed[] = {
    {"by-points", Enclosed::by_points}, {"all", Enclosed::all}, {"alternate", Enclosed::alternate}};

constexpr Choice<MeshPoints> kPoints[] = {{"by-size", MeshPoints::by_size}, {"few", MeshPoints::few}};

constexpr OutputKind kMeshOutputs[] = {kReportKind, kPictureKind};

struct MeshSettings {
  TimeLimit since;
  std::string input, coast, lines, size, size_data, from_depth, projection, region_sizes, faces;
  std::string target = std::string(targets()[0].name);
  MeshOutput output;
  std::vector<std::string> write;
  FurtherOutputs files;  ///< of `write`
  MesherOptions options;
  std::optional<double> radius;
  std::uint64_t threads = 0;
  bool sphere = false, no_optimize = false, no_weights = false, flat = false;
};

void add_files(Command& command, MeshSettings& s) {
  add_argument(command, "OUTLINE", s.input,
               "Outline file: .poly of Triangle, geometry of JIGSAW, GeoJSON, shapefile or GeoPackage. Its content "
               "shows the format. With --sphere you may leave it out.");
  add_mesh_output(command, s.output, "MESH");
  command.option("--output").require();
  add_write(command, s.write, kMeshOutputs);
}

void add_sizes(Command& command, MeshSettings& s) {
  add_text(command, "--size", "X|FILE", s.size,
           "Target edge length, in the units of the outline or in meters. FILE is a mesh file or a raster with a size "
           "at each of its points.");
  add_choice(command, "--points", kPoints, s.options.points,
             "Number of vertices. 'by-size' makes as many as --size asks for. 'few' makes as few as it finds, without "
             "--size, in the plane. With --time-limit it uses all of that time.");
  add_text(command, "--size-data", "NAME", s.size_data,
           "Name of the point data with the sizes in the file of --size. (default: size, or the only data)");
  add_text(command, "--from-depth", "KEY=VALUE,...", s.from_depth,
           "Rules that make sizes from depths in the file of --size. per_wavelength=N gives at least N edges to a "
           "wave of period=S seconds (default: the tide M2). time_step=S keeps the Courant number below courant=1. "
           "least=R and largest=R bound the sizes. positive=up says that the numbers are heights.");
  command.add_flag("--flat", s.flat,
                   "Take the mesh of --size as one of the plane of x and y, with z as point data 'z'.");
  add_number(command, "--grade", s.options.grade, kPositive,
             "Growth of the size per unit of length, away from short edges and narrow places.");
  add_text(command, "--region-size", "REGION,SIZE,...", s.region_sizes,
           "Target edge length in these regions. It applies if it is less than --size.");
  add_choice(command, "--enclosed", kEnclosed, s.options.enclosed,
             "Rule for the inside of nested loops. 'all' is everything that segments enclose, except holes. With "
             "'alternate' nested loops alternate: land, lake, island. 'by-points' is 'all' if the file has hole or "
             "region points, else 'alternate'. If the file has polygons or parts, these decide.")
      .excludes = "--sphere";
  add_number(command, "--snap", s.options.snap, kNotNegative,
             "Tolerance of joins. Points that are nearer to each other, or to a segment, are joined. 0 joins nothing. "
             "(default: 1e-9 of the extent of the outline, or 1e-7 of the radius of the sphere)");
  add_number(
      command, "--drop-below", s.options.drop_below, kNotNegative,
      "Leave out rings of polygons whose extent is less, such as small islands. Rings that --snap leaves nothing "
      "of are left out, too.");
  command.add_flag("--split-crossings", s.options.split_crossings,
                   "Divide lines where they cross each other or the boundary, and leave out what is outside. Without "
                   "this flag, crossings are errors.");
  add_text(command, "--faces", "NAME,...", s.faces,
           "Lines with these names or tags become faces of power cells, not edges of triangles: faults and barriers. "
           "With the name of a region, its borders become faces.")
      .excludes = "--sphere";
  add_text(command, "--projection", "NAME[:lon,lat]", s.projection,
           "Map from longitude and latitude to meters: stereographic, mercator or transverse-mercator about this "
           "center. Without a center, the middle of the points is used. 'none' uses degrees as coordinates of a plane.")
      .excludes = "--sphere";
}

void add_sphere(Command& command, MeshSettings& s) {
  command.add_flag("--sphere", s.sphere,
                   "Mesh the whole sphere, or the part that OUTLINE encloses. Outlines are in degrees, and their "
                   "segments are arcs of great circles. A closed line encloses the smaller of its two sides.");
  add_text(command, "--coast", "FILE", s.coast,
           "Coasts. The mesh leaves out everything that their polygons and closed lines enclose.");
  add_text(command, "--lines", "FILE", s.lines, "Rivers and other lines, which become constrained edges.");
  add_number(command, "--radius", s.radius, kPositive,
             "Radius of the sphere. (default: the radius of the size field, or 6371000)");
}

void add_optimization(Command& command, MeshSettings& s) {
  add_target(command, s.target, false).excludes = "--no-optimize";
  command.add_flag("--no-weights", s.no_weights, "Make triangles well-centered without weights.");
  command.add_flag("--no-optimize", s.no_optimize, "Write the Delaunay mesh without optimization.");
  add_count(command, "--attempts", s.options.attempts, 1,
            "Largest number of meshes made. If triangles stay bad, temper divides the outline finer around them and "
            "makes another mesh.");
  add_number(command, "--time-limit", s.options.time_limit, kNotNegative,
             "Time limit in seconds. The run then writes the best mesh so far, if there is one. 0 sets no limit.");
  add_threads(command, s.threads);
}

void add_options(Command& command, MeshSettings& s) {
  command.group("Files");
  add_files(command, s);
  command.group("Sizes and shape");
  add_sizes(command, s);
  command.group("Sphere");
  add_sphere(command, s);
  command.group("Optimization");
  add_optimization(command, s);
  command.group("Help");
  command.add_help({"[OUTLINE] -o MESH --size h|--points few [options]",
                    "  temper mesh lake.poly -o lake.vtu --size 0.05\n"
                    "  temper mesh lake.poly -o few.vtu --points few --time-limit 20\n"
                    "  temper mesh lake.poly -o lake.msh --size 0.05 --grade 0.15 --write lake.svg\n"
                    "  temper mesh plan.poly -o plan.vtu --size 1 --region-size 2,0.25\n"
                    "  temper mesh valley.geojson -o valley.vtu --size 100 --faces fault --for vertex\n"
                    "  temper mesh coast.geojson -o coast.vtu --size 2000 --projection stereographic\n"
                    "  temper mesh basin.msh -o basin.vtu --size 500 --projection transverse-mercator:9,0\n"
                    "  temper mesh --sphere -o ocean.vtu --size 500000 --coast land.geojson --lines rivers.geojson\n",
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
    refuse_usage(
        "mesh",
        fmt::format("--region-size: expected REGION,SIZE,... with whole regions and sizes above 0, found '{}'{}", text,
                    without_unit(separated(text).back())));
  }
  return sizes;
}

/// `--write a.svg OUTLINE`: --write takes all words that follow, so the last one may be the outline.
void take_input(Command& command, MeshSettings& s) {
  if (!s.input.empty() || s.write.empty() || is_output_of(kMeshOutputs, s.write.back())) return;
  s.input = s.write.back();
  s.write.pop_back();
  command.option("--write").given.pop_back();
}

/// "0.5m" is no name of a file, unless there is one.
void expect_no_unit(const std::string& size) {
  const std::string unit = without_unit(size);
  std::error_code ignored;
  if (unit.empty() || std::filesystem::exists(path_of(size), ignored)) return;
  refuse_usage("mesh", fmt::format("--size: '{}' is no size{}", size, unit));
}

void check_usage(const Command& command, const MeshSettings& s) {
  const bool few = s.options.points == MeshPoints::few;
  for (const char* option : {"--size", "--size-data", "--from-depth", "--grade", "--region-size", "--attempts"}) {
    if (few && command.was_given(option))
      refuse_usage("mesh", std::string(option) + " has no effect with --points few. Next: leave one out");
  }
  if (few && s.sphere) refuse_usage("mesh", "--points few is for the plane. Next: --sphere with --size h");
  if (few && s.no_optimize) refuse_usage("mesh", "--points few needs the optimization. Next: leave out --no-optimize");
  expect_no_unit(s.size);
  if (s.sphere) return;
  if (s.input.empty())
    refuse_usage("mesh", "OUTLINE is missing: give an outline file, or --sphere for a mesh of the whole sphere");
  for (const char* option : {"--coast", "--lines", "--radius"}) {
    if (command.was_given(option))
      refuse_usage("mesh", std::string(option) + " needs --sphere. Next: add --sphere, or leave this option out");
  }
}

/// The number given as --size; nothing if it is a file.
std::optional<double> size_number(const MeshSettings& s) {
  const auto number = parse_number(s.size);
  if (number && !s.from_depth.empty())
    refuse_usage("mesh", "--from-depth: expected a file with depths as --size, found the number " + s.size);
  if (number && !(*number > 0 && std::isfinite(*number)))
    refuse_usage("mesh", "--size: expected a number above 0, or a mesh file with sizes, found '" + s.size + "'");
  return number;
}

/// The sizes of a file. `degrees`: the projection for its points if they are longitude and latitude. A raster is read
/// in the box of the outline, if that has points.
SizeField read_sizes(const MeshSettings& s, const std::string& degrees, const std::vector<Vec2>& outline,
                     bool geographic, Executor* executor) {
  io::ReadOptions options = {executor, s.flat, {}, geographic};
  if (!outline.empty()) {
    Vec2 low = outline.front(), high = low;
    for (const Vec2 p : outline) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    options.window = {low, high};
  }
  std::optional<DepthRule> depths;
  if (!s.from_depth.empty()) depths = parse_depth_rule("mesh", s.from_depth);
  // Only z of a 2DM file asks for a sign; other data get it from the rule.
  if (depths && path_of(s.size).extension() == ".2dm") options.positive = depths->positive;
  io::MeshFile file = read_tried(s.size, options);
  const std::string projection = file.degrees() != nullptr ? degrees : "";
  ReadSizeField sizes =
      read_size_field(make_input(std::move(file), s.size, {projection, {}, executor}), s.size_data, depths);
  print_warnings(sizes.warnings);
  return std::move(sizes.field);
}

[[noreturn]] void wrong_space(const MeshSettings& s, const std::string& found, const std::string& expected) {
  throw Failure(Exit::bad_input, s.size + ": the sizes are on " + found + "; expected " + expected);
}

/// The outline in the plane, and its map. Longitude and latitude are not used as a plane: angles are wrong there.
MapUsed take_to_plane(const MeshSettings& s, io::OutlineFile& file) {
  expect_projection_of_outline(s.input, file.geographic, file.outline.points, s.projection);
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

void measure_covered(MapUsed& map, const Mesh& mesh) {
  double covered = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    covered += solid_angle(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c));
  }
  map.covered = covered / (4 * std::numbers::pi);
}

using Meshing = std::function<Expected<OutlineMesh>(const MesherOptions&, const OptimizeHooks&)>;

OutlineMesh run_library(const MeshSettings& s, MesherOptions options, Executor* executor, const Meshing& meshing) {
  ProgressLine line(!is_quiet() && error_is_terminal());
  const Observer observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  options.time_limit = s.since.left(options.time_limit);
  options.memory = io::free_memory();
  options.estimated = [&line](const MeshEstimate& estimate) {
    constexpr double kSomeSeconds = 200'000;  // triangles
    if (is_quiet() || estimate.triangles < kSomeSeconds) return;
    line.clear();
    put_to_error(fmt::format("temper: the mesh will have about {} triangles, and need about {} of memory\n",
                             estimate.triangles_text(), estimate.memory_text()));
  };
  options.region_sizes = region_sizes(s.region_sizes);
  if (s.no_optimize) options.optimize.reset();
  return or_fail(meshing(options, {.executor = executor, .observer = observer, .solvers = solvers()}));
}

/// The outlines, their map, and their mesh.
struct Result {
  std::vector<NamedOutline> inputs;
  MapUsed map;
  OutlineMesh made;
};

io::OutlineFile read_outline_file(const std::string& path) {
  io::OutlineFile file = or_fail(io::read_outline(path));
  print_warnings(file.warnings);
  return file;
}

Result mesh_plane(const MeshSettings& s, Executor* executor) {
  Result result;
  result.inputs.push_back({"outline", read_outline_file(s.input)});
  io::OutlineFile& input = result.inputs[0].file;
  if (!s.faces.empty()) or_fail(become_faces(input.outline, separated(s.faces)));
  result.map = take_to_plane(s, input);
  MesherOptions options = s.options;
  if (options.points == MeshPoints::few) {
    // no sizes
  } else if (const auto number = size_number(s)) {
    options.size = *number;
  } else {
    const auto& map = result.map.projection;
    options.field = read_sizes(s, map ? projection_text(*map) : std::string(io::kNoProjection),
                               map ? result.map.lon_lat : input.outline.points, map.has_value(), executor);
    const Space space = options.field->mesh().space();
    if (!space.is_plane()) wrong_space(s, "a sphere", "a plane, or --sphere");
    if (space.is_periodic()) wrong_space(s, "a periodic plane", "a plane without periods");
  }
  result.made = run_library(s, std::move(options), executor,
                            [&](const auto& o, const auto& hooks) { return mesh_outline(input.outline, o, hooks); });
  measure_distortion(result.map, result.made.mesh);
  return result;
}

Result mesh_globe(const MeshSettings& s, Executor* executor) {
  Result result;
  SphereOutline sphere;
  sphere.radius = s.radius.value_or(sphere.radius);
  MesherOptions options = s.options;
  if (const auto number = size_number(s)) {
    options.size = *number;
  } else {
    options.field = read_sizes(s, fmt::format("{}:radius={}", io::kOntoSphere, sphere.radius), {}, true, executor);
    const Space space = options.field->mesh().space();
    if (space.is_plane()) wrong_space(s, "a plane", "a sphere");
    if (s.radius && *s.radius != space.radius())
      wrong_space(s, fmt::format("a sphere of radius {}", space.radius()), fmt::format("one of {}", *s.radius));
    sphere.radius = space.radius();
  }
  const auto take = [&](const char* name, const std::string& path, Outline& outline) {
    if (path.empty()) return;
    result.inputs.push_back({name, read_outline_file(path)});
    outline = result.inputs.back().file.outline;
    result.map.lon_lat.insert(result.map.lon_lat.end(), outline.points.begin(), outline.points.end());
  };
  take("outline", s.input, sphere.basins);
  take("coast", s.coast, sphere.coasts);
  take("lines", s.lines, sphere.lines);
  result.map.radius = sphere.radius;
  result.made = run_library(s, std::move(options), executor,
                            [&](const auto& o, const auto& hooks) { return mesh_sphere(sphere, o, hooks); });
  measure_covered(result.map, result.made.mesh);
  return result;
}

/// Names a size. If an outline cannot be read, that is the error of the next run.
[[noreturn]] void refuse_missing_size(const MeshSettings& s) {
  SphereOutline sphere;
  sphere.radius = s.radius.value_or(sphere.radius);
  Outline plane;
  bool geographic = false, all_read = true;
  const auto take = [&](const std::string& path, Outline& outline) {
    if (path.empty()) return;
    const Expected<io::OutlineFile> file = io::read_outline(path);
    all_read = all_read && file.has_value();
    if (!file) return;
    outline = file->outline;
    geographic = file->geographic;
  };
  take(s.input, s.sphere ? sphere.basins : plane);
  take(s.coast, sphere.coasts);
  std::string hint = "Next: --size h, or --points few";
  if (all_read) hint = s.sphere ? size_hint(sphere, s.options) : size_hint(plane, geographic, s.projection, s.options);
  refuse_usage("mesh", "--size is missing. " + hint);
}

Exit mesh(const Command& command, const MeshSettings& s, Outputs& outputs) {
  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  catch_interrupts();
  io::MeshFile space;
  if (s.sphere) space.points_in = io::SpherePoints{};
  outputs.expect_place(s.output, space);
  const auto [inputs, map, made] = s.sphere ? mesh_globe(s, threads.get()) : mesh_plane(s, threads.get());
  QualityOptions measuring;
  measuring.executor = threads.get();
  if (s.files.report.empty()) measuring.detail = QualityDetail::criterion;  // the text has no other numbers
  print_warnings(made.warnings);
  const Quality after = quality(made.mesh, measuring);

  print_warnings(outputs.write_mesh(s.output, io::from_outline(made, map.lon_lat, map.projection), threads.get()));
  std::vector<std::string> arguments;
  if (!s.input.empty()) arguments.push_back(s.input);
  const MeshRecord record = {command_line(command, arguments), inputs, map, made, after};
  if (!s.files.report.empty()) outputs.write_text(s.files.report, mesh_json(record));
  if (!s.files.picture.empty()) outputs.write_picture(s.files.picture, draw_svg(made.mesh));
  print(mesh_text(record) + fmt::format("{}: {}\n", s.output.path, verdict(after)));
  // Next to faces some triangles have no room to become well-centered, and a solver may not need that.
  const Criterion criterion = keeps_faces(made.mesh) ? criterion_of_target(s.target) : Criterion::well_centered;
  const std::size_t bad = violations(after, criterion);
  if (criterion != Criterion::well_centered) print(count_of_duals(bad, criterion) + "\n");
  const bool few = s.options.points == MeshPoints::few;
  if (few && made.bad > 0) {
    print(fmt::format("Next: {}{}--size instead of --points few, or {}\n",
                      stopped_early(made.report.stopped) ? "a longer --time-limit, " : "",
                      s.options.optimize->unknowns == Unknowns::positions ? "weights, " : "",
                      command_line("explain", s.output.path, s.projection)));
  } else if (!s.sphere && bad > 0) {
    print(next_step(s.output.path, s.projection, criterion, s.target));
  }
  // The time limit is the usual end of a search for few points.
  const bool is_usual_end = few && made.report.stopped == Stopped::time_limit && made.bad == 0;
  return stopped_early(made.report.stopped) && !is_usual_end ? Exit::stopped_early : Exit::done;
}

}  // namespace

Exit run_mesh(const Arguments& arguments) {
  Command command(
      "mesh",
      "Meshes the inside of an outline and optimizes the mesh until every triangle is well-centered. Points of the "
      "outline keep their coordinates bit for bit. If the outline is in longitude and latitude, these coordinates are "
      "kept. With --sphere it meshes a globe, or the part that coasts leave of it.");
  MeshSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  take_input(command, s);
  check_usage(command, s);
  if (s.options.points != MeshPoints::few && s.size.empty()) refuse_missing_size(s);
  s.options.optimize = *options_for(s.target);
  if (s.no_weights) s.options.optimize->unknowns = Unknowns::positions;
  s.files = sorted_outputs("mesh", s.write, kMeshOutputs);
  Outputs outputs("mesh");
  // The points of a .poly may be in the .node next to it.
  const std::vector<std::string> inputs = {s.input, utf8(path_of(s.input).replace_extension(".node")), s.coast, s.lines,
                                           s.size};
  outputs.expect_mesh(s.output, inputs);
  outputs.expect(s.files, inputs);
  return mesh(command, s, outputs);
}

}  // namespace temper::app
