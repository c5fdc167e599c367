// Figure 9: the best weight of one vertex, by the angle there and by energy, drawn (§6.1.2).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/single_triangle.hpp"
#include "experiments/text.hpp"
#include "experiments/triangle_drawing.hpp"
#include "figures.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::gallery::fig09 {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array<EnergyKind, 5> kKinds = {EnergyKind::BH, EnergyKind::BHs, EnergyKind::BP, EnergyKind::T,
                                              EnergyKind::F};
constexpr std::array<const char*, 5> kNames = {"BH", "BHs", "BP", "T", "F"};
constexpr double kRounding = 1e-9;

std::optional<BestWeight> best(EnergyKind kind, double of_pi) { return best_weight(paper_model(kind), of_pi * kPi); }

Picture drawings() {
  constexpr std::array<double, 9> kAngles = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  TriangleTable table;
  table.low = {-0.75, -0.72};
  table.high = {1.08, 0.72};
  table.cell_width = 112;
  for (const double angle : kAngles) table.columns.push_back(digits(angle, 2) + "π");
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    TriangleRow row{.label = std::string("E_{") + kNames[k] + "}", .cells = {}, .captions = {}};
    for (const double angle : kAngles) {
      const auto found = best(kKinds[k], angle);
      row.cells.push_back(found ? std::optional(angle_triangle(angle * kPi, found->weight)) : std::nullopt);
      row.captions.push_back(found ? "w = " + digits(found->weight, 2) : "");
    }
    table.rows.push_back(row);
  }
  return {
      "fig09", triangle_table_svg(table),
      "The weight of the vertex at the angle θ that is best for each ★1 energy (γ = 1, h° = −0.15; for E_F the local "
      "minimum). Circles of radius √|w|, green for w > 0, red and dashed for w < 0; duals blue, dashed where they miss "
      "their edge."};
}

// The last angle at which some weight satisfies the barrier, from the first: both to 1e-4 π.
struct AngleRange {
  double first = 1, last = 0;
  bool whole = true;  // no gap between
};
AngleRange solvable(double least_h, int steps) {
  AngleRange range;
  int n = 0;
  for (int k = 1; k < steps; ++k) {
    const double angle = static_cast<double>(k) / steps;
    if (!feasible_weights(angle * kPi, least_h)) continue;
    range.first = std::min(range.first, angle);
    range.last = std::max(range.last, angle);
    ++n;
  }
  range.whole = n == static_cast<int>(std::lround((range.last - range.first) * steps)) + 1;
  return range;
}

Claim no_single_weight(int steps) {
  const AngleRange hard = solvable(0, steps), shifted = solvable(-0.15, steps);
  // With every h above its bound, is some d then always outside?
  bool d_fails = true;
  int asked = 0;
  for (int k = 1; k < steps; ++k) {
    const double angle = static_cast<double>(k) / steps;
    if (angle <= hard.last) continue;
    const auto d_alone = feasible_weights(angle * kPi, -std::numeric_limits<double>::infinity());
    d_fails = d_fails && d_alone && margins(angle_triangle(angle * kPi, (d_alone->low + d_alone->high) / 2)).min_h <= 0;
    ++asked;
  }
  return {"9",
          "For some large angles one weight alone cannot satisfy E_BH or E_BHs: all h > h° forces some d < 0",
          "no solution for some large angles",
          "E_BH has a solution from " + digits(hard.first) + "π to " + digits(hard.last) +
              "π, E_BHs (h° = −0.15) from " + digits(shifted.first) + "π to " + digits(shifted.last) +
              "π, so none for sharp angles either",
          hard.last < 1 && shifted.last < 1 && shifted.last > hard.last && hard.whole && shifted.whole && d_fails &&
              asked > 0,
          "h and d are linear in w: the intersection of intervals at " + digits(static_cast<std::size_t>(steps - 1)) +
              " angles"};
}

// Orthocenter at the incenter: weights of two vertices, the third 0.
Claim two_weights(int steps) {
  std::size_t good = 0, n = 0;
  double least_d = 1, least_h = 1;
  for (int k = 1; k < steps; ++k, ++n) {
    Corners p = angle_triangle(k * kPi / steps, 0);
    std::array<double, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) side[i] = length(p[(i + 1) % 3].position() - p[(i + 2) % 3].position());
    const double around = side[0] + side[1] + side[2];
    Vec2 incenter;
    for (std::size_t i = 0; i < 3; ++i) incenter = incenter + (side[i] / around) * p[i].position();
    const double power = squared_length(p[1].position() - incenter);
    for (WeightedPoint& v : p) v.w = squared_length(v.position() - incenter) - power;
    const Margins m = margins(p);
    good += m.min_d > 0 && m.min_h > 0 && is_well_centered(p[0], p[1], p[2]);
    least_d = std::min(least_d, m.min_d);
    least_h = std::min(least_h, m.min_h);
  }
  return {"9",
          "With two weights free there is always a solution: put the orthocenter at the incenter",
          "always",
          "well-centered at " + digits(good) + " of " + digits(n) + " angles; least d " + digits(least_d, 2) +
              ", least h " + digits(least_h, 2),
          good == n,
          "weights |p − o|² less that of the third vertex; decided by exact predicates"};
}

Claim t_equals_f() {
  double worst = 0;
  std::size_t n = 0, apart = 0;
  for (int k = 1; k < 100; ++k) {
    for (int i = -50; i <= 50; ++i) {
      const Corners p = angle_triangle(k * kPi / 100, i / 50.0);
      const double f = triangle_energy(paper_model(EnergyKind::F), p[0], p[1], p[2]);
      const double t = triangle_energy(paper_model(EnergyKind::T), p[0], p[1], p[2]);
      if (margins(p).min_h > 0) {
        worst = std::max(worst, std::abs(t / f - 1));
        ++n;
      } else {
        apart += t > f * (1 + kRounding);
      }
    }
  }
  return {"9",
          "E_T = E_F whenever all h > 0",
          "equal",
          "differ by at most " + digits(worst, 1) + " of their value in " + digits(n) +
              " triangles with all h > 0 (and E_T > E_F in " + digits(apart) + " others)",
          worst < kRounding && n > 100,
          "99 angles, 101 weights"};
}

Claim obtuse_t() {
  bool best_h = true, misses = false;
  std::string found;
  for (const double angle : {0.75, 0.8, 0.85, 0.9, 0.95}) {
    const auto t = best(EnergyKind::T, angle);
    best_h = best_h && t.has_value();
    if (!t) continue;
    for (const EnergyKind kind : {EnergyKind::BP, EnergyKind::F, EnergyKind::BHs, EnergyKind::BH}) {
      const auto other = best(kind, angle);
      best_h = best_h && (!other || other->margins.min_h < t->margins.min_h);
    }
    misses = misses || t->margins.min_d < 0;
    found += (found.empty() ? "h = " : ", ") +
             digits(std::abs(t->margins.min_h) < kRounding ? 0 : t->margins.min_h, 2) +
             " (d = " + digits(t->margins.min_d, 2) + ") at " + digits(angle, 2) + "π";
  }
  return {"9",
          "For very obtuse triangles E_T gives the best h, but sometimes with d < 0",
          "best h, sometimes d < 0",
          "least " + found,
          best_h && misses,
          "at each of these angles every other energy's least h is lower, or it has no solution"};
}

Claim sign_of_weights() {
  bool holds = true;
  std::size_t n = 0;
  for (int k = 2; k < 50; ++k) {
    const double angle = k / 50.0;
    if (angle > 0.3 && angle < 0.5) continue;
    for (const EnergyKind kind : kKinds) {
      const auto found = best(kind, angle);
      if (!found) continue;
      holds = holds && (angle <= 0.3 ? found->weight > 0 : found->weight < 0);
      ++n;
    }
  }
  return {"9",
          "Large angles (low valence) ask for negative weights, small ones (high valence) for positive weights",
          "as Engwirda observed, by angles",
          "w > 0 for θ ≤ 0.3π and w < 0 for θ ≥ 0.5π in all " + digits(n) + " optima",
          holds && n > 50,
          "five energies, angles 0.02π apart; E_BH and E_BHs where they have a solution"};
}

/// Over all angles, with the best weight: how many triangles have their orthocenter inside, and the mean of the least
/// h.
struct Centering {
  std::size_t solved = 0, inside = 0;
  double mean_h = 0;
};
Centering centering(EnergyKind kind, double length_parameter) {
  EnergyModel model = paper_model(kind);
  model.gamma.value = model.h0.value = length_parameter;
  Centering c;
  for (int k = 1; k < 100; ++k) {
    const auto found = best_weight(model, k * kPi / 100);
    if (!found) continue;
    ++c.solved;
    c.inside += found->margins.min_h > 0;
    c.mean_h += found->margins.min_h;
  }
  c.mean_h /= static_cast<double>(std::max(c.solved, std::size_t{1}));
  return c;
}

Claim smaller_constants_center() {
  bool holds = true;
  std::string found;
  for (const EnergyKind kind : {EnergyKind::BP, EnergyKind::BHs}) {
    std::size_t before = 0;
    found += kind == EnergyKind::BP ? "E_BP: " : "; E_BHs: ";
    for (const double length_parameter : {1.0, 0.5, 0.15, 0.05}) {
      const Centering c = centering(kind, length_parameter);
      holds = holds && c.inside >= before;
      before = c.inside;
      found += (length_parameter < 1 ? ", " : "") + digits(c.inside) + " of " + digits(c.solved) + " at " +
               digits(length_parameter, 2);
    }
    holds = holds && before > centering(kind, 1).inside;
  }
  return {"6.1.2",
          "Smaller constants encourage E_BP and E_BHs towards well-centered orthocenters",
          "by setting smaller constants",
          "orthocenter inside with the best weight, by γ and −h°: " + found,
          holds,
          "99 angles, of which E_BHs has a solution where it is counted"};
}

/// Correlation of an inner vertex's valence with its weight less the mean of its neighbors', over the square of the
/// mean distance to them.
struct Correlation {
  double coefficient = 0;
  std::array<double, 2> mean = {};         ///< of low (five and less) and high (seven and more) valences
  std::array<std::size_t, 2> number = {};  ///< of such vertices
};
Correlation weight_by_valence(const Mesh& mesh) {
  std::vector<Vec2> pairs;
  Correlation c;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    double weights = 0, lengths = 0, n = 0;
    for (const HalfedgeId h : mesh.star(v)) {
      weights += mesh.weight(mesh.target(h));
      lengths += length(mesh.position(mesh.target(h)) - mesh.position(v));
      n += 1;
    }
    const double excess = (mesh.weight(v) - weights / n) * n * n / (lengths * lengths);
    pairs.push_back({n, excess});
    if (n == 6) continue;
    const std::size_t high = n > 6 ? 1 : 0;
    c.mean[high] += excess;
    ++c.number[high];
  }
  for (std::size_t i = 0; i < 2; ++i) c.mean[i] /= static_cast<double>(std::max(c.number[i], std::size_t{1}));
  Vec2 mean;
  for (const Vec2 p : pairs) mean = mean + (1 / static_cast<double>(pairs.size())) * p;
  double xy = 0, xx = 0, yy = 0;
  for (const Vec2 p : pairs) {
    const Vec2 d = p - mean;
    xy += d.x * d.y, xx += d.x * d.x, yy += d.y * d.y;
  }
  c.coefficient = xy / std::sqrt(xx * yy);
  return c;
}

Claim valence_and_weight(Effort effort) {
  bool holds = true;
  std::string found;
  for (const EnergyKind kind : {EnergyKind::BP, EnergyKind::T}) {
    auto mesh = random_mesh({.vertices = effort == Effort::full ? 400U : 120U});
    OptimizeOptions options = kind == EnergyKind::T ? *options_for("paper") : OptimizeOptions();
    options.objective = Objective::energy;
    options.energy = kind;
    options.paper.removal = Removal::none;
    options.paper.collapse_from = {};
    options.paper.inversion = Inversion::refuse;
    options.max_sweeps = 40;
    if (!mesh || !optimize(*mesh, options)) {
      holds = false;
      continue;
    }
    const Correlation c = weight_by_valence(*mesh);
    holds = holds && c.coefficient > 0.3 && c.mean[0] < 0 && c.mean[1] > 0;
    found += std::string(kind == EnergyKind::BP ? "E_BP" : "; E_T") + " correlation " + digits(c.coefficient, 2) +
             ", mean weight " + digits(c.mean[0], 2) + " at " + digits(c.number[0]) +
             " vertices of valence 5 and less, " + digits(c.mean[1], 2) + " at " + digits(c.number[1]) +
             " of 7 and more";
  }
  return {
      "6.2",
      "On optimized meshes low-valence nodes have negative weights, high-valence nodes positive ones",
      "Engwirda's observation",
      found,
      holds,
      "random points, positions and weights optimized without removals; weights less the mean of the neighbors', in "
      "units of the squared mean edge there"};
}

}  // namespace

Page make(Effort effort) {
  const int steps = effort == Effort::full ? 10000 : 1000;
  Page page;
  page.pictures = {drawings()};
  page.claims = {no_single_weight(steps),    two_weights(steps),        t_equals_f(), obtuse_t(), sign_of_weights(),
                 smaller_constants_center(), valence_and_weight(effort)};
  return page;
}

}  // namespace temper::gallery::fig09
