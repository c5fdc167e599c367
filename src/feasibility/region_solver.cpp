#include "feasibility/region_solver.hpp"

#include <utility>

namespace temper {
namespace {

constexpr int kMoreRings = 2;  // one ring each time would solve each program twice as often
// Elastic regions grow while that takes this part off the sum of all violations.
constexpr double kWorthGrowing = 0.02;

}  // namespace

VertexMask RegionSolver::first_mask(double asked) const {
  VertexMask mask(demand_.n_vertices(), 0);
  for (const Region& component : components_) {
    std::vector<VertexId> bad;
    for (const CellId cell : component.cells) {
      if (is_bad(cell, asked)) demand_.add_corners(cell, bad);
    }
    if (bad.empty()) continue;
    if (component.cells.size() <= options_.whole) bad = component.free;
    for (const VertexId v : bad) mask[v] = 1;
    grow(demand_, mask, std::move(bad), options_.rings);
  }
  return mask;
}

void RegionSolver::attempt(double asked, double floor) {
  VertexMask mask = first_mask(asked);
  results_.clear();
  for (bool grown = true; grown;) {
    grown = false;
    std::vector<RegionResult> next;
    for (Region& region : regions_of(demand_, mask, demand_.has_duals())) {
      if (std::optional<RegionResult> known = take_result(region)) {
        next.push_back(*std::move(known));
      } else if (std::optional<RegionResult> found = solve(region, asked, floor)) {
        next.push_back(*std::move(found));
      } else {
        grow(demand_, mask, region.free, kMoreRings);
        grown = true;
      }
    }
    results_ = std::move(next);
  }
}

/// The result of the last round, if the region has not changed. Free vertices only increase, so first and number
/// decide.
std::optional<RegionResult> RegionSolver::take_result(const Region& region) {
  for (RegionResult& result : results_) {
    if (result.region.free.size() == region.free.size() && result.region.free.front() == region.free.front()) {
      return std::move(result);
    }
  }
  return std::nullopt;
}

RegionChange RegionSolver::change_of(const Region& region, double asked) const {
  if (has_bound_of_conflict(region)) return least_squares(problem(asked), region, *convex_);
  return least_change(problem(asked), region, solver_);
}

/// The linear program of a large region is slow. The convex one has found where the conflict is.
Bound RegionSolver::bound_without(const Region& region, const RegionChange& change) const {
  if (!has_bound_of_conflict(region)) return bound_of(region.cells);
  const std::vector<CellId> cells = cells_of(demand_, change.conflict);
  return cells.empty() ? Bound() : bound_of(cells);
}

/// Nothing: the region must grow.
std::optional<RegionResult> RegionSolver::solve(Region& region, double asked, double floor) {
  if (must_stop()) return RegionResult{std::move(region), std::nullopt, {}};
  RegionChange change = change_of(region, asked);
  if (must_stop()) return RegionResult{std::move(region), std::nullopt, {}};
  if (change.status != LpStatus::optimal && floor < asked) change = violation_of(region, asked, floor);
  if (change.status == LpStatus::optimal) return RegionResult{std::move(region), std::move(change), {}};
  Bound bound = bound_without(region, change);
  // Only a best margin of all constraints alike, and an exact one, rules out smaller margins than itself.
  const bool by_sign = demand_.has_duals() && (demand_.constraints() != Constraints::distances || !is_plane());
  const bool below = by_sign ? is_hopeless(bound.best.margin) : bound.best.margin < floor;
  const bool proof = bound.best.status == LpStatus::optimal && below;
  if (!proof && region.has_rim) return std::nullopt;
  RegionResult result{std::move(region), std::nullopt, std::move(bound)};
  if (options_.goal == WeightGoal::least)
    result.elastic = least_squares(problem(asked), result.region, *convex_, MayViolate::least);
  return result;
}

RegionChange RegionSolver::violation_of(const Region& region, double asked, double floor) const {
  if (!is_convex(region)) return least_violation(problem(asked, floor), region, solver_);
  return least_squares(problem(asked, floor), region, *convex_, MayViolate::least);
}

void RegionSolver::violate(double asked) {
  double before = kUnbounded;
  for (int rings = kMoreRings; !must_stop(); rings *= 2) {
    double sum = 0;
    bool may_grow = false;
    for (RegionResult& result : results_) {
      if (result.change) continue;
      if (result.elastic.status != LpStatus::optimal) result.elastic = violation_of(result.region, asked, -kUnbounded);
      sum += result.elastic.violation;
      may_grow = may_grow || (result.region.has_rim && is_convex(result.region));
    }
    if (!may_grow || !(sum < (1 - kWorthGrowing) * before)) break;
    before = sum;
    grow_unsolved(rings);
  }
  for (RegionResult& result : results_) {
    if (result.change) continue;
    if (options_.goal == WeightGoal::fewest)
      result.elastic = least_squares(problem(asked), result.region, *convex_, MayViolate::few);
    if (result.elastic.status == LpStatus::optimal) result.change = std::move(result.elastic);
  }
}

void RegionSolver::grow_unsolved(int rings) {
  VertexMask mask(demand_.n_vertices(), 0);
  for (const RegionResult& result : results_) {
    for (const VertexId v : result.region.free) mask[v] = 1;
  }
  for (const RegionResult& result : results_) {
    if (!result.change) grow(demand_, mask, result.region.free, rings);
  }
  std::vector<RegionResult> next;
  for (Region& region : regions_of(demand_, mask, demand_.has_duals())) {
    std::optional<RegionResult> known = take_result(region);
    next.push_back(known ? *std::move(known) : RegionResult{std::move(region), std::nullopt, {}});
  }
  results_ = std::move(next);
}

VertexWeights RegionSolver::changed_weights() const {
  VertexWeights weights = start_;
  for (const RegionResult& result : results_) {
    const RegionChange& found = result.change ? *result.change : result.elastic;
    for (std::size_t i = 0; i < found.change.size(); ++i) {
      const double change = found.change[i];
      double& w = weights[result.region.free[i]];
      if (change != 0) w = changed_weight(demand_.space(), w, change);
    }
  }
  return weights;
}

}  // namespace temper
