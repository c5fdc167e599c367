// Whole pictures: well-formed, deterministic, each option does what it says, and small enough at 100,000 triangles.
#include "temper/draw.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "unit/draw/svg_reading.hpp"

namespace temper {
namespace {

using test::count;
using test::expect_well_formed;
using test::lattice;
using test::mesh_of;

bool has_class(const std::string& svg, const std::string& name) {
  return svg.find("class=\"" + name + "\"") != std::string::npos;
}

// The d attribute of the path of that class.
std::string path_of(const std::string& svg, const std::string& name) {
  const std::size_t at = svg.find("class=\"" + name + "\"");
  if (at == std::string::npos) return "";
  const std::size_t begin = svg.find(" d=\"", at) + 4;
  return svg.substr(begin, svg.find('"', begin) - begin);
}

Mesh everything() {
  Mesh mesh = lattice({.n = 10, .jitter = 0.3, .weight = 0.3});
  for (TriangleId t : mesh.triangles()) mesh.set_region(t, t.index < 81 ? 1 : 2);
  for (HalfedgeId h : mesh.halfedges()) {
    const HalfedgeId twin = mesh.twin(h);
    if (twin.valid() && mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(twin))) {
      mesh.set_constrained(h, true);
    }
  }
  const VertexId a(44), b(45);
  mesh.set_position(a, mesh.position(b) + Vec2{-0.01, 0});
  return mesh;
}

TEST(Draw, ColorsAreOnOneScaleOfAllPanelsInsteadOfBadTriangles) {
  const Mesh mesh = everything();
  DrawOptions options;
  options.colors = TriangleColors{"a < b", {}};
  for (const double shift : {0.0, 100.0}) {
    IdVector<TriangleId, double> values;
    for (TriangleId t : mesh.triangles()) values.push_back(shift + static_cast<double>(t.index % 50));
    values[TriangleId(3)] = std::numeric_limits<double>::infinity();
    values[TriangleId(4)] = std::numeric_limits<double>::quiet_NaN();
    options.colors->values.push_back(values);
  }
  const std::string svg = draw_before_after_svg(mesh, mesh, options);
  expect_well_formed(svg);
  EXPECT_TRUE(has_class(svg, "value"));
  EXPECT_FALSE(has_class(svg, "bad"));
  EXPECT_FALSE(has_class(svg, "margin"));
  EXPECT_NE(svg.find("a &lt; b: 0 to 149"), std::string::npos);
  // 0 to 49 and 100 to 149, of ten colors four in each panel; and infinity has the last one in both.
  EXPECT_EQ(count(svg, "class=\"value\""), 9u);
}

TEST(Draw, LightIsGoodAlsoWhereLessIsBetter) {
  const Mesh mesh = lattice({.n = 4});
  DrawOptions options;
  options.colors = TriangleColors{"angle", {}};
  IdVector<TriangleId, double> values;
  for (TriangleId t : mesh.triangles()) values.push_back(t.index == 0 ? 0 : 1);
  options.colors->values.push_back(values);
  const auto color_of = [](const std::string& svg, std::size_t number) {
    std::size_t at = 0;
    for (std::size_t i = 0; i <= number; ++i) at = svg.find("class=\"value\" fill=\"", at + 1);
    return svg.substr(at + 20, 7);
  };
  const std::string larger = draw_svg(mesh, options);
  options.colors->better = Preference::less;
  const std::string less = draw_svg(mesh, options);
  // Dark paths come first: one triangle is dark if larger is better, all others if less is.
  EXPECT_EQ(color_of(larger, 0), color_of(less, 0));
  EXPECT_NE(path_of(larger, "value"), path_of(less, "value"));
  EXPECT_LT(path_of(larger, "value").size(), path_of(less, "value").size());
  EXPECT_LT(larger.rfind("#7690c8"), larger.rfind("#fff2a0"));  // of the legend, from the least value on
  EXPECT_GT(less.rfind("#7690c8"), less.rfind("#fff2a0"));
}

TEST(Draw, DotsMarkFixedPointsThatAreOnNoLine) {
  Mesh mesh = everything();
  EXPECT_FALSE(has_class(draw_svg(mesh), "fixed"));
  VertexId inside, on_line;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    bool line = false;
    for (const HalfedgeId h : mesh.star(v)) line = line || mesh.is_constrained(h);
    (line ? on_line : inside) = v;
  }
  mesh.set_fixed(on_line, true);
  EXPECT_FALSE(has_class(draw_svg(mesh), "fixed"));
  mesh.set_fixed(inside, true);
  const std::string svg = draw_svg(mesh);
  EXPECT_TRUE(has_class(svg, "fixed"));
  EXPECT_NE(svg.find("fixed point"), std::string::npos);
}

TEST(Draw, LinesOnFacesOfCellsAreThickAndHaveNamesWhereTheyAreSeen) {
  const Mesh mesh = lattice({.n = 10, .jitter = 0.1});
  DrawOptions options;
  options.cells = RegionCells{{cell_polygons(mesh, dec_operators(mesh), CellsOf::vertices)}};
  const std::string plain = draw_svg(mesh, options);
  options.cells->lines = {
      {{"a < b", {{Vec2{1, 1}, Vec2{3, 2}}, {Vec2{3, 2}, Vec2{5, 2}}}}, {"", {{Vec2{1, 4}, Vec2{2, 5}}}}}};
  const std::string svg = draw_svg(mesh, options);
  expect_well_formed(svg);
  EXPECT_FALSE(has_class(plain, "face"));
  EXPECT_EQ(count(path_of(svg, "face"), "m") + count(path_of(svg, "face"), "M"), 2u) << "pieces that meet are one path";
  EXPECT_EQ(count(svg, ">a &lt; b</text>"), 1u);
  EXPECT_EQ(count(svg, ">line on faces of cells</text>"), 1u);
  options.zoom = Box{{6, 6}, {8, 8}};
  const std::string elsewhere = draw_svg(mesh, options);
  EXPECT_FALSE(has_class(elsewhere, "face"));
  EXPECT_FALSE(has_class(elsewhere, "names"));
}

TEST(Draw, APictureOfEverythingIsWellFormed) {
  DrawOptions options;
  options.vertex_numbers = options.weights = true;
  options.title = "a < b & \"c\" \x02\xff";
  const std::string svg = draw_svg(everything(), options);
  expect_well_formed(svg);
  for (const char* name : {"margin", "bad", "primal", "constrained", "dual", "dual-negative", "weight-positive",
                           "weight-negative", "near-coincident", "numbers"}) {
    EXPECT_TRUE(has_class(svg, name)) << name;
  }
  EXPECT_NE(svg.find("a &lt; b &amp; \"c\""), std::string::npos);
  expect_well_formed(draw_before_after_svg(everything(), lattice(), options));
}

/// FNV-1a.
std::uint64_t hash(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return h;
}

// Neither time nor place, machine or what was drawn before: whoever changes pictures changes the hashes.
TEST(Draw, TheBytesAreThoseOfTheMeshAlone) {
  const std::string one = draw_svg(everything()), two = draw_before_after_svg(everything(), lattice());
  EXPECT_EQ(hash(one), 2458226062689698899u);
  EXPECT_EQ(hash(two), 13606934428358034227u);
  EXPECT_EQ(draw_svg(everything()), one);
  Mesh mesh = everything();
  mesh.set_weight(VertexId(44), 0.25);
  EXPECT_NE(draw_svg(mesh), one);
}

struct Switch {
  bool DrawOptions::*option;
  std::vector<std::string> classes;
};

TEST(Draw, EachOptionSwitchesItsOwnClassesOff) {
  const Mesh mesh = everything();
  DrawOptions all;
  all.vertex_numbers = all.weights = true;
  const std::vector<Switch> switches = {{&DrawOptions::dual, {"dual", "dual-negative"}},
                                        {&DrawOptions::primal, {"primal", "constrained"}},
                                        {&DrawOptions::fill, {"margin", "bad"}},
                                        {&DrawOptions::weights, {"weight-positive", "weight-negative"}},
                                        {&DrawOptions::near_coincident, {"near-coincident"}},
                                        {&DrawOptions::vertex_numbers, {"numbers"}}};
  const std::string full = draw_svg(mesh, all);
  for (const Switch& s : switches) {
    DrawOptions options = all;
    options.*s.option = false;
    const std::string svg = draw_svg(mesh, options);
    expect_well_formed(svg);
    for (const std::string& name : s.classes) {
      EXPECT_TRUE(has_class(full, name)) << name;
      EXPECT_FALSE(has_class(svg, name)) << name;
    }
    EXPECT_LT(svg.size(), full.size());
  }
}

TEST(Draw, BadTrianglesAreHatchedAndCountedExactly) {
  const Mesh mesh = lattice({.n = 10, .jitter = 0.3, .weight = 0.3});
  std::size_t bad = 0;
  for (TriangleId t : mesh.triangles()) {
    const auto v = mesh.corners(t);
    bad += !is_well_centered(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]));
  }
  ASSERT_GT(bad, 0u);
  const std::string svg = draw_svg(mesh);
  EXPECT_EQ(count(path_of(svg, "bad"), "z"), bad);
  EXPECT_NE(
      svg.find(">" + std::to_string(bad) + "</tspan> of " + std::to_string(mesh.n_triangles()) + " triangles bad"),
      std::string::npos);
  // One hatching in the panel, and one in the legend.
  EXPECT_EQ(count(svg, "<pattern id="), 2u);
  EXPECT_EQ(count(svg, "fill=\"url(#bad-"), 2u);
  const std::string good = draw_svg(lattice({.jitter = 0, .weight = 0}));
  EXPECT_FALSE(has_class(good, "bad"));
  EXPECT_EQ(count(good, "<pattern"), 0u);
  EXPECT_NE(good.find(">0</tspan> of 32 triangles bad"), std::string::npos);
}

TEST(Draw, TintsAreOfMarginsFromZeroToThreeTenths) {
  const double high = std::sqrt(0.75);  // of an equilateral triangle, with the margin 0.289
  EXPECT_NE(draw_svg(mesh_of({{0, 0}, {1, 0}, {0.5, high}}, {{0, 1, 2}})).find("class=\"margin\" fill=\"#fff2a0\""),
            std::string::npos);
  EXPECT_NE(draw_svg(mesh_of({{0, 0}, {1, 0}, {0.01, 1}}, {{0, 1, 2}})).find("class=\"margin\" fill=\"#7690c8\""),
            std::string::npos);
}

TEST(Draw, DualEdgesOfNegativeLengthAreDashed) {
  // The boundary edge below an obtuse angle; and the diagonal of a square of which one corner is pulled in.
  const std::string obtuse = draw_svg(mesh_of({{0, 0}, {2, 0}, {1, 0.5}}, {{0, 1, 2}}));
  EXPECT_EQ(count(path_of(obtuse, "dual"), "m"), 2u);
  EXPECT_EQ(count(path_of(obtuse, "dual-negative"), "m"), 1u);
  EXPECT_NE(obtuse.find("negative dual edge"), std::string::npos);
  const std::string diagonal = draw_svg(mesh_of({{0, 0}, {1, 0}, {0.6, 0.6}, {0, 1}}, {{0, 1, 3}, {1, 2, 3}}));
  EXPECT_TRUE(has_class(diagonal, "dual-negative"));
  EXPECT_FALSE(has_class(draw_svg(lattice({.jitter = 0, .weight = 0})), "dual-negative"));
}

TEST(Draw, WeightCirclesComeInTwoSignsAndSkipZero) {
  Mesh mesh = lattice({.weight = 0});
  DrawOptions options;
  options.weights = true;
  EXPECT_FALSE(has_class(draw_svg(mesh, options), "weight-positive"));
  mesh.set_weight(VertexId(6), 0.04);
  mesh.set_weight(VertexId(7), 0.09);
  mesh.set_weight(VertexId(8), -0.01);
  EXPECT_FALSE(has_class(draw_svg(mesh), "weight-positive"));
  const std::string svg = draw_svg(mesh, options);
  EXPECT_EQ(count(path_of(svg, "weight-positive"), "z"), 2u);
  EXPECT_EQ(count(path_of(svg, "weight-negative"), "z"), 1u);
  options.weight_scale = 0;
  EXPECT_FALSE(has_class(draw_svg(mesh, options), "weight-positive"));
}

// The radius in pixels of the only weight circle.
double circle_radius(const std::string& svg) {
  const std::string path = path_of(svg, "weight-positive");
  const std::string_view scale = "<g transform=\"scale(";
  const std::string unit = svg.substr(svg.find(scale) + scale.size());
  return std::stod(path.substr(path.find('a') + 1)) * std::stod(unit);
}

TEST(Draw, ACircleHasTheRootOfTheWeightForItsRadius) {
  Mesh mesh = lattice({.weight = 0});
  mesh.set_weight(VertexId(12), 0.09);
  DrawOptions options;
  options.weights = true;
  options.zoom = Box{{0, 0}, {9, 4}};
  options.width = 900;  // 100 pixels a unit
  EXPECT_NEAR(circle_radius(draw_svg(mesh, options)), 30, 0.1);
  options.weight_scale = 2;
  EXPECT_NEAR(circle_radius(draw_svg(mesh, options)), 60, 0.1);
}

TEST(Draw, AZoomBoxLeavesOutWhatItDoesNotMeet) {
  const Mesh mesh = lattice({.n = 40, .jitter = 0.2, .weight = 0.1});
  DrawOptions options;
  options.zoom = Box{{10, 10}, {12, 12}};
  const std::string all = draw_svg(mesh), some = draw_svg(mesh, options);
  expect_well_formed(some);
  EXPECT_LT(some.size(), all.size() / 10);
  EXPECT_GT(path_of(some, "primal").size(), 0u);
  options.zoom = Box{{-100, -100}, {-99, -99}};
  const std::string nothing = draw_svg(mesh, options);
  expect_well_formed(nothing);
  EXPECT_FALSE(has_class(nothing, "primal"));
}

TEST(Draw, BothPanelsHaveOneScale) {
  const Mesh mesh = lattice();
  const std::string same = draw_before_after_svg(mesh, mesh);
  const std::string first = path_of(same, "primal");
  EXPECT_EQ(count(same, first), 2u) << "the same mesh is drawn the same in both panels";
  EXPECT_NE(same.find(">before:<"), std::string::npos);
  EXPECT_NE(same.find(">after:<"), std::string::npos);
  // A larger mesh beside it shrinks both.
  EXPECT_LT(path_of(draw_before_after_svg(mesh, lattice({.scale = 4})), "primal").size(), first.size());
}

TEST(Draw, OrthocentersAtTheEndOfTheWorldAreClipped) {
  const Mesh sliver = mesh_of({{0, 0}, {1, 0}, {0.5, 1e-14}, {0.5, -0.5}}, {{0, 1, 2}, {1, 0, 3}});
  const std::string svg = draw_svg(sliver);
  expect_well_formed(svg);
  EXPECT_LT(svg.size(), 5000u);
}

TEST(Draw, AnEmptyMeshIsAnEmptyPanel) {
  expect_well_formed(draw_svg(Mesh()));
  expect_well_formed(draw_before_after_svg(Mesh(), lattice()));
}

TEST(Draw, EdgesTooCloseToTellApartAreLeftOutButNotTheBoundary) {
  const Mesh mesh = lattice({.n = 80, .jitter = 0.05, .weight = 0});
  DrawOptions options;
  options.width = 100;
  const std::string svg = draw_svg(mesh, options);
  EXPECT_FALSE(has_class(svg, "primal"));
  EXPECT_TRUE(has_class(svg, "constrained"));
  EXPECT_NE(svg.find("edges and dual: zoom in"), std::string::npos);
  EXPECT_TRUE(has_class(draw_svg(mesh), "primal"));
}

TEST(Draw, AHundredThousandTrianglesFitInAFewMegabytesAndBadOnesStayVisible) {
  Mesh mesh = lattice({.n = 225, .jitter = 0.05, .weight = 0.01});
  ASSERT_GT(mesh.n_triangles(), 100'000u);
  // One bad triangle among them all.
  mesh.set_weight(VertexId(112 * 225 + 112), 5);
  const std::string svg = draw_svg(mesh);
  EXPECT_LT(svg.size(), 10'000'000u);
  EXPECT_FALSE(has_class(svg, "dual"));
  EXPECT_FALSE(has_class(svg, "weight-positive"));
  EXPECT_NE(svg.find("zoom in"), std::string::npos);
  ASSERT_TRUE(has_class(svg, "bad"));
  EXPECT_NE(svg.find("class=\"bad\" fill=\"#c83a00\" stroke=\"#c83a00\" stroke-width=\"300\""), std::string::npos)
      << "3 pixels on a grid of 0.01: as wide as an edge is long";
}

}  // namespace
}  // namespace temper
