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
#include "feasibility/constraints.hpp"
#include "feasibility/region_solver.hpp"
#include "mesh/bad_triangles.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

constexpr int kHalvings = 30;      // of the requested margin: down to the rounding of the programs
constexpr double kLessMargin = 8;  // of the next margin after a bound that may be far above what weights can have
constexpr double kKept = 1e-9;     // a margin is kept if at most this is lacking: the solvers' tolerance

bool may_violate(WeightGoal goal) { return goal == WeightGoal::elastic || goal == WeightGoal::fewest; }
bool needs_convex(WeightGoal goal) {
  return is_convex(goal) || goal == WeightGoal::least || goal == WeightGoal::fewest;
}

double value(const Demand& demand, const WeightConstraint& constraint, const VertexWeights& weights) {
  return value_of(demand.linear_form(constraint), [&](VertexId v) { return potential_of(demand.space(), weights[v]); });
}

class WeightFinder {
 public:
  WeightFinder(const Demand& demand, LpSolver& solver, const WeightOptions& options, ConvexSolver* convex)
      : demand_(demand), solver_(solver), options_(options), regions_(demand, solver, options, convex) {}

  WeightReport run() {
    if (options_.goal == WeightGoal::margin) measure_components();
    double asked = std::min(options_.margin, demand_.is_stretchable() ? small_margin_ : small_margin_ / 2);
    if (is_elastic()) {
      violate_least(asked);
      return report(asked);
    }
    if (!is_least() && refuted_by_a_ring(asked)) return report(asked);
    for (int round = 0; round < kHalvings && asked > kNoMargin; ++round) {
      regions_.attempt(asked, asked);
      if (regions_.failures() == 0 || regions_.must_stop()) break;
      note_bound(asked);
      if (bound_is_of_conflict_ && bound_->best.margin <= kNoMargin) break;
      asked = next_margin(asked);
    }
    return report(asked);
  }

 private:
  [[nodiscard]] bool is_least() const { return options_.goal == WeightGoal::least; }
  [[nodiscard]] bool is_elastic() const { return may_violate(options_.goal); }

  /// The certificate of a bound that rules out all weights.
  [[nodiscard]] Certificate refute_all(const Bound& bound) const {
    const double duals = std::clamp(options_.margin, kLeastRefutedDual, kRefutedDual);
    return certify_bound(bound, refuted_margin(demand_, bound, duals));
  }

  /// The best margins of components that fit into one program.
  void measure_components() {
    for (const Region& component : regions_.components()) {
      if (component.cells.size() > options_.whole) continue;
      Bound bound = regions_.bound_of(component.cells);
      if (bound.best.status != LpStatus::optimal) bound.best.margin = 0;
      if (bound.best.margin >= small_margin_) continue;
      small_margin_ = bound.best.margin;
      worst_component_ = std::move(bound);
    }
  }

  /// The cheapest possible proof, when programs of regions may be large: the ring of one bad triangle.
  bool refuted_by_a_ring(double asked) {
    for (const Region& component : regions_.components()) {
      if (component.cells.size() <= options_.whole) continue;
      for (const CellId cell : component.cells) {
        if (!regions_.is_bad(cell, asked)) continue;
        Bound bound = regions_.bound_of(ring_of(demand_, cell));
        if (bound.best.status != LpStatus::optimal || !regions_.is_hopeless(bound.best.margin)) continue;
        if (!bound_ || bound.best.margin < bound_->best.margin) bound_ = std::move(bound);
        // No best margin of dual lengths is less than zero: the first proof is as good as any.
        if (demand_.is_stretchable() && proves(*bound_)) return true;
      }
    }
    return bound_ && proves(*bound_);
  }

  /// Keeps the certificate of a ring's bound, if there is one.
  bool proves(const Bound& bound) {
    bound_is_exact_ = false;
    refuted_ = refute_all(bound);
    refutes_all_ = !refuted_->terms.empty();
    if (!refutes_all_) refuted_.reset();
    return refutes_all_;
  }

  /// Keeps the least bound, and its verdict on the first requested margin.
  void note_bound(double asked) {
    for (RegionResult& result : regions_.results()) {
      if (result.change) continue;
      if (result.bound.best.status != LpStatus::optimal) result.bound.best.margin = 0;
      bound_is_exact_ = bound_is_exact_ && !result.region.has_rim && !regions_.has_bound_of_conflict(result.region);
      if (bound_ && bound_->best.margin <= result.bound.best.margin) continue;
      bound_ = result.bound;
      bound_is_of_conflict_ = regions_.has_bound_of_conflict(result.region);
    }
    // The solver contradicts itself: nothing is known.
    if (bound_->best.margin >= asked && !bound_is_of_conflict_) bound_->best.margin = 0;
    const bool none = bound_->best.margin < kNoMargin;
    if (refuted_ && (!none || refutes_all_ || !bound_is_of_conflict_)) return;
    refutes_all_ = none;
    refuted_ = refutes_all_ ? refute_all(*bound_) : certify_bound(*bound_, asked);
  }

  /// The margin to try after `bound_`, which other regions may be far below if it is of a conflict.
  [[nodiscard]] double next_margin(double asked) const {
    return std::min(bound_->best.margin / 2, bound_is_of_conflict_ ? asked / kLessMargin : kUnbounded);
  }
  [[nodiscard]] Certificate certify_bound(const Bound& bound, double margin) const {
    if (bound.best.status != LpStatus::optimal) return {};
    return certify(demand_, bound, margin);
  }

  /// The least sum of violations may make some cells bad where other weights make none bad. So half of the best margin
  /// is the floor of violations, unless no weights exist.
  void violate_least(double asked) {
    double floor = asked;
    regions_.attempt(asked, floor);
    for (int round = 0; round < kHalvings && regions_.failures() > 0; ++round) {
      note_bound(floor);
      floor = next_margin(floor);
      if (floor <= kNoMargin) break;
      regions_.attempt(asked, floor);
    }
    regions_.violate(asked);
  }

  WeightReport report(double asked) {
    WeightReport r;
    r.asked = asked;
    r.weights = regions_.changed_weights();
    demand_.settle(r.weights);
    r.programs = regions_.results().size();
    for (const RegionResult& result : regions_.results()) r.largest = std::max(r.largest, result.region.cells.size());
    measure(r);
    const bool all_good = std::all_of(demand_.cells().begin(), demand_.cells().end(),
                                      [&](CellId cell) { return demand_.is_kept(cell, r.weights); });
    const bool found = all_good && asked > kNoMargin && regions_.failures() == 0;
    judge_margin(r, found);
    judge(r, found);
    if (is_elastic() || (is_least() && !r.solved)) add_violations(r);
    return r;
  }

  void measure(WeightReport& r) const {
    r.attained = least_margin(demand_, r.weights);
    const auto change = [&](VertexId v) { return r.weights[v] - regions_.start()[v]; };
    for (const VertexId v : demand_.vertices()) r.moved += change(v) != 0 ? 1 : 0;
    r.change = weight_change(demand_, regions_.start(), r.weights);
  }

  void judge_margin(WeightReport& r, bool found) const {
    const bool all_measured =
        options_.goal == WeightGoal::margin &&
        std::all_of(regions_.components().begin(), regions_.components().end(),
                    [&](const Region& component) { return component.cells.size() <= options_.whole; });
    if (all_measured) {
      r.margin = small_margin_;
      r.margin_kind = demand_.is_stretchable() && small_margin_ > kNoMargin ? MarginKind::at_least : MarginKind::exact;
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
    bool refutes_all = refutes_all_;
    if (refuted_) {
      r.certificate = *refuted_;
    } else if (worst_component_ && small_margin_ <= kNoMargin) {
      r.certificate = refute_all(*worst_component_);
      refutes_all = true;
    }
    const bool refuted = refutes_all && !r.certificate.terms.empty();
    r.verdict = refuted ? Feasibility::infeasible : found ? Feasibility::feasible : Feasibility::undecided;
    switch (options_.goal) {
      case WeightGoal::margin:
      case WeightGoal::least:
        r.solved = r.verdict == Feasibility::feasible;
        break;
      case WeightGoal::change:
        r.solved = r.verdict == Feasibility::feasible && r.asked == options_.margin;
        break;
      case WeightGoal::elastic:
      case WeightGoal::fewest:
        r.solved = regions_.failures() == 0;
        break;
      case WeightGoal::center:
      case WeightGoal::accuracy:
        break;
    }
  }

  void add_violations(WeightReport& r) const {
    for (const WeightConstraint& c : demand_.constraints_of(all_cells(demand_))) {
      const double got = value(demand_, c, r.weights), asked = demand_.has_margin(c) ? r.asked : 0;
      if (got < asked - kKept) r.violations.push_back({c, got, asked - got, demand_.angle_deg(c)});
    }
    std::stable_sort(r.violations.begin(), r.violations.end(),
                     [](const Violation& a, const Violation& b) { return a.shortfall > b.shortfall; });
  }

  const Demand& demand_;
  LpSolver& solver_;
  const WeightOptions& options_;
  RegionSolver regions_;

  double small_margin_ = 1;  ///< least best margin of the components measured; 1: none was
  std::optional<Bound> worst_component_;
  std::optional<Bound> bound_;  ///< the least
  bool bound_is_exact_ = true;
  bool bound_is_of_conflict_ = false;
  std::optional<Certificate> refuted_;
  bool refutes_all_ = false;  ///< `refuted_` is about all weights, not about a margin
};

}  // namespace

std::span<const std::string_view> words_of(Feasibility) {
  static constexpr std::array<std::string_view, 3> kNames = {"feasible", "infeasible", "undecided"};
  return kNames;
}
std::string_view name(Feasibility verdict) { return words_of(verdict)[static_cast<std::size_t>(verdict)]; }

std::string_view name(MarginKind is) {
  constexpr std::array<std::string_view, 3> kNames = {"exact", "at_least", "at_most"};
  return kNames[static_cast<std::size_t>(is)];
}

double weight_change(const Mesh& mesh, const VertexWeights& from, const VertexWeights& to) {
  return weight_change(TriangleDemand(mesh, Constraints::well_centered), from, to);
}

WeightReport find_weights(const Demand& demand, LpSolver& solver, const WeightOptions& options, ConvexSolver* convex) {
  if (!is_convex(options.goal)) return WeightFinder(demand, solver, options, convex).run();
  if (std::optional<WeightReport> best = best_weights(demand, *convex, options, options.margin))
    return *std::move(best);
  // The linear programs say if there are weights at all, and which margin they can have.
  WeightOptions any = options;
  any.goal = WeightGoal::margin;
  WeightReport report = WeightFinder(demand, solver, any, nullptr).run();
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

std::optional<InputError> expect_goal_across_interfaces(const WeightOptions& options, bool has_interfaces) {
  if (!has_interfaces || !needs_convex(options.goal)) return std::nullopt;
  return InputError{ErrorCode::invalid_option, "",
                    "goal: center, accuracy, least and fewest have no equations for interfaces between tensors. Next: "
                    "goal change or elastic"};
}

std::optional<InputError> expect_goal(const WeightOptions& options, const ConvexSolver* convex) {
  if (needs_convex(options.goal) && convex == nullptr)
    return InputError{ErrorCode::invalid_option, "",
                      "goal: center, accuracy, least and fewest need a solver of convex programs"};
  const bool of_scheme =
      options.constraints == Constraints::coefficients || options.constraints == Constraints::distances;
  if (is_convex(options.goal) && of_scheme) {
    return InputError{ErrorCode::invalid_option, "",
                      "goal: center and accuracy are not for constraints " + std::string(name(options.constraints)) +
                          ". Next: goal least"};
  }
  if (!(options.offset_factor >= 0 && options.boundary_offset_factor >= 0 &&
        options.offset_factor + options.boundary_offset_factor < kUnbounded)) {
    return InputError{ErrorCode::invalid_option, "",
                      "offset_factor, boundary_offset_factor: expected finite numbers that are not negative"};
  }
  const bool elastic = may_violate(options.goal);
  if (options.margin < 0.5 && (elastic ? options.margin >= 0 : options.margin > 0)) return std::nullopt;
  return InputError{ErrorCode::invalid_option, "",
                    "margin: expected a number above 0 and below 0.5, found " + std::to_string(options.margin)};
}

std::optional<InputError> expect_request(const Mesh& mesh, const WeightOptions& options, const ConvexSolver* convex) {
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
  return expect_goal(options, convex);
}

Expected<WeightReport> find_weights(const Mesh& mesh, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  if (auto error = expect_request(mesh, options, convex)) return *std::move(error);
  return find_weights(TriangleDemand(mesh, options.constraints, options.edges), solver, options, convex);
}

double largest_gap(const MetricMesh& pieces) {
  const TriangleDemand demand(pieces, Constraints::well_centered);
  double gap = 0;
  for (const WeightConstraint& c : demand.equations_of(all_cells(demand)))
    gap = std::max(gap, std::abs(value(demand, c, demand.weights())));
  return gap;
}

void close_gaps(MetricMesh& pieces) {
  const TriangleDemand demand(pieces, Constraints::well_centered);
  VertexWeights weights = demand.weights();
  demand.settle(weights);
  for (const VertexId v : pieces.mesh.vertices()) pieces.mesh.set_weight(v, weights[v]);
}

Expected<WeightReport> find_weights(const MetricMesh& pieces, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  if (auto error = expect_request(pieces.mesh, options, convex)) return *std::move(error);
  if (auto error = expect_goal_across_interfaces(options, pieces.is_cut())) return *std::move(error);
  return find_weights(TriangleDemand(pieces, options.constraints, options.edges), solver, options, convex);
}

}  // namespace temper
