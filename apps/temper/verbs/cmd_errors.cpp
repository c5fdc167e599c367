// temper errors IN: the errors of solvers on a mesh, measured with manufactured solutions.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <span>
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
  bool condition = false, json = false, details = false;
  TensorOption tensor;
};

// Relative to the size of the domain: the rounding of coordinates by text formats.
constexpr double kSameBox = 1e-6;

std::string field_names() {
  std::string text;
  const auto add = [&text](std::string_view begin, std::span<const ErrorField> fields) {
    text += begin;
    std::string_view separator = " ";
    for (const ErrorField& field : fields) {
      text += fmt::format("{}{}", separator, field.name);
      separator = ", ";
    }
    text += ".";
  };
  add("Fields of the plane:", error_fields(SpaceKind::plane));
  add(" Fields of the sphere:", error_fields(SpaceKind::sphere));
  add(" Fields of a periodic plane:", error_fields(SpaceKind::periodic_plane));
  add(" Fields of tetrahedra and curved surfaces:", tets::error_fields());
  return text;
}

void add_options(Command& command, ErrorSettings& s) {
  command.group("Report");
  add_argument(command, "IN", s.input, "Mesh file. Its content shows the format.").require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  command.add_flag("--details", s.details,
                   "Print the errors of each field, and all that is known of the matrices. Without it, the report has "
                   "the means, and what solvers need.");
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
  add_tensor(command, s.tensor, "Take solutions and errors");
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
  std::string text;
  const auto is_unknown = [&text](const auto& tried) {
    if (tried || tried.error().code != ErrorCode::invalid_option) return false;
    const std::string& message = tried.error().message;
    text += text.empty() ? message : message.substr(message.find("; "));
    return true;
  };
  for (const Space& space : {Space(), Space::sphere(1), Space::periodic({1, 1})}) {
    Mesh none;
    none.set_space(space);
    if (!is_unknown(measure_errors(none, options))) return;
  }
  if (is_unknown(tets::measure_errors({}, {.fields = options.fields})))
    throw Failure(Exit::bad_usage, "--fields: " + text + "\nSee temper errors --help");
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

/// The options of the measures, in the frame of `input`.
MeasureErrorsOptions error_options(const ErrorSettings& s, const Input& input, Executor* executor) {
  MeasureErrorsOptions options;
  options.fields = separated(s.fields);
  options.executor = executor;
  options.frame = field_frame(input.mesh());
  options.refine = s.refine;
  options.condition = s.condition;
  options.local = !s.edges.empty();
  return options;
}
template <class Subject>
tets::MeasureErrorsOptions error_options(const ErrorSettings& s, const InputOf<Subject>& input,
                                         Executor* /*executor*/) {
  return {separated(s.fields), field_frame(input.mesh()), s.condition};
}
/// Those for the mesh of --against.
MeasureErrorsOptions without_orders(MeasureErrorsOptions options) {
  options.refine = 0;
  options.local = false;
  return options;
}
tets::MeasureErrorsOptions without_orders(tets::MeasureErrorsOptions options) { return options; }

void write_edges(const ErrorSettings& s, const ErrorRecord<Triangles>& record, const Input& input, Outputs& outputs) {
  if (!s.edges.empty()) outputs.write_text(s.edges, edge_errors_csv(record.report, input));
}
template <class Subject>
void write_edges(const ErrorSettings&, const ErrorRecord<Subject>&, const InputOf<Subject>&, Outputs&) {}

template <class Subject>
InputOf<Subject> read_reference(const ErrorSettings& s, const InputOf<Subject>& input, Executor* executor) {
  InputOf<Subject> reference =
      read_like(input, s.against, {same_projection(input.file, s.projection), {}, executor, s.heights});
  print_warnings(reference.warnings());
  return reference;
}

/// The report about manufactured solutions.
template <class Subject>
void report_fields(const ErrorSettings& s, InputOf<Subject>& input, Outputs& outputs, Executor* executor) {
  if constexpr (is_flat_subject<Subject>) take_to_metric(input, s.tensor);
  const auto options = error_options(s, input, executor);
  const auto measured = [](const auto& mesh, const auto& how) { return or_fail(measure_errors(mesh, how)); };
  ErrorRecord<Subject> record = {s.input, measured(input.mesh(), options), {}};
  if (!s.against.empty()) {
    InputOf<Subject> reference = read_reference(s, input, executor);
    if constexpr (is_flat_subject<Subject>) take_to_metric(reference, s.tensor);
    compare_boxes(s, *options.frame, field_frame(reference.mesh()));
    record.against = {s.against, measured(reference.mesh(), without_orders(options)), {}};
    record.against->ratios = or_fail(error_ratios(record.report, record.against->report));
  }
  write_edges(s, record, input, outputs);
  s.json ? print_data(error_json(record))
         : print(error_text(record, s.details ? ErrorRows::all : ErrorRows::means, text_style()));
}

DiffusionErrors measure_problem(const Command& command, const ErrorSettings& s, const Input& input) {
  const DiffusionProblem problem = read_problem(command, s.problem, input);
  const int refinements = s.refine > 0 ? s.refine : 2;
  auto errors = measure_diffusion_errors(input.mesh(), problem, refinements, input.names.get());
  if (!errors) throw Failure(Exit::bad_input, located(errors.error(), input.path).what());
  return *std::move(errors);
}

void expect_no_fields(const Command& command) {
  for (const char* option : {"--fields", "--tensor", "--edges", "--condition"}) {
    if (command.was_given(option))
      refuse_usage("errors",
                   std::string(option) + " is about manufactured solutions, and does not go with --dirichlet");
  }
}

/// The report of the user's own problem.
void report_problem(const Command& command, const ErrorSettings& s, const Input& input, Executor* executor) {
  ProblemRecord record = {s.input, measure_problem(command, s, input), s.against, {}};
  if (!s.against.empty()) record.reference = measure_problem(command, s, read_reference(s, input, executor));
  s.json ? print_data(problem_json(record)) : print(problem_text(record));
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
  check_fields({.fields = separated(s.fields)});
  Outputs outputs("errors");
  std::vector<std::string> inputs = {s.input};
  if (!s.against.empty()) inputs.push_back(s.against);
  outputs.expect_text("--edges", s.edges, inputs);

  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  expect_complete(command, s.problem);
  const auto expect = [&](CellKinds cells) {
    command.expect_for(cells, s.input);
    if (s.problem.given()) expect_no_fields(command);
  };
  AnyInput any = read_any(s.input, {s.projection, {}, threads.get(), s.heights, expect});
  std::visit([](const auto& input) { print_warnings(input.warnings()); }, any);
  if (s.problem.given()) {
    report_problem(command, s, std::get<Input>(any), threads.get());
  } else {
    std::visit([&](auto& input) { report_fields(s, input, outputs, threads.get()); }, any);
  }
  return Exit::done;
}

}  // namespace temper::app
