// Mesh::build: every way in which arrays fail to be a mesh, by code and message, and what is repaired or accepted.
#include <gtest/gtest.h>

#include <limits>

#include "support/std_threads.hpp"
#include "temper/detail/geometry.hpp"
#include "unit/mesh/inputs.hpp"

namespace temper {
namespace {

using test::Arrays;
using test::built;
using test::fan;
using test::squares;
using test::together;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

void expect_error(const Arrays& arrays, ErrorCode code, const std::string& message) {
  const auto result = arrays.build();
  ASSERT_FALSE(result.has_value()) << "no error, expected: " << message;
  EXPECT_EQ(name(result.error().code), name(code));
  EXPECT_EQ(result.error().message, message);
  EXPECT_EQ(result.error().where, "");
  EXPECT_EQ(result.error().what(), message);
}

TEST(BuildRefuses, NoPoints) { expect_error({}, ErrorCode::empty_input, "the mesh has no points"); }

TEST(BuildRefuses, NoTriangles) {
  expect_error({{{0, 0}, {1, 0}, {0, 1}}, {}}, ErrorCode::empty_input, "the mesh has no triangles");
}

TEST(BuildRefuses, ArraysOfDifferentLengths) {
  Arrays arrays = fan();
  arrays.weights = {1, 2, 3};
  expect_error(arrays, ErrorCode::size_mismatch, "3 weights given for 5 points");
  arrays.weights = {};
  arrays.regions = {1, 2, 3, 4, 5};
  expect_error(arrays, ErrorCode::size_mismatch, "5 regions given for 4 triangles");
}

TEST(BuildRefuses, CoordinatesThatAreNotFinite) {
  for (const auto& [bad, text] :
       {std::pair{Vec2{kNaN, -1}, "(nan, -1)"}, {Vec2{1, kInf}, "(1, inf)"}, {Vec2{-kInf, 0.5}, "(-inf, 0.5)"}}) {
    Arrays arrays = fan();
    arrays.points[1] = bad;
    expect_error(arrays, ErrorCode::not_finite,
                 "point 1 has coordinates " + std::string(text) + ", expected finite numbers");
  }
}

TEST(BuildRefuses, WeightsThatAreNotFinite) {
  for (const auto& [bad, text] : {std::pair{kNaN, "nan"}, {kInf, "inf"}, {-kInf, "-inf"}}) {
    Arrays arrays = fan();
    arrays.weights = {0, 0, 0, bad, 0};
    expect_error(arrays, ErrorCode::not_finite,
                 "point 3 has weight " + std::string(text) + ", expected a finite number");
  }
}

TEST(BuildRefuses, IndicesOutOfRange) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  for (const std::int32_t bad : {5, 305, -1, kLeast, std::numeric_limits<std::int32_t>::max()}) {
    Arrays arrays = fan();
    arrays.triangles[2][1] = bad;
    expect_error(arrays, ErrorCode::index_out_of_range,
                 "triangle 2 uses point index " + std::to_string(bad) + ", but there are 5 points");
    arrays = fan();
    arrays.constrained_edges = {{0, 1}, {1, bad}};
    expect_error(arrays, ErrorCode::index_out_of_range,
                 "a constrained edge uses point index " + std::to_string(bad) + ", but there are 5 points");
    arrays = fan();
    arrays.fixed_vertices = {0, bad};
    expect_error(arrays, ErrorCode::index_out_of_range,
                 "a fixed vertex has index " + std::to_string(bad) + ", but there are 5 points");
  }
}

TEST(BuildRefuses, ARepeatedVertex) {
  Arrays arrays = fan();
  for (const auto& corners : {std::array<std::int32_t, 3>{2, 2, 4}, {2, 4, 2}, {4, 2, 2}, {2, 2, 2}}) {
    arrays.triangles[1] = corners;
    expect_error(arrays, ErrorCode::zero_area, "triangle 1 has zero area: it uses point 2 more than once");
  }
}

TEST(BuildRefuses, ZeroArea) {
  expect_error({{{0, 0}, {1, 0}, {0, 1}, {0.1, 0.1}, {0.2, 0.2}}, {{0, 1, 2}, {0, 3, 4}}}, ErrorCode::zero_area,
               "triangle 1 has zero area: its corners point 0, point 3 and point 4 are collinear");
}

TEST(BuildAccepts, AnAreaThatOnlyExactArithmeticSees) {
  // 0.1 + 0.2 is one unit in the last place above 0.3: not collinear with (0, 0) and (1, 1).
  const Mesh mesh = built({{{0, 0}, {1, 1}, {0.3, 0.1 + 0.2}}, {{0, 1, 2}}});
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(BuildRefuses, DuplicatePoints) {
  // Two triangles that should share an edge but have their own copies of its ends.
  expect_error({{{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {3, 4, 5}}}, ErrorCode::duplicate_point,
               "point 2 and point 5 are both at (0, 1); expected distinct points");
  // 0 and −0 are the same place.
  expect_error({{{0.0, 0}, {1, 0}, {0, 1}, {-0.0, 0}, {-1, 0}, {0, -1}}, {{0, 1, 2}, {3, 4, 5}}},
               ErrorCode::duplicate_point, "point 0 and point 3 are both at (-0, 0); expected distinct points");
}

TEST(BuildRefuses, UnusedPoints) {
  Arrays arrays = fan();
  arrays.points.push_back({5, 5});
  expect_error(arrays, ErrorCode::unused_point, "point 5 belongs to no triangle");
}

TEST(BuildRefuses, ThreeTrianglesAtAnEdge) {
  expect_error({{{0, 0}, {1, 0}, {0, 1}, {0, -1}, {2, 2}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}},
               ErrorCode::non_manifold_edge,
               "the edge from point 0 to point 1 belongs to 3 triangles (triangle 0 and triangle 2 among them); "
               "expected at most 2");
}

TEST(BuildRefuses, TwoTrianglesOnTheSameSideOfAnEdge) {
  expect_error({{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0, 1, 2}, {0, 1, 3}}}, ErrorCode::overlap,
               "triangle 0 and triangle 1 lie on the same side of the edge from point 0 to point 1");
  // The same three points again are the same side of each edge.
  expect_error({{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}, {2, 0, 1}}}, ErrorCode::overlap,
               "triangle 0 and triangle 1 lie on the same side of the edge from point 0 to point 1");
}

TEST(BuildRefuses, ABowTie) {
  expect_error({{{0, 0}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}, {{0, 1, 2}, {0, 3, 4}}}, ErrorCode::non_manifold_vertex,
               "the mesh touches itself at point 0: its triangles are not one fan around it");
}

TEST(BuildRefuses, AClosedFanWithASecondFanAtItsMiddle) {
  Arrays arrays = together(fan(), {{{-3, 1}, {-3, -1}}, {}});
  arrays.triangles.push_back({4, 5, 6});
  expect_error(arrays, ErrorCode::non_manifold_vertex,
               "the mesh touches itself at point 4: its triangles are not one fan around it");
}

// A pentagram's corners in the order of its strokes: every triangle turns left, the star winds twice.
TEST(BuildRefuses, AStarThatWindsTwice) {
  const Arrays pentagram = {{{0, 0}, {0, 10}, {-6, -8}, {9, 3}, {-9, 3}, {6, -8}},
                            {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}}};
  expect_error(pentagram, ErrorCode::overlap, "the triangles around point 0 overlap");
}

// Seven triangles of 60° without closing: the last lies on the first.
TEST(BuildRefuses, ABoundaryFanOfMoreThanAFullTurn) {
  Arrays arrays = {{{0, 0}}, {}};
  const Vec2 hexagon[] = {{4, 0}, {2, 3}, {-2, 3}, {-4, 0}, {-2, -3}, {2, -3}};
  for (int i = 0; i < 8; ++i) arrays.points.push_back((1 + 0.125 * i) * hexagon[i % 6]);
  for (int i = 1; i < 8; ++i) arrays.triangles.push_back({0, i, i + 1});
  expect_error(arrays, ErrorCode::overlap, "the triangles around point 0 overlap");
  // Six of them meet along their first and last edge.
  arrays.points.pop_back();
  arrays.triangles.pop_back();
  expect_error(
      arrays, ErrorCode::overlap,
      "the mesh touches itself at point 0: its edges to point 1 and point 7 lie on each other (a hanging node, or "
      "an edge whose two sides are not joined)");
  // Five leave a gap.
  arrays.points.pop_back();
  arrays.triangles.pop_back();
  EXPECT_EQ(built(arrays).validate(), std::nullopt);
}

/// A strip of triangles between a lower and an upper chain of points.
Arrays strip(const std::vector<Vec2>& inner, const std::vector<Vec2>& outer) {
  Arrays arrays;
  for (std::size_t i = 0; i < inner.size(); ++i) arrays.points.insert(arrays.points.end(), {inner[i], outer[i]});
  for (std::int32_t i = 0; i + 3 < static_cast<std::int32_t>(arrays.points.size()); i += 2) {
    arrays.triangles.push_back({i, i + 1, i + 3});
    arrays.triangles.push_back({i, i + 3, i + 2});
  }
  return arrays;
}

// A strip along a square spiral's sides: down, right, up, left, and back across its own beginning.
TEST(BuildRefuses, ABoundaryThatCrossesItself) {
  const Arrays crossing =
      strip({{0, 9}, {0, 0}, {9, 0}, {9, 5}, {-3, 5}}, {{-1, 9}, {-1, -1}, {10, -1}, {10, 6}, {-3, 6}});
  expect_error(crossing, ErrorCode::overlap,
               "triangle 0 and triangle 7 have boundary edges that cross or touch away from a common vertex");
  // The same strip ends short of its beginning.
  const Arrays open = strip({{0, 9}, {0, 0}, {9, 0}, {9, 5}, {3, 5}}, {{-1, 9}, {-1, -1}, {10, -1}, {10, 6}, {3, 6}});
  EXPECT_EQ(built(open).validate(), std::nullopt);
}

// Point 4 lies in the middle of the edge from point 1 to point 2: left and right do not share their edges.
TEST(BuildRefuses, AHangingNode) {
  Arrays hanging = {{{0, 0}, {2, 0}, {2, 2}, {4, 0}, {2, 1}, {4, 2}}, {{0, 1, 2}, {1, 3, 4}, {4, 5, 2}, {3, 5, 4}}};
  expect_error(
      hanging, ErrorCode::non_manifold_vertex,
      "the mesh touches itself at point 1: its edges to point 2 and point 4 lie on each other (a hanging node, or "
      "an edge whose two sides are not joined)");
  // Joined below, the triangles around point 1 are one fan.
  hanging.points.push_back({2, -2});
  hanging.triangles.insert(hanging.triangles.end(), {{0, 6, 1}, {6, 3, 1}});
  hanging.triangles.insert(hanging.triangles.end(), {{0, 2, 7}, {2, 5, 7}});
  hanging.points.push_back({2, 4});
  expect_error(
      hanging, ErrorCode::overlap,
      "the mesh touches itself at point 1: its edges to point 2 and point 4 lie on each other (a hanging node, or "
      "an edge whose two sides are not joined)");
}

TEST(BuildRefuses, ComponentsThatTouch) {
  const Arrays touching = together({{{0, 0}, {2, 0}, {0, 2}}, {{0, 1, 2}}}, {{{1, 1}, {2, 1}, {2, 2}}, {{0, 1, 2}}});
  expect_error(touching, ErrorCode::overlap,
               "triangle 0 and triangle 1 have boundary edges that cross or touch away from a common vertex");
}

TEST(BuildRefuses, AComponentOnTopOfAnother) {
  // In the middle of a large triangle, and where its edges are inner edges of the other.
  expect_error(together({{{0, 0}, {9, 0}, {0, 9}}, {{0, 1, 2}}}, {{{1, 1}, {2, 1}, {1, 2}}, {{0, 1, 2}}}),
               ErrorCode::overlap, "triangle 1 lies on top of another component of the mesh");
  expect_error(together(squares(2, {2.25, 2.5}), squares(8)), ErrorCode::overlap,
               "triangle 0 lies on top of another component of the mesh");
}

TEST(BuildAccepts, AComponentInAHoleOfAnother) {
  const Arrays ring = squares(3, {0, 0}, {{1, 1}});
  const Arrays inside = {{{1.25, 1.25}, {1.75, 1.25}, {1.25, 1.75}}, {{0, 1, 2}}};
  for (const Arrays& both : {together(ring, inside), together(inside, ring)}) {
    const Mesh mesh = built(both);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(test::boundary_loops(mesh), 3u);
  }
  // A component in the hole's component is in triangles again.
  const Arrays third = {{{1.3, 1.3}, {1.4, 1.3}, {1.3, 1.4}}, {{0, 1, 2}}};
  expect_error(together(together(ring, inside), third), ErrorCode::overlap,
               "triangle 17 lies on top of another component of the mesh");
}

TEST(BuildAccepts, SeveralComponentsAndHoles) {
  const Mesh two = built(together(squares(2), squares(3, {10, 0}, {{1, 1}})));
  EXPECT_EQ(two.validate(), std::nullopt);
  EXPECT_EQ(test::boundary_loops(two), 3u);
  EXPECT_EQ(two.n_triangles(), 8u + 16u);
  const Mesh holes = built(squares(7, {0, 0}, {{1, 1}, {3, 3}, {5, 5}, {1, 5}}));
  EXPECT_EQ(holes.validate(), std::nullopt);
  EXPECT_EQ(test::boundary_loops(holes), 5u);
  // V − E + F = 1 − holes, for one component.
  EXPECT_EQ(holes.n_vertices() + holes.n_triangles() + 4, holes.n_edges() + 1);
}

TEST(BuildRefuses, CoordinatesAndWeightsOutOfTheRangeOfExactArithmetic) {
  const auto with = [](Vec2 p) { return Arrays{{{0, 0}, {1, 0}, p}, {{0, 1, 2}}}; };
  for (const auto& [bad, text] : {std::pair{Vec2{0, 1e80}, "(0, 1e+80)"},
                                  {Vec2{-1e300, 1}, "(-1e+300, 1)"},
                                  {Vec2{1e-70, 1}, "(1e-70, 1)"},
                                  {Vec2{0.5, 5e-324}, "(0.5, 5e-324)"}}) {
    expect_error(with(bad), ErrorCode::out_of_scale,
                 "point 2 has coordinates " + std::string(text) +
                     "; expected 0 or a magnitude from 1e-60 to 1e+60, which exact arithmetic needs");
  }
  // Beside a coordinate of 1e40, 1e-30 would be scaled out of the range.
  Arrays far_apart = with({1e-30, 1e40});
  expect_error(far_apart, ErrorCode::out_of_scale,
               "point 2 has coordinates (1e-30, 1e+40); expected 0 or a magnitude from 1e-20 to 1e+60, which exact "
               "arithmetic needs");
  Arrays heavy = with({0, 1});
  heavy.weights = {0, 1e125, 0};
  expect_error(
      heavy, ErrorCode::out_of_scale,
      "point 1 has weight 1e+125; expected 0 or a magnitude from 1e-120 to 1e+120, which exact arithmetic needs");
  heavy.weights = {0, 0, -1e-125};
  expect_error(heavy, ErrorCode::out_of_scale,
               "point 2 has weight -1e-125; expected 0 or a magnitude from 1e-120 to 1e+120, which exact arithmetic "
               "needs");
}

TEST(BuildRefuses, AnExtentTooSmallForExactArithmetic) {
  const auto result = Arrays{{{1e-60, 1e-60}, {1.5e-60, 1e-60}, {1e-60, 1.5e-60}}, {{0, 1, 2}}}.build();
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::out_of_scale);
  EXPECT_NE(result.error().message.find("expected an extent of at least 1e-60"), std::string::npos)
      << result.error().message;
}

TEST(BuildAccepts, TinyHugeAndFarMeshes) {
  for (const double scale : {1e-50, 1e-12, 1.0, 1e12, 1e50}) {
    for (const double offset : {0.0, 1e6}) {
      Arrays arrays = fan();
      for (Vec2& p : arrays.points) p = scale * (p + Vec2{offset, -offset});
      arrays.weights.assign(5, 0.125 * scale * scale);
      EXPECT_EQ(built(arrays).validate(), std::nullopt) << scale << " " << offset;
    }
  }
}

TEST(BuildRefuses, AConstrainedEdgeThatIsNone) {
  Arrays arrays = fan();
  arrays.constrained_edges = {{0, 1}, {0, 2}};
  expect_error(arrays, ErrorCode::missing_edge, "the constrained edge from point 0 to point 2 is no edge of the mesh");
  arrays.constrained_edges = {{3, 3}};
  expect_error(arrays, ErrorCode::missing_edge, "the constrained edge from point 3 to point 3 is no edge of the mesh");
}

/// Counts from 1 and knows lines, like a file.
class FileNames final : public InputNames {
 public:
  [[nodiscard]] std::string point(std::size_t i) const override { return "node " + std::to_string(i + 1); }
  [[nodiscard]] std::string triangle(std::size_t t) const override { return "element " + std::to_string(t + 101); }
  [[nodiscard]] std::string point_where(std::size_t i) const override { return "a.mesh:" + std::to_string(i + 4); }
  [[nodiscard]] std::string triangle_where(std::size_t t) const override { return "a.mesh:" + std::to_string(t + 20); }
};

void expect_what(const Arrays& arrays, const std::string& what) {
  const FileNames names;
  const auto result = arrays.build(&names);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().what(), what);
}

TEST(BuildErrors, SpeakTheNumbersOfTheUser) {
  Arrays arrays = fan();
  arrays.points[1].x = kNaN;
  expect_what(arrays, "a.mesh:5: node 2 has coordinates (nan, -1), expected finite numbers");
  arrays = fan();
  arrays.points.push_back({5, 5});
  expect_what(arrays, "a.mesh:9: node 6 belongs to no triangle");
  arrays = fan();
  arrays.points.push_back({0, 0});
  arrays.triangles[3] = {3, 0, 5};
  expect_what(arrays, "a.mesh:9: node 5 and node 6 are both at (0, 0); expected distinct points");
  arrays = fan();
  arrays.triangles.push_back({1, 2, 4});
  expect_what(arrays, "a.mesh:24: element 102 and element 105 lie on the same side of the edge from node 2 to node 3");
  arrays = fan();
  arrays.triangles[0] = {0, 1, 1};
  expect_what(arrays, "a.mesh:20: element 101 has zero area: it uses node 2 more than once");
  arrays = fan();
  arrays.triangles[0] = {0, 1, 7};
  expect_what(arrays, "a.mesh:20: element 101 uses point index 7, but there are 5 points");
  arrays = fan();
  arrays.constrained_edges = {{3, 1}};
  expect_what(arrays, "a.mesh:7: the constrained edge from node 4 to node 2 is no edge of the mesh");
  arrays = {{{0, 0}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}, {{0, 1, 2}, {0, 3, 4}}};
  expect_what(arrays, "a.mesh:4: the mesh touches itself at node 1: its triangles are not one fan around it");
  arrays = together({{{0, 0}, {9, 0}, {0, 9}}, {{0, 1, 2}}}, {{{1, 1}, {2, 1}, {1, 2}}, {{0, 1, 2}}});
  expect_what(arrays, "a.mesh:21: element 102 lies on top of another component of the mesh");
}

TEST(BuildRepairs, ClockwiseAndMixedOrientation) {
  const Mesh straight = built(fan());
  for (unsigned reversed = 0; reversed < 16; ++reversed) {
    Arrays arrays = fan();
    std::size_t expected = 0;
    for (unsigned t = 0; t < 4; ++t) {
      if ((reversed >> t & 1u) == 0) continue;
      std::swap(arrays.triangles[t][0], arrays.triangles[t][2]);
      ++expected;
    }
    const auto result = arrays.build();
    ASSERT_TRUE(result.has_value()) << result.error().what();
    EXPECT_EQ(result->reversed_triangles, expected);
    EXPECT_EQ(result->mesh.validate(), std::nullopt);
    for (const HalfedgeId h : straight.halfedges()) {
      EXPECT_TRUE(result->mesh.find_halfedge(straight.origin(h), straight.target(h)).valid());
    }
  }
}

TEST(BuildKeeps, OrderPointsWeightsAndRegions) {
  Arrays arrays = squares(3, {0.1, -7});
  for (std::size_t i = 0; i < arrays.points.size(); ++i) arrays.weights.push_back(0.1 * double(i) - 0.5);
  for (std::size_t t = 0; t < arrays.triangles.size(); ++t) arrays.regions.push_back(std::int32_t(t % 5) - 2);
  const auto result = arrays.build();
  ASSERT_TRUE(result.has_value()) << result.error().what();
  const Mesh& mesh = result->mesh;
  EXPECT_EQ(result->reversed_triangles, 0u);
  ASSERT_EQ(mesh.n_vertices(), arrays.points.size());
  ASSERT_EQ(mesh.n_triangles(), arrays.triangles.size());
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(mesh.position(v), arrays.points[v.index]);
    EXPECT_EQ(mesh.weight(v), arrays.weights[v.index]);
    EXPECT_FALSE(mesh.is_fixed(v));
  }
  for (const TriangleId t : mesh.triangles()) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.corners(t)[std::size_t(k)].index, std::uint32_t(arrays.triangles[t.index][std::size_t(k)]));
    }
    EXPECT_EQ(mesh.region(t), arrays.regions[t.index]);
  }
}

TEST(BuildConstrains, InterfacesOfRegionsAndTheEdgesAsked) {
  Arrays arrays = squares(4);
  for (std::size_t t = 0; t < arrays.triangles.size(); ++t) arrays.regions.push_back(t < 16 ? 3 : 8);
  arrays.constrained_edges = {{0, 6}, {6, 5}, {0, 1}};  // a diagonal, a side backwards, a boundary edge
  const Mesh mesh = built(arrays);
  std::size_t constrained = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const HalfedgeId twin = mesh.twin(h);
    const auto a = std::min(mesh.origin(h), mesh.target(h)).index, b = std::max(mesh.origin(h), mesh.target(h)).index;
    const bool asked = (a == 0 && b == 6) || (a == 5 && b == 6) || (a == 0 && b == 1);
    const bool interface = twin.valid() && mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(twin));
    EXPECT_EQ(mesh.is_constrained(h), asked || interface) << a << "-" << b;
    constrained += mesh.is_constrained(h) && mesh.is_edge_representative(h) ? 1 : 0;
  }
  EXPECT_EQ(constrained, 3u + 4u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(BuildFixes, TheVerticesAskedAndNoOther) {
  Arrays arrays = fan();
  arrays.fixed_vertices = {4, 1, 4};
  const Mesh mesh = built(arrays);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.is_fixed(v), v.index == 4 || v.index == 1);
}

/// The mesh or the error, by an executor of so many threads; 0: without one.
Expected<BuiltMesh> built_by(std::size_t threads, const Arrays& arrays) {
  test::StdThreads executor(threads);
  MeshInput input{arrays.points, arrays.weights, arrays.triangles};
  input.regions = arrays.regions;
  input.executor = threads > 0 ? &executor : nullptr;
  auto result = Mesh::build(input);
  EXPECT_EQ(executor.runs() > 0, threads > 0);
  return result;
}

TEST(Build, IsTheSameForAnyNumberOfThreads) {
  Arrays arrays = squares(150);  // several blocks
  arrays.regions.assign(arrays.triangles.size(), 0);
  for (std::size_t t = 0; t < arrays.triangles.size(); t += 3) {
    std::swap(arrays.triangles[t][0], arrays.triangles[t][1]);
    arrays.regions[t] = 4;
  }
  const auto alone = built_by(0, arrays);
  ASSERT_TRUE(alone.has_value());
  EXPECT_EQ(alone->mesh.validate(), std::nullopt);
  EXPECT_EQ(alone->reversed_triangles, (arrays.triangles.size() + 2) / 3);
  for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
    const auto result = built_by(threads, arrays);
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->mesh, alone->mesh);
    EXPECT_EQ(result->reversed_triangles, alone->reversed_triangles);
  }
}

TEST(Build, NamesTheSameFirstErrorForAnyNumberOfThreads) {
  const Arrays good = squares(150);
  const std::size_t n = good.points.size(), m = good.triangles.size();
  std::vector<Arrays> all(6, good);
  all[0].points[n - 5].x = kNaN, all[0].points[n - 9].y = kInf;
  all[1].triangles[m - 1][0] = -1, all[1].triangles[m - 2] = {0, 1, 2};
  all[2].triangles.pop_back(), all[2].triangles.pop_back();           // a point without triangles
  all[3].triangles.push_back(good.triangles[m - 7]);                  // a triangle twice
  all[4].points[n - 400] = all[4].points[n - 400] + Vec2{0.9, -0.9};  // folded over
  all[5].points.push_back(good.points[17]);                           // a point twice, and a fold there
  all[5].triangles.push_back({18, 17 + 151, static_cast<std::int32_t>(n)});
  for (const Arrays& arrays : all) {
    const auto alone = built_by(0, arrays);
    ASSERT_FALSE(alone.has_value());
    for (const std::size_t threads : {2u, 8u}) {
      const auto result = built_by(threads, arrays);
      ASSERT_FALSE(result.has_value());
      EXPECT_EQ(result.error().what(), alone.error().what());
      EXPECT_EQ(result.error().code, alone.error().code);
    }
  }
  EXPECT_EQ(built_by(0, all[5]).error().code, ErrorCode::duplicate_point);
}

}  // namespace
}  // namespace temper
