// Edges that must be split: never one in a well-centered mesh, exactly decided, and the same however a mesh is put.
#include "temper/detail/necessity.hpp"

#include <numbers>
#include <tuple>

#include "support/spheres.hpp"
#include "temper/optimize.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

Mesh mesh_of_outline(const std::vector<Vec2>& outline) {
  std::vector<std::array<std::int32_t, 2>> segments;
  const auto n = static_cast<std::int32_t>(outline.size());
  for (std::int32_t i = 0; i < n; ++i) segments.push_back({i, (i + 1) % n});
  auto mesh = constrained_delaunay({.points = outline, .segments = segments});
  if (!mesh) {
    ADD_FAILURE() << mesh.error().what();
    return {};
  }
  return *std::move(mesh);
}

/// All edges constrained: every edge is asked, and every vertex counts.
Mesh all_constrained(Mesh mesh) {
  for (const HalfedgeId h : mesh.halfedges()) mesh.set_constrained(h, true);
  return mesh;
}

/// By place, so that numbers do not matter: the ends of the edge in order, and the sum.
using Placed = std::tuple<double, double, double, double, double>;
template <class Back>
std::vector<Placed> placed(const Mesh& mesh, double up_to, const Back& back) {
  std::vector<Placed> all;
  for (const EdgeConflict& c : edges_that_must_be_split(mesh, up_to)) {
    Vec2 u = back(mesh.position(mesh.origin(c.edge))), v = back(mesh.position(mesh.target(c.edge)));
    if (std::tuple(v.x, v.y) < std::tuple(u.x, u.y)) std::swap(u, v);
    all.emplace_back(u.x, u.y, v.x, v.y, c.sum);
  }
  std::sort(all.begin(), all.end());
  return all;
}
std::vector<Placed> placed(const Mesh& mesh, double up_to) {
  return placed(mesh, up_to, [](Vec2 p) { return p; });
}

/// The rectangle [0, 1] × [0, length] whose right side has three points more.
Mesh rectangle(double length) {
  return mesh_of_outline(
      {{0, 0}, {1, 0}, {1, length / 4}, {1, length / 2}, {1, 3 * length / 4}, {1, length}, {0, length}});
}

TEST(Necessity, NoWellCenteredMeshHasAnEdgeThatMustBeSplit) {
  std::size_t edges = 0, meshes = 0, conflicts_before = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Mesh mesh = seed % 3 == 0   ? *random_mesh({.vertices = 120, .seed = seed})
                : seed % 3 == 1 ? jittered_lattice(seed, 7)
                                : *annulus({.around = 24, .rings = 4, .seed = seed});
    conflicts_before += edges_that_must_be_split(all_constrained(mesh)).size();
    ASSERT_TRUE(optimize(mesh));
    if (bad_triangles(mesh) > 0) continue;
    ++meshes;
    edges += mesh.n_edges();
    EXPECT_TRUE(edges_that_must_be_split(all_constrained(mesh)).empty()) << seed;
  }
  EXPECT_GE(meshes, 20u);
  EXPECT_GT(edges, 3000u);
  EXPECT_GT(conflicts_before, 0u);  // some had such edges before
}

/// The points a quarter of the way from the ends allow (16 + L²) / (4 L²) each, which is 1/2 at L = 4.
TEST(Necessity, LongRectanglesNeedASplitFromRatioFourOnExactly) {
  for (const double length : {4.0, std::nextafter(4.0, 5.0), 5.0, 8.0}) {
    const auto conflicts = edges_that_must_be_split(rectangle(length));
    ASSERT_EQ(conflicts.size(), 1u) << length;
    EXPECT_LE(conflicts[0].sum, 1);
    EXPECT_EQ(conflicts[0].split_at, 0.5);
  }
  for (const double length : {1.0, 2.0, 3.5, std::nextafter(4.0, 3.0)}) {
    EXPECT_TRUE(edges_that_must_be_split(rectangle(length)).empty()) << length;
  }
}

/// From the definition, with every vertex and every edge of the boundary: the least a + b of one side.
double least_sum(const Mesh& mesh, HalfedgeId h) {
  const Vec2 u = mesh.position(mesh.origin(h)), v = mesh.position(mesh.target(h));
  const auto left = [](Vec2 p, Vec2 q, Vec2 r) { return orient2d(p, q, r) == Sign::positive; };
  const auto cross_properly = [&](Vec2 p, Vec2 q, Vec2 r, Vec2 s) {
    return left(p, q, r) != left(p, q, s) && left(r, s, p) != left(r, s, q);
  };
  double a = kUnbounded, b = kUnbounded;
  for (const VertexId y : mesh.vertices()) {
    const Vec2 x = mesh.position(y);
    if (!mesh.is_boundary(y) || !left(u, v, x)) continue;
    bool visible = true;
    for (const HalfedgeId g : mesh.halfedges()) {
      if (!mesh.is_boundary(g)) continue;
      const Vec2 p = mesh.position(mesh.origin(g)), q = mesh.position(mesh.target(g));
      const bool touches_x = mesh.origin(g) == y || mesh.target(g) == y;
      for (const Vec2 end : {u, v}) {
        if (!touches_x && p != end && q != end && cross_properly(end, x, p, q)) visible = false;
      }
      if (left(u, v, p) && left(v, x, p) && left(x, u, p)) visible = false;
    }
    if (!visible) continue;
    if (dot(v - u, x - u) > 0) a = std::min(a, squared_length(x - u) / dot(v - u, x - u));
    if (dot(u - v, x - v) > 0) b = std::min(b, squared_length(x - v) / dot(u - v, x - v));
  }
  return a + b;
}

TEST(Necessity, TheWalkFindsWhatTheDefinitionSays) {
  constexpr double kUpTo = 3;
  std::size_t found = 0, edges = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Rng rng(seed);
    std::vector<Vec2> outline;  // a star with deep notches
    for (int i = 0; i < 40; ++i) {
      const double angle = 2 * std::numbers::pi * (i + rng.uniform(-0.3, 0.3)) / 40, r = rng.uniform(0.3, 1);
      outline.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    const Mesh mesh = mesh_of_outline(outline);
    for (const HalfedgeId h : mesh.halfedges()) {
      if (!mesh.is_boundary(h)) continue;
      ++edges;
      const double sum = least_sum(mesh, h);
      const auto conflict = edge_conflict(mesh, h, kUpTo);
      ASSERT_EQ(conflict.has_value(), sum <= kUpTo) << sum;
      if (!conflict) continue;
      ++found;
      EXPECT_NEAR(conflict->sum, sum, 1e-12);
    }
  }
  EXPECT_GT(found, 50u);
  EXPECT_LT(found, edges);
}

/// A tooth hangs from the upper side; once it is deep its tip alone counts.
TEST(Necessity, WhatLiesBehindTheBoundaryDoesNotCount) {
  const auto slab = [](double tip) {
    return mesh_of_outline({{0, 0}, {8, 0}, {8, 1}, {6, 1}, {4, tip}, {2, 1}, {0, 1}});
  };
  const auto open = edges_that_must_be_split(slab(1.5));
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].sum, 2 * 0.3125);
  EXPECT_TRUE(edges_that_must_be_split(slab(0.01)).empty());
  const auto blocked = edges_that_must_be_split(slab(0.01), 1.1);
  ASSERT_EQ(blocked.size(), 1u);
  EXPECT_EQ(blocked[0].near_u, VertexId(4));
  EXPECT_EQ(blocked[0].near_v, VertexId(4));
}

TEST(Necessity, IsTheSameMirroredTurnedScaledAndRenumbered) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Mesh mesh = all_constrained(jittered_lattice(seed));
    const auto expected = placed(mesh, 3);
    found += expected.size();
    const auto changed = [&](auto place) {
      std::vector<Vec2> points;
      for (const VertexId v : mesh.vertices()) points.push_back(place(mesh.position(v)));
      std::vector<std::array<std::int32_t, 3>> triangles;
      for (const TriangleId t : mesh.triangles()) {
        const auto [p, q, r] = mesh.corners(t);
        triangles.push_back({std::int32_t(p.index), std::int32_t(q.index), std::int32_t(r.index)});
      }
      return all_constrained(mesh_of(points, triangles));  // build turns clockwise triangles over
    };
    EXPECT_EQ(placed(changed([](Vec2 p) {
                       return Vec2{-p.x, p.y};
                     }),
                     3,
                     [](Vec2 p) {
                       return Vec2{-p.x, p.y};
                     }),
              expected);
    EXPECT_EQ(placed(changed([](Vec2 p) {
                       return Vec2{-p.y, p.x};
                     }),
                     3,
                     [](Vec2 p) {
                       return Vec2{p.y, -p.x};
                     }),
              expected);
    EXPECT_EQ(placed(changed([](Vec2 p) { return 0x1p20 * p; }), 3, [](Vec2 p) { return 0x1p-20 * p; }), expected);
    Mesh renumbered = mesh;
    hilbert_order(renumbered);
    EXPECT_EQ(placed(renumbered, 3), expected);
  }
  EXPECT_GT(found, 50u);
}

/// Asked one by one or all at once, from either side.
TEST(Necessity, OneEdgeHasTheConflictThatTheListHas) {
  const Mesh mesh = all_constrained(jittered_lattice(3));
  const auto all = edges_that_must_be_split(mesh, 3);
  ASSERT_FALSE(all.empty());
  for (const EdgeConflict& c : all) {
    for (const HalfedgeId h : {c.edge, mesh.twin(c.edge)}) {
      if (!h.valid()) continue;
      const auto one = edge_conflict(mesh, h, 3);
      ASSERT_TRUE(one);
      EXPECT_EQ(one->edge, c.edge);
      EXPECT_EQ(one->sum, c.sum);
    }
    EXPECT_FALSE(edge_conflict(mesh, c.edge, c.sum * (1 - 1e-9)).has_value());
  }
}

// --- on the sphere ---------------------------------------------------------------------------------------------

std::size_t bad_on_sphere(const Mesh& mesh) {
  std::size_t bad = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.corners(t);
    bad += !is_well_centered(mesh.weighted_vector(p), mesh.weighted_vector(q), mesh.weighted_vector(r));
  }
  return bad;
}

TEST(Necessity, NoWellCenteredMeshOfTheSphereHasAnEdgeThatMustBeSplit) {
  std::size_t edges = 0, meshes = 0, conflicts_before = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    // From 20 points on, edges of up to 80 degrees: nothing here is nearly flat.
    Mesh mesh = globe(20 + 10 * seed, seed, 1000);
    if (seed % 2 == 0) mesh = ocean(mesh, 300);
    conflicts_before += edges_that_must_be_split(all_constrained(mesh)).size();
    ASSERT_TRUE(optimize(mesh));
    if (bad_on_sphere(mesh) > 0) continue;
    ++meshes;
    edges += mesh.n_edges();
    EXPECT_TRUE(edges_that_must_be_split(all_constrained(mesh)).empty()) << seed;
  }
  EXPECT_GE(meshes, 12u);
  EXPECT_GT(edges, 3000u);
  EXPECT_GT(conflicts_before, 0u);
}

/// The sum of the least a and the least b: of arcs, and of chords, which up_to is about.
struct Sums {
  double arcs = 0, chords = 0;
};
/// From the definition: a right angle at X, tan um = tan uX / cos U; the arcs that are left, over that of the edge.
Sums least_sums(const Mesh& mesh, HalfedgeId h) {
  const Vec3 u = mesh.weighted_vector(mesh.origin(h)), v = mesh.weighted_vector(mesh.target(h));
  const auto left = [](Vec3 p, Vec3 q, Vec3 r) { return orientation(p, q, r) == Sign::positive; };
  const auto cross_properly = [&](Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
    return left(p, q, r) != left(p, q, s) && left(r, s, p) != left(r, s, q);
  };
  const auto bound = [](Vec3 near, Vec3 far, Vec3 x) {
    const double c = std::cos(corner_angle(near, far, x)), way = arc_length(near, x);
    return c > 0 && way < std::numbers::pi / 2 ? std::atan(std::tan(way) / c) : kUnbounded;
  };
  double a = kUnbounded, b = kUnbounded;
  for (const VertexId y : mesh.vertices()) {
    const Vec3 x = mesh.weighted_vector(y);
    if (!mesh.is_boundary(y) || !left(u, v, x)) continue;
    bool visible = true;
    for (const HalfedgeId g : mesh.halfedges()) {
      if (!mesh.is_boundary(g)) continue;
      const Vec3 p = mesh.weighted_vector(mesh.origin(g)), q = mesh.weighted_vector(mesh.target(g));
      const bool near = dot(p, u) > 0 && dot(q, u) > 0;  // arcs cross where their great circles do, or opposite to it
      const bool touches_x = mesh.origin(g) == y || mesh.target(g) == y;
      for (const Vec3 end : {u, v}) {
        if (near && !touches_x && p != end && q != end && cross_properly(end, x, p, q)) visible = false;
      }
      if (left(u, v, p) && left(v, x, p) && left(x, u, p)) visible = false;
    }
    if (!visible) continue;
    a = std::min(a, bound(u, v, x)), b = std::min(b, bound(v, u, x));
  }
  if (a == kUnbounded || b == kUnbounded) return {kUnbounded, kUnbounded};
  const double whole = arc_length(u, v);
  const auto chord = [&](double arc) { return std::sin(arc) / (std::sin(arc) + std::sin(whole - arc)); };
  return {(a + b) / whole, chord(a) + chord(b)};
}

TEST(Necessity, OnTheSphereTheWalkFindsWhatTheDefinitionSays) {
  constexpr double kUpTo = 2;
  std::size_t found = 0, edges = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Rng rng(seed);
    std::vector<Vec2> outline;  // a star with deep notches, of up to 45 degrees around the pole
    for (int i = 0; i < 40; ++i) {
      const double angle = 2 * std::numbers::pi * (i + rng.uniform(-0.3, 0.3)) / 40, r = rng.uniform(0.3, 1);
      outline.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    const Mesh mesh = on_cap(mesh_of_outline(outline), 1);
    for (const HalfedgeId h : mesh.halfedges()) {
      if (!mesh.is_boundary(h)) continue;
      ++edges;
      const Sums sums = least_sums(mesh, h);
      const auto conflict = edge_conflict(mesh, h, kUpTo);
      ASSERT_EQ(conflict.has_value(), sums.chords <= kUpTo) << sums.chords;
      if (!conflict) continue;
      ++found;
      EXPECT_NEAR(conflict->sum, sums.arcs, 1e-12);
    }
  }
  EXPECT_GT(found, 20u);
  EXPECT_LT(found, edges);
}

TEST(Necessity, OnSmallCapsItIsAsInThePlaneToSecondOrder) {
  const Mesh plane = rectangle(5);
  const EdgeConflict flat = edges_that_must_be_split(plane).at(0);
  std::vector<double> off;
  for (const double radius : {100.0, 200.0, 400.0}) {
    const auto conflicts = edges_that_must_be_split(on_cap(plane, radius));
    ASSERT_EQ(conflicts.size(), 1u);
    EXPECT_EQ(conflicts[0].near_u, flat.near_u);
    EXPECT_EQ(conflicts[0].near_v, flat.near_v);
    EXPECT_EQ(conflicts[0].edge, flat.edge);
    off.push_back(std::abs(conflicts[0].sum - flat.sum));
  }
  EXPECT_NEAR(off[0] / off[1], 4, 0.1);
  EXPECT_NEAR(off[1] / off[2], 4, 0.1);
}

TEST(Necessity, WeightsOfTheSphereDoNotMatter) {
  const Mesh bare = on_cap(rectangle(5), 10);
  Mesh weighted = bare;
  Rng rng(3);
  for (const VertexId v : weighted.vertices()) weighted.set_weight(v, rng.uniform(-5, 5));
  const auto before = edges_that_must_be_split(bare), after = edges_that_must_be_split(weighted);
  ASSERT_EQ(before.size(), 1u);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].edge, before[0].edge);
  EXPECT_NEAR(after[0].sum, before[0].sum, 1e-12);
}

}  // namespace
}  // namespace temper::test
