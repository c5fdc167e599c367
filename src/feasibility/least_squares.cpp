// The weights of a region with the least sum of squared changes of d/ℓ: a convex program. Each free vertex has a
// column, the change of its potential (potential.hpp) in units of the mean ℓ² of its edges. Each constraint has a row,
// its value less its margin. A row that is negative at the start is a bad place, and all others keep it from spoiling
// them.
//
// Without rim a constant on all changes is free, so one change is zero, and then their mean is made zero. On the sphere
// d/ℓ is replaced by its linear part at equal σ (offset_form).
#include <algorithm>
#include <cmath>

#include "feasibility/best_weights.hpp"
#include "feasibility/change.hpp"
#include "feasibility/lp_builder.hpp"

namespace temper {
namespace {

// Multipliers above this part of the largest belong to the conflict, if there are no weights.
constexpr double kInConflict = 1e-3;

// The cost of a mean violation of one, over the mean square of Δd/ℓ: so large that only contradictions are violated.
constexpr double kViolation = 1e3;

constexpr int kReweightings = 4;       // more programs hardly lower the number of violations
constexpr double kLeastUnit = 1e-3;    // of violations, for margins below it
constexpr double kNoViolation = 1e-9;  // smaller violations are the solver's tolerance

class LeastSquares {
 public:
  LeastSquares(const RegionProblem& problem, const Region& region, bool elastic)
      : p_(problem), demand_(problem.demand), region_(region), edges_(demand_.edges_of(region.cells)) {
    units_ = weight_units(region.free, edges_);
    program_.n_columns = region.free.size() - first_column();
    program_.must_stop = problem.must_stop;
    for (const WeightEdge& edge : edges_) add_square(edge);
    program_.square_constants.assign(program_.squares.size(), 0);
    for (const WeightConstraint& c : demand_.constraints_of(region.cells, true)) add_row(c, p_.margin);
    if (!elastic) return;
    program_.violation_cost.assign(constraints_.size(), kViolation / static_cast<double>(constraints_.size()));
    if (p_.floor == -kUnbounded) return;
    for (const WeightConstraint& c : demand_.constraints_of(region.cells, true)) add_row(c, p_.floor);
    program_.violation_cost.resize(constraints_.size(), kUnbounded);
  }

  RegionChange solve(ConvexSolver& solver) {
    return program_.n_columns == 0 ? RegionChange() : change_by(solver.solve(program_));
  }
  /// Violates few constraints (Candès, Wakin and Boyd): a violation v costs 1/(v + margin) in the next program.
  RegionChange solve_with_few_violations(ConvexSolver& solver) {
    if (program_.n_columns == 0) return {};
    const std::vector<double> costs = program_.violation_cost;
    const double unit = std::max(p_.margin, kLeastUnit);
    ConvexSolution best = solver.solve(program_), now = best;
    for (int i = 0; i < kReweightings && now.solved && !(p_.must_stop && p_.must_stop()); ++i) {
      for (std::size_t row = 0; row < costs.size(); ++row)
        program_.violation_cost[row] = costs[row] * unit / (unit + violation(now, row));
      now = solver.solve(program_);
      if (now.solved && n_violations(now) < n_violations(best)) best = now;
    }
    return change_by(best);
  }

 private:
  [[nodiscard]] double violation(const ConvexSolution& solution, std::size_t row) const {
    return std::max(0.0, -program_.rows.times(row, solution.primal) - program_.constants[row]);
  }
  [[nodiscard]] std::size_t n_violations(const ConvexSolution& solution) const {
    std::size_t n = 0;
    for (std::size_t row = 0; row < program_.rows.size(); ++row) n += violation(solution, row) > kNoViolation ? 1 : 0;
    return n;
  }

  [[nodiscard]] RegionChange change_by(const ConvexSolution& solution) const {
    RegionChange result;
    if (!solution.solved) {
      const double most = solution.dual.empty() ? 0 : *std::max_element(solution.dual.begin(), solution.dual.end());
      for (std::size_t i = 0; i < std::min(solution.dual.size(), constraints_.size()); ++i) {
        if (solution.dual[i] > kInConflict * most) result.conflict.push_back(constraints_[i]);
      }
      return result;
    }
    result.status = LpStatus::optimal;
    for (std::size_t row = 0; row < program_.violation_cost.size(); ++row) result.violation += violation(solution, row);
    result.change.assign(region_.free.size(), 0);
    double sum = 0;
    for (std::size_t i = first_column(); i < result.change.size(); ++i)
      sum += result.change[i] = units_[i] * solution.primal[i - first_column()];
    if (region_.has_rim) return result;
    const Space& space = demand_.space();
    const double mean = sum / static_cast<double>(result.change.size());
    // On the sphere all σ = σ₀ − slope · change are divided by the same factor.
    for (std::size_t i = 0; i < result.change.size(); ++i) {
      const double of_scale = scale_at(space, p_.start[region_.free[i]]);
      result.change[i] = (result.change[i] - of_scale * mean) / (1 - slope_of_scale(space) * mean);
    }
    return result;
  }

  /// The first vertex has no column if there is no rim.
  [[nodiscard]] std::size_t first_column() const { return region_.has_rim ? 0 : 1; }

  /// Adds the entries of a form; returns false if no vertex of it has a column.
  bool add_entries(SparseRows& rows, const LinearForm& form, double factor) {
    const std::size_t before = rows.column.size();
    for (int k = 0; k < form.size; ++k) {
      const VertexId v = form.vertices[static_cast<std::size_t>(k)];
      const std::size_t i = index_of(region_.free, v);
      if (i == region_.free.size() || region_.free[i] != v || i < first_column()) continue;
      rows.add_entry(static_cast<int>(i - first_column()),
                     factor * form.coefficients[static_cast<std::size_t>(k)] * units_[i]);
    }
    return rows.column.size() > before;
  }

  /// The squares are over their number, so that the solver sees a mean.
  void add_square(const WeightEdge& edge) {
    const LinearForm form = offset_form(demand_, {split_constraint(edge.p, edge.q), 1, 0.5});
    const double factor = std::sqrt(2 / static_cast<double>(edges_.size()));
    if (add_entries(program_.squares, form, factor)) program_.squares.end_row();
  }

  void add_row(const WeightConstraint& constraint, double asked) {
    const LinearForm form = demand_.linear_form(constraint);
    const double margin = p_.margin_of(constraint, asked);
    if (!add_entries(program_.rows, beyond_margin(form, margin), 1)) return;
    const auto start = [&](VertexId v) { return potential_of(demand_.space(), p_.start[v]); };
    constraints_.push_back(constraint);
    program_.rows.end_row();
    program_.constants.push_back(numerator_of(form, start) - margin * scale_of(form, start));
  }

  const RegionProblem& p_;
  const Demand& demand_;
  const Region& region_;
  std::vector<WeightEdge> edges_;
  std::vector<double> units_;
  std::vector<WeightConstraint> constraints_;  // of the rows
  ConvexProblem program_;
};

}  // namespace

RegionChange least_squares(const RegionProblem& problem, const Region& region, ConvexSolver& solver,
                           MayViolate may_violate) {
  LeastSquares program(problem, region, may_violate != MayViolate::none);
  return may_violate == MayViolate::few ? program.solve_with_few_violations(solver) : program.solve(solver);
}

}  // namespace temper
