// The threshold against bisection with the exact test of regularity.
#include "temper/regularity.hpp"

#include <gtest/gtest.h>

#include "support/lattice.hpp"

namespace temper::test {
namespace {

bool star_and_link_regular(const Mesh& mesh, VertexId v) {
  for (const HalfedgeId h : mesh.star(v)) {
    if (!is_regular(mesh, h) || !is_regular(mesh, Mesh::next(h))) return false;
  }
  return true;
}

TEST(FlipThreshold, IsWhereTheFirstEdgeStopsBeingRegular) {
  Noise noise(11);
  int crossings = 0, never = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Mesh mesh = lattice({.jitter = 0.15, .weight = 0.05, .seed = seed});
    restore_regularity(mesh);
    for (const VertexId v : mesh.vertices()) {
      const int kind = static_cast<int>(v.index % 3);  // position, weight, both
      const std::array<double, 3> step = {kind == 1 ? 0 : 0.5 * noise(), kind == 1 ? 0 : 0.5 * noise(),
                                          kind == 0 ? 0 : noise()};
      const WeightedPoint p = mesh.point(v);
      const auto regular_at = [&](double t) {
        mesh.set_point(v, {p.x + t * step[0], p.y + t * step[1], p.w + t * step[2]});
        const bool regular = star_and_link_regular(mesh, v);
        mesh.set_point(v, p);
        return regular;
      };
      const double threshold = flip_threshold(mesh, v, step);
      ASSERT_TRUE(regular_at(0));
      // The first failure on a fine grid, then bisection.
      constexpr int kGrid = 400;
      int first = 1;
      while (first <= kGrid && regular_at(double(first) / kGrid)) ++first;
      if (first > kGrid) {
        EXPECT_GT(threshold, 1);
        ++never;
        continue;
      }
      double low = double(first - 1) / kGrid, high = double(first) / kGrid;
      for (int i = 0; i < 60; ++i) (regular_at(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
      // A brief excursion between grid points is seen by the threshold only.
      EXPECT_LE(threshold, high * (1 + 1e-9));
      if (threshold < low * (1 - 1e-9)) {
        EXPECT_FALSE(regular_at(threshold * (1 + 1e-9)));
      }
      ++crossings;
    }
  }
  EXPECT_GT(crossings, 50);
  EXPECT_GT(never, 50);
}

TEST(FlipThreshold, PassesOverConstrainedEdges) {
  Mesh mesh = lattice({.jitter = 0, .weight = 0});
  const VertexId v(12);
  const std::array<double, 3> heavier = {0, 0, 1};
  EXPECT_LT(flip_threshold(mesh, v, heavier), kNoThreshold);
  for (const HalfedgeId h : mesh.star(v)) {
    mesh.set_constrained(h, true);
    mesh.set_constrained(Mesh::next(h), true);
  }
  EXPECT_EQ(flip_threshold(mesh, v, heavier), kNoThreshold);
}

}  // namespace
}  // namespace temper::test
