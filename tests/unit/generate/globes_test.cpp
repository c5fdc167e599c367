// Example meshes of the whole sphere: closed, of the size that they follow, the same for the same seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "temper/detail/geometry.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"

namespace temper::test {
namespace {

Mesh made(const GradedSphere& shape) {
  auto mesh = graded_sphere(shape);
  EXPECT_TRUE(mesh) << mesh.error().what();
  return *std::move(mesh);
}

double area_of(const Mesh& globe) {
  double sum = 0;
  for (const TriangleId t : globe.triangles()) {
    const auto [a, b, c] = globe.corners(t);
    sum += solid_angle(globe.weighted_vector(a), globe.weighted_vector(b), globe.weighted_vector(c));
  }
  return sum;
}

TEST(GradedSphere, CoversTheSphereOnce) {
  const Mesh globe = made({.vertices = 3000, .at = {190, -40}, .radius = 6371000});
  EXPECT_FALSE(globe.validate());
  EXPECT_EQ(globe.n_vertices(), 3000u);
  EXPECT_EQ(globe.n_vertices() + globe.n_triangles(), globe.n_edges() + 2);
  EXPECT_NEAR(area_of(globe), 4 * std::numbers::pi, 1e-11);
}

TEST(GradedSphere, IsTheSameForASeedAndAnotherForAnother) {
  const GradedSphere shape{.vertices = 500, .seed = 7};
  EXPECT_EQ(made(shape), made(shape));
  GradedSphere other = shape;
  other.seed = 8;
  EXPECT_NE(made(shape), made(other));
}

TEST(GradedSphere, HasTheSizesThatItFollows) {
  for (const double ratio : {1.0, 5.0, 30.0}) {
    const GradedSphere shape{.vertices = 20000, .ratio = ratio, .at = {-120, 65}, .radius = 10};
    const Vec3 fine = direction_of(shape.at);
    EXPECT_NEAR(graded_sphere_size(shape, -1.0 * fine) / graded_sphere_size(shape, fine), ratio, 1e-9 * ratio);
    const Mesh globe = made(shape);
    // Sizes of random points scatter: over a sixteenth of the way along the axis their mean squares do not.
    std::vector<double> area(16, 0), count(16, 0);
    for (const VertexId v : globe.vertices()) {
      const Vec3 p = globe.weighted_vector(v);
      const double wanted = graded_sphere_size(shape, p), size = local_size(globe, v);
      const auto part = static_cast<std::size_t>(std::min(15.0, 8 * (1 - dot(p, fine) / length(p))));
      area[part] += size * size / (wanted * wanted);
      ++count[part];
    }
    for (std::size_t i = 0; i < area.size(); ++i) {
      if (count[i] > 200) {
        EXPECT_NEAR(std::sqrt(area[i] / count[i]), 1, 0.15) << "ratio " << ratio << ", part " << i;
      }
    }
    EXPECT_GT(count[0], 200);
  }
}

TEST(GradedSphere, RefusesWhatMakesNoSense) {
  for (const GradedSphere& shape :
       {GradedSphere{.vertices = 19}, GradedSphere{.ratio = 0.9}, GradedSphere{.ratio = 1001},
        GradedSphere{.ratio = std::nan("")}, GradedSphere{.at = {0, 91}}, GradedSphere{.at = {361, 0}},
        GradedSphere{.radius = 0}}) {
    const auto mesh = graded_sphere(shape);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::invalid_option);
  }
}

}  // namespace
}  // namespace temper::test
