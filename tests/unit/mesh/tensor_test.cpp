// The plane of a tensor's metric, and the way there and back.
#include "temper/detail/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/lattice.hpp"
#include "support/shapes.hpp"

namespace temper {
namespace {

constexpr Tensor kTensors[] = {{1, 0, 1},           {1, 0, 100},         {3, 1.1, 0.7},
                               {1e-9, 2e-10, 4e-9}, {2e12, -1e12, 9e11}, {1, 0, 9e7}};

TEST(Metric, LengthsAreThoseOfTheInverseTensorAndAreasStay) {
  test::Noise noise(3);
  for (const Tensor& k : kTensors) {
    const auto metric = Metric::of(k);
    ASSERT_TRUE(metric) << metric.error().what();
    const double det = k.xx * k.yy - k.xy * k.xy;
    EXPECT_NEAR(metric->strength(), std::sqrt(det), 1e-15 * std::sqrt(det));
    EXPECT_NEAR(cross(metric->to_metric({1, 0}), metric->to_metric({0, 1})), 1, 1e-9);
    for (int i = 0; i < 20; ++i) {
      const Vec2 x = {noise(), noise()};
      const double inverse = (k.yy * x.x * x.x - 2 * k.xy * x.x * x.y + k.xx * x.y * x.y) / det;
      const double expected = metric->strength() * inverse;
      EXPECT_NEAR(squared_length(metric->to_metric(x)), expected, 1e-8 * expected);
      const Vec2 back = metric->from_metric(metric->to_metric(x));
      EXPECT_NEAR(length(back - x), 0, 1e-7 * length(x));
    }
  }
}

TEST(Metric, OfOneMovesNothing) {
  const auto metric = Metric::of({2, 0, 2});
  ASSERT_TRUE(metric);
  EXPECT_NEAR(length(metric->to_metric({0.3, -7}) - Vec2{0.3, -7}), 0, 1e-15);
  EXPECT_EQ(metric->strength(), 2);
}

TEST(Metric, TensorsThatAreNoneAreTold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Tensor& k) {
    const auto made = Metric::of(k);
    return made ? "nothing" : made.error().message;
  };
  const std::string definite =
      "tensor: expected a positive definite tensor kxx,kxy,kyy, with kxx > 0 and kxx kyy > kxy^2, found ";
  EXPECT_EQ(message({1, 2, 1}), definite + "1, 2, 1");
  EXPECT_EQ(message({-1, 0, -1}), definite + "-1, 0, -1");
  EXPECT_EQ(message({0, 0, 1}), definite + "0, 0, 1");
  EXPECT_EQ(message({1, nan, 1}), "tensor: expected finite numbers, found 1, nan, 1");
  EXPECT_EQ(message({1, 0, 1e9}),
            "tensor: expected eigenvalues that are at most 1e8 times each other, found 1, 0, 1e+09");
}

TEST(Mapped, ThereAndBackIsTheSameMeshBitForBit) {
  const Mesh mesh = test::lattice({.n = 6});
  for (const Tensor& k : kTensors) {
    const auto metric = Metric::of(k);
    const auto there = mapped(mesh, *metric);
    ASSERT_TRUE(there);
    EXPECT_FALSE(there->validate());
    EXPECT_NEAR(test::area(*there), test::area(mesh), 1e-9);
    const auto back = mapped_back(*there, mesh, *metric);
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, mesh);
  }
}

TEST(Mapped, WhatMovedIsMappedBackAndNumbersMayBeOthers) {
  const Mesh mesh = test::lattice({.n = 5});
  const auto metric = Metric::of({3, 1.1, 0.7});
  Mesh there = *mapped(mesh, *metric);
  const VertexId moved(12);
  const Vec2 step = {0.03, -0.02};
  there.set_position(moved, there.position(moved) + metric->to_metric(step));
  IdVector<VertexId, VertexId> numbers;
  for (const VertexId v : mesh.vertices()) numbers.push_back(v.index == 24 ? VertexId() : v);
  const auto back = mapped_back(there, mesh, *metric, numbers);
  ASSERT_TRUE(back);
  for (const VertexId v : mesh.vertices()) {
    const Vec2 expected = v == moved ? mesh.position(v) + step : mesh.position(v);
    const bool exact = v != moved && v.index != 24;
    EXPECT_LE(length(back->position(v) - expected), exact ? 0 : 1e-14) << v.index;
  }
}

TEST(Mapped, SpheresAndTrianglesThatTurnOverAreRefused) {
  const Mesh globe = test::lattice({.n = 4, .radius = 10});
  const auto refused = mapped(globe, Metric());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "the mesh is on a sphere, but a diffusion tensor needs a mesh of the plane");
  Mesh flat = test::lattice({.n = 2, .jitter = 0});
  const Mesh original = flat;
  flat.set_position(VertexId(0), flat.position(VertexId(3)));
  const auto turned = mapped_back(flat, original, Metric());
  ASSERT_FALSE(turned);
  EXPECT_EQ(turned.error().code, ErrorCode::zero_area);
}

}  // namespace
}  // namespace temper
