// The plane of a tensor's metric, and the way there and back.
#include "temper/detail/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

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
    EXPECT_FALSE(there->is_cut());
    EXPECT_FALSE(there->mesh.validate());
    EXPECT_NEAR(test::area(there->mesh), test::area(mesh), 1e-9);
    const auto back = mapped_back(*there, mesh, *there);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->mesh, mesh);
  }
}

TEST(Mapped, WhatMovedIsMappedBackAndNumbersMayBeOthers) {
  const Mesh mesh = test::lattice({.n = 5});
  const auto metric = Metric::of({3, 1.1, 0.7});
  const MetricMesh pieces = *mapped(mesh, *metric);
  Mesh there = pieces.mesh;
  const VertexId moved(12);
  const Vec2 step = {0.03, -0.02};
  there.set_position(moved, there.position(moved) + metric->to_metric(step));
  IdVector<VertexId, VertexId> numbers;
  for (const VertexId v : mesh.vertices()) numbers.push_back(v.index == 24 ? VertexId() : v);
  const auto back = mapped_back(with_mesh(pieces, there, numbers), mesh, pieces, numbers);
  ASSERT_TRUE(back);
  for (const VertexId v : mesh.vertices()) {
    const Vec2 expected = v == moved ? mesh.position(v) + step : mesh.position(v);
    const bool exact = v != moved && v.index != 24;
    EXPECT_LE(length(back->mesh.position(v) - expected), exact ? 0 : 1e-14) << v.index;
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
  const MetricMesh pieces = *mapped(original, Metric());
  const auto turned = mapped_back(with_mesh(pieces, flat), original, pieces);
  ASSERT_FALSE(turned);
  EXPECT_EQ(turned.error().code, ErrorCode::zero_area);
}

/// Tensors of a lattice over the unit square: K below y = 1/2, L above, M in a corner.
std::vector<Tensor> tensors_of(const Mesh& mesh, const Tensor& k, const Tensor& l, const Tensor& m) {
  std::vector<Tensor> tensors;
  for (const TriangleId t : mesh.triangles()) {
    Vec2 middle = {0, 0};
    for (const VertexId v : mesh.corners(t)) middle = middle + (1.0 / 3) * mesh.position(v);
    tensors.push_back(middle.x > 0.5 && middle.y > 0.5 ? m : middle.y > 0.5 ? l : k);
  }
  return tensors;
}

TEST(Pieces, AreCutWhereThePlaneChangesAndJoinedAgainBitForBit) {
  const Mesh mesh = test::lattice({.n = 8, .jitter = 0});
  const auto metrics = Metrics::of(tensors_of(mesh, {1, 0, 4}, {4, 1, 1}, {2, -1, 3}));
  ASSERT_TRUE(metrics);
  const auto pieces = mapped(mesh, *metrics);
  ASSERT_TRUE(pieces);
  EXPECT_TRUE(pieces->is_cut());
  EXPECT_FALSE(pieces->mesh.validate());
  std::size_t seams = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    const Metric &a = metrics->of(Mesh::triangle(h)), &b = metrics->of(Mesh::triangle(mesh.twin(h)));
    seams += a.shares_plane(b) ? 0 : 1;
    EXPECT_EQ(pieces->mesh.is_boundary(h), !a.shares_plane(b));
  }
  EXPECT_EQ(seams_of(*pieces).size(), seams);
  EXPECT_GT(seams, 8U);
  for (const TriangleId t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = pieces->mesh.corners(t).at(k);
      EXPECT_EQ(pieces->first_copy(v), mesh.corners(t).at(k));
      const Vec2 there = metrics->of(t).to_metric(mesh.position(mesh.corners(t).at(k)));
      EXPECT_EQ(pieces->mesh.position(v).x, there.x);
      EXPECT_EQ(pieces->mesh.position(v).y, there.y);
    }
  }
  const auto back = mapped_back(*pieces, mesh, *pieces);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->mesh, mesh);
  EXPECT_EQ(back->corner_weights.size(), mesh.n_halfedges());
  EXPECT_EQ(back->tensors.size(), mesh.n_triangles());
}

TEST(Pieces, OfMultiplesOfOneTensorAreOne) {
  const Mesh mesh = test::lattice({.n = 6});
  const auto metrics = Metrics::of(tensors_of(mesh, {1, 0.1, 4}, {3, 0.3, 12}, {1e-7, 1e-8, 4e-7}));
  ASSERT_TRUE(metrics);
  const auto pieces = mapped(mesh, *metrics);
  ASSERT_TRUE(pieces);
  EXPECT_FALSE(pieces->is_cut());
  EXPECT_EQ(pieces->mesh.n_vertices(), mesh.n_vertices());
  const auto one = Metrics::of(tensors_of(mesh, {1, 0, 4}, {1, 0, 4}, {1, 0, 4}));
  ASSERT_TRUE(one);
  EXPECT_TRUE(one->is_constant());
}

TEST(Pieces, KeepAWeightForEachCorner) {
  const Mesh mesh = test::lattice({.n = 5});
  const auto metrics = Metrics::of(tensors_of(mesh, {1, 0, 4}, {4, 0, 1}, {4, 0, 1}));
  std::vector<double> weights;
  for (const HalfedgeId h : mesh.halfedges())
    weights.push_back(0.01 * metrics->of(Mesh::triangle(h)).tensor().xx * mesh.origin(h).index);
  const auto pieces = mapped(mesh, *metrics, weights);
  ASSERT_TRUE(pieces);
  const auto back = mapped_back(*pieces, mesh, *pieces);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->corner_weights, weights);
  weights.pop_back();
  const auto refused = mapped(mesh, *metrics, weights);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "corner weights: expected " + std::to_string(mesh.n_halfedges()) + " for " +
                                         std::to_string(mesh.n_triangles()) + " triangles, found " +
                                         std::to_string(weights.size()));
}

TEST(Pieces, WrongTensorsAreToldWithTheirTriangle) {
  const Mesh mesh = test::lattice({.n = 3});
  std::vector<Tensor> tensors(mesh.n_triangles());
  tensors[4] = {1, 2, 1};
  const auto refused = Metrics::of(tensors);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().message.starts_with("triangle 4: tensor: expected a positive definite tensor"));
  for (double Tensor::*component : {&Tensor::xx, &Tensor::xy, &Tensor::yy}) {
    tensors.assign(mesh.n_triangles(), Tensor{3, 1, 2});
    tensors[6].*component = std::numeric_limits<double>::quiet_NaN();
    const auto nan = Metrics::of(tensors);
    ASSERT_FALSE(nan);
    EXPECT_TRUE(nan.error().message.starts_with("triangle 6: tensor: expected finite numbers")) << nan.error().message;
  }
}

}  // namespace
}  // namespace temper
