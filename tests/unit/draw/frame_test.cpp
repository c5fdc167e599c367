// The map to the page, and clipping: what is inside stays, what is outside goes, whatever lies far away.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "draw/viewport.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"

namespace temper {
namespace {

using test::Noise;

constexpr Box kUnit{{0, 0}, {1, 1}};

double polygon_area(const std::vector<Vec2>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
  return twice / 2;
}

TEST(Clip, ASegmentInsideIsKeptBitForBit) {
  const Segment s{{0.1, 0.7}, {0.9, 0.3}};
  const auto kept = clip(s, kUnit);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->from, s.from);
  EXPECT_EQ(kept->to, s.to);
}

TEST(Clip, ASegmentIsCutWhereItLeavesAndDroppedWhereItMisses) {
  const auto cut = clip(Segment{{-1, 0.5}, {3, 0.5}}, kUnit);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->from, (Vec2{0, 0.5}));
  EXPECT_EQ(cut->to, (Vec2{1, 0.5}));
  EXPECT_FALSE(clip(Segment{{-1, 0.5}, {0.5, 3}}, kUnit)) << "passes the corner";
  EXPECT_FALSE(clip(Segment{{2, 0}, {2, 1}}, kUnit)) << "parallel to a side";
}

TEST(Clip, WhatIsNotFiniteIsDropped) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(clip(Segment{{0.5, 0.5}, {kInfinity, 0}}, kUnit));
  EXPECT_FALSE(clip(Segment{{std::nan(""), 0.5}, {0.5, 0.5}}, kUnit));
  const auto far = clip(Segment{{0.5, 0.5}, {1e300, 0.5}}, kUnit);
  ASSERT_TRUE(far);
  EXPECT_NEAR(far->to.x, 1, 1e-15);
}

TEST(Clip, ClippedTrianglesTileWhatTheBoxHolds) {
  // Random triangles: the parts in the two halves of the box add up to the part in the box.
  Noise noise(5);
  int cut = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<Vec2> t(3);
    for (Vec2& p : t) p = {0.5 + noise(), 0.5 + noise()};
    if (cross(t[1] - t[0], t[2] - t[0]) < 0) std::swap(t[1], t[2]);
    const double whole = polygon_area(clip(t, kUnit));
    const double left = polygon_area(clip(t, {{0, 0}, {0.5, 1}})), right = polygon_area(clip(t, {{0.5, 0}, {1, 1}}));
    EXPECT_NEAR(whole, left + right, 1e-14);
    EXPECT_LE(whole, polygon_area(t) + 1e-14);
    cut += left > 0 && right > 0;
  }
  EXPECT_GT(cut, 100);
  EXPECT_TRUE(clip(std::vector<Vec2>{{2, 2}, {3, 2}, {2, 3}}, kUnit).empty());
}

TEST(Frames, EveryVertexIsInsideThePanel) {
  for (const double scale : {1e-12, 1.0, 1e12}) {
    const Mesh mesh = test::lattice({.n = 8, .scale = scale, .offset = {1e6 * scale, -1e6 * scale}});
    const std::array<const Mesh*, 1> meshes = {&mesh};
    const Viewport frame = make_viewport(meshes, {});
    EXPECT_EQ(frame.width, 900);
    for (VertexId v : mesh.vertices()) {
      const GridPoint g = frame.grid(mesh.position(v));
      EXPECT_GT(g.x, 0);
      EXPECT_GT(g.y, 0);
      EXPECT_LT(static_cast<double>(g.x) * frame.unit, frame.width);
      EXPECT_LT(static_cast<double>(g.y) * frame.unit, frame.height);
    }
  }
}

TEST(Frames, TheGridIsFinerThanAHundredthOfAnEdge) {
  for (const int n : {4, 40}) {
    const Mesh mesh = test::lattice({.n = n});
    const std::array<const Mesh*, 1> meshes = {&mesh};
    const Viewport frame = make_viewport(meshes, {});
    EXPECT_LE(frame.unit * 100, frame.edge);
    EXPECT_TRUE(frame.shows_detail());
  }
}

TEST(Frames, AZoomBoxThatIsTurnedRoundOrEmptyStillMakesAPanel) {
  const Mesh mesh = test::lattice();
  const std::array<const Mesh*, 1> meshes = {&mesh};
  DrawOptions options;
  options.zoom = Box{{2, 2}, {1, 1}};
  const Viewport turned = make_viewport(meshes, options);
  EXPECT_LE(turned.box.low.x, 1);
  EXPECT_GE(turned.box.high.x, 2);
  options.zoom = Box{{1, 1}, {1, 1}};
  EXPECT_GT(make_viewport(meshes, options).scale, 0);
  EXPECT_TRUE(std::isfinite(make_viewport(meshes, options).scale));
  const Mesh nothing;
  const std::array<const Mesh*, 1> none = {&nothing};
  EXPECT_TRUE(std::isfinite(make_viewport(none, {}).scale));
}

}  // namespace
}  // namespace temper
