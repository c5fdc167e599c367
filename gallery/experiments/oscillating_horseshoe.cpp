#include "experiments/oscillating_horseshoe.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/domain.hpp"

namespace temper::gallery {
namespace {

constexpr int kOuter = 7;  // outer iterations 0 to 6: the rows of figure 20
constexpr std::size_t kLongestPeriod = 12;
constexpr std::size_t kLeastRepeats = 5;  // one more than a transient of the pictured run shows

/// The interior vertex on one side of the middle (side −1: left) that moved furthest, by its number in the input.
VertexId most_moved(const Moment& from, const Moment& to, double side) {
  VertexId most;
  double furthest = -1;
  for (const VertexId v : to.mesh.vertices()) {
    const VertexId before = from.find(to.vertices[v]);
    if (!before.valid() || to.mesh.is_boundary(v) || to.mesh.position(v).x * side <= 0) continue;
    const double moved = length(to.mesh.position(v) - from.mesh.position(before));
    if (moved > furthest) furthest = moved, most = to.vertices[v];
  }
  return most;
}

std::vector<OrderedRun> run_orders(Effort effort) {
  const int outer = effort == Effort::full ? 50 : 16;
  std::vector<OrderedRun> all;
  for (const char* energy : {"F", "dT"}) {
    for (const VertexOrder& order : vertex_orders(effort == Effort::full ? 7 : 0)) {
      OptimizeOptions options = positions_and_collapses();
      visit_in(order, options);
      options.paper.collapse_energy = find_energy(energy)->kind;
      options.paper.outer = outer;
      all.push_back({order.name, energy, oscillation_of(record(dense_horseshoe(), options, Keep::outer))});
    }
  }
  return all;
}

/// a and b between two moments.
std::array<VertexId, 2> oscillating_between(const Moment& from, const Moment& to) {
  return {most_moved(from, to, -1), most_moved(from, to, +1)};
}

}  // namespace

EnergyModel energy_dt() {
  EnergyModel model;
  model.kind = EnergyKind::dT;
  model.boundary_treatment = BoundaryTreatment::absolute;
  return model;
}

std::vector<VertexOrder> vertex_orders(int random) {
  std::vector<VertexOrder> orders = {
      {"as numbered", SweepOrder::input}, {"reverse", SweepOrder::reverse}, {"Hilbert", SweepOrder::hilbert}};
  for (int i = 1; i <= random; ++i) {
    orders.push_back({"random " + std::to_string(i), SweepOrder::random, static_cast<std::uint64_t>(i)});
  }
  return orders;
}

VertexOrder shown_order() { return {"reverse", SweepOrder::reverse}; }

OptimizeOptions positions_and_collapses() {
  OptimizeOptions options = *options_for("paper");
  options.energy = EnergyKind::dT;
  options.unknowns = Unknowns::positions;
  options.paper.removal = Removal::none;
  options.paper.collapse_energy = EnergyKind::F;
  options.paper.inversion = Inversion::refuse;
  options.paper.order = shown_order().order;
  options.paper.outer = kOuter;
  return options;
}

const Recording& oscillating_run() {
  static const Recording run = record(dense_horseshoe(), positions_and_collapses(), Keep::sweeps);
  if (run.all(Snapshot::Moment::after_flips).size() < 2) {
    throw CannotBeMade("the run of figures 19 and 20 ends before it oscillates");
  }
  return run;
}

const Mesh& oscillating_mesh() { return oscillating_run().all(Snapshot::Moment::after_flips).back()->mesh; }

std::array<VertexId, 2> oscillating_vertices() {
  const auto flipped = oscillating_run().all(Snapshot::Moment::after_flips);
  return oscillating_between(*flipped[flipped.size() - 2], *flipped.back());
}

Oscillation oscillation_of(const Recording& run) {
  Oscillation o;
  const auto flipped = run.all(Snapshot::Moment::after_flips);
  for (const Moment* m : run.all(Snapshot::Moment::before_flips)) o.before.push_back(m->energy);
  for (const Moment* m : flipped) o.after.push_back(m->energy);
  const std::size_t n = flipped.size();
  if (n < 2) return o;
  const auto differ = [&](std::size_t i, std::size_t j) { return triangles_not_in(*flipped[i], *flipped[j]).size(); };
  for (std::size_t p = 1; o.period == 0 && p <= kLongestPeriod; ++p) {
    std::size_t repeats = 0;
    while (repeats + p < n && differ(n - 1 - repeats, n - 1 - repeats - p) == 0) ++repeats;
    if (repeats >= std::max(2 * p, kLeastRepeats)) o.period = p, o.first = n - repeats - p;
  }
  const auto [low, high] = std::minmax_element(
      o.after.end() - static_cast<std::ptrdiff_t>(std::clamp(o.period, std::size_t{2}, n)), o.after.end());
  o.low = *low, o.high = *high;
  o.vertices = flipped.back()->mesh.n_vertices();
  o.flipped = differ(n - 1, n - 2);
  const Moment &one = *flipped[n - 2], &other = *flipped[n - 1];
  const std::array<VertexId, 2> movers = oscillating_between(one, other);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const auto place = [&](const Moment& m) { return m.mesh.position(m.find(movers[i])); };
    o.places_low[i] = place(one.energy < other.energy ? one : other);
    o.places_high[i] = place(one.energy < other.energy ? other : one);
  }
  return o;
}

bool as_in_the_paper(const Oscillation& o) {
  constexpr double kPaperLow = 3.41, kPaperHigh = 4.08, kNear = 0.05;  // relative
  const auto near = [](double ours, double paper) { return std::abs(ours - paper) <= kNear * paper; };
  return o.period == 2 && near(o.low, kPaperLow) && near(o.high, kPaperHigh);
}

const std::vector<OrderedRun>& oscillations_by_order(Effort effort) {
  if (effort == Effort::full) {
    static const std::vector<OrderedRun> full = run_orders(Effort::full);
    return full;
  }
  static const std::vector<OrderedRun> reduced = run_orders(Effort::reduced);
  return reduced;
}

}  // namespace temper::gallery
