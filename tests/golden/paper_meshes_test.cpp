// Numbers of the paper's meshes, to 12 digits. The energies of the dense horseshoe were computed twice, by
// independent programs; the equilateral triangle's by hand.
#include <gtest/gtest.h>

#include "temper/energy.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

namespace temper::test {
namespace {

constexpr double kHalfUnit = 5e-13;  // of the twelfth decimal

TEST(PaperMeshes, EnergiesOfTheDenseHorseshoe) {
  const auto mesh = horseshoe();
  ASSERT_TRUE(mesh);
  const auto energy = [&](EnergyKind kind, int star) {
    return total_energy(*mesh, {.kind = kind, .star = Star(star)});
  };
  EXPECT_NEAR(energy(EnergyKind::F, 0), 0.581320957789, kHalfUnit);
  EXPECT_NEAR(energy(EnergyKind::F, 1), 2.836890825582, kHalfUnit);
  EXPECT_NEAR(energy(EnergyKind::F, 2), 2.255569867793, kHalfUnit);
  EXPECT_NEAR(energy(EnergyKind::T, 1), 12.143904187128, kHalfUnit);
  EXPECT_NEAR(energy(EnergyKind::dT, 1), 12.143904187128, kHalfUnit);
  EXPECT_NEAR(energy(EnergyKind::BP, 1), 375.355882218659, kHalfUnit);  // γ = 1, absolute
  EXPECT_EQ(energy(EnergyKind::BH, 1), std::numeric_limits<double>::infinity());
}

TEST(PaperMeshes, CountsOfTheDenseHorseshoe) {
  const auto mesh = horseshoe();
  ASSERT_TRUE(mesh);
  const Quality q = quality(*mesh);
  EXPECT_EQ(q.vertices, 63u);
  EXPECT_EQ(q.triangles, 96u);
  EXPECT_EQ(q.edges, 158u);
  EXPECT_EQ(q.boundary_edges, 28u);  // 2 × 6 on the arches, 2 × 8 on the feet
  EXPECT_EQ(q.inverted_triangles, 0u);
  EXPECT_EQ(q.non_regular_edges, 0u);
  EXPECT_EQ(q.negative_boundary_duals, 6u);
  EXPECT_EQ(q.orthocenters_outside, 58u);
  EXPECT_EQ(q.edges_not_crossed, 0u);
  EXPECT_NEAR(q.well_centered_fraction, 38.0 / 96, 1e-15);
  EXPECT_NEAR(q.min_h_over_l, -0.5607, 5e-5);
  EXPECT_EQ(q.min_d_over_l, 0.5);
  EXPECT_NEAR(q.min_angle_deg, 4.095, 5e-4);
  EXPECT_NEAR(q.max_angle_deg, 138.27, 5e-3);
}

TEST(PaperMeshes, TheSparseHorseshoeHasTheFiveVerticesOfThePaper) {
  const Mesh mesh = sparse_horseshoe();
  ASSERT_EQ(mesh.n_vertices(), 5u);
  ASSERT_EQ(mesh.n_triangles(), 4u);
  const Vec2 expected[] = {{-2, 0}, {0, 2}, {2, 0}, {0, 4}, {0, 3}};
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(mesh.position(v), expected[v.index]);
    EXPECT_EQ(mesh.is_boundary(v), v.index != 4);
  }
}

}  // namespace
}  // namespace temper::test
