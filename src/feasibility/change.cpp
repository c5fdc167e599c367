// The program of a region: columns u⁺, u⁻ ≥ 0 of each free vertex, and e⁺, e⁻ ≥ 0 of each edge that has a free end.
//
//   Δw_v = unit_v (u⁺ − u⁻)          cost (u⁺ + u⁻) · 10⁻⁴: without rim a constant on all Δw is free otherwise
//   Δw_i − Δw_j = ℓ² (e⁺ − e⁻)       cost (e⁺ + e⁻) ℓ/2, the |Δw_i − Δw_j| / (2ℓ) of the edge
//   crossings                           bounds of e⁺ and e⁻, since one of them is zero in any optimum
//   heights, dual lengths            one row each
//
// Lengths are in units of the region's mean edge length. The sum of absolute differences changes few weights: only the
// neighborhood of bad triangles in a region gets other weights.
//
// On the sphere w is the potential, and Δw belongs to σ = σ₀ (1 − Δw/(2R²)), relative to the start. So a factor of all
// σ is the same Δw of all. Crossings are rows of their own. Without rim the Δw sum to zero: otherwise all σ could tend
// to zero together, which keeps all constraints. Elastic programs have one column more for each height and dual length,
// and two for each edge with crossings. These pay for violations, down to a floor.
#include "feasibility/change.hpp"

#include <algorithm>
#include <cmath>

#include "feasibility/lp_builder.hpp"

namespace temper {
namespace {

// Smaller changes, in their unit, are noise of the solver: ten times its tolerance on h/ℓ and d/ℓ, which are of that
// order.
constexpr double kNoChange = 1e-8;
// The cost of a unit of u, against ℓ/2 for an edge: so small that it decides only between equal sums over the edges.
constexpr double kTieBreak = 1e-4;
// The margin of constraints that may be 0, far above the rounding of the solvers and far below any use.
constexpr double kAboveZero = 1e-6;
// The second elastic program may violate this much more than the least, relative and absolute: its own tolerance.
constexpr double kSameViolation = 1e-9;

struct Program {
  LpBuilder lp;
  std::vector<double> units;                            ///< columns 2 i and 2 i + 1 are u⁺ and u⁻ of vertex i
  std::vector<std::pair<int, double>> change_costs;     ///< (column, cost)
  std::vector<std::pair<int, double>> violation_costs;  ///< none unless elastic
};

class ProgramBuilder {
 public:
  ProgramBuilder(const RegionProblem& problem, const Region& region, bool elastic)
      : problem_(problem),
        demand_(problem.demand),
        region_(region),
        start_(problem.start),
        margin_(problem.margin),
        floor_(elastic ? problem.floor : problem.margin),
        elastic_(elastic) {}

  Program build() {
    const std::vector<WeightEdge> edges = demand_.edges_of(region_.cells);
    p_.units = weight_units(region_.free, edges);
    for (std::size_t i = 0; i < region_.free.size(); ++i) {
      for (int sign = 0; sign < 2; ++sign) p_.change_costs.emplace_back(p_.lp.add_column(0, 0, kUnbounded), kTieBreak);
    }
    double total = 0;
    for (const WeightEdge& edge : edges) total += std::sqrt(edge.squared_length);
    const double mean = total / static_cast<double>(edges.size());
    for (const WeightEdge& edge : edges) add_edge(edge, mean);
    if (!region_.has_rim && !space().is_plane()) add_sum();
    for (const WeightConstraint& c : demand_.constraints_of(region_.cells, true)) {
      if (c.kind != WeightConstraint::Kind::crossing || !crossings_are_differences()) add_rows(c);
    }
    for (const WeightConstraint& c : demand_.equations_of(region_.cells)) add_equation(demand_.linear_form(c));
    return std::move(p_);
  }

 private:
  /// Says whether there are crossings, as bounds of the columns of edges.
  [[nodiscard]] bool crossings_are_differences() const { return demand_.has_crossings() && space().is_plane(); }
  [[nodiscard]] const Space& space() const { return demand_.space(); }
  [[nodiscard]] double start(VertexId v) const { return potential_of(space(), start_[v]); }
  /// Adds factor · the change of v's potential to the row.
  bool add_potential(VertexId v, double factor) { return add_weight(v, factor * scale_at(space(), start_[v])); }
  /// Adds factor · Δw_v to the row, unless v is on the rim, where Δw is zero.
  bool add_weight(VertexId v, double factor) {
    const std::size_t i = index_of(region_.free, v);
    if (i == region_.free.size() || region_.free[i] != v) return false;
    p_.lp.add_entry(static_cast<int>(2 * i), factor * p_.units[i]);
    p_.lp.add_entry(static_cast<int>(2 * i + 1), -factor * p_.units[i]);
    return true;
  }
  int add_violation(double cost) {
    const int column = p_.lp.add_column(0, 0, kUnbounded);
    p_.violation_costs.emplace_back(column, cost);
    return column;
  }

  void add_edge(const WeightEdge& edge, double mean_length) {
    const auto& [i, j, squared_length] = edge;
    const double l = std::sqrt(squared_length);
    const bool i_free = add_weight(i, 1 / (l * l)), j_free = add_weight(j, -1 / (l * l));
    if (!i_free && !j_free) return;
    // margin ≤ d/ℓ ≤ 1 − margin, as bounds of (Δw_i − Δw_j)/ℓ².
    const double before = (start(i) - start(j)) / (l * l);
    const auto low = [&](double margin) { return -(1 - 2 * margin) - before; };
    const auto high = [&](double margin) { return (1 - 2 * margin) - before; };
    const bool bounded = crossings_are_differences();
    const auto least = [&](double x) { return bounded ? std::max(x, 0.0) : 0; };
    const auto most = [&](double x) { return bounded ? std::max(x, 0.0) : kUnbounded; };
    const int up = p_.lp.add_column(0, least(low(floor_)), most(high(floor_)));
    const int down = p_.lp.add_column(0, least(-high(floor_)), most(-low(floor_)));
    p_.change_costs.emplace_back(up, 0.5 * l / mean_length);
    p_.change_costs.emplace_back(down, 0.5 * l / mean_length);
    p_.lp.add_entry(up, -1);
    p_.lp.add_entry(down, 1);
    p_.lp.end_row(0, 0);
    if (!elastic_ || !bounded) return;
    const int below = add_violation(0.5), above = add_violation(0.5);  // d/ℓ is half of w/ℓ²
    p_.lp.add_entry(up, 1);
    p_.lp.add_entry(down, -1);
    p_.lp.add_entry(below, 1);
    p_.lp.add_entry(above, -1);
    p_.lp.end_row(low(margin_), high(margin_));
  }

  void add_sum() {
    const double unit = *std::max_element(p_.units.begin(), p_.units.end());
    for (const VertexId v : region_.free) add_weight(v, 1 / unit);
    p_.lp.end_row(0, 0);
  }

  void add_equation(const LinearForm& form) {
    bool any_free = false;
    for (int k = 0; k < form.size; ++k) any_free = add_potential(form.vertices[k], form.coefficients[k]) || any_free;
    if (!any_free) return;
    const double before = numerator_of(form, [&](VertexId v) { return start(v); });
    p_.lp.end_row(-before, -before);
  }
  void add_rows(const WeightConstraint& constraint) {
    const LinearForm form = demand_.linear_form(constraint);
    add_row(form, problem_.margin_of(constraint, margin_), elastic_);
    if (elastic_ && floor_ > -kUnbounded) add_row(form, problem_.margin_of(constraint, floor_), false);
  }
  void add_row(const LinearForm& form, double margin, bool may_violate) {
    const LinearForm kept = beyond_margin(form, margin);
    bool any_free = false;
    for (int k = 0; k < kept.size; ++k) any_free = add_potential(kept.vertices[k], kept.coefficients[k]) || any_free;
    if (!any_free) return;
    if (may_violate) p_.lp.add_entry(add_violation(1), 1);
    const auto potential = [&](VertexId v) { return start(v); };
    p_.lp.end_row(margin * scale_of(form, potential) - numerator_of(form, potential), kUnbounded);
  }

  const RegionProblem& problem_;
  const Demand& demand_;
  const Region& region_;
  const IdVector<VertexId, double>& start_;
  double margin_, floor_;
  bool elastic_;
  Program p_;
};

/// Without rim a constant on all weights, or a factor of all σ, is free: returns the change that most vertices share.
double common_change(std::vector<double> changes, double tolerance) {
  std::sort(changes.begin(), changes.end());
  std::size_t most = 0;
  double common = 0;
  for (std::size_t first = 0, last = 0; first < changes.size(); ++first) {
    while (last < changes.size() && changes[last] <= changes[first] + tolerance) ++last;
    if (last - first <= most) continue;
    most = last - first;
    common = changes[first + most / 2];
  }
  return common;
}

RegionChange read_change(const RegionProblem& problem, const Region& region, const std::vector<double>& units,
                         const LpSolution& solution) {
  RegionChange result;
  result.status = solution.status;
  if (solution.status != LpStatus::optimal) return result;
  for (std::size_t i = 0; i < region.free.size(); ++i) {
    result.change.push_back(units[i] * (solution.primal[2 * i] - solution.primal[2 * i + 1]));
  }
  const Space& space = problem.demand.space();
  if (!region.has_rim) {
    const double least_unit = *std::min_element(units.begin(), units.end());
    const double common = common_change(result.change, kNoChange * least_unit);
    for (double& change : result.change) change = (change - common) / (1 - slope_of_scale(space) * common);
  }
  for (std::size_t i = 0; i < region.free.size(); ++i) {
    if (std::abs(result.change[i]) <= kNoChange * units[i]) result.change[i] = 0;
    result.change[i] *= scale_at(space, problem.start[region.free[i]]);
  }
  return result;
}

}  // namespace

double RegionProblem::margin_of(const WeightConstraint& constraint, double asked) const {
  if (!demand.allows_zero()) return asked;
  const double least = std::min(asked, kAboveZero);
  if (!demand.has_margin(constraint)) return least;
  const auto potential = [&](VertexId v) { return potential_of(demand.space(), start[v]); };
  const double before = value_of(demand.linear_form(constraint), potential);
  return before < 0 ? asked : std::clamp(before, least, asked);
}

RegionChange least_change(const RegionProblem& problem, const Region& region, LpSolver& solver) {
  Program p = ProgramBuilder(problem, region, false).build();
  for (const auto& [column, cost] : p.change_costs) p.lp.set_cost(column, cost);
  return read_change(problem, region, p.units, solver.solve(p.lp.problem()));
}

RegionChange least_violation(const RegionProblem& problem, const Region& region, LpSolver& solver) {
  Program p = ProgramBuilder(problem, region, true).build();
  for (const auto& [column, cost] : p.violation_costs) p.lp.set_cost(column, cost);
  const LpSolution least = solver.solve(p.lp.problem());
  if (least.status != LpStatus::optimal) return read_change(problem, region, p.units, least);
  for (const auto& [column, cost] : p.violation_costs) {
    p.lp.set_cost(column, 0);
    p.lp.add_entry(column, cost);
  }
  p.lp.end_row(-kUnbounded, least.objective * (1 + kSameViolation) + kSameViolation);
  for (const auto& [column, cost] : p.change_costs) p.lp.set_cost(column, cost);
  const LpSolution least_moved = solver.solve(p.lp.problem());
  return read_change(problem, region, p.units, least_moved.status == LpStatus::optimal ? least_moved : least);
}

}  // namespace temper
