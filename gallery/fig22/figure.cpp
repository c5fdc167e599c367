// Figure 22: from the last mesh of figure 20, searches that stop at the point of flipping, flip, and go on. The mesh
// converges where the oscillation had none to converge to; and what other limits would have done.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/domain.hpp"
#include "experiments/mesh_picture.hpp"
#include "experiments/numbers.hpp"
#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/regularity.hpp"

namespace temper::gallery::fig22 {
namespace {

constexpr double kPaperEnergy = 3.29, kNearPaper = 0.01;  // relative: which vertices have collapsed before is open
constexpr const char* kCoincident = "#38b6ff";
constexpr const char* kKite = "#dcecf9";

/// Flips as soon as they are due, searches limited.
OptimizeOptions limited(FlipLimit limit, double overshoot) {
  OptimizeOptions options = positions_and_collapses();
  options.paper.outer = 0;
  options.flips = Flips::immediate;
  options.paper.flip_limit = limit;
  options.paper.overshoot = overshoot;
  return options;
}

const Recording& converged_run() {
  static const Recording run = record(oscillating_mesh(), limited(FlipLimit::after, 1.1), Keep::sweeps);
  return run;
}

/// On from the converged mesh, with no tolerance: sweeps until the energy falls no more at all.
Recording run_on(FlipLimit limit) {
  OptimizeOptions options = limited(limit, 1.1);
  options.paper.stopping = StoppingRule::relative;
  options.paper.tolerance = 0;
  options.max_sweeps = 200;
  return record(converged_run().result, options, Keep::sweeps);
}

// --- kites -----------------------------------------------------------------------------------------------

/// An inner edge and the distance between the orthocenters on its two sides, over its length.
struct Kite {
  HalfedgeId edge;
  double gap = 0;
};

/// The kites of an oscillating vertex: the edge of its star or its link with the least gap.
Kite narrowest_kite(const Mesh& mesh, VertexId v) {
  Kite narrowest{{}, 1};
  for (const HalfedgeId spoke : mesh.star(v)) {
    for (const HalfedgeId e : {spoke, Mesh::next(spoke)}) {
      if (mesh.is_boundary(e)) continue;
      const double between =
          length(orthocenter_of(mesh, Mesh::triangle(e)) - orthocenter_of(mesh, Mesh::triangle(mesh.twin(e))));
      const double gap = between / length(mesh.position(mesh.target(e)) - mesh.position(mesh.origin(e)));
      if (gap < narrowest.gap) narrowest = {e, gap};
    }
  }
  return narrowest;
}

/// The converged mesh's ids of a and b: the run starts from the last mesh of figure 20.
std::array<VertexId, 2> oscillating_here() {
  const Moment& start = *oscillating_run().all(Snapshot::Moment::after_flips).back();
  const Moment& end = converged_run().moments.back();
  const auto [a, b] = oscillating_vertices();
  return {end.find(start.find(a)), end.find(start.find(b))};
}

// --- pictures --------------------------------------------------------------------------------------------

std::string converged_mesh() {
  const Mesh& mesh = converged_run().result;
  MeshPicture picture;
  picture.width = 460;
  picture.title = std::to_string(mesh.n_vertices()) + " vertices, E = " + digits(total_energy(mesh, energy_dt()));
  const char* names[] = {"a", "b"};
  const auto here = oscillating_here();
  for (std::size_t i = 0; i < here.size(); ++i) {
    const Kite kite = narrowest_kite(mesh, here[i]);
    if (kite.edge.valid()) {
      for (const HalfedgeId side : {kite.edge, mesh.twin(kite.edge)}) {
        picture.shades.push_back({Mesh::triangle(side), kKite});
        picture.marks.push_back({orthocenter_of(mesh, Mesh::triangle(side)), kCoincident});
      }
    }
    picture.marks.push_back({mesh.position(here[i]), MarkColor::moving, names[i]});
  }
  return mesh_picture_svg(mesh, picture);
}

Series by_sweep(const std::string& name, const std::vector<const Moment*>& moments, int first_sweep) {
  Series series{name, {}, SeriesStyle::line_markers};
  for (const Moment* m : moments) series.points.push_back({static_cast<double>(m->sweep - first_sweep), m->energy});
  return series;
}

std::vector<const Moment*> sweeps_of(const Recording& run) {
  std::vector<const Moment*> sweeps = {&run.moments.front()};
  for (const Moment* m : run.all(Snapshot::Moment::after_sweep)) sweeps.push_back(m);
  return sweeps;
}

/// The same start with flips deferred: two more rounds of the oscillation.
std::string energies_by_sweep() {
  OptimizeOptions deferred = positions_and_collapses();
  deferred.paper.outer = 2;
  const Recording oscillating = record(oscillating_mesh(), deferred, Keep::sweeps);
  std::vector<const Moment*> moments;
  for (const Moment& m : oscillating.moments) moments.push_back(&m);
  LinePlot plot;
  plot.title = "Energy by sweep from the same mesh";
  plot.x_label = "sweep";
  plot.y_label = "E_{∂T}";
  plot.series = {by_sweep("stop after the flip, flip at once", sweeps_of(converged_run()), 0),
                 by_sweep("unlimited, flips deferred", moments, 0)};
  return line_plot_svg(plot);
}

Picture mesh_and_energy() {
  return {
      "fig22", grid_svg(std::vector{converged_mesh(), energies_by_sweep()}, 2),
      "Left, the converged mesh: a and b stand where their kites (pale blue) flip, and the two orthocenters of a kite "
      "coincide (light blue). Right, the energy by sweep from the same start: searches that stop after the next flip "
      "converge, deferred flips go on to oscillate; vertical steps are flips."};
}

// --- claims on the converged mesh ------------------------------------------------------------------------

Claim converges() {
  const Recording& run = converged_run();
  const double energy = total_energy(run.result, energy_dt());
  const std::size_t not_regular = count_non_regular_edges(run.result);
  return {
      "22",
      "With searches limited by the next flip the mesh converges to energy 3.29, below both states of the oscillation.",
      "3.29 (states: 3.41 and 4.08)",
      digits(energy, 5) + " after " + std::to_string(run.report.sweeps) + " sweeps, stopped: " +
          std::string(name(run.report.stopped)) + ", " + digits(not_regular) + " edges not regular",
      run.report.stopped == Stopped::converged && not_regular == 0 &&
          std::abs(energy - kPaperEnergy) <= kNearPaper * kPaperEnergy &&
          energy < oscillation_of(oscillating_run()).low,
      "Within 1 % of the paper's. Overshoot 1.1 in the first sweep, 1.01, 1.001, … after; regularity is decided "
      "exactly."};
}

Claim stays() {
  constexpr double kSame = 1e-4;  // relative
  const Recording on = run_on(FlipLimit::after), unlimited = run_on(FlipLimit::unlimited);
  double lowest = on.moments.front().energy, highest = lowest;
  for (const Moment& m : on.moments) lowest = std::min(lowest, m.energy), highest = std::max(highest, m.energy);
  const std::size_t changed = triangles_not_in(on.moments.back(), on.moments.front()).size();
  return {"22",
          "The mesh does not oscillate.",
          "does not oscillate",
          std::to_string(on.report.sweeps) + " more sweeps: E between " + digits(lowest, 6) + " and " +
              digits(highest, 6) + ", " + digits(changed) + " triangles new",
          on.report.sweeps > 1 && highest - lowest <= kSame * lowest && changed == 0,
          "Run on from the converged mesh with the same limit, until E fell no more. Unlimited searches leave it at "
          "once: " +
              digits(unlimited.moments.back().energy, 4) + " after " + std::to_string(unlimited.report.sweeps) +
              " sweeps."};
}

Claim orthocenters_coincide() {
  constexpr double kCoincide = 1e-6;  // of the edge
  const auto here = oscillating_here();
  const Mesh& mesh = converged_run().result;
  const double a = narrowest_kite(mesh, here[0]).gap, b = narrowest_kite(mesh, here[1]).gap;
  return {
      "22",
      "a stands at the flip: the two triangles of the kite have coincident orthocenters, and either diagonal adds no "
      "energy.",
      "coincident",
      "distance of the orthocenters " + digits(a, 2) + " of the diagonal at a, " + digits(b, 2) + " at b",
      a < kCoincide && b < kCoincide,
      "The dual edge of the kite's diagonal."};
}

// --- how far past the flip ---------------------------------------------------------------------------------

struct Limit {
  std::string name;
  FlipLimit limit = FlipLimit::after;
  double overshoot = 1.1;
  bool constant = false;  ///< the same overshoot in every sweep
};

std::vector<Limit> limits() {
  return {{"before", FlipLimit::before},
          {"at", FlipLimit::at},
          {"after, 1.01 shrinking", FlipLimit::after, 1.01},
          {"after, 1.1 shrinking", FlipLimit::after, 1.1},
          {"after, 2 shrinking", FlipLimit::after, 2},
          {"after, 1.1 always", FlipLimit::after, 1.1, true},
          {"after, 2 always", FlipLimit::after, 2, true},
          {"after, 5 always", FlipLimit::after, 5, true},
          {"unlimited", FlipLimit::unlimited}};
}

/// The outcome of one policy, over vertex orders.
struct Outcome {
  std::vector<double> energies, sweeps;
  std::size_t flips = 0;
  double longest_flipping_step = 0;  ///< of those that made an edge flip
  [[nodiscard]] double spread() const { return std::ranges::max(energies) - std::ranges::min(energies); }
};

/// The longest step of the run at whose end some edge had to flip.
double longest_flipping_step(const Recording& run) {
  const Moment& start = run.moments.front();
  IdVector<VertexId, Vec2> positions(start.mesh.n_vertices());
  for (const VertexId v : start.mesh.vertices()) positions[v] = start.mesh.position(v);
  double step = 0, longest = 0;
  for (const TraceEvent& e : run.events) {
    if (e.kind == EventKind::flip) longest = std::max(longest, step);
    if (e.kind != EventKind::move) continue;
    step = length(e.point.position() - positions[e.vertex]);
    positions[e.vertex] = e.point.position();
  }
  return longest;
}

/// The optimizer shrinks its overshoot sweep by sweep; runs of one sweep each begin with the full one.
void run_constant(Mesh mesh, OptimizeOptions options, Outcome& outcome) {
  constexpr int kMostSweeps = 60;
  options.max_sweeps = 1;
  double energy = total_energy(mesh, energy_dt());
  int sweeps = 0;
  for (double fall = energy;
       sweeps < kMostSweeps && fall >= options.paper.tolerance * static_cast<double>(mesh.n_triangles()); ++sweeps) {
    const Recording run = record(mesh, options, Keep::sweeps);
    mesh = run.moments.back().mesh;
    outcome.flips += run.report.flips;
    fall = energy - run.moments.back().energy;
    energy = run.moments.back().energy;
  }
  outcome.energies.push_back(energy);
  outcome.sweeps.push_back(sweeps);
}

Outcome outcome_of(const Limit& limit, const Mesh& start, int random_orders) {
  Outcome outcome;
  for (const VertexOrder& order : vertex_orders(random_orders)) {
    OptimizeOptions options = limited(limit.limit, limit.overshoot);
    visit_in(order, options);
    if (limit.constant) {
      run_constant(start, options, outcome);
      continue;
    }
    const Recording run = record(start, options, Keep::sweeps);
    outcome.energies.push_back(run.moments.back().energy);
    outcome.sweeps.push_back(run.report.sweeps);
    outcome.flips += run.report.flips;
    outcome.longest_flipping_step = std::max(outcome.longest_flipping_step, longest_flipping_step(run));
  }
  return outcome;
}

struct Comparison {
  Limit limit;
  Outcome from_input, from_oscillation;
};

std::vector<Comparison> compare(Effort effort) {
  const int random_orders = effort == Effort::full ? 12 : 0;
  std::vector<Comparison> all;
  for (const Limit& limit : limits()) {
    all.push_back({limit, outcome_of(limit, dense_horseshoe(), random_orders),
                   outcome_of(limit, oscillating_mesh(), random_orders)});
  }
  return all;
}

const Comparison& find(const std::vector<Comparison>& all, const std::string& limit) {
  return *std::ranges::find_if(all, [&](const Comparison& c) { return c.limit.name == limit; });
}

Table thresholds(const std::vector<Comparison>& all) {
  Table t{
      "Where a search stops, as a multiple of the way to the next flip: what the runs end in, over " +
          digits(all.front().from_input.energies.size()) +
          " vertex orders. Left from the dense horseshoe itself, right from the last mesh of figure 20.",
      {"stop", "median E", "greatest E", "median sweeps", "flips", "median E", "greatest E", "median sweeps", "flips"},
      {}};
  for (const Comparison& c : all) {
    std::vector<std::string> row = {c.limit.name};
    for (const Outcome* o : {&c.from_input, &c.from_oscillation}) {
      row.push_back(digits(median(o->energies)));
      row.push_back(digits(std::ranges::max(o->energies)));
      row.push_back(digits(median(o->sweeps)));
      row.push_back(digits(o->flips));
    }
    t.rows.push_back(row);
  }
  return t;
}

std::string medians(const Comparison& c) {
  return digits(median(c.from_input.energies)) + " and " + digits(median(c.from_oscillation.energies));
}

Claim before_is_slow(const std::vector<Comparison>& all) {
  const Comparison &before = find(all, "before"), &after = find(all, "after, 1.1 shrinking");
  constexpr double kRounding = 1e-12;
  const double slow = median(before.from_input.sweeps), quick = median(after.from_input.sweeps);
  return {"6.6.1",
          "Stopping before the flip converges slowly and prevents flips.",
          "slowly, no flips",
          digits(slow) + " sweeps (median) against " + digits(quick) + ", energies " +
              digits(median(before.from_input.energies)) + " against " + digits(median(after.from_input.energies)) +
              ", from the dense horseshoe",
          slow > quick && before.from_input.longest_flipping_step < kRounding &&
              median(before.from_input.energies) > median(after.from_input.energies),
          digits(before.from_input.flips) + " flips in all these runs against " + digits(after.from_input.flips) +
              " for stopping after; each after a step of at most " +
              digits(before.from_input.longest_flipping_step, 1) +
              ", of a vertex that stood at the flip up to rounding."};
}

Claim at_is_unpredictable(const std::vector<Comparison>& all) {
  const Comparison &at = find(all, "at"), &after = find(all, "after, 1.1 shrinking");
  return {"6.6.1",
          "Stopping at the flip is unpredictable.",
          "either configuration might be regular",
          "the final energies of different orders spread over " + digits(at.from_input.spread(), 2) + " against " +
              digits(after.from_input.spread(), 2) + " for stopping after, from the dense horseshoe",
          at.from_input.spread() > after.from_input.spread() &&
              at.from_oscillation.spread() > after.from_oscillation.spread(),
          "From the last mesh of figure 20: " + digits(at.from_oscillation.spread(), 2) + " against " +
              digits(after.from_oscillation.spread(), 2) + "."};
}

Claim large_overshoot_is_worse(const std::vector<Comparison>& all) {
  const Comparison &small = find(all, "after, 1.1 shrinking"), &large = find(all, "after, 5 always");
  const Comparison& unlimited = find(all, "unlimited");
  return {"6.6.1",
          "Too large an overshoot leads to worse final quality.",
          "worse",
          "median energies from the two starts " + medians(small) + " with 1.1 shrinking, " + medians(large) +
              " with 5 in every sweep, " + medians(unlimited) + " unlimited",
          median(large.from_input.energies) > median(small.from_input.energies) &&
              median(large.from_oscillation.energies) > median(small.from_oscillation.energies),
          "An overshoot of 2 ends at " + medians(find(all, "after, 2 shrinking")) + " when it shrinks and at " +
              medians(find(all, "after, 2 always")) + " when it does not."};
}

Claim annealing_is_best(const std::vector<Comparison>& all) {
  constexpr double kTie = 1e-3;  // relative: closer medians are one
  const Comparison& annealed = find(all, "after, 1.1 shrinking");
  std::string beside;
  bool best = true;
  for (const Comparison& c : all) {
    if (c.limit.name == annealed.limit.name) continue;
    bool worse = true;
    for (const auto start : {&Comparison::from_input, &Comparison::from_oscillation}) {
      worse = worse && median((c.*start).energies) > (1 + kTie) * median((annealed.*start).energies);
    }
    best = best && worse;
    if (!worse) beside += (beside.empty() ? "" : ", ") + ("“" + c.limit.name + "” " + medians(c));
  }
  return {
      "6.6.1",
      "The best strategy is to stop after the flip with an overshoot that decreases from 10 %.",
      "the best strategy",
      "median energies from the two starts " + medians(annealed) +
          "; no worse from one of them: " + (beside.empty() ? "none" : beside),
      best,
      "Best means lower by a thousandth than every other limit of the table, from both starts. A tie: what matters is "
      "to stop shortly after a flip. In " +
          digits(annealed.from_input.energies.size()) + " vertex orders each."};
}

}  // namespace

Page make(Effort effort) {
  const std::vector<Comparison> all = compare(effort);
  return {{mesh_and_energy()},
          {thresholds(all)},
          {converges(), stays(), orthocenters_coincide(), before_is_slow(all), at_is_unpredictable(all),
           large_overshoot_is_worse(all), annealing_is_best(all)}};
}

}  // namespace temper::gallery::fig22
