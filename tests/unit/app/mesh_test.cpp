// temper mesh: what it reads, refuses, writes and says.
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class MeshVerb : public Workshop {
 protected:
  /// An L with an interior line, whose segments carry markers.
  static void make_outline() {
    write("in.poly",
          "8 2 0 0\n1 0 0\n2 2 0\n3 2 1\n4 1 1\n5 1 2\n6 0 2\n7 0.5 0.5\n8 1.5 0.4\n"
          "7 1\n1 1 2 3\n2 2 3 3\n3 3 4 3\n4 4 5 3\n5 5 6 4\n6 6 1 4\n7 7 8 0\n0\n");
  }
  static void make_country() {
    write("in.json", R"({"type": "Polygon", "coordinates": [[[7, 50], [8, 50], [8.5, 51.5], [7, 51], [7, 50]]]})");
  }
};

TEST_F(MeshVerb, OneCommandMakesAWellCenteredMeshThatKeepsTheOutline) {
  make_outline();
  const Outcome outcome =
      temper_ok({"mesh", "in.poly", "-o", "out.vtu", "--size", "0.2", "--write", "r.json", "--write", "out.svg"});
  EXPECT_TRUE(contains(outcome.out, "triangles are well-centered"));
  temper_ok({"check", "out.vtu", "--require", "outside=0,not_crossed=0,nonregular=0"});
  const auto report = read_json("r.json");
  EXPECT_EQ(report["bad"], 0);
  EXPECT_EQ(report["outline"]["segments"], 7);
  EXPECT_EQ(report["mesh"]["orthocenters_outside"], 0);
  EXPECT_TRUE(contains(read("out.svg"), "<svg"));
  const auto file = io::read("out.vtu");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->points[2], (Vec2{2, 1}));
  ASSERT_GT(file->lines.size(), 0u);
  std::vector<std::int32_t> tags = file->lines.tags;
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  EXPECT_EQ(tags, (std::vector<std::int32_t>{3, 4, 5}));  // 5: the line inside had none
  // What is written is what is needed to go on: the line inside stays constrained.
  const auto loaded = io::make_mesh(*file);
  ASSERT_TRUE(loaded);
  std::size_t constrained = 0;
  for (const HalfedgeId h : loaded->mesh.halfedges()) constrained += loaded->mesh.is_constrained(h) ? 1 : 0;
  EXPECT_GT(constrained, 4u);
}

TEST_F(MeshVerb, ATargetWithoutWeightsMakesNone) {
  make_outline();
  for (const char* target : {"mpas", "fem", "any"}) {
    temper_ok({"mesh", "in.poly", "-o", "out.vtu", "--size", "0.2", "--for", target, "--write", "r.json"});
    const auto mesh = io::make_mesh(*io::read("out.vtu"))->mesh;
    std::size_t weights = 0;
    for (const VertexId v : mesh.vertices()) weights += mesh.weight(v) != 0 ? 1 : 0;
    EXPECT_EQ(weights > 0, target == std::string("any")) << target;
    EXPECT_LT(2 * read_json("r.json")["bad"].get<int>(), read_json("r.json")["delaunay_bad"].get<int>()) << target;
  }
  EXPECT_EQ(temper({"mesh", "in.poly", "-o", "o.vtu", "--size", "0.2", "--for", "mpas", "--no-optimize"}).exit, 2);
}

TEST_F(MeshVerb, ExitsWith4JustWhereTheTimeLimitEndsTheRun) {
  make_outline();
  int cut = 0;
  for (const std::string limit : {"0.02", "0.05", "0.1", "0.2", "0.5", "1000"}) {
    const Outcome outcome = temper(
        {"mesh", "in.poly", "-o", "out.vtu", "--size", "0.05", "--quiet", "--time-limit", limit, "--write", "r.json"});
    const bool has_mesh = exists("out.vtu");
    const bool early = !has_mesh || read_json("r.json")["stopped"] == "time_limit";
    EXPECT_EQ(outcome.exit, early ? 4 : 0) << limit;
    cut += has_mesh && early ? 1 : 0;
    std::filesystem::remove("out.vtu");
  }
  EXPECT_GT(cut, 0);
}

TEST_F(MeshVerb, WithoutOptimizationTheDelaunayMeshIsWritten) {
  make_outline();
  temper_ok({"mesh", "in.poly", "-o", "out.vtu", "--size", "0.2", "--no-optimize", "--write", "r.json"});
  EXPECT_EQ(read_json("r.json")["sweeps"], 0);
  temper_ok({"check", "out.vtu", "--require", "nonregular=0"});
}

TEST_F(MeshVerb, DegreesAreRefusedUnlessAProjectionIsChosen) {
  make_country();
  const Outcome refused = temper({"mesh", "in.json", "-o", "out.vtu", "--size", "10000"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_TRUE(contains(refused.err, "longitude and latitude"));
  write("meters.geojson",
        R"({"type": "Polygon", "coordinates": [[[6e5, 5e6], [6.1e5, 5e6], [6e5, 5.1e6], [6e5, 5e6]]]})");
  const Outcome meters = temper({"mesh", "meters.geojson", "-o", "out.vtu", "--size", "3000"});
  EXPECT_EQ(meters.exit, 2);
  EXPECT_TRUE(contains(meters.err, "meters.geojson: the point (600000, 5000000) is no longitude and latitude"));
  EXPECT_TRUE(contains(meters.err, "\"crs\""));
  EXPECT_TRUE(contains(refused.err, "--projection"));
  EXPECT_FALSE(exists("out.vtu"));
  temper_ok(
      {"mesh", "in.json", "-o", "out.vtu", "--size", "10000", "--projection", "stereographic", "--write", "r.json"});
  const auto report = read_json("r.json");
  EXPECT_EQ(report["bad"], 0);
  EXPECT_GT(report["projection"]["largest_scale"].get<double>(), 1);
  EXPECT_LT(report["projection"]["largest_scale"].get<double>(), 1.001);
  EXPECT_TRUE(contains(read("out.vtu"), "longitude"));
  temper_ok({"mesh", "in.json", "-o", "plain.vtu", "--size", "0.2", "--projection", "none"});
}

TEST_F(MeshVerb, WellsStayThroughOptimizeAndHaveTheirCells) {
  write("map.json", R"({"type": "FeatureCollection", "crs": "EPSG:25832", "features": [
{"type": "Feature", "properties": {}, "geometry":
 {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 6], [0, 6], [0, 0]]]}},
{"type": "Feature", "properties": {"name": "brook, upper"}, "geometry":
 {"type": "LineString", "coordinates": [[1, 1], [5, 3.5]]}},
{"type": "Feature", "properties": {"name": "wells"}, "geometry":
 {"type": "MultiPoint", "coordinates": [[2.1, 4.7], [6.3, 2.2], [7.1, 4.9]]}}]})");
  temper_ok({"mesh", "map.json", "-o", "raw.vtu", "--size", "0.6", "--no-optimize"});
  temper_ok({"optimize", "raw.vtu", "-o", "out.vtu", "--fix", "brook, upper"});
  const auto before = io::read("raw.vtu"), after = io::read("out.vtu");
  ASSERT_TRUE(before && after);
  EXPECT_NE(before->points, after->points);
  std::vector<Vec2> wells;
  for (const std::int32_t p : after->marked_points) wells.push_back(after->points[static_cast<std::size_t>(p)]);
  EXPECT_EQ(wells, (std::vector<Vec2>{{2.1, 4.7}, {6.3, 2.2}, {7.1, 4.9}}));
  for (const auto& line : before->lines) {
    for (const std::int32_t end : line) {
      const auto p = static_cast<std::size_t>(end);
      EXPECT_EQ(after->points[p], before->points[p]);
    }
  }
  write("l.csv", "vertex,top,bottom 1,bottom 2\n*,3,2,1\n");
  temper_ok({"operators", "out.vtu", "-o", "grid", "--layers", "l.csv", "--format", "disv,disu,tough"});
  const std::string n = std::to_string(after->points.size() + static_cast<std::size_t>(after->marked_points[0]) + 1);
  const std::string first = std::to_string(after->marked_points[0] + 1);
  EXPECT_TRUE(read("grid/mesh.disv.csv")
                  .starts_with("name,kind,layer,cell,length,x,y\nwells,point,1," + first + ",,2.1,4.7\nwells,point,2," +
                               first + ",,2.1,4.7\n"));
  EXPECT_TRUE(contains(read("grid/mesh.disu.csv"), "wells,point,2," + n + ",,2.1,4.7\n"));
  EXPECT_TRUE(contains(read("grid/mesh.disv.csv"), "\n\"brook, upper\",line,1,"));
  EXPECT_TRUE(contains(read("grid/MESH.csv"), "\nwells,point,1,A"));
}

TEST_F(MeshVerb, SizesComeFromDepthsWhoseSignIsKnown) {
  write("square.poly", "4 2 0 0\n1 0 0\n2 400 0\n3 400 400\n4 0 400\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  write("bed.asc", "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 400\n-10 -20\n-10 -20\n");
  const auto mesh = [&](const std::string& rule) {
    return temper({"mesh", "square.poly", "--size", "bed.asc", "--from-depth", rule, "-o", "out.vtu", "--quiet"});
  };
  const std::string rule = "time_step=5,least=10";
  const Outcome unknown = mesh(rule);
  EXPECT_TRUE(contains(unknown.err, "does not say whether its numbers are depths or heights")) << unknown.err;
  const Outcome land = mesh(rule + ",positive=down");
  EXPECT_EQ(land.exit, 1);
  EXPECT_TRUE(contains(land.err, "no point is under water. Next: positive=up in --from-depth reverses")) << land.err;
  EXPECT_FALSE(exists("out.vtu"));
  EXPECT_EQ(mesh(rule + ",positive=up").exit, 0);
}

TEST_F(MeshVerb, ASizeWithAUnitIsRefusedWithTheNumberAlone) {
  for (const char* size : {"0.5m", "0.5 km", "0.5degrees"}) {
    const Outcome outcome = temper({"mesh", "nothing.poly", "-o", "o.vtu", "--size", size});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err,
                         "numbers have no unit. Next: the number alone. Lengths are in the unit of the coordinates"))
        << outcome.err;
  }
  EXPECT_TRUE(contains(temper({"convert", "in.off", "-o", "o.off", "--merge", "1mm"}).err,
                       "'1mm' is not a number: numbers have no unit"));
  EXPECT_FALSE(contains(temper({"convert", "in.off", "-o", "o.off", "--merge", "mm"}).err, "unit"));
}

TEST_F(MeshVerb, BadUsageIsRefusedAndNothingWritten) {
  make_outline();
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"-o", "out.vtu"},
                                             {"--size", "1"},
                                             {"-o", "out.vtu", "--size", "0"},
                                             {"-o", "out.vtu", "--size", "1", "--grade", "-1"},
                                             {"-o", "out.vtu", "--size", "1", "--region-size", "1"},
                                             {"-o", "out.vtu", "--size", "1", "--region-size", "1.5,2"},
                                             {"-o", "out.vtu", "--size", "1", "--projection", "lambert"},
                                             {"-o", "out.vtu", "--size", "1e-7"},
                                             {"-o", "in.poly", "--size", "1"}}) {
    std::vector<std::string> arguments = {"mesh", "in.poly"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(temper(arguments).exit, 2) << more.back();
  }
  EXPECT_EQ(names(), std::vector<std::string>{"in.poly"});
}

TEST_F(MeshVerb, BadOutlinesAreNamedByFileLineAndNumber) {
  write("bad.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 3\n2 3 2\n3 2 4\n4 4 1\n0\n");
  const Outcome outcome = temper({"mesh", "bad.poly", "-o", "out.vtu", "--size", "1"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "bad.poly:9: segment 3"));
  EXPECT_FALSE(exists("out.vtu"));
}

class MeshSphere : public Workshop {
 protected:
  /// Two islands, one of them across the end of the map, and a river.
  static void make_world() {
    write("land.json",
          R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {}, "geometry":
 {"type": "Polygon", "coordinates": [[[0, 0], [40, 5], [35, 40], [5, 30], [0, 0]]]}},
{"type": "Feature", "properties": {}, "geometry":
 {"type": "LineString", "coordinates": [[170, -10], [-170, -12], [-175, -35], [170, -10]]}}]})");
    write("rivers.json", R"({"type": "LineString", "coordinates": [[170, 30], [178, 33], [-174, 30], [-165, 40]]})");
  }
  static Outcome mesh(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"mesh", "--sphere", "-o", "out.vtu", "--size", "600000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return temper(arguments);
  }
};

TEST_F(MeshSphere, OneCommandMakesAWellCenteredOceanWithCoastsAndRivers) {
  make_world();
  const Outcome outcome = mesh({"--coast", "land.json", "--lines", "rivers.json", "--write", "r.json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "triangles are well-centered"));
  EXPECT_TRUE(contains(outcome.out, "% of it meshed"));
  temper_ok({"check", "out.vtu", "--require", "outside=0,not_crossed=0,nonregular=0,inverted=0"});
  const auto report = read_json("r.json");
  EXPECT_EQ(report["bad"], 0);
  EXPECT_EQ(report["coast"]["parts"], 1);
  EXPECT_EQ(report["lines"]["segments"], 3);
  EXPECT_LT(report["sphere"]["covered"].get<double>(), 0.98);
  const auto file = io::read("out.vtu");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->space().radius(), 6371000);
  std::vector<std::int32_t> tags = file->lines.tags;
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  EXPECT_EQ(tags, (std::vector<std::int32_t>{1, 2}));  // coasts, rivers
}

TEST_F(MeshSphere, SizesComeFromAFile) {
  temper_ok({"example", "graded-sphere", "--vertices", "2000", "--ratio", "5", "--radius", "10", "-o", "field.vtu"});
  temper_ok({"mesh", "--sphere", "--size", "field.vtu", "-o", "out.vtu", "--write", "r.json"});
  EXPECT_EQ(read_json("r.json")["sphere"]["radius"], 10);
  EXPECT_EQ(read_json("r.json")["bad"], 0);
  const Outcome radius = temper({"mesh", "--sphere", "--size", "field.vtu", "-o", "x.vtu", "--radius", "9"});
  EXPECT_EQ(radius.exit, 1);
  EXPECT_TRUE(contains(radius.err, "field.vtu: the sizes are on a sphere of radius 10; expected one of 9"));
  const Outcome data = temper({"mesh", "--sphere", "--size", "field.vtu", "-o", "x.vtu", "--size-data", "h"});
  EXPECT_EQ(data.exit, 1);
  EXPECT_TRUE(contains(data.err, "no point data \"h\""));
  write("square.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  const Outcome plane = temper({"mesh", "square.poly", "--size", "field.vtu", "-o", "x.vtu"});
  EXPECT_EQ(plane.exit, 1);
  EXPECT_TRUE(contains(plane.err, "field.vtu: the sizes are on a sphere"));
  EXPECT_FALSE(exists("x.vtu"));
}

TEST_F(MeshSphere, AnOutlineIsABasin) {
  write("basin.json", R"({"type": "Polygon", "coordinates": [[[0, 40], [30, 38], [28, 60], [2, 62], [0, 40]]]})");
  temper_ok({"mesh", "basin.json", "--sphere", "--size", "200000", "-o", "out.vtu", "--write", "r.json"});
  EXPECT_EQ(read_json("r.json")["bad"], 0);
  EXPECT_NEAR(read_json("r.json")["sphere"]["covered"].get<double>(), 0.01, 0.005);
}

TEST_F(MeshSphere, BadFilesAreNamedWithTheirFeatureAndNothingIsWritten) {
  make_world();
  struct Case {
    const char* coast;
    std::vector<std::string> expected;
  };
  const std::vector<Case> cases = {
      {R"({"type": "Polygon", "coordinates": [[[0, 0], [40, 5], [35, 95], [0, 0]]]})",
       {"bad.json:1: point 2 (segment 1 of ring 0 of the geometry)", "latitude 95"}},
      {R"({"type": "Polygon", "coordinates": [[[0, 0], [20, 20], [20, 0], [0, 20], [0, 0]]]})",
       {"bad.json:1: segment 2 of ring 0", "crosses segment 0 of ring 0"}},
      {R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry":
{"type": "LineString", "coordinates": [[0, 0], [20, 20], [20, 0]]}}]})",
       {"bad.json:2: segment 0 of feature 0 ends at (0, 0)", "closed"}},
      {R"({"type": "Polygon", "coordinates": [[[-120, 0], [-100, 0], [200, 20], [-120, 0]]]})",
       {"bad.json:1: segment 1", "from longitude -100 to 200", "one convention"}},
      {R"({"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [180, 0], [-90, 0], [0, 0]]]})",
       {"bad.json:1: the geometry divides the sphere into halves"}},
      {R"({"type": "Polygon", "coordinates": [[[165, -25], [-160, -25], [-178, 0], [165, -25]]]})", {}},
  };
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.coast);
    write("bad.json", bad.coast);
    const Outcome outcome = mesh({"--coast", "bad.json"});
    EXPECT_EQ(outcome.exit, bad.expected.empty() ? 0 : 1) << outcome.err;
    for (const std::string& part : bad.expected) EXPECT_TRUE(contains(outcome.err, part)) << outcome.err;
    if (!bad.expected.empty()) {
      EXPECT_FALSE(exists("out.vtu"));
    }
  }
  // A coast and a line of two files, both named.
  const Outcome crossing =
      temper({"mesh", "--sphere", "-o", "x.vtu", "--size", "600000", "--coast", "land.json", "--lines", "bad.json"});
  EXPECT_EQ(crossing.exit, 1);
  EXPECT_TRUE(contains(crossing.err, "bad.json:1: segment")) << crossing.err;
  EXPECT_TRUE(contains(crossing.err, "segment 0 of feature 1 (point 4 to point 5, land.json:5)")) << crossing.err;
  EXPECT_FALSE(exists("x.vtu"));
}

TEST_F(MeshVerb, ASizeThatNeedsMoreMemoryThanThereIsIsRefusedWithOneThatFits) {
  make_outline();
  for (const char* size : {"1e-9", "1e-300"}) {
    const Outcome tiny = temper({"mesh", "in.poly", "-o", "x.vtu", "--size", size});
    EXPECT_EQ(tiny.exit, 2);
    EXPECT_TRUE(contains(tiny.err, "would make about")) << tiny.err;
    EXPECT_TRUE(contains(tiny.err, "Next: a size of ")) << tiny.err;
  }
  const Outcome example = temper({"example", "horseshoe", "--a", "1000000", "--b", "1000000", "-o", "x.vtu"});
  EXPECT_EQ(example.exit, 2);
  EXPECT_TRUE(contains(example.err, "about 1e+12 vertices need about 300 TB of memory")) << example.err;
  EXPECT_FALSE(exists("x.vtu"));
}

TEST_F(MeshVerb, WithoutASizeOneIsNamed) {
  write("square.poly", "4 2 0 0\n1 0 0\n2 1000 0\n3 1000 500\n4 0 500\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  const Outcome none = temper({"mesh", "square.poly", "-o", "x.vtu"});
  EXPECT_EQ(none.exit, 2);
  EXPECT_TRUE(contains(none.err, "The outline is 1000 by 500. Next: --size 17, which makes about 4000 triangles"))
      << none.err;
  make_country();
  const Outcome degrees = temper({"mesh", "in.json", "-o", "x.vtu"});
  EXPECT_EQ(degrees.exit, 2);
  EXPECT_TRUE(contains(degrees.err, "The outline is 1.5° by 1.5°, or ")) << degrees.err;
  EXPECT_TRUE(contains(degrees.err, " --projection stereographic, which makes about ")) << degrees.err;
  EXPECT_TRUE(contains(temper({"mesh", "--sphere", "-o", "x.vtu"}).err, "Next: --size 540000, which makes about"));
}

TEST_F(MeshSphere, BadUsageAndSizesAreRefused) {
  make_world();
  temper_ok({"example", "random-sphere", "--vertices", "50", "-o", "plain.vtu"});
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"mesh", "--size", "1", "-o", "x.vtu"},
           {"mesh", "land.json", "--coast", "land.json", "--size", "1", "-o", "x.vtu"},
           {"mesh", "land.json", "--radius", "1", "--size", "1", "-o", "x.vtu"},
           {"mesh", "--sphere", "--size", "-5", "-o", "x.vtu"},
           {"mesh", "--sphere", "--size", "0", "-o", "x.vtu"},
           {"mesh", "--sphere", "-o", "x.vtu"},
           {"mesh", "--sphere", "--size", "1e6", "--projection", "mercator", "-o", "x.vtu"},
           {"mesh", "--sphere", "--size", "1e6", "--enclosed", "all", "-o", "x.vtu"}}) {
    EXPECT_EQ(temper(arguments).exit, 2) << arguments[1];
  }
  const Outcome many = temper({"mesh", "--sphere", "--size", "10", "-o", "x.vtu"});
  EXPECT_EQ(many.exit, 2);
  EXPECT_TRUE(contains(many.err, "would make about")) << many.err;
  EXPECT_EQ(temper({"mesh", "--sphere", "--size", "plain.vtu", "-o", "x.vtu"}).exit, 1);
  EXPECT_EQ(temper({"mesh", "--sphere", "--size", "none.vtu", "-o", "x.vtu"}).exit, 1);
  write("negative.vtk",
        "# vtk DataFile Version 3.0\nsizes\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
        "1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\nCELLS 4 16\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n"
        "CELL_TYPES 4\n5\n5\n5\n5\nPOINT_DATA 4\nSCALARS size double 1\nLOOKUP_TABLE default\n1\n1\n-1\n1\n");
  const Outcome negative = temper({"mesh", "--sphere", "--size", "negative.vtk", "-o", "x.vtu"});
  EXPECT_EQ(negative.exit, 1);
  EXPECT_TRUE(contains(negative.err, "negative.vtk:8: point 2 has size -1; expected a finite, positive length"))
      << negative.err;
  EXPECT_FALSE(exists("x.vtu"));
}

}  // namespace
}  // namespace temper::test
