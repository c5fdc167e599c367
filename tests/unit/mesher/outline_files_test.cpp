// Outline files: what each format says, what is wrong with bad ones, and the public outlines from file to mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "outlines.hpp"
#include "temper/detail/projection.hpp"
#include "temper/io.hpp"
#include "temper/mesher.hpp"

namespace temper::test {
namespace {

class OutlineFiles : public ::testing::Test {
 protected:
  OutlineFiles() {
    folder_ = std::filesystem::temp_directory_path() /
              ("temper_outline_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
               std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder_);
  }
  ~OutlineFiles() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).generic_string();
  }
  io::OutlineFile read(const std::string& text) {
    auto file = io::read_outline(write("in", text));
    EXPECT_TRUE(file.has_value()) << file.error().what();
    return file ? *std::move(file) : io::OutlineFile();
  }
  /// Reading or meshing fails with this in the message.
  void expect_error(const std::string& text, const std::string& part) {
    const std::string path = write("bad", text);
    const auto file = io::read_outline(path);
    std::string what = file ? "" : file.error().what();
    if (file) {
      MesherOptions options;
      options.size = 10;
      options.optimize.reset();
      const auto made = mesh_outline(file->outline, options);
      what = made ? "no error" : made.error().what();
    }
    EXPECT_NE(what.find(part), std::string::npos) << text << "\nexpected: " << part << "\nfound: " << what;
    if (file && file->outline.points.empty()) ADD_FAILURE() << "an outline without points was read";
  }

  std::filesystem::path folder_;
};

constexpr const char* kSquarePoly =
    "# a square\n4 2 1 1\n1 0 0 9.5 3\n2 1 0 9.5 3\n3 1 1 9.5 3\n4 0 1 9.5 3 # the last\n"
    "4 1\n1 1 2 5\n2 2 3 6\n3 3 4 7\n4 4 1 8\n0\n1\n1 0.5 0.5 12 0.01\n";

TEST_F(OutlineFiles, SayWhatTheirLinesBecome) {
  const std::string line = R"("geometry": {"type": "LineString", "coordinates": [[1, 1], [3, 2]]}})";
  const std::string head = R"({"type": "Feature", "properties": {"name": "fault", "as": )";
  const io::OutlineFile faces = read(head + "\"faces\"}, " + line), edges = read(head + "\"edges\"}, " + line);
  ASSERT_EQ(faces.outline.segments.size(), 1U);
  ASSERT_EQ(edges.outline.segments.size(), 1U);
  EXPECT_EQ(faces.outline.segments[0].as, LineKind::faces);
  EXPECT_EQ(edges.outline.segments[0].as, LineKind::edges);
  expect_error(head + "\"walls\"}, " + line, "expected \"edges\" or \"faces\"");
}

TEST_F(OutlineFiles, PolyHasPointsSegmentsHolesAndRegions) {
  const io::OutlineFile file = read(kSquarePoly);
  EXPECT_EQ(file.format, "poly");
  EXPECT_FALSE(file.geographic);
  ASSERT_EQ(file.outline.points.size(), 4u);
  EXPECT_EQ(file.outline.points[2], (Vec2{1, 1}));
  ASSERT_EQ(file.outline.segments.size(), 4u);
  EXPECT_EQ(file.outline.segments[3].ends, (std::array{3, 0}));
  EXPECT_EQ(file.outline.segments[3].tag, 8);
  ASSERT_EQ(file.outline.regions.size(), 1u);
  EXPECT_EQ(file.outline.regions[0].region, 12);
  EXPECT_NEAR(file.outline.regions[0].size.value_or(0), std::sqrt(0.04 / std::sqrt(3.0)), 1e-15);
  EXPECT_EQ(file.outline.names->point(0), "point 1");
  EXPECT_NE(file.outline.names->segment_where(2).find("in:10"), std::string::npos);
}

TEST_F(OutlineFiles, PolyMayCountFromZeroAndHaveItsPointsInANodeFile) {
  write("far.node", "3 2 0 0\n0 0 0\n1 1 0\n2 0 1\n");
  const auto file = io::read_outline(write("far.poly", "0 2 0 0\n3 0\n0 0 1\n1 1 2\n2 2 0\n1\n0 5 5\n"));
  ASSERT_TRUE(file.has_value()) << file.error().what();
  EXPECT_EQ(file->outline.points.size(), 3u);
  EXPECT_EQ(file->outline.segments[2].ends, (std::array{2, 0}));
  EXPECT_EQ(file->outline.holes.size(), 1u);
  EXPECT_NE(file->outline.names->point_where(1).find("far.node:3"), std::string::npos);
  EXPECT_NE(file->outline.names->hole_where(0).find("far.poly:7"), std::string::npos);
}

TEST_F(OutlineFiles, JigsawHasPointsEdgesAndParts) {
  const io::OutlineFile file = read(
      "# geometry\nMSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=6\n0;0;0\n1;0;0\n1;1;0\n0;1;0\n2;0;0\n2;1;0\n"
      "EDGE2=7\n0;1;3\n1;2;3\n2;3;3\n3;0;3\n1;4;3\n4;5;3\n5;2;4\nVALUE=1;1\n7\n"
      "BOUND=8\n5;0;20\n5;1;20\n5;2;20\n5;3;20\n6;4;20\n6;5;20\n6;6;20\n6;1;20\n");
  EXPECT_EQ(file.format, "jigsaw");
  EXPECT_FALSE(file.geographic);
  EXPECT_EQ(file.outline.points.size(), 6u);
  ASSERT_EQ(file.outline.segments.size(), 7u);
  EXPECT_EQ(file.outline.segments[6].tag, 4);
  ASSERT_EQ(file.outline.parts.size(), 2u);
  EXPECT_EQ(file.outline.parts[1].region, 6);
  MesherOptions options;
  options.size = 0.3;
  const auto made = mesh_outline(file.outline, options);
  ASSERT_TRUE(made.has_value()) << made.error().what();
  EXPECT_EQ(made->bad, 0u);
  EXPECT_NEAR(mesh_area(made->mesh), 2, 1e-12);
}

TEST_F(OutlineFiles, JigsawOnTheEllipsoidIsInRadians) {
  const io::OutlineFile file = read(
      "mshid=3;ellipsoid-mesh\nRADII=6371;6371;6371\nNDIMS=2\nPOINT=3\n0;0;0\n0.1;0;0\n0;0.1;0\n"
      "EDGE2=3\n0;1;0\n1;2;0\n2;0;0\n");
  EXPECT_TRUE(file.geographic);
  EXPECT_NEAR(file.outline.points[1].x, 18 / std::numbers::pi, 1e-12);
}

constexpr const char* kTwoCounties = R"({"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {"name": "w\u00e9st", "size": 0.05}, "geometry": {"type": "Polygon", "coordinates":
  [[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], [[0.4, 0.4], [0.6, 0.4], [0.6, 0.6], [0.4, 0.4]]]}},
 {"type": "Feature", "properties": null, "geometry": {"type": "MultiPolygon", "coordinates":
  [[[[1, 0, 7], [2, 0, 7], [2, 1, 7], [1, 1, 7], [1, 0, 7]]], [[[3, 0], [4, 0], [3, 1], [3, 0]]]]}},
 {"type": "Feature", "properties": {"tag": 4}, "geometry": {"type": "LineString", "coordinates":
  [[1.2, 0.2], [1.5, 0.5], [1.5, 0.5], [1.8, 0.2]]}},
 {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [1.5, 0.8]}}]})";

TEST_F(OutlineFiles, GeoJsonPolygonsShareBordersAndLinesStayInside) {
  const io::OutlineFile file = read(kTwoCounties);
  EXPECT_EQ(file.format, "geojson");
  EXPECT_TRUE(file.geographic);
  EXPECT_EQ(file.outline.points.size(), 4u + 3 + 2 + 3 + 3 + 1);
  ASSERT_EQ(file.outline.parts.size(), 2u);
  EXPECT_EQ(file.outline.parts[0].region, 1);
  EXPECT_EQ(file.outline.parts[1].region, 2);
  EXPECT_EQ(file.outline.parts[0].size, 0.05);
  EXPECT_EQ(file.warnings.size(), 2u);  // a repeated position, heights
  EXPECT_EQ(file.outline.names->segment(4), "segment 0 of ring 1 of feature 0");
  MesherOptions options;
  options.size = 0.2;
  const auto made = mesh_outline(file.outline, options);
  ASSERT_TRUE(made.has_value()) << made.error().what();
  EXPECT_EQ(made->bad, 0u);
  EXPECT_NEAR(mesh_area(made->mesh), 1 - 0.02 + 1 + 0.5, 1e-12);
  std::size_t tagged = 0;
  for (const MeshLine& line : made->lines) tagged += line.tag == 4 ? 1 : 0;
  EXPECT_GT(tagged, 2u);
}

TEST_F(OutlineFiles, GeoJsonPropertiesThatAreMisspeltOrHaveNoEffectAreNamed) {
  const auto warnings = [&](const std::string& properties, const std::string& geometry) {
    std::string all;
    const io::OutlineFile file =
        read(R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": )" + geometry + "}}");
    for (const std::string& warning : file.warnings) all += warning.substr(warning.find(": ") + 2) + "\n";
    return all;
  };
  const std::string square = R"("Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]])";
  const std::string line = R"("LineString", "coordinates": [[0, 0], [1, 0]])";
  EXPECT_EQ(warnings(R"("size": 1, "region": 2, "tag": 3, "area": 4, "name": "Sizewell", "Region": "north")", square),
            "");
  EXPECT_EQ(warnings(R"("siez": 1, "Size": 1, "sizes": 1, "reigon": 2, "tags": 3)", square),
            "the feature: property 'siez' is ignored; is 'size' meant?\n"
            "the feature: property 'Size' is ignored; is 'size' meant?\n"
            "the feature: property 'sizes' is ignored; is 'size' meant?\n"
            "the feature: property 'reigon' is ignored; is 'region' meant?\n"
            "the feature: property 'tags' is ignored; is 'tag' meant?\n");
  EXPECT_EQ(warnings(R"("size": "0.1")", square),
            "the feature: property 'size' is a string, not a number, and ignored\n");
  EXPECT_EQ(warnings(R"("size": 0.1, "tag": 2)", line), "");
  EXPECT_EQ(warnings(R"("region": 2)", line),
            "the feature: 'region' is for polygons and has no effect on a LineString\n");
}

TEST_F(OutlineFiles, GeoJsonNamesHaveOneTagEachAndNothingIsLost) {
  const auto feature = [](const std::string& properties, const std::string& geometry) {
    return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": )" + geometry + "}}";
  };
  const auto line = [](int y) {
    return R"("LineString", "coordinates": [[1, )" + std::to_string(y) + "], [9, " + std::to_string(y) + "]]";
  };
  const auto square = [](int x) {
    const std::string a = std::to_string(x), b = std::to_string(x + 10);
    return R"("Polygon", "coordinates": [[[)" + a + ", 0], [" + b + ", 0], [" + b + ", 10], [" + a + ", 10], [" + a +
           ", 0]]]";
  };
  const auto outline_of = [&](const std::vector<std::string>& features) {
    std::string all;
    for (const std::string& each : features) all += (all.empty() ? "" : ",") + each;
    return read(R"({"type": "FeatureCollection", "crs": "EPSG:25832", "features": [)" + all + "]}");
  };
  using Names = std::vector<std::string>;
  const auto names = [](const io::OutlineFile& file) {
    Names all;
    for (const PhysicalName& g : file.outline.groups)
      all.push_back(std::to_string(g.dimension) + " " + std::to_string(g.tag) + " " + g.name);
    return all;
  };
  const auto tags_of_segment = [](const io::OutlineFile& file, std::size_t segment) {
    std::vector<std::int32_t> tags = {file.outline.segments[segment].tag};
    for (const OutlineTag& further : file.outline.further_tags) {
      if (static_cast<std::size_t>(further.element) == segment) tags.push_back(further.tag);
    }
    return tags;
  };
  using Tags = std::vector<std::int32_t>;
  // One name and one tag belong together, also where another feature of the name has no tag.
  io::OutlineFile file =
      outline_of({feature("\"tag\": 1", square(0)), feature(R"("name": " Rhine ", "tag": 4)", line(2)),
                  feature(R"("name": "Rhine")", line(4)), feature(R"("name": "Main\n")", line(6))});
  EXPECT_EQ(names(file), (Names{"1 4 Rhine", "1 5 Main"}));
  EXPECT_EQ(tags_of_segment(file, 5), Tags{4});
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_FALSE(file.geographic);
  // A tag of several names is a class: it stays, and each name has its own tag beside it. So does a name with two tags.
  file = outline_of({feature("", square(0)), feature(R"("name": "Rhine", "tag": 4)", line(2)),
                     feature(R"("name": "Main", "tag": 4)", line(4)), feature(R"("name": "Elbe", "tag": 5)", line(6)),
                     feature(R"("name": "Elbe", "tag": 6)", line(8))});
  EXPECT_EQ(names(file), (Names{"1 7 Rhine", "1 8 Main", "1 9 Elbe"}));
  EXPECT_EQ(tags_of_segment(file, 4), (Tags{4, 7}));
  EXPECT_EQ(tags_of_segment(file, 5), (Tags{4, 8}));
  EXPECT_EQ(tags_of_segment(file, 6), (Tags{5, 9}));
  EXPECT_EQ(tags_of_segment(file, 7), (Tags{6, 9}));
  // Polygons of one name are one region. A triangle has one region, so a second name is named and dropped.
  file = outline_of({feature(R"("name": "sand")", square(0)), feature(R"("name": "clay")", square(10)),
                     feature(R"("name": "sand")", square(20))});
  EXPECT_EQ(names(file), (Names{"2 1 sand", "2 2 clay"}));
  EXPECT_EQ(file.outline.parts[2].region, 1);
  file = outline_of({feature(R"("name": "sand", "region": 4)", square(0)),
                     feature(R"("name": "clay", "region": 4)", square(10)), feature(R"("name": "silt")", square(20))});
  EXPECT_EQ(names(file), (Names{"2 4 sand", "2 5 silt"}));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(
      file.warnings[0].find("region 4 is named 'sand'; its name 'clay' is dropped, because a region has one name"),
      std::string::npos);
  EXPECT_EQ(names(outline_of({feature(R"("name": "\u00e4\u20ac\ud83d\ude00\ud83d")", square(0))})),
            Names{"2 1 \u00e4\u20ac\U0001F600\ufffd"});
}

TEST_F(OutlineFiles, TagsOfPointsAreRead) {
  const auto tags = [&](const std::string& text) {
    std::vector<std::pair<std::int32_t, std::int32_t>> all;
    for (const OutlineTag& tag : read(text).outline.point_tags) all.emplace_back(tag.element, tag.tag);
    return all;
  };
  using Tags = std::vector<std::pair<std::int32_t, std::int32_t>>;
  EXPECT_EQ(tags(kSquarePoly), (Tags{{0, 3}, {1, 3}, {2, 3}, {3, 3}}));
  EXPECT_EQ(tags("MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=4\n0;0;0\n1;0;7\n0;1;-1\n1;1\n"
                 "EDGE2=3\n0;1;0\n1;2;0\n2;0;0\n"),
            (Tags{{1, 7}, {2, -1}}));
}

TEST_F(OutlineFiles, GeoJsonWithAProjectedCrsIsPlanar) {
  const std::string polygon = R"("type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]})";
  const auto with_crs = [&](const std::string& name) {
    return read(R"({"crs": {"type": "name", "properties": {"name": ")" + name + "\"}}, " + polygon).geographic;
  };
  EXPECT_FALSE(with_crs("urn:ogc:def:crs:EPSG::32632"));
  EXPECT_TRUE(with_crs("urn:ogc:def:crs:OGC:1.3:CRS84"));
  EXPECT_TRUE(with_crs("EPSG:4326"));
  EXPECT_TRUE(read("{" + polygon).geographic);
  EXPECT_FALSE(read(R"({"crs": "EPSG:32632", )" + polygon).geographic);
  EXPECT_TRUE(read(R"({"crs": "EPSG:4326", )" + polygon).geographic);
}

TEST_F(OutlineFiles, BadPolyFilesAreNamedWithLineAndNumber) {
  const std::string points = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n";
  expect_error("4 2 0 0\n1 0 0\n2 1 0\n4 1 1\n5 0 1\n0\n0\n", "bad:4: expected point 3, found point 4");
  expect_error("4 3 0 0\n1 0 0 0\n", "no outline");
  expect_error(points + "4 0\n1 1 2\n2 2 3\n3 3 9\n4 4 1\n0\n",
               "bad:9: segment 3 uses point 9, but there are points 1 to 4");
  expect_error(points + "4 0\n1 1 2\n2 2 3\n3 3 4\n", "bad:6: announces 4 segments, but only 21 bytes follow");
  expect_error(points + "4 0\n1 1 2\n2 2 x\n3 3 4\n4 4 1\n0\n", "bad:8: expected a vertex number, found 'x'");
  expect_error(points + "4 0\n1 1 2\n2 2 3\n3 3 4                   \n", "the file ends where the number of a segment");
  expect_error(points + "900000 0\n1 1 2\n", "announces 900000 segments");
  expect_error(points + "0 0\n0\n", "has no segments");
  expect_error(points + "4 0\n1 1 3\n2 3 2\n3 2 4\n4 4 1\n0\n",
               "bad:9: segment 3 (point 2 to point 4) crosses segment 1");
  expect_error(points + "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 4\n0\n",
               "bad:10: segment 4 has no length: both its ends are point 4");
  expect_error(points + "3 0\n1 1 2\n2 2 3\n3 3 4\n0\n", "bad:2: the outline is not closed");
  expect_error(points + "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n7 5 5\n", "bad:12: hole 7 lies outside");
  expect_error(points + "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n1\n1 .5 .5 1.5\n", "expected a whole number");
  expect_error("4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 1 0\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n",
               "bad:2: the outline is not closed");
  expect_error("0 2 0 0\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n", "no points of its own");
}

TEST_F(OutlineFiles, BadJigsawFilesAreNamedWithLineAndNumber) {
  const std::string head = "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\n", points = "POINT=3\n0;0;0\n1;0;0\n0;1;0\n";
  expect_error(head + points + "EDGE2=3\n0;1;0\n1;2;0\n2;3;0\n",
               "bad:10: segment 2 uses point 3, but there are points 0 to 2");
  expect_error(head + points + "EDGE2=3\n0;1;0\n1;2\n2;0;0\n", "bad:9: expected an edge a;b;tag, found '1;2'");
  expect_error(head + "POINT=3\n0;0;0\n1;zero;0\n0;1;0\n", "bad:5: expected a point x;y;tag");
  expect_error(head + "POINT=x\n", "bad:3: expected the number of lines of POINT, found 'x'");
  expect_error(head + "POINT=3\n0;0;0\n1;0;0\n", "POINT announces 3 lines, but the file ends after 2");
  expect_error("MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\n", "bad:2: has NDIMS=3; expected 2");
  expect_error("MSHID=3;EUCLIDEAN-GRID\n", "is a grid");
  expect_error(head + points, "no EDGE2");
  expect_error(head + "EDGE2=1\n0;1;0\n", "no POINT");
  expect_error(head + points + "EDGE2=3\n0;1;0\n1;2;0\n2;0;0\nBOUND=1\n1;0;30\n", "elements of type 30");
  expect_error(head + points + "EDGE2=3\n0;1;0\n1;2;0\n2;0;0\nBOUND=1\n1;8;20\n", "part 1 uses edge 8");
  expect_error(head + "nonsense\n", "bad:3: expected a section NAME=");
}

TEST_F(OutlineFiles, BadGeoJsonIsNamedWithLineAndFeature) {
  const auto polygon = [](const std::string& rings) {
    return "{\"type\": \"Polygon\",\n\"coordinates\": " + rings + "}";
  };
  expect_error(
      "{",
      "bad:1: is no JSON: syntax error while parsing object key - unexpected end of input; expected string literal");
  expect_error("{\"type\": \"Polygon\", \"coordinates\": [[[0, 0], [1, 0}]]]}", "unexpected '}'; expected ']'");
  expect_error("{\"type\": nothing}", "syntax error while parsing value - invalid literal; last read: '\"type\": no'");
  expect_error(polygon("[[[0, 0], [1, 0], [1, 1]]]"), "bad:2: ring 0 of the geometry is not closed");
  expect_error(polygon("[[[0, 0], [1, 0], [0, 0]]]"), "has 2 sides; expected three or more");
  expect_error(polygon("[[[0, 0]]]"), "expected two positions or more, found 1");
  expect_error(polygon("[[[0, 0], [1], [0, 0]]]"), "expected a position [x, y]");
  expect_error(polygon("[[[0, 0], \"x\", [0, 0]]]"), "expected a position [x, y], found a string");
  expect_error(polygon("7"), "expected an array, found a number");
  expect_error(polygon("[[[0, 0], [1, 1], [1, 0], [0, 1], [0, 0]]]"), "bad:2: segment 2 of ring 0 of the geometry");
  expect_error("{\"type\": \"Circle\"}", "found 'Circle'");
  expect_error("{\"type\": \"FeatureCollection\"}", "expected an array 'features', found none");
  expect_error("{\"type\": \"FeatureCollection\", \"features\": []}", "has no points");
  expect_error("{\"type\": \"FeatureCollection\", \"features\": [7, {}]}",
               "feature 0: expected a Feature, found a number");
  expect_error("{\"type\": \"Polygon\"}", "has no \"coordinates\"");
  expect_error(std::string(100000, '['), "no outline");
  expect_error("{\"a\": " + std::string(100000, '['), "nested more than");
}

TEST_F(OutlineFiles, WhatIsNoOutlineIsSaidToBeNone) {
  expect_error("$MeshFormat\n4.1 0 8\n", "is no outline that temper reads");
  expect_error("", "the file is empty");
  EXPECT_FALSE(io::read_outline("nosuch.poly").has_value());
  EXPECT_FALSE(io::read_outline(folder_.string()).has_value());
}

TEST(PublicOutlines, AllAreWellCenteredAtEverySizeInOneGo) {
  if (!std::filesystem::exists(TEMPER_SHARED "/outlines")) GTEST_SKIP() << "no public outlines here";
  std::size_t tested = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TEMPER_SHARED "/outlines")) {
    if (entry.path().extension() != ".poly") continue;
    const auto file = io::read_outline(entry.path().string());
    ASSERT_TRUE(file.has_value()) << file.error().what();
    for (const double part : {0.2, 0.05, 0.01}) {
      SCOPED_TRACE(entry.path().filename().string() + ", size " + std::to_string(part) + " of the extent");
      MesherOptions options;
      options.size = part * extent(file->outline);
      const auto made = mesh_outline(file->outline, options);
      ASSERT_TRUE(made.has_value()) << made.error().what();
      EXPECT_EQ(made->bad, 0u);
      EXPECT_EQ(count_bad(made->mesh), 0u);
      expect_kept(file->outline, *made);
      ++tested;
    }
  }
  EXPECT_EQ(tested, 12u);
}

/// The boundary of a file in degrees: one segment for each edge of one triangle.
Outline coast_of(const io::MeshFile& file, const Mesh& mesh) {
  Outline coast;
  std::vector<std::int32_t> number(mesh.n_vertices(), -1);
  const auto point = [&](VertexId v) {
    if (number[v.index] < 0) {
      number[v.index] = static_cast<std::int32_t>(coast.points.size());
      coast.points.push_back(file.points[v.index]);
    }
    return number[v.index];
  };
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) coast.segments.push_back({{point(mesh.origin(h)), point(mesh.target(h))}, 0});
  }
  return coast;
}

double part_of_sphere(const Mesh& mesh) {
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    sum += solid_angle(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c));
  }
  return sum / (4 * std::numbers::pi);
}

TEST_F(OutlineFiles, RingsFollowTheSpecification) {
  const std::string shell = R"({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]])";
  const std::string hole = ", [[1, 1], [2, 1], [2, 2], [1, 1]]", outside = ", [[5, 5], [6, 5], [6, 6], [5, 5]]";
  expect_error(shell + outside + "]}", "ring 1 of the geometry lies outside ring 0 of the geometry near (");
  expect_error(shell + hole + hole + "]}", "ring 2 of the geometry overlaps ring 1 of the geometry near (");
  expect_error(shell + ", [[3, 1], [5, 1], [3, 2], [3, 1]]" + "]}", "crosses");
}

TEST_F(OutlineFiles, WellsOutsideOrAtOnePlaceAreWarnedOf) {
  const io::OutlineFile file = read(R"({"type": "GeometryCollection", "geometries": [
{"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]]},
{"type": "MultiPoint", "coordinates": [[1, 1], [7, 2], [1, 1], [1.000000001, 1]]}]})");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("(1, 1), and becomes one vertex"), std::string::npos);
  MesherOptions options;
  options.size = 1;
  const auto made = mesh_outline(file.outline, options);
  ASSERT_TRUE(made) << made.error().what();
  ASSERT_EQ(made->warnings.size(), 2u);
  EXPECT_NE(made->warnings[0].find("are at one place, (1, 1), and become one vertex"), std::string::npos);
  EXPECT_NE(made->warnings[1].find("the point of the geometry at (7, 2) is outside"), std::string::npos);
}

// Small inputs that once showed a fault, with the size that shows it, and a part of what is said now.
TEST(ReportedOutlines, AreMeshedOrNamed) {
  const std::string reports = TEMPER_SHARED "/reports/";
  if (!std::filesystem::exists(reports)) GTEST_SKIP() << "no reports here";
  struct Row {
    const char* file;
    double size;
    const char* error;  // or none
  };
  for (const Row& row : {Row{"tee_rounded", 0.15, nullptr}, Row{"shared_rounded", 6, nullptr},
                         Row{"utm_2e-09", 100, nullptr}, Row{"touch_one_point", 0.5, nullptr},
                         Row{"hole_outside", 0.5, "ring 1 of feature 0 lies outside ring 0 of feature 0"},
                         Row{"narrow_1mm", 80, "narrow: 0.001 at ("}}) {
    const auto file = io::read_outline(reports + row.file + ".geojson");
    ASSERT_TRUE(file);
    MesherOptions options;
    options.size = row.size;
    const auto made = mesh_outline(file->outline, options);
    if (row.error != nullptr) {
      ASSERT_FALSE(made) << row.file;
      EXPECT_NE(made.error().what().find(row.error), std::string::npos) << made.error().what();
      continue;
    }
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_EQ(made->bad, 0u) << row.file;
    EXPECT_LT(made->mesh.n_vertices(), 600u) << row.file;
  }
}

TEST(PublicOutlines, TheCoastsOfAGlobalOceanAreMeshedWellCenteredAndKept) {
  const std::string path = TEMPER_SHARED "/meshes/sphere/fesom_pi.nod2d.out";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no public meshes here";
  const auto file = io::read(path);
  ASSERT_TRUE(file.has_value()) << file.error().what();
  const auto ocean = io::make_mesh(*file);
  ASSERT_TRUE(ocean.has_value()) << ocean.error().what();
  SphereOutline sphere;
  sphere.coasts = coast_of(*file, ocean->mesh);
  EXPECT_GT(sphere.coasts.points.size(), 400u);
  for (const double size : {1e6, 3e5}) {
    MesherOptions options;
    options.size = size;
    const auto made = mesh_sphere(sphere, options);
    ASSERT_TRUE(made.has_value()) << made.error().what();
    EXPECT_EQ(made->bad, 0u);
    EXPECT_EQ(count_bad(made->mesh), 0u);
    EXPECT_NEAR(part_of_sphere(made->mesh), part_of_sphere(ocean->mesh), 1e-9);
    for (std::size_t i = 0; i < sphere.coasts.points.size(); ++i) {
      EXPECT_TRUE(made->mesh.is_boundary(made->vertex_of_point[i]));
    }
  }
}

/// Land on a globe: every triangle is well-centered, and every coast point within the tolerance of its vertex. Points
/// on cuts at the end of the map, which end at a pole, are in the land.
void expect_coast_kept(const io::OutlineFile& land, double size) {
  SphereOutline sphere;
  sphere.coasts = land.outline;
  MesherOptions options;
  options.size = size;
  const auto made = mesh_sphere(sphere, options);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->bad, 0u);
  for (std::size_t i = 0; i < land.outline.points.size(); ++i) {
    const Vec2 p = land.outline.points[i];
    const VertexId v = made->vertex_of_point[i];
    if (!v.valid()) {
      EXPECT_TRUE(std::abs(std::abs(p.x) - 180) < 1e-9 || p.y < -84) << p.x << " " << p.y;
      continue;
    }
    EXPECT_LT(length(made->mesh.space().place(made->mesh.point(v)) - sphere.radius * direction_of(p)), 0.64) << i;
    EXPECT_TRUE(made->mesh.is_boundary(v));
  }
}

// As in Natural Earth: a continent on both sides of 180 degrees, which a rounded longitude ends; edges of 13 to 93 mm;
// a lake as a hole; a cap around the pole, cut at the end of the map.
TEST_F(OutlineFiles, CoastsOfAWorldMapAreKept) {
  constexpr double kMillimeter = 9e-9;  // degrees of latitude
  std::vector<Vec2> continent = {{180.00000000000014, 68.96},
                                 {160, 70},
                                 {120, 73},
                                 {80, 72},
                                 {45, 67},
                                 {10, 60},
                                 {-5, 48},
                                 {-9, 38},
                                 {10, 37},
                                 {35, 31},
                                 {45, 13},
                                 {58, 20},
                                 {72, 20},
                                 {78, 8},
                                 {88, 22},
                                 {105, 10},
                                 {120, 30},
                                 {135, 45},
                                 {155, 52},
                                 {165, 60},
                                 {180.00000000000014, 64.98}};
  for (int i = 0; i < 9; ++i) {
    const auto after = continent.begin() + 1 + 2 * i;
    continent.insert(after + 1, {after->x, after->y + (13 + 10 * i) * kMillimeter});
  }
  const std::vector<Vec2> lake = {{47, 45}, {53, 46}, {53, 38}, {49, 38}},
                          beyond = {{-180, 64.98}, {-172, 64.5}, {-170, 66}, {-175, 68}, {-180, 68.96}},
                          cap = {{-180, -90}, {-180, -84.7}, {-150, -78}, {-100, -73}, {-60, -64},
                                 {-40, -78},  {0, -70},      {60, -67},   {110, -66},  {150, -69},
                                 {170, -78},  {180, -84.7},  {180, -90}};
  const auto ring = [](std::vector<Vec2> points) {
    points.push_back(points.front());
    std::string text;
    char pair[64];
    for (const Vec2 p : points) {
      std::snprintf(pair, sizeof pair, "%s[%.17g, %.17g]", text.empty() ? "[" : ", ", p.x, p.y);
      text += pair;
    }
    return text + "]";
  };
  const io::OutlineFile land = read(R"({"type": "MultiPolygon", "coordinates": [[)" + ring(continent) + ", " +
                                    ring(lake) + "], [" + ring(beyond) + "], [" + ring(cap) + "]]}");
  EXPECT_EQ(land.outline.points.size(), 52u);
  for (const double size : {6e5, 3e5}) expect_coast_kept(land, size);
}

TEST(PublicOutlines, NaturalEarthIsKept) {
  const char* given = std::getenv("TEMPER_NATURAL_EARTH");
  const std::string path = given != nullptr ? given : TEMPER_SHARED "/outlines/ne_110m_land.json";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path << ": set TEMPER_NATURAL_EARTH to the 110 m land";
  const auto land = io::read_outline(path);
  ASSERT_TRUE(land) << land.error().what();
  for (const double size : {6e5, 1.5e5}) expect_coast_kept(*land, size);
}

}  // namespace
}  // namespace temper::test
