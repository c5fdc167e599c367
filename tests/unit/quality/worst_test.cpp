// The sentences on the worst triangles: each cause in its own words.
#include <gtest/gtest.h>

#include <string>

#include "support/shapes.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

using test::mesh_of;
using test::one_triangle;

std::string why(const Mesh& mesh) {
  const Quality q = quality(mesh, {.worst = 1});
  EXPECT_EQ(q.worst.size(), 1u);
  return q.worst.empty() ? "" : q.worst[0].why;
}

TEST(WorstTriangles, AnObtuseAngleIsNamedWithTheEdgeAcross) {
  EXPECT_EQ(why(one_triangle({0, 0}, {4, 0}, {2, 1})),
            "orthocenter outside across boundary edge 0-1: angle of 126.9° at vertex 2; all its corners are on the "
            "boundary, so only weights and flips can change it");
}

TEST(WorstTriangles, ARightAngleIsCalledRight) {
  EXPECT_TRUE(why(one_triangle({0, 0}, {1, 0}, {0, 1}))
                  .starts_with("orthocenter on boundary edge 1-2: right angle at vertex 0"));
}

TEST(WorstTriangles, AnAcuteTriangleIsPushedByWeights) {
  EXPECT_TRUE(why(one_triangle({0, 0}, {4, 0}, {2, 3}, {0, 0, 8}))
                  .starts_with("orthocenter outside across boundary edge 0-1: angle of 67.4° at vertex 2, but the "
                               "weights push it there: 8 at "
                               "vertex 2, 0 and 0 on the edge"));
}

TEST(WorstTriangles, AnUncrossedEdgeNamesTheHeavyEndAndTheLimit) {
  const std::string sentence = why(one_triangle({0, 0}, {1, 0}, {0.5, 4}, {0, 2, 0}));
  EXPECT_NE(sentence.find("boundary edge 0-1 is not crossed by its dual: the weight of vertex 1 exceeds that of vertex "
                          "0 by 2, and the edge's squared length is 1"),
            std::string::npos)
      << sentence;
}

TEST(WorstTriangles, AGoodTriangleSaysHowGood) {
  EXPECT_EQ(why(one_triangle({0, 0}, {2, 0}, {1, 2})),
            "well-centered; least margin h/ℓ = 0.25 over boundary edge 1-2, angle of 63.4° at vertex 0");
  EXPECT_EQ(why(one_triangle({0, 0}, {2, 0}, {3, 1.732}, {3.265, 0.265, 3.206124})),
            "well-centered; least margin d/ℓ = 0.125 on boundary edge 0-1")
      << "orthocenter (1.75, 0.45), an angle of 120° held by weights";
}

TEST(WorstTriangles, AnInteriorEdgeIsNotCalledBoundary) {
  const Mesh mesh = mesh_of({{0, 0}, {4, 0}, {2, 1}, {2, -3}}, {{0, 1, 2}, {1, 0, 3}});
  const Quality q = quality(mesh, {.worst = 1});
  ASSERT_EQ(q.worst.size(), 1u);
  EXPECT_EQ(q.worst[0].triangle, TriangleId(0));
  EXPECT_TRUE(q.worst[0].why.starts_with("orthocenter outside across edge 0-1: angle of 126.9° at vertex 2"));
  EXPECT_NEAR(q.worst[0].h_over_l, -1.5 / 4, 1e-15);
  EXPECT_NEAR(q.worst[0].at.x, 2, 1e-15);
  EXPECT_NEAR(q.worst[0].at.y, 1.0 / 3, 1e-15);
}

}  // namespace
}  // namespace temper
