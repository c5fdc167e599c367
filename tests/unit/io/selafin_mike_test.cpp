// Meshes of TELEMAC (Selafin with its boundary file) and of MIKE 21, byte for byte as these programs have them.
#include <algorithm>
#include <bit>

#include "support.hpp"

namespace temper::io {
namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;
using Lines = std::vector<std::array<std::int32_t, 2>>;
using Tags = std::vector<std::int32_t>;

/// Selafin of a unit square in two triangles.
struct Square {
  std::endian order = std::endian::big;
  bool is_double = false;
  std::vector<std::string> names = {"BOTTOM          M               "};
  std::vector<double> times = {0};
  std::array<std::int32_t, 10> parameters = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  std::vector<std::int32_t> counts = {2, 4, 3, 1};
  std::vector<std::int32_t> corners = {1, 2, 3, 1, 3, 4};
  std::vector<double> x = {0, 1, 1, 0}, y = {0, 0, 1, 1};
  /// Values of a variable at a point and a time.
  static double value(std::size_t variable, std::size_t point, double time) {
    return 10.0 * static_cast<double>(variable) + static_cast<double>(point) + (variable == 0 ? 0 : time);
  }

  template <class T>
  std::string number(T value) const {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }
  std::string record(const std::string& body) const {
    const std::string length = number(static_cast<std::int32_t>(body.size()));
    return length + body + length;
  }
  template <class T>
  std::string integers(const T& all) const {
    std::string body;
    for (const std::int32_t i : all) body += number(i);
    return record(body);
  }
  std::string reals(const std::vector<double>& all) const {
    std::string body;
    for (const double r : all) body += is_double ? number(r) : number(static_cast<float>(r));
    return record(body);
  }
  std::string header() const {
    std::string file = record("A title" + std::string(65, ' ') + (is_double ? "SERAFIND" : "SERAFIN "));
    file += integers(std::vector<std::int32_t>{static_cast<std::int32_t>(names.size()), 0});
    for (const std::string& name : names) file += record(name);
    file += integers(parameters);
    if (parameters[9] == 1) file += integers(std::vector<std::int32_t>{2011, 6, 2, 12, 0, 0});
    return file + integers(counts) + integers(corners) + integers(std::vector<std::int32_t>{1, 2, 3, 4});
  }
  std::string bytes() const {
    std::string file = header() + reals(x) + reals(y);
    for (const double time : times) {
      file += reals({time});
      for (std::size_t v = 0; v < names.size(); ++v) {
        std::vector<double> values;
        for (std::size_t p = 0; p < x.size(); ++p) values.push_back(value(v, p, time));
        file += reals(values);
      }
    }
    return file;
  }
};

class WaterFormats : public FileTest {
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
  std::vector<std::string> written(const std::string& name, const MeshFile& f, const std::string& format = {}) const {
    const auto warnings = write(path(name), f, {format, {}});
    EXPECT_TRUE(warnings) << warnings.error().what();
    std::vector<std::string> all = warnings ? *warnings : std::vector<std::string>{};
    for (std::string& warning : all) warning = plain(warning);
    return all;
  }
};

// --- Selafin ---------------------------------------------------------------------------------------------------

TEST_F(WaterFormats, SelafinOfBothByteOrdersAndPrecisionsComesBackInBigEndian) {
  for (const bool is_double : {false, true}) {
    for (const std::endian order : {std::endian::big, std::endian::little}) {
      Square square;
      square.is_double = is_double;
      square.order = order;
      square.names.push_back("VELOCITY U      M/S             ");
      square.times = {0, 3600};
      square.parameters = {1, 0, 5, -7, 0, 0, 0, 0, 0, 1};
      const MeshFile f = read_ok("a.slf", square.bytes());
      EXPECT_EQ(f.format, "selafin");
      EXPECT_EQ(f.points, (std::vector<Vec2>{{5, -7}, {6, -7}, {6, -6}, {5, -6}}));
      EXPECT_EQ(f.triangles.corners, (Triangles{{0, 1, 2}, {0, 2, 3}}));
      EXPECT_TRUE(f.z_is_data);
      EXPECT_EQ(f.positive, Positive::up);
      ASSERT_EQ(f.point_data.size(), 2u);
      EXPECT_EQ(f.point_data[0].name, "z");
      EXPECT_EQ(f.point_data[0].components, 1);
      EXPECT_EQ(f.point_data[1].name, "VELOCITY U [M/S]");
      EXPECT_EQ(f.point_data[1].components, 2) << "one for each time step";
      EXPECT_EQ(std::holds_alternative<std::vector<double>>(f.point_data[1].values), is_double);
      EXPECT_TRUE(written("b.slf", f).empty());
      square.order = std::endian::big;
      EXPECT_TRUE(slurp(path("b.slf")) == square.bytes());
      EXPECT_EQ(slurp(path("b.cli")),
                "2 2 2 0 0 0 0 2 0 0 0 1 1\n2 2 2 0 0 0 0 2 0 0 0 2 2\n2 2 2 0 0 0 0 2 0 0 0 3 3\n"
                "2 2 2 0 0 0 0 2 0 0 0 4 4\n");
    }
  }
}

TEST_F(WaterFormats, NumbersThatNeedDoublePrecisionAreWrittenAsSerafindWithAWarning) {
  MeshFile f = read_ok("a.slf", Square{}.bytes());
  f.points[2].x = 1.1;
  EXPECT_EQ(written("b.slf", f),
            std::vector<std::string>{"b.slf: numbers need double precision (SERAFIND). Next: GEOMETRY FILE FORMAT = "
                                     "'SERAFIND' in TELEMAC's steering file"});
  const auto g = read(path("b.slf"));
  ASSERT_TRUE(g) << g.error().what();
  EXPECT_EQ(g->points, f.points);
  EXPECT_TRUE(slurp(path("b.slf")).find("SERAFIND") != std::string::npos);
}

TEST_F(WaterFormats, ABedThatMovesIsDataAndItsNameComesBack) {
  Square square;
  square.names = {"WATER DEPTH     M               ", "FOND            M               "};
  square.times = {0, 1};
  const MeshFile moving = read_ok("a.slf", square.bytes());  // the second variable depends on time
  EXPECT_FALSE(moving.z_is_data);
  ASSERT_EQ(moving.warnings.size(), 1u);
  EXPECT_EQ(plain(moving.warnings[0]),
            "a.slf: the bed 'FOND [M]' is not the same finite number in all time steps: it is kept as data alone");
  EXPECT_TRUE(written("b.slf", moving).empty());
  EXPECT_TRUE(slurp(path("b.slf")) == square.bytes());
  square.names = {"FOND            M               "};
  const MeshFile fixed = read_ok("a.slf", square.bytes());
  EXPECT_TRUE(fixed.z_is_data);
  EXPECT_TRUE(written("b.slf", fixed).empty());
  EXPECT_TRUE(slurp(path("b.slf")) == square.bytes());
}

TEST_F(WaterFormats, TheBedOfSelafinBecomesADepthOfAdcirc) {
  const MeshFile f = read_ok("a.slf", Square{}.bytes());
  written("m.14", f);
  const auto g = read(path("m.14"));
  ASSERT_TRUE(g) << g.error().what();
  EXPECT_EQ(g->point_data.at(0).name, "depth");
  EXPECT_EQ(g->point_data.at(0).values, Values(std::vector<double>{0, -1, -2, -3}));
}

TEST_F(WaterFormats, TheBoundaryFileGivesLinesMarksAndTheirNumbers) {
  const std::string rows[] = {"5 4 4 0 0 0 0 2 0 0 0 1 1\n", "5 4 4 1.5 0 0 0 4 0 0 0 2 2\n",
                              "2 2 2 0 0 0 0 2 0 0 0 3 3\n", "4 5 5 0 0 0 0 2 0 0 0 4 4\n"};
  const std::string boundary = rows[0] + rows[1] + rows[2] + rows[3];
  make("a.cli", "  5 4 4  0.000 0 0 0.0  2 0 0 0  1  1  # Open\n" + rows[1] + rows[2] + "\n" + rows[3]);
  const MeshFile f = read_ok("a.slf", Square{}.bytes());
  EXPECT_EQ(f.lines.corners, (Lines{{0, 1}}));
  EXPECT_EQ(f.lines.tags, Tags{544});
  ASSERT_EQ(f.names.size(), 1u);
  EXPECT_EQ(f.names[0].name, "open boundary, code 544");
  EXPECT_EQ(f.marked_points.corners, (Tags{3, 1})) << "one is no line, and one has numbers of its own";
  EXPECT_EQ(f.marked_points.tags, (Tags{455, 544}));
  ASSERT_EQ(f.marked_points.data.size(), 1u);
  EXPECT_TRUE(written("b.slf", f).empty());
  EXPECT_EQ(slurp(path("b.cli")), boundary);
  EXPECT_EQ(files_to_read(path("a.slf")), (std::vector{path("a.slf"), path("a.cli")}));
}

TEST_F(WaterFormats, ABoundaryFileThatDoesNotFitIsNamed) {
  const auto refused_with = [&](const std::string& boundary) {
    make("a.cli", boundary);
    return refused("a.slf", Square{}.bytes());
  };
  EXPECT_EQ(
      refused_with("2 2 2 0 0 0 0 2 0 0 0 1 1\n2 2 2 0 0 0 0 2 0 0 0 9 2\n"),
      "a.cli:2: is of node 9, but the mesh has 4 nodes. Next: remove or rename this file if it belongs to another "
      "mesh");
  EXPECT_EQ(refused_with("2 2 2 0 0 0 0 2 0 0 0 1 1\n2 2 2 0 0 0 0 2 0 0 0 1 2\n"),
            "a.cli:2: is of node 1, which an earlier line has, too");
  EXPECT_EQ(refused_with("2 22 2 0 0 0 0 2 0 0 0 1 1\n"), "a.cli:1: expected a code of one digit as LIUBOR, found 22");
  EXPECT_EQ(refused_with("2 2 2 0 0 x\n"), "a.cli:1: expected a number of a boundary node, found 'x'");
}

TEST_F(WaterFormats, TagsThatAreNoCodesOfTelemacAreNamed) {
  MeshFile f = sample();
  f.points_in = PlanePoints{0};
  f.weights.clear();
  f.triangles.tags.clear();
  f.lines.tags = {1044, 1044, 9};
  const std::vector<std::string> warnings = written("m.slf", f);
  const auto said = [&](const std::string& warning) {
    return std::find(warnings.begin(), warnings.end(), warning) != warnings.end();
  };
  EXPECT_TRUE(
      said("m.slf: tag 1044 is no code of TELEMAC: its nodes are walls, 222. Expected three digits, such as 455"));
  EXPECT_TRUE(
      said("m.slf: 1 lines that are not on the boundary are not written: Selafin of TELEMAC has no place for them"));
}

TEST_F(WaterFormats, DataWithoutOneComponentForEachTimeStepAreNamed) {
  MeshFile f = read_ok("a.slf", Square{}.bytes());
  f.point_data.push_back({"vector", 2, std::vector<double>(8)});
  f.point_data.push_back({"a name that is too long for Selafin", 1, std::vector<double>(4)});
  const std::vector<std::string> warnings = written("b.slf", f);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0],
            "b.slf: the name 'a name that is too long for Selafin' is written as 'a name that is too long for Sela': "
            "there is room for 16 characters, and 16 of a unit");
  EXPECT_EQ(warnings[1],
            "b.slf: point data without 1 component is not written, Selafin of TELEMAC has no place for it: vector");
}

TEST_F(WaterFormats, SelafinThatIsNoMeshOfTrianglesOrIsCutIsNamed) {
  Square planes;
  planes.parameters[6] = 5;
  EXPECT_EQ(refused("a.slf", planes.bytes()),
            "a.slf: is a mesh of prisms between 5 planes; expected triangles. Next: take one plane of it, as "
            "slf_3d_to_2d of PyTelTools does");
  Square quadrilaterals;
  quadrilaterals.counts[2] = 4;
  EXPECT_EQ(refused("a.slf", quadrilaterals.bytes()), "a.slf: has elements of 4 points; expected triangles");
  Square wrong;
  wrong.counts[0] = 3;
  EXPECT_EQ(refused("a.slf", wrong.bytes()),
            "a.slf: the corners of triangles are a record of 24 bytes at byte 216; expected 36");
  Square negative;
  negative.corners[4] = 7;
  EXPECT_EQ(refused("a.slf", negative.bytes()),
            "a.slf: triangle 2 uses vertex 7, but the file has 4 vertices, numbered from 1");
  Square half;
  half.x.pop_back();
  EXPECT_EQ(refused("a.slf", half.bytes()),
            "a.slf: the x coordinates of 4 points are a record of 12 bytes; expected 4 or 8 bytes for each");
  Square whole;
  whole.times = {0, 1};
  const std::string bytes = whole.bytes();
  EXPECT_EQ(refused("a.slf", bytes.substr(0, 290)), "a.slf: the file ends within the x coordinates of points");
  const MeshFile f = read_ok("a.slf", bytes.substr(0, bytes.size() - 4));
  ASSERT_EQ(f.warnings.size(), 1u);
  EXPECT_EQ(plain(f.warnings[0]), "a.slf: ends within time step 2, which is left out");
  EXPECT_TRUE(f.z_is_data);
}

// --- MIKE 21 ---------------------------------------------------------------------------------------------------

// A quadrilateral, a triangle, an open boundary of two edges, and a node of its own code.
const std::string kMike =
    "100079 1000 5 UTM-33\n1 0 0 -1.5 2\n2 1 0 -2 2\n3 1 1 0.25 1\n4 0 1 -3 3\n5 2 0.5 -4 2\n2 4 25\n1 2 5 3 0\n"
    "2 1 2 3 4\n";

TEST_F(WaterFormats, MikeComesBackByteForByte) {
  const MeshFile f = read_ok("a.mesh", kMike);
  EXPECT_EQ(f.format, "mike");
  EXPECT_EQ(f.triangles.size(), 3u) << "a quadrilateral is two";
  EXPECT_EQ(f.lines.corners, (Lines{{0, 1}, {1, 4}}));
  EXPECT_EQ(f.lines.tags, (Tags{2, 2}));
  EXPECT_EQ(f.marked_points.corners, Tags{3});
  EXPECT_EQ(f.marked_points.tags, Tags{3});
  EXPECT_EQ(f.names.at(0).name, "open boundary, code 2");
  EXPECT_EQ(f.positive, Positive::up);
  EXPECT_TRUE(f.warnings.empty());
  EXPECT_TRUE(written("b.mike.mesh", f).empty());
  EXPECT_EQ(slurp(path("b.mike.mesh")), kMike);
  const std::string old = "3 NON-UTM\n1 0 0 -1.5 0\n2 1 0 -2 1\n3 1 1 0.25 1\n1 3 21\n1 1 2 3\n";
  EXPECT_TRUE(written("b.mike.mesh", read_ok("a.mesh", old)).empty());
  EXPECT_EQ(slurp(path("b.mike.mesh")), "3 NON-UTM\n1 0 0 -1.5 1\n2 1 0 -2 1\n3 1 1 0.25 1\n1 3 21\n1 1 2 3\n");
}

TEST_F(WaterFormats, MikeInDegreesIsNoPlane) {
  std::string degrees = kMike;
  degrees.replace(degrees.find("UTM-33"), 6, "LONG/LAT");
  const MeshFile f = read_ok("a.mesh", degrees);
  ASSERT_NE(f.degrees(), nullptr);
  EXPECT_FALSE(f.degrees()->is_guessed);
  EXPECT_TRUE(written("b.mesh", f, "mike").empty());
  EXPECT_EQ(slurp(path("b.mesh")), degrees);
}

TEST_F(WaterFormats, AnOpenBoundaryOfMikeIsOneOfAdcirc) {
  written("m.14", read_ok("a.mesh", kMike));
  EXPECT_NE(slurp(path("m.14")).find("1 = number of open boundaries\n3 = number of open boundary nodes"),
            std::string::npos)
      << slurp(path("m.14"));
}

TEST_F(WaterFormats, MikeThatIsWrongIsNamedWithItsLine) {
  const std::string nodes = "3 NON-UTM\n1 0 0 -1 1\n2 1 0 -2 1\n3 1 1 0.25 1\n";
  EXPECT_EQ(refused("a.mesh", nodes + "1 3 21\n1 1 2 9\n"),
            "a.mesh:6: element 1 uses node 9, but the file has 3 nodes and not this one");
  EXPECT_EQ(refused("a.mesh", nodes + "1 6 32\n1 1 2 3 1 2 3\n"),
            "a.mesh:5: has elements of type 32 with 6 nodes; expected type 21 of triangles, or 25 of triangles and "
            "quadrilaterals");
  EXPECT_EQ(refused("a.mesh", nodes + "1 3 21\n1 1 2 3 1 2\n"), "a.mesh:6: element 1 has more than four nodes");
  EXPECT_EQ(refused("a.mesh", nodes + "1 3 21\n1 1 2 3\n2 1 2 3\n"),
            "a.mesh:7: expected the end of the file after 1 elements, found '2'");
  EXPECT_EQ(refused("a.mesh", "3 NON-UTM\n1 0 0 -1 1\n1 1 0 -2 1\n3 1 1 0.25 1\n1 3 21\n1 1 2 3\n"),
            "a.mesh: has node 1 twice");
  EXPECT_EQ(refused("a.mesh", "3 NON-UTM\n1 0 0 -1 1\n2 1 0 nan 1\n3 1 1 0.25 1\n"),
            "a.mesh:3: node 2 has z = nan, expected a finite number");
  EXPECT_EQ(refused("a.mesh", "3 NON-UTM\n1 0 0 -1 1\n2 1 0 1 1 7\n"),
            "a.mesh:3: expected a node of five numbers: number, x, y, z and code");
  EXPECT_EQ(refused("a.mesh", nodes + "4 3 21\n1 1 2 3\n"), "a.mesh:5: announces 4 elements, but only 14 bytes follow");
}

}  // namespace
}  // namespace temper::io
