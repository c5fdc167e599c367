// Change::least: places that violate the criterion become good, and all else stays, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "optimize/repair/neighborhood.hpp"
#include "optimize/run/judge.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/detail/trace.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"
#include "topology/rings.hpp"

namespace temper::test {
namespace {

constexpr std::array kSchemes = {Scheme::all, Scheme::vertex, Scheme::cell};

OptimizeOptions least(Scheme scheme = Scheme::all) { return {.scheme = scheme, .change = Change::least}; }

bool says(const OptimizeReport& report, std::string_view what) {
  return std::ranges::any_of(report.notes, [&](const std::string& n) { return n.find(what) != std::string::npos; });
}

OptimizeReport least_changed(Mesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks = {}) {
  auto report = optimize(mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  EXPECT_EQ(mesh.validate(), std::nullopt);
  return *std::move(report);
}

/// Equilateral triangles, without a few inner vertices that a jump turns bad, in a mesh of n × n.
Mesh disturbed(int n, double amount, int every, std::uint64_t seed = 1) {
  Mesh mesh = lattice({.n = n, .jitter = 0, .weight = 0});
  Noise noise(seed);
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v) || v.index % static_cast<unsigned>(every) != 0) continue;
    mesh.set_position(v, mesh.position(v) + amount * Vec2{noise(), noise()});
  }
  return mesh;
}

/// Vertices that have more than `rings` rings between them and any violation.
std::vector<VertexId> far_from_violations(const Mesh& mesh, Criterion criterion, int rings) {
  std::vector<TriangleId> near = cells_at_violations(mesh, criterion);
  for (int i = 0; i < rings; ++i) near = triangles_around(mesh, near);
  std::set<VertexId> corners;
  for (const TriangleId t : near) {
    for (const VertexId v : mesh.corners(t)) corners.insert(v);
  }
  std::vector<VertexId> far;
  for (const VertexId v : mesh.vertices()) {
    if (!corners.contains(v)) far.push_back(v);
  }
  return far;
}

std::set<std::array<std::uint32_t, 2>> edges_of(const Mesh& mesh) {
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    const auto [a, b] = std::minmax({mesh.origin(h).index, mesh.target(h).index});  // by value
    edges.insert({a, b});
  }
  return edges;
}

TEST(LeastChange, OfAMeshThatMeetsTheCriterionIsNone) {
  const Mesh equilateral = lattice({.n = 9, .jitter = 0.02, .weight = 0.01});
  const Mesh squares = *sheared_grid({.nx = 8, .ny = 7, .shear = 0});
  const Mesh cap = lattice({.n = 8, .jitter = 0.02, .weight = 0.01, .radius = 30});
  for (const Scheme scheme : kSchemes) {
    for (const Mesh& input : {equilateral, squares, cap}) {
      if (!meets(input, criterion_of(scheme))) continue;
      for (const bool exclusive : {false, true}) {
        Mesh mesh = input;
        const OptimizeReport report = least_changed(mesh, least(scheme), {.exclusive = exclusive});
        EXPECT_EQ(mesh, input);
        EXPECT_EQ(report.sweeps, 0);
        ASSERT_TRUE(report.changed);
        EXPECT_EQ(report.changed->vertices_moved + report.changed->weights_changed + report.changed->edges_changed, 0u);
        EXPECT_TRUE(says(report, "it comes back as it was"));
      }
    }
  }
  EXPECT_TRUE(meets(squares, Criterion::coefficients));
  EXPECT_TRUE(meets(cap, Criterion::well_centered));
}

TEST(LeastChange, ReachesOnlyAFewRings) {
  constexpr int kMostRings = 7;  // six of a place, and one for vertices that flips join to it
  for (const Scheme scheme : kSchemes) {
    SCOPED_TRACE(static_cast<int>(scheme));
    const Criterion criterion = criterion_of(scheme);
    const Mesh input = disturbed(60, 0.75, 397);
    ASSERT_FALSE(meets(input, criterion));
    Mesh mesh = input;
    const OptimizeReport report = least_changed(mesh, least(scheme));
    EXPECT_TRUE(meets(mesh, criterion));
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
    const std::vector<VertexId> far = far_from_violations(input, criterion, kMostRings);
    EXPECT_GT(far.size(), mesh.n_vertices() / 4);
    for (const VertexId v : far) EXPECT_EQ(mesh.point(v), input.point(v));
    EXPECT_LT(report.changed->vertices_moved, mesh.n_vertices() / 20);
  }
}

TEST(LeastChange, CountsWhatChanged) {
  const Mesh input = disturbed(40, 0.75, 97);
  Mesh mesh = input;
  const OptimizeReport report = least_changed(mesh, least());
  std::size_t moved = 0, weighed = 0;
  for (const VertexId v : input.vertices()) {
    moved += mesh.position(v) == input.position(v) ? 0 : 1;
    weighed += mesh.weight(v) == input.weight(v) ? 0 : 1;
  }
  std::vector<std::array<std::uint32_t, 2>> fresh;
  std::ranges::set_difference(edges_of(mesh), edges_of(input), std::back_inserter(fresh));
  EXPECT_GT(moved + weighed, 0u);
  EXPECT_EQ(report.changed->vertices_moved, moved);
  EXPECT_EQ(report.changed->weights_changed, weighed);
  EXPECT_EQ(report.changed->edges_changed, fresh.size());
  Mesh other = input;
  EXPECT_FALSE(optimize(other)->changed);
}

// Squares with diagonals, whose coefficients are zero. Where a vertex has moved, some of them must flip.
TEST(LeastChange, IsAFlipWhereAFlipIsEnough) {
  Mesh input = *sheared_grid({.nx = 30, .ny = 30, .shear = 0});
  for (std::size_t i = 100; i < 800; i += 97) {
    if (input.is_boundary(VertexId(i))) continue;
    input.set_position(VertexId(i), input.position(VertexId(i)) + Vec2{0.06, 0.05});
  }
  Mesh mesh = input;
  const OptimizeReport report = least_changed(mesh, least(Scheme::vertex));
  EXPECT_TRUE(meets(mesh, Criterion::coefficients));
  EXPECT_EQ(report.changed->vertices_moved + report.changed->weights_changed, 0u);
  EXPECT_EQ(report.changed->edges_changed, report.flips);
  EXPECT_GT(report.flips, 0u);
}

TEST(LeastChange, NeverLeavesMoreViolations) {
  std::size_t left = 0, cured = 0;
  for (const Scheme scheme : kSchemes) {
    const Criterion criterion = criterion_of(scheme);
    for (const Mesh& input :
         {*horseshoe({.a = 6, .b = 7}), mesh_with_regions(60, 2), layers({.columns = 6, .rows = 8}),
          *regular_polygon({.corners = 17}), lattice({.n = 14, .jitter = 0.3, .weight = 0.3, .seed = 3})}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(scheme) << ", " << input.n_triangles() << " triangles");
      Mesh mesh = input;
      OptimizeOptions options = least(scheme);
      options.repair_trials = 300;
      const OptimizeReport report = least_changed(mesh, options);
      const std::size_t before = cells_at_violations(input, criterion).size(),
                        after = cells_at_violations(mesh, criterion).size();
      EXPECT_LE(after, before);
      EXPECT_LE(count_non_regular_edges(mesh, false), count_non_regular_edges(input, false));
      (after == 0 ? cured : left) += 1;
      if (after > 0 && scheme != Scheme::all) {
        EXPECT_TRUE(says(report, "violate"));
      }
    }
  }
  EXPECT_GT(cured, 5u);
  EXPECT_GT(left, 0u);
}

TEST(LeastChange, OfAMeshFullOfBadPlacesIsThatOfTheWholeMesh) {
  const Mesh input = *random_mesh({.vertices = 400, .seed = 5});
  Mesh mesh = input;
  const OptimizeReport report = least_changed(mesh, least());
  EXPECT_EQ(report.bad_after, 0u);
  EXPECT_TRUE(says(report, "so many that the whole mesh was changed"));
}

TEST(LeastChange, HasTheSameBytesOnThreadsAndForAnyNumbering) {
  const Mesh input = disturbed(50, 0.75, 131);
  for (const Scheme scheme : kSchemes) {
    Mesh first = input, second = input;
    StdThreads threads(3);
    least_changed(first, least(scheme));
    least_changed(second, least(scheme), {.executor = &threads});
    EXPECT_GT(threads.runs(), 0u);
    EXPECT_EQ(first, second);

    std::vector<Vec2> points;
    std::vector<std::array<std::int32_t, 3>> triangles;
    const auto n = static_cast<std::int32_t>(input.n_vertices());
    for (const VertexId v : input.vertices()) points.push_back(input.position(v));
    std::reverse(points.begin(), points.end());
    for (const TriangleId t : input.triangles()) {
      const auto [a, b, c] = input.corners(t);
      triangles.push_back(
          {n - 1 - std::int32_t(a.index), n - 1 - std::int32_t(b.index), n - 1 - std::int32_t(c.index)});
    }
    std::reverse(triangles.begin(), triangles.end());
    Mesh reversed = Mesh::build({.points = points, .triangles = triangles})->mesh;
    const OptimizeReport report = least_changed(reversed, least(scheme));
    EXPECT_TRUE(meets(reversed, criterion_of(scheme)));
    EXPECT_LT(report.changed->vertices_moved, input.n_vertices() / 10);
  }
}

TEST(LeastChange, IsTraced) {
  const Mesh input = disturbed(40, 0.75, 97);
  for (const OptimizeOptions& options : {least(), least(Scheme::vertex)}) {
    Mesh mesh = input;
    std::vector<TraceEvent> events;
    OptimizeHooks hooks;
    hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
    least_changed(mesh, options, hooks);
    EXPECT_FALSE(events.empty());
    const auto again = replay(input, events);
    ASSERT_TRUE(again) << again.error().what();
    EXPECT_EQ(*again, mesh);
  }
}

TEST(LeastChange, ThatIsStoppedKeepsWhatItHas) {
  const Mesh input = disturbed(50, 0.75, 131);
  const std::size_t before = cells_at_violations(input, Criterion::well_centered).size();
  for (const int most : {0, 1, 5}) {
    Mesh mesh = input;
    int calls = 0;
    OptimizeHooks hooks;
    hooks.observer = [&](const Progress&) { return calls++ < most ? Continue::yes : Continue::no; };
    const OptimizeReport report = least_changed(mesh, least(), hooks);
    EXPECT_EQ(report.stopped, Stopped::canceled);
    EXPECT_LE(cells_at_violations(mesh, Criterion::well_centered).size(), before);
    EXPECT_EQ(calls, most + 1);
  }
}

TEST(LeastChange, KeepsWhatTheOptionsKeep) {
  const Mesh input = disturbed(40, 0.75, 97);
  for (const Unknowns unknowns : {Unknowns::positions, Unknowns::weights}) {
    OptimizeOptions options = least();
    options.unknowns = unknowns;
    Mesh mesh = input;
    const OptimizeReport report = least_changed(mesh, options);
    EXPECT_LT(report.bad_after, report.bad_before);
    EXPECT_EQ(unknowns == Unknowns::positions ? report.changed->weights_changed : report.changed->vertices_moved, 0u);
  }
}

TEST(LeastChange, IsWhatTargetValidStandsFor) {
  OptimizeOptions any = *options_for("any");
  any.change = Change::least;
  const OptimizeOptions valid = *options_for("valid");
  for (const OptionRow& row : option_rows()) EXPECT_EQ(row.get(valid), row.get(any)) << row.name;
}

TEST(LeastChange, RefusesOptionsOfOtherRuns) {
  Mesh mesh = disturbed(10, 0, 1);
  const auto refused = [&](auto&& change) {
    OptimizeOptions options = least();
    change(options);
    const auto report = optimize(mesh, options);
    return !report && report.error().message.find("change=") != std::string::npos;
  };
  EXPECT_TRUE(refused([](auto& o) { o.flips = Flips::none; }));
  EXPECT_TRUE(refused([](auto& o) { o.energy = EnergyKind::F; }));
  EXPECT_TRUE(refused([](auto& o) { o.paper.gamma = LengthParameter{0.1}; }));
  EXPECT_TRUE(refused([](auto& o) { o.objective = Objective::solver_error; }));
  EXPECT_TRUE(refused([](auto& o) { o.coarsen = 2; }));
  EXPECT_FALSE(refused([](auto& o) { o.paper.seed = 2; }));
}

// Squares meet the criterion of unknowns at vertices, though none of their triangles is well-centered.
TEST(NothingToDo, IsTheAnswerIfEveryChangeOfWhatMeetsTheCriterionRaisesErrors) {
  const Mesh input = *sheared_grid({.nx = 10, .ny = 10, .shear = 0});
  for (const auto& [error, scheme] : {std::pair(2.0, Scheme::vertex), {0.5, Scheme::vertex}, {2.0, Scheme::cell}}) {
    Mesh mesh = input;
    OptimizeHooks hooks;
    hooks.solvers.squared_errors = [&, error = error](const Mesh& m, Scheme, Executor*) {
      return std::vector<double>{m == input ? 1 : error};
    };
    const auto report = optimize(mesh, {.scheme = scheme}, hooks);
    ASSERT_TRUE(report);
    const bool comes_back = error > 1 && scheme == Scheme::vertex;
    EXPECT_EQ(mesh == input, comes_back);
    EXPECT_EQ(says(*report, "the input has all that the target needs, and a change"), comes_back);
  }
}

// An edge of the rim has two sides in the whole mesh, and is judged by both.
TEST(LeastChange, CountsInAPlaceWhatTheWholeMeshHasThere) {
  Mesh mesh = lattice({.n = 14, .jitter = 0.3, .weight = 0.3, .seed = 2});
  for (const TriangleId t : mesh.triangles()) mesh.set_region(t, mesh.point(mesh.corners(t)[0]).x > 7 ? 1 : 0);
  const WorkingCopy work = WorkingCopy::part(mesh);
  std::size_t found = 0;
  for (const Criterion criterion : {Criterion::coefficients, Criterion::distances}) {
    const std::vector<ViolatedEdge> whole = violated_edges(mesh, criterion);
    for (std::size_t t = 0; t < mesh.n_triangles(); t += 7) {
      const Neighborhood around = neighborhood_of(work, TriangleId(t), 2);
      using Key = std::array<std::uint32_t, 3>;
      std::multiset<Key> expected, here;
      const auto key = [](VertexId a, VertexId b, DualKind kind) {
        const auto [low, high] = std::minmax(a.index, b.index);
        return Key{low, high, static_cast<std::uint32_t>(kind)};
      };
      const auto is_here = [&](HalfedgeId h) {
        const auto& all = around.vertices;
        const auto a = std::ranges::find(all, mesh.origin(h)), b = std::ranges::find(all, mesh.target(h));
        if (a == all.end() || b == all.end()) return false;
        const VertexId p(static_cast<std::size_t>(a - all.begin())), q(static_cast<std::size_t>(b - all.begin()));
        return around.mesh.find_halfedge(p, q).valid();
      };
      for (const ViolatedEdge& e : whole) {
        const bool part = e.kind == DualKind::region;
        if (!is_here(e.edge) && (part || mesh.is_boundary(e.edge) || !is_here(mesh.twin(e.edge)))) continue;
        expected.insert(key(mesh.origin(e.edge), mesh.target(e.edge), e.kind));
      }
      for (const ViolatedEdge& e : violated_edges(around, around.mesh, criterion)) {
        const VertexId a = around.mesh.origin(e.edge), b = around.mesh.target(e.edge);
        const VertexId p = around.vertices[a.index], q = around.vertices[b.index];
        const bool part = e.kind == DualKind::boundary && around.is_rim(a, b);  // an interface at the rim
        here.insert(key(p, q, part ? DualKind::region : e.kind));
        ++found;
      }
      EXPECT_EQ(here, expected);
    }
  }
  EXPECT_GT(found, 50u);
}

}  // namespace
}  // namespace temper::test
