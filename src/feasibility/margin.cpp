// The best margin: maximize t ≤ 1/2 with every h/ℓ, d/ℓ and 1 − d/ℓ, or every dual length/ℓ, at least t.
//
// The program always has a solution, and an optimal one since t is bounded: d/ℓ and 1 − d/ℓ sum to one, and the heights
// of one triangle bound it before that. Its dual is the certificate: multipliers y ≥ 0 that sum to one. In their
// combination of the constraints the weights cancel, and the constant is t*. So no ray of an infeasible program is
// needed. A weight is in units of the mean ℓ² around its vertex: then coefficients are of order one, also on graded
// meshes.
//
// On the sphere a margin is a ratio of linear functions, N/m > t (constraints.hpp). Let t be the margin attained so
// far: maximize s with every N − t m ≥ s. The margin of the solution is the next t, until s is zero (Dinkelbach's
// method, which converges faster than linearly). For N > 0 alone, the first program from t = 0 is enough. Dual lengths
// need no second one: σ less a linear function of the places leaves them unchanged, so that m can be made small.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "feasibility/certify.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/lp_builder.hpp"
#include "feasibility/region.hpp"

namespace temper {
namespace {

struct MarginProgram {
  std::vector<VertexId> vertices;  ///< a column each
  std::vector<double> units;
  std::vector<WeightConstraint> constraints;  ///< a row each
  LpProblem problem;
};

constexpr int kRounds = 12;          // two or three are enough; a few more if σ differ much
constexpr double kAttained = 1e-10;  // of s: a tenth of the solver's tolerance
// A lower bound of σ, so that m is positive. It is far below usual σ, so that it plays no part in proofs: with 1/16 one
// of ten random globes had none for heights alone.
constexpr double kLeastScale = 0x1p-12;

/// The program whose margins count from `from`.
MarginProgram margin_program(const Demand& demand, std::span<const CellId> cells, double from) {
  MarginProgram p;
  p.vertices = vertices_of(demand, cells);
  p.units = weight_units(p.vertices, demand.edges_of(cells));
  p.constraints = demand.constraints_of(cells);
  LpBuilder lp;
  // One weight is zero, since a constant on all would be free otherwise. It is a weight at the smallest triangles,
  // whose unit is most sensitive to rounding.
  const auto anchor = std::min_element(p.units.begin(), p.units.end()) - p.units.begin();
  for (std::size_t i = 0; i < p.vertices.size(); ++i) {
    const double most = i == static_cast<std::size_t>(anchor) ? 0 : kUnbounded;
    const double least_scale = (1 - kLeastScale) / (slope_of_scale(demand.space()) * p.units[i]);  // ∞ in the plane
    lp.add_column(0, -most, std::min(most, least_scale));
  }
  const int t = lp.add_column(-1, -kUnbounded, kMostMargin - from);
  for (const WeightConstraint& constraint : p.constraints) {
    const LinearForm form = beyond_margin(demand.linear_form(constraint), from);
    for (int k = 0; k < form.size; ++k) {
      const std::size_t column = index_of(p.vertices, form.vertices[k]);
      lp.add_entry(static_cast<int>(column), form.coefficients[k] * p.units[column]);
    }
    lp.add_entry(t, -1);
    lp.end_row(-form.constant, kUnbounded);
  }
  for (const WeightConstraint& equation : demand.equations_of(cells)) {
    const LinearForm form = demand.linear_form(equation);
    for (int k = 0; k < form.size; ++k) {
      const std::size_t column = index_of(p.vertices, form.vertices[k]);
      lp.add_entry(static_cast<int>(column), form.coefficients[k] * p.units[column]);
    }
    lp.end_row(-form.constant, -form.constant);
    p.constraints.push_back(equation);
  }
  p.problem = lp.problem();
  return p;
}

std::vector<CellId> sorted_cells(std::span<const TriangleId> triangles) {
  std::vector<CellId> result = as_cells(triangles);
  sort_unique(result);
  return result;
}

}  // namespace

std::size_t index_of(std::span<const VertexId> sorted_vertices, VertexId v) {
  const auto at = std::lower_bound(sorted_vertices.begin(), sorted_vertices.end(), v);
  return static_cast<std::size_t>(at - sorted_vertices.begin());
}

std::vector<double> weight_units(std::span<const VertexId> vertices, std::span<const WeightEdge> edges) {
  std::vector<double> sums(vertices.size(), 0.0);
  std::vector<double> counts(vertices.size(), 0.0);
  for (const WeightEdge& edge : edges) {
    for (const VertexId v : {edge.p, edge.q}) {
      const std::size_t i = index_of(vertices, v);
      if (i == vertices.size() || vertices[i] != v) continue;
      sums[i] += edge.squared_length;
      counts[i] += 1;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
  return sums;
}

double weight_margin(const Mesh& mesh, Constraints constraints, std::span<const HalfedgeId> edges) {
  const TriangleDemand demand(mesh, constraints, edges);
  return least_margin(demand, demand.weights());
}

Certificate certify(const Demand& demand, const Bound& bound, double margin) {
  const std::vector<double>& dual = bound.dual;
  double largest = 0;
  for (const double y : dual) largest = std::max(largest, std::abs(y));
  // Few terms are easier to read. Dropped terms weaken the check, so each candidate is tried.
  for (const double dropped : {1e-9, 1e-12, 1e-15}) {
    Certificate certificate;
    certificate.margin = margin;
    certificate.constraints = demand.constraints();
    for (std::size_t i = 0; i < dual.size(); ++i) {
      const double size = is_equation(bound.constraints[i]) ? std::abs(dual[i]) : dual[i];
      if (!(size > dropped * largest)) continue;
      certificate.terms.push_back({bound.constraints[i], dual[i] / demand.scale_of_polynomial(bound.constraints[i])});
    }
    if (demand.check(certificate) == CertificateCheck::proves) return certificate;
  }
  Certificate nothing;
  nothing.margin = margin;
  nothing.constraints = demand.constraints();
  return nothing;
}

namespace {

/// The solved program whose margins count from `from`.
Bound bound_from(const Demand& demand, std::span<const CellId> cells, LpSolver& solver, double from) {
  Bound bound;
  MarginProgram program = margin_program(demand, cells, from);
  LpSolution solution = solver.solve(program.problem);
  bound.constraints = std::move(program.constraints);
  bound.best.status = solution.status;
  bound.best.vertices = std::move(program.vertices);
  if (solution.status != LpStatus::optimal) return bound;
  bound.best.margin = from + solution.primal.back();
  bound.dual = std::move(solution.dual);
  std::vector<double> potentials;
  for (std::size_t i = 0; i < bound.best.vertices.size(); ++i) {
    potentials.push_back(program.units[i] * solution.primal[i]);
    bound.best.weights.push_back(weight_of_potential(demand.space(), potentials.back()));
  }
  if (demand.space().is_plane()) return bound;
  bound.attained = kUnbounded;
  for (const WeightConstraint& c : bound.constraints) {
    const double value =
        value_of(demand.linear_form(c), [&](VertexId v) { return potentials[index_of(bound.best.vertices, v)]; });
    bound.attained = std::min(bound.attained, value);
  }
  return bound;
}

bool is_attained(const Demand& demand, const Bound& bound) {
  return demand.space().is_plane() || bound.best.status != LpStatus::optimal ||
         std::abs(bound.best.margin - bound.attained) <= kAttained;
}

}  // namespace

Bound bound_margin(const Demand& demand, std::span<const CellId> cells, LpSolver& solver) {
  Bound bound = bound_from(demand, cells, solver, 0);
  if (!demand.space().is_plane() && demand.has_duals()) {
    bound.best.margin = std::min({bound.best.margin, bound.attained, kMostMargin});
    return bound;
  }
  for (int round = 0; round < kRounds && !is_attained(demand, bound); ++round) {
    Bound next = bound_from(demand, cells, solver, bound.attained);
    if (next.best.status != LpStatus::optimal) break;
    const bool better = next.attained > bound.attained;
    bound = std::move(next);
    if (!better) break;
  }
  double largest = 0;
  for (const double y : bound.dual) largest = std::max(largest, y);
  for (std::size_t i = 0; i < bound.dual.size(); ++i) {
    if (bound.dual[i] > 1e-9 * largest && !is_equation(bound.constraints[i]))
      bound.best.tight.push_back(bound.constraints[i]);
  }
  return bound;
}

BestMargin best_margin_of(const Demand& demand, std::span<const CellId> cells, LpSolver& solver) {
  Bound bound = bound_margin(demand, cells, solver);
  if (bound.best.status == LpStatus::optimal && bound.best.margin < kNoMargin) {
    bound.best.certificate = certify(demand, bound, refuted_margin(demand, bound, kRefutedDual));
  }
  return std::move(bound.best);
}

BestMargin best_margin(const Mesh& mesh, std::span<const TriangleId> triangles, LpSolver& solver,
                       Constraints constraints, std::span<const HalfedgeId> edges) {
  return best_margin_of(TriangleDemand(mesh, constraints, edges), sorted_cells(triangles), solver);
}

BestMargin best_margin(const Mesh& mesh, LpSolver& solver, Constraints constraints, std::span<const HalfedgeId> edges) {
  const TriangleDemand demand(mesh, constraints, edges);
  BestMargin worst;
  worst.margin = kUnbounded;
  for (const Region& component : components_of(demand)) {
    BestMargin best = best_margin_of(demand, component.cells, solver);
    if (best.status != LpStatus::optimal) return best;
    if (best.margin < worst.margin) worst = std::move(best);
  }
  return worst;
}

}  // namespace temper
