// The sign of each coefficient of tetrahedra against rational arithmetic.
//
// The oracle shares no formula with the library: it solves for the orthocenters of tetrahedra and faces, and takes the
// area of the dual polygon by cross products.
#include "temper/tets/criterion.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

#include "oracle/rational.hpp"
#include "support/tet_lattice.hpp"
#include "temper/tets/quality.hpp"
#include "tets/quality/coefficients.hpp"
#include "unit/geometry/degenerate_families.hpp"

namespace temper::tets {
namespace {

using testing::Random;
using testing::Rational;
using Triple = std::array<Rational, 3>;

Triple place(const WeightedPoint& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
Triple minus(const Triple& a, const Triple& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Triple plus(const Triple& a, const Rational& s, const Triple& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
Rational inner(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Triple outer(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// |q − p|² − w_q + w_p, halved.
Rational half_lift(const WeightedPoint& p, const WeightedPoint& q) {
  const Triple d = minus(place(q), place(p));
  return (inner(d, d) - Rational(q.w) + Rational(p.w)) / 2;
}
/// From p, by the dual basis of u, v and a third vector.
Triple solved(const WeightedPoint& p, const std::array<Triple, 3>& basis, const Triple& right) {
  const Rational volume = inner(basis[0], outer(basis[1], basis[2]));
  Triple o = place(p);
  for (std::size_t i = 0; i < 3; ++i) o = plus(o, right[i] / volume, outer(basis[(i + 1) % 3], basis[(i + 2) % 3]));
  return o;
}
Triple center(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  return solved(p, {minus(place(q), place(p)), minus(place(r), place(p)), minus(place(s), place(p))},
                {half_lift(p, q), half_lift(p, r), half_lift(p, s)});
}
Triple center(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Triple u = minus(place(q), place(p)), v = minus(place(r), place(p));
  return solved(p, {u, v, outer(u, v)}, {half_lift(p, q), half_lift(p, r), 0});
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;
struct Oracle {
  std::map<Edge, Rational> whole;                            // 2 ℓ · area of the dual
  std::map<std::pair<Edge, std::int32_t>, Rational> region;  // of edges with cells of several regions
};

Oracle duals_of(const TetMesh& mesh) {
  Oracle oracle;
  std::map<Edge, std::set<std::int32_t>> regions;
  for (const TetId t : mesh.tetrahedra()) {
    const auto p = mesh.points(t);
    for (const auto& [a, b, c, d] : kEdgeCorners) {
      const WeightedPoint &i = p[std::size_t(a)], &j = p[std::size_t(b)], &k = p[std::size_t(c)],
                          &l = p[std::size_t(d)];
      const Triple o = center(i, j, k, l), along = minus(place(j), place(i));
      const auto area = [&](const Triple& from, const Triple& to) {
        return inner(along, outer(minus(from, place(i)), minus(to, place(i))));
      };
      const Rational value = area(center(i, j, k), o) + area(o, center(i, j, l));
      const Edge edge = std::minmax(mesh.corners(t)[std::size_t(a)].index, mesh.corners(t)[std::size_t(b)].index);
      oracle.whole[edge] += value;
      oracle.region[{edge, mesh.region(t)}] += value;
      regions[edge].insert(mesh.region(t));
    }
  }
  std::erase_if(oracle.region, [&](const auto& part) { return regions[part.first.first].size() == 1; });
  return oracle;
}

struct Seen {
  std::size_t negative = 0, zero = 0, parts = 0;
};

Seen compare(const TetMesh& mesh) {
  const Oracle oracle = duals_of(mesh);
  Seen seen;
  std::size_t whole = 0;
  const Coefficients coefficients(mesh, nullptr);
  coefficients.visit(nullptr, [&](std::size_t, const EdgeCoefficient& c) {
    const Edge edge = {c.vertices[0].index, c.vertices[1].index};
    const bool part = c.kind == DualKind::region;
    const Rational& expected = part ? oracle.region.at({edge, c.region}) : oracle.whole.at(edge);
    EXPECT_EQ(static_cast<int>(c.sign), sgn(expected)) << edge.first << "-" << edge.second << " " << c.over_l;
    EXPECT_EQ(c.over_l > 0, expected > 0);
    EXPECT_EQ(c.over_l < 0, expected < 0);
    // 2 ℓ · area over 2 ℓ³.
    const Triple d = minus(place(mesh.point(c.vertices[0])), place(mesh.point(c.vertices[1])));
    const double l = std::sqrt(inner(d, d).get_d());
    EXPECT_NEAR(c.over_l, expected.get_d() / (2 * l * l * l), 1e-9 * (1 + std::abs(c.over_l)));
    ++(part ? seen.parts : whole), seen.negative += expected < 0, seen.zero += expected == 0;
  });
  EXPECT_EQ(whole, oracle.whole.size());
  EXPECT_EQ(seen.parts, oracle.region.size());
  return seen;
}

TetMesh with_regions(TetMesh mesh, Random& random, std::uint64_t n) {
  for (const TetId t : mesh.tetrahedra()) mesh.set_region(t, static_cast<std::int32_t>(random() % n));
  return mesh;
}

test::TetArrays with_weights(test::TetArrays arrays, Random& random, int largest, double unit) {
  arrays.weights.clear();
  for (std::size_t i = 0; i < arrays.points.size(); ++i)
    arrays.weights.push_back(unit * testing::integer(random, largest));
  return arrays;
}

test::TetArrays moved(test::TetArrays arrays, double scale, Vec3 offset) {
  for (Vec3& p : arrays.points) p = scale * p + offset;
  for (double& w : arrays.weights) w *= scale * scale;
  return arrays;
}

void add(Seen& all, const Seen& more) { all.negative += more.negative, all.zero += more.zero, all.parts += more.parts; }

TEST(CriterionOracle, NoSignIsWrongOnLatticesWithSmallWeights) {
  Random random(5);
  Seen all;
  for (const test::CubeCut* cut : {&test::kSixTets, &test::kFiveTets}) {
    for (int round = 0; round < 12; ++round) {
      const auto arrays = with_weights(test::cubes(2, *cut), random, 1 + round / 3, 0.25);
      const TetMesh mesh = test::mesh_of(arrays);
      add(all, compare(mesh));
      add(all, compare(with_regions(mesh, random, 2)));
      add(all, compare(test::mesh_of(moved(arrays, 0.1, {0.3, 0.7, -0.2}))));
    }
  }
  EXPECT_GT(all.negative, 1000U);
  EXPECT_GT(all.zero, 300U);
  EXPECT_GT(all.parts, 1000U);
}

TEST(CriterionOracle, NoSignIsWrongOnShakenMeshesAtAnyScale) {
  Random random(6);
  Seen all;
  for (const double scale : {1.0, 0x1p-30, 0x1p100, 0x1p-100}) {
    for (std::uint64_t round = 0; round < 4; ++round) {
      const auto arrays = test::shaken(test::cubes(2, test::kSixTets), 0.15, 0.1, round + 1);
      add(all, compare(with_regions(test::mesh_of(moved(arrays, scale, {})), random, 3)));
    }
  }
  EXPECT_GT(all.negative, 100U);
}

// The weight of one vertex is chosen so that a coefficient is nearly zero: it changes its sign among these doubles.
TEST(CriterionOracle, NoSignIsWrongNearZero) {
  Random random(7);
  std::size_t tried = 0;
  for (int round = 0; round < 60; ++round) {
    TetMesh mesh = test::mesh_of(test::shaken(test::cubes(1, test::kSixTets), 0.1, 0.1, random() % 1000));
    const auto values = [&](double w) {
      mesh.set_weight(VertexId(0), w);
      std::vector<double> found;
      const Coefficients coefficients(mesh, nullptr);
      coefficients.visit(nullptr, [&](std::size_t, const EdgeCoefficient& c) { found.push_back(c.over_l); });
      return found;
    };
    const auto at_0 = values(0), at_1 = values(1);
    const std::size_t i = random() % at_0.size();
    if (at_0[i] == at_1[i]) continue;
    double w = at_0[i] / (at_0[i] - at_1[i]);  // coefficients are not linear in all weights: improved by the secant
    for (int step = 0; step < 8; ++step) {
      const double here = values(w)[i], near = values(w + 1e-4)[i];
      if (here == near) break;
      w += 1e-4 * here / (here - near);
    }
    for (int ulps = -3; ulps <= 3; ++ulps) {
      mesh.set_weight(VertexId(0), w + ulps * (std::nextafter(w, 1e9) - w));
      compare(mesh);
      ++tried;
    }
  }
  EXPECT_GT(tried, 100U);
}

}  // namespace
}  // namespace temper::tets
