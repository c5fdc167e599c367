// Laws of the exact predicates. All of them hold without any tolerance, ties included.
//
// Where a sign is needed it comes from the construction: weights w_i = |x_i − o|² on a lattice put the orthocenter
// of every triangle at o, exactly, so heights and crossings are orientations and dot products with o.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/predicates_inline.hpp"
#include "temper/detail/geometry.hpp"
#include "unit/geometry/degenerate_families.hpp"

namespace temper {
namespace {

using testing::degenerate_families;
using testing::Family;
using testing::four;
using testing::integer;
using testing::Quad;
using testing::Random;

constexpr int kPoints = 400;

int to_int(Sign s) { return static_cast<int>(s); }
Sign sign_of(double x) { return x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero; }
Sign operator*(Sign a, Sign b) { return static_cast<Sign>(to_int(a) * to_int(b)); }
Sign orientation(const Quad& q, int i, int j, int k) {
  return orient2d(q[i].position(), q[j].position(), q[k].position());
}

struct Permutation {
  std::array<int, 4> to = {0, 1, 2, 3};
  Sign parity = Sign::positive;
};

std::vector<Permutation> all_permutations() {
  std::vector<Permutation> result;
  Permutation p;
  do {
    int inversions = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) inversions += p.to[i] > p.to[j];
    }
    p.parity = inversions % 2 == 0 ? Sign::positive : Sign::negative;
    result.push_back(p);
  } while (std::next_permutation(p.to.begin(), p.to.end()));
  return result;
}

/// The three predicates with one value for four points, to compare before and after a change that keeps them.
std::array<int, 8> all_signs(const Quad& q) {
  return {to_int(orientation(q, 0, 1, 2)),
          to_int(power_test(q[0], q[1], q[2], q[3])),
          to_int(power_test_perturbed(q[0], q[1], q[2], q[3], {3, 1, 2, 0})),
          to_int(signed_height_sign(q[0], q[1], q[2])),
          to_int(signed_height_sign(q[1], q[2], q[3])),
          to_int(dual_crossing_sign(q[0], q[1])),
          to_int(dual_crossing_sign(q[3], q[2])),
          is_well_centered(q[0], q[1], q[2])};
}

Quad small_lattice(Random& random) {
  return four(random, [](Random& r) -> WeightedPoint {
    return {1.0 * integer(r, 6), 1.0 * integer(r, 6), 1.0 * integer(r, 9)};
  });
}

/// Lattice points with weights that place the orthocenter of any three of them at o.
Quad around(Random& random, Vec2 o) {
  return four(random, [&](Random& r) -> WeightedPoint {
    const Vec2 x = {1.0 * integer(r, 8), 1.0 * integer(r, 8)};
    return {x.x, x.y, squared_length(x - o)};
  });
}

Vec2 half_lattice(Random& random) { return {0.5 * integer(random, 16), 0.5 * integer(random, 16)}; }

/// check(quad) on quadruples of every family.
template <class Check>
void on_every_family(int rounds, Check check) {
  ASSERT_GE(degenerate_families().size(), 16u);
  for (const Family& family : degenerate_families()) {
    SCOPED_TRACE(family.name);
    Random random(1);
    for (int round = 0; round < rounds; ++round) check(family.draw(random));
  }
}

TEST(DegenerateFamilies, OrientationIsCyclicAndAntisymmetric) {
  on_every_family(kPoints, [&](const Quad& q) {
    const Sign s = orientation(q, 0, 1, 2);
    EXPECT_EQ(orientation(q, 1, 2, 0), s);
    EXPECT_EQ(orientation(q, 2, 0, 1), s);
    EXPECT_EQ(orientation(q, 1, 0, 2), -s);
    EXPECT_EQ(orientation(q, 0, 0, 1), Sign::zero);
  });
}

TEST(DegenerateFamilies, PowerTestIsAlternatingInItsFourPoints) {
  const auto permutations = all_permutations();
  ASSERT_EQ(permutations.size(), 24u);
  on_every_family(kPoints / 4, [&](const Quad& q) {
    const Sign s = power_test(q[0], q[1], q[2], q[3]);
    for (const auto& [to, parity] : permutations) {
      EXPECT_EQ(power_test(q[to[0]], q[to[1]], q[to[2]], q[to[3]]), parity * s);
    }
  });
}

TEST(DegenerateFamilies, PerturbedPowerTestIsAlternatingAndZeroOnlyOnALine) {
  on_every_family(kPoints / 4, [&](const Quad& q) {
    const std::array<std::uint32_t, 4> index = {7, 3, 11, 5};
    const Sign s = power_test_perturbed(q[0], q[1], q[2], q[3], index);
    const Sign unperturbed = power_test(q[0], q[1], q[2], q[3]);
    if (unperturbed != Sign::zero) {
      EXPECT_EQ(s, unperturbed);
    }
    const bool on_a_line = orientation(q, 0, 1, 2) == Sign::zero && orientation(q, 0, 1, 3) == Sign::zero &&
                           orientation(q, 0, 2, 3) == Sign::zero && orientation(q, 1, 2, 3) == Sign::zero;
    EXPECT_EQ(s == Sign::zero, on_a_line);
    for (const auto& [to, parity] : all_permutations()) {
      EXPECT_EQ(power_test_perturbed(q[to[0]], q[to[1]], q[to[2]], q[to[3]],
                                     {index[to[0]], index[to[1]], index[to[2]], index[to[3]]}),
                parity * s);
    }
  });
}

TEST(DegenerateFamilies, HeightOfTheReversedEdgeIsOpposite) {
  on_every_family(kPoints, [&](const Quad& q) {
    EXPECT_EQ(signed_height_sign(q[1], q[0], q[2]), -signed_height_sign(q[0], q[1], q[2]));
  });
}

TEST(DegenerateFamilies, AtLeastOneEndOfAnEdgeIsOnItsOwnSide) {
  on_every_family(kPoints, [&](const Quad& q) {
    if (q[0].position() == q[1].position()) {
      EXPECT_EQ(dual_crossing_sign(q[0], q[1]), -dual_crossing_sign(q[1], q[0]));  // d ℓ = ±(w_p − w_q)/2
    } else {
      EXPECT_GT(std::max(to_int(dual_crossing_sign(q[0], q[1])), to_int(dual_crossing_sign(q[1], q[0]))), 0);
    }
  });
}

TEST(DegenerateFamilies, WellCenteredMeansCounterClockwiseAllHeightsPositiveAndAllEdgesCrossed) {
  on_every_family(kPoints, [&](const Quad& q) {
    bool expected = orientation(q, 0, 1, 2) == Sign::positive;
    for (int i = 0; i < 3; ++i) {
      const WeightedPoint &p = q[i], &next = q[(i + 1) % 3], &apex = q[(i + 2) % 3];
      expected = expected && signed_height_sign(p, next, apex) == Sign::positive &&
                 dual_crossing_sign(p, next) == Sign::positive && dual_crossing_sign(next, p) == Sign::positive;
    }
    EXPECT_EQ(is_well_centered(q[0], q[1], q[2]), expected);
    EXPECT_EQ(is_well_centered(q[1], q[2], q[0]), expected);
  });
}

TEST(DegenerateFamilies, TheFilterAgreesWithTheExactStage) {
  on_every_family(kPoints, [&](const Quad& q) {
    const auto& [a, b, c, d] = q;
    EXPECT_EQ(inlined::orient2d(a.position(), b.position(), c.position()),
              exact::orient2d(a.position(), b.position(), c.position()));
    EXPECT_EQ(inlined::power_test(a, b, c, d), exact::power_test(a, b, c, d));
    EXPECT_EQ(inlined::height_numerator_sign(a, b, c), exact::height_numerator_sign(a, b, c));
    EXPECT_EQ(inlined::dual_crossing_sign(a, b), exact::dual_crossing_sign(a, b));
  });
}

TEST(DegenerateFamilies, ScalingByAPowerOfTwoChangesNoSign) {
  // Within the range of exact coordinates even from the tiny and the huge family.
  for (const double s : {0x1p-3, 0x1p3}) {
    on_every_family(kPoints / 2, [&](const Quad& q) {
      Quad scaled = q;
      for (auto& p : scaled) p = {s * p.x, s * p.y, s * s * p.w};
      EXPECT_EQ(all_signs(scaled), all_signs(q));
    });
  }
}

TEST(DegenerateFamilies, EveryInputIsInTheExactRange) {
  on_every_family(kPoints, [&](const Quad& q) {
    for (const auto& p : q) {
      EXPECT_TRUE(is_exact_coordinate(p.x) && is_exact_coordinate(p.y) && is_exact_weight(p.w));
    }
  });
}

TEST(Predicates, TranslationByARepresentableOffsetChangesNoSign) {
  Random random(11);
  for (const double offset : {1.0, 1e6, 1e9, 1e15}) {  // lattice points stay lattice points
    for (int round = 0; round < kPoints; ++round) {
      const Quad q = small_lattice(random);
      Quad moved = q;
      for (auto& p : moved) p = {p.x + offset, p.y - 2 * offset, p.w};
      EXPECT_EQ(all_signs(moved), all_signs(q));
    }
  }
}

TEST(Predicates, AddingAConstantToAllWeightsChangesNoSign) {
  Random random(12);
  for (const double constant : {1.0, -1e6, 1e15}) {
    for (int round = 0; round < kPoints; ++round) {
      const Quad q = small_lattice(random);
      Quad shifted = q;
      for (auto& p : shifted) p.w += constant;
      EXPECT_EQ(all_signs(shifted), all_signs(q));
    }
  }
}

TEST(Predicates, AddingALinearFunctionToAllWeightsKeepsThePowerTest) {
  Random random(13);
  for (int round = 0; round < kPoints; ++round) {
    const Quad q = small_lattice(random);
    Quad sheared = q;
    const int a = integer(random, 1 << 20), b = integer(random, 1 << 20);
    for (auto& p : sheared) p.w += a * p.x + b * p.y;
    EXPECT_EQ(power_test(sheared[0], sheared[1], sheared[2], sheared[3]), power_test(q[0], q[1], q[2], q[3]));
  }
}

TEST(Predicates, HeightsAndCrossingsFollowAnOrthocenterPlacedAnywhere) {
  Random random(14);
  std::array<int, 3> seen = {};
  for (int round = 0; round < 50 * kPoints; ++round) {
    const Vec2 o = half_lattice(random);
    const auto [p, q, r, s] = around(random, o);
    if (orient2d(p.position(), q.position(), r.position()) == Sign::zero) continue;
    const Sign side = orient2d(p.position(), q.position(), o);
    ++seen[to_int(side) + 1];
    EXPECT_EQ(signed_height_sign(p, q, r), side);
    EXPECT_EQ(dual_crossing_sign(p, q), sign_of(dot(o - p.position(), q.position() - p.position())));
  }
  EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 100);
}

TEST(Predicates, PowerTestFollowsTheWeightOfTheFourthPoint) {
  Random random(15);
  for (int round = 0; round < 10 * kPoints; ++round) {
    Quad q = around(random, half_lattice(random));
    const Sign orientation_abc = orientation(q, 0, 1, 2);
    EXPECT_EQ(power_test(q[0], q[1], q[2], q[3]), Sign::zero);
    const double tie = q[3].w;
    q[3].w = std::nextafter(tie, INFINITY);  // power of d below theirs: conflict
    EXPECT_EQ(power_test(q[0], q[1], q[2], q[3]), orientation_abc);
    q[3].w = std::nextafter(tie, -INFINITY);
    EXPECT_EQ(power_test(q[0], q[1], q[2], q[3]), -orientation_abc);
  }
}

TEST(Predicates, WithoutWeightsWellCenteredMeansAcute) {
  Random random(16);
  int acute = 0;
  for (int round = 0; round < 10 * kPoints; ++round) {
    Quad q = small_lattice(random);
    for (auto& p : q) p.w = 0;
    bool expected = orientation(q, 0, 1, 2) == Sign::positive;
    for (int i = 0; i < 3; ++i) {
      const Vec2 p = q[i].position();
      expected = expected && dot(q[(i + 1) % 3].position() - p, q[(i + 2) % 3].position() - p) > 0;
    }
    acute += expected;
    EXPECT_EQ(is_well_centered(q[0], q[1], q[2]), expected);
  }
  EXPECT_GT(acute, 100);
}

TEST(Predicates, PerturbedPowerTestIsThatOfWeightsWithShrinkingPowers) {
  Random random(17);
  int ties = 0;
  for (int round = 0; round < 10 * kPoints; ++round) {
    Quad q = small_lattice(random);
    for (auto& p : q) p.w = 0;
    ties += power_test(q[0], q[1], q[2], q[3]) == Sign::zero;
    std::array<std::uint32_t, 4> index = {0, 1, 2, 3};
    std::shuffle(index.begin(), index.end(), random);
    Quad perturbed = q;
    // ε = 2^-100: minors of this lattice are below 2^9, so a smaller power never outweighs a larger one.
    for (int i = 0; i < 4; ++i) perturbed[i].w = std::ldexp(1.0, -100 * (static_cast<int>(index[i]) + 1));
    EXPECT_EQ(power_test_perturbed(q[0], q[1], q[2], q[3], index),
              power_test(perturbed[0], perturbed[1], perturbed[2], perturbed[3]));
  }
  EXPECT_GT(ties, 100);
}

TEST(Predicates, AnEdgeIsNotRegularWhenItsDualLengthIsNegative) {
  Random random(18);
  int conflicts = 0;
  for (int round = 0; round < 10 * kPoints; ++round) {
    const auto [p, q, r, s] = testing::nearly_power_cocircular(random, 0);
    WeightedPoint across = s;
    across.w += 0.1 * testing::real(random);
    const auto turn = [](const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) {
      return orient2d(a.position(), b.position(), c.position());
    };
    if (turn(p, q, r) != Sign::positive || turn(q, p, across) != Sign::positive) continue;
    const double dual = signed_height(p, q, r) + signed_height(q, p, across);
    if (std::abs(dual) < 1e-6) continue;  // far above the rounding of two heights of size about 1
    ++conflicts;
    EXPECT_EQ(power_test(p, q, r, across), -sign_of(dual));
  }
  EXPECT_GT(conflicts, 100);
}

TEST(Predicates, NotANumberGivesNoSign) {
  const WeightedPoint a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0}, d = {NAN, 1, 0};
  EXPECT_EQ(power_test(a, b, c, d), Sign::zero);
  EXPECT_EQ(orient2d(a.position(), b.position(), d.position()), Sign::zero);
  EXPECT_FALSE(is_well_centered(a, b, d));
  EXPECT_FALSE(is_exact_coordinate(NAN));
  EXPECT_FALSE(is_exact_coordinate(INFINITY));
}

}  // namespace
}  // namespace temper
