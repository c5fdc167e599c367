#include "feasibility/demand.hpp"

#include <algorithm>
#include <cmath>

#include "base/sort_unique.hpp"

namespace temper {

LinearForm beyond_margin(LinearForm form, double margin) {
  form.constant -= margin;
  for (int k = 0; k < 2; ++k) form.coefficients[k] += 0.5 * margin * form.slope;
  return form;
}

WeightConstraint split_constraint(VertexId from, VertexId to) {
  return {WeightConstraint::Kind::crossing, from, to, VertexId()};
}

std::vector<VertexId> vertices_of(const Demand& demand, std::span<const CellId> cells) {
  std::vector<VertexId> vertices;
  vertices.reserve(4 * cells.size());
  for (const CellId cell : cells) demand.add_corners(cell, vertices);
  sort_unique(vertices);
  return vertices;
}

std::vector<CellId> all_cells(const Demand& demand) { return {demand.cells().begin(), demand.cells().end()}; }

double least_margin(const Demand& demand, const VertexWeights& weights) {
  double margin = kUnbounded;
  for (const CellId cell : demand.cells()) margin = std::min(margin, demand.margin_of(cell, weights));
  return margin;
}

double weight_change(const Demand& demand, const VertexWeights& from, const VertexWeights& to) {
  const auto change = [&](VertexId v) { return to[v] - from[v]; };
  double total = 0;
  for (const WeightEdge& edge : demand.edges_of(all_cells(demand)))
    total += 0.5 * std::abs(change(edge.p) - change(edge.q)) / std::sqrt(edge.squared_length);
  return total;
}

}  // namespace temper
