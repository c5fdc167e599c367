// Weights alone on surfaces: the plane's weights in the plane, exact verdicts, and certificates.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/surface_meshes.hpp"
#include "temper/detail/lp.hpp"
#include "temper/generate.hpp"

namespace temper::surfaces {
namespace {

WeightReport weights_of(const SurfaceMesh& mesh, const WeightOptions& options = {}) {
  auto found = find_weights(mesh, *clp_solver(), options, interior_point_solver().get());
  EXPECT_TRUE(found) << found.error().what();
  return *std::move(found);
}

SurfaceMesh with(SurfaceMesh mesh, const IdVector<VertexId, double>& weights) {
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, weights[v]);
  return mesh;
}

/// An icosphere with random radii, thinner along z.
SurfaceMesh rough_sphere(double roughness, std::uint64_t seed, double thickness = 1) {
  Rng rng(seed);
  test::SurfaceArrays arrays = test::icosphere(2);
  for (Vec3& p : arrays.points) p = rng.uniform(1 - roughness, 1 + roughness) * Vec3{p.x, p.y, thickness * p.z};
  return test::mesh_of(arrays);
}

/// A strip with random diagonals, bent to a saddle.
SurfaceMesh saddle(std::uint64_t seed, double bend) {
  return test::mesh_of(test::mapped(test::plane_strip(8, seed), [&](Vec2 p) {
    return Vec3{p.x, p.y, bend * (p.x - 4) * (p.y - 4)};
  }));
}

/// A pinwheel: a triangle in a larger one, turned and lifted. The diagonals between them all turn one way.
SurfaceMesh pinwheel(double turn, double height) {
  test::SurfaceArrays arrays;
  for (int k = 0; k < 6; ++k) {
    const double angle = 2 * std::numbers::pi / 3 * k + (k < 3 ? 0 : turn), away = k < 3 ? 4 : 1;
    const double x = away * std::cos(angle), y = away * std::sin(angle);
    arrays.points.push_back({x + 0.3 * y, y, k < 3 ? 0 : height});  // sheared, so that its triangles differ
  }
  arrays.triangles = {{3, 4, 5}};
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    arrays.triangles.insert(arrays.triangles.end(), {{k, next, k + 3}, {next, next + 3, k + 3}});
  }
  return test::mesh_of(arrays);
}

TEST(SurfaceWeights, InThePlaneTheyAreThePlanesBitForBit) {
  for (const WeightGoal goal : {WeightGoal::change, WeightGoal::elastic, WeightGoal::margin}) {
    for (const std::uint64_t seed : {1, 2}) {
      const Mesh plane = *random_mesh({.vertices = 120, .seed = seed});
      const SurfaceMesh surface = test::mesh_of(test::lifted(plane));
      WeightOptions options;
      options.goal = goal;
      const WeightReport here = weights_of(surface, options),
                         there = *temper::find_weights(plane, *clp_solver(), options);
      EXPECT_EQ(here.weights, there.weights);
      EXPECT_EQ(here.verdict, there.verdict);
      EXPECT_EQ(here.margin, there.margin);
      EXPECT_EQ(here.certificate, there.certificate);
      EXPECT_EQ(here.violations.size(), there.violations.size());
      EXPECT_EQ(weight_change(surface, here.weights, IdVector<VertexId, double>(plane.n_vertices(), 0.0)),
                temper::weight_change(plane, there.weights, IdVector<VertexId, double>(plane.n_vertices(), 0.0)));
    }
  }
}

TEST(SurfaceWeights, OfFoldedPaperHaveTheMarginOfItsUnfolding) {
  const Mesh strip = test::plane_strip(6, 5);
  const SurfaceMesh folded = test::mesh_of(test::folded(strip, 0.9));
  for (const Constraints constraints :
       {Constraints::well_centered, Constraints::heights_only, Constraints::coefficients, Constraints::distances}) {
    EXPECT_NEAR(weight_margin(folded, constraints), temper::weight_margin(strip, constraints), 1e-12);
    WeightOptions options;
    options.goal = WeightGoal::margin;
    options.constraints = constraints;
    const WeightReport here = weights_of(folded, options), there = *temper::find_weights(strip, *clp_solver(), options);
    EXPECT_EQ(here.verdict, there.verdict) << name(constraints);
    EXPECT_NEAR(here.margin, there.margin, 1e-8) << name(constraints);
  }
}

TEST(SurfaceWeights, MakeARoughSphereWellCentered) {
  const SurfaceMesh sphere = rough_sphere(0.35, 3);
  EXPECT_LT(quality(sphere).well_centered_fraction, 1);
  WeightOptions options;
  options.goal = WeightGoal::margin;
  const WeightReport report = weights_of(sphere, options);
  ASSERT_EQ(report.verdict, Feasibility::feasible);
  EXPECT_GE(report.attained, report.asked - 1e-9);
  const SurfaceMesh after = with(sphere, report.weights);
  EXPECT_EQ(quality(after).well_centered_fraction, 1);
  EXPECT_NEAR(weight_margin(after), report.attained, 1e-12);

  options.goal = WeightGoal::center;
  options.constraints = Constraints::well_centered;
  const WeightReport center = weights_of(sphere, options);
  ASSERT_TRUE(center.solved);
  EXPECT_EQ(quality(with(sphere, center.weights)).well_centered_fraction, 1);
  EXPECT_LT(center.optimality->relative_gap(), 1e-6);
}

/// The sum of a certificate in doubles, from heights alone: Σ multiplier N at some weights.
double sum_at(const SurfaceMesh& mesh, const Certificate& certificate, const IdVector<VertexId, double>& weights) {
  const auto at = [&](VertexId v) {
    WeightedPoint p = mesh.point(v);
    p.w = weights[v];
    return p;
  };
  double sum = 0;
  for (const auto& [c, multiplier] : certificate.terms) {
    const WeightedPoint p = at(c.p), q = at(c.q);
    const double l = length(q.position() - p.position());
    const auto area = [&](const WeightedPoint& v) {
      return length(cross(q.position() - p.position(), v.position() - p.position()));
    };
    if (c.kind == WeightConstraint::Kind::crossing) {
      sum += multiplier * 2 * l * (dual_crossing(p, q) - certificate.margin * l);
    } else if (c.kind == WeightConstraint::Kind::height) {
      const double margin = certificate.constraints == Constraints::coefficients ? 0 : certificate.margin;
      sum += multiplier * 2 * l * area(at(c.r)) * (signed_height(p, q, at(c.r)) - margin * l);
    } else {
      const WeightedPoint r = at(c.r), s = at(c.s);
      const double dual = signed_height(p, q, r) + signed_height(q, p, s);
      sum += multiplier * 2 * l * area(r) * area(s) * (dual - certificate.margin * l);
    }
  }
  return sum;
}

TEST(SurfaceWeights, EveryVerdictHasAProof) {
  std::map<Feasibility, int> verdicts;
  for (const Constraints constraints :
       {Constraints::well_centered, Constraints::heights_only, Constraints::regular, Constraints::distances}) {
    for (const SurfaceMesh& mesh : {rough_sphere(0.35, 3), rough_sphere(0.1, 3, 0.3), saddle(1, 0.3), pinwheel(0, 0.5),
                                    pinwheel(0.2, 0.5), pinwheel(-0.2, 0.5), pinwheel(-0.2, 0)}) {
      WeightOptions options;
      options.goal = WeightGoal::margin;
      options.constraints = constraints;
      const WeightReport report = weights_of(mesh, options);
      ++verdicts[report.verdict];
      if (report.verdict == Feasibility::feasible) {
        EXPECT_GT(weight_margin(with(mesh, report.weights), constraints), 0);
        continue;
      }
      if (report.verdict == Feasibility::undecided) {
        EXPECT_NEAR(report.margin, 0, 1e-9);
        continue;
      }
      ASSERT_EQ(report.verdict, Feasibility::infeasible) << name(constraints);
      const Certificate& certificate = report.certificate;
      ASSERT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
      // The weights cancel, and the rest is negative.
      IdVector<VertexId, double> weights(mesh.n_vertices(), 0.0);
      const double rest = sum_at(mesh, certificate, weights);
      EXPECT_LT(rest, 0);
      Rng rng(1);
      for (double& w : weights) w = rng.uniform(-1, 1);
      EXPECT_NEAR(sum_at(mesh, certificate, weights), rest, 1e-6 * std::abs(rest));

      Certificate wrong = certificate;
      wrong.terms.resize(1);
      EXPECT_EQ(check_certificate(mesh, wrong), CertificateCheck::proves_nothing);
      wrong = certificate;
      wrong.terms.front().constraint.q = wrong.terms.front().constraint.p;
      EXPECT_EQ(check_certificate(mesh, wrong), CertificateCheck::not_of_this_mesh);
      wrong = certificate;
      wrong.terms.front().multiplier = -1;
      EXPECT_EQ(check_certificate(mesh, wrong), CertificateCheck::bad_multiplier);
      EXPECT_NE(check_certificate(rough_sphere(0, 1), certificate), CertificateCheck::proves);
    }
  }
  EXPECT_GE(verdicts[Feasibility::feasible], 8);
  EXPECT_GE(verdicts[Feasibility::infeasible], 14);
}

TEST(SurfaceWeights, ACertificateRefutesAMarginAboveTheBestOneOnly) {
  const SurfaceMesh mesh = rough_sphere(0.35, 3);
  for (const Constraints constraints : {Constraints::well_centered, Constraints::regular}) {
    WeightOptions options;
    options.goal = WeightGoal::margin;
    options.constraints = constraints;
    const double best = weights_of(mesh, options).margin;
    ASSERT_GT(best, 0.01);
    options.goal = WeightGoal::change;
    options.margin = best + 0.02;
    Certificate certificate = weights_of(mesh, options).certificate;
    EXPECT_EQ(certificate.margin, options.margin);
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves) << name(constraints);
    certificate.margin = best + 1e-4;
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves) << name(constraints);
    certificate.margin = best - 1e-4;
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves_nothing) << name(constraints);
  }
}

TEST(SurfaceWeights, DualLengthsOfAPinwheelHaveABestMarginOfAnySign) {
  // Seen from a point below, edges of a convex surface are regular with the weights |x|². Diagonals that are reflex
  // edges are not.
  const auto best = [](double turn) {
    WeightOptions options;
    options.goal = WeightGoal::margin;
    options.constraints = Constraints::regular;
    return weights_of(pinwheel(turn, 0.5), options).margin;
  };
  EXPECT_GT(best(0.2), 0.1);
  EXPECT_NEAR(best(0), 0, 1e-9);
  EXPECT_LT(best(-0.2), -1e-3);
}

double sum_of(const std::vector<Violation>& violations) {
  double sum = 0;
  for (const Violation& v : violations) sum += v.shortfall;
  return sum;
}

TEST(SurfaceWeights, OfLargeMeshesViolateAsLittleAsByTheLinearProgram) {
  for (const SurfaceMesh& mesh : {rough_sphere(0.4, 2, 0.3), saddle(1, 0.3), pinwheel(-0.2, 0.5)}) {
    for (const Constraints constraints : {Constraints::well_centered, Constraints::heights_only}) {
      WeightOptions options;
      options.goal = WeightGoal::elastic;
      options.constraints = constraints;
      const WeightReport whole = weights_of(mesh, options);
      options.whole = 0;
      const WeightReport grown = weights_of(mesh, options);
      EXPECT_EQ(grown.verdict, whole.verdict);
      const double least = sum_of(whole.violations);
      EXPECT_GE(sum_of(grown.violations), least - 1e-6);
      EXPECT_LE(sum_of(grown.violations), 1.03 * least + 1e-6) << name(constraints);
      EXPECT_EQ(check_certificate(mesh, grown.certificate), check_certificate(mesh, whole.certificate));
    }
  }
}

TEST(SurfaceWeights, FewestViolatesFewConstraintsAndNoneWithoutNeed) {
  WeightOptions elastic, fewest;
  elastic.goal = WeightGoal::elastic;
  fewest.goal = WeightGoal::fewest;
  std::size_t all = 0, few = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SurfaceMesh mesh = rough_sphere(0.4, seed, 0.3);
    const WeightReport one = weights_of(mesh, elastic), other = weights_of(mesh, fewest);
    ASSERT_EQ(one.verdict, Feasibility::infeasible);
    all += one.violations.size(), few += other.violations.size();
    EXPECT_GE(sum_of(other.violations), sum_of(one.violations) - 1e-6);
    EXPECT_EQ(other.certificate, one.certificate);
  }
  EXPECT_LT(few, all);

  const SurfaceMesh sphere = rough_sphere(0.35, 3);
  fewest.margin = 0.3;  // No weights have this margin, but no triangle is bad
  const WeightReport report = weights_of(sphere, fewest);
  EXPECT_EQ(report.verdict, Feasibility::feasible);
  EXPECT_GT(report.violations.size(), 0U);
  EXPECT_GT(report.attained, 0);
}

TEST(IntrinsicWeights, BeforeFlipsAreThoseOfTheMesh) {
  for (const SurfaceMesh& mesh :
       {rough_sphere(0.35, 3), rough_sphere(0.1, 3, 0.3), saddle(1, 0.3), pinwheel(-0.2, 0.5)}) {
    const IntrinsicMesh intrinsic(mesh);
    for (const Constraints constraints :
         {Constraints::well_centered, Constraints::heights_only, Constraints::regular, Constraints::coefficients}) {
      EXPECT_NEAR(weight_margin(intrinsic, constraints), weight_margin(mesh, constraints), 1e-11);
      WeightOptions options;
      options.goal = WeightGoal::margin;
      options.constraints = constraints;
      const WeightReport there = weights_of(mesh, options);
      const auto here = find_weights(intrinsic, *clp_solver(), options);
      ASSERT_TRUE(here);
      EXPECT_EQ(here->verdict, there.verdict);
      EXPECT_NEAR(here->margin, there.margin, 1e-7);
      if (here->verdict != Feasibility::infeasible) continue;
      EXPECT_EQ(check_certificate(intrinsic, here->certificate), CertificateCheck::proves) << name(constraints);
      EXPECT_EQ(check_certificate(intrinsic, there.certificate), CertificateCheck::proves) << name(constraints);
      Certificate wrong = here->certificate;
      wrong.terms.resize(1);
      EXPECT_EQ(check_certificate(intrinsic, wrong), CertificateCheck::proves_nothing);
    }
  }
}

TEST(IntrinsicWeights, NeedFlipsWhereTheMeshItselfHasNoWeights) {
  int cured = 0;
  std::size_t most_rounds = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const SurfaceMesh mesh = rough_sphere(0.35, seed, seed < 4 ? 0.6 : 0.4);
    WeightOptions options;
    options.goal = WeightGoal::fewest;
    const std::size_t own = n_bad_triangles(IntrinsicMesh(with(mesh, weights_of(mesh, options).weights)));
    IntrinsicMesh intrinsic(mesh);
    const auto found = find_intrinsic_weights(intrinsic, *clp_solver(), options, interior_point_solver().get());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->bad_before, n_bad_triangles(IntrinsicMesh(mesh)));
    EXPECT_EQ(found->bad_after, n_bad_triangles(intrinsic));
    EXPECT_LE(found->bad_after, own);
    IntrinsicMesh delaunay(mesh);
    flip_to_regular(delaunay);
    const auto once = find_weights(delaunay, *clp_solver(), options, interior_point_solver().get());
    for (const VertexId v : mesh.vertices()) delaunay.set_weight(v, once->weights[v]);
    EXPECT_LE(found->bad_after, n_bad_triangles(delaunay));
    most_rounds = std::max(most_rounds, found->rounds);
    EXPECT_EQ(found->flips.flips > 0, own > 0);
    cured += own > 0 && found->bad_after == 0 ? 1 : 0;
    const bool proves = check_certificate(intrinsic, found->report.certificate) == CertificateCheck::proves;
    EXPECT_TRUE(proves || found->report.verdict != Feasibility::infeasible);
    for (const VertexId v : mesh.vertices()) EXPECT_EQ(intrinsic.weight(v), found->report.weights[v]);
  }
  EXPECT_GE(cured, 1);
  EXPECT_GE(most_rounds, 3U);  // flips for the weights that were found help again
}

TEST(SurfaceWeights, ATorusOfTrapezoidsHasTheBestMarginZero) {
  // The best weights may depend on the height alone, by symmetry. Then the corners of each trapezoid stay cocircular.
  const SurfaceMesh torus = test::mesh_of(test::torus(12, 8));
  WeightOptions options;
  options.goal = WeightGoal::margin;
  const WeightReport report = weights_of(torus, options);
  EXPECT_NE(report.verdict, Feasibility::feasible);
  EXPECT_NEAR(report.margin, 0, 1e-9);
}

TEST(SurfaceWeights, AnErrorNamesTheGoalThatSurfacesDoNotHave) {
  WeightOptions options;
  options.goal = WeightGoal::accuracy;
  const auto found =
      find_weights(test::mesh_of(test::icosphere(0)), *clp_solver(), options, interior_point_solver().get());
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::invalid_option);
}

}  // namespace
}  // namespace temper::surfaces
