// Points that are nearly at one place become one, flat triangles are flipped away, and certificates come back.
#include "temper/detail/file_cures.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "temper/detail/certificate_io.hpp"

namespace temper::io {
namespace {

/// Two unit squares side by side, the right one with points of its own along the common edge.
MeshFile cracked(double width) {
  MeshFile file;
  file.path = "in.off";
  file.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1 + width, 0}, {2, 0}, {2, 1}, {1 + width, 1}};
  file.triangles.corners = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  file.triangles.tags = {1, 1, 2, 2};
  file.lines.corners = {{4, 7}};
  file.lines.tags = {5};
  file.point_data = {{"number", 1, std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}}};
  return file;
}

TEST(FileCures, FindACrackAndMergeItsPoints) {
  MeshFile file = cracked(1e-9);
  const auto loaded = make_mesh(file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  const Crack crack = find_crack(loaded->mesh);
  EXPECT_EQ(crack.pairs, 2U);
  EXPECT_NEAR(crack.widest, 1e-9, 1e-12);
  const auto gone = merge_points(file, 1e-8);
  ASSERT_TRUE(gone) << gone.error().what();
  EXPECT_EQ(*gone, 2U);
  EXPECT_EQ(file.points, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}}));
  EXPECT_EQ(file.triangles.corners,
            (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}));
  EXPECT_EQ(file.lines.corners, (std::vector<std::array<std::int32_t, 2>>{{1, 2}}));
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(file.point_data[0].values),
            (std::vector<std::int32_t>{0, 1, 2, 3, 5, 6}));
  const auto joined = make_mesh(file);
  ASSERT_TRUE(joined);
  EXPECT_EQ(find_crack(joined->mesh).pairs, 0U);
}

TEST(FileCures, RefuseARadiusThatTakesCorners) {
  MeshFile file = cracked(0.5);
  EXPECT_EQ(*merge_points(file, 0.1), 0U);
  const auto far = merge_points(file, 1);
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().what(), "in.off: --merge 1 makes two corners of triangle 0 one; expected less than its edges");
  EXPECT_EQ(merge_points(file, -1).error().code, ErrorCode::invalid_option);
}

TEST(FileCures, MergePointsOfTetrahedraInAllThreeCoordinates) {
  MeshFile file;
  file.points = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 0}};
  file.points_in = SpacePoints{{0, 0, 0, 1, 1e-9}};
  file.tetrahedra.corners = {{4, 1, 2, 3}};
  file.triangles.corners = {{0, 1, 2}};
  EXPECT_EQ(*merge_points(file, 1e-8), 1U);
  EXPECT_EQ(file.tetrahedra.corners, (std::vector<std::array<std::int32_t, 4>>{{0, 1, 2, 3}}));
  EXPECT_EQ(file.in_space()->heights, (std::vector<double>{0, 0, 0, 1}));
}

TEST(FileCures, FlipAFlatTriangleWithItsTagAndLines) {
  MeshFile file;
  file.points = {{0, 0}, {4, 0}, {2, 0}, {2, 3}, {2, -3}};
  file.triangles.corners = {{0, 2, 1}, {0, 1, 3}, {0, 4, 2}, {2, 4, 1}};
  file.triangles.tags = {7, 8, 9, 9};
  file.lines.corners = {{0, 1}};
  file.lines.tags = {3};
  const auto cured = flip_flat_triangles(file);
  ASSERT_TRUE(cured) << cured.error().what();
  EXPECT_EQ(*cured, 1U);
  EXPECT_EQ(file.triangles.tags, (std::vector<std::int32_t>{8, 8, 9, 9}));
  EXPECT_EQ(file.lines.tags, (std::vector<std::int32_t>{3, 3}));
  EXPECT_TRUE(make_mesh(file));
  file.points_in = PeriodicPoints{{8, 8}};
  EXPECT_EQ(flip_flat_triangles(file).error().code, ErrorCode::unsupported);
}

TEST(CertificateIo, ComesBackInTheNumbersOfTheMesh) {
  using Kind = WeightConstraint::Kind;
  Certificate certificate;
  certificate.margin = 0.25;
  certificate.terms = {{{Kind::height, VertexId(0), VertexId(1), VertexId(2)}, 0.1},
                       {{Kind::crossing, VertexId(2), VertexId(0), VertexId()}, 3},
                       {{Kind::dual, VertexId(0), VertexId(1), VertexId(2), VertexId(3)}, 1e-9}};
  const std::vector<std::size_t> points = {1, 2, 3, 4};  // point 0 is no vertex
  const auto back =
      certificate_from_json(certificate_to_json(certificate, points), VertexOfPoint({false, true, true, true, true}));
  ASSERT_TRUE(back) << back.error().what();
  EXPECT_EQ(std::get<Certificate>(*back).terms, certificate.terms);
  EXPECT_EQ(std::get<Certificate>(*back).margin, 0.25);
  const auto dropped =
      certificate_from_json(certificate_to_json(certificate), VertexOfPoint({false, true, true, true, true}), "c.json");
  EXPECT_EQ(dropped.error().what(), "c.json: term 0: point 0 is in no triangle");
}

TEST(CertificateIo, NamesCopiesOnInterfacesByPointAndCell) {
  using Kind = WeightConstraint::Kind;
  Certificate certificate;
  certificate.terms = {{{Kind::equal_crossing, VertexId(0), VertexId(1), VertexId(4), VertexId(5)}, -2.5},
                       {{Kind::crossing, VertexId(4), VertexId(5), VertexId()}, 1}};
  const std::vector<std::size_t> points = {1, 2, 3, 4, 5, 6, 7};
  const std::vector<CopyOfPoint> copies = {{5, 1, 8}, {6, 2, 8}, {7, 3, 9}};
  const std::string text = certificate_to_json(certificate, points, copies);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["copies"], nlohmann::json({{5, 1, 8}, {6, 2, 8}}));
  EXPECT_EQ(json["terms"][0]["edge"], nlohmann::json({1, 2}));
  EXPECT_EQ(json["terms"][0]["across"], nlohmann::json({5, 6}));
  const VertexOfPoint vertices({false, true, true, true, true, true, true, true});
  const auto back = certificate_from_json(text, vertices);
  ASSERT_TRUE(back) << back.error().what();
  EXPECT_EQ(std::get<Certificate>(*back), certificate);
}

}  // namespace
}  // namespace temper::io
