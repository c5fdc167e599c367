// Explanations of tetrahedra: each bad one is explained once, by numbers that other functions have, too.
#include "temper/tets/explain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/rng.hpp"
#include "support/tet_lattice.hpp"
#include "support/tet_layers.hpp"
#include "temper/detail/lp.hpp"
#include "temper/tets/geometry.hpp"

namespace temper::tets {
namespace {

/// Cubes with moved vertices: some tetrahedra are bad, others are not.
TetMesh shaken() {
  test::TetArrays arrays = test::cubes(3, test::kFiveTets);
  Rng rng(7);
  for (Vec3& p : arrays.points) p = p + 0.2 * Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
  return test::mesh_of(arrays);
}

TEST(TetExplanation, HasEachBadTetrahedronOnceWithItsFourHeights) {
  const TetMesh mesh = shaken();
  const auto why = explain(mesh, *clp_solver());
  ASSERT_TRUE(why);
  EXPECT_GT(why->bad, 0U);
  EXPECT_EQ(why->bad, why->quality.orthocenters_outside);
  ASSERT_EQ(why->reasons.size(), why->bad);
  std::vector<TetId> seen;
  std::size_t on_boundary = 0;
  for (const Reason& reason : why->reasons) {
    seen.push_back(reason.tetrahedron);
    EXPECT_FALSE(tetrahedron_quality(mesh.points(reason.tetrahedron)).well_centered);
    double least = HUGE_VAL;
    for (const FaceHeight& face : reason.faces) {
      least = std::min(least, face.h_over_l);
      EXPECT_EQ(face.h > 0, !face.outside);
    }
    EXPECT_NEAR(least, reason.h_over_l, 1e-9);
    const auto [a, b, c, d] = mesh.points(reason.tetrahedron);
    EXPECT_EQ(reason.orthocenter, orthocenter(a, b, c, d));
    on_boundary += reason.all_on_boundary;
  }
  EXPECT_EQ(why->all_on_boundary, on_boundary);
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(TetExplanation, NamesTheCureThatTheVerdictAllows) {
  const TetMesh mesh = shaken();
  const auto known = explain(mesh, *clp_solver()), unknown = explain(mesh, *clp_solver(), {.reasons = 1, .whole = 0});
  ASSERT_TRUE(known && unknown);
  ASSERT_TRUE(known->weights);
  EXPECT_EQ(known->verdict(), known->weights->verdict);
  EXPECT_EQ(unknown->verdict(), Feasibility::undecided);
  EXPECT_EQ(unknown->reasons.size(), 1U);
  EXPECT_EQ(unknown->cure(false), Cure::optimize);
  EXPECT_EQ(unknown->cure(true), Cure::split_boundary);
  EXPECT_EQ(known->cure(true), known->verdict() == Feasibility::feasible ? Cure::weights : Cure::split_boundary);
  for (const Reason& reason : known->reasons) EXPECT_EQ(reason.cure, known->cure(reason.all_on_boundary));
}

TEST(TetExplanation, KnowsTheEquationsOfInterfacesBetweenTensors) {
  const auto solver = clp_solver();
  const MetricMesh pieces = test::pieces_of(test::two_layers(4, 0.1, 0), test::kLower, test::kUpper);
  const auto why = explain(pieces, *solver), alone = explain(pieces.mesh, *solver);
  ASSERT_TRUE(why && alone);
  EXPECT_EQ(why->bad, alone->bad);
  ASSERT_TRUE(why->weights);
  EXPECT_EQ(why->weights->margin, find_weights(pieces, *solver, {.goal = WeightGoal::margin})->margin);
  EXPECT_EQ(why->cure(true), Cure::slide);
  std::size_t at_interface = 0;
  for (std::size_t i = 0; i < why->reasons.size(); ++i) {
    for (std::size_t f = 0; f < 4; ++f) {
      const FaceHeight &face = why->reasons[i].faces[f], &face_alone = alone->reasons[i].faces[f];
      EXPECT_EQ(face_alone.boundary, face.boundary || face.at_interface);
      EXPECT_FALSE(face.boundary && face.at_interface);
      if (!face.at_interface) continue;
      ++at_interface;
      // The layers meet at z = 2.
      const Metric& metric = pieces.metric(why->reasons[i].tetrahedron);
      for (const VertexId v : face.vertices) EXPECT_NEAR(metric.from_metric(pieces.mesh.position(v)).z, 2, 1e-12);
    }
  }
  EXPECT_GT(at_interface, 0U);
}

}  // namespace
}  // namespace temper::tets
