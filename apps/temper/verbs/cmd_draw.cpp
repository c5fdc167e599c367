// temper draw IN -o P.svg: one mesh, or two side by side. Meshes of tetrahedra are cut by a plane.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/tensor_option.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "temper/dec.hpp"
#include "temper/detail/cells.hpp"
#include "temper/detail/dec_io.hpp"
#include "temper/detail/read_number.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/draw.hpp"
#include "temper/quality.hpp"
#include "temper/tets/draw.hpp"

namespace temper::app {
namespace {

struct DrawSettings {
  std::string projection;
  Heights heights;
  std::string input, before, output, color, cut;
  DrawOptions options;
  TensorOption tensor;
  std::optional<CellsOf> cells;
  bool no_primal = false, no_dual = false, no_rings = false;
};

void add_files(Command& command, DrawSettings& s) {
  command.group("Files");
  add_argument(command, "IN", s.input, "Mesh to draw, of " + any_elements() + ".").require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_text(command, "-o,--output", "FILE", s.output, "Picture to write: .svg, .png or .pdf.").require();
  add_text(command, "--before", "IN0", s.before, "Second mesh, drawn to the left of IN at the same scale.");
}

/// Adds options that choose the parts of a mesh and the view.
void add_parts(Command& command, DrawSettings& s) {
  add_text(
      command, "--cut", "AXIS[=VALUE]", s.cut,
      "Plane that cuts a mesh of tetrahedra, such as x=0.5. Without VALUE, the plane goes through the middle of the "
      "mesh. Without --cut, it is the middle plane at a right angle to the shortest side of the mesh. Tetrahedra are "
      "colored by their margin, and bad ones are hatched.")
      .cells = CellKinds::tetrahedra;
  add_numbers(
      command, "--view", "LON,LAT", 2,
      [&s](const std::vector<double>& v) {
        s.options.view = Vec2{v[0], v[1]};
      },
      "Center of the picture of a sphere, in degrees. The half of the sphere nearest to it is drawn. If you do not "
      "give it: the middle of a mesh that covers a part of the sphere, else 0,0. A curved surface is seen from this "
      "direction, by default from -60,30.");
  command.add_flag("--no-primal", s.no_primal, "Leave out the edges of triangles.");
  command.add_flag("--no-dual", s.no_dual, "Leave out the dual edges, which connect orthocenters.");
  command.add_flag("--no-rings", s.no_rings, "Do not mark vertices that nearly coincide with a neighbor.");
  command.add_flag("--weights", s.options.weights,
                   "Draw a circle of radius sqrt|w| around each vertex of weight w. It is dashed if w < 0.");
}

/// Adds options that fill triangles and cells.
void add_colors(Command& command, DrawSettings& s) {
  std::string colors = "none|";
  for (const TriangleValue& value : triangle_values()) colors += std::string(value.name) + "|";
  add_text(command, "--color", colors + "NAME", s.color,
           "Number by which triangles are filled; bright is good. If you do not give it, bad triangles are hatched "
           "and the others show their margin, which is the 'quality' from 0 to 0.3. 'none' leaves triangles white. "
           "'quality' is the least of h/l, d/l and 1 - d/l. 'angle' is the largest angle. 'size' is the mean length of "
           "the edges. 'region' is the number of the region. NAME is data of triangles or points in the files.")
      .cells_of = [](std::string_view color) {
    return color.empty() || color == "none" ? CellKinds::all : CellKinds::triangles;
  };
  add_choice(
      command, "--cells", kCellsOf, [&s](CellsOf value) { s.cells = value; },
      "Cells to fill by their regions, instead of triangles by their margin: power cells or triangles. Of the edges, "
      "only boundaries and lines are drawn. Lines on faces of power cells are thick, and have their names.");
  add_tensor(command, s.tensor, "Draw meshes");
}

void add_options(Command& command, DrawSettings& s) {
  add_files(command, s);
  command.group("Picture");
  add_parts(command, s);
  add_colors(command, s);
  command.add_flag("--numbers", s.options.vertex_numbers, "Number the vertices, from 0.");
  add_number(command, "--weight-scale", s.options.weight_scale, kPositive, "Factor on the radius of weight circles.");
  add_numbers(
      command, "--zoom", "x0,y0,x1,y1", 4,
      [&s](const std::vector<double>& v) {
        s.options.zoom = Box{{v[0], v[1]}, {v[2], v[3]}};
      },
      "Rectangle to draw; all outside it is left out. For a sphere, give coordinates in the picture: x to the right "
      "and y up from its middle.");
  add_number(command, "--width", s.options.width, kPositive, "Width of one panel, in CSS pixels.");
  add_text(command, "--title", "TEXT", s.options.title, "Title above the picture.");
  command.option("--view").cells = CellKinds::all_triangles;
  for (const char* name : {"--no-dual", "--no-rings", "--weights", "--numbers", "--weight-scale"})
    command.option(name).cells = CellKinds::triangles;
  command.group("Help");
  command.add_help({"IN -o FILE [options]",
                    "  temper draw in.vtu -o mesh.svg\n"
                    "  temper draw out.vtu --before in.vtu -o both.svg\n"
                    "  temper draw in.vtu -o angle.svg --color angle --no-dual\n"
                    "  temper draw out.vtu -o cells.svg --cells power --no-dual\n"
                    "  temper draw box.mesh -o cut.svg --cut x=0.5\n"
                    "  temper draw in.vtu -o corner.svg --zoom 0,0,0.5,0.5 --numbers --weights\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
}

/// A measure of the library, data of triangles, or the mean of data of points over the corners.
IdVector<TriangleId, double> values_of(const Input& input, const std::string& name) {
  const Mesh& mesh = input.mesh();
  IdVector<TriangleId, double> values;
  const auto known = std::ranges::find(triangle_values(), name, &TriangleValue::name);
  if (known != triangle_values().end()) {
    for (const TriangleId t : mesh.triangles()) values.push_back(known->of(mesh, t));
  } else if (const io::DataArray* of_triangles = find_numbers(input.file.triangles.data, name)) {
    for (const double value : as_doubles(*of_triangles)) values.push_back(value);
  } else if (const io::DataArray* of_points = find_numbers(input.file.point_data, name)) {
    const std::vector<double> at = at_vertices(input, *of_points);
    for (const TriangleId t : mesh.triangles()) {
      const auto [a, b, c] = mesh.corners(t);
      values.push_back((at[a.index] + at[b.index] + at[c.index]) / 3);
    }
  } else {
    std::vector<std::string_view> names;
    for (const TriangleValue& m : triangle_values()) names.push_back(m.name);
    for (const auto* data : {&input.file.triangles.data, &input.file.point_data}) {
      for (const io::DataArray& d : *data) {
        if (d.components == 1) names.push_back(d.name);
      }
    }
    throw Failure(Exit::bad_usage, fmt::format("{}: --color: there are no numbers '{}'; there are {}{}", input.path,
                                               name, join(names), did_you_mean(name, names)));
  }
  return values;
}

/// The colors of the panels, from left to right.
void set_colors(DrawOptions& options, const std::string& name, std::initializer_list<const Input*> panels) {
  options.fill = name != "none";
  if (name.empty() || !options.fill) return;
  const auto known = std::ranges::find(triangle_values(), name, &TriangleValue::name);
  options.colors = TriangleColors{name, {}};
  if (known != triangle_values().end()) {
    options.colors->label = known->label;
    options.colors->better = known->better;
  }
  for (const QualityMeasure& measure : quality_measures())  // data with the name that a community uses
    if (measure.alias == name) options.colors->better = measure.better;
  for (const Input* panel : panels) options.colors->values.push_back(values_of(*panel, name));
}

/// The lines on faces of power cells, with their names.
std::vector<FaceLine> face_lines(const Input& input) {
  std::map<std::int32_t, std::string> names;
  for (const PhysicalName& name : input.file.names) {
    if (name.dimension == 1) names.emplace(name.tag, name.name);
  }
  const std::set<std::int32_t> tags(input.file.lines.tags.begin(), input.file.lines.tags.end());
  std::vector<FaceLine> lines;
  for (const std::int32_t tag : tags) {
    const auto faces = io::faces_of_line(input.file, input.loaded, input.mesh(), std::to_string(tag));
    if (!faces) continue;  // on edges of triangles
    FaceLine& line = lines.emplace_back();
    if (const auto name = names.find(tag); name != names.end()) line.name = name->second;
    for (const io::LineFace& face : *faces) line.pieces.push_back({face.from, face.to});
  }
  return lines;
}

/// Cells with the duals of tensors, in the plane of the mesh.
CellPolygons cells_in_metric(const Mesh& mesh, const MetricMesh& pieces, CellsOf of) {
  const DecComplex there = dec_operators(pieces.mesh);
  if (of == CellsOf::triangles) return cell_polygons(mesh, mapped_back(there, pieces, mesh), of);
  return cell_polygons(mesh, mapped_back(power_cells(pieces.mesh, there), pieces));
}

/// The cells of the panels, from left to right.
void set_cells(DrawOptions& options, const std::optional<CellsOf>& of, std::initializer_list<const Input*> panels) {
  if (!of) return;
  options.cells.emplace();
  for (const Input* panel : panels) {
    expect_plane(panel->mesh(), panel->path, "--cells");
    const std::size_t number = options.cells->panels.size();
    options.cells->panels.push_back(options.pieces.empty()
                                        ? cell_polygons(panel->mesh(), dec_operators(panel->mesh()), *of)
                                        : cells_in_metric(panel->mesh(), options.pieces[number], *of));
    options.cells->lines.push_back(*of == CellsOf::vertices ? face_lines(*panel) : std::vector<FaceLine>());
    for (const PhysicalName& name : panel->file.names) {
      if (name.dimension == 2) options.cells->names.emplace(name.tag, name.name);
    }
  }
}

void check_zoom(const DrawOptions& options) {
  if (!options.zoom) return;
  const Box& box = *options.zoom;
  if (box.low.x < box.high.x && box.low.y < box.high.y) return;
  refuse_usage("draw", "--zoom: it must have x0 < x1 and y0 < y1");
}

void expect_direction(const DrawOptions& options) {
  if (!options.view) return;
  if (!(std::abs(options.view->x) <= 360) || !(std::abs(options.view->y) <= 90)) {
    refuse_usage("draw", "--view: expected a longitude from -360 to 360 and a latitude from -90 to 90");
  }
}

void check_view(const DrawOptions& options, const Input& input) {
  if (!options.view) return;
  expect_direction(options);
  if (!input.mesh().space().is_plane()) return;
  throw Failure(Exit::bad_usage,
                fmt::format("{}: --view: the mesh is in a plane; expected a mesh of the sphere", input.path));
}

void check_same_space(const Input& before, const Input& after) {
  if (before.mesh().space().kind() == after.mesh().space().kind()) return;
  const auto name = [](const Input& input) {
    constexpr const char* kNames[] = {"the plane", "the sphere", "a periodic plane"};
    return kNames[static_cast<std::size_t>(input.mesh().space().kind())];
  };
  throw Failure(Exit::bad_input,
                fmt::format("{}: is a mesh of {}, but {} is a mesh of {}; expected two meshes of the same space",
                            before.path, name(before), after.path, name(after)));
}

/// The plane of --cut. Failure if the words are no plane, or it misses the mesh.
tets::Plane plane_of(const DrawSettings& s, const tets::TetMesh& mesh) {
  if (s.cut.empty()) return tets::middle_plane(mesh);
  const auto axis = std::string_view("xyz").find(s.cut[0]);
  if (axis == std::string_view::npos || (s.cut.size() > 1 && s.cut[1] != '='))
    refuse_usage("draw", fmt::format("--cut: expected x=VALUE, y=VALUE, z=VALUE or one of x, y, z, found '{}'", s.cut));
  if (s.cut.size() == 1) return middle_plane(mesh, static_cast<int>(axis));
  double at = 0;
  const char* const end = s.cut.data() + s.cut.size();
  const auto [read_to, error] = read_number(s.cut.data() + 2, end, at);
  if (error != std::errc() || read_to != end)
    refuse_usage("draw", fmt::format("--cut: expected a number after '=', found '{}'", s.cut));
  const auto plane = plane_through(mesh, static_cast<int>(axis), at);
  if (!plane) throw Failure(Exit::bad_usage, fmt::format("{}: --cut: {}", s.input, plane.error().message));
  return *plane;
}

/// The meshes of the panels in the metrics of tensors, from left to right; none without tensors. Warns if dual edges do
/// not cross interfaces at one place.
template <class Subject>
std::vector<typename Subject::Pieces> pieces_of(const DrawSettings& s, const InputOf<Subject>& input,
                                                const InputOf<Subject>* before) {
  std::vector<typename Subject::Pieces> all;
  if (!s.tensor.given()) return all;
  for (const InputOf<Subject>* panel : {before, &input}) {
    if (panel == nullptr) continue;
    all.push_back(*metric_of(*panel, s.tensor));
    if (panel == &input) warn_of_crossings(input, all.back());
  }
  return all;
}

/// The picture of a mesh, or of two if `before` is not null.
std::string picture(const DrawSettings& s, Input& input, Input* before) {
  check_view(s.options, input);
  DrawOptions options = s.options;
  options.pieces = pieces_of(s, input, before);
  if (before == nullptr) {
    set_colors(options, s.color, {&input});
    set_cells(options, s.cells, {&input});
    return draw_svg(input.mesh(), options);
  }
  check_same_space(*before, input);
  set_colors(options, s.color, {before, &input});
  set_cells(options, s.cells, {before, &input});
  return draw_before_after_svg(before->mesh(), input.mesh(), options);
}

std::string picture(const DrawSettings& s, const TetInput& input, const TetInput* before) {
  DrawOptions options = s.options;
  const std::vector<tets::MetricMesh> pieces = pieces_of(s, input, before);
  options.fill = s.color != "none";
  const tets::Plane plane = plane_of(s, input.mesh());
  return before == nullptr ? draw_svg(input.mesh(), plane, options, pieces)
                           : draw_before_after_svg(before->mesh(), input.mesh(), plane, options, pieces);
}

std::string picture(const DrawSettings& s, const SurfaceInput& input, const SurfaceInput* before) {
  expect_direction(s.options);
  DrawOptions options = s.options;
  options.fill = s.color != "none";
  return before == nullptr ? draw_svg(input.mesh(), options)
                           : draw_before_after_svg(before->mesh(), input.mesh(), options);
}

template <class Subject>
void draw(const DrawSettings& s, InputOf<Subject>& input, Outputs& outputs) {
  print_warnings(input.warnings());
  std::optional<InputOf<Subject>> before;
  if (!s.before.empty()) {
    before = read_like(input, s.before, {same_projection(input.file, s.projection), {}, nullptr, s.heights});
    print_warnings(before->warnings());
  }
  outputs.write_picture(s.output, picture(s, input, before ? &*before : nullptr));
}

}  // namespace

Exit run_draw(const Arguments& arguments) {
  Command command(
      "draw",
      "Draws triangles and their dual, or a cut through tetrahedra, as SVG, PNG or PDF. Bad triangles and tetrahedra, "
      "which are not well-centered, are hatched.");
  DrawSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  s.options.primal = !s.no_primal;
  s.options.dual = !s.no_dual;
  s.options.near_coincident = !s.no_rings;
  check_zoom(s.options);
  if (s.cells && command.was_given("--color")) refuse_usage("draw", "--color and --cells: expected one of the two");
  Outputs outputs("draw");
  outputs.expect_picture("--output", s.output, s.before.empty() ? Arguments{s.input} : Arguments{s.input, s.before});

  AnyInput any = read_any(command, s.input, {s.projection, {}, nullptr, s.heights});
  std::visit([&](auto& input) { draw(s, input, outputs); }, any);
  return Exit::done;
}

}  // namespace temper::app
