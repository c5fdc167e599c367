// temper errors IN: the errors of solvers on a mesh, measured with manufactured solutions.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/problem_options.hpp"
#include "files/tensor_option.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "reports/error_report.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

struct ErrorSettings {
  std::string projection;
  Heights heights;
  std::string input, against, fields = "all", edges;
  ProblemOptions problem;
  int refine = 0;
  std::uint64_t threads = 0;
  bool condition = false, json = false;
  std::optional<Metric> metric;
};

// Relative to the size of the domain: the rounding of coordinates by text formats.
constexpr double kSameBox = 1e-6;

std::string field_names() {
  std::string text;
  const auto add = [&text](std::string_view begin, SpaceKind space) {
    text += begin;
    std::string_view separator = " ";
    for (const ErrorField& field : error_fields(space)) {
      text += fmt::format("{}{}", separator, field.name);
      separator = ", ";
    }
    text += ".";
  };
  add("Fields of the plane:", SpaceKind::plane);
  add(" Fields of the sphere:", SpaceKind::sphere);
  add(" Fields of a periodic plane:", SpaceKind::periodic_plane);
  text += " Fields of tetrahedra:";
  for (const ErrorField& field : tets::error_fields()) text += fmt::format(" {},", field.name);
  text.back() = '.';
  return text;
}

void add_options(Command& command, ErrorSettings& s) {
  command.group("Report");
  add_argument(command, "IN", s.input, "Mesh file. Its content shows the format.").require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  command.add_flag("--json", s.json,
                   "Print the report as JSON. A null is an infinite number, or an order that is undefined.");
  add_text(command, "--against", "MESH", s.against,
           "Another mesh of the same domain. For each field, also print the error of IN divided by the error of MESH.");
  add_text(command, "--edges", "FILE", s.edges,
           "Write the error of star 1 at each edge as CSV, with points counted from 0.")
      .cells = CellKinds::triangles;
  command.group("Measures");
  add_text(
      command, "--fields", "LIST", s.fields,
      "Solutions to try, separated by commas. Groups of fields are all, chosen, held-back and exact. " + field_names())
      .defaults_to([&s] { return s.fields; });
  add_count(
      command, "--refine", s.refine, 0,
      "Number of refinements, each of which cuts every triangle into four. The report then has orders of convergence.")
      .cells = CellKinds::triangles;
  add_tensor(command, s.metric, "Take solutions and errors");
  command.add_flag("--condition", s.condition, "Also estimate the condition numbers of both matrices.");
  add_threads(command, s.threads);
  command.group("Your own problem, -div(K grad u) = f");
  add_problem(command, s.problem,
              "The report is then about this problem: both schemes against finite elements on a refined mesh.");
  command.group("Help");
  command.add_help({"IN [options]",
                    "  temper errors in.vtu\n"
                    "  temper errors in.vtu --fields held-back --refine 2 --json\n"
                    "  # compare the errors before and after an optimization\n"
                    "  temper example annulus -o ring.vtu && temper optimize ring.vtu -o better.vtu --quiet\n"
                    "  temper errors better.vtu --against ring.vtu\n"
                    "  # the heads of a well field\n"
                    "  temper errors in.vtu --dirichlet boundary=0 --source 1e-3\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
}

/// Fails on unknown fields before a large mesh is read.
void check_fields(const MeasureErrorsOptions& options) {
  Mesh none;
  const auto report = measure_errors(none, options);
  const auto unknown = [&](const Space& space) {
    none.set_space(space);
    const auto tried = measure_errors(none, options);
    return !tried && tried.error().code == ErrorCode::invalid_option;
  };
  const auto of_tetrahedra = tets::measure_errors({}, {.fields = options.fields});
  if (unknown(Space()) && unknown(Space::sphere(1)) && unknown(Space::periodic({1, 1})) &&
      of_tetrahedra.error().code == ErrorCode::invalid_option) {
    throw Failure(Exit::bad_usage, "--fields: " + report.error().message + "\nSee temper errors --help");
  }
}

/// Warns if two meshes do not have the same box.
template <class Frame>
void compare_boxes(const ErrorSettings& s, const Frame& a, const Frame& b) {
  if (std::abs(a.half_size - b.half_size) <= kSameBox * b.half_size &&
      length(a.center - b.center) <= kSameBox * b.half_size)
    return;
  print_warnings(std::vector<std::string>{fmt::format(
      "{} and {} do not have the same bounding box: both are measured in the box of {}", s.input, s.against, s.input)});
}

ErrorRecord::Reference measure_reference(const ErrorSettings& s, const std::string& projection,
                                         const MeasureErrorsOptions& options, const FieldFrame& frame) {
  Input reference = read_input(s.against, {projection, {}, options.executor, true, s.heights});
  print_warnings(reference.warnings());
  take_to_metric(reference, s.metric);
  compare_boxes(s, frame, field_frame(reference.mesh()));
  MeasureErrorsOptions same = options;
  same.refine = 0;
  same.local = false;
  return {s.against, or_fail(measure_errors(reference.mesh(), same)), {}};
}

DiffusionErrors measure_problem(const Command& command, const ErrorSettings& s, const std::string& path,
                                const std::string& projection, Executor* executor) {
  const Input input = read_input(path, {projection, {}, executor, true});
  print_warnings(input.warnings());
  const DiffusionProblem problem = read_problem(command, s.problem, input);
  const int refinements = s.refine > 0 ? s.refine : 2;
  auto errors = measure_diffusion_errors(input.mesh(), problem, refinements, input.names.get());
  if (!errors) throw Failure(Exit::bad_input, located(errors.error(), path).what());
  return *std::move(errors);
}

/// The mesh of a file of tetrahedra.
TetInput read_tetrahedra(const std::string& path, Executor* executor) {
  io::MeshFile file = read_tried(path, {executor});
  if (file.dimension() == 2)
    throw Failure(Exit::bad_input, fmt::format("{}: expected tetrahedra, as in the other mesh, found triangles", path));
  TetInput input = make_input(path, std::move(file), executor);
  print_warnings(input.warnings());
  return input;
}

Exit run_tetrahedra(const Command& command, const ErrorSettings& s, io::MeshFile file, Executor* executor) {
  command.expect_for(CellKinds::tetrahedra, s.input);
  const TetInput input = make_input(s.input, std::move(file), executor);
  print_warnings(input.warnings());
  tets::MeasureErrorsOptions options = {separated(s.fields), tets::field_frame(input.mesh()), s.condition};
  TetErrorRecord record = {s.input, or_fail(tets::measure_errors(input.mesh(), options)), {}};
  if (!s.against.empty()) {
    const TetInput reference = read_tetrahedra(s.against, executor);
    compare_boxes(s, *options.frame, tets::field_frame(reference.mesh()));
    record.against = {s.against, or_fail(tets::measure_errors(reference.mesh(), options)), {}};
    record.against->ratios = or_fail(tets::error_ratios(record.report, record.against->report));
  }
  s.json ? print_data(error_json(record)) : print(error_text(record, text_style()));
  return Exit::done;
}

/// The report of the user's own problem.
Exit run_problem(const Command& command, const ErrorSettings& s, Executor* executor) {
  for (const char* option : {"--fields", "--tensor", "--edges", "--condition"}) {
    if (command.was_given(option))
      refuse_usage("errors",
                   std::string(option) + " is about manufactured solutions, and does not go with --dirichlet");
  }
  ProblemRecord record = {s.input, measure_problem(command, s, s.input, s.projection, executor), s.against, {}};
  if (!s.against.empty()) record.reference = measure_problem(command, s, s.against, s.projection, executor);
  s.json ? print_data(problem_json(record)) : print(problem_text(record));
  return Exit::done;
}

}  // namespace

Exit run_errors(const Arguments& arguments) {
  Command command(
      "errors",
      "Measures the errors that solvers make on a mesh, with manufactured solutions. It tests diagonal Hodge stars and "
      "two Poisson problems. One uses discrete exterior calculus at the vertices, the other two-point fluxes at the "
      "orthocenters. It also describes their matrices. The page docs/reference/errors.md defines every number.");
  ErrorSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  MeasureErrorsOptions options;
  options.fields = separated(s.fields);
  check_fields(options);
  Outputs outputs("errors");
  std::vector<std::string> inputs = {s.input};
  if (!s.against.empty()) inputs.push_back(s.against);
  outputs.expect_text("--edges", s.edges, inputs);

  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  expect_complete(command, s.problem);
  io::MeshFile file = read_tried(s.input, s.heights.to_read(threads.get()));
  if (file.dimension() == 3) return run_tetrahedra(command, s, std::move(file), threads.get());
  if (s.problem.given()) return run_problem(command, s, threads.get());
  options.executor = threads.get();
  const auto read = [&](const std::string&) { return std::move(file); };
  Input input = read_input(s.input, {s.projection, {}, threads.get(), true, s.heights, read});
  print_warnings(input.warnings());
  take_to_metric(input, s.metric);
  options.frame = field_frame(input.mesh());
  options.refine = s.refine;
  options.condition = s.condition;
  options.local = !s.edges.empty();
  ErrorRecord record = {s.input, or_fail(measure_errors(input.mesh(), options)), {}};
  if (!s.against.empty()) {
    record.against = measure_reference(s, same_projection(input, s.projection), options, *options.frame);
    record.against->ratios = or_fail(error_ratios(record.report, record.against->report));
  }
  if (!s.edges.empty()) outputs.write_text(s.edges, edge_errors_csv(record.report, input));
  s.json ? print_data(error_json(record)) : print(error_text(record, text_style()));
  return Exit::done;
}

}  // namespace temper::app
