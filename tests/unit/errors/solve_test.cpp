// Sparse solves: definite, indefinite and singular matrices, against what is known of them.
#include "errors/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/lattice.hpp"

namespace temper::error_detail {
namespace {

LinearSystem tridiagonal(std::size_t n, double diagonal) {
  LinearSystem system;
  system.unknowns = n;
  for (std::size_t i = 0; i < n; ++i) {
    system.lower.push_back({i, i, diagonal});
    if (i > 0) system.lower.push_back({i, i - 1, -1});
  }
  return system;
}

double residual(const LinearSystem& system, const std::vector<double>& x, const std::vector<double>& b) {
  std::vector<double> left(b.size(), 0.0);
  for (const auto& [row, column, value] : system.lower) {
    left[row] += value * x[column];
    if (row != column) left[column] += value * x[row];
  }
  double most = 0;
  for (std::size_t i = 0; i < b.size(); ++i) most = std::max(most, std::abs(left[i] - b[i]));
  return most;
}

TEST(ErrorSolve, SolvesDefiniteAndIndefiniteSystems) {
  test::Noise noise(3);
  for (const double diagonal : {2.0, 0.3}) {  // eigenvalues: diagonal + 2 cos, positive for 2 alone
    LinearSystem system = tridiagonal(50, diagonal);
    for (int k = 0; k < 2; ++k) {
      system.right_sides.emplace_back();
      for (int i = 0; i < 50; ++i) system.right_sides.back().push_back(noise());
    }
    const LinearSolution solution = solve(system, false);
    EXPECT_FALSE(solution.singular);
    EXPECT_EQ(solution.definite, diagonal == 2);
    EXPECT_FALSE(solution.condition.has_value());
    ASSERT_EQ(solution.solutions.size(), 2u);
    for (int k = 0; k < 2; ++k) EXPECT_LT(residual(system, solution.solutions[k], system.right_sides[k]), 1e-11);
  }
}

TEST(ErrorSolve, EstimatesTheConditionFromBelow) {
  constexpr std::size_t kSize = 20;
  const double angle = std::acos(-1.0) / (2 * (kSize + 1));
  const double exact = std::pow(std::cos(angle) / std::sin(angle), 2);
  const double estimate = *solve(tridiagonal(kSize, 2), true).condition;
  EXPECT_LE(estimate, exact * (1 + 1e-10));
  EXPECT_GE(estimate, exact * 0.95);
  // It is that of the matrix as it is, whatever the solver scales.
  LinearSystem diagonal = {3, {{0, 0, 1}, {1, 1, -50}, {2, 2, 10}}, {}};
  EXPECT_NEAR(*solve(diagonal, true).condition, 50, 1e-6);
}

TEST(ErrorSolve, SaysWhenAMatrixIsSingular) {
  const LinearSystem two = {2, {{0, 0, 1}, {1, 1, 1}, {1, 0, -1}}, {{1, 0}}};
  const LinearSolution solution = solve(two, true);
  EXPECT_TRUE(solution.singular);
  EXPECT_FALSE(solution.definite);
  EXPECT_TRUE(solution.solutions.empty());
  EXPECT_TRUE(std::isinf(*solution.condition));
  EXPECT_TRUE(solve({2, {{0, 0, 1}}, {{1, 0}}}, false).singular);                        // an empty row
  EXPECT_TRUE(solve({1, {{0, 0, HUGE_VAL}}, {{1}}}, false).singular);                    // no number
  EXPECT_TRUE(solve({2, {{0, 0, 1}, {1, 0, 2}, {1, 1, 4}}, {{1, 0}}}, false).singular);  // rank one
  // A zero diagonal and very unlike rows are not.
  EXPECT_FALSE(solve({2, {{1, 0, 1}}, {{1, 0}}}, false).singular);
  EXPECT_FALSE(solve({2, {{0, 0, 1e-200}, {1, 1, 1e200}}, {{1, 0}}}, false).singular);
}

TEST(ErrorSolve, OfNothingIsNothing) {
  const LinearSolution solution = solve({0, {}, {{}, {}}}, true);
  EXPECT_TRUE(solution.definite);
  EXPECT_FALSE(solution.singular);
  EXPECT_EQ(solution.solutions.size(), 2u);
}

}  // namespace
}  // namespace temper::error_detail
