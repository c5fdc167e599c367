// The accuracy objective: its energy falls, margins hold after every sweep, fixed vertices stay, and the number of
// threads does not matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "energy/whole_mesh.hpp"
#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/stages/driver.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

OptimizeOptions for_accuracy() {
  OptimizeOptions o;
  o.objective = Objective::accuracy;
  o.scheme = Scheme::stars;
  o.accuracy.margin = 0.02;
  return o;
}

OptimizeReport improved(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks = {}) {
  auto report = optimize(mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  return report ? *std::move(report) : OptimizeReport{};
}

/// Well-centered with all margins, but uneven.
Mesh ready_mesh() { return lattice({.n = 8, .jitter = 0.1, .weight = 0.06, .seed = 4}); }

std::size_t sweeps_for(const OptimizeReport& report, Objective objective) {
  return static_cast<std::size_t>(std::count_if(report.history.begin(), report.history.end(), [&](const auto& r) {
    return r.objective == objective && r.sweep > 0;
  }));
}

void expect_inside(const Mesh& mesh, double margin) {
  const Quality q = quality(mesh);
  EXPECT_EQ(q.well_centered_fraction, 1);
  EXPECT_EQ(q.non_regular_edges, 0u);
  EXPECT_GE(q.min_h_over_l, margin);
  EXPECT_GE(q.min_d_over_l, margin);
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

bool same_bits(const WeightedPoint& a, const WeightedPoint& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(Accuracy, NeverRaisesTheEnergyOfAMeshWithAllMarginsAndKeepsItsEdges) {
  for (const Star star : {Star::zero, Star::one, Star::two, Star::all}) {
    OptimizeOptions o = for_accuracy();
    o.star = star;
    Mesh mesh = ready_mesh();
    const Mesh before = mesh;
    ASSERT_TRUE(has_margins(mesh, *o.accuracy.margin));
    const OptimizeReport report = improved(mesh, o);
    EXPECT_LT(report.objective_after, 0.99 * report.objective_before);
    EXPECT_EQ(sweeps_for(report, Objective::energy), 0u);
    EXPECT_GT(sweeps_for(report, Objective::accuracy), 0u);
    EXPECT_EQ(report.history.front().objective, Objective::accuracy);
    EXPECT_NEAR(report.history.front().energy / report.objective_before, 1, 1e-12);
    double least = report.objective_before;  // near a minimum the energy may rise again, for the barrier
    for (const SweepRecord& record : report.history) least = std::min(least, record.energy);
    EXPECT_NEAR(least / report.objective_after, 1, 1e-12);
    EXPECT_EQ(report.flips, 0u);
    for (const HalfedgeId h : mesh.halfedges()) EXPECT_EQ(mesh.origin(h), before.origin(h));
    expect_inside(mesh, *o.accuracy.margin);
  }
}

/// The least lengths of interior edges and of their duals, over the local sizes.
RelativeLengths least_lengths(const Mesh& mesh) {
  const auto sizes = local_sizes(mesh);
  RelativeLengths least{kInfinity, kInfinity};
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) continue;
    const auto [edge, dual] = relative_lengths(mesh, sizes, h);
    least.edge = std::min(least.edge, edge);
    least.dual = std::min(least.dual, dual);
  }
  return least;
}

TEST(Accuracy, MakesEdgesAndDualsAsLongAsIsAskedFor) {
  constexpr double kEdge = 0.65, kDual = 0.25;
  for (const Mesh& input : {*random_mesh({.vertices = 300, .seed = 2}), *annulus(), *airfoil()}) {
    for (const Scheme scheme : {Scheme::all, Scheme::vertex}) {
      OptimizeOptions o;
      o.scheme = scheme;
      Mesh without = input, with = input;
      improved(without, o);
      o.accuracy.min_edge = kEdge, o.accuracy.min_dual = kDual;
      improved(with, o);
      const auto [edge, dual] = least_lengths(with);
      EXPECT_GE(edge, kEdge);
      EXPECT_GE(dual, kDual);
      EXPECT_LT(std::min(least_lengths(without).edge / kEdge, least_lengths(without).dual / kDual), 1);
      expect_inside(with, scheme == Scheme::all ? 0.05 : 0.02);
    }
  }
}

TEST(Accuracy, OfOneSchemeBeginsWithSweepsOfOdtWhereThereAreNoWeights) {
  const Mesh input = *random_mesh({.vertices = 300, .seed = 2});
  const auto made_by = [](Mesh mesh, OptimizeOptions o) {
    o.objective = Objective::accuracy;
    improved(mesh, o);
    return mesh;
  };
  OptimizeOptions said, stars, at_once, all;
  for (OptimizeOptions* o : {&said, &stars, &at_once}) o->scheme = Scheme::stars;
  said.paper.first_energy = EnergyKind::ODT, said.paper.switch_at = 10;
  at_once.paper.first_energy = EnergyKind::ODT, at_once.paper.switch_at = 0;
  EXPECT_EQ(made_by(input, stars), made_by(input, said));
  EXPECT_NE(made_by(input, stars), made_by(input, at_once));
  EXPECT_NE(made_by(input, all), made_by(input, at_once));
  Mesh weighted = input;
  weighted.set_weight(VertexId(7), 1e-6);
  at_once.paper.first_energy.reset();
  EXPECT_EQ(made_by(weighted, stars), made_by(weighted, at_once));
  const Mesh ready = ready_mesh();  // has its margins: the second phase begins at once
  EXPECT_EQ(made_by(ready, stars), made_by(ready, at_once));
}

TEST(Accuracy, KeepsMarginsAfterEverySweepAndTheBoundaryBitForBit) {
  Mesh mesh = *random_mesh({.vertices = 300, .seed = 2});
  const Mesh before = mesh;
  int looks = 0;
  OptimizeOptions o = for_accuracy();
  OptimizeHooks hooks;
  hooks.snapshots = [&](const Snapshot& shot) {
    if (!has_margins(shot.mesh, *o.accuracy.margin)) {
      EXPECT_EQ(looks, 0) << "lost after sweep " << shot.sweep;
      return;
    }
    expect_inside(shot.mesh, *o.accuracy.margin);
    ++looks;
  };
  const OptimizeReport report = improved(mesh, o, hooks);
  EXPECT_GT(sweeps_for(report, Objective::energy), 0u);
  EXPECT_GT(looks, 10);
  EXPECT_GE(static_cast<std::size_t>(looks), sweeps_for(report, Objective::accuracy));
  expect_inside(mesh, *o.accuracy.margin);
  std::size_t compared = 0;
  for (const VertexId v : mesh.vertices()) {
    if (!before.is_boundary(v)) continue;
    const Vec2 p = before.position(v), q = mesh.position(v);
    EXPECT_EQ(std::memcmp(&p, &q, sizeof p), 0);
    ++compared;
  }
  EXPECT_GT(compared, 10u);
  EXPECT_EQ(report.objective, Objective::accuracy);
  EXPECT_LT(report.objective_after, report.objective_before);
}

TEST(Accuracy, LeavesAMinimumAsItIs) {
  Mesh mesh = ready_mesh();
  OptimizeOptions o = for_accuracy();
  const std::vector<double> ones(mesh.n_vertices(), 1.0);
  o.size_field = *SizeField::from_values(mesh, ones);  // the same both times
  o.accuracy.sweeps = 500;
  o.accuracy.tolerance = 1e-13;
  const OptimizeReport first = improved(mesh, o);
  EXPECT_EQ(first.stopped, Stopped::converged);
  const Mesh there = mesh;
  const OptimizeReport second = improved(mesh, o);
  EXPECT_NEAR(second.objective_after / first.objective_after, 1, 1e-9);
  for (const VertexId v : mesh.vertices()) {
    EXPECT_NEAR(mesh.point(v).x, there.point(v).x, 1e-4);
    EXPECT_NEAR(mesh.point(v).y, there.point(v).y, 1e-4);
    EXPECT_NEAR(mesh.point(v).w, there.point(v).w, 1e-4);
  }
}

TEST(Accuracy, KnowsNoUnitOfLength) {
  Mesh mesh = ready_mesh(), large = mesh;
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    large.set_point(v, {0x1p10 * p.x, 0x1p10 * p.y, 0x1p20 * p.w});
  }
  const OptimizeReport a = improved(mesh, for_accuracy()), b = improved(large, for_accuracy());
  EXPECT_EQ(0x1p20 * a.objective_after, b.objective_after);
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    EXPECT_TRUE(same_bits({0x1p10 * p.x, 0x1p10 * p.y, 0x1p20 * p.w}, large.point(v)));
  }
}

TEST(Accuracy, MovesWhatItMayAndNothingElse) {
  const Mesh before = ready_mesh();
  const auto count = [&](const Mesh& mesh) {
    struct Changes {
      int positions = 0, weights = 0, fixed = 0;
    } n;
    for (const VertexId v : mesh.vertices()) {
      const bool moved = mesh.position(v) != before.position(v);
      n.positions += moved ? 1 : 0;
      n.weights += mesh.weight(v) != before.weight(v) ? 1 : 0;
      n.fixed += moved && v.index % 3 == 0 ? 1 : 0;
    }
    return n;
  };
  OptimizeOptions o = for_accuracy();
  Mesh mesh = before;
  o.unknowns = Unknowns::weights;
  const OptimizeReport by_weights = improved(mesh, o);
  EXPECT_LT(by_weights.objective_after, by_weights.objective_before);
  EXPECT_EQ(count(mesh).positions, 0);
  EXPECT_GT(count(mesh).weights, 0);

  mesh = before;
  o.unknowns = Unknowns::positions;
  const OptimizeReport by_positions = improved(mesh, o);
  EXPECT_LT(by_positions.objective_after, by_positions.objective_before);
  EXPECT_GT(count(mesh).positions, 0);
  EXPECT_EQ(count(mesh).weights, 0);

  mesh = before;
  o.unknowns = Unknowns::positions_and_weights;
  for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, v.index % 3 == 0);
  improved(mesh, o);
  EXPECT_GT(count(mesh).positions, 0);
  EXPECT_EQ(count(mesh).fixed, 0);

  mesh = before;
  o.paper.anchor = VertexId(5);
  improved(mesh, o);
  EXPECT_EQ(mesh.weight(VertexId(5)), 0);
}

TEST(Accuracy, SlidesBoundaryVerticesAlongTheirLinesOnly) {
  Mesh mesh = ready_mesh();
  const Mesh before = mesh;
  OptimizeOptions o = for_accuracy();
  o.boundary = BoundaryVertices::slide;
  const OptimizeReport report = improved(mesh, o);
  EXPECT_LT(report.objective_after, report.objective_before);
  expect_inside(mesh, *o.accuracy.margin);
  int slid = 0;
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) continue;
    slid += mesh.position(v) != before.position(v) ? 1 : 0;
    if (before.position(v).y == 0) {
      EXPECT_EQ(mesh.position(v).y, 0);
    }
  }
  EXPECT_GT(slid, 4);
}

TEST(Accuracy, HoldsASizeBand) {
  Mesh mesh = ready_mesh();
  const Mesh before = mesh;
  OptimizeOptions o = for_accuracy();
  const OptimizeReport free = improved(mesh, o);
  ASSERT_GT(free.size.after.band(), 1.03);
  mesh = before;
  o.size_band = 1.03;
  const OptimizeReport held = improved(mesh, o);
  EXPECT_LE(held.size.after.band(), 1.03 + 1e-12);
  EXPECT_LT(held.objective_after, held.objective_before);
}

/// The second phase alone, with small parts.
Mesh second_phase(const Mesh& input, const OptimizeOptions& options, std::size_t part_size,
                  const OptimizeHooks& hooks = {}) {
  WorkingCopy work(input, options.paper.order);
  const Settings settings = *make_settings(options, work.mesh, work.units, hooks);
  Run run(options, hooks, input);
  AccuracySizes sizes(input, {}, options.size_field, hooks.executor);
  AccuracyPhase phase(work, settings, run, sizes.lend(work, hooks.executor));
  Driver(work, phase.settings(), phase.state(), run, part_size).run(phase, 0);
  EXPECT_GT(run.report.sweeps, 0);
  return std::move(work).in_user_terms();
}

class AccuracyBlocksBackwards final : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    for (std::size_t i = n; i > 0; --i) block(i - 1);
  }
};

TEST(Accuracy, HasTheSameBytesForAnyNumberOfThreads) {
  Mesh mesh = mesh_with_regions(1500, 3);  // enough for batches
  OptimizeOptions o = for_accuracy();
  improved(mesh, {});
  o.accuracy.margin = 0.005;
  o.accuracy.sweeps = 6;
  ASSERT_EQ(count_bad(mesh, nullptr), 0u);
  const Mesh alone = second_phase(mesh, o, 100);
  EXPECT_NE(alone, mesh);
  EXPECT_NE(alone, second_phase(mesh, o, 1000)) << "parts are not seen: nothing was tested";
  for (const std::size_t n : {1, 2, 3, 8}) {
    StdThreads threads(n);
    OptimizeHooks hooks;
    hooks.executor = &threads;
    EXPECT_TRUE(second_phase(mesh, o, 100, hooks) == alone) << n << " threads";
    EXPECT_GT(threads.runs(), 0u);
  }
  AccuracyBlocksBackwards backwards;
  OptimizeHooks hooks;
  hooks.executor = &backwards;
  EXPECT_TRUE(second_phase(mesh, o, 100, hooks) == alone);
  std::size_t events = 0;
  hooks.tracer = [&](const TraceEvent&) { ++events; };
  EXPECT_TRUE(second_phase(mesh, o, 100, hooks) == alone) << "traced";
  EXPECT_GT(events, mesh.n_vertices());
}

TEST(Accuracy, IsReplayedByItsTrace) {
  for (const bool ready : {true, false}) {
    const Mesh input = ready ? ready_mesh() : *random_mesh({.vertices = 120, .seed = 6});
    Mesh mesh = input;
    OptimizeOptions o = for_accuracy();
    std::vector<TraceEvent> events;
    OptimizeHooks hooks;
    hooks.tracer = [&](const TraceEvent& event) { events.push_back(event); };
    improved(mesh, o, hooks);
    const auto again = replay(input, events);
    ASSERT_TRUE(again) << again.error().what();
    EXPECT_TRUE(*again == mesh);
  }
}

TEST(Accuracy, CountsSweepsOfBothPhasesAndStopsWhereItIsTold) {
  const Mesh input = *random_mesh({.vertices = 200, .seed = 8});
  OptimizeOptions o = for_accuracy();
  Mesh mesh = input;
  const OptimizeReport whole = improved(mesh, o);
  const int first = static_cast<int>(sweeps_for(whole, Objective::energy));
  EXPECT_EQ(static_cast<std::size_t>(whole.sweeps),
            sweeps_for(whole, Objective::energy) + sweeps_for(whole, Objective::accuracy));

  mesh = input;
  o.max_sweeps = first + 3;
  const OptimizeReport cut = improved(mesh, o);
  EXPECT_EQ(cut.stopped, Stopped::max_sweeps);
  EXPECT_EQ(cut.sweeps, first + 3);
  EXPECT_EQ(sweeps_for(cut, Objective::accuracy), 3u);
  expect_inside(mesh, *o.accuracy.margin);

  mesh = input;
  o = for_accuracy();
  o.accuracy.sweeps = 2;
  o.accuracy.tolerance = 0;
  EXPECT_EQ(improved(mesh, o).stopped, Stopped::sweep_limit);

  mesh = input;
  o = for_accuracy();
  const OptimizeReport canceled =
      improved(mesh, o, {.observer = [](const Progress& progress) {
                 return progress.last.objective == Objective::accuracy ? Continue::no : Continue::yes;
               }});
  EXPECT_EQ(canceled.stopped, Stopped::canceled);
  EXPECT_LE(sweeps_for(canceled, Objective::accuracy), 2u);
  expect_inside(mesh, *o.accuracy.margin);
}

/// One corner triangle has all its vertices on the boundary and is obtuse. Only flips or weights could repair it.
Mesh hopeless_mesh() {
  Mesh mesh = lattice({.n = 7, .jitter = 0.05, .weight = 0});
  mesh.set_point(VertexId(0), {0.5, 0.3, 0});
  return mesh;
}

TEST(Accuracy, WorksAroundWhatCannotBeWellCentered) {
  Mesh mesh = hopeless_mesh();
  const Mesh before = mesh;
  const std::size_t bad = count_bad(mesh, nullptr);
  OptimizeOptions o = for_accuracy();
  o.repair = Repair::none;
  o.unknowns = Unknowns::positions;
  o.flips = Flips::none;
  Mesh by_energy = mesh;
  OptimizeOptions energy = o;
  energy.objective = Objective::energy;
  improved(by_energy, energy);
  const std::size_t left = count_bad(by_energy, nullptr);
  const OptimizeReport report = improved(mesh, o);
  EXPECT_GT(sweeps_for(report, Objective::accuracy), 0u);
  EXPECT_LE(count_bad(mesh, nullptr), left);
  EXPECT_LE(left, bad);
  ASSERT_GT(left, 0u);
  EXPECT_TRUE(std::any_of(report.notes.begin(), report.notes.end(), [](const std::string& note) {
    return note.find("vertices there were not moved for accuracy") != std::string::npos;
  }));
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
}

TEST(Accuracy, SizesAreSmoothedAndGoWithTheirVertices) {
  const Mesh mesh = *graded_mesh({.finest = 1.0 / 16});
  const AccuracySizes sizes(mesh, {}, {}, nullptr);
  ASSERT_EQ(sizes.of_input().size(), mesh.n_vertices());
  double rough = 0, smooth = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    rough = std::max(rough, local_size(mesh, a) / local_size(mesh, b));
    smooth = std::max(smooth, sizes.of_input()[a] / sizes.of_input()[b]);
  }
  EXPECT_LT(smooth, rough);
  EXPECT_GT(smooth, 1);
  WorkingCopy work(mesh, SweepOrder::hilbert);
  const VertexSizes here = sizes.of(work, nullptr), back = AccuracySizes(sizes).in_user_terms(work, nullptr);
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(here[v] * work.units.scale, sizes.of_input()[work.order->vertices[v]]);
    EXPECT_EQ(back[v], sizes.of_input()[v]);
  }
  const AccuracySizes own(mesh, {}, input_size_field(mesh), nullptr);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(own.of_input()[v], sizes.of_input()[v]) << "the same field";
  const std::vector<double> twos(mesh.n_vertices(), 2.0);
  const AccuracySizes even(mesh, {}, *SizeField::from_values(mesh, twos), nullptr);
  for (const VertexId v : mesh.vertices()) EXPECT_NEAR(even.of_input()[v], 2, 1e-14);
}

std::string refusal_of(OptimizeOptions options) {
  options.objective = Objective::accuracy;
  Mesh mesh = lattice();
  const Mesh before = mesh;
  const auto report = optimize(mesh, options);
  if (report) return "no error";
  EXPECT_EQ(mesh, before);
  return report.error().what();
}

TEST(Accuracy, SizesThatWereLentAreWhatTheyWere) {
  const auto mesh = random_mesh({.vertices = 500, .seed = 3});
  ASSERT_TRUE(mesh);
  AccuracySizes sizes(*mesh, {}, {}, nullptr);
  const VertexSizes before = sizes.of_input();
  const WorkingCopy work(*mesh, SweepOrder::hilbert);
  const VertexSizes own = sizes.of(work, nullptr);
  VertexSizes lent = sizes.lend(work, nullptr);
  EXPECT_EQ(lent, own);
  EXPECT_TRUE(sizes.of_input().empty());
  sizes.take_back(std::move(lent));
  EXPECT_EQ(sizes.of(work, nullptr), own);
  EXPECT_EQ(sizes.lend(work, nullptr), own) << "again";
  sizes.take_back(own);
  EXPECT_EQ(std::move(sizes).in_user_terms(work, nullptr), before);
}

TEST(Accuracy, FloorsThatAllTrianglesHaveTakeNoRoomAndAreTheSame) {
  const Mesh mesh = ready_mesh();
  constexpr double kMargin = 0.01;
  ASSERT_TRUE(has_margins(mesh, kMargin));
  double least = 1;
  for (const TriangleId t : mesh.triangles()) least = std::min(least, triangle_margin(mesh, t));
  for (const double margin : {kMargin, 2 * least}) {  // all of them, and not all
    AccuracyFloors floors;
    EXPECT_EQ(floors.raise(mesh, margin), mesh.n_triangles());
    for (const TriangleId t : mesh.triangles()) {
      const double has = triangle_margin(mesh, t);
      EXPECT_EQ(floors[t], has > margin ? margin : 0.9 * has);
    }
    const std::size_t of_each = mesh.n_triangles() * sizeof(double);
    EXPECT_EQ(floors.memory_bytes() < of_each, margin == kMargin);
    EXPECT_EQ(floors.raise(mesh, margin), 0u);
  }
}

TEST(Accuracy, OptionsOutOfRangeAreRefusedByName) {
  const auto with = [](auto set) {
    OptimizeOptions o;
    set(o);
    return refusal_of(o);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(with([](OptimizeOptions&) {}), "no error");
  EXPECT_EQ(with([](OptimizeOptions& o) { o.accuracy.offset_factor = -1; }),
            "`offset_factor` is -1; expected at least 0, or auto");
  EXPECT_EQ(with([&](OptimizeOptions& o) { o.accuracy.boundary_offset_factor = nan; }),
            "`boundary_offset_factor` is nan; expected at least 0, or auto");
  EXPECT_EQ(with([](OptimizeOptions& o) { o.accuracy.margin = 0; }),
            "`margin` is 0; expected more than 0 and less than 0.25, or auto");
  EXPECT_EQ(with([](OptimizeOptions& o) { o.accuracy.margin = 0.25; }),
            "`margin` is 0.25; expected more than 0 and less than 0.25, or auto");
  EXPECT_EQ(with([](OptimizeOptions& o) { o.accuracy.barrier = 0; }), "`barrier` is 0; expected more than 0");
  EXPECT_EQ(with([](OptimizeOptions& o) { o.accuracy.sweeps = -1; }), "`accuracy_sweeps` is -1; expected at least 0");
  EXPECT_EQ(with([&](OptimizeOptions& o) { o.accuracy.tolerance = nan; }),
            "`accuracy_tolerance` is nan; expected at least 0");
  EXPECT_EQ(with([](OptimizeOptions& o) { o.energy = EnergyKind::F; }),
            "`objective=accuracy` begins with an energy that makes triangles well-centered, which F does not; expected "
            "`energy=BP`, `energy=BHs` or `energy=BH`");
  EXPECT_EQ(with([](OptimizeOptions& o) {
              o.flips = Flips::deferred;
              o.paper.inversion = Inversion::allow;
            }),
            "`objective=accuracy` needs `inversion=refuse`: its second phase is for well-centered triangles");
}

}  // namespace
}  // namespace temper::test
