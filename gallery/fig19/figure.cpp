// Figure 19: the first inner iterations of the oscillating run: which vertices collapse, onto which neighbors, and how
// little those move afterwards.
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/domain.hpp"
#include "experiments/line_search.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/numbers.hpp"
#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/patch_test.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"

namespace temper::gallery::fig19 {
namespace {

constexpr int kMostSweeps = 120;  // of runs that compare energies; collapses come early

constexpr int kIterations = 4;   // 0 to 3
constexpr double kLarge = 0.25;  // of the mean edge: a vertex is seen to have moved

/// One collapse of the run, in numbers of the input.
struct Collapse {
  int iteration = 0;
  VertexId removed, kept;
  double gap = 0;  ///< from the E_F-optimal position of `removed` to `kept`, over the shorter link edge at `kept`
};

/// The mesh on which event number `at` acts.
Replay mesh_before(const Recording& run, std::size_t at) {
  auto replayed = replay_with_vertices(dense_horseshoe(), std::span(run.events).first(at));
  return replayed ? *std::move(replayed) : Replay{};
}

/// The place to which three line searches under E_F move v: the test of Algorithm 2.
Vec2 collapse_position(const Mesh& mesh, VertexId v) {
  EnergyModel model;
  model.kind = EnergyKind::F;
  const std::vector<LineSearch> searches = line_searches(mesh, model, v);
  return searches.empty() ? mesh.position(v) : searches.back().to;
}

Collapse describe(const Recording& run, std::size_t at) {
  const TraceEvent& event = run.events[at];
  const Replay now = mesh_before(run, at);
  // Vertices that a replay has kept have the input's numbers until the mesh is made compact.
  const auto local = [&](VertexId input) {
    if (now.vertices.empty()) return input;
    const auto found = std::ranges::find(now.vertices, input);
    return VertexId(static_cast<std::size_t>(found - now.vertices.begin()));
  };
  const Vec2 best = collapse_position(now.mesh, local(event.vertex));
  const auto position = [&](VertexId input) { return now.mesh.position(local(input)); };
  const auto distance = [&](VertexId input) { return length(position(input) - best); };
  const auto nearest = std::ranges::min_element(event.link, {}, distance);
  const std::size_t n = event.link.size(), i = static_cast<std::size_t>(nearest - event.link.begin());
  const double shorter = std::min(length(position(event.link[(i + 1) % n]) - position(*nearest)),
                                  length(position(event.link[(i + n - 1) % n]) - position(*nearest)));
  return {event.sweep - 1, event.vertex, *nearest, distance(*nearest) / shorter};
}

/// The collapses of the first iterations of a run.
std::vector<Collapse> collapses_of(const Recording& run) {
  std::vector<Collapse> list;
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    if (run.events[i].kind == EventKind::collapse && run.events[i].sweep <= kIterations) {
      list.push_back(describe(run, i));
    }
  }
  return list;
}

const std::vector<Collapse>& shown_collapses() {
  static const std::vector<Collapse> list = collapses_of(oscillating_run());
  return list;
}

std::string panel(int iteration) {
  const Moment& m = oscillating_run().begin_of(iteration);
  MeshPicture picture;
  picture.title = "iteration " + std::to_string(iteration) + ": " + std::to_string(m.mesh.n_vertices()) +
                  " vertices, E = " + digits(m.energy);
  for (const Collapse& c : shown_collapses()) {
    if (c.iteration == iteration - 2) add_mark(picture, m, c.kept, MarkColor::kept_long_before);
    if (c.iteration == iteration - 1) add_mark(picture, m, c.kept, MarkColor::kept_before);
    if (c.iteration != iteration) continue;
    add_mark(picture, m, c.kept, MarkColor::kept);
    add_mark(picture, m, c.removed, MarkColor::removed);
  }
  return mesh_picture_svg(m.mesh, picture);
}

Picture panels() {
  std::vector<std::string> svgs;
  for (int i = 0; i < kIterations; ++i) svgs.push_back(panel(i));
  return {
      "fig19", grid_svg(svgs, 2),
      "The meshes with which inner iterations 0 to 3 begin, and their duals. Red: vertices that the iteration "
      "removes, because their E_F-optimal position nearly meets the purple neighbor. The purple vertex is green one "
      "iteration later and dark green after two."};
}

/// The distance that a vertex of the input goes in an iteration, over the mean length of its edges at the end of it;
/// nothing when it has been removed by then.
std::optional<double> relative_displacement(const Recording& run, VertexId input, int iteration) {
  const Moment &from = run.begin_of(iteration), &to = run.begin_of(iteration + 1);
  const VertexId before = from.find(input), after = to.find(input);
  if (!before.valid() || !after.valid()) return std::nullopt;
  double sum = 0;
  std::size_t edges = 0;
  const Vec2 p = to.mesh.position(after);
  for (const HalfedgeId h : to.mesh.star(after)) {
    sum += length(to.mesh.position(to.mesh.target(h)) - p);
    ++edges;
  }
  return length(p - from.mesh.position(before)) * static_cast<double>(edges) / sum;
}

Table table() {
  Table t{
      "The collapses of iterations 0 to 3. Gap: from the removed vertex's E_F-optimal position to the kept one, over "
      "the shorter of the two edges beside it (the rule asks for less than 0.1). Moved: how far the kept vertex goes "
      "in the iteration itself and in the next two, over the mean length of its edges.",
      {"iteration", "removed", "kept", "on the boundary", "gap", "moved", "one later", "two later"},
      {}};
  const Recording& run = oscillating_run();
  for (const Collapse& c : shown_collapses()) {
    const auto moved = [&](int later) {
      const auto distance = relative_displacement(run, c.kept, c.iteration + later);
      return distance ? digits(*distance, 2) : std::string("removed");
    };
    t.rows.push_back({std::to_string(c.iteration), digits(std::size_t{c.removed.index}),
                      digits(std::size_t{c.kept.index}), run.begin_of(0).mesh.is_boundary(c.kept) ? "yes" : "no",
                      digits(c.gap, 2), moved(0), moved(1), moved(2)});
  }
  return t;
}

/// Displacements of kept inner vertices in the iteration after their collapse.
struct Stability {
  std::vector<double> after_first;  ///< collapses of iteration 0
  std::vector<double> after_later;
  std::vector<double> gaps;  ///< of all collapses
  std::size_t runs = 0;
  std::size_t removed = 0;  ///< kept vertices that collapsed themselves in the next iteration
};

void add(const Recording& run, Stability& s) {
  const Mesh& input = run.begin_of(0).mesh;
  ++s.runs;
  for (const Collapse& c : collapses_of(run)) {
    s.gaps.push_back(c.gap);
    if (input.is_boundary(c.kept)) continue;
    if (const auto moved = relative_displacement(run, c.kept, c.iteration + 1)) {
      (c.iteration == 0 ? s.after_first : s.after_later).push_back(*moved);
    } else {
      ++s.removed;
    }
  }
}

Stability stability(Effort effort) {
  Stability s;
  for (const VertexOrder& order : vertex_orders(effort == Effort::full ? 12 : 0)) {
    OptimizeOptions options = positions_and_collapses();
    visit_in(order, options);
    options.paper.outer = 1;
    add(record(dense_horseshoe(), options, Keep::sweeps), s);
  }
  return s;
}

std::size_t count_large(const std::vector<double>& moved) {
  return static_cast<std::size_t>(std::ranges::count_if(moved, [](double d) { return d > kLarge; }));
}

Claim kept_vertices_are_stable() {
  Stability s;
  add(oscillating_run(), s);
  std::vector<double> moved = s.after_first;
  moved.insert(moved.end(), s.after_later.begin(), s.after_later.end());
  const double most = moved.empty() ? 1 : std::ranges::max(moved);
  return {"19",
          "After a collapse the next position step makes no large changes: the kept vertex is stable.",
          "the green and dark green vertices stay in place",
          digits(moved.size()) + " kept inner vertices move by at most " + digits(most, 2) +
              " of their mean edge in the next iteration; " + digits(s.removed) + " collapse themselves",
          !moved.empty() && most < kLarge,
          "The pictured run; less than " + digits(kLarge, 2) +
              " was asked for. Vertices on the boundary cannot move and do not count."};
}

Claim stable_in_any_order(const Stability& s) {
  constexpr double kSeldom = 0.1;  // of all cases
  const std::size_t all = s.after_first.size() + s.after_later.size();
  const std::size_t early = count_large(s.after_first), late = count_large(s.after_later);
  return {"19",
          "After a collapse the kept vertex stays, whatever the order in which vertices are visited.",
          "one run is shown",
          digits(early + late) + " of " + digits(all) + " kept inner vertices move by more than " + digits(kLarge, 2) +
              " of their mean edge in the next iteration, with " + digits(s.runs) + " vertex orders; medians " +
              digits(median(s.after_first), 2) + " after collapses of iteration 0, " +
              digits(median(s.after_later), 2) + " after later ones",
          all > 0 && static_cast<double>(early + late) <= kSeldom * static_cast<double>(all),
          digits(early) + " of these follow a collapse of iteration 0 (" + digits(s.after_first.size()) +
              " cases), on a mesh that is far from optimal still, and " + digits(late) + " of " +
              digits(s.after_later.size()) + " a later one. In " + digits(s.removed) +
              " more the kept vertex itself collapsed next.",
          Author::temper};
}

Claim collapses_meet_the_rule(const Stability& s) {
  const double widest = s.gaps.empty() ? 1 : std::ranges::max(s.gaps);
  return {"19",
          "A vertex is removed where its E_F-optimal position nearly meets a neighbor.",
          "within 0.1 of the shorter edge beside that neighbor",
          digits(s.gaps.size()) + " collapses; the widest gap is " + digits(widest, 2),
          !s.gaps.empty() && widest < 0.1,
          "Each was repeated by line searches on the mesh as it was at that moment, which replaying the run up to it "
          "gives."};
}

/// Collapses of runs whose positions an energy moves, one count for each vertex order.
std::vector<std::size_t> collapses_under(EnergyKind energy, Effort effort) {
  std::vector<std::size_t> counts;
  for (const VertexOrder& order : vertex_orders(effort == Effort::full ? 7 : 0)) {
    OptimizeOptions options = positions_and_collapses();
    options.energy = energy;
    options.paper.outer = 3;
    options.max_sweeps = kMostSweeps;
    visit_in(order, options);
    counts.push_back(all_of(removals(record(dense_horseshoe(), options, Keep::outer))).size());
  }
  return counts;
}

Claim collapses_easily(Effort effort) {
  const std::vector<std::size_t> dt = collapses_under(EnergyKind::dT, effort),
                                 bp = collapses_under(EnergyKind::BP, effort);
  std::size_t sum_dt = 0, sum_bp = 0, more = 0, fewer = 0;
  for (std::size_t i = 0; i < dt.size(); ++i) {
    sum_dt += dt[i], sum_bp += bp[i];
    more += dt[i] > bp[i], fewer += dt[i] < bp[i];
  }
  return {"7 Conclusion",
          "Under E_∂T collapses by the short-edge rule happen more easily than under E_BP.",
          "more easily",
          digits(sum_dt) + " against " + digits(sum_bp) + " collapses; more in " + digits(more) + " of " +
              digits(dt.size()) + " vertex orders, fewer in " + digits(fewer),
          sum_dt > sum_bp && more > fewer,
          "Positions alone, E_F says where a vertex would go, three outer iterations of at most " +
              std::to_string(kMostSweeps) + " sweeps together."};
}

}  // namespace

Page make(Effort effort) {
  const Stability s = stability(effort);
  return {{panels()},
          {table()},
          {kept_vertices_are_stable(), stable_in_any_order(s), collapses_meet_the_rule(s), collapses_easily(effort)}};
}

}  // namespace temper::gallery::fig19
