#include "optimize_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "console.hpp"
#include "interrupt.hpp"
#include "progress_line.hpp"
#include "ranks.hpp"
#include "read_tried.hpp"
#include "report_text.hpp"
#include "temper/draw.hpp"
#include "temper/lp.hpp"
#include "trace_jsonl.hpp"
#ifdef TEMPER_WITH_VERIFY
#include "solver_errors.hpp"
#endif

namespace temper::app {
namespace {

/// A run whose checkpoints cannot be written goes on.
void keep(io::CheckpointFile& file, const std::function<std::string()>& state) {
  if (const Expected<void> kept = file.keep(state); !kept) print_warnings(std::vector{kept.error().what()});
}

OptimizeReport run_library(const OptimizeSettings& s, const Input& input, Mesh& mesh, const RunFiles& files,
                           Tracer tracer) {
  ProgressLine line(!s.quiet && error_is_terminal());
  const Observer observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  OptimizeHooks hooks;
  hooks.executor = files.threads;
  hooks.ranks = joined_ranks();
  hooks.names = input.names.get();
  hooks.exclusive = true;
  const std::unique_ptr<LpSolver> lp = clp_solver();
  hooks.lp = lp.get();
  hooks.observer = observer;
  hooks.tracer = std::move(tracer);
  if (files.checkpoint != nullptr) hooks.checkpoints = [&](const auto& state) { keep(*files.checkpoint, state); };
  if (files.resumed != nullptr) hooks.resume = files.resumed->checkpoint.state;
  OptimizeOptions options = s.options();
  options.time_limit = s.since.left(options.time_limit);
#ifdef TEMPER_WITH_VERIFY
  if (wants_error_model(options, mesh)) {
    auto model = solver_error_model(mesh, {.scheme = options.for_});
    if (!model) throw as_failure(spell_options(model.error()));
    options.error.model = *std::move(model);
  }
#endif
  Expected<OptimizeReport> report = optimize(mesh, options, hooks);
  if (!report) {
    InputError error = spell_options(report.error());
    if (files.resumed != nullptr && error.where.empty()) error.where = files.resumed->path;
    throw as_failure(error);
  }
  for (std::string& note : report->notes) note = spell_options(note);
  return *std::move(report);
}

#ifdef TEMPER_WITH_VERIFY
/// The input instead of the result, which leaves solvers with larger errors.
void return_input(Mesh& mesh, const Mesh& original, double ratio, OptimizeReport& report, const Tracer& tracer) {
  if (tracer) {
    TraceEvent back;
    back.kind = EventKind::undo;
    back.sweep = report.sweeps;
    back.to_sweep = -1;
    tracer(back);
  }
  mesh = original;
  report.vertices = {};
  report.vertices_removed = report.vertices_inserted = report.flips = 0;
  report.hidden = {};
  report.size.after = report.size.before;
  report.final_energy = report.initial_energy;
  report.notes.push_back(fmt::format(
      "the input was well-centered, and errors of solvers would be {:.3g} times its own in the mean: it is returned as "
      "it was",
      ratio));
}

/// What --verify asks for.
void verify_result(const OptimizeSettings& s, SolverErrors& errors, Mesh& mesh, const Mesh& original,
                   RunResults& results, const Tracer& tracer) {
  errors.measure_result(mesh);
  if (s.for_accuracy() && errors.input_was_better()) {
    return_input(mesh, original, errors.mean_ratio(), results.report, tracer);
    errors.measure_result(mesh);
  }
  results.errors_text = errors.text(text_style());
  results.errors_json = errors.json();
}
#endif

/// The tracer of the trace, if there is one. The beginning of a resumed one is written before.
Tracer tracer_of(const OptimizeSettings& s, const RunFiles& files, const Input& input) {
  TraceFile* const trace = files.trace;
  if (trace == nullptr && s.traced) return [](const TraceEvent&) {};  // the first rank writes it
  if (trace == nullptr) return {};
  const bool begun = files.resumed != nullptr && !files.resumed->checkpoint.trace.empty();
  trace->write(begun ? files.resumed->checkpoint.trace : trace_header(input));
  if (begun) trace->place.events = files.resumed->checkpoint.events;
  return [trace, &input](const TraceEvent& event) {
    trace->write(trace_line(event, input));
    ++trace->place.events;
  };
}

std::string picture_title(const Input& input, const Quality& before, const Quality& after) {
  return fmt::format("{}: of {} triangles {} were not well-centered, now {}", input.path, before.triangles,
                     bad_triangles(before), bad_triangles(after));
}

}  // namespace

io::MeshFile read_file(const RunFiles& files, const std::string& path) {
  io::MeshFile file;
  if (files.resumed != nullptr) {
    const std::vector<io::MeshFile>& inputs = files.resumed->checkpoint.inputs;
    const auto found = std::find_if(inputs.begin(), inputs.end(), [&](const auto& each) { return each.path == path; });
    if (found == inputs.end()) throw Failure(Exit::bad_input, files.resumed->path + ": does not have " + path);
    file = *found;
  } else {
    file = read_tried(path, files.threads);
  }
  if (files.checkpoint != nullptr) files.checkpoint->add_input(file);
  return file;
}

void improve(const OptimizeSettings& s, Input& input, RunResults& results, const RunFiles& files) {
  QualityOptions measuring;
  measuring.executor = files.threads;
  Mesh& mesh = input.loaded.mesh;
  const bool may_return_input = s.verify && s.for_accuracy();
  const Mesh& original = results.original;
  if (!s.picture.empty() || !s.html.empty() || may_return_input) results.original = mesh;
  const bool shown = !s.report.empty() || !s.html.empty() || !s.picture.empty();
  const bool measured = !s.quiet || shown || !s.requirements.empty();  // else nobody would see it
  if (measured) results.before = quality(mesh, measuring);
  catch_interrupts();
  alone([&] {
    if (s.quiet) return;
    print(fmt::format("{}: {} vertices, {} triangles\n", s.input, results.before.vertices, results.before.triangles));
    flush_output();
  });
  const Tracer tracer = tracer_of(s, files, input);
#ifdef TEMPER_WITH_VERIFY
  std::optional<SolverErrors> errors;
  alone([&] {
    if (s.verify) errors.emplace(mesh, files.threads);
  });
  results.report = run_library(s, input, mesh, files, tracer);
  if (errors) verify_result(s, *errors, mesh, original, results, tracer);
#else
  results.report = run_library(s, input, mesh, files, tracer);
#endif
  if (files.trace != nullptr) files.trace->write(trace_end(files.trace->place.events, mesh, input));
  if (measured) results.after = quality(mesh, measuring);
  results.outcomes = judge(s.requirements, results.after);
  if (!s.picture.empty()) {
    DrawOptions drawing;
    drawing.title = picture_title(input, results.before, results.after);
    results.picture = draw_before_after_svg(original, mesh, drawing);
  }
}

}  // namespace temper::app
