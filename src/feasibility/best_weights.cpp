// The convex programs of the best weights. Each vertex has a column: its potential (potential.hpp), in units of the
// mean ℓ² of its edges. Each constraint has a row: its value less the margin; on the sphere N − t m, linear in σ.
//
//   center      minimize −Σ ln s. A constant on all weights changes nothing in the plane, so one weight of each
//               component is zero. On the sphere s has the factor of all σ. There M/n Σ σ is added for each component,
//               with M constraints and n vertices. Then the minimum has Σ σ = n.
//   accuracy    minimize the squared offsets with s ≥ 0. One potential of each component is zero.
//
// The gap (temper/feasibility.hpp) bounds the effect of the slope r that rounding leaves. Along each edge weights, or
// σ, differ by at most `reach`, so each vertex differs from the fixed one by at most the sum along a path.
#include "feasibility/best_weights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "feasibility/lp_builder.hpp"
#include "feasibility/region.hpp"

namespace temper {
namespace {

using Kind = WeightConstraint::Kind;

// The relative error of a coefficient or a multiplier's product, in roundings; each addition has one more.
constexpr double kRoundings = 32;
// A margin that lacks less than this is kept: rounding, in thin triangles of large terms.
constexpr double kKeptInDoubles = 1e-9;

class BestWeights {
 public:
  BestWeights(const Demand& demand, const WeightOptions& options, double margin)
      : demand_(demand),
        options_(options),
        margin_(is_center() ? 0 : margin),
        components_(components_of(demand)),
        column_(demand.n_vertices(), kNoColumn) {
    for (const Region& component : components_) add_columns(component);
    add_rows();
    is_center() ? add_center() : add_offsets();
  }

  std::optional<WeightReport> solve(ConvexSolver& solver) {
    const ConvexSolution solution = solver.solve(problem_);
    if (!solution.solved) return std::nullopt;
    WeightReport report;
    report.weights = weights_of(solution.primal);
    const auto cells = demand_.cells();
    const bool kept =
        std::all_of(cells.begin(), cells.end(), [&](CellId cell) { return demand_.is_kept(cell, report.weights); });
    report.attained = least_margin(demand_, report.weights);
    if (!kept || report.attained < margin_ - kKeptInDoubles) return std::nullopt;
    report.optimality = prove(solution);
    report.verdict = Feasibility::feasible;
    report.margin = report.attained;
    report.margin_kind = MarginKind::at_least;
    report.solved = true;
    report.asked = margin_;
    report.programs = 1;
    report.largest = demand_.n_cells();
    const VertexWeights start = options_.from_input ? demand_.weights() : VertexWeights(demand_.n_vertices(), 0.0);
    for (const VertexId v : demand_.vertices()) report.moved += report.weights[v] != start[v] ? 1 : 0;
    report.change = weight_change(demand_, start, report.weights);
    return report;
  }

 private:
  static constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);

  [[nodiscard]] bool is_center() const { return options_.goal == WeightGoal::center; }
  [[nodiscard]] const Space& space() const { return demand_.space(); }
  /// Says whether the objective fixes the potentials, not only their differences.
  [[nodiscard]] bool has_scale() const { return is_center() && !space().is_plane(); }

  void add_columns(const Region& component) {
    const std::vector<double> units = weight_units(component.free, demand_.edges_of(component.cells));
    for (std::size_t i = has_scale() ? 0 : 1; i < component.free.size(); ++i) {
      column_[component.free[i]] = problem_.n_columns++;
      units_.push_back(units[i]);
    }
  }

  /// Adds a row of coefficients of potentials. Vertices without a column have the potential zero.
  void add_entries(SparseRows& rows, const LinearForm& form, double factor) {
    for (int k = 0; k < form.size; ++k) {
      const std::size_t column = column_[form.vertices[static_cast<std::size_t>(k)]];
      if (column == kNoColumn) continue;
      rows.add_entry(static_cast<int>(column),
                     factor * form.coefficients[static_cast<std::size_t>(k)] * units_[column]);
    }
    rows.end_row();
  }

  void add_row(const WeightConstraint& constraint, double margin) {
    const LinearForm form = beyond_margin(demand_.linear_form(constraint), margin);
    constraints_.push_back(constraint);
    add_entries(problem_.rows, form, 1);
    problem_.constants.push_back(form.constant);
  }

  void add_rows() {
    const std::vector<CellId> cells = all_cells(demand_);
    for (const WeightConstraint& c : demand_.constraints_of(cells)) add_row(c, margin_);
    if (!demand_.has_duals()) return;
    for (const WeightEdge& edge : demand_.edges_of(cells)) {
      add_row(split_constraint(edge.p, edge.q), -kCrossingReach);
      add_row(split_constraint(edge.q, edge.p), -kCrossingReach);
    }
  }

  void add_center() {
    problem_.barrier = 1;
    if (!has_scale()) return;
    problem_.cost.assign(problem_.n_columns, 0);
    for (const Region& component : components_) {
      std::size_t rows = demand_.constraints_of(component.cells).size();
      if (demand_.has_duals()) rows += 2 * demand_.edges_of(component.cells).size();
      const double each = static_cast<double>(rows) / static_cast<double>(component.free.size());
      for (const VertexId v : component.free)
        problem_.cost[column_[v]] = -each * slope_of_scale(space()) * units_[column_[v]];
    }
  }

  /// The squares are over the sum of all factors, so that the solver sees a mean.
  void add_offsets() {
    offsets_ = demand_.offsets(options_);
    for (const OffsetTerm& term : offsets_) total_ += term.factor;
    if (!(total_ > 0)) total_ = 1;
    for (const OffsetTerm& term : offsets_) {
      const LinearForm form = offset_form(demand_, term);
      const double factor = std::sqrt(2 * term.factor / total_);
      add_entries(problem_.squares, form, factor);
      problem_.square_constants.push_back(factor * form.constant);
    }
  }

  /// In the plane the mean of the weights of a component is zero.
  [[nodiscard]] VertexWeights weights_of(const std::vector<double>& x) const {
    VertexWeights weights(demand_.n_vertices(), 0.0);
    for (const Region& component : components_) {
      double sum = 0;
      for (const VertexId v : component.free) {
        if (column_[v] != kNoColumn) weights[v] = units_[column_[v]] * x[column_[v]];
        sum += weights[v];
      }
      const double mean = space().is_plane() ? sum / static_cast<double>(component.free.size()) : 0;
      for (const VertexId v : component.free) weights[v] = weight_of_potential(space(), weights[v] - mean);
    }
    return weights;
  }

  [[nodiscard]] Optimality prove(const ConvexSolution& solution) const {
    const std::vector<double>& x = solution.primal;
    const double unit = is_center() ? 1 : total_;
    Optimality proof;
    proof.goal = options_.goal;
    proof.constraints = demand_.constraints();
    proof.margin = margin_;
    proof.iterations = solution.iterations;
    proof.offsets = offsets_;
    std::vector<double> slope = problem_.cost.empty() ? std::vector<double>(problem_.n_columns, 0.0) : problem_.cost;
    std::vector<double> sizes(problem_.n_columns, 0.0), terms(problem_.n_columns, kRoundings);
    const auto add = [&](const SparseRows& rows, std::size_t row, double factor) {
      rows.for_each(row, [&](std::size_t k, double a) {
        slope[k] += factor * a;
        sizes[k] += std::abs(factor * a);
        terms[k] += 1;
      });
    };
    for (std::size_t i = 0; i < problem_.squares.size(); ++i) {
      const double value = problem_.squares.times(i, x) + problem_.square_constants[i];
      proof.objective += 0.5 * unit * value * value;
      add(problem_.squares, i, value);
    }
    for (std::size_t i = 0; i < problem_.rows.size(); ++i) {
      const double s = problem_.rows.times(i, x) + problem_.constants[i], y = solution.dual[i], sy = s * y;
      if (is_center()) proof.objective -= std::log(s);
      proof.gap += is_center() ? sy - 1 - std::log(sy) : unit * std::abs(sy);
      add(problem_.rows, i, -y);
      proof.terms.push_back({constraints_[i], unit * y / demand_.scale_of_polynomial(constraints_[i])});
    }
    const VertexWeights reach = reach_of_potentials();
    for (const VertexId v : demand_.vertices()) {
      const std::size_t k = column_[v];
      if (k == kNoColumn) continue;
      const double most = std::abs(slope[k]) + 0x1p-53 * terms[k] * sizes[k];
      proof.gap += unit * most * reach[v] / units_[k];
    }
    return proof;
  }

  /// Returns a bound of the difference between the potentials of each vertex and of the root of its component.
  [[nodiscard]] VertexWeights reach_from_roots() const {
    VertexWeights reach(demand_.n_vertices(), 0.0);
    VertexMask seen(demand_.n_vertices(), 0);
    std::vector<VertexId> corners;
    std::vector<CellId> cells;
    for (const Region& component : components_) {
      std::vector<VertexId> queue = {component.free.front()};
      seen[queue.front()] = 1;
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const VertexId p = queue[i];
        cells.clear();
        demand_.add_cells_around(p, cells);
        for (const CellId cell : cells) {
          corners.clear();
          demand_.add_corners(cell, corners);
          for (const VertexId q : corners) {
            if (seen[q] != 0) continue;
            seen[q] = 1;
            const double b = demand_.reach(p, q, corners);
            reach[q] = reach[p] + b + (space().is_plane() ? 0 : b * reach[p]);
            queue.push_back(q);
          }
        }
      }
    }
    return reach;
  }

  /// Returns the largest difference between two potentials of each vertex that keep the constraints.
  [[nodiscard]] VertexWeights reach_of_potentials() const {
    VertexWeights reach = reach_from_roots();
    if (!has_scale()) {
      for (double& r : reach) r *= space().is_plane() ? 2 : 2 / slope_of_scale(space());
      return reach;
    }
    // Σ σ = n, and each σ is between σ_root/(1 + W) and σ_root (1 + W).
    for (const Region& component : components_) {
      double least = 0, most = 0;  // of Σ σ/σ_root
      for (const VertexId v : component.free) least += 1 / (1 + reach[v]), most += 1 + reach[v];
      const auto n = static_cast<double>(component.free.size());
      for (const VertexId v : component.free) {
        const double w = 1 + reach[v];
        reach[v] = (n / least * w - n / most / w) / slope_of_scale(space());
      }
    }
    return reach;
  }
  const Demand& demand_;
  const WeightOptions& options_;
  double margin_;
  std::vector<Region> components_;
  IdVector<VertexId, std::size_t> column_;
  std::vector<double> units_;                  // of the columns
  std::vector<WeightConstraint> constraints_;  // of the rows
  std::vector<OffsetTerm> offsets_;
  double total_ = 0;  // of the factors
  ConvexProblem problem_;
};

}  // namespace

double Optimality::relative_gap() const {
  return objective == 0 ? (gap == 0 ? 0 : kUnbounded) : gap / std::abs(objective);
}

std::optional<WeightReport> best_weights(const Demand& demand, ConvexSolver& solver, const WeightOptions& options,
                                         double margin) {
  return BestWeights(demand, options, margin).solve(solver);
}

}  // namespace temper
