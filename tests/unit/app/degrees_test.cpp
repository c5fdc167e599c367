// Meshes in longitude and latitude, from file to file.
#include <algorithm>

#include "temper/generate.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Degrees : public Workshop {
 protected:
  /// A sea of 8° × 4°, 3 km deep, as fort.14.
  static void write_sea(const std::string& path) {
    io::MeshFile file = io::from_mesh(*random_mesh({.vertices = 300, .seed = 4}));
    std::vector<double> depths;
    for (Vec2& p : file.points) {
      p = {2 * p.x - 14, p.y + 55};
      depths.push_back(3000 + 100 * p.y);
    }
    file.point_data = {{"depth", 1, depths}};
    file.weights.clear();
    ASSERT_TRUE(io::write(path, file, {"adcirc", {}}));
  }
};

TEST_F(Degrees, AreRefusedWithTheCureWhereAPlaneIsNeeded) {
  write_sea("fort.14");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"optimize", "fort.14", "-o", "out.14"},
                                             {"check", "fort.14"},
                                             {"draw", "fort.14", "-o", "out.svg"},
                                             {"weights", "fort.14", "-o", "out.14"},
                                             {"explain", "fort.14"},
                                             {"errors", "fort.14"},
                                             {"operators", "fort.14", "-o", "out"}}) {
    const Outcome outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, 2) << arguments[0];
    EXPECT_TRUE(contains(outcome.err, "fort.14: the points look like longitude and latitude"));
    EXPECT_TRUE(contains(outcome.err, "choose a --projection: stereographic, mercator or transverse-mercator"));
    EXPECT_TRUE(contains(outcome.err, "for lengths in meters, sphere for a mesh of the sphere, or none "));
  }
  EXPECT_EQ(names(), std::vector<std::string>{"fort.14"});
  EXPECT_EQ(temper({"convert", "fort.14", "-o", "m.ugrid.nc"}).err.find("`projection`"), std::string::npos);
  temper_ok({"convert", "fort.14", "-o", "same.vtu"});
  temper_ok({"optimize", "fort.14", "-o", "out.14", "--projection", "none", "--quiet"});
}

TEST_F(Degrees, AreOptimizedOnAMapAndWrittenAsTheyCame) {
  write_sea("fort.14");
  const Outcome run = temper_ok({"optimize", "fort.14", "-o", "out.14", "--projection", "stereographic:-10,57"});
  EXPECT_TRUE(contains(run.err, "weights are squared lengths on the map stereographic:-10,57, in meters"));
  const auto before = io::read("fort.14"), after = io::read("out.14");
  ASSERT_TRUE(before && after);
  ASSERT_EQ(before->points.size(), after->points.size());
  std::size_t stayed = 0;
  for (std::size_t p = 0; p < before->points.size(); ++p) {
    stayed += before->points[p] == after->points[p] ? 1 : 0;
    EXPECT_LT(length(before->points[p] - after->points[p]), 2) << "degrees";
  }
  EXPECT_GT(stayed, 20u) << "the coast";
  EXPECT_LT(stayed, before->points.size() / 2);
  const Outcome bad = temper_ok({"check", "fort.14", "--projection", "stereographic:-10,57"});
  EXPECT_TRUE(contains(bad.out, "temper optimize fort.14 --projection=stereographic:-10,57 -o OUT"));
  // On the same map it is what the run said that it is, and a run on the plane of degrees would not be.
  temper_ok({"check", "out.14", "--projection", "stereographic:-10,57", "--require", "outside=0,not_crossed=0"});
  temper_ok({"optimize", "fort.14", "-o", "plane.14", "--projection", "none", "--quiet"});
  EXPECT_EQ(temper({"check", "plane.14", "--projection", "stereographic:-10,57", "--require", "outside=0"}).exit, 3);
  temper_ok({"draw", "out.14", "--before", "fort.14", "-o", "both.svg", "--projection", "stereographic"});
}

TEST_F(Degrees, PlacesAreThoseOfTheFile) {
  write_sea("fort.14");
  const std::string map = "--projection=stereographic";
  const auto is_in_sea = [](const nlohmann::json& at) {
    return at[0] >= -14 && at[0] <= -6 && at[1] >= 54 && at[1] <= 60;
  };
  const auto reasons = nlohmann::json::parse(temper_ok({"explain", "fort.14", map, "--json"}).out)["reasons"];
  ASSERT_FALSE(reasons.empty());
  for (const nlohmann::json& reason : reasons) {
    EXPECT_TRUE(is_in_sea(reason["at"])) << reason["at"];
    for (const nlohmann::json& cure : reason["cures"]) EXPECT_TRUE(cure["at"].is_null() || is_in_sea(cure["at"]));
  }
  const auto check = nlohmann::json::parse(temper_ok({"check", "fort.14", map, "--json"}).out);
  for (const nlohmann::json& worst : check["worst"]) EXPECT_TRUE(is_in_sea(worst["at"])) << worst["at"];
}

TEST_F(Degrees, AReplayOnTheSameMapMakesTheSameFile) {
  write_sea("fort.14");
  temper_ok({"optimize", "fort.14", "-o", "out.14", "--projection", "mercator", "--write", "t.jsonl", "--quiet"});
  temper_ok({"paper", "replay", "fort.14", "t.jsonl", "-o", "again.14", "--projection", "mercator", "--quiet"});
  EXPECT_EQ(read("out.14"), read("again.14"));
}

TEST_F(Degrees, PlainMeshesInTheRangeOfDegreesAreNot) {
  temper_ok({"example", "random", "--vertices", "60", "-o", "in.vtu"});
  temper_ok({"convert", "in.vtu", "-o", "fort.14"});
  for (const char* input : {"in.vtu", "fort.14"}) temper_ok({"optimize", input, "-o", "out.vtu", "--quiet"});
}

TEST_F(Degrees, AFormatWithoutAPlaceForTheGlobeIsRefusedBeforeTheWork) {
  write_sea("fort.14");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"optimize", "fort.14", "--projection", "sphere", "--time-limit", "100"},
                                             {"weights", "fort.14", "--projection", "sphere"},
                                             {"mesh", "--sphere", "--size", "100"}}) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"-o", "out.node"});
    const Outcome outcome = temper(all);
    EXPECT_EQ(outcome.exit, 1) << arguments[0];
    EXPECT_TRUE(contains(outcome.err, "points are on a sphere, which Triangle is not written with")) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  temper_ok({"optimize", "fort.14", "-o", "globe.14", "--projection", "sphere", "--quiet"});
  EXPECT_EQ(io::read("globe.14")->points.size(), io::read("fort.14")->points.size());
}

}  // namespace
}  // namespace temper::test
