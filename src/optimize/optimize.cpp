// optimize(): attempts, repairs, and the phase of the accuracy objective, all on copies; the best mesh is given back.
#include "temper/optimize.hpp"

#include <optional>
#include <utility>

#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/agreement.hpp"
#include "optimize/attempts.hpp"
#include "optimize/driver.hpp"
#include "optimize/error/error_phase.hpp"
#include "optimize/input_mesh.hpp"
#include "optimize/lengths.hpp"
#include "optimize/rank.hpp"
#include "optimize/report.hpp"

namespace temper {
namespace {

/// The stage of a run: attempts from the input, such with weights alone, repairs of the best of them, the second
/// objective, the third.
enum class Stage { attempts, weights, repairs, accuracy, error };

/// Says whether the second phase may begin at once with the input.
bool is_ready_for_accuracy(const Mesh& mesh, const Settings& s) {
  return s.options.objective != Objective::energy && s.options.boundary != BoundaryVertices::split &&
         has_margins(mesh, s.accuracy.margin, s.hooks.executor) &&
         missing_lengths(mesh, s.accuracy, s.hooks.executor) == 0;
}

/// The size field of a run with a band; the input's own is seen where it is, since the run works on copies.
std::optional<SizeField> field_of_band(const Mesh& mesh, const OptimizeOptions& options, Executor* executor) {
  if (!options.size_band) return std::nullopt;
  return options.size_field ? options.size_field : input_size_field_of(mesh, executor);
}

/// The measures of the input, and for objectives other than an energy its sizes.
InputMeasures measured(const Mesh& mesh, const Settings& s, std::optional<AccuracySizes>& sizes) {
  const NearbyCopy near(mesh, s.hooks.executor);
  InputMeasures measures = measure_input(mesh, near, s);
  if (s.options.objective != Objective::energy) {
    sizes.emplace(near, s.options.size_field, s.hooks.executor);
    measures.rank = rank_input(near, measures.counts, s, *sizes);
  }
  return measures;
}

/// One phase more. Where there is a model of errors it says whether that was for the better; if not, it is taken back.
template <class Improving>
void improve(Candidate& best, const Settings& settings, Run& run, AccuracySizes& sizes) {
  if (run.stopped_early() || run.report.stopped == Stopped::hidden) return;
  const bool judges = settings.options.error.model != nullptr;
  std::optional<Candidate> before;
  if (judges && !run.checkpoints.resumes()) before = best;
  const Resumable here(run.checkpoints, before);
  Improving phase(best.work, settings, run, sizes.lend(best.work, settings.hooks.executor));
  Driver driver(best.work, phase.settings(), run);
  best.sweep = driver.run(phase, best.sweep);
  if (run.checkpoints.resumes()) return;  // the state that is resumed does not fit
  sizes.take_back(phase.take_sizes(), best.work, settings.hooks.executor);
  if (!before) return;
  const auto rank_of = [&](const Candidate& c) {
    const VertexSizes own = sizes.of(c.work, settings.hooks.executor);
    return rank(c.work.mesh, settings, &own);
  };
  if (!(rank_of(*before) < rank_of(best))) return;
  best = *std::move(before);
  driver.recorder().returned_to(best.sweep);
}

}  // namespace

Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  if (auto error = expect_agreement(hooks, options, mesh)) return *std::move(error);
  Run run(options, hooks.observer, hooks.communicator);
  auto settings = make_settings(options, mesh, Frame::of(mesh), hooks);
  if (!settings) return settings.error();
  settings->size_field = field_of_band(mesh, options, hooks.executor);

  auto checkpoints = Checkpoints::of(hooks, options, mesh);
  if (!checkpoints) return checkpoints.error();
  run.checkpoints = *std::move(checkpoints);

  auto stage = Stage::attempts;
  Candidate best;
  const Resumable here(run.checkpoints, run, *settings, stage, best);
  if (run.checkpoints.failed()) return *run.checkpoints.error();
  std::optional<AccuracySizes> sizes;
  const InputMeasures of_input = measured(mesh, *settings, sizes);
  InputMesh input(mesh, hooks.exclusive && !options.size_band, hooks.executor);  // the band's field may look at it
  if (stage == Stage::attempts) {
    auto found = is_ready_for_accuracy(mesh, *settings)
                     ? Candidate{WorkingCopy(mesh, options.paper.order, hooks.executor)}
                     : best_attempt(input, *settings, run);
    if (!found) return found.error();
    best = *std::move(found);
    stage = Stage::weights;
  }
  input.fold();
  if (stage == Stage::weights) {
    best = weighed(std::move(best), input, *settings, run);
    stage = Stage::repairs;
  }
  if (stage == Stage::repairs) {
    best = repaired(std::move(best), *settings, run);
    stage = Stage::accuracy;
  }
  if (sizes) {
    if (stage == Stage::accuracy) {
      improve<AccuracyPhase>(best, *settings, run, *sizes);
      stage = Stage::error;
    }
    if (settings->options.objective == Objective::error) improve<ErrorPhase>(best, *settings, run, *sizes);
  }
  if (auto error = run.checkpoints.error()) return *std::move(error);
  give_back(input.whole(), std::move(best), *std::move(settings), of_input, std::move(sizes), run);
  return std::move(run.report);
}

}  // namespace temper
