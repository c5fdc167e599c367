// The report on meshes whose numbers are known: by hand, from the paper's horseshoe, from public meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "support/shapes.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

using test::mesh_of;
using test::one_triangle;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(QualityFacts, AnEquilateralTriangle) {
  const Quality q = quality(one_triangle({0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}));
  EXPECT_EQ(q.vertices, 3u);
  EXPECT_EQ(q.triangles, 1u);
  EXPECT_EQ(q.edges, 3u);
  EXPECT_EQ(q.boundary_edges, 3u);
  EXPECT_EQ(q.regions, 1u);
  EXPECT_EQ(q.orthocenters_outside, 0u);
  EXPECT_EQ(q.negative_boundary_duals, 0u);
  EXPECT_EQ(q.well_centered_fraction, 1);
  EXPECT_NEAR(q.min_h_over_l, 1 / std::sqrt(12.0), 1e-15);
  EXPECT_EQ(q.min_d_over_l, 0.5);
  EXPECT_NEAR(q.min_angle_deg, 60, 1e-13);
  EXPECT_NEAR(q.max_angle_deg, 60, 1e-13);
  EXPECT_EQ(q.max_transmissibility_over_median, 1) << "no interior edge: nothing to compare";
  EXPECT_NEAR(q.energy[3][1], 4.618802153517, 5e-13);
}

double value_of(std::string_view name, const Mesh& mesh) {
  const auto found = std::ranges::find(triangle_values(), name, &TriangleValue::name);
  return found->of(mesh, TriangleId(0));
}

TEST(TriangleValues, AreThoseOfTheReportWhereItHasThem) {
  const Mesh right = one_triangle({0, 0}, {2, 0}, {0, 1});
  const Quality q = quality(right);
  EXPECT_EQ(triangle_values().size(), 4u);
  EXPECT_NEAR(value_of("quality", right), std::min(q.min_h_over_l, q.min_d_over_l), 1e-15);
  EXPECT_NEAR(value_of("angle", right), q.max_angle_deg, 1e-12);
  EXPECT_NEAR(value_of("size", right), (3 + std::sqrt(5.0)) / 3, 1e-15);
  EXPECT_EQ(value_of("region", right), right.region(TriangleId(0)));
  Mesh inverted = right;
  inverted.set_position(VertexId(2), {0, -1});
  EXPECT_EQ(value_of("quality", inverted), -kInfinity);
}

TEST(QualityFacts, TheOrthocenterOfARightTriangleIsNotInside) {
  const Quality q = quality(one_triangle({0, 0}, {1, 0}, {0, 1}));
  EXPECT_EQ(q.orthocenters_outside, 1u);
  EXPECT_EQ(q.negative_boundary_duals, 0u) << "zero is not negative";
  EXPECT_EQ(q.edges_not_crossed, 0u);
  EXPECT_EQ(q.well_centered_fraction, 0);
  EXPECT_EQ(q.min_h_over_l, 0);
  EXPECT_EQ(q.energy[3][1], kInfinity);
}

TEST(QualityFacts, AWeightAsLargeAsTheSquaredLengthLeavesAnEdgeUncrossed) {
  const Vec2 a{0, 0}, b{1, 0}, c{0.5, 4};
  EXPECT_EQ(quality(one_triangle(a, b, c, {0.9375, 0, 0})).edges_not_crossed, 0u);
  EXPECT_EQ(quality(one_triangle(a, b, c, {1, 0, 0})).edges_not_crossed, 1u) << "d = 0 exactly";
  const Quality q = quality(one_triangle(a, b, c, {2, 0, 0}));
  EXPECT_EQ(q.edges_not_crossed, 1u);
  EXPECT_EQ(q.min_d_over_l, -0.5);
}

TEST(QualityFacts, ADualOfLengthZeroMakesTransmissibilityInfinite) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Quality q = quality(mesh_of(square, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(q.max_transmissibility_over_median, kInfinity);
  EXPECT_EQ(q.non_regular_edges, 0u) << "zero is not negative";
}

TEST(QualityFacts, TransmissibilityIsFaceLengthOverCenterDistance) {
  // Equilateral triangles around a vertex: all spokes alike.
  std::vector<Vec2> points = {{0, 0}};
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i < 6; ++i) {
    points.push_back({std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3)});
    triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
  }
  EXPECT_NEAR(quality(mesh_of(points, triangles)).max_transmissibility_over_median, 1, 1e-14);
  // Three triangles around the origin, two interior edges; the median of two is their mean.
  const Mesh fan = mesh_of({{0, 0}, {2, 0}, {1, 1.5}, {-1, 2}, {-2, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  const auto center = [](Vec2 b, Vec2 c) {
    const double det = 2 * cross(b, c), bb = squared_length(b), cc = squared_length(c);
    return Vec2{(c.y * bb - b.y * cc) / det, (b.x * cc - c.x * bb) / det};
  };
  const Vec2 a = center({2, 0}, {1, 1.5}), b = center({1, 1.5}, {-1, 2}), c = center({-1, 2}, {-2, 0});
  const double first = std::sqrt(3.25) / length(b - a), second = std::sqrt(5) / length(c - b);
  const double expected = std::max(first, second) / ((first + second) / 2);
  EXPECT_NEAR(quality(fan).max_transmissibility_over_median, expected, 1e-13);
}

TEST(QualityFacts, AnInvertedTriangleCountsAsWorstOfAll) {
  Mesh mesh = mesh_of({{0, 0}, {4, 0}, {2, 3}, {2, 1}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  mesh.set_position(VertexId(3), {2, -1});
  const Quality q = quality(mesh);
  EXPECT_EQ(q.inverted_triangles, 1u);
  EXPECT_EQ(q.min_h_over_l, -kInfinity);
  ASSERT_FALSE(q.worst.empty());
  EXPECT_EQ(q.worst[0].triangle, TriangleId(0));
  EXPECT_EQ(q.worst[0].why, "inverted: its corners turn clockwise");
  EXPECT_GE(q.orthocenters_outside, 1u);

  mesh.set_position(VertexId(3), {2, 0});
  const Quality flat = quality(mesh);
  EXPECT_EQ(flat.inverted_triangles, 0u);
  EXPECT_EQ(flat.worst[0].why, "no area: its corners are collinear");
}

TEST(QualityFacts, RegionsAreCounted) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(quality(mesh_of(square, {{0, 1, 2}, {0, 2, 3}}, {}, {7, -3})).regions, 2u);
}

TEST(QualityFacts, AnEmptyMeshHasAnEmptyReport) {
  const Quality q = quality(Mesh());
  EXPECT_EQ(q.vertices + q.triangles + q.edges + q.regions, 0u);
  EXPECT_TRUE(q.worst.empty());
}

TEST(QualityFacts, TheDenseHorseshoe) {
  const Quality q = quality(*horseshoe());
  EXPECT_EQ(q.vertices, 63u);
  EXPECT_EQ(q.triangles, 96u);
  EXPECT_EQ(q.edges, 158u);
  EXPECT_EQ(q.boundary_edges, 28u);
  EXPECT_EQ(q.non_regular_edges, 0u);
  EXPECT_EQ(q.orthocenters_outside, 58u);
  EXPECT_EQ(q.edges_not_crossed, 0u);
  EXPECT_EQ(q.well_centered_fraction, 38.0 / 96);
  EXPECT_NEAR(q.min_h_over_l, -0.5607, 5e-5);
  EXPECT_EQ(q.min_d_over_l, 0.5);
  EXPECT_NEAR(q.min_angle_deg, 4.095, 5e-4);
  EXPECT_NEAR(q.max_angle_deg, 138.27, 5e-3);
  const std::array<std::array<double, 3>, 2> hot = {
      {{0.581320957789, 2.836890825582, 2.255569867793}, {5.061732607188, 12.143904187128, 7.082171579940}}};
  for (std::size_t star = 0; star < 3; ++star) {
    EXPECT_NEAR(q.energy[0][star], hot[0][star], 5e-13);
    EXPECT_NEAR(q.energy[1][star], hot[1][star], 5e-12);
    EXPECT_NEAR(q.energy[2][star], hot[1][star], 5e-12) << "regular: E_dT is E_T";
    EXPECT_EQ(q.energy[3][star], kInfinity);
    EXPECT_EQ(q.energy[4][star], kInfinity);
  }
  EXPECT_NEAR(q.energy[5][1], 375.355882218659, 5e-10);
}

// --- public meshes, read in place --------------------------------------------------------------------------

// What follows a keyword of a medit file: the dimension, or how many there are.
std::size_t count_after(std::istream& in, const std::string& keyword) {
  std::string word;
  while (in >> word && word != keyword) {
  }
  std::size_t n = 0;
  in >> n;
  return n;
}

Mesh read_medit(const std::filesystem::path& path) {
  std::ifstream in(path);
  const std::size_t dimension = count_after(in, "Dimension");
  std::vector<Vec2> points(count_after(in, "Vertices"));
  double z = 0;
  int reference = 0;
  for (Vec2& p : points) {
    in >> p.x >> p.y;
    if (dimension == 3) in >> z;
    in >> reference;
  }
  std::vector<std::array<std::int32_t, 3>> triangles(count_after(in, "Triangles"));
  for (auto& t : triangles) {
    in >> t[0] >> t[1] >> t[2] >> reference;
    for (std::int32_t& v : t) --v;
  }
  EXPECT_TRUE(in.good());
  return mesh_of(points, triangles);
}

struct PublicMesh {
  const char* file;
  std::size_t vertices, triangles, outside;
};

TEST(QualityFacts, PublicMeshes) {
  const std::filesystem::path folder = TEMPER_SHARED "/meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  // Counted in rational arithmetic: 128 obtuse triangles of osteonT1, and 44 with an exact right angle.
  for (const PublicMesh& known : {PublicMesh{"sfepy_osteonT1_11.mesh", 1228, 2292, 128 + 44},
                                  PublicMesh{"sfepy_circle_in_square.mesh", 1102, 2102, 67}}) {
    SCOPED_TRACE(known.file);
    const Quality q = quality(read_medit(folder / known.file));
    EXPECT_EQ(q.vertices, known.vertices);
    EXPECT_EQ(q.triangles, known.triangles);
    EXPECT_EQ(q.orthocenters_outside, known.outside);
  }
}

}  // namespace
}  // namespace temper
