// The parts of `temper optimize` that differ between kinds of cells. cmd_optimize.cpp has the sequence.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "console.hpp"
#include "files/input.hpp"
#include "reports/quality_report.hpp"
#include "system/system.hpp"
#ifdef TEMPER_WITH_ERRORS
#include "reports/error_report.hpp"
#endif
#include "verbs/optimize_settings.hpp"
#include "verbs/progress_line.hpp"
#include "verbs/save_every.hpp"

namespace temper::app {

/// The results of a run.
template <class Subject>
struct RunResults {
  typename Subject::Quality before, after;
  typename Subject::Mesh second;  ///< the input if it is improved in place and something shows it; else the result
  const typename Subject::Mesh *original = nullptr,
                               *improved = nullptr;  ///< each is `second`, or the mesh of the input
  typename Subject::OptimizeReport report;
  std::vector<Outcome> outcomes;  ///< of --require
  bool lacks_flips = false;       ///< edges are not regular that should be
  io::DataReport data;
  std::string picture;                   ///< SVG, when asked for
  std::string errors_text, errors_json;  ///< of solvers, when asked for
  std::vector<std::string> warnings;
};

template <class Subject>
void warn(RunResults<Subject>& results, std::span<const std::string> warnings) {
  print_warnings(warnings);
  results.warnings.insert(results.warnings.end(), warnings.begin(), warnings.end());
}

/// Adds the errors of solvers before and after a run, for --measure-errors. An interrupt or a time limit that ended the
/// run leaves no time for them.
template <class Subject>
void add_errors([[maybe_unused]] const OptimizeSettings& s, [[maybe_unused]] const typename Subject::Mesh& before,
                [[maybe_unused]] const typename Subject::Mesh& after, [[maybe_unused]] Executor* threads,
                [[maybe_unused]] RunResults<Subject>& results) {
#ifdef TEMPER_WITH_ERRORS
  if (!s.measure_errors) return;
  std::optional<SolverErrors<Subject>> errors;
  const bool is_early = stopped_early(results.report.stopped);
  if (!is_early && !interrupted()) errors.emplace(before, threads);
  if (is_early || interrupted()) {
    const std::string text = is_early ? "a time limit or a signal ended the run, so nothing was measured"
                                      : "a signal came after the run, so nothing was measured; the mesh is complete";
    return warn(results, std::vector{"--measure-errors: " + text + ". Next: " +
                                     fmt::format("temper errors {} --against {}", s.output.path, s.input)});
  }
  errors->measure_result(after);
  results.errors_text = errors->text(text_style());
  results.errors_json = errors->json();
#endif
}

struct TraceFile {
  io::TextStream stream;
  std::size_t events = 0;
};

/// The files and observers of a run, besides its settings. Null: there is none.
struct RunFiles {
  Executor* threads = nullptr;
  TraceFile* trace = nullptr;
};

/// Finds in the mesh what the settings name, and warns of settings without effect.
void prepare(const Command& command, OptimizeSettings& settings, const Input& input, const RunFiles& files,
             RunResults<Triangles>& results);
void prepare(const Command& command, const OptimizeSettings& settings, const TetInput& input, const RunFiles& files,
             RunResults<Tetrahedra>& results);
void prepare(const Command& command, const OptimizeSettings& settings, const SurfaceInput& input, const RunFiles& files,
             RunResults<Surfaces>& results);

/// Improves and measures. Triangles are improved in place, because memory is scarce on the largest meshes.
void improve(const OptimizeSettings& settings, Input& input, const RunFiles& files, RunResults<Triangles>& results);
void improve(const OptimizeSettings& settings, TetInput& input, const RunFiles& files, RunResults<Tetrahedra>& results);
void improve(const OptimizeSettings& settings, SurfaceInput& input, const RunFiles& files,
             RunResults<Surfaces>& results);

/// Frees a mesh that the file has, unless something shows it.
inline void release_mesh(Input& input, RunResults<Triangles>& /*results*/) { input.loaded.mesh = {}; }
template <class Subject>
void release_mesh(InputOf<Subject>& input, RunResults<Subject>& results) {
  input.loaded.mesh = {};
  results.second = {};
}

/// The parts of the result in the input.
[[nodiscard]] inline const auto& parts_of(const OptimizeReport& report) { return report.vertices; }
[[nodiscard]] inline const auto& parts_of(const BestSoFar& best) { return best.vertices; }
[[nodiscard]] inline const auto& parts_of(const surfaces::SurfaceReport& report) { return report.vertices; }
[[nodiscard]] inline const auto& parts_of(const surfaces::BestSoFar& best) { return best.vertices; }
[[nodiscard]] inline const auto& parts_of(const tets::OptimizeReport& report) { return report.origins; }
[[nodiscard]] inline const auto& parts_of(const tets::BestSoFar& best) { return best.origins; }

/// Weights for each vertex and region go into the file.
template <class Report>
void add_corner_weights(const Report& report, io::MeshFile& file) {
  if constexpr (requires { report.corner_weights; }) io::set_corner_weights(file, report.corner_weights);
}

/// The objective that the run lowered at last.
[[nodiscard]] inline Objective last_objective(const OptimizeReport& report) { return report.objective; }
[[nodiscard]] inline Objective last_objective(const RunReport& /*report*/) { return Objective::energy; }

/// The measures of the mesh that --details adds.
[[nodiscard]] std::string measures_text(const OptimizeSettings& settings, const RunResults<Triangles>& results);
template <class Subject>
[[nodiscard]] std::string measures_text(const OptimizeSettings& /*settings*/, const RunResults<Subject>& results) {
  return comparison_text(results.before, results.after);
}

/// The listener of a run that saves its best mesh.
template <class Subject>
auto saver_of_best(const OptimizeSettings& s, const InputOf<Subject>& input, Executor* threads) {
  return saver(s, [&s, &input, threads](const auto& best) {
    io::MeshFile file = input.file;
    io::update(file, input.loaded, best.mesh, parts_of(best), with_threads(s.data, threads));
    return save(s, file, threads);
  });
}

/// The hooks that all runs have. `line` shows the progress.
template <class Hooks, class Subject>
void set_hooks(Hooks& hooks, ProgressLine& line, const OptimizeSettings& s, const InputOf<Subject>& input,
               Executor* threads) {
  hooks.executor = threads;
  hooks.started = s.started;
  hooks.observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  if (s.save_every) hooks.best_so_far = saver_of_best(s, input, threads);
}

}  // namespace temper::app
