// Columns under layers: volumes, areas and connections that add up, on meshes with weights.
#include "temper/detail/columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Expected<Columns> columns_of(const Mesh& mesh, const Layers& layers, const ColumnOptions& options = {}) {
  const DecComplex complex = dec_operators(mesh);
  return columns(mesh, complex, cell_polygons(mesh, complex), layers, options);
}
Expected<Columns> columns_of_triangles(const Mesh& mesh, const Layers& at_vertices, const ColumnOptions& options = {}) {
  const DecComplex complex = dec_operators(mesh);
  const Layers layers = layers_of_triangles(mesh, at_vertices);
  return columns(mesh, complex, cell_polygons(mesh, complex, CellsOf::triangles), layers, options);
}

/// The same surfaces everywhere.
Layers flat(const Mesh& mesh, const std::vector<double>& surfaces) {
  Layers layers = {surfaces.size() - 1, {}, {}};
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v)
    layers.surfaces.insert(layers.surfaces.end(), surfaces.begin(), surfaces.end());
  return layers;
}

/// Layers that dip and thin out, some to nothing.
Layers dipping(const Mesh& mesh, std::size_t n_layers) {
  Layers layers = {n_layers, {}, {}};
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    double z = 10 + 0.3 * p.x - 0.2 * p.y;
    layers.surfaces.push_back(z);
    for (std::size_t k = 0; k < n_layers; ++k) {
      z -= std::max(0.0, 0.5 + 0.4 * std::sin(2.0 * p.x + static_cast<double>(k)) - 0.3);
      layers.surfaces.push_back(z);
    }
  }
  return layers;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(Columns, VolumesOfALayerAreItsThicknessOverTheDomain) {
  const Mesh mesh = test::lattice({.n = 7});
  const auto made = columns_of(mesh, flat(mesh, {3, 2.5, 0}));
  ASSERT_TRUE(made);
  const auto middle = made->volumes.begin() + static_cast<std::ptrdiff_t>(mesh.n_vertices());
  EXPECT_NEAR(std::accumulate(made->volumes.begin(), middle, 0.0), 0.5 * test::area(mesh), 1e-12);
  EXPECT_NEAR(std::accumulate(middle, made->volumes.end(), 0.0), 2.5 * test::area(mesh), 1e-12);
}

TEST(Columns, VolumesOfAThicknessThatVariesComeNearerToItsIntegralAsTheMeshIsRefined) {
  // Over [0, 1]² with x² + 1 the integral is 4/3; grids of right triangles are regular.
  std::vector<double> errors;
  for (const int n : {4, 8, 16}) {
    const Mesh mesh = *sheared_grid({.nx = n, .ny = n, .shear = 0});
    Layers layers = {1, {}, {}};
    double low = kNone, high = kNone;
    for (const VertexId v : mesh.vertices()) {
      low = std::fmin(low, mesh.position(v).x), high = std::fmax(high, mesh.position(v).x);
    }
    double exact = 0;
    for (const VertexId v : mesh.vertices()) {
      const double x = (mesh.position(v).x - low) / (high - low);
      layers.surfaces.insert(layers.surfaces.end(), {x * x + 1, 0});
    }
    exact = 4.0 / 3 * test::area(mesh);
    const auto made = columns_of(mesh, layers);
    ASSERT_TRUE(made) << made.error().what();
    errors.push_back(std::abs(sum(made->volumes) - exact) / exact);
  }
  EXPECT_LT(errors[1], 0.3 * errors[0]);
  EXPECT_LT(errors[2], 0.3 * errors[1]);
}

TEST(Columns, ConnectionsAreEachOnceAscendingAndPositive) {
  const Mesh mesh = test::lattice({.n = 8});
  const auto made = columns_of(mesh, dipping(mesh, 4));
  ASSERT_TRUE(made) << made.error().what();
  const Columns& c = *made;
  EXPECT_GT(std::count(c.states.begin(), c.states.end(), CellState::pinched_out), 10);
  std::pair<std::uint32_t, std::uint32_t> last = {0, 0};
  for (const ColumnConnection& k : c.connections) {
    EXPECT_LT(last, std::pair(k.first, k.second));
    last = {k.first, k.second};
    EXPECT_LT(k.first, k.second);
    EXPECT_TRUE(c.is_active(k.first) && c.is_active(k.second));
    EXPECT_GT(std::min({k.first_distance, k.second_distance, k.area}), 0);
    const VertexId a(c.column(k.first)), b(c.column(k.second));
    EXPECT_EQ(k.is_vertical, a == b);
    EXPECT_EQ(k.is_vertical, c.layer(k.first) != c.layer(k.second));
    if (k.is_vertical) {
      EXPECT_EQ(k.area, c.plan.areas[a.index]);
      EXPECT_NEAR(k.first_distance + k.second_distance, c.center(k.first) - c.center(k.second), 1e-12)
          << "what is pinched out is of no thickness";
    } else {
      EXPECT_NEAR(k.first_distance + k.second_distance, length(mesh.position(b) - mesh.position(a)), 1e-12);
      const double ta = c.tops[k.first] - c.bottoms[k.first], tb = c.tops[k.second] - c.bottoms[k.second];
      EXPECT_GE(k.area, k.width * std::min(ta, tb) * (1 - 1e-12));
      EXPECT_LE(k.area, k.width * std::max(ta, tb) * (1 + 1e-12));
    }
  }
}

TEST(Columns, FacesCloseTheCellsOfInnerVertices) {
  const Mesh mesh = test::lattice({.n = 8});
  const auto made = columns_of(mesh, flat(mesh, {1, 0}));
  ASSERT_TRUE(made);
  IdVector<VertexId, Vec2> outward(mesh.n_vertices());
  IdVector<VertexId, double> areas(mesh.n_vertices(), 0.0);
  for (const ColumnConnection& k : made->connections) {
    const VertexId a(made->column(k.first)), b(made->column(k.second));
    const Vec2 along = mesh.position(b) - mesh.position(a);
    const Vec2 normal = (k.area / length(along)) * along;
    outward[a] = outward[a] + normal;
    outward[b] = outward[b] - normal;
    areas[a] += 0.5 * k.width * k.first_distance;
    areas[b] += 0.5 * k.width * k.second_distance;
  }
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    EXPECT_LT(length(outward[v]), 1e-13) << v.index;
    EXPECT_NEAR(areas[v], made->plan.areas[v.index], 1e-13) << v.index;
  }
}

TEST(Columns, WhatIsAbovePinchedOutLayersIsConnectedToWhatIsBelow) {
  const Mesh mesh = test::one_triangle({0, 0}, {1, 0}, {0.5, 0.8});
  Layers layers = flat(mesh, {4, 3, 3, 3, 1});
  layers.surfaces[5 + 2] = layers.surfaces[5 + 3] = 2.5;  // of vertex 1 layer 2 is half thick
  const auto made = columns_of(mesh, layers);
  ASSERT_TRUE(made);
  const Columns& c = *made;
  EXPECT_EQ(c.states[c.cell(0, 1)], CellState::pinched_out);
  std::map<std::pair<std::uint32_t, std::uint32_t>, ColumnConnection> found;
  for (const ColumnConnection& k : c.connections) found[{k.first, k.second}] = k;
  ASSERT_TRUE(found.contains({0, 9})) << "across two layers";
  EXPECT_EQ(found.at({0, 9}).first_distance, 0.5);
  EXPECT_EQ(found.at({0, 9}).second_distance, 1);
  EXPECT_TRUE(found.contains({1, 4}) && found.contains({4, 10}) && !found.contains({1, 10}));
  EXPECT_TRUE(!found.contains({3, 4})) << "nobody is beside a cell that its layer has alone";
}

TEST(Columns, ThinLayersArePinchedOutToo) {
  const Mesh mesh = test::one_triangle({0, 0}, {1, 0}, {0.5, 0.8});
  const Layers layers = flat(mesh, {2, 1, 0.75, 0});
  EXPECT_EQ(columns_of(mesh, layers)->connections.size(), 3u * 3 + 3 * 2);
  const auto made = columns_of(mesh, layers, {0.25, nullptr});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->states[3], CellState::pinched_out);
  EXPECT_EQ(made->connections.size(), 2u * 3 + 3);
  EXPECT_NEAR(sum(made->volumes), 1.75 * test::area(mesh), 1e-14);
}

TEST(Columns, NothingGoesThroughWhatIsInactive) {
  const Mesh mesh = test::one_triangle({0, 0}, {1, 0}, {0.5, 0.8});
  Layers layers = flat(mesh, {4, 3, 2, 1});
  layers.active.assign(9, 1);
  layers.active[1] = 0;            // of vertex 0 the middle
  layers.surfaces[4 + 3] = kNone;  // of vertex 1 the lowest surface
  layers.surfaces[8] = kNone;      // of vertex 2 the highest
  const auto made = columns_of(mesh, layers);
  ASSERT_TRUE(made);
  const Columns& c = *made;
  using enum CellState;
  EXPECT_EQ(c.states,
            (std::vector<CellState>{active, active, inactive, inactive, active, active, active, inactive, active}));
  EXPECT_EQ(c.tops[c.cell(2, 0)], 3) << "all heights are numbers";
  EXPECT_EQ(c.bottoms[c.cell(1, 2)], 2);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const ColumnConnection& k : c.connections) found.emplace_back(k.first, k.second);
  EXPECT_EQ(found, (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}, {1, 4}, {4, 5}, {5, 8}, {6, 8}}));
}

TEST(Columns, BelowTrianglesTheyHaveOrthocentersAsCentersAndEdgesAsFaces) {
  const Mesh mesh = test::lattice({.n = 8});  // well-centered
  const auto made = columns_of_triangles(mesh, flat(mesh, {3, 1, 0}));
  ASSERT_TRUE(made) << made.error().what();
  const Columns& c = *made;
  ASSERT_EQ(c.n_columns(), mesh.n_triangles());
  std::vector<Vec2> outward(c.n_columns());
  std::vector<double> areas(c.n_columns(), 0.0);
  std::size_t beside = 0;
  for (const ColumnConnection& k : c.connections) {
    const std::size_t a = c.column(k.first), b = c.column(k.second);
    EXPECT_GT(std::min({k.first_distance, k.second_distance, k.area}), 0);
    EXPECT_EQ(k.is_vertical, a == b);
    if (k.is_vertical || c.layer(k.first) != 0) continue;
    ++beside;
    const Vec2 along = c.plan.centers[b] - c.plan.centers[a];
    EXPECT_NEAR(k.first_distance + k.second_distance, length(along), 1e-12);
    outward[a] = outward[a] + (k.width / length(along)) * along;
    outward[b] = outward[b] - (k.width / length(along)) * along;
    areas[a] += 0.5 * k.width * k.first_distance;
    areas[b] += 0.5 * k.width * k.second_distance;
  }
  EXPECT_GT(beside, mesh.n_triangles());
  for (const TriangleId t : mesh.triangles()) {
    const bool inner =
        std::ranges::none_of(std::array{0, 1, 2}, [&](int i) { return mesh.is_boundary(Mesh::halfedge(t, i)); });
    if (!inner) continue;
    EXPECT_LT(length(outward[t.index]), 1e-12) << t.index;
    EXPECT_NEAR(areas[t.index], c.plan.areas[t.index], 1e-12) << t.index;
  }
}

TEST(Columns, BelowTrianglesVolumesAreThoseBetweenSurfacesThatAreLinearOnThem) {
  const Mesh mesh = test::lattice({.n = 6});
  Layers layers = {1, {}, {}};
  double volume = 0;  // of a plane over the domain: its height in the middle of each triangle, times the area
  const auto top = [](Vec2 p) { return 5 + 0.3 * p.x - 0.7 * p.y; };
  for (const VertexId v : mesh.vertices()) layers.surfaces.insert(layers.surfaces.end(), {top(mesh.position(v)), 0});
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.points(t);
    const Vec2 middle = (1.0 / 3) * (a.position() + b.position() + c.position());
    volume += 0.5 * cross(b.position() - a.position(), c.position() - a.position()) * top(middle);
  }
  const auto made = columns_of_triangles(mesh, layers);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_NEAR(sum(made->volumes), volume, 1e-12 * volume);
}

TEST(Columns, BelowTrianglesALayerIsActiveIfItIsAtAllCorners) {
  const Mesh mesh = test::mesh_of({{0, 0}, {1, -0.6}, {1, 0.6}, {2, 0}}, {{0, 1, 2}, {1, 3, 2}});
  Layers layers = flat(mesh, {3, 2, 1});
  layers.active = {1, 0, 1, 1, 1, 1, 1, 1};
  const auto made = columns_of_triangles(mesh, layers);
  ASSERT_TRUE(made) << made.error().what();
  using enum CellState;
  EXPECT_EQ(made->states, (std::vector<CellState>{active, active, inactive, active}));
  layers.active.clear();
  layers.surfaces[3 * 3 + 2] = kNone;  // of vertex 3 the lowest surface
  EXPECT_EQ(columns_of_triangles(mesh, layers)->states, (std::vector<CellState>{active, active, active, inactive}));
}

TEST(Columns, BelowTrianglesAnOrthocenterBehindAnEdgeIsTold) {
  const Mesh obtuse = test::mesh_of({{0, 0}, {1, -0.2}, {2, 0}, {1, 3}}, {{0, 1, 2}, {0, 2, 3}});
  const auto made = columns_of_triangles(obtuse, flat(obtuse, {2, 1}));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().what(),
            "triangle 0: its orthocenter is not on its side of the edge to triangle 1, so that the edge is not between "
            "the two centers. Next: temper optimize --for cell");
}

TEST(Columns, BadInputIsTold) {
  const Mesh mesh = test::lattice({.n = 4});
  const auto message = [](const Expected<Columns>& made) { return made ? "nothing" : made.error().what(); };
  EXPECT_EQ(message(columns_of(mesh, {1, {1, 0}, {}})), "surfaces: expected 32 numbers, found 2");
  EXPECT_EQ(message(columns_of(mesh, {0, {}, {}})), "expected one layer or more, found none");
  EXPECT_EQ(message(columns_of(mesh, flat(mesh, {1, 2}))), "point 0: bottom 1 is 2, higher than the top, which is 1");
  EXPECT_EQ(message(columns_of(mesh, flat(mesh, {3, kNone, 4}))),
            "point 0: bottom 2 is 4, higher than the top, which is 3");
  EXPECT_EQ(message(columns_of(mesh, flat(mesh, {HUGE_VAL, 2}))), "point 0: the top is infinite, expected a height");
  EXPECT_EQ(message(columns_of(mesh, flat(mesh, {2, 2}))), "no cell is active: all are inactive or pinched out");
  EXPECT_EQ(message(columns_of(mesh, flat(mesh, {2, 1}), {-1, nullptr})),
            "pinch_out: expected a length, 0 or more, found -1");
  Layers short_of = flat(mesh, {2, 1});
  short_of.active = {1};
  EXPECT_EQ(message(columns_of(mesh, short_of)), "active: expected 16 numbers, found 1");
  const Mesh flipped = test::mesh_of({{0, 0}, {1, -0.2}, {2, 0}, {1, 0.2}}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_EQ(message(columns_of(flipped, flat(flipped, {2, 1}))),
            "point 0: its edge to point 2 is not regular, so that faces of cells there are not at right angles to "
            "connections; temper optimize makes meshes regular");
  // Of vertex 0 there is a cell, but on its far side, seen from vertex 1.
  const Mesh heavy =
      test::mesh_of({{0, 0}, {1, 0}, {-2, 1}, {-2, -1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}, {0, 1.2, 0, 0});
  EXPECT_EQ(message(columns_of(heavy, flat(heavy, {2, 1}))),
            "point 0: the face of its cell to that of point 1 is behind it, not between the two; temper optimize makes "
            "meshes where it is");
  const Mesh globe = test::lattice({.n = 4, .radius = 10});
  EXPECT_NE(message(columns_of(globe, flat(globe, {2, 1}))).find("columns()"), std::string::npos);
}

}  // namespace
}  // namespace temper
