// The exact checker: it accepts what proves, and nothing else.
#include <algorithm>

#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

Certificate certificate_of(const Mesh& mesh) { return margin_of(mesh).certificate; }

TEST(Certificate, OfTheHorseshoesProves) {
  for (const Mesh& mesh : {sparse_horseshoe(), *horseshoe()}) {
    const Certificate certificate = certificate_of(mesh);
    EXPECT_GE(certificate.terms.size(), 2u);
    EXPECT_LE(certificate.terms.size(), 20u);  // few constraints, whatever the size of the mesh
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
  }
}

TEST(Certificate, SurvivesScaling) {
  const Mesh mesh = *horseshoe();
  for (const double factor : {1e-6, 1e6, 0x1p-60, 0x1p60}) {
    const Mesh other = scaled(mesh, factor);
    EXPECT_EQ(check_certificate(other, certificate_of(other)), CertificateCheck::proves) << factor;
  }
  // By a power of two everything is exact: the certificate itself can be carried over, degree by degree.
  Certificate carried = certificate_of(mesh);
  for (auto& term : carried.terms) {
    term.multiplier *= term.constraint.kind == WeightConstraint::Kind::height ? 0x1p-40 : 0x1p-20;
  }
  EXPECT_EQ(check_certificate(scaled(mesh, 0x1p10), carried), CertificateCheck::proves);
}

TEST(Certificate, DoesNotDependOnTheWeightsOfTheMesh) {
  Mesh mesh = sparse_horseshoe();
  const Certificate certificate = certificate_of(mesh);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 1e3 * v.index);
  EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
}

TEST(Certificate, ProvesNothingWhenAnyMultiplierIsChanged) {
  std::size_t changed = 0;
  for (const Mesh& mesh : {sparse_horseshoe(), *horseshoe()}) {
    const Certificate certificate = certificate_of(mesh);
    for (std::size_t i = 0; i < certificate.terms.size(); ++i, ++changed) {
      Certificate corrupted = certificate;
      corrupted.terms[i].multiplier *= 100;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::proves_nothing) << i;
      for (const double bad : {-certificate.terms[i].multiplier, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
        corrupted.terms[i].multiplier = bad;
        EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::bad_multiplier);
      }
    }
  }
  EXPECT_GE(changed, 10u);
}

// Crossings bound what is left of the weights whether they are terms or not, so that those that are can be spared.
TEST(Certificate, OfTheSparseHorseshoeNeedsEachOfItsHeights) {
  const Mesh mesh = sparse_horseshoe();
  const Certificate certificate = certificate_of(mesh);
  std::size_t heights = 0;
  for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
    if (certificate.terms[i].constraint.kind == WeightConstraint::Kind::crossing) continue;
    ++heights;
    for (const double factor : {0.0, 0.5, 2.0}) {
      Certificate corrupted = certificate;
      corrupted.terms[i].multiplier *= factor;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::proves_nothing) << i << " times " << factor;
    }
  }
  EXPECT_GE(heights, 2u);
}

TEST(Certificate, OfConstraintsThatTheMeshDoesNotHaveIsRefused) {
  const Mesh mesh = sparse_horseshoe();
  const Certificate certificate = certificate_of(mesh);
  ASSERT_FALSE(certificate.terms.empty());
  for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
    WeightConstraint c = certificate.terms[i].constraint;
    std::vector<WeightConstraint> wrong = {{c.kind, VertexId(std::size_t{99}), c.q, c.r}, {c.kind, c.p, c.p, c.r}};
    if (c.kind == WeightConstraint::Kind::height) {
      wrong.push_back({c.kind, c.q, c.p, c.r});  // clockwise
      wrong.push_back({c.kind, c.p, c.q, VertexId()});
    }
    for (const WeightConstraint& constraint : wrong) {
      Certificate corrupted = certificate;
      corrupted.terms[i].constraint = constraint;
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::not_of_this_mesh);
    }
  }
}

TEST(Certificate, WithoutTermsOrWithAnImpossibleMarginIsRefused) {
  const Mesh mesh = sparse_horseshoe();
  EXPECT_EQ(check_certificate(mesh, {}), CertificateCheck::bad_multiplier);
  Certificate certificate = certificate_of(mesh);
  for (const double margin : {-0.1, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    certificate.margin = margin;
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::bad_multiplier);
  }
}

TEST(Certificate, RefutesMarginsAboveTheBestOneAndNoneBelow) {
  const Mesh mesh = jittered_lattice(4);
  const double best = margin_of(mesh).margin;
  const WeightReport report = weights_of(mesh, {.margin = best + 0.01});
  ASSERT_FALSE(report.certificate.terms.empty());
  EXPECT_EQ(report.certificate.margin, best > 0 ? best + 0.01 : 0);
  Certificate certificate = report.certificate;
  EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
  certificate.margin = best + 0.02;
  EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves);
  certificate.margin = std::max(best - 1e-6, 0.0);
  if (best > 0) {
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves_nothing);
  }
}

TEST(Certificate, RefutesMarginsOfCrossingsToo) {
  std::size_t with_crossings = 0;
  for (const double height : {0.05, 0.1, 0.2, 0.4, 0.8}) {  // of an obtuse triangle over its longest side
    const Mesh mesh = build_or_die({{-1, 0}, {1, 0}, {0.25, height}}, {{0, 1, 2}});
    const double best = margin_of(mesh).margin;
    ASSERT_GT(best, 0);
    Certificate certificate = weights_of(mesh, {.margin = best + 0.01}).certificate;
    with_crossings += std::any_of(certificate.terms.begin(), certificate.terms.end(), [](const auto& term) {
      return term.constraint.kind == WeightConstraint::Kind::crossing && term.multiplier > 0;
    });
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves) << height;
    certificate.margin = best - 1e-6;
    EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves_nothing) << height;
  }
  EXPECT_GT(with_crossings, 0u);
}

// The law that matters: where there are good weights, nothing proves that there are none.
TEST(Certificate, NeverProvesAnythingOfAMeshThatHasGoodWeights) {
  std::size_t tried = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Mesh mesh = lattice({.n = 4, .jitter = 0.1, .seed = seed});
    if (bad_triangles(mesh) > 0) continue;
    Rng rng(seed);
    std::vector<WeightConstraint> constraints;
    for (const HalfedgeId h : mesh.halfedges()) {
      const VertexId p = mesh.origin(h), q = mesh.target(h);
      constraints.push_back({WeightConstraint::Kind::height, p, q, mesh.opposite(h)});
      constraints.push_back({WeightConstraint::Kind::crossing, p, q, VertexId()});
      constraints.push_back({WeightConstraint::Kind::crossing, q, p, VertexId()});
    }
    for (int i = 0; i < 100; ++i, ++tried) {
      Certificate certificate;
      for (std::uint32_t n = 1 + rng.below(8); n > 0; --n) {
        const auto& constraint = constraints[rng.below(static_cast<std::uint32_t>(constraints.size()))];
        certificate.terms.push_back({constraint, std::ldexp(rng.uniform(0.5, 1), -static_cast<int>(rng.below(60)))});
      }
      EXPECT_EQ(check_certificate(mesh, certificate), CertificateCheck::proves_nothing);
    }
  }
  EXPECT_GT(tried, 500u);
}

TEST(Certificate, OfAnInfeasibleMeshProvesNothingOnceVerticesMoveToWhereWeightsExist) {
  const Mesh straight = lattice({.n = 6, .jitter = 0, .weight = 0});
  std::size_t infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Certificate certificate = certificate_of(lattice({.n = 6, .jitter = 0.3, .weight = 0, .seed = seed}));
    if (certificate.terms.empty()) continue;
    ++infeasible;
    EXPECT_EQ(check_certificate(straight, certificate), CertificateCheck::proves_nothing) << seed;
  }
  EXPECT_GT(infeasible, 0u);
}

}  // namespace
}  // namespace temper::test
