// The paper's switches: inner and outer iterations, collapses, the patch test, deferred weights, hidden vertices,
// orders, snapshots.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "property/mesh_of_random_points.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

Mesh three_hundred_points(std::uint64_t seed = 1) {
  auto mesh = random_mesh({.vertices = 300, .seed = seed});
  EXPECT_TRUE(mesh);
  return *std::move(mesh);
}

Mesh dense() { return *horseshoe(); }

/// Boundary vertices with their places, in order.
std::vector<Vec2> boundary(const Mesh& mesh) {
  std::vector<Vec2> places;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) places.push_back(mesh.position(v));
  }
  return places;
}

OptimizeOptions dense_positions() {
  OptimizeOptions o = *options_for("paper");
  o.energy = EnergyKind::dT;
  o.unknowns = Unknowns::positions;
  o.paper.inversion = Inversion::refuse;
  o.paper.removal = Removal::none;
  o.max_sweeps = 60;
  return o;
}

TEST(PaperMethod, IsAlgorithm1) {
  Mesh mesh = dense();
  const auto report = optimize(mesh, *options_for("paper"));
  ASSERT_TRUE(report) << report.error().what();
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_GT(report->vertices_removed, 10u);
  EXPECT_EQ(mesh.n_vertices() + report->vertices_removed, 63u);
  EXPECT_LT(report->objective_after, report->objective_before);
}

TEST(Collapses, KeepDomainRegularityAndTheOtherNames) {
  const Mesh input = dense();
  Mesh mesh = input;
  OptimizeOptions o = dense_positions();
  o.flips = Flips::immediate;
  o.paper.flip_limit = FlipLimit::after;
  const auto report = optimize(mesh, o);
  ASSERT_TRUE(report);
  EXPECT_GT(report->vertices_removed, 0u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  EXPECT_EQ(boundary(mesh), boundary(input));
  EXPECT_NEAR(area(mesh), area(input), 1e-12);
  ASSERT_EQ(report->vertices.size(), mesh.n_vertices());
  EXPECT_TRUE(std::is_sorted(report->vertices.begin(), report->vertices.end()));
  for (const VertexId v : mesh.vertices()) {
    const VertexId old = report->vertices[v];
    if (input.is_boundary(old)) {
      EXPECT_EQ(mesh.position(v), input.position(old));
    }
    EXPECT_EQ(mesh.is_boundary(v), input.is_boundary(old));
  }
}

TEST(Collapses, BeginWithTheirSweep) {
  OptimizeOptions o = dense_positions();
  o.paper.collapse_from = 3;
  std::vector<std::size_t> vertices;
  OptimizeHooks hooks;
  hooks.snapshots = [&](const Snapshot& s) {
    if (s.moment == Snapshot::Moment::after_sweep) vertices.push_back(s.mesh.n_vertices());
  };
  Mesh mesh = dense();
  ASSERT_TRUE(optimize(mesh, o, hooks));
  ASSERT_GT(vertices.size(), 4u);
  EXPECT_EQ(vertices[2], 63u);
  EXPECT_LT(vertices[3], 63u);
}

TEST(Collapses, NeverWithoutTheSwitch) {
  OptimizeOptions o = dense_positions();
  o.paper.collapse_from = std::nullopt;
  Mesh mesh = dense();
  const auto report = optimize(mesh, o);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->vertices_removed, 0u);
  EXPECT_TRUE(report->vertices.empty());
  EXPECT_EQ(mesh.n_vertices(), 63u);
}

TEST(Collapses, AHigherRatioCollapsesMore) {
  std::vector<std::size_t> removed;
  for (const double ratio : {1e-6, 0.1, 0.5}) {
    OptimizeOptions o = dense_positions();
    o.paper.collapse_ratio = ratio;
    o.max_sweeps = 3;
    Mesh mesh = dense();
    const auto report = optimize(mesh, o);
    ASSERT_TRUE(report);
    removed.push_back(report->vertices_removed);
  }
  EXPECT_LT(removed[0], removed[1]);
  EXPECT_LT(removed[1], removed[2]);
}

TEST(Collapses, LeaveFixedVerticesAlone) {
  Mesh mesh = dense();
  for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, true);
  const Mesh input = mesh;
  OptimizeOptions o = *options_for("paper");
  o.paper.inversion = Inversion::refuse;
  ASSERT_TRUE(optimize(mesh, o));
  EXPECT_EQ(mesh.n_vertices(), input.n_vertices());
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.position(v), input.position(v));
}

TEST(Collapses, LeaveInterfacesAlone) {
  Mesh mesh = dense();
  std::vector<std::pair<Vec2, Vec2>> line;  // a path of inner edges, constrained
  for (const HalfedgeId h : mesh.halfedges()) {
    const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
    if (mesh.is_boundary(h) || std::abs(a.x) > 1e-9 || std::abs(b.x) > 1e-9 || a.y > b.y) continue;
    mesh.set_constrained(h, true);
    line.push_back({a, b});
  }
  ASSERT_GT(line.size(), 4u);
  OptimizeOptions o = *options_for("paper");
  o.paper.inversion = Inversion::refuse;
  const auto report = optimize(mesh, o);
  ASSERT_TRUE(report);
  EXPECT_GT(report->vertices_removed, 10u);
  std::size_t found = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const std::pair edge(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)));
    if (mesh.is_constrained(h)) found += static_cast<std::size_t>(std::count(line.begin(), line.end(), edge));
  }
  EXPECT_EQ(found, line.size());
}

TEST(PatchTest, SumGutsWhereMeanAndExcessSpare) {
  std::vector<std::size_t> left;
  for (const RemovalMeasure measure : {RemovalMeasure::sum, RemovalMeasure::mean, RemovalMeasure::excess}) {
    Mesh mesh = three_hundred_points();
    const auto report = optimize(mesh, {.max_sweeps = 40,
                                        .paper = {.gamma = LengthParameter{1, LengthScale::relative},
                                                  .removal = Removal::patch,
                                                  .removal_measure = measure,
                                                  .removal_from = 0}});
    ASSERT_TRUE(report);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
    left.push_back(mesh.n_vertices());
  }
  EXPECT_LT(2 * left[0], left[1]);
  EXPECT_LT(4 * left[0], 3 * left[2]);
}

TEST(PatchTest, AWiderMarginRemovesFewer) {
  std::vector<std::size_t> removed;
  for (const double margin : {0.0, 0.1, 0.3}) {
    Mesh mesh = three_hundred_points();
    const auto report = optimize(
        mesh, {.max_sweeps = 30, .paper = {.removal = Removal::patch, .removal_margin = margin, .removal_from = 5}});
    ASSERT_TRUE(report);
    removed.push_back(report->vertices_removed);
  }
  EXPECT_GT(removed[0], removed[1]);
  EXPECT_GT(removed[1], removed[2]);
}

TEST(OuterIterations, FlipOnlyWhenTheInnerOnesHaveConverged) {
  OptimizeOptions o = dense_positions();
  int before = 0, after = 0;
  std::size_t non_regular = 0;
  OptimizeHooks hooks;
  hooks.snapshots = [&](const Snapshot& s) {
    if (s.moment == Snapshot::Moment::before_flips) {
      ++before;
      non_regular += count_non_regular_edges(s.mesh);
    }
    if (s.moment == Snapshot::Moment::after_flips) {
      ++after;
      EXPECT_EQ(count_non_regular_edges(s.mesh), 0u);
    }
  };
  Mesh mesh = dense();
  const auto report = optimize(mesh, o, hooks);
  ASSERT_TRUE(report);
  EXPECT_EQ(before, after);
  EXPECT_GT(before, 3);
  EXPECT_LT(before, report->sweeps / 2);  // several sweeps each
  EXPECT_GT(non_regular, 0u);
}

TEST(OuterIterations, EndWithTheirNumber) {
  for (const int outer : {1, 3}) {
    OptimizeOptions o = dense_positions();
    o.paper.outer = outer;
    int rounds = 0;
    OptimizeHooks hooks;
    hooks.snapshots = [&](const Snapshot& s) { rounds += s.moment == Snapshot::Moment::after_flips ? 1 : 0; };
    Mesh mesh = dense();
    const auto report = optimize(mesh, o, hooks);
    ASSERT_TRUE(report);
    EXPECT_EQ(rounds, outer);
    EXPECT_EQ(report->stopped, Stopped::max_outer);
  }
}

TEST(OuterIterations, InnerOnesEndWithTheirNumber) {
  OptimizeOptions o = dense_positions();
  o.paper.inner = 2;
  o.max_sweeps = 10;
  std::vector<int> sweeps;
  OptimizeHooks hooks;
  hooks.snapshots = [&](const Snapshot& s) {
    if (s.moment == Snapshot::Moment::before_flips) sweeps.push_back(s.sweep);
  };
  Mesh mesh = dense();
  ASSERT_TRUE(optimize(mesh, o, hooks));
  ASSERT_GE(sweeps.size(), 2u);
  EXPECT_EQ(sweeps[0], 2);
  EXPECT_EQ(sweeps[1], 4);
}

TEST(DeferredWeights, DoNotDependOnTheOrderOfTheVertices) {
  std::vector<Mesh> results;
  for (const SweepOrder order : {SweepOrder::input, SweepOrder::reverse, SweepOrder::random}) {
    Mesh mesh = lattice({.n = 8, .jitter = 0.1, .weight = 0});
    ASSERT_TRUE(restore_regularity(mesh).regular());
    OptimizeOptions o = *options_for("paper");
    o.unknowns = Unknowns::weights;
    o.paper.weight_updates = Updates::deferred;
    o.paper.anchor = {};
    o.paper.collapse_from = std::nullopt;
    o.paper.removal = Removal::none;
    o.paper.order = order;
    o.max_sweeps = 1;
    ASSERT_TRUE(optimize(mesh, o));
    results.push_back(std::move(mesh));
  }
  EXPECT_TRUE(std::any_of(results[0].vertices().begin(), results[0].vertices().end(),
                          [&](VertexId v) { return results[0].weight(v) != 0; }));
  for (const VertexId v : results[0].vertices()) {
    // Weights are equal up to the order in which each patch is summed.
    EXPECT_NEAR(results[1].weight(v), results[0].weight(v), 1e-6);
    EXPECT_NEAR(results[2].weight(v), results[0].weight(v), 1e-6);
  }
}

/// A strip, whose vertices are all on the boundary and cannot be removed, and meshes with many vertices to hide.
std::vector<Mesh> meshes_to_hide_in() {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int32_t i = 0; i < 9; ++i) {
    points.insert(points.end(), {{1.0 * i, 0.0}, {1.0 * i, 1.0}});
    if (i < 8) triangles.insert(triangles.end(), {{2 * i, 2 * i + 2, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 1}});
  }
  return {Mesh::build({.points = points, .triangles = triangles})->mesh, dense(), three_hundred_points()};
}

// Lower HOT energies may make triangles bad. If hidden vertices stay, edges may stop being regular.
TEST(PaperMethod, SaysWhenMoreTrianglesAreBadOrEdgesNotRegular) {
  Mesh mesh = *random_mesh({.vertices = 130, .seed = 5});
  OptimizeOptions o = *options_for("paper");
  o.energy = EnergyKind::dT;
  o.paper.inversion = Inversion::refuse;
  o.max_sweeps = 100;
  const auto report = optimize(mesh, o);
  ASSERT_TRUE(report);
  EXPECT_GT(count_non_regular_edges(mesh, false), 0u);
  const auto says = [&](const char* text) {
    return std::any_of(report->notes.begin(), report->notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(says("of the triangles are bad (not well-centered)"));
  EXPECT_TRUE(says("not regular, since `hidden=keep`"));
}

// Runs that end early: deferred flips may find a hidden vertex that has to stay.
TEST(HiddenVertices, LeaveEdgesRegularAtTheEndUnlessTheyAreKept) {
  std::size_t runs = 0, stopped = 0, with_progress = 0;
  for (const Mesh& input : meshes_to_hide_in()) {
    for (const Unknowns unknowns : {Unknowns::weights, Unknowns::positions_and_weights}) {
      for (const HiddenPolicy policy : {HiddenPolicy::undo, HiddenPolicy::remove}) {
        for (const EnergyKind energy : {EnergyKind::BP, EnergyKind::T, EnergyKind::F}) {
          for (const int inner : {1, 3, 0}) {
            for (const int sweeps : {1, 2, 5, 20}) {
              OptimizeOptions o;
              o.energy = energy;
              o.unknowns = unknowns;
              o.flips = Flips::deferred;
              o.max_sweeps = sweeps;
              o.paper.inner = inner;
              o.paper.hidden = policy;
              Mesh mesh = input;
              const auto report = optimize(mesh, o);
              ASSERT_TRUE(report) << report.error().what();
              EXPECT_EQ(count_non_regular_edges(mesh, false), 0u)
                  << input.n_vertices() << " vertices, energy " << energy_info(energy).name << ", inner " << inner
                  << ", " << sweeps << " sweeps";
              EXPECT_EQ(mesh.validate(), std::nullopt);
              const bool hidden = report->stopped == Stopped::hidden;
              stopped += hidden ? 1 : 0;
              with_progress += hidden && report->objective_after < report->objective_before ? 1 : 0;
              ++runs;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(runs, 432u);
  EXPECT_GT(stopped, 10u);
  EXPECT_GT(with_progress, 0u);  // runs that had rounds before the failed one
}

// For barriers no best mesh is kept, since γ changes.
TEST(HiddenVertices, OfABarrierEndTheRunWithTheLastRoundThatWasRegular) {
  OptimizeOptions o;
  o.objective = Objective::energy;
  o.energy = EnergyKind::BP;
  o.flips = Flips::deferred;
  o.repair = Repair::none;
  o.max_sweeps = 12;
  o.paper.inner = 2;
  o.paper.solver = Solver::alternating;
  o.paper.weight_updates = Updates::deferred;
  OptimizeOptions all = o;
  o.paper.hidden = HiddenPolicy::remove;
  all.paper.hidden = HiddenPolicy::undo;
  all.paper.position_updates = Updates::deferred;
  all.paper.gamma = LengthParameter{1, LengthScale::relative};
  for (const auto& [input, options] : {std::pair(sparse_horseshoe(), o), {dense(), all}}) {
    Mesh mesh = input;
    const auto report = optimize(mesh, options);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->stopped, Stopped::hidden);
    EXPECT_LT(report->objective_after, report->objective_before);
    EXPECT_EQ(count_non_regular_edges(mesh, false), 0u);
    EXPECT_NE(mesh, input);
  }
}

// All weights of a sweep at once may hide a vertex that none of them hides alone.
TEST(DeferredWeights, LeaveEveryEdgeRegularWhereFlipsDoNotWait) {
  std::size_t sweeps = 0, set_twice = 0;
  for (const Mesh& input : meshes_to_hide_in()) {
    for (const HiddenPolicy policy : {HiddenPolicy::undo, HiddenPolicy::remove}) {
      for (const EnergyKind energy : {EnergyKind::BP, EnergyKind::T, EnergyKind::F}) {
        OptimizeOptions o{.energy = energy, .max_sweeps = 6, .paper = {.solver = Solver::alternating}};
        o.paper.weight_updates = Updates::deferred;
        o.paper.hidden = policy;
        OptimizeHooks hooks;
        hooks.snapshots = [&](const Snapshot& s) {
          EXPECT_EQ(count_non_regular_edges(s.mesh, false), 0u);
          ++sweeps;
        };
        std::set<std::pair<int, std::uint32_t>> set;
        std::vector<TraceEvent> events;
        hooks.tracer = [&](const TraceEvent& e) {
          events.push_back(e);
          if (e.kind == EventKind::weight && !set.emplace(e.sweep, e.vertex.index).second) ++set_twice;
        };
        Mesh mesh = input;
        ASSERT_TRUE(optimize(mesh, o, hooks));
        const auto again = replay(input, events);
        ASSERT_TRUE(again) << again.error().what();
        EXPECT_EQ(*again, mesh);
      }
    }
  }
  EXPECT_GT(sweeps, 60u);
  EXPECT_GT(set_twice, 0u);
}

TEST(HiddenVertices, AreKeptRemovedOrNeverThereByThePolicy) {
  std::size_t kept = 0, removed = 0;
  for (const HiddenPolicy policy : {HiddenPolicy::undo, HiddenPolicy::keep, HiddenPolicy::remove}) {
    OptimizeOptions o = *options_for("paper");
    o.energy = EnergyKind::dT;
    o.unknowns = Unknowns::weights;
    o.paper.collapse_from = std::nullopt;
    o.paper.removal = Removal::none;
    o.flips = Flips::immediate;
    o.paper.inversion = Inversion::refuse;
    o.paper.hidden = policy;
    o.max_sweeps = 8;
    std::set<std::uint32_t> hidden;
    std::size_t removals = 0;
    OptimizeHooks hooks;
    hooks.tracer = [&](const TraceEvent& e) {
      if (e.kind == EventKind::hidden) hidden.insert(e.vertex.index);
      removals += e.kind == EventKind::removal ? 1 : 0;
    };
    bool regular = true;
    hooks.snapshots = [&](const Snapshot& s) { regular = regular && count_non_regular_edges(s.mesh) == 0; };
    Mesh mesh = dense();
    ASSERT_TRUE(optimize(mesh, o, hooks));
    EXPECT_EQ(mesh.validate(), std::nullopt);
    if (policy == HiddenPolicy::undo) {
      EXPECT_TRUE(hidden.empty());
      EXPECT_EQ(removals, 0u);
      EXPECT_TRUE(regular);
    }
    if (policy == HiddenPolicy::keep) kept = hidden.size();
    if (policy == HiddenPolicy::remove) removed = removals;
  }
  EXPECT_GT(kept, 0u);
  EXPECT_GT(removed, 0u);
}

TEST(Inversions, AreTakenOnlyWhereAllowed) {
  for (const Inversion inversion : {Inversion::refuse, Inversion::allow}) {
    OptimizeOptions o = *options_for("paper");
    o.energy = EnergyKind::F;
    o.paper.collapse_from = std::nullopt;
    o.paper.removal = Removal::none;
    o.paper.inversion = inversion;
    o.max_sweeps = 10;
    bool inverted = false;
    OptimizeHooks hooks;
    hooks.snapshots = [&](const Snapshot& s) { inverted = inverted || s.mesh.validate().has_value(); };
    const Mesh input = dense();
    Mesh mesh = input;
    const auto report = optimize(mesh, o, hooks);
    ASSERT_TRUE(report);
    EXPECT_EQ(inverted, inversion == Inversion::allow);
    if (inverted) {
      EXPECT_EQ(report->stopped, Stopped::tangled);
    }
    EXPECT_EQ(mesh.validate(), std::nullopt);  // the returned mesh has no tangles
  }
}

// Lawson's algorithm, which finds hidden vertices, has no meaning among inverted triangles.
TEST(Inversions, OfTheInputThatStayNameNoHiddenVertices) {
  Mesh mesh = dense();
  VertexId inner;
  for (const VertexId v : mesh.vertices()) {
    if (!mesh.is_boundary(v)) inner = v;
  }
  mesh.set_position(inner, {100, 100});
  OptimizeOptions o = *options_for("paper");
  o.energy = EnergyKind::F;
  o.max_sweeps = 1;
  const auto report = optimize(mesh, o);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->stopped, Stopped::tangled);
  EXPECT_TRUE(report->hidden_vertices.empty());
}

TEST(FlipLimits, BeforeNeverFlips) {
  for (const Flips timing : {Flips::immediate, Flips::deferred}) {
    for (const bool weights : {false, true}) {
      OptimizeOptions o = dense_positions();
      o.paper.collapse_from = std::nullopt;
      o.flips = timing;
      o.paper.flip_limit = FlipLimit::before;
      o.paper.order = SweepOrder::input;
      if (weights) o.unknowns = Unknowns::positions_and_weights;
      std::size_t flips = 0, moves = 0;
      OptimizeHooks hooks;
      hooks.tracer = [&](const TraceEvent& e) { ++(e.kind == EventKind::flip ? flips : moves); };
      Mesh mesh = dense();
      ASSERT_TRUE(optimize(mesh, o, hooks));
      EXPECT_EQ(flips, 0u);
      EXPECT_GT(moves, 200u);
      EXPECT_EQ(count_non_regular_edges(mesh), 0u);
    }
  }
}

TEST(PaperMethod, GivesTheInputBackRegularWhenItFindsNothingBetter) {
  const Mesh input = *sheared_grid({.nx = 6, .ny = 5});
  ASSERT_GT(count_non_regular_edges(input), 0u);
  OptimizeOptions o = *options_for("paper");
  o.energy = EnergyKind::dT;
  o.star = Star::zero;
  std::vector<TraceEvent> events;
  OptimizeHooks hooks;
  hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
  Mesh mesh = input;
  const auto report = optimize(mesh, o, hooks);
  ASSERT_TRUE(report);
  ASSERT_NE(report->notes.back().find("no better mesh"), std::string::npos);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  const auto again = replay(input, events);
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, mesh);
}

TEST(PaperMethod, GivesAnInputBackRegularWhateverIsCutOrKeptHidden) {
  std::size_t given_back = 0, cut = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Rng rng(seed);
    Mesh input = test::mesh_of_random_points(rng, 10, 16);
    if (seed % 2 == 1) input.set_weight(VertexId(6), -0.2);
    for (const HiddenPolicy policy : {HiddenPolicy::undo, HiddenPolicy::remove, HiddenPolicy::keep}) {
      for (const BoundaryVertices boundary : {BoundaryVertices::keep, BoundaryVertices::split}) {
        SCOPED_TRACE(std::to_string(seed) + ", " + std::to_string(static_cast<int>(policy)) + ", " +
                     std::to_string(static_cast<int>(boundary)));
        OptimizeOptions o = *options_for("paper");
        o.energy = seed % 3 == 0 ? EnergyKind::dT : EnergyKind::BP;
        o.boundary = boundary;
        o.boundary_ratio = 2;
        o.max_sweeps = seed % 2 == 0 ? 0 : 3;
        o.paper.hidden = policy;
        std::vector<TraceEvent> events;
        OptimizeHooks hooks;
        hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
        Mesh mesh = input;
        const auto report = optimize(mesh, o, hooks);
        if (!report) {  // a vertex is hidden against the policy
          EXPECT_EQ(report.error().code, ErrorCode::hidden_vertex);
          continue;
        }
        const auto says = [&](const char* text) {
          return std::any_of(report->notes.begin(), report->notes.end(),
                             [&](const std::string& note) { return note.find(text) != std::string::npos; });
        };
        Mesh again = mesh;
        const Restoration restored = restore_regularity(again);
        EXPECT_EQ(restored.flips, 0u);
        EXPECT_EQ(restored.hidden, report->hidden_vertices);
        EXPECT_EQ(says("`hidden=keep`"), !restored.stuck.empty());
        const auto replayed = replay_with_vertices(input, events);
        ASSERT_TRUE(replayed) << replayed.error().what();
        EXPECT_EQ(replayed->mesh, mesh);
        EXPECT_EQ(replayed->vertices, report->vertices);
        if (!says("no better mesh")) continue;
        ++given_back;
        cut += boundary == BoundaryVertices::split ? 1 : 0;
        EXPECT_EQ(report->vertices_inserted, 0u);
        EXPECT_FALSE(says("inserted"));
      }
    }
  }
  EXPECT_GT(given_back, 5u);
  EXPECT_GT(cut, 2u);
}

TEST(Orders, EachIsItsOwnAndSeeded) {
  const auto first_moved = [](SweepOrder order, std::uint64_t seed) {
    std::vector<std::uint32_t> moved;
    OptimizeOptions o{.max_sweeps = 1, .paper = {.order = order, .seed = seed}};
    OptimizeHooks hooks;
    hooks.tracer = [&](const TraceEvent& e) {
      if (e.sweep == 1 && e.kind == EventKind::move) moved.push_back(e.vertex.index);
    };
    Mesh mesh = three_hundred_points();
    EXPECT_TRUE(optimize(mesh, o, hooks));
    EXPECT_GT(moved.size(), 100u);
    return moved;
  };
  const auto input = first_moved(SweepOrder::input, 1), reverse = first_moved(SweepOrder::reverse, 1);
  EXPECT_TRUE(std::is_sorted(input.begin(), input.end()));
  EXPECT_TRUE(std::is_sorted(reverse.rbegin(), reverse.rend()));
  EXPECT_EQ(first_moved(SweepOrder::random, 1), first_moved(SweepOrder::random, 1));
  EXPECT_NE(first_moved(SweepOrder::random, 1), first_moved(SweepOrder::random, 2));
  EXPECT_NE(first_moved(SweepOrder::hilbert, 1), input);
}

TEST(Options, SwitchesThatContradictEachOtherAreRefused) {
  Mesh mesh = three_hundred_points();
  const Mesh input = mesh;
  for (const OptimizeOptions& o : std::vector<OptimizeOptions>{
           {.paper = {.weight_updates = Updates::deferred}},
           {.flips = Flips::none, .paper = {.solver = Solver::golden, .weight_updates = Updates::deferred}},
           {.paper = {.inversion = Inversion::allow}},
           {.paper = {.collapse_energy = EnergyKind::BP}},
           {.paper = {.collapse_ratio = 0}},
           {.paper = {.removal_margin = -1}},
           {.paper = {.inner = -1}},
           {.paper = {.outer = -1}},
           {.paper = {.position_updates = Updates::deferred}},
           {.unknowns = Unknowns::positions, .size_band = 2, .paper = {.position_updates = Updates::deferred}},
           {.flips = Flips::none, .paper = {.insertion_from = 0}},
           {.paper = {.weight_search_radius = 0}},
           {.paper = {.overshoot_factor = 1.5}},
           {.paper = {.insertion_ratio = 1}},
           {.energy = EnergyKind::ODT, .unknowns = Unknowns::weights},
           {.unknowns = Unknowns::weights, .paper = {.first_energy = EnergyKind::ODT}},
           {.size_band = 2, .paper = {.insertion_from = 0}},
           {.unknowns = Unknowns::positions, .paper = {.position_updates = Updates::deferred, .visits = Visits::twice}},
           {.paper = {.inversion = Inversion::infinite, .first_energy = EnergyKind::dT}},
           {.energy = EnergyKind::T, .paper = {.inversion = Inversion::infinite}}}) {
    const auto report = optimize(mesh, o);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalid_option);
    EXPECT_EQ(mesh, input);
  }
}

TEST(Traces, ChangeNothingOfTheRun) {
  Mesh plain = three_hundred_points(), traced = plain;
  std::size_t events = 0, snapshots = 0;
  OptimizeOptions o{.max_sweeps = 12, .paper = {.removal = Removal::patch, .removal_from = 2}};
  ASSERT_TRUE(optimize(plain, o));
  OptimizeHooks hooks;
  hooks.tracer = [&](const TraceEvent&) { ++events; };
  hooks.snapshots = [&](const Snapshot&) { ++snapshots; };
  ASSERT_TRUE(optimize(traced, o, hooks));
  EXPECT_EQ(plain, traced);
  EXPECT_GT(events, 1000u);
  EXPECT_EQ(snapshots, 13u);
}

}  // namespace
}  // namespace temper::test
