// temper check: the report for programs, the report for people, requirements.
#include <algorithm>

#include "temper/energy.hpp"
#include "temper/quality.hpp"
#include "temper/tets/quality.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Two triangles with unequal angles; medit counts from 1, and the first point is of no triangle.
constexpr const char* kKite =
    "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n9 9 0\n0 0 0\n2 -0.3 0\n4 0 0\n2 5 0\n"
    "Triangles\n2\n2 3 4 0\n2 4 5 0\nEnd\n";

class Check : public Workshop {
 protected:
  static OrderedJson check(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"check", "--json"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return OrderedJson::parse(temper_ok(all).out);
  }
};

TEST_F(Check, JsonHasExactlyTheKeysOfTheReport) {
  make_input();
  const OrderedJson report = check({"in.vtu"});
  std::vector<std::string> keys;
  for (const auto& item : report.items()) keys.push_back(item.key());
  std::vector<std::string> all = {"schema", "file"};
  for (const QualityMeasure& measure : quality_measures()) all.emplace_back(measure.key);
  for (const char* key : {"energy", "min_coefficient_place", "histograms", "worst", "verdict", "requirements"})
    all.emplace_back(key);
  EXPECT_EQ(keys, all);
  std::vector<std::string> names;
  for (const auto& item : report["energy"].items()) {
    names.push_back(item.key());
    EXPECT_EQ(item.value().size(), 3u);
  }
  std::vector<std::string> expected;
  for (const EnergyInfo& energy : energies()) expected.emplace_back(energy.name);
  EXPECT_EQ(names, expected);
  ASSERT_EQ(report["worst"].size(), 5u);
  std::vector<std::string> worst;
  for (const auto& item : report["worst"][0].items()) worst.push_back(item.key());
  EXPECT_EQ(worst, (std::vector<std::string>{"triangle", "vertices", "at", "h_over_l", "angle_deg", "why"}));
}

TEST_F(Check, CountsAreWholeNumbersAndInfinityIsNull) {
  make_input();
  const OrderedJson report = check({"in.vtu"});
  EXPECT_EQ(report["vertices"], 49);
  EXPECT_EQ(report["triangles"], 72);
  EXPECT_TRUE(report["orthocenters_outside"].is_number_integer());
  EXPECT_GT(report["orthocenters_outside"], 0);
  EXPECT_TRUE(report["energy"]["BH"][1].is_null());
  EXPECT_TRUE(report["energy"]["BP"][1].is_number());
}

TEST_F(Check, ShortNamesAreRequiredAsKeysAre) {
  make_input();
  std::string list;
  for (const QualityMeasure& m : quality_measures()) {
    if (!m.alias.empty()) list += (list.empty() ? "" : ",") + std::string(m.alias) + ">=-1e300";
  }
  const OrderedJson report = check({"in.vtu", "--require", list});
  for (const OrderedJson& asked : report["requirements"])
    EXPECT_EQ(asked["found"], report[asked["key"].get<std::string>()]);
}

TEST_F(Check, AKeyAloneAsksForWhatIsUsual) {
  make_input();
  std::string list;
  std::vector<QualityMeasure> rows;
  for (const QualityMeasure& m : quality_measures()) {
    if (!m.wanted) continue;
    list += (list.empty() ? "" : ",") + std::string(m.key);
    rows.push_back(m);
  }
  const OrderedJson asked =
      OrderedJson::parse(temper({"check", "--json", "in.vtu", "--require", list}).out)["requirements"];
  ASSERT_EQ(asked.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(asked[i]["key"], std::string(rows[i].key));
    EXPECT_EQ(asked[i]["value"], *rows[i].wanted);
  }
}

TEST_F(Check, NumbersHaveFullPrecision) {
  temper_ok({"example", "triangle", "--a", "1", "--b", "1", "--angle", "60", "-o", "t.vtu"});
  EXPECT_NEAR(check({"t.vtu"})["energy"]["BH"][1].get<double>(), 4.618802153517, 1e-12);
}

TEST_F(Check, TheDenseHorseshoeHasThePublishedEnergies) {
  temper_ok({"example", "horseshoe", "-o", "h.vtu"});
  const std::string table = temper_ok({"check", "h.vtu", "--details"}).out;
  for (const char* energy :
       {"2.836890825582", "12.143904187128", "375.355882218659", "0.581320957789", "2.255569867793"}) {
    EXPECT_TRUE(contains(table, energy));
  }
}

TEST_F(Check, WorstIsAsLongAsAsked) {
  make_input();
  EXPECT_EQ(check({"in.vtu", "--worst", "0"})["worst"].size(), 0u);
  EXPECT_EQ(check({"in.vtu", "--worst", "7"})["worst"].size(), 7u);
  EXPECT_FALSE(contains(temper_ok({"check", "in.vtu", "--details", "--worst", "0"}).out, "worst triangles"));
}

TEST_F(Check, JsonCountsFromZeroAndPeopleSeeTheirOwnNumbers) {
  write("kite.mesh", kKite);
  const OrderedJson worst = check({"kite.mesh", "--worst", "1"})["worst"][0];
  EXPECT_EQ(worst["triangle"], 0);
  EXPECT_EQ(worst["vertices"], (OrderedJson{1, 2, 3}));
  EXPECT_TRUE(contains(worst["why"].get<std::string>(), "vertex 2"));

  const std::string table = temper_ok({"check", "kite.mesh", "--details", "--worst", "1"}).out;
  EXPECT_TRUE(contains(table, "\n  1 (2 3 4) at "));
  EXPECT_TRUE(contains(table, "at vertex 3"));
}

TEST_F(Check, WarningsGoToStandardErrorAndJsonStaysJson) {
  write("kite.mesh", kKite);
  const Outcome outcome = temper_ok({"check", "--json", "kite.mesh"});
  EXPECT_TRUE(contains(outcome.err, "temper: warning: "));
  EXPECT_TRUE(OrderedJson::accept(outcome.out));
}

TEST_F(Check, GammaIsOneUnlessGiven) {
  make_input();
  const OrderedJson plain = check({"in.vtu"});
  EXPECT_EQ(plain, check({"in.vtu", "--gamma", "1:absolute"}));
  EXPECT_NE(plain["energy"]["BP"], check({"in.vtu", "--gamma", "0.5:absolute"})["energy"]["BP"]);
  EXPECT_NE(plain["energy"]["BP"], check({"in.vtu", "--gamma", "1"})["energy"]["BP"]);
  EXPECT_EQ(plain["energy"]["BHs"], plain["energy"]["BH"]);
  EXPECT_TRUE(check({"in.vtu", "--h0", "10"})["energy"]["BHs"][1].is_number());
}

TEST_F(Check, ThreadsDoNotChangeAByte) {
  make_input();
  EXPECT_EQ(temper_ok({"check", "in.vtu", "--json", "--threads", "1"}).out,
            temper_ok({"check", "in.vtu", "--json", "--threads", "3"}).out);
}

TEST_F(Check, TheTableHasHistogramsInUtf8OrAscii) {
  make_input();
  const std::string utf8 = temper_ok({"check", "in.vtu", "--details"}).out;
  EXPECT_TRUE(contains(utf8, "angles (degrees)"));
  EXPECT_TRUE(contains(utf8, "h/ℓ"));
  EXPECT_TRUE(contains(utf8, "█"));
  const std::string ascii = shell("LC_ALL=C temper check in.vtu --details").out;
  EXPECT_TRUE(contains(ascii, "####"));
  EXPECT_TRUE(std::all_of(ascii.begin(), ascii.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
}

TEST_F(Check, RequirementsThatHoldExitWith0) {
  make_input();
  EXPECT_EQ(temper({"check", "in.vtu", "--require", "inverted=0,nonregular<=72,triangles==72,max_angle=180"}).exit, 0);
}

TEST_F(Check, EveryRequirementThatFailsIsNamedWithWantedAndFound) {
  make_input();
  const Outcome outcome =
      temper({"check", "in.vtu", "--require", "outside=0,inverted=0,triangles=73", "--require", "min_h=0.05"});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_TRUE(contains(outcome.err, "in.vtu: requirement not met: outside=0 means orthocenters_outside = 0, found "));
  EXPECT_TRUE(contains(outcome.err, "triangles=73 means triangles = 73, found 72\n"));
  EXPECT_TRUE(contains(outcome.err, "min_h=0.05 means min_h_over_l >= 0.05, found -"));
  EXPECT_FALSE(contains(outcome.err, "inverted=0"));
}

TEST_F(Check, EveryKeyOfTheReportCanBeRequired) {
  make_input();
  const OrderedJson report = check({"in.vtu"});
  std::string equal = "regions=1", other = "regions==-12345";
  std::size_t keys = 0;
  for (const auto& item : report.items()) {
    if (!item.value().is_number() || item.key() == "schema") continue;
    ++keys;
    equal += "," + item.key() + "=" + item.value().dump();
    other += "," + item.key() + "==-12345";
  }
  EXPECT_EQ(keys, quality_measures().size());
  temper_ok({"check", "in.vtu", "--require", equal});
  const OrderedJson refused =
      OrderedJson::parse(temper({"check", "--json", "in.vtu", "--require", other}).out)["requirements"];
  EXPECT_EQ(refused.size(), keys + 1);
  for (const OrderedJson& outcome : refused) EXPECT_FALSE(outcome["met"].get<bool>()) << outcome["key"];
  const std::string bp = report["energy"]["BP"][1].dump();
  EXPECT_EQ(temper({"check", "in.vtu", "--require", "energy.BP.1=" + bp}).exit, 0);
  EXPECT_EQ(temper({"check", "in.vtu", "--require", "energy.BH.1=1e300"}).exit, 3);
}

TEST_F(Check, OutcomesOfRequirementsAreInTheReport) {
  make_input();
  const Outcome outcome = temper({"check", "in.vtu", "--json", "--require", "inverted=0,min_h>=0.5"});
  EXPECT_EQ(outcome.exit, 3);
  const OrderedJson report = OrderedJson::parse(outcome.out);
  ASSERT_EQ(report["requirements"].size(), 2u);
  EXPECT_EQ(report["requirements"][0], (OrderedJson{{"text", "inverted=0"},
                                                    {"key", "inverted_triangles"},
                                                    {"wants", "="},
                                                    {"value", 0.0},
                                                    {"found", 0.0},
                                                    {"met", true}}));
  EXPECT_EQ(report["requirements"][1]["wants"], ">=");
  EXPECT_EQ(report["requirements"][1]["found"], report["min_h_over_l"]);
  EXPECT_EQ(report["requirements"][1]["met"], false);
}

TEST_F(Check, SeveralMeshesAreAListAndNoneKeepsAnotherFromBeingLookedAt) {
  make_input("a.vtu");
  temper_ok({"example", "horseshoe", "-o", "b.vtu"});
  const OrderedJson both = OrderedJson::parse(temper_ok({"check", "a.vtu", "b.vtu", "--json"}).out);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0], check({"a.vtu"}));
  EXPECT_EQ(both[1], check({"b.vtu"}));

  const Outcome outcome = temper({"check", "a.vtu", "missing.vtu", "b.vtu", "--require", "regions=7"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.out, "a.vtu: "));
  EXPECT_TRUE(contains(outcome.out, "\n\nb.vtu: "));
  EXPECT_TRUE(contains(outcome.err, "missing.vtu: cannot be read"));
  EXPECT_TRUE(contains(outcome.err, "b.vtu: requirement not met: regions=7"));
}

// --- targets -----------------------------------------------------------------------------------------------------

// A square cut along a diagonal, whose dual has the length 0.
constexpr const char* kSquare =
    "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
    "Triangles\n2\n1 2 3 0\n1 3 4 0\nEnd\n";

TEST_F(Check, AMeshThatTheSolverOfATargetTakesNeedsNoRun) {
  write("square.mesh", kSquare);
  EXPECT_TRUE(contains(temper_ok({"check", "square.mesh"}).out, "2 of 2 triangles are bad (not well-centered)"));
  const std::string text = temper_ok({"check", "square.mesh", "--for", "vertex", "--require", "bad=0"}).out;
  EXPECT_TRUE(contains(text,
                       "no edge has a negative coefficient: a solver with unknowns at vertices can use this mesh "
                       "as it is\n"))
      << text;
  EXPECT_FALSE(contains(text, "Next:"));
  const Outcome cell = temper({"check", "square.mesh", "--for", "fipy", "--require", "bad=0"});
  EXPECT_EQ(cell.exit, 3);
  EXPECT_TRUE(
      contains(cell.out,
               "1 distance between centers is bad (not positive): 1 inside, 0 from the boundary, 0 from interfaces; "
               "the least over length is 0 at edge 3-1 (0.5, 0.5)\n"
               "Next: temper optimize square.mesh -o OUT --for cell, or temper explain square.mesh --for "
               "cell\n"))
      << cell.out;
  EXPECT_TRUE(contains(cell.err, "bad=0 means bad = 0, found 1"));
  EXPECT_EQ(temper({"check", "square.mesh", "--for", "stars", "--require", "bad=0"}).exit, 3);
}

TEST_F(Check, TheVerdictNamesTheWorstCoefficient) {
  // Obtuse across the boundary at the third point of the file, and across an interface of regions.
  write("kite.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n4 0 0\n2 1 0\n2 -9 0\n"
        "Triangles\n2\n1 2 3 1\n2 1 4 2\nEnd\n");
  const std::string text = temper({"check", "kite.mesh", "--for", "vertex"}).out;
  EXPECT_TRUE(
      contains(text,
               "1 coefficient is bad (negative): 0 inside, 0 on the boundary, 1 of one region alone; the least is "
               "-0.375 at edge 1-2 (2, 0)"))
      << text;
  EXPECT_TRUE(contains(temper_ok({"check", "kite.mesh", "--for", "vertex", "--details"}).out,
                       "1 coefficient is bad (negative)"));
}

// --- tetrahedra ------------------------------------------------------------------------------------------------

TEST_F(Check, TetrahedraAreMeasuredInTheNumbersOfTheirFile) {
  make_tetrahedra();
  const Outcome short_report = temper_ok({"check", "two.mesh"});
  EXPECT_TRUE(contains(short_report.out, "two.mesh: 5 vertices (0 inside), 2 tetrahedra\nbad tetrahedra"));
  EXPECT_TRUE(contains(short_report.out,
                       "\n1 of 2 tetrahedra is bad (not well-centered), 1 face is not regular\n"
                       "Next: temper optimize two.mesh -o OUT, or temper explain two.mesh\n"));
  EXPECT_TRUE(contains(short_report.err, "two.mesh: 1 point of no tetrahedron is dropped: point 1"));
  const Outcome details = temper_ok({"check", "two.mesh", "--details", "--worst", "1"});
  EXPECT_TRUE(contains(details.out, "worst tetrahedra\n  2 (2 4 3 6) at 1 0.575 -0.075: h/l "));
  EXPECT_TRUE(contains(details.out, "orthocenter outside across face 2-4-3: h/"));
  for (const tets::QualityMeasure& m : tets::quality_measures())
    EXPECT_TRUE(contains(details.out, "\n" + std::string(m.label) + " "));
}

TEST_F(Check, JsonOfTetrahedraHasExactlyTheKeysOfTheReport) {
  make_tetrahedra();
  const OrderedJson report = check({"two.mesh"});
  std::vector<std::string> keys, all = {"schema", "file"};
  for (const auto& item : report.items()) keys.push_back(item.key());
  for (const tets::QualityMeasure& m : tets::quality_measures()) all.emplace_back(m.key);
  for (const char* key :
       {"min_coefficient_place", "min_distance_place", "histograms", "worst", "verdict", "requirements"})
    all.emplace_back(key);
  EXPECT_EQ(keys, all);
  EXPECT_EQ(report["regions"], 2);
  EXPECT_EQ(report["worst"][0]["tetrahedron"], 1);
  EXPECT_EQ(report["worst"][0]["vertices"], (OrderedJson{1, 3, 2, 5}));  // points[i] of the file, from 0
  EXPECT_TRUE(contains(report["worst"][0]["why"].get<std::string>(), "face 1-3-2"));
}

TEST_F(Check, TargetsOfTetrahedraHaveTheirOwnVerdicts) {
  make_tetrahedra();
  const OrderedJson report = check({"two.mesh"});
  const Outcome vertex = temper({"check", "two.mesh", "--for", "vertex", "--require", "bad=0"});
  EXPECT_EQ(vertex.exit, 3);
  EXPECT_TRUE(contains(vertex.out, "of one region alone; the least over length is ")) << vertex.out;
  EXPECT_TRUE(contains(vertex.out, " at edge ")) << vertex.out;
  const Outcome cell = temper({"check", "two.mesh", "--for", "cell", "--require", "bad=0"});
  EXPECT_EQ(cell.exit, 3);
  EXPECT_TRUE(contains(cell.out, " at face ")) << cell.out;
  const std::size_t all = report["nonpositive_distances"].get<std::size_t>() +
                          report["nonpositive_boundary_distances"].get<std::size_t>() +
                          report["nonpositive_region_distances"].get<std::size_t>();
  EXPECT_TRUE(contains(cell.err, "bad=0 means bad = 0, found " + std::to_string(all))) << cell.err;
}

TEST_F(Check, RequirementsOnTetrahedraHaveTheirOwnKeys) {
  make_tetrahedra();
  make_input();
  EXPECT_EQ(temper({"check", "two.mesh", "--require", "tetrahedra=2,min_dihedral>=1,inverted"}).exit, 0);
  const Outcome unmet = temper({"check", "two.mesh", "--require", "outside=0"});
  EXPECT_EQ(unmet.exit, 3);
  EXPECT_TRUE(contains(unmet.err, "outside=0 means orthocenters_outside = 0, found 1"));
  const Outcome triangles = temper({"check", "in.vtu", "--require", "min_dihedral>=1"});
  EXPECT_EQ(triangles.exit, 2);
  EXPECT_TRUE(contains(triangles.err, "unknown key 'min_dihedral'"));
  const Outcome tetrahedra = temper({"check", "two.mesh", "--require", "energy.BP.1=0"});
  EXPECT_EQ(tetrahedra.exit, 2);
  EXPECT_TRUE(contains(tetrahedra.err, "unknown key 'energy.BP.1' for tetrahedra. Next: temper check --help lists"));
  EXPECT_TRUE(contains(temper({"check", "two.mesh", "--require", "min_angle=1"}).err,
                       "unknown key 'min_angle' for tetrahedra; there are min_coefficient, min_distance, min_h, "
                       "min_face_h, min_d, min_dihedral, "
                       "min_volume. Next: "));
  EXPECT_TRUE(contains(temper({"check", "in.vtu", "--require", "energy.B.1=0"}).err, "there are energy.NAME.STAR"));
  EXPECT_TRUE(contains(temper({"check", "two.mesh", "--require", "outside=0,min_angle"}).err,
                       "'min_angle' has no usual value: write min_angle>=VALUE. Not all of these keys exist for "
                       "tetrahedra\nSee "));
  // No value equals a volume, which is rounded.
  const Outcome equal = temper({"check", "two.mesh", "--require", "volume=1"});
  EXPECT_EQ(equal.exit, 2);
  EXPECT_TRUE(contains(
      equal.err, "'volume=1': volume is rounded, so that = decides nothing: write volume>=VALUE or volume<=VALUE"));
  EXPECT_TRUE(contains(temper({"check", "two.mesh", "--require", "volume"}).err,
                       "'volume' has no usual value: write volume>=VALUE or volume<=VALUE"));
  EXPECT_EQ(temper({"check", "two.mesh", "--require", "volume>=1,volume<=1.1,min_volume=0.1,max_volume=1"}).exit, 0);
  // A list that makes sense for both is judged on both.
  EXPECT_EQ(temper({"check", "in.vtu", "two.mesh", "--require", "inverted=0"}).exit, 0);
}

TEST_F(Check, OptionsForTrianglesAloneAreRefusedForTetrahedraByName) {
  make_tetrahedra();
  const std::vector<std::vector<std::string>> refused = {
      {"--flat"}, {"--gamma", "1"}, {"--h0", "1"}, {"--projection", "sphere"}};
  for (const auto& option : refused) {
    std::vector<std::string> all = {"check", "two.mesh"};
    all.insert(all.end(), option.begin(), option.end());
    const Outcome outcome = temper(all);
    EXPECT_EQ(outcome.exit, 2) << option[0] << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "two.mesh has tetrahedra, and " + option[0])) << outcome.err;
  }
  EXPECT_EQ(names(), std::vector<std::string>{"two.mesh"});
}

}  // namespace
}  // namespace temper::test
