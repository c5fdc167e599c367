// temper operators IN -o DIR: the operators of discrete exterior calculus and finite volumes, as files for solvers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/problem_options.hpp"
#include "files/tensor_option.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "reports/reports.hpp"
#include "temper/detail/dec_io.hpp"
#include "temper/detail/path.hpp"
#include "temper/detail/suggest.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

namespace fs = std::filesystem;

constexpr Choice<io::DecFormat> kDecFormats[] = {{"npz", io::DecFormat::npz},   {"mtx", io::DecFormat::mtx},
                                                 {"vtu", io::DecFormat::vtu},   {"disv", io::DecFormat::disv},
                                                 {"disu", io::DecFormat::disu}, {"tough", io::DecFormat::tough},
                                                 {"uge", io::DecFormat::uge}};

struct DecSettings {
  std::string projection;
  Heights heights;
  std::string input, output, formats = "npz,mtx,vtu";
  std::string layers, coefficient;
  double pinch_out = 0;
  CellsOf cells = CellsOf::vertices;
  std::string barriers;
  TensorOption tensor;
  std::uint64_t threads = 0;
  bool json = false;
};

void add_options(Command& command, DecSettings& s) {
  command.group("Files");
  add_argument(command, "IN", s.input, "Mesh file. Its content shows the format.").require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_text(command, "-o,--output", "DIR", s.output, "Folder for the files. It is made if it does not exist.").require();
  add_text(command, "--format", "LIST", s.formats,
           "Formats to write, separated by commas. 'npz' is for NumPy and SciPy, 'mtx' is Matrix Market, and 'vtu' "
           "holds the dual for ParaView. With --layers there are also 'disv' and 'disu' for MODFLOW 6, 'tough' for "
           "TOUGH2 and TOUGH3, and 'uge' for PFLOTRAN. Tetrahedra have 'tough' and 'uge', too.")
      .defaults_to([&s] { return s.formats; });
  command.group("Coefficients");
  add_coefficient(command, s.coefficient);
  add_tensor(command, s.tensor, "Make stars, fluxes, orthocenters and power cells");
  command.group("Layers");
  add_text(command, "--layers", "FILE", s.layers,
           "CSV file with the heights of the surfaces between layers, for columns of cells below the mesh. Its title "
           "line is vertex,top,bottom 1,bottom 2,... Each vertex has a row, or one row with * holds for all. See "
           "docs/reference/formats/layers.md.")
      .cells = CellKinds::triangles;
  add_choice(command, "--cells", kCellsOf, s.cells,
             "Cells seen from above. 'power' takes the power cells, with vertices as centers. 'triangles' takes the "
             "triangles, with orthocenters as centers.");
  add_number(command, "--pinch-out", s.pinch_out, kNotNegative,
             "Least thickness. If a layer is not thicker than this at a vertex, it has no cell there. The cells above "
             "and below are then connected.")
      .cells = CellKinds::triangles;
  add_text(
      command, "--barriers", "NAME=C,...", s.barriers,
      "Lines that are barriers to flow, by name or tag, each with its hydraulic characteristic: the conductivity of "
      "the barrier over its width. The files of 'disv' and 'disu' then have one for MODFLOW's package HFB. Lines of "
      "'temper mesh --faces' are faces of power cells. Others need --cells triangles.")
      .cells = CellKinds::triangles;
  command.group("Report");
  command.add_flag("--json", s.json, "Print the summary as JSON.");
  add_threads(command, s.threads);
  command.group("Help");
  command.add_help({"IN -o DIR [options]",
                    "  temper operators in.vtu -o operators\n"
                    "  temper operators in.vtu -o operators --format npz --json\n"
                    "  temper operators in.vtu -o operators --coefficient 0=2.5\n"
                    "  temper optimize in.vtu -o out.vtu\n"
                    "  temper operators out.vtu -o model --layers layers.csv --format disv,tough\n"
                    "  temper operators out.vtu -o model --layers layers.csv --format disv --cells triangles\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
}

std::vector<io::DecFormat> parse_formats(std::string_view list) {
  std::vector<io::DecFormat> formats;
  std::vector<std::string_view> names;
  for (const auto& choice : kDecFormats) names.push_back(choice.name);
  for (const std::string& name : separated(list)) {
    const auto known = std::find_if(std::begin(kDecFormats), std::end(kDecFormats),
                                    [&](const auto& choice) { return choice.name == name; });
    if (known == std::end(kDecFormats)) {
      refuse_usage("operators", "--format: " + none_of(name, names));
    }
    formats.push_back(known->value);
  }
  return formats;
}

/// Checks that options which need layers have them.
void check_layers(const Command& command, const DecSettings& s, const std::vector<io::DecFormat>& formats) {
  const bool wanted = std::ranges::any_of(formats, [](io::DecFormat format) { return io::needs_columns(format); });
  if (wanted && s.layers.empty()) refuse_usage("operators", "--format: disv, disu, tough and uge need --layers");
  for (const char* const option : {"--barriers", "--cells", "--pinch-out"}) {
    if (s.layers.empty() && command.was_given(option))
      print_warnings(std::array{fmt::format("{} has no effect without --layers", option)});
  }
}

/// Checks that the cells of layers have one tensor each, and that the solver takes their lengths from the file.
void check_tensor(const DecSettings& s, const std::vector<io::DecFormat>& formats) {
  if (!s.tensor.given() || s.layers.empty()) return;
  if (s.tensor.may_differ() && s.cells == CellsOf::vertices)
    refuse_usage("operators",
                 "--tensor: a power cell may have several tensors. Next: --cells triangles, or one tensor for all");
  if (std::ranges::find(formats, io::DecFormat::disv) != formats.end())
    refuse_usage("operators",
                 "--tensor does not go with --format disv, where MODFLOW computes lengths itself, without the tensor. "
                 "Next: --format disu");
}

/// Checks before the work that a folder can be made, and that no input is one of the files that will be replaced.
void check_folder(const DecSettings& s, const std::vector<io::DecFormat>& formats, io::DecKind kind) {
  std::error_code ignored;
  if (fs::exists(path_of(s.output), ignored) && !fs::is_directory(path_of(s.output), ignored)) {
    throw Failure(Exit::bad_input, fmt::format("{}: is not a folder; expected a folder, or a new name", s.output));
  }
  for (const io::DecFormat format : formats) {
    for (const std::string_view name : io::dec_file_names(format, kind)) {
      const std::string path = utf8(path_of(s.output) / name);
      if (same_file(path, s.input))
        throw Failure(Exit::bad_usage, fmt::format("operators: --output: {} is the input mesh", path));
      if (same_file(path, s.layers))
        throw Failure(Exit::bad_usage, fmt::format("operators: --output: {} is the file of --layers", path));
    }
  }
}

/// Takes K into the operators, if it is given.
template <class Subject, class Complex>
Complex with_k(const Command& command, const DecSettings& s, const InputOf<Subject>& input, Complex complex) {
  const std::vector<double> k = read_coefficient(command, s.coefficient, input);
  if (k.empty()) return complex;
  auto made = with_coefficient(input.mesh(), std::move(complex), k, input.names.get());
  if (!made) throw Failure(Exit::bad_input, located(made.error(), s.input).what());
  return *std::move(made);
}

/// Nothing without --layers.
std::optional<Columns> make_columns(const DecSettings& s, const Input& input, const DecComplex& complex,
                                    const PowerCells& cells) {
  if (s.layers.empty()) return {};
  const Mesh& mesh = input.mesh();
  expect_plane(mesh, s.input, "--layers");
  const bool power = s.cells == CellsOf::vertices;
  Layers layers = or_fail(io::read_layers(s.layers, input.file, input.loaded));
  if (!power) layers = layers_of_triangles(mesh, layers);
  auto made =
      columns(mesh, complex, power ? cell_polygons(mesh, cells) : cell_polygons(mesh, complex, CellsOf::triangles),
              layers, {s.pinch_out, input.names.get()});
  if (!made) throw as_failure(located(made.error(), s.input));
  return *std::move(made);
}

/// None without --barriers.
std::vector<io::Barrier> make_barriers(const DecSettings& s, const Input& input) {
  if (s.barriers.empty()) return {};
  std::vector<std::pair<std::string, double>> characteristics;
  for (const std::string& entry : separated(s.barriers)) {
    const std::size_t equals = entry.rfind('=');
    const auto value =
        equals == std::string::npos ? std::nullopt : parse_number(std::string_view(entry).substr(equals + 1));
    if (!value) refuse_usage("operators", fmt::format("--barriers: expected NAME=NUMBER, found '{}'", entry));
    characteristics.emplace_back(entry.substr(0, equals), *value);
  }
  auto made = io::barriers_of_lines(input.file, input.loaded, input.mesh(), characteristics, s.cells);
  if (!made) throw as_failure(located(made.error(), s.input));
  return *std::move(made);
}

/// The JSON has no sentences: the verdict is a warning then.
template <class Record>
void warn(const DecSettings& s, const Record& record) {
  if (const std::string trouble = dec_trouble(record); s.json && !trouble.empty()) print_warnings(std::array{trouble});
  print_warnings(dec_warnings(record));
}

void write(const Command& command, const DecSettings& s, TetInput& input, const std::vector<io::DecFormat>& formats,
           Executor* executor) {
  const auto view = take_to_metric(input, s.tensor);
  tets::DecComplex complex = with_k(command, s, input, tets::dec_operators(input.mesh()));
  if (view) complex = mapped_back(complex, view->pieces, view->plain);
  const tets::DecSummary summary = tets::summarize(complex);
  TetDecRecord record = {s.input, summary, {}};
  warn(s, record);
  io::DecWriteOptions options;
  options.formats = formats;
  options.points = input.points;
  options.executor = executor;
  record.files = or_fail(io::write_dec(s.output, view ? view->plain : input.mesh(), complex, options));
  s.json ? print_data(dec_json(record)) : print(dec_text(record));
}

void write(const Command& command, const DecSettings& s, SurfaceInput& input, const std::vector<io::DecFormat>& formats,
           Executor* executor) {
  const surfaces::SurfaceMesh& mesh = input.mesh();
  const DecComplex complex = with_k(command, s, input, dec_operators(mesh));
  const DecSummary summary = summarize(mesh, complex);
  const PowerCells cells = dual_cells(mesh, complex);
  DecRecord record = {s.input, summary, cells, nullptr, {}};
  warn(s, record);
  io::DecWriteOptions options;
  options.formats = formats;
  options.points = input.points;
  options.executor = executor;
  record.files = or_fail(io::write_dec(s.output, mesh, complex, cells, options));
  s.json ? print_data(dec_json(record)) : print(dec_text(record));
}

/// The warning that operators have the halves of quadrilaterals.
void warn_of_halves(const Input& input) {
  const std::size_t n = count_quadrilaterals(input.mesh());
  if (n == 0) return;
  print_warnings(std::array{fmt::format("{}: {} two triangles each in the operators, with the diagonal as an edge",
                                        input.path, plural(n, "quadrilateral is", "quadrilaterals are"))});
}

void write(const Command& command, const DecSettings& s, Input& input, const std::vector<io::DecFormat>& formats,
           Executor* executor) {
  if (s.layers.empty()) io::release_geometry(input.file, input.loaded);  // the mesh has it
  const std::optional<MetricView> view = take_to_metric(input, s.tensor);
  DecComplex complex = with_k(command, s, input, dec_operators(input.mesh()));
  PowerCells cells = power_cells(input.mesh(), complex);
  if (view) {
    complex = mapped_back(std::move(complex), view->pieces, view->plain);
    cells = mapped_back(std::move(cells), view->pieces);
  }
  const DecSummary summary = summarize(input.mesh(), complex);
  if (view) input.loaded.mesh = view->plain;
  const std::optional<Columns> under_layers = make_columns(s, input, complex, cells);
  const Columns* const columns = under_layers ? &*under_layers : nullptr;
  DecRecord record = {s.input, summary, cells, columns, {}};
  warn(s, record);
  warn_of_halves(input);
  const std::vector<io::GroupCell> groups = columns != nullptr
                                                ? io::cells_of_groups(input.file, input.loaded, input.mesh(), s.cells)
                                                : std::vector<io::GroupCell>();
  const std::vector<io::Barrier> barriers = make_barriers(s, input);
  io::DecWriteOptions options = {formats, input.points, input.file.z(), columns, groups};
  if (!s.barriers.empty()) options.barriers = barriers;
  options.names = input.names.get();
  options.executor = executor;
  record.files = or_fail(io::write_dec(s.output, input.mesh(), complex, cells, options));
  s.json ? print_data(dec_json(record)) : print(dec_text(record));
}

}  // namespace

Exit run_operators(const Arguments& arguments) {
  Command command("operators",
                  "Writes the operators of a mesh for solvers: incidence d0 and d1, and diagonal stars with signed "
                  "power duals. It also writes orthocenters, weighted midpoints, transmissibilities, and power cells "
                  "within the domain. With --layers it also writes columns of cells for MODFLOW 6 and TOUGH. A mesh "
                  "of tetrahedra has d2 and star 3, too.");
  DecSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  const std::vector<io::DecFormat> formats = parse_formats(s.formats);
  check_tensor(s, formats);
  const io::DecKind of_triangles = s.layers.empty() ? io::DecKind::triangles : io::DecKind::columns;
  check_folder(s, formats, of_triangles);

  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  const auto expect = [&](CellKinds cells) {
    command.expect_for(cells, s.input);
    if (cells == Tetrahedra::cells)
      check_folder(s, formats, io::DecKind::tetrahedra);
    else if (cells == Triangles::cells)
      check_layers(command, s, formats);
  };
  AnyInput any = read_any(s.input, {s.projection, {}, threads.get(), s.heights, expect});
  std::visit(
      [&](auto& input) {
        print_warnings(input.warnings());
        write(command, s, input, formats, threads.get());
      },
      any);
  return Exit::done;
}

}  // namespace temper::app
