#include "optimize/result/notes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/sum.hpp"
#include "base/text.hpp"
#include "energy/whole_mesh.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/run/changes.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/step/dofs.hpp"
#include "temper/detail/necessity.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// The sentences of a report, in their order.
class Notes {
 public:
  Notes(const Mesh& mesh, const Settings& settings, OptimizeReport& report)
      : mesh_(mesh), settings_(settings), options_(settings.options), report_(report) {}

  void add(std::string note) { report_.notes.push_back(std::move(note)); }

  void note_facts(const RunFacts& facts) {
    if (facts.stays_unsplit) {
      add("the boundary and lines were not split: more triangles would be left that are not well-centered");
    } else if (facts.boundary_splits) {
      note_splits(*facts.boundary_splits);
    }
    note_input_flips(facts.input_flips);
    if (facts.weights_shrunk) add("weights left edges uncrossed that a barrier needs crossed: all were made smaller");
    if (facts.energy_rose) add("the energy rose in the last sweeps; the mesh with the least one is returned");
  }

  /// No other change of the run is in the returned mesh.
  void note_input_is_returned(const RunFacts& facts, bool flipped) {
    if (flipped) note_input_flips(facts.input_flips);
    add(flipped ? "no better mesh was found: the input is returned, its edges flipped to be regular"
                : "no better mesh was found: the input is returned as it was");
  }

  void note_limits_are_met() {
    const char* const limits = options_.guard.client == Client::dflowfm
                                   ? "the limits of D-Flow FM (orthogonality 0.01, flow links 0.1)"
                                   : "the limits of the target (no obtuse triangles, no short edges)";
    add(std::string("the input meets ") + limits + ": it comes back as it was");
  }

  void note_violations(std::size_t n) {
    if (n == 0) return;
    add(settings_.criterion == Criterion::well_centered
            ? count_of(n, "triangle is", "triangles are") + " still bad (not well-centered)"
            : count_of(n, "dual of an edge still violates", "duals of edges still violate") +
                  " what the target needs: explain tells more");
  }

  /// Measured errors on structured grids may rise.
  void note_errors(double ratio, bool input_returned) {
    const std::string times = to_text(std::round(1000 * ratio) / 1000);
    const bool is_any = criterion_of(options_.scheme) == Criterion::well_centered;
    const std::string good = is_any ? "the input is well-centered" : "the input has all that the target needs";
    add(input_returned ? good + ", and a change would make measured errors up to " + times + " times as large"
                       : "measured errors are up to " + times +
                             " times the input's: where errors of neighbors cancel, "
                             "a change of the mesh makes some of them larger");
  }

  /// HOT energies may make more triangles bad. `bad_before`: bad part of the input's triangles.
  void note_if_more_are_bad(double bad_before) {
    const auto percent = [](double part) { return to_text(std::round(1000 * part) / 10) + " %"; };
    const double bad = bad_part(mesh_.n_triangles(), count_bad(mesh_, settings_.executor()));
    if (bad > bad_before) {
      add(percent(bad) + " of the triangles are bad (not well-centered), " + percent(bad_before) +
          " of the input's: energy " + std::string(settings_.energy().name) + " does not ask for that, energy BP does");
    }
  }

  /// Because of hidden vertices in the mesh, some edges cannot be regular.
  void note_what_is_not_regular() {
    if (!settings_.policy.keeps_hidden()) return;
    const std::size_t edges = count_non_regular_edges(mesh_, false, settings_.executor());
    if (edges > 0)
      add(count_of(edges, "edge is", "edges are") + " not regular, since `hidden=keep` keeps hidden vertices");
  }

  void note_sizes() {
    const SizeReport& before = report_.size.before;
    if (options_.size_band && before.band() > *options_.size_band) {
      add("the input is outside of its size band: sizes are up to " + to_text(before.band()) +
          " times off the size field, and what is outside can only come nearer to it");
    }
    if (before.vertices_outside_field > 0) {
      add("the size field does not reach " + count_of(before.vertices_outside_field, "vertex", "vertices") +
          " of the input, where its nearest value was taken");
    }
  }

  void note_energy() {
    if (!std::isfinite(report_.objective_after)) {
      add("the energy is infinite: on some edges weights differ by more than the squared length, and this run could "
          "not change that");
    }
    if (report_.objective_after < 0) {
      add("the energy is negative: HOT has no lower bound in the weights; energies T and BP have one");
    }
  }

  /// Notes triangles that no optimizer can make well-centered.
  void note_edges_that_must_be_split(std::size_t bad) {
    if (!settings_.energy().barrier || bad == 0 || mesh_.space().kind() != SpaceKind::plane) return;
    if (settings_.policy.allows_inversion() && count_inverted(mesh_) > 0) return;  // no well-defined inside
    const std::vector<EdgeConflict> edges = edges_that_must_be_split(mesh_);
    if (edges.empty()) return;
    const HalfedgeId worst = edges.front().edge;
    add(count_of(edges.size(), "edge of the boundary or of lines has", "edges of the boundary or of lines have") +
        " to be split, or a vertex near it moved, before any mesh can be well-centered here, first the one from " +
        name_of(mesh_.origin(worst)) + " to " + name_of(mesh_.target(worst)) + ": explain tells more" +
        (options_.boundary == BoundaryVertices::split ? "" : ", and `boundary=split` splits them"));
  }

  /// Notes bad triangles that nothing can reshape, if another option would let a corner move.
  void note_corners_that_stay(std::size_t bad) {
    const bool moves = options_.unknowns != Unknowns::weights && settings_.energy().barrier;
    if (bad == 0 || !moves || mesh_.space().kind() != SpaceKind::plane) return;
    OptimizeOptions sliding = options_;
    sliding.boundary = BoundaryVertices::slide;
    sliding.interfaces = InterfaceVertices::sliding;
    std::size_t stuck = 0;
    bool along_boundary = false, along_lines = false;
    for (const TriangleId t : mesh_.triangles()) {
      if (!is_bad(mesh_, t)) continue;
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

  void note_accuracy(std::size_t bad) {
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
    if (settings_.errors != nullptr && !std::isfinite(report_.objective_before))
      add("the equations of the scheme have no solution on the input: the matrix is not positive definite");
  }

 private:
  void note_input_flips(std::size_t flips) {
    if (flips > 0) add(count_of(flips, "edge", "edges") + " of the input flipped to make it regular");
  }

  void note_splits(const SplitCounts& cuts) {
    const auto rounded = [](double ratio) { return to_text(std::round(100 * ratio) / 100); };
    if (cuts.vertices > 0) {
      add(count_of(cuts.vertices, "vertex", "vertices") +
          " inserted on the boundary and on lines: edges that meet there differed in length by a factor of " +
          rounded(cuts.ratio_before) + ", now " + rounded(cuts.ratio_after));
    }
    if (cuts.conflicts > 0) {
      add(std::to_string(cuts.conflicts) +
          " of these split edges that left their dual no place to cross, or hardly one");
    }
    if (cuts.inside > 0) {
      add(count_of(cuts.inside, "vertex", "vertices") +
          " inserted in triangles whose corners all were on the boundary or on lines");
    }
    if (cuts.refused > 0) {
      add(count_of(cuts.refused, "edge", "edges") +
          " of the boundary or of lines could not be cut: coordinates are too coarse there, weights would hide a "
          "vertex, or there would be too many cuts for this mesh");
    }
  }

  /// Counts the triangles without the margin, bad ones included.
  [[nodiscard]] std::size_t count_thin() const {
    return static_cast<std::size_t>(blockwise_sum(mesh_.n_triangles(), settings_.executor(), [&](std::size_t i) {
      return triangle_margin(mesh_, TriangleId(i)) > settings_.accuracy.margin ? 0.0 : 1.0;
    }));
  }

  [[nodiscard]] std::string name_of(VertexId v) const {
    const VertexId number = report_.vertices.empty() ? v : report_.vertices[v];
    if (!number.valid()) return "(" + to_text(mesh_.position(v).x) + ", " + to_text(mesh_.position(v).y) + ")";
    return settings_.hooks.names != nullptr ? settings_.hooks.names->point(number.index)
                                            : InputNames().point(number.index);
  }

  const Mesh& mesh_;
  const Settings& settings_;
  const OptimizeOptions& options_;
  OptimizeReport& report_;
};

}  // namespace

void add_notes(const Mesh& mesh, const Settings& settings, const RunFacts& facts, const Ending& ending,
               OptimizeReport& report) {
  Notes notes(mesh, settings, report);
  if (ending.returns_input) {
    notes.note_input_is_returned(facts, ending.flips_input);
  } else {
    notes.note_facts(facts);
  }
  if (facts.meets_limits) notes.note_limits_are_met();
  if (facts.meets_criterion) notes.add(criterion_is_met_note(settings.criterion));
  if (facts.places_left > 0)
    notes.add(whole_mesh_note(count_of(facts.places_left, "triangle", "triangles"), facts.many_are_bad));
  if (settings.changes_least() && !facts.meets_criterion) notes.add(changes_note(*report.changed));
  if (settings.counts_violations()) notes.note_violations(count_violations(mesh, settings));
  if (facts.error_ratio) notes.note_errors(*facts.error_ratio, ending.returns_input);
  if (facts.gave_up) {
    notes.add(
        "in the metric of the tensor most triangles stay bad, so that all vertices stay where they were; "
        "expected triangles that are long along the larger conductivity");
  }
  if (has_quadrilaterals(mesh)) notes.add("the mesh has quadrilaterals: their corners and all weights are unchanged");
  const bool barrier = settings.energy().barrier;
  if (!barrier) notes.note_if_more_are_bad(ending.bad_part_before);
  notes.note_what_is_not_regular();
  notes.note_sizes();
  notes.note_energy();
  const std::size_t bad = settings.criterion == Criterion::well_centered ? ending.bad : 0;
  notes.note_corners_that_stay(bad);
  notes.note_edges_that_must_be_split(bad);
  if (settings.guard != nullptr && bad > 0 && !facts.meets_limits)
    notes.add(
        "the guard may keep triangles from becoming well-centered: a larger `guard_areas` leaves more room, except for "
        "D-Flow FM, where `guard=none` does");
  if (settings.lacks_discretization_error) {
    notes.add(
        "the objective was accuracy, not the error of the solver: this run had no model of that error; builds with "
        "Eigen have one, temper::solvers() in C++");
  }
  if (facts.lacks_programs && bad > 0) {
    notes.add(
        "repairs had no solver of linear programs, which may find weights for triangles that are left; builds with Clp "
        "have one, temper::solvers() in C++");
  }
  if (ending.for_accuracy && !settings.changes_least())
    notes.note_accuracy(barrier ? ending.bad : count_bad(mesh, settings.executor()));
}

}  // namespace temper
