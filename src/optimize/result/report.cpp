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

/// A mesh that may be returned to the user: in the user's units, and in an order in which stars are near in memory.
struct Result {
  WorkingCopy work;
  IdVector<VertexId, VertexId> vertices;  ///< for OptimizeReport
  MeshScore score;
  SizeReport size;
};

/// Sizes take time. Besides the user only some notes need them.
bool wants_sizes(const Settings& settings) {
  return settings.hooks.measures_sizes || settings.options.size_field || settings.size_field;
}

/// `model`: in the user's units. Data that are no longer needed are freed before the next measure.
Result result_of(InputMesh& input, WorkingCopy work, const Settings& settings, const EnergyModel& model,
                 std::optional<AccuracySizes> sizes) {
  Executor* const executor = settings.executor();
  Result result;
  const bool for_accuracy = sizes.has_value(), scattered = input.is_scattered();
  VertexSizes own;
  if (for_accuracy) own = scattered ? sizes->in_user_units(work, executor) : sizes->in_user_terms(work, executor);
  sizes.reset();
  if (work.has_gaps || work.has_inserted()) result.vertices = work.user_vertices();
  const bool on_sphere = !work.units.space.is_plane();  // elsewhere nothing is rounded
  work.leave_frame();
  if (scattered) {
    if (on_sphere) take_back_rounding(input.whole(), work.order->vertices, work.mesh);
  } else {
    work.take_user_order(executor);
    if (on_sphere) take_back_rounding(input.whole(), result.vertices, work.mesh);
  }
  result.score = score(work.mesh, settings, model, for_accuracy ? &own : nullptr);
  own = {};
  if (wants_sizes(settings)) {
    const auto& numbers = scattered ? work.order->vertices : result.vertices;
    result.size = measure_size(work.mesh, field_of(input.whole(), settings), executor, numbers);
  }
  result.work = std::move(work);
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

/// Returns the numbers in the original; none if all are equal.
IdVector<VertexId, VertexId> numbers_of(const NearbyCopy& near) {
  IdVector<VertexId, VertexId> numbers;
  if (near.is_original()) return numbers;
  numbers.reserve(near.mesh().n_vertices());
  for (const VertexId v : near.mesh().vertices()) numbers.push_back(near.original(v));
  return numbers;
}

/// Counts removed and inserted vertices.
void count_changes(std::size_t n_input_vertices, OptimizeReport& report) {
  report.vertices_removed = report.vertices_inserted = 0;
  if (report.vertices.empty()) return;
  for (const VertexId v : report.vertices) report.vertices_inserted += v.valid() ? 0 : 1;
  report.vertices_removed = n_input_vertices - (report.vertices.size() - report.vertices_inserted);
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

InputMeasures::InputMeasures(InputMesh& input, const Settings& settings, std::optional<AccuracySizes>& sizes) {
  Executor* const executor = settings.executor();
  const NearbyCopy near(input.any_order(), executor);
  const Mesh& mesh = near.mesh();
  if (settings.hooks.viewer) settings.hooks.viewer(mesh);
  counts = count(mesh, settings);
  const IdVector<VertexId, VertexId> copied = numbers_of(near);
  const IdVector<VertexId, VertexId>& numbers = near.is_original() ? input.numbers() : copied;
  const bool has_field = settings.size_field || settings.options.size_field;
  if (wants_sizes(settings)) {
    size = has_field ? measure_size(mesh, field_of(mesh, settings), executor, numbers)
                     : measure_size(mesh, field_of(mesh, settings), executor);
  }
  if (settings.objective == Objective::energy) return;
  sizes.emplace(mesh, numbers, settings.options.size_field, executor);
  VertexSizes there;
  for (const VertexId v : numbers) there.push_back(sizes->of_input()[v]);
  score = temper::score(mesh, counts, settings, settings.model, numbers.empty() ? &sizes->of_input() : &there);
}

void give_back(InputMesh& input, Candidate best, const Settings& settings, const SweepState& state,
               const InputMeasures& of_input, std::optional<AccuracySizes> sizes, Run& run) {
  OptimizeReport& report = run.report;
  report.objective = settings.objective;
  Recorder recorder(settings.hooks.tracer, best.work, 1);
  recorder.begin_sweep(run.next_sweep());
  const EnergyModel model = in_user_units(state.model, best.work.units);
  const bool for_accuracy = sizes.has_value();
  Result result = result_of(input, std::move(best.work), settings, model, std::move(sizes));
  const MeshScore before =
      of_input.score ? *of_input.score : score(input.whole(), of_input.counts, settings, model, nullptr);
  report.size.before = report.size.after = of_input.size;
  report.objective_before = before.energy;
  report.bad_before = of_input.counts.bad;
  const double bad_part_before = bad_part(input.n_triangles(), of_input.counts.bad);
  // Flips that make the input regular have priority over all other criteria.
  const bool may_be_better = before < result.score || result.score.bad > 0 || result.score.non_regular > 0;
  bool flips = may_be_better && !run.facts.meets_limits && lacks_flips(of_input.counts, settings, run.facts);
  Result as_given;
  as_given.score = before;
  if (flips) {
    Settings silent = settings;
    silent.hooks.tracer = {};
    std::optional<AccuracySizes> again;
    if (for_accuracy) {
      const NearbyCopy near(input.whole(), settings.executor());
      again.emplace(near.mesh(), numbers_of(near), settings.options.size_field, settings.executor());
    }
    as_given =
        result_of(input, made_regular(input.whole(), silent, state, report.sweeps), settings, model, std::move(again));
    // Regularity comes before the worst triangle, but not before the measures of the client.
    if (settings.guard != nullptr && as_given.score.beyond_guard > 0) {
      flips = false;
      as_given = {};
      as_given.score = before;
    }
  }
  const bool coarser = settings.options.coarsen && result.work.mesh.n_vertices() < input.n_vertices() &&
                       result.score.bad <= as_given.score.bad && result.score.non_regular <= as_given.score.non_regular;
  const bool worse =
      run.facts.keeps_input || (!coarser && !replaces(result.score, as_given.score, Requirement::not_worse));
  if (worse) {
    recorder.returned_to(-1);
    if (flips && recorder.on()) static_cast<void>(made_regular(input.whole(), settings, state, report.sweeps));
    result = std::move(as_given);
  }
  report.vertices = std::move(result.vertices);
  report.objective_after = result.score.energy;
  report.bad_after = !worse || flips ? result.score.bad : of_input.counts.bad;
  count_changes(input.n_vertices(), report);
  if (!worse || flips) {
    report.size.after = result.size;
    if (settings.hooks.viewer) settings.hooks.viewer(result.work.mesh);
    input.replace(std::move(result.work));
  }
  const Mesh& mesh = input.whole();
  report.hidden = hidden_vertices_of(mesh, settings);

  add_notes(mesh, settings, run.facts, {worse, flips, for_accuracy, result.score.bad, bad_part_before}, report);
  report.seconds = run.seconds();
}

}  // namespace temper
