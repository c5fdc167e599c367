// What solvers look at: laws, exact values of regular lattices, a mesh by hand, and a naive twin on random meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include "geometry/flow_cell.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/size.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

using test::lattice;
using test::LatticeOptions;
using test::mesh_of;

constexpr double kClose = 1e-9;  // of doubles that a few hundred operations made, of lengths that nearly cancel

double number(const Quality& q, std::string_view key) {
  for (const QualityMeasure& m : quality_measures()) {
    if (m.key == key) return m.of(q);
  }
  ADD_FAILURE() << key;
  return 0;
}

Mesh changed(Mesh mesh, double factor, double turn, Vec2 shift) {
  const double c = std::cos(turn), s = std::sin(turn);
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    mesh.set_point(
        v, {factor * (c * p.x - s * p.y) + shift.x, factor * (s * p.x + c * p.y) + shift.y, factor * factor * p.w});
  }
  return mesh;
}

Mesh with_weights(Mesh mesh) {
  test::Noise noise(7);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.1 * noise());
  return mesh;
}

TEST(QualityMeasures, HaveOneNameEachAndADefinition) {
  std::set<std::string_view> names;
  for (const QualityMeasure& m : quality_measures()) {
    EXPECT_TRUE(names.insert(m.key).second) << m.key;
    if (!m.alias.empty()) {
      EXPECT_TRUE(names.insert(m.alias).second) << m.alias;
    }
    EXPECT_FALSE(m.label.empty() || m.definition.empty()) << m.key;
  }
}

TEST(SolverMeasures, OfEquilateralTrianglesAreAllIdeal) {
  for (const double scale : {1.0, 0.25, 3e5}) {
    const Quality q = quality(lattice({.n = 6, .jitter = 0, .weight = 0, .scale = scale}));
    EXPECT_NEAR(q.min_edge_over_size, 1, kClose);
    EXPECT_NEAR(q.min_dual_over_size, 1 / std::numbers::sqrt3, kClose);
    EXPECT_NEAR(q.min_dual_over_cell_median, 1, kClose);
    EXPECT_NEAR(q.transmissibility_ratio, 1, kClose);
    EXPECT_NEAR(q.max_orthogonality, 0, kClose);
    EXPECT_NEAR(q.max_smoothness, 1, kClose);
    EXPECT_NEAR(q.min_flow_link, (1 / std::numbers::sqrt3) / std::sqrt(std::sqrt(3.0) / 4), kClose);
    EXPECT_EQ(q.small_flow_links, 0u);
    EXPECT_NEAR(q.min_cell_quality, 1, kClose);
    EXPECT_NEAR(q.min_grid_spacing, scale, kClose * scale);
    EXPECT_NEAR(q.max_grid_spacing, scale, kClose * scale);
    EXPECT_NEAR(q.min_triangle_quality, 1, kClose);
    EXPECT_NEAR(q.min_triangle_angle_quality, 1, kClose);
    EXPECT_EQ(q.obtuse_triangles, 0u);
    EXPECT_NEAR(q.max_centroid_offset_over_size, 0, kClose);
  }
}

// Squares of side 1, all cut along the same diagonal: circumcenters meet in the middle of diagonals, cells are squares.
TEST(SolverMeasures, OfSquaresCutInTwoSayThatDiagonalsHaveNoDuals) {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) points.push_back({double(i), double(j)});
  }
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      const int a = 4 * j + i;
      triangles.push_back({a, a + 1, a + 5});
      triangles.push_back({a, a + 5, a + 4});
    }
  }
  const Quality q = quality(mesh_of(points, triangles));
  EXPECT_EQ(q.min_dual_over_size, 0);
  EXPECT_EQ(q.min_dual_over_cell_median, 0);
  EXPECT_EQ(q.transmissibility_ratio, std::numeric_limits<double>::infinity());
  EXPECT_EQ(q.min_flow_link, 0);
  EXPECT_EQ(q.small_flow_links, 9u);
  EXPECT_EQ(q.max_orthogonality, 0) << "links without length have no direction";
  EXPECT_EQ(q.min_cell_quality, 0);
  EXPECT_EQ(q.obtuse_triangles, 0u) << "right angles are not";
  EXPECT_NEAR(q.min_triangle_quality, std::sqrt(0.5), kClose);
  EXPECT_NEAR(q.min_triangle_angle_quality, 0.5, kClose);
  EXPECT_NEAR(q.max_centroid_offset_over_size, 0, kClose);
}

// Edge ab from (0, 0) to (4, 0). Above it c = (2, 1), obtuse: the circumcenter (2, −3/2) is clamped to the edge, (2,
// 0). Below it d = (1, −3): circumcenter (2, −1), inside. So the link goes straight down, of length 1, and areas are 2
// and 6.
TEST(SolverMeasures, OfTwoTrianglesAreAsByHand) {
  const Quality q = quality(mesh_of({{0, 0}, {4, 0}, {2, 1}, {1, -3}}, {{0, 1, 2}, {1, 0, 3}}));
  EXPECT_NEAR(q.max_orthogonality, 0, kClose);
  EXPECT_NEAR(q.max_smoothness, 3, kClose);
  EXPECT_NEAR(q.min_flow_link, 1 / (0.5 * (std::sqrt(2) + std::sqrt(6))), kClose);
  EXPECT_EQ(q.small_flow_links, 0u);
  EXPECT_EQ(q.obtuse_triangles, 1u);
  EXPECT_NEAR(q.min_triangle_quality, std::sqrt(5.0) / 4, kClose);
  EXPECT_NEAR(q.min_triangle_angle_quality, std::atan2(1, 2) / (std::numbers::pi - 2 * std::atan2(1, 2)), kClose);
  // Both ends of ab: mean area 4.
  const double size = std::sqrt(4 / std::sqrt(3.0) * 4);
  EXPECT_NEAR(q.min_edge_over_size, 4 / size, kClose);
  EXPECT_NEAR(q.min_dual_over_size, (-1.5 + 1) / size, kClose) << "orthocenters have changed places";
  EXPECT_EQ(q.transmissibility_ratio, 1);
  EXPECT_EQ(q.min_cell_quality, std::numeric_limits<double>::infinity()) << "no cell is closed";
  EXPECT_EQ(q.max_centroid_offset_over_size, 0);
  EXPECT_NEAR(q.min_grid_spacing, std::sqrt(5.0), kClose);
  EXPECT_NEAR(q.max_grid_spacing, (std::sqrt(10.0) + std::sqrt(18.0)) / 2, kClose);
}

// c = (1, 1) over the same edge: the way from the centroid (5/3, 1/3) to (2, −1) is at (7/4, 0) when it leaves. From
// d = (2, −4) comes (2, −3/2).
TEST(SolverMeasures, OrthogonalityIsThatOfCircumcentersKeptInside) {
  const Quality q = quality(mesh_of({{0, 0}, {4, 0}, {1, 1}, {2, -4}}, {{0, 1, 2}, {1, 0, 3}}));
  EXPECT_NEAR(q.max_orthogonality, 0.25 / std::hypot(0.25, 1.5), kClose);
}

/// By hand: the bisectors of two sides meet in the center; of one side, the center is the mean of the corners; of four
/// sides of a kite it is the point nearest to all bisectors, found by Gauss's normal equations.
TEST(FlowCell, OfAQuadrilateralIsNearestToTheBisectorsOfItsInnerSides) {
  const std::array<Vec3, 4> p = {{{0, 0, 0}, {4, 0, 0}, {5, 3, 0}, {0, 4, 0}}};
  const auto center = [&](std::array<bool, 4> inner) { return flow_cell(p, inner).center; };
  EXPECT_NEAR(length(center({true, false, false, true}) - Vec3{2, 2, 0}), 0, 1e-14);
  EXPECT_NEAR(length(center({true, false, false, false}) - Vec3{2.25, 1.75, 0}), 0, 1e-14);
  EXPECT_DOUBLE_EQ(flow_cell(p, {}).area, 16);
  // Two parallel sides leave one direction free: the center keeps the height of the mean.
  const std::array<Vec3, 4> trapezoid = {{{0, 0, 0}, {4, 0, 0}, {3, 2, 0}, {2, 2, 0}}};
  EXPECT_NEAR(length(flow_cell(trapezoid, {true, false, true, false}).center - Vec3{2.25, 1, 0}), 0, 1e-14);
  // The gradient of the sum of squares vanishes at the center of four sides, which is inside.
  const Vec3 c = center({true, true, true, true});
  Vec3 gradient;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 side = p[(k + 1) % 4] - p[k], along = (1 / length(side)) * side;
    gradient = gradient + dot(c - p[k] - 0.5 * side, along) * along;
  }
  EXPECT_NEAR(length(gradient), 0, 1e-14);
  // The bisectors x = 2 and 2.5 (x - 4.25) + y = 0.1 meet at y = 5.725: the center stays on the upper side.
  const std::array<Vec3, 4> thin = {{{0, 0, 0}, {4, 0, 0}, {4.5, 0.2, 0}, {0, 0.2, 0}}};
  const Vec3 on_side = flow_cell(thin, {true, true, false, false}).center;
  EXPECT_NEAR(on_side.y, 0.2, 1e-14);
}

TEST(SolverMeasures, DoNotChangeWhenTheMeshIsTurnedMovedOrScaled) {
  const Mesh mesh = lattice({.n = 9, .jitter = 0.25, .weight = 0.1, .seed = 3});
  const Quality before = quality(mesh), after = quality(changed(mesh, 3, 0.7, {5, -2}));
  for (const QualityMeasure& m : quality_measures()) {
    if (m.community.empty()) continue;
    const double factor = m.key.find("grid_spacing") != std::string_view::npos ? 3 : 1;
    EXPECT_NEAR(m.of(after) / (factor * m.of(before)), 1, 1e-7) << m.key;
  }
}

TEST(SolverMeasures, OfDFlowFMKnowNoWeights) {
  const Quality without = quality(lattice({.n = 8, .jitter = 0.2, .weight = 0, .seed = 5})),
                with = quality(with_weights(lattice({.n = 8, .jitter = 0.2, .weight = 0, .seed = 5})));
  for (const QualityMeasure& m : quality_measures()) {
    if (m.community == "D-Flow FM") {
      EXPECT_EQ(m.of(without), m.of(with)) << m.key;
    }
  }
}

// --- the twin: a list of points and triangles, circumcenters by solving for them, cells as polygons
// --------------------

struct Naive {
  const Mesh& mesh;

  Vec2 at(VertexId v) const { return mesh.position(v); }
  double size(VertexId v) const {
    double area = 0;
    int n = 0;
    for (const TriangleId t : mesh.triangles()) {
      const auto c = mesh.corners(t);
      if (std::find(c.begin(), c.end(), v) != c.end()) area += area_of(t), ++n;
    }
    return std::sqrt(4 / std::sqrt(3.0) * area / n);
  }
  double area_of(TriangleId t) const {
    const auto [a, b, c] = mesh.corners(t);
    return cross(at(b) - at(a), at(c) - at(a)) / 2;
  }
  Vec2 center(TriangleId t, bool weighted) const {
    const auto [a, b, c] = mesh.corners(t);
    const auto right = [&](VertexId v) {
      return 0.5 * (dot(at(v), at(v)) - dot(at(a), at(a)) - (weighted ? mesh.weight(v) - mesh.weight(a) : 0));
    };
    const Vec2 u = at(b) - at(a), v = at(c) - at(a);
    const double det = cross(u, v);
    return {(right(b) * v.y - right(c) * u.y) / det, (u.x * right(c) - v.x * right(b)) / det};
  }
  /// By bisection of the way from the centroid.
  Vec2 clamped(TriangleId t) const {
    const auto [a, b, c] = mesh.corners(t);
    const Vec2 middle = (1.0 / 3) * (at(a) + at(b) + at(c)), o = center(t, false);
    const auto inside = [&](Vec2 p) {
      return cross(at(b) - at(a), p - at(a)) >= 0 && cross(at(c) - at(b), p - at(b)) >= 0 &&
             cross(at(a) - at(c), p - at(c)) >= 0;
    };
    if (inside(o)) return o;
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
      const double s = 0.5 * (low + high);
      (inside(middle + s * (o - middle)) ? low : high) = s;
    }
    return middle + low * (o - middle);
  }
  double dual(HalfedgeId h) const {
    const Vec2 along = at(mesh.target(h)) - at(mesh.origin(h));
    const Vec2 way = center(Mesh::triangle(h), true) - center(Mesh::triangle(mesh.twin(h)), true);
    return cross(along, way) / length(along);
  }
};

TEST(SolverMeasures, AreThoseOfANaiveTwinOnRandomMeshes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = lattice({.n = 7, .jitter = 0.3, .weight = seed % 2 == 0 ? 0.0 : 0.1, .seed = seed});
    const Naive naive{mesh};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double edge = infinity, dual = infinity, link = infinity, ortho = 0, smooth = 1, cell = infinity, median = infinity,
           offset = 0;
    std::size_t small = 0, obtuse = 0;
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_boundary(h) || mesh.twin(h) < h) continue;
      const VertexId a = mesh.origin(h), b = mesh.target(h);
      const double size = (naive.size(a) + naive.size(b)) / 2;
      const Vec2 along = naive.at(b) - naive.at(a);
      edge = std::min(edge, length(along) / size);
      dual = std::min(dual, naive.dual(h) / size);
      const TriangleId s = Mesh::triangle(h), t = Mesh::triangle(mesh.twin(h));
      const Vec2 way = naive.clamped(t) - naive.clamped(s);
      ortho = std::max(ortho, std::abs(dot(way, along)) / length(way) / length(along));
      const double relative = length(way) / ((std::sqrt(naive.area_of(s)) + std::sqrt(naive.area_of(t))) / 2);
      link = std::min(link, relative);
      small += relative < 0.1;
      smooth = std::max({smooth, naive.area_of(s) / naive.area_of(t), naive.area_of(t) / naive.area_of(s)});
    }
    for (const TriangleId t : mesh.triangles()) {
      bool any = false;
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId h = Mesh::halfedge(t, k);
        const Vec2 c = naive.at(mesh.opposite(h));
        any |= dot(naive.at(mesh.origin(h)) - c, naive.at(mesh.target(h)) - c) < 0;
      }
      obtuse += any;
    }
    for (const VertexId v : mesh.vertices()) {
      if (mesh.is_boundary(v)) continue;
      std::vector<double> lengths;
      double least = infinity, area = 0;
      Vec2 moment{0, 0};
      for (const HalfedgeId h : mesh.star(v)) {
        lengths.push_back(std::abs(naive.dual(h)));
        least = std::min(least, naive.dual(h));
        const Vec2 p = naive.center(Mesh::triangle(h), true),
                   q = naive.center(Mesh::triangle(mesh.twin(Mesh::prev(h))), true);
        area += cross(p, q) / 2;
        moment = moment + (cross(p, q) / 6) * (p + q);
      }
      std::sort(lengths.begin(), lengths.end());
      const std::size_t n = lengths.size();
      cell = std::min(cell, lengths.front() / lengths.back());
      median = std::min(median, least / ((lengths[(n - 1) / 2] + lengths[n / 2]) / 2));
      offset = std::max(offset, area > 0 ? length((1 / area) * moment - naive.at(v)) / naive.size(v) : infinity);
    }
    const Quality q = quality(mesh);
    const auto expect = [&](const char* key, double expected) {
      EXPECT_NEAR(number(q, key), expected, 1e-7 * std::max(1.0, std::abs(expected))) << key;
    };
    expect("min_edge_over_size", edge);
    expect("min_dual_over_size", dual);
    expect("min_dual_over_cell_median", median);
    expect("max_orthogonality", ortho);
    expect("max_smoothness", smooth);
    expect("min_flow_link", link);
    expect("small_flow_links", double(small));
    expect("min_cell_quality", cell);
    expect("obtuse_triangles", double(obtuse));
    expect("max_centroid_offset_over_size", offset);
  }
}

// A small patch of a large sphere is nearly flat: all numbers go to those of the plane with the square of its size.
TEST(SolverMeasures, OnALargeSphereAreThoseOfThePlane) {
  const LatticeOptions flat = {.n = 7, .jitter = 0.15, .weight = 0, .seed = 2};
  LatticeOptions curved = flat;
  const Quality plane = quality(lattice(flat));
  std::array<double, 2> worst{};
  for (const int k : {0, 1}) {
    curved.radius = k == 0 ? 1000 : 10000;
    const Quality sphere = quality(lattice(curved));
    for (const QualityMeasure& m : quality_measures()) {
      if (m.community.empty()) continue;
      worst[k] = std::max(worst[k], std::abs(m.of(sphere) - m.of(plane)) / std::max(1.0, std::abs(m.of(plane))));
    }
  }
  EXPECT_LT(worst[0], 1e-3);
  EXPECT_LT(worst[1], worst[0] / 30);
}

}  // namespace
}  // namespace temper
