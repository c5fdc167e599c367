// Weights for each vertex and region: the equations of interfaces hold, and what cannot be is proved.
#include <gtest/gtest.h>

#include "support/tet_layers.hpp"
#include "temper/detail/lp.hpp"
#include "temper/tets/quality.hpp"
#include "temper/tets/weights.hpp"

namespace temper::tets {
namespace {

using test::kLower, test::kUpper, test::pieces_of, test::two_layers;

MetricMesh with_weights(MetricMesh pieces, const IdVector<VertexId, double>& weights) {
  for (const VertexId v : pieces.mesh.vertices()) pieces.mesh.set_weight(v, weights[v]);
  return pieces;
}

TEST(TetTensorWeights, KeepTheEquationsOfInterfaces) {
  const MetricMesh pieces = pieces_of(two_layers(2, 0, 0), kLower, kUpper);
  const auto solver = clp_solver();
  for (const WeightGoal goal : {WeightGoal::change, WeightGoal::elastic}) {
    WeightOptions options;
    options.goal = goal;
    const auto found = find_weights(pieces, *solver, options);
    ASSERT_TRUE(found) << found.error().what();
    EXPECT_LT(largest_gap_of_edges(with_weights(pieces, found->weights)), 1e-12);
    if (found->certificate.terms.empty()) continue;
    EXPECT_EQ(check_certificate(pieces, found->certificate), CertificateCheck::proves);
  }
}

TEST(TetTensorWeights, AreProvedNotToExist) {
  const MetricMesh pieces = pieces_of(two_layers(4, 0.1, 0), kLower, kUpper);
  const auto found = find_weights(pieces, *clp_solver(), {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->verdict, Feasibility::infeasible);
  EXPECT_EQ(check_certificate(pieces, found->certificate), CertificateCheck::proves);
}

TEST(TetTensorWeights, OfTheMeshAloneAreNoBetterWithEquations) {
  // Equations leave less room: the least violation grows, or stays.
  const TetMesh mesh = two_layers(2, 0, 0, test::kSixTets);
  const MetricMesh pieces = pieces_of(mesh, kLower, kUpper);
  const auto solver = clp_solver();
  WeightOptions options;
  options.goal = WeightGoal::elastic;
  options.constraints = Constraints::distances;
  const auto with = find_weights(pieces, *solver, options), without = find_weights(pieces.mesh, *solver, options);
  ASSERT_TRUE(with);
  ASSERT_TRUE(without);
  const auto margin = [&](const auto& report) {
    return weight_margin(with_weights(pieces, report->weights).mesh, Constraints::distances);
  };
  EXPECT_LE(margin(with), margin(without) + 1e-7);
}

TEST(TetTensorWeights, TermsOfOtherEdgesAreNotOfTheMesh) {
  const MetricMesh pieces = pieces_of(two_layers(2, 0, 0), kLower, kUpper);
  const auto found = find_weights(pieces, *clp_solver(), {});
  ASSERT_TRUE(found);
  Certificate certificate = found->certificate;
  WeightConstraint equation = {WeightConstraint::Kind::equal_crossing, VertexId(0), VertexId(1), VertexId(2),
                               VertexId(3)};
  certificate.terms.push_back({equation, 1});
  certificate.terms.push_back({equation, -1});
  EXPECT_NE(check_certificate(pieces, certificate), CertificateCheck::proves);
}

TEST(TetTensorWeights, GoalsWithoutEquationsAreRefused) {
  const MetricMesh pieces = pieces_of(two_layers(2, 0, 0), kLower, kUpper);
  for (const WeightGoal goal : {WeightGoal::center, WeightGoal::accuracy, WeightGoal::least, WeightGoal::fewest}) {
    WeightOptions options;
    options.goal = goal;
    const auto refused = find_weights(pieces, *clp_solver(), options, interior_point_solver().get());
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().message.starts_with("goal: center, accuracy, least and fewest have no equations"));
  }
}

}  // namespace
}  // namespace temper::tets
