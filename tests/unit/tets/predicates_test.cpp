// Laws of the exact predicates of tetrahedra, without any tolerance, ties included. tests/oracle/tets_test.cpp compares
// their signs with rational arithmetic.
#include <gtest/gtest.h>

#include <cmath>

#include "support/tet_lattice.hpp"
#include "temper/tets/geometry.hpp"

namespace temper::tets {
namespace {

const Vec3 kOrigin = {0, 0, 0}, kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};
WeightedPoint at(Vec3 p, double w = 0) { return {p.x, p.y, p.z, w}; }

TEST(TetPredicates, ATetrahedronIsPositiveIfItsFirstThreeCornersTurnCounterClockwiseSeenFromTheFourth) {
  EXPECT_EQ(orientation(kOrigin, kX, kY, kZ), Sign::positive);
  EXPECT_EQ(orientation(kX, kOrigin, kY, kZ), Sign::negative);
  EXPECT_EQ(orientation(kOrigin, kX, kY, {0.3, 0.3, 0}), Sign::zero);
  EXPECT_EQ(orientation(kOrigin, kX, kY, {0.3, 0.3, 1e-30}), Sign::positive);
}

TEST(TetPredicates, APointInsideTheSphereConflictsAndAHeavierOneConflictsSooner) {
  const auto test = [](Vec3 p, double w) { return power_test(at(kOrigin), at(kX), at(kY), at(kZ), at(p, w)); };
  EXPECT_EQ(test({0.5, 0.5, 0.5}, 0), Sign::positive);
  EXPECT_EQ(test({1, 1, 1}, 0), Sign::zero);
  EXPECT_EQ(test({1, 1, 1}, 1e-25), Sign::positive);
  EXPECT_EQ(test({1, 1, 1}, -1e-25), Sign::negative);
}

TEST(TetPredicates, TiesGoToTheLowestIndexAsIfItsWeightWereLarger) {
  // A cube is cospherical. As a heavier point (1, 1, 1) conflicts, and as heavier corners the others resist.
  const std::array<WeightedPoint, 5> points = {at(kOrigin), at(kX), at(kY), at(kZ), at({1, 1, 1})};
  EXPECT_EQ(power_test_perturbed(points, {1, 2, 3, 4, 0}), Sign::positive);
  for (const std::size_t heaviest : {1U, 2U, 3U}) {
    std::array<std::uint32_t, 5> index = {5, 6, 7, 8, 9};
    index[heaviest] = 0;
    EXPECT_EQ(power_test_perturbed(points, index), Sign::negative);
  }
}

TEST(TetPredicates, TheSignOfADualEdgeIsTheSignOfTheSumOfItsHeights) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(3, test::kFiveTets), 0.1, 0.1));
  int compared = 0;
  for (const HalffaceId h : mesh.halffaces()) {
    if (mesh.is_boundary(h)) continue;
    const auto [a, b, c] = mesh.vertices(h);
    const WeightedPoint p = mesh.point(a), q = mesh.point(b), r = mesh.point(c), s = mesh.point(mesh.opposite(h)),
                        t = mesh.point(mesh.opposite(mesh.twin(h)));
    const double dual = signed_height(p, q, r, s) + signed_height(p, r, q, t);
    EXPECT_EQ(power_test(p, q, r, s, t), dual > 0 ? Sign::negative : Sign::positive);
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(TetPredicates, HeightsDoNotDependOnTheOrderOfCornersNorOnAnOffsetOfWeights) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(2), 0.2, 0.2, 4));
  for (const TetId t : mesh.tetrahedra()) {
    const auto [p, q, r, s] = mesh.points(t);
    const Sign sign = signed_height_sign(p, q, r, s);
    EXPECT_EQ(signed_height_sign(q, r, p, s), sign);
    EXPECT_EQ(signed_height_sign(q, p, r, s), sign);
    EXPECT_EQ(signed_height_sign(p, q, r), signed_height_sign(q, p, r));
    // Over a power of two, and under an offset of weights without rounding.
    const auto moved = [](const WeightedPoint& x) {
      return WeightedPoint{0x1p20 * x.x, 0x1p20 * x.y, 0x1p20 * x.z, 0x1p40 * x.w};
    };
    EXPECT_EQ(signed_height_sign(moved(p), moved(q), moved(r), moved(s)), sign);
    EXPECT_EQ(sign == Sign::positive, signed_height(p, q, r, s) > 0);
    EXPECT_EQ(dual_crossing_sign(p, q) == Sign::positive, dual_crossing(p, q) > 0);
    EXPECT_NEAR(dual_crossing(p, q) + dual_crossing(q, p), length(q.position() - p.position()), 1e-14);
  }
}

TEST(TetPredicates, TheOrthocenterHasEqualPowerToAllCornersAndTheHeightsOfItsFaces) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(2), 0.2, 0.2, 7));
  for (const TetId t : mesh.tetrahedra()) {
    const auto points = mesh.points(t);
    const auto& [p, q, r, s] = points;
    const Vec3 o = orthocenter(p, q, r, s);
    const double power = squared_length(o - p.position()) - p.w;
    for (const WeightedPoint& x : points)
      EXPECT_NEAR(squared_length(o - x.position()) - x.w, power, 1e-9 * (1 + std::abs(power)));
    const Vec3 n = cross(q.position() - p.position(), r.position() - p.position());
    EXPECT_NEAR(signed_height(p, q, r, s), dot(o - p.position(), n) / length(n), 1e-9);
  }
}

TEST(TetPredicates, AnglesOfTheBodyCenteredLatticeAreThoseOfSommerville) {
  const TetMesh mesh = test::mesh_of(test::body_centered(2));
  const auto [p, q, r, s] = mesh.points(TetId(0));
  const double right = dihedral_angle(p.position(), q.position(), r.position(), s.position());
  EXPECT_NEAR(right, std::acos(0.0), 1e-15);
  EXPECT_NEAR(dihedral_angle(p.position(), r.position(), q.position(), s.position()), std::acos(0.5), 1e-15);
  const double ball = 4 * std::acos(-1.0);
  double sum = 0;  // the first point is the center of a cube of which only one inner face has tetrahedra
  for (const TetId t : mesh.tetrahedra())
    sum += mesh.corners(t)[0] == VertexId(0) ? solid_angle(p.position(), q.position(), r.position(), s.position()) : 0;
  EXPECT_NEAR(sum, 12 * ball / 24, 1e-12);
}

}  // namespace
}  // namespace temper::tets
