// The constrained Delaunay triangulation: laws, then what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/rng.hpp"
#include "generate/triangulation.hpp"
#include "property/mesh_of_random_points.hpp"
#include "support/shapes.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

using test::area;

using Segments = std::vector<std::array<std::int32_t, 2>>;

std::vector<Vec2> random_points_in_square(std::uint64_t seed, std::size_t n) {
  Rng rng(seed);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back({rng.uniform(), rng.uniform()});
  return points;
}

std::vector<Vec2> lattice(int nx, int ny) {
  std::vector<Vec2> points;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) points.push_back({static_cast<double>(i), static_cast<double>(j)});
  }
  return points;
}

Segments closed(std::int32_t first, std::int32_t n) {
  Segments segments;
  for (std::int32_t i = 0; i < n; ++i) segments.push_back({first + i, first + (i + 1) % n});
  return segments;
}

double area(const std::vector<Vec2>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += 0.5 * cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return sum;
}

int euler(const Mesh& mesh) {
  return static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) + static_cast<int>(mesh.n_triangles());
}

void expect_delaunay(const Mesh& mesh, const std::vector<Vec2>& points) {
  ASSERT_EQ(mesh.validate(), std::nullopt);
  ASSERT_EQ(mesh.n_vertices(), points.size());
  for (const VertexId v : mesh.vertices()) ASSERT_EQ(mesh.position(v), points[v.index]);
  EXPECT_EQ(count_non_regular_edges(mesh, false), 0u);
  EXPECT_TRUE(test::has_canonical_outgoing(mesh));
}

/// Every boundary turns left or goes straight, and there is one boundary: the mesh covers its convex hull.
void expect_convex(const Mesh& mesh) {
  std::size_t boundary = 0, seen = 0;
  HalfedgeId first;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    ++boundary;
    first = h;
  }
  ASSERT_TRUE(first.valid());
  HalfedgeId h = first;
  do {
    const HalfedgeId following = mesh.outgoing(mesh.target(h));
    ASSERT_NE(
        orient2d(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)), mesh.position(mesh.target(following))),
        Sign::negative);
    h = following;
    ++seen;
  } while (h != first && seen <= boundary);
  EXPECT_EQ(seen, boundary);
  EXPECT_EQ(euler(mesh), 1);
}

TEST(Delaunay, OfRandomPointsIsRegularAndCoversTheHull) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto points = random_points_in_square(seed, 3 + 3 * seed);
    const auto mesh = constrained_delaunay({points, {}, false});
    ASSERT_TRUE(mesh) << mesh.error().what();
    expect_delaunay(*mesh, points);
    expect_convex(*mesh);
  }
}

TEST(Delaunay, OfALatticeIsTheSameWhateverTheOrderOfInsertion) {
  // Shifting all numbers by unused far points would change the order of insertion; here the lattice is triangulated
  // as a whole and once more with its lower half alone. What both contain away from the cut must agree.
  const auto all = lattice(12, 12);
  const auto mesh = constrained_delaunay({all, {}, false});
  const std::vector<Vec2> half(all.begin(), all.begin() + 72);
  const auto lower = constrained_delaunay({half, {}, false});
  ASSERT_TRUE(mesh && lower);
  expect_delaunay(*mesh, all);
  expect_convex(*mesh);
  auto edges = test::edge_set(*mesh);
  std::erase_if(edges, [](const auto& edge) { return edge.second >= 72; });
  EXPECT_EQ(edges, test::edge_set(*lower));
}

TEST(Delaunay, TiesAreBrokenByNumberNotByPlace) {
  // The perturbed weights make the lowest number of a cocircular quad the heaviest: it gets the diagonal.
  const std::vector<Vec2> corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  do {
    std::vector<Vec2> points;
    for (const std::size_t i : order) points.push_back(corners[i]);
    const auto mesh = constrained_delaunay({points, {}, false});
    ASSERT_TRUE(mesh);
    bool zero_has_diagonal = false;
    for (const HalfedgeId h : mesh->halfedges()) {
      if (!mesh->is_boundary(h) && mesh->origin(h) == VertexId(0)) zero_has_diagonal = true;
    }
    EXPECT_TRUE(zero_has_diagonal);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Delaunay, DoesNotMindOffsetsAndScales) {
  const auto points = random_points_in_square(11, 300);
  const auto reference = constrained_delaunay({points, {}, false});
  ASSERT_TRUE(reference);
  for (const double scale : {0x1p-40, 0x1p40, 0x1p-100, 0x1p100}) {
    auto scaled = points;
    for (Vec2& p : scaled) p = scale * p;
    const auto mesh = constrained_delaunay({scaled, {}, false});
    ASSERT_TRUE(mesh) << mesh.error().what();
    EXPECT_EQ(test::edge_set(*mesh), test::edge_set(*reference));
  }
  for (const double offset : {1e6, 1e12}) {
    auto moved = points;
    for (Vec2& p : moved) p = p + Vec2{offset, -3 * offset};
    const auto mesh = constrained_delaunay({moved, {}, false});
    ASSERT_TRUE(mesh) << mesh.error().what();
    expect_delaunay(*mesh, moved);
    expect_convex(*mesh);
  }
}

TEST(Delaunay, OfNearlyCollinearPointsHasACompleteHull) {
  Rng rng(5);
  std::vector<Vec2> points;
  for (int i = 0; i < 200; ++i) {
    const double x = rng.uniform();
    points.push_back({x, x / 3 + 0x1p-53 * rng.below(3)});
  }
  points.push_back({0.5, -7});
  const auto mesh = constrained_delaunay({points, {}, false});
  ASSERT_TRUE(mesh) << mesh.error().what();
  expect_delaunay(*mesh, points);
  expect_convex(*mesh);
}

TEST(Delaunay, OfPointsOnALineAndOneMoreIsAFan) {
  std::vector<Vec2> points = lattice(50, 1);
  points.push_back({20, 1});
  const auto mesh = constrained_delaunay({points, {}, false});
  ASSERT_TRUE(mesh);
  expect_delaunay(*mesh, points);
  EXPECT_EQ(mesh->n_triangles(), 49u);
}

TEST(Delaunay, OfAHubOfHighDegreeDoesNotWalkAroundItForEachPoint) {
  // All triangles meet in one vertex. A walk around it for each point would be a million steps and more.
  constexpr int kPoints = 2000;
  std::vector<Vec2> line = lattice(kPoints, 1);
  line.push_back({kPoints / 2, 10 * kPoints});
  const auto fan = generate::triangulate_points(line);
  ASSERT_TRUE(fan);
  EXPECT_EQ(fan->mesh.n_triangles(), kPoints - 1u);
  EXPECT_EQ(fan->mesh.validate(), std::nullopt);
  EXPECT_GT(fan->steps, kPoints / 2u);
  EXPECT_LT(fan->steps, 10u * kPoints);
}

TEST(ConstrainedDelaunay, FillsAPolygonWithAHole) {
  std::vector<Vec2> points = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}, {1, 1}, {1.5, 1}, {1.5, 0.5}, {1, 0.5}};
  Segments segments = closed(0, 5);
  for (const auto& s : closed(5, 4)) segments.push_back(s);
  const auto mesh = constrained_delaunay({points, segments});
  ASSERT_TRUE(mesh) << mesh.error().what();
  expect_delaunay(*mesh, points);
  EXPECT_EQ(euler(*mesh), 0);
  EXPECT_DOUBLE_EQ(area(*mesh), area(std::vector<Vec2>(points.begin(), points.begin() + 5)) - 0.25);
  for (const auto& [a, b] : segments) {
    const bool there =
        mesh->find_halfedge(VertexId(static_cast<std::size_t>(a)), VertexId(static_cast<std::size_t>(b))).valid() ||
        mesh->find_halfedge(VertexId(static_cast<std::size_t>(b)), VertexId(static_cast<std::size_t>(a))).valid();
    EXPECT_TRUE(there);
  }
}

TEST(ConstrainedDelaunay, OfRandomStarPolygonsHasTheirArea) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Rng rng(seed);
    std::vector<Vec2> points;
    const std::int32_t n = 5 + static_cast<std::int32_t>(rng.below(60));
    for (std::int32_t i = 0; i < n; ++i) {
      const double angle = 2 * 3.141592653589793 * i / n, radius = rng.uniform(0.1, 1);
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const auto mesh = constrained_delaunay({points, closed(0, n)});
    ASSERT_TRUE(mesh) << mesh.error().what();
    expect_delaunay(*mesh, points);
    EXPECT_EQ(mesh->n_triangles(), static_cast<std::size_t>(n - 2));
    EXPECT_NEAR(area(*mesh), area(points), 1e-14 * n);
  }
}

// Long segments through many triangles, with vertices hanging into the strip.
TEST(ConstrainedDelaunay, KeepsDisjointSegmentsAmongManyPoints) {
  std::size_t inserted = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    auto points = random_points_in_square(seed, 150);
    Segments segments;
    for (int k = 0; k < 40; ++k) {
      const auto a = static_cast<std::int32_t>(rng.below(150)), b = static_cast<std::int32_t>(rng.below(150));
      const auto crosses = [&](const std::array<std::int32_t, 2>& s) {
        const Vec2 p = points[static_cast<std::size_t>(a)], q = points[static_cast<std::size_t>(b)];
        const Vec2 r = points[static_cast<std::size_t>(s[0])], t = points[static_cast<std::size_t>(s[1])];
        return orient2d(p, q, r) != orient2d(p, q, t) && orient2d(r, t, p) != orient2d(r, t, q) && a != s[0] &&
               a != s[1] && b != s[0] && b != s[1];
      };
      if (a == b || std::any_of(segments.begin(), segments.end(), crosses)) continue;
      segments.push_back({a, b});
    }
    const auto mesh = constrained_delaunay({points, segments, false});
    ASSERT_TRUE(mesh) << mesh.error().what();
    expect_delaunay(*mesh, points);
    expect_convex(*mesh);
    for (const auto& [a, b] : segments) {
      const VertexId u(static_cast<std::size_t>(a)), v(static_cast<std::size_t>(b));
      HalfedgeId h = mesh->find_halfedge(u, v);
      if (!h.valid()) h = mesh->find_halfedge(v, u);
      ASSERT_TRUE(h.valid());
      EXPECT_TRUE(mesh->is_boundary(h) || mesh->is_constrained(h));
      ++inserted;
    }
  }
  EXPECT_GT(inserted, 600u);
}

TEST(ConstrainedDelaunay, DoesNotDependOnTheOrderOfSegments) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    const auto points = lattice(8, 8);
    Segments segments = {{0, 63}, {7, 27}, {56, 36}, {1, 53}, {8, 46}, {2, 61}};
    std::erase_if(segments, [&](const auto&) { return segments.size() > 3 && rng.below(2) == 0; });
    const auto forwards = constrained_delaunay({points, segments, false});
    std::reverse(segments.begin(), segments.end());
    const auto backwards = constrained_delaunay({points, segments, false});
    ASSERT_EQ(forwards.has_value(), backwards.has_value());
    if (!forwards) continue;
    expect_delaunay(*forwards, points);
    EXPECT_EQ(test::edge_set(*forwards), test::edge_set(*backwards));
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(ConstrainedDelaunay, SplitsASegmentAtThePointsThatLieOnIt) {
  const auto points = lattice(9, 9);
  const Segments segments = {{0, 80}, {36, 44}};
  const auto mesh = constrained_delaunay({points, segments, false});
  ASSERT_TRUE(mesh) << mesh.error().what();  // they meet at point 40
  std::size_t constrained = 0;
  for (const HalfedgeId h : mesh->halfedges()) {
    if (mesh->is_edge_representative(h) && mesh->is_constrained(h)) ++constrained;
  }
  EXPECT_EQ(constrained, 16u);
}

TEST(ConstrainedDelaunay, KeepsALineThatDividesTheInside) {
  const std::vector<Vec2> points = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0.75}};
  Segments segments = closed(0, 4);
  segments.push_back({1, 3});
  const auto mesh = constrained_delaunay({points, segments});
  ASSERT_TRUE(mesh) << mesh.error().what();
  expect_delaunay(*mesh, points);
  EXPECT_DOUBLE_EQ(area(*mesh), 4);
  EXPECT_TRUE(mesh->is_constrained(mesh->find_halfedge(VertexId(1), VertexId(3))));
}

TEST(ConstrainedDelaunay, FillsAnIslandInAHole) {
  std::vector<Vec2> points;
  Segments segments;
  for (const double r : {3.0, 2.0, 1.0}) {
    const auto first = static_cast<std::int32_t>(points.size());
    for (const Vec2 p : {Vec2{-r, -r}, {r, -r}, {r, r}, {-r, r}}) points.push_back(p);
    for (const auto& s : closed(first, 4)) segments.push_back(s);
  }
  const auto mesh = constrained_delaunay({points, segments});
  ASSERT_TRUE(mesh) << mesh.error().what();
  EXPECT_DOUBLE_EQ(area(*mesh), 36 - 16 + 4);
  EXPECT_EQ(euler(*mesh), 1);  // a ring and a disc
}

struct Refusal {
  std::vector<Vec2> points;
  Segments segments;
  ErrorCode code;
  std::string message;
};

TEST(ConstrainedDelaunay, RefusesByName) {
  const double nan = std::nan("");
  const std::vector<Vec2> unit = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<Refusal> cases = {
      {{{0, 0}, {1, 0}}, {}, ErrorCode::empty_input, "a triangulation needs three points or more, not 2"},
      {{{0, 0}, {1, 1}, {2, 2}}, {}, ErrorCode::zero_area, "all points lie on one line"},
      {{{0, 0}, {1, nan}, {2, 2}}, {}, ErrorCode::not_finite, "point 1 is not finite"},
      {{{0, 0}, {1e300, 0}, {2, 2}},
       {},
       ErrorCode::out_of_scale,
       "point 1 at (1e+300, 0) is out of the range of exact arithmetic"},
      {{{0, 0}, {1, 0}, {1, 1}, {1, 0}, {0, 1}}, {}, ErrorCode::duplicate_point, "points 1 and 3 are both at (1, 0)"},
      {unit, {{0, 4}}, ErrorCode::index_out_of_range, "segment 0 uses point 4, but there are 4 points"},
      {unit, {{0, 1}, {-1, 2}}, ErrorCode::index_out_of_range, "segment 1 uses point -1, but there are 4 points"},
      {unit, {{2, 2}}, ErrorCode::zero_area, "segment 0 joins point 2 to itself"},
      {unit,
       {{0, 2}, {1, 3}},
       ErrorCode::overlap,
       "segment 0 (point 0 to point 2) and segment 1 (point 1 to point 3) cross; segments may only meet at points"},
      {unit, {{0, 2}}, ErrorCode::empty_input, "the segments enclose nothing"},
      {unit, {{0, 1}, {1, 2}, {2, 0}}, ErrorCode::unused_point, "point 3 lies outside the segments"},
      {{{0, 0}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}},
       {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}},
       ErrorCode::non_manifold_vertex,
       "the domain touches itself at point 0"},
  };
  for (const Refusal& refusal : cases) {
    const auto mesh = constrained_delaunay({refusal.points, refusal.segments});
    ASSERT_FALSE(mesh) << refusal.message;
    EXPECT_EQ(mesh.error().code, refusal.code);
    EXPECT_EQ(mesh.error().what(), refusal.message);
  }
}

}  // namespace
}  // namespace temper
