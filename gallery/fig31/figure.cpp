// Figure 31: the patch test with positions and weights: later than with positions alone, and with care on large meshes.
#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/domain.hpp"
#include "experiments/energies.hpp"
#include "experiments/high_heat.hpp"
#include "experiments/patch_test.hpp"
#include "experiments/summary_matrix.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "gallery.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"

namespace temper::gallery::fig31 {
namespace {

constexpr std::array<Star, 2> kOthers = {Star::zero, Star::two};

std::string name_of(Star star) { return star == Star::zero ? "★0" : "★2"; }

const Matrix& matrix_of(Star star, Effort effort) { return summary_matrix(effort, Inversion::refuse, star); }

bool is_hot(const Cell& c) { return c.energy == "F" || c.energy == "dT" || c.energy == "T"; }
bool is_unbounded(const Cell& c) { return c.energy == "F" || c.energy == "dT"; }
bool moves_only(const Cell& c) { return c.unknowns == Unknowns::positions; }

/// Runs of some cells of both matrices: those with that end, and all.
struct Count {
  std::size_t with = 0, all = 0;
};
Count count(const Matrix& matrix, Verdict verdict, const std::function<bool(const Cell&)>& asked) {
  Count c;
  for (const Cell& cell : matrix.cells) {
    if (!asked(cell)) continue;
    c.with += cell.count(verdict);
    c.all += cell.endings.size();
  }
  return c;
}

/// A claim that both stars have to meet: `part` of the asked runs at least end so.
Claim of_both(Effort effort, const std::string& claim, Verdict verdict, double part,
              const std::function<bool(const Cell&)>& asked, const std::string& why = "") {
  bool holds = true;
  std::string found;
  for (const Star star : kOthers) {
    const Count c = count(matrix_of(star, effort), verdict, asked);
    holds = holds && c.all > 0 && static_cast<double>(c.with) >= part * static_cast<double>(c.all);
    found += (found.empty() ? "" : "; ") + name_of(star) + ": " + std::string(name(verdict)) + " in " + digits(c.with) +
             " of " + digits(c.all) + " runs";
  }
  return {"7 Further Exploration",
          claim,
          "“have not studied ★0 nor ★2”",
          found,
          holds,
          "The runs of figure 32 with another star, two vertex orders; asked for: in at least " +
              digits(100 * part, 3) + " % of them." + why,
          Author::temper};
}

std::string counts_of(const Cell& cell) {
  std::string text;
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (cell.count(verdict) > 0)
      text += (text.empty() ? "" : ", ") + std::string(name(verdict)) + " " + digits(cell.count(verdict));
  }
  return text;
}

/// How the runs end, by star.
Table star_table(Effort effort) {
  Table t{"The runs of figure 32 for ★0 and ★2, by verdict; no step turns a triangle over.",
          {"energy", "star", "x, no removal", "x, short edges", "x, patch test", "x and w, no removal",
           "x and w, short edges", "x and w, patch test"},
          {}};
  for (const std::string_view energy : kFiveEnergies) {
    for (const Star star : kOthers) {
      std::vector<std::string> row = {symbol(energy), name_of(star)};
      for (const Unknowns unknowns : kUnknowns) {
        for (const RemovalRule rule : kRules) {
          row.push_back(counts_of(matrix_of(star, effort).at(energy, unknowns, rule)));
        }
      }
      t.rows.push_back(row);
    }
  }
  return t;
}

/// What figure 32 says of ★1, asked of the other two.
std::vector<Claim> star_claims(Effort effort) {
  return {of_both(effort, "For ★0 and ★2, too, the barriers E_BP and E_BHs always work.", Verdict::good, 1,
                  [](const Cell& c) { return !is_hot(c); }),
          of_both(effort, "For ★0 and ★2, too, positions under E_F, E_∂T and E_T without removals collapse edges.",
                  Verdict::collapsed, 0.5,
                  [](const Cell& c) { return is_hot(c) && moves_only(c) && c.rule == RemovalRule::none; }),
          of_both(
              effort, "For ★0 and ★2, too, weights under E_F and E_∂T produce a HOT mess.", Verdict::mess, 0.5,
              [](const Cell& c) { return is_unbounded(c) && !moves_only(c) && c.rule == RemovalRule::none; },
              " E_F^2 is a convex parabola in each weight (figure 4), and so has nothing to run away to."),
          of_both(effort, "For ★0 and ★2, too, explicit collapses make every energy work on positions alone.",
                  Verdict::good, 1,
                  [](const Cell& c) { return is_hot(c) && moves_only(c) && c.rule == RemovalRule::short_edge; })};
}

Claim later_with_weights(Effort effort) {
  double positions = 0, weights = 0;
  std::size_t later = 0, last_later = 0;
  const auto& all = rule_comparisons(effort);
  for (const RuleComparison& c : all) {
    if (c.patch_positions.empty() || c.patch_weights.empty()) throw CannotBeMade("the patch test removes no vertex");
    positions += mean_iteration(c.patch_positions) / static_cast<double>(all.size());
    weights += mean_iteration(c.patch_weights) / static_cast<double>(all.size());
    if (mean_iteration(c.patch_weights) > mean_iteration(c.patch_positions)) ++later;
    if (c.patch_weights.rbegin()->first > c.patch_positions.rbegin()->first) ++last_later;
  }
  const int last_p = removals(patch_test_run(Unknowns::positions)).rbegin()->first;
  const int last_w = removals(patch_test_run(Unknowns::positions_and_weights)).rbegin()->first;
  return {"31",
          "With weights, the patch test removes vertices at later iterations than with positions alone.",
          "later",
          "last removal in iteration " + std::to_string(last_w) + " against " + std::to_string(last_p) +
              "; over vertex orders the mean iteration is " + digits(weights, 3) + " against " + digits(positions, 3),
          last_w > last_p && weights > positions,
          "Of " + digits(all.size()) + " vertex orders the mean iteration is later with weights in " + digits(later) +
              ", the last removal in " + digits(last_later) + "."};
}

/// The short-edge rule with deferred flips, with and without weights, for a number of iterations.
struct Movement {
  std::size_t collapses = 0;
  double displacement = 0;  ///< mean distance of the inner vertices that are left from where they began
};

Movement movement(const VertexOrder& order, Unknowns unknowns) {
  constexpr int kSweeps = 60;
  OptimizeOptions options = high_heat_options("BP");
  options.unknowns = unknowns;
  options.paper.weights_from = 0;
  visit_in(order, options);
  options.max_sweeps = kSweeps;
  const Recording run = record(dense_horseshoe(), options, Keep::outer);
  Movement m{all_of(removals(run)).size(), 0};
  const Moment& end = run.moments.back();
  std::size_t inner = 0;
  for (const VertexId v : end.mesh.vertices()) {
    if (end.mesh.is_boundary(v)) continue;
    m.displacement += length(end.mesh.position(v) - dense_horseshoe().position(end.vertices[v]));
    ++inner;
  }
  if (inner > 0) m.displacement /= static_cast<double>(inner);
  return m;
}

Claim weights_move_less(Effort effort) {
  Movement positions, both;
  const std::vector<VertexOrder> orders = vertex_orders(effort == Effort::full ? 5 : 0);
  const auto add = [&](Movement& sum, const Movement& m) {
    sum.collapses += m.collapses;
    sum.displacement += m.displacement / static_cast<double>(orders.size());
  };
  for (const VertexOrder& order : orders) {
    add(positions, movement(order, Unknowns::positions));
    add(both, movement(order, Unknowns::positions_and_weights));
  }
  return {
      "31",
      "With weights, positions change less and the short-edge rule removes fewer vertices.",
      "less, fewer",
      "mean displacement " + digits(both.displacement, 3) + " against " + digits(positions.displacement, 3) +
          ", collapses " + digits(both.collapses) + " against " + digits(positions.collapses),
      both.displacement < positions.displacement && both.collapses < positions.collapses,
      "The first 60 iterations with weights from iteration 0 and with positions alone, E_BP, deferred flips, summed "
      "over " +
          digits(orders.size()) + " vertex orders."};
}

/// The success of the patch test on a larger mesh, by the measure that it takes of a patch.
struct Measure {
  const char* name;
  RemovalMeasure measure;
  double margin;
};
constexpr Measure kMeasures[] = {{"sum, the paper's", RemovalMeasure::sum, 0},
                                 {"mean a triangle, 10 % margin", RemovalMeasure::mean, 0.1},
                                 {"excess over equilateral, 10 % margin", RemovalMeasure::excess, 0.1}};

struct LargeRun {
  std::string name;
  std::size_t inner_before = 0, inner_after = 0, triangles = 0;
  double well_centered = 0;
  [[nodiscard]] double kept() const { return static_cast<double>(inner_after) / static_cast<double>(inner_before); }
};

std::vector<LargeRun> large_runs(Effort effort) {
  std::vector<LargeRun> runs;
  const auto input = random_mesh({.vertices = effort == Effort::full ? 2000U : 250U});
  if (!input) return runs;
  for (const Measure& m : kMeasures) {
    OptimizeOptions options;
    options.paper.removal = Removal::patch;
    options.paper.removal_measure = m.measure;
    options.paper.removal_margin = m.margin;
    if (m.margin == 0) options.paper.removal_from = 0;
    options.max_sweeps = effort == Effort::full ? 60 : 30;
    Mesh mesh = *input;
    if (!optimize(mesh, options)) continue;
    const Quality q = quality(mesh);
    runs.push_back({m.name, count_interior(*input), count_interior(mesh), q.triangles, q.well_centered_fraction});
  }
  return runs;
}

Table large_table(const std::vector<LargeRun>& runs) {
  Table t{"The patch test on random points, by how a patch is measured; Newton steps, flips at once.",
          {"measure", "inner vertices", "left", "triangles", "well-centered"},
          {}};
  for (const LargeRun& r : runs) {
    t.rows.push_back(
        {r.name, digits(r.inner_before), digits(r.inner_after), digits(r.triangles), digits(r.well_centered, 3)});
  }
  return t;
}

Claim summed_energy_guts(const std::vector<LargeRun>& runs) {
  std::string found;
  for (const LargeRun& r : runs) {
    found += (found.empty() ? "" : "; ") + r.name + ": " + digits(r.inner_after) + " of " + digits(r.inner_before);
  }
  return {
      "7 Conclusion",
      "Caution with energies that depend on the number of elements: summed E_BP guts a larger mesh, mean and excess "
      "with a margin do not.",
      "use caution",
      "inner vertices left, by measure: " + found,
      runs.size() == std::size(kMeasures) && runs[0].kept() < 0.25 && runs[1].kept() > 0.5 && runs[2].kept() > 0.5,
      "Any removal lowers the sum by the two triangles that go. Asked for: less than a quarter of the inner vertices "
      "left by the sum, more than half by the others."};
}

double mean_least_angle(const Mesh& mesh) {
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
    sum += std::min({corner_angle(p, q, r), corner_angle(q, r, p), corner_angle(r, p, q)});
  }
  return sum / static_cast<double>(mesh.n_triangles());
}

Claim mean_is_no_cure() {
  const Mesh& mesh = oscillating_mesh();
  const auto mean = [](const Mesh& m) { return total_energy(m, energy_dt()) / static_cast<double>(m.n_triangles()); };
  std::size_t cuts = 0, worse_shape = 0, less_energy = 0, both = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 center = (1.0 / 3) * (mesh.position(a) + mesh.position(b) + mesh.position(c));
    Mesh cut = mesh;
    insert_in_triangle(cut, t, {center.x, center.y, 0});
    restore_regularity(cut);
    const bool worse = mean_least_angle(cut) < mean_least_angle(mesh), less = mean(cut) < mean(mesh);
    ++cuts;
    worse_shape += worse, less_energy += less, both += worse && less;
  }
  return {
      "3.3",
      "The average HOT energy per element is no sufficient fix: it, too, falls when elements get smaller and worse.",
      "an insufficient fix",
      "a vertex at the centroid of a triangle, and flips: the mean least angle falls at " + digits(worse_shape) +
          " of " + digits(cuts) + " triangles, the mean E_∂T at " + digits(less_energy) + ", both at " + digits(both),
      worse_shape > 0 && 2 * both > worse_shape,
      "The mesh from which figure 22 starts, each of its triangles cut in turn. Asked for: less energy in more than "
      "half of the cuts that make shapes worse."};
}

}  // namespace

Page make(Effort effort) {
  const Recording& run = patch_test_run(Unknowns::positions_and_weights);
  const std::vector<LargeRun> large = large_runs(effort);
  std::vector<Claim> claims = {coarse_but_good(Unknowns::positions_and_weights, "31"), later_with_weights(effort),
                               weights_move_less(effort), summed_energy_guts(large), mean_is_no_cure()};
  for (Claim& claim : star_claims(effort)) claims.push_back(std::move(claim));
  return {{{"fig31", removal_panels(run, 1),
            "The mesh with which each iteration begins, the vertices that it removes in red, and the final mesh. "
            "Positions and weights under E_BP with γ = 1, weights from iteration 0, flips at once, vertices visited as "
            "numbered. Weight circles to scale."}},
          {removal_table(run), large_table(large), star_table(effort)},
          std::move(claims)};
}

}  // namespace temper::gallery::fig31
