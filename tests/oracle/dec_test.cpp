// ★1, ★2 and the crossing of an edge against rational arithmetic: a small relative error on every input, whatever
// cancels.
//
// The oracle finds both orthocenters by Cramer's rule and measures the dual edge between them; no formula is the
// library's.
#include "temper/dec.hpp"

#include <gtest/gtest.h>

#include "oracle/rational.hpp"
#include "unit/geometry/degenerate_families.hpp"

namespace temper {
namespace {

using testing::expect_relative;
using testing::kRelative;
using testing::Rational;

struct RationalVector {
  Rational x, y;
};

RationalVector rational_center(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const Rational ax = Rational(q.x) - p.x, ay = Rational(q.y) - p.y, bx = Rational(r.x) - p.x, by = Rational(r.y) - p.y;
  const Rational a = (ax * ax + ay * ay + p.w - q.w) / 2, b = (bx * bx + by * by + p.w - r.w) / 2;
  const Rational doubled = ax * by - ay * bx;
  return {(a * by - b * ay) / doubled + p.x, (ax * b - bx * a) / doubled + p.y};
}

/// From one orthocenter to the other across pq, in units of the edge: their difference, turned by 90°, along the edge.
Rational rational_star1(const WeightedPoint& p, const WeightedPoint& q, const RationalVector& left,
                        const RationalVector& right) {
  const Rational x = Rational(q.x) - p.x, y = Rational(q.y) - p.y;
  return ((left.y - right.y) * x - (left.x - right.x) * y) / (x * x + y * y);
}

TEST(DecOracle, EveryStarHasASmallRelativeErrorOnDegenerateFamilies) {
  std::size_t compared = 0, zeros = 0, negative = 0;
  for (const testing::Family& family : testing::degenerate_families()) {
    testing::Random random(1);
    for (int round = 0; round < 400; ++round) {
      const testing::Quad quad = family.draw(random);
      std::vector<Vec2> points;
      std::vector<double> weights;
      for (const WeightedPoint& p : quad) points.push_back(p.position()), weights.push_back(p.w);
      const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {1, 0, 3}};
      const auto built = Mesh::build({.points = points, .weights = weights, .triangles = triangles});
      if (!built) continue;  // flat, or both on one side
      const Mesh& mesh = built->mesh;
      const DecComplex c = dec_operators(mesh);
      const RationalVector a = rational_center(quad[0], quad[1], quad[2]),
                           b = rational_center(quad[0], quad[1], quad[3]);
      const HalfedgeId shared = mesh.find_halfedge(VertexId(0), VertexId(1));
      const bool first_is_left = mesh.opposite(shared) == VertexId(2);
      const EdgeId e = c.edge_of_halfedge[shared];
      const Rational star1 = rational_star1(quad[0], quad[1], first_is_left ? a : b, first_is_left ? b : a);
      SCOPED_TRACE(family.name);
      expect_relative(c.star1[e], star1);
      const Rational x = Rational(quad[1].x) - quad[0].x, y = Rational(quad[1].y) - quad[0].y;
      const Rational share = (1 + (Rational(quad[0].w) - quad[1].w) / (x * x + y * y)) / 2;
      EXPECT_NEAR(c.edges[e].crossing / c.edges[e].length, share.get_d(), kRelative * std::abs(share.get_d()));
      for (const TriangleId t : mesh.triangles()) {
        const auto [i, j, k] = mesh.corners(t);
        const WeightedPoint p = mesh.point(i), q = mesh.point(j), r = mesh.point(k);
        const Rational doubled =
            (Rational(q.x) - p.x) * (Rational(r.y) - p.y) - (Rational(q.y) - p.y) * (Rational(r.x) - p.x);
        expect_relative(c.star2[t], 2 / doubled);
      }
      ++compared;
      zeros += star1 == 0 ? 1 : 0;
      negative += star1 < 0 ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 1000u);
  EXPECT_GT(zeros, 100u);
  EXPECT_GT(negative, 100u);
}

}  // namespace
}  // namespace temper
