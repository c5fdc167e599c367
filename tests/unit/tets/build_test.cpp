// TetMesh::build: connectivity and tags of good meshes, and what it says of bad ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "support/tet_lattice.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {
namespace {

using test::TetArrays;

TetArrays one_tetrahedron() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, {{0, 1, 2, 3}}}; }

InputError error_of(const TetMeshInput& input) {
  auto result = TetMesh::build(input);
  EXPECT_FALSE(result.has_value());
  return result ? InputError{} : result.error();
}
void expect_error(const TetArrays& arrays, ErrorCode code, std::string_view message) {
  const InputError error = error_of(arrays.input());
  EXPECT_EQ(error.code, code) << error.what();
  EXPECT_NE(error.message.find(message), std::string::npos) << error.message;
  EXPECT_NE(error.message.find(". Next: "), std::string::npos) << error.message;
}

TEST(TetMeshBuild, EulersFormulaHoldsForEachLattice) {
  for (const TetArrays& arrays : {one_tetrahedron(), test::cubes(3, test::kSixTets), test::cubes(3, test::kFiveTets),
                                  test::body_centered(3), test::shaken(test::cubes(2, test::kFiveTets), 0.1, 0.1)}) {
    const TetMesh mesh = test::mesh_of(arrays);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    std::set<std::pair<VertexId, VertexId>> edges;
    for (const TetId t : mesh.tetrahedra()) {
      const auto& c = mesh.corners(t);
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) edges.insert(std::minmax(c[i], c[j]));
      }
    }
    const std::size_t n_edges = edges.size() - mesh.n_vertices();  // pairs of a vertex with itself
    EXPECT_EQ(mesh.n_vertices() + mesh.n_faces(), n_edges + mesh.n_tetrahedra() + 1);
  }
}

TEST(TetMeshBuild, TwinsAreTheSameFaceSeenFromTheOtherSide) {
  const TetMesh mesh = test::mesh_of(test::cubes(2, test::kSixTets));
  std::size_t boundary = 0;
  for (const HalffaceId h : mesh.halffaces()) {
    const auto [a, b, c] = mesh.vertices(h);
    EXPECT_EQ(orientation(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(mesh.opposite(h))),
              Sign::positive);
    boundary += mesh.is_boundary(h);
  }
  EXPECT_EQ(boundary, 2U * 6 * 4);
  EXPECT_EQ(boundary_vertices(mesh).raw()[13], 0);  // the middle of the 27
}

TEST(TetMeshBuild, NegativeTetrahedraAreReversedAndCounted) {
  TetArrays arrays = test::cubes(2, test::kFiveTets);
  const TetMesh mesh = test::mesh_of(arrays);
  for (std::size_t t = 0; t < arrays.tetrahedra.size(); t += 3)
    std::swap(arrays.tetrahedra[t][0], arrays.tetrahedra[t][1]);
  const BuiltTetMesh again = test::built(arrays.input());
  EXPECT_EQ(again.mesh.validate(), std::nullopt);
  std::size_t negative = 0;
  for (const auto& [a, b, c, d] : arrays.tetrahedra) {
    const auto at = [&](std::int32_t p) { return arrays.points[std::size_t(p)]; };
    negative += orientation(at(a), at(b), at(c), at(d)) == Sign::negative;
  }
  EXPECT_GT(negative, 5U);
  EXPECT_EQ(again.reversed_tetrahedra, negative);
  EXPECT_EQ(again.mesh.n_faces(), mesh.n_faces());
}

TEST(TetMeshBuild, TagsAreFoundAndWhatIsNoFaceOrEdgeIsCounted) {
  const TetArrays arrays = test::cubes(1, test::kSixTets);  // corners by the bits x, y, z
  TetMeshInput input = arrays.input();
  const std::vector<std::array<std::int32_t, 3>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 7, 1}, {1, 2, 4}, {0, 1, 7}};
  const std::vector<std::int32_t> face_tags = {5, 6, 7, 8, 7}, regions = {1, 1, 2, 2, 3, 3}, line_tags = {4, 3},
                                  point_tags = {9};
  const std::vector<std::array<std::int32_t, 2>> lines = {{7, 0}, {1, 2}};
  const std::vector<std::int32_t> points = {6};
  input.faces = faces, input.face_tags = face_tags, input.regions = regions;
  input.lines = lines, input.line_tags = line_tags, input.marked_points = points, input.point_tags = point_tags;
  const BuiltTetMesh result = test::built(input);
  EXPECT_EQ(result.dangling_faces, (std::vector<std::size_t>{0, 3}));  // the bottom has the diagonal 0-3
  EXPECT_EQ(result.dangling_lines, (std::vector<std::size_t>{1}));
  const TetMesh& mesh = result.mesh;
  ASSERT_EQ(mesh.tagged_faces().size(), 3U);
  EXPECT_EQ(mesh.tagged_faces()[0].tag, 6);
  EXPECT_TRUE(mesh.is_boundary(mesh.tagged_faces()[0].face));
  const auto [a, b, c] = mesh.vertices(mesh.tagged_faces()[1].face);  // the side with the user's orientation 0 → 7 → 1
  EXPECT_EQ(b.index, a.index == 0 ? 7U : a.index == 7 ? 1U : 0U) << a.index << b.index << c.index;
  EXPECT_EQ(mesh.tagged_faces()[2].face, mesh.twin(mesh.tagged_faces()[1].face));
  EXPECT_EQ(mesh.tagged_lines(), (std::vector<TaggedLine>{{{VertexId(7), VertexId(0)}, 4}}));
  EXPECT_EQ(mesh.tagged_points(), (std::vector<TaggedPoint>{{VertexId(6), 9}}));
  EXPECT_EQ(mesh.region(TetId(5)), 3);
}

TEST(TetMeshBuild, NamesAPointThatIsNoneOrBelongsToNothing) {
  TetArrays arrays = one_tetrahedron();
  arrays.points.push_back({5, 5, 5});
  expect_error(arrays, ErrorCode::unused_point, "point 4 belongs to no tetrahedron");
  arrays.points[4].y = std::numeric_limits<double>::quiet_NaN();
  expect_error(arrays, ErrorCode::not_finite, "point 4 has coordinates (5, nan, 5), expected finite numbers");
  arrays.points[4].y = 1e-40;
  expect_error(arrays, ErrorCode::out_of_scale, "point 4 has coordinates (5, 1e-40, 5); expected 0 or a magnitude");
  arrays = one_tetrahedron();
  arrays.tetrahedra[0][2] = 4;
  expect_error(arrays, ErrorCode::index_out_of_range, "tetrahedron 0 uses point index 4, but there are 4 points");
  arrays.tetrahedra[0][2] = -1;
  expect_error(arrays, ErrorCode::index_out_of_range, "tetrahedron 0 uses point index -1");
  expect_error({}, ErrorCode::empty_input, "the mesh has no points");
  arrays = one_tetrahedron();
  arrays.weights = {0, 0, 1e80, 0};
  expect_error(arrays, ErrorCode::out_of_scale, "point 2 has weight 1e+80; expected 0 or a magnitude");
  arrays.weights.pop_back();
  expect_error(arrays, ErrorCode::size_mismatch, "3 weights given for 4 points. Next: give one for each, or none");
}

TEST(TetMeshBuild, NamesAFlatTetrahedronAndItsPlace) {
  TetArrays arrays = one_tetrahedron();
  arrays.points[3] = {1, 1, 0};
  expect_error(arrays, ErrorCode::zero_volume,
               "tetrahedron 0 is flat: its corners 0, 1, 2 and 3 are in one plane, near (0.5, 0.5, 0)");
  arrays.tetrahedra[0] = {0, 1, 2, 1};
  expect_error(arrays, ErrorCode::zero_volume, "tetrahedron 0 is flat: it uses point 1 more than once");
}

TEST(TetMeshBuild, NamesTwoPointsAtOnePlace) {
  TetArrays arrays = one_tetrahedron();
  arrays.points.push_back({0, 0, -0.0});
  arrays.points.push_back({-1, 0, 0});
  arrays.tetrahedra.push_back({4, 2, 5, 3});
  expect_error(arrays, ErrorCode::duplicate_point, "point 0 and point 4 are both at (0, 0, -0)");
  arrays = one_tetrahedron();
  arrays.points[3] = arrays.points[1];
  expect_error(arrays, ErrorCode::duplicate_point, "point 1 and point 3 are both at (1, 0, 0); expected distinct");
}

TEST(TetMeshBuild, NamesRepeatedCrowdedAndOverlappingTetrahedra) {
  TetArrays arrays = one_tetrahedron();
  arrays.tetrahedra.push_back({3, 2, 0, 1});
  expect_error(arrays, ErrorCode::overlap, "tetrahedron 1 repeats tetrahedron 0: both have the corners 0, 1, 2 and 3");

  arrays = one_tetrahedron();
  arrays.points.push_back({0.5, 0.5, 2});
  arrays.tetrahedra.push_back({0, 1, 2, 4});
  expect_error(
      arrays, ErrorCode::overlap,
      "tetrahedron 0 and tetrahedron 1 lie on the same side of their common face of points 0, 1 and 2, near (0.33");

  arrays.points.push_back({0.2, 0.2, -1});
  arrays.tetrahedra.push_back({0, 1, 2, 5});
  expect_error(arrays, ErrorCode::non_manifold_face, "belongs to 3 tetrahedra (0, 1 and 2)");
}

TEST(TetMeshBuild, NamesTheTetrahedronThatIsInvertedInTruth) {
  TetArrays arrays = test::cubes(2, test::kFiveTets);
  arrays.points[13] = {1.13, 1.07, 2.2};  // the middle, pushed through the top: some tetrahedra turn over
  const InputError error = error_of(arrays.input());
  EXPECT_EQ(error.code, ErrorCode::overlap);
  const std::size_t end = error.message.find(" is inverted. Next: ");
  ASSERT_NE(end, std::string::npos) << error.message;
  const std::size_t number = error.message.rfind(' ', end - 1) + 1;
  const auto& named = arrays.tetrahedra[std::stoul(error.message.substr(number, end - number))];
  const auto at = [&](std::size_t k) { return arrays.points[std::size_t(named[k])]; };
  EXPECT_EQ(orientation(at(0), at(1), at(2), at(3)), Sign::negative) << error.message;
}

TEST(TetMeshBuild, NamesEdgesAndVerticesWhereTheMeshTouchesItself) {
  TetArrays arrays = one_tetrahedron();  // another one on the other side of the edge 0-1
  arrays.points.insert(arrays.points.end(), {{0, -1, 0}, {0, 0, -1}});
  arrays.tetrahedra.push_back({0, 1, 4, 5});
  expect_error(arrays, ErrorCode::non_manifold_edge,
               "the mesh touches itself along the edge from point 0 to point 1: its tetrahedra are not one fan around "
               "it, near (0.5, 0, 0)");
  arrays = one_tetrahedron();
  arrays.points.insert(arrays.points.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  arrays.tetrahedra.push_back({0, 4, 5, 6});
  expect_error(arrays, ErrorCode::non_manifold_vertex, "the mesh touches itself at point 0");
}

/// Tetrahedra from the origin to triangles in the plane z = 1.
TetArrays cone(const std::vector<std::array<double, 2>>& points, const std::vector<std::array<int, 3>>& triangles) {
  TetArrays arrays;
  arrays.points.push_back({0, 0, 0});
  for (const auto& [x, y] : points) arrays.points.push_back({x, y, 1});
  for (const auto& [a, b, c] : triangles) arrays.tetrahedra.push_back({0, a + 1, b + 1, c + 1});
  return arrays;
}

TEST(TetMeshBuild, NamesEdgesAndVerticesWhereConnectedTetrahedraAreNoBall) {
  // A ring of triangles around a hole, whose ends meet in the corner 0 alone, and a whole ring.
  const std::vector<std::array<double, 2>> corners = {{-2, -2}, {2, -2}, {2, 2},  {-2, 2},
                                                      {1, -1},  {1, 1},  {-1, 1}, {-1, -1}};
  std::vector<std::array<int, 3>> ring = {{0, 1, 4}, {1, 2, 4}, {4, 2, 5}, {2, 3, 5}, {5, 3, 6}, {3, 0, 6}};
  TetArrays pinched = cone(corners, ring);
  pinched.points.pop_back();
  expect_error(pinched, ErrorCode::non_manifold_edge, "the mesh touches itself along the edge from point 0 to point 1");
  ring.push_back({6, 0, 7});
  ring.push_back({0, 4, 7});
  expect_error(cone(corners, ring), ErrorCode::non_manifold_vertex, "the mesh touches itself at point 0");
}

TEST(TetMeshBuild, FindsAnEdgeThatWindsTwice) {
  // Around the edge from (0, 0, 0) to (0, 0, 1) twelve tetrahedra make two turns. All faces fit.
  TetArrays arrays;
  arrays.points = {{0, 0, 0}, {0, 0, 1}};
  for (int k = 0; k < 12; ++k) {
    const double angle = std::acos(-1.0) * k / 3, r = k < 6 ? 1 : 2;
    arrays.points.push_back({r * std::cos(angle), r * std::sin(angle), 0.5});
  }
  for (std::int32_t k = 0; k < 12; ++k) arrays.tetrahedra.push_back({0, 1, 2 + k, 2 + (k + 1) % 12});
  expect_error(arrays, ErrorCode::overlap,
               "the tetrahedra around the edge from point 0 to point 1 overlap: together they make 2 turns around it");
}

TEST(TetMeshBuild, FindsAnInnerVertexThatIsCoveredTwice) {
  // The same ring, joined to two poles: the link of the origin is a sphere that covers the directions twice.
  TetArrays arrays;
  arrays.points = {{0, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < 12; ++k) {
    const double angle = std::acos(-1.0) * k / 3, r = k < 6 ? 1 : 2;
    arrays.points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  for (std::int32_t k = 0; k < 12; ++k) {
    arrays.tetrahedra.push_back({0, 1, 3 + k, 3 + (k + 1) % 12});
    arrays.tetrahedra.push_back({0, 2, 3 + (k + 1) % 12, 3 + k});
  }
  expect_error(arrays, ErrorCode::overlap,
               "the tetrahedra around point 0 overlap: together they fill 200 % of the sphere around (0, 0, 0)");
}

}  // namespace
}  // namespace temper::tets
