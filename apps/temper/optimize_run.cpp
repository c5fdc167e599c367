#include "optimize_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "console.hpp"
#include "interrupt.hpp"
#include "progress_line.hpp"
#include "ranks.hpp"
#include "report_text.hpp"
#include "temper/draw.hpp"
#include "temper/lp.hpp"
#include "trace_jsonl.hpp"
#ifdef TEMPER_WITH_VERIFY
#include "solver_errors.hpp"
#endif

namespace temper::app {
namespace {

/// Writes the best mesh so far as the result will be written.
Expected<void> save(const OptimizeSettings& s, const Input& input, const RunFiles& files, const BestSoFar& best) {
  std::optional<Mesh> back;
  if (files.plain != nullptr) {
    Expected<Mesh> mesh = taken_back(s, best.mesh, *files.plain, best.vertices);
    if (!mesh) return mesh.error();
    back = *std::move(mesh);
  }
  io::MeshFile file = input.file;
  io::update(file, input.loaded, back ? *back : best.mesh, best.vertices, {s.rules, files.threads});
  io::WriteOptions options = s.output.options;
  options.executor = files.threads;
  const Expected<std::vector<std::string>> written = io::write(s.output.path, file, options);
  if (!written) return written.error();
  return {};
}

/// For --save-every. A run whose mesh cannot be written goes on, and says so once.
auto saver(const OptimizeSettings& s, const Input& input, const RunFiles& files) {
  using Clock = std::chrono::steady_clock;
  return [&, last = Clock::now(), warned = false](const auto& best) mutable {
    if (std::chrono::duration<double>(Clock::now() - last).count() < *s.save_every) return;
    best([&](const BestSoFar& mesh) {
      const Expected<void> saved = save(s, input, files, mesh);
      if (!saved && !std::exchange(warned, true)) print_warnings(std::vector{saved.error().what()});
    });
    last = Clock::now();
  };
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
  if (s.save_every) hooks.best_so_far = saver(s, input, files);
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
  if (!report) throw as_failure(spell_options(report.error()));
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

std::string picture_title(const Input& input, const Quality& before, const Quality& after) {
  return fmt::format("{}: of {} triangles {} were not well-centered, now {}", input.path, before.triangles,
                     bad_triangles(before), bad_triangles(after));
}

}  // namespace

Expected<Mesh> taken_back(const OptimizeSettings& s, const Mesh& mesh, const Mesh& plain,
                          const IdVector<VertexId, VertexId>& vertices) {
  Expected<Mesh> back = mapped_back(mesh, plain, *s.metric, vertices);
  if (back) return back;
  InputError error = back.error();
  error.where = s.input;
  return error;
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
  if (files.trace != nullptr) files.trace->stream.write(trace_end(files.trace->events, mesh, input));
  if (measured) results.after = quality(mesh, measuring);
  results.outcomes = judge(s.requirements, results.after);
  if (!s.picture.empty()) {
    DrawOptions drawing;
    drawing.title = picture_title(input, results.before, results.after);
    results.picture = draw_before_after_svg(original, mesh, drawing);
  }
}

}  // namespace temper::app
