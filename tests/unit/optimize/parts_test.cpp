// Sweeps in parts: the same bytes on any number of threads, and limits of what a part touches.
#include <gtest/gtest.h>

#include <limits>

#include "mesh/mesh_editor.hpp"
#include "optimize/flips/guard.hpp"
#include "optimize/flips/partition.hpp"
#include "optimize/stages/driver.hpp"
#include "support/sanitizers.hpp"
#include "support/shapes.hpp"
#include "support/std_threads.hpp"
#include "support/thread_communicator.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

constexpr std::size_t kSmallPart = 100, kPartsVertices = 800;
// Numbers of threads. Under a sanitizer two are enough.
const std::vector<std::size_t> kThreads =
    TEMPER_SANITIZED ? std::vector<std::size_t>{3, 8} : std::vector<std::size_t>{1, 2, 3, 8};
const std::vector<std::size_t> kRanks =
    TEMPER_SANITIZED ? std::vector<std::size_t>{2, 5} : std::vector<std::size_t>{1, 2, 3, 5, 8};

class LastBlockFirst final : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    for (std::size_t i = n; i > 0; --i) block(i - 1);
  }
};

struct SweptMesh {
  Mesh mesh;
  OptimizeReport report;
};

/// One restart with small parts, as optimize() makes it.
SweptMesh swept(const Mesh& input, const OptimizeOptions& options, std::size_t part_size = kSmallPart,
                const OptimizeHooks& hooks = {}) {
  WorkingCopy work(input, options.paper.order);
  Settings settings = *make_settings(options, work.mesh, work.units, hooks);
  if (options.size_band) settings.size_field = input_size_field_of(input);
  settings.guard = *guard_limits(input, options);
  SweepState state(settings);
  Run run(options, hooks, input);
  Driver driver(work, settings, state, run, part_size);
  EXPECT_TRUE(options.flips == Flips::none || driver.make_regular());
  driver.grade_boundary();
  driver.restart(restarts(settings, work.mesh).front(), false);
  return {std::move(work).in_user_terms(), run.report};
}

void expect_same(const SweptMesh& a, const SweptMesh& b) {
  EXPECT_TRUE(a.mesh == b.mesh);
  EXPECT_EQ(a.report.flips, b.report.flips);
  EXPECT_EQ(a.report.vertices_removed, b.report.vertices_removed);
  ASSERT_EQ(a.report.history.size(), b.report.history.size());
  for (std::size_t i = 0; i < a.report.history.size(); ++i) {
    EXPECT_EQ(a.report.history[i].energy, b.report.history[i].energy);
    EXPECT_EQ(a.report.history[i].flips, b.report.history[i].flips);
    EXPECT_EQ(a.report.history[i].bad, b.report.history[i].bad);
  }
}

struct PartsCase {
  const char* name;
  OptimizeOptions options;
};

class SweepsInParts : public testing::TestWithParam<PartsCase> {};

TEST_P(SweepsInParts, GiveTheSameBytesOnAnyNumberOfThreadsAndRanksAndTraced) {
  OptimizeOptions options = GetParam().options;
  const Mesh input =  // of a mesh at random the guard keeps hardly more than the worst triangle
      options.guard.step ? *annulus({.around = 64, .rings = 12}) : mesh_with_regions(kPartsVertices, 3);
  options.max_sweeps = 4;
  if (options.guard.step) {
    for (const VertexId v : input.vertices()) options.guard.depth.push_back(3 + 7.0 * (v.index % 5));
  }
  const SweptMesh alone = swept(input, options);
  EXPECT_EQ(alone.mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(alone.mesh, false), 0u);
  EXPECT_EQ(alone.report.sweeps, 4);

  for (const std::size_t threads : kThreads) {
    StdThreads crew(threads);
    OptimizeHooks hooks;
    hooks.executor = &crew;
    expect_same(swept(input, options, kSmallPart, hooks), alone);
  }
  for (const std::size_t ranks : kRanks) {
    on_ranks(ranks, [&](Communicator& all) {
      StdThreads crew(2);
      expect_same(swept(input, options, kSmallPart, {.executor = &crew, .communicator = &all}), alone);
    });
  }
  LastBlockFirst backwards;
  OptimizeHooks hooks;
  hooks.executor = &backwards;
  expect_same(swept(input, options, kSmallPart, hooks), alone);
  std::size_t events = 0;
  hooks.tracer = [&](const TraceEvent&) { ++events; };
  expect_same(swept(input, options, kSmallPart, hooks), alone);
  EXPECT_GT(events, kPartsVertices);
}

INSTANTIATE_TEST_SUITE_P(
    Options, SweepsInParts,
    testing::Values(
        PartsCase{"newton", {}}, PartsCase{"alternating", {.paper = {.solver = Solver::alternating}}},
        PartsCase{"golden", {.paper = {.solver = Solver::golden}}},
        PartsCase{"hot", {.energy = EnergyKind::T, .paper = {.flip_limit = FlipLimit::after}}},
        PartsCase{"hot_alternating", {.energy = EnergyKind::dT, .paper = {.solver = Solver::alternating}}},
        PartsCase{"hot_golden",
                  {.energy = EnergyKind::F, .paper = {.solver = Solver::golden, .flip_limit = FlipLimit::unlimited}}},
        PartsCase{"shifted_barrier", {.energy = EnergyKind::BHs}},
        PartsCase{"sliding", {.boundary = BoundaryVertices::slide, .interfaces = InterfaceVertices::sliding}},
        PartsCase{"split_boundary", {.boundary = BoundaryVertices::split}},
        PartsCase{"before_flips", {.paper = {.flip_limit = FlipLimit::before}}},
        PartsCase{"frozen_connectivity", {.flips = Flips::none}},
        PartsCase{"deferred_flips", {.flips = Flips::deferred, .paper = {.inner = 2}}},
        PartsCase{"deferred_weights", {.paper = {.solver = Solver::alternating, .weight_updates = Updates::deferred}}},
        PartsCase{"size_band", {.size_band = 2}},
        PartsCase{"guard", {.guard = {.angle = 60, .edge = 1, .areas = 1, .step = 1000}}},
        PartsCase{"removal", {.paper = {.removal = Removal::patch, .removal_from = 2}}},
        PartsCase{"collapse", {.energy = EnergyKind::T, .paper = {.collapse_from = 1}}},
        PartsCase{"hidden_removed", {.energy = EnergyKind::F, .paper = {.hidden = HiddenPolicy::remove}}},
        PartsCase{"anchor", {.paper = {.anchor = VertexId(7)}}}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(Parts, OfOneMeshThatIsNoLargerAreThePlainOrder) {
  const Mesh input = mesh_with_regions(600, 5);
  const SweptMesh one = swept(input, {.max_sweeps = 4}, 600), many = swept(input, {.max_sweeps = 4}, 599);
  EXPECT_FALSE(one.mesh == many.mesh);
  Mesh plain = input;
  ASSERT_TRUE(optimize(plain, {.max_sweeps = 4}));
  EXPECT_TRUE(one.mesh == plain);
}

TEST(Parts, LeaveOtherOrdersAlone) {
  const Mesh input = mesh_with_regions(600, 6);
  for (const SweepOrder order : {SweepOrder::input, SweepOrder::reverse, SweepOrder::random}) {
    const OptimizeOptions options{.max_sweeps = 3, .paper = {.order = order}};
    expect_same(swept(input, options, 50), swept(input, options, 10000));
  }
}

TEST(Parts, ReachAsLowAnEnergyAsTheWhole) {
  const Mesh input = *random_mesh({.vertices = 2500, .seed = 8});
  const SweptMesh whole = swept(input, {.max_sweeps = 40}, 2500), parts = swept(input, {.max_sweeps = 40});
  EXPECT_EQ(parts.report.history.back().bad, 0u);
  EXPECT_LT(parts.report.history.back().energy, 1.01 * whole.report.history.back().energy);
}

TEST(Parts, AskTheObserverInTheCallersThreadAndStopWhenToldTo) {
  const Mesh input = *random_mesh({.vertices = 2500, .seed = 9});
  StdThreads crew(3);
  const auto caller = std::this_thread::get_id();
  int calls = 0;
  const Observer observer = [&](const Progress& progress) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_GE(progress.fraction, 0);
    EXPECT_LT(progress.fraction, 1);
    return ++calls == 10 ? Continue::no : Continue::yes;
  };
  const SweptMesh result = swept(input, {}, kSmallPart, {.executor = &crew, .observer = observer});
  EXPECT_EQ(calls, 10);
  EXPECT_EQ(result.report.stopped, Stopped::canceled);
  EXPECT_EQ(result.mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(result.mesh, false), 0u);
}

// --- ranks ---------------------------------------------------------------------------------------

struct RankCase {
  const char* name;
  Mesh (*make)();
  OptimizeOptions options;
};

class Together : public testing::TestWithParam<RankCase> {};

TEST_P(Together, RanksEndWithTheBytesOfOneAlone) {
  const Mesh input = GetParam().make();
  Mesh alone = input;
  ASSERT_TRUE(optimize(alone, GetParam().options));
  for (std::size_t ranks = TEMPER_SANITIZED ? 3 : 2; ranks <= 3; ++ranks) {
    on_ranks(ranks, [&](Communicator& all) {
      Mesh mesh = input;
      const auto report = optimize(mesh, GetParam().options, {.communicator = &all});
      ASSERT_TRUE(report) << report.error().what();
      EXPECT_TRUE(mesh == alone) << "rank " << all.rank() << " of " << all.size();
    });
  }
}

Mesh plane_of_two_parts() { return *random_mesh({.vertices = 17000, .seed = 4}); }
Mesh sphere_of_two_parts() { return *random_sphere({.vertices = 17000, .seed = 4}); }
Mesh periodic_of_two_parts() { return *random_periodic({.vertices = 17000, .seed = 4, .period = {2, 1}}); }

INSTANTIATE_TEST_SUITE_P(
    Spaces, Together,
    testing::Values(
        RankCase{"plane", plane_of_two_parts, {.max_sweeps = 3}},
        RankCase{"sphere", sphere_of_two_parts, {.max_sweeps = 3}},
        RankCase{"periodic", periodic_of_two_parts, {.max_sweeps = 3}},
        RankCase{"accuracy", plane_of_two_parts, {.objective = Objective::accuracy, .max_sweeps = 3}},
        RankCase{"repair", plane_of_two_parts, {.repair = Repair::vertices, .repair_trials = 40, .max_sweeps = 6}}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(Together, RanksStopWhenTheFirstIsToldTo) {
  const Mesh input = *random_mesh({.vertices = 2500, .seed = 9});
  std::array<Mesh, 3> ends;
  on_ranks(ends.size(), [&](Communicator& all) {
    StdThreads crew(2);
    int calls = 0;
    const Observer observer = [&](const Progress&) {
      EXPECT_EQ(all.rank(), 0u);
      return ++calls == 10 ? Continue::no : Continue::yes;
    };
    const SweptMesh result =
        swept(input, {}, kSmallPart, {.executor = &crew, .communicator = &all, .observer = observer});
    EXPECT_EQ(calls, all.rank() == 0 ? 10 : 0);
    EXPECT_EQ(result.report.stopped, Stopped::canceled);
    EXPECT_EQ(result.mesh.validate(), std::nullopt);
    ends[all.rank()] = result.mesh;
  });
  EXPECT_TRUE(ends[1] == ends[0] && ends[2] == ends[0]);
}

TEST(Together, RanksThatAreGivenDifferentThingsAllSaySo) {
  const Mesh input = mesh_with_regions(kPartsVertices, 3);
  const auto differing = [&](Mesh mesh, const OptimizeOptions& options, Communicator& all) {
    const Mesh before = mesh;
    const auto report = optimize(mesh, options, {.communicator = &all});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::rank_mismatch);
    EXPECT_NE(report.error().what().find("rank 2 "), std::string::npos) << report.error().what();
    EXPECT_TRUE(mesh == before);
  };
  on_ranks(3, [&](Communicator& all) { differing(input, {.max_sweeps = all.rank() == 2 ? 3 : 4}, all); });
  on_ranks(3, [&](Communicator& all) {
    Mesh other = input;
    if (all.rank() == 2) other.set_weight(VertexId(5), 1e-9);
    differing(other, {}, all);
  });
}

// --- cuts into parts -----------------------------------------------------------------------------

struct PartitionCase {
  const char* name;
  Mesh (*make)();
};

class Partitions : public testing::TestWithParam<PartitionCase> {};

TEST_P(Partitions, LeaveNoneOrFewVerticesOutsideOfAllParts) {
  constexpr std::size_t kParts = 6;
  const Mesh mesh = hilbert_ordered(GetParam().make()).mesh;
  const std::size_t n = mesh.n_vertices();
  const Partition numbers{n, kParts};
  StdThreads crew(3);
  ShiftedPartitions cuts;
  cuts.cut(mesh, kParts, crew);
  ASSERT_EQ(cuts.n_parts(), kParts);
  EXPECT_TRUE(cuts.are_of(mesh));
  std::array<std::vector<std::size_t>, ShiftedPartitions::kPartitions> sizes;
  sizes.fill(std::vector<std::size_t>(kParts, 0));
  std::size_t in_order = 0, nowhere = 0;
  for (const VertexId v : mesh.vertices()) {
    bool confined = is_confined(mesh, v, numbers[v.index * kParts / n]);
    in_order += confined ? 0 : 1;
    for (std::size_t k = 0; k < ShiftedPartitions::kPartitions; ++k) {
      const std::size_t i = cuts.part_of(k, v);
      ASSERT_LT(i, kParts);
      ++sizes[k][i];
      EXPECT_TRUE(cuts.part(k, i).contains(v));
      EXPECT_FALSE(cuts.part(k, (i + 1) % kParts).contains(v));
      confined = confined || is_confined(mesh, v, cuts.part(k, i));
    }
    nowhere += confined ? 0 : 1;
  }
  EXPECT_GT(in_order, n / 20);
  EXPECT_LE(nowhere, n / 200);
  for (const auto& of_partition : sizes) {
    EXPECT_LT(*std::max_element(of_partition.begin(), of_partition.end()), 2 * n / kParts);
    EXPECT_GT(*std::min_element(of_partition.begin(), of_partition.end()), n / kParts / 2);
  }

  ShiftedPartitions alone;
  SerialExecutor one;
  alone.cut(mesh, kParts, one);
  for (const VertexId v : mesh.vertices()) {
    for (std::size_t k = 0; k < ShiftedPartitions::kPartitions; ++k)
      EXPECT_EQ(cuts.part_of(k, v), alone.part_of(k, v)) << "threads";
  }
  cuts.clear();
  EXPECT_FALSE(cuts.are_of(mesh));
}

Mesh points_in_plane() { return *random_mesh({.vertices = 24000, .seed = 4}); }
Mesh points_of_many_sizes() { return *graded_mesh({.finest = 0.002, .growth = 0.03, .seed = 4}); }
Mesh points_on_sphere() { return *random_sphere({.vertices = 24000, .seed = 4}); }
Mesh points_around_both_ways() { return *random_periodic({.vertices = 24000, .seed = 4, .period = {2, 1}}); }
Mesh channel() { return *periodic_hexagons({.nx = 160, .ny = 150, .channel = true}); }

INSTANTIATE_TEST_SUITE_P(Spaces, Partitions,
                         testing::Values(PartitionCase{"plane", points_in_plane},
                                         PartitionCase{"graded", points_of_many_sizes},
                                         PartitionCase{"sphere", points_on_sphere},
                                         PartitionCase{"periodic", points_around_both_ways},
                                         PartitionCase{"channel", channel}),
                         [](const auto& one) { return std::string(one.param.name); });

// --- what one part touches -----------------------------------------------------------------------

bool is_inner(const Mesh& mesh, TriangleId t, const Part& part) {
  const auto [a, b, c] = mesh.corners(t);
  return part.contains(a) && part.contains(b) && part.contains(c);
}

bool has_corner_in(const Mesh& mesh, TriangleId t, const Part& part) {
  const auto [a, b, c] = mesh.corners(t);
  return part.contains(a) || part.contains(b) || part.contains(c);
}

/// Improves the part's vertices three times. Returns the number of vertices that were left.
std::size_t improve_part(WorkingCopy& work, const Settings& settings, const Part& part) {
  const SweepState state(settings);
  const Recorder recorder(settings.hooks.tracer, work, 1);
  VertexLimits limits(work, settings, work.units);
  Improver improver({work.mesh, settings, state, work.units, limits, recorder});
  std::vector<VertexId> vertices, left;
  for (const VertexId v : work.mesh.vertices()) {
    if (part.contains(v)) vertices.push_back(v);
  }
  for (int sweep = 0; sweep < 3; ++sweep) {
    improver.step().begin_sweep(sweep, settings.options.unknowns);
    improver.improve(vertices, part, left);
  }
  EXPECT_GT(improver.flipper().take_changes().flips, 0u);
  return left.size();
}

struct OnePart {
  OnePart(const Mesh& input, const OptimizeOptions& options)
      : work(input, SweepOrder::hilbert), settings(*make_settings(options, work.mesh, work.units)) {
    settings.model.gamma = {0.3, LengthScale::relative};
    SerialExecutor executor;
    cuts.cut(work.mesh, 3, executor);
  }
  /// A part of the numbers, or of a shifted cut.
  [[nodiscard]] Part part(bool shifted) const { return shifted ? cuts.part(1, 1) : Part{VertexId(300), VertexId(700)}; }
  WorkingCopy work;
  Settings settings;
  ShiftedPartitions cuts;
};

std::vector<OptimizeOptions> ways_to_step() {
  return {{},
          {.paper = {.solver = Solver::alternating}},
          {.energy = EnergyKind::T},
          {.energy = EnergyKind::F, .paper = {.solver = Solver::golden, .flip_limit = FlipLimit::unlimited}}};
}

std::vector<std::pair<OptimizeOptions, bool>> ways_to_step_in_parts() {
  std::vector<std::pair<OptimizeOptions, bool>> ways;
  for (const OptimizeOptions& options : ways_to_step()) {
    for (const bool shifted : {false, true}) ways.emplace_back(options, shifted);
  }
  return ways;
}

void expect_same_outside(const Mesh& before, const Mesh& after, const Part& part) {
  for (const VertexId v : before.vertices()) {
    if (part.contains(v)) continue;
    EXPECT_EQ(after.point(v), before.point(v));
    EXPECT_EQ(after.outgoing(v), before.outgoing(v));
  }
  for (const HalfedgeId h : before.halfedges()) {
    const bool inner = is_inner(before, Mesh::triangle(h), part);
    EXPECT_EQ(is_inner(after, Mesh::triangle(h), part), inner);
    if (!inner) {
      EXPECT_EQ(after.origin(h), before.origin(h));
    }
    if (part.contains(before.origin(h)) && part.contains(before.target(h))) continue;
    EXPECT_EQ(after.twin(h), before.twin(h));
    EXPECT_EQ(after.is_constrained(h), before.is_constrained(h));
  }
}

TEST(OnePart, ChangesNothingOutside) {
  for (const auto& [options, shifted] : ways_to_step_in_parts()) {
    OnePart one(mesh_with_regions(1000, 11), options);
    const Mesh before = one.work.mesh;
    const std::size_t left = improve_part(one.work, one.settings, one.part(shifted));
    EXPECT_GT(left, 0u);
    EXPECT_LT(left, 3u * 300u);
    EXPECT_EQ(one.work.mesh.validate(), std::nullopt);
    expect_same_outside(before, one.work.mesh, one.part(shifted));
  }
}

TEST(OnePart, UndoesAStepWhoseFlipsWouldLeaveIt) {
  constexpr std::size_t kTiny = 60;  // vertices: cascades of flips come to its rim
  OnePart one(*random_mesh({.vertices = 3000, .seed = 13}),
              {.energy = EnergyKind::T, .paper = {.flip_limit = FlipLimit::unlimited}});
  Mesh& mesh = one.work.mesh;
  const Recorder recorder(one.settings.hooks.tracer, one.work, 1);
  VertexLimits limits(one.work, one.settings, one.work.units);
  const SweepState state(one.settings);
  Improver improver({mesh, one.settings, state, one.work.units, limits, recorder});
  improver.step().begin_sweep(0, one.settings.options.unknowns);
  std::size_t escapes = 0;
  for (std::size_t first = 0; first + kTiny <= mesh.n_vertices(); first += kTiny) {
    const Part part{VertexId(first), VertexId(first + kTiny)};
    const Mesh before = mesh;
    std::vector<VertexId> confined, left;
    for (std::size_t i = first; i < first + kTiny; ++i) {
      if (is_confined(mesh, VertexId(i), part)) confined.push_back(VertexId(i));
    }
    improver.improve(confined, part, left);
    for (const VertexId v : left) escapes += is_confined(mesh, v, part) ? 1 : 0;
    expect_same_outside(before, mesh, part);
  }
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_GT(escapes, 0u);
}

TEST(OnePart, DoesNotSeeWhatOtherPartsMayChange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [options, shifted] : ways_to_step_in_parts()) {
    OnePart seen(mesh_with_regions(1000, 12), options), blind = seen;
    const Part part = seen.part(shifted);
    Mesh& mesh = blind.work.mesh;
    for (const HalfedgeId h : mesh.halfedges()) {
      const bool an_end = part.contains(seen.work.mesh.origin(h)) || part.contains(seen.work.mesh.target(h));
      if (!an_end) MeshEditor(mesh).link(h, HalfedgeId());
    }
    for (const TriangleId t : seen.work.mesh.triangles()) {
      if (has_corner_in(seen.work.mesh, t, part)) continue;
      for (int k = 0; k < 3; ++k) MeshEditor(mesh).set_corner(Mesh::halfedge(t, k), VertexId());
    }
    for (const VertexId v : mesh.vertices()) {
      if (part.contains(v)) continue;
      mesh.set_point(v, {kNan, kNan, kNan});
      MeshEditor(mesh).set_outgoing(v, HalfedgeId());
    }
    EXPECT_EQ(improve_part(blind.work, blind.settings, part), improve_part(seen.work, seen.settings, part));
    for (const VertexId v : mesh.vertices()) {
      if (!part.contains(v)) continue;
      EXPECT_EQ(mesh.point(v), seen.work.mesh.point(v));
      EXPECT_EQ(mesh.outgoing(v), seen.work.mesh.outgoing(v));
    }
  }
}

}  // namespace
}  // namespace temper::test
