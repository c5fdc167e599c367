// Cuts of meshes of tetrahedra, and their pictures.
#include "temper/tets/draw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "support/tet_lattice.hpp"
#include "support/tet_layers.hpp"
#include "temper/tets/quality.hpp"
#include "tets/draw/cut.hpp"
#include "unit/draw/svg_reading.hpp"

namespace temper::tets {
namespace {

double area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

/// Cubes with inner vertices and weights off their places.
TetMesh shaken_cubes() {
  const test::TetArrays exact = test::cubes(4, test::kSixTets), moved = test::shaken(exact, 0.2, 0.1);
  TetMesh mesh = test::mesh_of(exact);
  const auto on_boundary = boundary_vertices(mesh);
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = on_boundary[v] != 0 ? exact.points[v.index] : moved.points[v.index];
    mesh.set_point(v, {p.x, p.y, p.z, moved.weights[v.index]});
  }
  EXPECT_EQ(mesh.validate(), std::nullopt);
  return mesh;
}

TEST(TetCut, PiecesFillTheSectionOfTheDomainForPlanesThroughVerticesToo) {
  for (const TetMesh& mesh : {test::mesh_of(test::cubes(4, test::kSixTets)),
                              test::mesh_of(test::cubes(4, test::kFiveTets)), shaken_cubes()}) {
    for (const int axis : {0, 1, 2}) {
      for (const double at : {0.01, 1.0, 1.5, 2.0, 3.7, 4.0}) {
        double sum = 0;
        for (const CutTet& piece : cut(mesh, {axis, at})) {
          EXPECT_EQ(area(piece.corners) > 0, piece.corners.size() > 2);
          sum += area(piece.corners);
        }
        EXPECT_NEAR(sum, 16, 1e-12) << axis << " " << at;
      }
    }
  }
}

TEST(TetCut, PiecesOfNeighborsHaveASideInCommonWhichIsDrawnOnce) {
  const TetMesh mesh = shaken_cubes();
  for (const Plane plane : {Plane{0, 1.3}, Plane{1, 2.0}, Plane{2, 2.6}}) {
    const std::vector<CutTet> pieces = cut(mesh, plane);
    std::map<HalffaceId, std::set<std::pair<double, double>>> sides;
    for (const CutTet& piece : pieces) {
      for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        const Vec2 a = piece.corners[i], b = piece.corners[(i + 1) % piece.corners.size()];
        sides[piece.faces[i]] = {{a.x, a.y}, {b.x, b.y}};
      }
    }
    std::size_t shared = 0;
    for (const auto& [face, ends] : sides) {
      const auto other = sides.find(mesh.twin(face));
      if (other == sides.end()) continue;
      EXPECT_EQ(ends, other->second);
      ++shared;
    }
    EXPECT_GT(shared, sides.size() / 2);
    std::size_t drawn = 0;
    for (const Section::Piece& piece : section_of(mesh, plane).pieces)
      drawn += piece.sides.size() - static_cast<std::size_t>(std::ranges::count(piece.sides, Section::Side::none));
    EXPECT_EQ(drawn, sides.size() - shared / 2);
  }
}

TEST(TetCut, WithTensorsPiecesStayAndMarginsAreThoseOfTheMetrics) {
  const TetMesh mesh = test::two_layers(4, 0.1, 0);
  const MetricMesh pieces = test::pieces_of(mesh, test::kLower, test::kUpper);
  const Plane plane = {0, 1.3};
  const Section plain = section_of(mesh, plane), there = section_of(mesh, plane, pieces.mesh);
  ASSERT_EQ(plain.pieces.size(), there.pieces.size());
  const std::vector<CutTet> cuts = cut(mesh, plane);
  std::size_t bad = 0, others = 0;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    EXPECT_EQ(plain.pieces[i].corners, there.pieces[i].corners);
    const TetId t = cuts[i].tetrahedron;
    EXPECT_EQ(there.pieces[i].bad, !tetrahedron_quality(pieces.mesh.points(t)).well_centered);
    bad += there.pieces[i].bad ? 1 : 0;
    others += there.pieces[i].bad != plain.pieces[i].bad ? 1 : 0;
  }
  EXPECT_GT(bad, 0U);
  EXPECT_GT(others, 0U);
  EXPECT_NE(draw_svg(mesh, plane, {}, {&pieces, 1}), draw_svg(mesh, plane));
}

TEST(TetCut, TheOutlineAndLinesBetweenRegionsAreThickerInPlanesThroughVerticesToo) {
  TetMesh mesh = test::mesh_of(test::cubes(4, test::kSixTets));
  for (const TetId t : mesh.tetrahedra()) mesh.set_region(t, t.index < 192 ? 1 : 2);  // below and above z = 2
  for (const Plane plane : {Plane{0, 1.3}, Plane{1, 2.0}, Plane{1, 4.0}, Plane{2, 2.6}, Plane{2, 3.0}}) {
    double kept = 0;
    for (const Section::Piece& piece : section_of(mesh, plane).pieces) {
      for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        if (piece.sides[i] != Section::Side::kept) continue;
        kept += length(piece.corners[(i + 1) % piece.corners.size()] - piece.corners[i]);
      }
    }
    EXPECT_NEAR(kept, plane.axis == 2 ? 16 : 20, 1e-12) << plane.axis << " " << plane.at;
  }
}

TEST(TetCut, APlaneBesideTheMeshCutsNothingAndTheMiddleOneIsAcrossTheShortestSide) {
  TetMesh mesh = test::mesh_of(test::cubes(2, test::kSixTets));
  EXPECT_TRUE(cut(mesh, {1, 0}).empty());  // all vertices are on it or above
  EXPECT_TRUE(cut(mesh, {1, 2.001}).empty());
  for (const double at : {-0.001, 0.0, 2.001, std::nan("")}) EXPECT_FALSE(plane_through(mesh, 1, at)) << at;
  for (const double at : {1e-9, 2.0}) EXPECT_EQ(*plane_through(mesh, 1, at), (Plane{1, at}));
  EXPECT_EQ(middle_plane(mesh), (Plane{2, 1}));
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = mesh.position(v);
    mesh.set_point(v, {p.x / 2, p.y, p.z, 0});
  }
  EXPECT_EQ(middle_plane(mesh), (Plane{0, 0.5}));
}

TEST(TetCut, ThePictureHasTheBadOnesOfItsCaptionAndColorsOfItsLegend) {
  const TetMesh mesh = shaken_cubes();
  const Plane plane = {2, 2.5};
  std::size_t bad = 0, all = 0;
  for (const CutTet& piece : cut(mesh, plane)) {
    if (piece.corners.size() < 3) continue;
    bad += !tetrahedron_quality(mesh.points(piece.tetrahedron)).well_centered;
    ++all;
  }
  ASSERT_GT(bad, 0U);
  ASSERT_LT(bad, all);
  const std::string svg = draw_svg(mesh, plane);
  test::expect_well_formed(svg);
  EXPECT_NE(svg.find(">" + std::to_string(bad) + "</tspan> of " + std::to_string(all) + " tetrahedra bad at z = 2.5<"),
            std::string::npos);
  EXPECT_NE(svg.find("bad tetrahedron"), std::string::npos);
  EXPECT_NE(svg.find("margin: 0 to 0.2"), std::string::npos);
  const std::string margin = "class=\"margin\" fill=\"";
  std::set<std::string> colors;
  for (std::size_t at = svg.find(margin); at != std::string::npos; at = svg.find(margin, at + 1)) {
    const std::string color = svg.substr(at + margin.size(), 7);
    EXPECT_NE(svg.find("height=\"0.9\" fill=\"" + color + "\""), std::string::npos) << color;
    colors.insert(color);
  }
  EXPECT_GT(colors.size(), 2U);
  const std::string both = draw_before_after_svg(test::mesh_of(test::body_centered(2)), mesh, plane);
  test::expect_well_formed(both);
  EXPECT_EQ(test::count(both, "tetrahedra bad at z = 2.5"), 2U);
}

}  // namespace
}  // namespace temper::tets
