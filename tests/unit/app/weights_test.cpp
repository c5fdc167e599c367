// temper weights: every mode, what it writes, and that nothing else changes.
#include <set>

#include "support/tet_files.hpp"
#include "temper/feasibility.hpp"
#include "temper/io.hpp"
#include "temper/regularity.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Weights : public Workshop {
 protected:
  static void make_infeasible() { temper_ok({"example", "sparse-horseshoe", "-o", "in.vtu"}); }
  /// Two nested triangles, the ring between them cut like a pinwheel: no weights make all of its edges regular.
  static void make_pinwheel() {
    write("pinwheel.mesh",
          "MeshVersionFormatted 2\nDimension 2\nVertices\n6\n4 0 0\n-2 3.5 0\n-2 -3.5 0\n1 0.1 0\n-0.6 0.8 0\n"
          "-0.4 -0.9 0\nTriangles\n7\n4 5 6 1\n1 2 5 1\n1 5 4 1\n2 3 6 1\n2 6 5 1\n3 1 4 1\n3 4 6 1\nEnd\n");
  }
  /// A square around a point near one side: bad, and weights cure it.
  static void make_feasible() {
    write("in.mesh",
          "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n0 0 7\n1 0 0\n1 1 0\n0 1 0\n0.5 0.3 0\n"
          "Triangles\n4\n1 2 5 1\n2 3 5 1\n3 4 5 2\n4 1 5 2\nEnd\n");
  }
};

TEST_F(Weights, InfeasibleIsSaidProvedAndWritten) {
  make_infeasible();
  const Outcome outcome = temper({"weights", "in.vtu", "--mode", "margin", "--json", "--certificate", "why.json"});
  EXPECT_EQ(outcome.exit, 6) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["feasible"], false);
  EXPECT_EQ(json["verdict"], "infeasible");
  EXPECT_NEAR(json["margin"].get<double>(), -8.0 / 135, 1e-9);
  EXPECT_EQ(json["certificate"], read_json("why.json"));
  EXPECT_EQ(temper_ok({"weights", "in.vtu", "--check-certificate", "why.json"}).err, "");
  EXPECT_EQ(temper_ok({"weights", "in.vtu", "--check-certificate", "why.json", "--json"}).out,
            "{\"schema\": 1, \"proves\": true, \"check\": \"proves\"}\n");
}

TEST_F(Weights, WithoutAnswerNothingButTheProofIsWritten) {
  make_infeasible();
  for (const char* mode : {"change", "center", "accuracy"}) {
    const Outcome outcome = temper({"weights", "in.vtu", "-o", "out.vtu", "--mode", mode});
    EXPECT_EQ(outcome.exit, 6);
    EXPECT_TRUE(contains(outcome.out, "infeasible: no weights"));
    EXPECT_TRUE(contains(outcome.out, "h over edge "));
    EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
  }
}

TEST_F(Weights, AChangedCertificateIsRefused) {
  make_infeasible();
  temper({"weights", "in.vtu", "--mode", "margin", "--certificate", "why.json"});
  auto json = read_json("why.json");
  ASSERT_GT(json["terms"].size(), 1u);
  for (std::size_t i = 0; i < json["terms"].size(); ++i) {
    auto changed = json;
    changed["terms"][i]["multiplier"] = 100 * json["terms"][i]["multiplier"].get<double>();
    write("changed.json", changed.dump());
    const Outcome outcome = temper({"weights", "in.vtu", "--check-certificate", "changed.json"});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_TRUE(contains(outcome.err, "the sum of its terms is no contradiction, or a case is missing"));
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
      {R"({"temper_certificate": 1, "margin": 0, "terms": [{"kind": "crossing", "edge": [0, 99], "multiplier": 1}]})",
       "term 0: expected a point, 0 to 4, found 99"},
      {R"({"temper_certificate": 1, "margin": 0, "terms": [{"kind": "area", "edge": [0, 1], "multiplier": 1}]})",
       "found \"area\""},
      {R"({"temper_certificate": 1, "margin": 0, "terms": [{"kind": "crossing", "edge": [0, 1], "multiplier": "x"}]})",
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
  for (const char* mode : {"margin", "change", "elastic", "center", "accuracy"}) {
    temper_ok({"weights", "in.mesh", "-o", "out.mesh", "--mode", mode});
    temper_ok({"check", "out.mesh", "--require", "outside=0,not_crossed=0,nonregular=0"});
    const auto before = io::read("in.mesh"), after = io::read("out.mesh");
    ASSERT_TRUE(before && after);
    EXPECT_EQ(before->points, after->points) << mode;
    EXPECT_EQ(before->triangles.corners, after->triangles.corners) << mode;
    EXPECT_EQ(before->triangles.tags, after->triangles.tags) << mode;
    EXPECT_NE(before->weights, after->weights) << mode;
  }
}

TEST_F(Weights, BestWeightsHaveAGapInTheReportAndTheirProofInAFile) {
  make_feasible();
  for (const char* mode : {"center", "accuracy"}) {
    const Outcome outcome =
        temper_ok({"weights", "in.mesh", "-o", "out.vtu", "--mode", mode, "--certificate", "best.json", "--json"});
    const auto json = nlohmann::json::parse(outcome.out), proof = read_json("best.json");
    EXPECT_LE(json["optimality"]["relative_gap"].get<double>(), 1e-8);
    EXPECT_EQ(json["optimality"]["objective"], proof["objective"]);
    EXPECT_EQ(json["optimality"]["gap"], proof["gap"]);
    EXPECT_EQ(json["certificate"], nullptr);
    EXPECT_EQ(proof["goal"], mode);
    EXPECT_EQ(proof.contains("offsets"), std::string(mode) == "accuracy");
    const Outcome text = temper_ok({"weights", "in.mesh", "-o", "out.vtu", "--mode", mode});
    EXPECT_TRUE(contains(text.out, "duality gap ")) << text.out;
    const Outcome check = temper({"weights", "in.mesh", "--check-certificate", "best.json"});
    EXPECT_EQ(check.exit, 1);
    EXPECT_TRUE(contains(check.err, "bench/check_best.py")) << check.err;
  }
  EXPECT_EQ(nlohmann::json::parse(temper_ok({"weights", "in.mesh", "-o", "out.vtu", "--json"}).out)["optimality"],
            nullptr);
}

TEST_F(Weights, TheSchemeChangesTheBestWeights) {
  make_feasible();
  std::set<std::vector<double>> weights;
  for (const char* scheme : {"any", "vertex", "cell"}) {
    temper_ok({"weights", "in.mesh", "-o", "out.mesh", "--mode", "accuracy", "--for", scheme});
    weights.insert(io::read("out.mesh")->weights);
  }
  EXPECT_EQ(weights.size(), 3u);
}

TEST_F(Weights, TheMarginIsKeptOrSaidToBeTooMuch) {
  make_feasible();
  temper_ok({"weights", "in.mesh", "-o", "out.vtu", "--margin", "0.02"});
  temper_ok({"check", "out.vtu", "--require", "min_h>=0.0199999,min_d>=0.0199999"});
  const Outcome outcome = temper({"weights", "in.mesh", "-o", "much.vtu", "--margin", "0.4"});
  EXPECT_EQ(outcome.exit, 6);
  EXPECT_TRUE(contains(outcome.out, "no weights give a margin of 0.4"));
  EXPECT_TRUE(outcome.out.ends_with("Next: a --margin of at most the best margin, or --mode elastic\n")) << outcome.out;
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

TEST_F(Weights, EveryConditionHasAVerdictAndAProofThatIsReadAgain) {
  temper_ok({"example", "horseshoe", "-o", "dense.vtu"});
  make_pinwheel();
  make_feasible();
  for (const ConstraintsInfo& row : constraints_table()) {
    std::string name(row.name);
    std::replace(name.begin(), name.end(), '_', '-');
    const bool heights_alone =
        row.constraints == Constraints::well_centered || row.constraints == Constraints::heights_only;
    const std::string bad = heights_alone ? "dense.vtu" : "pinwheel.mesh";
    const Outcome none = temper({"weights", bad, "-o", "none.vtu", "--constraints", name, "--certificate", "why.json"});
    EXPECT_EQ(none.exit, 6) << none.err;
    EXPECT_TRUE(contains(none.out, std::string("infeasible: ") + std::string(row.failure))) << none.out;
    EXPECT_FALSE(exists("none.vtu"));
    EXPECT_EQ(read_json("why.json")["constraints"], row.name);
    EXPECT_TRUE(contains(temper_ok({"weights", bad, "--check-certificate", "why.json"}).out, std::string(row.failure)));
    const Outcome some = temper_ok({"weights", "in.mesh", "-o", "out.vtu", "--constraints", name});
    EXPECT_TRUE(contains(some.out, std::string("feasible: ") + std::string(row.success))) << some.out;
    const auto json = nlohmann::json::parse(
        temper_ok({"weights", bad, "-o", "out.vtu", "--constraints", name, "--mode", "elastic", "--json"}).out);
    EXPECT_EQ(json["constraints"], row.name);
    EXPECT_GT(json["violations"].size(), 0u);
  }
}

TEST_F(Weights, PrescribedEdgesAreThoseOfTheFileOrTheLines) {
  make_pinwheel();
  const auto find = [](const std::string& edges) {
    return temper(
        {"weights", "pinwheel.mesh", "-o", "out.vtu", "--constraints", "regular", "--edges", edges, "--json"});
  };
  const Outcome all = find("all");
  EXPECT_EQ(all.exit, 6);
  EXPECT_EQ(nlohmann::json::parse(all.out)["edges"], 9);
  write("edges.txt", "# two of the three diagonals, and an edge of the boundary\n1 5\n\n6 2  # either way\n1 2\n");
  const Outcome two = find("edges.txt");
  EXPECT_EQ(two.exit, 0) << two.out;
  EXPECT_EQ(nlohmann::json::parse(two.out)["edges"], 2);
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {"1 5\n7 2\n", "edges.txt:2: pinwheel.mesh has no vertex 7 in a triangle"},
           {"# none\n1 6\n", "edges.txt:2: pinwheel.mesh has no edge 1-6"},
           {"1 1\n", "edges.txt:1: pinwheel.mesh has no edge 1-1"},
           {"1 5 2\n", "edges.txt:1: expected two vertices, found 3 words"},
           {"1\n", "edges.txt:1: expected two vertices, found 1 words"},
           {"x y\n", "edges.txt:1: pinwheel.mesh has no vertex x in a triangle"},
           {"# nothing\n", "edges.txt: expected edges, found none"},
           {"1 2\n2 3\n", "none of the edges that --edges edges.txt names is inside the mesh"}}) {
    write("edges.txt", text);
    const Outcome outcome = find("edges.txt");
    EXPECT_EQ(outcome.exit, 1) << text;
    EXPECT_TRUE(contains(outcome.err, expected)) << outcome.err;
  }
  EXPECT_TRUE(contains(find("lines").err, "none of the edges that --edges lines names is inside the mesh"));
  EXPECT_TRUE(contains(find("nosuch.txt").err, "nosuch.txt: cannot be read"));
  EXPECT_TRUE(contains(find(".").err, "cannot be read"));
  make_feasible();  // two regions
  const auto json = nlohmann::json::parse(
      temper_ok({"weights", "in.mesh", "-o", "out.vtu", "--constraints", "regular", "--edges", "lines", "--json"}).out);
  EXPECT_EQ(json["edges"], 2);
}

TEST_F(Weights, TheSearchOverConnectivitiesWritesARegularMeshWithOtherEdges) {
  temper_ok({"example", "random", "--vertices", "40", "-o", "in.vtu"});
  const std::vector<std::string> heights = {"weights",      "in.vtu", "-o",     "out.vtu", "--constraints",
                                            "heights-only", "--mode", "margin", "--json"};
  EXPECT_EQ(temper(heights).exit, 6);
  EXPECT_FALSE(exists("out.vtu"));
  std::vector<std::string> searching = heights;
  searching.insert(searching.end(), {"--connectivity", "search"});
  const auto json = nlohmann::json::parse(temper_ok(searching).out);
  EXPECT_EQ(json["search"]["end"], "no_better_neighbor");
  EXPECT_LT(json["search"]["before"].get<double>(), 0);
  EXPECT_GT(json["search"]["margin"].get<double>(), 0);
  EXPECT_EQ(json["search"]["steps"].back()["margin"], json["search"]["margin"]);
  EXPECT_NEAR(json["margin"].get<double>(), json["search"]["margin"].get<double>(), 1e-7);
  temper_ok({"check", "out.vtu", "--require", "outside=0,nonregular=0"});
  const auto before = io::read("in.vtu"), after = io::read("out.vtu");
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->points, after->points);
  EXPECT_NE(before->triangles.corners, after->triangles.corners);
  searching.insert(searching.end(), {"--programs", "2"});
  EXPECT_EQ(nlohmann::json::parse(temper(searching).out)["search"]["end"], "limit");
}

TEST_F(Weights, AProofOverConnectivitiesIsWrittenAndCheckedAndRefusedOnceChanged) {
  make_infeasible();
  const Outcome outcome = temper(
      {"weights", "in.vtu", "--mode", "margin", "--connectivity", "search", "--json", "--certificate", "why.json"});
  EXPECT_EQ(outcome.exit, 6) << outcome.err;
  const auto search = nlohmann::json::parse(outcome.out)["search"];
  EXPECT_EQ(search["end"], "none_exists");
  EXPECT_EQ(search["bound"], 0);
  auto proof = read_json("why.json");
  EXPECT_EQ(search["lemmas"], proof["lemmas"].size());
  const Outcome checked = temper_ok({"weights", "in.vtu", "--check-certificate", "why.json"});
  EXPECT_TRUE(contains(checked.out, "with any connectivity")) << checked.out;
  proof["lemmas"].back()["terms"].erase(0);
  write("changed.json", proof.dump());
  EXPECT_EQ(temper({"weights", "in.vtu", "--check-certificate", "changed.json"}).exit, 1);
  proof["lemmas"].back()["edges"] = "all";
  write("changed.json", proof.dump());
  const Outcome refused = temper({"weights", "in.vtu", "--check-certificate", "changed.json"});
  EXPECT_EQ(refused.exit, 1);
  EXPECT_TRUE(contains(refused.err, "changed.json: lemma 0: expected \"edges\" to be an array")) << refused.err;
}

TEST_F(Weights, ATimeLimitEndsTheSearchOverConnectivities) {
  temper_ok({"example", "random", "--vertices", "200", "-o", "in.vtu"});
  const Outcome outcome = temper({"weights", "in.vtu", "--mode", "margin", "--constraints", "heights-only",
                                  "--connectivity", "search", "--time-limit", "0.2", "--json"});
  EXPECT_EQ(outcome.exit, 4) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["search"]["end"], "stopped");
  const Outcome quiet = temper({"weights", "in.vtu", "-o", "out.vtu", "--constraints", "heights-only", "--connectivity",
                                "search", "--time-limit", "0.2", "--quiet"});
  EXPECT_EQ(quiet.exit, 4);
  EXPECT_FALSE(exists("out.vtu"));
}

TEST_F(Weights, BadUsageIsRefused) {
  make_infeasible();
  const std::vector<std::vector<std::string>> mistakes = {
      {"in.vtu"},
      {"in.vtu", "-o", "out.vtu", "--margin", "0.5"},
      {"in.vtu", "-o", "out.vtu", "--margin", "0"},
      {"in.vtu", "-o", "out.vtu", "--mode", "center", "--for", "cell"},
      {"in.vtu", "-o", "out.vtu", "--mode", "center", "--margin", "0.02"},
      {"in.vtu", "-o", "out.vtu", "--mode", "best"},
      {"in.vtu", "-o", "out.vtu", "--check-certificate", "why.json"},
      {"in.vtu", "-o", "out.vtu", "--constraints", "both"},
      {"in.vtu", "-o", "out.vtu", "--edges", "lines"},
      {"in.vtu", "-o", "out.vtu", "--programs", "10"},
      {"in.vtu", "-o", "out.vtu", "--connectivity", "search", "--programs", "0"},
      {"in.vtu", "-o", "out.vtu", "--time-limit", "-1"},
      {"in.vtu", "-o", "out.vtu", "--connectivity", "search", "--constraints", "regular"},
      {"in.vtu", "--check-certificate", "why.json", "--constraints", "heights-only"}};
  for (std::vector<std::string> arguments : mistakes) {
    arguments.insert(arguments.begin(), "weights");
    EXPECT_EQ(temper(arguments).exit, 2) << arguments.back();
  }
  const Outcome outcome = temper({"weights", "in.vtu", "-o", "out.vtu", "--programs", "10"});
  EXPECT_TRUE(contains(outcome.err, "--programs needs --connectivity search. Next: add it, or")) << outcome.err;
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
}

TEST_F(Weights, AreNotSoughtWithQuadrilaterals) {
  write("m.gr3", "one\n1 4\n1 0 0 1\n2 900 0 1\n3 900 900 1\n4 0 900 1\n1 4 1 2 3 4\n");
  const Outcome outcome = temper({"weights", "m.gr3", "-o", "out.vtu"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "the mesh has quadrilaterals, whose corners keep their weights")) << outcome.err;
  EXPECT_FALSE(exists("out.vtu"));
}

TEST_F(Weights, AreSetToZero) {
  temper_ok({"example", "random", "--vertices", "60", "-o", "in.vtu"});
  temper_ok({"optimize", "in.vtu", "-o", "heavy.vtu", "--effort", "quick", "--quiet"});
  const Outcome outcome = temper_ok({"weights", "heavy.vtu", "-o", "plain.vtu", "--zero"});
  EXPECT_TRUE(contains(outcome.out, "set to zero, ")) << outcome.out;
  const Mesh plain = io::make_mesh(*io::read("plain.vtu"))->mesh, heavy = io::make_mesh(*io::read("heavy.vtu"))->mesh;
  std::size_t weights = 0;
  for (const VertexId v : plain.vertices()) {
    EXPECT_EQ(plain.weight(v), 0);
    EXPECT_EQ(plain.position(v), heavy.position(v));
    weights += heavy.weight(v) != 0 ? 1 : 0;
  }
  EXPECT_GT(weights, 10u);
  EXPECT_EQ(count_non_regular_edges(plain, false), 0u);
  EXPECT_EQ(temper({"optimize", "plain.vtu", "-o", "o.vtu", "--for", "mpas", "--effort", "quick", "--quiet"}).err, "");
  EXPECT_TRUE(contains(temper({"optimize", "heavy.vtu", "-o", "o.vtu", "--for", "fem", "--effort", "quick"}).err,
                       "temper weights heavy.vtu --zero"));
  EXPECT_EQ(temper({"weights", "heavy.vtu", "-o", "o.vtu", "--zero", "--mode", "elastic"}).exit, 2);
}

class TetWeightsVerb : public Workshop {
 protected:
  /// Two tetrahedra below and above a triangle. The lower apex is inside the sphere of the upper tetrahedron, unless
  /// weights cure it.
  static void make_curable() {
    write("in.mesh",
          "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n1 0 0 7\n-0.5 0.9 0 0\n-0.5 -0.9 0 0\n0 0 0.4 0\n0 0 -0.4 "
          "0\n"
          "Tetrahedra\n2\n1 2 3 4 1\n1 3 2 5 2\nEnd\n");
  }
  /// The cone over a pinwheel, above: no weights make all of its faces regular.
  static void make_pinwheel() {
    write("pinwheel.mesh",
          "MeshVersionFormatted 2\nDimension 3\nVertices\n7\n4 0 0 0\n-2 3.5 0 0\n-2 -3.5 0 0\n1 0.1 0 0\n-0.6 0.8 0 "
          "0\n-0.4 -0.9 0 0\n0.5 0.25 3 0\nTetrahedra\n7\n4 5 6 7 1\n1 2 5 7 1\n1 5 4 7 1\n2 3 6 7 1\n2 6 5 7 1\n"
          "3 1 4 7 1\n3 4 6 7 1\nEnd\n");
  }
};

TEST_F(TetWeightsVerb, RegularWeightsAreFoundAndNothingElseChanges) {
  make_curable();
  EXPECT_NE(temper({"check", "in.mesh", "--require", "nonregular=0"}).exit, 0);
  for (const char* mode : {"margin", "change", "elastic", "center", "accuracy"}) {
    for (const char* out : {"out.vtu", "out.mesh"}) {
      temper_ok({"weights", "in.mesh", "-o", out, "--mode", mode, "--constraints", "regular"});
      temper_ok({"check", out, "--require", "nonregular=0"});
      const auto before = io::read("in.mesh"), after = io::read(out);
      ASSERT_TRUE(before && after);
      const auto &a = *before, &b = *after;
      EXPECT_EQ(test::places_of(a), test::places_of(b)) << mode;
      EXPECT_EQ(a.tetrahedra.corners, b.tetrahedra.corners) << mode;
      EXPECT_EQ(a.tetrahedra.tags, b.tetrahedra.tags) << mode;
      EXPECT_NE(a.weights, b.weights) << mode;
    }
  }
}

TEST_F(TetWeightsVerb, InfeasibleIsSaidProvedAndChecked) {
  make_pinwheel();
  const Outcome outcome = temper({"weights", "pinwheel.mesh", "-o", "out.vtu", "--constraints", "regular"});
  EXPECT_EQ(outcome.exit, 6) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "infeasible: no weights make every face regular")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "dual length of face ")) << outcome.out;
  EXPECT_EQ(names(), std::vector<std::string>{"pinwheel.mesh"});
  const auto json = nlohmann::json::parse(temper({"weights", "pinwheel.mesh", "--mode", "margin", "--constraints",
                                                  "regular", "--json", "--certificate", "why.json"})
                                              .out);
  EXPECT_EQ(json["verdict"], "infeasible");
  EXPECT_EQ(json["certificate"], read_json("why.json"));
  EXPECT_TRUE(contains(temper_ok({"weights", "pinwheel.mesh", "--check-certificate", "why.json"}).out, "proves it"));
  auto changed = read_json("why.json");
  changed["terms"][0]["multiplier"] = 2 * changed["terms"][0]["multiplier"].get<double>();
  write("changed.json", changed.dump());
  const Outcome refused = temper({"weights", "pinwheel.mesh", "--check-certificate", "changed.json"});
  EXPECT_EQ(refused.exit, 1);
  EXPECT_TRUE(contains(refused.err, "the sum of its terms is no contradiction, or a case is missing")) << refused.err;
}

TEST_F(TetWeightsVerb, CertificatesOfAllConstraintsAreReadAsTheyWereWritten) {
  make_curable();
  for (const char* constraints : {"well-centered", "completely-well-centered"}) {
    const Outcome outcome = temper({"weights", "in.mesh", "-o", "out.vtu", "--margin", "0.45", "--constraints",
                                    constraints, "--certificate", "why.json"});
    EXPECT_EQ(outcome.exit, 6) << constraints << outcome.out;
    temper_ok({"weights", "in.mesh", "--check-certificate", "why.json"});
  }
}

TEST_F(TetWeightsVerb, ElasticListsTheViolations) {
  make_pinwheel();
  const auto json = nlohmann::json::parse(temper_ok({"weights", "pinwheel.mesh", "-o", "out.vtu", "--mode", "elastic",
                                                     "--constraints", "regular", "--json"})
                                              .out);
  ASSERT_FALSE(json["violations"].empty());
  for (const auto& violation : json["violations"]) {
    EXPECT_EQ(violation["kind"], "dual_of_face");
    EXPECT_EQ(violation["face"].size(), 3U);
    EXPECT_NE(violation["vertex"], violation["across"]);
  }
}

TEST_F(TetWeightsVerb, OptionsOfTheOtherKindAreRefusedByName) {
  make_curable();
  const std::vector<std::vector<std::string>> refused = {{"--zero"},
                                                         {"--flat"},
                                                         {"--projection", "none"},
                                                         {"--constraints", "heights-only"},
                                                         {"--connectivity", "search"},
                                                         {"--constraints", "regular", "--edges", "lines"}};
  for (const std::vector<std::string>& options : refused) {
    std::vector<std::string> words = {"weights", "in.mesh", "-o", "out.vtu"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = temper(words);
    EXPECT_EQ(outcome.exit, 2) << options.back();
    EXPECT_TRUE(contains(outcome.err, "is for triangles")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, options[options.size() == 4 ? 2 : 0])) << outcome.err;
  }
  temper_ok({"example", "sparse-horseshoe", "-o", "flat.vtu"});
  const Outcome outcome = temper({"weights", "flat.vtu", "-o", "out.vtu", "--constraints", "completely-well-centered"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_TRUE(contains(outcome.err, "is for tetrahedra alone")) << outcome.err;
}

}  // namespace
}  // namespace temper::test
