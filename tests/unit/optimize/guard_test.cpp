// The guard: no run makes an angle, an edge, the ratio of areas, the time of a wave or a measure of the client worse
// than in the input, or than a bound. All is measured here by other formulas.
#include "optimize/flips/guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
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
  double angle = 180, largest = 0, areas = 1, edge = 1e9, shortest = 1e9, time = 1e9;
};

double area_of(const Mesh& mesh, TriangleId t) {
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
    const double angle = std::acos(dot(a - c, b - c) / (length(a - c) * length(b - c))) * 180 / std::numbers::pi;
    s.angle = std::min(s.angle, angle);
    s.largest = std::max(s.largest, angle);
    s.shortest = std::min(s.shortest, l);
    const double speed = std::sqrt(9.81 * std::max((depth(a) + depth(b) + depth(c)) / 3, 1.0));
    s.time = std::min(s.time, 2 * area_of(mesh, t) / l / speed);
    if (mesh.is_boundary(h)) continue;
    const double here = area_of(mesh, t), there = area_of(mesh, Mesh::triangle(mesh.twin(h)));
    s.areas = std::max(s.areas, here / there);
    s.edge = std::min(s.edge, l / std::sqrt(4 / std::numbers::sqrt3 * (here + there) / 2));
  }
  return s;
}

constexpr double kRounding = 1e-8;

void expect_guarded(const Shape& before, const Shape& after, const GuardOptions& guard, const std::string& name) {
  EXPECT_GE(after.angle, std::min(before.angle, guard.angle) - kRounding) << name;
  EXPECT_LE(after.largest, std::max(before.largest, 180 - 2 * guard.angle) + 1e-6) << name;
  EXPECT_LE(after.areas, std::max(before.areas, guard.areas.value_or(1e9)) + kRounding) << name;
  EXPECT_GE(after.shortest, std::min(before.shortest, guard.length.value_or(1e9)) - kRounding) << name;
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

std::size_t n_obtuse(const Mesh& mesh) { return quality(mesh).obtuse_triangles; }

/// The targets of clients, at random meshes, where most triangles may become better.
TEST(Guard, KeepsTheMeasuresOfEachClient) {
  std::size_t better = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Mesh input = seed < 3 ? *random_mesh({90, seed, {}}) : *annulus({.around = 20, .rings = 4});
    const Quality before = quality(input);
    for (const char* const target : {"fem", "adcirc", "dflowfm", "mpas"}) {
      SCOPED_TRACE(testing::Message() << target << " " << seed);
      OptimizeOptions options = *options_for(target, "quick");
      options.repair_trials = 200;
      Mesh mesh = input;
      ASSERT_TRUE(optimize(mesh, options));
      const Quality after = quality(mesh);
      expect_guarded(shape(input, depth_of), shape(mesh, depth_of), options.guard, target);
      EXPECT_LE(n_obtuse(mesh), n_obtuse(input));
      better += n_obtuse(mesh) < n_obtuse(input) ? 1 : 0;
      if (options.guard.client == Client::dflowfm) {
        EXPECT_LE(after.max_orthogonality, before.max_orthogonality + 1e-6);
        EXPECT_LE(after.max_smoothness, before.max_smoothness + kRounding);
        EXPECT_GE(after.min_flow_link, before.min_flow_link - kRounding);
        EXPECT_LE(after.small_flow_links, before.small_flow_links);
      } else if (options.guard.client == Client::mpas) {
        EXPECT_GE(after.min_cell_quality, before.min_cell_quality - kRounding);
        EXPECT_GE(after.min_grid_spacing, before.min_grid_spacing - kRounding);
        EXPECT_LE(after.max_grid_spacing, before.max_grid_spacing + kRounding);
        EXPECT_GE(after.min_triangle_quality, before.min_triangle_quality - kRounding);
        EXPECT_GE(after.min_triangle_angle_quality, before.min_triangle_angle_quality - kRounding);
        EXPECT_LE(after.max_centroid_offset_over_size, before.max_centroid_offset_over_size + kRounding);
      }
    }
  }
  EXPECT_GT(better, 4u);
}

/// The least ratio of two angles of one triangle around a vertex, if it were at this place.
double least_ratio_of_angles(const Mesh& mesh, VertexId v, Vec2 at) {
  double least = 1;
  for (const HalfedgeId h : mesh.star(v)) {
    const Vec2 b = mesh.position(mesh.target(h)), c = mesh.position(mesh.opposite(h));
    const auto angle = [](Vec2 p, Vec2 q, Vec2 r) {
      return std::acos(dot(q - p, r - p) / (length(q - p) * length(r - p)));
    };
    const auto [smallest, largest] = std::minmax({angle(at, b, c), angle(b, c, at), angle(c, at, b)});
    least = std::min(least, smallest / largest);
  }
  return least;
}

TEST(Guard, RefusesAWorseRatioOfAnglesBeyondTheLimitAlone) {
  const Mesh mesh = *random_mesh({200, 5, {}});
  const WorkingUnits units;
  Rng rng(7);
  std::size_t allowed = 0, refused = 0;
  for (const double limit : {0.02, 0.1, 0.3}) {
    const auto limits = std::make_shared<GuardLimits>();
    limits->has_cells = true;
    limits->for_steps.value.fill(-std::numeric_limits<double>::infinity());
    limits->for_steps.value[GuardValues::angles_alike] = limit;
    Guard guard(mesh, units, limits, true);
    for (const VertexId v : mesh.vertices()) {
      const WeightedPoint from = mesh.point(v);
      const auto step = [&] { return 0.04 * (static_cast<double>(rng.below(1000)) / 500 - 1); };
      const WeightedPoint to = {from.x + step(), from.y + step(), from.w};
      const double before = least_ratio_of_angles(mesh, v, from.position()),
                   after = least_ratio_of_angles(mesh, v, to.position());
      guard.begin_step();
      const bool may = guard.allows_move(v, to);
      if (std::abs(after - limit) < kRounding || std::abs(after - before) < kRounding) continue;
      EXPECT_EQ(may, after >= limit || after >= before) << v.index << " " << limit << " " << before << " " << after;
      ++(may ? allowed : refused);
    }
  }
  EXPECT_GT(allowed, 100u);
  EXPECT_GT(refused, 100u);
}

TEST(Guard, AnswersEachMoveOfAStepAsIfItWereTheFirst) {
  const Mesh mesh = *random_mesh({200, 5, {}});
  const WorkingUnits units;
  const auto limits = std::make_shared<GuardLimits>();
  limits->has_flow = true;
  GuardValues& least = limits->for_steps;
  least.value.fill(-std::numeric_limits<double>::infinity());
  least.value[GuardValues::sine] = 0.1;
  least.value[GuardValues::areas] = 0.4;
  least.value[GuardValues::orthogonality] = -0.3;
  least.value[GuardValues::link] = 0.4;
  Guard guard(mesh, units, limits, true), fresh(mesh, units, limits, true);
  Rng rng(3);
  std::size_t allowed = 0, refused = 0;
  for (const VertexId v : mesh.vertices()) {
    guard.begin_step();
    for (int i = 0; i < 10; ++i) {
      const auto step = [&] { return 0.02 * (static_cast<double>(rng.below(1000)) / 500 - 1); };
      const WeightedPoint from = mesh.point(v), to = {from.x + step(), from.y + step(), from.w};
      fresh.begin_step();
      const bool may = fresh.allows_move(v, to);
      EXPECT_EQ(guard.allows_move(v, to), may) << v.index;
      ++(may ? allowed : refused);
    }
  }
  EXPECT_GT(allowed, 100u);
  EXPECT_GT(refused, 100u);
}

/// A step of refinement between quadrilaterals, with a corner of the large one moved. All its triangles have a right
/// angle.
///
///     0---1---2
///     |   |   |      two quadrilaterals of side 1
///     3---4---5
///     |  / \  |      three triangles
///     6-------7
///     |       |      a quadrilateral of side 2
///     8-------9
Mesh step_of_refinement(double moved) {
  const std::vector<Vec2> points = {{0, 2}, {1, 2}, {2, 2},         {0, 1},  {1, 1},
                                    {2, 1}, {0, 0}, {2 + moved, 0}, {0, -2}, {2, -2}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}, {3, 6, 4},
                                                              {4, 6, 7}, {4, 7, 5}, {8, 9, 7}, {8, 7, 6}};
  Mesh mesh = Mesh::build({.points = points, .triangles = triangles})->mesh;
  constexpr std::array<std::array<int, 2>, 3> kDiagonals = {{{0, 4}, {1, 5}, {8, 7}}};
  for (const auto& [a, b] : kDiagonals)
    mesh.set_diagonal(mesh.find_halfedge(VertexId(std::size_t(a)), VertexId(std::size_t(b))));
  for (const TriangleId t : mesh.triangles()) {
    if (!mesh.is_half(t)) continue;
    for (int k = 0; k < 3; ++k) {
      mesh.set_fixed(mesh.corners(t).at(static_cast<std::size_t>(k)), true);
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (!mesh.is_boundary(h) && !mesh.is_diagonal(h)) mesh.set_constrained(h, true);
    }
  }
  return mesh;
}

TEST(Guard, AnOrthogonalGridComesBackFromDFlowFM) {
  for (const double moved : {0.0, 1e-12, 0.001}) {
    const Mesh input = step_of_refinement(moved);
    EXPECT_LE(quality(input).max_orthogonality, 0.01);
    Mesh mesh = input;
    const auto report = optimize(mesh, *options_for("dflowfm"));
    ASSERT_TRUE(report);
    EXPECT_EQ(mesh, input);
    EXPECT_EQ(report->notes.front(),
              "the input meets the limits of D-Flow FM (orthogonality 0.01, flow links 0.1): it comes back as it was");
  }
}

/// Beyond the advice of D-Flow FM no measure becomes worse, and no vertex comes beside a quadrilateral.
TEST(Guard, AGridWithQuadrilateralsKeepsItsMeasures) {
  for (const double moved : {0.1, 0.3, 0.6}) {
    const Mesh input = step_of_refinement(moved);
    const Quality before = quality(input);
    EXPECT_GT(before.max_orthogonality, 0.01);
    Mesh mesh = input;
    ASSERT_TRUE(optimize(mesh, *options_for("dflowfm")));
    const Quality after = quality(mesh);
    EXPECT_EQ(after.vertices, before.vertices);
    EXPECT_LE(after.max_orthogonality, before.max_orthogonality + 1e-6);
    EXPECT_LE(after.small_flow_links, before.small_flow_links);
    EXPECT_LE(after.max_smoothness, before.max_smoothness + kRounding);
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
  options.guard.areas = 0.5;
  Mesh mesh = *random_mesh({20, 1, {}});
  const auto report = optimize(mesh, options);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("guard_areas"), std::string::npos);
}

}  // namespace
}  // namespace temper::test
