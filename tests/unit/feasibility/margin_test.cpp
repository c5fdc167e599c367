// The best margin: numbers known from elsewhere, and what it must not depend on.
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

// An optimum of a well-scaled program with a hundred rows: the solver's tolerance is 1e-9.
constexpr double kSolvedMargin = 1e-9;

TEST(BestMargin, OfTheEquilateralTriangleIsThatOfZeroWeights) {
  const BestMargin best = margin_of(one_triangle({0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}));
  EXPECT_NEAR(best.margin, std::sqrt(0.75) / 3, kSolvedMargin);
  EXPECT_TRUE(best.certificate.terms.empty());
}

// The incenter can be the orthocenter: the squared tangent lengths are weights with which every foot is on its edge.
TEST(BestMargin, OfOneTriangleIsPositiveWhateverItsAngles) {
  Rng rng(1);
  std::size_t tried = 0;
  for (int i = 0; i < 200; ++i) {
    const auto point = [&] { return Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)}; };
    const Vec2 p = point(), q = point(), r = point();
    if (orient2d(p, q, r) == Sign::zero) continue;
    const BestMargin best = margin_of(one_triangle(p, q, r));
    EXPECT_GT(best.margin, 0);
    EXPECT_TRUE(best.certificate.terms.empty());
    ++tried;
  }
  EXPECT_GT(tried, 190u);
}

TEST(BestMargin, OfTheSparseHorseshoeIsMinusEightOver135) {
  EXPECT_NEAR(margin_of(sparse_horseshoe()).margin, -8.0 / 135, kSolvedMargin);
  EXPECT_NEAR(margin_of(sparse_horseshoe(), Constraints::heights_only).margin, 0.05, kSolvedMargin);
}

TEST(BestMargin, OfTheDenseHorseshoeIsWhatAnIndependentProgramFound) {
  const Mesh mesh = *horseshoe();
  EXPECT_NEAR(margin_of(mesh).margin, -0.3199381998, kSolvedMargin);
  EXPECT_NEAR(margin_of(mesh, Constraints::heights_only).margin, -0.1046174535, kSolvedMargin);
}

TEST(BestMargin, IsAttainedByItsWeightsAndByNoneBetter) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Mesh mesh = jittered_lattice(seed);
    const BestMargin best = margin_of(mesh);
    ASSERT_EQ(best.status, LpStatus::optimal);
    for (std::size_t i = 0; i < best.vertices.size(); ++i) mesh.set_weight(best.vertices[i], best.weights[i]);
    EXPECT_NEAR(weight_margin(mesh), best.margin, 1e-8) << seed;  // ten tolerances: the sum of a row's terms
    EXPECT_FALSE(best.tight.empty());
    Noise noise(seed);
    for (int i = 0; i < 50; ++i) {
      Mesh other = mesh;
      for (const VertexId v : other.vertices()) other.set_weight(v, other.weight(v) + std::pow(0.7, i) * noise());
      EXPECT_LE(weight_margin(other), best.margin + kSolvedMargin);
    }
  }
}

TEST(BestMargin, DoesNotDependOnSizePlaceOrWeights) {
  const Mesh mesh = *horseshoe();
  const double expected = margin_of(mesh).margin;
  for (const double factor : {1e-6, 1e-3, 1e3, 1e6}) {
    EXPECT_NEAR(margin_of(scaled(mesh, factor)).margin, expected, kSolvedMargin) << factor;
  }
  EXPECT_NEAR(margin_of(scaled(mesh, 1, {100, -1000})).margin, expected, kSolvedMargin);
  Mesh weighted = mesh;
  for (const VertexId v : weighted.vertices()) weighted.set_weight(v, 17.0 * v.index);
  EXPECT_EQ(margin_of(weighted).margin, expected);
}

TEST(BestMargin, OfAGradedMeshIsAttainedWhereItIsFineToo) {
  Mesh mesh = *airfoil({.around = 16, .growth = 1.8});
  double shortest = kUnbounded, longest = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const double l = length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h)));
    shortest = std::min(shortest, l), longest = std::max(longest, l);
  }
  ASSERT_GT(longest / shortest, 30);
  const BestMargin best = margin_of(mesh);
  ASSERT_EQ(best.status, LpStatus::optimal);
  for (std::size_t i = 0; i < best.vertices.size(); ++i) mesh.set_weight(best.vertices[i], best.weights[i]);
  EXPECT_NEAR(weight_margin(mesh), best.margin, 1e-8);
}

TEST(BestMargin, OfPartOfAMeshIsNoSmaller) {
  const Mesh mesh = *horseshoe();
  const double whole = margin_of(mesh).margin;
  const auto solver = clp_solver();
  std::vector<TriangleId> part;
  double last = 0.5;
  for (const TriangleId t : mesh.triangles()) {
    part.push_back(t);
    if (part.size() % 12 != 0) continue;
    const double margin = best_margin(mesh, part, *solver).margin;
    EXPECT_GE(margin, whole - kSolvedMargin);
    EXPECT_LE(margin, last + kSolvedMargin);
    last = margin;
  }
  EXPECT_NEAR(last, whole, kSolvedMargin);
}

TEST(WeightMargin, IsTheLeastHeightAndCrossingOfTheMesh) {
  const Mesh mesh = lattice({.weight = 0.2, .seed = 3});
  double expected = 1;
  for (const HalfedgeId h : mesh.halfedges()) {
    const WeightedPoint p = mesh.point(mesh.origin(h)), q = mesh.point(mesh.target(h)),
                        r = mesh.point(mesh.opposite(h));
    const double l = length(q.position() - p.position());
    expected = std::min({expected, signed_height(p, q, r) / l, dual_crossing(p, q) / l, dual_crossing(q, p) / l});
  }
  EXPECT_NEAR(weight_margin(mesh), expected, 1e-14);
}

}  // namespace
}  // namespace temper::test
