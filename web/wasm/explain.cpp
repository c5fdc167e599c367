// Explanations. The linear programs are solved on the side of JavaScript, by a solver of its own.
#include "temper/explain.hpp"

#include <utility>
#include <vector>

#include "answer.hpp"
#include "held_mesh.hpp"
#include "records.hpp"

namespace temper::wasm {
namespace {

/// Solves the problem: writes x and the multipliers, and returns the number of an LpStatus.
TEMPER_IMPORT(solve_lp)
int solve_lp(std::size_t columns, std::size_t rows, std::size_t entries, const double* cost, const double* column_lower,
             const double* column_upper, const double* row_lower, const double* row_upper, const int* row_start,
             const int* column, const double* value, double* primal, double* dual);
/// How many of the bad triangles are explained; 0 stops.
TEMPER_IMPORT(explained) int report_explained(std::size_t done, std::size_t all);

class SolverOutside final : public LpSolver {
 public:
  LpSolution solve(const LpProblem& p) override {
    LpSolution solution;
    std::vector<double> primal(p.n_columns()), dual(p.n_rows());
    solution.status =
        status_of(solve_lp(p.n_columns(), p.n_rows(), p.value.size(), p.cost.data(), p.column_lower.data(),
                           p.column_upper.data(), p.row_lower.data(), p.row_upper.data(), p.row_start.data(),
                           p.column.data(), p.value.data(), primal.data(), dual.data()));
    if (solution.status != LpStatus::optimal) return solution;
    for (std::size_t c = 0; c < p.n_columns(); ++c) solution.objective += p.cost[c] * primal[c];
    solution.primal = std::move(primal);
    solution.dual = std::move(dual);
    return solution;
  }

 private:
  static LpStatus status_of(int number) {
    constexpr LpStatus kAll[] = {LpStatus::optimal, LpStatus::infeasible, LpStatus::unbounded};
    return number >= 0 && number < 3 ? kAll[number] : LpStatus::failed;
  }
};

}  // namespace

/// The answer is the explanation.
TEMPER_EXPORT(mesh_explain) int mesh_explain(const HeldMesh* held, const char* given, std::size_t size) {
  return done([&] {
    constexpr std::string_view kNames[] = {"cures", "whole"};
    const Json wanted = parse({given, size});
    expect_names(wanted, kNames);
    ExplainOptions options;
    take(wanted, "cures", options.cures), take(wanted, "whole", options.whole);
    options.progress = [](std::size_t done, std::size_t all) {
      return report_explained(done, all) != 0 ? Continue::yes : Continue::no;
    };
    SolverOutside solver;
    const Mesh& mesh = held->mesh;
    const Explanation why = or_fail(explain(mesh, solver, options));
    answer(json_of(ExplanationReport{mesh, why}));
  });
}

}  // namespace temper::wasm
