// Least weights of tetrahedra: the minimum by a linear program, the laws, places that stay, and proofs that there are
// none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/tet_lattice.hpp"
#include "temper/tets/weights.hpp"
#include "tets/weights/demand.hpp"
#include "unit/feasibility/least.hpp"
#include "unit/tets/pinwheel_cone.hpp"

namespace temper::tets {
namespace {

using Kind = WeightConstraint::Kind;
constexpr Constraints kBoth[] = {Constraints::coefficients, Constraints::distances};

WeightReport least_of(const TetMesh& mesh, Constraints constraints, std::size_t whole = 100'000) {
  return test::least_of(mesh, {.goal = WeightGoal::least, .whole = whole, .constraints = constraints});
}

/// The lower half has region 1.
TetMesh in_two_regions(TetMesh mesh, double height) {
  for (const TetId t : mesh.tetrahedra()) {
    double sum = 0;
    for (const WeightedPoint& p : mesh.points(t)) sum += p.position().z;
    if (sum < 4 * height) mesh.set_region(t, 1);
  }
  return mesh;
}

bool keeps(const TetMesh& mesh, Constraints constraints, const VertexWeights& weights) {
  const TetDemand demand(mesh, constraints);
  return std::all_of(demand.cells().begin(), demand.cells().end(),
                     [&](CellId cell) { return demand.is_kept(cell, weights); });
}

TEST(LeastTetWeights, AreZeroIfTheMeshKeepsTheConstraintsEvenWithZeros) {
  for (const auto& cut : {test::kSixTets, test::kFiveTets}) {
    const TetMesh mesh = test::mesh_of(test::cubes(2, cut));  // many coefficients are zero
    const WeightReport report = least_of(mesh, Constraints::coefficients);
    EXPECT_TRUE(report.solved);
    EXPECT_EQ(report.moved + report.programs, 0U);
    EXPECT_EQ(least_of(in_two_regions(mesh, 1), Constraints::coefficients).moved, 0U);
  }
  for (const Constraints constraints : kBoth)
    EXPECT_EQ(least_of(test::mesh_of(test::body_centered(2)), constraints).moved, 0U);
}

TEST(LeastTetWeights, AreTheMinimumAndKeepTheConstraintsExactly) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const TetMesh cubes = test::mesh_of(test::shaken(test::cubes(3, test::kFiveTets), 0.12, 0, seed));
    for (const TetMesh& mesh :
         {cubes, in_two_regions(cubes, 1.5), test::mesh_of(test::shaken(test::body_centered(3), 0.2, 0, seed))}) {
      for (const Constraints constraints : kBoth) {
        const WeightReport report = least_of(mesh, constraints);
        if (report.verdict == Feasibility::infeasible) {
          EXPECT_EQ(check_certificate(mesh, report.certificate), CertificateCheck::proves);
          continue;
        }
        ASSERT_EQ(report.verdict, Feasibility::feasible);
        EXPECT_TRUE(keeps(mesh, constraints, report.weights));
        EXPECT_GT(report.moved, 0U);
        found += test::expect_minimum(TetDemand(mesh, constraints), report) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(found, 8U);
}

TEST(LeastTetWeights, ScaleByPowersOfTwoExactly) {
  test::TetArrays a = test::shaken(test::cubes(3, test::kFiveTets), 0.12, 0, 2);
  const TetMesh mesh = test::mesh_of(a);
  for (Vec3& p : a.points) p = 0x1p-7 * p;
  for (const Constraints constraints : kBoth) {
    const WeightReport report = least_of(mesh, constraints), small = least_of(test::mesh_of(a), constraints);
    ASSERT_EQ(report.verdict, small.verdict);
    for (const VertexId v : mesh.vertices()) EXPECT_EQ(small.weights[v], 0x1p-14 * report.weights[v]);
  }
}

TEST(LeastTetWeights, OfALargeMeshChangeOnlyTheSurroundingsOfBadPlaces) {
  test::TetArrays a = test::body_centered(8);
  const auto center = std::min_element(a.points.begin(), a.points.end(), [](Vec3 x, Vec3 y) {
    return length(x - Vec3{4, 4, 4}) < length(y - Vec3{4, 4, 4});
  });
  *center = *center + Vec3{0.45, 0.2, 0.1};
  const TetMesh mesh = test::mesh_of(a);
  for (const Constraints constraints : kBoth) {
    const WeightReport report = least_of(mesh, constraints, 100);
    EXPECT_EQ(report.verdict, Feasibility::feasible);
    EXPECT_TRUE(keeps(mesh, constraints, report.weights));
    EXPECT_GT(report.moved, 0U);
    EXPECT_LT(report.moved, mesh.n_vertices() / 3);
  }
}

TEST(LeastTetWeights, HaveAProofIfThereAreNoneAndStillViolateLittle) {
  const TetMesh mesh = pinwheel_cone();
  for (const Constraints constraints : kBoth) {
    const WeightReport report = least_of(mesh, constraints);
    EXPECT_FALSE(report.solved);
    EXPECT_FALSE(report.violations.empty());
    const Certificate& certificate = report.certificate;
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
    for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
      Certificate corrupted = certificate;
      corrupted.terms[i].multiplier *= 100;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::proves_nothing) << i;
      corrupted.terms[i].multiplier *= -1;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::bad_multiplier) << i;
    }
    Certificate other = certificate;
    other.constraints = Constraints::regular;
    if (std::any_of(other.terms.begin(), other.terms.end(),
                    [](const auto& term) { return term.constraint.kind != Kind::dual_of_face; })) {
      EXPECT_EQ(check_certificate(mesh, other), CertificateCheck::not_of_this_mesh);
    }
  }
}

// A height inside the mesh, an edge that is not of the surface, and the two kinds of edges of a surface exchanged.
TEST(LeastTetWeights, CertificatesOfConstraintsThatAreNotOfTheSurfaceAreRefused) {
  const TetMesh mesh = in_two_regions(test::mesh_of(test::cubes(2, test::kSixTets)), 1);
  const TetDemand demand(mesh, Constraints::coefficients);
  const auto check = [&](const WeightConstraint& c, Constraints constraints) {
    return check_certificate(mesh, {.terms = {{c, 1}}, .constraints = constraints});
  };
  std::size_t flat = 0, ridges = 0;
  for (const WeightConstraint& c : demand.constraints_of(all_cells(demand), true)) {
    EXPECT_EQ(check(c, Constraints::coefficients), CertificateCheck::proves_nothing);
    const bool within = c.kind == Kind::dual || c.kind == Kind::height;
    EXPECT_EQ(check(c, Constraints::distances),
              within ? CertificateCheck::not_of_this_mesh : CertificateCheck::proves_nothing);
    if (c.kind == Kind::dual) {
      ++flat;
      EXPECT_EQ(check({Kind::height, c.p, c.q, c.r}, Constraints::coefficients), CertificateCheck::not_of_this_mesh);
      EXPECT_EQ(check({Kind::dual, c.p, c.q, c.r, c.r}, Constraints::coefficients), CertificateCheck::not_of_this_mesh);
      EXPECT_EQ(check({Kind::dual, c.p, c.r, c.q, c.s}, Constraints::coefficients), CertificateCheck::not_of_this_mesh);
    }
    ridges += c.kind == Kind::height ? 1 : 0;
  }
  EXPECT_GT(flat, 20U);
  EXPECT_GT(ridges, 20U);
  for (const HalffaceId h : mesh.halffaces()) {
    const auto [p, q, r] = mesh.vertices(h);
    const WeightConstraint over = {Kind::height_over_face, p, q, r, mesh.opposite(h)};
    EXPECT_EQ(check(over, Constraints::distances) == CertificateCheck::proves_nothing, mesh.bounds_region(h));
  }
}

}  // namespace
}  // namespace temper::tets
