#include "experiments/variations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/dense_runs.hpp"
#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/high_heat.hpp"
#include "experiments/numbers.hpp"
#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/text.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper::gallery {
namespace {

constexpr std::array<std::string_view, 3> kEnergies = {"T", "BP", "BHs"};  // without a HOT mess

int random_orders(Effort effort) { return effort == Effort::full ? 3 : 0; }

// --- §5.2: the state at the beginning of the iteration ---------------------------------------------------------

struct Unstable {
  std::size_t non_regular = 0;  ///< edges after kEarly sweeps
  std::size_t rises = 0;        ///< sweeps that raised the energy
  std::size_t inverted = 0;     ///< triangles at the end
};
constexpr int kEarly = 2, kSweeps = 20;

Unstable unstable(std::string_view energy, Updates updates, Inversion inversion = Inversion::refuse) {
  OptimizeOptions o = dense_options(energy);
  o.paper.position_updates = o.paper.weight_updates = updates;
  o.paper.inversion = inversion;
  o.paper.stopping = StoppingRule::relative;  // the paper's ends at the first rise
  o.paper.tolerance = 0;
  o.max_sweeps = kSweeps;
  const Recording run = record(dense_horseshoe(), o, Keep::sweeps);
  Unstable found;
  for (const Moment* m : run.all(Snapshot::Moment::after_sweep)) {
    const Quality q = quality(m->mesh);
    if (m->sweep == kEarly) found.non_regular = q.non_regular_edges;
    found.inverted = q.inverted_triangles;
  }
  const auto& history = run.report.history;
  for (std::size_t i = 1; i < history.size(); ++i) found.rises += history[i].energy > history[i - 1].energy ? 1 : 0;
  return found;
}

Claim at_once_is_unstable() {
  std::string kept;
  for (const std::string_view energy : kEnergies) {
    const Unstable in_turn = unstable(energy, Updates::immediate), at_once = unstable(energy, Updates::deferred);
    kept += (kept.empty() ? "" : "; ") + symbol(energy) + ": " + digits(at_once.non_regular) + " against " +
            digits(in_turn.non_regular) + " edges not regular after " + std::to_string(kEarly) + " iterations, " +
            digits(at_once.rises) + " against " + digits(in_turn.rises) + " rises of the energy";
  }
  const Unstable in_turn = unstable("T", Updates::immediate, Inversion::allow);
  const Unstable at_once = unstable("T", Updates::deferred, Inversion::allow);
  return {
      "5.2",
      "Using the state at the beginning of the iteration was unstable and made the triangulation non-regular very "
      "quickly.",
      "unstable, non-regular very quickly",
      "E_T after " + std::to_string(kSweeps) + " iterations: " + digits(at_once.inverted) +
          " triangles turned over against " + digits(in_turn.inverted) + ", the energy rose after " +
          digits(at_once.rises) + " against " + digits(in_turn.rises),
      at_once.inverted > in_turn.inverted && at_once.rises > in_turn.rises,
      "All unknowns at once against one vertex after the other, positions and weights of the dense horseshoe before "
      "flips, inversions allowed. Where no step may turn a triangle over, and a vertex stays whose neighbors have "
      "moved "
      "so that it would, " +
          kept + "."};
}

// --- §5.2: all positions, then all weights ---------------------------------------------------------------------

Mesh converged(std::string_view energy, Visits visits, int sweeps) {
  OptimizeOptions o = dense_options(energy);
  o.paper.visits = visits;
  o.max_sweeps = sweeps;
  return before_flips(record(dense_horseshoe(), o, Keep::outer)).mesh;
}

Claim two_visits_differ_little(Effort effort) {
  constexpr double kLittle = 0.02;
  const int sweeps = effort == Effort::full ? 300 : 40;
  bool holds = true;
  std::string found;
  for (const std::string_view energy : kEnergies) {
    const double once = dense_energy(converged(energy, Visits::once, sweeps), energy);
    const double twice = dense_energy(converged(energy, Visits::twice, sweeps), energy);
    holds = holds && std::abs(twice / once - 1) < kLittle;
    found += (found.empty() ? "" : ", ") + symbol(energy) + " " + digits(100 * (twice / once - 1), 2) + " %";
  }
  return {"5.2",
          "Optimizing the positions of all points, then the weights of all points, made little difference.",
          "little difference",
          "energies before flips differ by " + found,
          holds,
          "Against position and weight of each point in turn; little is less than 2 %."};
}

// --- §5.2: flips after each point ------------------------------------------------------------------------------

Claim flips_at_once_are_more_stable(Effort effort) {
  std::size_t at_once = 0, deferred = 0, orders = 0;
  std::vector<double> energies_at_once, energies_deferred;
  for (const VertexOrder& order : vertex_orders(random_orders(effort))) {
    OptimizeOptions o = positions_and_collapses();
    visit_in(order, o);
    o.paper.outer = 0;
    o.max_sweeps = 300;
    const Recording late = record(dense_horseshoe(), o, Keep::outer);
    o.flips = Flips::immediate;
    const Recording soon = record(dense_horseshoe(), o, Keep::outer);
    ++orders;
    deferred += late.report.stopped == Stopped::converged ? 1 : 0;
    at_once += soon.report.stopped == Stopped::converged ? 1 : 0;
    energies_deferred.push_back(late.report.objective_after);
    energies_at_once.push_back(soon.report.objective_after);
  }
  return {
      "5.2",
      "Flipping after each point improves stability, and has an unpredictable effect on the final mesh.",
      "improves stability",
      "runs that converge: " + digits(at_once) + " of " + digits(orders) + " with flips after each point, " +
          digits(deferred) + " with flips after the inner iterations; median E_∂T " + digits(median(energies_at_once)) +
          " against " + digits(median(energies_deferred)),
      at_once > deferred,
      "Positions and collapses under E_∂T, which oscillate with deferred flips (figure 20), at most 300 iterations, "
      "several vertex orders."};
}

// --- §7: what it proposes ------------------------------------------------------------------------------------------

struct End {
  double energy = 0, well_centered = 0;
  std::size_t vertices = 0;
};

End ending(const OptimizeOptions& options) {
  const Recording run = record(dense_horseshoe(), options, Keep::outer);
  if (!run.error.empty()) return {std::numeric_limits<double>::quiet_NaN(), 0, 0};  // for which no claim holds
  const Quality q = quality(run.result);
  return {run.report.objective_after, q.well_centered_fraction, run.result.n_vertices()};
}

std::string told(const End& e) {
  return "E_BP " + digits(e.energy) + ", well-centered " + digits(100 * e.well_centered, 3) + " %, " +
         digits(e.vertices) + " vertices";
}

Claim first_energy_helps(Effort effort) {
  OptimizeOptions o = high_heat_options("BP");
  o.paper.inversion = Inversion::refuse;  // E_∂T has no wall
  o.max_sweeps = effort == Effort::full ? 150 : 50;
  const End plain = ending(o);
  o.paper.first_energy = EnergyKind::dT;
  o.paper.switch_at = o.paper.weights_from;
  const End switched = ending(o);
  return {"7 Further Exploration",
          "E_∂T for positions and collapses, then E_BP when weights join, ends with less energy than E_BP alone.",
          "one could combine",
          told(switched) + "; E_BP alone: " + told(plain),
          switched.energy < plain.energy,
          "The run of figure 26 with inversions refused, at most 150 iterations; the energies switch at i_w = 40.",
          Author::temper};
}

Claim light_vertices_should_go(Effort effort) {
  std::size_t kept = 0, removed = 0, runs = 0;
  for (const VertexOrder& order : vertex_orders(random_orders(effort))) {
    OptimizeOptions o = high_heat_options("T");
    visit_in(order, o);
    o.paper.inversion = Inversion::refuse;
    o.paper.weights_from = 0;
    o.paper.outer = 4;
    o.max_sweeps = effort == Effort::full ? 150 : 30;
    const auto hidden = [&] {
      return count_non_regular_edges(record(dense_horseshoe(), o, Keep::outer).moments.back().mesh) > 0;
    };
    kept += hidden() ? 1 : 0;
    o.paper.removal = Removal::weight;
    removed += hidden() ? 1 : 0;
    ++runs;
  }
  return {"7 Further Exploration",
          "Vertices with large negative weights may be hidden when regularity is restored, so perhaps they should be "
          "removed explicitly.",
          "perhaps",
          "runs that end with hidden vertices: " + digits(kept) + " of " + digits(runs) + ", with explicit removal " +
              digits(removed),
          removed < kept,
          "E_T, positions and weights, short-edge collapses, deferred flips; removed is what is more than R² below the "
          "mean weight of its neighbors.",
          Author::temper};
}

Claim insertions_help() {
  OptimizeOptions o;
  o.objective = Objective::energy;
  o.repair = Repair::none;
  const End plain = ending(o);
  o.paper.insertion_from = 0;
  o.paper.insertion_ratio = 1.2;
  o.paper.removal_margin = 0;
  const End more = ending(o);
  return {"7 Further Exploration",
          "New nodes at the orthocenters of large-energy triangles make more of the mesh well-centered.",
          "it may be effective",
          told(more) + "; without: " + told(plain),
          more.vertices > plain.vertices && more.well_centered > plain.well_centered,
          "E_BP, temper's own way without repairs; inserted after each iteration, where a triangle has more than 1.2 "
          "times the mean energy and the mean over what is replaced falls.",
          Author::temper};
}

}  // namespace

std::vector<Claim> claims_on_variations(Effort effort) {
  return {at_once_is_unstable(),      two_visits_differ_little(effort), flips_at_once_are_more_stable(effort),
          first_energy_helps(effort), light_vertices_should_go(effort), insertions_help()};
}

}  // namespace temper::gallery
