// Help, versions, and every way to use the program wrongly.
#include <algorithm>
#include <map>
#include <sstream>

#include "support/sanitizers.hpp"
#include "temper/detail/optimize_table.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

const std::vector<std::string> kVerbs = {"check",     "optimize", "mesh",    "weights", "explain", "errors",
                                         "operators", "draw",     "convert", "example", "paper"};

class Usage : public Workshop {};

TEST_F(Usage, VersionSaysWhatTheProgramIsMadeOf) {
  const Outcome outcome = temper_ok({"--version"});
  EXPECT_TRUE(outcome.out.starts_with("temper " TEMPER_VERSION "\n\n")) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  for (const char* row : {"commit", "compiler", "processor", "instructions", "threads", "oneTBB", "NetCDF", "HDF5",
                          "zlib", "pugixml", "Clp", "Eigen"}) {
    EXPECT_TRUE(contains(outcome.out, "\n  " + std::string(row) + " ")) << row << " in\n" << outcome.out;
  }
  for (std::istringstream lines(outcome.out); !lines.eof();) {
    std::string line;
    std::getline(lines, line);
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
  EXPECT_EQ(outcome.out, temper_ok({"--version"}).out);
}

TEST_F(Usage, WithoutArgumentsAShortHelpAndBadUsage) {
  const Outcome outcome = temper({});
  EXPECT_EQ(outcome.exit, 2);
  for (const std::string& verb : kVerbs) EXPECT_TRUE(contains(outcome.err, verb));
}

TEST_F(Usage, HelpNamesEveryVerbAndEveryExitCode) {
  const Outcome outcome = temper_ok({"--help"});
  for (const std::string& verb : kVerbs) EXPECT_TRUE(contains(outcome.out, "  " + verb));
  for (int code = 0; code <= 5; ++code) EXPECT_TRUE(contains(outcome.out, "\n  " + std::to_string(code) + "  "));
}

TEST_F(Usage, EveryVerbHasUsageExamplesAndExitCodes) {
  for (const std::string& verb : kVerbs) {
    const Outcome outcome = temper_ok({verb, "--help"});
    EXPECT_TRUE(contains(outcome.out, "\nUsage: temper "));
    const std::string all = temper_ok({verb, "--help-all"}).out;
    for (const char* part : {"\nUsage: temper ", "\nExamples:\n  temper ", "\nExit codes:\n  0  Done.\n"}) {
      EXPECT_TRUE(contains(all, part));
    }
    EXPECT_EQ(outcome.out, temper_ok({"help", verb}).out);
    EXPECT_EQ(outcome.out, temper_ok({verb, "-h"}).out);
  }
}

TEST_F(Usage, HelpFitsInAHundredColumnsOfAscii) {
  for (const std::string& verb : kVerbs) {
    std::istringstream help(temper_ok({verb, "--help"}).out);
    std::size_t lines = 0;
    for (std::string line; std::getline(help, line); ++lines) {
      EXPECT_LE(line.size(), 100u) << line;
      EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; })) << line;
    }
    EXPECT_GT(lines, 10u);
  }
}

TEST_F(Usage, HelpMentionsEveryOption) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> options = {
      {"optimize", {"--output",   "--for",      "--effort",  "--keep",       "--boundary",  "--fix",   "--size",
                    "--min-edge", "--min-dual", "--require", "--time-limit", "--write",     "--quiet", "--set",
                    "--options",  "--details",  "--threads", "--save-every", "--size-data", "--help"}},
      {"check", {"--json", "--write", "--details", "--gamma ", "--h0 ", "--require", "--worst", "--threads", "--help"}},
      {"errors", {"--json", "--against", "--edges", "--fields", "--refine", "--condition", "--threads", "--help"}},
      {"draw", {"--output", "--before", "--numbers", "--zoom", "--width", "--title", "--help"}},
      {"convert", {"--output", "--format", "--encoding", "--help"}},
      {"example", {"--output",   "--list",    "sparse-horseshoe:",
                   "horseshoe:", "--a ",      "--b ",
                   "--x ",       "--y ",      "triangle:",
                   "--angle",    "random:",   "--vertices",
                   "--seed",     "--polygon", "sheared-grid:",
                   "--nx",       "--ny",      "--shear",
                   "annulus:",   "--inner",   "--outer",
                   "--around",   "--rings",   "--jitter",
                   "airfoil:",   "--growth",  "--help"}},
      {"paper", {"--output", "--reduced", "--require-claims", "--list", "--sweeps", "--quiet", "--help"}},
  };
  for (const auto& [verb, names] : options) {
    const std::string help = temper_ok({verb, "--help-all"}).out;
    for (const std::string& name : names) EXPECT_TRUE(contains(help, name));
  }
}

// Every row of the library's table: named in one of the two long helps, and refused by name and range when out of that.
TEST_F(Usage, EveryOptionOfTheTableCanBeSet) {
  make_input();
  const std::string all = temper_ok({"optimize", "--help-all"}).out,
                    paper = temper_ok({"optimize", "--help-paper"}).out;
  std::size_t rows = 0;
  for (const OptionRow& row : option_rows()) {
    const std::string name(row.name), entry = "\n  " + name + "=";
    EXPECT_EQ(contains(paper, entry), row.research) << name;
    EXPECT_EQ(contains(all, entry), !row.research) << name;
    const bool bounded = row.range.low > -1 && row.kind != OptionKind::choice;
    if (!bounded) continue;
    const Outcome low = temper({"optimize", "in.vtu", "-o", "out.vtu", "--set", name + "=-1"});
    EXPECT_EQ(low.exit, 2) << name;
    EXPECT_TRUE(contains(low.err, name + ": -1 is out of range, it must be ")) << low.err;
    ++rows;
  }
  EXPECT_GT(rows, 20u);
}

TEST_F(Usage, TheFirstHelpOfOptimizeHasFourteenOptionsAndFortyLines) {
  const std::string help = temper_ok({"optimize", "--help"}).out;
  EXPECT_LE(std::count(help.begin(), help.end(), '\n'), 40);
  std::istringstream text(help);
  std::vector<std::string> options;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("  -")) options.push_back(line);
  }
  EXPECT_LE(options.size(), 14u);
  for (const char* name : {"--for", "--effort", "--keep", "--write", "--help-all", "--help-paper"})
    EXPECT_TRUE(contains(help, name)) << name;
  for (const Preset& target : targets())
    EXPECT_TRUE(target.research || contains(help, "\n      " + std::string(target.name) + " "));
  for (const std::string& verb : kVerbs) {
    if (verb != "optimize") {
      EXPECT_EQ(temper_ok({verb, "--help"}).out, temper_ok({verb, "--help-all"}).out);
    }
  }
}

// The table of tests/unit/app/mistakes.md: | `command` | code | `message` |
TEST_F(Usage, TheTableOfMistakesInTheDocsIsTrue) {
  make_input();
  write("empty.msh", "");
  std::istringstream docs(read(TEMPER_SOURCE_DIR "/tests/unit/app/mistakes.md"));
  int rows = 0;
  for (std::string line; std::getline(docs, line);) {
    if (line.rfind("| `temper", 0) != 0) continue;
    std::vector<std::string> cells;
    for (std::size_t at = 2; at < line.size(); at = line.find(" | ", at) + 3) {
      cells.push_back(line.substr(at, line.find_first_of('|', at) - 1 - at));
      if (line.find(" | ", at) == std::string::npos) break;
    }
    ASSERT_EQ(cells.size(), 3u) << line;
    const Outcome outcome = shell(cells[0].substr(1, cells[0].size() - 2));
    EXPECT_EQ(std::to_string(outcome.exit), cells[1]) << line << "\n" << outcome.err;
    EXPECT_TRUE(contains(outcome.err, cells[2].substr(1, cells[2].size() - 2)));
    ++rows;
  }
  EXPECT_GT(rows, 25);
}

// A mesh may be in several files, each of which an output could destroy.
TEST_F(Usage, NoOutputIsAFileOfAnotherOutputOrOfAnInput) {
  make_input();
  temper_ok({"convert", "in.vtu", "-o", "in.node"});
  temper_ok({"convert", "in.vtu", "-o", "in.obj"});
  write("in.obj.weights.csv", "point,weight\n");
  write("mine.json", "{\"for\": \"cell\"}");
  std::map<std::string, std::string> before;
  for (const std::string& name : names()) before[name] = read(name);
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const Outcome outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, 2) << message;
    EXPECT_TRUE(contains(outcome.err, message));
    std::map<std::string, std::string> after;
    for (const std::string& name : names()) after[name] = read(name);
    EXPECT_EQ(after, before) << message;
  };
  refused({"optimize", "in.vtu", "-o", "out.obj", "--write", "p.svg", "out.obj.weights.csv"},
          "--write: out.obj.weights.csv is another output already: --output out.obj");
  refused({"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "./r.json"},
          "--write: r.json and ./r.json are each a report; expected one");
  refused({"optimize", "in.obj", "-o", "out.vtu", "--write", "in.obj.weights.csv"},
          "--write: in.obj.weights.csv is read with in.obj, the input mesh");
  refused({"optimize", "in.vtu", "-o", "out.vtu", "--size", "in.obj", "--write", "in.obj.weights.csv"},
          "--write: in.obj.weights.csv is read with in.obj, an input");
  refused({"optimize", "in.vtu", "-o", "in.obj", "--size", "in.obj"},
          "--output: in.obj is an input, and would be replaced");
  refused({"optimize", "in.vtu", "-o", "in.ele", "--format", "vtu", "--size", "in.node"},
          "--output: in.ele is read with in.node, an input, and would be replaced");
  refused({"optimize", "in.vtu", "-o", "out.vtu", "--options", "mine.json", "--write", "mine.json"},
          "--write: mine.json is an input");
  refused({"optimize", "in.vtu", "-o", "mine.json", "--format", "vtu", "--options", "mine.json"},
          "--output: mine.json is an input, and would be replaced");
  refused({"weights", "in.vtu", "-o", "w.vtu", "--edges", "mine.json", "--constraints", "regular", "--certificate",
           "mine.json"},
          "--certificate: mine.json is an input");
  refused({"paper", "replay", "in.vtu", "mine.json", "-o", "mine.json", "--format", "vtu"},
          "--output: mine.json is an input, and would be replaced");
  temper_ok({"convert", "in.node", "-o", "in.ele"});  // in its own place
}

TEST_F(Usage, EveryVerbIsQuietButForJson) {
  temper_ok({"example", "annulus", "--around", "24", "--rings", "3", "-o", "in.vtu", "--quiet"});
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "t.jsonl", "--quiet"});
  write("a.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"check", "out.vtu"},
                                             {"explain", "out.vtu"},
                                             {"operators", "out.vtu", "-o", "dual", "--format", "npz"},
                                             {"weights", "out.vtu", "-o", "w.vtu"},
                                             {"mesh", "a.poly", "-o", "a.vtu", "--size", "0.5"},
                                             {"optimize", "in.vtu", "-o", "out.vtu"},
                                             {"draw", "in.vtu", "-o", "in.svg"},
                                             {"convert", "in.vtu", "-o", "in.off"},
                                             {"paper", "replay", "in.vtu", "t.jsonl", "-o", "again.vtu"}}) {
    std::vector<std::string> quiet = words;
    quiet.emplace_back("--quiet");
    EXPECT_EQ(temper_ok(quiet).out, "") << words[0];
  }
  EXPECT_TRUE(nlohmann::json::parse(temper_ok({"check", "out.vtu", "--json", "--quiet"}).out).contains("triangles"));
}

TEST_F(Usage, ACodeOfAQuietRunThatIsNotZeroHasItsSentence) {
  make_input();
  const Outcome stopped = temper({"optimize", "in.vtu", "-o", "out.vtu", "--time-limit", "1e-9", "--quiet"});
  EXPECT_EQ(stopped.exit, 4);
  EXPECT_TRUE(contains(stopped.err, "temper: error: A signal or --time-limit stopped the run"));
  temper_ok({"example", "sparse-horseshoe", "-o", "shoe.vtu"});
  const Outcome none = temper({"weights", "shoe.vtu", "--mode", "margin", "--quiet"});
  EXPECT_EQ(none.exit, 6);
  EXPECT_TRUE(contains(none.err, "No weights meet the request"));
}

TEST_F(Usage, TheReaderOfAPipeMayGoBeforeTheFileIsWritten) {
  make_input();
  const Outcome one = shell("temper optimize in.vtu -o out.vtu --write r.json | true");
  EXPECT_EQ(one.err, "");
  temper_ok({"check", "out.vtu", "--require", "outside=0"});
  EXPECT_TRUE(exists("r.json"));
  EXPECT_EQ(shell("(temper optimize in.vtu -o both.vtu 2>&1; echo $? > code) | true").err, "");
  EXPECT_EQ(read("code"), "0\n");
  EXPECT_EQ(read("both.vtu"), read("out.vtu"));
}

TEST_F(Usage, SuffixesMayBeLargeAndOneIsOne) {
  temper_ok({"example", "triangle", "-o", "A.VTU"});
  temper_ok({"convert", "A.VTU", "-o", "A.MSH"});
  temper_ok({"draw", "A.MSH", "-o", "A.SVG"});
  const Outcome check = temper_ok({"check", "A.MSH", "--write", "A.JSON"});
  EXPECT_TRUE(contains(check.out, "A.MSH: 3 vertices, 1 triangle\n"));
  EXPECT_TRUE(contains(check.out, "1 of 1 triangle is bad (not well-centered)"));
  EXPECT_EQ(read_json("A.JSON")["triangles"], 1);
  EXPECT_TRUE(read("A.MSH").starts_with("$MeshFormat\n4.1"));
}

TEST_F(Usage, AKeyOfTheOptionsFileIsGivenOnce) {
  make_input();
  write("o.json", R"({"max_sweeps": 3, "max_sweeps": 4})");
  const Outcome outcome = temper({"optimize", "in.vtu", "-o", "out.vtu", "--options", "o.json"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "o.json: max_sweeps is given more than once; expected one value"));
  write("o.json", R"({"schema": 1, "before": {"size": 1}, "after": {"size": 1}, "options": {"max_sweeps": 3}})");
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--options", "o.json"});
}

TEST_F(Usage, EveryExampleInTheHelpRuns) {
  make_input();
  temper_ok({"convert", "in.vtu", "-o", "in.msh"});
  write("layers.csv", "vertex,top,bottom\n*,1,0\n");
  write("lake.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  write("plan.poly", "4 2 0 0\n1 0 0\n2 9 0\n3 9 9\n4 0 9\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n1\n1 1 1 2 -1\n");
  const std::string square =
      R"({"type": "Polygon", "coordinates": [[[9, 0], [9.1, 0], [9.1, 0.1], [9, 0.1], [9, 0]]]})";
  write("coast.geojson", square);
  write("valley.geojson",
        R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}}, )"
        R"("features": [{"type": "Feature", "properties": {}, "geometry": )"
        R"({"type": "Polygon", "coordinates": [[[0, 0], [2000, 0], [2000, 1500], [0, 1500], [0, 0]]]}}, )"
        R"({"type": "Feature", "properties": {"name": "fault"}, "geometry": )"
        R"({"type": "LineString", "coordinates": [[500, 400], [1000, 900], [1500, 1000]]}}]})");
  write("basin.msh",
        "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=4\n9;0;0\n9.1;0;0\n9.1;0.1;0\n9;0.1;0\n"
        "EDGE2=4\n0;1;0\n1;2;0\n2;3;0\n3;0;0\n");
  write("report.json", R"({"for": "cell"})");
  write("hgrid.2dm", "MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 9\nND 2 900 0 2\nND 3 0 900 1\n");
  write("in.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  make_tetrahedra("box.mesh");
  write("land.geojson", R"({"type": "Polygon", "coordinates": [[[0, 0], [40, 5], [35, 40], [5, 30], [0, 0]]]})");
  write("rivers.geojson", R"({"type": "LineString", "coordinates": [[170, 30], [178, 33], [-174, 30], [-165, 40]]})");
  std::vector<std::string> texts = {temper_ok({"--help"}).out};
  for (const std::string& verb : kVerbs) {
    texts.push_back(temper_ok({verb, "--help-all"}).out);
  }
  int examples = 0;
  for (const std::string& text : texts) {
    std::istringstream help(text.substr(text.find("\nExamples:\n")));
    for (std::string line; std::getline(help, line);) {
      if (line.rfind("  temper ", 0) != 0) continue;
      // Whole figures are made by tests/claims.
      const bool whole_figure = line.find(" reproduce ") != line.npos && line.find(" --reduced") == line.npos;
      const Outcome outcome = shell(whole_figure && TEMPER_SANITIZED ? line + " --reduced" : line);
      EXPECT_EQ(outcome.exit, 0) << line << "\n" << outcome.err;
      ++examples;
    }
  }
  EXPECT_GT(examples, 15);
}

struct Wrong {
  const char* name;
  std::vector<std::string> arguments;
  const char* message;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.name; }

class BadUsage : public Workshop, public testing::WithParamInterface<Wrong> {};

TEST_P(BadUsage, ExitsWith2AndSaysWhatIsWrong) {
  const Outcome outcome = temper(GetParam().arguments);
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("temper: error: ", 0), 0u) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, GetParam().message));
  EXPECT_TRUE(names().empty());
}

INSTANTIATE_TEST_SUITE_P(
    Program, BadUsage,
    testing::Values(
        Wrong{"UnknownVerb", {"optimise", "a.vtu"}, "did you mean 'optimize'?"},
        Wrong{"OptionInsteadOfVerb", {"--quiet"}, "expected a verb"},
        Wrong{"UnknownOption", {"optimize", "a.vtu", "-o", "b.vtu", "--gama", "1"}, "unknown option --gama"},
        Wrong{"OptionOfTheTable",
              {"optimize", "a.vtu", "-o", "b.vtu", "--gamma", "1"},
              "did you mean --set gamma=VALUE?"},
        Wrong{"NoInput", {"optimize", "-o", "b.vtu"}, "IN is missing"},
        Wrong{"NoOutput", {"optimize", "a.vtu"}, "-o OUT is missing"},
        Wrong{"OutputAsSecondInput", {"optimize", "a.vtu", "b.vtu"}, "-o"},
        Wrong{"TwoInputs", {"optimize", "a.vtu", "c.vtu", "-o", "b.vtu"}, "unexpected argument 'c.vtu'"},
        Wrong{"OptionAsValue", {"optimize", "a.vtu", "-o", "--quiet"}, "found the option --quiet"},
        Wrong{"UnknownSuffix", {"optimize", "a.vtu", "-o", "b.xyz"}, "the suffix names no format that temper writes"},
        Wrong{"UnknownEnergy", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "energy=bp"}, "did you mean 'BP'?"},
        Wrong{"UnknownSolver", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "solver=newtn"}, "did you mean 'newton'?"},
        Wrong{"UnknownStar", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "star=4"}, "'4' is none of 0, 1, 2, 3, all"},
        Wrong{"GammaNotANumber",
              {"optimize", "a.vtu", "-o", "b.vtu", "--set", "gamma=1e:absolute"},
              "'1e' is not a number"},
        Wrong{"GammaNegative", {"optimize", "a.vtu", "-o", "b.vtu", "--set=gamma=-1:absolute"}, "it must be > 0"},
        Wrong{"SetTwice",
              {"optimize", "a.vtu", "-o", "b.vtu", "--set", "gamma=1:absolute", "--set", "gamma=1"},
              "gamma is set more than once"},
        Wrong{"GammaInfinite",
              {"optimize", "a.vtu", "-o", "b.vtu", "--set", "gamma=inf:absolute"},
              "'inf' is not a number"},
        Wrong{"SweepsNegative", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "max_sweeps=-1"}, "it must be >= 0"},
        Wrong{
            "SweepsNotWhole", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "max_sweeps=1.5"}, "is not a whole number"},
        Wrong{"SweepsTooLarge", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "max_sweeps=99999999999"}, "too large"},
        Wrong{"RelaxationTooLarge", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "relaxation=2"}, "between 0 and 2"},
        Wrong{"NoValue", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "gamma"}, "expected NAME=VALUE, found 'gamma'"},
        Wrong{"NothingToChange",
              {"optimize", "a.vtu", "-o", "b.vtu", "--keep", "positions,weights"},
              "nothing can change"},
        Wrong{"SchemeOfAnotherTarget",
              {"optimize", "a.vtu", "-o", "b.vtu", "--for", "cell", "--set", "scheme=vertex"},
              "target 'cell', which stands for --set scheme=cell, contradicts --set scheme=vertex"},
        Wrong{"WeightsOfATargetWithout",
              {"optimize", "a.vtu", "-o", "b.vtu", "--for", "mpas", "--set", "unknowns=weights"},
              "contradicts --set unknowns=weights"},
        Wrong{"PositionsThatSlide",
              {"optimize", "a.vtu", "-o", "b.vtu", "--keep", "positions", "--boundary", "slide"},
              "keep 'positions' contradicts --boundary slide"},
        Wrong{"TargetAsOption", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "target=cell"}, "did you mean --for?"},
        Wrong{"FlagAsOption", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "keep=weights"}, "did you mean --keep?"},
        Wrong{"RequireTwoValues",
              {"check", "a.vtu", "--require", "inverted=0", "--require", "inverted=1"},
              "no mesh meets both inverted=1 and inverted=0"},
        Wrong{"RequireEmptyRange",
              {"check", "a.vtu", "--require", "min_angle>=30,min_angle<=20"},
              "no mesh meets both min_angle>=30 and min_angle<=20"},
        Wrong{"KeepUnknown", {"optimize", "a.vtu", "-o", "b.vtu", "--keep", "position"}, "did you mean 'positions'?"},
        Wrong{"ReportIsOutput",
              {"optimize", "a.vtu", "-o", "b.csv", "--format", "vtu", "--write", "./b.csv"},
              "another output already"},
        Wrong{"ReportIsInput", {"optimize", "a.json", "-o", "b.vtu", "--write", "a.json"}, "is the input mesh"},
        Wrong{"OutputOfNoKind",
              {"optimize", "a.vtu", "-o", "b.vtu", "--write", "c.txt"},
              "the suffix of c.txt names no output"},
        Wrong{"UnknownMethod", {"optimize", "a.vtu", "-o", "b.vtu", "--for", "papr"}, "did you mean 'paper'?"},
        Wrong{
            "UnknownRemoval", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "removal=Patch"}, "did you mean 'patch'?"},
        Wrong{"UnknownFlips",
              {"optimize", "a.vtu", "-o", "b.vtu", "--set", "flips=never"},
              "none of immediate, deferred"},
        Wrong{"CollapseByABarrier",
              {"optimize", "a.vtu", "-o", "b.vtu", "--set", "collapse_energy=BP"},
              "'BP' is none of F, T, dT"},
        Wrong{"CollapseRatioOne", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "collapse_ratio=1"}, "between 0 and 1"},
        Wrong{"CollapseFromAWord", {"optimize", "a.vtu", "-o", "b.vtu", "--set", "collapse_from=soon"}, "whole number"},
        Wrong{"ReplayWithoutTrace", {"paper", "replay", "a.vtu", "-o", "b.vtu"}, "TRACE is required"},
        Wrong{"RequireUnknownKey", {"check", "a.vtu", "--require", "outsid=0"}, "did you mean 'outside'?"},
        Wrong{"RequireListsKeysAlike",
              {"check", "a.vtu", "--require", "min_nothing=0"},
              "; there are min_coefficient, min_h, min_d, min_angle"},
        Wrong{"RequireNoValue", {"check", "a.vtu", "--require", "nowhere"}, "unknown key 'nowhere'. Next: "},
        Wrong{"RequireNoUsualValue",
              {"check", "a.vtu", "--require", "smoothness"},
              "'smoothness' has no usual value: write smoothness<=VALUE"},
        Wrong{"RequireNotANumber", {"check", "a.vtu", "--require", "outside=no"}, "'no' is not a number"},
        Wrong{"RequireEmptyPart", {"check", "a.vtu", "--require", "outside=0,"}, "'' is not key=value"},
        Wrong{"RequireLess", {"check", "a.vtu", "--require", "outside<5"}, "write <= or >="},
        Wrong{"ZoomShort", {"draw", "a.vtu", "-o", "a.svg", "--zoom", "0,0,1"}, "x0,y0,x1,y1"},
        Wrong{"ZoomEmpty", {"draw", "a.vtu", "-o", "a.svg", "--zoom", "1,0,0,1"}, "x0 < x1"},
        Wrong{"MeshNoSize", {"mesh", "a.poly", "-o", "a.vtu"}, "--size is missing"},
        Wrong{"MeshFewSize",
              {"mesh", "a.poly", "-o", "a.vtu", "--points", "few", "--size", "1"},
              "--size has no effect with --points few. Next: "},
        Wrong{"MeshFewGrade",
              {"mesh", "a.poly", "-o", "a.vtu", "--points", "few", "--grade", "0.2"},
              "--grade has no effect with --points few. Next: "},
        Wrong{"MeshFewSphere", {"mesh", "--sphere", "-o", "a.vtu", "--points", "few"}, "is for the plane. Next: "},
        Wrong{"MeshFewPlain",
              {"mesh", "a.poly", "-o", "a.vtu", "--points", "few", "--no-optimize"},
              "needs the optimization. Next: "},
        Wrong{"MeshOverOutline", {"mesh", "a.poly", "-o", "a.node", "--size", "1"}, "is an input"},
        Wrong{"ReportOverField",
              {"optimize", "a.vtu", "-o", "b.vtu", "--write", "f.json", "--size", "f.json"},
              "is an input"},
        Wrong{"DrawOverInput", {"draw", "a.vtu", "-o", "a.vtu"}, "is the input mesh"},
        Wrong{"UnknownFormat", {"convert", "a.vtu", "-o", "b", "--format", "vtx"}, "did you mean 'vtu'?"},
        Wrong{"ExampleNoName", {"example", "-o", "a.vtu"}, "NAME is missing"},
        Wrong{"ExampleUnknown", {"example", "horsehoe", "-o", "a.vtu"}, "did you mean 'horseshoe'?"},
        Wrong{"ExampleNoOutput", {"example", "horseshoe"}, "--output is required"},
        Wrong{"ExampleOptionOfAnother",
              {"example", "horseshoe", "--rings", "3", "-o", "a.vtu"},
              "unknown option --rings"},
        Wrong{"PolygonOdd", {"example", "random", "--polygon", "0,0,1,0,1", "-o", "a.vtu"}, "not a list of numbers"}),
    [](const testing::TestParamInfo<Wrong>& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace temper::test
