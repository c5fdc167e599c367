// The regions of a mesh that need weights, solved one by one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "feasibility/certify.hpp"
#include "feasibility/change.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/region.hpp"

namespace temper {

/// A finished region: its change of weights, or the proof that there is none.
struct RegionResult {
  Region region;
  std::optional<RegionChange> change;
  Bound bound;                ///< without change
  RegionChange elastic = {};  ///< without change: what violates least
};

class RegionSolver {
 public:
  /// `convex` is for the goals least, fewest, and elastic, which can do without.
  RegionSolver(const Demand& demand, LpSolver& solver, const WeightOptions& options, ConvexSolver* convex)
      : demand_(demand),
        solver_(solver),
        convex_(convex),
        options_(options),
        start_(options.from_input ? demand.weights() : VertexWeights(demand.n_vertices(), 0.0)),
        components_(components_of(demand)) {
    if (options.goal == WeightGoal::elastic && !demand.equations_of(all_cells(demand)).empty()) convex_ = nullptr;
  }

  [[nodiscard]] const VertexWeights& start() const { return start_; }
  [[nodiscard]] const std::vector<Region>& components() const { return components_; }
  /// The results of the last attempt.
  [[nodiscard]] std::vector<RegionResult>& results() { return results_; }
  [[nodiscard]] const std::vector<RegionResult>& results() const { return results_; }

  [[nodiscard]] bool must_stop() const { return options_.must_stop && options_.must_stop(); }
  /// The number of regions without weights.
  [[nodiscard]] std::size_t failures() const {
    return static_cast<std::size_t>(
        std::count_if(results_.begin(), results_.end(), [](const RegionResult& o) { return !o.change; }));
  }
  [[nodiscard]] Bound bound_of(std::span<const CellId> cells) const { return bound_margin(demand_, cells, solver_); }
  [[nodiscard]] RegionProblem problem(double asked, double floor = -kUnbounded) const {
    return {demand_, start_, asked, floor, options_.must_stop};
  }
  /// A best margin that rules out all weights. Dual lengths are all zero for w = |x|², so their best margin is never
  /// below zero, unless heights count, too.
  [[nodiscard]] bool is_hopeless(double margin) const {
    return margin <= (demand_.has_duals() ? kNoMargin : -kNoMargin);
  }
  [[nodiscard]] bool is_bad(CellId cell, double asked) const {
    return (!demand_.allows_zero() && demand_.margin_of(cell, start_) < asked) || !demand_.is_kept(cell, start_);
  }

  /// Says whether the bound of a region is of a conflict in it, as the convex program finds it.
  [[nodiscard]] bool has_bound_of_conflict(const Region& region) const {
    return options_.goal == WeightGoal::least || (is_elastic() && region.cells.size() > options_.whole);
  }

  /// Solves all regions for a margin. With `floor` below `asked`, a region that cannot have the margin `asked` violates
  /// it down to `floor`.
  void attempt(double asked, double floor);
  /// Finds elastic weights for the regions without weights, by the goal. They grow while that lowers violations much.
  void violate(double asked);
  /// The weights at the start with the changes of the regions.
  [[nodiscard]] VertexWeights changed_weights() const;

 private:
  [[nodiscard]] bool is_plane() const { return demand_.space().is_plane(); }
  [[nodiscard]] VertexMask first_mask(double asked) const;
  /// The best change of a region by the goal.
  [[nodiscard]] RegionChange change_of(const Region& region, double asked) const;
  /// Says whether the convex program finds the elastic weights of a region. Linear programs of large regions are slow.
  [[nodiscard]] bool is_convex(const Region& region) const {
    return options_.goal == WeightGoal::fewest ||
           (is_elastic() && (region.has_rim || region.cells.size() > options_.whole));
  }
  [[nodiscard]] bool is_elastic() const {
    return convex_ != nullptr && (options_.goal == WeightGoal::elastic || options_.goal == WeightGoal::fewest);
  }
  [[nodiscard]] RegionChange violation_of(const Region& region, double asked, double floor) const;
  /// Adds rings of vertices to the regions without weights, which may merge with others.
  void grow_unsolved(int rings);
  /// A bound of the margin that a region without this change can have.
  [[nodiscard]] Bound bound_without(const Region& region, const RegionChange& change) const;
  std::optional<RegionResult> take_result(const Region& region);
  std::optional<RegionResult> solve(Region& region, double asked, double floor);

  const Demand& demand_;
  LpSolver& solver_;
  ConvexSolver* convex_;
  const WeightOptions& options_;
  VertexWeights start_;
  std::vector<Region> components_;
  std::vector<RegionResult> results_;
};

}  // namespace temper
