// Convex programs for temper/feasibility.hpp: a sum of squares and logarithms of linear functions.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace temper {

/// The rows of a sparse matrix, compressed.
struct SparseRows {
  std::vector<std::size_t> start = {0};
  std::vector<int> column;
  std::vector<double> value;

  [[nodiscard]] std::size_t size() const { return start.size() - 1; }
  void add_entry(int at, double x) { column.push_back(at), value.push_back(x); }
  void end_row() { start.push_back(column.size()); }
  /// Calls use(column, value) for the entries of a row.
  template <class Use>
  void for_each(std::size_t row, const Use& use) const {
    for (std::size_t k = start[row]; k < start[row + 1]; ++k) use(static_cast<std::size_t>(column[k]), value[k]);
  }
  /// The row times x.
  [[nodiscard]] double times(std::size_t row, const std::vector<double>& x) const {
    double sum = 0;
    for_each(row, [&](std::size_t at, double a) { sum += a * x[at]; });
    return sum;
  }
};

/// A convex program: minimize ½ Σ (squares x + square_constants)² + cost · x − barrier Σ ln s, with the slacks
/// s = rows x + constants ≥ 0. It needs a row, and one minimum: no
/// change of x leaves all squares and all slacks as they are.
struct ConvexProblem {
  std::size_t n_columns = 0;
  SparseRows squares;
  std::vector<double> square_constants;
  std::vector<double> cost;  ///< One per column, or empty: none
  SparseRows rows;
  std::vector<double> constants;
  /// Cost per unit of a slack below 0, infinite for rows that must be kept. Empty: all must. Precondition if not
  /// empty: no barrier.
  std::vector<double> violation_cost = {};
  double barrier = 0;                    ///< Factor of the logarithms; 0: the slacks may reach 0
  std::function<bool()> must_stop = {};  ///< Asked once an iteration: if it says yes, the solver gives up
};

struct ConvexSolution {
  bool solved = false;         ///< Else the solver gave up: there may be no x with positive slacks
  std::vector<double> primal;  ///< Values of x
  std::vector<double> dual;  ///< One multiplier ≥ 0 per row: (squares)ᵀ (squares x + …) + cost = (rows)ᵀ dual. If
                             ///< not solved, the last ones: the largest belong to rows that contradict each other
  std::size_t iterations = 0;
};

/// The interface of solvers of convex programs. Each call is independent of the calls before.
class ConvexSolver {
 public:
  virtual ~ConvexSolver() = default;
  [[nodiscard]] virtual ConvexSolution solve(const ConvexProblem& problem) = 0;
};

}  // namespace temper
