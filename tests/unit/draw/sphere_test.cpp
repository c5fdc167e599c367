// Spheres in pictures: the near half, projected at right angles, ends at the limb.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "draw/viewport.hpp"
#include "temper/draw.hpp"
#include "temper/generate.hpp"
#include "unit/draw/svg_reading.hpp"

namespace temper {
namespace {

constexpr double kRadius = 6371;

WeightedPoint at_degrees(double lon, double lat) {
  const double l = lon * std::numbers::pi / 180, b = lat * std::numbers::pi / 180;
  return {kRadius * std::cos(b) * std::cos(l), kRadius * std::cos(b) * std::sin(l), kRadius * std::sin(b)};
}

void expect_near(Vec2 p, Vec2 q) { EXPECT_LT(length(p - q), 1e-9 * kRadius) << p.x << " " << p.y; }

double area(const std::vector<Vec2>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
  return twice / 2;
}

Mesh globe(int level = 3) { return *icosahedral({.level = level, .radius = kRadius}); }

TEST(View, HasTheMiddleInTheMiddleAndNorthUp) {
  const View view(kRadius, {30, 40});
  expect_near(view.at(at_degrees(30, 40)), {0, 0});
  expect_near(view.at(at_degrees(120, 0)), {kRadius, 0});
  const Vec2 pole = view.at({0, 0, kRadius});
  expect_near(pole, {0, kRadius * std::cos(40 * std::numbers::pi / 180)});
  EXPECT_TRUE(view.shows({0, 0, 1}));
  EXPECT_FALSE(view.shows({0, 0, -1}));
}

TEST(View, CutsLinesAtTheLimb) {
  const View view(kRadius, {0, 0});
  const auto crossing = view.line(at_degrees(80, 20), at_degrees(110, 20));
  ASSERT_GT(crossing.size(), 2U);
  EXPECT_NEAR(length(crossing.back()), kRadius, 1e-9 * kRadius);
  expect_near(crossing.front(), view.at(at_degrees(80, 20)));
  const auto back = view.line(at_degrees(110, 20), at_degrees(80, 20));
  expect_near(back.front(), crossing.back());
  EXPECT_TRUE(view.line(at_degrees(100, 0), at_degrees(170, 30)).empty());
  // A meridian is half an ellipse, not a chord.
  for (const Vec2 p : view.line(at_degrees(45, -60), at_degrees(45, 60))) {
    EXPECT_NEAR(2 * p.x * p.x + p.y * p.y, kRadius * kRadius, 1e-6 * kRadius * kRadius);
  }
}

TEST(View, TrianglesOfAClosedMeshCoverTheDiscOnce) {
  for (const Vec2 middle : {Vec2{0, 0}, Vec2{77, -33}, Vec2{-180, 90}}) {
    const View view(kRadius, middle);
    double sum = 0;
    const Mesh mesh = globe();
    for (const TriangleId t : mesh.triangles()) {
      const auto [a, b, c] = mesh.corners(t);
      const double part = area(view.polygon({mesh.point(a), mesh.point(b), mesh.point(c)}));
      EXPECT_GT(part, -1e-5 * kRadius * kRadius) << "chords of slivers at the limb";
      sum += part;
    }
    EXPECT_NEAR(sum / (std::numbers::pi * kRadius * kRadius), 1, 1e-3);
  }
}

TEST(View, IsOfTheMiddleOfAPartOfTheSphere) {
  const std::array<Vec3, 3> points = {as_vector(at_degrees(100, 0)), as_vector(at_degrees(140, 0)),
                                      as_vector(at_degrees(120, 30))};
  const std::array<std::array<std::int32_t, 3>, 1> triangles = {{{0, 1, 2}}};
  MeshInput input;
  input.space = Space::sphere(kRadius);
  input.sphere_points = points;
  input.triangles = triangles;
  const Mesh part = Mesh::build(input)->mesh, whole = globe();
  const std::array<const Mesh*, 1> one = {&part}, all = {&whole};
  expect_near({make_view(one, {}).at(at_degrees(120, 0)).x, 0}, {0, 0});
  expect_near(make_view(all, {}).at(at_degrees(0, 0)), {0, 0});
  DrawOptions asked;
  asked.view = Vec2{10, 20};
  expect_near(make_view(one, asked).at(at_degrees(10, 20)), {0, 0});
}

TEST(DrawSphere, IsWellFormedAndShowsAboutHalfOfTheMesh) {
  Mesh mesh = *random_sphere({.vertices = 500, .radius = kRadius});
  mesh.set_weight(VertexId(3), 1e4), mesh.set_weight(VertexId(4), -1e4), mesh.set_weight(VertexId(5), 1e4);
  DrawOptions options;
  options.vertex_numbers = true;
  const std::string svg = draw_svg(mesh, options);
  test::expect_well_formed(svg);
  for (const char* name : {"bad", "limb", "primal", "dual"}) {
    EXPECT_EQ(test::count(svg, std::string("class=\"") + name + "\""), 1U) << name;
  }
  EXPECT_NE(svg.find("(whole mesh)"), std::string::npos);
  options.dual = false;
  const std::string front = draw_svg(mesh, options);
  options.view = Vec2{180, 0};
  const std::string back = draw_svg(mesh, options);
  EXPECT_EQ(test::count(front, "<text x") + test::count(back, "<text x"),
            500U + 2 * 3);  // of each a caption and two keys
}

TEST(DrawSphere, HasTheScaleOfBothPanels) {
  const Mesh mesh = globe(2);
  const std::string svg = draw_before_after_svg(mesh, mesh);
  EXPECT_EQ(test::count(svg, "class=\"limb\""), 2U);
  test::expect_well_formed(svg);
}

}  // namespace
}  // namespace temper
