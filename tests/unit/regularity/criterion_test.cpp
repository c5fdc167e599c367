// The criteria of targets in the plane and on the sphere: meshes whose answers are known, and laws.
#include "temper/detail/criterion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "regularity/duals.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/spheres.hpp"
#include "support/std_threads.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

constexpr std::array kDuals = {Criterion::coefficients, Criterion::distances};

void expect_meets(const Mesh& mesh, std::array<bool, 3> expected) {
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE(criteria_table()[i].name);
    EXPECT_EQ(meets(mesh, criteria_table()[i].criterion), expected[i]);
    EXPECT_EQ(cells_at_violations(mesh, criteria_table()[i].criterion).empty(), expected[i]);
  }
}

Mesh bad_mesh(std::uint64_t seed = 1) {
  Mesh mesh = test::lattice({.n = 14, .jitter = 0.3, .weight = 0.3, .seed = seed});
  for (const TriangleId t : mesh.triangles()) mesh.set_region(t, mesh.point(mesh.corners(t)[0]).x > 7 ? 1 : 0);
  return mesh;
}

TEST(Criterion, EachSchemeHasOneAndTheTableIsInOrder) {
  EXPECT_EQ(criterion_of(Scheme::vertex), Criterion::coefficients);
  EXPECT_EQ(criterion_of(Scheme::cell), Criterion::distances);
  EXPECT_EQ(criterion_of(Scheme::stars), Criterion::well_centered);
  EXPECT_EQ(criterion_of(Scheme::all), Criterion::well_centered);
  for (std::size_t i = 0; i < criteria_table().size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(criteria_table()[i].criterion), i);
}

TEST(Criterion, EquilateralTrianglesMeetAll) {
  expect_meets(test::lattice({.n = 4, .jitter = 0, .weight = 0}), {true, true, true});
}

// Right triangles: the diagonal has a dual of length zero.
TEST(Criterion, ZeroIsGoodForCoefficientsAndBadForDistances) {
  const Mesh mesh = test::mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  expect_meets(mesh, {false, true, false});
  const auto violated = violated_edges(mesh, Criterion::distances);
  ASSERT_EQ(violated.size(), 1U);
  EXPECT_EQ(violated[0].kind, DualKind::inside);
  EXPECT_EQ(violated[0].dual_over_l, 0);
}

// An obtuse angle across an inner edge does no harm if the other side makes up for it, unless regions differ.
TEST(Criterion, BetweenRegionsEachSideCountsAlone) {
  const std::vector<Vec2> points = {{0, 0}, {2, 0}, {1, 0.75}, {1, -3}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {0, 3, 1}};
  const Mesh one = test::mesh_of(points, triangles), two = test::mesh_of(points, triangles, {}, {1, 2});
  expect_meets(one, {false, true, true});
  expect_meets(two, {false, false, false});
  for (const Criterion criterion : kDuals) {
    const auto violated = violated_edges(two, criterion);
    ASSERT_EQ(violated.size(), 1U);
    EXPECT_EQ(violated[0].kind, DualKind::region);
    EXPECT_EQ(two.region(Mesh::triangle(violated[0].edge)), 1);
    EXPECT_NEAR(violated[0].dual_over_l, (0.75 * 0.75 - 1) / 1.5 / 2, 1e-15);
  }
}

TEST(Criterion, AnObtuseAngleAcrossTheBoundaryIsAViolation) {
  const Mesh mesh = test::one_triangle({0, 0}, {4, 0}, {2, 1});
  expect_meets(mesh, {false, false, false});
  EXPECT_EQ(violated_edges(mesh, Criterion::coefficients).front().kind, DualKind::boundary);
}

// Each cell with a side outside is at a violation of coefficients, or its neighbor makes up for it.
TEST(Criterion, ViolationsAreThoseOfANaiveLoop) {
  for (const Mesh& mesh : {bad_mesh(), bad_mesh(2), test::on_cap(bad_mesh(3), 40), test::globe(300)}) {
    const Space& space = mesh.space();
    for (const Criterion criterion : kDuals) {
      std::set<std::pair<std::uint32_t, DualKind>> expected;
      for (const HalfedgeId h : mesh.halfedges()) {
        const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
        const Sign height = signed_height_sign(space, a, b, c);
        const auto bad = [&](Sign sign) {
          return sign == Sign::negative || (sign == Sign::zero && criterion == Criterion::distances);
        };
        if (mesh.is_boundary(h)) {
          if (bad(height)) expected.insert({h.index, DualKind::boundary});
          continue;
        }
        const WeightedPoint d = mesh.point(mesh.opposite(mesh.twin(h)), a);
        if (mesh.is_edge_representative(h) && bad(-power_test(space, a, b, c, d)))
          expected.insert({h.index, DualKind::inside});
        if (mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h))) && bad(height))
          expected.insert({h.index, DualKind::region});
      }
      std::set<std::pair<std::uint32_t, DualKind>> found;
      for (const ViolatedEdge& v : violated_edges(mesh, criterion)) {
        found.insert({v.edge.index, v.kind});
        EXPECT_LE(v.dual_over_l, 0);
      }
      EXPECT_EQ(found, expected);
      EXPECT_EQ(meets(mesh, criterion), expected.empty());
    }
  }
}

TEST(Criterion, APeriodicPlaneHasNoBoundary) {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  constexpr int n = 4;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      points.push_back({double(x), double(y)});
      const auto at = [&](int i, int j) { return (j % n) * n + i % n; };
      triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  MeshInput input{.points = points, .triangles = triangles};
  input.space = Space::periodic({n, n});
  const auto built = Mesh::build(input);
  ASSERT_TRUE(built) << built.error().what();
  expect_meets(built->mesh, {false, true, false});
  EXPECT_EQ(violated_edges(built->mesh, Criterion::distances).size(), std::size_t{n * n});
}

TEST(Criterion, AClockwiseTriangleMeetsNothing) {
  Mesh mesh = test::lattice({.n = 4, .jitter = 0, .weight = 0});
  const VertexId inner(5);
  mesh.set_position(inner, mesh.position(inner) + Vec2{3, 0});
  expect_meets(mesh, {false, false, false});
}

TEST(Criterion, ErasedTrianglesAreNotThere) {
  Mesh mesh = test::lattice({.n = 6, .jitter = 0, .weight = 0});
  remove_vertex(mesh, plan_removal(mesh, VertexId(14)));
  const auto before = violated_edges(mesh, Criterion::distances);
  mesh.compact();
  EXPECT_EQ(before.size(), violated_edges(mesh, Criterion::distances).size());
}

TEST(Criterion, AnswersDoNotDependOnThreads) {
  const Mesh mesh = test::mesh_with_regions(20000, 3);
  test::StdThreads threads(3);
  for (const Criterion criterion : kDuals) {
    EXPECT_EQ(cells_at_violations(mesh, criterion), cells_at_violations(mesh, criterion, &threads));
    EXPECT_EQ(violated_edges(mesh, criterion).size(), violated_edges(mesh, criterion, &threads).size());
    EXPECT_GT(violated_edges(mesh, criterion).size(), 10U);
  }
}

}  // namespace
}  // namespace temper
