// Laws of size fields: linear ones are reproduced, samples are a function of the point alone, beyond the mesh the
// nearest value holds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "location/box_tree.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"

namespace temper::test {
namespace {

constexpr double kRounding = 1e-14;  // relative to the greatest value: interpolation is a few operations

double linear(Vec2 p) { return 3 + 0.25 * p.x - 0.125 * p.y; }

SizeField field_of(const Mesh& mesh, double (*f)(Vec2)) {
  std::vector<double> sizes;
  for (const VertexId v : mesh.vertices()) sizes.push_back(f(mesh.position(v)));
  auto field = SizeField::from_values(mesh, sizes);
  EXPECT_TRUE(field.has_value());
  return *field;
}

Vec2 at_weights(const Mesh& mesh, TriangleId t, double u, double v) {
  const auto [a, b, c] = mesh.corners(t);
  const Vec2 p = mesh.position(a);
  return p + u * (mesh.position(b) - p) + v * (mesh.position(c) - p);
}

/// A square ring: a domain with a hole.
Mesh ring() { return *annulus(); }

TEST(SizeField, OfASphereIsExactAtItsVerticesAndWhatSizesAreComparedWith) {
  const Mesh mesh = *random_sphere({.vertices = 200, .radius = 10});
  std::vector<double> sizes;
  for (const VertexId v : mesh.vertices()) sizes.push_back(1 + static_cast<double>(v.index));
  const SizeField field = *SizeField::from_values(mesh, sizes);
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(field.at(mesh.space().with_weight(mesh.point(v), 3)).size, sizes[v.index]) << "weights do not count";
  }
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec3 middle = mesh.weighted_vector(a) + mesh.weighted_vector(b) + mesh.weighted_vector(c);
    const SizeField::Sample sample = field.at(as_point(middle), t);
    EXPECT_EQ(sample.triangle, t);
    EXPECT_NEAR(sample.size, (sizes[a.index] + sizes[b.index] + sizes[c.index]) / 3, 1e-9);
  }
  EXPECT_EQ(measure_size(mesh, input_size_field(mesh)).band(), 1);
}

TEST(DepthSizes, FollowTheWaveBetweenTheirBounds) {
  const DepthSizes rules = {.per_wavelength = 40, .period = 600, .least = 50, .largest = 2000};
  const std::vector<double> depths = {-3, 0, std::numeric_limits<double>::quiet_NaN(), 1, 25, 100, 1e6};
  const std::vector<double> sizes = *sizes_from_depths(depths, rules);
  const std::vector<double> expected = {50, 50, 50, 50, 15 * std::sqrt(9.81 * 25), 15 * std::sqrt(9.81 * 100), 2000};
  ASSERT_EQ(sizes.size(), expected.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) EXPECT_DOUBLE_EQ(sizes[i], expected[i]) << i;
}

TEST(DepthSizes, KeepTheCourantNumberEvenAboveTheLargestSize) {
  const DepthSizes rules = {.per_wavelength = 100, .time_step = 20, .courant = 0.5, .least = 30, .largest = 1000};
  for (const double depth : {0.1, 5.0, 300.0, 9000.0}) {
    const double size = (*sizes_from_depths(std::array{depth}, rules))[0], speed = std::sqrt(9.81 * depth);
    EXPECT_LE(speed * rules.time_step / size, rules.courant * (1 + 1e-12));
    EXPECT_GE(size, rules.least);
  }
  const std::vector<double> alone = *sizes_from_depths(std::array{10.0}, {.time_step = 4, .least = 1});
  EXPECT_DOUBLE_EQ(alone[0], 4 * std::sqrt(98.1));
}

TEST(DepthSizes, RulesAreNumbersAboveZero) {
  const std::array depths = {1.0};
  for (const DepthSizes& wrong :
       {DepthSizes{.least = 1}, DepthSizes{.per_wavelength = 1}, DepthSizes{.per_wavelength = -1, .least = 1},
        DepthSizes{.per_wavelength = 1, .courant = 0, .least = 1},
        DepthSizes{.per_wavelength = 1, .least = 2, .largest = 1},
        DepthSizes{.time_step = std::numeric_limits<double>::infinity(), .least = 1}}) {
    EXPECT_FALSE(sizes_from_depths(depths, wrong));
  }
}

TEST(SizeField, IsExactAtTheVerticesFromAnyHint) {
  const Mesh mesh = *random_mesh({200, 3, {}});
  Noise noise(1);
  std::vector<double> sizes;
  for (std::size_t i = 0; i < mesh.n_vertices(); ++i) sizes.push_back(std::exp(5 * noise()));  // nothing cancels
  const SizeField field = *SizeField::from_values(mesh, sizes);
  for (const VertexId v : mesh.vertices()) {
    for (const TriangleId hint : {TriangleId(), TriangleId(0), Mesh::triangle(mesh.outgoing(v))}) {
      const SizeField::Sample sample = field.at(mesh.position(v), hint);
      EXPECT_EQ(sample.size, sizes[v.index]);
      EXPECT_FALSE(sample.outside);
    }
  }
}

TEST(SizeField, ReproducesLinearFieldsBetweenTheVertices) {
  const Mesh mesh = *random_mesh({200, 4, {}});
  const SizeField field = field_of(mesh, linear);
  Noise noise(5);
  int asked = 0;
  for (const TriangleId t : mesh.triangles()) {
    const double u = 0.5 + 0.49 * noise(), v = (1 - u) * (0.5 + 0.49 * noise());
    const Vec2 p = at_weights(mesh, t, u, v);
    const SizeField::Sample sample = field.at(p);
    EXPECT_NEAR(sample.size, linear(p), 4 * kRounding);
    EXPECT_EQ(sample.triangle, t);
    ++asked;
  }
  EXPECT_GT(asked, 200);
}

TEST(SizeField, IsAFunctionOfThePointWhateverTheHint) {
  const Mesh mesh = ring();
  const SizeField field = input_size_field(mesh);
  Noise noise(7);
  int outside = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec2 p{1.2 * noise(), 1.2 * noise()};
    const SizeField::Sample first = field.at(p);
    outside += first.outside ? 1 : 0;
    for (int j = 0; j < 5; ++j) {
      const TriangleId hint(static_cast<std::size_t>((0.5 + 0.5 * noise()) * 0.999 * double(mesh.n_triangles())));
      const SizeField::Sample sample = field.at(p, hint);
      EXPECT_EQ(sample.size, first.size);
      EXPECT_EQ(sample.outside, first.outside);
    }
  }
  EXPECT_GT(outside, 100);
  EXPECT_LT(outside, 400);
}

TEST(SizeField, SaysTheSameOnBothSidesOfAnEdge) {
  const Mesh mesh = *sheared_grid({.nx = 8, .ny = 8, .shear = 0.5});  // midpoints of edges are exact here
  std::vector<double> sizes;
  Noise noise(2);
  for (std::size_t i = 0; i < mesh.n_vertices(); ++i) sizes.push_back(2 + noise());
  const SizeField field = *SizeField::from_values(mesh, sizes);
  int edges = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) continue;
    const Vec2 a = mesh.position(mesh.origin(h)), b = mesh.position(mesh.target(h));
    const Vec2 p = a + 0.5 * (b - a);
    if (orient2d(a, b, p) != Sign::zero) continue;
    EXPECT_EQ(field.at(p, Mesh::triangle(h)).size, field.at(p, Mesh::triangle(mesh.twin(h))).size);
    ++edges;
  }
  EXPECT_GT(edges, 100);
}

TEST(SizeField, ExtendsByTheNearestValue) {
  const Mesh mesh = mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
  const std::vector<double> sizes = {1, 2, 4, 3};
  const SizeField field = *SizeField::from_values(mesh, sizes);
  for (const TriangleId hint : {TriangleId(), TriangleId(0), TriangleId(1)}) {
    EXPECT_EQ(field.at(Vec2{-1, -2}, hint).size, 1);     // beyond a corner
    EXPECT_EQ(field.at(Vec2{0.5, -3}, hint).size, 1.5);  // beyond the middle of an edge
    EXPECT_EQ(field.at(Vec2{5, 0.25}, hint).size, 2.5);
    EXPECT_TRUE(field.at(Vec2{5, 0.25}, hint).outside);
  }
}

TEST(SizeField, FindsTheNearestPointOfAMeshWithHoles) {
  const Mesh mesh = ring();
  const SizeField field = input_size_field(mesh);
  const BoxTree tree(mesh);
  Noise noise(11);
  int outside = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec2 p{1.5 * noise(), 1.5 * noise()};
    double nearest2 = std::numeric_limits<double>::infinity();  // by looking at all boundary edges
    for (const HalfedgeId h : mesh.halfedges()) {
      if (!mesh.is_boundary(h)) continue;
      const Vec2 a = mesh.position(mesh.origin(h)), ab = mesh.position(mesh.target(h)) - a;
      const double t = std::clamp(dot(p - a, ab) / squared_length(ab), 0.0, 1.0);
      nearest2 = std::min(nearest2, squared_length(p - a - t * ab));
    }
    const NearestPoint found = tree.nearest(mesh, {p.x, p.y, 0});
    EXPECT_EQ(found.distance2 > 0, field.at(p).outside);
    if (found.distance2 == 0) continue;
    EXPECT_NEAR(found.distance2, nearest2, kRounding);
    ++outside;
  }
  EXPECT_GT(outside, 50);
}

TEST(SizeField, ScalesWithTheUnitOfLength) {
  const Mesh mesh = lattice({.n = 6, .jitter = 0.2});
  const Mesh larger = lattice({.n = 6, .jitter = 0.2, .scale = 1024});  // a power of two: no rounding
  const SizeField field = input_size_field(mesh), same = input_size_field(larger);
  Noise noise(3);
  for (int i = 0; i < 100; ++i) {
    const Vec2 p{4 + 4 * noise(), 2 + 3 * noise()};
    EXPECT_EQ(1024 * field.at(p).size, same.at(1024.0 * p).size);
  }
}

TEST(SizeField, OutlivesTheMeshItWasMadeOf) {
  Mesh mesh = lattice();
  const double size = local_size(mesh, VertexId(7));
  const SizeField field = input_size_field(mesh);
  const SizeField copy = field;
  const Vec2 p = mesh.position(VertexId(7));
  mesh = Mesh();
  EXPECT_EQ(copy.at(p).size, size);
  EXPECT_EQ(copy.mesh().position(VertexId(7)), p);
}

TEST(SizeField, RefusesSizesThatAreNone) {
  const Mesh mesh = one_triangle({0, 0}, {1, 0}, {0, 1});
  const auto refused = [&mesh](std::vector<double> sizes, ErrorCode code, const char* message) {
    const auto field = SizeField::from_values(mesh, sizes);
    ASSERT_FALSE(field.has_value());
    EXPECT_EQ(field.error().code, code);
    EXPECT_EQ(field.error().message, message);
  };
  refused({1, 1}, ErrorCode::size_mismatch, "the size field has 2 sizes; expected one for each of the 3 vertices");
  refused({1, 0, 1}, ErrorCode::invalid_option, "point 1 has size 0; expected a finite, positive length");
  refused({1, 1, -2}, ErrorCode::invalid_option, "point 2 has size -2; expected a finite, positive length");
  refused({std::numeric_limits<double>::quiet_NaN(), 1, 1}, ErrorCode::not_finite,
          "point 0 has size nan; expected a finite, positive length");
}

}  // namespace
}  // namespace temper::test
