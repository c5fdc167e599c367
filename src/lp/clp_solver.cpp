// Clp behind temper's LpSolver, by its C interface.
//
// The dual simplex method comes first. temper's programs start dual feasible: costs are not negative, and free columns
// cost nothing. It then works on violated rows alone, which are few if few triangles are bad. Solutions are checked
// before they are used; bad ones are solved again by other means.
#include <coin/Clp_C_Interface.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>

#include "temper/detail/lp.hpp"

namespace temper {
namespace {

// Rows are h/ℓ and d/ℓ: this is far below any useful margin, far above the rounding of a few hundred terms.
constexpr double kTolerance = 1e-9;
// Ten times that, because Clp's own scaling of rows and columns adds an error.
constexpr double kAccepted = 1e-8;

constexpr std::size_t kLarge = 4000;  // rows from which an attempt goes on from its basis: a new one takes long
constexpr std::size_t kMostSize = 100'000'000;  // of rows and columns, for the limit of steps

constexpr int kOptimal = 0, kInfeasible = 1, kUnboundedStatus = 2;  // Clp_status

struct Delete {
  void operator()(Clp_Simplex* model) const { Clp_deleteModel(model); }
};
using Model = std::unique_ptr<Clp_Simplex, Delete>;

/// By columns, the input format of Clp.
struct Columns {
  std::vector<CoinBigIndex> start;
  std::vector<int> row;
  std::vector<double> value;
};

Columns by_columns(const LpProblem& problem) {
  Columns columns;
  columns.start.assign(problem.n_columns() + 1, 0);
  columns.row.resize(problem.column.size());
  columns.value.resize(problem.column.size());
  for (const int c : problem.column) ++columns.start[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 0; c < problem.n_columns(); ++c) columns.start[c + 1] += columns.start[c];
  std::vector<CoinBigIndex> at(columns.start.begin(), columns.start.end() - 1);
  for (std::size_t r = 0; r < problem.n_rows(); ++r) {
    for (int i = problem.row_start[r]; i < problem.row_start[r + 1]; ++i) {
      const auto to = static_cast<std::size_t>(at[static_cast<std::size_t>(problem.column[i])]++);
      columns.row[to] = static_cast<int>(r);
      columns.value[to] = problem.value[i];
    }
  }
  return columns;
}

/// Clp's infinity is the largest double.
std::vector<double> finite(std::vector<double> bounds) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (double& bound : bounds) bound = std::clamp(bound, -kLargest, kLargest);
  return bounds;
}

Model load(const LpProblem& problem) {
  Model model(Clp_newModel());
  Clp_setLogLevel(model.get(), 0);
  const Columns columns = by_columns(problem);
  Clp_loadProblem(model.get(), static_cast<int>(problem.n_columns()), static_cast<int>(problem.n_rows()),
                  columns.start.data(), columns.row.data(), columns.value.data(), finite(problem.column_lower).data(),
                  finite(problem.column_upper).data(), problem.cost.data(), finite(problem.row_lower).data(),
                  finite(problem.row_upper).data());
  Clp_setPrimalTolerance(model.get(), kTolerance);
  Clp_setDualTolerance(model.get(), kTolerance);
  // Clp may cycle on degenerate programs: the next attempt does not. Others take one or two steps per row and column.
  const std::size_t size = std::min(problem.n_columns() + problem.n_rows(), kMostSize);
  Clp_setMaximumIterations(model.get(), static_cast<int>(1000 + 10 * size));
  return model;
}

LpSolution result(Clp_Simplex* model, const LpProblem& problem) {
  LpSolution solution;
  const int status = Clp_status(model);
  solution.status = status == kOptimal           ? LpStatus::optimal
                    : status == kInfeasible      ? LpStatus::infeasible
                    : status == kUnboundedStatus ? LpStatus::unbounded
                                                 : LpStatus::failed;
  if (solution.status != LpStatus::optimal) return solution;
  const double* primal = Clp_primalColumnSolution(model);
  const double* dual = Clp_dualRowSolution(model);
  solution.primal.assign(primal, primal + problem.n_columns());
  solution.dual.assign(dual, dual + problem.n_rows());
  solution.objective = Clp_objectiveValue(model);
  return solution;
}

/// The largest violation of a bound of a column or a row by x.
double violation_of(const LpProblem& problem, const std::vector<double>& x) {
  double worst = 0;
  const auto note = [&worst](double value, double low, double high) {
    worst = std::max({worst, low - value, value - high});
  };
  for (std::size_t c = 0; c < x.size(); ++c) note(x[c], problem.column_lower[c], problem.column_upper[c]);
  for (std::size_t r = 0; r < problem.n_rows(); ++r) {
    double sum = 0;
    for (int i = problem.row_start[r]; i < problem.row_start[r + 1]; ++i) {
      sum += problem.value[i] * x[static_cast<std::size_t>(problem.column[i])];
    }
    note(sum, problem.row_lower[r], problem.row_upper[r]);
  }
  return worst;
}

/// Cost of x above the bound that the multipliers prove (weak duality), relative.
double gap_of(const LpProblem& problem, const LpSolution& solution) {
  const auto least = [](double factor, double low, double high) {
    if (std::abs(factor) <= kTolerance) return 0.0;
    return factor * (factor > 0 ? low : high);
  };
  std::vector<double> reduced = problem.cost;
  double bound = 0;
  for (std::size_t r = 0; r < problem.n_rows(); ++r) {
    bound += least(solution.dual[r], problem.row_lower[r], problem.row_upper[r]);
    for (int i = problem.row_start[r]; i < problem.row_start[r + 1]; ++i) {
      reduced[static_cast<std::size_t>(problem.column[i])] -= problem.value[i] * solution.dual[r];
    }
  }
  for (std::size_t c = 0; c < reduced.size(); ++c) {
    bound += least(reduced[c], problem.column_lower[c], problem.column_upper[c]);
  }
  return std::abs(solution.objective - bound) / (1 + std::abs(solution.objective));
}

/// Clp calls some solutions optimal that are off by 10⁻⁵, because it does not fully undo perturbation or scaling.
bool is_good(const LpProblem& problem, const LpSolution& solution) {
  return violation_of(problem, solution.primal) <= kAccepted && gap_of(problem, solution) <= kAccepted;
}

/// One way to solve: the first good one is taken.
struct Attempt {
  bool dual;
  bool perturb;
  bool scale;
};
constexpr Attempt kAttempts[] = {
    {true, true, true}, {true, false, true}, {false, false, true}, {true, false, false}, {false, false, false}};

LpSolution attempt(const LpProblem& problem, const Attempt& how) {
  constexpr int kNoPerturbation = 100, kPerturbation = 50, kNoScaling = 0, kAutomaticScaling = 3;  // Clp's codes
  const Model model = load(problem);
  const auto run = [&](const Attempt& step) {
    Clp_setPerturbation(model.get(), step.perturb ? kPerturbation : kNoPerturbation);
    Clp_scaling(model.get(), step.scale ? kAutomaticScaling : kNoScaling);
    if (step.dual) {
      Clp_dual(model.get(), 0);
    } else {
      Clp_primal(model.get(), 0);
    }
    return result(model.get(), problem);
  };
  LpSolution solution = run(how);
  if (solution.status != LpStatus::optimal || problem.n_rows() < kLarge || is_good(problem, solution)) return solution;
  return run({false, false, false});  // from this basis: mostly without a step
}

LpSolution solve_carefully(const LpProblem& problem) {
  std::size_t infeasible = 0;
  for (const Attempt& how : kAttempts) {
    LpSolution solution = attempt(problem, how);
    if (solution.status == LpStatus::optimal && is_good(problem, solution)) return solution;
    if (solution.status == LpStatus::unbounded) return solution;
    // Two methods must agree that no solution exists.
    infeasible += solution.status == LpStatus::infeasible ? 1 : 0;
    if (infeasible == 2) return solution;
  }
  return {};
}

class ClpSolver final : public LpSolver {
 public:
  LpSolution solve(const LpProblem& problem) override {
    // Clp throws CoinError on supposed misuse; for the caller it has just failed.
    try {
      return solve_carefully(problem);
    } catch (const std::bad_alloc&) {
      throw;  // which is nothing that is true of the problem
    } catch (const std::exception&) {
      return {};
    } catch (...) {
      return {};
    }
  }
};

}  // namespace

std::unique_ptr<LpSolver> clp_solver() { return std::make_unique<ClpSolver>(); }

}  // namespace temper
