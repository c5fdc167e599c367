// Cells as polygons with shared corners: their laws against the operators, on meshes with weights.
#include "temper/detail/cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/generate.hpp"
#include "temper/mesher.hpp"

namespace temper {
namespace {

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::vector<Vec2> corners_of(const CellPolygons& cells, std::size_t polygon) {
  std::vector<Vec2> corners;
  for (const std::uint32_t corner : cells.polygon(polygon)) corners.push_back(cells.points[corner]);
  return corners;
}

double shoelace(const std::vector<Vec2>& corners) {
  double doubled = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    doubled += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  return doubled / 2;
}

/// A mesh with region 3 on the left of a line, and region 1 on its right.
void divide(Mesh& mesh, double x) {
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.points(t);
    mesh.set_region(t, (a.x + b.x + c.x) / 3 < x ? 3 : 1);
  }
}

TEST(CellPolygons, PowerCellsHaveTheAreasOfTheOperatorsAndOfTheirCorners) {
  const Mesh mesh = test::lattice({.n = 9});
  const DecComplex complex = dec_operators(mesh);
  const CellPolygons cells = cell_polygons(mesh, complex);
  ASSERT_EQ(cells.n_polygons(), mesh.n_vertices());
  for (std::size_t i = 0; i < cells.n_cells(); ++i) {
    EXPECT_EQ(cells.cells[i], i);
    EXPECT_NEAR(cells.areas[i], complex.star0[VertexId(i)], 1e-13) << i;
    EXPECT_NEAR(cells.polygon_areas[i], shoelace(corners_of(cells, i)), 1e-12) << i;
    EXPECT_EQ(cells.centers[i], mesh.position(VertexId(i)));
  }
  EXPECT_NEAR(sum_of(cells.areas), test::area(mesh), 1e-12);
}

TEST(CellPolygons, InsideTheyAreConvex) {
  const Mesh mesh = test::lattice({.n = 9});
  const CellPolygons cells = cell_polygons(mesh, dec_operators(mesh));
  std::size_t inner = 0;
  for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
    if (mesh.is_boundary(VertexId(cells.cells[p]))) continue;
    ++inner;
    const std::vector<Vec2> c = corners_of(cells, p);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Vec2 a = c[i], b = c[(i + 1) % c.size()], d = c[(i + 2) % c.size()];
      EXPECT_GT(cross(b - a, d - b), 0) << p;
    }
  }
  EXPECT_EQ(inner, 49u);
}

TEST(CellPolygons, NeighborsShareTheTwoCornersOfTheDualOfTheirEdge) {
  const Mesh mesh = test::lattice({.n = 8});
  const DecComplex complex = dec_operators(mesh);
  const CellPolygons cells = cell_polygons(mesh, complex);
  ASSERT_EQ(cells.faces.size(), complex.edges.size());
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const DecEdge& edge = complex.edges[EdgeId(e)];
    const CellFace& face = cells.faces[e];
    EXPECT_EQ(face.first, edge.from.index);
    EXPECT_EQ(face.second, edge.to.index);
    EXPECT_NEAR(face.width, edge.dual_length, 1e-13);
    EXPECT_NEAR(face.first_distance, edge.crossing, 1e-13);
    EXPECT_NEAR(face.second_distance, edge.length - edge.crossing, 1e-13);
    const auto a = cells.polygon(face.first), b = cells.polygon(face.second);
    std::vector<std::uint32_t> common;
    std::ranges::copy_if(a, std::back_inserter(common),
                         [&](std::uint32_t c) { return std::ranges::find(b, c) != b.end(); });
    ASSERT_EQ(common.size(), 2u) << e;
    EXPECT_NEAR(length(cells.points[common[0]] - cells.points[common[1]]), edge.dual_length, 1e-12);
  }
}

TEST(CellPolygons, NumbersOfPointsFollowEulersFormula) {
  const Mesh mesh = test::lattice({.n = 8});
  const DecComplex complex = dec_operators(mesh);
  const CellPolygons cells = cell_polygons(mesh, complex);
  const auto boundary = static_cast<std::size_t>(std::ranges::count_if(complex.edges, &DecEdge::is_boundary));
  EXPECT_EQ(cells.points.size(), mesh.n_triangles() + 2 * boundary)
      << "orthocenters, and on the boundary vertices and midpoints";
}

TEST(CellPolygons, PartsOfCellsInRegionsSumToTheRegions) {
  Mesh random = *random_mesh({.vertices = 200, .seed = 5});  // not well-centered: cells of pieces
  Mesh lattice = test::lattice({.n = 9});
  double middle = 0;
  for (const VertexId v : lattice.vertices())
    middle += lattice.position(v).x / static_cast<double>(lattice.n_vertices());
  divide(lattice, middle);
  divide(random, 0.5);
  for (const Mesh* mesh : {&lattice, &random}) {
    const CellPolygons cells = cell_polygons(*mesh, dec_operators(*mesh));
    std::map<std::int32_t, double> expected, found;
    for (const TriangleId t : mesh->triangles()) {
      const auto [a, b, c] = mesh->points(t);
      expected[mesh->region(t)] += 0.5 * cross(b.position() - a.position(), c.position() - a.position());
    }
    std::size_t shared = 0;
    for (std::size_t i = 0; i < cells.n_cells(); ++i) {
      EXPECT_GE(cells.region_shares[i], 0.5 - 1e-12) << "the larger one of two";
      EXPECT_LE(cells.region_shares[i], 1);
      shared += cells.region_shares[i] < 1 ? 1 : 0;
      found[cells.regions[i]] += cells.areas[i] * cells.region_shares[i];
      found[4 - cells.regions[i]] += cells.areas[i] * (1 - cells.region_shares[i]);
    }
    EXPECT_GT(shared, 5u);
    EXPECT_LT(shared, cells.n_cells() / 2);
    for (const auto& [region, area] : expected) EXPECT_NEAR(found[region], area, 1e-11 * area) << region;
  }
}

TEST(CellPolygons, OfEqualPartsTheLowestRegionCounts) {
  Mesh mesh = test::mesh_of({{0, 0}, {1, 0}, {0.5, 0.9}, {0.5, -0.9}}, {{0, 1, 2}, {1, 0, 3}});
  mesh.set_region(TriangleId(0), 7);
  mesh.set_region(TriangleId(1), 2);
  const CellPolygons cells = cell_polygons(mesh, dec_operators(mesh));
  EXPECT_EQ(cells.regions, (std::vector<std::int32_t>{2, 2, 7, 2}));
  EXPECT_EQ(cells.region_shares[2], 1);
  EXPECT_EQ(cells.region_shares[0], 0.5);
}

TEST(CellPolygons, TrianglesHaveOrthocentersAndHeights) {
  const Mesh mesh = test::lattice({.n = 6});
  const DecComplex complex = dec_operators(mesh);
  const CellPolygons cells = cell_polygons(mesh, complex, CellsOf::triangles);
  ASSERT_EQ(cells.n_cells(), mesh.n_triangles());
  EXPECT_EQ(cells.centers, complex.orthocenters.raw());
  EXPECT_EQ(cells.points.size(), mesh.n_vertices());
  for (const TriangleId t : mesh.triangles())
    EXPECT_NEAR(cells.areas[t.index], shoelace(corners_of(cells, t.index)), 1e-13);
  EXPECT_EQ(cells.faces.size(), static_cast<std::size_t>(std::ranges::count_if(
                                    complex.edges, [](const DecEdge& e) { return !e.is_boundary(); })));
  for (const CellFace& face : cells.faces) {
    EXPECT_LT(face.first, face.second);
    EXPECT_NEAR(face.first_distance + face.second_distance,
                length(cells.centers[face.second] - cells.centers[face.first]), 1e-12);
  }
}

TEST(CellPolygons, OnTheSphereTheyShareCornersAndCoverIt) {
  const Mesh mesh = *random_sphere({.vertices = 300, .radius = 2});
  for (const CellsOf of : {CellsOf::vertices, CellsOf::triangles}) {
    const CellPolygons cells = cell_polygons(mesh, dec_operators(mesh), of);
    EXPECT_NEAR(sum_of(cells.areas), 16 * std::numbers::pi, 1e-9);
    EXPECT_EQ(cells.sphere_points.size(), of == CellsOf::vertices ? mesh.n_triangles() : mesh.n_vertices());
    EXPECT_TRUE(cells.points.empty());
    for (const Vec3 p : cells.sphere_points) EXPECT_NEAR(length(p), 2, 1e-12);
  }
}

TEST(CellPolygons, InAPeriodicPlaneCornersAreNearTheirCells) {
  const Mesh mesh = *random_periodic({.vertices = 100});
  for (const CellsOf of : {CellsOf::vertices, CellsOf::triangles}) {
    const CellPolygons cells = cell_polygons(mesh, dec_operators(mesh), of);
    for (std::size_t p = 0; p < cells.n_polygons(); ++p)
      EXPECT_NEAR(cells.polygon_areas[p], shoelace(corners_of(cells, p)), 1e-12) << p;
    const Vec2 period = mesh.space().period();
    EXPECT_NEAR(sum_of(cells.areas), period.x * period.y, 1e-12);
  }
}

/// Two regions with a border that becomes faces; and faults that cross, end inside, and end on the boundary.
Outline faults() {
  Outline o;
  o.points = {{0, 0},      {1300, 0},   {2500, 0},  {2500, 1500}, {1200, 1500}, {0, 1500},   {300, 400},
              {1000, 600}, {400, 1200}, {900, 250}, {2500, 700},  {1800, 400},  {1600, 900}, {2200, 1200}};
  const auto add = [&](std::initializer_list<std::int32_t> line, LineKind as) {
    for (const std::int32_t* p = line.begin(); p + 1 != line.end(); ++p) o.segments.push_back({{p[0], p[1]}, 1, as});
  };
  add({0, 1, 2, 3, 4, 5, 0}, LineKind::edges);
  add({1, 4}, LineKind::faces);
  add({6, 7}, LineKind::faces);
  add({8, 9}, LineKind::faces);
  add({10, 11, 12, 13}, LineKind::faces);
  o.regions = {{{100, 100}, 10, {}}, {{2400, 100}, 20, {}}};
  return o;
}

Mesh mesh_of_faults() {
  MesherOptions options;
  options.size = 120;
  options.split_crossings = true;
  options.optimize->scheme = Scheme::vertex;
  return mesh_outline(faults(), options)->mesh;
}

// Duals around ends of faces are zero, but rounding of large coordinates gives them signs.
TEST(CellPolygons, OnFacesAreTheSameInCoordinatesOfMaps) {
  const Mesh here = mesh_of_faults();
  Mesh there = here;
  for (const VertexId v : there.vertices()) there.set_position(v, there.position(v) + Vec2{500'000.3, 5'800'000.7});
  const CellPolygons cells = cell_polygons(here, dec_operators(here)),
                     shifted = cell_polygons(there, dec_operators(there));
  ASSERT_EQ(cells.n_polygons(), here.n_vertices()) << "each cell is one polygon";
  EXPECT_EQ(shifted.cells, cells.cells);
  EXPECT_EQ(shifted.starts, cells.starts);
  EXPECT_EQ(shifted.corners, cells.corners);
  EXPECT_EQ(shifted.regions, cells.regions);
  for (std::size_t i = 0; i < cells.n_cells(); ++i) {
    EXPECT_NEAR(shifted.areas[i] / cells.areas[i], 1, 1e-9) << i;
    EXPECT_NEAR(shifted.region_shares[i], cells.region_shares[i], 1e-9) << i;
  }
  ASSERT_EQ(shifted.faces.size(), cells.faces.size());
  for (std::size_t i = 0; i < cells.faces.size(); ++i) {
    EXPECT_EQ(shifted.faces[i].first, cells.faces[i].first);
    EXPECT_EQ(shifted.faces[i].second, cells.faces[i].second);
    EXPECT_NEAR(shifted.faces[i].width, cells.faces[i].width, 1e-7);
  }
}

TEST(CellPolygons, AroundEndsOfFacesOnlyTouch) {
  const Mesh mesh = mesh_of_faults();
  const DecComplex complex = dec_operators(mesh);
  std::set<std::array<std::uint32_t, 2>> joined;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_joint(h) || mesh.is_boundary(h)) continue;
    EXPECT_EQ(complex.star1[complex.edge_of_halfedge[h]], 0);
    EXPECT_EQ(complex.orthocenters[Mesh::triangle(h)], complex.orthocenters[Mesh::triangle(mesh.twin(h))]);
    joined.insert({std::min(mesh.origin(h), mesh.target(h)).index, std::max(mesh.origin(h), mesh.target(h)).index});
  }
  EXPECT_GT(joined.size(), 20U);
  EXPECT_EQ(summarize(mesh, complex).zero_star1, 0U) << "these have no sign";
  for (const CellFace& face : cell_polygons(mesh, complex).faces) {
    EXPECT_FALSE(joined.contains({face.first, face.second}));
    EXPECT_GT(face.width, 1e-9) << "no face by rounding";
  }
}

}  // namespace
}  // namespace temper
