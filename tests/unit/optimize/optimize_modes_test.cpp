// Every switch of the optimizer has its documented effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "support/lattice.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

Mesh mesh_of_random_points(std::uint64_t seed = 1) {
  auto mesh = random_mesh({.vertices = 300, .seed = seed});
  EXPECT_TRUE(mesh);
  return *std::move(mesh);
}

std::vector<std::array<VertexId, 3>> connectivity(const Mesh& mesh) {
  std::vector<std::array<VertexId, 3>> all;
  for (const TriangleId t : mesh.triangles()) all.push_back(mesh.corners(t));
  return all;
}

TEST(Modes, PositionsOnlyKeepsWeights) {
  Mesh mesh = mesh_of_random_points();
  const Mesh before = mesh;
  const auto report = optimize(mesh, {.unknowns = Unknowns::positions, .max_sweeps = 30});
  ASSERT_TRUE(report);
  std::size_t moved = 0;
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(mesh.weight(v), before.weight(v));
    moved += mesh.position(v) != before.position(v) ? 1 : 0;
  }
  EXPECT_GT(moved, 100u);
  EXPECT_LT(report->history.back().bad, report->history.front().bad / 2);
}

TEST(Modes, WeightsOnlyKeepsPositions) {
  Mesh mesh = lattice({.n = 12, .jitter = 0.2, .weight = 0});
  const Mesh before = mesh;
  const auto report = optimize(mesh, {.unknowns = Unknowns::weights, .max_sweeps = 60});
  ASSERT_TRUE(report);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.position(v), before.position(v));
  EXPECT_LT(report->history.back().bad, report->history.front().bad);
}

TEST(Modes, WeightsWaitForTheirSweep) {
  Mesh mesh = mesh_of_random_points();
  ASSERT_TRUE(optimize(mesh, {.max_sweeps = 5, .paper = {.weights_from = 5}}));
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.weight(v), 0);
  ASSERT_TRUE(optimize(mesh, {.max_sweeps = 7, .paper = {.weights_from = 5}}));
  EXPECT_TRUE(
      std::any_of(mesh.vertices().begin(), mesh.vertices().end(), [&](VertexId v) { return mesh.weight(v) != 0; }));
}

TEST(Modes, FrozenConnectivityIsKeptAndStaysRegular) {
  for (const Solver solver : {Solver::newton, Solver::alternating, Solver::golden}) {
    Mesh mesh = mesh_of_random_points();
    const auto before = connectivity(mesh);
    const auto report = optimize(mesh, {.flips = Flips::none, .max_sweeps = 12, .paper = {.solver = solver}});
    ASSERT_TRUE(report);
    EXPECT_EQ(report->flips, 0u);
    EXPECT_EQ(connectivity(mesh), before);
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_LT(report->history.back().bad, report->history.front().bad);
  }
}

TEST(Modes, FrozenConnectivityThatIsNotRegularGetsNoWorse) {
  Mesh mesh = lattice({.n = 12, .jitter = 0.35, .weight = 0});
  std::vector<HalfedgeId> regular;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (is_regular(mesh, h)) regular.push_back(h);
  }
  ASSERT_LT(regular.size(), mesh.n_halfedges());
  const auto before = connectivity(mesh);
  const auto report = optimize(mesh, {.flips = Flips::none, .max_sweeps = 40});
  ASSERT_TRUE(report);
  EXPECT_EQ(connectivity(mesh), before);
  for (const HalfedgeId h : regular) EXPECT_TRUE(is_regular(mesh, h));
  EXPECT_LT(report->history.back().bad, report->history.front().bad / 2);
}

TEST(Modes, FrozenConnectivityStaysRegularWhereWeightsLeaveEdgesUncrossed) {
  int infinite = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Mesh mesh = lattice({.n = 6, .jitter = 0.2, .weight = 0.55, .seed = seed});
    if (!restore_regularity(mesh).regular()) continue;
    infinite += std::isinf(total_energy(mesh, {.kind = EnergyKind::BP})) ? 1 : 0;
    ASSERT_TRUE(optimize(mesh, {.flips = Flips::none, .max_sweeps = 5}));
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  }
  EXPECT_GT(infinite, 3);
}

TEST(Modes, AnInputThatIsNotRegularComesBackRegularEvenWithoutASweep) {
  Mesh mesh = lattice({.n = 9, .jitter = 0.3, .weight = 0});
  ASSERT_GT(count_non_regular_edges(mesh), 0u);
  ASSERT_TRUE(optimize(mesh, {.max_sweeps = 0}));
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
}

TEST(Modes, InfiniteEnergyIsLeftOrSaid) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {0.5, 0.9}};
  const std::vector<double> weights = {0, 100, -100};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}};
  Mesh mesh = Mesh::build({.points = points, .weights = weights, .triangles = triangles})->mesh;
  Mesh frozen = mesh;
  const auto report = optimize(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(quality(mesh).well_centered_fraction, 1);
  EXPECT_TRUE(std::isfinite(report->objective_after));

  const auto stuck = optimize(frozen, {.objective = Objective::energy, .unknowns = Unknowns::positions});
  ASSERT_TRUE(stuck);
  EXPECT_LT(stuck->sweeps, 20);
  ASSERT_FALSE(stuck->notes.empty());
  EXPECT_NE(stuck->notes.back().find("the energy is infinite"), std::string::npos);
}

TEST(Modes, EverySolverLowersEveryEnergyAndKeepsTheMeshValid) {
  int runs = 0;
  for (const EnergyInfo& info : energies()) {
    for (int star = 0; star < 3; ++star) {
      for (const Solver solver : {Solver::newton, Solver::alternating, Solver::golden}) {
        Mesh mesh = info.is_hard() ? lattice({.n = 7, .jitter = 0.02}) : lattice({.n = 7, .jitter = 0.3, .weight = 0});
        const auto report =
            optimize(mesh, {.energy = info.kind, .star = Star(star), .max_sweeps = 6, .paper = {.solver = solver}});
        ASSERT_TRUE(report) << info.name << ": " << report.error().what();
        EXPECT_LT(report->objective_after, report->objective_before) << info.name << " star " << star;
        EXPECT_EQ(mesh.validate(), std::nullopt);
        EXPECT_EQ(count_non_regular_edges(mesh), 0u);
        ++runs;
      }
    }
  }
  EXPECT_EQ(runs, int{kEnergyKinds} * 3 * 3);
}

TEST(Modes, EveryFlipLimitAndTimingKeepsTheMeshRegular) {
  int runs = 0;
  for (const EnergyKind energy : {EnergyKind::BP, EnergyKind::dT, EnergyKind::T}) {
    for (const auto limit : {FlipLimit::unlimited, FlipLimit::before, FlipLimit::at, FlipLimit::after}) {
      for (const auto timing : {Flips::immediate, Flips::deferred}) {
        Mesh mesh = lattice({.n = 9, .jitter = 0.3, .weight = 0});
        const std::size_t non_regular = count_non_regular_edges(mesh);
        const auto report =
            optimize(mesh, {.energy = energy, .flips = timing, .max_sweeps = 8, .paper = {.flip_limit = limit}});
        ASSERT_TRUE(report);
        EXPECT_EQ(mesh.validate(), std::nullopt);
        EXPECT_EQ(count_non_regular_edges(mesh), 0u) << energy_info(energy).name;
        if (limit == FlipLimit::before) {
          // Only the flips that made the input regular were made.
          Mesh restored = lattice({.n = 9, .jitter = 0.3, .weight = 0});
          EXPECT_EQ(report->flips, restore_regularity(restored).flips);
          EXPECT_GT(non_regular, 0u);
        }
        ++runs;
      }
    }
  }
  EXPECT_EQ(runs, 3 * 4 * 2);
}

TEST(Modes, InterfaceVerticesStayOrSlideAlongTheirLine) {
  // A lattice with two regions, split along a straight row.
  const auto with_interface = [] {
    Mesh mesh = lattice({.n = 9, .jitter = 0.3, .weight = 0});
    for (const VertexId v : mesh.vertices()) {
      if (v.index / 9 == 4) mesh.set_position(v, {double(v.index % 9) + 2, std::sqrt(0.75) * 4});
    }
    for (std::size_t i = 36; i < 44; ++i) mesh.set_constrained(mesh.find_halfedge(VertexId(i), VertexId(i + 1)), true);
    return mesh;
  };
  const Mesh before = with_interface();
  ASSERT_EQ(before.validate(), std::nullopt);
  for (const auto interfaces : {InterfaceVertices::fixed, InterfaceVertices::sliding}) {
    Mesh mesh = before;
    ASSERT_TRUE(optimize(mesh, {.interfaces = interfaces, .max_sweeps = 20}));
    EXPECT_EQ(mesh.validate(), std::nullopt);
    double slid = 0;
    for (std::size_t i = 36; i < 45; ++i) {
      const VertexId v(i);
      EXPECT_NEAR(mesh.position(v).y, before.position(v).y, 1e-14);
      slid = std::max(slid, std::abs(mesh.position(v).x - before.position(v).x));
      if (i < 44) {
        EXPECT_TRUE(mesh.is_constrained(mesh.find_halfedge(v, VertexId(i + 1))));
      }
    }
    EXPECT_EQ(slid > 0, interfaces == InterfaceVertices::sliding);
  }
}

TEST(Modes, AnchorHasWeightZeroAtTheEnd) {
  Mesh mesh = mesh_of_random_points();
  ASSERT_TRUE(optimize(mesh, {.max_sweeps = 10, .paper = {.anchor = VertexId(17)}}));
  EXPECT_EQ(mesh.weight(VertexId(17)), 0);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
}

TEST(Modes, StopsAtTheSweepLimitTheTimeLimitAndWhenAsked) {
  Mesh mesh = mesh_of_random_points();
  const auto limited = optimize(mesh, {.max_sweeps = 3});
  ASSERT_TRUE(limited);
  EXPECT_EQ(limited->stopped, Stopped::max_sweeps);
  EXPECT_EQ(limited->sweeps, 3);
  EXPECT_EQ(limited->history.size(), 4u);

  Mesh timed = mesh_of_random_points();
  const auto late = optimize(timed, {.time_limit = 1e-9});
  ASSERT_TRUE(late);
  EXPECT_EQ(late->stopped, Stopped::time_limit);
  EXPECT_EQ(timed.validate(), std::nullopt);

  Mesh asked = mesh_of_random_points();
  int calls = 0;
  OptimizeHooks hooks;
  hooks.observer = [&](const Progress& p) {
    EXPECT_EQ(p.max_sweeps, OptimizeOptions().max_sweeps);
    EXPECT_EQ(p.last.sweep, calls);
    return ++calls > 4 ? Continue::no : Continue::yes;
  };
  const auto canceled = optimize(asked, {}, hooks);
  ASSERT_TRUE(canceled);
  EXPECT_EQ(canceled->stopped, Stopped::canceled);
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(asked.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(asked), 0u);
}

/// Is slow once, before the first sweep.
class SlowBeginning final : public Executor {
 public:
  static constexpr std::chrono::milliseconds kTime{300};
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    std::call_once(slept_, [] { std::this_thread::sleep_for(kTime); });
    SerialExecutor().run(n, block);
  }

 private:
  std::once_flag slept_;
};

// Twice 0.3 seconds are more than 0.5. Only the estimated time for the end makes this run stop.
TEST(Modes, TheTimeLimitIsOfTheEndTooWhichTakesAsLongAsTheBeginning) {
  for (const Objective objective : {Objective::energy, Objective::accuracy}) {
    SlowBeginning executor;
    OptimizeHooks hooks;
    hooks.executor = &executor;
    Mesh mesh = *sheared_grid({.nx = 3, .ny = 3});
    const auto report = optimize(mesh, {.objective = objective, .time_limit = 0.5}, hooks);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->stopped, Stopped::time_limit);
  }
}

TEST(Modes, ThePapersStoppingRuleLooksAtTheMeanEnergyOfATriangle) {
  Mesh mesh = lattice({.n = 8, .jitter = 0.2, .weight = 0});
  const auto report =
      optimize(mesh, {.paper = {.gamma = LengthParameter{0.1}, .tolerance = 1e-3, .stopping = StoppingRule::paper}});
  ASSERT_TRUE(report);
  ASSERT_EQ(report->stopped, Stopped::converged);
  ASSERT_GE(report->history.size(), 3u);
  const std::size_t n = report->history.size();
  const double triangles = static_cast<double>(mesh.n_triangles());
  EXPECT_LT(report->history[n - 2].energy - report->history[n - 1].energy, 1e-3 * triangles);
  EXPECT_GE(report->history[n - 3].energy - report->history[n - 2].energy, 1e-3 * triangles);
}

TEST(Modes, JitterFreesASymmetricGridAndIsSeeded) {
  const auto solve = [](std::uint64_t seed, Objective objective = Objective::energy) {
    Mesh mesh = *sheared_grid({.nx = 8, .ny = 8, .shear = 0});
    const OptimizeOptions options = {
        .objective = objective, .unknowns = Unknowns::positions, .max_sweeps = 120, .paper = {.seed = seed}};
    EXPECT_TRUE(optimize(mesh, options));
    return mesh;
  };
  const Mesh start = *sheared_grid({.nx = 8, .ny = 8, .shear = 0});
  const Mesh one = solve(1), again = solve(1), two = solve(2);
  EXPECT_EQ(quality(start).well_centered_fraction, 0);
  EXPECT_GT(quality(one).well_centered_fraction, 0.5);
  EXPECT_EQ(one, again);
  EXPECT_NE(one, two);
  // The worst triangles of the grid have right angles. A run for accuracy leaves no worse ones.
  const Quality accurate = quality(solve(1, Objective::accuracy));
  EXPECT_GT(accurate.well_centered_fraction, 0.5);
  EXPECT_EQ(accurate.obtuse_triangles, 0u);
}

TEST(Modes, ASecondAttemptImprovesTheDenseHorseshoe) {
  Mesh mesh = *horseshoe();
  const auto report = optimize(mesh, {.max_sweeps = 400});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->history.front().bad, 58u);
  EXPECT_LE(quality(mesh).orthocenters_outside, 8u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(Modes, HotWithoutBarrierKeepsTheMeshValidWhereEdgesCollapse) {
  Mesh mesh = *horseshoe();
  const auto report = optimize(mesh, {.energy = EnergyKind::F, .max_sweeps = 40});
  ASSERT_TRUE(report);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  EXPECT_LT(report->objective_after, report->objective_before);
}

}  // namespace
}  // namespace temper::test
