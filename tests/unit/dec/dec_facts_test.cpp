// Operators of meshes whose numbers are known by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/shapes.hpp"
#include "temper/dec.hpp"

namespace temper {
namespace {

using test::mesh_of;
using test::one_triangle;

TEST(DecFacts, AnObtuseTriangleHasItsOrthocenterOutsideAndANegativeStarThere) {
  // Circumcenter (2, −3/2), 3/2 below the long edge 0-1.
  const Mesh mesh = one_triangle({0, 0}, {4, 0}, {2, 1});
  const DecComplex c = dec_operators(mesh);
  ASSERT_EQ(c.edges.size(), 3u);
  EXPECT_EQ(c.star1[EdgeId(0)], -0.375);
  EXPECT_EQ(c.edges[EdgeId(0)].left_height, -1.5);
  EXPECT_FALSE(c.edges[EdgeId(0)].right.valid());
  EXPECT_EQ(c.edges[EdgeId(0)].midpoint, (Vec2{2, 0}));
  // Edges 0-2 and 1-2: the orthocenter is inside of them, at 5/2 · √5/2 … by Pythagoras from the radius 5/2.
  const double h = std::sqrt(2.5 * 2.5 - 1.25);
  EXPECT_NEAR(c.star1[EdgeId(1)], h / std::sqrt(5.0), 1e-15);
  EXPECT_EQ(c.edges[EdgeId(1)].left, TriangleId()) << "0 → 2 runs clockwise";
  EXPECT_EQ(c.edges[EdgeId(1)].right, TriangleId(0));
  EXPECT_EQ(c.edges[EdgeId(2)].left, TriangleId(0));
  EXPECT_EQ(c.orthocenters[TriangleId(0)], (Vec2{2, -1.5}));
  EXPECT_EQ(c.star2[TriangleId(0)], 0.5);
  // Signed: half of each edge times its height, (4 (−3/2) / 4 + √5 h / 4) at the ends of the long edge.
  EXPECT_NEAR(c.star0[VertexId(0)], -1.5 + std::sqrt(5.0) * h / 4, 1e-15);
  EXPECT_NEAR(c.star0[VertexId(2)], std::sqrt(5.0) * h / 2, 1e-15);
  const DecSummary s = summarize(mesh, c);
  EXPECT_EQ(s.negative_boundary_star1, 1u);
  EXPECT_EQ(s.negative_star1, 0u);
  EXPECT_EQ(s.negative_star0, 2u);
  EXPECT_EQ(s.not_well_centered, 1u);
  EXPECT_EQ(s.area, 2);
}

TEST(DecFacts, AWeightMovesTheMidpointTowardsTheOther) {
  const Mesh mesh = one_triangle({0, 0}, {2, 0}, {1, 3}, {1, 0, 0});
  const DecComplex c = dec_operators(mesh);
  EXPECT_EQ(c.edges[EdgeId(0)].crossing, 1.25) << "ℓ/2 + (w_0 − w_1)/(2ℓ)";
  EXPECT_EQ(c.edges[EdgeId(0)].midpoint, (Vec2{1.25, 0}));
}

TEST(DecFacts, CocircularPointsHaveADualEdgeOfLengthZeroExactly) {
  // The third square is not representable: its corners are cocircular only where 0.1 + 0.2 is what doubles make of it.
  const double a = 0.1, b = 0.1 + 0.2;
  for (const std::vector<Vec2>& square : {std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                          std::vector<Vec2>{{1e6, 0}, {1e6 + 0.5, 0}, {1e6 + 0.5, 3}, {1e6, 3}},
                                          std::vector<Vec2>{{a, a}, {b, a}, {b, b}, {a, b}}}) {
    const Mesh mesh = mesh_of(square, {{0, 1, 2}, {0, 2, 3}});
    const DecComplex c = dec_operators(mesh);
    const EdgeId diagonal = c.edge_of_halfedge[mesh.find_halfedge(VertexId(0), VertexId(2))];
    EXPECT_EQ(c.star1[diagonal], 0);
    EXPECT_FALSE(std::signbit(c.star1[diagonal]));
    EXPECT_EQ(c.edges[diagonal].dual_length, 0);
    EXPECT_EQ(c.transmissibility[diagonal], std::numeric_limits<double>::infinity());
    const DecSummary s = summarize(mesh, c);
    EXPECT_EQ(s.zero_star1, 1u);
    EXPECT_EQ(s.negative_star1, 0u);
    EXPECT_EQ(s.max_transmissibility, std::numeric_limits<double>::infinity());
  }
}

TEST(DecFacts, ARightAngleOnTheBoundaryHasAZeroThere) {
  const DecComplex c = dec_operators(one_triangle({0, 0}, {3, 0}, {0, 1}));
  EXPECT_EQ(c.star1[EdgeId(2)], 0) << "the hypotenuse 1-2";
  EXPECT_EQ(c.star1[EdgeId(0)], 1.0 / 6);
}

TEST(DecFacts, AMeshOfNothingHasOperatorsOfNothing) {
  const Mesh mesh;
  const DecComplex c = dec_operators(mesh);
  EXPECT_EQ(c.d0.n_rows(), 0u);
  EXPECT_EQ(c.d1.n_rows(), 0u);
  EXPECT_EQ(summarize(mesh, c).max_star1, 0);
  EXPECT_EQ(power_cells(mesh, c).n_polygons(), 0u);
}

}  // namespace
}  // namespace temper
