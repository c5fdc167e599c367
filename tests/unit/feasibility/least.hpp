// Least weights: the minimum of squares, by a linear program.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "feasibility/best_weights.hpp"
#include "feasibility/change.hpp"
#include "feasibility/demand.hpp"
#include "feasibility/lp_builder.hpp"
#include "temper/detail/lp.hpp"
#include "temper/feasibility.hpp"

namespace temper::test {

/// Of a mesh of triangles or of tetrahedra.
template <class M>
WeightReport least_of(const M& mesh, const WeightOptions& options) {
  const auto lp = clp_solver();
  const auto convex = interior_point_solver();
  auto report = find_weights(mesh, *lp, options, convex.get());
  if (!report) ADD_FAILURE() << report.error().what();
  return report ? *std::move(report) : WeightReport();
}

/// Weights w minimize a convex f over a polyhedron if and only if w minimizes the linear function ∇f(w) · v over it.
/// Returns false if Clp gives up.
inline bool expect_minimum(const Demand& demand, const WeightReport& report) {
  const VertexWeights start(demand.n_vertices(), 0.0);
  const RegionProblem problem{demand, start, report.asked};
  std::vector<double> slope(demand.n_vertices(), 0.0);
  double squares = 0;
  const auto cells = all_cells(demand);
  for (const WeightEdge& edge : demand.edges_of(cells)) {
    const double of_edge = 0.5 / edge.squared_length * (report.weights[edge.p] - report.weights[edge.q]);
    squares += of_edge * of_edge;
    slope[edge.p.index] += of_edge / edge.squared_length, slope[edge.q.index] -= of_edge / edge.squared_length;
  }
  LpBuilder lp;
  for (const VertexId v : demand.vertices()) {
    const double most = v.index == 0 ? 0 : kUnbounded;
    lp.add_column(slope[v.index] / squares, -most, most);
  }
  for (const WeightConstraint& c : demand.constraints_of(cells)) {
    const LinearForm form = demand.linear_form(c);
    for (int k = 0; k < form.size; ++k)
      lp.add_entry(static_cast<int>(form.vertices[static_cast<std::size_t>(k)].index),
                   form.coefficients[static_cast<std::size_t>(k)]);
    lp.end_row(problem.margin_of(c, report.asked) - form.constant, kUnbounded);
  }
  const LpSolution least = clp_solver()->solve(lp.problem());
  if (least.status == LpStatus::failed) return false;
  EXPECT_EQ(least.status, LpStatus::optimal);
  EXPECT_NEAR(least.objective, 2, 1e-5);
  return true;
}

}  // namespace temper::test
