// Gmsh in the forms that Gmsh itself writes and that temper does not.
#include "support.hpp"

namespace temper::io {
namespace {

const std::string kNodes2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n10 0 0 0\n20 1 0 0\n30 1 1 0\n7 0 1 0\n$EndNodes\n";

TEST_F(FileTest, SparseNodeNumbersAndElementsOutOfOrderAreRead) {
  const auto f = read(make(
      "m.msh", kNodes2 + "$Elements\n3\n9 2 2 5 1 10 30 7\n3 1 2 8 1 10 20\n4 2 3 6 1 0 10 20 30\n$EndElements\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}))
      << "in the order of their numbers";
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{6, 5}));
  EXPECT_EQ(f->lines.tags, std::vector<std::int32_t>{8});
  EXPECT_EQ(f->numbering->point(3), "point 7");
  EXPECT_EQ(f->numbering->triangle(1), "triangle 9");
  EXPECT_EQ(plain(f->numbering->triangle_where(1)), "m.msh:13");
}

TEST_F(FileTest, ElementsOfHigherOrderAreReadByTheirCorners) {
  const std::string points = "1 0 0 0\n2 0.5 0 0\n3 1 0 0\n4 0.5 0.5 0\n5 0 0.5 0\n6 0 1 0\n7 2 1 0\n";
  const auto f =
      read(make("m.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n" + points +
                             "$EndNodes\n$Elements\n3\n1 8 2 4 1 1 3 2\n2 9 2 5 1 1 3 6 2 4 5\n3 2 2 6 1 3 7 6\n"
                             "$EndElements\n$NodeData\n1\n\"t\"\n1\n0\n3\n0\n1\n7\n1 1\n2 2\n3 3\n4 4\n5 5\n6 6\n7 7\n"
                             "$EndNodeData\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}, {2, 1}}));
  EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{5, 6}));
  EXPECT_EQ(f->lines.corners, (std::vector<std::array<std::int32_t, 2>>{{0, 1}}));
  EXPECT_EQ(f->point_data.at(0).values, Values(std::vector<double>{1, 3, 6, 7}));
  EXPECT_EQ(f->numbering->point(3), "point 7");
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(
      plain(f->warnings[0]),
      "m.msh: elements of higher order are read by their corners: edges become straight, and nodes between corners "
      "are left out");
  const auto tets =
      read(make("t.msh",
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 "
                "0\n6 .5 .5 0\n7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n$EndNodes\n$Elements\n1\n1 11 2 9 1 1 "
                "2 3 4 5 6 7 8 9 10\n$EndElements\n"));
  ASSERT_TRUE(tets) << tets.error().what();
  EXPECT_EQ(tets->points.size(), 4u);
  EXPECT_EQ(tets->tetrahedra.tags, std::vector<std::int32_t>{9});
  const auto solid = read(make("m.msh",
                               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n"
                               "1 17 2 9 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\n$EndElements\n"));
  ASSERT_FALSE(solid);
  EXPECT_EQ(plain(solid.error().what()).substr(0, 47), "m.msh:10: element 1 is a quadratic hexahedron; ");
}

TEST_F(FileTest, NamesOfVersion20AreOfAllDimensionsWhoseElementsCarryTheTag) {
  const std::string content =
      "$MeshFormat\n2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n5 \"steel and more\"\n8 \"wall\"\n100 \"nothing\"\n"
      "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n4\n"
      "1 15 3 8 1 0 1\n2 1 3 8 1 0 1 2\n3 2 3 5 1 0 1 2 3\n4 2 3 5 1 0 1 3 4\n$EndElements\n";
  const auto f = read(make("m.msh", content));
  ASSERT_TRUE(f) << f.error().what();
  std::vector<std::string> names;
  for (const PhysicalName& n : f->names) {
    names.push_back(std::to_string(n.dimension) + " " + std::to_string(n.tag) + " " + n.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"2 5 steel and more", "0 8 wall", "1 8 wall"}));
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(
      plain(f->warnings[0]),
      "m.msh: the physical name 'nothing' of tag 100 is dropped: it has no dimension, and no element has the tag");
}

TEST_F(FileTest, ATriangleThatVersion2ListsOnceForEachGroupIsInAllOfThem) {
  const std::string elements =
      "$Elements\n5\n1 2 2 5 1 10 20 30\n2 2 2 6 1 10 20 30\n3 2 2 7 1 10 20 30\n4 2 2 5 1 10 30 7\n"
      "5 2 2 7 1 7 30 10\n$EndElements\n$ElementData\n1\n\"e\"\n1\n0\n3\n0\n1\n3\n1 1.5\n2 2.5\n4 3.5\n"
      "$EndElementData\n";
  const auto f = read(make("m.msh", kNodes2 + elements));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.corners, (std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{6, 5})) << "6 is a part of 5, and 7 is not";
  EXPECT_EQ(f->numbering->triangle(1), "triangle 4");
  EXPECT_EQ(std::get<std::vector<double>>(f->triangles.data.at(0).values), (std::vector<double>{1.5, 3.5}));
  ASSERT_EQ(f->triangles.data.size(), 5u);
  for (const auto& [i, name, inside] : {std::tuple(1, "gmsh:physical:first", std::vector<std::int32_t>{5, 5}),
                                        {2, "gmsh:physical:6", std::vector<std::int32_t>{1, 0}},
                                        {3, "gmsh:physical:7", std::vector<std::int32_t>{1, 1}}}) {
    EXPECT_EQ(f->triangles.data[i].name, name);
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(f->triangles.data[i].values), inside);
  }
  EXPECT_TRUE(f->warnings.empty());
}

/// Four triangles around the center of a square. The groups 1 to 3 overlap: {1}, {1 2}, {1 2 3}, {1 3}.
const std::string kOverlap =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"all\"\n2 2 \"wet\"\n2 3 \"clay\"\n"
    "$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 .5 .5 0\n$EndNodes\n$Elements\n8\n"
    "1 2 2 1 1 1 2 5\n2 2 2 1 2 2 3 5\n3 2 2 1 3 3 4 5\n4 2 2 1 4 4 1 5\n5 2 2 2 2 2 3 5\n6 2 2 2 3 3 4 5\n"
    "7 2 2 3 3 3 4 5\n8 2 2 3 4 4 1 5\n$EndElements\n";

std::vector<std::string> lines_of(const std::vector<PhysicalName>& names) {
  std::vector<std::string> lines;
  for (const PhysicalName& n : names)
    lines.push_back(std::to_string(n.dimension) + " " + std::to_string(n.tag) + " " + n.name);
  return lines;
}

TEST_F(FileTest, TrianglesWithDifferentSetsOfGroupsAreDifferentRegions) {
  const auto f = read(make("m.msh", kOverlap));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{1, 4, 6, 5}));
  EXPECT_EQ(lines_of(f->names), (std::vector<std::string>{"2 1 all", "2 2 wet", "2 3 clay", "2 4 all and wet",
                                                          "2 5 all and clay", "2 6 all and wet and clay"}));
  for (const auto& [format, encoding] :
       {std::pair("gmsh22", Encoding::ascii), {"gmsh22", Encoding::appended}, {"gmsh41", Encoding::ascii}}) {
    SCOPED_TRACE(format);
    // By way of VTU, which holds regions, names and data.
    ASSERT_TRUE(write(path("a.vtu"), *f));
    const auto vtu = read(path("a.vtu"));
    ASSERT_TRUE(vtu);
    ASSERT_TRUE(write(path("b.msh"), *vtu, {.format = format, .encoding = encoding}));
    const std::string bytes = slurp(path("b.msh"));
    EXPECT_NE(bytes.find("$PhysicalNames\n3\n2 1 \"all\"\n2 2 \"wet\"\n2 3 \"clay\"\n$End"), std::string::npos);
    const auto back = read(path("b.msh"));
    ASSERT_TRUE(back) << back.error().what();
    EXPECT_EQ(back->triangles.tags, f->triangles.tags);
    EXPECT_EQ(lines_of(back->names), lines_of(f->names));
    for (const std::string group : {"first", "2", "3"}) {
      const auto named = [&](const DataArray& a) { return a.name == "gmsh:physical:" + group; };
      const auto before = std::find_if(f->triangles.data.begin(), f->triangles.data.end(), named);
      const auto after = std::find_if(back->triangles.data.begin(), back->triangles.data.end(), named);
      ASSERT_TRUE(before != f->triangles.data.end() && after != back->triangles.data.end()) << group;
      EXPECT_EQ(before->values, after->values) << group;
    }
  }
}

TEST_F(FileTest, VerticesOfAGroupAreFixedInAllItsRegions) {
  const auto f = read(make("m.msh", kOverlap));
  ASSERT_TRUE(f) << f.error().what();
  const auto fixed = [&](const std::string& group) {
    const auto made = make_mesh(*f, std::vector<std::string>{group});
    EXPECT_TRUE(made) << made.error().what();
    std::vector<std::size_t> numbers;
    for (const VertexId v : made->mesh.vertices()) {
      if (made->mesh.is_fixed(v)) numbers.push_back(v.index);
    }
    return numbers;
  };
  EXPECT_EQ(fixed("all"), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(fixed("wet"), (std::vector<std::size_t>{1, 2, 3, 4})) << "the triangles 2 3 5 and 3 4 5";
  EXPECT_EQ(fixed("all and clay"), (std::vector<std::size_t>{0, 3, 4}));
}

TEST_F(FileTest, EachElementHasAGroupIfAnyElementHasOne) {
  MeshFile f;
  f.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  f.triangles.corners = {{0, 1, 2}, {0, 2, 3}};
  f.lines.corners = {{0, 1}, {2, 3}};
  f.lines.tags = {5, 0};
  f.marked_points.corners = {2};
  f.marked_points.tags = {0};
  f.names = {{1, 5, "inflow"}, {2, 8, "nowhere"}};
  const std::string names =
      "$PhysicalNames\n5\n1 5 \"inflow\"\n2 8 \"nowhere\"\n0 9 \"temper_ungrouped_points\"\n"
      "1 10 \"temper_ungrouped_lines\"\n2 11 \"temper_ungrouped_faces\"\n$End";
  for (const auto& [format, encoding, elements] :
       {std::tuple("gmsh22", Encoding::ascii, "1 15 2 9 1 3 \n2 1 2 5 1 1 2 \n3 1 2 10 2 3 4 \n4 2 2 11 1 1 2 3 \n"),
        {"gmsh41", Encoding::ascii, "$Entities\n1 2 1 0 \n1 0 0 0 1 9 \n1 0 0 0 1 1 0 1 5 0 \n2 0 0 0 1 1 0 1 10 0 \n"},
        {"gmsh22", Encoding::appended, ""},
        {"gmsh41", Encoding::appended, ""}}) {
    SCOPED_TRACE(format);
    ASSERT_TRUE(write(path("m.msh"), f, {.format = format, .encoding = encoding}));
    const std::string bytes = slurp(path("m.msh"));
    EXPECT_NE(bytes.find(names), std::string::npos) << bytes;
    EXPECT_NE(bytes.find(elements), std::string::npos) << bytes;
    const auto back = read(path("m.msh"));
    ASSERT_TRUE(back) << back.error().what();
    EXPECT_TRUE(back->triangles.tags.empty());
    EXPECT_EQ(back->lines.tags, f.lines.tags);
    EXPECT_EQ(back->marked_points.tags, f.marked_points.tags);
    EXPECT_EQ(lines_of(back->names), lines_of(f.names));
  }
}

TEST_F(FileTest, TheGroupOfTheOtherElementsHasATagThatIsFree) {
  MeshFile f;
  f.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  f.triangles.corners = {{0, 1, 2}, {0, 2, 3}};
  f.triangles.tags = {std::numeric_limits<std::int32_t>::max(), 0};
  f.names = {{1, 1, "wall"}};
  ASSERT_TRUE(write(path("m.msh2"), f));
  EXPECT_NE(slurp(path("m.msh2")).find("2 2 \"temper_ungrouped_faces\"\n"), std::string::npos);
  const auto back = read(path("m.msh2"));
  ASSERT_TRUE(back) << back.error().what();
  EXPECT_EQ(back->triangles.tags, f.triangles.tags);
  f.triangles.tags = {0, 0};
  ASSERT_TRUE(write(path("m.msh2"), f));
  EXPECT_EQ(slurp(path("m.msh2")).find("temper_ungrouped"), std::string::npos) << "no element has a group";
}

TEST_F(FileTest, ATriangleThatIsThereTwiceWithOneTagIsRefused) {
  const auto f = read(make("m.msh", kNodes2 + "$Elements\n3\n1 2 2 5 1 10 20 30\n2 2 2 5 1 10 20 30\n"
                                              "3 2 2 6 1 10 30 7\n$EndElements\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->triangles.size(), 3u);
  const auto made = make_mesh(*f);
  ASSERT_FALSE(made);
  EXPECT_EQ(plain(made.error().what()),
            "m.msh:14: triangle 1 and triangle 2 lie on the same side of the edge from point 10 to point 20");
}

TEST_F(FileTest, CommentsBeforeAndBetweenSectionsAreSkipped) {
  const auto f = read(make("m.msh", "####\n# Mesh file of a test, not $MeshFormat\n####\n\n" + kNodes2 +
                                        "# $Elements\n$Elements\n1\n9 2 2 5 1 10 30 7\n$EndElements\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->format, "gmsh22");
  EXPECT_EQ(plain(f->numbering->triangle_where(0)), "m.msh:18");
}

TEST_F(FileTest, AnElementOfAnUnknownTypeIsAnElement) {
  const auto f = read(make("m.msh", kNodes2 + "$Elements\n1\n9 93 2 5 1 10 30 7\n$EndElements\n"));
  ASSERT_FALSE(f);
  EXPECT_EQ(plain(f.error().what()),
            "m.msh:13: element 9 is an element of an unknown type; temper reads linear triangles, quadrilaterals and "
            "tetrahedra, with lines and points as tags");
}

TEST_F(FileTest, LinesToPointsOfNoTriangleAreDroppedWithAWarning) {
  const auto f = read(
      make("m.msh", kNodes2 + "$Elements\n3\n1 2 2 5 1 10 20 30\n2 1 2 8 1 30 7\n3 1 2 8 1 10 20\n$EndElements\n"));
  ASSERT_TRUE(f) << f.error().what();
  const auto made = make_mesh(*f);
  ASSERT_TRUE(made) << made.error().what();
  ASSERT_EQ(made->warnings.size(), 2u);
  EXPECT_EQ(plain(made->warnings[0]), "m.msh: 1 point of no triangle is dropped: point 7");
  EXPECT_EQ(plain(made->warnings[1]),
            "m.msh: 1 line to a point of no triangle is dropped with it: point 30 to point 7");
}

TEST_F(FileTest, ANodeNumberThatIsNoneIsNamed) {
  const auto f = read(make("m.msh", kNodes2 + "$Elements\n1\n9 2 2 5 1 10 30 8\n$EndElements\n"));
  ASSERT_FALSE(f);
  EXPECT_EQ(plain(f.error().what()), "m.msh:13: triangle 9 uses vertex 8, but the file has no vertex of that number");
}

TEST_F(FileTest, ANodeNumberGivenTwiceIsNamed) {
  const auto f =
      read(make("m.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n1 1 1 0\n$EndNodes\n"));
  ASSERT_FALSE(f);
  EXPECT_EQ(plain(f.error().what()), "m.msh:8: node number 1 is given twice");
}

TEST_F(FileTest, DataOfSomeNodesAreNanElsewhereAndWeightsMustBeWhole) {
  const std::string elements = "$Elements\n2\n1 2 2 0 1 10 20 30\n2 2 2 0 1 10 30 7\n$EndElements\n";
  const auto data = [](const std::string& name) {
    return "$NodeData\n1\n\"" + name + "\"\n1\n0.0\n3\n0\n1\n2\n20 1.5\n7 2.5\n$EndNodeData\n";
  };
  const auto f = read(make("m.msh", kNodes2 + elements + data("t")));
  ASSERT_TRUE(f) << f.error().what();
  const auto& t = std::get<std::vector<double>>(f->point_data.at(0).values);
  EXPECT_EQ(t[1], 1.5);
  EXPECT_EQ(t[3], 2.5);
  EXPECT_TRUE(std::isnan(t[0]) && std::isnan(t[2]));
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(plain(f->warnings[0]), "m.msh:26: node data 't' miss 2 points: read as NaN");

  const auto g = read(make("m.msh", kNodes2 + elements + data("weight")));
  ASSERT_FALSE(g);
  EXPECT_EQ(plain(g.error().what()), "m.msh:26: node data 'weight' miss 2 of 4 points, the first is point 10");
}

TEST_F(FileTest, TimeStepsOfOneNameAreKeptApart) {
  const auto step = [](const char* time, const char* value) {
    return std::string("$ElementData\n1\n\"e\"\n1\n") + time + "\n3\n0\n1\n1\n1 " + value + "\n$EndElementData\n";
  };
  const auto f = read(
      make("m.msh", kNodes2 + "$Elements\n1\n1 2 2 0 1 10 20 30\n$EndElements\n" + step("0", "3") + step("0.5", "4")));
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_EQ(f->triangles.data.size(), 3u);
  EXPECT_EQ(f->triangles.data[0].name, "e");
  EXPECT_EQ(f->triangles.data[1].name, "e@0.5");
  EXPECT_EQ(f->triangles.data[2].name, "gmsh:geometrical");
}

TEST_F(FileTest, ParametricNodesCommentsAndDroppedSectionsOfVersion41AreRead) {
  const auto f =
      read(make("m.msh",
                "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\nmade by hand\n$EndComments\n$Entities\n1 1 1 0\n"
                "5 0 0 0 1 77\n3 0 0 0 1 0 0 2 8 9 2 5 -5\n1 0 0 0 1 1 0 1 4 1 3\n$EndEntities\n$Nodes\n2 3 1 3\n"
                "1 3 1 2\n1\n2\n0 0 0 0.5\n1 0 0 0.75\n2 1 0 1\n3\n0 1 0\n$EndNodes\n$Elements\n3 3 1 3\n"
                "0 5 15 1\n1 1\n1 3 1 1\n2 1 2\n2 1 2 1\n3 1 2 3\n$EndElements\n$Periodic\n0\n$EndPeriodic\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(f->triangles.tags, std::vector<std::int32_t>{4});
  EXPECT_EQ(f->lines.tags, (std::vector<std::int32_t>{8, 9}));
  EXPECT_EQ(f->marked_points.tags, std::vector<std::int32_t>{77});
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(plain(f->warnings[0]), "m.msh:33: section $Periodic is dropped");
}

TEST_F(FileTest, BigEndianBinaryIsRead) {
  const auto big = [](auto value) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    std::reverse(one.begin(), one.end());
    return one;
  };
  std::string content = "$MeshFormat\n2.2 1 8\n" + big(std::int32_t{1}) + "\n$EndMeshFormat\n$Nodes\n3\n";
  const double xy[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  for (std::int32_t i = 0; i < 3; ++i) content += big(i + 1) + big(xy[i][0]) + big(xy[i][1]) + big(0.25);
  content += "\n$EndNodes\n$Elements\n1\n";
  for (const std::int32_t v : {2, 1, 2, 1, 6, 1, 1, 2, 3}) content += big(v);
  content += "\n$EndElements\n";
  const auto f = read(make("m.msh", content));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->z(), 0.25);
  EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(f->triangles.tags, std::vector<std::int32_t>{6});
}

/// Numbers of a file, as words or as bytes.
class Numbers {
 public:
  explicit Numbers(bool binary) : binary_(binary) {}
  template <class... T>
  Numbers& operator()(T... values) {
    (one(values), ...);
    if (!binary_) content += '\n';
    return *this;
  }
  std::string content;

 private:
  void one(int value) { put(std::int32_t{value}); }
  void one(unsigned value) { put(std::uint64_t{value}); }
  void one(double value) { put(value); }
  template <class T>
  void put(T value) {
    if (!binary_) return static_cast<void>(content += std::to_string(value) + " ");
    content.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  bool binary_;
};

/// A square of two triangles with a well, a wall, and an inflow whose group has its curve in the other direction:
///
///     4 ---- 3          In two parts there are, too, the edge 1-3 between them (curve 12, of surface 1), its
///     |  20/ |          end 3 (point 10, of curve 2), and the triangle 1 2 3 again as a ghost (surface 20).
///  32 |  / 10| 31
///     1 ---- 2 (well)
std::string square_41(bool binary, bool partitioned) {
  const std::string names =
      "$PhysicalNames\n5\n0 40 \"well\"\n1 31 \"inflow\"\n1 32 \"wall\"\n2 10 \"granite\"\n2 20 \"sand\"\n"
      "$EndPhysicalNames\n";
  std::string file = "$MeshFormat\n4.1 " + std::string(binary ? "1 8\n" : "0 8\n");
  if (binary) file += Numbers(true)(1).content + "\n";
  file += "$EndMeshFormat\n" + names + "$Entities\n";
  Numbers entities(binary);
  entities(1u, 2u, 2u, 0u);
  entities(2, 1., 0., 0., 1u, 40);
  entities(2, 1., 0., 0., 1., 1., 0., 1u, -31, 0u)(3, 0., 0., 0., 0., 1., 0., 1u, 32, 0u);
  entities(1, 0., 0., 0., 1., 1., 0., 1u, 10, 0u)(2, 0., 0., 0., 1., 1., 0., 1u, 20, 0u);
  file += entities.content + "\n$EndEntities\n";
  const int shift = partitioned ? 7 : 0;  // of the numbers of entities
  if (partitioned) {
    Numbers parts(binary);
    parts(2u, 2u)(20, 1)(21, 2)(2u, 3u, 2u, 0u);
    parts(9, 0, 2, 1u, 1, 1., 0., 0., 0u)(10, 1, 2, 2u, 1, 2, 1., 1., 0., 0u);
    parts(9, 1, 2, 1u, 1, 1., 0., 0., 1., 1., 0., 0u, 2u, 9, -10);
    parts(10, 1, 3, 1u, 2, 0., 0., 0., 0., 1., 0., 1u, 32, 0u);
    parts(12, 2, 1, 2u, 1, 2, 0., 0., 0., 1., 1., 0., 1u, 10, 0u);
    parts(8, 2, 1, 1u, 1, 0., 0., 0., 1., 1., 0., 1u, 99, 0u)(9, 2, 2, 1u, 2, 0., 0., 0., 1., 1., 0., 0u, 0u);
    file += "$PartitionedEntities\n" + parts.content + "\n$EndPartitionedEntities\n";
  }
  Numbers nodes(binary);
  nodes(1u, 4u, 1u, 4u)(2, 1 + shift, 0, 4u)(1u)(2u)(3u)(4u)(0., 0., 0.)(1., 0., 0.)(1., 1., 0.)(0., 1., 0.);
  file += "$Nodes\n" + nodes.content + "\n$EndNodes\n$Elements\n";
  Numbers elements(binary);
  elements(partitioned ? 8u : 5u, partitioned ? 8u : 5u, 1u, 8u);
  elements(0, 2 + shift, 15, 1u)(1u, 2u);
  elements(1, 2 + shift, 1, 1u)(2u, 2u, 3u)(1, 3 + shift, 1, 1u)(3u, 4u, 1u);
  elements(2, 1 + shift, 2, 1u)(4u, 1u, 2u, 3u)(2, 2 + shift, 2, 1u)(5u, 1u, 3u, 4u);
  if (partitioned) elements(0, 10, 15, 1u)(6u, 3u)(1, 12, 1, 1u)(7u, 1u, 3u)(2, 20, 2, 1u)(8u, 1u, 2u, 3u);
  file += elements.content + "\n$EndElements\n";
  if (partitioned) file += "$ElementData\n1\n\"e\"\n1\n0\n3\n0\n1\n3\n";
  Numbers data(binary);
  if (partitioned) file += data(4, 1.5)(5, 2.5)(7, 3.5).content + "\n$EndElementData\n";
  return file;
}

TEST_F(FileTest, APartitionedMeshIsTheMeshOfItsParts) {
  for (const bool binary : {false, true}) {
    SCOPED_TRACE(binary);
    const auto plain_file = read(make("whole.msh", square_41(binary, false)));
    auto f = read(make("parts.msh", square_41(binary, true)));
    ASSERT_TRUE(plain_file) << plain_file.error().what();
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->triangles.corners, plain_file->triangles.corners);
    EXPECT_EQ(f->triangles.tags, plain_file->triangles.tags);
    EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{10, 20}));
    EXPECT_EQ(f->lines.corners, plain_file->lines.corners);
    EXPECT_EQ(f->lines.corners, (std::vector<std::array<std::int32_t, 2>>{{2, 1}, {3, 0}}))
        << "in the direction of the group";
    EXPECT_EQ(f->lines.tags, plain_file->lines.tags);
    EXPECT_EQ(f->lines.tags, (std::vector<std::int32_t>{31, 32}));
    EXPECT_EQ(f->marked_points.tags, plain_file->marked_points.tags);
    EXPECT_EQ(f->marked_points.tags, std::vector<std::int32_t>{40});
    ASSERT_EQ(f->lines.data.size(), 1u);
    EXPECT_EQ(f->lines.data[0].values, plain_file->lines.data.at(0).values) << "entities that the partition divided";
    const auto partition = std::find_if(f->triangles.data.begin(), f->triangles.data.end(),
                                        [](const DataArray& a) { return a.name == "gmsh:partition"; });
    ASSERT_NE(partition, f->triangles.data.end());
    EXPECT_EQ(std::get<std::vector<std::int32_t>>(partition->values), (std::vector<std::int32_t>{1, 2}));
    ASSERT_EQ(f->warnings.size(), 1u);
    EXPECT_EQ(plain(f->warnings[0]), "parts.msh: 3 elements that the partition added are left out");
    const auto made = make_mesh(*f);
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_TRUE(made->warnings.empty());
  }
}

TEST_F(FileTest, PartitionsOfVersion2AreDataAndTheEdgesBetweenThemAreLeftOut) {
  const auto f = read(make("m.msh",
                           "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 30 \"fault\"\n"
                           "$EndPhysicalNames\n" +
                               kNodes2.substr(kNodes2.find("$Nodes")) +
                               "$Elements\n5\n1 1 5 30 7 2 1 2 10 30\n2 1 5 0 8 2 1 2 10 30\n"
                               "3 1 5 9 8 2 2 -1 10 20\n4 2 4 5 1 1 2 10 20 30\n5 2 5 5 1 2 3 -2 10 30 7\n"
                               "$EndElements\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_EQ(f->lines.tags, (std::vector<std::int32_t>{30, 9})) << "a ghost is not between partitions";
  EXPECT_EQ(f->triangles.tags, (std::vector<std::int32_t>{5, 5}));
  ASSERT_FALSE(f->triangles.data.empty());
  EXPECT_EQ(f->triangles.data[0].name, "gmsh:partition");
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(f->triangles.data[0].values), (std::vector<std::int32_t>{2, 3}));
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(plain(f->warnings[0]), "m.msh: 1 element that the partition added is left out");
}

TEST_F(FileTest, ParametricNodesOfVersion22AreRead) {
  for (const bool binary : {false, true}) {
    SCOPED_TRACE(binary);
    std::string file = "$MeshFormat\n2.2 " + std::string(binary ? "1 8\n" : "0 8\n");
    if (binary) file += Numbers(true)(1).content + "\n";
    Numbers nodes(binary), elements(binary);
    nodes(1, 0., 0., 2., 0, 7)(2, 1., 0., 2., 1, 7, .5)(3, 0., 1., 2., 2, 1, .25, .75)(4, 1., 1., 2., 3, 1);
    binary ? elements(2, 2, 2)(1, 6, 1, 1, 2, 3)(2, 6, 1, 2, 4, 3)
           : elements(1, 2, 2, 6, 1, 1, 2, 3)(2, 2, 2, 6, 1, 2, 4, 3);
    file += "$EndMeshFormat\n$ParametricNodes\n4\n" + nodes.content + "\n$EndParametricNodes\n$Elements\n2\n" +
            elements.content + "\n$EndElements\n";
    const auto f = read(make("m.msh", file));
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
    EXPECT_EQ(f->z(), 2);
    EXPECT_EQ(f->triangles.size(), 2u);
    EXPECT_TRUE(f->warnings.empty());
  }
}

}  // namespace
}  // namespace temper::io
