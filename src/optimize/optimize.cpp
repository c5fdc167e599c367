// optimize(): restarts, repairs, and the phase of the accuracy objective work on copies. The user gets the best mesh.
#include "temper/optimize.hpp"

#include <optional>
#include <utility>

#include "mesh/curve.hpp"
#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/flips/guard.hpp"
#include "optimize/result/report.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "optimize/solver_error/solver_error_phase.hpp"
#include "optimize/stages/driver.hpp"
#include "optimize/stages/restarts.hpp"
#include "optimize/step/ties.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {
namespace {

/// Says whether the second phase may begin at once with the input.
bool is_ready_for_accuracy(const Mesh& mesh, const Settings& s) {
  return s.objective != Objective::energy && s.options.boundary != BoundaryVertices::split &&
         has_all_for_accuracy(mesh, s);
}

/// Returns the size field of a run with a band. It can refer to the input, since the run works on copies.
std::optional<SizeField> field_of_band(const Mesh& mesh, const OptimizeOptions& options, Executor* executor) {
  if (!options.size_band) return std::nullopt;
  return options.size_field ? options.size_field : input_size_field_of(mesh, executor);
}

/// Runs one more phase. If a model of errors says that the mesh is worse, the phase is undone.
template <class Improving>
void improve(Candidate& best, const Settings& settings, Run& run, AccuracySizes& sizes) {
  if (run.stopped_early() || run.report.stopped == Stopped::hidden) return;
  std::optional<Candidate> before;
  if (settings.errors != nullptr) before = best;
  Improving phase(best.work, settings, run, sizes.lend(best.work, settings.executor()));
  Driver driver(best.work, phase.settings(), phase.state(), run);
  best.sweep = driver.run(phase, best.sweep);
  sizes.take_back(phase.take_sizes(), best.work, settings.executor());
  if (!before) return;
  const auto score_of = [&](const Candidate& c) {
    const VertexSizes own = sizes.of(c.work, settings.executor());
    return score(c.work.mesh, settings, settings.model, &own, c.work.units);
  };
  if (replaces(score_of(best), score_of(*before), Requirement::not_worse)) return;
  best = *std::move(before);
  driver.recorder().returned_to(best.sweep);
}

/// Makes one attempt: restarts, repairs, and the phases for accuracy.
Expected<Candidate> attempt(InputMesh& input, const Settings& settings, SweepState& state, Run& run,
                            std::optional<AccuracySizes>& sizes) {
  const Mesh& mesh = input.restore_twins();
  auto found = is_ready_for_accuracy(mesh, settings)
                   ? Candidate{WorkingCopy(mesh, settings.policy.order, settings.executor())}
                   : best_restart(input, settings, state, run);
  if (!found) return found;
  Candidate best = *std::move(found);
  // A tensor can make all triangles thin. Then sweeps pull vertices together, and repairs take long and cure little.
  run.facts.gave_up =
      settings.in_metric && 2 * count_bad(best.work.mesh, settings.executor()) > best.work.mesh.n_triangles();
  if (run.facts.gave_up) {
    return Candidate{WorkingCopy(input.restore_twins(), settings.policy.order, settings.executor())};
  }
  input.drop_twins();
  best = reweighted(std::move(best), input, settings, state, run);
  best = repaired(std::move(best), settings, state, run);
  if (sizes) improve<AccuracyPhase>(best, settings, run, *sizes);
  if (settings.objective == Objective::solver_error) improve<SolverErrorPhase>(best, settings, run, *sizes);
  return best;
}

/// Returns the mesh of the run, or a rival on which measured errors are smaller. On structured grids errors of
/// neighbors cancel, which vertices that move end. The rivals are a sound input, and a grid whose ties get small
/// weights.
Candidate least_error(Candidate best, const Mesh& input, const Settings& settings, SweepState state, Run& run) {
  // With the least, errors change by a percent or two. Trapezoids of rings need more.
  constexpr double kTieWeights[] = {0.01, 0.04, 0.16};
  constexpr double kTiedPart = 0.1;  // least part of the vertices at ties in a grid
  Settings by_weights = settings;
  by_weights.options.unknowns = Unknowns::weights;
  if (run.stopped_early() || !is_judged_by_errors(input, settings)) return best;
  const auto ties = static_cast<double>(heavier_ends_of_ties(input, by_weights.options).size());
  const bool sound = is_sound(input, settings), tied = ties >= kTiedPart * static_cast<double>(input.n_vertices());
  if (!sound && !tied) return best;
  double ratio = largest_error_ratio(best.work.mesh, input, settings);
  if (ratio > 1 && tied && !sound) {
    for (const double amount : kTieWeights) {
      const std::size_t sweeps = run.report.history.size();
      Candidate now{WorkingCopy(input, settings.policy.order, settings.executor())};
      Driver driver(now.work, by_weights, state, run);
      driver.recorder().returned_to(-1);
      const bool good = driver.make_regular() && driver.reweight_ties(amount);
      now.sweep = run.report.sweeps;
      const double of_weights = good ? largest_error_ratio(now.work.mesh, input, settings) : ratio;
      if (of_weights < ratio) {
        ratio = of_weights;
        best = std::move(now);
      } else {
        driver.recorder().returned_to(best.sweep);
        run.report.history.resize(sweeps);  // its last record is of the returned mesh
      }
      if (good) break;
    }
  }
  run.facts.keeps_input = ratio > 1 && sound;
  if (ratio > 1) run.facts.error_ratio = ratio;
  return best;
}

/// Runs in the plane of the mesh.
Expected<OptimizeReport> optimize_here(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks,
                                       bool in_metric = false) {
  if (auto error = expect_agreement(hooks, options, mesh)) return *std::move(error);
  Run run(options, hooks, mesh);
  auto made = make_settings(options, mesh, WorkingUnits::of(mesh), hooks);
  if (!made) return made.error();
  made->size_field = field_of_band(mesh, options, hooks.executor);
  Settings settings = *std::move(made);
  auto guard = guard_limits(mesh, options, hooks.executor);
  if (!guard) return guard.error();
  settings.guard = *std::move(guard);
  settings.in_metric = in_metric;
  SweepState state(settings);

  std::optional<AccuracySizes> sizes;
  const InputMeasures of_input(mesh, settings, sizes);
  InputMesh input(mesh, hooks.exclusive && !options.size_band, hooks.executor);  // the band's field may refer to it
  auto found = attempt(input, settings, state, run, sizes);
  if (!found) return found.error();
  Candidate best = *std::move(found);
  best = least_error(std::move(best), input.restore_twins(), settings, state, run);
  give_back(input.restore_twins(), std::move(best), settings, state, of_input, std::move(sizes), run);
  return std::move(run.report);
}

/// Refuses options that only a mesh in its own plane can have.
std::optional<InputError> check_metric(const OptimizeOptions& options, const OptimizeHooks& hooks) {
  const auto refused = [](const char* what) {
    return InputError{ErrorCode::invalid_option, {}, std::string("a tensor cannot go with ") + what};
  };
  if (options.size_field) return refused("`size_field`: sizes are lengths of the plane of the mesh");
  if (options.problem) return refused("a problem, whose coefficients are numbers");
  if (hooks.tracer) return refused("a trace: its events would be in the plane of the metric");
  return std::nullopt;
}

/// Runs in the plane of the tensor's metric, and maps back.
Expected<OptimizeReport> optimize_in_metric(Mesh& mesh, const OptimizeOptions& options, OptimizeHooks hooks) {
  if (auto error = check_metric(options, hooks)) return *std::move(error);
  const Expected<Metric> metric = Metric::of(*options.tensor);
  if (!metric) return metric.error();
  Expected<Mesh> there = hooks.names != nullptr ? mapped(mesh, *metric, *hooks.names) : mapped(mesh, *metric);
  if (!there) return there.error();
  if (hooks.best_so_far) {
    hooks.best_so_far = [&, listener = hooks.best_so_far](const auto& best) {
      listener([&](const auto& use) {
        best([&](const BestSoFar& found) {
          if (auto back = mapped_back(found.mesh, mesh, *metric, found.vertices)) use({*back, found.vertices});
        });
      });
    };
  }
  OptimizeOptions there_options = options;
  there_options.tensor.reset();
  there_options.guard.depth.clear();  // waves do not know that plane
  Expected<OptimizeReport> report = optimize_here(*there, there_options, hooks, true);
  if (!report) return report;
  Expected<Mesh> back = mapped_back(*there, mesh, *metric, report->vertices);
  if (!back) return back.error();
  mesh = *std::move(back);
  return report;
}

}  // namespace

Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  return options.tensor ? optimize_in_metric(mesh, options, hooks) : optimize_here(mesh, options, hooks);
}

}  // namespace temper
