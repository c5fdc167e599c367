#include "base/supernodes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "temper/detail/instruction_set.hpp"

namespace temper {
namespace {

/// A symmetric matrix with a dominant diagonal; its entries may repeat, in both triangles.
struct Sparse {
  std::size_t n = 0;
  std::vector<SupernodalCholesky::Entry> entries;
  std::vector<double> values;

  Sparse(std::size_t size, std::size_t further, std::uint64_t seed) : n(size) {
    Rng rng(seed);
    std::vector<double> diagonal(n, 0.1);
    const auto any = [&] { return static_cast<int>(rng.uniform(0, static_cast<double>(n)) * 0.999999); };
    for (std::size_t i = 0; i < further; ++i) {
      const int row = any(), column = any();
      const double value = rng.uniform(-1, 1);
      if (row == column) continue;
      add(row, column, value);
      diagonal[static_cast<std::size_t>(row)] += std::abs(value);
      diagonal[static_cast<std::size_t>(column)] += std::abs(value);
    }
    for (std::size_t i = 0; i < n; ++i) add(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
  }
  void add(int row, int column, double value) {
    entries.push_back({row, column});
    values.push_back(value);
  }
  [[nodiscard]] std::vector<double> times(const std::vector<double>& x, double shift) const {
    std::vector<double> y(n);
    for (std::size_t i = 0; i < n; ++i) y[i] = shift * x[i];
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const auto i = static_cast<std::size_t>(entries[k].row), j = static_cast<std::size_t>(entries[k].column);
      y[i] += values[k] * x[j];
      if (i != j) y[j] += values[k] * x[i];
    }
    return y;
  }
};

/// Some order of elimination.
std::vector<int> shuffled(std::size_t n, std::uint64_t seed) {
  std::vector<int> place(n);
  std::iota(place.begin(), place.end(), 0);
  Rng rng(seed);
  for (std::size_t i = n; i > 1; --i)
    std::swap(place[i - 1], place[static_cast<std::size_t>(rng.uniform(0, static_cast<double>(i)) * 0.999999)]);
  return place;
}

/// Solutions of one right side, and of eight multiples of it.
std::vector<double> solutions(const Sparse& a, const SupernodalCholesky& l, const std::vector<double>& right) {
  std::vector<double> one = right, lanes(kLanes * a.n), all;
  for (std::size_t i = 0; i < a.n; ++i) {
    for (std::size_t k = 0; k < kLanes; ++k) lanes[kLanes * l.place(i) + k] = static_cast<double>(k) * right[i];
  }
  l.solve(one);
  l.solve_lanes(lanes.data());
  for (std::size_t i = 0; i < a.n; ++i) {
    all.push_back(one[i]);
    for (std::size_t k = 0; k < kLanes; ++k) all.push_back(lanes[kLanes * l.place(i) + k]);
  }
  return all;
}

// Few entries leave many trees; many fill one panel of all columns.
TEST(Supernodes, SolveWhatTheMatrixMultiplies) {
  for (const auto& [n, further] : std::vector<std::pair<std::size_t, std::size_t>>{
           {1, 0}, {7, 3}, {60, 40}, {60, 90}, {90, 2000}, {400, 700}, {1500, 2600}}) {
    const Sparse a(n, further, n + further);
    SupernodalCholesky l;
    l.analyze(shuffled(n, 5), a.entries);
    for (const double shift : {0.0, 2.0}) {
      ASSERT_TRUE(l.factor(a.values, shift)) << n;
      Rng rng(9);
      std::vector<double> x(n);
      for (double& value : x) value = rng.uniform(-1, 1);
      const std::vector<double> found = solutions(a, l, a.times(x, shift));
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_NEAR(found[(1 + kLanes) * i], x[i], 1e-12) << n << " unknowns, number " << i;
        for (std::size_t k = 0; k < kLanes; ++k)
          ASSERT_NEAR(found[(1 + kLanes) * i + 1 + k], static_cast<double>(k) * x[i], 1e-11) << k;
      }
    }
  }
}

TEST(Supernodes, HaveTheSameBitsInAllInstructionSets) {
  const Sparse a(700, 1500, 3);
  const std::vector<double> right(a.n, 1.0);
  std::vector<double> first;
  const InstructionSet before = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set));
    SupernodalCholesky l;
    l.analyze(shuffled(a.n, 1), a.entries);
    ASSERT_TRUE(l.factor(a.values));
    const std::vector<double> now = solutions(a, l, right);
    if (first.empty()) first = now;
    EXPECT_EQ(now, first);
  }
  ASSERT_TRUE(use_instruction_set(before));
}

TEST(Supernodes, RefuseMatricesThatAreNotPositive) {
  Sparse a(50, 100, 4);
  SupernodalCholesky l;
  l.analyze(shuffled(a.n, 2), a.entries);
  for (const double value : {-1.0, 0.0, std::nan("")}) {
    a.values.back() = value;
    EXPECT_FALSE(l.factor(a.values));
  }
  a.values.back() = 100;
  EXPECT_TRUE(l.factor(a.values));
}

}  // namespace
}  // namespace temper
