// optimize() on surfaces: what it promises to keep, what it reaches, and its parts.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "energy/accuracy_energy.hpp"
#include "optimize/options/settings.hpp"
#include "support/surface_meshes.hpp"
#include "surfaces/optimize/accuracy.hpp"
#include "surfaces/optimize/barrier.hpp"
#include "surfaces/optimize/closest_point.hpp"
#include "surfaces/optimize/draft.hpp"
#include "surfaces/optimize/draft_energy.hpp"
#include "surfaces/optimize/flips.hpp"
#include "surfaces/optimize/patch.hpp"
#include "temper/detail/lp.hpp"
#include "temper/generate.hpp"

namespace temper::surfaces {
namespace {

SurfaceReport optimized(SurfaceMesh& mesh, const SurfaceOptions& options = {}) {
  const auto report = optimize(mesh, *clp_solver(), options);
  EXPECT_TRUE(report) << report.error().what();
  EXPECT_EQ(mesh.validate(), std::nullopt);
  return *report;
}

/// A torus whose points are shaken along the torus.
SurfaceMesh shaken_torus(double shake, std::uint64_t seed, double unit = 1) {
  Rng rng(seed);
  constexpr int kAround = 24, kThrough = 12;
  test::SurfaceArrays arrays = test::torus(kAround, kThrough);
  for (std::size_t i = 0; i < arrays.points.size(); ++i) {
    const auto turn = [&](std::size_t index, int n) {
      return 2 * std::numbers::pi * (static_cast<double>(index) + rng.uniform(-shake, shake)) / n;
    };
    arrays.points[i] = unit * test::on_torus(turn(i / kThrough, kAround), turn(i % kThrough, kThrough));
  }
  return test::mesh_of(arrays);
}

/// Squares in the plane z = 0 with random diagonals; inner points are shaken.
test::SurfaceArrays shaken_grid(int n, double shake, std::uint64_t seed) {
  Rng rng(seed);
  test::SurfaceArrays arrays;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const bool is_inside = i > 0 && i < n && j > 0 && j < n;
      const auto shaken = [&](int x) { return x + (is_inside ? rng.uniform(-shake, shake) : 0); };
      arrays.points.push_back({shaken(i), shaken(j), 0});
      if (i == n || j == n) continue;
      test::add_square(arrays.triangles, i * (n + 1) + j, n + 1, rng);
    }
  }
  return arrays;
}

/// The same with heights.
SurfaceMesh rough_grid(int n, double height, std::uint64_t seed) {
  Rng rng(seed);
  test::SurfaceArrays arrays = shaken_grid(n, 0.3, seed);
  for (Vec3& p : arrays.points) p.z = rng.uniform(-height, height);
  return test::mesh_of(arrays);
}

/// An open cylinder of radius 1 whose points are shaken on it, at its ends around it.
test::SurfaceArrays shaken_cylinder(int n, int m, double shake, std::uint64_t seed) {
  Rng rng(seed);
  test::SurfaceArrays arrays;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= m; ++j) {
      const double turn = 2 * std::numbers::pi * (i + rng.uniform(-shake, shake)) / n;
      const double up = j + (j == 0 || j == m ? 0 : rng.uniform(-shake, shake));
      arrays.points.push_back({std::cos(turn), std::sin(turn), 2 * std::numbers::pi / n * up});
      if (j == m) continue;
      const int a = i * (m + 1) + j, b = (i + 1) % n * (m + 1) + j;
      arrays.triangles.insert(arrays.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
    }
  }
  return arrays;
}

double brute_force_distance(const SurfaceMesh& mesh, Vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.points(t);
    least = std::min(least, length(p - closest_point({a.position(), b.position(), c.position()}, p)));
  }
  return least;
}

TEST(SurfaceBarrier, TheGradientIsThatOfDifferencesToOrderTwo) {
  Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    std::array<WeightedPoint, 3> points;
    for (WeightedPoint& p : points)
      p = {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-0.3, 0.3)};
    const double gamma = rng.uniform(0.1, 1);
    if (width_of({points[0].position(), points[1].position(), points[2].position()}) < 0.3) continue;
    const BarrierValue e = barrier(points, gamma);
    for (std::size_t k = 0; k < 3; ++k) {
      for (double WeightedPoint::*const x :
           {&WeightedPoint::x, &WeightedPoint::y, &WeightedPoint::z, &WeightedPoint::w}) {
        const double slope = x == &WeightedPoint::x   ? e.by_corner[k].x
                             : x == &WeightedPoint::y ? e.by_corner[k].y
                             : x == &WeightedPoint::z ? e.by_corner[k].z
                                                      : e.by_weight[k];
        const auto error = [&](double step) {
          auto after = points, before = points;
          after[k].*x += step, before[k].*x -= step;
          return std::abs((barrier(after, gamma).value - barrier(before, gamma).value) / (2 * step) - slope);
        };
        EXPECT_LT(error(1e-4), 1e-4 * std::max(1.0, std::abs(slope)));
        EXPECT_LT(error(1e-4), 0.02 * error(1e-3) + 1e-8 * std::max(1.0, std::abs(slope)));
      }
    }
  }
}

TEST(SurfaceBarrier, IsTheLeastForEquilateralTrianglesAndHasNoUnit) {
  const std::array<WeightedPoint, 3> best = {{{0, 0, 0, 0}, {1, 0, 0, 0}, {0.5, std::sqrt(0.75), 0, 0}}};
  const BarrierValue e = barrier(best, 0.1);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(length(e.by_corner[k]), 1e-12);
    EXPECT_NEAR(e.by_weight[k], 0, 1e-12);
  }
  std::array<WeightedPoint, 3> some = {{{0, 0, 0, 0.1}, {1, 0, 0.5, 0}, {0.3, 0.2, 1, 0.2}}}, larger = some;
  for (WeightedPoint& p : larger) p = {8 * p.x, 8 * p.y, 8 * p.z, 64 * p.w};
  EXPECT_EQ(barrier(some, 0.1).value, barrier(larger, 0.1).value);
}

Draft draft_of_all(const SurfaceMesh& mesh) {
  Draft draft;
  for (const VertexId v : mesh.vertices()) draft.points.push_back(mesh.point(v));
  for (const TriangleId t : mesh.triangles()) draft.triangles.push_back(mesh.connectivity().corners(t));
  draft.tracks = IdVector<VertexId, Track>(mesh.n_vertices(), kFree);
  draft.weighs = IdVector<VertexId, std::uint8_t>(mesh.n_vertices(), 1);
  return draft;
}

AccuracyModel model_of(Scheme scheme) { return accuracy_model({}, scheme, Star::one); }

/// A torus without bad triangles.
SurfaceMesh good_torus(std::uint64_t seed) {
  SurfaceMesh mesh = shaken_torus(0.2, seed);
  SurfaceOptions options;
  options.surface_distance = 0.02;
  EXPECT_EQ(optimized(mesh, options).violations_after, 0U);
  return mesh;
}

/// Takes an energy of a draft whose vertices move and weigh in part.
template <class Energy>
void expect_gradient_of_steps(const SurfaceMesh& mesh, const Energy& energy_of) {
  Rng rng(7);
  Draft draft = draft_of_all(mesh);
  for (const VertexId v : mesh.vertices()) {
    if (v.index % 3 == 0) draft.tracks[v] = kHeld;
    if (v.index % 4 == 0) draft.weighs[v] = 0;
  }
  const IdVector<VertexId, WeightedPoint> points = draft.points;
  DraftEnergy energy = energy_of(draft);
  const std::vector<double> gradient = energy.value().gradient;
  for (int i = 0; i < 200; ++i) {
    const std::size_t k = rng.below(static_cast<std::uint32_t>(gradient.size()));
    std::vector<double> step(gradient.size(), 0.0);
    constexpr double kStep = 1e-6;
    step[k] = kStep;
    energy.place(step, 1);
    const double after = energy.value().lowered;
    energy.place(step, -1);
    const double before = energy.value().lowered;
    energy.place(step, 0);
    EXPECT_NEAR((after - before) / (2 * kStep), gradient[k], 1e-5 * std::max(1.0, std::abs(gradient[k])));
  }
  EXPECT_EQ(draft.points, points);
  const double first = energy.value().lowered;
  energy.lower(10, [] { return false; });
  EXPECT_LT(energy.value().lowered, first);
  EXPECT_TRUE(energy.is_inside());
  for (const VertexId v : mesh.vertices()) {
    EXPECT_TRUE(draft.tracks[v] != kHeld || draft.points[v].position() == points[v].position());
    EXPECT_TRUE(draft.weighs[v] != 0 || draft.points[v].w == points[v].w);
  }
}

TEST(SurfaceDraft, TheGradientIsThatOfSteps) {
  expect_gradient_of_steps(shaken_torus(0.2, 7), [](Draft& draft) { return DraftEnergy(draft, 0.5); });
  for (const Scheme scheme : {Scheme::all, Scheme::vertex, Scheme::cell, Scheme::stars})
    expect_gradient_of_steps(good_torus(7), [&](Draft& draft) { return DraftEnergy(draft, model_of(scheme)); });
}

TEST(SurfaceAccuracy, InThePlaneItIsThePlanes) {
  Mesh plane = *random_mesh({.vertices = 300, .seed = 5});
  ASSERT_TRUE(temper::optimize(plane));
  const Draft draft = draft_of_all(test::mesh_of(test::lifted(plane)));
  for (const Scheme scheme : {Scheme::all, Scheme::vertex, Scheme::cell, Scheme::stars}) {
    const AccuracyModel model = model_of(scheme);
    const DraftAccuracy accuracy(draft, model);
    AccuracyDomain domain;
    domain.sizes = accuracy.sizes();
    domain.floors.raise(plane, model.margin);
    const AccuracyTotal total = accuracy_total(plane, domain, model);
    const auto gradient = accuracy_gradient(plane, domain, model, nullptr);
    std::vector<CornerSlopes> slopes;
    EXPECT_NEAR(accuracy.value(draft, slopes) / (total.energy + total.barrier), 1, 1e-12);
    IdVector<VertexId, CornerSlopes> sums(plane.n_vertices());  // in the first corner
    for (std::size_t t = 0; t < slopes.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        CornerSlopes& sum = sums[draft.triangles[t][k]];
        sum.by_corner[0] = sum.by_corner[0] + slopes[t].by_corner[k];
        sum.by_weight[0] += slopes[t].by_weight[k];
      }
    }
    double largest = 0;
    for (const VertexId v : plane.vertices()) largest = std::max(largest, length(gradient[v].position()));
    for (const VertexId v : plane.vertices()) {
      EXPECT_NEAR(sums[v].by_corner[0].x, gradient[v].x, 1e-10 * largest);
      EXPECT_NEAR(sums[v].by_corner[0].y, gradient[v].y, 1e-10 * largest);
      EXPECT_NEAR(sums[v].by_weight[0], gradient[v].w, 1e-10 * largest);
    }
  }
}

// Two triangles with the common edge from (0, 0, 0) to (0, 1, 0), and one of them has a corner at this height.
TEST(SurfaceDraft, GoesBackWhereItTurnsTooMuch) {
  const auto turned = [](double from, double to, TurnLimit limit, double right = 1) {
    Draft draft;
    draft.points = IdVector<VertexId, WeightedPoint>(4);
    draft.points[VertexId(1)].y = 1;
    draft.points[VertexId(2)] = {-1, 0.5, 0, 0};
    draft.points[VertexId(3)] = {right, 0.5, from, 0};
    draft.triangles = {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(1), VertexId(0), VertexId(3)}};
    const IdVector<VertexId, WeightedPoint> first = draft.points;
    draft.points[VertexId(3)].z = to;
    go_back(draft, first, limit);
    return draft.points[VertexId(3)].z == to;
  };
  // The turn is 45 degrees at the height 1, 55 degrees at 1.43 and 35 degrees at 0.7.
  EXPECT_TRUE(turned(0.7, 1, {50, 50, 50}));
  EXPECT_FALSE(turned(0.7, 1.43, {50, 50, 50}));
  EXPECT_TRUE(turned(0.7, 1.43, {}));
  EXPECT_FALSE(turned(0.7, 1.43, {50, 60, 50}));
  EXPECT_TRUE(turned(0.1, 0.7, {50, 90, 50}, 0.4));  // 60 degrees at an angle of 116 degrees
  EXPECT_FALSE(turned(0.1, 0.7, {50, 50, 90}, 0.4));
  EXPECT_TRUE(turned(1, 1.43, {40, 40, 56}));
  EXPECT_FALSE(turned(1, 1.43, {40, 40, 54}));
}

TEST(SurfaceClosestPoint, IsTheBestOfAllTriangles) {
  const SurfaceMesh mesh = shaken_torus(0.3, 1);
  const ClosestPoints closest(mesh);
  Rng rng(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = {rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-1, 1)};
    const double distance = brute_force_distance(mesh, p);
    EXPECT_NEAR(std::sqrt(closest.find(p).squared_distance), distance, 1e-14);
  }
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(closest.find(mesh.position(v)).squared_distance, 0);
}

/// The largest distance of random points of a mesh from another one, if some are a corner.
double sampled_distance(const SurfaceMesh& from, const SurfaceMesh& to, int per_triangle, std::uint64_t seed) {
  Rng rng(seed);
  const ClosestPoints closest(to);
  double most = 0;
  for (const TriangleId t : from.triangles()) {
    const auto [a, b, c] = from.points(t);
    for (int i = 0; i < per_triangle; ++i) {
      double u = rng.uniform(0, 1), v = rng.uniform(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (i % 4 == 0) v = 0;
      if (i % 4 == 1) v = 1 - u;
      const Vec3 p = (1 - u - v) * a.position() + u * b.position() + v * c.position();
      most = std::max(most, std::sqrt(closest.find(p).squared_distance));
    }
  }
  return most;
}

TEST(SurfaceClosestPoint, ATriangleWhoseAreaIsRoundingIsItsSides) {
  const Target sliver({Vec3{0, 0, 0}, {1, 0.08, 0}, {0.22, 0.22 * 0.08, 0}});
  EXPECT_EQ(length(sliver.normal), 0);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(sliver.squared_distance({1, 0.08, 0.5}, infinity), 0.25, 1e-15);
  EXPECT_EQ(sliver.squared_distance({-3, 4, 0}, infinity), 25);
  EXPECT_EQ(sliver.squared_distance({-3, 4, 0}, 24), infinity);
}

TEST(SurfaceDistance, TheBoundOfATriangleIsTheLargestDistanceOfItsPoints) {
  const SurfaceMesh mesh = shaken_torus(0.3, 9);
  const ClosestPoints closest(mesh);
  Rng rng(4);
  const auto off = [&](double most) {
    return Vec3{rng.uniform(-most, most), rng.uniform(-most, most), rng.uniform(-most, most)};
  };
  for (int i = 0; i < 300; ++i) {
    const Vec3 on = mesh.position(VertexId(rng.below(static_cast<std::uint32_t>(mesh.n_vertices()))));
    ClosestPoints::Triangle triangle = {on + off(0.2), on + off(0.2), on + off(0.2)};
    const bool is_segment = i % 3 == 0;
    if (is_segment) triangle[2] = triangle[0];
    double most = 0;
    constexpr int kParts = 60;
    for (int u = 0; u <= kParts; ++u) {
      for (int v = 0; v <= (is_segment ? 0 : kParts - u); ++v) {
        const Vec3 p = (1.0 / kParts) * ((kParts - u - v) * triangle[0] + u * triangle[1] + v * triangle[2]);
        most = std::max(most, std::sqrt(closest.find(p).squared_distance));
      }
    }
    const double bound = closest.bound(triangle, 0, 1).most;
    EXPECT_GE(bound, most - 1e-15);
    EXPECT_LE(bound, 1.001 * most + 0.5 * 0.7 / kParts);  // between samples, with the slope 1
    EXPECT_LE(closest.bound(triangle, 2 * bound, 1).most, 2.003 * bound);
    // A limit just above the largest distance allows it. One below names a place that is too far.
    EXPECT_LE(closest.bound(triangle, 1.002 * bound, 1.002 * bound).most, 1.002 * bound);
    const DistanceBound not_near = closest.bound(triangle, 0.99 * most, 0.99 * most);
    EXPECT_EQ(not_near.most, std::numeric_limits<double>::infinity());
    EXPECT_GT(std::sqrt(closest.find(not_near.far).squared_distance), 0.97 * most);
  }
}

TEST(SurfaceDistance, NoPointBetweenSamplesIsFartherThanTheLimitAndTheReport) {
  for (const bool may_slide : {false, true}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      SurfaceMesh mesh = test::mesh_of(shaken_cylinder(16, 4, 0.3, seed));
      const SurfaceMesh input = mesh;
      SurfaceOptions options;
      options.surface_distance = 0.01;
      options.may_slide = may_slide;
      const SurfaceReport report = optimized(mesh, options);
      const double most = std::max(sampled_distance(mesh, input, 200, seed), sampled_distance(input, mesh, 200, seed));
      EXPECT_GT(most, 0.5 * 0.01 * report.diagonal);
      EXPECT_LE((1 - 1e-14) * most, report.surface_distance);
      EXPECT_LE(report.surface_distance, 0.01 * report.diagonal);
      EXPECT_LE(report.surface_distance, 1.1 * most);
    }
  }
}

TEST(SurfaceDistance, LinesAreNearThoseOfTheInputWhereTheirTrianglesAreNearTheSurface) {
  // A line in the plane turns by 36 degrees at each of five vertices. One of them slides to the next: its chord leaves
  // the line by the height of a corner, and no point of the surface moves.
  test::SurfaceArrays arrays = shaken_grid(8, 0, 1);
  const auto number = [](int i, int j) { return i * 9 + j; };
  for (int i = 1; i < 7; ++i) {
    arrays.constrained.push_back({number(i, 4), number(i + 1, 4)});
    if (i % 2 == 0) arrays.points[static_cast<std::size_t>(number(i, 4))].y += 0.3;
  }
  SurfaceMesh mesh = test::mesh_of(arrays);
  const Lines lines(mesh, {}, true);
  const VertexId moved(static_cast<std::size_t>(number(3, 4)));
  EXPECT_EQ(lines.too_far(mesh, lines.tracks(), 1e-12), std::vector<VertexId>());
  mesh.set_position(moved,
                    mesh.position(moved) + 0.5 * (mesh.position(VertexId(moved.index + 9)) - mesh.position(moved)));
  const Nearness nearness(test::mesh_of(arrays), 1e-12);
  Nearness::Known known;
  EXPECT_TRUE(nearness.too_far(mesh, known).empty());
  // From (2, 4.3) to (3.5, 4.15) the line has its corner at (3, 4).
  const double height = (0.3 - 0.1) * std::cos(std::atan(0.1));
  EXPECT_TRUE(lines.too_far(mesh, lines.tracks(), 1.01 * height).empty());
  const std::vector<VertexId> far = lines.too_far(mesh, lines.tracks(), 0.99 * height);
  EXPECT_TRUE(std::find(far.begin(), far.end(), moved) != far.end());
  EXPECT_TRUE(lines.too_far(mesh, IdVector<VertexId, Track>(mesh.n_vertices(), kHeld), 1).empty());
}

TEST(SurfaceDistance, WhatIsKnownOfAMeshIsWhatAFirstLookFinds) {
  const SurfaceMesh input = shaken_torus(0.3, 3);
  SurfaceMesh mesh = input;
  const Nearness nearness(input, 0.02);
  Nearness::Known known;
  Rng rng(8);
  std::size_t far = 0;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 6; ++k) {
      const VertexId v(rng.below(static_cast<std::uint32_t>(mesh.n_vertices())));
      const auto off = [&] { return k % 2 == 0 ? 0 : rng.uniform(-0.03, 0.03); };
      mesh.set_position(v, input.position(v) + Vec3{off(), off(), off()});
    }
    Nearness::Known none;
    const std::vector<VertexId> found = nearness.too_far(mesh, known), again = nearness.too_far(mesh, none);
    EXPECT_EQ(found, again);
    far += found.size();
  }
  EXPECT_GT(far, 100U);
}

TEST(SurfaceFlips, MakeAPlaneMeshRegularAndKeepACurvedOneWithoutDistance) {
  // A grid has no thin triangles, which keep others from flips.
  SurfaceMesh plane = test::mesh_of(shaken_grid(8, 0.2, 2));
  EXPECT_GT(quality(plane).non_regular_edges, 10U);
  EXPECT_GT(flip_negative_duals(plane, Nearness(plane, 1e-12), {}), 10U);
  EXPECT_LE(quality(plane).non_regular_edges, 1U);  // corners of the grid keep three edges
  EXPECT_EQ(plane.validate(), std::nullopt);

  SurfaceMesh torus = shaken_torus(0.4, 2);
  const SurfaceMesh input = torus;
  EXPECT_EQ(flip_negative_duals(torus, Nearness(input, 0), {}), 0U);
  EXPECT_EQ(torus, input);
  EXPECT_EQ(flip_negative_duals(torus, Nearness(input, 0.1), {0, 0, 0}), 0U);
  EXPECT_GT(flip_negative_duals(torus, Nearness(input, 0.1), {}), 0U);
}

TEST(SurfaceOptimize, AGoodMeshStaysBitForBit) {
  SurfaceMesh mesh = test::mesh_of(test::icosphere(2));
  const SurfaceMesh input = mesh;
  const SurfaceReport report = optimized(mesh);
  EXPECT_EQ(mesh, input);
  EXPECT_EQ(static_cast<std::size_t>(report.sweeps) + report.flips + report.repairs, 0U);
  EXPECT_LT(report.surface_distance, 1e-15);
}

TEST(SurfaceOptimize, ToriBecomeWellCenteredNearTheInput) {
  for (const std::uint64_t seed : {1, 2}) {
    SurfaceMesh mesh = shaken_torus(0.3, seed);
    const SurfaceMesh input = mesh;
    SurfaceOptions options;
    options.surface_distance = 0.02;
    const SurfaceReport report = optimized(mesh, options);
    EXPECT_GT(report.violations_before, 100U);
    EXPECT_EQ(report.violations_after, 0U);
    EXPECT_EQ(quality(mesh).well_centered_fraction, 1);
    // The distance of the report, by all triangles.
    EXPECT_LE(report.surface_distance, 0.02 * report.diagonal);
    double most = 0;
    const auto compare = [&](const SurfaceMesh& from, const SurfaceMesh& to) {
      for (const TriangleId t : from.triangles()) {
        const auto [a, b, c] = from.points(t);
        const Vec3 center = (1.0 / 3) * (a.position() + b.position() + c.position());
        for (const Vec3 p : {a.position(), center, 0.5 * (a.position() + b.position()),
                             0.5 * (b.position() + c.position()), 0.5 * (c.position() + a.position())})
          most = std::max(most, brute_force_distance(to, p));
      }
    };
    compare(mesh, input), compare(input, mesh);
    EXPECT_GE(report.surface_distance, (1 - 1e-14) * most);
    EXPECT_GT(most, 0);
    // Closed, and of the same genus.
    EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles(), mesh.connectivity().n_edges());
  }
}

/// The surface of a box of cubes, n along each axis. Points inside of its faces are shaken, and points inside of its
/// edges along them.
test::SurfaceArrays shaken_box(std::array<int, 3> n, double shake, std::uint64_t seed, double along = 0) {
  Rng rng(seed);
  test::SurfaceArrays arrays;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  const auto point = [&](std::array<int, 3> at) {
    const auto [found, is_new] = numbers.try_emplace(at, static_cast<std::int32_t>(arrays.points.size()));
    if (is_new) {
      std::array<double, 3> x;
      const auto is_outer = [&](std::size_t k) { return at[k] == 0 || at[k] == n[k]; };
      const double most = is_outer(0) + is_outer(1) + is_outer(2) == 1 ? shake : along;
      for (std::size_t k = 0; k < 3; ++k) x[k] = at[k] + (is_outer(k) || most == 0 ? 0 : rng.uniform(-most, most));
      arrays.points.push_back({x[0], x[1], x[2]});
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n[axis]}) {
      for (int i = 0; i < n[(axis + 1) % 3]; ++i) {
        for (int j = 0; j < n[(axis + 2) % 3]; ++j) {
          const auto corner = [&](int u, int v) {
            std::array<int, 3> at = {};
            at[axis] = side, at[(axis + 1) % 3] = i + u, at[(axis + 2) % 3] = j + v;
            return point(at);
          };
          const std::int32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          arrays.triangles.insert(arrays.triangles.end(), {{a, b, c}, {a, c, d}});
        }
      }
    }
  }
  return arrays;
}

TEST(SurfaceOptimize, AnotherUnitOfLengthChangesNothingElse) {
  test::SurfaceArrays box = shaken_box({3, 3, 3}, 0.3, 3);
  for (const double unit : {8.0, 0x1p-140, 0x1p140}) {
    test::SurfaceArrays scaled = box;
    for (Vec3& p : scaled.points) p = unit * p;
    SurfaceMesh one = test::mesh_of(box), other = test::mesh_of(scaled);
    std::size_t shown = 0;
    SurfaceOptions options;
    options.surface_distance = 0.02;
    const SurfaceReport a = optimized(one, options);
    options.best_so_far = [&](const auto& get) {
      get([&](const BestSoFar& best) {
        for (const VertexId v : best.mesh.vertices()) shown += length((1 / unit) * best.mesh.position(v)) < 6 ? 1 : 0;
      });
    };
    const SurfaceReport b = optimized(other, options);
    EXPECT_GT(shown, box.points.size());
    EXPECT_EQ(a.crease_edges, 36U);
    EXPECT_LT(a.violations_after, a.violations_before);
    EXPECT_EQ(unit * a.surface_distance, b.surface_distance);
    EXPECT_EQ(a.turns_after.largest_deg, b.turns_after.largest_deg);
    EXPECT_EQ(a.history.size(), b.history.size());
    EXPECT_EQ(a.violations_after, b.violations_after);
    ASSERT_EQ(one.n_vertices(), other.n_vertices());
    for (const VertexId v : one.vertices()) {
      ASSERT_EQ(unit * one.position(v), other.position(v));
      ASSERT_EQ(unit * unit * one.weight(v), other.weight(v));
    }
  }
}

TEST(SurfaceOptimize, TheLimitOfDistanceHoldsForNumbersThatFilesRefuse) {
  constexpr double kUnit = 1e-59, kLeast = 1e-60;
  const auto allowed = [](double x) { return std::abs(kUnit * x) < kLeast ? 0 : kUnit * x; };
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SurfaceMesh mesh = shaken_torus(0.3, seed);
    for (const VertexId v : mesh.vertices()) {
      const Vec3 p = mesh.position(v);
      mesh.set_position(v, {allowed(p.x), allowed(p.y), allowed(p.z)});
    }
    const SurfaceMesh input = mesh;
    SurfaceOptions options;
    options.surface_distance = 0.02;
    options.observer = [](const Progress& now) { return now.last.sweep < 3 ? Continue::yes : Continue::no; };
    const SurfaceReport report = optimized(mesh, options);
    EXPECT_LT(report.violations_after, report.violations_before);
    const double found = std::max(sampled_distance(mesh, input, 50, 1), sampled_distance(input, mesh, 50, 2));
    EXPECT_GT(found, 0);
    EXPECT_LE(found, report.surface_distance);
    EXPECT_LE(report.surface_distance, options.surface_distance * report.diagonal * (1 + 1e-12));
    for (const VertexId v : mesh.vertices()) {
      const Vec3 p = mesh.position(v);
      for (const double x : {p.x, p.y, p.z}) EXPECT_TRUE(x == 0 || std::abs(x) >= kLeast);
    }
  }
}

TEST(SurfaceOptimize, WithoutDistanceVerticesMoveInPlanesAlone) {
  for (const bool is_curved : {false, true}) {
    SurfaceMesh mesh = is_curved ? rough_grid(6, 0.2, 1) : test::mesh_of(shaken_box({5, 5, 5}, 0.25, 3));
    const SurfaceMesh input = mesh;
    SurfaceOptions options;
    options.surface_distance = 0;
    const SurfaceReport report = optimized(mesh, options);
    EXPECT_LE(report.surface_distance, 1e-12 * report.diagonal);
    EXPECT_LE(sampled_distance(mesh, input, 10, 1), 1e-12 * report.diagonal);
    EXPECT_EQ(report.flips > 0, !is_curved);
    EXPECT_LT(report.violations_after, report.violations_before);
  }
}

/// The turns at all edges that have two triangles.
std::vector<double> all_turns(const SurfaceMesh& mesh) {
  std::vector<double> turns;
  const Mesh& connectivity = mesh.connectivity();
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!connectivity.is_edge_representative(h) || connectivity.is_boundary(h)) continue;
    const Vec3 n = normal_at(mesh, Mesh::triangle(h)), m = normal_at(mesh, Mesh::triangle(connectivity.twin(h)));
    turns.push_back(std::acos(dot(n, m) / (length(n) * length(m))) * 180 / std::numbers::pi);
  }
  return turns;
}

TEST(SurfaceOptimize, NoEdgeTurnsMoreThanTheSharpestOfTheInputAndFewAreSharp) {
  constexpr double kSharp = 40;
  SurfaceOptions options;
  options.crease_angle_deg = kSharp;
  options.surface_distance = 0.03;
  std::size_t sharp_before = 0, sharp_after = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    SurfaceMesh mesh = rough_grid(10, 0.2, seed);
    const std::vector<double> before = all_turns(mesh);
    const SurfaceReport report = optimized(mesh, options);
    EXPECT_EQ(report.violations_after, 0U) << seed;
    const std::vector<double> after = all_turns(mesh);
    const auto largest = [](const std::vector<double>& turns) { return *std::max_element(turns.begin(), turns.end()); };
    const auto sharp = [](double turn) { return turn > kSharp; };
    EXPECT_NEAR(report.turns_before.largest_deg, largest(before), 1e-6);
    EXPECT_NEAR(report.turns_after.largest_deg, largest(after), 1e-6);
    EXPECT_EQ(report.turns_before.sharp, std::count_if(before.begin(), before.end(), sharp));
    EXPECT_EQ(report.turns_after.sharp, std::count_if(after.begin(), after.end(), sharp));
    EXPECT_LE(report.turns_after.largest_deg, std::max(kSharp, report.turns_before.largest_deg)) << seed;
    sharp_before += report.turns_before.sharp, sharp_after += report.turns_after.sharp;
  }
  EXPECT_LE(sharp_after, sharp_before) << sharp_before << " then " << sharp_after;
}

TEST(SurfaceOptimize, FewEdgesAreSharpWhereARunWithoutALimitMakesMany) {
  // With the limit there are 5, without it 43.
  std::size_t sharp = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SurfaceMesh mesh = shaken_torus(0.3, seed);
    SurfaceOptions options;
    options.crease_angle_deg = 40;
    options.surface_distance = 0.05;
    const SurfaceReport report = optimized(mesh, options);
    EXPECT_EQ(report.violations_after, 0U);
    sharp += report.turns_after.sharp;
  }
  EXPECT_LE(sharp, 15U);
}

TEST(SurfaceOptimize, BoundaryFixedVerticesAndConstrainedEdgesStayInThePlane) {
  const Mesh plane = *random_mesh({.vertices = 150, .seed = 8});
  test::SurfaceArrays arrays = test::lifted(plane);
  const auto corners = plane.corners(TriangleId(40));
  arrays.constrained = {{static_cast<std::int32_t>(corners[0].index), static_cast<std::int32_t>(corners[1].index)}};
  SurfaceInput in = arrays.input();
  std::vector<std::int32_t> fixed;
  for (const VertexId v : plane.vertices()) {
    if (!plane.is_boundary(v) && fixed.size() < 10) fixed.push_back(static_cast<std::int32_t>(v.index));
  }
  in.fixed_vertices = fixed;
  SurfaceMesh mesh = SurfaceMesh::build(in)->mesh;
  const SurfaceMesh input = mesh;
  const SurfaceReport report = optimized(mesh);
  EXPECT_LT(report.violations_after, report.violations_before / 2);
  EXPECT_LT(report.surface_distance, 1e-12);
  const auto new_number = [&](VertexId v) {
    if (report.vertices.empty()) return v;
    const auto at = std::find(report.vertices.begin(), report.vertices.end(), v);
    return VertexId(static_cast<std::size_t>(at - report.vertices.begin()));
  };
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.position(v).z, 0);
  std::size_t boundary = 0;
  for (const VertexId v : input.vertices()) {
    const bool stays = input.connectivity().is_boundary(v) || input.connectivity().is_fixed(v);
    if (!stays) continue;
    ++boundary;
    ASSERT_LT(new_number(v).index, mesh.n_vertices());
    EXPECT_EQ(mesh.position(new_number(v)), input.position(v));
    EXPECT_EQ(mesh.connectivity().is_fixed(new_number(v)), input.connectivity().is_fixed(v));
  }
  EXPECT_GT(boundary, 10U);
  const Mesh& after = mesh.connectivity();
  const VertexId a = new_number(corners[0]), b = new_number(corners[1]);
  const HalfedgeId h = after.find_halfedge(a, b), g = after.find_halfedge(b, a);
  ASSERT_TRUE(h.valid() || g.valid());
  EXPECT_TRUE(after.is_constrained(h.valid() ? h : g));
  std::size_t constrained = 0;
  for (const HalfedgeId e : mesh.halfedges()) constrained += after.is_constrained(e) ? 1 : 0;
  EXPECT_EQ(constrained, 2U);
}

TEST(SurfacePatch, EditsKeepTheSurfaceAndItsFlags) {
  test::SurfaceArrays arrays = test::icosphere(2);
  const std::array<std::int32_t, 2> crease = {arrays.triangles[100][0], arrays.triangles[100][1]};
  arrays.constrained = {{arrays.triangles[0][0], arrays.triangles[0][1]}, crease};
  SurfaceInput in = arrays.input();
  const std::vector<std::int32_t> fixed = {arrays.triangles[8][0], arrays.triangles[9][1]};
  in.fixed_vertices = fixed;
  const auto id = [](std::int32_t v) { return VertexId(static_cast<std::size_t>(v)); };
  State state{SurfaceMesh::build(in)->mesh, nullptr, {}, {}, {ascending(id(crease[0]), id(crease[1]))}, 0};
  for (const VertexId v : state.mesh.vertices()) {
    const Mesh& mesh = state.mesh.connectivity();
    bool is_end = false;
    for (const auto& [a, b] : arrays.constrained) is_end = is_end || v == id(a) || v == id(b);
    state.tracks.push_back(is_end || mesh.is_fixed(v) ? kHeld : kFree);
    state.origins.push_back(v);
  }
  const Nearness nearness(state.mesh, 1);
  const SurfaceOptions options;
  const auto solver = clp_solver();
  SurfaceReport report;
  const surfaces::Run run{options, nearness, *solver, report};
  std::map<Edit::Kind, int> made;
  std::size_t made_cuts = 0;
  for (const TriangleId t : {TriangleId(0), TriangleId(8), TriangleId(100)}) {
    const Patch patch(state, t, 2);
    for (const Edit& edit : patch.edits()) {
      Patch trial = patch;
      if (!trial.make(edit, nearness)) continue;
      ++made[edit.kind];
      trial.descend(run);
      const std::optional<State> next = trial.applied();
      ASSERT_TRUE(next);
      EXPECT_EQ(next->mesh.validate(), std::nullopt);
      const Mesh& mesh = next->mesh.connectivity();
      EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles(), mesh.n_edges() + 2);
      const int change = edit.kind == Edit::Kind::split ? 1 : edit.kind == Edit::Kind::collapse ? -1 : 0;
      EXPECT_EQ(static_cast<int>(mesh.n_vertices()), static_cast<int>(state.mesh.n_vertices()) + change);
      std::size_t n_fixed = 0, n_held = 0, n_constrained = 0;
      for (const VertexId v : mesh.vertices()) {
        const VertexId old = next->origins[v];
        n_fixed += mesh.is_fixed(v) ? 1 : 0;
        if (next->tracks[v] != kHeld) continue;
        ++n_held;
        const Vec3 p = next->mesh.position(v), a = state.mesh.position(id(crease[0]));
        const Vec3 along = state.mesh.position(id(crease[1])) - a;
        EXPECT_TRUE(old.valid() ? p == state.mesh.position(old) : length(cross(p - a, along)) < 1e-15);
      }
      for (const HalfedgeId h : mesh.halfedges()) n_constrained += mesh.is_constrained(h) ? 1 : 0;
      // The crease may have been split: a vertex that is held, and one edge more.
      const std::size_t cuts = next->creases.size() - 1;
      made_cuts += cuts;
      for (const auto& [a, b] : next->creases) EXPECT_TRUE(mesh.is_constrained(mesh.find_halfedge(a, b)));
      EXPECT_EQ(n_fixed, 2U);
      EXPECT_EQ(n_held, 6U + cuts);
      EXPECT_EQ(n_constrained, 4U + 2 * cuts);
    }
  }
  EXPECT_EQ(made_cuts, 1U);
  EXPECT_EQ(made[Edit::Kind::none], 3);
  for (const Edit::Kind kind : {Edit::Kind::flip, Edit::Kind::split, Edit::Kind::collapse}) EXPECT_GT(made[kind], 5);
}

TEST(SurfaceOptimize, CreasesStay) {
  SurfaceMesh mesh = test::mesh_of(shaken_box({5, 5, 5}, 0.25, 3));
  const SurfaceMesh input = mesh;
  const SurfaceReport report = optimized(mesh);
  EXPECT_EQ(report.crease_edges, 60U);
  EXPECT_LT(report.violations_after, report.violations_before / 3);
  EXPECT_LT(report.surface_distance, 1e-12);
  std::size_t creases = 0;
  for (const HalfedgeId h : mesh.halfedges()) EXPECT_FALSE(mesh.connectivity().is_constrained(h));
  for (const VertexId v : mesh.vertices()) {
    const VertexId old = report.vertices.empty() ? v : report.vertices[v];
    const auto is_outer = [](double x) { return std::abs(x) < 1e-9 || std::abs(x - 5) < 1e-9; };
    const Vec3 p = mesh.position(v);
    EXPECT_TRUE(is_outer(p.x) || is_outer(p.y) || is_outer(p.z));
    if (!old.valid()) continue;
    const Vec3 q = input.position(old);
    if (is_outer(q.x) + is_outer(q.y) + is_outer(q.z) < 2) continue;
    EXPECT_EQ(p, q);
    ++creases;
  }
  EXPECT_EQ(creases, 56U);  // 8 corners and 4 points on each of 12 edges
}

/// The number of vertices of the input on edges of its boundary, of creases and constrained ones that have moved.
std::size_t n_moved(const SurfaceMesh& input, const SurfaceMesh& mesh, const SurfaceReport& report,
                    const std::function<bool(Vec3)>& is_on_line) {
  std::size_t moved = 0;
  for (const VertexId v : mesh.vertices()) {
    const VertexId old = report.vertices.empty() ? v : report.vertices[v];
    moved += old.valid() && is_on_line(input.position(old)) && mesh.position(v) != input.position(old) ? 1 : 0;
  }
  return moved;
}

TEST(SurfaceSlide, VerticesOfCreasesStayOnTheEdgesOfABox) {
  constexpr int kLong = 12;  // of a bar: all points are on its edges
  const SurfaceMesh input = test::mesh_of(shaken_box({kLong, 1, 1}, 0, 4, 0.45));
  const auto is_end = [](Vec3 p) { return p.x == 0 || p.x == kLong; };
  std::size_t left[2] = {};
  for (const bool may_slide : {false, true}) {
    SurfaceMesh mesh = input;
    SurfaceOptions options;
    options.may_slide = may_slide;
    options.may_flip = options.may_insert = false;
    const SurfaceReport report = optimized(mesh, options);
    EXPECT_EQ(report.crease_edges, 4U * (kLong + 2));
    left[may_slide ? 1 : 0] = report.violations_after;
    EXPECT_EQ(n_moved(input, mesh, report, [&](Vec3 p) { return !is_end(p); }) > kLong, may_slide);
    for (const VertexId v : mesh.vertices()) {
      const Vec3 p = mesh.position(v), q = input.position(v);
      EXPECT_TRUE(p.y == q.y && p.z == q.z && (p == q || (may_slide && !is_end(q)))) << v.index;
    }
  }
  EXPECT_EQ(left[1], 0U);
  EXPECT_GT(left[0], 0U);
}

TEST(SurfaceSlide, VerticesOfTheBoundaryStayOnItsCurveInTheirOrder) {
  constexpr int kAround = 24, kUp = 6;
  const SurfaceMesh input = test::mesh_of(shaken_cylinder(kAround, kUp, 0.3, 2));
  SurfaceMesh mesh = input;
  SurfaceOptions options;
  options.may_slide = true;
  options.surface_distance = 0.01;
  const SurfaceReport report = optimized(mesh, options);
  EXPECT_EQ(report.violations_after, 0U);
  EXPECT_LE(report.surface_distance, 0.01 * report.diagonal);
  ASSERT_TRUE(report.vertices.empty() || report.repairs > 0);
  const auto is_end = [](Vec3 p) { return p.z == 0 || p.z > 6.2 / kAround * kUp; };
  EXPECT_GT(n_moved(input, mesh, report, is_end), 20U);
  for (const VertexId v : mesh.vertices()) {
    const VertexId old = report.vertices.empty() ? v : report.vertices[v];
    if (!mesh.connectivity().is_boundary(v)) continue;
    ASSERT_TRUE(old.valid());
    const Vec3 p = mesh.position(v);
    // On an edge of the input: its z, and the distance from the nearest chord.
    EXPECT_EQ(p.z, input.position(old).z);
    double least = 1;
    for (const HalfedgeId h : input.halfedges()) {
      if (!input.connectivity().is_boundary(h)) continue;
      const Vec3 a = input.position(input.connectivity().origin(h)), b = input.position(input.connectivity().target(h));
      const double part = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
      least = std::min(least, length(p - (a + part * (b - a))));
    }
    EXPECT_LT(least, 1e-15);
  }
  // The boundary still goes around once at each end.
  double around = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.connectivity().is_boundary(h)) continue;
    const Vec3 a = mesh.position(mesh.connectivity().origin(h)), b = mesh.position(mesh.connectivity().target(h));
    const double turn = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    EXPECT_EQ(turn > 0, a.z == 0);
    around += std::abs(turn);
  }
  EXPECT_NEAR(around, 4 * std::numbers::pi, 1e-12);
}

TEST(SurfaceSlide, EndsBendsBranchesAndFixedVerticesOfLinesStay) {
  // A grid in the plane with a constrained line of five edges, a bend in it, and a branch.
  test::SurfaceArrays arrays = shaken_grid(8, 0, 1);
  const auto number = [](int i, int j) { return i * 9 + j; };
  for (int i = 1; i < 6; ++i) arrays.constrained.push_back({number(i, 4), number(i + 1, 4)});
  arrays.constrained.push_back({number(6, 4), number(6, 5)});
  arrays.constrained.push_back({number(3, 4), number(3, 5)});
  SurfaceInput in = arrays.input();
  const std::vector<std::int32_t> fixed = {number(5, 4), number(8, 2)};
  in.fixed_vertices = fixed;
  const SurfaceMesh mesh = SurfaceMesh::build(in)->mesh;
  const Lines lines(mesh, {}, true), none(mesh, {}, false);
  const auto track = [&](int i, int j) { return lines.tracks()[VertexId(static_cast<std::size_t>(number(i, j)))]; };
  for (const auto& [i, j] :
       std::vector<std::array<int, 2>>{{1, 4}, {3, 4}, {5, 4}, {6, 4}, {6, 5}, {3, 5}, {8, 2}, {0, 0}})
    EXPECT_EQ(track(i, j), kHeld) << i << ' ' << j;
  EXPECT_EQ(track(2, 2), kFree);
  EXPECT_GE(track(2, 4), 0);
  EXPECT_GE(track(4, 4), 0);
  EXPECT_NE(track(2, 4), track(4, 4));
  EXPECT_EQ(track(8, 3), track(8, 7));
  EXPECT_NE(track(8, 3), track(8, 1));
  EXPECT_EQ(lines.closest(track(2, 4), {2.5, 3, 1}), (Vec3{2.5, 4, 0}));
  EXPECT_EQ(lines.closest(track(2, 4), {5, 3, 1}), (Vec3{3, 4, 0}));
  EXPECT_NEAR(std::abs(lines.direction(track(2, 4), {2.2, 4, 0}).x), 1, 1e-15);
  for (const VertexId v : mesh.vertices()) EXPECT_LT(none.tracks()[v], 0);
  EXPECT_EQ(none.tracks()[VertexId(static_cast<std::size_t>(number(8, 3)))], kHeld);
}

TEST(SurfaceSlide, VerticesBetweenLinesOfTwoKindsStay) {
  test::SurfaceArrays arrays = shaken_grid(4, 0, 1);
  arrays.constrained = {{11, 12}, {12, 13}, {6, 7}, {7, 8}};
  const SurfaceMesh mesh = test::mesh_of(arrays);
  const Lines lines(mesh, {{VertexId(12), VertexId(13)}}, true);
  EXPECT_EQ(lines.tracks()[VertexId(12)], kHeld);
  EXPECT_GE(lines.tracks()[VertexId(7)], 0);
}

TEST(SurfaceSlide, EditsRemoveNoVertexOfALineAndNewOnesStayOnIt) {
  // A grid with a crease along its middle.
  test::SurfaceArrays arrays = shaken_grid(8, 0.2, 5);
  State state;
  const auto id = [](int v) { return VertexId(static_cast<std::size_t>(v)); };
  for (int i = 0; i <= 8; ++i) {
    arrays.points[static_cast<std::size_t>(i * 9 + 4)].y = 4;
    if (i == 8) break;
    arrays.constrained.push_back({i * 9 + 4, i * 9 + 13});
    state.creases.push_back({id(i * 9 + 4), id(i * 9 + 13)});
  }
  state.mesh = test::mesh_of(arrays);
  const Lines lines(state.mesh, state.creases, true);
  state.lines = &lines;
  state.tracks = lines.tracks();
  for (const VertexId v : state.mesh.vertices()) state.origins.push_back(v);
  const auto n_on_lines = [](const State& s) {
    return std::count_if(s.tracks.begin(), s.tracks.end(), [](Track track) { return track >= 0; });
  };
  const Nearness nearness(state.mesh, 1);
  const SurfaceOptions options;
  const auto solver = clp_solver();
  SurfaceReport report;
  const surfaces::Run run{options, nearness, *solver, report};
  int splits = 0;
  for (const TriangleId t : {TriangleId(56), TriangleId(57), TriangleId(70)}) {
    const Patch patch(state, t, 2);
    for (const Edit& edit : patch.edits()) {
      Patch trial = patch;
      if (!trial.make(edit, nearness)) continue;
      trial.descend(run);
      const std::optional<State> next = trial.applied();
      ASSERT_TRUE(next);
      const auto cuts = next->creases.size() - state.creases.size();
      splits += static_cast<int>(cuts);
      EXPECT_EQ(n_on_lines(*next), n_on_lines(state) + static_cast<std::ptrdiff_t>(cuts));
      for (const auto& [a, b] : next->creases)
        EXPECT_TRUE(next->mesh.position(a).y == 4 && next->mesh.position(b).y == 4);
    }
  }
  EXPECT_GT(splits, 0);
}

TEST(SurfaceOptimize, VerticesMoveWhereWeightsAloneSuffice) {
  int cured = 0;
  for (const std::uint64_t seed : {1, 2}) {
    // A good mesh that has lost its weights.
    SurfaceMesh mesh = shaken_torus(0.3, seed);
    SurfaceOptions options;
    options.surface_distance = 0.02;
    static_cast<void>(optimized(mesh, options));
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0);
    SurfaceMesh weighted = mesh;
    const SurfaceReport report = optimized(mesh, options);
    options.may_move = false;
    const SurfaceReport alone = optimized(weighted, options);
    EXPECT_EQ(report.violations_after, 0U);
    if (alone.violations_before == 0 || alone.violations_after > 0) continue;
    ++cured;
    EXPECT_GT(report.sweeps, 0);
    EXPECT_NE(mesh, weighted);
    EXPECT_GT(report.after.min_h_over_l, 0.02);
  }
  EXPECT_GE(cured, 1);
}

TEST(SurfaceOptimize, SmallerErrorsDecide) {
  int cured = 0;
  double most = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SurfaceMesh mesh = good_torus(seed);
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0);
    const SurfaceMesh input = mesh;
    SurfaceOptions options;
    options.surface_distance = 0.02;
    options.may_move = false;
    SurfaceMesh alone = input;
    if (optimized(alone, options).violations_after > 0) continue;
    ++cured;
    options.may_move = true;
    // Errors by moves, as if the input were best; and their opposite.
    const auto moves = [&input](const SurfaceMesh& now) {
      double sum = 0;
      for (const VertexId v : now.vertices()) sum += squared_length(now.position(v) - input.position(v));
      return sum;
    };
    options.squared_errors = [&](const SurfaceMesh& now, Scheme) { return std::vector{1 + moves(now)}; };
    SurfaceMesh kept = input, moved = input;
    EXPECT_EQ(optimized(kept, options).violations_after, 0U);
    EXPECT_EQ(moves(kept), 0);
    options.squared_errors = [&](const SurfaceMesh& now, Scheme) { return std::vector{1 / (1 + moves(now))}; };
    EXPECT_EQ(optimized(moved, options).violations_after, 0U);
    most = std::max(most, moves(moved));
  }
  EXPECT_GT(most, 1e-3);
  EXPECT_GE(cured, 2);
}

TEST(SurfaceSlide, IsNotWorseThanVerticesThatStay) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const SurfaceMesh input = test::mesh_of(shaken_cylinder(14, 4, 0.25, seed));
    SurfaceOptions options;
    options.surface_distance = 0.01;
    SurfaceMesh kept = input, slid = input;
    const SurfaceReport keep = optimized(kept, options);
    options.may_slide = true;
    const SurfaceReport slide = optimized(slid, options);
    EXPECT_LE(slide.violations_after, keep.violations_after);
    if (slide.violations_after < keep.violations_after) continue;
    EXPECT_LE(slide.objective_after, keep.objective_after);
  }
}

TEST(SurfaceOptimize, AThinTriangleThatIsFoldedOverIsNoCrease) {
  test::SurfaceArrays arrays = shaken_grid(8, 0.1, 6);
  constexpr std::int32_t kMoved = 4 * 9 + 4;
  for (const auto& t : arrays.triangles) {
    const auto at = std::find(t.begin(), t.end(), kMoved);
    if (at == t.end()) continue;
    const auto point = [&](std::ptrdiff_t k) {
      return arrays.points[static_cast<std::size_t>(t[(at - t.begin() + k) % 3])];
    };
    // A little beyond the opposite edge.
    arrays.points[kMoved] = 0.5 * (point(1) + point(2)) + 0.05 * (0.5 * (point(1) + point(2)) - point(0));
    break;
  }
  SurfaceMesh mesh = test::mesh_of(arrays);
  const SurfaceReport report = optimized(mesh);
  EXPECT_EQ(report.crease_edges, 0U);
  EXPECT_EQ(report.violations_after, 0U);
}

TEST(SurfaceOptimize, ATriangleWhoseAreaIsRoundingCostsNoTime) {
  // Its height is 1e-17. Exact numbers as sums of doubles grew there until one dual took a second.
  test::SurfaceArrays arrays;
  for (const double y : {0.0, 1.0, 2.0}) {
    for (const double x : {0.0, 1.0, 2.0}) arrays.points.push_back({x, y, x + y == 4 ? 0.4 : 0});
  }
  arrays.points[1].y = 0.08;
  arrays.points.push_back({0.3, 0.024, 0});
  arrays.triangles = {{0, 1, 9}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7},
                      {3, 7, 6}, {4, 5, 8}, {4, 8, 7}, {1, 4, 9}, {4, 0, 9}};
  SurfaceMesh mesh = test::mesh_of(arrays);
  EXPECT_LT(optimized(mesh).seconds, 10);
  for (const VertexId v : mesh.vertices()) EXPECT_TRUE(std::isfinite(mesh.weight(v)));
}

/// A box with a vertex close to an inner edge of a face. The height over the edge is a part of the triangle's. If that
/// is 0, the height is so small that the normal is 0 in doubles.
test::SurfaceArrays with_sliver(test::SurfaceArrays box, std::uint64_t seed, double height = 0) {
  Rng rng(seed);
  const auto in_plane = [](Vec3 p) { return Vec2{p.x, p.y}; };
  while (true) {
    const std::size_t t = rng.below(static_cast<std::uint32_t>(box.triangles.size()));
    const auto [a, b, c] = box.triangles[t];
    const auto point = [&](std::int32_t v) { return box.points[static_cast<std::size_t>(v)]; };
    const Vec3 p = point(a), q = point(b), r = point(c), m = p + rng.uniform(0.2, 0.8) * (q - p) + height * (r - p);
    const bool is_inside = p.z == q.z && p.z == r.z && (p.x != std::round(p.x) || q.x != std::round(q.x));
    const Sign side = orient2d(in_plane(p), in_plane(q), in_plane(m));
    if (!is_inside || side != orient2d(in_plane(p), in_plane(q), in_plane(r)) ||
        (height == 0 && normal_of(p, q, m) != Vec3{}))
      continue;
    const auto added = static_cast<std::int32_t>(box.points.size());
    box.points.push_back(m);
    box.triangles[t] = {a, added, c};
    box.triangles.insert(box.triangles.end(), {{added, b, c}, {a, b, added}});
    return box;
  }
}

TEST(SurfaceDraft, ASliverBlocksItsOwnVerticesAlone) {
  const auto gain = [](const test::SurfaceArrays& box) {
    const SurfaceMesh mesh = test::mesh_of(box);
    Draft draft = draft_of_all(mesh);
    DraftEnergy energy(draft, 0.1);
    const double before = energy.value().lowered;
    energy.lower(30, [] { return false; });
    EXPECT_TRUE(energy.is_inside());
    for (const WeightedPoint& p : draft.points) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z + p.w));
    return before - energy.value().lowered;
  };
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const test::SurfaceArrays box = shaken_box({6, 6, 6}, 0.3, seed);
    const double usual = gain(box);
    EXPECT_GT(usual, 0);
    for (const double height : {0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7})
      EXPECT_GT(gain(with_sliver(box, seed, height)), 0.8 * usual) << seed << ", " << height;
  }
}

TEST(SurfaceOptimize, TargetsOfDualsHaveTheCoefficientsOfWellCenteredMeshes) {
  for (const Criterion criterion : {Criterion::coefficients, Criterion::distances}) {
    SurfaceMesh all = shaken_torus(0.3, 1), one = all;
    SurfaceOptions options;
    options.surface_distance = 0.02;
    const SurfaceReport good = optimized(all, options);
    options.criterion = criterion;
    const SurfaceReport report = optimized(one, options);
    EXPECT_EQ(one, all);
    EXPECT_GT(report.violations_before, 0U);
    EXPECT_NE(report.violations_before, good.violations_before);
    EXPECT_EQ(report.violations_after, 0U);
  }
}

TEST(SurfaceOptimize, AStopKeepsWhatTheWellCenteredRunHasReached) {
  const SurfaceMesh input = shaken_torus(0.35, 4);
  const auto negative = [](const SurfaceMesh& mesh) { return violated_edges(mesh, Criterion::coefficients).size(); };
  bool has_reached_some = false;
  for (const int last : {20, 100, 300, 1000}) {
    int asked = 0;
    SurfaceOptions options;
    options.surface_distance = 0.02;
    options.must_stop = [&] { return ++asked > last; };
    SurfaceMesh all = input, one = input;
    static_cast<void>(optimized(all, options));
    options.criterion = Criterion::coefficients;
    asked = 0;
    const SurfaceReport report = optimized(one, options);
    has_reached_some = has_reached_some || (negative(all) < negative(input) && report.stopped == Stopped::canceled);
    EXPECT_LE(negative(one), std::min(negative(all), negative(input)));
    EXPECT_EQ(report.violations_after, negative(one));
  }
  EXPECT_TRUE(has_reached_some);
}

TEST(SurfaceOptimize, AStopInTheFirstRoundKeepsWhatIsBetter) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const SurfaceMesh input = shaken_torus(0.35, seed);
    SurfaceMesh one = input, weighted = input, stopped = input;
    int asked = 0, at_first_round = 0;
    SurfaceOptions options;
    options.surface_distance = 0.02;
    options.must_stop = [&] { return ++asked, false; };
    options.observer = [&](const Progress& now) {
      if (now.last.sweep == 1) at_first_round = asked;
      return now.last.sweep == 1 ? Continue::no : Continue::yes;
    };
    static_cast<void>(optimized(one, options));
    ASSERT_GT(at_first_round, 3);
    options.observer = {};
    int left = at_first_round - 3;
    options.must_stop = [&] { return --left < 0; };
    const SurfaceReport report = optimized(stopped, options);
    EXPECT_EQ(report.stopped, Stopped::canceled);
    EXPECT_LE(report.surface_distance, options.surface_distance * report.diagonal);
    options.must_stop = {};
    options.may_move = false;
    EXPECT_LT(report.violations_after, optimized(weighted, options).violations_after);
  }
}

TEST(SurfaceOptimize, TargetsOfDualsAreMet) {
  for (const Criterion criterion : {Criterion::coefficients, Criterion::distances}) {
    SurfaceMesh mesh = shaken_torus(0.35, 4);
    SurfaceOptions options;
    options.criterion = criterion;
    options.surface_distance = 0.02;
    const SurfaceReport report = optimized(mesh, options);
    EXPECT_GT(report.violations_before, 0U);
    EXPECT_EQ(report.violations_after, 0U);
    EXPECT_TRUE(meets(mesh, criterion));
  }
}

TEST(SurfaceOptimize, TheHistorySaysWhichObjectiveARoundLowers) {
  SurfaceMesh mesh = shaken_torus(0.3, 1);
  SurfaceOptions options;
  options.surface_distance = 0.02;
  const SurfaceReport report = optimized(mesh, options);
  std::vector<double> accuracy;
  for (const SweepRecord& record : report.history) {
    if (record.objective == Objective::energy) {
      EXPECT_GT(record.length_parameter, 0);
      EXPECT_TRUE(record.bad > 0 || accuracy.empty());
    } else {
      EXPECT_EQ(record.objective, Objective::accuracy);
      EXPECT_EQ(record.bad, 0U);
      accuracy.push_back(record.energy);
    }
  }
  ASSERT_GT(accuracy.size(), 2U);
  EXPECT_LT(accuracy.back(), accuracy.front());
}

TEST(SurfaceOptimize, ListenersGetTheBestMeshSoFar) {
  SurfaceMesh mesh = test::mesh_of(shaken_box({5, 5, 5}, 0.25, 3)), last;
  const SurfaceMesh input = mesh;
  IdVector<VertexId, VertexId> vertices;
  std::size_t least = cells_at_violations(mesh, Criterion::well_centered).size(), calls = 0;
  SurfaceOptions options;
  options.best_so_far = [&](const std::function<void(const std::function<void(const BestSoFar&)>&)>& best) {
    best([&](const BestSoFar& now) {
      const std::size_t bad = cells_at_violations(now.mesh, Criterion::well_centered).size();
      EXPECT_LE(bad, least);
      least = bad, last = now.mesh, vertices = now.vertices, ++calls;
      for (const HalfedgeId h : now.mesh.halfedges()) EXPECT_FALSE(now.mesh.connectivity().is_constrained(h));
    });
  };
  const SurfaceReport report = optimized(mesh, options);
  EXPECT_GT(calls, 3U);
  EXPECT_EQ(least, report.violations_after);
  EXPECT_EQ(last.n_triangles(), mesh.n_triangles());
  EXPECT_EQ(vertices.size(), report.vertices.size());
  SurfaceMesh other = input;
  options.best_so_far = {};
  static_cast<void>(optimized(other, options));
  EXPECT_EQ(other, mesh) << "the listener changes nothing";
}

TEST(SurfaceOptimize, AStopLeavesTheMeshAsItIsAndSaysSo) {
  SurfaceMesh mesh = shaken_torus(0.3, 1);
  const SurfaceMesh input = mesh;
  SurfaceOptions options;
  options.must_stop = [] { return true; };
  EXPECT_EQ(optimized(mesh, options).stopped, Stopped::canceled);
  EXPECT_EQ(mesh, input);
}

TEST(SurfaceOptimize, OptionsOutOfRangeAreErrors) {
  SurfaceMesh mesh = test::mesh_of(test::icosphere(0));
  const auto code = [&](const SurfaceOptions& options) {
    const auto report = optimize(mesh, *clp_solver(), options);
    EXPECT_FALSE(report);
    return report.error().code;
  };
  SurfaceOptions options;
  options.margin = 0.5;
  EXPECT_EQ(code(options), ErrorCode::invalid_option);
  options = {};
  options.surface_distance = -1;
  EXPECT_EQ(code(options), ErrorCode::invalid_option);
  options = {};
  options.crease_angle_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(options), ErrorCode::invalid_option);
}

}  // namespace
}  // namespace temper::surfaces
