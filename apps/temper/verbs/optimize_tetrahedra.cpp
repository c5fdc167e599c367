// `temper optimize` of tetrahedra: the run of the library.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <vector>

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

/// The options of the run, with tensors.
OptimizeOptions options_of(const OptimizeSettings& s, const TetInput& input, const std::vector<Tensor3>& tensors) {
  OptimizeOptions options = s.options;
  options.tetrahedra_tensors = tensors;
  if (s.tensor.may_differ()) options.corner_weights = io::corner_weights_of(input.file, input.loaded);
  return options;
}

/// A mesh as its measures see it: itself, or in the metrics of tensors.
class Seen {
 public:
  /// `tensors`: of all tetrahedra, or one for all.
  Seen(const tets::TetMesh& mesh, const std::vector<Tensor3>& tensors, const std::vector<double>& corner_weights,
       const TetInput& input)
      : mesh_(mesh) {
    if (!tensors.empty()) there_.emplace(in_metric(mesh, tensors, corner_weights, input));
  }
  [[nodiscard]] const tets::TetMesh& mesh() const { return there_ ? there_->mesh : mesh_; }

 private:
  const tets::TetMesh& mesh_;
  std::optional<tets::MetricMesh> there_;
};

}  // namespace

void prepare(const Command& /*command*/, const OptimizeSettings& s, const TetInput& /*input*/,
             const RunFiles& /*files*/, RunResults<Tetrahedra>& results) {
  warn(results, warning_of_replaced_input(s));
  warn(results, warning_of_effort(s));
}

void improve(const OptimizeSettings& s, TetInput& input, const RunFiles& files, RunResults<Tetrahedra>& results) {
  const tets::QualityOptions measuring = {tets::QualityOptions().worst, files.threads};
  warn_without(s.tensor, input);
  std::vector<Tensor3> tensors = tensors_of(s.tensor, input);
  const OptimizeOptions options = options_of(s, input, tensors);
  const Seen before(input.mesh(), tensors, options.corner_weights, input);
  results.before = quality(before.mesh(), measuring);
  catch_interrupts();
  const std::string size = s.tensor.given() ? mesh_size(input.mesh()) : mesh_size(results.before);
  print(fmt::format("{}: {}\n", s.input, size));
  flush_output();
  ProgressLine line(!is_quiet() && error_is_terminal(), Tetrahedra::elements);
  tets::OptimizeHooks hooks;
  set_hooks(hooks, line, s, input, files.threads);
  hooks.solvers = tets::solvers(s.options.scheme);
  results.second = input.mesh();
  results.improved = &results.second;
  results.original = &input.mesh();
  Expected<tets::OptimizeReport> report = optimize(results.second, options, hooks);
  if (!report) throw as_failure(spell_options(report.error()));
  for (std::string& note : report->notes) note = spell_options(note);
  results.report = *std::move(report);
  tensors.resize(std::min<std::size_t>(tensors.size(), 1));  // all have it if the report has none
  const tets::OptimizeReport& made = results.report;
  const Seen after(results.second, made.tetrahedra_tensors.empty() ? tensors : made.tetrahedra_tensors,
                   made.corner_weights, input);
  results.after = quality(after.mesh(), measuring);
  add_errors(s, before.mesh(), after.mesh(), files.threads, results);
  results.outcomes = judge(s.requirements, results.after, criterion_of_target(s.target));
  if (!s.files.picture.empty())
    results.picture = draw_before_after_svg(before.mesh(), after.mesh(), tets::middle_plane(before.mesh()));
}

}  // namespace temper::app
