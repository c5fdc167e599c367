// Insertions and the options of the boundary. Traces replay to the same bits after any insertion, split, removal and
// compaction. The domain keeps its shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "energy/whole_mesh.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/flips/flipper.hpp"
#include "optimize/flips/grading.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/trace/recorder.hpp"
#include "support/shapes.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

using Events = std::vector<TraceEvent>;

/// Makes random changes of every kind in a working copy, and records them.
class Actor {
 public:
  Actor(const Mesh& input, SweepOrder order, std::uint64_t seed)
      : work_(input, order),
        tracer_([this](const TraceEvent& e) { events.push_back(e); }),
        recorder_(tracer_, work_, 1),
        rng_(seed) {}

  void act() {
    switch (rng_.below(7)) {
      case 0:
        return insert();
      case 1:
        return split();
      case 2:
        return remove();
      case 3:
        if (rng_.below(8) == 0) compact();
        return;
      case 4:
        return move();
      default:
        return flip();
    }
  }
  void compact() { work_.compact(), ++compactions; }
  [[nodiscard]] WorkingCopy& work() { return work_; }

  Events events;
  int compactions = 0;

 private:
  Mesh& mesh() { return work_.mesh; }
  TriangleId any_triangle() {
    for (;;) {
      const TriangleId t(std::size_t{rng_.below(static_cast<std::uint32_t>(mesh().n_triangles()))});
      if (!mesh().is_erased(t)) return t;
    }
  }
  HalfedgeId any_halfedge() { return Mesh::halfedge(any_triangle(), static_cast<int>(rng_.below(3))); }
  [[nodiscard]] bool is_triangle(VertexId a, VertexId b, Vec2 p) {
    return orient2d(mesh().position(a), mesh().position(b), p) == Sign::positive;
  }

  void insert() {
    const auto corners = mesh().corners(any_triangle());
    const auto [a, b, c] = corners;
    const Vec2 sum = mesh().position(a) + mesh().position(b) + mesh().position(c);
    const Vec2 p = work_.units.snap((1.0 / 3) * sum);
    if (!is_triangle(a, b, p) || !is_triangle(b, c, p) || !is_triangle(c, a, p)) return;
    const TriangleId t = Mesh::triangle(mesh().find_halfedge(a, b));
    const VertexId v = insert_in_triangle(mesh(), t, {p.x, p.y, rng_.uniform(-1, 1)});
    work_.name_new();
    recorder_.inserted(v, corners, 0, 0);
  }
  void split() {
    const HalfedgeId h = any_halfedge(), twin = mesh().twin(h);
    const VertexId a = mesh().origin(h), b = mesh().target(h), c = mesh().opposite(h);
    const VertexId d = twin.valid() ? mesh().opposite(twin) : VertexId();
    const double t = rng_.uniform(0.3, 0.7);
    const Vec2 p = work_.units.snap((1 - t) * mesh().position(a) + t * mesh().position(b));
    if (!is_triangle(b, c, p) || !is_triangle(c, a, p)) return;
    if (d.valid() && (!is_triangle(a, d, p) || !is_triangle(d, b, p))) return;
    const VertexId v = split_edge(mesh(), h, {p.x, p.y, rng_.uniform(-1, 1)});
    work_.name_new();
    recorder_.split(v, {a, b, c, d}, 0, 0);
  }
  void remove() {
    const RemovalPlan plan = plan_removal(mesh(), mesh().origin(any_halfedge()));
    if (plan.status != RemovalStatus::possible) return;
    recorder_.removed(EventKind::removal, plan, 0, 0);
    remove_vertex(mesh(), plan);
  }
  void flip() {
    const HalfedgeId h = any_halfedge();
    if (can_flip(mesh(), h) != FlipStatus::possible) return;
    const VertexId c = mesh().opposite(h), d = mesh().opposite(mesh().twin(h));
    const FlipRecord record{mesh().origin(h), mesh().target(h), c, d};
    temper::flip(mesh(), h);
    recorder_.flipped({&record, 1});
  }
  void move() {
    const VertexId v = mesh().origin(any_halfedge());
    const WeightedPoint from = mesh().point(v);
    mesh().set_weight(v, from.w + rng_.uniform(-1, 1));
    recorder_.placed(v, from, mesh().point(v), 0, 0);
  }

  WorkingCopy work_;
  Tracer tracer_;
  Recorder recorder_;
  Rng rng_;
};

Mesh displaced(Mesh mesh) {
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    mesh.set_point(v, {0.01 * p.x + 1234, 0.01 * p.y - 77, p.w});
  }
  return mesh;
}

TEST(Insertions, ReplayToTheSameBitsSlotsAndNumbersInAnyOrderOfWork) {
  std::map<EventKind, std::size_t> seen;
  int compactions = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Mesh input = *random_mesh({.vertices = 60, .seed = seed});
    if (seed % 2 == 0) input = displaced(std::move(input));
    Actor actor(input, seed % 4 < 2 ? SweepOrder::hilbert : SweepOrder::input, seed);
    for (int i = 0; i < 300; ++i) actor.act();
    actor.compact();
    const auto result = replay_with_vertices(input, actor.events);
    ASSERT_TRUE(result) << result.error().what();
    const Mesh expected = actor.work().in_user_terms();
    EXPECT_EQ(expected.validate(), std::nullopt);
    EXPECT_EQ(result->mesh, expected);
    EXPECT_EQ(result->vertices, actor.work().user_vertices());
    for (const TraceEvent& e : actor.events) ++seen[e.kind];
    compactions += actor.compactions;
  }
  for (const EventKind kind : {EventKind::insertion, EventKind::split, EventKind::removal, EventKind::flip}) {
    EXPECT_GT(seen[kind], 100u) << name(kind);
  }
  EXPECT_GT(compactions, 40);
}

TEST(Insertions, KeptVerticesComeFirstInTheirOrderAndNumbersAreNeverGivenTwice) {
  const Mesh input = *random_mesh({.vertices = 60});
  Actor actor(input, SweepOrder::hilbert, 7);
  for (int i = 0; i < 400; ++i) actor.act();
  actor.compact();
  std::size_t next = input.n_vertices(), removed_new = 0;
  for (const TraceEvent& e : actor.events) {
    const bool is_new = e.kind == EventKind::insertion || e.kind == EventKind::split;
    EXPECT_TRUE(!is_new || e.vertex.index == next);
    if (is_new) ++next;
    if (e.kind == EventKind::removal && e.vertex.index >= input.n_vertices()) ++removed_new;
  }
  EXPECT_GT(removed_new, 0u);
  VertexId last;
  bool new_ones = false;
  for (const VertexId v : actor.work().user_vertices()) {
    new_ones = new_ones || !v.valid();
    EXPECT_EQ(v.valid(), !new_ones);
    EXPECT_TRUE(!v.valid() || !last.valid() || last < v);
    last = v;
  }
  EXPECT_TRUE(new_ones);
}

TEST(Insertions, ThatDoNotFitAreRefusedByReplay) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {0, 1}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}};
  const Mesh input = Mesh::build({.points = points, .triangles = triangles})->mesh;
  const auto id = [](std::size_t i) { return VertexId(i); };
  const TraceEvent insertion = {
      .kind = EventKind::insertion, .vertex = id(3), .point = {0.25, 0.25, 0}, .link = {id(1), id(2), id(0)}};
  const TraceEvent split = {
      .kind = EventKind::split, .vertex = id(3), .point = {0.5, 0, 0}, .quad = {id(0), id(1), id(2), VertexId()}};
  ASSERT_TRUE(replay(input, Events{insertion}));
  ASSERT_TRUE(replay(input, Events{split}));
  const auto refused = [&](TraceEvent e, const std::string& message) {
    const auto result = replay(input, Events{std::move(e)});
    ASSERT_FALSE(result) << message;
    EXPECT_EQ(result.error().what(), "event 0: " + message);
  };
  const auto with = [](TraceEvent e, auto change) {
    change(e);
    return e;
  };
  refused(with(insertion, [&](TraceEvent& e) { e.vertex = id(4); }),
          "insertion of vertex index 4, but the next new one is 3");
  refused(with(insertion, [&](TraceEvent& e) { e.vertex = {}; }), "insertion without a vertex");
  refused(with(insertion, [&](TraceEvent& e) { e.point.w = std::nan(""); }),
          "insertion of point 3 at what is not finite; expected finite numbers");
  refused(with(insertion, [&](TraceEvent& e) { e.link.pop_back(); }), "insertion of point 3 in what is no triangle");
  refused(with(insertion, [&](TraceEvent& e) { std::swap(e.link[0], e.link[1]); }),
          "insertion of point 3 in the triangle of point 2, point 1 and point 0, which is not in the mesh");
  refused(with(insertion, [&](TraceEvent& e) { e.point.x = 2; }),
          "insertion of point 3, which is not inside the triangle of point 1, point 2 and point 0");
  refused(with(split, [&](TraceEvent& e) { e.quad[3] = id(2); }),
          "split of the edge from point 0 to point 1 between other vertices than are beside it");
  refused(with(split, [&](TraceEvent& e) { std::swap(e.quad[0], e.quad[1]); }),
          "split of the edge from point 1 to point 0, which is not in the mesh");
  refused(with(split, [&](TraceEvent& e) { e.point.x = 1; }),
          "split of the edge from point 0 to point 1 at a place that is not on it");
}

// --- the boundary ---------------------------------------------------------------------------------------------

Mesh rotated(Mesh mesh, double angle) {
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    const double c = std::cos(angle), s = std::sin(angle);
    mesh.set_point(v, {c * p.x - s * p.y, s * p.x + c * p.y, p.w});
  }
  return mesh;
}

std::vector<std::pair<Vec2, Vec2>> boundary_edges(const Mesh& mesh) {
  std::vector<std::pair<Vec2, Vec2>> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) edges.emplace_back(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)));
  }
  return edges;
}

double distance(Vec2 p, const std::pair<Vec2, Vec2>& edge) {
  const Vec2 along = edge.second - edge.first;
  const double t = std::clamp(dot(p - edge.first, along) / squared_length(along), 0.0, 1.0);
  return length(p - (edge.first + t * along));
}

double distance(Vec2 p, const std::vector<std::pair<Vec2, Vec2>>& edges) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& edge : edges) least = std::min(least, distance(p, edge));
  return least;
}

constexpr int kSweeps = 40;

/// The distance by which rounding may move a place off its line: one unit in the last place of the coordinates per
/// sweep.
double rounding(const Mesh& mesh) {
  double largest = 0;
  for (const VertexId v : mesh.vertices()) {
    largest = std::max({largest, std::abs(mesh.position(v).x), std::abs(mesh.position(v).y)});
  }
  return kSweeps * std::numeric_limits<double>::epsilon() * largest;
}

double perimeter(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b] : boundary_edges(mesh)) sum += length(b - a);
  return sum;
}

/// Runs, replays, and checks the laws of all boundary options.
OptimizeReport run(const Mesh& input, Mesh& mesh, OptimizeOptions options) {
  Events events;
  OptimizeHooks hooks;
  hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
  options.max_sweeps = kSweeps;
  mesh = input;
  const auto report = optimize(mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  if (!report) return {};
  const auto again = replay_with_vertices(input, events);
  EXPECT_TRUE(again) << again.error().what();
  if (again) {
    EXPECT_EQ(again->mesh, mesh);
    EXPECT_EQ(again->vertices, report->vertices);
  }
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_NEAR(test::area(mesh), test::area(input), rounding(input) * perimeter(input));
  return *report;
}

TEST(Boundary, SlidingKeepsShapeAndCorners) {
  const Mesh straight = *sheared_grid({.nx = 10, .ny = 6, .shear = 0.3});
  for (const double angle : {0.0, 0.4}) {
    const Mesh input = rotated(straight, angle);
    for (const Solver solver : {Solver::newton, Solver::golden, Solver::alternating}) {
      Mesh mesh;
      run(input, mesh, {.boundary = BoundaryVertices::slide, .repair = Repair::none, .paper = {.solver = solver}});
      ASSERT_EQ(mesh.n_vertices(), input.n_vertices());
      const auto edges = boundary_edges(input);
      int slid = 0;
      for (const VertexId v : input.vertices()) {
        if (!input.is_boundary(v)) continue;
        EXPECT_LT(distance(mesh.position(v), edges), rounding(input));
        slid += mesh.position(v) != input.position(v) ? 1 : 0;
        const bool corner = v.index == 0 || v.index == 10 || v.index == 66 || v.index == 76;
        EXPECT_TRUE(!corner || mesh.position(v) == input.position(v)) << v.index;
      }
      EXPECT_GT(slid, 10);
      if (angle != 0) continue;
      for (const VertexId v : input.vertices()) {  // axis-parallel sides stay exactly
        const double y = input.position(v).y;
        const bool on_side = y == 0 || y == input.position(VertexId(76)).y;
        EXPECT_TRUE(!on_side || mesh.position(v).y == y) << v.index;
      }
    }
  }
}

TEST(Boundary, FixedVerticesAndEndsOfInterfacesDoNotSlide) {
  Mesh input = *sheared_grid({.nx = 10, .ny = 6, .shear = 0.3});
  for (const TriangleId t : input.triangles()) {
    const auto [a, b, c] = input.corners(t);
    input.set_region(t, std::min({a.index % 11, b.index % 11, c.index % 11}) < 5 ? 1 : 2);
  }
  for (const HalfedgeId h : input.halfedges()) {
    if (input.is_boundary(h)) continue;
    if (input.region(Mesh::triangle(h)) != input.region(Mesh::triangle(input.twin(h)))) input.set_constrained(h, true);
  }
  input.set_fixed(VertexId(2), true);
  Mesh mesh;
  run(input, mesh, {.boundary = BoundaryVertices::slide, .repair = Repair::none});
  for (const std::size_t v : {2u, 5u, 71u}) EXPECT_EQ(mesh.position(VertexId(v)), input.position(VertexId(v))) << v;
  EXPECT_NE(mesh.position(VertexId(3)), input.position(VertexId(3)));
}

TEST(Boundary, SplittingKeepsTheVerticesThatWereThereAndTheShape) {
  for (const bool far_away : {false, true}) {
    const Mesh input = far_away ? displaced(*horseshoe()) : *horseshoe();
    Mesh mesh;
    const OptimizeReport report = run(input, mesh, {.boundary = BoundaryVertices::split, .repair = Repair::none});
    ASSERT_GT(report.vertices_inserted, 0u);
    EXPECT_EQ(report.vertices_removed, 0u);
    ASSERT_EQ(mesh.n_vertices(), input.n_vertices() + report.vertices_inserted);
    ASSERT_EQ(report.vertices.size(), mesh.n_vertices());
    const auto edges = boundary_edges(input);
    std::size_t on_boundary = 0;  // other new vertices are in triangles that had no free corner
    for (const VertexId v : mesh.vertices()) {
      if (v.index < input.n_vertices()) {
        EXPECT_EQ(report.vertices[v], v);
        EXPECT_TRUE(!input.is_boundary(v) || mesh.position(v) == input.position(v));
      } else {
        EXPECT_FALSE(report.vertices[v].valid());
        if (!mesh.is_boundary(v)) continue;
        ++on_boundary;
        EXPECT_LT(distance(mesh.position(v), edges), rounding(input));
      }
    }
    EXPECT_GT(on_boundary, 0u);
    EXPECT_EQ(boundary_edges(mesh).size(), edges.size() + on_boundary);
    EXPECT_LT(plan_boundary_grading(mesh, 2).ratio_before, 4 * (1 + 1e-9));
    EXPECT_NE(report.notes.front().find("vertices inserted on the boundary"), std::string::npos);
  }
}

double shortest_edge(const Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const HalfedgeId h : mesh.halfedges()) {
    least = std::min(least, length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h))));
  }
  return least;
}

/// A corner with few degrees, whose sides are divided differently.
Mesh sharp_corner(double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  std::vector<Vec2> points = {{0, 0}};
  for (const double r : {0.9, 2.1, 3.0, 4.2}) points.push_back({r, 0});
  for (const double r : {4.4, 3.3, 2.4, 1.3}) points.push_back({r * std::cos(angle), r * std::sin(angle)});
  std::vector<std::array<std::int32_t, 2>> sides;
  for (std::int32_t i = 0; i < 9; ++i) sides.push_back({i, (i + 1) % 9});
  return *constrained_delaunay({.points = points, .segments = sides});
}

TEST(Boundary, SplittingASharpCornerEndsLongBeforeRounding) {
  for (const double angle : {1.1, 3.0, 10.0, 40.0}) {
    const Mesh input = sharp_corner(angle);
    Mesh mesh;
    const OptimizeReport report = run(input, mesh, {.boundary = BoundaryVertices::split, .repair = Repair::none});
    EXPECT_LT(report.vertices_inserted, 200u) << angle;
    EXPECT_GT(shortest_edge(mesh), 1e-2 * shortest_edge(input)) << angle;
  }
}

/// The strip y < 1 of a box. Its upper side is divided evenly, and its lower side at other places.
Mesh uneven_strip() {
  std::vector<Vec2> points = {{0, 0}};
  for (const double x : {1.3, 1.9, 4.1, 4.9, 7.2}) points.push_back({x, 0});
  for (int i = 8; i >= 0; --i) points.push_back({static_cast<double>(i), 1});
  std::vector<std::array<std::int32_t, 2>> sides;
  const auto n = static_cast<std::int32_t>(points.size());
  for (std::int32_t i = 0; i < n; ++i) sides.push_back({i, (i + 1) % n});
  return *constrained_delaunay({.points = points, .segments = sides});
}

TEST(Boundary, CutsWhereTrianglesAreBadAreAtTheirCornersAlone) {
  const Mesh input = uneven_strip();
  const OptimizeOptions options = {.boundary = BoundaryVertices::split};
  WorkingCopy work(input, options.paper.order);
  auto settings = make_settings(options, input, WorkingUnits::of(input), {});
  ASSERT_TRUE(settings);
  const Tracer nobody;
  const Recorder recorder(nobody, work, 1);
  const SweepState state(*settings);
  Flipper flipper(work.mesh, *settings, state, recorder);
  ASSERT_TRUE(flipper.restore_all());
  IdVector<VertexId, bool> is_near(work.mesh.n_vertices(), false);
  for (const TriangleId t : bad_triangles(work.mesh)) {
    for (const VertexId v : work.mesh.corners(t)) is_near[v] = true;
  }
  std::vector<std::pair<VertexId, VertexId>> edges;
  for (const HalfedgeId h : work.mesh.halfedges()) {
    if (work.mesh.is_boundary(h)) edges.emplace_back(work.mesh.origin(h), work.mesh.target(h));
  }
  const std::size_t n = work.mesh.n_vertices();
  const SplitCounts cuts = split_where_bad(work, flipper);
  EXPECT_GT(cuts.vertices, 0u);
  EXPECT_EQ(work.mesh.n_vertices(), n + cuts.vertices);
  EXPECT_EQ(count_non_regular_edges(work.mesh, false), 0u);
  EXPECT_EQ(work.mesh.validate(), std::nullopt);
  EXPECT_EQ(boundary_edges(work.mesh).size(), edges.size() + cuts.vertices);
  std::size_t whole = 0;
  for (const auto& [a, b] : edges) {
    const bool is_cut = !work.mesh.find_halfedge(a, b).valid();
    EXPECT_TRUE(!is_cut || is_near[a] || is_near[b]);
    whole += is_cut ? 0 : 1;
  }
  EXPECT_GT(whole, 0u);
}

TEST(Boundary, SplittingNeverLeavesMoreTrianglesBadThanLeavingItAsItIs) {
  std::vector<Mesh> inputs = {*wedge({.angle_deg = 1}), *horseshoe(), letter_a()};
  for (const double angle : {1.1, 3.0, 10.0, 20.0, 40.0}) inputs.push_back(sharp_corner(angle));
  for (const Mesh& input : inputs) {
    Mesh kept = input, split = input;
    const OptimizeOptions keep = {.objective = Objective::energy, .repair = Repair::none};
    OptimizeOptions cut = keep;
    cut.boundary = BoundaryVertices::split;
    ASSERT_TRUE(optimize(kept, keep));
    const auto report = optimize(split, cut);
    ASSERT_TRUE(report);
    EXPECT_LE(count_bad(split, nullptr), count_bad(kept, nullptr));
    if (report->notes.empty() || report->notes.front().find("were not split") == std::string::npos) continue;
    EXPECT_EQ(split.n_vertices(), input.n_vertices());
  }
}

TEST(Boundary, WhereAllCornersStayTheReportNamesWhatLetsThemMove) {
  const std::vector<Vec2> points = {{0, 0}, {0.1, 0}, {2.9, 0}, {3, 0}, {3, 1}, {2.9, 1}, {0.1, 1}, {0, 1}};
  std::vector<std::array<std::int32_t, 2>> sides;
  for (std::int32_t i = 0; i < 8; ++i) sides.push_back({i, (i + 1) % 8});
  const Mesh input = *constrained_delaunay({.points = points, .segments = sides});
  const auto names_sliding = [](const OptimizeReport& report) {
    return std::any_of(report.notes.begin(), report.notes.end(), [](const std::string& note) {
      return note.find("have to stay: `boundary=slide` would let some of them move") != std::string::npos;
    });
  };
  Mesh mesh;
  const OptimizeReport kept = run(input, mesh, {.unknowns = Unknowns::positions});
  ASSERT_GT(count_bad(mesh, nullptr), 0u);
  EXPECT_TRUE(names_sliding(kept));
  const OptimizeReport slid = run(input, mesh, {.unknowns = Unknowns::positions, .boundary = BoundaryVertices::slide});
  EXPECT_FALSE(names_sliding(slid));
}

TEST(Boundary, SplittingLeavesTheDenseHorseshoeWideMargins) {
  Mesh mesh;
  run(*horseshoe(), mesh, {.boundary = BoundaryVertices::split});
  const Quality q = quality(mesh);
  EXPECT_EQ(q.well_centered_fraction, 1);
  EXPECT_GE(q.min_h_over_l, 0.05);
  EXPECT_GE(q.min_d_over_l, 0.05);
}

TEST(Boundary, IsKeptBitForBitOtherwise) {
  const Mesh input = *horseshoe();
  Mesh mesh;
  run(input, mesh, {.repair = Repair::none});
  EXPECT_EQ(boundary_edges(mesh).size(), boundary_edges(input).size());
  for (const VertexId v : input.vertices()) {
    EXPECT_TRUE(!input.is_boundary(v) || mesh.position(v) == input.position(v));
  }
}

}  // namespace
}  // namespace temper
