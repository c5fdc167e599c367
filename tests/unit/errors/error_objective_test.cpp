// Objective::solver_error with the model of temper::errors: errors fall, what must stay stays, and a run is the same
// however it is made.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/rng.hpp"
#include "support/lattice.hpp"
#include "support/std_threads.hpp"
#include "temper/errors.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/solvers.hpp"

namespace temper::test {
namespace {

constexpr double kMargin = 0.02;

OptimizeOptions options_for(Scheme scheme) {
  OptimizeOptions o;
  o.scheme = scheme;
  if (scheme == Scheme::all) o.objective = Objective::solver_error;
  o.solver_error.steps = 40;
  return o;
}

struct Improved {
  Mesh mesh;
  OptimizeReport report;
};

/// The mean squared errors of the schemes on `mesh`, in the measure of `input`.
std::vector<double> errors_on(const Mesh& mesh, const Mesh& input, Scheme scheme) {
  const auto model = make_discretization_error(input, {.scheme = scheme});
  EXPECT_TRUE(model);
  return (*model)->errors(mesh);
}

Improved improved(const Mesh& input, const OptimizeOptions& options, OptimizeHooks hooks = {}) {
  hooks.solvers = solvers();
  Improved result{input, {}};
  auto report = optimize(result.mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  if (report) result.report = *std::move(report);
  return result;
}

TEST(ErrorObjective, LowersTheErrorsOfItsSchemeBelowThoseOfTheAccuracyObjective) {
  const Mesh input = *random_mesh({.vertices = 150, .seed = 8});
  for (const Scheme scheme : {Scheme::vertex, Scheme::cell, Scheme::all}) {
    const OptimizeOptions options = options_for(scheme);
    const Improved error = improved(input, options);
    const Improved accuracy = improved(input, {.objective = Objective::accuracy, .scheme = scheme});
    const auto after = errors_on(error.mesh, input, scheme), before = errors_on(accuracy.mesh, input, scheme);
    ASSERT_EQ(after.size(), before.size());
    double product = 1;
    for (std::size_t i = 0; i < after.size(); ++i) product *= after[i] / before[i];
    EXPECT_LT(product, 1);
    const Quality q = quality(error.mesh);
    EXPECT_EQ(q.well_centered_fraction, 1);
    EXPECT_EQ(q.non_regular_edges, 0u);
    EXPECT_GT(q.min_h_over_l, 0.9 * kMargin);
    EXPECT_EQ(error.mesh.validate(), std::nullopt);
    EXPECT_EQ(error.report.history.back().objective, Objective::solver_error);
    for (const VertexId v : input.vertices()) {
      if (!input.is_boundary(v)) continue;
      EXPECT_EQ(error.mesh.position(v), input.position(v));
    }
  }
}

TEST(ErrorObjective, ReportsTheErrorsOfTheInputAndOfTheReturnedMesh) {
  const Mesh input = *random_mesh({.vertices = 150, .seed = 8});
  const auto mean_of = [&](const Mesh& mesh, Scheme scheme) {
    double product = 1;
    const std::vector<double> errors = errors_on(mesh, input, scheme);
    for (const double error : errors) product *= error;
    return std::pow(product, 0.5 / static_cast<double>(errors.size()));
  };
  for (const Scheme scheme : {Scheme::vertex, Scheme::all}) {
    const Improved result = improved(input, options_for(scheme));
    EXPECT_NEAR(result.report.objective_after / mean_of(result.mesh, scheme), 1, 1e-9);
    if (scheme == Scheme::vertex) {
      EXPECT_NEAR(result.report.objective_before / mean_of(input, scheme), 1, 1e-9);
    }
  }
}

TEST(ErrorObjective, SweepsForAccuracyEndEarlierIfStepsForTheErrorFollow) {
  const Mesh input = *random_mesh({.vertices = 400, .seed = 8});
  const auto sweeps_for = [&](Objective objective) {
    const Improved result = improved(input, {.objective = objective, .scheme = Scheme::vertex});
    return std::ranges::count(result.report.history, Objective::accuracy, &SweepRecord::objective);
  };
  EXPECT_GT(sweeps_for(Objective::solver_error), 0);
  EXPECT_LT(sweeps_for(Objective::solver_error), sweeps_for(Objective::accuracy));
}

// Some triangle of a random mesh is always close to its floor.
TEST(ErrorObjective, TightTrianglesHoldBackNoOtherVertices) {
  const Mesh input = *random_mesh({.vertices = 400, .seed = 8});
  OptimizeOptions options = options_for(Scheme::vertex);
  options.solver_error.steps = 8;
  const Improved error = improved(input, options);
  const Improved accuracy = improved(input, {.objective = Objective::accuracy, .scheme = Scheme::vertex});
  const double ratio =
      errors_on(error.mesh, input, Scheme::vertex).at(0) / errors_on(accuracy.mesh, input, Scheme::vertex).at(0);
  EXPECT_LT(std::sqrt(ratio), 0.7);
}

/// Two layers with a straight border between them, and a problem whose coefficient jumps there.
struct Layers {
  Mesh mesh;
  DiffusionProblem problem = {};

  explicit Layers(int n) {
    std::vector<Vec2> points;
    Rng rng(8);
    const auto jittered = [&](int i) {
      const bool stays = i == 0 || i == n || 2 * i == n;
      const double by = rng.uniform(-0.3, 0.3);
      return (i + (stays ? 0 : by)) / n;
    };
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) points.push_back({jittered(x), jittered(y)});
    }
    for (int y = 0; y <= n; ++y) {
      points[static_cast<std::size_t>(y * (n + 1))].x = 0;
      for (const int x : {0, n / 2, n})
        points[static_cast<std::size_t>(y * (n + 1) + x)].y = static_cast<double>(y) / n;
    }
    mesh = *constrained_delaunay({.points = points});
    for (const TriangleId t : mesh.triangles()) {
      double x = 0;
      for (const VertexId v : mesh.corners(t)) x += mesh.position(v).x / 3;
      mesh.set_region(t, x < 0.5 ? 1 : 2);
    }
    problem.coefficient = coefficient(mesh);
    EXPECT_FALSE(problem_warnings(mesh, problem).empty()) << "nothing holds the border";
    problem.source.assign(mesh.n_vertices(), 1.0);
    problem.boundary = {{{}, 1, false}, {{}, -1, true}};
    for (const HalfedgeId h : mesh.halfedges()) {
      const VertexId a = mesh.origin(h), b = mesh.target(h);
      const double x = mesh.position(a).x;
      if (x == mesh.position(b).x && mesh.is_boundary(h)) problem.boundary[x == 0 ? 0 : 1].edges.push_back({a, b});
      if (x == mesh.position(b).x && x == 0.5) mesh.set_constrained(h, true);
    }
    EXPECT_TRUE(problem_warnings(mesh, problem).empty());
  }
  static std::vector<double> coefficient(const Mesh& of) {
    std::vector<double> k;
    for (const TriangleId t : of.triangles()) k.push_back(of.region(t) == 1 ? 1000 : 1);
    return k;
  }
};

// The reference of the measured errors is another one: on the new mesh, and finer.
TEST(ErrorObjective, LowersTheErrorOfTheUsersOwnProblem) {
  const Layers input(12);
  for (const Scheme scheme : {Scheme::vertex, Scheme::cell}) {
    OptimizeOptions options = options_for(scheme);
    const Improved general = improved(input.mesh, options);
    options.problem = input.problem;
    const Improved special = improved(input.mesh, options);
    const auto error = [&](const Mesh& mesh) {
      DiffusionProblem problem = input.problem;  // its boundary stays
      problem.coefficient = Layers::coefficient(mesh);
      const DiffusionErrors errors = *measure_diffusion_errors(mesh, problem, 3);
      return scheme == Scheme::vertex ? errors.vertex.l2 : errors.cell.l2;
    };
    EXPECT_LT(error(special.mesh), 0.5 * error(general.mesh));
    EXPECT_LT(error(special.mesh), 0.5 * error(input.mesh));
    EXPECT_LT(special.report.objective_after, special.report.objective_before);
    for (const HalfedgeId h : input.mesh.halfedges()) {
      if (!input.mesh.is_unflippable(h)) continue;
      const VertexId a = input.mesh.origin(h), b = input.mesh.target(h);
      EXPECT_EQ(special.mesh.position(a), input.mesh.position(a));
      EXPECT_TRUE(special.mesh.find_halfedge(a, b).valid() || special.mesh.find_halfedge(b, a).valid());
    }
  }
}

TEST(ErrorObjective, AProblemThatNoRunWouldUseIsRefused) {
  const Layers input(6);
  const auto message = [&](OptimizeOptions options) {
    options.problem = input.problem;
    Mesh mesh = input.mesh;
    const auto report = optimize(mesh, options, {.solvers = solvers()});
    EXPECT_EQ(mesh, input.mesh);
    return report ? std::string() : report.error().message;
  };
  EXPECT_NE(message({}).find("expected the target vertex or cell"), std::string::npos);
  EXPECT_NE(message({.scheme = Scheme::cell, .energy = EnergyKind::T}).find("the default objective"),
            std::string::npos);
  EXPECT_NE(message({.scheme = Scheme::cell, .tensor = Tensor{2, 0, 1}}).find("cannot go with a problem"),
            std::string::npos);
  OptimizeOptions few = options_for(Scheme::vertex);
  few.problem = input.problem;
  Mesh mesh = input.mesh;
  EXPECT_FALSE(optimize(mesh, few)) << "without a model";
  few.solver_error.most_vertices = 48;
  EXPECT_NE(message(few).find("Next: `solver_error_vertices=49`"), std::string::npos);
}

// On rings errors cancel from neighbor to neighbor, which all that moves single vertices ends
// (docs/explanation/accuracy.md).
TEST(ErrorObjective, IsNeverWorseThanAWellCenteredInput) {
  const Mesh ring = *annulus({.jitter = 0});
  ASSERT_EQ(quality(ring).well_centered_fraction, 1);
  for (const Objective objective : {Objective::accuracy, Objective::solver_error}) {
    for (const Scheme scheme : {Scheme::vertex, Scheme::cell}) {
      OptimizeOptions options = options_for(scheme);
      options.objective = objective;
      const Improved result = improved(ring, options);
      EXPECT_LE(errors_on(result.mesh, ring, scheme)[0], errors_on(ring, ring, scheme)[0]);
      EXPECT_LE(result.report.objective_after, result.report.objective_before);
    }
  }
}

TEST(ErrorObjective, IsTheSameForAnyThreadsAndReplayed) {
  const Mesh input = *random_mesh({.vertices = 120, .seed = 2});
  const OptimizeOptions options = options_for(Scheme::vertex);
  std::vector<TraceEvent> events;
  OptimizeHooks hooks;
  hooks.tracer = [&](const TraceEvent& event) { events.push_back(event); };
  const Improved whole = improved(input, options, hooks);
  const auto again = replay(input, events);
  ASSERT_TRUE(again) << again.error().what();
  EXPECT_EQ(*again, whole.mesh);
  for (const std::size_t threads : {2, 5}) {
    StdThreads executor(threads);
    EXPECT_EQ(improved(input, options, {.executor = &executor}).mesh, whole.mesh);
  }
}

TEST(ErrorObjective, StopsWhenItIsAsked) {
  const Mesh input = *random_mesh({.vertices = 120, .seed = 2});
  const Improved cut =
      improved(input, options_for(Scheme::cell), {.observer = [](const Progress& progress) {
                 return progress.last.objective == Objective::solver_error ? Continue::no : Continue::yes;
               }});
  EXPECT_EQ(cut.report.stopped, Stopped::canceled);
  EXPECT_EQ(quality(cut.mesh).well_centered_fraction, 1);
  EXPECT_EQ(cut.mesh.validate(), std::nullopt);
}

// A trial of a step solves all systems anew, which takes long in a large mesh.
TEST(ErrorObjective, AsksAfterEachTrialOfAStep) {
  const Mesh input = *random_mesh({.vertices = 60, .seed = 2});
  std::size_t calls = 0;
  const Improved whole = improved(input, options_for(Scheme::cell), {.observer = [&](const Progress& progress) {
                                    calls += progress.last.objective == Objective::solver_error ? 1 : 0;
                                    return Continue::yes;
                                  }});
  const auto steps = static_cast<std::size_t>(
      std::ranges::count(whole.report.history, Objective::solver_error, &SweepRecord::objective));
  ASSERT_GT(steps, 5u);
  EXPECT_GE(calls, 2 * (steps - 2)) << "once after the trial, once after the step";
}

TEST(ErrorObjective, WithoutAModelLowersAccuracyAndSaysSo) {
  const Mesh input = *random_mesh({.vertices = 60, .seed = 2});
  Mesh without = input, accuracy = input;
  const auto report = optimize(without, {.scheme = Scheme::vertex});
  ASSERT_TRUE(report);
  ASSERT_TRUE(optimize(accuracy, {.objective = Objective::accuracy, .scheme = Scheme::vertex}));
  EXPECT_EQ(without, accuracy);
  EXPECT_EQ(report->objective, Objective::accuracy);
  EXPECT_NE(report->notes.front().find("the objective was accuracy, not the error"), std::string::npos);
  EXPECT_EQ(improved(input, {.scheme = Scheme::vertex}).report.objective, Objective::solver_error);
}

TEST(ErrorObjective, IsForSchemesAndEnergiesThatCenterTriangles) {
  Mesh mesh = *random_mesh({.vertices = 20, .seed = 2});
  const Mesh before = mesh;
  EXPECT_FALSE(wants_error_model({}, mesh));
  EXPECT_FALSE(wants_error_model({.scheme = Scheme::stars}, mesh));
  EXPECT_FALSE(wants_error_model({.scheme = Scheme::cell, .energy = EnergyKind::T}, mesh));
  EXPECT_TRUE(wants_error_model({.scheme = Scheme::cell}, mesh));
  OptimizeOptions hot = options_for(Scheme::vertex);
  hot.objective = Objective::solver_error;
  hot.energy = EnergyKind::T;
  EXPECT_FALSE(optimize(mesh, hot));
  EXPECT_EQ(mesh, before);
}

// --- never worse -----------------------------------------------------------------------------------------------------

/// n × n rectangles of this height and width 1, cut into triangles along parallel diagonals.
Mesh rectangles(std::int32_t n, double height) {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int32_t j = 0; j <= n; ++j) {
    for (std::int32_t i = 0; i <= n; ++i) points.push_back({static_cast<double>(i), height * j});
  }
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t a = i + (n + 1) * j, b = a + 1, d = a + n + 1, c = d + 1;
      triangles.push_back({a, b, d});
      triangles.push_back({b, c, d});
    }
  }
  return Mesh::build({.points = points, .triangles = triangles})->mesh;
}

TEST(NeverWorse, AnEquilateralGridComesBackAsItWas) {
  const Mesh input = lattice({.n = 13, .jitter = 0, .weight = 0});
  Mesh mesh = input;
  const auto report = optimize(mesh, {}, {.solvers = solvers()});
  ASSERT_TRUE(report);
  for (const VertexId v : input.vertices()) EXPECT_EQ(mesh.point(v), input.point(v));
  ASSERT_FALSE(report->notes.empty());
  EXPECT_NE(report->notes.back().find("times as large"), std::string::npos);
}

TEST(NeverWorse, RightAngledGridsKeepTheirErrorsUpToAFewPercent) {
  for (const double height : {1.0, 0.3}) {
    const Mesh input = rectangles(12, height);
    std::vector<Mesh> meshes;
    for (const unsigned threads : {1u, 2u, 3u}) {
      StdThreads executor(threads);
      meshes.push_back(input);
      ASSERT_TRUE(optimize(meshes.back(), {}, {.executor = &executor, .solvers = solvers()}));
      EXPECT_EQ(measure_errors(meshes.back())->not_well_centered, 0u);
    }
    for (const VertexId v : input.vertices()) {
      EXPECT_EQ(meshes[0].position(v), input.position(v));
      EXPECT_EQ(meshes[0].point(v), meshes[1].point(v));
      EXPECT_EQ(meshes[0].point(v), meshes[2].point(v));
    }
    std::vector<double> ratios = squared_solver_errors(meshes[0], Scheme::all);
    const std::vector<double> of_input = squared_solver_errors(input, Scheme::all);
    for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] = std::sqrt(ratios[i] / of_input.at(i));
    ASSERT_EQ(ratios.size(), 4u);
    for (const double ratio : ratios) EXPECT_LT(ratio, 1.05);
    const Mesh first = meshes[0];
    ASSERT_TRUE(optimize(meshes[0], {}, {.solvers = solvers()}));
    EXPECT_EQ(meshes[0], first) << "a second run sees the grid behind the weights";
  }
}

}  // namespace
}  // namespace temper::test
