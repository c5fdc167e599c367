// The report on meshes of tetrahedra: laws, and the lattices whose measures are known.
#include "temper/tets/quality.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"

namespace temper::tets {
namespace {

Quality of(const test::TetArrays& arrays) { return quality(test::mesh_of(arrays)); }

TEST(TetQuality, TheBodyCenteredLatticeIsCompletelyWellCentered) {
  const Quality q = of(test::body_centered(3));
  EXPECT_EQ(q.orthocenters_outside, 0U);
  EXPECT_EQ(q.non_regular_faces + q.negative_boundary_duals + q.faces_not_crossed + q.edges_not_crossed, 0U);
  EXPECT_EQ(q.completely_well_centered_fraction, 1);
  EXPECT_NEAR(q.min_dihedral_deg, 60, 1e-12);
  EXPECT_NEAR(q.max_dihedral_deg, 90, 1e-12);
  // h = √2/8, and a face of sides 1, √3/2 and √3/2 has the area √2/4.
  EXPECT_NEAR(q.min_h_over_l, std::sqrt(2.0) / 8 / std::sqrt(4 / std::sqrt(3.0) * std::sqrt(2.0) / 4), 1e-14);
  EXPECT_NEAR(q.volume, static_cast<double>(q.tetrahedra) / 12, 1e-12);
  EXPECT_NEAR(q.transmissibility_ratio, 1, 1e-12);
}

TEST(TetQuality, CubesInSixHaveAllOrthocentersOnFacesAndDualEdgesOfLengthZero) {
  const Quality q = of(test::cubes(2, test::kSixTets));
  EXPECT_EQ(q.orthocenters_outside, q.tetrahedra);
  EXPECT_EQ(q.non_regular_faces, 0U);
  EXPECT_EQ(q.min_h_over_l, 0);
  EXPECT_EQ(q.edges_not_crossed, 0U);
  EXPECT_EQ(q.transmissibility_ratio, std::numeric_limits<double>::infinity());
  EXPECT_NE(q.worst.front().why.find("orthocenter on "), std::string::npos) << q.worst.front().why;
  EXPECT_NE(q.worst.front().why.find("h/ℓ = 0, dihedral angle of 90.0° at edge "), std::string::npos);
}

TEST(TetQuality, CountsFitTheMesh) {
  const TetMesh mesh = test::mesh_of(test::cubes(3, test::kFiveTets));
  const Quality q = quality(mesh);
  EXPECT_EQ(q.vertices, 64U);
  EXPECT_EQ(q.inner_vertices, 8U);
  EXPECT_EQ(q.tetrahedra, 135U);
  EXPECT_EQ(q.boundary_faces, 108U);
  EXPECT_EQ(q.faces, (4 * q.tetrahedra + q.boundary_faces) / 2);
  EXPECT_EQ(q.vertices + q.faces, q.edges + q.tetrahedra + 1);
  EXPECT_EQ(q.regions, 1U);
  EXPECT_EQ(q.faces_not_crossed, q.faces - 4U * 27);  // only the faces of the middle tetrahedra are not right-angled
  EXPECT_NEAR(q.volume, 27, 1e-12);
  EXPECT_NEAR(q.max_volume, 1.0 / 3, 1e-15);
  EXPECT_NEAR(q.min_volume, 1.0 / 6, 1e-15);
}

TEST(TetQuality, ScaleTranslationAndAnOffsetOfWeightsChangeNoMeasureButVolumes) {
  const test::TetArrays arrays = test::shaken(test::body_centered(3), 0.15, 0.05);
  test::TetArrays moved = arrays;
  for (Vec3& p : moved.points) p = 8.0 * p + Vec3{16, -8, 32};
  for (double& w : moved.weights) w = 64 * w + 4;
  const Quality a = of(arrays), b = of(moved);
  for (const QualityMeasure& m : quality_measures()) {
    const double power = m.key.find("volume") != std::string_view::npos ? 512 : 1;
    EXPECT_NEAR(m.of(b), power * m.of(a), 1e-9 * std::abs(power * m.of(a))) << m.key;
  }
  EXPECT_GT(a.orthocenters_outside, 0U);
  EXPECT_LT(a.orthocenters_outside, a.tetrahedra);
}

TEST(TetQuality, TheReportDoesNotDependOnThreads) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(10, test::kSixTets), 0.1, 0.1));
  test::StdThreads threads(3);
  const Quality one = quality(mesh, {20}), three = quality(mesh, {20, &threads});
  for (const QualityMeasure& m : quality_measures()) EXPECT_EQ(m.of(one), m.of(three)) << m.key;
  ASSERT_EQ(one.worst.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(one.worst[i].why, three.worst[i].why);
    EXPECT_LE(one.worst[i ? i - 1 : 0].h_over_l, one.worst[i].h_over_l);
  }
}

TEST(TetQuality, EachMeasureHasOneNameAndADefinition) {
  std::vector<std::string_view> names;
  for (const QualityMeasure& m : quality_measures()) {
    EXPECT_FALSE(m.label.empty() || m.definition.empty()) << m.key;
    names.push_back(m.key);
    if (!m.alias.empty()) names.push_back(m.alias);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace temper::tets
