// Weights alone on the sphere: the constraints are linear in σ = R/|P|, and all that the plane's programs and
// certificates promise holds there.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "feasibility/constraints.hpp"
#include "support/spheres.hpp"
#include "temper/detail/connectivity.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

using Kind = WeightConstraint::Kind;

Mesh with_random_weights(Mesh mesh, std::uint64_t seed, double most) {
  Rng rng(seed);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, rng.uniform(-most, most));
  return mesh;
}

/// All P times a number.
Mesh gauged(Mesh mesh, double factor) {
  for (const VertexId v : mesh.vertices()) mesh.set_point(v, as_point(factor * mesh.weighted_vector(v)));
  return mesh;
}

/// Turned by a product of three plane rotations.
Mesh turned(Mesh mesh, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (const VertexId v : mesh.vertices()) {
    Vec3 p = mesh.weighted_vector(v);
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
    p = {c * p.x - s * p.z, p.y, s * p.x + c * p.z};
    mesh.set_point(v, as_point(p));
  }
  return mesh;
}

/// A mesh of the plane on the cap around the pole of a sphere, by the gnomonic map.
Mesh on_cap(const Mesh& plane, double radius) {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const VertexId v : plane.vertices()) {
    const Vec3 p = {plane.position(v).x, plane.position(v).y, radius};
    points.push_back((radius / length(p)) * p);
  }
  for (const TriangleId t : plane.triangles()) {
    const auto [a, b, c] = plane.corners(t);
    triangles.push_back(
        {static_cast<std::int32_t>(a.index), static_cast<std::int32_t>(b.index), static_cast<std::int32_t>(c.index)});
  }
  MeshInput input;
  input.sphere_points = points, input.triangles = triangles, input.space = Space::sphere(radius);
  auto built = Mesh::build(input);
  if (!built) ADD_FAILURE() << built.error().what();
  Mesh mesh = std::move(built->mesh);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, plane.weight(v));
  return mesh;
}

bool keeps_on_sphere(const Mesh& mesh, Constraints constraints) {
  const TriangleDemand demand(mesh, constraints);
  return std::all_of(demand.cells().begin(), demand.cells().end(),
                     [&](CellId cell) { return demand.is_kept(cell, demand.weights()); });
}

Certificate corrupted(Certificate certificate, std::size_t i, double factor) {
  certificate.terms[i].multiplier *= factor;
  return certificate;
}

TEST(SphereForms, HaveTheSignsOfTheExactPredicates) {
  std::size_t tried = 0, positive = 0;
  const auto expect_sign = [&](const Mesh& mesh, const WeightConstraint& c, Sign expected) {
    const double value =
        value_of(linear_form(mesh, c), [&](VertexId v) { return potential_of(mesh.space(), mesh.weight(v)); });
    if (std::abs(value) < 1e-11) return;  // rounding of coordinates decides
    ++tried;
    positive += value > 0 ? 1 : 0;
    EXPECT_EQ(value > 0, expected == Sign::positive) << name(c.kind) << " " << value;
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double radius = seed % 2 == 0 ? 6371000 : 1;
    const Mesh sphere = *random_sphere({.vertices = 60, .seed = seed, .radius = radius});
    const Mesh mesh = with_random_weights(sphere, seed, 0.3 * radius * radius);
    for (const HalfedgeId h : mesh.halfedges()) {
      const auto at = [&](VertexId v) { return mesh.weighted_vector(v); };
      const VertexId p = mesh.origin(h), q = mesh.target(h), r = mesh.opposite(h), s = mesh.opposite(mesh.twin(h));
      expect_sign(mesh, height_constraint(mesh, h), signed_height_sign(at(p), at(q), at(r)));
      expect_sign(mesh, split_constraint(p, q), dual_crossing_sign(at(p), at(q)));
      expect_sign(mesh, dual_constraint(mesh, h), -power_test(at(p), at(q), at(r), at(s)));
    }
  }
  EXPECT_GT(tried, 15000u);
  EXPECT_GT(positive, 1000u);
  EXPECT_GT(tried - positive, 1000u);
}

// The naive twin: arcs from the constructions. With all σ one, a height is R tan h over 2 R sin(ℓ/2) cos²(ℓ/2).
TEST(SphereForms, AreArcsOfTheMeshWhereWeightsAreEqual) {
  const Mesh mesh = globe(100, 7);
  for (const HalfedgeId h : mesh.halfedges()) {
    const Vec3 p = mesh.weighted_vector(mesh.origin(h)), q = mesh.weighted_vector(mesh.target(h)),
               r = mesh.weighted_vector(mesh.opposite(h));
    const double half = 0.5 * arc_length(p, q);
    const double expected = std::tan(signed_height(p, q, r)) / (2 * std::sin(half) * std::cos(half) * std::cos(half));
    const double value = value_of(linear_form(mesh, height_constraint(mesh, h)), [](VertexId) { return 0.0; });
    EXPECT_NEAR(value, expected, 1e-9 * (1 + std::abs(expected)));
    EXPECT_NEAR(
        value_of(linear_form(mesh, split_constraint(mesh.origin(h), mesh.target(h))), [](VertexId) { return 0.0; }),
        0.5, 1e-12);
  }
}

TEST(SpherePotential, IsTheWeightToFirstOrderAndBack) {
  for (const double radius : {1.0, 6371000.0}) {
    const Space space = Space::sphere(radius);
    for (const double part : {-0.9, -0.1, -1e-6, 0.0, 1e-12, 1e-3, 0.5, 10.0}) {
      const double w = part * radius * radius, potential = potential_of(space, w);
      EXPECT_NEAR(weight_of_potential(space, potential), w, 1e-14 * std::abs(w));
      EXPECT_NEAR(1 - slope_of_scale(space) * potential, 1 / std::sqrt(1 + part), 1e-14);
      if (std::abs(part) < 1e-2) {
        EXPECT_NEAR(potential, w, 2 * std::abs(part * w));
      }
    }
  }
}

TEST(SphereMargin, DoesNotDependOnTheFactorTheTurnTheSizeOrTheWeights) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = jittered_globe(seed, 0.15 * static_cast<double>(seed));
    for (const ConstraintsInfo& row : constraints_table()) {
      const double expected = margin_of(mesh, row.constraints).margin;
      const Mesh heavy = with_random_weights(mesh, seed, 0.01);
      for (const Mesh& other : {gauged(mesh, 1.3), turned(mesh, 0.7), heavy}) {
        const double margin = margin_of(other, row.constraints).margin;
        if (TriangleDemand(mesh, row.constraints).has_duals()) {  // no heights, as a globe has no boundary
          EXPECT_EQ(margin > 1e-9, expected > 1e-9);
        } else {
          EXPECT_NEAR(margin, expected, 1e-6) << row.name;
        }
      }
      for (const double factor : {0.5, 1.001, 3.0}) {
        EXPECT_NEAR(weight_margin(gauged(heavy, factor), row.constraints), weight_margin(heavy, row.constraints), 1e-9);
      }
    }
  }
}

TEST(SphereMargin, IsAttainedByItsWeightsAndRefutedAbove) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Mesh mesh = jittered_globe(seed, 0.1 * static_cast<double>(seed));
    for (const ConstraintsInfo& row : constraints_table()) {
      const BestMargin best = margin_of(mesh, row.constraints);
      ASSERT_EQ(best.status, LpStatus::optimal);
      Mesh attained = mesh;
      for (std::size_t i = 0; i < best.vertices.size(); ++i) attained.set_weight(best.vertices[i], best.weights[i]);
      EXPECT_NEAR(weight_margin(attained, row.constraints), best.margin, 1e-6) << row.name;
      EXPECT_EQ(keeps_on_sphere(attained, row.constraints), best.margin > 1e-7) << row.name << " " << best.margin;
    }
  }
}

// A cap of a sphere that grows is the plane, to second order.
TEST(SphereMargin, OfACapThatShrinksIsThePlanesToSecondOrder) {
  for (const Mesh& plane : {*horseshoe(), jittered_lattice(4), jittered_lattice(5)}) {
    for (const ConstraintsInfo& row : constraints_table()) {
      if (row.constraints == Constraints::regular) continue;  // capped in the plane
      const double expected = margin_of(plane, row.constraints).margin;
      const double coarse = std::abs(margin_of(on_cap(plane, 200), row.constraints).margin - expected);
      const double fine = std::abs(margin_of(on_cap(plane, 2000), row.constraints).margin - expected);
      EXPECT_LT(coarse, 0.01) << row.name;
      EXPECT_LT(fine, coarse / 50 + 1e-8) << row.name;
    }
  }
}

TEST(SphereWeights, AreRightUnderEveryConditionForTheWholeAndByNeighborhoods) {
  std::array<int, 3> verdicts = {};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh mesh = jittered_globe(seed, 0.09 * static_cast<double>(seed));
    for (const ConstraintsInfo& row : constraints_table()) {
      const double best = margin_of(mesh, row.constraints).margin;
      for (const std::size_t whole : {std::size_t{3000}, std::size_t{0}}) {
        for (const WeightGoal goal : {WeightGoal::margin, WeightGoal::change, WeightGoal::elastic}) {
          WeightOptions options = {.goal = goal, .margin = 0.02, .constraints = row.constraints};
          options.whole = whole;
          const WeightReport report = weights_of(mesh, options);
          ++verdicts[static_cast<std::size_t>(report.verdict)];
          if (report.verdict == Feasibility::feasible) {
            EXPECT_GT(best, 0) << row.name;
          }
          if (report.verdict == Feasibility::infeasible) {
            EXPECT_LT(best, 2e-6) << row.name;
          }
          if (!report.certificate.terms.empty()) {
            EXPECT_EQ(check_certificate(mesh, report.certificate), CertificateCheck::proves);
          }
          if (!report.solved) continue;
          const Mesh result = with_weights(mesh, report.weights);
          EXPECT_NEAR(weight_margin(result, row.constraints), report.attained, 1e-9);
          if (goal == WeightGoal::elastic) continue;
          EXPECT_TRUE(keeps_on_sphere(result, row.constraints)) << row.name;
          if (row.constraints == Constraints::coefficients) continue;  // there, a small one may stay as it is
          EXPECT_GE(report.attained, report.asked - 1e-8) << row.name;
        }
      }
    }
  }
  EXPECT_GT(verdicts[0], 20);
  EXPECT_GT(verdicts[1], 20);
}

TEST(SphereWeights, LeavePlacesAndUnchangedVerticesAlone) {
  const Mesh mesh = jittered_globe(3, 0.15, 3);
  const WeightReport report = weights_of(mesh, {.margin = 0.02});
  ASSERT_TRUE(report.solved);
  ASSERT_GT(report.moved, 0u);
  EXPECT_LT(report.moved, mesh.n_vertices());
  const Mesh result = with_weights(mesh, report.weights);
  for (const VertexId v : mesh.vertices()) {
    EXPECT_TRUE(mesh.space().same_place(mesh.point(v), result.point(v)));
    if (report.weights[v] == 0) {
      EXPECT_EQ(result.point(v), mesh.point(v));
    }
  }
}

TEST(SphereCertificate, ProvesAndIsNoProofOnceAnythingIsChanged) {
  std::size_t proofs = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Mesh mesh = jittered_globe(seed, 0.35);
    for (const ConstraintsInfo& row : constraints_table()) {
      const Certificate certificate = margin_of(mesh, row.constraints).certificate;
      if (certificate.terms.empty()) continue;
      ++proofs;
      EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
      EXPECT_EQ(check_certificate(gauged(mesh, 2), certificate), CertificateCheck::proves);
      EXPECT_EQ(check_certificate(*icosahedral({.level = 1}), certificate), CertificateCheck::proves_nothing);
      for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
        EXPECT_EQ(check_certificate(mesh, corrupted(certificate, i, -1)), CertificateCheck::bad_multiplier);
        if (certificate.terms[i].constraint.kind == Kind::crossing) continue;  // bounded anyway
        EXPECT_EQ(check_certificate(mesh, corrupted(certificate, i, 1e12)), CertificateCheck::proves_nothing)
            << row.name << " " << i;
      }
      Certificate above = certificate;
      above.margin = 0.3;
      EXPECT_EQ(check_certificate(mesh, above), CertificateCheck::proves);
    }
  }
  EXPECT_GT(proofs, 12u);
}

// The law that matters: where there are good weights, nothing proves that there are none.
TEST(SphereCertificate, NeverProvesAnythingOfAMeshThatHasGoodWeights) {
  const Mesh mesh = *icosahedral({.level = 2});
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    Certificate certificate;
    for (std::uint32_t n = 1 + rng.below(8); n > 0; --n) {
      const HalfedgeId h(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_halfedges()))});
      certificate.terms.push_back(
          {rng.below(2) == 0 ? height_constraint(mesh, h) : split_constraint(mesh.origin(h), mesh.target(h)),
           std::ldexp(rng.uniform(0.5, 1), -static_cast<int>(rng.below(60)))});
    }
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves_nothing);
  }
}

TEST(SphereConnectivity, GrowsTheMarginAndKeepsPlacesAndWeights) {
  const Mesh mesh = jittered_globe(2, 0.4);
  const auto report = best_connectivity(mesh, *clp_solver(), {.programs = 30});
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->steps.empty());
  double margin = report->before;
  for (const ConnectivityStep& step : report->steps) {
    EXPECT_GT(step.margin, margin);
    margin = step.margin;
  }
  EXPECT_NEAR(margin_of(report->mesh).margin, report->margin, 1e-7);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(report->mesh.point(v), mesh.point(v));
}

}  // namespace
}  // namespace temper::test
