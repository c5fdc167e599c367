// `temper optimize` of curved surfaces: the run of the library.
#include <fmt/format.h>

#include "console.hpp"
#include "reports/quality_report.hpp"
#include "temper/detail/lp.hpp"
#include "temper/solvers.hpp"
#include "verbs/optimize_run.hpp"

namespace temper::app {

void prepare(const Command& /*command*/, const OptimizeSettings& s, const SurfaceInput& /*input*/,
             const RunFiles& /*files*/, RunResults<Surfaces>& results) {
  warn(results, warning_of_replaced_input(s));
}

void improve(const OptimizeSettings& s, SurfaceInput& input, const RunFiles& files, RunResults<Surfaces>& results) {
  Expected<surfaces::SurfaceOptions> options = surfaces::surface_options(s.options);
  if (!options) throw as_failure(spell_options(options.error()));
  catch_interrupts();
  print(fmt::format("{}: {}\n", s.input, mesh_size(input.mesh())));
  flush_output();
  ProgressLine line(!is_quiet() && error_is_terminal(), Surfaces::elements);
  options->started = s.started;
  options->squared_errors = surfaces::squared_errors();
  options->must_stop = [] { return interrupted(); };
  options->observer = [&line](const Progress& progress) {
    line.show(progress);
    return Continue::yes;
  };
  if (s.save_every) options->best_so_far = saver_of_best(s, input, files.threads);
  results.second = input.mesh();
  results.improved = &results.second;
  results.original = &input.mesh();
  Expected<surfaces::SurfaceReport> report = optimize(results.second, *clp_solver(), *options);
  if (!report) throw as_failure(spell_options(report.error()));
  results.report = *std::move(report);
  results.before = results.report.before;
  results.after = results.report.after;
  add_errors(s, input.mesh(), results.second, files.threads, results);
  results.outcomes = judge(s.requirements, results.after, criterion_of_target(s.target));
}

}  // namespace temper::app
