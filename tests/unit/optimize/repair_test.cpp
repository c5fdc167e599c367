// Repairs cure the triangles that sweeps leave bad, place by place, and make nothing else worse.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "optimize/repair/local_copy.hpp"
#include "optimize/repair/neighborhood.hpp"
#include "optimize/repair/trial.hpp"
#include "optimize/repair/trial_memo.hpp"
#include "optimize/stages/restarts.hpp"
#include "optimize/step/vertex_step.hpp"
#include "support/instances.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

using Edge = std::pair<std::pair<double, double>, std::pair<double, double>>;

/// The edges of the boundary by coordinates. Equal sets are equal boundaries, bit for bit.
std::set<Edge> boundary(const Mesh& mesh) {
  std::set<Edge> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
    edges.insert({{a.x, a.y}, {b.x, b.y}});
  }
  return edges;
}

std::size_t n_bad(const Mesh& mesh) { return defect_of(mesh).bad; }

struct HardMesh {
  const char* name;
  Mesh mesh;
  int seeds;  // run here; a seed takes up to a second
};

std::vector<HardMesh> hard_meshes() {
  return {{"sparse horseshoe", sparse_horseshoe(), 10},
          {"dense horseshoe", *horseshoe(), 2},
          {"60-gon", *regular_polygon(), 2},
          {"letter A", letter_a(), 10},
          {"wedge of 5 degrees", *wedge(), 3},
          {"graded random points", *graded_mesh(), 1}};
}

TEST(Repair, HardMeshesEndWellCenteredWithTheirBoundaryBitForBit) {
  for (const auto& [name, input, seeds] : hard_meshes()) {
    ASSERT_GT(seeds, 0);
    for (int seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(testing::Message() << name << ", seed " << seed);
      Mesh mesh = input;
      const auto report =
          optimize(mesh, {.repair = Repair::vertices, .paper = {.seed = static_cast<std::uint64_t>(seed)}});
      ASSERT_TRUE(report);
      EXPECT_EQ(n_bad(mesh), 0u);
      EXPECT_EQ(count_non_regular_edges(mesh), 0u);
      EXPECT_EQ(mesh.validate(), std::nullopt);
      EXPECT_EQ(boundary(mesh), boundary(input));
      EXPECT_EQ(mesh.n_vertices(), input.n_vertices() + report->vertices_inserted - report->vertices_removed);
    }
  }
}

TEST(Repair, WithoutInsertionAndRemovalEveryVertexStays) {
  const Mesh input = *horseshoe();
  Mesh swept = input, repaired = input;
  ASSERT_TRUE(optimize(swept, {.repair = Repair::none}));
  const auto report = optimize(repaired);
  ASSERT_TRUE(report);
  EXPECT_GT(n_bad(swept), 0u);
  EXPECT_EQ(n_bad(repaired), 0u);
  EXPECT_EQ(repaired.n_vertices(), input.n_vertices());
  EXPECT_TRUE(report->vertices.empty());
}

TEST(Restarts, WithWeightsAloneCureLayersThatMovesDoNot) {
  const Mesh input = test::layers();
  EXPECT_EQ(n_bad(input), input.n_triangles());  // right angles
  Mesh moved = input, reweighted = input;
  const OptimizeOptions options = {.objective = Objective::energy};
  OptimizeOptions positions = options;
  positions.unknowns = Unknowns::positions;
  positions.repair = Repair::none;
  ASSERT_TRUE(optimize(moved, positions));
  ASSERT_TRUE(optimize(reweighted, options));
  EXPECT_GT(n_bad(moved), 0u);
  EXPECT_EQ(n_bad(reweighted), 0u);
  for (const VertexId v : input.vertices()) ASSERT_EQ(reweighted.position(v), input.position(v)) << v.index;
}

TEST(Repair, OfOnePlaceInALargeMeshChangesNothingElsewhere) {
  constexpr int kSide = 240;  // 114,242 triangles
  Mesh input = test::lattice({.n = kSide, .jitter = 0.02, .weight = 0});
  const VertexId moved(kSide * kSide / 2 + kSide / 2);
  const WeightedPoint from = input.point(moved);
  input.set_point(moved, {from.x, from.y + 0.4, 0});  // sees the edge above at more than a right angle
  ASSERT_EQ(n_bad(input), 1u);

  const OptimizeOptions options;
  const OptimizeHooks nobody;
  temper::Run run(options, nobody, input);
  auto settings = make_settings(options, input, WorkingUnits::of(input), {});
  ASSERT_TRUE(settings);
  SweepState state(*settings);
  const Candidate mended = repaired({WorkingCopy(input, options.paper.order)}, *settings, state, run);
  EXPECT_GT(run.report.sweeps, 0);
  const Mesh mesh = mended.work.in_user_terms();
  EXPECT_EQ(n_bad(mesh), 0u);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = input.position(v);
    if (std::hypot(p.x - from.x, p.y - from.y) > 6) {
      ASSERT_EQ(mesh.point(v), input.point(v)) << v.index;
    }
  }
}

TEST(Repair, IsKeptWhereItIsNoWorseAndCameAndWentForSomething) {
  const Mesh good = test::lattice({.n = 6, .jitter = 0.02, .weight = 0});
  Mesh bad = good;
  const VertexId moved(14);
  const WeightedPoint from = bad.point(moved);
  bad.set_point(moved, {from.x, from.y + 0.4, 0});
  ASSERT_GT(n_bad(bad), n_bad(good));
  const OptimizeOptions options;
  const auto settings = make_settings(options, good, WorkingUnits::of(good), {});
  ASSERT_TRUE(settings);
  const Candidate cured = {WorkingCopy(good, options.paper.order)}, ill = {WorkingCopy(bad, options.paper.order)};
  EXPECT_TRUE(has_gained(cured, ill, *settings, settings->model));
  EXPECT_FALSE(has_gained(ill, cured, *settings, settings->model));
  EXPECT_TRUE(has_gained(cured, cured, *settings, settings->model));
  Candidate replaced = cured;  // a vertex went, and another one came
  ++replaced.work.n_vertices_named;
  EXPECT_FALSE(has_gained(replaced, cured, *settings, settings->model)) << "for nothing";
  EXPECT_TRUE(has_gained(replaced, ill, *settings, settings->model));
}

TEST(Repair, StopsAtTheFirstTrialWhenItIsAskedAndAsksNoMore) {
  Mesh input = test::lattice({.n = 6, .jitter = 0.02, .weight = 0});
  const VertexId moved(14);
  const WeightedPoint from = input.point(moved);
  input.set_point(moved, {from.x, from.y + 0.4, 0});
  ASSERT_GT(n_bad(input), 0u);
  for (const Continue answer : {Continue::yes, Continue::no}) {
    int calls = 0;
    OptimizeHooks hooks;
    hooks.observer = [&](const Progress&) {
      ++calls;
      return answer;
    };
    const OptimizeOptions options;
    temper::Run run(options, hooks, input);
    run.report.history.push_back({});
    const auto settings = make_settings(options, input, WorkingUnits::of(input), hooks);
    ASSERT_TRUE(settings);
    SweepState state(*settings);
    const Candidate mended = repaired({WorkingCopy(input, options.paper.order)}, *settings, state, run);
    if (answer == Continue::yes) {
      EXPECT_EQ(n_bad(mended.work.in_user_terms()), 0u);
      continue;
    }
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(run.report.stopped, Stopped::canceled);
    EXPECT_EQ(mended.work.in_user_terms(), input);
  }
}

TEST(Repair, IsTracedLikeAllElse) {
  for (const Mesh& input : {*regular_polygon({.corners = 40}), *horseshoe()}) {
    std::vector<TraceEvent> events;
    Mesh mesh = input;
    OptimizeOptions options = {.repair = Repair::vertices, .max_sweeps = 300};
    OptimizeHooks hooks;
    hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
    const auto report = optimize(mesh, options, hooks);
    ASSERT_TRUE(report);
    EXPECT_GT(report->vertices_inserted + report->vertices_removed, 0u);
    const auto again = replay_with_vertices(input, events);
    ASSERT_TRUE(again) << again.error().what();
    EXPECT_EQ(again->mesh, mesh);
    EXPECT_EQ(again->vertices, report->vertices);
  }
}

TEST(Repair, KeepsInterfacesRegionsAndFixedVertices) {
  // Two halves of a polygon without interior vertices, with a common line across.
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 2>> segments;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    points.push_back({std::cos(angle), std::sin(angle)});
    segments.push_back({i, (i + 1) % 40});
  }
  for (int i = 1; i < 8; ++i) points.push_back({1 - i / 4.0, 0});
  for (int i = 40; i < 46; ++i) segments.push_back({i, i + 1});
  segments.push_back({0, 40});
  segments.push_back({46, 20});
  Mesh input = *constrained_delaunay({.points = points, .segments = segments});
  input.set_fixed(VertexId(43), true);
  std::map<std::int32_t, double> area_before, area_after;
  for (const TriangleId t : input.triangles()) {
    const auto [a, b, c] = input.corners(t);
    const double y = input.position(a).y + input.position(b).y + input.position(c).y;
    input.set_region(t, y > 0 ? 1 : 2);
    area_before[input.region(t)] += doubled_area(input.position(a), input.position(b), input.position(c));
  }
  ASSERT_EQ(area_before.size(), 2u);
  Mesh mesh = input;
  const auto report = optimize(mesh, {.repair = Repair::vertices});
  ASSERT_TRUE(report);
  EXPECT_EQ(n_bad(mesh), 0u);
  EXPECT_GT(report->vertices_inserted, 0u);
  for (int i = 0; i < 47; ++i) EXPECT_EQ(mesh.position(VertexId(i)).x, points[static_cast<std::size_t>(i)].x);
  for (const auto& [a, b] : segments) {
    HalfedgeId h = mesh.find_halfedge(VertexId(a), VertexId(b));
    if (!h.valid()) h = mesh.find_halfedge(VertexId(b), VertexId(a));
    ASSERT_TRUE(h.valid()) << a << " to " << b;
  }
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    area_after[mesh.region(t)] += doubled_area(mesh.position(a), mesh.position(b), mesh.position(c));
  }
  EXPECT_NEAR(area_after[1], area_before[1], 1e-12);
  EXPECT_NEAR(area_after[2], area_before[2], 1e-12);
}

TEST(Repair, LeavesFixedVerticesWhereTheyAre) {
  Mesh input = *horseshoe();
  std::vector<VertexId> fixed;
  for (const VertexId v : input.vertices()) {
    if (input.is_boundary(v) || v.index % 3 != 0) continue;
    input.set_fixed(v, true);
    fixed.push_back(v);
  }
  ASSERT_GT(fixed.size(), 3u);
  Mesh mesh = input;
  const auto report = optimize(mesh, {.repair = Repair::vertices, .repair_trials = 2000});
  ASSERT_TRUE(report);
  std::map<std::uint32_t, VertexId> now;
  for (const VertexId v : mesh.vertices()) {
    const VertexId was = report->vertices.empty() ? v : report->vertices[v];
    if (was.valid()) now[was.index] = v;
  }
  for (const VertexId v : fixed) {
    ASSERT_EQ(now.count(v.index), 1u) << v.index << " is gone";
    EXPECT_EQ(mesh.position(now[v.index]), input.position(v)) << v.index;
  }
}

TEST(Repair, NoTrialsMeansNoRepair) {
  Mesh none = *horseshoe(), no_trials = none;
  ASSERT_TRUE(optimize(none, {.repair = Repair::none, .max_sweeps = 60}));
  const auto report = optimize(no_trials, {.repair = Repair::vertices, .repair_trials = 0, .max_sweeps = 60});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->vertices_removed + report->vertices_inserted, 0u);
  EXPECT_GT(n_bad(no_trials), 0u);
  EXPECT_FALSE(optimize(none, {.repair_trials = -1}));
}

TEST(Repair, TriesLittleWhereMostTrianglesAreBad) {
  std::vector<Vec2> points;
  Rng rng(1);
  for (int i = 0; i < 120; ++i) points.push_back({100 * rng.uniform(), rng.uniform()});
  Mesh strip = *constrained_delaunay({.points = points});
  OptimizeHooks hooks;
  std::size_t asked = 0;
  hooks.observer = [&](const Progress&) {
    ++asked;
    return Continue::yes;
  };
  ASSERT_TRUE(optimize(strip, {}, hooks));
  EXPECT_GT(2 * n_bad(strip), strip.n_triangles());
  EXPECT_LT(asked, 700u);  // 1,968 if each trial counts once
}

TEST(Repair, SaysWhenAnEdgeMustBeSplitBeforeAnythingHelps) {
  const std::vector<Vec2> points = {{0, 0}, {5, 0}, {5, 1}, {3.75, 1}, {2.5, 1}, {1.25, 1}, {0, 1}};
  std::vector<std::array<std::int32_t, 2>> segments;
  for (int i = 0; i < 7; ++i) segments.push_back({i, (i + 1) % 7});
  const Mesh input = *constrained_delaunay({.points = points, .segments = segments});
  Mesh kept = input, split = input;
  const auto report =
      optimize(kept, {.objective = Objective::energy, .repair = Repair::vertices, .repair_trials = 500});
  ASSERT_TRUE(report);
  EXPECT_GT(n_bad(kept), 0u);
  ASSERT_FALSE(report->notes.empty());
  EXPECT_NE(report->notes.back().find("1 edge of the boundary or of lines has to be split"), std::string::npos);
  EXPECT_NE(report->notes.back().find("from point 0 to point 1"), std::string::npos);
  const auto after_split = optimize(split, {.boundary = BoundaryVertices::split});
  ASSERT_TRUE(after_split);
  EXPECT_EQ(n_bad(split), 0u);
}

// --- the parts ------------------------------------------------------------------------------------------

TEST(Neighborhood, IsAValidPartWithItsRimFrozen) {
  Mesh mesh = *annulus({});
  for (std::size_t i = 0; i < mesh.n_vertices(); i += 5) mesh.set_fixed(VertexId(i), true);
  std::size_t frozen = 0;
  for (const int rings : {0, 1, 2, 3, 20}) {
    for (std::size_t i = 0; i < mesh.n_triangles(); i += 17) {
      const Neighborhood around = neighborhood_of(WorkingCopy::part(mesh), TriangleId(i), rings);
      ASSERT_EQ(around.mesh.validate(), std::nullopt);
      ASSERT_TRUE(rim_is_regular(around, around.mesh));
      for (const VertexId v : around.mesh.vertices()) {
        const VertexId whole = around.vertices[v.index];
        ASSERT_EQ(around.mesh.point(v), mesh.point(whole));
        ASSERT_EQ(around.mesh.is_fixed(v), mesh.is_fixed(whole));
        std::size_t here = 0, there = 0;
        for ([[maybe_unused]] const HalfedgeId h : around.mesh.star(v)) ++here;
        for ([[maybe_unused]] const HalfedgeId h : mesh.star(whole)) ++there;
        ASSERT_EQ(around.frozen[v.index] != 0, here < there);
        frozen += around.frozen[v.index];
      }
    }
  }
  EXPECT_GT(frozen, 0u);
  EXPECT_EQ(neighborhood_of(WorkingCopy::part(mesh), TriangleId(0), 100).mesh.n_triangles(), mesh.n_triangles());
}

TEST(TrialMemo, KnowsAPlaceByAllThatATrialDependsOn) {
  const Mesh mesh = *annulus({});
  const Neighborhood around = neighborhood_of(WorkingCopy::part(mesh), TriangleId(0), 2);
  ASSERT_FALSE(around.beyond.empty());
  std::size_t k = 0;
  while (around.outside.at(k).points.empty()) ++k;
  TrialMemo memo;
  memo.at(around, Pace::quick)[{0, 0}] = TrialResult();
  const VertexId v(0);
  const std::vector<std::function<void(Neighborhood&)>> changes = {
      [](Neighborhood& n) { n.seed = TriangleId(n.seed.index + 1); },
      [&](Neighborhood& n) { n.mesh.set_weight(v, 1e-300); },
      [&](Neighborhood& n) { n.mesh.set_fixed(v, !n.mesh.is_fixed(v)); },
      [](Neighborhood& n) { n.mesh.set_constrained(HalfedgeId(0), true); },
      [](Neighborhood& n) { n.mesh.set_face(HalfedgeId(0)); },
      [](Neighborhood& n) { n.mesh.set_joint(HalfedgeId(0)); },
      [](Neighborhood& n) { n.mesh.set_diagonal(HalfedgeId(0)); },
      [](Neighborhood& n) { n.frozen[0] = 1 - n.frozen[0]; },
      [](Neighborhood& n) { n.beyond[0].x += 1e-9; },
      [](Neighborhood& n) { ++n.region_beyond[0]; },
      [k](Neighborhood& n) { n.outside[k].points[0].y += 1e-9; },
      [k](Neighborhood& n) { n.outside[k].is_closed = !n.outside[k].is_closed; },
      [k](Neighborhood& n) { n.outside[k].is_outside = !n.outside[k].is_outside; },
      [&](Neighborhood& n) {
        n.divided.emplace(v, DividedEdge{{0, 0}, {1, 0}});
      },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Neighborhood other = around;
    changes[i](other);
    EXPECT_TRUE(memo.at(other, Pace::quick).empty()) << i;
    memo.at(other, Pace::quick)[{0, 0}] = TrialResult();  // differs from all that follow
  }
  EXPECT_TRUE(memo.at(around, Pace::thorough).empty());
  EXPECT_EQ(memo.at(around, Pace::quick).size(), 1u);
}

TEST(Trial, RemovesNoVertexThatIsFixedFrozenOfTheBoundaryOrOfALine) {
  Mesh mesh = test::lattice({.n = 6, .jitter = 0.02, .weight = 0});
  std::vector<std::uint8_t> frozen(mesh.n_vertices(), 0);
  std::size_t inner = 0;
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(may_be_removed(mesh, frozen, {}, v), !mesh.is_boundary(v)) << v.index;
    if (mesh.is_boundary(v)) continue;
    ++inner;
    mesh.set_fixed(v, true);
    EXPECT_FALSE(may_be_removed(mesh, frozen, {}, v)) << "fixed";
    mesh.set_fixed(v, false);
    frozen[v.index] = 1;
    EXPECT_FALSE(may_be_removed(mesh, frozen, {}, v)) << "frozen";
    frozen[v.index] = 0;
    mesh.set_constrained(mesh.outgoing(v), true);
    EXPECT_FALSE(may_be_removed(mesh, frozen, {}, v)) << "of a line";
    mesh.set_constrained(mesh.outgoing(v), false);
  }
  EXPECT_GT(inner, 5u);
}

// --- lines that the run divides ---------------------------------------------------------------------------

/// A polygon with whole coordinates and a constrained line through it. No edge is parallel to an axis.
Mesh polygon_with_line() {
  const std::vector<Vec2> points = {{3, 1}, {101, 17}, {120, 83}, {67, 131}, {11, 90}, {50, 40}, {61, 85}};
  const std::vector<std::array<std::int32_t, 2>> segments = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}, {5, 6}};
  return *constrained_delaunay({.points = points, .segments = segments});
}

Settings splitting_settings(const Mesh& mesh) {
  return *make_settings({.boundary = BoundaryVertices::split, .repair = Repair::vertices}, mesh, WorkingUnits());
}

/// Says whether edges from a to b cover the segment between two places, exactly.
bool is_covered(const Mesh& mesh, Vec2 a, Vec2 b) {
  const auto at = [&](Vec2 p) {
    for (const VertexId v : mesh.vertices()) {
      if (mesh.position(v) == p) return v;
    }
    return VertexId();
  };
  VertexId v = at(a);
  while (v.valid() && mesh.position(v) != b) {
    VertexId next;
    for (const HalfedgeId h : lines_at(mesh, v)) {
      const VertexId u = mesh.origin(h) == v ? mesh.target(h) : mesh.origin(h);
      const Vec2 p = mesh.position(u);
      if (orient2d(a, p, b) == Sign::zero && dot(p - mesh.position(v), b - a) > 0) next = u;
    }
    v = next;
  }
  return v.valid();
}

TEST(DividedEdge, HasItsPlacesExactlyOnIfCoordinatesHaveFewBits) {
  Rng rng(3);
  const auto whole = [&] { return static_cast<double>(rng.below(1U << 31U)); };
  for (int i = 0; i < 500; ++i) {
    const DividedEdge edge = {{whole(), whole()}, {whole(), whole()}};
    const double t = 0.01 + 0.98 * rng.uniform();
    const Vec2 p = edge.at(t, WorkingUnits());
    EXPECT_EQ(orient2d(edge.a, p, edge.b), Sign::zero);
    EXPECT_NEAR(edge.part_of(p), t, 0x1p-12);
    EXPECT_EQ(edge.nearest(p, WorkingUnits()), p) << "the same place again";
  }
  const DividedEdge odd = {{0.1, 0.7}, {1.3, 1.1}};
  const Vec2 p = odd.at(1.0 / 3, WorkingUnits());
  EXPECT_NEAR(cross(p - odd.a, odd.along()), 0, 1e-15);
}

TEST(Trial, SplitsLinesOnBothSidesAndKeepsThemExactly) {
  const Neighborhood around = neighborhood_of(WorkingCopy::part(polygon_with_line()), TriangleId(0), 9);
  const Mesh& mesh = around.mesh;
  const Settings settings = splitting_settings(mesh);
  std::size_t valid = 0, inside = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_unflippable(h) || !mesh.is_edge_representative(h)) continue;
    const TrialResult result = try_edit(around, Split{h, 0.4}, settings, WorkingUnits(), {.with_events = true});
    if (!result.valid) continue;
    ++valid;
    inside += mesh.is_boundary(h) ? 0 : 1;
    const auto after = replay(mesh, result.events);
    ASSERT_TRUE(after);
    EXPECT_EQ(after->validate(), std::nullopt);
    EXPECT_EQ(after->n_vertices(), mesh.n_vertices() + 1);
    EXPECT_EQ(count_non_regular_edges(*after), 0u);
    for (const HalfedgeId line : mesh.halfedges()) {
      if (!mesh.is_unflippable(line)) continue;
      const Vec2 a = mesh.position(mesh.origin(line)), b = mesh.position(mesh.target(line));
      EXPECT_TRUE(is_covered(*after, a, b)) << a.x << " to " << b.x;
    }
    for (const VertexId v : mesh.vertices()) {
      if (!lines_at(mesh, v).empty()) {
        EXPECT_EQ(after->position(v), mesh.position(v));
      }
    }
  }
  EXPECT_GE(valid, 5u);
  EXPECT_EQ(inside, 1u);
}

TEST(Trial, CutsAllLinesOfACornerAtOneDistance) {
  const std::vector<Vec2> points = {{0, 0}, {100, 0}, {80, 30}};
  const Mesh input = *constrained_delaunay({.points = points});
  const Neighborhood around = neighborhood_of(WorkingCopy::part(input), TriangleId(0), 1);
  const Mesh& mesh = around.mesh;
  VertexId corner;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.position(v) == points[0]) corner = v;
  }
  const Edit edit = CutCorner{corner, 50};
  Settings settings = splitting_settings(mesh);
  settings.options.unknowns = Unknowns::weights;  // new vertices stay where they are put
  const TrialResult result = try_edit(around, edit, settings, WorkingUnits(), {.with_events = true});
  const auto after = replay(mesh, result.events);
  ASSERT_TRUE(after);
  ASSERT_EQ(after->n_vertices(), 5u);
  for (const std::size_t i : {3U, 4U}) EXPECT_NEAR(length(after->position(VertexId(i))), 50, 1e-4);
  const Edit too_far = CutCorner{corner, 99};
  EXPECT_FALSE(try_edit(around, too_far, settings, WorkingUnits()).valid);
}

TEST(Trial, RemovesAndSlidesVerticesOfTheRunOnLinesAndNoOthers) {
  WorkingCopy work = WorkingCopy::part(polygon_with_line());
  const Mesh input = work.mesh;
  const Settings settings = splitting_settings(work.mesh);
  const SweepState state(settings);
  const Recorder recorder(settings.hooks.tracer, work, 1);
  Flipper flipper(work.mesh, settings, state, recorder);
  std::vector<std::array<VertexId, 2>> lines;
  for (const HalfedgeId h : input.halfedges()) {
    if (input.is_unflippable(h) && input.is_edge_representative(h)) lines.push_back({input.origin(h), input.target(h)});
  }
  for (const auto& [a, b] : lines) {
    const HalfedgeId h = work.mesh.find_halfedge(a, b);
    const Vec2 p = work.divided_by(h).at(0.25, WorkingUnits());
    const VertexId v = flipper.split(work, h, {p.x, p.y, 0}, kNoEnergy, kNoEnergy);
    ASSERT_NE(work.divided_edge(v), nullptr);
    // Pieces of the edge divide the same edge.
    for (const HalfedgeId piece : lines_at(work.mesh, v)) {
      EXPECT_EQ(work.divided_by(piece).a, work.divided_edge(v)->a);
      EXPECT_EQ(work.divided_by(piece).b, work.divided_edge(v)->b);
    }
  }
  ASSERT_TRUE(flipper.restore_all());
  const VertexLimits limits(work, settings, work.units);
  const std::vector<std::uint8_t> nothing_frozen(work.mesh.n_vertices(), 0);
  for (const VertexId v : work.mesh.vertices()) {
    const bool is_of_run = v.index >= input.n_vertices();
    const bool on_line = !lines_at(work.mesh, v).empty();
    EXPECT_EQ(may_be_removed(work.mesh, nothing_frozen, work.divided, v), is_of_run || !on_line) << v.index;
    const Mobility on_a_line = is_of_run ? Mobility::sliding : Mobility::fixed;
    EXPECT_EQ(limits.mobility[v], on_line ? on_a_line : Mobility::free) << v.index;
  }
  for (std::size_t i = input.n_vertices(); i < work.mesh.n_vertices(); ++i) {
    const RemovalPlan plan = plan_removal(work.mesh, VertexId(i));
    ASSERT_EQ(plan.status, RemovalStatus::possible);
    flipper.remove(EventKind::removal, plan, kNoEnergy, kNoEnergy);
  }
  ASSERT_TRUE(flipper.restore_all());
  work.compact();
  EXPECT_EQ(work.mesh.validate(), std::nullopt);
  EXPECT_EQ(boundary(work.mesh), boundary(input));
}

TEST(Repair, OfPolygonsWithSplitsLeavesNoBadTriangleAndTheirLinesExactly) {
  std::size_t split = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Rng rng(seed);
    std::vector<Vec2> points;
    std::vector<std::array<std::int32_t, 2>> segments;
    constexpr int kCorners = 14;
    for (int i = 0; i < kCorners; ++i) {  // a star, with a constrained line from its center to a corner
      const double angle = 2 * std::numbers::pi * (i + 0.8 * rng.uniform()) / kCorners, r = 200 + 800 * rng.uniform();
      points.push_back({std::round(r * std::cos(angle)), std::round(r * std::sin(angle))});
      segments.push_back({i, (i + 1) % kCorners});
    }
    points.push_back({0, 0});
    segments.push_back({kCorners, 0});
    Mesh input = *constrained_delaunay({.points = points, .segments = segments});
    input.set_fixed(VertexId(kCorners), true);
    Mesh mesh = input;
    const auto report = optimize(mesh, {.boundary = BoundaryVertices::split, .repair = Repair::vertices});
    ASSERT_TRUE(report);
    EXPECT_EQ(n_bad(mesh), 0u) << "seed " << seed;
    EXPECT_EQ(mesh.validate(), std::nullopt);
    split += report->vertices_inserted;
    for (const auto& [a, b] : segments) {
      EXPECT_TRUE(is_covered(mesh, points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)]))
          << "seed " << seed << ", " << a << " to " << b;
    }
  }
  EXPECT_GT(split, 0u);
}

TEST(Trial, RefinesLinesOnlyIfItMay) {
  const Neighborhood around = neighborhood_of(WorkingCopy::part(polygon_with_line()), TriangleId(0), 9);
  const Settings settings = splitting_settings(around.mesh);
  for (const bool splits : {false, true}) {
    const Edit edit = Refine{.sizes = {0.6, 0.3}, .splits_lines = splits, .sweeps = false};
    const TrialResult result = try_edit(around, edit, settings, WorkingUnits(), {.with_events = true});
    ASSERT_TRUE(result.valid);
    const auto after = replay(around.mesh, result.events);
    ASSERT_TRUE(after);
    EXPECT_EQ(after->validate(), std::nullopt);
    EXPECT_GT(after->n_vertices(), around.mesh.n_vertices());
    EXPECT_EQ(boundary(*after) == boundary(around.mesh), !splits);
    for (const HalfedgeId h : around.mesh.halfedges()) {
      if (!around.mesh.is_unflippable(h)) continue;
      EXPECT_TRUE(
          is_covered(*after, around.mesh.position(around.mesh.origin(h)), around.mesh.position(around.mesh.target(h))));
    }
  }
}

TEST(Run, RenewsTheWholeBudgetOfTrialsWhenItsInputIsAway) {
  Mesh input = test::lattice({.n = 40, .jitter = 0.2});
  const OptimizeOptions options;
  const OptimizeHooks nobody;
  temper::Run run(options, nobody, input);
  const Mesh folded_up = std::exchange(input, Mesh());
  const auto spend = [&] {
    int trials = 0;
    for (; run.repair_trials_left() > 0; ++trials) run.count_trials(1, folded_up.n_triangles());
    return trials;
  };
  const int first = spend();
  EXPECT_GT(first, 100);
  run.renew_trials();
  EXPECT_EQ(spend(), first);
}

TEST(Refined, LeavesNoBadTriangleWithoutRepairsBefore) {
  const Mesh input = polygon_with_line();
  ASSERT_GT(n_bad(input), 0u);
  const OptimizeOptions options = {.boundary = BoundaryVertices::split, .repair = Repair::vertices};
  const OptimizeHooks nobody;
  temper::Run run(options, nobody, input);
  const auto settings = make_settings(options, input, WorkingUnits::of(input), {});
  ASSERT_TRUE(settings);
  SweepState state(*settings);
  const Mesh mesh = refined({WorkingCopy(input, options.paper.order)}, *settings, state, run).work.in_user_terms();
  EXPECT_EQ(n_bad(mesh), 0u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  for (const HalfedgeId h : input.halfedges()) {
    if (!input.is_unflippable(h)) continue;
    EXPECT_TRUE(is_covered(mesh, input.position(input.origin(h)), input.position(input.target(h))));
  }
}

TEST(Repair, OfPointSetsWithConstraintsLeavesNoBadTriangleAndAllPointsInPlace) {
  const std::filesystem::path folder = TEMPER_SHARED "/cgshop";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no instances here";
  std::size_t n = 0;
  for (const char* name : {"point-set_10_13860916", "point-set_20_0c4009d9", "point-set_40_9451c229"}) {
    const auto path = folder / (std::string(name) + ".instance.json");
    if (!std::filesystem::exists(path)) continue;
    ++n;
    const test::Instance instance = test::read_instance(path);
    Mesh mesh = *constrained_delaunay({.points = instance.points, .segments = instance.segments, .carve = false});
    for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, true);
    const auto report = optimize(mesh, {.boundary = BoundaryVertices::split, .repair = Repair::vertices});
    ASSERT_TRUE(report);
    EXPECT_EQ(n_bad(mesh), 0u) << name;
    for (std::size_t i = 0; i < instance.points.size(); ++i) {
      EXPECT_EQ(mesh.position(VertexId(i)), instance.points[i]) << name << ", point " << i;
    }
    for (const auto& [a, b] : instance.segments) {
      EXPECT_TRUE(
          is_covered(mesh, instance.points[static_cast<std::size_t>(a)], instance.points[static_cast<std::size_t>(b)]))
          << name;
    }
  }
  EXPECT_GT(n, 0u);
}

TEST(Trial, LeavesFrozenVerticesAndTellsWhatItDid) {
  Mesh mesh = *horseshoe();
  ASSERT_TRUE(optimize(mesh, {.repair = Repair::none, .max_sweeps = 40}));
  Settings settings = *make_settings({}, mesh, WorkingUnits());
  std::size_t applied = 0;
  for (const TriangleId t : mesh.triangles()) {
    const Neighborhood around = neighborhood_of(WorkingCopy::part(mesh), t, 1);
    const auto [a, b, c] = around.mesh.corners(TriangleId(0));
    const Vec2 middle = (1.0 / 3) * (around.mesh.position(a) + around.mesh.position(b) + around.mesh.position(c));
    const Edit edit = Insert{TriangleId(0), {middle.x, middle.y}};
    const TrialResult quiet = try_edit(around, edit, settings, WorkingUnits());
    const TrialResult told = try_edit(around, edit, settings, WorkingUnits(), {.with_events = true});
    EXPECT_EQ(quiet.valid, told.valid);
    EXPECT_EQ(quiet.defect, told.defect);
    if (!told.valid) continue;
    const auto local = replay(around.mesh, told.events);
    ASSERT_TRUE(local);
    EXPECT_EQ(defect_of(*local), told.defect);
    for (const VertexId v : around.mesh.vertices()) {
      if (around.frozen[v.index] != 0) {
        EXPECT_EQ(local->point(v), around.mesh.point(v));
      }
    }
    ++applied;
  }
  EXPECT_GT(applied, 10u);
}

TEST(Trial, IsGivenUpEarlyOnlyIfQuickAndNextToBadTriangles) {
  Mesh mesh = *horseshoe();
  ASSERT_TRUE(optimize(mesh, {.repair = Repair::none, .max_sweeps = 40}));
  const Settings settings = *make_settings({}, mesh, WorkingUnits());
  std::size_t given_up = 0, made = 0;
  for (const TriangleId t : mesh.triangles()) {
    const Neighborhood around = neighborhood_of(WorkingCopy::part(mesh), t, 2);
    const auto [a, b, c] = around.mesh.corners(TriangleId(0));
    const Vec2 middle = (1.0 / 3) * (around.mesh.position(a) + around.mesh.position(b) + around.mesh.position(c));
    const Edit edit = Insert{TriangleId(0), {middle.x, middle.y}};
    const TrialResult quick = try_edit(around, edit, settings, WorkingUnits(), {.pace = Pace::quick});
    made += quick.valid ? 1 : 0;
    if (quick.valid || !try_edit(around, edit, settings, WorkingUnits()).valid) continue;
    EXPECT_GT(defect_of(around.mesh).bad, 0u);
    ++given_up;
  }
  EXPECT_GT(given_up, 0u);
  EXPECT_GT(made, 0u);
}

}  // namespace
}  // namespace temper
