// Parts of the program that can be had without running it.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <string>
#include <vector>

#include "temper/detail/suggest.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

TEST(Threads, AreThereWhenMoreThanOneIsAskedFor) {
  EXPECT_EQ(make_threads(1), nullptr);
#ifdef TEMPER_WITH_TBB
  constexpr bool kThere = true;
#else
  constexpr bool kThere = false;
#endif
  for (const std::size_t threads : {2u, 3u, 8u}) EXPECT_EQ(make_threads(threads) != nullptr, kThere);
}

TEST(Threads, RunEveryBlockOnceHoweverManyTheyAre) {
  for (const std::size_t threads : {0u, 2u, 3u, 8u}) {
    const auto executor = make_threads(threads);
    if (executor == nullptr) continue;
    for (const std::size_t n : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<int> runs(n, 0);
      executor->run(n, [&runs](std::size_t i) { ++runs[i]; });
      EXPECT_EQ(runs, std::vector<int>(n, 1)) << threads << " threads, " << n << " blocks";
    }
  }
}

TEST(Threads, ReturnOnlyWhenAllBlocksAreDone) {
  const auto executor = make_threads(3);
  if (executor == nullptr) GTEST_SKIP() << "built without oneTBB";
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> done = 0;
    executor->run(5, [&done](std::size_t) { ++done; });
    ASSERT_EQ(done, 5);
  }
}

TEST(Threads, RunWithinABlock) {
  const auto executor = make_threads(4);
  if (executor == nullptr) GTEST_SKIP() << "built without oneTBB";
  std::atomic<int> done = 0;
  executor->run(20, [&](std::size_t) { executor->run(30, [&done](std::size_t) { ++done; }); });
  EXPECT_EQ(done, 600);
}

TEST(Suggestion, NamesTheNearestAndNeverAGuess) {
  constexpr std::array<std::string_view, 4> kNames = {"F", "BP", "newton", "golden"};
  EXPECT_EQ(nearest("newtn", kNames), "newton");
  EXPECT_EQ(nearest("GOLDEN", kNames), "golden");
  EXPECT_EQ(nearest("bq", kNames), "BP");
  EXPECT_EQ(nearest("X", kNames), "");
  EXPECT_EQ(nearest("something", kNames), "");
  EXPECT_EQ(nearest("", kNames), "");
}

}  // namespace
}  // namespace temper::app
