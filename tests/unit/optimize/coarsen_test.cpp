// Coarsening removes vertices. All else that holds of a run stays true: no bad triangles, boundary and fixed vertices
// bit for bit, traces, and the same bytes again.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "optimize/coarsen/moves.hpp"
#include "optimize/coarsen/size_limit.hpp"
#include "support/lattice.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::max();

/// Moves are few: each one is tested by slow assertions.
OptimizeOptions coarsening(double factor) {
  return {.objective = Objective::energy, .coarsen = factor, .coarsen_moves = 60};
}

Mesh good_lattice() {
  Mesh mesh = test::lattice({.n = 8, .jitter = 0.05, .weight = 0});
  EXPECT_TRUE(optimize(mesh));
  EXPECT_EQ(defect_of(mesh).bad, 0u);
  return mesh;
}

std::multiset<std::pair<double, double>> places_on_boundary(const Mesh& mesh) {
  std::multiset<std::pair<double, double>> places;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) places.insert({mesh.position(v).x, mesh.position(v).y});
  }
  return places;
}

bool has_vertex_at(const Mesh& mesh, Vec2 p) {
  const auto all = mesh.vertices();
  return std::any_of(all.begin(), all.end(), [&](VertexId v) { return mesh.position(v) == p; });
}

TEST(Coarsening, LeavesFewerVerticesAndNothingBad) {
  const Mesh input = good_lattice();
  for (const Unknowns unknowns : {Unknowns::positions_and_weights, Unknowns::positions}) {
    for (const double factor : {1.5, 3.0, kNoLimit}) {
      SCOPED_TRACE(testing::Message() << factor);
      OptimizeOptions options = coarsening(factor);
      options.unknowns = unknowns;
      Mesh mesh = input;
      if (unknowns == Unknowns::positions) {
        for (const VertexId v : mesh.vertices()) mesh.set_point(v, mesh.space().with_weight(mesh.point(v), 0));
        ASSERT_TRUE(optimize(mesh, {.unknowns = unknowns}));
        ASSERT_EQ(defect_of(mesh).bad, 0u);
      }
      const auto report = optimize(mesh, options);
      ASSERT_TRUE(report);
      EXPECT_EQ(defect_of(mesh).bad, 0u);
      EXPECT_EQ(count_non_regular_edges(mesh), 0u);
      EXPECT_EQ(mesh.validate(), std::nullopt);
      EXPECT_LT(mesh.n_vertices(), input.n_vertices());
      EXPECT_EQ(mesh.n_vertices(), input.n_vertices() + report->vertices_inserted - report->vertices_removed);
      EXPECT_EQ(places_on_boundary(mesh), places_on_boundary(input));
      if (unknowns != Unknowns::positions) continue;
      for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.weight(v), mesh.weight(VertexId(0)));
    }
  }
}

TEST(Coarsening, KeepsFixedVerticesAndLines) {
  Mesh input = good_lattice();
  std::vector<Vec2> fixed;
  for (std::size_t i = 0; i < input.n_vertices(); i += 7) {
    input.set_fixed(VertexId(i), true);
    fixed.push_back(input.position(VertexId(i)));
  }
  HalfedgeId line;
  for (const HalfedgeId h : input.halfedges()) {
    const bool inner = !input.is_boundary(input.origin(h)) && !input.is_boundary(input.target(h));
    if (inner && !input.is_fixed(input.origin(h)) && !input.is_fixed(input.target(h))) line = h;
  }
  ASSERT_TRUE(line.valid());
  input.set_constrained(line, true);
  const Vec2 a = input.position(input.origin(line)), b = input.position(input.target(line));
  Mesh mesh = input;
  ASSERT_TRUE(optimize(mesh, coarsening(kNoLimit)));
  EXPECT_LT(mesh.n_vertices(), input.n_vertices());
  for (const Vec2 p : fixed) EXPECT_TRUE(has_vertex_at(mesh, p));
  std::size_t covered = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    covered += mesh.is_constrained(h) && mesh.position(mesh.origin(h)) == a && mesh.position(mesh.target(h)) == b;
  }
  EXPECT_EQ(covered, 1u);
}

TEST(Coarsening, MakesNoSizeLargerThanTheLimit) {
  const Mesh input = good_lattice();
  const SizeField field = input_size_field(input);
  std::size_t least = input.n_vertices();
  for (const double factor : {1.3, 2.0}) {  // sweeps before the search change sizes by less
    Mesh mesh = input;
    ASSERT_TRUE(optimize(mesh, coarsening(factor)));
    for (const VertexId v : mesh.vertices()) {
      EXPECT_LE(local_size(mesh, v), factor * field.at(mesh.point(v)).size * (1 + 1e-12)) << factor;
    }
    EXPECT_LE(mesh.n_vertices(), least) << "a larger factor allows as few vertices";
    least = mesh.n_vertices();
  }
  EXPECT_LT(least, input.n_vertices());
}

TEST(Coarsening, NeverHasMoreVerticesOrABadTriangleLater) {
  Mesh mesh = good_lattice();
  std::size_t vertices = mesh.n_vertices(), rounds = 0;
  OptimizeHooks hooks;
  hooks.snapshots = [&](const Snapshot& s) {
    if (s.moment != Snapshot::Moment::after_sweep) return;
    ++rounds;
    EXPECT_LE(s.mesh.n_vertices(), vertices);
    EXPECT_EQ(defect_of(s.mesh).bad, 0u);
    vertices = s.mesh.n_vertices();
  };
  ASSERT_TRUE(optimize(mesh, coarsening(kNoLimit), hooks));
  EXPECT_GT(rounds, 1u);
  EXPECT_EQ(mesh.n_vertices(), vertices);
}

TEST(Coarsening, GivesTheSameBytesForTheSameSeedAndIsTraced) {
  const Mesh input = good_lattice();
  std::vector<TraceEvent> events;
  OptimizeHooks hooks;
  hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
  Mesh first = input, second = input;
  ASSERT_TRUE(optimize(first, coarsening(2), hooks));
  ASSERT_TRUE(optimize(second, coarsening(2)));
  EXPECT_EQ(first, second);
  const auto again = replay(input, events);
  ASSERT_TRUE(again) << again.error().what();
  EXPECT_EQ(*again, first);
}

TEST(Coarsening, ReturnsAGoodMeshWhenItIsStopped) {
  const Mesh input = good_lattice();
  for (int allowed = 5; allowed < 100; allowed += 30) {
    int asked = 0;
    OptimizeHooks hooks;
    hooks.observer = [&](const Progress&) { return ++asked > allowed ? Continue::no : Continue::yes; };
    Mesh mesh = input;
    const auto report = optimize(mesh, coarsening(kNoLimit), hooks);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->stopped, Stopped::canceled);
    EXPECT_EQ(defect_of(mesh).bad, 0u);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_LE(mesh.n_vertices(), input.n_vertices());
  }
}

TEST(Coarsening, RefusesWhatItCannotKeep) {
  const Mesh input = test::lattice({.n = 4, .jitter = 0.02, .weight = 0});
  const auto is_refused = [&](OptimizeOptions options) {
    Mesh mesh = input;
    options.coarsen = options.coarsen.value_or(2);
    const auto report = optimize(mesh, options);
    return !report && mesh == input;
  };
  EXPECT_FALSE(is_refused({}));
  EXPECT_TRUE(is_refused({.coarsen = 0.5}));
  EXPECT_TRUE(is_refused({.energy = EnergyKind::T}));
  EXPECT_TRUE(is_refused({.unknowns = Unknowns::weights}));
  EXPECT_TRUE(is_refused({.flips = Flips::none}));
  EXPECT_TRUE(is_refused({.size_band = 2}));
  EXPECT_TRUE(is_refused({.guard = {.angle = 60}}));
}

// --- the parts ------------------------------------------------------------------------------------------

const WorkingUnits kUnits;

struct MiddleOfMesh {
  WorkingCopy work;
  Settings settings;
  Neighborhood around;
};

MiddleOfMesh middle_of(const Mesh& mesh, int rings = 3) {
  Settings settings = settings_of_copies(*make_settings({}, mesh, kUnits));
  const WorkingCopy work = WorkingCopy::part(mesh);
  Neighborhood around = neighborhood_of(work, TriangleId(mesh.n_triangles() / 2), rings);
  return {work, std::move(settings), std::move(around)};
}

TEST(SearchCopy, ReturnsToAnEarlierStateBitForBit) {
  const auto [work, settings, around] = middle_of(good_lattice());
  SearchCopy copy(around, settings, kUnits, true);
  Rng rng(1);
  std::size_t changes = 0;
  for (const VertexId v : around.mesh.vertices()) {
    const Mesh before = copy.mesh();
    const SearchCopy::State state = copy.state();
    if (copy.may_be_removed(v) ? copy.remove(v) : copy.insert_near(around.seed, rng)) copy.improve();
    changes += copy.mesh() == before ? 0 : 1;
    copy.return_to(state);
    EXPECT_EQ(copy.mesh(), before);
  }
  EXPECT_GT(changes, 3u);
  EXPECT_TRUE(copy.take_events().empty());
}

TEST(Moves, CountVerticesAndReplay) {
  const auto [work, settings, around] = middle_of(good_lattice());
  std::vector<VertexId> removable;
  for (const VertexId v : around.mesh.vertices()) {
    if (around.frozen[v.index] == 0 && may_be_removed(work, around.vertices[v.index])) removable.push_back(v);
  }
  ASSERT_GE(removable.size(), 3u);
  std::size_t valid = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Move move = {.kind = seed % 2 == 0 ? Move::exchange : Move::crowd, .most_inserted = 2, .seed = seed};
    if (move.kind == Move::exchange) {
      move.removed.assign(removable.begin(), removable.begin() + 1 + static_cast<std::ptrdiff_t>(seed % 3));
    }
    const MoveResult result = try_move(around, move, settings, kUnits, true);
    if (!result.valid) continue;
    ++valid;
    const auto after = replay(around.mesh, result.events);
    ASSERT_TRUE(after);
    EXPECT_EQ(static_cast<int>(after->n_vertices()), static_cast<int>(around.mesh.n_vertices()) + result.more_vertices);
    EXPECT_EQ(defect_of(*after), result.defect);
    const MoveResult again = try_move(around, move, settings, kUnits, false);
    EXPECT_EQ(again.defect, result.defect);
    EXPECT_EQ(again.more_vertices, result.more_vertices);
  }
  EXPECT_GT(valid, 5u);
}

TEST(SizeLimit, CountsTheTrianglesOutsideAPlace) {
  const auto [work, settings, around] = middle_of(good_lattice());
  const SizeField field = input_size_field(work.mesh);
  EXPECT_TRUE(SizeLimit(work, field, 1).allows(around, around.mesh)) << "nothing changes";
  std::size_t allowed = 0, refused = 0;
  for (const VertexId v : around.mesh.vertices()) {
    if (around.frozen[v.index] != 0 || !may_be_removed(work, around.vertices[v.index])) continue;
    const MoveResult result = try_move(around, {.removed = {v}}, settings, kUnits, true);
    if (!result.valid) continue;
    EXPECT_FALSE(SizeLimit(work, field, 1).allows(around, result.mesh)) << "neighbors grow";
    for (const double factor : {1.05, 1.2, 1.5, 4.0}) {
      SizeLimit(work, field, factor).allows(around, result.mesh) ? ++allowed : ++refused;
    }
    EXPECT_TRUE(SizeLimit(work, field, 4).allows(around, result.mesh));
  }
  EXPECT_GT(allowed, 0u);
  EXPECT_GT(refused, 0u);
}

TEST(SizeLimit, HoldsOnTheRim) {
  const auto [work, settings, around] = middle_of(good_lattice(), 1);
  std::vector<double> sizes;
  for (const VertexId v : work.mesh.vertices()) sizes.push_back(local_size(work.mesh, v));
  constexpr double kAnySize = 1000;
  std::size_t removals = 0;
  for (const VertexId v : around.mesh.vertices()) {
    if (around.frozen[v.index] == 0) sizes[around.vertices[v.index].index] = kAnySize;
  }
  const SizeField field = *SizeField::from_values(work.mesh, sizes);
  for (const VertexId v : around.mesh.vertices()) {
    if (around.frozen[v.index] != 0) continue;
    const MoveResult result = try_move(around, {.removed = {v}}, settings, kUnits, true);
    if (!result.valid) continue;
    ++removals;
    EXPECT_FALSE(SizeLimit(work, field, 1).allows(around, result.mesh)) << "vertices of the rim grow";
    EXPECT_TRUE(SizeLimit(work, field, 4).allows(around, result.mesh));
  }
  EXPECT_GT(removals, 0u);
}

}  // namespace
}  // namespace temper
