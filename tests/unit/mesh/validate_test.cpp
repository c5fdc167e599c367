// validate() must find each kind of corruption that an editor can make, and name it.
#include <gtest/gtest.h>

#include <limits>

#include "mesh/mesh_editor.hpp"
#include "unit/mesh/inputs.hpp"

namespace temper {
namespace {

// Square around vertex 4; triangle t has corners t, t + 1, 4; see inputs.hpp.
Mesh mesh_of_fan() { return test::built(test::fan()); }

void expect_found(const Mesh& mesh, const std::string& message) {
  const auto found = mesh.validate();
  ASSERT_TRUE(found.has_value()) << "nothing found, expected: " << message;
  EXPECT_EQ(*found, message);
}

TEST(Validate, FindsNothingInAMesh) { EXPECT_EQ(mesh_of_fan().validate(), std::nullopt); }

TEST(Validate, FindsACornerThatIsNoVertex) {
  Mesh mesh = mesh_of_fan();
  MeshEditor(mesh).set_corner(HalfedgeId(4), VertexId(5));
  expect_found(mesh, "halfedge 4 starts at no vertex");
  MeshEditor(mesh).set_corner(HalfedgeId(4), VertexId());
  expect_found(mesh, "halfedge 4 starts at no vertex");
}

TEST(Validate, FindsACornerOfAnotherTriangle) {
  Mesh mesh = mesh_of_fan();
  MeshEditor(mesh).set_corner(HalfedgeId(4), VertexId(0));
  expect_found(mesh, "halfedge 4 and its twin join different vertices");
}

TEST(Validate, FindsTwinsOutOfRange) {
  Mesh mesh = test::built({{{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}});
  // A twin that exists in a larger mesh: linked in one, then copied triangle by triangle is what a bug would do.
  MeshEditor(mesh).add_triangle({VertexId(1), VertexId(0), VertexId(2)}, 0);
  MeshEditor(mesh).link(HalfedgeId(0), HalfedgeId(3));
  EXPECT_NE(mesh.validate(), std::nullopt);
}

TEST(Validate, PassesOverErasedTrianglesWhoseCornersWereMended) {
  Mesh mesh = test::built({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}});
  MeshEditor(mesh).erase(TriangleId(0));
  EXPECT_NE(mesh.validate(), std::nullopt);
  MeshEditor(mesh).set_outgoing(VertexId(0), HalfedgeId(3));
  MeshEditor(mesh).set_outgoing(VertexId(2), HalfedgeId(4));
  MeshEditor(mesh).set_outgoing(VertexId(1), HalfedgeId());
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_EQ(mesh.n_edges(), 3u);
  mesh.compact();
  EXPECT_EQ(mesh.n_vertices(), 3u);
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(Validate, FindsTwinsThatAreNotMutual) {
  Mesh mesh = mesh_of_fan();
  const HalfedgeId h = mesh.find_halfedge(VertexId(1), VertexId(4)), twin = mesh.twin(h);
  MeshEditor(mesh).link(twin, HalfedgeId());
  expect_found(mesh, "halfedge " + std::to_string(h.index) + " is not the twin of its twin");
}

TEST(Validate, FindsTwinsOfDifferentVertices) {
  Mesh mesh = mesh_of_fan();
  MeshEditor(mesh).link(HalfedgeId(0), HalfedgeId(6));  // bottom and top of the square
  expect_found(mesh, "halfedge 0 and its twin join different vertices");
}

TEST(Validate, FindsAMissingOutgoingHalfedge) {
  Mesh mesh = mesh_of_fan();
  MeshEditor(mesh).set_outgoing(VertexId(2), HalfedgeId());
  expect_found(mesh, "vertex 2 has no halfedge");
  mesh = mesh_of_fan();
  MeshEditor(mesh).set_outgoing(VertexId(2), HalfedgeId(99));
  expect_found(mesh, "vertex 2 has no halfedge");
  mesh = mesh_of_fan();
  MeshEditor(mesh).add_vertex({3, 3, 0});
  expect_found(mesh, "vertex 5 has no halfedge");
}

TEST(Validate, FindsAForeignOutgoingHalfedge) {
  Mesh mesh = mesh_of_fan();
  MeshEditor(mesh).set_outgoing(VertexId(0), HalfedgeId(1));
  expect_found(mesh, "vertex 0 has a foreign halfedge in its star");
}

TEST(Validate, FindsABoundaryStarThatDoesNotBeginOnTheBoundary) {
  Mesh mesh = mesh_of_fan();
  const VertexId v(1);
  MeshEditor(mesh).set_outgoing(v, mesh.rotate(mesh.outgoing(v)));
  expect_found(mesh, "vertex 1 does not reach all its triangles");
}

TEST(Validate, FindsAnUnlinkedEdge) {
  Mesh mesh = mesh_of_fan();
  const HalfedgeId h = mesh.find_halfedge(VertexId(1), VertexId(4)), twin = mesh.twin(h);
  MeshEditor(mesh).link(h, HalfedgeId());
  MeshEditor(mesh).link(twin, HalfedgeId());
  EXPECT_NE(mesh.validate(), std::nullopt);
}

TEST(Validate, FindsAnEdgeConstrainedOnOneSide) {
  Mesh mesh = mesh_of_fan();
  const HalfedgeId h = mesh.find_halfedge(VertexId(1), VertexId(4)), twin = mesh.twin(h);
  MeshEditor(mesh).link(h, HalfedgeId());
  mesh.set_constrained(h, true);  // the twin does not hear of it
  MeshEditor(mesh).link(h, twin);
  expect_found(mesh, "halfedge " + std::to_string(std::min(h, twin).index) + " is constrained on one side only");
}

TEST(Validate, FindsNumbersThatAreNotFinite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const WeightedPoint& bad : {WeightedPoint{nan, 0, 0}, {0, -inf, 0}, {0, 0, inf}, {0, 0, nan}}) {
    Mesh mesh = mesh_of_fan();
    mesh.set_point(VertexId(4), bad);
    expect_found(mesh, "vertex 4 is not finite");
  }
}

TEST(Validate, FindsTrianglesThatAreNotCounterClockwise) {
  Mesh mesh = mesh_of_fan();
  mesh.set_position(VertexId(4), {0, -1});  // on the bottom edge
  expect_found(mesh, "triangle 0 is not counter-clockwise");
  mesh.set_position(VertexId(4), {0, 1 + 0x1p-52});  // just above the top
  expect_found(mesh, "triangle 2 is not counter-clockwise");
  mesh.set_position(VertexId(4), {0, 1 - 0x1p-53});  // just below it
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

}  // namespace
}  // namespace temper
