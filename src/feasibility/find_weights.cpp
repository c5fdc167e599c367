// The whole mesh: solves regions that need weights one by one, grows a region if the outside is in the way, and
// collects verdicts.
//
//   if the ring of one bad triangle is a proof already, try nothing else (except for elastic weights);
//   free the neighborhoods of bad triangles; until no region changes:
//     least change of each region                      solved: done with it
//     else the region's own margin, the rest left out  below the demand: proof found, done with it
//     else more rings, merging regions that meet
//
// A region's own margin is an upper bound of the mesh's margin. So the loop ends with an answer or a proof, at the
// latest when a region is a whole component.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/assert.hpp"
#include "feasibility/best_weights.hpp"
#include "feasibility/certify.hpp"
#include "feasibility/change.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/region.hpp"
#include "mesh/bad_triangles.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

constexpr int kMoreRings = 2;   // one ring each time would solve each program twice as often
constexpr int kHalvings = 30;   // of the requested margin: down to the rounding of the programs
constexpr double kKept = 1e-9;  // a margin is kept if at most this is lacking: the solvers' tolerance

/// A finished region: its change of weights, or the proof that there is none.
struct RegionResult {
  Region region;
  std::optional<RegionChange> change;
  Bound bound;  ///< without change
};

class WeightFinder {
 public:
  WeightFinder(const Demand& demand, LpSolver& solver, const WeightOptions& options)
      : demand_(demand),
        solver_(solver),
        options_(options),
        start_(options.from_input ? demand.weights() : VertexWeights(demand.n_vertices(), 0.0)),
        components_(components_of(demand)) {}

  WeightReport run() {
    if (options_.goal == WeightGoal::margin) measure_components();
    double asked = std::min(options_.margin, demand_.has_duals() ? small_margin_ : small_margin_ / 2);
    if (options_.goal == WeightGoal::elastic) {
      violate_least(asked);
      return report(asked);
    }
    if (refuted_by_a_ring(asked)) return report(asked);
    for (int round = 0; round < kHalvings && asked > kNoMargin; ++round) {
      attempt(asked, asked);
      if (failures() == 0) break;
      note_bound(asked);
      asked = bound_->best.margin / 2;
    }
    return report(asked);
  }

 private:
  [[nodiscard]] double value(const WeightConstraint& constraint, const VertexWeights& weights) const {
    return value_of(demand_.linear_form(constraint),
                    [&](VertexId v) { return potential_of(demand_.space(), weights[v]); });
  }
  [[nodiscard]] Bound bound_of(std::span<const CellId> cells) const { return bound_margin(demand_, cells, solver_); }
  [[nodiscard]] RegionProblem problem(double asked, double floor = -kUnbounded) const {
    return {demand_, start_, asked, floor};
  }

  /// A best margin that rules out all weights. Dual lengths are all zero for w = |x|², so their best margin is never
  /// below zero.
  [[nodiscard]] bool is_hopeless(double margin) const {
    return margin <= (demand_.has_duals() ? kNoMargin : -kNoMargin);
  }
  /// The margin that is refuted when no weights satisfy the constraints.
  [[nodiscard]] double refuted_margin() const {
    return demand_.refuted_margin(std::clamp(options_.margin, kLeastRefutedDual, kRefutedDual));
  }

  /// The best margins of components that fit into one program.
  void measure_components() {
    for (const Region& component : components_) {
      if (component.cells.size() > options_.whole) continue;
      Bound bound = bound_of(component.cells);
      if (bound.best.status != LpStatus::optimal) bound.best.margin = 0;
      if (bound.best.margin >= small_margin_) continue;
      small_margin_ = bound.best.margin;
      worst_component_ = std::move(bound);
    }
  }

  [[nodiscard]] bool is_bad(CellId cell, double asked) const {
    return demand_.margin_of(cell, start_) < asked || !demand_.is_kept(cell, start_);
  }

  /// The cheapest possible proof, when programs of regions may be large: the ring of one bad triangle.
  bool refuted_by_a_ring(double asked) {
    for (const Region& component : components_) {
      if (component.cells.size() <= options_.whole) continue;
      for (const CellId cell : component.cells) {
        if (!is_bad(cell, asked)) continue;
        Bound bound = bound_of(ring_of(demand_, cell));
        if (bound.best.status != LpStatus::optimal || !is_hopeless(bound.best.margin)) continue;
        if (!bound_ || bound.best.margin < bound_->best.margin) bound_ = std::move(bound);
        // No best margin of dual lengths is less than zero: the first proof is as good as any.
        if (demand_.has_duals() && proves(*bound_)) return true;
      }
    }
    return bound_ && proves(*bound_);
  }

  /// Keeps the certificate of a ring's bound, if there is one.
  bool proves(const Bound& bound) {
    bound_is_exact_ = false;
    refuted_ = certify_bound(bound, refuted_margin());
    if (refuted_->terms.empty()) refuted_.reset();
    return refuted_.has_value();
  }

  [[nodiscard]] VertexMask first_mask(double asked) const {
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

  /// With `floor` below `asked`, a region that cannot have the margin `asked` violates it down to `floor`.
  void attempt(double asked, double floor) {
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
  std::optional<RegionResult> take_result(const Region& region) {
    for (RegionResult& result : results_) {
      if (result.region.free.size() == region.free.size() && result.region.free.front() == region.free.front()) {
        return std::move(result);
      }
    }
    return std::nullopt;
  }

  /// Nothing: the region must grow.
  std::optional<RegionResult> solve(Region& region, double asked, double floor) {
    RegionChange change = least_change(problem(asked), region, solver_);
    if (change.status != LpStatus::optimal && floor < asked)
      change = least_violation(problem(asked, floor), region, solver_);
    if (change.status == LpStatus::optimal) return RegionResult{std::move(region), std::move(change), {}};
    Bound bound = bound_of(region.cells);
    const bool below = demand_.has_duals() ? is_hopeless(bound.best.margin) : bound.best.margin < floor;
    const bool proof = bound.best.status == LpStatus::optimal && below;
    if (!proof && region.has_rim) return std::nullopt;
    return RegionResult{std::move(region), std::nullopt, std::move(bound)};
  }

  [[nodiscard]] std::size_t failures() const {
    return static_cast<std::size_t>(
        std::count_if(results_.begin(), results_.end(), [](const RegionResult& o) { return !o.change; }));
  }

  /// Keeps the least bound, and its verdict on the first requested margin.
  void note_bound(double asked) {
    for (RegionResult& result : results_) {
      if (result.change) continue;
      if (result.bound.best.status != LpStatus::optimal) result.bound.best.margin = 0;
      bound_is_exact_ = bound_is_exact_ && !result.region.has_rim;
      if (bound_ && bound_->best.margin <= result.bound.best.margin) continue;
      bound_ = result.bound;
    }
    if (bound_->best.margin >= asked) bound_->best.margin = 0;  // the solver contradicts itself: nothing is known
    if (!refuted_) refuted_ = certify_bound(*bound_, bound_->best.margin < kNoMargin ? refuted_margin() : asked);
  }

  [[nodiscard]] Certificate certify_bound(const Bound& bound, double margin) const {
    if (bound.best.status != LpStatus::optimal) return {};
    return certify(demand_, bound, margin);
  }

  /// The least sum of violations may make some cells bad where other weights make none bad. So half of the best margin
  /// is the floor of violations, unless no weights exist.
  void violate_least(double asked) {
    double floor = asked;
    attempt(asked, floor);
    for (int round = 0; round < kHalvings && failures() > 0; ++round) {
      note_bound(floor);
      floor = bound_->best.margin / 2;
      if (floor <= kNoMargin) break;
      attempt(asked, floor);
    }
    for (RegionResult& result : results_) {
      if (result.change) continue;
      RegionChange change = least_violation(problem(asked), result.region, solver_);
      if (change.status == LpStatus::optimal) result.change = std::move(change);
    }
  }

  [[nodiscard]] VertexWeights changed_weights() const {
    VertexWeights weights = start_;
    for (const RegionResult& result : results_) {
      if (!result.change) continue;
      for (std::size_t i = 0; i < result.region.free.size(); ++i) {
        const double change = result.change->change[i];
        double& w = weights[result.region.free[i]];
        if (change != 0) w = changed_weight(demand_.space(), w, change);
      }
    }
    return weights;
  }

  WeightReport report(double asked) {
    WeightReport r;
    r.asked = asked;
    r.weights = changed_weights();
    r.programs = results_.size();
    for (const RegionResult& result : results_) r.largest = std::max(r.largest, result.region.cells.size());
    measure(r);
    const bool all_good = std::all_of(demand_.cells().begin(), demand_.cells().end(),
                                      [&](CellId cell) { return demand_.is_kept(cell, r.weights); });
    const bool found = all_good && asked > kNoMargin && failures() == 0;
    judge_margin(r, found);
    judge(r, found);
    if (options_.goal == WeightGoal::elastic) add_violations(r);
    return r;
  }

  void measure(WeightReport& r) const {
    r.attained = least_margin(demand_, r.weights);
    const auto change = [&](VertexId v) { return r.weights[v] - start_[v]; };
    for (const VertexId v : demand_.vertices()) r.moved += change(v) != 0 ? 1 : 0;
    r.change = weight_change(demand_, start_, r.weights);
  }

  void judge_margin(WeightReport& r, bool found) const {
    const bool all_measured = options_.goal == WeightGoal::margin &&
                              std::all_of(components_.begin(), components_.end(), [&](const Region& component) {
                                return component.cells.size() <= options_.whole;
                              });
    if (all_measured) {
      r.margin = small_margin_;
      r.margin_kind = demand_.has_duals() && small_margin_ > kNoMargin ? MarginKind::at_least : MarginKind::exact;
    } else if (bound_) {
      r.margin = std::min(bound_->best.margin, small_margin_);
      r.margin_kind = bound_is_exact_ ? MarginKind::exact : MarginKind::at_most;
    } else if (found) {
      r.margin = std::min(r.attained, small_margin_);
      r.margin_kind = MarginKind::at_least;
    } else {  // a component that is one program has no good weights; others were not tried
      r.margin = small_margin_;
      r.margin_kind = MarginKind::at_most;
    }
  }

  void judge(WeightReport& r, bool found) const {
    if (refuted_) {
      r.certificate = *refuted_;
    } else if (worst_component_ && small_margin_ <= kNoMargin) {
      r.certificate = certify_bound(*worst_component_, refuted_margin());
    }
    const bool refuted = !r.certificate.terms.empty() && r.certificate.margin == refuted_margin();
    r.verdict = refuted ? Feasibility::infeasible : found ? Feasibility::feasible : Feasibility::undecided;
    switch (options_.goal) {
      case WeightGoal::margin:
        r.solved = r.verdict == Feasibility::feasible;
        break;
      case WeightGoal::change:
        r.solved = r.verdict == Feasibility::feasible && r.asked == options_.margin;
        break;
      case WeightGoal::elastic:
        r.solved = failures() == 0;
        break;
      case WeightGoal::center:
      case WeightGoal::accuracy:
        break;
    }
  }

  void add_violations(WeightReport& r) const {
    for (const WeightConstraint& c : demand_.constraints_of(all_cells(demand_))) {
      const double got = value(c, r.weights);
      if (got < r.asked - kKept) r.violations.push_back({c, got, r.asked - got, demand_.angle_deg(c)});
    }
    std::stable_sort(r.violations.begin(), r.violations.end(),
                     [](const Violation& a, const Violation& b) { return a.shortfall > b.shortfall; });
  }

  const Demand& demand_;
  LpSolver& solver_;
  const WeightOptions& options_;
  VertexWeights start_;
  std::vector<Region> components_;

  double small_margin_ = 1;  ///< least best margin of the components measured; 1: none was
  std::optional<Bound> worst_component_;
  std::vector<RegionResult> results_;
  std::optional<Bound> bound_;  ///< the least
  bool bound_is_exact_ = true;
  std::optional<Certificate> refuted_;
};

}  // namespace

std::string_view name(Feasibility verdict) {
  constexpr std::array<std::string_view, 3> kNames = {"feasible", "infeasible", "undecided"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string_view name(MarginKind is) {
  constexpr std::array<std::string_view, 3> kNames = {"exact", "at_least", "at_most"};
  return kNames[static_cast<std::size_t>(is)];
}

double weight_change(const Mesh& mesh, const VertexWeights& from, const VertexWeights& to) {
  return weight_change(TriangleDemand(mesh, Constraints::well_centered), from, to);
}

WeightReport find_weights(const Demand& demand, LpSolver& solver, const WeightOptions& options, ConvexSolver* convex) {
  if (!is_convex(options.goal)) return WeightFinder(demand, solver, options).run();
  if (std::optional<WeightReport> best = best_weights(demand, *convex, options, options.margin))
    return *std::move(best);
  // The linear programs say if there are weights at all, and which margin they can have.
  WeightOptions any = options;
  any.goal = WeightGoal::margin;
  WeightReport report = WeightFinder(demand, solver, any).run();
  report.solved = false;
  const bool may_have_less = options.goal == WeightGoal::accuracy && report.asked < options.margin;
  if (report.verdict != Feasibility::feasible || !may_have_less) return report;
  std::optional<WeightReport> best = best_weights(demand, *convex, options, report.asked);
  if (!best) return report;
  best->margin = report.margin;
  best->margin_kind = report.margin_kind;
  best->certificate = std::move(report.certificate);
  return *std::move(best);
}

std::optional<InputError> expect_goal(const WeightOptions& options, const ConvexSolver* convex) {
  if (is_convex(options.goal) && convex == nullptr)
    return InputError{ErrorCode::invalid_option, "", "goal: center and accuracy need a solver of convex programs"};
  if (!(options.offset_factor >= 0 && options.boundary_offset_factor >= 0 &&
        options.offset_factor + options.boundary_offset_factor < kUnbounded)) {
    return InputError{ErrorCode::invalid_option, "",
                      "offset_factor, boundary_offset_factor: expected finite numbers that are not negative"};
  }
  const bool elastic = options.goal == WeightGoal::elastic;
  if (options.margin < 0.5 && (elastic ? options.margin >= 0 : options.margin > 0)) return std::nullopt;
  return InputError{ErrorCode::invalid_option, "",
                    "margin: expected a number above 0 and below 0.5, found " + std::to_string(options.margin)};
}

Expected<WeightReport> find_weights(const Mesh& mesh, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  if (has_quadrilaterals(mesh)) {
    return InputError{ErrorCode::unsupported, "",
                      "the mesh has quadrilaterals, whose corners keep their weights; expected triangles alone. Next: "
                      "optimize moves the vertices around quadrilaterals"};
  }
  for (const HalfedgeId h : options.edges) {
    if (h.index >= mesh.n_halfedges()) {
      return InputError{ErrorCode::index_out_of_range, "",
                        "edges: expected halfedges 0 to " + std::to_string(mesh.n_halfedges() - 1) + ", found " +
                            std::to_string(h.index)};
    }
  }
  if (!options.edges.empty() && options.constraints != Constraints::regular) {
    return InputError{ErrorCode::invalid_option, "", "edges: only constraints regular are about some edges"};
  }
  if (options.constraints == Constraints::completely_well_centered) {
    return InputError{ErrorCode::invalid_option, "",
                      "constraints: expected well_centered, heights_only or regular, found completely_well_centered: "
                      "it is for tetrahedra. Next: well_centered, which is as much for triangles"};
  }
  if (auto error = expect_goal(options, convex)) return *std::move(error);
  return find_weights(TriangleDemand(mesh, options.constraints, options.edges), solver, options, convex);
}

}  // namespace temper
