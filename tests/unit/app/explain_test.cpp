// temper explain: what people read, the JSON, and that the page in docs/ shows what the program says.
#include <cmath>

#include "support/sanitizers.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Explain : public Workshop {};

TEST_F(Explain, NamesTheCornersOfAnInfeasibleMesh) {
  temper_ok({"example", "sparse-horseshoe", "-o", "in.vtu"});
  const std::string text = temper_ok({"explain", "in.vtu"}).out;
  EXPECT_TRUE(contains(text, "in.vtu: 4 of 4 triangles are not well-centered"));
  EXPECT_TRUE(contains(text, "no weights make all of them well-centered"));
  EXPECT_TRUE(contains(text, "4 in 2 conflicts"));
  EXPECT_TRUE(contains(text, "at vertex 4"));
  EXPECT_TRUE(contains(text, "Cures it, verified: move vertex 4"));
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
  temper_ok({"weights", "in.vtu", "-o", "out.vtu", "--mode", "feasible"});
  EXPECT_TRUE(contains(temper_ok({"explain", "out.vtu"}).out, "triangles are well-centered"));
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

TEST_F(Explain, BadUsageIsRefused) {
  temper_ok({"example", "sparse-horseshoe", "-o", "in.vtu"});
  EXPECT_EQ(temper({"explain"}).exit, 2);
  EXPECT_EQ(temper({"explain", "in.vtu", "--limit", "-1"}).exit, 2);
  EXPECT_EQ(temper({"explain", "nosuch.vtu"}).exit, 1);
}

}  // namespace
}  // namespace temper::test
