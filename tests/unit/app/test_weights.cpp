// temper weights: every mode, what it writes, and that nothing else changes.
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Weights : public Workshop {
 protected:
  static void make_infeasible() { temper_ok({"example", "sparse-horseshoe", "-o", "in.vtu"}); }
  /// A square around a point near one side: bad, and weights cure it.
  static void make_feasible() {
    write("in.mesh",
          "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n0 0 7\n1 0 0\n1 1 0\n0 1 0\n0.5 0.3 0\n"
          "Triangles\n4\n1 2 5 1\n2 3 5 1\n3 4 5 2\n4 1 5 2\nEnd\n");
  }
};

TEST_F(Weights, InfeasibleIsSaidProvedAndWritten) {
  make_infeasible();
  const Outcome outcome = temper({"weights", "in.vtu", "--mode", "feasible", "--json", "--certificate", "why.json"});
  EXPECT_EQ(outcome.exit, 6) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["feasible"], false);
  EXPECT_EQ(json["verdict"], "infeasible");
  EXPECT_NEAR(json["margin"].get<double>(), -8.0 / 135, 1e-9);
  EXPECT_EQ(json["certificate"], read_json("why.json"));
  EXPECT_EQ(temper_ok({"weights", "in.vtu", "--check-certificate", "why.json"}).err, "");
  EXPECT_EQ(temper_ok({"weights", "in.vtu", "--check-certificate", "why.json", "--json"}).out,
            "{\"proves\": true, \"check\": \"proves\"}\n");
}

TEST_F(Weights, WithoutAnswerNothingButTheProofIsWritten) {
  make_infeasible();
  for (const char* mode : {"minimal", "barrier"}) {
    const Outcome outcome = temper({"weights", "in.vtu", "-o", "out.vtu", "--mode", mode});
    EXPECT_EQ(outcome.exit, 6);
    EXPECT_TRUE(contains(outcome.out, "infeasible: no weights"));
    EXPECT_TRUE(contains(outcome.out, "h over edge "));
    EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
  }
}

TEST_F(Weights, AChangedCertificateIsRefused) {
  make_infeasible();
  temper({"weights", "in.vtu", "--mode", "feasible", "--certificate", "why.json"});
  auto json = read_json("why.json");
  ASSERT_GT(json["terms"].size(), 1u);
  for (std::size_t i = 0; i < json["terms"].size(); ++i) {
    auto changed = json;
    changed["terms"][i]["multiplier"] = 100 * json["terms"][i]["multiplier"].get<double>();
    write("changed.json", changed.dump());
    const Outcome outcome = temper({"weights", "in.vtu", "--check-certificate", "changed.json"});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_TRUE(contains(outcome.err, "proves_nothing"));
  }
}

TEST_F(Weights, CertificatesThatNestWithoutEndOrHoldNoNumberAreRefused) {
  make_infeasible();
  const std::string deep(200000, '[');
  for (const std::string& text :
       {"{\"temper_certificate\": 1, \"margin\": " + deep, "{\"temper_certificate\": " + deep}) {
    write("deep.json", text);
    const Outcome outcome = temper({"weights", "in.vtu", "--check-certificate", "deep.json"});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_TRUE(contains(outcome.err, "deep.json: nested more than 16 deep")) << outcome.err;
  }
  write("huge.json", "{\"temper_certificate\": 1, \"margin\": 1e999, \"terms\": []}");
  const Outcome outcome = temper({"weights", "in.vtu", "--check-certificate", "huge.json"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "huge.json: holds a number beyond what a double can hold")) << outcome.err;
}

TEST_F(Weights, CertificatesThatAreNoneAreNamed) {
  make_infeasible();
  const std::vector<std::pair<std::string, std::string>> texts = {
      {"{", "not JSON"},
      {"[]", "no \"temper_certificate\""},
      {"{\"temper_certificate\": 2}", "expected version 1"},
      {R"({"temper_certificate": 1, "margin": 0})", "there is no \"terms\""},
      {R"({"temper_certificate": 1, "margin": 0, "terms": [{"kind": "split", "edge": [0, 99], "multiplier": 1}]})",
       "term 0: expected a point, 0 to 4, found 99"},
      {R"({"temper_certificate": 1, "margin": 0, "terms": [{"kind": "area", "edge": [0, 1], "multiplier": 1}]})",
       "found \"area\""},
      {R"({"temper_certificate": 1, "margin": 0, "terms": [{"kind": "split", "edge": [0, 1], "multiplier": "x"}]})",
       "expected \"multiplier\" to be a number"}};
  for (const auto& [text, expected] : texts) {
    write("bad.json", text);
    const Outcome outcome = temper({"weights", "in.vtu", "--check-certificate", "bad.json"});
    EXPECT_EQ(outcome.exit, 1) << text;
    EXPECT_TRUE(contains(outcome.err, "bad.json: "));
    EXPECT_TRUE(contains(outcome.err, expected));
  }
  for (const char* path : {".", "nosuch.json"}) {
    const Outcome outcome = temper({"weights", "in.vtu", "--check-certificate", path});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_TRUE(contains(outcome.err, "cannot be read"));
  }
}

TEST_F(Weights, OnlyWeightsChangeInEveryMode) {
  make_feasible();
  for (const char* mode : {"feasible", "minimal", "elastic", "barrier"}) {
    temper_ok({"weights", "in.mesh", "-o", "out.mesh", "--mode", mode});
    temper_ok({"check", "out.mesh", "--require", "outside=0,not_crossed=0,nonregular=0"});
    const auto before = io::read("in.mesh"), after = io::read("out.mesh");
    ASSERT_TRUE(before && after);
    EXPECT_EQ(before->points, after->points) << mode;
    EXPECT_EQ(before->triangles, after->triangles) << mode;
    EXPECT_EQ(before->regions, after->regions) << mode;
    EXPECT_NE(before->weights, after->weights) << mode;
  }
}

TEST_F(Weights, TheMarginIsKeptOrSaidToBeTooMuch) {
  make_feasible();
  temper_ok({"weights", "in.mesh", "-o", "out.vtu", "--margin", "0.02"});
  temper_ok({"check", "out.vtu", "--require", "min_h>=0.0199999,min_d>=0.0199999"});
  const Outcome outcome = temper({"weights", "in.mesh", "-o", "much.vtu", "--margin", "0.4"});
  EXPECT_EQ(outcome.exit, 6);
  EXPECT_TRUE(contains(outcome.out, "a margin of 0.4 cannot be had"));
  EXPECT_FALSE(exists("much.vtu"));
}

TEST_F(Weights, ElasticNamesWhatGivesWay) {
  make_infeasible();
  const auto json =
      nlohmann::json::parse(temper_ok({"weights", "in.vtu", "-o", "out.vtu", "--mode", "elastic", "--json"}).out);
  EXPECT_EQ(json["feasible"], false);
  ASSERT_GT(json["violations"].size(), 0u);
  EXPECT_TRUE(json["violations"][0].contains("shortfall"));
  EXPECT_TRUE(exists("out.vtu"));
}

TEST_F(Weights, BadUsageIsRefused) {
  make_infeasible();
  const std::vector<std::vector<std::string>> mistakes = {
      {"in.vtu"},
      {"in.vtu", "-o", "out.vtu", "--margin", "0.5"},
      {"in.vtu", "-o", "out.vtu", "--margin", "0"},
      {"in.vtu", "-o", "out.vtu", "--energy", "BP"},
      {"in.vtu", "-o", "out.vtu", "--mode", "best"},
      {"in.vtu", "-o", "out.vtu", "--check-certificate", "why.json"}};
  for (std::vector<std::string> arguments : mistakes) {
    arguments.insert(arguments.begin(), "weights");
    EXPECT_EQ(temper(arguments).exit, 2) << arguments.back();
  }
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
}

}  // namespace
}  // namespace temper::test
