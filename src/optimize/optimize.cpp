// optimize(): restarts, repairs, and the phase of the accuracy objective work on copies. The user gets the best mesh.
#include "temper/optimize.hpp"

#include <cmath>
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
#include "optimize/tensors.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {
namespace {

/// Says whether the second phase may begin at once with the input.
bool is_ready_for_accuracy(const Mesh& mesh, const Settings& s) {
  return s.objective != Objective::energy && !s.options.coarsen && s.options.boundary != BoundaryVertices::split &&
         has_all_for_accuracy(mesh, s);
}

/// Returns the size field of a run with a band, or with a limit of coarsening. It can refer to the input, since the run
/// works on copies.
std::optional<SizeField> field_of_band(const Mesh& mesh, const OptimizeOptions& options, Executor* executor) {
  if (!options.size_band && !options.coarsen) return std::nullopt;
  return options.size_field ? options.size_field : input_size_field_of(mesh, executor);
}

/// Runs one more phase. Returns the least measure of its meshes.
template <class Improving>
double improve(Candidate& best, const Settings& settings, Run& run, AccuracySizes& sizes) {
  if (run.stopped_early() || run.report.stopped == Stopped::hidden) return kInfinity;
  Improving phase(best.work, settings, run, sizes.lend(best.work, settings.executor()));
  Driver driver(best.work, phase.settings(), phase.state(), run);
  best.sweep = driver.run(phase, best.sweep);
  sizes.take_back(phase.take_sizes());
  return driver.least_measure();
}

/// Runs the phases for accuracy. If a model of errors says that the mesh is worse, they are undone.
void improve_accuracy(Candidate& best, const Settings& settings, SweepState& state, Run& run, AccuracySizes& sizes) {
  std::optional<Candidate> before;
  if (settings.errors != nullptr) before = best;
  improve<AccuracyPhase>(best, settings, run, sizes);
  if (settings.objective == Objective::solver_error) {
    const double error = improve<SolverErrorPhase>(best, settings, run, sizes);
    if (std::isfinite(error)) best.error = error;
  }
  if (!before || before->sweep == best.sweep) return;
  const auto score_of = [&](const Candidate& c) {
    const MeshScore counts = count(c.work.mesh, settings, c.work.units);
    if (c.error) return score(c.work.mesh, counts, settings, *c.error);
    const VertexSizes own = sizes.of(c.work, settings.executor());
    return score(c.work.mesh, counts, settings, settings.model, &own);
  };
  if (replaces(score_of(best), score_of(*before), Requirement::not_worse)) return;
  best = *std::move(before);
  Driver(best.work, settings, state, run).recorder().returned_to(best.sweep);
}

// A cure that finds nothing in so many moves gives way to repairs, which insert more vertices.
constexpr int kMovesBeforeRepairs = 300;

/// Makes the mesh well-centered, or comes near to it: restarts and repairs.
Expected<Candidate> well_centered(InputMesh& input, const Settings& settings, SweepState& state, Run& run) {
  auto found = is_ready_for_accuracy(input.any_order(), settings) ? Candidate{input.copy()}
                                                                  : best_restart(input, settings, state, run);
  if (!found) return found;
  Candidate best = *std::move(found);
  // A tensor can make all triangles thin. Then sweeps pull vertices together, and repairs take long and cure little.
  run.facts.gave_up =
      settings.in_metric && 2 * count_bad(best.work.mesh, settings.executor()) > best.work.mesh.n_triangles();
  if (run.facts.gave_up) return Candidate{input.copy()};
  best = reweighted(std::move(best), input, settings, state, run);
  const bool coarsens = settings.options.coarsen.has_value();
  if (coarsens) best = coarsened(std::move(best), settings, state, run, kMovesBeforeRepairs);
  if (!coarsens || count_bad(best.work.mesh, settings.executor()) > 0) {
    best = repaired(std::move(best), settings, state, run);
    best = refined(std::move(best), settings, state, run);
    if (coarsens) best = coarsened(std::move(best), settings, state, run, settings.options.coarsen_moves);
  }
  return best;
}

/// Changes only places that violate the criterion, or the whole mesh if this leaves fewer violations.
Expected<Candidate> with_least_change(InputMesh& input, const Settings& settings, SweepState& state, Run& run) {
  auto found = mended(input, settings, state, run);
  if (!found) return found.error();
  Candidate& best = found->candidate;
  if (found->left == 0 || !run.goes_on()) return std::move(best);
  const BestBefore kept(run.best_before, &best.work);
  Driver(best.work, settings, state, run).recorder().returned_to(-1);
  Settings of_all = settings;
  of_all.options.change = Change::all;
  of_all.criterion = Criterion::well_centered;
  auto whole = well_centered(input, of_all, state, run);
  if (!whole) return whole;
  if (count(whole->work.mesh, settings) < count(best.work.mesh, settings)) {
    run.facts.many_are_bad = found->many;
    run.facts.places_left = found->left;
    return whole;
  }
  Driver(best.work, settings, state, run).recorder().returned_to(best.sweep);
  return std::move(best);
}

/// Makes one attempt: restarts, repairs, and the phases for accuracy.
Expected<Candidate> attempt(InputMesh& input, const Settings& settings, SweepState& state, Run& run,
                            std::optional<AccuracySizes>& sizes) {
  auto found = settings.changes_least() ? with_least_change(input, settings, state, run)
                                        : well_centered(input, settings, state, run);
  if (!found || run.facts.gave_up || settings.changes_least()) return found;
  Candidate best = *std::move(found);
  if (sizes) improve_accuracy(best, settings, state, run, *sizes);
  return best;
}

/// Says whether the mesh is a grid: in a grid at least a tenth of the vertices are at ties, without the weights that an
/// earlier run has given them.
bool is_grid(Mesh mesh, const Settings& settings) {
  constexpr double kTiedPart = 0.1;
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0);
  const std::size_t ties = heavier_ends_of_ties(mesh, settings.options).size();
  return static_cast<double>(ties) >= kTiedPart * static_cast<double>(mesh.n_vertices());
}

/// A candidate, and the largest ratio of its errors to the input's.
struct Judged {
  Candidate candidate;
  double ratio = 1;
};

/// Takes the input with small weights at its ties instead, if errors are smaller there. `end`: settings by weights.
void weigh_ties_instead(Judged& best, const ErrorJudge& judge, const Mesh& input, const RunEnd& end, Run& run) {
  const Settings& settings = end.settings;
  SweepState state = end.state;
  // With the least, errors change by a percent or two. Trapezoids of rings need more.
  for (const double amount : {0.01, 0.04, 0.16}) {
    const std::size_t records = run.report.history.size();
    Candidate now{WorkingCopy(input, settings.policy.order, settings.executor())};
    Driver driver(now.work, settings, state, run);
    driver.recorder().returned_to(-1);
    const bool is_good = driver.make_regular() && driver.reweight_ties(amount);
    now.sweep = run.report.sweeps;
    const double ratio = is_good ? judge.largest_ratio(now.work.mesh) : best.ratio;
    if (ratio < best.ratio) {
      best = {std::move(now), ratio};
      return;
    }
    driver.recorder().returned_to(best.candidate.sweep);
    run.report.history.resize(records);  // its last record is of the returned mesh
    if (is_good) return;
  }
}

/// Returns the mesh of the run, or a rival on which measured errors are smaller. On structured grids errors of
/// neighbors cancel, and vertices that move end this. A sound input is a rival, and so is a grid whose ties get small
/// weights.
Candidate least_error(Candidate best, InputMesh& given, const RunEnd& end, Run& run) {
  const Settings& settings = end.settings;
  if (settings.options.coarsen) return best;  // it should have fewer vertices, and larger errors
  if (run.stopped_early() || !is_judged_by_errors(given.n_vertices(), best.work.units.space, settings)) return best;
  const Mesh& input = given.whole();
  Settings by_weights = settings;
  by_weights.options.unknowns = Unknowns::weights;
  const bool sound = is_sound(input, end.of_input.counts, settings);
  if (!sound && !is_grid(input, by_weights)) return best;
  const ErrorJudge judge(input, settings);
  const double ratio = judge.largest_ratio(best.work.mesh);
  Judged judged = {std::move(best), ratio};
  if (ratio > 1 && !sound) weigh_ties_instead(judged, judge, input, {by_weights, end.state, end.of_input}, run);
  const Criterion criterion = criterion_of(settings.options.scheme);
  run.facts.keeps_input =
      sound && (judged.ratio > 1 || !meets(judged.candidate.work.mesh, criterion, settings.executor()));
  if (judged.ratio > 1) run.facts.error_ratio = judged.ratio;
  return std::move(judged.candidate);
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
  if (settings.objective != Objective::energy) settings.worst_violation = worst_violation(mesh, hooks.executor);
  settings.in_metric = in_metric;
  SweepState state(settings);

  std::optional<AccuracySizes> sizes;
  // A listener, the field of a band and a model of errors may refer to the mesh.
  const bool is_free = hooks.exclusive && !hooks.best_so_far && !settings.size_field && settings.errors == nullptr &&
                       !settings.changes_least();
  InputMesh input(mesh, is_free, settings.policy.order, hooks.executor);
  const InputMeasures of_input(input, settings, sizes);
  run.facts.meets_limits = meets_limits_of_client(input.any_order(), settings);
  run.facts.meets_criterion =
      settings.changes_least() && meets(input.any_order(), settings.criterion, settings.executor());
  const RunEnd end = {settings, state, of_input};
  if (run.facts.meets_limits || run.facts.meets_criterion) {
    keep_input(input, end, run);
    return run.take_report();
  }
  auto found = attempt(input, settings, state, run, sizes);
  if (!found) return found.error();
  Candidate best = least_error(*std::move(found), input, end, run);
  give_back(input, std::move(best), end, std::move(sizes), run);
  return run.take_report();
}

}  // namespace

Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  if (!options.tensor && options.triangle_tensors.empty()) return optimize_here(mesh, options, hooks);
  return optimize_in_metrics(mesh, options, hooks, [](Mesh& there, const OptimizeOptions& o, const OptimizeHooks& h) {
    return optimize_here(there, o, h, true);
  });
}

}  // namespace temper
