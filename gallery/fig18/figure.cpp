// Figure 18: positions and weights of the dense horseshoe under energies that keep it good.
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/closeness.hpp"
#include "experiments/dense_runs.hpp"
#include "experiments/energies.hpp"
#include "experiments/text.hpp"
#include "experiments/variations.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig18 {
namespace {

constexpr std::array<std::string_view, 3> kEnergies = {"T", "BP", "BHs"};
constexpr double kReducedTolerance = 1e-3;  // against the paper's 1e-6: a tenth of the sweeps

/// One run of an energy, and what is asked of it.
struct Run {
  std::vector<double> energies;  ///< [0] of the input, then after each sweep
  Mesh mesh;                     ///< before flips
  Quality quality;
  double closeness = 0;

  [[nodiscard]] std::size_t sweeps() const { return energies.size() - 1; }
  /// No triangle turned over, no vertices nearly coincident, and numbers of the size of the input's.
  [[nodiscard]] bool good() const {
    return quality.inverted_triangles == 0 && closeness >= kNearlyCoincident && energies.back() < energies.front() &&
           energies.back() > 0;
  }
  /// Sweeps until the mean energy per triangle fell by less than that in one; 0: never.
  [[nodiscard]] std::size_t converged_in(double tolerance, std::size_t first) const {
    for (std::size_t k = first + 1; k < energies.size(); ++k) {
      const double fall = energies[k - 1] - energies[k];
      if (fall < tolerance * static_cast<double>(mesh.n_triangles())) return k;
    }
    return 0;
  }
};

Run make_run(std::string_view energy, int weights_from, double tolerance, const VertexOrder& order = {},
             std::optional<Inversion> inversion = {}) {
  OptimizeOptions options = dense_options(energy, order);
  options.paper.inversion = inversion.value_or(options.paper.inversion);
  options.paper.weights_from = weights_from;
  options.paper.tolerance = tolerance;
  const Recording recording = record(dense_horseshoe(), options, Keep::outer);
  Run run;
  for (const SweepRecord& r : recording.report.history) run.energies.push_back(r.energy);
  run.mesh = before_flips(recording).mesh;
  run.energies.back() = before_flips(recording).energy;  // the last record is amended by the flips
  run.quality = quality(run.mesh);
  run.closeness = least_closeness(run.mesh);
  return run;
}

struct Pair {
  Run immediate, deferred;  ///< i_w = 0 and 2
};
/// Barriers to that tolerance, E_T to the paper's.
std::array<Pair, 3> make_runs(double tolerance) {
  std::array<Pair, 3> pairs;
  for (std::size_t i = 0; i < kEnergies.size(); ++i) {
    const double enough =
        kEnergies[i] == "T" ? options_for("paper")->paper.tolerance : tolerance;  // few sweeps in any case
    pairs[i] = {make_run(kEnergies[i], 0, enough), make_run(kEnergies[i], 2, enough)};
  }
  return pairs;
}

std::string panels(const std::array<Pair, 3>& pairs) {
  std::vector<std::string> svgs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Run& run = pairs[i].immediate;
    svgs.push_back(dense_picture(
        run.mesh, symbol(kEnergies[i]),
        digits(run.sweeps()) + " sweeps, well-centered " + digits(100 * run.quality.well_centered_fraction, 3) + " %",
        0.25));
  }
  return grid_svg(svgs, 3);
}

Table table_of(const std::array<Pair, 3>& pairs) {
  Table table{
      "Positions and weights of the dense horseshoe before flips: energies of ★1 (γ = 1), triangles turned over, "
      "orthocenters outside their triangle, and the least distance over the shorter perimeter edge.",
      {"energy", "i_w", "sweeps", "E before", "E after", "E_F after", "inverted", "well-centered", "outside",
       "closeness"},
      {}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const int weights_from : {0, 2}) {
      const Run& run = weights_from == 0 ? pairs[i].immediate : pairs[i].deferred;
      table.rows.push_back({symbol(kEnergies[i]), std::to_string(weights_from), digits(run.sweeps()),
                            digits(run.energies.front(), 5), digits(run.energies.back(), 5),
                            digits(dense_energy(run.mesh, "F"), 4), digits(run.quality.inverted_triangles),
                            digits(run.quality.well_centered_fraction, 3), digits(run.quality.orthocenters_outside),
                            digits(run.closeness, 3)});
    }
  }
  return table;
}

Claim good_meshes(const std::array<Pair, 3>& pairs) {
  bool holds = true;
  std::string found;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Run& run = pairs[i].immediate;
    holds = holds && run.good();
    found += (i == 0 ? "" : "; ") + symbol(kEnergies[i]) + ": " + digits(run.quality.inverted_triangles) +
             " inverted, energy " + digits(run.energies.front()) + " to " + digits(run.energies.back()) +
             ", closest pair " + digits(run.closeness, 2);
  }
  return {"18",
          "E_T, E_BP and E_BHs produce a good mesh from positions and weights",
          "good meshes",
          found,
          holds,
          "i_w = 0, vertices as numbered; steps may turn triangles over under E_T, not under the barriers. Good: "
          "nothing inverted, nothing within 0.05 of the "
          "perimeter edge, energy lower and positive"};
}

/// Good meshes over vertex orders: a sentence, and whether it is all.
struct InAllOrders {
  std::string found;
  bool all_good = true;
};

InAllOrders in_all_orders(int random, double tolerance, std::optional<Inversion> inversion) {
  InAllOrders result;
  for (const std::string_view energy : kEnergies) {
    std::size_t all = 0, good = 0;
    for (const VertexOrder& order : vertex_orders(random)) {
      ++all;
      good += make_run(energy, 0, tolerance, order, inversion).good();
    }
    result.all_good = result.all_good && good == all;
    result.found += (result.found.empty() ? "" : ", ") + symbol(energy) + " " + digits(good) + " of " + digits(all);
  }
  return result;
}

Claim good_in_any_order(int random, double tolerance) {
  const InAllOrders as_here = in_all_orders(random, tolerance, {});
  return {"18",
          "They do so whatever the vertex order",
          "one order shown",
          "good meshes: " + as_here.found +
              "; with inversions allowed: " + in_all_orders(random, tolerance, Inversion::allow).found,
          as_here.all_good,
          "the same runs over vertex orders, to a mean fall of " + digits(tolerance, 1) + " per triangle",
          Author::temper};
}

Claim bhs_like_bp(const std::array<Pair, 3>& pairs) {
  const Difference apart = difference(pairs[2].immediate.mesh, pairs[1].immediate.mesh);
  const Difference moved = difference(pairs[1].immediate.mesh, dense_horseshoe());
  return {"18",
          "The E_BHs mesh is very similar to that of E_BP",
          "very similar",
          "interior vertices differ by " + digits(apart.mean_move, 2) + " in the mean, weights by at most " +
              digits(apart.largest_weight, 2) + "; E_BP moved vertices by " + digits(moved.mean_move, 2) +
              " and weights by up to " + digits(moved.largest_weight, 2),
          apart.mean_move < 0.1 * moved.mean_move,
          "γ = 1 and −h° = " + digits(shift_beyond(dense_horseshoe()).value, 3) + ", both constant"};
}

double mean_edge(const Mesh& mesh) {
  double sum = 0, edges = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h)) continue;
    sum += length(mesh.position(mesh.origin(h)) - mesh.position(mesh.target(h)));
    edges += 1;
  }
  return sum / edges;
}

Claim little_difference(const std::array<Pair, 3>& pairs) {
  constexpr double kLittleEnergy = 0.02, kLittleMove = 0.1;
  const double edge = mean_edge(dense_horseshoe());
  bool holds = true;
  std::string found;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [immediate, deferred] = pairs[i];
    const double energy = std::abs(deferred.energies.back() / immediate.energies.back() - 1);
    const double moved = difference(deferred.mesh, immediate.mesh).mean_move / edge;
    holds = holds && energy < kLittleEnergy && moved < kLittleMove;
    found += (i == 0 ? "" : "; ") + symbol(kEnergies[i]) + ": energy by " + digits(100 * energy, 2) +
             " %, interior vertices by " + digits(100 * moved, 2) + " % of the mean edge";
  }
  return {"18",
          "i_w = 2 makes little difference to the outputs",
          "little difference",
          "the results of i_w = 2 and 0 differ, " + found,
          holds,
          "little is less than 2 % and 10 %. The barriers' two meshes are the same optimum"};
}

/// The number of orders in which i_w = 2 needs fewer sweeps, for E_T, whose optima depend on the order.
std::string orders_with_fewer(int random) {
  const double tolerance = options_for("paper")->paper.tolerance;
  std::size_t all = 0, fewer = 0;
  for (const VertexOrder& order : vertex_orders(random)) {
    ++all;
    fewer += make_run("T", 2, tolerance, order).sweeps() < make_run("T", 0, tolerance, order).sweeps();
  }
  return digits(fewer) + " of " + digits(all);
}

Claim fewer_iterations(const std::array<Pair, 3>& pairs, int random) {
  std::size_t fewer = 0;
  std::string found, looser;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& [immediate, deferred] = pairs[i];
    fewer += deferred.sweeps() < immediate.sweeps();
    found += (i == 0 ? "" : ", ") + symbol(kEnergies[i]) + " " + digits(deferred.sweeps()) + " against " +
             digits(immediate.sweeps());
    for (const double loose : {1e-2, 1e-3, 1e-4}) {
      if (immediate.converged_in(loose, 0) == 0 || deferred.converged_in(loose, 2) == 0) continue;
      looser += (looser.empty() ? "" : ", ") + symbol(kEnergies[i]) + " at " + digits(loose, 1) + " " +
                digits(deferred.converged_in(loose, 2)) + " against " + digits(immediate.converged_in(loose, 0));
    }
  }
  return {
      "18",
      "With i_w = 2 they converge in fewer iterations than with i_w = 0",
      "fewer",
      "sweeps with i_w = 2 against i_w = 0: " + found,
      fewer == pairs.size(),
      "nor with looser tolerances: " + looser + "; under E_T it depends on the vertex order, fewer in " +
          orders_with_fewer(random) +
          ". Both runs of a barrier end in the same optimum at the same linear rate, so that sweeps without weights "
          "only delay it"};
}

}  // namespace

Page make(Effort effort) {
  const bool full = effort == Effort::full;
  const double tolerance = full ? options_for("paper")->paper.tolerance : kReducedTolerance;
  const std::array<Pair, 3> pairs = make_runs(tolerance);
  Page page;
  page.pictures.push_back({"fig18", panels(pairs),
                           "Optimal positions and weights before flips, i_w = 0, circles at a quarter of their radius: "
                           "green positive, red negative. E_BHs is drawn beside the two that the paper shows."});
  page.tables.push_back(table_of(pairs));
  page.claims = {good_meshes(pairs), good_in_any_order(full ? 5 : 0, full ? 1e-4 : kReducedTolerance),
                 bhs_like_bp(pairs), little_difference(pairs), fewer_iterations(pairs, full ? 5 : 0)};
  for (Claim& claim : claims_on_variations(effort)) page.claims.push_back(std::move(claim));
  return page;
}

}  // namespace temper::gallery::fig18
