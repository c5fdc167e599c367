// Parts of the program that can be had without running it.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <string>
#include <vector>

#include "processors.hpp"
#include "suggest.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

TEST(Threads, AreThereWhenMoreThanOneIsAskedFor) {
  EXPECT_EQ(make_threads(1), nullptr);
#ifdef TEMPER_WITH_TBB
  EXPECT_TRUE(has_threads());
#else
  EXPECT_FALSE(has_threads());
#endif
  for (const std::size_t threads : {2u, 3u, 8u}) EXPECT_EQ(make_threads(threads) != nullptr, has_threads());
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

TEST(Processors, AreThoseOfEither) {
  const std::string a("\x05\x00\x80", 3), b("\x06", 1);
  EXPECT_EQ(both(a, b), std::string("\x07\x00\x80", 3));
  EXPECT_EQ(both(b, a), both(a, b));
  EXPECT_EQ(count_processors(both(a, b)), 4u);
  EXPECT_EQ(count_processors({}), 0u);
}

#ifdef __linux__
TEST(Processors, AreGivenUpAndTakenAgain) {
  const std::string all = own_processors();
  ASSERT_GT(count_processors(all), 0u);
  std::string one(all.size(), '\0');
  const std::size_t place = all.find_first_not_of('\0');
  one[place] = static_cast<char>(all[place] & -all[place]);  // the lowest bit
  EXPECT_TRUE(run_on(one));
  EXPECT_EQ(own_processors(), one);
  EXPECT_EQ(count_processors(own_processors()), 1u);
  std::string too_many = all;
  too_many.back() = '\x80';
  EXPECT_FALSE(run_on(too_many)) << "there is no such processor";
  EXPECT_EQ(own_processors(), one);
  EXPECT_TRUE(run_on(all));
  EXPECT_EQ(own_processors(), all);
}
#endif

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
