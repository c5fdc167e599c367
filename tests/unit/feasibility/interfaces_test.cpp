// Weights for each vertex and region: the equations of interfaces between tensors, and their proofs.
#include <algorithm>
#include <cmath>

#include "support/layers_of_rock.hpp"
#include "unit/feasibility/support.hpp"

namespace temper {
namespace {

MetricMesh with_weights(MetricMesh pieces, const IdVector<VertexId, double>& weights) {
  pieces.mesh = test::with_weights(std::move(pieces.mesh), weights);
  return pieces;
}

std::size_t equations_in(const Certificate& certificate) {
  return static_cast<std::size_t>(std::ranges::count_if(certificate.terms, [](const Certificate::Term& term) {
    return term.constraint.kind == WeightConstraint::Kind::equal_crossing;
  }));
}

TEST(Interfaces, WeightsOfAllGoalsKeepTheEquations) {
  const auto solver = clp_solver();
  std::size_t solved = 0, changed = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const MetricMesh pieces = test::layers_of_rock(3, 1.3, 3, 0.2, seed).pieces();
    for (const WeightGoal goal : {WeightGoal::change, WeightGoal::margin, WeightGoal::elastic}) {
      for (const Constraints constraints :
           {Constraints::well_centered, Constraints::coefficients, Constraints::distances}) {
        const auto report = find_weights(pieces, *solver, {.goal = goal, .constraints = constraints});
        ASSERT_TRUE(report);
        const MetricMesh weighted = with_weights(pieces, report->weights);
        EXPECT_LT(largest_gap(weighted), 1e-14) << seed;
        solved += report->solved ? 1 : 0;
        changed += report->moved > 0 ? 1 : 0;
        if (report->verdict != Feasibility::feasible || constraints != Constraints::well_centered) continue;
        EXPECT_EQ(test::bad_triangles(weighted.mesh), 0U) << seed;
        EXPECT_GT(weight_margin(weighted.mesh), 0.5 * report->asked);
      }
    }
  }
  EXPECT_GT(solved, 30U);
  EXPECT_GT(changed, 30U);
}

TEST(Interfaces, ProofsNeedTheirEquationsAndNoOthers) {
  const auto solver = clp_solver();
  std::size_t proofs = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const MetricMesh pieces = test::layers_of_rock(2, 3, 2, 0.3, seed).pieces();
    const auto report = find_weights(pieces, *solver, {.goal = WeightGoal::margin});
    ASSERT_TRUE(report);
    if (report->verdict != Feasibility::infeasible || equations_in(report->certificate) == 0) continue;
    ++proofs;
    Certificate certificate = report->certificate;
    EXPECT_EQ(check_certificate(pieces, certificate), CertificateCheck::proves);
    EXPECT_EQ(check_certificate(pieces.mesh, certificate), CertificateCheck::not_of_this_mesh) << "no interfaces";
    const auto equation = std::ranges::find_if(certificate.terms, [](const Certificate::Term& term) {
      return term.constraint.kind == WeightConstraint::Kind::equal_crossing;
    });
    const Certificate::Term kept = *equation;
    equation->multiplier = -kept.multiplier;
    EXPECT_EQ(check_certificate(pieces, certificate), CertificateCheck::proves_nothing);
    *equation = kept;
    std::swap(equation->constraint.r, equation->constraint.s);  // the edge in the other direction
    EXPECT_EQ(check_certificate(pieces, certificate), CertificateCheck::not_of_this_mesh);
    *equation = kept;
    certificate.terms.erase(equation);
    EXPECT_NE(check_certificate(pieces, certificate), CertificateCheck::proves);
  }
  EXPECT_GT(proofs, 3U);
}

TEST(Interfaces, WithoutTheirEquationsEachSideHasMoreMargin) {
  const auto solver = clp_solver();
  std::size_t more = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const MetricMesh pieces = test::layers_of_rock(2, 1.5, 2, 0.2, seed).pieces();
    const auto report = find_weights(pieces, *solver, {.goal = WeightGoal::margin});
    ASSERT_TRUE(report);
    const BestMargin alone = best_margin(pieces.mesh, *solver);
    EXPECT_GE(alone.margin, report->margin - 1e-9) << seed;
    more += alone.margin > report->margin + 1e-6 ? 1 : 0;
  }
  EXPECT_GT(more, 3U);
}

TEST(Interfaces, GapsAreClosedByTheLeastChange) {
  MetricMesh pieces = test::layers_of_rock(3, 4, 2, 0.1).pieces();
  test::Noise noise(5);
  for (const VertexId v : pieces.mesh.vertices()) pieces.mesh.set_weight(v, 0.05 * noise());
  const MetricMesh before = pieces;
  EXPECT_GT(largest_gap(pieces), 1e-3);
  close_gaps(pieces);
  EXPECT_LT(largest_gap(pieces), 1e-15);
  double change = 0;
  std::size_t copies = 0;
  for (const VertexId v : pieces.mesh.vertices()) {
    const double moved = std::abs(pieces.mesh.weight(v) - before.mesh.weight(v));
    change = std::max(change, moved);
    const bool at_interface = std::ranges::count(pieces.first_copies, pieces.first_copy(v)) > 1;
    copies += at_interface ? 1 : 0;
    EXPECT_TRUE(at_interface || moved == 0);
  }
  EXPECT_LT(change, 0.15);
  EXPECT_GT(copies, 10U);
  const MetricMesh closed = pieces;
  close_gaps(pieces);
  EXPECT_EQ(pieces.mesh, closed.mesh) << "nothing is left to close";
}

TEST(Interfaces, GoalsOfConvexProgramsAreRefused) {
  const MetricMesh pieces = test::layers_of_rock(2, 2).pieces();
  for (const WeightGoal goal : {WeightGoal::center, WeightGoal::accuracy, WeightGoal::least}) {
    const auto refused = find_weights(pieces, *clp_solver(), {.goal = goal}, interior_point_solver().get());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_option);
  }
}

}  // namespace
}  // namespace temper
