#include "optimize/result/report.hpp"

#include <optional>
#include <utility>

#include "energy/whole_mesh.hpp"
#include "mesh/curve.hpp"
#include "optimize/result/notes.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/stages/driver.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// Returns the field with which sizes are compared: the user's, or the input's own, valid until that is replaced.
SizeField field_of(const Mesh& input, const Settings& settings) {
  if (settings.size_field) return *settings.size_field;
  return settings.options.size_field ? *settings.options.size_field : input_size_field_of(input, settings.executor());
}

/// Returns the vertices that Lawson's algorithm leaves without a power cell. Among inverted triangles these are not
/// defined, so there are none.
std::vector<VertexId> hidden_vertices_of(const Mesh& mesh, const Settings& settings) {
  const bool keeps = settings.policy.keeps_hidden();
  if (!keeps || count_non_regular_edges(mesh, false, settings.executor()) == 0 || count_inverted(mesh) > 0) return {};
  Mesh copy = mesh;
  return restore_regularity(copy).hidden;
}

/// A mesh that may be returned to the user.
struct Result {
  Mesh mesh;
  IdVector<VertexId, VertexId> vertices;  ///< for OptimizeReport
  MeshScore score;
  SizeReport size;
};

/// `model`: in the user's units. Measures that the user's order would scatter over memory come before the change of
/// order. Data that are no longer needed are freed before the next measure.
Result result_of(const Mesh& input, WorkingCopy work, const Settings& settings, const EnergyModel& model,
                 std::optional<AccuracySizes> sizes) {
  Executor* const executor = settings.executor();
  Result result;
  const bool for_accuracy = sizes.has_value(), scattered = is_scattered(input);
  VertexSizes own;
  if (for_accuracy) own = scattered ? sizes->in_user_units(work, executor) : sizes->in_user_terms(work, executor);
  sizes.reset();
  const auto measure = [&](const Mesh& mesh, const IdVector<VertexId, VertexId>& numbers) {
    result.score = score(mesh, settings, model, for_accuracy ? &own : nullptr);
    own = {};
    result.size = measure_size(mesh, field_of(input, settings), executor, numbers);
  };
  if (work.has_gaps || work.has_inserted()) result.vertices = work.user_vertices();
  if (scattered) {
    work.leave_frame();
    take_back_rounding(input, work.order.vertices, work.mesh);
    measure(work.mesh, work.order.vertices);
    result.mesh = std::move(work).in_user_order(executor);
  } else {
    result.mesh = std::move(work).in_user_terms(executor);  // frees the data of the order
    take_back_rounding(input, result.vertices, result.mesh);
    measure(result.mesh, result.vertices);
  }
  return result;
}

/// Returns the input made regular by flips, as every restart begins, for a run that found no better mesh.
WorkingCopy made_regular(const Mesh& mesh, const Settings& settings, SweepState state, int sweeps) {
  WorkingCopy work(mesh, settings.policy.order, settings.executor());
  const OptimizeHooks nobody;
  Run unheard(settings.options, nobody, mesh);
  unheard.report.sweeps = sweeps;
  Driver(work, settings, state, unheard).make_regular();
  return work;
}

/// Counts removed and inserted vertices.
void count_changes(const Mesh& input, OptimizeReport& report) {
  report.vertices_removed = report.vertices_inserted = 0;
  if (report.vertices.empty()) return;
  for (const VertexId v : report.vertices) report.vertices_inserted += v.valid() ? 0 : 1;
  report.vertices_removed = input.n_vertices() - (report.vertices.size() - report.vertices_inserted);
}

/// Says whether flips alone improve a returned input. Edges that hidden vertices keep irregular do not count.
bool lacks_flips(const MeshScore& input, const Settings& settings, const RunFacts& facts) {
  const Policy& policy = settings.policy;
  if (policy.keeps_connectivity() || (policy.keeps_hidden() && facts.input_flips == 0)) return false;
  return input.non_regular > 0;
}

}  // namespace

std::string_view name(Stopped stopped) {
  constexpr std::string_view kNames[] = {"converged", "max_sweeps", "max_outer",   "time_limit",
                                         "canceled",  "tangled",    "sweep_limit", "hidden"};
  return kNames[static_cast<std::size_t>(stopped)];
}

InputMeasures::InputMeasures(const Mesh& mesh, const Settings& settings, std::optional<AccuracySizes>& sizes) {
  Executor* const executor = settings.executor();
  const NearbyCopy near(mesh, executor);
  counts = count(near.mesh(), settings);
  IdVector<VertexId, VertexId> numbers;
  if (!near.is_original()) {
    for (const VertexId v : near.mesh().vertices()) numbers.push_back(near.original(v));
  }
  const bool has_field = settings.size_field || settings.options.size_field;
  size = has_field ? measure_size(near.mesh(), field_of(mesh, settings), executor, numbers)
                   : measure_size(near.mesh(), field_of(near.mesh(), settings), executor);
  if (settings.objective == Objective::energy) return;
  sizes.emplace(near, settings.options.size_field, executor);
  VertexSizes there;
  for (const VertexId v : numbers) there.push_back(sizes->of_input()[v]);
  score = temper::score(near.mesh(), counts, settings, settings.model, numbers.empty() ? &sizes->of_input() : &there);
}

void give_back(Mesh& mesh, Candidate best, const Settings& settings, const SweepState& state,
               const InputMeasures& of_input, std::optional<AccuracySizes> sizes, Run& run) {
  OptimizeReport& report = run.report;
  report.objective = settings.objective;
  Recorder recorder(settings.hooks.tracer, best.work, 1);
  recorder.begin_sweep(run.next_sweep());
  const EnergyModel model = in_user_units(state.model, best.work.units);
  const bool for_accuracy = sizes.has_value();
  Result result = result_of(mesh, std::move(best.work), settings, model, std::move(sizes));
  const MeshScore before = of_input.score ? *of_input.score : score(mesh, of_input.counts, settings, model, nullptr);
  report.size.before = report.size.after = of_input.size;
  report.objective_before = before.energy;
  const double bad_part_before = bad_part(mesh, of_input.counts.bad);
  // Flips that make the input regular have priority over all other criteria.
  const bool may_be_better = before < result.score || result.score.bad > 0 || result.score.non_regular > 0;
  bool flips = may_be_better && lacks_flips(of_input.counts, settings, run.facts);
  Result input;
  input.score = before;
  if (flips) {
    Settings silent = settings;
    silent.hooks.tracer = {};
    std::optional<AccuracySizes> again;
    if (for_accuracy)
      again.emplace(NearbyCopy(mesh, settings.executor()), settings.options.size_field, settings.executor());
    input = result_of(mesh, made_regular(mesh, silent, state, report.sweeps), settings, model, std::move(again));
    if (input.score.beyond_guard > 0) {  // then the input is better as it was
      flips = false;
      input = {};
      input.score = before;
    }
  }
  const bool worse = run.facts.keeps_input || !replaces(result.score, input.score, Requirement::not_worse);
  if (worse) {
    recorder.returned_to(-1);
    if (flips && recorder.on()) static_cast<void>(made_regular(mesh, settings, state, report.sweeps));
    result = std::move(input);
  }
  report.vertices = std::move(result.vertices);
  report.objective_after = result.score.energy;
  count_changes(mesh, report);
  if (!worse || flips) {
    report.size.after = result.size;
    mesh = std::move(result.mesh);
  }
  report.hidden = hidden_vertices_of(mesh, settings);

  add_notes(mesh, settings, run.facts, {worse, flips, for_accuracy, result.score.bad, bad_part_before}, report);
  report.seconds = run.seconds();
}

}  // namespace temper
