// The variations of Algorithm 1 that the paper names in §5.2 and §7. Each is compared with its naive twin: a loop over
// runs without the switch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "energy/patch.hpp"
#include "optimize/step/descent.hpp"
#include "optimize/step/removal.hpp"
#include "support/lattice.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

Mesh mesh_of_random_points() {
  auto mesh = random_mesh({.vertices = 150, .seed = 4});
  EXPECT_TRUE(mesh);
  return *std::move(mesh);
}

/// Algorithm 1 without removals, one sweep of it.
OptimizeOptions one_sweep(EnergyKind energy) {
  OptimizeOptions o = *options_for("paper");
  o.energy = energy;
  o.paper.inversion = Inversion::refuse;
  o.paper.hidden = HiddenPolicy::undo;
  o.paper.collapse_from = std::nullopt;
  o.paper.removal = Removal::none;
  o.paper.anchor = {};
  o.max_sweeps = 1;
  return o;
}

Mesh after(Mesh mesh, const OptimizeOptions& options) {
  const auto report = optimize(mesh, options);
  EXPECT_TRUE(report);
  return mesh;
}

TEST(SearchRadius, IsTheRootMeanSquareTheFarthestOrTheNearest) {
  const Mesh mesh = lattice({.jitter = 0.3, .weight = 0.1});
  Patch patch;
  for (const VertexId v : mesh.vertices()) {
    gather_patch(mesh, v, false, patch);
    std::vector<double> lengths;
    double squares = 0;
    for (const VertexId q : patch.link) {
      const Vec2 to = mesh.position(q) - mesh.position(v);
      lengths.push_back(std::hypot(to.x, to.y));
      squares += lengths.back() * lengths.back();
    }
    const WeightedPoint p = mesh.point(v);
    EXPECT_NEAR(patch_radius(patch, p, SearchRadius::rms), std::sqrt(squares / double(lengths.size())), 1e-14);
    EXPECT_NEAR(patch_radius(patch, p, SearchRadius::max), *std::max_element(lengths.begin(), lengths.end()), 1e-14);
    EXPECT_NEAR(patch_radius(patch, p, SearchRadius::min), *std::min_element(lengths.begin(), lengths.end()), 1e-14);
  }
}

// One search for a weight per sweep: no weight moves farther, and some move nearly as far.
TEST(SearchRadius, BoundsTheWayOfAWeight) {
  const Mesh input = mesh_of_random_points();
  Patch patch;
  for (const SearchRadius radius : {SearchRadius::min, SearchRadius::rms, SearchRadius::max}) {
    for (const double reach : {0.001, 0.1}) {
      OptimizeOptions o = one_sweep(EnergyKind::T);
      o.unknowns = Unknowns::weights;
      o.paper.search_radius = radius;
      o.paper.weight_search_radius = reach;
      double most = 0;
      OptimizeHooks hooks;
      hooks.tracer = [&](const TraceEvent& e) {
        if (e.kind != EventKind::weight || e.sweep != 1) return;
        gather_patch(input, e.vertex, false, patch);
        const double r = patch_radius(patch, input.point(e.vertex), radius);
        most = std::max(most, std::abs(e.point.w - input.weight(e.vertex)) / (reach * r * r));
      };
      Mesh mesh = input;
      ASSERT_TRUE(optimize(mesh, o, hooks));
      EXPECT_GT(most, 0.9);
      EXPECT_LE(most, 1 + 1e-9);
    }
  }
}

// The twin: all other vertices are fixed.
TEST(PositionUpdates, DeferredAreThoseOfEachVertexAlone) {
  const Mesh input = lattice({.n = 6, .jitter = 0.2, .weight = 0});
  for (const Solver solver : {Solver::golden, Solver::newton}) {
    OptimizeOptions o = one_sweep(EnergyKind::T);
    o.unknowns = Unknowns::positions;
    o.paper.solver = solver;
    o.paper.inner = 1;
    std::vector<Vec2> alone(input.n_vertices());
    for (const VertexId v : input.vertices()) {
      Mesh one = input;
      for (const VertexId u : input.vertices()) one.set_fixed(u, u != v);
      OptimizeHooks hooks;
      hooks.snapshots = [&](const Snapshot& s) {
        if (s.moment == Snapshot::Moment::after_sweep) alone[v.index] = s.mesh.position(v);
      };
      ASSERT_TRUE(optimize(one, o, hooks));
    }
    o.paper.position_updates = Updates::deferred;
    Mesh all = input;
    std::size_t moved = 0;
    OptimizeHooks hooks;
    hooks.snapshots = [&](const Snapshot& s) {
      if (s.moment != Snapshot::Moment::after_sweep) return;
      for (const VertexId v : input.vertices()) {
        EXPECT_EQ(s.mesh.position(v), alone[v.index]) << v.index;
        moved += s.mesh.position(v) == input.position(v) ? 0 : 1;
      }
    };
    ASSERT_TRUE(optimize(all, o, hooks));
    EXPECT_GT(moved, 10u);
  }
}

TEST(PositionUpdates, DeferredKeepTrianglesUprightWhereInversionsAreRefused) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Mesh mesh = *random_mesh({.vertices = 200, .seed = seed});
    OptimizeOptions o{.energy = EnergyKind::F, .unknowns = Unknowns::positions, .max_sweeps = 10};
    o.paper.position_updates = Updates::deferred;
    bool inverted = false;
    OptimizeHooks hooks;
    hooks.snapshots = [&](const Snapshot& s) { inverted = inverted || s.mesh.validate().has_value(); };
    ASSERT_TRUE(optimize(mesh, o, hooks));
    EXPECT_FALSE(inverted);
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
  }
}

/// Points agree up to rounding, since a separate run may begin its stars elsewhere.
void expect_same(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.n_vertices(), b.n_vertices());
  for (const VertexId v : a.vertices()) {
    EXPECT_NEAR(a.point(v).x, b.point(v).x, 1e-9);
    EXPECT_NEAR(a.point(v).y, b.point(v).y, 1e-9);
    EXPECT_NEAR(a.point(v).w, b.point(v).w, 1e-9);
  }
}

// The twin: a sweep of positions, then one of weights.
TEST(Visits, TwiceAreASweepOfPositionsAndOneOfWeights) {
  for (const Solver solver : {Solver::newton, Solver::golden}) {
    OptimizeOptions o{.energy = EnergyKind::BP, .repair = Repair::none, .max_sweeps = 1};
    o.paper.solver = solver;
    o.paper.gamma = LengthParameter{0.5};
    o.paper.order = SweepOrder::input;
    const Mesh input = mesh_of_random_points();
    OptimizeOptions twice = o;
    twice.paper.visits = Visits::twice;
    const Mesh result = after(input, twice);
    EXPECT_FALSE(result == after(input, o));
    o.unknowns = Unknowns::positions;
    Mesh naive = after(input, o);
    o.unknowns = Unknowns::weights;
    expect_same(result, after(std::move(naive), o));
  }
}

// The twin: a run for the first energy, then one for the other.
TEST(FirstEnergy, IsARunOfItsOwnBeforeTheOther) {
  constexpr int kFirst = 5, kThen = 4;
  OptimizeOptions o{.energy = EnergyKind::BP, .repair = Repair::none, .max_sweeps = kFirst + kThen};
  o.paper.gamma = LengthParameter{0.5};
  o.paper.first_energy = EnergyKind::T;
  o.paper.switch_at = kFirst;
  o.paper.order = SweepOrder::input;
  const Mesh input = mesh_of_random_points();
  Mesh both = input;
  const auto report = optimize(both, o);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->sweeps, kFirst + kThen);
  o.paper.first_energy = std::nullopt;
  o.energy = EnergyKind::T;
  o.max_sweeps = kFirst;
  Mesh naive = after(input, o);
  o.energy = EnergyKind::BP;
  o.max_sweeps = kThen;
  expect_same(both, after(std::move(naive), o));
}

TEST(FirstEnergy, IsNotGivenUpBeforeTheOtherHasBeenTried) {
  OptimizeOptions o{.energy = EnergyKind::BP, .max_sweeps = 300};
  o.paper.first_energy = EnergyKind::dT;
  o.paper.switch_at = 900;
  o.paper.tolerance = 1e-12;
  Mesh mesh = *horseshoe();
  const auto report = optimize(mesh, o);
  ASSERT_TRUE(report);
  EXPECT_LT(report->history.back().length_parameter, 0.5);  // γ of E_BP, come down
}

TEST(FirstEnergy, GivesWayWhenItHasConvergedOrTheRunEnds) {
  OptimizeOptions o{.energy = EnergyKind::BP, .max_sweeps = 400};
  o.paper.first_energy = EnergyKind::T;
  o.paper.switch_at = 1000;
  Mesh mesh = mesh_of_random_points();
  const auto report = optimize(mesh, o);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->stopped, Stopped::converged);
  EXPECT_EQ(report->history.back().bad, 0u);
  o.max_sweeps = 2;
  Mesh early = mesh_of_random_points();
  const auto cut = optimize(early, o);
  ASSERT_TRUE(cut);
  EXPECT_EQ(early.validate(), std::nullopt);
}

TEST(Overshoot, BelowOneNeverFlipsAsLongAsItIsConstant) {
  const Mesh input = mesh_of_random_points();
  for (const double factor : {1.0, 0.1, 0.0}) {
    OptimizeOptions o{.energy = EnergyKind::T, .max_sweeps = 8};
    o.paper.flip_limit = FlipLimit::after;
    o.paper.overshoot = 0.5;
    o.paper.overshoot_factor = factor;
    Mesh mesh = input;
    const auto report = optimize(mesh, o);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->history[1].flips, 0u);
    if (factor == 1) {
      EXPECT_EQ(report->flips, 0u);
    }
  }
}

TEST(RemovalByWeight, TakesTheVertexThatIsAboutToBeHiddenAndNoOther) {
  Mesh mesh = lattice({.n = 6, .jitter = 0.05, .weight = 0});
  ASSERT_TRUE(restore_regularity(mesh).regular());
  const VertexId light(14);
  ASSERT_FALSE(mesh.is_boundary(light));
  Patch patch;
  gather_patch(mesh, light, false, patch);
  const double r = patch_radius(patch, mesh.point(light));
  mesh.set_weight(light, -0.4 * r * r);
  EXPECT_NEAR(relative_lightness(patch, mesh.point(light)), 0.4, 1e-12);
  ASSERT_TRUE(restore_regularity(mesh).regular());
  for (const double limit : {0.3, 0.9}) {
    OptimizeOptions o{.unknowns = Unknowns::positions, .repair = Repair::none, .max_sweeps = 1};
    o.paper.removal = Removal::weight;
    o.paper.hidden_threshold = limit;
    o.paper.removal_from = 0;
    std::vector<VertexId> removed;  // whether or not the run returns to an earlier mesh
    OptimizeHooks hooks;
    hooks.tracer = [&](const TraceEvent& e) {
      if (e.kind == EventKind::removal) removed.push_back(e.vertex);
    };
    Mesh result = mesh;
    ASSERT_TRUE(optimize(result, o, hooks));
    EXPECT_EQ(removed, limit < 0.4 ? std::vector{light} : std::vector<VertexId>{});
  }
}

TEST(Insertion, BreaksUpTrianglesOfLargeEnergy) {
  for (const EnergyKind energy : {EnergyKind::T, EnergyKind::BP}) {
    OptimizeOptions o{.energy = energy, .repair = Repair::none, .max_sweeps = 12};
    o.paper.insertion_from = 1;
    o.paper.insertion_ratio = 1.2;
    o.paper.removal_measure = energy == EnergyKind::BP ? RemovalMeasure::mean : RemovalMeasure::sum;
    o.paper.removal_margin = 0;
    const Mesh input = mesh_of_random_points();
    Mesh mesh = input, without = input;
    const auto report = optimize(mesh, o);
    ASSERT_TRUE(report);
    EXPECT_GT(report->vertices_inserted, 0u);
    EXPECT_EQ(mesh.n_vertices(), input.n_vertices() + report->vertices_inserted);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
    o.paper.insertion_from = std::nullopt;
    const auto plain = optimize(without, o);
    ASSERT_TRUE(plain);
    const auto mean = [](const OptimizeReport& r, const Mesh& m, EnergyKind kind) {
      return kind == EnergyKind::T ? r.objective_after : r.objective_after / double(m.n_triangles());
    };
    EXPECT_LT(mean(*report, mesh, energy), mean(*plain, without, energy));
  }
}

// Algorithm 1 with all its other parts: removals in the same sweeps, and triangles that turn over.
TEST(Insertion, GoesWithRemovalsAndWaitsWhereTrianglesAreInverted) {
  OptimizeOptions o = *options_for("paper");
  o.energy = EnergyKind::F;
  o.paper.inner = 3;
  o.paper.insertion_from = 0;
  o.paper.insertion_ratio = 1.1;
  o.paper.removal_measure = RemovalMeasure::sum;
  o.max_sweeps = 12;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Mesh mesh = *random_mesh({.vertices = 80, .seed = seed});
    ASSERT_TRUE(optimize(mesh, o));
    EXPECT_EQ(mesh.validate(), std::nullopt);
  }
}

// Lloyd's iteration moves a vertex to the centroid of its cell. There the moment is least, so it is a stationary point
// of E_F⁰.
TEST(Methods, CvtEndsWithVerticesAtTheCentroidsOfTheirCells) {
  Mesh mesh = lattice({.n = 7, .jitter = 0.2, .weight = 0});
  OptimizeOptions o = *options_for("cvt");
  o.paper.tolerance = 1e-12;
  ASSERT_TRUE(optimize(mesh, o));
  int inner = 0;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    const Vec2 p = mesh.position(v);
    double area = 0;
    Vec2 moment{0, 0};
    std::vector<Vec2> cell;
    for (const HalfedgeId h : mesh.star(v)) {
      cell.push_back(orthocenter(mesh.point(v), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h))) - p);
    }
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Vec2 a = cell[i], b = cell[(i + 1) % cell.size()];
      area += 0.5 * cross(a, b);
      moment = moment + (cross(a, b) / 6) * (a + b);
    }
    EXPECT_GT(area, 0);
    EXPECT_LT(std::hypot(moment.x, moment.y), 2e-5 * std::pow(area, 1.5));
    EXPECT_EQ(mesh.weight(v), 0);
    ++inner;
  }
  EXPECT_GT(inner, 20);
}

// Chen and Xu: the vertex is the mean of its star's circumcenters, weighted by the areas.
TEST(Methods, OdtEndsWithVerticesAtTheMeanOfCircumcenters) {
  Mesh mesh = lattice({.n = 7, .jitter = 0.2, .weight = 0});
  OptimizeOptions o = *options_for("odt");
  o.paper.tolerance = 1e-12;
  ASSERT_TRUE(optimize(mesh, o));
  int inner = 0;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    double area = 0, longest = 0;
    Vec2 sum{0, 0};
    for (const HalfedgeId h : mesh.star(v)) {
      const WeightedPoint p = mesh.point(v), q = mesh.point(mesh.target(h)), r = mesh.point(mesh.opposite(h));
      const double s = 0.5 * cross(q.position() - p.position(), r.position() - p.position());
      area += s;
      sum = sum + s * (orthocenter(p, q, r) - p.position());
      longest = std::max(longest, squared_length(q.position() - p.position()));
    }
    EXPECT_LT(std::hypot(sum.x, sum.y), 2e-5 * area * std::sqrt(longest));
    ++inner;
  }
  EXPECT_GT(inner, 20);
}

}  // namespace
}  // namespace temper::test
