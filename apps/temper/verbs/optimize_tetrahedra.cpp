// `temper optimize` of tetrahedra: the run of the library.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "console.hpp"
#include "reports/quality_report.hpp"
#include "temper/solvers.hpp"
#include "temper/tets/draw.hpp"
#include "verbs/optimize_run.hpp"

namespace temper::app {
namespace {

/// More trials change the connectivity or lower errors. Some runs do neither.
std::vector<std::string> warning_of_effort(const OptimizeSettings& s) {
  const OptimizeOptions& o = s.options;
  const bool keeps_connectivity = o.flips == Flips::none || o.unknowns != Unknowns::positions_and_weights;
  if (s.effort != "high" || !keeps_connectivity || o.scheme != Scheme::all) return {};
  return {
      fmt::format("--effort high has no effect with --keep {}, which allows no new connectivity. Next: leave one of "
                  "them out",
                  fmt::join(s.keep, ","))};
}

}  // namespace

void prepare(const Command& /*command*/, const OptimizeSettings& s, const TetInput& /*input*/,
             const RunFiles& /*files*/, RunResults<Tetrahedra>& results) {
  warn(results, warning_of_replaced_input(s));
  warn(results, warning_of_effort(s));
}

void improve(const OptimizeSettings& s, TetInput& input, const RunFiles& files, RunResults<Tetrahedra>& results) {
  const tets::QualityOptions measuring = {tets::QualityOptions().worst, files.threads};
  results.before = quality(input.mesh(), measuring);
  catch_interrupts();
  print(fmt::format("{}: {}\n", s.input, mesh_size(results.before)));
  flush_output();
  ProgressLine line(!is_quiet() && error_is_terminal(), Tetrahedra::elements);
  tets::OptimizeHooks hooks;
  set_hooks(hooks, line, s, input, files.threads);
  hooks.solvers = tets::solvers(s.options.scheme);
  results.second = input.mesh();
  results.improved = &results.second;
  results.original = &input.mesh();
  Expected<tets::OptimizeReport> report = optimize(results.second, s.options, hooks);
  if (!report) throw as_failure(spell_options(report.error()));
  for (std::string& note : report->notes) note = spell_options(note);
  results.report = *std::move(report);
  results.after = quality(results.second, measuring);
  results.outcomes = judge(s.requirements, results.after, criterion_of_target(s.target));
  if (!s.files.picture.empty())
    results.picture = draw_before_after_svg(input.mesh(), results.second, tets::middle_plane(input.mesh()));
}

std::string measures_text(const OptimizeSettings& /*settings*/, const RunResults<Tetrahedra>& results) {
  return comparison_text(results.before, results.after);
}

}  // namespace temper::app
