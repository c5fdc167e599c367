// Power cells against half-plane clipping by every vertex, and their laws on any domain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "property/mesh_of_random_points.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

constexpr double kAbsolute = 1e-12;  // domains of size about 1

using Corners = std::vector<Vec2>;

Corners polygon(const PowerCells& cells, std::size_t p) {
  return {cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.starts[p]),
          cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.starts[p + 1])};
}

double area(const Corners& corners) {
  double doubled = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) doubled += cross(corners[i], corners[(i + 1) % corners.size()]);
  return doubled / 2;
}

/// The power distance of x to v minus that to u: > 0 outside of the cell of v.
double excess(const Mesh& mesh, VertexId v, VertexId u, Vec2 x) {
  const Vec2 y = x - mesh.position(v), e = mesh.position(u) - mesh.position(v);
  return 2 * dot(y, e) - squared_length(e) + mesh.weight(u) - mesh.weight(v);
}

/// The square [−1, 1]² cut by the half-plane of every other vertex.
Corners clipped_square(const Mesh& mesh, VertexId v) {
  Corners cell = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const VertexId u : mesh.vertices()) {
    if (u == v || mesh.is_isolated(u)) continue;
    Corners rest;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Vec2 a = cell[i], b = cell[(i + 1) % cell.size()];
      const double fa = excess(mesh, v, u, a), fb = excess(mesh, v, u, b);
      if (fa <= 0) rest.push_back(a);
      if ((fa <= 0) != (fb <= 0)) rest.push_back(a + (fa / (fa - fb)) * (b - a));
    }
    cell = rest;
  }
  return cell;
}

bool inside(const Corners& corners, Vec2 x) {
  bool in = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
  }
  return in;
}

bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) { return static_cast<int>(orient2d(p, q, r)); };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

void expect_simple(const Corners& corners) {
  EXPECT_GT(area(corners), 0);
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      EXPECT_FALSE(crosses(corners[i], corners[i + 1], corners[j], corners[(j + 1) % n])) << "sides " << i << ", " << j;
    }
  }
}

/// Expects what holds on any domain, whatever the weights: polygons simple, areas theirs, the whole covered once.
void expect_partition(const Mesh& mesh, const PowerCells& cells, double tolerance = kAbsolute) {
  ASSERT_GT(cells.n_polygons(), 0u);
  ASSERT_EQ(cells.starts.size(), cells.n_polygons() + 1);
  EXPECT_TRUE(std::is_sorted(cells.vertices.begin(), cells.vertices.end()));
  const double whole = test::area(mesh);
  std::vector<double> sums(mesh.n_vertices(), 0.0);
  for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
    const Corners corners = polygon(cells, p);
    ASSERT_GE(corners.size(), 3u);
    expect_simple(corners);
    EXPECT_NEAR(area(corners), cells.polygon_areas[p], tolerance * whole);
    sums[cells.vertices[p].index] += cells.polygon_areas[p];
  }
  for (const VertexId v : mesh.vertices()) EXPECT_NEAR(sums[v.index], cells.areas[v], tolerance * whole);
  EXPECT_NEAR(std::accumulate(cells.areas.begin(), cells.areas.end(), 0.0), whole, tolerance * whole);

  Rng rng(5);
  for (const TriangleId t : mesh.triangles()) {
    const auto [i, j, k] = mesh.corners(t);
    const double a = rng.uniform(0.05, 0.9), b = rng.uniform(0.02, 0.95 - a);
    const Vec2 x = a * mesh.position(i) + b * mesh.position(j) + (1 - a - b) * mesh.position(k);
    int owners = 0;
    for (std::size_t p = 0; p < cells.n_polygons(); ++p) owners += inside(polygon(cells, p), x) ? 1 : 0;
    EXPECT_EQ(owners, 1) << "at (" << x.x << ", " << x.y << ")";
  }
}

TEST(PowerCells, AreHalfPlaneClippingInRegularTriangulationsOfAConvexDomain) {
  Rng rng(11);
  std::size_t compared = 0, away_from_home = 0;
  for (int round = 0; round < 60; ++round) {
    const int n = 4 + round;
    Mesh mesh = test::mesh_of_random_points(rng, n);
    const double amplitude = round % 4 == 0 ? 0 : std::exp2(-round % 5) * 2.0 / n;
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, amplitude * rng.uniform(-1, 1));
    if (!restore_regularity(mesh).regular()) continue;
    ++compared;
    const DecComplex c = dec_operators(mesh);
    const PowerCells cells = power_cells(mesh, c);
    expect_partition(mesh, cells);
    for (const VertexId v : mesh.vertices()) {
      const Corners expected = clipped_square(mesh, v);
      EXPECT_NEAR(cells.areas[v], area(expected), kAbsolute);
      for (const HalfedgeId h : mesh.star(v)) {
        away_from_home += dual_crossing_sign(mesh.point(v), mesh.point(mesh.target(h))) == Sign::negative ? 1 : 0;
      }
    }
    // Within every half-plane and of the same area: the same.
    for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
      const VertexId v = cells.vertices[p];
      EXPECT_TRUE(p == 0 || cells.vertices[p - 1] != v) << "a convex cell is one polygon";
      for (const Vec2 x : polygon(cells, p)) {
        for (const VertexId u : mesh.vertices()) {
          if (u == v) continue;
          const double distance = excess(mesh, v, u, x) / (2 * length(mesh.position(u) - mesh.position(v)));
          EXPECT_LE(distance, kAbsolute) << "vertex " << v.index << " against " << u.index;
        }
      }
    }
  }
  EXPECT_GT(compared, 25u);
  EXPECT_GT(away_from_home, 10u) << "vertices outside of their own cells were to be among them";
}

TEST(PowerCells, OfCocircularPointsOnALatticeAreHalfPlaneClippingToo) {
  Rng rng(12);
  for (int round = 0; round < 15; ++round) {
    Mesh mesh = test::mesh_of_random_points(rng, 30, 6);
    ASSERT_TRUE(restore_regularity(mesh).regular());
    const PowerCells cells = power_cells(mesh, dec_operators(mesh));
    expect_partition(mesh, cells);
    for (const VertexId v : mesh.vertices()) EXPECT_NEAR(cells.areas[v], area(clipped_square(mesh, v)), kAbsolute);
  }
}

double perimeter(const Corners& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) sum += length(corners[(i + 1) % corners.size()] - corners[i]);
  return sum;
}

TEST(PowerCells, ShareFacesThatTogetherWithTheBoundaryAreAllTheirSides) {
  Rng rng(14);
  std::size_t compared = 0, beyond_edges = 0, closed = 0;
  for (int round = 0; round < 40; ++round) {
    Mesh mesh = test::mesh_of_random_points(rng, 5 + round);
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, round % 3 * 0.5 / (5 + round) * rng.uniform(-1, 1));
    if (!restore_regularity(mesh).regular()) continue;
    ++compared;
    const PowerCells cells = power_cells(mesh, dec_operators(mesh));
    double sides = 0, faces = 0, boundary = 8;
    for (std::size_t p = 0; p < cells.n_polygons(); ++p) sides += perimeter(polygon(cells, p));
    IdVector<VertexId, Vec2> outward(mesh.n_vertices());
    IdVector<VertexId, double> areas(mesh.n_vertices(), 0.0);
    for (std::size_t i = 0; i < cells.faces.size(); ++i) {
      const auto& [a, b, width] = cells.faces[i];
      EXPECT_TRUE(a < b && width > 0);
      EXPECT_TRUE(i == 0 || std::pair(cells.faces[i - 1].first, cells.faces[i - 1].second) < std::pair(a, b));
      faces += width;
      const Vec2 along = mesh.position(b) - mesh.position(a);
      const double d = dual_crossing(mesh.point(a), mesh.point(b)), l = length(along);
      outward[a] = outward[a] + (width / l) * along;
      outward[b] = outward[b] - (width / l) * along;
      areas[a] += 0.5 * width * d;
      areas[b] += 0.5 * width * (l - d);
      beyond_edges += mesh.find_halfedge(a, b).valid() || mesh.find_halfedge(b, a).valid() ? 0 : 1;
    }
    EXPECT_NEAR(sides, 2 * faces + boundary, 1e-11);
    for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
      const VertexId v = cells.vertices[p];
      const Corners corners = polygon(cells, p);
      if (std::any_of(corners.begin(), corners.end(),
                      [](Vec2 c) { return std::max(std::abs(c.x), std::abs(c.y)) > 1 - 1e-9; }))
        continue;
      ++closed;
      EXPECT_LT(length(outward[v]), 1e-11) << v.index;
      EXPECT_NEAR(areas[v], cells.areas[v], 1e-11) << v.index;
    }
  }
  EXPECT_GT(compared, 20u);
  EXPECT_GT(closed, 50u);
  EXPECT_EQ(beyond_edges, 0u) << "in a regular triangulation neighbors share an edge";
}

// --- any domain -----------------------------------------------------------------------------------------------

/// Equilateral triangles around a hole, and cut by a notch: well-centered, with reflex corners.
Mesh holed_lattice() {
  const Mesh whole = test::lattice({.n = 9, .jitter = 0.04, .weight = 0.04});
  std::vector<Vec2> points;
  std::vector<double> weights;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> number(whole.n_vertices(), -1);
  for (const TriangleId t : whole.triangles()) {
    Vec2 middle;
    for (const VertexId v : whole.corners(t)) middle = middle + (1.0 / 3) * whole.position(v);
    const double row = middle.y / std::sqrt(0.75), column = middle.x - 0.5 * row;
    const bool hole = column > 2 && column < 4 && row > 2 && row < 5;
    const bool notch = column > 6 && row > 3 && row < 4;
    if (hole || notch) continue;
    std::array<std::int32_t, 3> corners = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = whole.corners(t)[k];
      if (number[v.index] < 0) {
        number[v.index] = static_cast<std::int32_t>(points.size());
        points.push_back(whole.position(v));
        weights.push_back(whole.weight(v));
      }
      corners[k] = number[v.index];
    }
    triangles.push_back(corners);
  }
  return test::mesh_of(points, triangles, weights);
}

TEST(PowerCells, OfAWellCenteredMeshAreItsDualCells) {
  const Mesh mesh = holed_lattice();
  const DecComplex c = dec_operators(mesh);
  ASSERT_EQ(summarize(mesh, c).not_well_centered, 0u);
  const PowerCells cells = power_cells(mesh, c);
  expect_partition(mesh, cells);
  EXPECT_EQ(cells.n_polygons(), mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) EXPECT_NEAR(cells.areas[v], c.star0[v], kAbsolute);
  auto face = cells.faces.begin();
  for (const DecEdge& edge : c.edges) {
    ASSERT_NE(face, cells.faces.end());
    EXPECT_TRUE(face->first == edge.from && face->second == edge.to);
    EXPECT_NEAR(face->width, edge.dual_length, kAbsolute);
    ++face;
  }
}

/// Spokes of different lengths around a tip, from one side of a crack to the other.
Mesh cracked_disk() {
  std::vector<Vec2> points = {{0, 0}};
  std::vector<std::array<std::int32_t, 3>> triangles;
  constexpr int kSpokes = 8;
  for (int i = 0; i < kSpokes; ++i) {
    const double angle = (2 + 356.0 * i / (kSpokes - 1)) * std::numbers::pi / 180, r = 1 - 0.06 * i;
    points.push_back({r * std::cos(angle), r * std::sin(angle)});
    if (i > 0) triangles.push_back({0, i, i + 1});
  }
  return test::mesh_of(points, triangles);
}

TEST(PowerCells, DoNotReachThroughACrack) {
  const Mesh mesh = cracked_disk();
  const DecComplex c = dec_operators(mesh);
  ASSERT_EQ(summarize(mesh, c).not_well_centered, 0u);
  const PowerCells cells = power_cells(mesh, c);
  expect_partition(mesh, cells);
  for (const VertexId v : mesh.vertices()) EXPECT_NEAR(cells.areas[v], c.star0[v], kAbsolute);
  // The bisector of the tip and the last spoke, 0.29 from the tip, would cut into the first triangle, beyond the crack.
  EXPECT_LT(mesh.position(VertexId(8)).x, mesh.position(VertexId(1)).x);
  EXPECT_GT(excess(mesh, VertexId(0), VertexId(8), {0.4, 0.02}), 0);

  Mesh weighted = mesh;  // no triangle plain any more: the same by division
  weighted.set_weight(VertexId(4), 0.5);
  ASSERT_GT(summarize(weighted, dec_operators(weighted)).not_well_centered, 0u);
  const PowerCells divided = power_cells(weighted, dec_operators(weighted));
  expect_partition(weighted, divided);
  for (std::size_t p = 0; p < divided.n_polygons(); ++p) {
    EXPECT_EQ(inside(polygon(divided, p), {0.4, 0.02}), divided.vertices[p] == VertexId(0));
  }
}

TEST(PowerCells, CoverAnyDomainOnceWhateverTheWeights) {
  Rng rng(13);
  std::vector<Mesh> meshes = {*horseshoe(), sparse_horseshoe(), letter_a()};
  meshes.push_back(*airfoil({.around = 24}));
  meshes.push_back(*annulus({.around = 18, .rings = 3}));
  meshes.push_back(*sheared_grid({.nx = 5, .ny = 5}));
  meshes.push_back(*regular_polygon({.corners = 12}));
  meshes.push_back(*wedge({.pieces = 4}));
  for (std::uint64_t seed = 1; seed <= 4; ++seed) meshes.push_back(*random_mesh({.vertices = 60, .seed = seed}));
  for (const Mesh& mesh : meshes) {
    expect_partition(mesh, power_cells(mesh, dec_operators(mesh)));
    for (const double amplitude : {0.1, 1.0}) {  // the second leaves many edges not regular
      Mesh weighted = mesh;
      for (const VertexId v : mesh.vertices()) {
        const double l2 = squared_length(mesh.position(mesh.target(mesh.outgoing(v))) - mesh.position(v));
        weighted.set_weight(v, amplitude * l2 * rng.uniform(-1, 1));
      }
      expect_partition(weighted, power_cells(weighted, dec_operators(weighted)));
      restore_regularity(weighted);
      expect_partition(weighted, power_cells(weighted, dec_operators(weighted)));
    }
  }
}

TEST(PowerCells, ScaleWithTheDomainAndKeepTheirPlaceFarFromTheOrigin) {
  Mesh mesh = *horseshoe(), far = mesh;
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = {std::round(mesh.position(v).x * 0x1p20) * 0x1p-20,
                    std::round(mesh.position(v).y * 0x1p20) * 0x1p-20};
    mesh.set_position(v, p);
    far.set_position(v, {4 * p.x + 0x1p20, 4 * p.y - 0x1p20});
  }
  const PowerCells a = power_cells(mesh, dec_operators(mesh)), b = power_cells(far, dec_operators(far));
  ASSERT_EQ(a.vertices, b.vertices);
  for (const VertexId v : mesh.vertices()) EXPECT_NEAR(16 * a.areas[v], b.areas[v], kAbsolute);
}

}  // namespace
}  // namespace temper
