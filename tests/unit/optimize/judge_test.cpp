// The judge of meshes: which of two scores a stage keeps.
#include "optimize/run/judge.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace temper {
namespace {

/// All scores of two values in each place, the better ones first.
std::vector<MeshScore> ascending_scores() {
  std::vector<MeshScore> scores;
  for (std::size_t i = 0; i < 256; ++i) {
    const auto bit = [i](int k) { return i >> (7 - k) & 1; };
    scores.push_back({bit(0), bit(1), bit(2), bit(3), bit(4), bit(5) != 0, 0.25 * static_cast<double>(bit(6)),
                      1.5 - 1 / (1 + static_cast<double>(bit(7)))});
  }
  return scores;
}

TEST(Judge, ReplacesByTheFirstPlaceThatDiffersAndKeepsTiesOnlyWhereTheyWillDo) {
  const std::vector<MeshScore> scores = ascending_scores();
  for (std::size_t i = 0; i < scores.size(); ++i) {
    for (std::size_t j = 0; j < scores.size(); ++j) {
      SCOPED_TRACE(testing::Message() << i << " for " << j);
      const MeshScore &now = scores[i], &best = scores[j];
      const bool fewer_bad = std::pair(now.violations, now.bad) < std::pair(best.violations, best.bad);
      const bool cures =
          now.beyond_guard < best.beyond_guard || fewer_bad || now.missing_lengths < best.missing_lengths;
      ASSERT_EQ(replaces(now, best, Requirement::not_worse), i <= j);
      const bool fewer = now.beyond_guard != best.beyond_guard ? now.beyond_guard < best.beyond_guard : fewer_bad;
      ASSERT_EQ(replaces(now, best, Requirement::fewer_bad), fewer);
      ASSERT_EQ(replaces(now, best, Requirement::cures), i <= j && cures);
    }
  }
}

}  // namespace
}  // namespace temper
