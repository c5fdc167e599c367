// Intrinsic triangulations: triangles by their lengths, flips, and operators.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/surface_meshes.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper::surfaces {
namespace {

MetricTriangle by_lengths(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const auto l2 = [](const WeightedPoint& a, const WeightedPoint& b) {
    return squared_length(b.position() - a.position());
  };
  return {l2(p, q), l2(q, r), l2(r, p), p.w, q.w, r.w};
}

TEST(MetricTriangle, HasTheExactSignsOfItsPoints) {
  Rng rng(1);
  const auto random = [&rng] {
    const auto digit = [&rng] { return static_cast<double>(rng.below(5)); };
    return WeightedPoint{digit(), digit(), digit(), digit()};  // whose squared lengths are exact
  };
  std::set<Sign> heights, duals;
  for (int i = 0; i < 3000; ++i) {
    const WeightedPoint p = random(), q = random(), r = random(), s = random();
    const MetricTriangle left = by_lengths(p, q, r), right = by_lengths(q, p, s);
    ASSERT_EQ(is_flat(left), is_flat(p.position(), q.position(), r.position()));
    if (is_flat(left) || is_flat(right)) continue;
    ASSERT_EQ(signed_height_sign(left), signed_height_sign(p, q, r));
    ASSERT_EQ(dual_crossing_sign(left), dual_crossing_sign(p, q));
    ASSERT_EQ(dual_length_sign(left, right), dual_length_sign(p, q, r, s));
    ASSERT_EQ(is_well_centered(left), is_well_centered(p, q, r));
    EXPECT_NEAR(signed_height(left), signed_height(p, q, r), 1e-12);
    EXPECT_NEAR(dual_crossing(left), dual_crossing(p, q), 1e-12);
    EXPECT_NEAR(dual_over_length(left, right), dual_over_length(p, q, r, s), 1e-12);
    heights.insert(signed_height_sign(left)), duals.insert(dual_length_sign(left, right));
  }
  EXPECT_EQ(heights.size(), 3U);
  EXPECT_EQ(duals.size(), 3U);
  EXPECT_TRUE(is_flat({1, 1, 9}));  // no triangle has these lengths
}

using Corners = std::set<std::set<std::uint32_t>>;
Corners corners_of(const Mesh& mesh) {
  Corners all;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    all.insert({a.index, b.index, c.index});
  }
  return all;
}

double area_of(const IntrinsicMesh& mesh) {
  double area = 0;
  for (const TriangleId t : mesh.connectivity().triangles())
    area += 0.5 * doubled_area(mesh.triangle(Mesh::halfedge(t, 0)));
  return area;
}

/// Connectivity, and one length for both sides of an edge.
void expect_valid(const IntrinsicMesh& mesh) {
  const Mesh& c = mesh.connectivity();
  for (const HalfedgeId h : c.halfedges()) {
    EXPECT_NE(c.origin(h), c.target(h));
    EXPECT_EQ(c.find_halfedge(c.origin(h), c.target(h)), h);  // no other edge has these ends
    if (c.is_boundary(h)) continue;
    EXPECT_EQ(c.twin(c.twin(h)), h);
    EXPECT_EQ(c.origin(c.twin(h)), c.target(h));
    EXPECT_EQ(mesh.squared_length(c.twin(h)), mesh.squared_length(h));
  }
}

TEST(IntrinsicMesh, OfPaperBecomesThePlanesRegularTriangulation) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Mesh plane = test::plane_strip(8, seed);
    IntrinsicMesh lifted(test::mesh_of(test::lifted(plane))), folded(test::mesh_of(test::folded(plane, 0.9)));
    const double area = area_of(lifted);
    for (IntrinsicMesh* mesh : {&lifted, &folded}) {
      const IntrinsicFlips flips = flip_to_regular(*mesh);
      EXPECT_GT(flips.flips, 5U);
      EXPECT_EQ(flips.blocked, 0U);
      expect_valid(*mesh);
      EXPECT_NEAR(area_of(*mesh), area, 1e-12 * area);
      EXPECT_EQ(flip_to_regular(*mesh).flips, 0U);
    }
    ASSERT_TRUE(restore_regularity(plane).regular());
    EXPECT_EQ(corners_of(lifted.connectivity()), corners_of(plane));
    EXPECT_EQ(corners_of(folded.connectivity()), corners_of(plane));
  }
}

TEST(IntrinsicMesh, FlipsAreUndoneByFlips) {
  const SurfaceMesh sphere = test::mesh_of(test::icosphere(2));
  const IntrinsicMesh before(sphere);
  IntrinsicMesh mesh = before;
  std::size_t flipped = 0;
  for (const HalfedgeId h : mesh.connectivity().halfedges()) {
    if (!mesh.flip(h)) continue;
    ++flipped;
    expect_valid(mesh);
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(mesh.flip(h));
    for (const HalfedgeId side : mesh.connectivity().halfedges()) {
      ASSERT_EQ(mesh.connectivity().origin(side), before.connectivity().origin(side));
      ASSERT_NEAR(mesh.squared_length(side), before.squared_length(side), 1e-14);
    }
    if (flipped == 40) break;
  }
  EXPECT_EQ(flipped, 40U);
}

TEST(IntrinsicMesh, ComesBackToOneDelaunayTriangulationFromAnyOther) {
  Rng rng(5);
  test::SurfaceArrays rough = test::icosphere(3);
  for (Vec3& p : rough.points) p = rng.uniform(0.95, 1.05) * p;
  for (const SurfaceMesh& surface :
       {test::mesh_of(test::lifted(*random_mesh({.vertices = 300, .seed = 2}))), test::mesh_of(rough)}) {
    IntrinsicMesh delaunay(surface);
    ASSERT_EQ(flip_to_regular(delaunay).blocked, 0U);
    IntrinsicMesh mesh = delaunay;
    std::size_t flips = 0;
    const auto n = static_cast<std::uint32_t>(mesh.connectivity().n_halfedges());
    for (int i = 0; i < 3000; ++i) flips += mesh.flip(HalfedgeId(rng.below(n))) ? 1 : 0;
    ASSERT_GT(flips, 1000U);
    expect_valid(mesh);
    ASSERT_EQ(flip_to_regular(mesh).blocked, 0U);
    EXPECT_EQ(corners_of(mesh.connectivity()), corners_of(delaunay.connectivity()));
    for (const HalfedgeId h : mesh.connectivity().halfedges()) {
      const Mesh& c = delaunay.connectivity();
      const HalfedgeId same = c.find_halfedge(mesh.connectivity().origin(h), mesh.connectivity().target(h));
      EXPECT_NEAR(mesh.squared_length(h), delaunay.squared_length(same), 1e-9 * delaunay.squared_length(same));
    }
  }
}

TEST(IntrinsicMesh, RefusesFlipsThatLeaveNoTriangulation) {
  // A tetrahedron has all edges already; the corner of a square is not convex.
  const SurfaceMesh tetrahedron =
      test::mesh_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}});
  IntrinsicMesh closed(tetrahedron);
  for (const HalfedgeId h : closed.connectivity().halfedges()) EXPECT_FALSE(closed.flip(h));
  IntrinsicMesh dart(test::mesh_of({{{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}}));
  for (const HalfedgeId h : dart.connectivity().halfedges()) EXPECT_FALSE(dart.flip(h));
  test::SurfaceArrays square = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto inner = [](const IntrinsicMesh& mesh) {
    return mesh.connectivity().find_halfedge(VertexId(0), VertexId(2));
  };
  IntrinsicMesh may(test::mesh_of(square));
  EXPECT_TRUE(may.flip(inner(may)));
  square.constrained = {{0, 2}};
  IntrinsicMesh constrained(test::mesh_of(square));
  EXPECT_FALSE(constrained.flip(inner(constrained)));
}

void expect_same_operators(const SurfaceMesh& surface) {
  const DecComplex own = dec_operators(surface), same = dec_operators(IntrinsicMesh(surface));
  ASSERT_EQ(same.d0.columns, own.d0.columns);
  ASSERT_EQ(same.d1.columns, own.d1.columns);
  ASSERT_EQ(same.d1.signs, own.d1.signs);
  for (std::size_t i = 0; i < own.edges.size(); ++i) {
    const EdgeId e(i);
    EXPECT_NEAR(same.star1[e], own.star1[e], 1e-12 * std::max(1.0, std::abs(own.star1[e])));
    EXPECT_NEAR(same.edges[e].crossing, own.edges[e].crossing, 1e-14);
    EXPECT_NEAR(same.edges[e].left_height, own.edges[e].left_height, 1e-13);
    EXPECT_NEAR(same.edges[e].right_height, own.edges[e].right_height, 1e-13);
  }
  for (const VertexId v : surface.vertices()) EXPECT_NEAR(same.star0[v], own.star0[v], 1e-13);
}

TEST(IntrinsicMesh, HasTheOperatorsOfItsMeshAndNoNegativeOneAfterFlips) {
  test::SurfaceArrays arrays = test::torus(24, 16);
  Rng rng(3);
  for (Vec3& p : arrays.points) p = rng.uniform(0.9, 1.1) * p;
  const SurfaceMesh torus = test::mesh_of(arrays);
  IntrinsicMesh mesh(torus);
  expect_same_operators(torus);
  expect_same_operators(test::mesh_of(test::folded(test::plane_strip(6, 1), 0.9)));  // with a boundary and weights
  const auto is_negative = [](double ratio) { return ratio < 0; };
  const DecComplex own = dec_operators(torus);
  EXPECT_GT(std::count_if(own.star1.begin(), own.star1.end(), is_negative), 50);

  ASSERT_EQ(flip_to_regular(mesh).blocked, 0U);
  const DecComplex flipped = dec_operators(mesh);
  double area = 0;
  for (const double dual : flipped.star0) area += dual;
  EXPECT_NEAR(area, area_of(IntrinsicMesh(torus)), 1e-12 * area);
  for (const double ratio : flipped.star1) EXPECT_GE(ratio, -1e-10);
}

}  // namespace
}  // namespace temper::surfaces
