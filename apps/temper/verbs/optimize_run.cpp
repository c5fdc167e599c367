#include "verbs/optimize_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "console.hpp"
#include "files/trace_jsonl.hpp"
#include "interrupt.hpp"
#include "options/ranks.hpp"
#include "reports/quality_report.hpp"
#include "temper/draw.hpp"
#include "temper/solvers.hpp"
#include "verbs/progress_line.hpp"
#ifdef TEMPER_WITH_VERIFY
#include "reports/verify_report.hpp"
#endif

namespace temper::app {
namespace {

/// Writes the best mesh so far as the result will be written.
Expected<void> save(const OptimizeSettings& s, const Input& input, const RunFiles& files, const BestSoFar& best) {
  io::MeshFile file = input.file;
  io::update(file, input.loaded, best.mesh, best.vertices, {s.rules, files.threads});
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
  hooks.communicator = communicator();
  hooks.names = input.names.get();
  hooks.exclusive = true;
  hooks.solvers = solvers();
  hooks.started = s.started;
  hooks.observer = observer;
  hooks.tracer = std::move(tracer);
  if (s.save_every) hooks.best_so_far = saver(s, input, files);
  OptimizeOptions options = s.options();
  if (s.metric) options.tensor = s.metric->tensor();
  Expected<OptimizeReport> report = optimize(mesh, options, hooks);
  if (!report) throw as_failure(spell_options(report.error()));
  for (std::string& note : report->notes) note = spell_options(note);
  return *std::move(report);
}

#ifdef TEMPER_WITH_VERIFY
/// What --verify asks for.
void verify_result(SolverErrors& errors, const Mesh& mesh, RunResults& results) {
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

/// Says whether edges are not regular that should be: `after` counts those that may not be flipped, too.
bool lacks_flips(const OptimizeSettings& s, const Quality& after, const Mesh& mesh, Executor* executor) {
  const OptimizeOptions& o = s.options();
  return after.non_regular_edges > 0 && o.flips != Flips::none && o.paper.hidden != HiddenPolicy::keep &&
         count_non_regular_edges(mesh, false, executor) > 0;
}

std::string picture_title(const Input& input, const Quality& before, const Quality& after) {
  return fmt::format("{}: of {} triangles {} were not well-centered, now {}", input.path, before.triangles,
                     bad_triangles(before), bad_triangles(after));
}

}  // namespace

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
  if (!s.picture.empty() || !s.html.empty()) results.original = *seen;
  const bool shown = !s.report.empty() || !s.html.empty() || !s.picture.empty();
  const bool measured = !s.quiet || shown || !s.requirements.empty();  // else nobody would see it
  if (measured) results.before = quality(*seen, measuring);
  catch_interrupts();
  on_first_rank([&] {
    if (s.quiet) return;
    print(fmt::format("{}: {} vertices, {} triangles\n", s.input, results.before.vertices, results.before.triangles));
    flush_output();
  });
  const Tracer tracer = tracer_of(s, files, input);
#ifdef TEMPER_WITH_VERIFY
  std::optional<SolverErrors> errors;
  on_first_rank([&] {
    if (s.verify) errors.emplace(*seen, files.threads);
  });
  results.report = run_library(s, input, mesh, files, tracer);
  look_at();
  if (errors) verify_result(*errors, *seen, results);
#else
  results.report = run_library(s, input, mesh, files, tracer);
  look_at();
#endif
  if (files.trace != nullptr) files.trace->stream.write(trace_end(files.trace->events, mesh, input));
  if (measured) results.after = quality(*seen, measuring);
  results.lacks_flips = lacks_flips(s, results.after, *seen, files.threads);
  results.outcomes = judge(s.requirements, results.after);
  if (!s.picture.empty()) {
    DrawOptions drawing;
    drawing.title = picture_title(input, results.before, results.after);
    results.picture = draw_before_after_svg(results.original, *seen, drawing);
  }
}

}  // namespace temper::app
