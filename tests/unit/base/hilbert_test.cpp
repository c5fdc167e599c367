// The Hilbert curve visits every cell once, and consecutive cells are neighbors.
#include "base/hilbert.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <vector>

namespace temper {
namespace {

TEST(HilbertIndex, VisitsEveryCellOfACornerOnceFromNeighborToNeighbor) {
  // The 2^k × 2^k cells at the origin, k even, are the first 4^k of the curve (rotated for odd k, still the first).
  constexpr std::uint32_t kSide = 64;
  std::map<std::uint64_t, std::pair<int, int>> cell_at;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      cell_at[hilbert_index(x, y)] = {static_cast<int>(x), static_cast<int>(y)};
    }
  }
  ASSERT_EQ(cell_at.size(), std::size_t{kSide} * kSide);
  EXPECT_EQ(cell_at.begin()->first, 0u);
  EXPECT_EQ(cell_at.rbegin()->first, std::uint64_t{kSide} * kSide - 1);
  for (auto i = cell_at.begin(), j = std::next(i); j != cell_at.end(); i = j++) {
    const auto [x, y] = i->second;
    const auto [u, v] = j->second;
    EXPECT_EQ(std::abs(x - u) + std::abs(y - v), 1);
  }
}

TEST(HilbertIndex, OfTheFarCornersIsInRange) {
  constexpr std::uint32_t kLast = (1u << kHilbertBits) - 1;
  for (const auto& [x, y] : {std::pair{kLast, kLast}, {kLast, 0u}, {0u, kLast}}) {
    EXPECT_LT(hilbert_index(x, y), std::uint64_t{1} << (2 * kHilbertBits));
  }
  EXPECT_EQ(hilbert_index(kLast, 0), (std::uint64_t{1} << (2 * kHilbertBits)) - 1);  // where the curve ends
}

TEST(HilbertGrid, CoversTheBoundingBox) {
  const std::vector<Vec2> points = {{-3, 1e6}, {5, 1e6 + 2}, {1, 1e6 + 1}};
  const HilbertGrid grid(points);
  for (const Vec2 p : points) EXPECT_LT(grid(p), std::uint64_t{1} << (2 * kHilbertBits));
  EXPECT_EQ(grid({-3, 1e6}), 0u);
  const std::vector<Vec2> one = {{7, 7}};
  EXPECT_EQ(HilbertGrid(one)({7, 7}), 0u);
}

}  // namespace
}  // namespace temper
