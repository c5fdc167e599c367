// The criteria of targets for tetrahedra: lattices whose answers are known, and laws.
#include "temper/tets/criterion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"
#include "temper/tets/operators.hpp"
#include "temper/tets/quality.hpp"

namespace temper::tets {
namespace {

constexpr std::array kAll = {Criterion::well_centered, Criterion::coefficients, Criterion::distances};

/// A mesh with violations of each kind.
TetMesh bad_mesh(int n = 4, std::uint64_t seed = 1) {
  TetMesh mesh = test::mesh_of(test::shaken(test::cubes(n, test::kSixTets), 0.15, 0.4, seed));
  for (const TetId t : mesh.tetrahedra()) mesh.set_region(t, 1 + static_cast<std::int32_t>(t.index % 2));
  return mesh;
}

void expect_meets(const TetMesh& mesh, std::array<bool, 3> expected) {
  const Quality q = quality(mesh);
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE(name(kAll[i]));
    EXPECT_EQ(meets(mesh, kAll[i]), expected[i]);
    EXPECT_EQ(violations(q, kAll[i]) == 0, expected[i]);
    EXPECT_EQ(cells_at_violations(mesh, kAll[i]).empty(), expected[i]);
  }
}

TEST(TetCriterion, TheBodyCenteredLatticeMeetsAll) {
  expect_meets(test::mesh_of(test::body_centered(3)), {true, true, true});
  EXPECT_GT(quality(test::mesh_of(test::body_centered(3))).min_distance, 0.1);
}

TEST(TetCriterion, CubesInSixHaveCoefficientsOfZeroAtAnyPlaceAndScale) {
  for (const double scale : {1.0, 0.1, 1e-20, 1e20}) {
    test::TetArrays arrays = test::cubes(3, test::kSixTets);
    for (Vec3& p : arrays.points) p = scale * p;  // the same three doubles along each axis: corners stay cospherical
    const TetMesh mesh = test::mesh_of(arrays);
    expect_meets(mesh, {false, true, false});
    const Quality q = quality(mesh);
    EXPECT_EQ(q.min_coefficient, 0);
    EXPECT_EQ(q.min_distance, 0);
    EXPECT_EQ(q.nonpositive_distances, 6U * 27) << "the faces inside each cube";
  }
}

TEST(TetCriterion, OneTetrahedronWithAnOrthocenterOutside) {
  // Flat over its base, whose corners see the top under obtuse angles.
  const test::TetArrays flat = {{{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -0.75, 0}, {0, 0, 0.25}}, {}, {{0, 1, 2, 3}}};
  const TetMesh mesh = test::mesh_of(flat);
  expect_meets(mesh, {false, false, false});
  const Quality q = quality(mesh);
  EXPECT_EQ(q.negative_coefficients, 0U) << "all edges are on the boundary";
  EXPECT_EQ(q.negative_boundary_coefficients, violated_edges(mesh).size());
  EXPECT_EQ(q.nonpositive_boundary_distances, violated_faces(mesh).size());
  EXPECT_EQ(q.negative_region_coefficients + q.nonpositive_region_distances, 0U);
}

TEST(TetCriterion, CountsAreThoseOfTheOperators) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const TetMesh mesh = bad_mesh(4, seed);
    const DecComplex c = dec_operators(mesh);
    const Quality q = quality(mesh);
    std::array<std::size_t, 2> negative = {};
    double least = 1e300;
    for (std::size_t e = 0; e < c.edges.size(); ++e) {
      const DecEdge& edge = c.edges[EdgeId(e)];
      negative[edge.is_boundary ? 1 : 0] += c.star1[EdgeId(e)] < 0;
      least = std::min(least, c.star1[EdgeId(e)] / edge.length);
    }
    EXPECT_EQ(q.negative_coefficients, negative[0]);
    EXPECT_EQ(q.negative_boundary_coefficients, negative[1]);
    EXPECT_GT(negative[0] * negative[1], 0U);
    EXPECT_LE(q.min_coefficient, least + 1e-12) << "parts of regions count, too";
  }
}

TEST(TetCriterion, ViolationsAreListedAsTheyAreCounted) {
  const TetMesh mesh = bad_mesh();
  const Quality q = quality(mesh);
  std::array<std::size_t, 3> edges = {}, faces = {};
  double least_edge = 0, least_face = 0;
  for (const ViolatedEdge& e : violated_edges(mesh)) {
    ++edges[static_cast<std::size_t>(e.kind)];
    least_edge = std::min(least_edge, e.dual_over_l2);
    EXPECT_LT(e.vertices[0], e.vertices[1]);
    EXPECT_EQ(e.region != 0, e.kind == DualKind::region);
  }
  for (const ViolatedFace& f : violated_faces(mesh)) {
    ++faces[static_cast<std::size_t>(f.kind)];
    least_face = std::min(least_face, f.dual_over_l);
    EXPECT_EQ(f.kind == DualKind::boundary, mesh.is_boundary(f.face));
  }
  EXPECT_EQ(edges,
            (std::array{q.negative_coefficients, q.negative_boundary_coefficients, q.negative_region_coefficients}));
  EXPECT_EQ(faces,
            (std::array{q.nonpositive_distances, q.nonpositive_boundary_distances, q.nonpositive_region_distances}));
  for (std::size_t kind = 0; kind < 3; ++kind) EXPECT_GT(std::min(edges[kind], faces[kind]), 0U) << kind;
  EXPECT_EQ(least_edge, q.min_coefficient);
  EXPECT_NEAR(least_face, q.min_distance, 1e-12);
  expect_meets(mesh, {false, false, false});
}

TEST(TetCriterion, CellsAreThoseAroundViolations) {
  const TetMesh mesh = bad_mesh();
  std::set<TetId> around;
  for (const ViolatedEdge& e : violated_edges(mesh)) {
    for (const TetId t : mesh.tetrahedra()) {
      const auto& corners = mesh.corners(t);
      if (std::ranges::count(corners, e.vertices[0]) + std::ranges::count(corners, e.vertices[1]) == 2)
        around.insert(t);
    }
  }
  const auto cells = cells_at_violations(mesh, Criterion::coefficients);
  EXPECT_EQ(cells, std::vector<TetId>(around.begin(), around.end()));
  EXPECT_EQ(cells_at_violations(mesh, Criterion::well_centered).size(), quality(mesh).orthocenters_outside);
}

TEST(TetCriterion, PowersOfTwoChangeNoBit) {
  const test::TetArrays arrays = test::shaken(test::cubes(3, test::kSixTets), 0.15, 0.1);
  const Quality before = quality(test::mesh_of(arrays));
  for (const double scale : {0x1p-40, 0x1p40}) {
    test::TetArrays scaled = arrays;
    for (Vec3& p : scaled.points) p = scale * p;
    for (double& w : scaled.weights) w *= scale * scale;
    const Quality after = quality(test::mesh_of(scaled));
    EXPECT_EQ(after.min_coefficient, before.min_coefficient);
    EXPECT_EQ(after.min_distance, before.min_distance);
    EXPECT_EQ(after.min_coefficient_place.vertices, before.min_coefficient_place.vertices);
    for (const Criterion criterion : kAll) EXPECT_EQ(violations(after, criterion), violations(before, criterion));
  }
}

TEST(TetCriterion, NumbersOfVerticesAndTetrahedraDoNotCount) {
  const test::TetArrays arrays = test::shaken(test::cubes(3, test::kSixTets), 0.15, 0.1);
  test::TetArrays turned = arrays;
  const auto n = static_cast<std::int32_t>(arrays.points.size());
  std::ranges::reverse(turned.points);
  std::ranges::reverse(turned.weights);
  std::ranges::reverse(turned.tetrahedra);
  for (auto& t : turned.tetrahedra) {
    for (std::int32_t& v : t) v = n - 1 - v;
    std::rotate(t.begin(), t.begin() + 1, t.end());
  }
  const Quality a = quality(test::mesh_of(arrays)), b = quality(test::mesh_of(turned));
  for (const Criterion criterion : kAll) EXPECT_EQ(violations(a, criterion), violations(b, criterion));
  EXPECT_EQ(a.negative_coefficients, b.negative_coefficients);
  EXPECT_NEAR(a.min_coefficient, b.min_coefficient, 1e-12);
  EXPECT_EQ(a.min_coefficient_place.vertices[0].index, n - 1 - b.min_coefficient_place.vertices[1].index);
}

TEST(TetCriterion, AnswersDoNotDependOnThreads) {
  const TetMesh mesh = bad_mesh(11);
  test::StdThreads threads(3);
  const auto one = violated_edges(mesh), three = violated_edges(mesh, &threads);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].vertices, three[i].vertices);
    EXPECT_EQ(one[i].dual_over_l2, three[i].dual_over_l2);
  }
  for (const Criterion criterion : kAll)
    EXPECT_EQ(cells_at_violations(mesh, criterion), cells_at_violations(mesh, criterion, &threads));
}

}  // namespace
}  // namespace temper::tets
