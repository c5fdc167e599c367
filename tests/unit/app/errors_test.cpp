// temper errors: tables, JSON, comparisons, and what is refused.
#include "temper/errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Errors : public Workshop {};

TEST_F(Errors, PrintsErrorsOfEveryFieldTheirMeansAndTheMatrices) {
  make_input();
  const std::string text = temper_ok({"errors", "in.vtu", "--condition", "--details"}).out;
  for (const char* part : {"in.vtu: ", "relative error, L2", "relative error, maximum", "product (chosen)",
                           "bump (held-back)", "mean, chosen", "mean, held-back", "M-matrix", "positive definite",
                           "largest coefficient over median", "condition, at least"}) {
    EXPECT_TRUE(contains(text, part));
  }
  EXPECT_FALSE(contains(text, "linear"));
  EXPECT_FALSE(contains(text, "nan"));
  const auto json = nlohmann::json::parse(temper_ok({"errors", "in.vtu", "--json"}).out);
  for (const auto& field : json["errors"]["fields"]) {
    for (const char* key : {"star0", "star1", "star2", "poisson", "flux"}) {
      for (const char* norm : {"l2", "max"}) {
        char number[32];
        std::snprintf(number, sizeof number, " %.3e", field[key][norm].get<double>());
        EXPECT_TRUE(contains(text, number)) << field["name"] << " " << key;
      }
    }
  }
}

TEST_F(Errors, PrintsMeansAndWhatSolversNeedUnlessAllIsAskedFor) {
  make_input();
  const std::string text = temper_ok({"errors", "in.vtu", "--against", "in.vtu", "--refine", "1"}).out;
  for (const char* part : {"mean relative error, 9 fields", "mean ratio, 9 fields", "mean order, 9 fields", "M-matrix",
                           "negative coefficients", "--details prints all"})
    EXPECT_TRUE(contains(text, part)) << part;
  for (const char* part : {"bump", "singular", "merged cells"}) EXPECT_FALSE(contains(text, part)) << part;
  const auto mean = nlohmann::json::parse(temper_ok({"errors", "in.vtu", "--json"}).out)["errors"]["mean"]["all"];
  for (const char* norm : {"l2", "max"}) {
    char number[32];
    std::snprintf(number, sizeof number, " %.3e", mean["flux"][norm].get<double>());
    EXPECT_TRUE(contains(text, number)) << norm;
  }
  EXPECT_TRUE(contains(temper_ok({"errors", "in.vtu", "--fields", "bump"}).out, "relative error, bump"));
}

TEST_F(Errors, TetrahedraHaveTheSameVerb) {
  // An octahedron in eight, around a vertex that is not in the middle.
  const auto octahedron = [](const std::string& middle) {
    return "MeshVersionFormatted 2\nDimension 3\nVertices\n7\n1 0 0 0\n-1 0 0 0\n0 1 0 0\n0 -1 0 0\n0 0 1 0\n"
           "0 0 -1 0\n" +
           middle +
           " 0\nTetrahedra\n8\n1 3 5 7 0\n3 2 5 7 0\n2 4 5 7 0\n4 1 5 7 0\n3 1 6 7 0\n"
           "2 3 6 7 0\n4 2 6 7 0\n1 4 6 7 0\nEnd\n";
  };
  write("a.mesh", octahedron("0.1 0.1 0.2"));
  write("b.mesh", octahedron("0 0 0"));
  const std::string text = temper_ok({"errors", "a.mesh", "--against", "b.mesh", "--condition", "--details"}).out;
  for (const char* part : {"a.mesh: 8 tetrahedra, ", "oblique (chosen)", "mean, held-back",
                           "faces between merged cells", "condition, at least", "over the errors of b.mesh:"})
    EXPECT_TRUE(contains(text, part)) << part;
  const auto json = nlohmann::json::parse(temper_ok({"errors", "a.mesh", "--fields", "exact", "--json"}).out);
  EXPECT_EQ(json["tetrahedra"], 8);
  EXPECT_EQ(json["matrices"]["poisson"]["unknowns"], 1);
  EXPECT_LT(json["errors"]["fields"][0]["flux"]["l2"].get<double>(), 1e-12);
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
    std::vector<std::string> all = {"errors", "a.mesh"};
    all.insert(all.end(), words.begin(), words.end());
    const auto outcome = temper(all);
    EXPECT_NE(outcome.exit, 0);
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
  };
  refused({"--refine", "1"}, "a.mesh has tetrahedra, and --refine is for triangles alone");
  refused({"--dirichlet", "1=0"}, "--dirichlet is for triangles alone");
  refused({"--fields", "bump"}, "no field 'bump'; the fields of tetrahedra and curved surfaces are ");
  make_input();
  refused({"--against", "in.vtu"}, "in.vtu: expected tetrahedra, as in a.mesh, found triangles");
}

TEST_F(Errors, SaysTheSameAsJsonForAnyNumberOfThreads) {
  make_input();
  const std::string text = temper_ok({"errors", "in.vtu", "--json", "--threads", "1"}).out;
  EXPECT_EQ(temper_ok({"errors", "in.vtu", "--json", "--threads", "3"}).out, text);
  const auto json = nlohmann::json::parse(text);
  const auto check = nlohmann::json::parse(temper_ok({"check", "in.vtu", "--json"}).out);
  EXPECT_EQ(json["triangles"], check["triangles"]);
  EXPECT_EQ(json["non_regular_edges"], check["non_regular_edges"]);
  ASSERT_EQ(json["errors"]["fields"].size(), 9u);
  double logs = 0;
  for (const auto& field : json["errors"]["fields"]) {
    for (const char* key : {"star0", "star1", "star2", "poisson", "flux"}) {
      EXPECT_GT(field[key]["l2"], 0) << key;
      EXPECT_GT(field[key]["max"], field[key]["l2"]) << key;
    }
    logs += std::log(field["poisson"]["l2"].get<double>()) / 9;
  }
  EXPECT_NEAR(json["errors"]["mean"]["all"]["poisson"]["l2"].get<double>(), std::exp(logs), 1e-12);
  EXPECT_TRUE(json["matrices"]["flux"]["condition"].is_null());
}

TEST_F(Errors, MeasuresTheUsersOwnProblemByTheNamesOfTheFile) {
  // Two squares, sand and clay, with tagged lines on the left and right.
  write(
      "a.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 \"river\"\n1 2 \"lake\"\n2 5 \"sand\"\n2 6 "
      "\"clay\"\n$EndPhysicalNames\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n7 0.4 0.5 "
      "0\n8 1.6 0.5 0\n$EndNodes\n$Elements\n10\n1 1 2 1 1 1 4\n2 1 2 2 2 3 6\n3 2 2 5 1 1 2 7\n4 2 2 5 1 2 5 7\n5 2 2 "
      "5 1 "
      "5 4 7\n6 2 2 5 1 4 1 7\n7 2 2 6 2 2 3 8\n8 2 2 6 2 3 6 8\n9 2 2 6 2 6 5 8\n10 2 2 6 2 5 2 8\n$EndElements\n");
  const std::vector<std::string> problem = {"errors",      "a.msh",          "--coefficient", "sand=10,6=0.1",
                                            "--dirichlet", "river=3,lake=1", "--json"};
  const auto json = nlohmann::json::parse(temper_ok(problem).out);
  EXPECT_LT(json["problem"]["vertex"]["max"].get<double>(), 1e-12) << "piecewise linear";
  EXPECT_GT(json["problem"]["cell"]["max"].get<double>(), 1e-3) << "orthocenters are in other triangles";
  EXPECT_NEAR(json["problem"]["largest"].get<double>(), 3, 1e-12);
  EXPECT_EQ(json["problem"]["matrices"]["vertex"]["unknowns"], 4);
  const std::string text =
      temper_ok({"errors", "a.msh", "--dirichlet", "boundary=0", "--source", "2", "--against", "a.msh"}).out;
  EXPECT_TRUE(contains(text, "unknowns at orthocenters, L2"));
  EXPECT_TRUE(contains(text, "--against"));
  const auto refuse = [&](std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), {"errors", "a.msh"});
    const auto outcome = temper(arguments);
    EXPECT_NE(outcome.exit, 0);
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
  };
  refuse({"--dirichlet", "sea=1"},
         "expected the number or name of lines on the boundary before '=', found 'sea'; names are river, lake");
  refuse({"--dirichlet", "9=1"}, "no boundary edge has the tag '9'");
  refuse({"--dirichlet", "river"}, "expected NAME=NUMBER, found 'river'");
  refuse({"--source", "1"}, "--source needs --dirichlet");
  refuse({"--dirichlet", "river=1", "--source", "rain"}, "expected a number or the name of point data, found 'rain'");
  refuse({"--dirichlet", "river=1", "--fields", "all"}, "--fields is about manufactured solutions");
}

TEST_F(Errors, ComparesWithAnotherMesh) {
  temper_ok({"example", "annulus", "-o", "ring.vtu"});
  temper_ok({"optimize", "ring.vtu", "-o", "better.vtu", "--set", "max_sweeps=5", "--quiet"});
  const auto json = nlohmann::json::parse(temper_ok({"errors", "better.vtu", "--against", "ring.vtu", "--json"}).out);
  const auto& ratios = json["against"]["ratios"]["fields"];
  const auto& before = json["against"]["report"]["errors"]["fields"];
  ASSERT_EQ(ratios.size(), 9u);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const double expected =
        json["errors"]["fields"][i]["flux"]["l2"].get<double>() / before[i]["flux"]["l2"].get<double>();
    EXPECT_NEAR(ratios[i]["flux"]["l2"], expected, 1e-12 * expected);
  }
  const Outcome same = temper_ok({"errors", "ring.vtu", "--against", "ring.vtu", "--fields", "chosen"});
  EXPECT_TRUE(contains(same.out, "over the errors of ring.vtu:"));
  EXPECT_EQ(same.err, "");
  make_input();
  const Outcome other = temper_ok({"errors", "ring.vtu", "--against", "in.vtu"});
  EXPECT_TRUE(contains(other.err, "ring.vtu and in.vtu do not have the same bounding box"));
}

TEST_F(Errors, IsPartOfAnOptimizationWhenAskedFor) {
  make_input();
  const std::string text = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--set", "objective=accuracy",
                                      "--measure-errors", "--write", "r.json"})
                               .out;
  EXPECT_TRUE(contains(text, "mean relative error"));
  const auto report = nlohmann::json::parse(read("r.json"));
  const auto against = nlohmann::json::parse(temper_ok({"errors", "out.vtu", "--against", "in.vtu", "--json"}).out);
  EXPECT_EQ(report["errors"]["before"]["errors"], against["against"]["report"]["errors"]);
  EXPECT_EQ(report["errors"]["after"]["errors"], against["errors"]);
  for (const char* when : {"before", "after"}) {
    const auto& mean = report["errors"][when]["errors"]["mean"]["all"];
    for (const char* key : {"star0", "star1", "star2", "poisson", "flux"}) {
      for (const char* norm : {"l2", "max"}) {
        char number[32];
        std::snprintf(number, sizeof number, " %.3e", mean[key][norm].get<double>());
        EXPECT_TRUE(contains(text, number)) << when << " " << key;
      }
    }
  }
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "--quiet"});
  EXPECT_FALSE(nlohmann::json::parse(read("r.json")).contains("errors"));
}

TEST_F(Errors, OfARunThatItsTimeLimitEndsAreNotMeasured) {
  make_input();
  const Outcome run =
      temper({"optimize", "in.vtu", "-o", "out.vtu", "--time-limit", "1e-9", "--measure-errors", "--write", "r.json"});
  EXPECT_EQ(run.exit, 4);
  EXPECT_TRUE(contains(run.err, "nothing was measured. Next: temper errors out.vtu --against in.vtu")) << run.err;
  EXPECT_FALSE(contains(run.out, "mean relative error"));
  const auto report = nlohmann::json::parse(read("r.json"));
  EXPECT_FALSE(report.contains("errors"));
  EXPECT_EQ(report["warnings"].size(), 1u);
}

// On even rings the errors of the Poisson problem cancel, and any change makes them larger.
TEST_F(Errors, OfAnOptimizationOnlyMeasures) {
  temper_ok({"example", "annulus", "--jitter", "0", "-o", "in.vtu"});
  for (const auto& [out, more] :
       {std::pair("plain.off", std::vector<std::string>()),
        std::pair("measured.off", std::vector<std::string>{"--measure-errors", "--write", "r.json"})}) {
    std::vector<std::string> words = {"optimize", "in.vtu", "-o", out, "--set", "objective=accuracy", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    temper_ok(words);
  }
  EXPECT_EQ(read("measured.off"), read("plain.off"));
  const auto report = nlohmann::json::parse(read("r.json"));
  EXPECT_NE(report["errors"]["after"]["errors"], report["errors"]["before"]["errors"]);
}

TEST_F(Errors, MeasuresOrders) {
  temper_ok({"example", "sheared-grid", "--nx", "6", "--ny", "6", "-o", "in.vtu"});
  const std::string text =
      temper_ok({"errors", "in.vtu", "--refine", "2", "--fields", "bump,crossed", "--details"}).out;
  EXPECT_TRUE(contains(text, "level 2"));
  EXPECT_TRUE(contains(text, "order, L2"));
  const auto json =
      nlohmann::json::parse(temper_ok({"errors", "in.vtu", "--refine", "2", "--fields", "bump,exact", "--json"}).out);
  ASSERT_EQ(json["levels"].size(), 3u);
  EXPECT_EQ(json["levels"][2]["triangles"], 16 * json["triangles"].get<int>());
  EXPECT_NEAR(json["orders"]["fields"][0]["poisson"]["l2"].get<double>(), 2, 0.3);
  EXPECT_TRUE(json["orders"]["fields"][1]["poisson"]["l2"].is_null());  // linear: nothing but rounding
}

TEST_F(Errors, WritesTheErrorOfEachEdge) {
  make_input();
  const auto json = nlohmann::json::parse(temper_ok({"errors", "in.vtu", "--edges", "edges.csv", "--json"}).out);
  std::istringstream csv(read("edges.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "from,to,star1,error");
  const Mesh mesh = io::make_mesh(*io::read("in.vtu"))->mesh;
  const auto report = measure_errors(mesh, {.fields = {"all"}, .local = true});
  ASSERT_TRUE(report);
  const std::vector<double>& errors = report->local[1];
  ASSERT_EQ(errors.size(), json["edges"].get<std::size_t>());
  for (std::size_t e = 0; e < errors.size(); ++e) {
    ASSERT_TRUE(std::getline(csv, line)) << "edge " << e;
    EXPECT_GT(errors[e], 0) << "edge " << e;
    EXPECT_NEAR(std::stod(line.substr(line.rfind(',') + 1)), errors[e], 1e-12 * errors[e]) << line;
  }
  EXPECT_FALSE(std::getline(csv, line)) << line;
}

TEST_F(Errors, BadUsageIsRefusedAndNothingIsWritten) {
  make_input();
  const Outcome field = temper({"errors", "in.vtu", "--fields", "chosen,sine", "--edges", "edges.csv"});
  EXPECT_EQ(field.exit, 2);
  EXPECT_TRUE(contains(field.err, "--fields: no field 'sine'; the fields are all, chosen, held-back, exact, product"));
  for (const std::string space : {"on the sphere", "in a periodic plane", "of tetrahedra and curved surfaces"})
    EXPECT_TRUE(contains(field.err, "; the fields " + space + " are all, chosen, held-back, ")) << space;
  const Outcome both = temper({"errors", "in.vtu", "--fields", "sine;cosine"});
  EXPECT_TRUE(contains(both.err, "no field 'sine;cosine'; the fields are all")) << both.err;
  EXPECT_EQ(std::count(both.err.begin(), both.err.end(), ';'), 5) << both.err;
  EXPECT_EQ(temper({"errors"}).exit, 2);
  EXPECT_EQ(temper({"errors", "in.vtu", "--fields", ""}).exit, 2);
  EXPECT_EQ(temper({"errors", "in.vtu", "--refine", "-1"}).exit, 2);
  EXPECT_EQ(temper({"errors", "in.vtu", "--refine", "30", "--edges", "edges.csv"}).exit, 2);
  EXPECT_EQ(temper({"errors", "in.vtu", "--edges", "in.vtu"}).exit, 2);
  EXPECT_EQ(temper({"errors", "nosuch.vtu"}).exit, 1);
  EXPECT_EQ(temper({"errors", "in.vtu", "--against", "nosuch.vtu"}).exit, 1);
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
}

}  // namespace
}  // namespace temper::test
