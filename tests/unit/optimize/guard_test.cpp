// The guard: no run makes the least angle, the least edge over size, the ratio of areas or the time of a wave worse
// than in the input, or than a bound. All is measured here by other formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/rng.hpp"
#include "temper/detail/location.hpp"
#include "temper/detail/trace.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"

namespace temper::test {
namespace {

struct Shape {
  double angle = 180, areas = 1, edge = 1e9, time = 1e9;
};

double area(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return 0.5 * cross(b.position() - a.position(), c.position() - a.position());
}

/// `depth`: of a point; waves have the speed √(g H), H the mean of the corners, at least 1.
template <class Depth>
Shape shape(const Mesh& mesh, const Depth& depth) {
  Shape s;
  for (const HalfedgeId h : mesh.halfedges()) {
    const TriangleId t = Mesh::triangle(h);
    const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h)),
               c = mesh.position(mesh.opposite(h));
    const double l = length(b - a);
    s.angle =
        std::min(s.angle, std::acos(dot(a - c, b - c) / (length(a - c) * length(b - c))) * 180 / std::numbers::pi);
    const double speed = std::sqrt(9.81 * std::max((depth(a) + depth(b) + depth(c)) / 3, 1.0));
    s.time = std::min(s.time, 2 * area(mesh, t) / l / speed);
    if (mesh.is_boundary(h)) continue;
    const double here = area(mesh, t), there = area(mesh, Mesh::triangle(mesh.twin(h)));
    s.areas = std::max(s.areas, here / there);
    s.edge = std::min(s.edge, l / std::sqrt(4 / std::numbers::sqrt3 * (here + there) / 2));
  }
  return s;
}

constexpr double kRounding = 1e-8;

void expect_guarded(const Shape& before, const Shape& after, const GuardOptions& guard, const std::string& name) {
  EXPECT_GE(after.angle, std::min(before.angle, guard.angle) - kRounding) << name;
  EXPECT_LE(after.areas, std::max(before.areas, guard.areas) + kRounding) << name;
  EXPECT_GE(after.edge, std::min(before.edge, guard.edge) - kRounding) << name;
}

/// A bottom that slopes: linear, so that the field has it exactly.
double depth_of(Vec2 p) { return 12 + 3 * p.x + p.y; }

std::vector<double> depths_of(const Mesh& mesh) {
  std::vector<double> depths;
  for (const VertexId v : mesh.vertices()) depths.push_back(depth_of(mesh.position(v)));
  return depths;
}

TEST(Guard, HoldsForEveryTargetAndItsLimitsBind) {
  std::size_t worse_without = 0, better = 0;
  for (const Mesh& input : {*random_mesh({60, 3, {}}), *annulus({.around = 24, .rings = 3}),
                            *graded_mesh({.finest = 1.0 / 12, .growth = 0.3})}) {
    const Shape before = shape(input, depth_of);
    for (const char* const target : {"any", "vertex", "cell", "mpas", "adcirc", "fem"}) {
      OptimizeOptions options = *options_for(target, "quick");
      options.repair_trials = 100;
      options.guard.angle = 60;
      options.guard.areas = options.guard.edge = 1;
      options.guard.depth = depths_of(input);
      Mesh mesh = input, free = input;
      std::vector<TraceEvent> events;
      const auto report = optimize(mesh, options, {.tracer = [&](const TraceEvent& e) { events.push_back(e); }});
      ASSERT_TRUE(report);
      const bool names_guard = std::ranges::any_of(
          report->notes, [](const std::string& note) { return note.find("guard_areas") != std::string::npos; });
      EXPECT_EQ(names_guard, quality(mesh).well_centered_fraction < 1) << target;
      const Shape after = shape(mesh, depth_of);
      expect_guarded(before, after, options.guard, target);
      EXPECT_GE(after.time, before.time * (1 - kRounding)) << target;
      EXPECT_EQ(*replay(input, events), mesh);
      better += quality(mesh).well_centered_fraction > quality(input).well_centered_fraction ? 1 : 0;
      options.guard = {};
      ASSERT_TRUE(optimize(free, options));
      const Shape unguarded = shape(free, depth_of);
      worse_without += unguarded.angle < before.angle || unguarded.areas > before.areas ? 1 : 0;
    }
  }
  EXPECT_GT(worse_without, 1u);
  EXPECT_GT(better, 8u);
}

/// Land and water at random: times are of the depths that the input has at the new places.
TEST(Guard, HoldsForRandomMeshesAndDepths) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Mesh input =
        seed == 1 ? *random_mesh({1100, seed, {}}) : *annulus({.around = 80, .rings = 12});  // in batches
    Rng rng(seed);
    OptimizeOptions options = *options_for("adcirc", "quick");
    options.repair_trials = 30;
    for (std::size_t i = 0; i < input.n_vertices(); ++i) options.guard.depth.push_back(rng.uniform(-8, 4));
    const PointLocator places(input);
    const auto depth = [&](Vec2 p) {
      return interpolated(places.find(p), [&](VertexId v) { return options.guard.depth[v.index]; });
    };
    const Shape before = shape(input, depth);
    Mesh mesh = input;
    ASSERT_TRUE(optimize(mesh, options));
    const Shape after = shape(mesh, depth);
    expect_guarded(before, after, options.guard, "adcirc");
    EXPECT_GE(after.time, before.time * (1 - kRounding));
    EXPECT_GT(quality(mesh).well_centered_fraction, quality(input).well_centered_fraction);
  }
}

TEST(Guard, DepthsAreOfAllVertices) {
  OptimizeOptions options;
  options.guard = {.angle = 60, .depth = {1, 2}};
  Mesh mesh = *random_mesh({20, 1, {}});
  const auto report = optimize(mesh, options);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("2 depths; expected one for each"), std::string::npos);
}

TEST(Guard, HoldsIfVerticesAreSplitRemovedAndInserted) {
  const Mesh input = *random_mesh({80, 9, {}});
  const Shape before = shape(input, depth_of);
  OptimizeOptions options;
  options.boundary = BoundaryVertices::split;
  options.repair = Repair::vertices;
  options.repair_trials = 200;
  options.guard.angle = 60;
  options.guard.areas = options.guard.edge = 1;
  Mesh mesh = input;
  ASSERT_TRUE(optimize(mesh, options));
  expect_guarded(before, shape(mesh, depth_of), options.guard, "split");
}

TEST(Guard, ABoundIsRefusedOutOfRange) {
  OptimizeOptions options;
  options.guard.areas = -1;
  Mesh mesh = *random_mesh({20, 1, {}});
  const auto report = optimize(mesh, options);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("guard_areas"), std::string::npos);
}

}  // namespace
}  // namespace temper::test
