// temper optimize IN -o OUT: reads, improves, writes, reports.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "console.hpp"
#include "exit.hpp"
#include "files/input.hpp"
#include "files/options_file.hpp"
#include "files/outputs.hpp"
#include "files/size_options.hpp"
#include "files/trace_jsonl.hpp"
#include "options/options.hpp"
#include "options/ranks.hpp"
#include "options/requirement.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"
#include "temper/draw.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"
#include "temper/solvers.hpp"
#include "threads.hpp"
#include "verbs/optimize_settings.hpp"
#include "verbs/optimize_tetrahedra.hpp"
#include "verbs/progress_line.hpp"
#include "verbs/save_every.hpp"
#ifdef TEMPER_WITH_ERRORS
#include "reports/error_report.hpp"
#endif

namespace temper::app {
namespace {

/// The results of a run, apart from the mesh.
struct RunResults {
  Quality before, after;
  Mesh original;  ///< when a picture or a page needs it
  OptimizeReport report;
  std::vector<Outcome> outcomes;  ///< of --require
  bool lacks_flips = false;       ///< edges are not regular that should be
  io::DataReport data;
  std::string picture;                   ///< SVG, when asked for
  std::string errors_text, errors_json;  ///< of solvers, when asked for
  std::vector<std::string> warnings;
};

struct TraceFile {
  io::TextStream stream;
  std::size_t events = 0;
};

/// The files and observers of a run, besides its settings. Null: there is none.
struct RunFiles {
  Executor* threads = nullptr;
  TraceFile* trace = nullptr;
};

using Viewer = std::function<void(const Mesh&)>;

OptimizeReport run_library(const OptimizeSettings& s, const Input& input, Mesh& mesh, const RunFiles& files,
                           Tracer tracer, Viewer viewer, bool measures_sizes) {
  ProgressLine line(!is_quiet() && error_is_terminal());
  const Observer observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  OptimizeHooks hooks;
  hooks.executor = files.threads;
  hooks.communicator = communicator();
  hooks.names = input.names.get();
  hooks.exclusive = true;
  hooks.viewer = std::move(viewer);
  hooks.measures_sizes = measures_sizes;
  hooks.solvers = solvers();
  hooks.started = s.started;
  hooks.observer = observer;
  hooks.tracer = std::move(tracer);
  if (s.save_every) {
    hooks.best_so_far = saver(s, [&](const BestSoFar& best) {
      io::MeshFile file = input.file;
      io::update(file, input.loaded, best.mesh, best.vertices, {s.rules, files.threads});
      return save(s, file, files.threads);
    });
  }
  OptimizeOptions options = s.options;
  if (s.metric) options.tensor = s.metric->tensor();
  Expected<OptimizeReport> report = optimize(mesh, options, hooks);
  if (!report) throw as_failure(spell_options(report.error()));
  for (std::string& note : report->notes) note = spell_options(note);
  return *std::move(report);
}

#ifdef TEMPER_WITH_ERRORS
/// The results of --measure-errors.
void error_result(SolverErrors& errors, const Mesh& mesh, RunResults& results) {
  errors.measure_result(mesh);
  results.errors_text = errors.text(text_style());
  results.errors_json = errors.json();
}
#endif

/// The tracer of the trace, if there is one.
Tracer tracer_of(const OptimizeSettings& s, const RunFiles& files, const Input& input) {
  TraceFile* const trace = files.trace;
  if (trace == nullptr && s.traced) return [](const TraceEvent&) {};  // the first rank writes it
  if (trace == nullptr) return {};
  trace->stream.write(trace_header(input));
  return [trace, &input](const TraceEvent& event) {
    trace->stream.write(trace_line(event, input));
    ++trace->events;
  };
}

/// Says whether edges lack flips. Edges that may not be flipped do not count.
bool lacks_flips(const OptimizeOptions& o, const Mesh& mesh, Executor* executor) {
  return o.flips != Flips::none && o.paper.hidden != HiddenPolicy::keep &&
         count_non_regular_edges(mesh, false, executor) > 0;
}

/// Improves the mesh of the input in place: a second copy is made only when something needs one.
void improve(const OptimizeSettings& s, Input& input, RunResults& results, const RunFiles& files) {
  QualityOptions measuring;
  measuring.executor = files.threads;
  Mesh& mesh = input.loaded.mesh;
  const Mesh* seen = &mesh;
  std::optional<Mesh> there;
  const auto look_at = [&] {
    if (s.metric) seen = &there.emplace(in_metric(mesh, *s.metric, input));
  };
  look_at();
  if (!s.files.picture.empty() || !s.files.page.empty()) results.original = *seen;
  const bool shown = !s.files.report.empty() || !s.files.page.empty() || !s.files.picture.empty();
  measuring.brief = !shown && !s.details && s.requirements.empty();
  const bool measured = !is_quiet() || shown || !s.requirements.empty();  // else nobody would see it
  // The run looks at the mesh in an order for which no copy is needed. It has no names for the worst triangles.
  Viewer viewer;
  if (measured && measuring.brief && !s.metric) {
    viewer = [&, first = true](const Mesh& now) mutable {
      results.after = quality(now, measuring);
      if (std::exchange(first, false)) results.before = results.after;
    };
  } else if (measured) {
    results.before = quality(*seen, measuring);
  }
  catch_interrupts();
  on_first_rank([&] {
    print(fmt::format("{}: {}", s.input, mesh_size(mesh.n_vertices(), mesh.n_triangles())));
    print(s.set_by_target.empty() ? "\n" : fmt::format("; --for {} sets {}\n", s.target, s.set_by_target));
    flush_output();
  });
  const Tracer tracer = tracer_of(s, files, input);
#ifdef TEMPER_WITH_ERRORS
  std::optional<SolverErrors> errors;
  on_first_rank([&] {
    if (s.measure_errors) errors.emplace(*seen, files.threads);
  });
#endif
  results.report = run_library(s, input, mesh, files, tracer, viewer, !measuring.brief);
  look_at();
#ifdef TEMPER_WITH_ERRORS
  if (errors) error_result(*errors, *seen, results);
#endif
  if (files.trace != nullptr) files.trace->stream.write(trace_end(files.trace->events, mesh, input));
  if (measured && !viewer) results.after = quality(*seen, measuring);
  const bool all_regular = measured && results.after.non_regular_edges == 0;  // those that may not be flipped, too
  results.lacks_flips = !all_regular && lacks_flips(s.options, *seen, files.threads);
  results.outcomes = judge(s.requirements, results.after);
  if (!s.files.picture.empty()) results.picture = draw_before_after_svg(results.original, *seen);
}

bool has_weights(const Mesh& mesh) {
  for (const VertexId v : mesh.vertices()) {
    if (mesh.weight(v) != 0) return true;
  }
  return false;
}

VertexId find_vertex(const Input& input, std::string_view option, const std::string& number) {
  for (const VertexId v : input.mesh().vertices()) {
    if (input.vertex_number(v) == number) return v;
  }
  throw Failure(Exit::bad_usage, fmt::format("{}: {}: there is no vertex {}", input.path,
                                             spell_options(fmt::format("`{}`", option)), number));
}

/// Finds the vertices that options name, now that vertices have numbers.
void find_vertices(OptimizeSettings& s, const Input& input) {
  for (const Assignment& a : s.assignments) {
    if (a.vertex.empty()) continue;
    const bool none = a.vertex == a.row->absent_name;
    a.row->set(s.options, none ? OptionValue() : OptionValue(find_vertex(input, a.row->name, a.vertex)));
  }
}

std::string ending_of(const OptimizeReport& report) {
  std::string work = work_done(report);
  if (report.objective == Objective::solver_error && std::isfinite(report.objective_before))
    work += fmt::format("; solver error {:.3g} times the input's", report.objective_after / report.objective_before);
  return ending(report.stopped) + work;
}

void warn(RunResults& results, std::span<const std::string> warnings) {
  print_warnings(warnings);
  results.warnings.insert(results.warnings.end(), warnings.begin(), warnings.end());
}

/// Writes the mesh first, as it took the most time.
void write_all(const Command& command, const OptimizeSettings& s, Input& input, RunResults& results, Outputs& outputs,
               const RunFiles& files) {
  const std::size_t known = input.file.warnings.size();
  results.data =
      io::update(input.file, input.loaded, input.loaded.mesh, results.report.vertices, {s.rules, files.threads});
  if (s.files.page.empty()) input.loaded.mesh = {};  // the file has it, and on the largest meshes memory is scarce
  warn(results, std::span(input.file.warnings).subspan(known));
  warn(results, outputs.write_mesh(s.output, input.file, files.threads));
  if (files.trace != nullptr) outputs.commit(s.files.trace, files.trace->stream);
  if (!s.files.report.empty() || !s.files.page.empty()) {
    const OptimizeRecord record = {command_line(command, {s.input}),
                                   options_json(command, s.assignments),
                                   options_json(s.options, CellKinds::triangles),
                                   results.before,
                                   input.points,
                                   results.after,
                                   results.report,
                                   results.data,
                                   results.outcomes,
                                   results.warnings,
                                   results.errors_json};
    if (!s.files.report.empty()) outputs.write_text(s.files.report, optimize_json(record));
    if (!s.files.page.empty())
      outputs.write_text(s.files.page, optimize_html(OptimizePage{record, input, results.original, input.loaded.mesh}));
  }
  if (!s.files.history.empty()) outputs.write_text(s.files.history, history_csv(results.report.history));
  if (!s.files.picture.empty()) outputs.write_picture(s.files.picture, results.picture);
}

/// The relevant row of energies.
int star_shown(const OptimizeOptions& options) {
  return objective_of(options) != Objective::energy ? 1 : static_cast<int>(options.star);
}

/// What --details adds.
void print_details(const OptimizeSettings& s, const RunResults& results) {
  print("\n" + comparison_text(results.before, results.after, star_shown(s.options), text_style()) +
        size_text(results.report.size));
  if (const std::string data = data_text(results.data); !data.empty()) print("\n" + data);
  print(fmt::format("objective {}: {:.6g} before, {:.6g} after\n", name(results.report.objective),
                    results.report.objective_before, results.report.objective_after));
  for (const std::string& note : results.report.notes) print("note: " + note + "\n");
  print("\n");
}

void print_result(const OptimizeSettings& s, const RunResults& results, const Outputs& outputs) {
  print(brief_text(results.before, results.after));
  if (s.details) print_details(s, results);
  if (!results.errors_text.empty()) print("\n" + results.errors_text + "\n");
  const std::size_t notes = s.details ? 0 : results.report.notes.size();
  print(ending_of(results.report) +
        (notes == 0 ? "\n" : fmt::format("; --details has {}\n", plural(notes, "note", "notes"))));
  std::string written;
  for (const std::string& path : outputs.written()) written += (written.empty() ? "wrote " : ", ") + path;
  print(written + "\n");
  if (!s.metric) print(next_step(results.after, s.output.path, s.projection));
}

Exit optimize_mesh(const Command& command, OptimizeSettings& s, Outputs& outputs) {
  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  std::optional<TraceFile> trace;
  if (!s.files.trace.empty()) trace.emplace(TraceFile{outputs.open(s.files.trace), {}});
  const RunFiles files = {threads.get(), trace ? &*trace : nullptr};
  io::MeshFile file = read_tried(s.input, s.heights.to_read(threads.get()));
  if (file.dimension() == 3) return optimize_tetrahedra(command, s, outputs, {std::move(file), threads.get()});
  expect_for(command, s, CellKinds::triangles);
  s.requirements = s.requirement_lists.of(CellKinds::triangles);
  const auto read = [&](const std::string&) { return std::move(file); };
  Input input = read_input(s.input, {s.projection, s.fix, threads.get(), true, s.heights, read});
  outputs.expect_place(s.output, input.file);
  if (!s.files.page.empty()) expect_plane(input.mesh(), s.input, "--write " + s.files.page);
  RunResults results;
  warn(results, input.warnings());
  find_vertices(s, input);
  s.rules = data_rules(s.point_data, input.path, input.file.point_data);
  warn(results, doubtful_options(command, s));
  if (s.options.unknowns == Unknowns::positions && has_weights(input.mesh())) {
    warn(results,
         std::array{fmt::format("{0}: the mesh has weights, and this run keeps them. If your solver ignores weights, "
                                "set them to zero first. Next: temper weights {0} --zero -o plain.vtu",
                                s.input)});
  }
  if (!s.size.empty()) {
    ReadSizeField sizes = read_size_field(
        s.size, s.size_data, {same_projection(input, s.projection), {}, threads.get(), true, {s.heights.flat}});
    warn(results, sizes.warnings);
    s.options.size_field = std::move(sizes.field);
  }
  if (const auto depth = io::depths_of(input.file)) s.options.guard.depth = at_vertices(input, *depth);
  if (s.problem.given()) {
    s.options.problem = read_problem(command, s.problem, input);
    warn(results, problem_warnings(input.mesh(), *s.options.problem));
  }
  // The mesh has its geometry now, and on the largest meshes memory is scarce.
  io::release_geometry(input.file, input.loaded);
  agree_to_go_on();
  warn(results, warnings_of_ranks());
  improve(s, input, results, files);
  if (!is_first_rank()) return Exit::done;
  write_all(command, s, input, results, outputs, files);
  if (!is_quiet()) print_result(s, results, outputs);
  flush_output();  // before the verdict on standard error
  if (const Exit verdict = report_unmet(results.outcomes, s.output.path); verdict != Exit::done) return verdict;
  return stopped_early(results.report.stopped) || results.lacks_flips ? Exit::stopped_early : Exit::done;
}

/// The outputs that the first rank writes for all.
void leave_outputs_to_first_rank(OptimizeSettings& s) {
  s.output.path.clear();
  s.files = {};
  s.requirement_lists = {};
  s.save_every.reset();
  s.measure_errors = false;
  be_quiet();
}

/// A command that has been parsed.
Exit run_command(Command& command, OptimizeSettings& settings) {
  take_input(command, settings);
  settle_options(command, settings);
  expect_without(command, settings.metric, "--size");
  expect_without(command, settings.metric, "--dirichlet");
  expect_complete(command, settings.problem);
  if (settings.metric && !(settings.files.page.empty() && settings.files.trace.empty()))
    refuse_usage("optimize",
                 "--tensor: the page and the trace of --write are in the plane of the mesh; expected neither");
  if (settings.metric) settings.output.options.triangle_quality = false;  // which is of the plane
  settings.requirement_lists = RequirementLists("optimize", settings.require);
  settings.traced = !settings.files.trace.empty();
  if (!is_first_rank()) leave_outputs_to_first_rank(settings);

  Outputs outputs("optimize");
  if (is_first_rank()) outputs.expect_mesh(settings.output, {settings.size, settings.options_file});
  outputs.expect(settings.files, {settings.input, settings.size, settings.options_file});
  return optimize_mesh(command, settings, outputs);
}

}  // namespace

Exit run_optimize(const Arguments& arguments) {
  join_ranks();
  OptimizeSettings settings;
  Command command = optimize_command(settings);
  if (!command.parse(arguments)) return Exit::done;
  return run_command(command, settings);
}

}  // namespace temper::app
