// temper explain: what people read, the JSON, and that the page in docs/ shows what the program says.
#include <algorithm>
#include <cmath>
#include <variant>

#include "support/sanitizers.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Explain : public Workshop {};

TEST_F(Explain, NamesTheCornersOfAnInfeasibleMesh) {
  temper_ok({"example", "sparse-horseshoe", "-o", "in.vtu"});
  const std::string text = temper_ok({"explain", "in.vtu"}).out;
  EXPECT_TRUE(contains(text, "in.vtu: 4 of 4 triangles are bad (not well-centered)"));
  EXPECT_TRUE(contains(text, "no weights make all of them well-centered"));
  EXPECT_TRUE(contains(text, "4 in 2 conflicts"));
  EXPECT_TRUE(contains(text, "at vertex 4"));
  EXPECT_TRUE(contains(text, "    what: Triangles 0 and 3 exclude each other.")) << text;
  EXPECT_TRUE(contains(text, "    why:  They cannot agree on where the dual crosses edge")) << text;
  EXPECT_TRUE(contains(text, "    cure: Cures it, verified: move vertex 4")) << text;
  const std::string one = temper_ok({"explain", "in.vtu", "--limit", "1"}).out;
  EXPECT_TRUE(contains(one, "and 1 more (--limit 2 or --json has all)"));
}

TEST_F(Explain, CertificatesOfItsJsonAreVerifiedByWeights) {
  temper_ok({"example", "sparse-horseshoe", "-o", "in.vtu"});
  const auto json = nlohmann::json::parse(temper_ok({"explain", "in.vtu", "--json"}).out);
  EXPECT_EQ(json["bad"], 4);
  EXPECT_EQ(json["verdict"], "infeasible");
  ASSERT_EQ(json["reasons"].size(), 2u);
  for (const auto& reason : json["reasons"]) {
    write("why.json", reason["certificate"].dump());
    EXPECT_TRUE(contains(temper_ok({"weights", "in.vtu", "--check-certificate", "why.json"}).out, "proves it"));
    EXPECT_EQ(reason["kind"], "edge");
    EXPECT_GT(reason["cures"].size(), 0u);
  }
}

TEST_F(Explain, WhatItSaysWeightsCureTheyDo) {
  temper_ok({"example", "annulus", "-o", "in.vtu"});
  const auto json = nlohmann::json::parse(temper_ok({"explain", "in.vtu", "--json"}).out);
  ASSERT_GT(json["bad"], 0);
  EXPECT_EQ(json["verdict"], "feasible");
  for (const auto& reason : json["reasons"]) EXPECT_EQ(reason["kind"], "weights");
  temper_ok({"weights", "in.vtu", "-o", "out.vtu", "--mode", "margin"});
  EXPECT_TRUE(contains(temper_ok({"explain", "out.vtu"}).out, "triangles are well-centered"));
}

TEST_F(Explain, ForATargetItExplainsDuals) {
  write("in.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n4 0 0\n2 1 0\n2 -1 0\n"
        "Triangles\n2\n1 2 3 1\n2 1 4 1\nEnd\n");
  const std::string text = temper_ok({"explain", "in.mesh", "--for", "vertex"}).out;
  EXPECT_TRUE(contains(text, "in.mesh: 1 coefficient is bad (negative)\n")) << text;
  EXPECT_TRUE(contains(text, " 1. at (2, 0)\n    what: Edge 1-2: coefficient -0.75.\n    why:  h/")) << text;
  EXPECT_TRUE(contains(text, "on the side of vertex 3") && contains(text, "126.9")) << text;
  EXPECT_TRUE(contains(text, "Next: temper optimize in.mesh -o OUT --for vertex\n")) << text;
  const auto json = nlohmann::json::parse(temper_ok({"explain", "in.mesh", "--for", "cell", "--json"}).out);
  EXPECT_EQ(json["criterion"], "distances");
  EXPECT_EQ(json["violations"], 1);
  EXPECT_EQ(json["reasons"][0]["vertices"], (nlohmann::json{0, 1}));
  EXPECT_EQ(json["reasons"][0]["kind"], "inside");
  temper_ok({"example", "triangle", "--a", "1", "--b", "1", "--angle", "60", "-o", "t.vtu"});
  EXPECT_EQ(temper_ok({"explain", "t.vtu", "--for", "vertex"}).out, "t.vtu: no edge has a negative coefficient\n");
}

TEST_F(Explain, ForATargetItExplainsDualsOfTetrahedra) {
  make_tetrahedra();
  const std::string faces = temper_ok({"explain", "two.mesh", "--for", "cell"}).out;
  EXPECT_TRUE(contains(faces, "what: Face ")) << faces;
  EXPECT_TRUE(contains(faces, "distance") && contains(faces, "dihedral")) << faces;
  const std::string edges = temper_ok({"explain", "two.mesh", "--for", "vertex", "--limit", "1"}).out;
  EXPECT_TRUE(contains(edges, "\n    what: Edge ")) << edges;
  EXPECT_TRUE(contains(edges, "over length -")) << edges;
}

TEST_F(Explain, SpeaksTheNumbersOfTheFile) {
  // Counted from 1 in this format; two obtuse triangles whose weights exist.
  write("in.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n4 0 0\n2 1 0\n2 -1 0\n"
        "Triangles\n2\n1 2 3 1\n2 1 4 1\nEnd\n");
  const std::string text = temper_ok({"explain", "in.mesh"}).out;
  EXPECT_TRUE(contains(text, "edge 1-2") || contains(text, "edge 2-1")) << text;
  EXPECT_FALSE(contains(text, "vertex 0")) << text;
}

TEST_F(Explain, OfAGlobeHasPlacesInDegreesAndCertificates) {
  temper_ok({"example", "random-sphere", "--vertices", TEMPER_SANITIZED ? "40" : "60", "-o", "globe.vtu"});
  EXPECT_TRUE(contains(temper_ok({"explain", "globe.vtu", "--limit", "1"}).out, "Conflicts, worst first"));
  const auto json = nlohmann::json::parse(temper_ok({"explain", "globe.vtu", "--json", "--limit", "1"}).out);
  const auto& worst = json["reasons"][0];
  EXPECT_LE(std::abs(worst["at"][1].get<double>()), 90);
  EXPECT_TRUE(worst["cures"][0]["verified"]);
  write("why.json", worst["certificate"].dump());
  EXPECT_TRUE(contains(temper_ok({"weights", "globe.vtu", "--check-certificate", "why.json"}).out, "proves it"));
}

TEST_F(Explain, ATetrahedronHasItsNumbersAndAdvice) {
  make_tetrahedra();
  const std::string text = temper_ok({"explain", "two.mesh"}).out;
  EXPECT_TRUE(contains(text, "two.mesh: 1 of 2 tetrahedra is bad (not well-centered), 1 face is not regular\n"));
  EXPECT_TRUE(contains(text, " 1. at (1, 0.575, -0.075)\n    what: Tetrahedron 2 (2 4 3 6) with the weights "));
  EXPECT_TRUE(contains(text, "    cure: Try: temper weights\n")) << text;
  const nlohmann::json json = nlohmann::json::parse(temper_ok({"explain", "two.mesh", "--json"}).out);
  EXPECT_EQ(json["bad"], 1);
  EXPECT_EQ(json["verdict"], "feasible");
  const nlohmann::json& reason = json["reasons"].at(0);
  EXPECT_EQ(reason["vertices"], (nlohmann::json{1, 3, 2, 5}));  // points[i] of the file, from 0
  // The orthocenter has equal power to all corners, and the least height is the reason.
  const auto file = *io::read("two.mesh");
  std::vector<double> powers, heights;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 p = file.place(reason["vertices"][k].get<std::size_t>());
    const auto& o = reason["orthocenter"];
    powers.push_back(std::pow(o[0].get<double>() - p.x, 2) + std::pow(o[1].get<double>() - p.y, 2) +
                     std::pow(o[2].get<double>() - p.z, 2) - reason["weights"][k].get<double>());
    heights.push_back(reason["faces"][k]["h_over_l"]);
    EXPECT_EQ(reason["faces"][k]["outside"], heights[k] <= 0);
  }
  for (const double power : powers) EXPECT_NEAR(power, powers[0], 1e-12);
  EXPECT_NEAR(*std::min_element(heights.begin(), heights.end()), reason["h_over_l"].get<double>(), 1e-14);
  // The advice helps.
  temper_ok({"weights", "two.mesh", "-o", "out.mesh"});
  EXPECT_EQ(temper_ok({"explain", "out.mesh"}).out.find("all 2 tetrahedra are well-centered"), 10U);
  EXPECT_FALSE(contains(temper_ok({"explain", "two.mesh", "--limit", "0"}).out, "what: "));
  EXPECT_EQ(temper({"explain", "two.mesh", "--flat"}).exit, 2);
}

TEST_F(Explain, BadUsageIsRefused) {
  temper_ok({"example", "sparse-horseshoe", "-o", "in.vtu"});
  EXPECT_EQ(temper({"explain"}).exit, 2);
  EXPECT_EQ(temper({"explain", "in.vtu", "--limit", "-1"}).exit, 2);
  EXPECT_EQ(temper({"explain", "nosuch.vtu"}).exit, 1);
}

}  // namespace
}  // namespace temper::test
