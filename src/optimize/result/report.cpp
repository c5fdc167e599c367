#include "optimize/result/report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "energy/whole_mesh.hpp"
#include "mesh/curve.hpp"
#include "optimize/result/notes.hpp"
#include "optimize/run/changes.hpp"
#include "optimize/run/end_of_run.hpp"
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

/// Says whether the accuracy objective compares meshes. With the least change nothing lowers it.
bool is_of_accuracy(const Settings& settings) {
  return settings.objective != Objective::energy && !settings.changes_least();
}
Objective reported_objective(const Settings& settings) {
  return is_of_accuracy(settings) ? settings.objective : Objective::energy;
}

/// `model`: in the user's units. Data that are no longer needed are freed before the next measure.
Result result_of(InputMesh& input, Candidate candidate, const Settings& settings, const EnergyModel& model,
                 std::optional<AccuracySizes> sizes) {
  Executor* const executor = settings.executor();
  WorkingCopy& work = candidate.work;
  Result result;
  const bool for_accuracy = sizes.has_value(), scattered = input.is_scattered();
  VertexSizes own;
  if (for_accuracy) {
    AccuracySizes last = *std::exchange(sizes, std::nullopt);
    own = scattered ? std::move(last).in_user_units(work, executor) : std::move(last).in_user_terms(work, executor);
  }
  if (work.has_gaps || work.has_inserted()) result.vertices = work.user_vertices();
  const bool on_sphere = !work.units.space.is_plane();  // elsewhere nothing is rounded
  work.leave_frame();
  if (scattered) {
    if (on_sphere) take_back_rounding(input.whole(), work.order->vertices, work.mesh);
  } else {
    work.take_user_order(executor);
    if (on_sphere) take_back_rounding(input.whole(), result.vertices, work.mesh);
  }
  const MeshScore counts = count(work.mesh, settings);
  result.score = candidate.error ? score(work.mesh, counts, settings, *candidate.error)
                                 : score(work.mesh, counts, settings, model, for_accuracy ? &own : nullptr);
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

/// Says whether flips alone improve a returned input. Edges that hidden vertices keep irregular do not count.
bool lacks_flips(const MeshScore& input, const Settings& settings, const RunFacts& facts) {
  const Policy& policy = settings.policy;
  if (policy.keeps_connectivity() || (policy.keeps_hidden() && facts.input_flips == 0)) return false;
  return input.non_regular > 0;
}

}  // namespace

std::span<const std::string_view> words_of(Stopped) {
  static constexpr std::string_view kNames[] = {"converged", "max_sweeps", "max_outer",   "time_limit",
                                                "canceled",  "tangled",    "sweep_limit", "hidden"};
  return kNames;
}
std::string_view name(Stopped stopped) { return words_of(stopped)[static_cast<std::size_t>(stopped)]; }

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
  if (!is_of_accuracy(settings)) return;
  sizes.emplace(mesh, numbers, settings.options.size_field, executor);
  VertexSizes there;
  for (const VertexId v : numbers) there.push_back(sizes->of_input()[v]);
  score = temper::score(mesh, counts, settings, settings.model, numbers.empty() ? &sizes->of_input() : &there);
}

/// Counts what differs from the input. `numbers`: as in EndOfRun.
static ChangeCounts changes_from(const Mesh& input, const Mesh& mesh, const IdVector<VertexId, VertexId>& numbers) {
  const auto is_old = [&](VertexId v) { return v.index < input.n_vertices(); };
  ChangeCounts counts = changed_vertices(input, mesh, numbers, [&](VertexId v, VertexId was) {
    return !(mesh.space().place(mesh.point(v)) == mesh.space().place(input.point(was)));
  });
  const auto number = [&](VertexId v) { return numbers.empty() ? v : numbers[v]; };
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h)) continue;
    const VertexId a = number(mesh.origin(h)), b = number(mesh.target(h));
    if (h.index < input.n_halfedges() && input.origin(h) == a && input.target(h) == b) continue;
    const bool was_there =
        is_old(a) && is_old(b) && (input.find_halfedge(a, b).valid() || input.find_halfedge(b, a).valid());
    counts.edges_changed += was_there ? 0 : 1;
  }
  return counts;
}

namespace {

/// The two meshes of which one goes back to the user.
struct Rivals {
  Result made;
  Result as_given;                 ///< the score of the input; if `flips`, the input made regular
  bool flips = false;              ///< the input lacks flips that may make it the better mesh
  std::vector<TraceEvent> events;  ///< of these flips
  double energy_before = 0;        ///< of the input
};

Rivals measure(InputMesh& input, Candidate best, const RunEnd& end, std::optional<AccuracySizes> sizes,
               const Run& run) {
  const auto& [settings, state, of_input] = end;
  const EnergyModel model = in_user_units(state.model, best.work.units);
  Rivals rivals;
  rivals.made = result_of(input, std::move(best), settings, model, std::move(sizes));
  const MeshScore before =
      of_input.score ? *of_input.score : score(input.whole(), of_input.counts, settings, model, nullptr);
  rivals.energy_before = before.energy;
  rivals.as_given.score = before;
  // Flips that make the input regular have priority over all other criteria.
  const MeshScore& made = rivals.made.score;
  const bool may_be_better = before < made || made.bad > 0 || made.non_regular > 0;
  if (!may_be_better || !lacks_flips(of_input.counts, settings, run.facts)) return rivals;
  std::optional<AccuracySizes> again;
  if (is_of_accuracy(settings)) {
    const NearbyCopy near(input.whole(), settings.executor());
    again.emplace(near.mesh(), numbers_of(near), settings.options.size_field, settings.executor());
  }
  Settings recorded = settings;
  std::vector<TraceEvent> events;
  if (settings.hooks.tracer) recorded.hooks.tracer = [&events](const TraceEvent& e) { events.push_back(e); };
  Result flipped = result_of(input, {made_regular(input.whole(), recorded, state, run.report.sweeps)}, settings, model,
                             std::move(again));
  // Regularity comes before the worst triangle, but not before the measures of the client.
  if (settings.guard != nullptr && flipped.score.beyond_guard > 0) return rivals;
  rivals.as_given = std::move(flipped);
  rivals.flips = true;
  rivals.events = std::move(events);
  return rivals;
}

/// Says whether the input is better than the mesh of the run.
bool returns_input(const Rivals& rivals, const InputMesh& input, const Settings& settings, const RunFacts& facts) {
  if (facts.keeps_input) return true;
  const MeshScore &made = rivals.made.score, &as_given = rivals.as_given.score;
  const bool coarser = settings.options.coarsen && rivals.made.work.mesh.n_vertices() < input.n_vertices() &&
                       made.bad <= as_given.bad && made.non_regular <= as_given.non_regular;
  return !coarser && !replaces(made, as_given, Requirement::not_worse);
}

/// Steps can leave weights of 1e-300, which mean nothing and which files refuse.
void drop_tiny_weights(Mesh& mesh) {
  constexpr double kTiny = 1e-100, kRefused = 1e-120;
  const double scale = WorkingUnits::of(mesh).scale, least = std::max(kRefused, kTiny * scale * scale);
  for (const VertexId v : mesh.vertices()) {
    if (std::abs(mesh.weight(v)) < least && mesh.weight(v) != 0) mesh.set_weight(v, 0);
  }
}

void hand_over(InputMesh& input, Rivals rivals, bool returns_input, const RunEnd& end, Run& run) {
  const Settings& settings = end.settings;
  OptimizeReport& report = run.report;
  Ending ending = {returns_input, rivals.flips, is_of_accuracy(settings), rivals.made.score.bad,
                   bad_part(input.n_triangles(), end.of_input.counts.bad)};
  Result& result = rivals.made;
  if (returns_input) {
    Recorder recorder(settings.hooks.tracer, result.work, 1);
    recorder.begin_sweep(run.next_sweep());
    recorder.returned_to(-1);
    for (const TraceEvent& e : rivals.events) settings.hooks.tracer(e);
    result = std::move(rivals.as_given);
    ending.bad = result.score.bad;
  }
  const bool is_new = !returns_input || rivals.flips;
  if (!returns_input) drop_tiny_weights(result.work.mesh);
  report.size.before = end.of_input.size;
  report.size.after = is_new ? result.size : end.of_input.size;
  report.vertices = std::move(result.vertices);
  const std::size_t bad_before = end.of_input.counts.bad;
  const EndOfRun<Mesh> compared = {settings.changes_least() ? &input.whole() : nullptr,
                                   is_new ? result.work.mesh : input.whole(),
                                   is_new && input.is_scattered() ? result.work.order->vertices : report.vertices,
                                   input.n_vertices(),
                                   reported_objective(settings),
                                   {rivals.energy_before, bad_before},
                                   {result.score.energy, is_new ? result.score.bad : bad_before}};
  complete(report, compared);
  if (is_new) {
    if (settings.hooks.viewer) settings.hooks.viewer(result.work.mesh);
    input.replace(std::move(result.work));
  }
  report.hidden_vertices = hidden_vertices_of(input.whole(), settings);
  add_notes(input.whole(), settings, run.facts, ending, report);
}

}  // namespace

void keep_input(InputMesh& input, const RunEnd& end, Run& run) {
  const auto& [settings, state, of_input] = end;
  const Mesh& mesh = input.whole();
  const EnergyModel model = in_user_units(state.model, WorkingUnits::of(mesh));
  const MeshScore measured = of_input.score ? *of_input.score : score(mesh, of_input.counts, settings, model, nullptr);
  const ReportedNumbers numbers = {measured.energy, of_input.counts.bad};
  OptimizeReport& report = run.report;
  report.size.before = report.size.after = of_input.size;
  complete(report, EndOfRun<Mesh>{nullptr, mesh, report.vertices, input.n_vertices(), reported_objective(settings),
                                  numbers, numbers});
  if (settings.changes_least()) report.changed.emplace();
  report.hidden_vertices = hidden_vertices_of(mesh, settings);
  const double part = bad_part(input.n_triangles(), of_input.counts.bad);
  add_notes(mesh, settings, run.facts, {false, false, is_of_accuracy(settings), of_input.counts.bad, part}, report);
}

void give_back(InputMesh& input, Candidate best, const RunEnd& end, std::optional<AccuracySizes> sizes, Run& run) {
  Rivals rivals = measure(input, std::move(best), end, std::move(sizes), run);
  const bool worse = returns_input(rivals, input, end.settings, run.facts);
  hand_over(input, std::move(rivals), worse, end, run);
}

}  // namespace temper
