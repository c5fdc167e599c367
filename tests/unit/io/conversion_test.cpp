// From a file to a mesh and back.
#include "support.hpp"

namespace temper::io {
namespace {

TEST_F(FileTest, TheMeshHasThePointsWeightsAndRegionsOfTheFile) {
  const MeshFile f = tamed(sample());
  const auto made = make_mesh(f);
  ASSERT_TRUE(made) << made.error().what();
  ASSERT_EQ(made->mesh.n_vertices(), f.points.size());
  for (const VertexId v : made->mesh.vertices()) {
    EXPECT_EQ(made->mesh.position(v), f.points[v.index]);
    EXPECT_EQ(made->mesh.weight(v), f.weights[v.index]);
  }
  for (const TriangleId t : made->mesh.triangles()) EXPECT_EQ(made->mesh.region(t), f.triangles.tags[t.index]);
}

TEST_F(FileTest, ReadingAndPuttingBackAnUnchangedMeshChangesNothing) {
  for (const MeshFile& f : {tamed(sample()), tamed(rich_sample())}) {
    const auto made = make_mesh(f);
    ASSERT_TRUE(made) << made.error().what();
    MeshFile g = f;
    update(g, *made, made->mesh);
    expect_same_mesh(f, g);
    expect_same_data(f.point_data, g.point_data, "point data");
    expect_same_data(f.triangles.data, g.triangles.data, "cell data");
  }
}

TEST_F(FileTest, InteriorLinesAreConstrainedAndBoundaryLinesAreNot) {
  const auto made = make_mesh(tamed(sample()));
  ASSERT_TRUE(made);
  const Mesh& mesh = made->mesh;
  const auto edge = [&](std::size_t a, std::size_t b) {
    const HalfedgeId h = mesh.find_halfedge(VertexId(a), VertexId(b));
    return h.valid() ? h : mesh.find_halfedge(VertexId(b), VertexId(a));
  };
  EXPECT_TRUE(mesh.is_constrained(edge(2, 4)));
  EXPECT_TRUE(mesh.is_constrained(edge(1, 4))) << "between regions";
  EXPECT_FALSE(mesh.is_constrained(edge(1, 5)));
}

TEST_F(FileTest, LinesThatAreNoEdgesAreNamedAndConstrainNothing) {
  MeshFile f = tamed(sample());
  f.lines.corners.push_back({0, 4});
  f.lines.tags.push_back(1);
  const auto made = make_mesh(f);
  ASSERT_TRUE(made) << made.error().what();
  ASSERT_EQ(made->warnings.size(), 1u);
  EXPECT_EQ(made->warnings[0], "1 line is no edge of the mesh and constrains nothing: point 0 to point 4");
}

TEST_F(FileTest, ClockwiseTrianglesAreReversedAndCounted) {
  const std::string file = make("m.mesh",
                                "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                "Triangles\n2\n1 2 3 0\n1 4 3 0\nEnd\n");
  const auto f = read(file);
  ASSERT_TRUE(f) << f.error().what();
  const auto made = make_mesh(*f);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->reversed_triangles, 1u);
  ASSERT_EQ(made->warnings.size(), 1u);
  EXPECT_EQ(plain(made->warnings[0]), "m.mesh: 1 clockwise triangle is reversed");
}

TEST_F(FileTest, UnusedPointsAreDroppedAndNamedInTheNumbersOfTheFile) {
  const std::string file =
      make("m.mesh",
           "MeshVersionFormatted 2\nDimension 2\nVertices\n6\n0 0 0\n9 9 3\n1 0 0\n1 1 0\n8 8 0\n0 1 5\n"
           "Edges\n2\n1 3 7\n2 3 7\nTriangles\n2\n1 3 4 0\n1 4 6 0\nEnd\n");
  auto f = read(file);
  ASSERT_TRUE(f) << f.error().what();
  f->weights = {0, 100, 1, 2, 200, 3};
  f->point_data = {{"id", 1, std::vector<std::int32_t>{1, 2, 3, 4, 5, 6}}};
  const auto made = make_mesh(*f);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->mesh.n_vertices(), 4u);
  ASSERT_EQ(made->warnings.size(), 2u);
  EXPECT_EQ(plain(made->warnings[0]), "m.mesh: 2 points of no triangle are dropped: point 2, point 5");
  EXPECT_EQ(plain(made->warnings[1]),
            "m.mesh: 1 line to a point of no triangle is dropped with it: point 2 to point 3");
  const std::vector<std::int32_t> vertex_of_point = {0, -1, 1, 2, -1, 3};
  ASSERT_EQ(made->vertex_of_point.size(), vertex_of_point.size());
  EXPECT_EQ(made->vertex_of_point.n_kept(), 4u);
  for (std::size_t p = 0; p < vertex_of_point.size(); ++p) EXPECT_EQ(made->vertex_of_point[p], vertex_of_point[p]) << p;

  for (int twice = 0; twice < 2; ++twice) {  // as for --save-every
    update(*f, *made, made->mesh);
    EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(f->weights, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(f->lines.corners, (std::vector<std::array<std::int32_t, 2>>{{0, 1}}));
    EXPECT_EQ(f->marked_points.corners, (std::vector<std::int32_t>{3}));
    EXPECT_EQ(f->marked_points.tags, (std::vector<std::int32_t>{5}));
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(f->point_data[0].values), (std::vector<std::int32_t>{1, 3, 4, 6}));
    ASSERT_TRUE(write(path("out.vtu"), *f));
  }
}

TEST_F(FileTest, ErrorsAfterDroppedPointsStillSpeakTheNumbersOfTheFile) {
  const std::string file = make("m.mesh",
                                "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n9 9 0\n0 0 0\n1 0 0\n1 1 0\n1 1 0\n"
                                "Triangles\n2\n2 3 4 0\n2 4 5 0\nEnd\n");
  const auto f = read(file);
  ASSERT_TRUE(f);
  const auto made = make_mesh(*f);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("point 5"), std::string::npos) << made.error().what();
}

TEST_F(FileTest, FixedTagsGoByNumberOrName) {
  const MeshFile f = tamed(rich_sample());
  const auto fixed = [&](const std::vector<std::string>& tags) {
    const auto made = make_mesh(f, tags);
    EXPECT_TRUE(made) << made.error().what();
    std::vector<std::size_t> result;
    for (const VertexId v : made->mesh.vertices()) {
      if (made->mesh.is_fixed(v)) result.push_back(v.index);
    }
    return result;
  };
  using List = std::vector<std::size_t>;
  EXPECT_EQ(fixed({}), (List{0, 3})) << "marked points";
  EXPECT_EQ(fixed({"4"}), (List{0, 1, 2, 3}));
  EXPECT_EQ(fixed({"inflow and more"}), (List{0, 1, 2, 3}));
  EXPECT_EQ(fixed({"corner"}), (List{0, 3}));
  EXPECT_EQ(fixed({"12", "9"}), (List{0, 2, 3, 4}));
  EXPECT_EQ(fixed({"steel"}), (List{0, 1, 2, 3, 4}));
  const std::string unknown[] = {"outflow"};
  const auto made = make_mesh(f, unknown);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::invalid_option);
  EXPECT_EQ(
      made.error().what(),
      "no points, lines or triangles have the tag 'outflow'; there are: corner, inflow and more, steel, 4, 9, 11, 12");
}

TEST_F(FileTest, VerticesThatMeditCallsRequiredAreFixed) {
  const auto f =
      read(make("m.mesh",
                "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nRequiredVertices\n1\n2\n"
                "Triangles\n2\n1 2 3 0\n1 3 4 0\nEnd\n"));
  ASSERT_TRUE(f) << f.error().what();
  const auto made = make_mesh(*f);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->mesh.is_fixed(VertexId(1)));
  EXPECT_FALSE(made->mesh.is_fixed(VertexId(2)));
}

TEST_F(FileTest, AMeshWhoseVerticesAreKnownByTheirPlaceAloneKeepsLinesAndData) {
  MeshFile f = tamed(rich_sample());
  const auto made = make_mesh(f);
  ASSERT_TRUE(made);
  MeshFile smaller;  // without triangle 0 and its vertex 0
  smaller.points = {{1.0 / 3, -0.0}, {2, 0}, {2, 1}, {0.1 + 0.2, 1}, {0, 1}};
  smaller.triangles.corners = {{0, 3, 4}, {0, 1, 3}, {1, 2, 3}};
  const auto other = make_mesh(smaller);
  ASSERT_TRUE(other);
  update(f, *made, other->mesh);
  EXPECT_EQ(f.points, smaller.points);
  EXPECT_EQ(f.triangles.corners, smaller.triangles.corners);
  EXPECT_EQ(f.lines.corners, (std::vector<std::array<std::int32_t, 2>>{{1, 0}, {1, 3}}));
  EXPECT_EQ(f.lines.tags, (std::vector<std::int32_t>{4, 9}));
  EXPECT_EQ(f.marked_points.corners, std::vector<std::int32_t>{2});
  ASSERT_EQ(f.point_data.size(), 4u);
  EXPECT_EQ(std::get<std::vector<double>>(f.point_data[0].values), (std::vector<double>{-0.0, 0.1, 1e300, 2, 3}));
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(f.point_data[3].values),
            (std::vector<std::uint8_t>{1, 2, 253, 254, 255}));
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(f.triangles.data[0].values),
            (std::vector<std::int32_t>{2, 3, -2147483647}));
  EXPECT_EQ(f.warnings, std::vector<std::string>{"2 lines or marked points have lost their vertices and are dropped"});
  EXPECT_TRUE(write(path("m.vtu"), f));
}

TEST_F(FileTest, AFileOfAMeshGivesTheMeshBack) {
  auto made = make_mesh(tamed(sample()));
  ASSERT_TRUE(made);
  made->mesh.set_constrained(made->mesh.find_halfedge(VertexId(1), VertexId(5)), true);
  const MeshFile f = from_mesh(made->mesh);
  EXPECT_EQ(f.lines.size(), 1u) << "only the line that no interface between regions stands for";
  const auto again = make_mesh(f);
  ASSERT_TRUE(again) << again.error().what();
  EXPECT_TRUE(again->mesh == made->mesh);
}

}  // namespace
}  // namespace temper::io
