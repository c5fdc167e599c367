// JIGSAW, OFF, PLY and ADCIRC's fort.14 as other programs write them.
#include <bit>

#include "support.hpp"

namespace temper::io {
namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;
using Lines = std::vector<std::array<std::int32_t, 2>>;
using Tags = std::vector<std::int32_t>;

std::string text_of_name(const Format& format) {
  return "m" + std::string(format.suffixes.substr(0, format.suffixes.find(' ')));
}

class OtherFormats : public FileTest {
 protected:
  MeshFile read_ok(const std::string& name, const std::string& content) const {
    auto f = read(make(name, content));
    EXPECT_TRUE(f) << f.error().what();
    return f ? *f : MeshFile{};
  }
  std::string refused(const std::string& name, const std::string& content) const {
    const auto f = read(make(name, content));
    EXPECT_FALSE(f) << content;
    return f ? "" : plain(f.error().what());
  }
};

// --- JIGSAW ----------------------------------------------------------------------------------------------------

TEST_F(OtherFormats, JigsawGivesWeightsTagsAndValues) {
  const MeshFile f = read_ok("m.msh",
                             "# a comment; with = and ;\nmshid=3;euclidean-mesh\nNDIMS = 2\nPOINT=4\n0;0;0\n1;0;7\n"
                             "1;1;0\n0;1;0\nPOWER=4;1\n0.5\n-0\n1e-300\n-2\nVALUE=4;2\n1;2\n3;4\n5;6\n7;8\n"
                             "EDGE2=1\n0;1;5\nTRIA3=2\n0;1;2;1\n0;2;3;2\nBOUND=1\n1;0;20\n");
  EXPECT_EQ(f.format, "jigsaw");
  EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(f.triangles.tags, (Tags{1, 2}));
  EXPECT_TRUE(same_bits(f.weights, {0.5, -0.0, 1e-300, -2}));
  EXPECT_EQ(f.lines.corners, (Lines{{0, 1}}));
  EXPECT_EQ(f.lines.tags, (Tags{5}));
  EXPECT_EQ(f.marked_points.corners, (Tags{1}));
  EXPECT_EQ(f.marked_points.tags, (Tags{7}));
  ASSERT_EQ(f.point_data.size(), 1u);
  EXPECT_EQ(f.point_data[0].name, "value");
  EXPECT_EQ(f.point_data[0].components, 2);
  ASSERT_EQ(f.warnings.size(), 1u);
  EXPECT_NE(f.warnings[0].find("BOUND"), std::string::npos);
}

TEST_F(OtherFormats, JigsawWritesPowerUnderTheValuesOfItsPoints) {
  MeshFile f;
  f.points = {{0, 0}, {1, 0}, {0, 1}};
  f.triangles.corners = {{0, 1, 2}};
  f.weights = {0.25, -0.0, 3};
  ASSERT_TRUE(write(path("m.jigsaw.msh"), f));
  EXPECT_EQ(
      slurp(path("m.jigsaw.msh")),
      "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=3\n0;0;0\n1;0;0\n0;1;0\nPOWER=3;1\n0.25\n-0\n3\nTRIA3=1\n0;1;2;0\n");
}

TEST_F(OtherFormats, JigsawThatIsNoMeshOfTrianglesIsNamed) {
  const std::string head = "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\n", points = "POINT=3\n0;0;0\n1;0;0\n0;1;0\n";
  EXPECT_EQ(refused("m.msh", "MSHID=3;EUCLIDEAN-GRID\nNDIMS=2\n"),
            "m.msh:1: is of kind 'EUCLIDEAN-GRID'; temper reads EUCLIDEAN-MESH and ELLIPSOID-MESH");
  EXPECT_EQ(refused("m.msh", head + points + "EDGE2=1\n0;1;0\n"),
            "m.msh: the file has no triangles: it is an outline, for `temper mesh` to mesh");
  EXPECT_EQ(refused("m.msh", head + points), "m.msh: the file has no triangles or tetrahedra");
  EXPECT_EQ(refused("m.msh", head + points + "QUAD4=1\n0;1;2;0;0\n"),
            "m.msh:8: element 0 is a quadrilateral; in this format temper reads linear triangles, with lines and "
            "points as tags. Next: write meshes of quadrilaterals as VTU or Gmsh");
  EXPECT_EQ(refused("m.msh", head + points + "POWER=2;1\n0\n1\nTRIA3=1\n0;1;2;0\n"),
            "m.msh: POWER has 2 rows, but there are 3 points");
  EXPECT_EQ(refused("m.msh", head + points + "TRIA3=1\n0;1;9;0\n"),
            "m.msh:8: triangle 0 uses vertex 9, but the file has 3 vertices, numbered from 0");
}

// --- medit -----------------------------------------------------------------------------------------------------

TEST_F(OtherFormats, MeditOfBamgHasTextsInQuotesWhichAreDropped) {
  const std::string head = "MeshVersionFormatted 0\n\nDimension\n2\n\nIdentifier\n\"G=a 1.msh; # 3 of 4\nVertices\"\n";
  const MeshFile f = read_ok("m.msh", head +
                                          "Geometry\n\"a.msh\"\nVertices\n3\n0 0 1\n1 0 1\n0 1 1\nTriangles\n1\n"
                                          "1 2 3 4\nSubDomainFromMesh\n1\n3 1 1 0\nEnd\n");
  EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(f.triangles.tags, (Tags{4}));
  ASSERT_EQ(f.warnings.size(), 3u);
  EXPECT_EQ(plain(f.warnings[1]), "m.msh:9: section 'Geometry' is dropped");
  EXPECT_EQ(refused("m.msh", "MeshVersionFormatted 0\nDimension 2\nGeometry \"a.msh\nVertices\n"),
            "m.msh:3: the file ends where the end of a quoted text was expected");
}

// --- OBJ -------------------------------------------------------------------------------------------------------

TEST_F(OtherFormats, ObjWithARegionOfTag0IsWrittenAsItWas) {
  const std::string content = "v 0 0 0\nv 1 0 0\nv 0 1 0\ng region_0\nf 1 2 3\n";
  const MeshFile f = read_ok("m.obj", content);
  EXPECT_EQ(f.triangles.tags, Tags{0});
  ASSERT_TRUE(write(path("n.obj"), f));
  EXPECT_EQ(slurp(path("n.obj")), content);
  EXPECT_TRUE(read_ok("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng line_2\nf 1 2 3\n").triangles.tags.empty());
}

// --- OFF -------------------------------------------------------------------------------------------------------

TEST_F(OtherFormats, OffWithColorsAndCommentsIsReadAndSaysWhatItDrops) {
  const MeshFile f = read_ok("m.off",
                             "COFF # colors\n4 2 0\n# points\n0 0 2 255 0 0 255\n1 0 2 0 0 0 255\n1 1 2 0 0 0 255\n"
                             "0 1 2 0 0 0 255\n3 0 1 2 0.5 0.5 0.5\n3 0 2 3\n");
  EXPECT_EQ(f.format, "off");
  EXPECT_EQ(f.z(), 2);
  EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(f.warnings.size(), 2u);
  EXPECT_EQ(read_ok("m.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").triangles.corners, (Triangles{{0, 1, 2}}));
}

TEST_F(OtherFormats, ObjSaysThatItDropsColors) {
  const MeshFile f = read_ok("m.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  ASSERT_EQ(f.warnings.size(), 1u);
  EXPECT_NE(f.warnings[0].find("statements that are no mesh are dropped: numbers after z, vn"), std::string::npos);
  EXPECT_EQ(refused("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\rf 1 2 3\n"), "m.obj:3: expected a color, found 'f'");
}

TEST_F(OtherFormats, QuadrilateralsOfOffAndObjAreCutInTwo) {
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_EQ(read_ok("m.off", "OFF\n4 1 0\n" + points + "4 0 1 2 3\n").triangles.size(), 2u);
  const MeshFile obj =
      read_ok("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\ng inlet\nf 1 2 3 4\ng outlet\nf 2 5 3\n");
  EXPECT_EQ(obj.triangles.size(), 3u);
  EXPECT_EQ(std::set<std::int32_t>(obj.triangles.tags.begin(), obj.triangles.tags.end()).size(), 2u);
  EXPECT_EQ(std::count(obj.triangles.tags.begin(), obj.triangles.tags.end(), obj.triangles.tags[0]), 2);
  EXPECT_TRUE(io::make_mesh(obj));
}

TEST_F(OtherFormats, OffOfPolygonsOrInBinaryIsNamed) {
  EXPECT_EQ(refused("m.off", "OFF\n5 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0.5 0\n5 0 1 2 3 4\n"),
            "m.off:8: face 0 has 5 corners; temper reads triangles and quadrilaterals");
  EXPECT_EQ(refused("m.off", "OFF BINARY\n"), "m.off:1: is an OFF file in binary; temper reads text");
  EXPECT_EQ(refused("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n"),
            "m.off:7: expected the end of the file after 1 faces, found '3'");
}

// --- PLY -------------------------------------------------------------------------------------------------------

template <class T>
std::string bytes_of(std::endian order, std::initializer_list<T> values) {
  std::string all;
  for (const T v : values) {
    std::string one(reinterpret_cast<const char*>(&v), sizeof v);
    if (order != std::endian::native) std::reverse(one.begin(), one.end());
    all += one;
  }
  return all;
}

TEST_F(OtherFormats, BinaryPlyOfBothByteOrdersIsRead) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string name = order == std::endian::little ? "little" : "big";
    std::string content = "ply\r\nformat binary_" + name +
                          "_endian 1.0\r\nobj_info by hand\r\nelement vertex 3\r\nproperty float x\r\nproperty float "
                          "y\r\nproperty float z\r\nproperty double weight\r\nproperty uchar red\r\nelement face 1\r\n"
                          "property list uchar uint vertex_index\r\nproperty short region\r\nproperty list uchar float "
                          "texcoord\r\nend_header\r\n";
    for (int i = 0; i < 3; ++i) {
      content += bytes_of<float>(order, {i == 1 ? 1.f : 0.f, i == 2 ? 1.f : 0.f, 0.5f});
      content += bytes_of<double>(order, {i / 3.0});
      content += static_cast<char>(i + 250);
    }
    content += '\3' + bytes_of<std::uint32_t>(order, {0, 1, 2}) + bytes_of<std::int16_t>(order, {-7}) + '\2' +
               bytes_of<float>(order, {1, 2});
    const MeshFile f = read_ok("m.ply", content);
    EXPECT_EQ(f.points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_EQ(f.z(), 0.5);
    EXPECT_TRUE(same_bits(f.weights, {0, 1 / 3.0, 2 / 3.0}));
    EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(f.triangles.tags, (Tags{-7}));
    ASSERT_EQ(f.point_data.size(), 1u);
    EXPECT_EQ(std::get<std::vector<std::uint8_t>>(f.point_data[0].values), (std::vector<std::uint8_t>{250, 251, 252}));
    ASSERT_EQ(f.warnings.size(), 1u);
    EXPECT_NE(f.warnings[0].find("'texcoord'"), std::string::npos);
  }
}

TEST_F(OtherFormats, PlyFacesOfTwoCornersAndOneAreLinesAndMarkedPoints) {
  const MeshFile f = read_ok(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nelement face 3\nproperty list "
      "uchar int vertex_indices\nproperty int region\nend_header\n0 0\n1 0\n0 1\n2 0 1 5\n3 0 1 2 6\n1 2 7\n");
  EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(f.lines.corners, (Lines{{0, 1}}));
  EXPECT_EQ(f.marked_points.corners, (Tags{2}));
  EXPECT_EQ(f.triangles.tags, (Tags{6}));
  EXPECT_EQ(f.lines.tags, (Tags{5}));
  EXPECT_EQ(f.marked_points.tags, (Tags{7}));
}

TEST_F(OtherFormats, PlyMayHaveCoordinatesInUpperCase) {
  const MeshFile f = read_ok("m.ply",
                             "ply\nformat ascii 1.0\nelement vertex 3\nproperty double X\nproperty double Y\nproperty "
                             "double Z\nelement face 1\n"
                             "property list uchar uint vertex_indices\nend_header\n0 0 7\n1 0 7\n0 1 7\n3 0 1 2\n");
  EXPECT_EQ(f.points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(f.z(), 7);
  EXPECT_TRUE(f.point_data.empty());
}

TEST_F(OtherFormats, PlyKeepsArraysOfSeveralComponentsAndNames) {
  const MeshFile f = rich_sample();
  for (const Encoding encoding : {Encoding::ascii, Encoding::appended}) {
    ASSERT_TRUE(write(path("m.ply"), f, {"ply", encoding}));
    const auto g = read(path("m.ply"));
    ASSERT_TRUE(g) << g.error().what();
    ASSERT_EQ(g->point_data.size(), 3u) << "all but the 64-bit integers";
    EXPECT_EQ(g->point_data[1].name, "velocity");
    EXPECT_TRUE(g->point_data[1].values == f.point_data[1].values);
    ASSERT_EQ(g->names.size(), 3u);
    EXPECT_EQ(g->names[1].name, "inflow and more");
  }
}

TEST_F(OtherFormats, BadPlyIsNamed) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0\n1 0\n0 1\n";
  EXPECT_EQ(refused("m.ply", head + faces + "5 0 1 2 0 1\n"),
            "m.ply:12: element 0 is a polygon with 5 corners; temper reads linear triangles and quadrilaterals, with "
            "lines and "
            "points as tags");
  EXPECT_EQ(refused("m.ply", head + "property quad w\n" + faces), "m.ply: expected a type of PLY, found 'quad'");
  EXPECT_EQ(refused("m.ply", "ply\nformat ascii 2.0\n"),
            "m.ply:2: is PLY in format 'ascii' '2.0'; temper reads ascii, binary_little_endian and binary_big_endian "
            "1.0");
  EXPECT_EQ(refused("m.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty int y\nend_header\n0\n"),
            "m.ply: vertices have no property x");
  EXPECT_EQ(refused("m.ply", head + "element face 1\nend_header\n0 0\n1 0\n0 1\n"),
            "m.ply: elements 'face' have no properties");
  EXPECT_EQ(refused("m.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000000\nproperty int x\nend_header\n0\n"),
            "m.ply:6: announces 4000000000000 elements 'vertex', but only 2 bytes follow");
  EXPECT_EQ(refused("m.ply", head + faces + "3 0 1 2\n3 0 2 1\n"),
            "m.ply:13: expected the end of the file after all elements of the header, found '3'");
}

// --- ADCIRC ----------------------------------------------------------------------------------------------------

// A square with a node inside, an open boundary below, and land with a weir and an inflow around the rest.
const std::string kFort14 =
    "OFF the coast\n4 5 ! NE NP\n10 0 0 1.5\n20 1 0 2.5 # deep\n30 1 1 -3\n40 0 1 4\n50 0.5 0.5 5\n"
    "1 3 10 20 50\n2 3 20 30 50\n3 3 30 40 50\n4 3 40 10 50\n"
    "1 = number of open boundaries\n2 = nodes\n2 = nodes of open boundary 1\n10\n20\n"
    "2\n5\n3 20 = land\n20\n30\n40\n2 23\n40 0.5 1\n10 0.25 0.75\n";

TEST_F(OtherFormats, Fort14GivesDepthsAndBoundariesByTheirNumbers) {
  const MeshFile f = read_ok("fort.14", kFort14);
  EXPECT_EQ(f.format, "adcirc");
  EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
  ASSERT_EQ(f.point_data.size(), 1u);
  EXPECT_EQ(f.point_data[0].name, "depth");
  EXPECT_EQ(std::get<std::vector<double>>(f.point_data[0].values), (std::vector<double>{1.5, 2.5, -3, 4, 5}));
  EXPECT_EQ(f.lines.corners, (Lines{{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
  EXPECT_EQ(f.lines.tags, (Tags{1, 2, 2, 3}));
  ASSERT_EQ(f.names.size(), 3u);
  EXPECT_EQ(f.names[0].name, "open boundary 1");
  EXPECT_EQ(f.names[1].name, "land boundary 1, type 20");
  EXPECT_EQ(f.names[2].name, "land boundary 2, type 23");
  EXPECT_EQ(f.marked_points.corners, (Tags{3, 0}));
}

TEST_F(OtherFormats, Fort14BoundariesGoThroughVtuAndComeBack) {
  const MeshFile f = read_ok("fort.14", kFort14);
  ASSERT_TRUE(write(path("m.vtu"), f));
  const auto g = read(path("m.vtu"));
  ASSERT_TRUE(g) << g.error().what();
  const auto warnings = write(path("n.14"), *g);
  ASSERT_TRUE(warnings) << warnings.error().what();
  EXPECT_TRUE(warnings->empty()) << (*warnings)[0];
  EXPECT_EQ(slurp(path("n.14")),
            "OFF the coast\n4 5\n1 0 0 1.5\n2 1 0 2.5\n3 1 1 -3\n4 0 1 4\n5 0.5 0.5 5\n1 3 1 2 5\n2 3 2 3 5\n"
            "3 3 3 4 5\n4 3 4 1 5\n1 = number of open boundaries\n2 = number of open boundary nodes\n"
            "2 0 = number of nodes and type of open boundary 1\n1\n2\n"
            "2 = number of land boundaries\n5 = number of land boundary nodes\n"
            "3 20 = number of nodes and type of land boundary 1\n2\n3\n4\n"
            "2 23 = number of nodes and type of land boundary 2\n4 0.5 1\n1 0.25 0.75\n");
}

TEST_F(OtherFormats, Fort14ClosesIslandsAndKeepsPairsOfLevees) {
  const std::string content =
      "two halves\n2 6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1.1 0 0\n5 1.1 1 0\n6 0.1 1 0\n1 3 1 2 3\n2 3 4 5 6\n"
      "0\n0\n2\n7\n3 1\n1\n2\n3\n2 24\n4 2 1 2 3\n6 3 4 5 6\n";
  const MeshFile f = read_ok("fort.14", content);
  EXPECT_EQ(f.lines.corners, (Lines{{0, 1}, {1, 2}, {2, 0}, {3, 5}}));
  EXPECT_EQ(f.marked_points.corners, (Tags{3, 1, 5, 2})) << "a node and its partner";
  const auto warnings = write(path("n.14"), f);
  ASSERT_TRUE(warnings);
  const std::string out = slurp(path("n.14"));
  EXPECT_NE(out.find("\n3 1 = number of nodes and type of land boundary 1\n1\n2\n3\n"), std::string::npos)
      << "ADCIRC closes islands itself: " << out;
  EXPECT_NE(out.find("\n2 24 = number of nodes and type of land boundary 2\n4 2 1 2 3\n6 3 4 5 6\n"), std::string::npos)
      << out;
}

//   7 ─ 8   9 ─ 10     A levee between the channels. The land above passes its end from 8 to 9, which is no edge.
//   │ ╱ │   │ ╱ │      The open boundary runs with the domain on its right. Land 2 has the node 2 in two rows, and
//   visits 4 ─ 5   6 ─ 11     the node 1 twice. │ ╱ │   │ ╱ │ 1 ─ 2   3 ─ 12
TEST_F(OtherFormats, Fort14StringsComeBackAsTheyWere) {
  const std::string nodes =
      "1 0 0 1\n2 1 0 1\n3 2 0 1\n4 0 1 1\n5 1 1 1\n6 2 1 1\n7 0 2 1\n8 1 2 1\n9 2 2 1\n10 3 2 1\n11 3 1 1\n12 3 0 1\n";
  const std::string mesh = "levee\n8 12\n" + nodes +
                           "1 3 1 2 5\n2 3 1 5 4\n3 3 4 5 8\n4 3 4 8 7\n5 3 3 12 11\n6 3 3 11 6\n7 3 6 11 10\n"
                           "8 3 6 10 9\n";
  const std::string open = "2 0 = number of nodes and type of open boundary 1\n12\n3\n";
  const std::string land =
      "4 20 = number of nodes and type of land boundary 1\n10\n9\n8\n7\n"
      "7 0 = number of nodes and type of land boundary 2\n4\n1\n2\n2\n5\n1\n4\n"
      "2 24 = number of nodes and type of land boundary 3\n2 3 1.5 1 1\n5 6 2.5 1 1\n"
      "3 1 = number of nodes and type of land boundary 4\n3\n12\n11\n";
  const std::string all = "1 = number of open boundaries\n2 = number of open boundary nodes\n" + open +
                          "4 = number of land boundaries\n18 = number of land boundary nodes\n" + land;
  const MeshFile f = read_ok("fort.14", mesh + all);
  ASSERT_TRUE(write(path("m.vtu"), f));
  const auto g = read(path("m.vtu"));
  ASSERT_TRUE(g) << g.error().what();
  for (const MeshFile* file : {&f, &*g}) {
    const auto warnings = write(path("n.14"), *file);
    ASSERT_TRUE(warnings) << warnings.error().what();
    EXPECT_EQ(slurp(path("n.14")), mesh + all);
  }
  ASSERT_TRUE(write(path("m.msh"), f));  // it has no place for levees
  const auto h = read(path("m.msh"));
  ASSERT_TRUE(h) << h.error().what();
  ASSERT_TRUE(write(path("n.14"), *h));
  EXPECT_NE(slurp(path("n.14")).find(open), std::string::npos);
  EXPECT_NE(slurp(path("n.14")).find("land boundary 2\n4\n1\n2\n2\n5\n1\n4\n"), std::string::npos);
  // Without the data that a fort.14 brings, the domain is on the left, and strings end where the boundary does.
  MeshFile drawn = f;
  drawn.lines.data.clear();
  ASSERT_TRUE(write(path("n.14"), drawn));
  EXPECT_NE(slurp(path("n.14")).find("type of open boundary 1\n3\n12\n"), std::string::npos);
}

TEST_F(OtherFormats, Fort14OfOrdinaryStringsNeedsNoDataOfItsLines) {
  EXPECT_TRUE(read_ok("fort.14", kFort14).lines.data.empty());
}

TEST_F(OtherFormats, Fort14OfSchismHasNoTypesOfLandBoundaries) {
  const std::string head = "square\n2 4\n1 0 0 9\n2 1 0 9\n3 1 1 9\n4 0 1 9\n1 3 1 2 3\n2 3 1 3 4\n0\n0\n2\n5\n";
  const std::string warning = "hgrid.gr3: 2 land boundaries have no type, which SCHISM reads none of: read as type 0";
  for (const std::string after : {"", " = Number of nodes", " !"}) {
    const MeshFile f = read_ok("hgrid.gr3", head + "3" + after + "\n1\n2\n3\n2" + after + "\n4\n1\n");
    EXPECT_EQ(f.lines.corners, (Lines{{0, 1}, {1, 2}, {3, 0}}));
    ASSERT_EQ(f.names.size(), 2u);
    EXPECT_EQ(f.names[0].name, "land boundary 1, type 0");
    ASSERT_EQ(f.warnings.size(), 1u);
    EXPECT_EQ(plain(f.warnings[0]), warning);
  }
}

TEST_F(OtherFormats, Fort14IsWhatTheSuffixGr3Means) {
  const MeshFile f = read_ok("fort.14", kFort14);
  ASSERT_TRUE(write(path("m.gr3"), f));
  ASSERT_TRUE(write(path("m.14"), f));
  EXPECT_EQ(slurp(path("m.gr3")), slurp(path("m.14")));
}

TEST_F(OtherFormats, Fort14IslandsAreNotClosedByWhatIsNoEdge) {
  const std::string square = "two\n2 4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n1 3 1 2 3\n2 3 1 3 4\n0\n0\n2\n7\n";
  const MeshFile f = read_ok("fort.14", square + "3 1\n4\n1\n2\n4 21\n1\n2\n3\n4\n");
  EXPECT_EQ(f.lines.corners, (Lines{{3, 0}, {0, 1}, {0, 1}, {1, 2}, {2, 3}, {3, 0}})) << "from 2 to 4 there is no edge";
  EXPECT_EQ(f.lines.tags, (Tags{1, 1, 2, 2, 2, 2}));
  const auto made = make_mesh(f);
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->warnings.empty());
}

//   2 ── 3,6 ── 4     The wall has no width. Its partners 5 and 6 are at the places of the nodes 1 and 3.
//     ╲   │   ╱
//      ╲  │  ╱        Between reading and writing they are to the right of them, in the triangle 3 5 4 6.
//        1,5
TEST_F(OtherFormats, Fort14WithVerticalElementWallsIsAMeshAndComesBackBitForBit) {
  const std::string nodes = "1 1 0 0.5\n2 0 1 0.5\n3 1 1 0.5\n4 2 1 0.5\n5 1 0 -1.5\n6 1 1 0.25\n";
  const std::string wall = "2 64 = number of nodes and type of land boundary 1\n1 5 1 0.5 0.25\n3 6 1 1 1\n";
  for (const char* const triangles : {"1 3 1 3 2\n2 3 5 4 6\n", "1 3 1 3 2\n2 3 6 4 5\n"}) {  // also clockwise
    const MeshFile f = read_ok("fort.14", "wall\n2 6\n" + nodes + triangles + "0\n0\n1\n4\n" + wall);
    for (const std::size_t partner : {std::size_t{4}, std::size_t{5}}) {
      EXPECT_EQ(f.points[partner].y, partner == 4 ? 0 : 1);
      EXPECT_NEAR(f.points[partner].x, 1 + 1e-6, 1e-9);
    }
    const auto made = make_mesh(f);
    ASSERT_TRUE(made) << made.error().what();
    ASSERT_TRUE(write(path("m.vtu"), f));
    const auto g = read(path("m.vtu"));
    ASSERT_TRUE(g) << g.error().what();
    for (const MeshFile& file : {f, *g}) {
      ASSERT_TRUE(write(path("n.14"), file));
      const std::string out = slurp(path("n.14"));
      EXPECT_NE(out.find("\n" + nodes), std::string::npos) << out;
      EXPECT_NE(out.find(wall), std::string::npos) << out;
    }
  }
}

TEST_F(OtherFormats, Fort14HasPairsOfNodesThatStayOpposite) {
  const std::string nodes = "1 0 0 1\n2 1 0 1\n3 2 0 1\n4 0 9 1\n5 0 20 1\n6 1 20 1\n7 2 20 1\n8 0 29 1\n";
  const std::string rest = "1 3 1 2 4\n2 3 2 3 4\n3 3 5 8 6\n4 3 6 8 7\n0\n0\n1\n6\n";
  const std::string pairs = "1 5 2 1 1\n2 6 2 1 1\n3 7 2 1 1\n";
  const auto made = make_mesh(read_ok("fort.14", "levee\n4 8\n" + nodes + rest + "3 24\n" + pairs));
  ASSERT_TRUE(made) << made.error().what();
  std::size_t fixed = 0;
  for (const VertexId v : made->mesh.vertices()) fixed += made->mesh.is_fixed(v) ? 1 : 0;
  EXPECT_EQ(fixed, 6u);
  EXPECT_EQ(
      refused("fort.14", "wall\n4 8\n" + nodes + rest + "3 64\n" + pairs),
      "fort.14:20: land boundary 1, type 64: node 1 and its partner 5 are 20 apart; expected one place, as walls of "
      "type 64 have no width. Next: type 24 is a levee");
}

TEST_F(OtherFormats, Fort14OfLinesWithoutAKindSaysWhatItMakesOfThem) {
  MeshFile f = tamed(sample());
  const auto warnings = write(path("m.14"), f);
  ASSERT_TRUE(warnings);
  std::string all;
  for (const std::string& w : *warnings) all += plain(w) + "\n";
  EXPECT_NE(all.find("m.14: lines with tag 4 are written as land boundaries of type 0"), std::string::npos) << all;
  EXPECT_NE(all.find("m.14: 1 lines that are not on the boundary"), std::string::npos) << all;
  const auto g = read(path("m.14"));
  ASSERT_TRUE(g) << g.error().what();
  EXPECT_EQ(g->lines.corners, (Lines{{0, 1}, {1, 2}})) << "with the domain on their left";
}

TEST_F(OtherFormats, BadFort14IsNamed) {
  const std::string head = "t\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n";
  EXPECT_EQ(refused("fort.14", head + "1 3 1 2 9\n"),
            "fort.14:6: triangle 1 uses vertex 9, but the file has 3 vertices, numbered from 1");
  EXPECT_EQ(refused("fort.14", head + "7 5 1 2 3 1 2\n"), "fort.14:6: element 7 has 5 corners; expected 3 or 4");
  EXPECT_EQ(refused("fort.14", head + "7 4 1 2 3 9\n"),
            "fort.14:6: quadrilateral 7 uses vertex 9, but the file has 3 vertices, numbered from 1");
  EXPECT_EQ(refused("fort.14", head + "1 3 1 2 3\n1\n2\n2 0\n1\n8\n"),
            "fort.14:11: open boundary 1 uses vertex 8, but the file has 3 vertices, numbered from 1");
  EXPECT_EQ(refused("fort.14", head + "1 3 1 2 3\n1\n2\n2 0\n1\n"),
            "fort.14:11: the file ends where the number of a node was expected");
}

// --- 2DM -------------------------------------------------------------------------------------------------------

TEST_F(OtherFormats, MeshesOfSmsHaveHeightsMaterialsAndNamedStrings) {
  const std::string content =
      "MESH2D\nMESHNAME \"bay\"\nNUM_MATERIALS_PER_ELEM 1\nE3T 5 10 20 30 2\nE3T 6 10 30 40 3\n"
      "ND 10 0 0 -5\nND 20 10 0 -6.5\nND 30 10 10 1\nND 40 0 10 0\nNS 20 30\nNS -40 7 \"sea side\"\nBEGPARAMDEF\n";
  const MeshFile f = read_ok("m.2dm", content);
  EXPECT_EQ(f.format, "2dm");
  EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(f.triangles.tags, (Tags{2, 3}));
  EXPECT_EQ(f.lines.corners, (Lines{{1, 2}, {2, 3}}));
  EXPECT_EQ(f.lines.tags, (Tags{7, 7}));
  ASSERT_EQ(f.names.size(), 1u);
  EXPECT_EQ(f.names[0].name, "sea side");
  ASSERT_EQ(f.warnings.size(), 2u);
  EXPECT_NE(f.warnings[0].find("cards are dropped: BEGPARAMDEF"), std::string::npos);
  EXPECT_NE(f.warnings[1].find("z is taken as heights, positive up. Next: --positive down if"), std::string::npos);
  ASSERT_TRUE(write(path("again.2dm"), f));
  EXPECT_EQ(slurp(path("again.2dm")),
            "MESH2D\nE3T 1 1 2 3 2\nE3T 2 1 3 4 3\nND 1 0 0 -5\nND 2 10 0 -6.5\nND 3 10 10 1\nND 4 0 10 0\n"
            "NS 2 3 -4 7 \"sea side\"\n");
  EXPECT_EQ(refused("m.2dm", "MESH2D\nE8Q 1 1 2 3 4 5 6 7 8 1\n"),
            "m.2dm:2: element 1 is a quadratic quadrilateral; temper reads linear triangles and quadrilaterals, with "
            "lines and "
            "points as tags. Next: write linear elements");
  EXPECT_EQ(refused("m.2dm", "MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 0\nND 2 1 0 0\n"),
            "m.2dm:2: triangle 1 uses vertex 3, but the file has 2 vertices and not this one");
}

// SMS has heights in 2DM, SCHISM has depths.
TEST_F(OtherFormats, TheUserSaysTheSignOfTheBed) {
  make("m.2dm", "MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 9.66\nND 2 900 0 2\nND 3 0 900 -1\n");
  const auto depths_in_gr3 = [&](const ReadOptions& options) {
    const auto f = read(path("m.2dm"), options);
    EXPECT_TRUE(f && write(path("m.gr3"), *f) && write(path("again.2dm"), *f));
    EXPECT_NE(slurp(path("again.2dm")).find("ND 1 0 0 9.66\n"), std::string::npos) << "the format gets its z back";
    return std::get<std::vector<double>>(read(path("m.gr3"))->point_data.at(0).values);
  };
  EXPECT_EQ(depths_in_gr3({}), (std::vector<double>{-9.66, -2, 1}));
  EXPECT_EQ(depths_in_gr3({.positive = Positive::up}), (std::vector<double>{-9.66, -2, 1}));
  EXPECT_EQ(depths_in_gr3({.positive = Positive::down}), (std::vector<double>{9.66, 2, -1}));
  for (const Positive sign : {Positive::up, Positive::down}) {
    const auto f = read(path("m.2dm"), {.positive = sign});
    EXPECT_TRUE(f->warnings.empty());
    const double factor = sign == Positive::up ? -1 : 1;
    EXPECT_EQ(depths_of(*f)->values, Values(std::vector<double>{9.66 * factor, 2 * factor, -1 * factor}));
  }
  EXPECT_FALSE(depths_of({}));
}

TEST_F(OtherFormats, ASignThatTheUserSaysMakesZTheBedAndOverrulesTheFormat) {
  make("m.off", "OFF\n3 1 0\n0 0 5\n900 0 7\n0 900 6\n3 0 1 2\n");
  const auto flat = read(path("m.off"), {.flat = true, .positive = Positive::down});
  ASSERT_TRUE(flat && write(path("m.gr3"), *flat) && write(path("again.off"), *flat));
  EXPECT_EQ(read(path("m.gr3"))->point_data.at(0).values, Values(std::vector<double>{5, 7, 6}));
  EXPECT_NE(slurp(path("again.off")).find("\n900 0 7\n"), std::string::npos);

  const auto heights = read(path("m.gr3"), {.positive = Positive::up});
  ASSERT_TRUE(heights && write(path("again.gr3"), *heights) && write(path("m.2dm"), *heights));
  EXPECT_EQ(slurp(path("again.gr3")), slurp(path("m.gr3"))) << "comes back as it was";
  EXPECT_NE(slurp(path("m.2dm")).find("ND 2 900 0 7\n"), std::string::npos);

  const auto none = read(make("plane.off", "OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n"), {.positive = Positive::up});
  ASSERT_TRUE(none);
  ASSERT_EQ(none->warnings.size(), 1u);
  EXPECT_NE(none->warnings[0].find("has no depths or heights of a bed, so positive up has no effect"),
            std::string::npos);
}

// --- z as data, planes that stand, and weights of zero ----------------------------------------------------------

TEST_F(OtherFormats, HeightsAreDataOfAFlatMeshAndComeBackAsZ) {
  const std::string content = "OFF\n4 2 0\n0 0 1.5\n1 0 2\n1 1 -3\n0 1 4\n3 0 1 2\n3 0 2 3\n";
  const MeshFile surface = read_ok("m.off", content);
  EXPECT_TRUE(surface.is_surface());
  ASSERT_EQ(surface.warnings.size(), 1u);
  EXPECT_EQ(
      plain(surface.warnings[0]),
      "m.off: z differs, so the mesh is a curved surface. Next: if z is a height or a depth, --flat takes the mesh "
      "as one of the plane (flat=True in Python)");
  const auto f = read(path("m.off"), {.flat = true});
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_EQ(f->point_data.size(), 1u);
  EXPECT_EQ(f->point_data[0].name, "z");
  EXPECT_EQ(f->point_data[0].values, Values(std::vector<double>{1.5, 2, -3, 4}));
  const auto loaded = make_mesh(*f);
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(loaded->mesh.space().is_plane());
  for (const Format& format : formats()) {
    if (!writes_planes(format)) continue;
    const std::string name = path(text_of_name(format));
    ASSERT_TRUE(write(name, *f, {std::string(format.name), {}})) << format.name;
    const bool is_whole = slurp(name).starts_with("$MeshFormat\n2 0 8\n");  // the version, for WAVEWATCH III
    EXPECT_TRUE(is_whole || format.name != "gmsh22");
    const auto back = read(name, {.flat = true});
    ASSERT_TRUE(back) << format.name << back.error().what();
    ASSERT_EQ(back->point_data.size(), 1u) << format.name;
    const bool has_depth = format.name == "adcirc";  // and no place for z
    EXPECT_TRUE(has_depth || back->point_data[0].values == f->point_data[0].values) << format.name;
    EXPECT_EQ(back->points, f->points) << format.name;
  }
}

TEST_F(OtherFormats, PlanesOfConstantXOrYStand) {
  for (const auto& [vertices, points] :
       {std::pair{"5 0 0\n5 1 0\n5 1 2\n5 0 2\n", std::vector<Vec2>{{0, 0}, {1, 0}, {1, 2}, {0, 2}}},
        std::pair{"0 7 0\n1 7 0\n1 7 2\n0 7 2\n", std::vector<Vec2>{{0, 0}, {1, 0}, {1, 2}, {0, 2}}}}) {
    const MeshFile f = read_ok("m.off", std::string("OFF\n4 2 0\n") + vertices + "3 0 1 2\n3 0 2 3\n");
    EXPECT_EQ(f.points, points);
    ASSERT_TRUE(make_mesh(f));
    ASSERT_TRUE(write(path("again.off"), f));
    EXPECT_NE(slurp(path("again.off")).find(vertices), std::string::npos) << slurp(path("again.off"));
    const auto warnings = write(path("m.14"), f);
    ASSERT_TRUE(warnings);
    EXPECT_EQ(warnings->size(), 1u) << "the plane is lost, and said";
  }
}

TEST_F(OtherFormats, WeightsOfZeroAreNoneInEveryFormat) {
  MeshFile f = sample();
  f.weights.clear();
  for (const Format& format : formats()) {
    if (!writes_planes(format)) continue;
    const std::string name = path(text_of_name(format));
    f.weights.clear();
    ASSERT_TRUE(write(name, f, {std::string(format.name), {}})) << format.name;
    const std::string without = slurp(name);
    f.weights.assign(f.points.size(), 0);
    ASSERT_TRUE(write(name, f, {std::string(format.name), {}})) << format.name;
    EXPECT_TRUE(slurp(name) == without) << format.name;
    EXPECT_TRUE(read(name)->weights.empty()) << format.name;
  }
}

TEST_F(OtherFormats, FesomFilesBesideTheMeshAreReadOrNamed) {
  make("nod2d.out", "4\n1 0 0 1\n2 1 0 1\n3 1 1 1\n4 0 1 1\n");
  make("elem2d.out", "2\n1 2 3\n1 3 4\n");
  make("cavity_depth@node.out", "-294.5\n 0\n-1e2\n-7\n");
  make("windstress@elem.out", "0.5 -0.25\n 1 2\n");
  make("depth@node.out", "1\n2\n3\n");
  make("edges.out", "1 2\n");
  make("cavity_nlvls.out", "1\n");
  const auto f = read(path("nod2d.out"));
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_EQ(f->point_data.size(), 2u);
  EXPECT_EQ(f->point_data[1].name, "cavity_depth@node");
  EXPECT_EQ(f->point_data[1].values, Values(std::vector<double>{-294.5, 0, -100, -7}));
  ASSERT_EQ(f->triangles.data.size(), 1u);
  EXPECT_EQ(f->triangles.data[0].name, "windstress@elem");
  EXPECT_EQ(f->triangles.data[0].components, 2);
  ASSERT_EQ(f->warnings.size(), 1u);
  EXPECT_EQ(plain(f->warnings[0]),
            "depth@node.out: has 3 numbers for 4 points, and is left out. Next: see whether it is of this mesh");

  const auto elsewhere = write(path("new.nod2d.out"), *f);
  ASSERT_TRUE(elsewhere) << elsewhere.error().what();
  EXPECT_EQ(slurp(path("new.cavity_depth@node.out")), "-294.5\n0\n-100\n-7\n");
  EXPECT_EQ(slurp(path("new.windstress@elem.out")), "0.5 -0.25\n1 2\n");
  const std::string next = " Next: let FESOM's fesom_ini.x make them, and the parts in dist_*, for this mesh";
  ASSERT_EQ(elsewhere->size(), 1u);
  EXPECT_EQ(
      plain(elsewhere->at(0)),
      "new.nod2d.out: edges.out, cavity_nlvls.out beside nod2d.out are the edges and levels of the mesh there." + next);

  MeshFile moved = *f;
  std::get<std::vector<double>>(moved.point_data[1].values)[1] = -3;
  moved.triangles.data.clear();
  const auto in_place = write(path("nod2d.out"), moved);
  ASSERT_TRUE(in_place) << in_place.error().what();
  EXPECT_EQ(slurp(path("cavity_depth@node.out")), "-294.5\n-3\n-100\n-7\n");
  ASSERT_EQ(in_place->size(), 2u);
  EXPECT_EQ(plain(in_place->at(0)),
            "nod2d.out: beside it stay depth@node.out, windstress@elem.out, which are not of this mesh: it has no such "
            "data. Next: remove them, or make them for the new points and triangles");
  EXPECT_EQ(plain(in_place->at(1)),
            "nod2d.out: beside it stay edges.out, cavity_nlvls.out, the edges and levels of the mesh before. Next: "
            "remove them, and let FESOM's fesom_ini.x make them, and the parts in dist_*, for this mesh");
}

TEST_F(OtherFormats, FesomKeepsDepthsWithoutLevels) {
  MeshFile f;
  f.points = {{0, 0}, {1, 0}, {0, 1}};
  f.points_in = DegreePoints{};
  f.triangles.corners = {{0, 1, 2}};
  f.point_data = {{"depth", 1, std::vector<double>{10, 20, 30}}};
  ASSERT_TRUE(project(f, "sphere"));
  const auto warnings = write(path("m.nod2d.out"), f);
  ASSERT_TRUE(warnings) << warnings.error().what();
  ASSERT_EQ(warnings->size(), 1u);
  EXPECT_NE((*warnings)[0].find("0 levels"), std::string::npos);
  const auto back = read(path("m.nod2d.out"));
  ASSERT_TRUE(back) << back.error().what();
  EXPECT_EQ(back->point_data.at(1).values, f.point_data[0].values);
}

}  // namespace
}  // namespace temper::io
