// Reasons at interfaces between tensors: proofs with equations of interfaces, where each side alone has weights.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/layers_of_rock.hpp"
#include "support/shapes.hpp"
#include "temper/detail/lp.hpp"
#include "temper/explain.hpp"

namespace temper::test {
namespace {

bool has_equations(const Certificate& certificate) {
  return std::ranges::any_of(certificate.terms, [](const Certificate::Term& term) {
    return term.constraint.kind == WeightConstraint::Kind::equal_crossing;
  });
}

/// Checks a conflict across an interface.
void expect_across(const MetricMesh& pieces, const Reason& reason, LpSolver& solver) {
  std::set<std::int32_t> regions;
  for (const TriangleId t : reason.conflict) regions.insert(pieces.mesh.region(t));
  EXPECT_GE(regions.size(), 2U);
  for (const std::int32_t region : regions) {
    std::vector<TriangleId> side = reason.conflict;
    std::erase_if(side, [&](TriangleId t) { return pieces.mesh.region(t) != region; });
    EXPECT_GT(best_margin(pieces.mesh, side, solver).margin, 0) << "each side alone has weights";
  }
  ASSERT_FALSE(reason.cures.empty());
  const Cure& cure = reason.cures.front();
  EXPECT_EQ(cure.action, Cure::Action::split_interface);
  const HalfedgeId h = pieces.mesh.find_halfedge(cure.edge[0], cure.edge[1]);
  const HalfedgeId at = h.valid() ? h : pieces.mesh.find_halfedge(cure.edge[1], cure.edge[0]);
  ASSERT_TRUE(at.valid());
  EXPECT_EQ(pieces.mesh.region(Mesh::triangle(at)), pieces.mesh.region(reason.bad.front()));
  EXPECT_TRUE(std::ranges::any_of(seams_of(pieces), [&](const SeamEdge& s) { return s.one == at || s.other == at; }));
  EXPECT_NE(reason_text(pieces.mesh, reason).find("must cross interface edge"), std::string::npos);
  EXPECT_NE(cure_text(pieces.mesh, cure).find("on both sides"), std::string::npos);
}

/// Two triangles with an interface edge in common, 0-1. One is obtuse at vertex 0, and the other at vertex 1.
MetricMesh obtuse_at_both_ends() {
  const Mesh mesh = mesh_of({{0, 0}, {1, 0}, {-0.5, 0.4}, {1.5, -0.4}}, {{0, 1, 2}, {1, 0, 3}});
  return *mapped(mesh, *Metrics::of(std::vector<Tensor>{{1, 0, 1}, {1, 0, 1.1}}));
}

TEST(ExplainInterfaces, AConflictAcrossOneIsProvedWithItsEquation) {
  const MetricMesh pieces = obtuse_at_both_ends();
  const auto solver = clp_solver();
  const auto explanation = explain(pieces, *solver);
  ASSERT_TRUE(explanation);
  EXPECT_EQ(explanation->verdict, Feasibility::infeasible);
  ASSERT_EQ(explanation->reasons.size(), 1U);
  const Reason& reason = explanation->reasons.front();
  EXPECT_EQ(reason.kind, ReasonKind::at_interface);
  EXPECT_EQ(reason.bad.size(), 2U);
  EXPECT_TRUE(has_equations(reason.certificate));
  EXPECT_EQ(check_certificate(pieces, reason.certificate), CertificateCheck::proves);
  expect_across(pieces, reason, *solver);
  const auto alone = explain(pieces.mesh, *solver);
  ASSERT_TRUE(alone);
  for (const Reason& r : alone->reasons) EXPECT_EQ(r.kind, ReasonKind::weights) << "each side alone has weights";
}

TEST(ExplainInterfaces, ProofsHaveEquationsJustWhenTheyAreOfTheKindInterface) {
  const auto solver = clp_solver();
  std::size_t proofs = 0, weights = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const double ratio : {1.3, 3.0}) {
      const MetricMesh pieces = layers_of_rock(2, ratio, 2, 0.25, seed).pieces();
      const auto explanation = explain(pieces, *solver);
      ASSERT_TRUE(explanation);
      std::size_t bad = 0;
      for (const Reason& reason : explanation->reasons) {
        bad += reason.bad.size();
        EXPECT_EQ(reason.kind == ReasonKind::at_interface, has_equations(reason.certificate));
        if (reason.kind == ReasonKind::at_interface) expect_across(pieces, reason, *solver);
        weights += reason.kind == ReasonKind::weights ? 1 : 0;
        if (reason.certificate.terms.empty()) continue;
        ++proofs;
        EXPECT_EQ(check_certificate(pieces, reason.certificate), CertificateCheck::proves);
      }
      EXPECT_EQ(bad, explanation->bad);
    }
  }
  EXPECT_GT(proofs, 2U);
  EXPECT_GT(weights, 0U);
}

TEST(ExplainInterfaces, OfOneTensorAreThoseOfTheMesh) {
  const auto solver = clp_solver();
  LayersOfRock rock = layers_of_rock(2, 3, 2, 0.3, 4);
  std::ranges::fill(rock.tensors, Tensor{2, 0.5, 1});
  const MetricMesh pieces = rock.pieces();
  const auto with = explain(pieces, *solver), without = explain(pieces.mesh, *solver);
  ASSERT_TRUE(with);
  ASSERT_TRUE(without);
  ASSERT_EQ(with->reasons.size(), without->reasons.size());
  EXPECT_GT(with->reasons.size(), 0U);
  for (std::size_t i = 0; i < with->reasons.size(); ++i)
    EXPECT_EQ(reason_text(pieces.mesh, with->reasons[i]), reason_text(pieces.mesh, without->reasons[i]));
}

}  // namespace
}  // namespace temper::test
