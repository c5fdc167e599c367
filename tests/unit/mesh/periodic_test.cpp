// Meshes of periodic planes: what Mesh::build accepts and refuses, and what it says.
#include <gtest/gtest.h>

#include <cmath>

#include "temper/generate.hpp"
#include "temper/mesh.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

using TriangleNumbers = std::array<std::int32_t, 3>;

/// A MeshInput of a periodic plane that owns its arrays.
struct PeriodicArrays {
  Vec2 period;
  std::vector<Vec2> points;
  std::vector<TriangleNumbers> triangles;

  [[nodiscard]] Expected<BuiltMesh> build() const {
    MeshInput input;
    input.space = Space::periodic(period);
    input.points = points;
    input.triangles = triangles;
    return Mesh::build(input);
  }
};

/// nx × ny squares of size 1, cut along a diagonal; the last rows and columns are the first again where the plane is
/// periodic, as it is along x.
PeriodicArrays squares(int nx, int ny, bool along_y = true) {
  PeriodicArrays a;
  a.period = {1.0 * nx, along_y ? 1.0 * ny : 0};
  const int rows = along_y ? ny : ny + 1;
  const auto at = [&](int i, int j) { return (j % rows) * nx + i % nx; };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < nx; ++i) a.points.push_back({1.0 * i, 1.0 * j});
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      a.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      a.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return a;
}

void expect_message(const PeriodicArrays& arrays, ErrorCode code, const std::string& part) {
  const auto built = arrays.build();
  ASSERT_FALSE(built) << part;
  EXPECT_EQ(built.error().code, code) << built.error().message;
  EXPECT_NE(built.error().message.find(part), std::string::npos) << built.error().message;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    area += 0.5 * cross(q.position() - p.position(), r.position() - p.position());
  }
  return area;
}

TEST(PeriodicPlane, AMeshOfBothPeriodsHasNoBoundaryAndCoversTheDomain) {
  for (const auto& [nx, ny] : {std::pair(3, 3), std::pair(3, 7), std::pair(8, 5)}) {
    const auto built = squares(nx, ny).build();
    ASSERT_TRUE(built) << built.error().what();
    const Mesh& mesh = built->mesh;
    EXPECT_FALSE(mesh.validate());
    EXPECT_EQ(mesh.n_vertices() + mesh.n_triangles(), mesh.n_edges());  // Euler's number is 0
    for (const VertexId v : mesh.vertices()) EXPECT_FALSE(mesh.is_boundary(v));
    EXPECT_EQ(area_of(mesh), nx * ny);
  }
}

TEST(PeriodicPlane, AChannelHasTwoShores) {
  const auto built = squares(5, 4, false).build();
  ASSERT_TRUE(built) << built.error().what();
  std::size_t boundary = 0;
  for (const HalfedgeId h : built->mesh.halfedges()) boundary += built->mesh.is_boundary(h);
  EXPECT_EQ(boundary, 10U);
  EXPECT_EQ(area_of(built->mesh), 20);
}

TEST(PeriodicPlane, AnyImagesOfPointsMakeTheSameMesh) {
  const PeriodicArrays arrays = squares(4, 6);
  PeriodicArrays images = arrays;
  for (std::size_t i = 0; i < images.points.size(); ++i) {
    images.points[i].x += 4.0 * (static_cast<double>(i % 5) - 2);
    images.points[i].y -= 6.0 * static_cast<double>(i % 3);
  }
  const auto one = arrays.build(), other = images.build();
  ASSERT_TRUE(one && other);
  EXPECT_TRUE(one->mesh == other->mesh);
}

TEST(PeriodicPlane, WhatIsWrongIsNamed) {
  expect_message(squares(2, 5), ErrorCode::overlap, "triangle 0 does not fit into half a period");
  // Edges all below half a period, but around it: there is no such triangle.
  PeriodicArrays around = squares(6, 6);
  around.triangles[0] = {0, 2, 4};
  expect_message(around, ErrorCode::overlap, "triangle 0 does not fit into half a period");
  PeriodicArrays flat = squares(6, 6);
  flat.triangles[0] = {0, 1, 2};
  expect_message(flat, ErrorCode::zero_area, "are collinear");
  PeriodicArrays twice = squares(6, 6);
  const PeriodicArrays again = squares(6, 6);
  for (const Vec2 p : again.points) twice.points.push_back({p.x + 0.25, p.y + 0.125});
  for (auto t : again.triangles) {
    for (auto& i : t) i += 36;
    twice.triangles.push_back(t);
  }
  expect_message(twice, ErrorCode::overlap, "the mesh is of 2 pieces");
  PeriodicArrays folded = squares(6, 6);
  folded.points[14] = {3.2, 2.6};
  expect_message(folded, ErrorCode::overlap, "lie on the same side");
}

// Six columns of squares go around a period of three twice; no star sees that.
TEST(PeriodicPlane, AMeshThatGoesAroundTwiceIsRefused) {
  PeriodicArrays arrays = squares(8, 4);
  arrays.period.x = 4;
  expect_message(arrays, ErrorCode::duplicate_point, "are both at");
  for (std::size_t i = 0; i < arrays.points.size(); ++i) {
    if (i % 8 >= 4) arrays.points[i] = {arrays.points[i].x + 0.25, arrays.points[i].y + 0.125};
  }
  expect_message(arrays, ErrorCode::overlap, "covers it more than once");
}

TEST(PeriodicPlane, BoundariesThatMeetAcrossThePeriodAreFound) {
  // Five columns of a channel of six, and a finger on the left that reaches around into the right one.
  PeriodicArrays arrays = squares(6, 2, false);
  std::erase_if(arrays.triangles, [](const TriangleNumbers& t) { return t[0] % 6 == 5; });
  ASSERT_TRUE(arrays.build());
  arrays.points[6] = {4.9, 1};  // the middle of the left end, now beyond the right one
  const auto built = arrays.build();
  ASSERT_FALSE(built);
  EXPECT_EQ(built.error().code, ErrorCode::overlap) << built.error().message;
}

TEST(PeriodicPlane, ImagesAreExact) {
  const Space space = Space::periodic({0.7, 3.1});
  const auto [a, b] = space.period();
  EXPECT_NEAR(a, 0.7, 1e-14);
  for (const Vec2 at : {Vec2{0.1, 0.2}, Vec2{-5.3, 17.7}, Vec2{0.7, 3.1}, Vec2{-1e-18, -1e-18}}) {
    const WeightedPoint p = space.in_domain({at.x, at.y, 2});
    EXPECT_TRUE(p.x >= 0 && p.x < a && p.y >= 0 && p.y < b) << p.x << " " << p.y;
    EXPECT_EQ(space.in_domain(p), p);
    for (int m = -3; m <= 3; ++m) {
      const WeightedPoint image = {p.x + m * a, p.y - m * b, 2};
      EXPECT_EQ(image.x - m * a, p.x);
      EXPECT_EQ(image.y + m * b, p.y);
      EXPECT_EQ(space.image(image, p), p);
      EXPECT_EQ(space.image(p, image), image);
    }
  }
}

TEST(PeriodicPlane, MeasuresOfCopiesAreThoseOfOne) {
  const auto one = random_periodic({.vertices = 200, .seed = 3, .period = {1, 2}});
  ASSERT_TRUE(one) << one.error().what();
  constexpr int kCopies = 3;
  PeriodicArrays copies;
  copies.period = {kCopies * one->space().period().x, kCopies * one->space().period().y};
  const auto n = static_cast<std::int32_t>(one->n_vertices());
  for (int j = 0; j < kCopies; ++j) {
    for (int i = 0; i < kCopies; ++i) {
      for (const VertexId v : one->vertices()) {
        const WeightedPoint p = one->point(v);
        copies.points.push_back({p.x + i * one->space().period().x, p.y + j * one->space().period().y});
      }
    }
  }
  // The copy of a corner is that of the first one, unless its image is around the period from there.
  const auto [a, b] = one->space().period();
  for (int j = 0; j < kCopies; ++j) {
    for (int i = 0; i < kCopies; ++i) {
      for (const TriangleId t : one->triangles()) {
        const auto points = one->points(t);
        TriangleNumbers corners{};
        for (std::size_t k = 0; k < 3; ++k) {
          const auto shift = [](double x, double period) { return static_cast<int>(std::floor(x / period)); };
          const int to_i = (i + shift(points[k].x, a) + kCopies) % kCopies;
          const int to_j = (j + shift(points[k].y, b) + kCopies) % kCopies;
          corners[k] = (to_j * kCopies + to_i) * n + static_cast<std::int32_t>(one->corners(t)[k].index);
        }
        copies.triangles.push_back(corners);
      }
    }
  }
  const auto built = copies.build();
  ASSERT_TRUE(built) << built.error().what();
  const Quality q = quality(*one), all = quality(built->mesh);
  EXPECT_EQ(all.edges, kCopies * kCopies * q.edges);
  EXPECT_EQ(all.non_regular_edges, 0U);
  EXPECT_EQ(all.orthocenters_outside, kCopies * kCopies * q.orthocenters_outside);
  EXPECT_NEAR(all.min_h_over_l, q.min_h_over_l, 1e-9);
  EXPECT_NEAR(all.max_angle_deg, q.max_angle_deg, 1e-9);
  EXPECT_NEAR(all.max_orthogonality, q.max_orthogonality, 1e-9);
  EXPECT_NEAR(all.max_centroid_offset_over_size, q.max_centroid_offset_over_size, 1e-9);
  EXPECT_NEAR(all.transmissibility_ratio / q.transmissibility_ratio, 1, 1e-9);
  for (std::size_t e = 0; e < q.energy.size(); ++e) {
    for (std::size_t star = 0; star < 3; ++star) {
      if (!std::isfinite(q.energy[e][star])) continue;
      EXPECT_NEAR(all.energy[e][star] / (kCopies * kCopies * q.energy[e][star]), 1, 1e-9) << e << " " << star;
    }
  }
}

}  // namespace
}  // namespace temper
