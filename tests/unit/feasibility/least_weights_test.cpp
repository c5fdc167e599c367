// Least weights of triangles: the minimum by a linear program, the laws, places that stay, and proofs that there are
// none.
#include <algorithm>

#include "feasibility/constraints.hpp"
#include "support/spheres.hpp"
#include "unit/feasibility/least.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

constexpr Constraints kOuter[] = {Constraints::coefficients, Constraints::distances};

WeightReport least(const Mesh& mesh, Constraints constraints, std::size_t whole = 100'000) {
  return test::least_of(mesh, {.goal = WeightGoal::least, .whole = whole, .constraints = constraints});
}

bool keeps_with(const Mesh& mesh, Constraints constraints, const VertexWeights& weights) {
  const TriangleDemand demand(mesh, constraints);
  return std::all_of(demand.cells().begin(), demand.cells().end(),
                     [&](CellId cell) { return demand.is_kept(cell, weights); });
}

/// Squares cut by diagonals, whose dual lengths are zero.
Mesh squares(int n) {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) points.push_back({double(i), double(j)});
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, c = a + n + 2;
      triangles.push_back({a, a + 1, c}), triangles.push_back({a, c, c - 1});
    }
  }
  return build_or_die(points, triangles);
}

Mesh in_two_regions(Mesh mesh) {
  for (const TriangleId t : mesh.triangles()) mesh.set_region(t, mesh.position(mesh.corners(t)[0]).y < 2 ? 1 : 0);
  return mesh;
}

TEST(LeastWeights, AreZeroIfTheMeshKeepsTheConstraintsEvenWithZeros) {
  const WeightReport of_squares = least(squares(4), Constraints::coefficients);
  EXPECT_TRUE(of_squares.solved);
  EXPECT_EQ(of_squares.moved + of_squares.programs, 0u);
  EXPECT_EQ(least(in_two_regions(squares(4)), Constraints::coefficients).moved, 0u);
  for (const Constraints constraints : kOuter)
    EXPECT_EQ(least(lattice({.jitter = 0.05, .weight = 0}), constraints).moved, 0u);
  EXPECT_GT(least(squares(4), Constraints::distances).moved, 0u);
}

TEST(LeastWeights, AreTheMinimumAndKeepTheConstraintsExactly) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const Mesh random = mesh_of_random_points(rng, static_cast<int>(seed % 12));
    const Mesh lattice = jittered_lattice(seed), halves = in_two_regions(lattice);
    for (const Mesh* const one : {&random, &lattice, &halves}) {
      const Mesh& mesh = *one;
      for (const Constraints constraints : kOuter) {
        const WeightReport report = least(mesh, constraints);
        ASSERT_NE(report.verdict, Feasibility::undecided) << seed << " " << report.margin;
        if (report.verdict == Feasibility::infeasible) {
          EXPECT_EQ(check_certificate(mesh, report.certificate), CertificateCheck::proves);
          continue;
        }
        EXPECT_TRUE(keeps_with(mesh, constraints, report.weights));
        if (report.moved == 0 || one == &random) continue;  // random triangles are so thin that Clp gives up
        found += expect_minimum(TriangleDemand(mesh, constraints), report) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(found, 20u);
}

TEST(LeastWeights, ScaleByPowersOfTwoExactly) {
  const Mesh mesh = jittered_lattice(3);
  for (const Constraints constraints : kOuter) {
    const WeightReport report = least(mesh, constraints), small = least(scaled(mesh, 0x1p-7), constraints);
    EXPECT_GT(report.moved, 0u);
    for (const VertexId v : mesh.vertices()) EXPECT_EQ(small.weights[v], 0x1p-14 * report.weights[v]);
  }
}

TEST(LeastWeights, OfALargeMeshChangeOnlyTheSurroundingsOfBadPlaces) {
  Mesh mesh = lattice({.n = 40, .jitter = 0, .weight = 0});
  const VertexId moved(std::size_t{20 * 40 + 20});
  mesh.set_position(moved, mesh.position(moved) + Vec2{0.55, 0.3});
  for (const Constraints constraints : kOuter) {
    const WeightReport report = least(mesh, constraints, 100);
    EXPECT_EQ(report.verdict, Feasibility::feasible);
    EXPECT_TRUE(keeps_with(mesh, constraints, report.weights));
    EXPECT_GT(report.moved, 0u);
    EXPECT_LT(report.moved, 100u);
  }
}

TEST(LeastWeights, ChangeTheWeightsOfTheInputLittle) {
  Mesh mesh = jittered_lattice(5);
  for (const Constraints constraints : kOuter) {
    const WeightReport report = least(mesh, constraints);
    ASSERT_TRUE(report.solved);
    const WeightReport again =
        least_of(with_weights(mesh, report.weights),
                 {.goal = WeightGoal::least, .margin = 0.009, .from_input = true, .constraints = constraints});
    EXPECT_EQ(again.moved, 0u);
    EXPECT_EQ(again.weights, report.weights);
  }
}

TEST(LeastWeights, ExistOnTheSphereToo) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = jittered_globe(seed, 0.3);
    for (const Constraints constraints : kOuter) {
      const WeightReport report = least(mesh, constraints);
      if (report.verdict != Feasibility::feasible) continue;
      EXPECT_TRUE(keeps_with(mesh, constraints, report.weights));
      EXPECT_GT(report.moved, 0u);
      ++found;
    }
  }
  EXPECT_GT(found, 1u);
}

TEST(LeastWeights, HaveAProofIfThereAreNoneThatBecomesNoneIfChanged) {
  const Mesh mesh = pinwheel();
  for (const Constraints constraints : kOuter) {
    const WeightReport report = least(mesh, constraints);
    EXPECT_EQ(report.verdict, Feasibility::infeasible);
    EXPECT_FALSE(report.violations.empty());
    const Certificate& certificate = report.certificate;
    EXPECT_EQ(certificate.constraints, constraints);
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
    for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
      Certificate corrupted = certificate;
      corrupted.terms[i].multiplier *= 1.5;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::proves_nothing) << i;
      corrupted = certificate;
      corrupted.terms[i].constraint.q = corrupted.terms[i].constraint.p;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::not_of_this_mesh) << i;
    }
  }
}

// Zero is no contradiction if zero is allowed: the diagonal of a square, from both sides of which the terms cancel.
TEST(LeastWeights, OfCoefficientsMayBeZeroSoThatASumOfZeroProvesNothing) {
  const Mesh mesh = squares(1);
  const HalfedgeId h = mesh.find_halfedge(VertexId(0), VertexId(3));
  ASSERT_TRUE(h.valid());
  const WeightConstraint inside = height_constraint(mesh, h);
  for (const Constraints constraints : kOuter) {
    EXPECT_EQ(check_certificate(mesh, {.terms = {{inside, 1}}, .constraints = constraints}),
              CertificateCheck::not_of_this_mesh);  // only heights over the boundary count
  }
  const Mesh halves = [&] {
    Mesh two = mesh;
    two.set_region(TriangleId(0), 1);
    return two;
  }();
  // Both heights over the diagonal and its dual length are zero whatever a constant on all weights is.
  EXPECT_EQ(check_certificate(halves, {.terms = {{inside, 1}}, .constraints = Constraints::coefficients}),
            CertificateCheck::proves_nothing);
}

}  // namespace
}  // namespace temper::test
