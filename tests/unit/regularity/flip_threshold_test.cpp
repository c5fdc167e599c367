// The thresholds of §2.4 against bisection with the exact test of regularity, and where the answer is known.
#include "regularity/flip_threshold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "property/mesh_of_random_points.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// A regular triangulation of weighted points in the square, some of them on its sides, if it shows them all.
struct RegularMesh {
  Mesh mesh;
  bool shows_all = false;
};
RegularMesh regular_mesh(Rng& rng, int n, double amplitude) {
  RegularMesh result{test::mesh_of_random_points(rng, n)};
  Mesh& mesh = result.mesh;
  for (int i = 0; i < n / 3; ++i) {
    const double s = rng.uniform(-1, 1), side = i % 2 == 0 ? -1 : 1;
    test::insert_anywhere(mesh, i % 4 < 2 ? WeightedPoint{s, side, 0} : WeightedPoint{side, s, 0});
  }
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, amplitude * 4 / n * rng.uniform(-1, 1));
  result.shows_all = restore_regularity(mesh).regular();
  return result;
}

/// Are the edges that a change of v can spoil regular with v at p + t step? Exact, but for the rounding of the place.
class Probe {
 public:
  Probe(Mesh& mesh, VertexId v, std::array<double, 3> step) : mesh_(mesh), v_(v), start_(mesh.point(v)), step_(step) {}
  ~Probe() { mesh_.set_point(v_, start_); }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;

  [[nodiscard]] bool regular_at(double t) const {
    mesh_.set_point(v_, {start_.x + t * step_[0], start_.y + t * step_[1], start_.w + t * step_[2]});
    for (const HalfedgeId h : mesh_.star(v_)) {
      if (!is_regular(mesh_, h) || !is_regular(mesh_, Mesh::next(h))) return false;
    }
    return true;
  }

 private:
  Mesh& mesh_;
  VertexId v_;
  WeightedPoint start_;
  std::array<double, 3> step_;
};

// What rounding may move a threshold by, relative to itself and to the domain's size 1: conditioning included.
constexpr double kClose = 1e-9;
constexpr double kFar = 0x1p20;

TEST(WeightFlipThreshold, OnTheSphereEdgesAreRegularBeforeItAndOneIsNotBehindIt) {
  const auto globe = random_sphere({.vertices = 200, .radius = 3});
  ASSERT_TRUE(globe);
  int finite = 0;
  for (const VertexId v : globe->vertices()) {
    for (const int sign : {1, -1}) {
      const double threshold = weight_flip_threshold(*globe, v, sign);
      if (threshold == kNoThreshold) continue;
      ++finite;
      Mesh mesh = *globe;
      mesh.set_weight(v, sign * threshold * (1 - kClose));
      EXPECT_EQ(count_non_regular_edges(mesh), 0U) << v.index;
      mesh.set_weight(v, sign * threshold * (1 + kClose));
      EXPECT_GT(count_non_regular_edges(mesh), 0U) << v.index;
    }
  }
  EXPECT_GT(finite, 200);
}

// Each edge's condition is linear in the weight, so those weights at which all hold are an interval: bisection is sure.
TEST(WeightFlipThreshold, IsWhereBisectionFindsTheFirstFlip) {
  int finite = 0, infinite = 0, on_boundary = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    RegularMesh random = regular_mesh(rng, 24, seed % 3 == 0 ? 0 : 0.06);
    if (!random.shows_all) continue;
    Mesh& mesh = random.mesh;
    for (const VertexId v : mesh.vertices()) {
      for (const double direction : {1.0, -1.0}) {
        const double threshold = weight_flip_threshold(mesh, v, direction);
        const Probe probe(mesh, v, {0, 0, direction});
        ASSERT_TRUE(probe.regular_at(0));
        double low = 0, high = 1e-6;
        while (high < kFar && probe.regular_at(high)) low = high, high *= 2;
        if (high >= kFar) {
          EXPECT_EQ(threshold, kNoThreshold);
          ++infinite;
          continue;
        }
        for (int i = 0; i < 80; ++i) (probe.regular_at(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
        ASSERT_NEAR(threshold, low, kClose * (1 + low)) << "seed " << seed << " vertex " << v.index;
        ++finite;
        on_boundary += mesh.is_boundary(v) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(finite, 1200);
  EXPECT_GT(infinite, 40);
  EXPECT_GT(on_boundary, 400);
}

// A link edge may fail on a stretch in the middle of the line, so we look everywhere before, and just behind.
TEST(PositionFlipThreshold, EdgesAreRegularBeforeItAndOneIsNotBehindIt) {
  constexpr int kSamples = 40;
  int finite = 0, infinite = 0, on_boundary = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Rng rng(seed);
    RegularMesh random = regular_mesh(rng, 24, seed % 3 == 0 ? 0 : 0.06);
    if (!random.shows_all) continue;
    Mesh& mesh = random.mesh;
    for (const VertexId v : mesh.vertices()) {
      const Vec2 direction = {rng.uniform(-1, 1), rng.uniform(-1, 1)};
      const double threshold = position_flip_threshold(mesh, v, direction);
      const Probe probe(mesh, v, {direction.x, direction.y, 0});
      ASSERT_TRUE(probe.regular_at(0));
      if (threshold == kNoThreshold) {
        for (double t = 0x1p-10; t < kFar; t *= 1.2) ASSERT_TRUE(probe.regular_at(t)) << "seed " << seed;
        ++infinite;
        continue;
      }
      EXPECT_DOUBLE_EQ(position_flip_threshold(mesh, v, 4 * direction), 0.25 * threshold);
      const double margin = kClose * (1 + threshold);
      for (int i = 1; i <= kSamples; ++i) {
        ASSERT_TRUE(probe.regular_at((threshold - margin) * i / kSamples) || threshold < margin)
            << "seed " << seed << " vertex " << v.index;
      }
      EXPECT_FALSE(probe.regular_at(threshold + margin)) << "seed " << seed << " vertex " << v.index;
      ++finite;
      on_boundary += mesh.is_boundary(v) ? 1 : 0;
    }
  }
  EXPECT_GT(finite, 1000);
  EXPECT_GT(infinite, 100);
  EXPECT_GT(on_boundary, 300);
}

TEST(FlipThreshold, OfAnyStepIsWhereAnEdgeStopsBeingRegular) {
  int finite = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    RegularMesh random = regular_mesh(rng, 24, 0.06);
    if (!random.shows_all) continue;
    for (const VertexId v : random.mesh.vertices()) {
      const std::array<double, 3> step = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
      const double threshold = flip_threshold(random.mesh, v, step);
      const double most = rng.uniform(0, 2) * std::min(threshold, 1.0);
      EXPECT_EQ(flip_threshold_up_to(random.mesh, v, step, most), std::min(threshold, most));
      const Probe probe(random.mesh, v, step);
      if (threshold == kNoThreshold) {
        EXPECT_TRUE(probe.regular_at(1)) << "seed " << seed;
        continue;
      }
      const double margin = kClose * (1 + threshold);
      for (int i = 0; i < 20 && threshold > margin; ++i) {
        ASSERT_TRUE(probe.regular_at((threshold - margin) * i / 19)) << "seed " << seed;
      }
      EXPECT_FALSE(probe.regular_at(threshold + margin)) << "seed " << seed << " vertex " << v.index;
      ++finite;
    }
  }
  EXPECT_GT(finite, 1000);
}

TEST(FlipThreshold, NoVertexOfTheMeshIsHiddenBeforeIt) {
  int cases = 0, hidden_later = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const RegularMesh random = regular_mesh(rng, 15, 0.06);
    if (!random.shows_all) continue;
    for (const VertexId v : random.mesh.vertices()) {
      for (const double direction : {1.0, -1.0}) {
        const double threshold = weight_flip_threshold(random.mesh, v, direction);
        const double w = random.mesh.weight(v);
        const auto restored_at = [&](double change) {
          Mesh mesh = random.mesh;
          mesh.set_weight(v, w + direction * change);
          return restore_regularity(mesh);
        };
        const Restoration before = restored_at(threshold == kNoThreshold ? 1e3 : threshold * (1 - kClose));
        EXPECT_TRUE(before.regular()) << "seed " << seed << " vertex " << v.index;
        EXPECT_EQ(before.flips, 0u);
        EXPECT_TRUE(before.hidden.empty());
        hidden_later += restored_at(1e3).regular() ? 0 : 1;
        ++cases;
      }
    }
  }
  EXPECT_GT(cases, 1000);
  EXPECT_GT(hidden_later, 500);
}

TEST(FlipThreshold, OfTheCenterOfAHexagonIsItsRadius) {
  const double s = std::sqrt(0.75);
  Mesh mesh = test::build_or_die({{1, 0}, {0.5, s}, {-0.5, s}, {-1, 0}, {-0.5, -s}, {0.5, -s}, {0, 0}},
                                 {{6, 0, 1}, {6, 1, 2}, {6, 2, 3}, {6, 3, 4}, {6, 4, 5}, {6, 5, 0}});
  const VertexId center(6);
  mesh.set_weight(center, 0.25);
  EXPECT_DOUBLE_EQ(weight_flip_threshold(mesh, center, -1), 1.25);  // hidden at once: its power is −w = R²
  EXPECT_DOUBLE_EQ(weight_flip_threshold(mesh, center, -7), 1.25);  // a sign, not a length
  EXPECT_EQ(weight_flip_threshold(mesh, center, +1), kNoThreshold);
  mesh.set_weight(center, 0);
  EXPECT_DOUBLE_EQ(position_flip_threshold(mesh, center, {2, 0}), 0.5);
  EXPECT_DOUBLE_EQ(position_flip_threshold(mesh, center, {-0.3, 0.4}), 2);
  EXPECT_EQ(position_flip_threshold(mesh, center, {0, 0}), kNoThreshold);
  EXPECT_EQ(weight_flip_threshold(mesh, center, 0), kNoThreshold);
}

// The square with its diagonal 0-2: four cocircular corners.
TEST(FlipThreshold, IsZeroWhereATieBreaks) {
  const Mesh mesh = test::square();
  for (const std::size_t end : {0u, 2u}) {
    EXPECT_EQ(weight_flip_threshold(mesh, VertexId(end), -1), 0);
    EXPECT_EQ(weight_flip_threshold(mesh, VertexId(end), +1), kNoThreshold);
  }
  for (const std::size_t across : {1u, 3u}) {
    EXPECT_EQ(weight_flip_threshold(mesh, VertexId(across), +1), 0);
    EXPECT_EQ(weight_flip_threshold(mesh, VertexId(across), -1), kNoThreshold);
  }
  EXPECT_EQ(position_flip_threshold(mesh, VertexId(0), {-1, -1}), 0);
  EXPECT_EQ(position_flip_threshold(mesh, VertexId(0), {1, 1}), 2);   // out of the circle on its far side
  EXPECT_EQ(position_flip_threshold(mesh, VertexId(0), {1, -1}), 0);  // along the tangent
  EXPECT_EQ(position_flip_threshold(mesh, VertexId(1), {-1, 1}), 0);
  EXPECT_EQ(position_flip_threshold(mesh, VertexId(1), {1, -1}), kNoThreshold);
  EXPECT_EQ(position_flip_threshold(mesh, VertexId(1), {1, 1}), kNoThreshold);
}

TEST(FlipThreshold, PassesOverConstrainedEdgesAndThoseNotRegularAsItIs) {
  Mesh mesh = test::square();
  const HalfedgeId diagonal = mesh.find_halfedge(VertexId(0), VertexId(2));
  mesh.set_weight(VertexId(1), -0.5);
  EXPECT_EQ(weight_flip_threshold(mesh, VertexId(1), +1), 0.5);
  mesh.set_constrained(diagonal, true);
  EXPECT_EQ(weight_flip_threshold(mesh, VertexId(1), +1), kNoThreshold);
  mesh.set_constrained(diagonal, false);
  mesh.set_weight(VertexId(1), 0.5);
  EXPECT_EQ(weight_flip_threshold(mesh, VertexId(1), +1), kNoThreshold);
}

}  // namespace
}  // namespace temper
