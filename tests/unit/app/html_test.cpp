// The HTML page of check and optimize.
#include "workshop.hpp"

namespace temper::test {
namespace {

class Html : public Workshop {
 protected:
  /// What the page has besides the meshes.
  static nlohmann::json report_in(const std::string& path) {
    const std::string html = read(path), begin = "id=\"report\">";
    const std::size_t at = html.find(begin) + begin.size();
    return nlohmann::json::parse(html.substr(at, html.find("</script>", at) - at));
  }
};

TEST_F(Html, CheckShowsItsReportAndTheReasons) {
  make_input();
  const Outcome outcome = temper_ok({"check", "in.vtu", "--json", "--write", "page.html"});
  const nlohmann::json report = report_in("page.html"), json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["verb"], "check");
  EXPECT_EQ(report["after"]["min_h_over_l"], json["min_h_over_l"]);
  EXPECT_EQ(report["after"]["histograms"], json["histograms"]);
  EXPECT_FALSE(report["reasons"].empty());
  EXPECT_TRUE(contains(report["command"], "temper check in.vtu --json --write=page.html"));
  EXPECT_TRUE(contains(read("page.html"), "id=\"after.points\""));
  EXPECT_FALSE(contains(read("page.html"), "id=\"before.points\""));
}

TEST_F(Html, OptimizeShowsBeforeAndAfterAndWritesTheSameBytesAgain) {
  make_input();
  const std::vector<std::string> command = {"optimize", "in.vtu", "-o", "out.vtu", "--write", "page.html"};
  temper_ok(command);
  const std::string first = read("page.html");
  temper_ok(command);
  EXPECT_TRUE(first == read("page.html")) << "something in it depends on time";
  const nlohmann::json report = report_in("page.html");
  EXPECT_EQ(report["verb"], "optimize");
  EXPECT_GT(report["before"]["orthocenters_outside"], 0);
  EXPECT_EQ(report["after"]["orthocenters_outside"], 0);
  EXPECT_GT(report["history"].size(), 1u);
  EXPECT_TRUE(report["reasons"].empty());
  for (const char* id : {"before.points", "after.points", "after.weights"}) {
    EXPECT_TRUE(contains(first, std::string("id=\"") + id + "\"")) << id;
  }
}

TEST_F(Html, TetrahedraHaveTheirOwnArraysAndMeasures) {
  make_tetrahedra();
  temper_ok({"optimize", "two.mesh", "-o", "out.vtu", "--write", "page.html", "cut.svg"});
  const std::string page = read("page.html");
  const nlohmann::json report = report_in("page.html");
  EXPECT_GT(report["before"]["orthocenters_outside"], 0);
  EXPECT_EQ(report["after"]["tetrahedra"], report["before"]["tetrahedra"]);
  EXPECT_FALSE(report.contains("seconds")) << "the same command writes the same bytes";
  for (const char* id : {"before.points", "before.tetrahedra", "after.weights", "after.verdicts", "before.regions"})
    EXPECT_TRUE(contains(page, std::string("id=\"") + id + "\"")) << id;
  EXPECT_FALSE(contains(page, "id=\"after.triangles\""));
  EXPECT_TRUE(contains(page, "\"key\":\"min_dihedral_deg\""));
  EXPECT_TRUE(contains(page, "id=\"before.vertex_numbers\"")) << "the file has one more point";
  EXPECT_TRUE(contains(read("cut.svg"), "tetrahedra bad at "));
  temper_ok({"check", "two.mesh", "--write", "page.html"});
  EXPECT_TRUE(contains(report_in("page.html")["after"]["worst"][0]["why"].get<std::string>(), "face 2-4-3"));
}

TEST_F(Html, TheInputAndOtherOutputsAreNotReplaced) {
  make_input();
  EXPECT_EQ(temper({"check", "in.vtu", "--write", "page.htm"}).exit, 2);
  EXPECT_EQ(temper({"check", "in.vtu", "--write", "none/page.html"}).exit, 1);
  EXPECT_EQ(temper({"optimize", "in.vtu", "-o", "out.html", "--format", "vtu", "--write", "out.html"}).exit, 2);
  const Outcome several = temper({"check", "in.vtu", "in.vtu", "--write", "page.html"});
  EXPECT_EQ(several.exit, 2);
  EXPECT_TRUE(contains(several.err, "--write: expected one mesh, found 2"));
  EXPECT_EQ(names(), (std::vector<std::string>{"in.vtu"}));
}

}  // namespace
}  // namespace temper::test
