#include "optimize/report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/sum.hpp"
#include "base/text.hpp"
#include "energy/whole_mesh.hpp"
#include "mesh/curve.hpp"
#include "mesh/predicates.hpp"
#include "optimize/driver.hpp"
#include "optimize/lengths.hpp"
#include "optimize/rank.hpp"
#include "optimize/rounding.hpp"
#include "optimize/step/freedom.hpp"
#include "temper/necessity.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

std::string count_of(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// The part of the triangles that is not well-centered.
double bad_part(const Mesh& mesh, std::size_t bad) {
  return static_cast<double>(bad) / static_cast<double>(mesh.n_triangles());
}

/// What sizes are compared with; the input's own are seen until it is replaced.
SizeField field_of(const Mesh& input, const Settings& settings) {
  if (settings.size_field) return *settings.size_field;
  return settings.options.size_field ? *settings.options.size_field
                                     : input_size_field_of(input, settings.hooks.executor);
}

/// The sentences of a report, in the order in which they are told.
class Notes {
 public:
  Notes(const Mesh& mesh, const Settings& settings, OptimizeReport& report)
      : mesh_(mesh), settings_(settings), options_(settings.options), report_(report) {}

  void tell(const RunFacts& facts);
  void tell_input_is_returned(const RunFacts& facts, bool flipped);
  void tell_if_more_are_bad(double bad_before);
  void tell_what_is_not_regular();
  void tell_sizes();
  void tell_energy();
  void tell_edges_that_must_be_split(std::size_t bad);
  void tell_corners_that_stay(std::size_t bad);
  void tell_accuracy(std::size_t bad);

 private:
  void add(std::string note) { report_.notes.push_back(std::move(note)); }
  void tell_input_flips(std::size_t flips);
  void tell_cuts(const BoundaryCuts& cuts);
  [[nodiscard]] std::size_t count_thin() const;
  [[nodiscard]] std::string name_of(VertexId v) const;

  const Mesh& mesh_;
  const Settings& settings_;
  const OptimizeOptions& options_;
  OptimizeReport& report_;
};

void Notes::tell(const RunFacts& facts) {
  if (facts.stays_uncut) {
    add("the boundary and lines were not split: more triangles would be left that are not well-centered");
  } else if (facts.boundary_cuts) {
    tell_cuts(*facts.boundary_cuts);
  }
  tell_input_flips(facts.input_flips);
  if (facts.weights_shrunk) add("weights left edges uncrossed that a barrier needs crossed: all were made smaller");
  if (facts.energy_rose) add("the energy rose in the last sweeps; the mesh with the least one is returned");
}

void Notes::tell_input_flips(std::size_t flips) {
  if (flips > 0) add(count_of(flips, "edge", "edges") + " of the input flipped to make it regular");
}

void Notes::tell_cuts(const BoundaryCuts& cuts) {
  const auto rounded = [](double ratio) { return to_text(std::round(100 * ratio) / 100); };
  if (cuts.vertices > 0) {
    add(count_of(cuts.vertices, "vertex", "vertices") +
        " inserted on the boundary and on lines: edges that meet there differed in length by a factor of " +
        rounded(cuts.ratio_before) + ", now " + rounded(cuts.ratio_after));
  }
  if (cuts.conflicts > 0) {
    add(std::to_string(cuts.conflicts) + " of these split edges that left their dual no place to cross, or hardly one");
  }
  if (cuts.inside > 0) {
    add(count_of(cuts.inside, "vertex", "vertices") +
        " inserted in triangles whose corners all were on the boundary or on lines");
  }
  if (cuts.refused > 0) {
    add(std::to_string(cuts.refused) +
        " cuts of the boundary were not made: coordinates are too coarse there, or weights would hide a vertex");
  }
}

/// What else the run did is not in the mesh.
void Notes::tell_input_is_returned(const RunFacts& facts, bool flipped) {
  if (flipped) tell_input_flips(facts.input_flips);
  add(flipped ? "no better mesh was found: the input is returned, its edges flipped to be regular"
              : "no better mesh was found: the input is returned as it was");
}

/// HOT energies do not ask how many triangles are well-centered. `bad_before`: part of the input's.
void Notes::tell_if_more_are_bad(double bad_before) {
  const auto percent = [](double part) { return to_text(std::round(1000 * part) / 10) + " %"; };
  const double bad = bad_part(mesh_, count_bad(mesh_, settings_.hooks.executor));
  if (bad > bad_before) {
    add(percent(bad) + " of the triangles are not well-centered, " + percent(bad_before) + " of the input's: energy " +
        std::string(settings_.energy.name) + " does not ask for that, energy BP does");
  }
}

/// Hidden vertices that are kept keep edges from being regular.
void Notes::tell_what_is_not_regular() {
  if (options_.paper.hidden != HiddenPolicy::keep) return;
  const std::size_t edges = count_non_regular_edges(mesh_, false, settings_.hooks.executor);
  if (edges > 0)
    add(count_of(edges, "edge is", "edges are") + " not regular, since `hidden=keep` keeps hidden vertices");
}

void Notes::tell_sizes() {
  const SizeReport& before = report_.size.before;
  if (options_.size_band && before.band() > *options_.size_band) {
    add("the input is outside of its size band: sizes are up to " + to_text(before.band()) +
        " times off the size field, and what is outside can only come nearer to it");
  }
  if (before.outside > 0) {
    add("the size field does not reach " + count_of(before.outside, "vertex", "vertices") +
        " of the input, where its nearest value was taken");
  }
}

void Notes::tell_energy() {
  if (!std::isfinite(report_.final_energy)) {
    add("the energy is infinite: on some edges weights differ by more than the squared length, and this run could not "
        "change that");
  }
  if (report_.final_energy < 0) {
    add("the energy is negative: HOT has no lower bound in the weights; energies T and BP have one");
  }
}

std::string Notes::name_of(VertexId v) const {
  const VertexId number = report_.vertices.empty() ? v : report_.vertices[v];
  if (!number.valid()) return "(" + to_text(mesh_.position(v).x) + ", " + to_text(mesh_.position(v).y) + ")";
  return settings_.hooks.names != nullptr ? settings_.hooks.names->point(number.index)
                                          : InputNames().point(number.index);
}

/// Triangles that no optimiser can make well-centered, whatever it tries.
void Notes::tell_edges_that_must_be_split(std::size_t bad) {
  if (!settings_.energy.barrier || bad == 0 || mesh_.space().kind() != SpaceKind::plane) return;
  if (options_.paper.inversion == Inversion::allow && count_inverted(mesh_) > 0) return;  // no inside to see through
  const std::vector<EdgeConflict> edges = edges_that_must_be_split(mesh_);
  if (edges.empty()) return;
  const HalfedgeId worst = edges.front().edge;
  add(count_of(edges.size(), "edge of the boundary or of lines has", "edges of the boundary or of lines have") +
      " to be split, or a vertex near it moved, before any mesh can be well-centered here, first the one from " +
      name_of(mesh_.origin(worst)) + " to " + name_of(mesh_.target(worst)) + ": explain tells more" +
      (options_.boundary == BoundaryVertices::split ? "" : ", and `boundary=split` splits them"));
}

/// Bad triangles that nothing can reshape, where another option would let a corner move.
void Notes::tell_corners_that_stay(std::size_t bad) {
  const bool moves = options_.unknowns != Unknowns::weights && settings_.energy.barrier;
  if (bad == 0 || !moves || mesh_.space().kind() != SpaceKind::plane) return;
  OptimizeOptions sliding = options_;
  sliding.boundary = BoundaryVertices::slide;
  sliding.interfaces = InterfaceVertices::sliding;
  std::size_t stuck = 0;
  bool along_boundary = false, along_lines = false;
  for (const TriangleId t : mesh_.triangles()) {
    if (inlined::is_well_centered(mesh_, t)) continue;
    const auto corners = mesh_.corners(t);
    const auto is = [&](Mobility m, const OptimizeOptions& o) {
      return [this, m, &o](VertexId v) { return mobility(mesh_, v, o) == m; };
    };
    if (!std::all_of(corners.begin(), corners.end(), is(Mobility::fixed, options_))) continue;
    const auto slides = is(Mobility::sliding, sliding);
    if (std::none_of(corners.begin(), corners.end(), slides)) continue;
    ++stuck;
    for (const VertexId v : corners) (mesh_.is_boundary(v) ? along_boundary : along_lines) |= slides(v);
  }
  if (stuck == 0) return;
  add("all corners of " + count_of(stuck, "triangle", "triangles") + " that " + (stuck == 1 ? "is" : "are") +
      " not well-centered have to stay: " + (along_boundary ? "`boundary=slide`" : "") +
      (along_boundary && along_lines ? " and " : "") + (along_lines ? "`interfaces=sliding`" : "") +
      " would let some of them move along straight lines");
}

/// Triangles without the margin, the bad ones included.
std::size_t Notes::count_thin() const {
  return static_cast<std::size_t>(blockwise_sum(mesh_.n_triangles(), settings_.hooks.executor, [&](std::size_t i) {
    return triangle_margin(mesh_, TriangleId(i)) > settings_.accuracy.margin ? 0.0 : 1.0;
  }));
}

void Notes::tell_accuracy(std::size_t bad) {
  if (bad > 0) {
    add(count_of(bad, "triangle is", "triangles are") +
        " not well-centered: vertices there were not moved for accuracy");
  }
  if (const std::size_t thin = options_.accuracy.margin ? count_thin() : 0; thin > bad) {
    add(count_of(thin - bad, "triangle is", "triangles are") + " well-centered by no more than " +
        to_text(settings_.accuracy.margin) + " of an edge");
  }
  const std::size_t lacking = triangles_lacking_length(mesh_, settings_.accuracy).size();
  if (lacking > 0) {
    add("at " + count_of(lacking, "triangle", "triangles") +
        " edges or duals are shorter than `min_edge` and `min_dual` ask for" +
        (options_.repair == Repair::vertices ? "" : ": `repair=vertices` may find other connectivities"));
  }
  if (options_.error.model == nullptr) {
    add("energy of the accuracy objective, edges taken absolute: " + to_text(report_.initial_energy) + " before, " +
        to_text(report_.final_energy) + " after");
  } else if (std::isfinite(report_.initial_energy)) {
    add("errors of what the mesh is for, over smooth fields: now " +
        to_text(std::round(1000 * report_.final_energy / report_.initial_energy) / 1000) + " times those of the input");
  } else {
    add("what the mesh is for could not be solved on the input: its matrix was not positive definite");
  }
}

/// Vertices that Lawson's algorithm leaves without a power cell; none where it has no meaning, among inverted
/// triangles.
std::vector<VertexId> hidden_vertices_of(const Mesh& mesh, const Settings& settings) {
  const bool keeps = settings.options.paper.hidden == HiddenPolicy::keep;
  if (!keeps || count_non_regular_edges(mesh, false, settings.hooks.executor) == 0 || count_inverted(mesh) > 0)
    return {};
  Mesh copy = mesh;
  return restore_regularity(copy).hidden;
}

/// A mesh that may be given back.
struct Result {
  Mesh mesh;
  IdVector<VertexId, VertexId> vertices;  ///< of OptimizeReport
  Rank rank;
  SizeReport size;
};

/// `settings`: in the user's units. What the user's numbers would scatter over memory is measured before it has them;
/// what is no longer needed is gone before the next is measured.
Result result_of(const Mesh& input, WorkingCopy work, const Settings& settings, std::optional<AccuracySizes> sizes) {
  Executor* const executor = settings.hooks.executor;
  Result result;
  const bool for_accuracy = sizes.has_value(), scattered = is_scattered(input);
  VertexSizes own;
  if (for_accuracy) own = scattered ? sizes->in_user_units(work, executor) : sizes->in_user_terms(work, executor);
  sizes.reset();
  const auto measure = [&](const Mesh& mesh, const IdVector<VertexId, VertexId>& numbers) {
    result.rank = rank(mesh, settings, for_accuracy ? &own : nullptr);
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
    result.mesh = std::move(work).in_user_terms(executor);  // what knew the order takes room no longer
    take_back_rounding(input, result.vertices, result.mesh);
    measure(result.mesh, result.vertices);
  }
  return result;
}

/// The input with its edges flipped as every attempt begins, for a run that found nothing better in so many sweeps.
WorkingCopy made_regular(const Mesh& mesh, Settings settings, int sweeps) {
  WorkingCopy work(mesh, settings.options.paper.order, settings.hooks.executor);
  const Observer nobody;
  Run unheard(settings.options, nobody);
  unheard.report.sweeps = sweeps;
  Driver(work, settings, unheard).make_regular();
  return work;
}

/// Vertices of the input that are gone, and new ones that are there.
void count_changes(const Mesh& input, OptimizeReport& report) {
  report.vertices_removed = report.vertices_inserted = 0;
  if (report.vertices.empty()) return;
  for (const VertexId v : report.vertices) report.vertices_inserted += v.valid() ? 0 : 1;
  report.vertices_removed = input.n_vertices() - (report.vertices.size() - report.vertices_inserted);
}

/// Says whether flips alone make an input that is returned better: what hidden vertices keep from being regular stays
/// so.
bool lacks_flips(const Counts& input, const Settings& settings, const RunFacts& facts) {
  const OptimizeOptions& o = settings.options;
  if (o.flips == Flips::none || (o.paper.hidden == HiddenPolicy::keep && facts.input_flips == 0)) return false;
  return input.non_regular > 0;
}

}  // namespace

std::string_view name(Objective objective) {
  constexpr std::string_view kNames[] = {"energy", "accuracy", "error"};
  return kNames[static_cast<std::size_t>(objective)];
}

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

InputMeasures measure_input(const Mesh& mesh, const NearbyCopy& near, const Settings& settings) {
  InputMeasures measures;
  measures.counts = count(near.mesh(), settings);
  Executor* const executor = settings.hooks.executor;
  if (!settings.size_field && !settings.options.size_field) {
    measures.size = measure_size(near.mesh(), field_of(near.mesh(), settings), executor);
    return measures;
  }
  IdVector<VertexId, VertexId> numbers;
  if (!near.is_original()) {
    for (const VertexId v : near.mesh().vertices()) numbers.push_back(near.original(v));
  }
  measures.size = measure_size(near.mesh(), field_of(mesh, settings), executor, numbers);
  return measures;
}

Rank rank_input(const NearbyCopy& near, const Counts& counts, const Settings& settings, const AccuracySizes& sizes) {
  if (near.is_original()) return rank(near.mesh(), counts, settings, &sizes.of_input());
  VertexSizes there(near.mesh().n_vertices());
  for (const VertexId v : near.mesh().vertices()) there[v] = sizes.of_input()[near.original(v)];
  return rank(near.mesh(), counts, settings, &there);
}

void give_back(Mesh& mesh, Candidate best, Settings settings, const InputMeasures& of_input,
               std::optional<AccuracySizes> sizes, Run& run) {
  OptimizeReport& report = run.report;
  Recorder recorder(settings.hooks.tracer, best.work, 1);
  recorder.begin_sweep(run.next_sweep());
  const Settings in_frame = settings;
  settings.model = in_user_units(settings.model, best.work.frame);
  const bool for_accuracy = sizes.has_value();
  Result result = result_of(mesh, std::move(best.work), settings, std::move(sizes));
  const Rank before = of_input.rank ? *of_input.rank : rank(mesh, of_input.counts, settings, nullptr);
  report.size.before = report.size.after = of_input.size;
  report.initial_energy = before.energy;
  const std::optional<double> bad_before =
      settings.energy.barrier ? std::nullopt : std::optional(bad_part(mesh, of_input.counts.bad));
  // Flips that make the input regular come before all else that may be better or worse.
  const bool may_be_better = before < result.rank || result.rank.bad > 0 || result.rank.non_regular > 0;
  const bool flips = may_be_better && lacks_flips(of_input.counts, settings, run.facts);
  Result input;
  input.rank = before;
  if (flips) {
    Settings silent = in_frame;
    silent.hooks.tracer = {};
    sizes.reset();
    if (for_accuracy)
      sizes.emplace(NearbyCopy(mesh, settings.hooks.executor), settings.options.size_field, settings.hooks.executor);
    input = result_of(mesh, made_regular(mesh, silent, report.sweeps), settings, std::move(sizes));
  }
  const bool worse = input.rank < result.rank;
  if (worse) {
    recorder.returned_to(-1);
    if (flips && recorder.on()) static_cast<void>(made_regular(mesh, in_frame, report.sweeps));
    result = std::move(input);
  }
  report.vertices = std::move(result.vertices);
  report.final_energy = result.rank.energy;
  count_changes(mesh, report);
  if (!worse || flips) {
    report.size.after = result.size;
    mesh = std::move(result.mesh);
  }
  report.hidden = hidden_vertices_of(mesh, settings);

  Notes notes(mesh, settings, report);
  if (worse) {
    notes.tell_input_is_returned(run.facts, flips);
  } else {
    notes.tell(run.facts);
  }
  if (bad_before) notes.tell_if_more_are_bad(*bad_before);
  notes.tell_what_is_not_regular();
  notes.tell_sizes();
  notes.tell_energy();
  notes.tell_corners_that_stay(result.rank.bad);
  notes.tell_edges_that_must_be_split(result.rank.bad);
  if (for_accuracy)
    notes.tell_accuracy(settings.energy.barrier ? result.rank.bad : count_bad(mesh, settings.hooks.executor));
  report.seconds = run.seconds();
}

}  // namespace temper
