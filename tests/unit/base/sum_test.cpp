// blockwise_sum: the same bits whatever runs it, and near the sum in higher precision.
#include "base/sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <thread>

#include "base/rng.hpp"
#include "support/thread_communicator.hpp"

namespace temper {
namespace {

/// Blocks in a random order.
class Shuffled final : public Executor {
 public:
  explicit Shuffled(std::uint64_t seed) : rng_(seed) {}
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[rng_.below(static_cast<std::uint32_t>(i))]);
    for (const std::size_t b : order) block(b);
    blocks_run += n;
  }
  std::size_t blocks_run = 0;

 private:
  Rng rng_;
};

/// Blocks dealt out to some threads.
class Threads final : public Executor {
 public:
  explicit Threads(std::size_t threads) : threads_(threads) {}
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    std::vector<std::thread> pool;
    for (std::size_t k = 0; k < threads_; ++k) {
      pool.emplace_back([&, k] {
        for (std::size_t b = k; b < n; b += threads_) block(b);
      });
    }
    for (std::thread& thread : pool) thread.join();
  }

 private:
  std::size_t threads_;
};

std::vector<double> random_values(std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> values(n);
  for (double& x : values) x = std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(40)));
  return values;
}

TEST(BlockwiseSum, DoesNotDependOnTheExecutor) {
  for (const std::size_t n : {std::size_t{1}, kBlockSize - 1, kBlockSize, kBlockSize + 1, 17 * kBlockSize + 5}) {
    const std::vector<double> values = random_values(n, n);
    const auto term = [&](std::size_t i) { return values[i]; };
    const double alone = blockwise_sum(n, nullptr, term);
    Shuffled shuffled(n);
    Threads threads(3);
    EXPECT_EQ(blockwise_sum(n, &shuffled, term), alone);
    EXPECT_EQ(blockwise_sum(n, &threads, term), alone);
    EXPECT_EQ(shuffled.blocks_run, (n + kBlockSize - 1) / kBlockSize);
  }
}

TEST(BlockwiseSum, TakesEveryTermOnce) {
  for (std::size_t n : {std::size_t{0}, std::size_t{1}, kBlockSize, 2 * kBlockSize + 1}) {
    std::vector<int> taken(n, 0);
    const double sum = blockwise_sum(n, nullptr, [&](std::size_t i) {
      ++taken[i];
      return static_cast<double>(i);
    });
    EXPECT_EQ(sum, static_cast<double>(n) * (static_cast<double>(n) - 1) / 2 * (n > 0 ? 1 : 0));
    EXPECT_TRUE(std::all_of(taken.begin(), taken.end(), [](int times) { return times == 1; }));
  }
}

TEST(BlockwiseSum, IsNearTheSumInLongDouble) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::size_t n = 100000 + 777 * seed;
    const std::vector<double> values = random_values(n, seed);
    long double exact = 0, magnitude = 0;
    for (const double x : values) {
      exact += x;
      magnitude += std::fabs(x);
    }
    const double sum = blockwise_sum(n, nullptr, [&](std::size_t i) { return values[i]; });
    // Each term goes through at most kBlockSize + log2(blocks) additions of half a unit in the last place.
    const double bound = (static_cast<double>(kBlockSize) + 6) * 0x1p-53 * static_cast<double>(magnitude);
    EXPECT_LE(std::fabs(sum - static_cast<double>(exact)), bound);
    // Typically it is far better: random roundings grow with the square root of their number.
    EXPECT_LE(std::fabs(sum - static_cast<double>(exact)), bound / 50);
  }
}

TEST(SumsOfBlocks, AreTheSameOnAnyNumberOfRanks) {
  for (const std::size_t n : {std::size_t{1}, 17 * kBlockSize + 5}) {
    const std::vector<double> values = random_values(n, n);
    std::atomic<std::size_t> blocks_run = 0;
    const auto add = [&](std::size_t b, std::span<double> sums) {
      ++blocks_run;
      for (std::size_t i = b * kBlockSize; i < std::min(n, (b + 1) * kBlockSize); ++i) {
        sums[0] += values[i];
        sums[1] += 1;
      }
    };
    const std::vector<double> alone = sums_of_blocks(n, 2, nullptr, add);
    EXPECT_EQ(alone[1], static_cast<double>(n));
    blocks_run = 0;
    test::on_ranks(3, [&](Communicator& all) { EXPECT_EQ(sums_of_blocks(n, 2, {nullptr, &all}, add), alone); });
    EXPECT_EQ(blocks_run, (n + kBlockSize - 1) / kBlockSize);
  }
}

TEST(PairwiseSum, IsNearerThanAdditionInOrder) {
  // 0.1 added in order drifts by a rounding a step; pairs are of equal size.
  std::vector<double> tenths(1000000, 0.1);
  const double in_order = std::accumulate(tenths.begin(), tenths.end(), 0.0);
  const double pairs = pairwise_sum(tenths);
  EXPECT_LT(std::fabs(pairs - 1e5), 1e-10);
  EXPECT_GT(std::fabs(in_order - 1e5), 1e-7);
}

TEST(PairwiseSum, OfNothingIsZeroAndKeepsInfinity) {
  std::vector<double> none;
  EXPECT_EQ(pairwise_sum(none), 0);
  std::vector<double> some = {1, HUGE_VAL, 2};
  EXPECT_EQ(pairwise_sum(some), HUGE_VAL);
}

}  // namespace
}  // namespace temper
