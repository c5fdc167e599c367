// optimize(): checks what it is given, works on a copy, and gives back the best mesh it found.
#include "temper/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "optimize/accuracy/accuracy_driver.hpp"
#include "optimize/driver.hpp"
#include "optimize/repair/repair_search.hpp"
#include "temper/necessity.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// Hidden vertices have no power cell, so no regular triangulation keeps them: the user must know which.
InputError hidden_error(const Mesh& mesh, const std::vector<VertexId>& hidden, const InputNames& names) {
  constexpr std::size_t kNamed = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(hidden.size(), kNamed); ++i) {
    if (i > 0) list += ", ";
    list += names.point(hidden[i].index) + " (weight " + to_text(mesh.weight(hidden[i])) + ")";
  }
  if (hidden.size() > kNamed) list += " and " + std::to_string(hidden.size() - kNamed) + " more";
  return {ErrorCode::hidden_vertex, hidden.empty() ? std::string() : names.point_where(hidden[0].index),
          "weights hide " + list + "; expected weights that leave every vertex a power cell"};
}

InputError outside_domain_error(const Mesh& mesh, const Settings& settings) {
  return {ErrorCode::invalid_option,
          {},
          "energy " + std::string(settings.energy.name) + " is infinite on this mesh, where " +
              std::to_string(count_bad(mesh, settings.options.executor)) + " of " + std::to_string(mesh.n_triangles()) +
              " triangles are not well-centered; expected a mesh inside its barrier, or energy BP, which needs none"};
}

/// E_BH, and E_BHs with the user's h°, can only stay inside their barrier; the others get in from anywhere.
bool starts_outside_domain(const Mesh& mesh, const Settings& settings) {
  const bool gets_in = settings.energy.softened_by_gamma || (settings.energy.softened_by_h0 && !settings.options.h0);
  return settings.energy.barrier && !gets_in && !std::isfinite(total_energy(mesh, settings.model));
}

/// Whether a is worse than b: validity first, and regularity, but for hidden vertices that the user keeps; for a
/// barrier, which is there to make triangles well-centered, their number next; then the energy.
bool is_worse(const Mesh& a, const Mesh& b, const Settings& settings) {
  const auto standing = [&](const Mesh& mesh) {
    const OptimizeOptions& o = settings.options;
    const std::size_t inverted = o.inversion == Inversion::allow ? count_inverted(mesh) : 0;
    const std::size_t non_regular =
        o.hidden == HiddenPolicy::keep ? 0 : count_non_regular_edges(mesh, false, o.executor);
    const std::size_t bad = settings.energy.barrier ? count_bad(mesh, o.executor) : 0;
    return std::tuple(inverted, non_regular, bad, total_energy(mesh, settings.model, settings.options.executor));
  };
  return standing(b) < standing(a);
}

/// What the energies of the accuracy objective are told by, in the user's terms.
struct AccuracyOf {
  const Mesh& mesh;
  const VertexSizes& sizes;
};

double accuracy_of(const AccuracyOf& a, const Settings& settings) {
  return accuracy_energy(a.mesh, a.sizes, settings.accuracy, settings.options.executor);
}

/// The same for the accuracy objective: before its energy comes that margins are kept, which its second phase does.
bool is_worse(const AccuracyOf& a, const AccuracyOf& b, const Settings& settings) {
  const auto standing = [&](const AccuracyOf& of) {
    const OptimizeOptions& o = settings.options;
    const std::size_t non_regular =
        o.hidden == HiddenPolicy::keep ? 0 : count_non_regular_edges(of.mesh, false, o.executor);
    return std::tuple(non_regular, count_bad(of.mesh, o.executor),
                      !has_margins(of.mesh, settings.accuracy.margin, o.executor), accuracy_of(of, settings));
  };
  return standing(b) < standing(a);
}

}  // namespace

std::string_view name(Stopped stopped) {
  switch (stopped) {
    case Stopped::converged:
      return "converged";
    case Stopped::max_sweeps:
      return "max_sweeps";
    case Stopped::max_outer:
      return "max_outer";
    case Stopped::time_limit:
      return "time_limit";
    case Stopped::cancelled:
      return "cancelled";
    case Stopped::accuracy_sweeps:
      return "accuracy_sweeps";
    case Stopped::tangled:
      return "tangled";
    case Stopped::hidden:
      return "hidden";
  }
  return "unknown";
}

OptimizeOptions paper_method() {
  OptimizeOptions o;
  o.gamma = Softening{1, LengthScale::absolute};
  o.solver = Solver::golden;
  o.flip_timing = FlipTiming::deferred;
  o.inner = 0;
  o.flip_limit = FlipLimit::unlimited;
  o.inversion = Inversion::allow;
  o.hidden = HiddenPolicy::keep;
  o.order = SweepOrder::input;
  o.anchor = 0;
  o.collapse_from = 0;
  o.removal = Removal::patch;
  o.removal_measure = RemovalMeasure::sum;
  o.removal_margin = 0;
  o.removal_from = 0;
  o.repair = Repair::none;
  o.stopping = StoppingRule::paper;
  o.tolerance = 1e-6;
  return o;
}

namespace {

constexpr const char* kStillInfinite =
    "the energy is infinite: on some edges weights differ by more than the squared length, and this run could not "
    "change that";
constexpr const char* kNegative =
    "the energy is negative: HOT has no lower bound in the weights; energies T and BP have one";

InputError hidden_by_input(const Mesh& mesh, const InputNames* names) {
  Mesh copy = mesh;
  const InputNames numbers_from_0;
  return hidden_error(mesh, restore_regularity(copy).hidden, names != nullptr ? *names : numbers_from_0);
}

/// Vertices that Lawson's algorithm leaves without a power cell.
std::vector<VertexId> hidden_vertices_of(const Mesh& mesh, const OptimizeOptions& options) {
  if (options.hidden != HiddenPolicy::keep || count_non_regular_edges(mesh, false, options.executor) == 0) return {};
  Mesh copy = mesh;
  return restore_regularity(copy).hidden;
}

/// What one attempt came to.
struct Result {
  WorkingCopy work;
  int sweep = 0;
};

std::string count_of(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// The settings with lengths in the user's units, for meshes in the user's terms.
Settings in_user_terms(Settings settings, const Frame& frame) {
  settings.model = in_user_units(settings.model, frame);
  return settings;
}

/// The input with its edges flipped as every attempt begins, for a run that found nothing better.
Mesh made_regular(const Mesh& mesh, Settings settings) {
  settings.options.tracer = {};
  WorkingCopy work(mesh, settings.options.order, settings.options.executor);
  const Observer nobody;
  Run unheard(settings.options, nobody);
  Driver(work, settings, unheard).make_regular();
  return std::move(work).in_user_terms();
}

/// Vertices of the input that are gone, and new ones that are there.
void count_changes(const IdVector<VertexId, VertexId>& vertices, const Mesh& input, OptimizeReport& report) {
  report.vertices_removed = report.vertices_inserted = 0;
  if (vertices.empty()) return;
  for (const VertexId v : vertices) report.vertices_inserted += v.valid() ? 0 : 1;
  report.vertices_removed = input.n_vertices() - (vertices.size() - report.vertices_inserted);
}

/// The size field of a run with a band; the input's own is seen where it is, since the run works on copies.
std::optional<SizeField> field_of_band(const Mesh& mesh, const OptimizeOptions& options) {
  if (!options.size_band) return std::nullopt;
  return options.size_field ? options.size_field : input_size_field_of(mesh, options.executor);
}

/// Puts the best mesh into `mesh`, unless that is the better one, and says in the report what came of it.
void give_back(Mesh& mesh, WorkingCopy best, const Settings& settings, const AccuracySizes* sizes,
               const Recorder& recorder, OptimizeReport& report) {
  const OptimizeOptions& o = settings.options;
  const VertexSizes of_result = sizes != nullptr ? sizes->in_user_terms(best, o.executor) : VertexSizes();
  const auto energy = [&](const Mesh& of, bool is_result) {
    if (sizes == nullptr) return total_energy(of, settings.model, o.executor);
    return accuracy_of({of, is_result ? of_result : sizes->of_input()}, settings);
  };
  auto vertices = best.has_gaps || best.has_inserted() ? best.user_vertices() : IdVector<VertexId, VertexId>();
  Mesh result = std::move(best).in_user_terms();  // first: what knew the order takes room no longer
  report.initial_energy = energy(mesh, false);
  const SizeField field =
      o.size_field ? *o.size_field : input_size_field_of(mesh, o.executor);  // seen until mesh is replaced
  report.size.before = report.size.after = measure_size(mesh, field, o.executor);
  const bool worse = sizes == nullptr ? is_worse(result, mesh, settings)
                                      : is_worse({result, of_result}, {mesh, sizes->of_input()}, settings);
  if (worse) {
    // Where hidden vertices are kept, edges that are not regular make no mesh worse; but those that can be flipped are.
    const bool flips = o.flips && o.hidden == HiddenPolicy::keep && o.boundary_vertices != BoundaryVertices::split &&
                       count_non_regular_edges(mesh, false, o.executor) > 0;
    if (flips) {
      Mesh regular = made_regular(mesh, settings);
      report.size.after = measure_size(regular, field, o.executor);
      mesh = std::move(regular);
    }
    recorder.returned_to(flips ? 0 : -1);
    report.notes.push_back(flips ? "no better mesh was found: the input is returned, its edges flipped to be regular"
                                 : "no better mesh was found: the input is returned as it was");
    report.vertices_removed = report.vertices_inserted = 0;
  } else {
    count_changes(vertices, mesh, report);
    report.vertices = std::move(vertices);
    report.size.after = measure_size(result, field, o.executor, report.vertices);
    mesh = std::move(result);
  }
  report.final_energy = energy(mesh, !worse);
  report.hidden = hidden_vertices_of(mesh, o);
  if (o.size_band && report.size.before.band() > *o.size_band) {
    report.notes.push_back("the input is outside of its size band: sizes are up to " +
                           to_text(report.size.before.band()) +
                           " times off the size field, and what is outside can only come nearer to it");
  }
  if (const std::size_t outside = report.size.before.outside; outside > 0) {
    report.notes.push_back("the size field does not reach " + count_of(outside, "vertex", "vertices") +
                           " of the input, where its nearest value was taken");
  }
  if (!std::isfinite(report.final_energy)) report.notes.push_back(kStillInfinite);
  if (report.final_energy < 0) report.notes.push_back(kNegative);
}

/// Triangles that no optimiser can make well-centered, whatever it tries.
void note_edges_that_must_be_split(const Mesh& mesh, const Settings& settings, OptimizeReport& report) {
  const OptimizeOptions& o = settings.options;
  if (!settings.energy.barrier || count_bad(mesh, o.executor) == 0) return;
  if (o.inversion == Inversion::allow && count_inverted(mesh) > 0) return;  // a tangle has no inside to see through
  const std::vector<EdgeConflict> edges = edges_that_must_be_split(mesh);
  if (edges.empty()) return;
  const HalfedgeId worst = edges.front().edge;
  const auto vertex = [&](VertexId v) {
    const VertexId number = report.vertices.empty() ? v : report.vertices[v];
    if (!number.valid()) return "(" + to_text(mesh.position(v).x) + ", " + to_text(mesh.position(v).y) + ")";
    return o.names != nullptr ? o.names->point(number.index) : InputNames().point(number.index);
  };
  report.notes.push_back(
      count_of(edges.size(), "edge of the boundary or of lines has", "edges of the boundary or of lines have") +
      " to be split, or a vertex near it moved, before any mesh can be well-centered here, first the one from " +
      vertex(mesh.origin(worst)) + " to " + vertex(mesh.target(worst)) + ": see temper explain, or --boundary split");
}

// A search that ends with triangles bad may have gone astray early on.
constexpr std::uint64_t kSearches = 4;

/// Repairs, from the same beginning until a search leaves nothing bad; the best result is kept, and swept once more.
Result repaired(Result start, Settings& settings, Run& run) {
  const auto is_done = [&](const Result& result) {
    return run.stopped_by_caller() || !run.sweeps_left() || run.repair_trials_left <= 0 ||
           count_bad(result.work.mesh, settings.options.executor) == 0;
  };
  if (is_done(start) || !std::isfinite(total_energy(start.work.mesh, settings.model))) return start;
  Result best = start;
  for (std::uint64_t i = 0; i < kSearches && !is_done(best); ++i) {
    Result result = start;
    Driver driver(result.work, settings, run);
    if (best.sweep != start.sweep) driver.recorder().returned_to(start.sweep);
    if (driver.repair(settings.options.seed + i)) {
      result.sweep = driver.final_sweep();
      if (!is_worse(result.work.mesh, best.work.mesh, settings)) {
        best = std::move(result);
        continue;
      }
    }
    driver.recorder().returned_to(best.sweep);
  }
  if (run.stopped_by_caller() || !run.sweeps_left()) return best;
  best.sweep = Driver(best.work, settings, run).polish(best.sweep);
  return best;
}

/// The best mesh so far, and what it is judged by.
struct Lowered {
  Result best;
  Settings settings;
};

/// The input as it is, for a run that needs nothing but the second phase of the accuracy objective.
Expected<Lowered> not_lowered(const Mesh& mesh, const OptimizeOptions& options, const std::optional<SizeField>& band) {
  WorkingCopy work(mesh, options.order, options.executor);
  auto settings = make_settings(options, work.mesh, work.frame);
  if (!settings) return settings.error();
  settings->size_field = band;
  return Lowered{{std::move(work), 0}, *std::move(settings)};
}

/// Attempts and repairs that lower the energy of the options. For the accuracy objective they end with the margins.
Expected<Lowered> lowered(const Mesh& mesh, const OptimizeOptions& options, const std::optional<SizeField>& band,
                          Run& run) {
  OptimizeReport& report = run.report;
  std::optional<Result> best;  // of the attempts so far
  std::optional<Settings> settings;
  std::span<const Attempt> tries;
  for (std::size_t i = 0; i == 0 || i < tries.size(); ++i) {
    WorkingCopy work(mesh, options.order, options.executor);
    auto made = make_settings(options, work.mesh, work.frame);
    if (!made) return made.error();
    settings = *std::move(made);
    settings->size_field = band;
    if (options.objective == Objective::accuracy) {
      settings->enough = [&run, &options](const Mesh& now) {
        return run.report.history.back().bad == 0 && has_margins(now, options.accuracy.margin, options.executor);
      };
    }
    Driver driver(work, *settings, run);
    if (i > 0) driver.recorder().returned_to(-1);
    if (options.flips && !driver.make_regular()) return hidden_by_input(mesh, options.names);
    driver.grade_boundary();
    if (i == 0) {
      if (starts_outside_domain(work.mesh, *settings)) return outside_domain_error(work.mesh, *settings);
      tries = attempts(settings->energy, options, work.mesh);
      if (report.flips > 0) {
        report.notes.push_back(count_of(report.flips, "edge", "edges") + " of the input flipped to make it regular");
      }
    }
    driver.jitter(tries[i].jitter);
    driver.optimize(tries[i], i + 1 < tries.size() || repairs(*settings));
    if (!best || !is_worse(work.mesh, best->work.mesh, *settings)) {
      best = {std::move(work), driver.final_sweep()};
    } else {
      driver.recorder().returned_to(best->sweep);
    }
    if (count_bad(best->work.mesh, options.executor) == 0 || run.stopped_by_caller() || !run.sweeps_left()) break;
  }
  if (repairs(*settings)) best = repaired(*std::move(best), *settings, run);
  return Lowered{*std::move(best), *std::move(settings)};
}

/// What the accuracy objective came to.
void note_accuracy(const Mesh& mesh, const Settings& settings, OptimizeReport& report) {
  const OptimizeOptions& o = settings.options;
  const std::size_t bad = count_bad(mesh, o.executor);
  std::size_t thin = 0;
  for (const TriangleId t : mesh.triangles()) thin += triangle_margin(mesh, t) > settings.accuracy.margin ? 0 : 1;
  thin -= std::min(thin, bad);
  if (bad > 0) {
    report.notes.push_back(count_of(bad, "triangle is", "triangles are") +
                           " not well-centered: vertices there were not moved for accuracy");
  }
  if (thin > 0) {
    report.notes.push_back(count_of(thin, "triangle is", "triangles are") + " well-centered by no more than " +
                           to_text(settings.accuracy.margin) + " of an edge");
  }
  report.notes.push_back("energy of the accuracy objective, edges taken absolute: " + to_text(report.initial_energy) +
                         " before, " + to_text(report.final_energy) + " after");
}

/// Whether a mesh is one that the second phase may begin with at once.
bool is_ready_for_accuracy(const Mesh& mesh, const OptimizeOptions& options) {
  return options.objective == Objective::accuracy && options.boundary_vertices != BoundaryVertices::split &&
         has_margins(mesh, options.accuracy.margin, options.executor);
}

}  // namespace

Expected<OptimizeReport> optimize(Mesh& mesh, const OptimizeOptions& options, const Observer& observer) {
  Run run(options, observer);
  OptimizeReport& report = run.report;
  const bool for_accuracy = options.objective == Objective::accuracy;
  const std::optional<SizeField> band_field = field_of_band(mesh, options);
  const bool ready = is_ready_for_accuracy(mesh, options);
  auto done = ready ? not_lowered(mesh, options, band_field) : lowered(mesh, options, band_field, run);
  if (!done) return done.error();
  auto& [best, settings] = *done;
  std::optional<AccuracySizes> sizes;
  if (for_accuracy) {
    sizes.emplace(mesh, options.size_field, options.executor);
    const bool goes_on = !run.stopped_by_caller() && report.stopped != Stopped::hidden;
    if (goes_on) best.sweep = AccuracyDriver(best.work, settings, run, *sizes).optimize(best.sweep);
  }
  Recorder recorder(settings.options.tracer, best.work, 1);
  recorder.begin_sweep(run.next_sweep());
  const Settings user_settings = in_user_terms(settings, best.work.frame);
  give_back(mesh, std::move(best.work), user_settings, sizes ? &*sizes : nullptr, recorder, report);
  note_edges_that_must_be_split(mesh, user_settings, report);
  if (for_accuracy) note_accuracy(mesh, user_settings, report);
  report.seconds = run.seconds();
  return std::move(report);
}

}  // namespace temper
