// temper optimize --checkpoint and --resume: whatever stops a run, the one that goes on ends with its bytes.
#include "temper/checkpoint.hpp"

#include <signal.h>

#include <chrono>
#include <thread>

#include "support/sanitizers.hpp"
#include "temper/envelope.hpp"
#include "temper/generate.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

/// All but times, and what was said about how long it may take, on how many threads.
Json without_times(Json json) {
  if (json.is_object()) {
    for (const char* key : {"seconds", "time-limit", "threads", "command"}) json.erase(key);
  }
  if (json.is_structured()) {
    for (Json& inner : json) inner = without_times(inner);
  }
  return json;
}

struct Sample {
  const char* name;
  std::string example;  ///< that makes IN
  std::vector<std::string> options;
};

class Checkpoint : public Workshop {
 protected:
  static constexpr const char* kOutputs[] = {"out.vtu", "t.jsonl", "h.csv", "p.svg"};

  /// The run that is not stopped leaves its outputs in whole.*.
  static void run_whole(const std::vector<std::string>& arguments) {
    temper_ok(arguments);
    for (const char* path : kOutputs) {
      if (exists(path)) std::filesystem::rename(path, std::string("whole.") + path);
    }
    std::filesystem::rename("r.json", "whole.r.json");
    std::filesystem::remove("run.ckpt");
  }
  static void expect_whole() {
    for (const char* path : {"out.vtu", "t.jsonl", "p.svg"}) {
      const std::string whole = std::string("whole.") + path;
      ASSERT_EQ(exists(path), exists(whole)) << path;
      EXPECT_TRUE(!exists(path) || read(path) == read(whole)) << path;
    }
    const Json difference = Json::diff(without_times(read_json("whole.r.json")), without_times(read_json("r.json")));
    EXPECT_EQ(difference.size(), 0u) << difference.dump(2).substr(0, 1000);
  }
  static void make_size_field() {
    const Mesh mesh = *random_points({.vertices = 100, .seed = 9});
    io::MeshFile file = io::from_mesh(mesh);
    file.point_data.push_back({"size", 1, std::vector<double>(mesh.n_vertices(), 0.05)});
    ASSERT_TRUE(io::write("field.vtu", file));
  }
  /// Short runs, each a little longer than the one before. Returns how many were stopped.
  static int run_in_pieces(std::vector<std::string> first) {
    double limit = 0.004;
    first.insert(first.end(), {"--time-limit", std::to_string(limit)});
    int stopped = 0;
    Outcome outcome = temper(first);
    while (outcome.exit == 4) {
      ++stopped;
      EXPECT_TRUE(contains(outcome.out, "to go on: temper optimize --resume run.ckpt"));
      limit *= TEMPER_SANITIZED ? 4 : 1.8;
      for (const char* input : {"in.vtu", "field.vtu"}) std::filesystem::remove(input);  // they are in the checkpoint
      const char* threads = stopped % 2 == 0 ? "1" : "2";
      outcome =
          temper({"optimize", "--resume", "run.ckpt", "--time-limit", std::to_string(limit), "--threads", threads});
    }
    EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
    return stopped;
  }
};

TEST_F(Checkpoint, ARunInPiecesEndsWithTheBytesOfTheWholeRun) {
  // Long enough to be stopped several times.
  const std::string plain = TEMPER_SANITIZED ? "random --vertices 300" : "random --vertices 2000";
  const std::string trials = TEMPER_SANITIZED ? "5" : "100";
  const std::string few = TEMPER_SANITIZED ? "random --vertices 250" : "random --vertices 500";
  const Sample samples[] = {
      {"plain", plain, {"--trace", "t.jsonl", "--draw", "p.svg", "--history", "h.csv"}},
      {"paper", "random --vertices 200", {"--method", "paper", "--energy", "dT", "--trace", "t.jsonl"}},
      {"deferred", few, {"--energy", "T", "--flips", "deferred", "--inner", "3"}},
      {"accuracy", few, {"--objective", "accuracy", "--boundary", "split"}},
      {"repairs", "horseshoe", {"--repair", "vertices", "--repair-trials", trials, "--trace", "t.jsonl"}},
      {"removal", few, {"--removal", "patch", "--removal-from", "2", "--hidden", "remove"}},
      {"weights", "airfoil", {"--weights-only", "--no-flips", "--anchor", "3"}},
      {"sizes",
       few,
       {"--size-band", "2", "--size-field", "field.vtu", "--order", "random", "--max-sweeps", "60", "--repair",
        "none"}}};
  int all_stopped = 0;
  for (const auto& [name, example, options] : samples) {
    SCOPED_TRACE(name);
    ASSERT_EQ(shell("temper example " + example + " -o in.vtu").exit, 0);
    if (std::string(name) == "sizes") make_size_field();
    std::vector<std::string> arguments = {"optimize", "in.vtu",       "-o",       "out.vtu",   "--report",
                                          "r.json",   "--checkpoint", "run.ckpt", "--threads", "1"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    run_whole(arguments);
    const int stopped = run_in_pieces(arguments);
    all_stopped += stopped;
    EXPECT_GT(stopped, 0);
    expect_whole();
    for (const std::string& path : names()) std::filesystem::remove(path);
  }
  EXPECT_GT(all_stopped, 12);
}

TEST_F(Checkpoint, DataDegreesAndMarksComeBackFromIt) {
  const Mesh mesh = *random_points({.vertices = 400, .seed = 4});
  io::MeshFile file = io::from_mesh(mesh);
  for (Vec2& p : file.points) p = {3 + p.x, 50 + p.y};
  std::vector<double> depth;
  std::vector<std::int32_t> kind;
  for (const Vec2 p : file.points) depth.push_back(p.x * p.y), kind.push_back(p.x > 3.5 ? 1 : 0);
  file.point_data.push_back({"depth", 1, depth});
  file.point_data.push_back({"kind", 1, kind});
  file.cell_data.push_back({"soil", 1, std::vector<float>(mesh.n_triangles(), 0.5F)});
  ASSERT_TRUE(io::write("in.vtu", file));
  const std::vector<std::string> arguments = {
      "optimize",     "in.vtu",      "-o",           "out.vtu",    "--projection", "stereographic",
      "--point-data", "interpolate", "--point-data", "keep=depth", "--report",     "r.json",
      "--checkpoint", "run.ckpt",    "--every",      "0",          "--threads",    "1",
      "--draw",       "p.svg"};
  run_whole(arguments);
  EXPECT_GT(run_in_pieces(arguments), 0);
  expect_whole();
}

TEST_F(Checkpoint, ARunThatIsKilledGoesOnFromItsFile) {
  temper_ok({"example", "random", "--vertices", TEMPER_SANITIZED ? "2500" : "8000", "-o", "in.vtu"});
  const std::vector<std::string> arguments = {"optimize",     "in.vtu",   "-o",      "in.vtu", "--report",  "r.json",
                                              "--checkpoint", "run.ckpt", "--every", "0",      "--threads", "1"};
  const std::string input = read("in.vtu");
  temper_ok(arguments);
  const std::string whole = read("in.vtu");
  const Json report = without_times(read_json("r.json"));
  for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
    SCOPED_TRACE(signal);
    write("in.vtu", input);
    for (const char* path : {"run.ckpt", "r.json"}) std::filesystem::remove(path);
    const pid_t process = start(arguments, "out.txt", "err.txt");
    for (int i = 0; i < 3000 && !exists("run.ckpt"); ++i) std::this_thread::sleep_for(10ms);
    std::this_thread::sleep_for(60ms);
    kill(process, signal);
    EXPECT_EQ(wait_for(process), signal == SIGKILL ? -SIGKILL : 4);
    temper_ok({"optimize", "--resume", "run.ckpt"});
    EXPECT_TRUE(read("in.vtu") == whole);
    EXPECT_EQ(without_times(read_json("r.json")), report);
  }
}

TEST_F(Checkpoint, ThatIsNotOneIsRefusedAndNothingIsWritten) {
  make_input();
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--checkpoint", "run.ckpt", "--quiet"});
  const std::string bytes = read("run.ckpt");
  std::filesystem::remove("out.vtu");
  const auto refused = [&](const std::string& content, const std::string& why) {
    write("bad.ckpt", content);
    const Outcome outcome = temper({"optimize", "--resume", "bad.ckpt"});
    EXPECT_EQ(outcome.exit, 1) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "bad.ckpt: " + why));
    EXPECT_FALSE(exists("out.vtu"));
  };
  refused("", "the file is empty");
  refused(read("in.vtu"), "is no temper checkpoint");
  refused("temper checkpoint, version 99.1\n" + bytes.substr(40), "is a temper checkpoint, version 99.1, and this is");
  refused(bytes.substr(0, bytes.size() / 2), "is cut off");
  refused(bytes.substr(0, 20), "is cut off in its first line");
  refused(bytes + "x", "is damaged: it has more bytes");
  std::string changed = bytes;
  changed[bytes.size() / 2] = static_cast<char>(changed[bytes.size() / 2] ^ 4);
  refused(changed, "is damaged: its checksum");
  const std::string inner(*from_envelope("temper checkpoint", bytes));
  refused(in_envelope("temper checkpoint", inner.substr(0, inner.size() - 9)), "was written by another build");
  refused(in_envelope("temper checkpoint", std::string(200, '\0')), "was written by another build");
}

TEST_F(Checkpoint, TakesNoOptionAnewThatTheResultDependsOn) {
  make_input();
  temper_ok({"optimize", "in.vtu", "-o", "out.vtu", "--checkpoint", "run.ckpt"});
  const auto refused = [](const std::vector<std::string>& more, const std::string& why) {
    std::vector<std::string> arguments = {"optimize", "--resume", "run.ckpt"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err, why));
  };
  refused({"--gamma", "1"}, "--gamma is that of the run that is resumed");
  refused({"in.vtu"}, "IN is that of the run that is resumed");
  refused({"--max-sweeps", "3", "--quiet"}, "--max-sweeps is that of the run");
  refused({"--trace", "t.jsonl"}, "--trace: the run was not traced from its beginning");
  refused({"--report", "in.vtu"}, "is the input mesh");
  temper_ok({"optimize", "--resume", "run.ckpt", "-o", "other.vtu", "--encoding", "ascii", "--no-triangle-quality",
             "--report", "r.json", "--html", "r.html", "--history", "h.csv", "--draw", "p.svg", "--require",
             "outside=0", "--quiet"});
  for (const char* output : {"other.vtu", "r.html", "h.csv", "p.svg"}) EXPECT_TRUE(exists(output)) << output;
  temper_ok({"optimize", "--resume", "run.ckpt", "-o", "other", "--format", "gmsh41"});
  EXPECT_EQ(read_json("r.json")["options"]["resume"], nullptr);
  const Outcome idle = temper({"optimize", "in.vtu", "-o", "out.vtu", "--every", "3"});
  EXPECT_TRUE(contains(idle.err, "--every has no effect without --checkpoint"));
}

}  // namespace
}  // namespace temper::test
