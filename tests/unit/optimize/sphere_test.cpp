// Optimization on the sphere: the guarantees of the plane, and the special laws of the sphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/bad_triangles.hpp"
#include "support/spheres.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

using test::globe;
using test::ocean;

OptimizeReport optimized(Mesh& mesh, const OptimizeOptions& options = {}, const OptimizeHooks& hooks = {}) {
  auto report = optimize(mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  return *std::move(report);
}

void expect_well_centered(const Mesh& mesh) {
  EXPECT_FALSE(mesh.validate());
  EXPECT_TRUE(bad_triangles(mesh).empty());
  EXPECT_EQ(count_non_regular_edges(mesh), 0U);
}

TEST(Sphere, RandomGlobesBecomeWellCentered) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    Mesh mesh = globe(seed < 5 ? 300 : 1500, seed);  // one by one, and in batches
    ASSERT_GT(bad_triangles(mesh).size(), mesh.n_triangles() / 4);
    optimized(mesh);
    expect_well_centered(mesh);
  }
}

TEST(Sphere, APolyhedronOfIcosahedraIsImprovedWithoutALoss) {
  const auto before = icosahedral({.level = 3});
  ASSERT_TRUE(before);
  Mesh mesh = *before;
  const OptimizeReport report = optimized(mesh);
  expect_well_centered(mesh);
  EXPECT_LE(report.objective_after, report.objective_before);
  // The objective may take room from a triangle, down to the margin that was asked for.
  const double margin = scheme_weights(Scheme::all).margin;
  EXPECT_GT(quality(*before).min_h_over_l, margin);
  EXPECT_GT(quality(mesh).min_h_over_l, margin);
}

TEST(Sphere, CoastsStayWhereTheyAre) {
  const Mesh before = ocean(globe(900, 3), 0.4);
  Mesh mesh = before;
  optimized(mesh);
  EXPECT_FALSE(mesh.validate());
  std::size_t coast = 0, moved = 0;
  for (const VertexId v : before.vertices()) {
    EXPECT_EQ(mesh.is_boundary(v), before.is_boundary(v));
    const bool same = mesh.space().same_place(mesh.point(v), before.point(v));
    if (before.is_boundary(v)) {
      ++coast;
      EXPECT_TRUE(same) << v.index;
    } else {
      moved += same ? 0 : 1;
    }
  }
  EXPECT_GT(coast, 20U);
  EXPECT_GT(moved, mesh.n_vertices() / 2);
  EXPECT_LT(bad_triangles(mesh).size(), bad_triangles(before).size() / 10);
}

TEST(Sphere, TheAccuracyObjectiveLowersItsEnergyAndKeepsItsMargin) {
  for (const std::size_t vertices : {200U, 1500U}) {  // one by one, and in batches
    Mesh barrier = globe(vertices, 5), mesh = barrier;
    optimized(barrier);
    const OptimizeReport report = optimized(mesh, {.objective = Objective::accuracy, .scheme = Scheme::stars});
    expect_well_centered(mesh);
    EXPECT_LT(report.objective_after, 0.35 * report.objective_before);
    const auto q = quality(mesh);
    constexpr double kMargin = 0.02;
    EXPECT_GT(q.min_h_over_l, kMargin);
    EXPECT_GT(q.min_d_over_l, kMargin);
  }
  // A coast stays, and what is well-centered remains so.
  const Mesh before = ocean(globe(900, 3), 0.4);
  Mesh mesh = before, barrier = before;
  optimized(barrier);
  const OptimizeReport report = optimized(mesh, {.objective = Objective::accuracy});
  EXPECT_LT(report.objective_after, report.objective_before);
  EXPECT_EQ(bad_triangles(mesh).size(), bad_triangles(barrier).size());
  for (const VertexId v : before.vertices()) {
    if (!before.is_boundary(v)) continue;
    EXPECT_TRUE(mesh.space().same_place(mesh.point(v), before.point(v))) << v.index;
  }
}

TEST(Sphere, PositionsAloneLeaveWeightsAndWeightsAloneLeavePositions) {
  const Mesh before = globe(400, 2);
  Mesh positions = before;
  optimized(positions, {.unknowns = Unknowns::positions});
  for (const VertexId v : before.vertices()) EXPECT_NEAR(positions.weight(v), 0, 1e-12);
  EXPECT_LT(bad_triangles(positions).size(), bad_triangles(before).size() / 4);

  Mesh weights = positions;
  const OptimizeReport report = optimized(weights, {.unknowns = Unknowns::weights});
  EXPECT_LT(report.objective_after, report.objective_before);
  std::size_t changed = 0;
  for (const VertexId v : before.vertices()) {
    EXPECT_TRUE(before.space().same_place(weights.point(v), positions.point(v)));
    changed += std::abs(weights.weight(v)) > 1e-6 ? 1 : 0;
  }
  EXPECT_GT(changed, weights.n_vertices() / 2);
}

TEST(Sphere, RepairsMendWhatSweepsOfPositionsAloneDoNot) {
  const Mesh before = globe(2000, 3);
  Mesh swept = before, mended = before, refined = before;
  optimized(swept, {.unknowns = Unknowns::positions, .repair = Repair::none});
  optimized(mended, {.unknowns = Unknowns::positions});
  const OptimizeReport report = optimized(refined, {.unknowns = Unknowns::positions, .repair = Repair::vertices});
  EXPECT_FALSE(bad_triangles(swept).empty());
  expect_well_centered(mended);
  EXPECT_EQ(mended.n_vertices(), before.n_vertices());
  expect_well_centered(refined);
  EXPECT_GT(report.vertices_inserted + report.vertices_removed, 0U);
  for (const VertexId v : refined.vertices()) {
    EXPECT_EQ(refined.weight(v), 0);
    EXPECT_NEAR(length(refined.weighted_vector(v)), 1, 1e-12);
  }
}

// Repairs insert exactly the tested vertices next to an interface, to the last bit.
TEST(Sphere, RepairsInsertBesideInterfaces) {
  Mesh mesh = globe(800, 1);
  const auto is_north = [&](TriangleId t) {
    const auto [a, b, c] = mesh.corners(t);
    return mesh.weighted_vector(a).z + mesh.weighted_vector(b).z + mesh.weighted_vector(c).z > 0;
  };
  for (const TriangleId t : mesh.triangles()) mesh.set_region(t, is_north(t) ? 1 : 2);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)))) mesh.set_constrained(h, true);
  }
  const std::size_t before = bad_triangles(mesh).size();
  const OptimizeReport report =
      optimized(mesh, {.unknowns = Unknowns::positions, .repair = Repair::vertices, .repair_trials = 800});
  EXPECT_FALSE(mesh.validate());
  EXPECT_LT(bad_triangles(mesh).size(), before / 5);
  EXPECT_GT(report.vertices_inserted, 0U);
}

TEST(Sphere, ConstrainedLinesAndFixedVerticesStay) {
  Mesh before = globe(500, 4);
  std::vector<std::pair<VertexId, VertexId>> river;
  VertexId at(7);
  for (int i = 0; i < 6; ++i) {
    const HalfedgeId h = before.outgoing(at);
    before.set_constrained(h, true);
    river.emplace_back(at, before.target(h));
    at = before.target(h);
  }
  before.set_fixed(VertexId(100), true);
  Mesh mesh = before;
  optimized(mesh);
  for (const auto& [a, b] : river) {
    const HalfedgeId h = mesh.find_halfedge(a, b);
    ASSERT_TRUE(h.valid());
    EXPECT_TRUE(mesh.is_constrained(h));
    EXPECT_TRUE(mesh.space().same_place(mesh.point(a), before.point(a)));
  }
  EXPECT_TRUE(mesh.space().same_place(mesh.point(VertexId(100)), before.point(VertexId(100))));
}

TEST(Sphere, EveryEnergyAndSolverKeepsTheMeshOneOfTheSphere) {
  Mesh before = globe(150, 5);
  optimized(before, {.unknowns = Unknowns::positions});
  ASSERT_TRUE(bad_triangles(before).empty());
  for (const EnergyInfo& energy : energies()) {
    for (const Solver solver : {Solver::newton, Solver::alternating, Solver::golden}) {
      OptimizeOptions o;
      o.energy = energy.kind;
      if (energy.positions_alone) o.unknowns = Unknowns::positions;
      o.paper.solver = solver;
      o.max_sweeps = 5;
      Mesh mesh = before;
      const OptimizeReport report = optimized(mesh, o);
      SCOPED_TRACE(std::string(energy.name));
      EXPECT_FALSE(mesh.validate());
      EXPECT_EQ(count_non_regular_edges(mesh), 0U);
      if (energy.barrier) {
        EXPECT_LE(report.objective_after, report.objective_before);
      }
    }
  }
}

TEST(Sphere, SweepsRemoveVerticesWhereThePaperDoes) {
  Mesh mesh = globe(300, 6);
  OptimizeOptions o;
  o.paper.removal = Removal::patch;
  o.paper.collapse_from = 0;
  const OptimizeReport report = optimized(mesh, o);
  EXPECT_FALSE(mesh.validate());
  EXPECT_GT(report.vertices_removed, 0);
  EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles() - mesh.n_edges(), 2U);
  EXPECT_EQ(count_non_regular_edges(mesh), 0U);
}

TEST(Sphere, UnitsOfLengthByAPowerOfTwoChangeNothing) {
  Mesh small = globe(400, 7, 1), large = globe(400, 7, 0x1p22);
  const OptimizeReport a = optimized(small), b = optimized(large);
  EXPECT_EQ(a.sweeps, b.sweeps);
  for (const VertexId v : small.vertices()) {
    EXPECT_EQ(0x1p22 * small.weighted_vector(v), large.weighted_vector(v)) << v.index;
  }
}

TEST(Sphere, TurnedGlobesEndTheSameButForRounding) {
  Mesh mesh = globe(250, 8);
  // Far from a minimum Hessians are indefinite, and the pivots of a definite one depend on its axes.
  optimized(mesh, {.unknowns = Unknowns::positions});
  ASSERT_TRUE(bad_triangles(mesh).empty());
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  // A turn by the unit quaternion (1, 2, 4, 10)/11: entries are rational.
  const auto turned = [](Vec3 p) {
    const double r[3][3] = {{-1.0 + 2 * (1.0 + 4.0) / 121, 2 * (8.0 - 10.0) / 121, 2 * (20.0 + 4.0) / 121},
                            {2 * (8.0 + 10.0) / 121, -1.0 + 2 * (1.0 + 16.0) / 121, 2 * (40.0 - 2.0) / 121},
                            {2 * (20.0 - 4.0) / 121, 2 * (40.0 + 2.0) / 121, -1.0 + 2 * (1.0 + 100.0) / 121}};
    return Vec3{r[0][0] * p.x + r[0][1] * p.y + r[0][2] * p.z, r[1][0] * p.x + r[1][1] * p.y + r[1][2] * p.z,
                r[2][0] * p.x + r[2][1] * p.y + r[2][2] * p.z};
  };
  for (const VertexId v : mesh.vertices()) points.push_back(turned(mesh.weighted_vector(v)));
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    triangles.push_back(
        {static_cast<std::int32_t>(a.index), static_cast<std::int32_t>(b.index), static_cast<std::int32_t>(c.index)});
  }
  MeshInput input;
  input.space = mesh.space();
  input.sphere_points = points;
  input.triangles = triangles;
  auto other = Mesh::build(input);
  ASSERT_TRUE(other) << other.error().what();
  // Another order of vertices gives other steps, and the order of the input gives the same steps.
  OptimizeOptions o;
  o.paper.order = SweepOrder::input;
  o.max_sweeps = 4;
  o.repair = Repair::none;
  optimized(mesh, o);
  optimized(other->mesh, o);
  double farthest = 0;
  for (const VertexId v : mesh.vertices()) {
    farthest = std::max(farthest, length(turned(mesh.weighted_vector(v)) - other->mesh.weighted_vector(v)));
  }
  EXPECT_LT(farthest, 1e-8);
}

// Heights, crossings and energies of a small cap agree with the tangent plane's, except for terms in (ℓ/R)².
TEST(Sphere, CapsOfASmallRadiusAreThePlane) {
  double last = 0;
  for (const double radius : {10.0, 20.0, 40.0, 80.0}) {
    std::vector<Vec2> flat;
    std::vector<Vec3> curved;
    for (int i = 0; i < 7; ++i) {
      const double angle = std::numbers::pi * (i + 0.2 * (i % 2)) / 3;
      const Vec2 p = i == 6 ? Vec2{0.1, 0.05} : Vec2{std::cos(angle), std::sin(angle)};
      flat.push_back(p);
      // The arc to the center of the cap is as long as the distance in the plane.
      const double r = length(p), s = std::sin(r / radius) / r;
      curved.push_back({radius * s * p.x, radius * s * p.y, radius * std::cos(r / radius)});
    }
    const std::vector<std::array<std::int32_t, 3>> triangles = {{6, 0, 1}, {6, 1, 2}, {6, 2, 3},
                                                                {6, 3, 4}, {6, 4, 5}, {6, 5, 0}};
    MeshInput in_plane{.points = flat, .triangles = triangles}, on_sphere{.triangles = triangles};
    on_sphere.space = Space::sphere(radius);
    on_sphere.sphere_points = curved;
    const auto plane = Mesh::build(in_plane), sphere = Mesh::build(on_sphere);
    ASSERT_TRUE(plane);
    ASSERT_TRUE(sphere);
    double error = 0;
    for (const EnergyInfo& energy : energies()) {
      const EnergyModel model{.kind = energy.kind};
      const double a = total_energy(plane->mesh, model), b = total_energy(sphere->mesh, model);
      if (std::isfinite(a)) error = std::max(error, std::abs(b / a - 1));
    }
    error = std::max(error, std::abs(quality(sphere->mesh).min_h_over_l / quality(plane->mesh).min_h_over_l - 1));
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.3) << radius;
    }
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(Sphere, SolidAnglesOfAGlobeAreThatOfTheSphere) {
  const Mesh mesh = globe(500, 10);
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    sum += solid_angle(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c));
  }
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-12);
}

TEST(Sphere, RefusesWhatIsForThePlane) {
  Mesh mesh = globe(100);
  const Mesh before = mesh;
  for (const auto& [options, word] :
       {std::pair{OptimizeOptions{.boundary = BoundaryVertices::split}, "`boundary=split` is for meshes of the plane"},
        std::pair{OptimizeOptions{.paper = {.insertion_from = 1}}, "`insertion_from` is for meshes of the plane"}}) {
    const auto report = optimize(mesh, options);
    ASSERT_FALSE(report);
    EXPECT_NE(report.error().what().find(word), std::string::npos) << report.error().what();
    EXPECT_EQ(mesh, before);
  }
}

TEST(SphericalDelaunay, KeepsNumbersAndHasEmptyCircles) {
  const Mesh mesh = globe(200, 11);
  ASSERT_EQ(mesh.n_vertices(), 200U);
  EXPECT_EQ(mesh.n_triangles(), 396U);
  std::size_t asked = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    for (const VertexId d : mesh.vertices()) {  // all against all: the hull
      if (d == a || d == b || d == c) continue;
      EXPECT_EQ(power_test(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c),
                           mesh.weighted_vector(d)),
                Sign::negative);
      ++asked;
    }
  }
  EXPECT_EQ(asked, 396U * 197U);
}

TEST(SphericalDelaunay, DecidesTiesByNumberAlone) {
  // A lattice sphere: up to 24 points on a circle.
  std::vector<Vec3> points;
  for (int x = -9; x <= 9; ++x) {
    for (int y = -9; y <= 9; ++y) {
      for (int z = -9; z <= 9; ++z) {
        if (x * x + y * y + z * z == 81) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  ASSERT_EQ(points.size(), 102U);
  const auto mesh = spherical_delaunay(points, 9);
  ASSERT_TRUE(mesh) << mesh.error().what();
  EXPECT_FALSE(mesh->validate());
  EXPECT_EQ(mesh->n_triangles(), 200U);
  EXPECT_EQ(count_non_regular_edges(*mesh), 0U);
  // Each edge agrees with the perturbed test, which gives the same answer from both of its triangles.
  for (const HalfedgeId h : mesh->halfedges()) {
    const VertexId a = mesh->origin(h), b = mesh->target(h), c = mesh->opposite(h), d = mesh->opposite(mesh->twin(h));
    EXPECT_EQ(power_test_perturbed(mesh->weighted_vector(a), mesh->weighted_vector(b), mesh->weighted_vector(c),
                                   mesh->weighted_vector(d), {a.index, b.index, c.index, d.index}),
              Sign::negative);
  }
}

TEST(SphericalDelaunay, SaysWhatIsWrongWithPoints) {
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) points.push_back({std::cos(0.2 * i), std::sin(0.2 * i), 1 + 0.1 * (i % 3)});
  auto mesh = spherical_delaunay(points);
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().what().find("leave half of the sphere empty"), std::string::npos) << mesh.error().what();
  points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 2, 0}};
  mesh = spherical_delaunay(points);
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().what().find("points 2 and 6 are both in the direction"), std::string::npos)
      << mesh.error().what();
  points.back() = {0, 0, 0};
  mesh = spherical_delaunay(points);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::not_on_sphere);
  points.pop_back();
  mesh = spherical_delaunay(points);
  ASSERT_TRUE(mesh) << mesh.error().what();
  EXPECT_EQ(mesh->n_triangles(), 8U);
}

}  // namespace
}  // namespace temper
