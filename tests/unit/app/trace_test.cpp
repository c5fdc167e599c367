// temper optimize --write and temper replay: the same bytes, and every trace that is none or another's refused.
#include <signal.h>

#include <chrono>
#include <map>
#include <numeric>
#include <sstream>
#include <thread>

#include "support/sanitizers.hpp"
#include "temper/generate.hpp"
#include "temper/io.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class Trace : public Workshop {
 protected:
  static std::vector<std::string> lines(const std::string& path) {
    std::istringstream file(read(path));
    std::vector<std::string> all;
    for (std::string line; std::getline(file, line);) all.push_back(line);
    return all;
  }
  static void expect_replay_gives(const std::string& input, const std::string& output) {
    const std::string again = "again." + output;
    const Outcome outcome = temper({"paper", "replay", input, "t.jsonl", "-o", again});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    ASSERT_FALSE(read(output).empty());
    EXPECT_EQ(read(again), read(output));
  }
};

struct Replayed {
  const char* example;
  std::vector<std::string> options;
};

TEST_F(Trace, ReplaysToTheSameBytes) {
  const std::vector<Replayed> samples = {
      {"horseshoe",
       TEMPER_SANITIZED ? std::vector<std::string>{"--set", "max_sweeps=100"} : std::vector<std::string>()},
      {"horseshoe",
       {"--set", "removal=patch", "--set", "removal_from=0", "--set", "removal_margin=0", "--set", "max_sweeps=20"}},
      {"random",
       {"--set", "energy=T", "--set", "collapse_from=1", "--set", "collapse_ratio=0.4", "--set", "max_sweeps=20"}},
      {"random", {"--set", "solver=golden", "--set", "flips=deferred", "--set", "max_sweeps=4"}},
      {"sheared-grid", {"--set", "anchor=3", "--set", "order=random", "--set", "max_sweeps=10"}},
      {"sheared-grid", {"--for", "paper", "--set", "energy=dT", "--set", "max_sweeps=6", "--set", "inversion=refuse"}},
      {"airfoil", {"--keep", "positions", "--keep", "edges", "--set", "max_sweeps=5"}},
      {"random-sphere", {"--set", "max_sweeps=10"}},
      {"random-sphere", {"--keep", "positions", "--set", "max_sweeps=5"}},
      {"random-sphere", {"--keep", "weights", "--set", "max_sweeps=5"}},
  };
  for (const Replayed& sample : samples) {
    SCOPED_TRACE(sample.example);
    std::vector<std::string> make = {"example", sample.example, "-o", "in.vtu"};
    if (std::string(sample.example).starts_with("random"))
      make.insert(make.end(), {"--vertices", TEMPER_SANITIZED ? "80" : "200"});
    temper_ok(make);
    std::vector<std::string> arguments = {"optimize", "in.vtu", "-o", "out.vtu", "--write", "t.jsonl", "--quiet"};
    arguments.insert(arguments.end(), sample.options.begin(), sample.options.end());
    temper_ok(arguments);
    EXPECT_GT(lines("t.jsonl").size(), 1u);
    expect_replay_gives("in.vtu", "out.vtu");
  }
}

// Numbers from 1, a point of no triangle, clockwise triangles, tags, data: all that stands between a file and its
// mesh.
TEST_F(Trace, ReplaysInEveryFormatWithDataAndDroppedPoints) {
  temper_ok({"example", "random", "--vertices", "150", "-o", "random.vtu"});
  for (const char* name : {"m.msh", "m.msh2", "m.mesh", "m.obj", "m.node", "m.vtu"}) {
    SCOPED_TRACE(name);
    temper_ok({"convert", "random.vtu", "-o", name});
    const std::string output = std::string("out.") + name;
    temper_ok({"optimize", name, "-o", output, "--write", "t.jsonl", "--quiet", "--set", "removal=patch", "--set",
               "removal_from=0", "--set", "removal_margin=0", "--set", "max_sweeps=15"});
    EXPECT_EQ(temper({"check", output, "--require", "vertices=150"}).exit, 3) << "nothing was removed";
    expect_replay_gives(name, output);
  }
  write("odd.mesh",
        "MeshVersionFormatted 2\nDimension 2\nVertices\n7\n9 9 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n8 8 0\n0.3 0.4 0\n"
        "Edges\n2\n2 3 11\n3 4 12\nTriangles\n4\n3 2 7 0\n3 4 7 0\n4 5 7 0\n5 2 7 0\nEnd\n");
  temper_ok({"optimize", "odd.mesh", "-o", "out.mesh", "--write", "t.jsonl", "--quiet"});
  expect_replay_gives("odd.mesh", "out.mesh");
  std::size_t moves = 0;
  for (const std::string& line : lines("t.jsonl")) {
    const nlohmann::json event = nlohmann::json::parse(line);
    if (event.value("event", "") != "move") continue;
    EXPECT_EQ(event["vertex"], 6) << "position in the file, from 0";
    ++moves;
  }
  EXPECT_GT(moves, 0u);
}

/// Values of an array as doubles, whatever their type.
std::vector<double> numbers(const std::vector<io::DataArray>& arrays, const std::string& name) {
  for (const io::DataArray& array : arrays) {
    if (array.name != name) continue;
    return std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
                      array.values);
  }
  return {};
}

TEST_F(Trace, PointsThatAreLeftKeepTheirDataWhenToldTo) {
  const auto mesh = random_mesh({.vertices = 150});
  ASSERT_TRUE(mesh);
  io::MeshFile file = io::from_mesh(*mesh);
  std::vector<double> id(file.points.size()), one(file.triangles.size(), 1), number(file.triangles.size());
  std::iota(id.begin(), id.end(), 0.0);
  std::iota(number.begin(), number.end(), 0.0);
  file.point_data = {{"id", 1, id}};
  file.triangles.data = {{"one", 1, one}, {"number", 1, number}};
  for (const char* name : {"m.vtu", "m.msh", "m.msh2", "m.node"}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(io::write(name, file));
    const std::string output = std::string("out.") + name;
    const Outcome outcome =
        temper_ok({"optimize", name, "-o", output, "--write", "t.jsonl", "--quiet", "--set", "removal=patch", "--set",
                   "removal_from=0", "--set", "removal_margin=0", "--set", "max_sweeps=15", "--point-data", "keep=id"});
    EXPECT_FALSE(contains(outcome.err, "dropped"));
    std::vector<double> left = id;
    for (const std::string& line : lines("t.jsonl")) {
      const nlohmann::json event = nlohmann::json::parse(line);
      if (event.value("event", "") == "removal") std::erase(left, event["vertex"].get<double>());
      ASSERT_FALSE(event.contains("to")) << "the removals of this run count as they are";
    }
    ASSERT_LT(left.size(), id.size());
    const auto result = io::read(output);
    ASSERT_TRUE(result) << result.error().what();
    EXPECT_EQ(numbers(result->point_data, "id"), left);
    EXPECT_EQ(numbers(result->triangles.data, "one"), std::vector<double>(result->triangles.size(), 1));
    for (const double n : numbers(result->triangles.data, "number")) EXPECT_TRUE(n >= 0 && n < number.back() + 1);
    EXPECT_EQ(numbers(result->triangles.data, "number").size(), result->triangles.size());
  }
}

TEST_F(Trace, EveryLineIsAnObjectWithItsKeys) {
  temper_ok({"example", "horseshoe", "-o", "in.vtu"});
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "t.jsonl", "--set", "removal=patch", "--set",
             "removal_from=0", "--write", "r.json", "--quiet"});
  const std::vector<std::string> all = lines("t.jsonl");
  ASSERT_GT(all.size(), 100u);
  const nlohmann::json header = nlohmann::json::parse(all[0]);
  EXPECT_EQ(header["temper"], TEMPER_VERSION);
  EXPECT_EQ(header["trace"], 2);
  EXPECT_EQ(header["input"], "in.vtu");
  EXPECT_EQ(header["vertices"], 63);
  EXPECT_EQ(header["triangles"], 96);
  const std::map<std::string, std::vector<std::string>> keys = {{"move", {"vertex", "x", "y", "w"}},
                                                                {"weight", {"vertex", "w"}},
                                                                {"flip", {"edge", "opposite"}},
                                                                {"removal", {"vertex", "link", "triangles"}},
                                                                {"undo", {}}};
  std::map<std::string, int> seen;
  const nlohmann::json end = nlohmann::json::parse(all.back());
  EXPECT_EQ(end["event"], "end");
  EXPECT_EQ(end["events"], all.size() - 2);
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    const nlohmann::json event = nlohmann::json::parse(all[i]);
    const std::string kind = event["event"];
    ++seen[kind];
    ASSERT_TRUE(keys.count(kind)) << all[i];
    for (const char* key : {"sweep", "before", "after"}) EXPECT_TRUE(event.contains(key)) << all[i];
    for (const std::string& key : keys.at(kind)) EXPECT_TRUE(event.contains(key)) << all[i];
  }
  for (const char* kind : {"move", "flip", "removal"}) EXPECT_GT(seen[kind], 0) << kind;
  const nlohmann::json report = read_json("r.json");
  EXPECT_GT(report["vertices_removed"], 0);
  EXPECT_EQ(end["vertices"], report["after"]["vertices"]);
  EXPECT_EQ(end["triangles"], report["after"]["triangles"]);
  EXPECT_TRUE(report["hidden_vertices"].is_array());
}

TEST_F(Trace, ReplayStopsAfterASweepWhenAsked) {
  make_input();
  temper_ok({"optimize", "in.vtu", "-o", "three.vtu", "--set", "max_sweeps=3", "--write", "t.jsonl", "--quiet"});
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--set", "max_sweeps=6", "--write", "t.jsonl", "--quiet"});
  const Outcome outcome = temper_ok({"paper", "replay", "in.vtu", "t.jsonl", "-o", "again.vtu", "--sweeps", "3"});
  EXPECT_EQ(read("again.vtu"), read("three.vtu"));
  EXPECT_TRUE(contains(outcome.out, "wrote again.vtu"));
  EXPECT_EQ(temper_ok({"paper", "replay", "in.vtu", "t.jsonl", "-o", "again.vtu", "--quiet"}).out, "");
  EXPECT_EQ(read("again.vtu"), read("out.vtu"));
}

TEST_F(Trace, OfARunStoppedByASignalIsThatOfItsMesh) {
  temper_ok({"example", "random", "--vertices", "5000", "-o", "in.vtu"});
  const pid_t process = start({"optimize", "in.vtu", "-o", "out.vtu", "--set", "max_sweeps=1000000", "--set",
                               "tolerance=0", "--write", "t.jsonl"},
                              "out.txt", "err.txt");
  for (int i = 0; i < 3000 && read("out.txt").find("vertices") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(exists("t.jsonl"));
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 4) << read("err.txt");
  expect_replay_gives("in.vtu", "out.vtu");
  EXPECT_EQ(names(), (std::vector<std::string>{"again.out.vtu", "err.txt", "in.vtu", "out.txt", "out.vtu", "t.jsonl"}));
}

TEST_F(Trace, NothingIsLeftOfOneWhoseRunFailed) {
  temper_ok({"example", "horseshoe", "-o", "in.vtu"});
  EXPECT_EQ(temper({"optimize", "in.vtu", "-o", "out.vtu", "--set", "energy=BH", "--write", "t.jsonl"}).exit, 2);
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
}

TEST_F(Trace, WrongOnesAreRefusedWithTheirLine) {
  make_input();
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "t.jsonl", "--quiet"});
  const std::string header = lines("t.jsonl").at(0) + "\n";
  const auto expect_refused = [&](const std::string& trace, const std::string& message) {
    write("bad.jsonl", trace);
    const Outcome outcome = temper({"paper", "replay", "in.vtu", "bad.jsonl", "-o", "no.vtu"});
    EXPECT_EQ(outcome.exit, 1) << message;
    EXPECT_TRUE(contains(outcome.err, "temper: error: bad.jsonl" + message));
    EXPECT_FALSE(exists("no.vtu"));
  };
  const std::string move = R"({"event":"move","sweep":1,"vertex":8,"before":null,"after":1,"x":0.3,"y":0.2,"w":0})";
  const std::string end = "{\"event\":\"end\",\"events\":1}\n";
  write("good.jsonl", header + move + "\n" + end);
  temper_ok({"paper", "replay", "in.vtu", "good.jsonl", "-o", "moved.vtu"});

  expect_refused("", ": the file is empty");
  expect_refused(header + "{\"event\":" + std::string(200000, '[') + "\n", ":2: is nested more than 16 deep");
  expect_refused("$MeshFormat\n", ":1: is no JSON object");
  expect_refused("{\"a\":1}\n", ":1: is not the header of a trace");
  expect_refused("{\"trace\":3}\n", ":1: is a trace of version 3; this temper reads version 2");
  expect_refused("{\"trace\":1}\n", ":1: is a trace of version 1, which has no end line");
  expect_refused(header, ": has no end line: only the first 0 events of it are there");
  expect_refused(header + move + "\n", ": has no end line: only the first 1 events of it are there");
  expect_refused(header + move + "\n" + move + "\n" + end, ":4: ends a trace of 1 events, but 2 are before it");
  expect_refused(header + move + "\n" + end + move + "\n", ":4: follows the end of the trace");
  expect_refused(header + move + "\n{\"event\":\"end\",\"events\":1,\"triangles\":1}\n",
                 ":3: is the end of another mesh than the events make");
  expect_refused(header + move + "\n{\"event\":\"end\",\"events\":1,\"checksum\":\"0123456789abcdef\"}\n",
                 ":3: is the end of another mesh than the events make");
  std::string other = header;
  other.replace(other.find("\"vertices\":49"), 13, "\"vertices\":50");
  expect_refused(other, ":1: is of a mesh of 50 vertices (in.vtu), but in.vtu has 49");
  other = header;
  other[other.find("checksum\":\"") + 11] ^= 1;
  expect_refused(other, ":1: is of another mesh (in.vtu) of as many vertices and triangles as in.vtu");
  expect_refused(header + move + "\n{\"event\":\n", ":3: is no JSON object: column");
  expect_refused(header + move + "\n" + move.substr(0, 30), ":3: the file ends within an event");
  expect_refused(header + "\n", ":2: is no JSON object");
  expect_refused(header + "{\"event\":\"mov\",\"sweep\":1}\n", ":2: event 'mov' is none of move, weight, flip");
  expect_refused(header + "{\"event\":\"move\",\"sweep\":1}\n", ":2: has no \"vertex\"");
  expect_refused(header + "{\"event\":\"move\",\"sweep\":1,\"vertex\":49}\n",
                 ":2: \"vertex\" has vertex 49, but in.vtu has 49 points, numbered from 0");
  expect_refused(header + "{\"event\":\"weight\",\"sweep\":1,\"vertex\":1,\"w\":\"big\"}\n",
                 ":2: expected a number as \"w\", found \"big\"");
  expect_refused(header + "{\"event\":\"weight\",\"sweep\":1,\"vertex\":1,\"w\":null}\n",
                 ":2: expected a number as \"w\", found null");
  expect_refused(header + "{\"event\":\"flip\",\"sweep\":1,\"edge\":[1],\"opposite\":[2,3]}\n",
                 ":2: expected 2 vertices as \"edge\", found [1]");
  expect_refused(header + move + "\n{\"event\":\"flip\",\"sweep\":1,\"edge\":[0,48],\"opposite\":[2,3]}\n" +
                     "{\"event\":\"end\",\"events\":2}\n",
                 ":3: flip of the edge from point 0 to point 48, which is not in the mesh");
  expect_refused(header + "{\"event\":\"undo\",\"sweep\":1,\"to\":4}\n" + end,
                 ":2: undo in sweep 1 to the end of sweep 4, which has not been");
  const Outcome missing = temper({"paper", "replay", "in.vtu", "none.jsonl", "-o", "no.vtu"});
  EXPECT_EQ(missing.exit, 1);
  EXPECT_TRUE(contains(missing.err, "none.jsonl: cannot be read: No such file or directory"));
}

// --- the paper's switches ---------------------------------------------------------------------------------------

TEST_F(Trace, TargetPaperChangesTheDefaultsAndGivenOptionsWin) {
  make_input();
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "--quiet", "--set", "tolerance=0.5", "--for",
             "paper", "--set", "max_sweeps=2", "--set", "removal=none", "--set", "collapse_from=none"});
  const nlohmann::json settings = read_json("r.json")["settings"];
  EXPECT_EQ(settings["solver"], "golden");
  EXPECT_EQ(settings["flips"], "deferred");
  EXPECT_EQ(settings["flip_limit"], "unlimited");
  EXPECT_EQ(settings["inversion"], "allow");
  EXPECT_EQ(settings["hidden"], "keep");
  EXPECT_EQ(settings["order"], "input");
  EXPECT_EQ(settings["gamma"], "1:absolute");
  EXPECT_EQ(settings["removal_measure"], "sum");
  EXPECT_EQ(settings["stopping"], "paper");
  EXPECT_EQ(settings["tolerance"], 0.5) << "given before --for";
  EXPECT_EQ(settings["removal"], "none");
  EXPECT_TRUE(settings["collapse_from"].is_null());
}

TEST_F(Trace, TheCommandOfAnyMethodGivesTheSameBytes) {
  temper_ok({"example", "horseshoe", "-o", "in.vtu"});
  const std::vector<std::vector<std::string>> runs = {
      {"--for", "paper", "--set", "max_sweeps=3", "--set", "inversion=refuse"},
      {"--for", "paper", "--set", "max_sweeps=3", "--set", "gamma=0.3", "--set", "anchor=none", "--set", "energy=T"},
      {"--set", "removal=patch", "--set", "collapse_from=2", "--set", "hidden=remove", "--set", "order=reverse",
       "--set", "max_sweeps=15"},
      {"--set", "solver=alternating", "--set", "weight_updates=deferred", "--set", "flips=none", "--unknown"},
  };
  for (std::vector<std::string> options : runs) {
    const bool wrong = options.back() == "--unknown";
    std::vector<std::string> arguments = {"optimize", "in.vtu", "-o", "out.vtu", "--write", "r.json", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    if (wrong) {
      EXPECT_EQ(temper(arguments).exit, 2);
      continue;
    }
    temper_ok(arguments);
    const std::string first = read("out.vtu");
    std::filesystem::remove("out.vtu");
    const std::string command = read_json("r.json")["command"];
    EXPECT_EQ(shell(command).exit, 0) << command;
    EXPECT_EQ(read("out.vtu"), first) << command;
  }
}

TEST_F(Trace, FlipsNoneIsNoFlipsAndKeepsEveryEdge) {
  make_input();
  temper_ok({"optimize", "in.vtu", "-o", "a.vtu", "--set", "flips=none", "--set", "max_sweeps=5", "--write", "r.json"});
  EXPECT_EQ(read_json("r.json")["flips"], 0);
  temper_ok({"optimize", "in.vtu", "-o", "b.vtu", "--keep", "edges", "--quiet", "--set", "max_sweeps=5"});
  EXPECT_EQ(read("a.vtu"), read("b.vtu"));
  const auto input = *io::read("in.vtu"), output = *io::read("a.vtu");
  EXPECT_EQ(output.triangles.corners, input.triangles.corners);
  EXPECT_NE(output.points, input.points);
  temper_ok({"optimize", "in.vtu", "-o", "c.vtu", "--set", "max_sweeps=5", "--write", "r.json"});
  EXPECT_GT(read_json("r.json")["flips"], 0);
  EXPECT_NE(io::read("c.vtu")->triangles.corners, input.triangles.corners);
}

TEST_F(Trace, RemovalsAreSaidAndCounted) {
  temper_ok({"example", "horseshoe", "-o", "in.vtu"});
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--set", "removal=patch", "--set",
                                     "removal_from=0", "--write", "r.json"});
  const nlohmann::json report = read_json("r.json");
  const std::size_t removed = report["vertices_removed"];
  ASSERT_GT(removed, 1u);
  EXPECT_TRUE(contains(outcome.out, std::to_string(removed) + " vertices removed"));
  EXPECT_EQ(report["after"]["vertices"], 63 - removed);
  EXPECT_EQ(report["after"], numbers_of("out.vtu"));
}

TEST_F(Trace, SwitchesThatDoNothingAloneAreNamed) {
  make_input();
  const Outcome outcome = temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--quiet", "--set", "max_sweeps=1", "--set",
                                     "inner=2", "--set", "removal_margin=0.5", "--set", "collapse_ratio=0.2"});
  for (const char* message : {"--set inner=2 has no effect without --set flips=deferred",
                              "--set removal_margin=0.5 has no effect without --set removal=patch",
                              "--set collapse_ratio=0.2 has no effect without collapse_from"}) {
    EXPECT_TRUE(contains(outcome.err, message));
  }
  const Outcome others =
      temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--quiet", "--set", "max_sweeps=1", "--set", "solver=golden",
                 "--set", "relaxation=1.5", "--set", "overshoot=1.2", "--set", "boundary_ratio=3"});
  for (const char* message :
       {"--set relaxation=1.5 has no effect without --set solver=newton or --set solver=alternating",
        "--set overshoot=1.2 has no effect without --set flip_limit=after",
        "--set boundary_ratio=3 has no effect without --boundary split"}) {
    EXPECT_TRUE(contains(others.err, message));
  }
}

TEST_F(Trace, SwitchesThatContradictEachOtherAreRefused) {
  make_input();
  const auto refused = [](std::vector<std::string> options) {
    std::vector<std::string> arguments = {"optimize", "in.vtu", "-o", "no.vtu", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, 2) << outcome.err;
    EXPECT_FALSE(exists("no.vtu"));
    return outcome.err;
  };
  EXPECT_TRUE(contains(refused({"--keep", "edges", "--set", "flips=immediate"}),
                       "keep 'edges' contradicts --set flips=immediate"));
  EXPECT_TRUE(contains(refused({"--for", "paper", "--for", "any"}), "--for is given more than once"));
  EXPECT_TRUE(contains(refused({"--boundary", "split", "--keep", "edges"}), "expected --set flips=immediate"));
  EXPECT_TRUE(contains(refused({"--boundary", "slide", "--set", "inversion=allow", "--set", "flips=deferred"}),
                       "--boundary slide needs --set inversion=refuse"));
  EXPECT_TRUE(contains(refused({"--for", "paper", "--set", "flips=immediate"}), "needs --set flips=deferred"));
  EXPECT_TRUE(contains(refused({"--set", "energy=T", "--set", "energy=BP"}), "energy is set more than once"));
}

// --- the boundary -------------------------------------------------------------------------------------------------

TEST_F(Trace, OfASplitBoundaryReplaysInEveryFormat) {
  temper_ok({"example", "horseshoe", "-o", "horseshoe.vtu"});
  for (const char* name : {"m.msh", "m.msh2", "m.mesh", "m.obj", "m.node", "m.vtu"}) {
    SCOPED_TRACE(name);
    temper_ok({"convert", "horseshoe.vtu", "-o", name});
    const std::string output = std::string("out.") + name;
    const Outcome outcome = temper_ok({"optimize", name, "-o", output, "--write", "t.jsonl", "--boundary", "split",
                                       "--set", "max_sweeps=15", "--set", "repair=none", "--write", "r.json"});
    const nlohmann::json report = read_json("r.json");
    ASSERT_GT(report["vertices_inserted"], 0);
    EXPECT_EQ(report["vertices_removed"], 0);
    EXPECT_TRUE(contains(outcome.out, std::to_string(report["vertices_inserted"].get<int>()) + " vertices inserted"));
    expect_replay_gives(name, output);
    const std::vector<std::string> all = lines("t.jsonl");
    std::size_t splits = 0, inserted = 0;
    for (const std::string& line : all) {
      const nlohmann::json event = nlohmann::json::parse(line);
      const std::string kind = event.value("event", "");
      if (kind != "split" && kind != "insertion") continue;
      EXPECT_GE(event["vertex"], 63);
      splits += kind == "split" ? 1 : 0;
      ++inserted;
    }
    EXPECT_GT(splits, 0u);
    EXPECT_GE(inserted, report["vertices_inserted"].get<std::size_t>());
  }
}

}  // namespace
}  // namespace temper::test
