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
      temper_ok({"mesh", "in.poly", "-o", "out.vtu", "--size", "0.2", "--report", "r.json", "--draw", "out.svg"});
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
  std::vector<std::int32_t> tags = file->line_tags;
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

TEST_F(MeshVerb, WithoutOptimisationTheDelaunayMeshIsWritten) {
  make_outline();
  temper_ok({"mesh", "in.poly", "-o", "out.vtu", "--size", "0.2", "--no-optimize", "--report", "r.json"});
  EXPECT_EQ(read_json("r.json")["sweeps"], 0);
  temper_ok({"check", "out.vtu", "--require", "nonregular=0"});
}

TEST_F(MeshVerb, DegreesAreRefusedUnlessAProjectionIsChosen) {
  make_country();
  const Outcome refused = temper({"mesh", "in.json", "-o", "out.vtu", "--size", "10000"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_TRUE(contains(refused.err, "longitude and latitude"));
  EXPECT_TRUE(contains(refused.err, "--projection"));
  EXPECT_FALSE(exists("out.vtu"));
  temper_ok(
      {"mesh", "in.json", "-o", "out.vtu", "--size", "10000", "--projection", "stereographic", "--report", "r.json"});
  const auto report = read_json("r.json");
  EXPECT_EQ(report["bad"], 0);
  EXPECT_GT(report["projection"]["largest_scale"].get<double>(), 1);
  EXPECT_LT(report["projection"]["largest_scale"].get<double>(), 1.001);
  EXPECT_TRUE(contains(read("out.vtu"), "longitude"));
  temper_ok({"mesh", "in.json", "-o", "plain.vtu", "--size", "0.2", "--projection", "none"});
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

}  // namespace
}  // namespace temper::test
