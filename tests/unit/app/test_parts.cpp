// Parts of the program that can be had without running it.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <vector>

#include "suggest.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

TEST(ThreadPool, RunsEveryBlockOnceWithAnyNumberOfThreads) {
  for (const std::size_t threads : {0u, 1u, 2u, 5u}) {
    ThreadPool pool(threads);
    for (const std::size_t n : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<int> runs(n, 0);
      pool.run(n, [&runs](std::size_t i) { ++runs[i]; });
      EXPECT_EQ(runs, std::vector<int>(n, 1)) << threads << " threads, " << n << " blocks";
    }
  }
}

TEST(ThreadPool, ReturnsOnlyWhenAllBlocksAreDone) {
  ThreadPool pool(3);
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> done = 0;
    pool.run(5, [&done](std::size_t) { ++done; });
    ASSERT_EQ(done, 5);
  }
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
