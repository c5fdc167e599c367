// Crossing intervals: the closed formulae against sampled orthocenters, and against the linear program.

#include "explain/conflict.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/lp.hpp"
#include "unit/explain/fans.hpp"

namespace temper::test {
namespace {

/// A counter-clockwise triangle with angles of at least some degrees.
std::array<Vec2, 3> random_triangle(Noise& noise) {
  for (;;) {
    std::array<Vec2, 3> p;
    for (Vec2& v : p) v = {noise(), noise()};
    if (doubled_area(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
    bool good = true;
    for (int k = 0; k < 3; ++k) good = good && corner_angle(p[k], p[(k + 1) % 3], p[(k + 2) % 3]) > 8 * kRadians;
    if (good) return p;
  }
}

/// Weights with this orthocenter: its power is zero to all three.
WeightedPoint weighted(Vec2 p, Vec2 o) { return {p.x, p.y, squared_length(o - p)}; }

TEST(CrossingInterval, HoldsEveryWellCenteredCrossingAndNoLess) {
  Noise noise(3);
  std::size_t obtuse = 0;
  for (int i = 0; i < 60; ++i) {
    const auto [p, q, r] = random_triangle(noise);
    const double c = length(q - p);
    const Interval interval = crossing_interval(p, q, r);
    obtuse += interval.from > 0 || interval.to < c;
    EXPECT_GE(interval.from, 0);
    EXPECT_LE(interval.to, c);
    double least = c, most = 0;
    // Barycentric samples, dense towards the sides, where the ends of the interval are attained.
    for (int j = 0; j < 4000; ++j) {
      const double u = std::pow(std::abs(noise()), 2), v = std::pow(std::abs(noise()), 2),
                   w = std::pow(std::abs(noise()), 2);
      const Vec2 o = (u / (u + v + w)) * p + (v / (u + v + w)) * q + (w / (u + v + w)) * r;
      if (!is_well_centered(weighted(p, o), weighted(q, o), weighted(r, o))) continue;
      const double d = dual_crossing(weighted(p, o), weighted(q, o));
      least = std::min(least, d);
      most = std::max(most, d);
    }
    EXPECT_GE(least, interval.from - 1e-12 * c);
    EXPECT_LE(most, interval.to + 1e-12 * c);
    EXPECT_NEAR(least, interval.from, 0.15 * c);
    EXPECT_NEAR(most, interval.to, 0.15 * c);
  }
  EXPECT_GT(obtuse, 20u);
}

TEST(CrossingInterval, ReversesWithItsEdge) {
  Noise noise(4);
  for (int i = 0; i < 100; ++i) {
    const auto [p, q, r] = random_triangle(noise);
    const double c = length(q - p);
    const Interval there = crossing_interval(p, q, r);
    // Mirrored, so that q p r is counter-clockwise.
    const Interval back = crossing_interval({-q.x, q.y}, {-p.x, p.y}, {-r.x, r.y});
    EXPECT_NEAR(there.from, c - back.to, 1e-12);
    EXPECT_NEAR(there.to, c - back.from, 1e-12);
  }
}

TEST(CrossingInterval, OfTwoTrianglesDecidesWhetherWeightsExist) {
  const auto solver = clp_solver();
  std::size_t feasible = 0, infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const Mesh mesh = random_fan(seed, 2);  // triangles 0 1 2 and 0 2 3 share 0-2
    const Vec2 a = mesh.position(VertexId(0)), b = mesh.position(VertexId(1)), c = mesh.position(VertexId(2)),
               d = mesh.position(VertexId(3));
    const double l = length(c - a);
    const Interval left = crossing_interval(a, c, d);
    const Interval right = crossing_interval(c, a, b);  // from c
    const double overlap = std::min(left.to, l - right.from) - std::max(left.from, l - right.to);
    if (std::abs(overlap) < 1e-6 * l) continue;
    const BestMargin best = best_margin(mesh, *solver);
    EXPECT_EQ(overlap > 0, best.margin > 0) << seed;
    EXPECT_EQ(overlap < 0, !best.certificate.terms.empty()) << seed;
    const auto conflict = crossing_conflict(mesh, all_triangles(mesh));
    ASSERT_EQ(conflict.has_value(), overlap < 0) << seed;
    (overlap > 0 ? feasible : infeasible) += 1;
    if (!conflict) continue;
    const double gap = std::max(conflict->right.from - conflict->left.to, conflict->left.from - conflict->right.to);
    EXPECT_NEAR(gap, -overlap, 1e-12);
  }
  EXPECT_GT(feasible, 50u);
  EXPECT_GT(infeasible, 20u);
}

TEST(CrossingConflict, OfAFanIsThereJustWhenTheProgramFindsOne) {
  const auto solver = clp_solver();
  std::size_t feasible = 0, large = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const Mesh mesh = random_fan(seed, 3 + static_cast<int>(seed % 3));
    const TriangleDemand demand(mesh, Constraints::well_centered);
    const auto found = find_conflict({mesh, demand}, all_triangles(mesh), TriangleId(), *solver);
    if (!found) {
      EXPECT_FALSE(crossing_conflict(mesh, all_triangles(mesh))) << seed;
      ++feasible;
      continue;
    }
    const auto crossing = crossing_conflict(mesh, found->triangles);
    ASSERT_TRUE(crossing) << seed;
    EXPECT_EQ(crossing->left.triangles.size() + crossing->right.triangles.size(), found->triangles.size());
    large += found->triangles.size() > 2;
  }
  EXPECT_GT(feasible, 20u);
  EXPECT_GT(large, 5u);
}

/// At a corner, from one spoke to the next, the crossing shrinks at most by the cosine of the angle between them:
/// d_i > d_{i-1} cos θ_i. So when the first must be beyond `from`, and the last within `to`, from · Π cos θ ≥ to proves
/// it.
TEST(CosineChain, ProvesOnlyWhatTheProgramFindsInfeasible) {
  const auto solver = clp_solver();
  std::size_t proved = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const int n = 3 + static_cast<int>(seed % 2);
    Noise noise(seed);
    std::vector<double> lengths, angles;
    for (int i = 0; i <= n; ++i) lengths.push_back(std::exp(noise()));
    for (int i = 0; i < n; ++i) angles.push_back(i == 0 || i + 1 == n ? 60 + 50 * noise() : 20 + 15 * noise());
    const Mesh mesh = fan(lengths, angles);
    const auto at = [&](int i) { return mesh.position(VertexId(static_cast<std::size_t>(i))); };
    double product = 1;
    for (int i = 1; i + 1 < n; ++i) product *= std::cos(angles[static_cast<std::size_t>(i)] * kRadians);
    // The first triangle on the second spoke, on its right; the last triangle on the last spoke but one.
    const double from = length(at(2)) - crossing_interval(at(2), at(0), at(1)).to;
    const double to = crossing_interval(at(0), at(n), at(n + 1)).to;
    if (from * product < to * (1 + 1e-9)) continue;
    ++proved;
    EXPECT_FALSE(best_margin(mesh, *solver).certificate.terms.empty()) << seed;
  }
  EXPECT_GT(proved, 5u);
}

TEST(OneTriangle, AlwaysHasWeights) {
  const auto solver = clp_solver();
  Noise noise(5);
  for (int i = 0; i < 50; ++i) {
    const auto [p, q, r] = random_triangle(noise);
    EXPECT_GT(best_margin(one_triangle(p, q, r), *solver).margin, 0);
  }
}

}  // namespace
}  // namespace temper::test
