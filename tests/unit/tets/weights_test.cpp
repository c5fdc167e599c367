// Weights for tetrahedra: what was asked for is there, exactly; what cannot be is proved, and nothing else is.
#include "temper/tets/weights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "base/rng.hpp"
#include "support/tet_lattice.hpp"
#include "temper/detail/lp.hpp"
#include "temper/tets/quality.hpp"
#include "tets/weights/demand.hpp"
#include "unit/feasibility/support.hpp"
#include "unit/tets/pinwheel_cone.hpp"

namespace temper::tets {
namespace {

using test::weights_of;
using Kind = WeightConstraint::Kind;

constexpr double kLacking = 1e-7;  // what a margin may lack: the solver's tolerance on its own rows

TetMesh with_weights(TetMesh mesh, const VertexWeights& weights) {
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, weights[v]);
  return mesh;
}

TetMesh scaled(TetMesh mesh, double factor, Vec3 offset = {}) {
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    const Vec3 to = factor * p.position() + offset;
    mesh.set_point(v, {to.x, to.y, to.z, factor * factor * p.w});
  }
  return mesh;
}

/// Edges of the surface with the third corners of their faces, each found by looking at all tetrahedra.
std::map<std::array<VertexId, 2>, std::vector<VertexId>> thirds_of(const TetMesh& mesh) {
  std::map<std::array<VertexId, 2>, std::vector<VertexId>> thirds;
  for (const HalffaceId h : mesh.halffaces()) {
    if (!mesh.bounds_region(h) || !mesh.is_face_representative(h)) continue;
    const auto [a, b, c] = mesh.vertices(h);
    thirds[{std::min(a, b), std::max(a, b)}].push_back(c);
    thirds[{std::min(b, c), std::max(b, c)}].push_back(a);
    thirds[{std::min(c, a), std::max(c, a)}].push_back(b);
  }
  return thirds;
}

/// The angle between the normals of the faces at pq.
double turn_of(const TetMesh& mesh, VertexId p, VertexId q, VertexId r, VertexId s) {
  const Vec3 at = mesh.position(p), pq = mesh.position(q) - at;
  const Vec3 up = cross(pq, mesh.position(r) - at), down = cross(mesh.position(s) - at, pq);
  return std::atan2(length(cross(up, down)), dot(up, down));
}

constexpr double kFlat = 5.07 * std::numbers::pi / 180;

/// Says by heights of orthocenters if weights keep coefficients or distances.
bool keeps_outer(const TetMesh& mesh, Constraints constraints) {
  double least = kUnbounded;
  for (const HalffaceId h : mesh.halffaces()) {
    const auto [p, q, r] = mesh.vertices(h);
    const auto over = [&](VertexId s) {
      return signed_height(mesh.point(p), mesh.point(q), mesh.point(r), mesh.point(s));
    };
    const double height = over(mesh.opposite(h));
    if (mesh.bounds_region(h)) least = std::min(least, height);
    if (!mesh.is_boundary(h))
      least = std::min(least, height + signed_height(mesh.point(p), mesh.point(r), mesh.point(q),
                                                     mesh.point(mesh.opposite(mesh.twin(h)))));
  }
  if (constraints == Constraints::distances) return least > 0;
  for (const auto& [ends, thirds] : thirds_of(mesh)) {
    const auto height = [&](VertexId r) {
      return signed_height(mesh.point(ends[0]), mesh.point(ends[1]), mesh.point(r));
    };
    const bool flat = thirds.size() == 2 && turn_of(mesh, ends[0], ends[1], thirds[0], thirds[1]) < kFlat;
    if (flat) least = std::min(least, height(thirds[0]) + height(thirds[1]));
    for (const VertexId r : thirds) least = flat ? least : std::min(least, height(r));
  }
  return least > -1e-12;
}

/// Says by the report on the mesh if the constraints hold.
bool keeps(const TetMesh& mesh, Constraints constraints) {
  if (constraints == Constraints::coefficients || constraints == Constraints::distances)
    return keeps_outer(mesh, constraints);
  const Quality q = quality(mesh);
  if (constraints == Constraints::well_centered) return q.orthocenters_outside == 0;
  if (constraints == Constraints::completely_well_centered) return q.completely_well_centered_fraction == 1;
  return q.non_regular_faces == 0 && std::isfinite(q.transmissibility_ratio);
}

TEST(TetDemand, HasTheFormsOfHeightsCrossingsAndDualLengths) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(3, test::kSixTets), 0.02, 0.2));
  for (const ConstraintsInfo& row : constraints_table()) {
    const TetDemand demand(mesh, row.constraints);
    for (const WeightConstraint& c : demand.constraints_of(all_cells(demand), false)) {
      const WeightedPoint p = mesh.point(c.p), q = mesh.point(c.q);
      const double l = length(q.position() - p.position());
      double expected = dual_crossing(p, q) / l;
      if (c.kind == Kind::height) expected = signed_height(p, q, mesh.point(c.r)) / l;
      if (c.kind == Kind::dual) {
        const double turn = turn_of(mesh, c.p, c.q, c.r, c.s);
        expected = (std::cos(turn) * signed_height(p, q, mesh.point(c.r)) + signed_height(q, p, mesh.point(c.s))) / l;
      } else if (c.s.valid()) {
        const WeightedPoint r = mesh.point(c.r);
        const double area = 0.5 * length(cross(q.position() - p.position(), r.position() - p.position()));
        expected = signed_height(p, q, r, mesh.point(c.s));
        if (c.kind == Kind::dual_of_face) expected += signed_height(p, r, q, mesh.point(c.t));
        expected /= std::sqrt(4 / std::numbers::sqrt3 * area);
      }
      EXPECT_NEAR(value_of(demand.linear_form(c), [&](VertexId v) { return mesh.weight(v); }), expected, 1e-11);
    }
  }
}

TEST(TetDemand, IsKeptAsTheReportSays) {
  std::size_t kept = 0, tried = 0;
  for (const double jitter : {0.0, 0.02, 0.05, 0.1, 0.2}) {
    const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(2), jitter, 0.1 * jitter));
    for (const ConstraintsInfo& row : constraints_table()) {
      const TetDemand demand(mesh, row.constraints);
      const VertexWeights weights = demand.weights();
      const bool all = std::all_of(demand.cells().begin(), demand.cells().end(),
                                   [&](CellId cell) { return demand.is_kept(cell, weights); });
      EXPECT_EQ(all, keeps(mesh, row.constraints)) << row.name << " " << jitter;
      EXPECT_EQ(all, weight_margin(mesh, row.constraints) > 0) << row.name << " " << jitter;
      kept += all ? 1 : 0, ++tried;
    }
  }
  EXPECT_GT(kept, 3U);
  EXPECT_LT(kept, tried);
}

TEST(TetDemand, CountsEachConstraintOnce) {
  const TetMesh mesh = test::mesh_of(test::cubes(3, test::kFiveTets));
  const Quality q = quality(mesh);
  const auto count = [&](Constraints constraints) {
    const TetDemand demand(mesh, constraints);
    return demand.constraints_of(all_cells(demand), true).size();
  };
  EXPECT_EQ(count(Constraints::well_centered), 4 * q.tetrahedra);
  EXPECT_EQ(count(Constraints::completely_well_centered), 4 * q.tetrahedra + 3 * q.faces + 2 * q.edges);
  EXPECT_EQ(count(Constraints::regular), q.faces - q.boundary_faces);
  EXPECT_EQ(count(Constraints::distances), q.faces);
  // Each of the six sides of the cube has 3 · 3² − 2 · 3 edges inside, and each of its twelve edges has two faces.
  EXPECT_EQ(count(Constraints::coefficients), q.faces + 6 * (27 - 6) + 12 * 3 * 2);
}

TEST(TetWeights, AreWhatWasAskedForOrProvedImpossible) {
  std::size_t found = 0, refuted = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const TetMesh& mesh : {test::mesh_of(test::shaken(test::body_centered(2), 0.15, 0.1, seed)),
                                test::mesh_of(test::shaken(test::cubes(2, test::kSixTets), 0.25, 0.1, seed))}) {
      for (const ConstraintsInfo& row : constraints_table()) {
        for (const std::size_t whole : {std::size_t{0}, std::size_t{3000}}) {
          const WeightReport report =
              weights_of(mesh, {.goal = WeightGoal::margin, .whole = whole, .constraints = row.constraints});
          const TetMesh weighted = with_weights(mesh, report.weights);
          ASSERT_NE(report.verdict, Feasibility::undecided) << row.name << " " << seed;
          const bool feasible = report.verdict == Feasibility::feasible;
          EXPECT_EQ(report.solved, feasible);
          if (feasible) {
            EXPECT_TRUE(keeps(weighted, row.constraints)) << row.name << " " << seed;
            if (row.constraints != Constraints::coefficients) {  // there, a small one may stay as it is
              EXPECT_GE(report.attained, report.asked - kLacking);
            }
            EXPECT_NEAR(report.attained, weight_margin(weighted, row.constraints), 1e-12);
          } else {
            EXPECT_EQ(check_certificate(mesh, report.certificate), CertificateCheck::proves);
          }
          (feasible ? found : refuted) += 1;
        }
      }
    }
  }
  EXPECT_GT(found, 5U);
  EXPECT_GT(refuted, 5U);
}

TEST(TetWeights, ChangeNothingWhereNothingIsBad) {
  const TetMesh mesh = test::mesh_of(test::body_centered(2));
  for (const ConstraintsInfo& row : constraints_table()) {
    const WeightReport report = weights_of(mesh, {.constraints = row.constraints});
    EXPECT_TRUE(report.solved) << row.name;
    EXPECT_EQ(report.moved + report.programs, 0U) << row.name;
  }
}

TEST(TetWeights, DoNotDependOnSizeAndPlace) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(2, test::kFiveTets), 0.15, 0.1, 2));
  for (const ConstraintsInfo& row : constraints_table()) {
    const WeightOptions options = {.goal = WeightGoal::margin, .constraints = row.constraints};
    const WeightReport report = weights_of(mesh, options);
    for (const double factor : {0x1p-20, 1e-3, 1e4}) {
      const WeightReport other = weights_of(scaled(mesh, factor, {factor, -2 * factor, 0}), options);
      EXPECT_EQ(other.verdict, report.verdict);
      EXPECT_NEAR(other.margin, report.margin, kLacking);
      EXPECT_NEAR(other.change / factor, report.change, 1e-5 * (1 + report.change));
    }
  }
}

TEST(TetWeights, ElasticViolatesLeastAndSaysWhere) {
  const TetMesh mesh = pinwheel_cone();
  const WeightReport report = weights_of(mesh, {.goal = WeightGoal::elastic, .constraints = Constraints::regular});
  EXPECT_TRUE(report.solved);
  EXPECT_EQ(report.verdict, Feasibility::infeasible);
  ASSERT_FALSE(report.violations.empty());
  for (const Violation& v : report.violations) {
    EXPECT_EQ(v.constraint.kind, Kind::dual_of_face);
    EXPECT_NEAR(v.value + v.shortfall, report.asked, 1e-12);
  }
  EXPECT_LT(report.violations.size(), 6U);
}

TEST(TetWeights, ElasticMakesNothingBadIfWeightsExist) {
  for (const ConstraintsInfo& row : constraints_table()) {
    // Any margin of dual lengths alone that is attained can be stretched.
    if (row.constraints == Constraints::regular || row.constraints == Constraints::coefficients) continue;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(2), 0.1, 0, seed));
      const double best =
          weights_of(mesh, {.goal = WeightGoal::margin, .margin = 1e-3, .constraints = row.constraints}).margin;
      ASSERT_GT(best, 0.01) << row.name << " " << seed;
      const WeightReport report = weights_of(
          mesh, {.goal = WeightGoal::elastic, .margin = std::min(2 * best, 0.45), .constraints = row.constraints});
      EXPECT_EQ(report.verdict, Feasibility::feasible) << row.name << " " << seed;
      EXPECT_GE(report.attained, best / 2 - kLacking) << row.name << " " << seed;
      EXPECT_FALSE(report.violations.empty());
    }
  }
}

TEST(TetWeights, RefuseWhatIsForTriangles) {
  const TetMesh mesh = pinwheel_cone();
  const auto solver = clp_solver();
  EXPECT_FALSE(find_weights(mesh, *solver, {.constraints = Constraints::heights_only}));
  EXPECT_FALSE(find_weights(mesh, *solver, {.constraints = Constraints::regular, .edges = {HalfedgeId(0)}}));
  EXPECT_FALSE(find_weights(mesh, *solver, {.margin = 0.5}));
}

class TetCertificate : public testing::Test {
 protected:
  static Certificate certificate_of(const TetMesh& mesh, Constraints constraints) {
    return weights_of(mesh, {.goal = WeightGoal::margin, .constraints = constraints}).certificate;
  }
};

TEST_F(TetCertificate, OfPinwheelsProvesWhateverTheirSize) {
  for (const double turn : {0.05, 0.1, 0.3}) {
    const TetMesh mesh = pinwheel_cone(turn);
    for (const double factor : {1.0, 1e-6, 1e6, 0x1p60}) {
      const TetMesh other = scaled(mesh, factor);
      const Certificate certificate = certificate_of(other, Constraints::regular);
      EXPECT_EQ(check_certificate(other, certificate), CertificateCheck::proves) << turn << " " << factor;
      EXPECT_GE(certificate.terms.size(), 3U);
    }
  }
}

TEST_F(TetCertificate, ProvesNothingWhenAMultiplierIsChanged) {
  const TetMesh mesh = pinwheel_cone();
  const Certificate certificate = certificate_of(mesh, Constraints::regular);
  for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
    Certificate corrupted = certificate;
    for (const double factor : {0.0, 0.5, 2.0, 100.0}) {
      corrupted.terms[i].multiplier = factor * certificate.terms[i].multiplier;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::proves_nothing) << i << " times " << factor;
    }
    corrupted.terms[i].multiplier = -certificate.terms[i].multiplier;
    EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::bad_multiplier);
  }
}

TEST_F(TetCertificate, OfConstraintsThatTheMeshDoesNotHaveIsRefused) {
  const TetMesh mesh = pinwheel_cone();
  const Certificate certificate = certificate_of(mesh, Constraints::regular);
  const auto [kind, p, q, r, s, t] = certificate.terms.front().constraint;
  for (const WeightConstraint& c : std::initializer_list<WeightConstraint>{{kind, q, p, r, s, t},
                                                                           {kind, p, q, r, t, s},
                                                                           {kind, p, q, r, s, s},
                                                                           {kind, p, q, r, s},
                                                                           {kind, p, p, r, s, t},
                                                                           {kind, VertexId(99), q, r, s, t},
                                                                           {Kind::height_over_face, p, q, r, s},
                                                                           {Kind::dual, p, q, r, s}}) {
    Certificate corrupted = certificate;
    corrupted.terms.front().constraint = c;
    EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::not_of_this_mesh);
  }
  Certificate of_triangles = certificate;
  of_triangles.constraints = Constraints::heights_only;
  EXPECT_EQ(check_certificate(mesh, of_triangles), CertificateCheck::not_of_this_mesh);
}

// The law that matters: where weights exist, nothing proves that there are none.
TEST_F(TetCertificate, NeverProvesAnythingOfAMeshThatHasWeights) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(2), 0.02, 0.01));
  Rng rng(1);
  for (const ConstraintsInfo& row : constraints_table()) {
    ASSERT_TRUE(keeps(mesh, row.constraints));
    const TetDemand demand(mesh, row.constraints);
    const std::vector<WeightConstraint> all = demand.constraints_of(all_cells(demand), false);
    for (int i = 0; i < 100; ++i) {
      Certificate certificate;
      certificate.constraints = row.constraints;
      for (std::uint32_t n = 1 + rng.below(8); n > 0; --n) {
        certificate.terms.push_back({all[rng.below(static_cast<std::uint32_t>(all.size()))],
                                     std::ldexp(rng.uniform(0.5, 1), -static_cast<int>(rng.below(60)))});
      }
      EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves_nothing);
    }
  }
}

TEST_F(TetCertificate, RefutesMarginsAboveTheBestOneAndNoneBelow) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(2), 0.05, 0, 3));
  for (const Constraints constraints : {Constraints::well_centered, Constraints::completely_well_centered}) {
    const double best = weights_of(mesh, {.goal = WeightGoal::margin, .constraints = constraints}).margin;
    ASSERT_GT(best, 0);
    Certificate certificate = weights_of(mesh, {.margin = best + 0.01, .constraints = constraints}).certificate;
    ASSERT_FALSE(certificate.terms.empty());
    EXPECT_EQ(certificate.margin, best + 0.01);
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
    certificate.margin = best - 1e-6;
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves_nothing);
  }
}

}  // namespace
}  // namespace temper::tets
