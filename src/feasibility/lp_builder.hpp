// A linear program put together column by column and row by row.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "feasibility/demand.hpp"
#include "temper/feasibility.hpp"

namespace temper {

class LpBuilder {
 public:
  /// Returns the number of the column.
  int add_column(double cost, double lower, double upper) {
    problem_.cost.push_back(cost);
    problem_.column_lower.push_back(lower);
    problem_.column_upper.push_back(upper);
    return static_cast<int>(problem_.n_columns()) - 1;
  }
  /// One more entry of the row that end_row() will close.
  void add_entry(int column, double value) {
    problem_.column.push_back(column);
    problem_.value.push_back(value);
  }
  /// Returns the number of the row.
  int end_row(double lower, double upper) {
    problem_.row_lower.push_back(lower);
    problem_.row_upper.push_back(upper);
    problem_.row_start.push_back(static_cast<int>(problem_.column.size()));
    return static_cast<int>(problem_.n_rows()) - 1;
  }
  void set_cost(int column, double cost) { problem_.cost[static_cast<std::size_t>(column)] = cost; }
  [[nodiscard]] const LpProblem& problem() const { return problem_; }

 private:
  LpProblem problem_;
};

/// The position of v in a sorted list that has it; otherwise the size of the list, or another position.
[[nodiscard]] std::size_t index_of(std::span<const VertexId> sorted_vertices, VertexId v);

/// For each vertex the mean over its edges among `edges`. Each vertex must have one.
[[nodiscard]] std::vector<double> weight_units(std::span<const VertexId> vertices, std::span<const WeightEdge> edges);

}  // namespace temper
