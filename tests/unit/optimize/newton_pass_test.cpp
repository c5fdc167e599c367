// Newton's method for all vertices of a part: what a pass keeps, what it gains, and that nothing else decides about it.
#include "optimize/sweep/newton_pass.hpp"

#include <gtest/gtest.h>

#include "energy/whole_mesh.hpp"
#include "optimize/driver.hpp"
#include "optimize/sweep/semidefinite.hpp"
#include "support/lattice.hpp"
#include "support/std_threads.hpp"
#include "temper/generate.hpp"
#include "temper/instruction_set.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"
#include "temper/trace.hpp"

namespace temper::test {
namespace {

constexpr std::size_t kVertices = 900, kPart = 200;

/// Well-centered, but far from the minimum; with two regions, a line between them, and vertices that the user has
/// fixed.
Mesh start_of_passes(std::uint64_t seed = 1) {
  Mesh mesh = *random_points({.vertices = kVertices, .seed = seed});
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    mesh.set_region(t, mesh.position(a).x + mesh.position(b).x + mesh.position(c).x > 1.2 ? 1 : 0);
  }
  OptimizeOptions options{.max_sweeps = 60, .paper = {.newton_passes = false}};
  options.paper.tolerance = 1e-3;
  EXPECT_TRUE(optimize(mesh, options));
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h) && mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)))) {
      mesh.set_constrained(h, true);
    }
  }
  for (std::size_t i = 0; i < kVertices; i += 50) mesh.set_fixed(VertexId(i), true);
  EXPECT_EQ(count_bad(mesh, nullptr), 0U);
  return mesh;
}

struct PassResult {
  Mesh mesh;
  std::vector<double> energies;  // before the first pass and after each
  std::vector<TraceEvent> events;
};

/// Passes alone, without sweeps.
PassResult after_passes(const Mesh& input, int passes, const OptimizeOptions& options = {},
                        std::size_t part_size = kPart, const OptimizeHooks& hooks = {}) {
  WorkingCopy work(input, options.paper.order);
  Settings settings = *make_settings(options, work.mesh, work.frame, hooks);
  settings.model.gamma = {0.003, LengthScale::relative};
  settings.model.h0 = {0.05, LengthScale::relative};
  const Observer nobody;
  Run run(options, nobody);
  run.report.history.push_back({});
  const Recorder recorder(settings.hooks.tracer, work, 1);
  VertexLimits limits(work.mesh, settings, work.frame);
  NewtonPass pass({work.mesh, settings, work.frame, limits, recorder}, part_size);
  PassResult result;
  result.energies.push_back(total_energy(work.mesh, settings.model));
  for (int i = 0; i < passes; ++i) {
    StopToken stop(run, work.mesh.n_vertices());
    pass.run(options.unknowns, stop);
    EXPECT_FALSE(stop.stopped());
    result.energies.push_back(total_energy(work.mesh, settings.model));
  }
  result.mesh = std::move(work).in_user_terms();
  return result;
}

void expect_kept(const Mesh& before, const Mesh& after) {
  EXPECT_EQ(after.validate(), std::nullopt);
  EXPECT_EQ(count_bad(after, nullptr), 0U);
  EXPECT_EQ(count_non_regular_edges(after), 0U);
  ASSERT_EQ(after.n_vertices(), before.n_vertices());
  for (const TriangleId t : before.triangles()) {
    EXPECT_EQ(after.corners(t), before.corners(t));
    EXPECT_EQ(after.region(t), before.region(t));
  }
  std::size_t kept = 0;
  for (const HalfedgeId h : before.halfedges()) {
    EXPECT_EQ(after.is_constrained(h), before.is_constrained(h));
    const VertexId v = before.origin(h);
    if (!before.is_constrained(h) && !before.is_boundary(h) && !before.is_fixed(v)) continue;
    EXPECT_EQ(after.position(v), before.position(v));
    ++kept;
  }
  EXPECT_GT(kept, 100U);
}

TEST(NewtonPasses, LowerEveryBarrierAndKeepWhatMustStay) {
  const Mesh input = start_of_passes();
  for (const EnergyKind energy : {EnergyKind::BP, EnergyKind::BHs, EnergyKind::BH}) {
    for (int star = 0; star <= 2; ++star) {
      SCOPED_TRACE(std::string(energy_info(energy).name) + " " + std::to_string(star));
      const PassResult result = after_passes(input, 4, {.energy = energy, .star = Star(star)});
      for (std::size_t i = 1; i < result.energies.size(); ++i) {
        EXPECT_LT(result.energies[i], result.energies[i - 1]);
      }
      expect_kept(input, result.mesh);
    }
  }
}

TEST(NewtonPasses, MoveOnlyTheirUnknowns) {
  const Mesh input = start_of_passes(2);
  const Mesh weights = after_passes(input, 2, {.unknowns = Unknowns::weights}).mesh;
  const Mesh positions = after_passes(input, 2, {.unknowns = Unknowns::positions}).mesh;
  std::size_t moved = 0, weighed = 0;
  for (const VertexId v : input.vertices()) {
    EXPECT_EQ(weights.position(v), input.position(v));
    EXPECT_EQ(positions.weight(v), input.weight(v));
    moved += positions.position(v) != input.position(v) ? 1 : 0;
    weighed += weights.weight(v) != input.weight(v) ? 1 : 0;
  }
  EXPECT_GT(moved, kVertices / 2);
  EXPECT_GT(weighed, kVertices / 2);
}

TEST(NewtonPasses, ConvergeLikeNewtonsMethodInOnePart) {
  const PassResult result = after_passes(start_of_passes(3), 12, {}, 10 * kVertices);
  const double least = result.energies.back();
  const auto gap = [&](std::size_t i) { return (result.energies[i] - least) / least; };
  EXPECT_GT(gap(0), 1e-4);
  EXPECT_LT(gap(6), 1e-7);
}

TEST(NewtonPasses, GiveTheSameBytesOnThreadsInInstructionSetsAndTraced) {
  const Mesh input = start_of_passes(4);
  const Mesh first = after_passes(input, 3).mesh;
  EXPECT_FALSE(first == input);
  for (const std::size_t threads : {1, 2, 3, 8}) {
    StdThreads executor(threads);
    EXPECT_TRUE(after_passes(input, 3, {}, kPart, {.executor = &executor}).mesh == first);
    EXPECT_GT(executor.runs(), 0U);
  }
  std::vector<TraceEvent> events;
  EXPECT_TRUE(after_passes(input, 3, {}, kPart, {.tracer = [&](const TraceEvent& e) { events.push_back(e); }}).mesh ==
              first);
  EXPECT_GT(events.size(), kVertices);
  const auto again = replay(input, events);
  ASSERT_TRUE(again) << again.error().what();
  EXPECT_TRUE(*again == first);
  const InstructionSet used = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set));
    EXPECT_TRUE(after_passes(input, 3).mesh == first) << name(set);
  }
  use_instruction_set(used);
}

struct PassesRun {
  Mesh mesh;
  OptimizeReport report;
};

PassesRun optimized(const Mesh& input, OptimizeOptions options) {
  PassesRun run{input, {}};
  run.report = *optimize(run.mesh, options);
  return run;
}

TEST(RunsWithNewtonPasses, EndLowerAfterFewerSweeps) {
  for (const std::size_t vertices : {200, 1000, 3000}) {
    for (const std::uint64_t seed : {1, 2}) {
      SCOPED_TRACE(std::to_string(vertices) + " vertices, seed " + std::to_string(seed));
      const Mesh input = *random_points({.vertices = vertices, .seed = seed});
      const PassesRun sweeps = optimized(input, {.paper = {.newton_passes = false}}),
                      passes = optimized(input, {.objective = Objective::energy});
      EXPECT_EQ(passes.report.stopped, Stopped::converged);
      EXPECT_LE(passes.report.history.back().bad, sweeps.report.history.back().bad);
      EXPECT_LT(passes.report.final_energy, sweeps.report.final_energy * (1 + 1e-6));
      EXPECT_LT(passes.report.sweeps, sweeps.report.sweeps);
      EXPECT_EQ(passes.report.history.size(), static_cast<std::size_t>(passes.report.sweeps) + 1);
      EXPECT_EQ(count_non_regular_edges(passes.mesh), 0U);
      EXPECT_EQ(passes.mesh.validate(), std::nullopt);
    }
  }
}

TEST(RunsWithNewtonPasses, EndWhenSweepsAreUsedUpOrTheCallerSaysSo) {
  const Mesh input = *random_points({.vertices = 500, .seed = 5});
  const int all = optimized(input, {}).report.sweeps;
  for (int most = all - 4; most < all; ++most) {
    const OptimizeReport report = optimized(input, {.max_sweeps = most}).report;
    EXPECT_EQ(report.sweeps, most);
    EXPECT_EQ(report.stopped, Stopped::max_sweeps);
    Mesh mesh = input;
    OptimizeHooks hooks;
    hooks.observer = [&](const Progress& p) { return p.last.sweep >= most ? Continue::no : Continue::yes; };
    const auto stopped = optimize(mesh, {}, hooks);
    EXPECT_EQ(stopped->stopped, Stopped::cancelled);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(count_non_regular_edges(mesh), 0U);
  }
}

TEST(RunsWithNewtonPasses, AreThoseOfSweepsAloneWhereOptionsAskForMore) {
  const Mesh input = *random_points({.vertices = 300, .seed = 6});
  for (OptimizeOptions options : std::vector<OptimizeOptions>{{.paper = {.solver = Solver::alternating}},
                                                              {.energy = EnergyKind::T},
                                                              {.flips = Flips::none},
                                                              {.paper = {.flip_limit = FlipLimit::before}},
                                                              {.paper = {.order = SweepOrder::input}},
                                                              {.paper = {.anchor = VertexId(0)}},
                                                              {.paper = {.removal = Removal::patch}},
                                                              {.size_band = 3}}) {
    options.max_sweeps = 15;
    const PassesRun with = optimized(input, options);
    options.paper.newton_passes = false;
    EXPECT_TRUE(with.mesh == optimized(input, options).mesh);
  }
}

TEST(Semidefinite, MatricesLoseTheirNegativeEigenvaluesAndNothingElse) {
  Noise noise(1);
  for (int trial = 0; trial < 20; ++trial) {
    // H = Σ λ v⊗v by a product of reflections, whose columns are orthonormal.
    Matrix6 v{};
    for (std::size_t i = 0; i < 6; ++i) v[i][i] = 1;
    for (int k = 0; k < 3; ++k) {
      std::array<double, 6> u{};
      double norm = 0;
      for (double& x : u) x = noise(), norm += x * x;
      for (auto& row : v) {
        double along = 0;
        for (std::size_t i = 0; i < 6; ++i) along += row[i] * u[i];
        for (std::size_t i = 0; i < 6; ++i) row[i] -= 2 * along / norm * u[i];
      }
    }
    constexpr std::array<double, 6> kEigenvalues = {-3, -0.01, 0, 0.5, 2, 100};
    const auto with = [&](bool negative) {
      Matrix6 h{};
      for (std::size_t k = 0; k < 6; ++k) {
        if (kEigenvalues[k] < 0 && !negative) continue;
        for (std::size_t i = 0; i < 6; ++i) {
          for (std::size_t j = 0; j < 6; ++j) h[i][j] += kEigenvalues[k] * v[i][k] * v[j][k];
        }
      }
      return h;
    };
    Matrix6 h = with(true);
    const Matrix6 expected = with(false);
    make_semidefinite(h);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) EXPECT_NEAR(h[i][j], expected[i][j], 1e-10 * kEigenvalues[5]);
    }
  }
}

}  // namespace
}  // namespace temper::test
