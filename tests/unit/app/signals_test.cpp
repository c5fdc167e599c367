// Stopping a long run: a signal, a time limit.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "workshop.hpp"

namespace temper::test {
namespace {

using namespace std::chrono_literals;

class Stopping : public Workshop {
 protected:
  // Too many sweeps to end by itself, on a mesh that is large enough for a sweep to take a moment.
  const std::vector<std::string> kLong = {"optimize",           "in.vtu", "-o",          "out.vtu", "--set",
                                          "max_sweeps=1000000", "--set",  "tolerance=0", "--write", "r.json"};

  void SetUp() override { temper_ok({"example", "random", "--vertices", "10000", "-o", "in.vtu"}); }

  /// Starts the long run and returns once it sweeps: the line with the sizes is printed just before.
  pid_t start_long() {
    const pid_t process = start(kLong, "out.txt", "err.txt");
    for (int i = 0; i < 3000 && read("out.txt").find("vertices") == std::string::npos; ++i) {
      std::this_thread::sleep_for(10ms);
    }
    EXPECT_TRUE(contains(read("out.txt"), "vertices"));
    std::this_thread::sleep_for(50ms);
    return process;
  }

  void expect_stopped_early(const char* why) {
    EXPECT_EQ(temper({"check", "out.vtu", "--require", "vertices=10000,inverted=0,nonregular=0"}).exit, 0);
    EXPECT_EQ(read_json("r.json")["stopped"], why);
  }
};

TEST_F(Stopping, TheFirstSignalWritesTheBestMeshAndExitsWith4) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t process = start_long();
    kill(process, signal);
    EXPECT_EQ(wait_for(process), 4);
    expect_stopped_early("canceled");
    EXPECT_TRUE(contains(read("out.txt"), "stopped early by a signal"));
    for (const char* path : {"out.txt", "out.vtu", "r.json"}) std::filesystem::remove(path);
  }
}

TEST_F(Stopping, TheTimeLimitWritesTheBestMeshAndExitsWith4) {
  std::vector<std::string> arguments = kLong;
  arguments.insert(arguments.end(), {"--time-limit", "0.2"});
  const auto begin = std::chrono::steady_clock::now();
  const Outcome outcome = temper(arguments);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 30s);
  EXPECT_EQ(outcome.exit, 4);
  expect_stopped_early("time_limit");
}

// The file comes after a second, and writing is reckoned to take another one: nothing is left of two for the sweeps.
TEST_F(Stopping, TheTimeLimitIsOfTheWholeRun) {
  temper_ok({"example", "random", "--vertices", "400", "-o", "small.off"});
  temper_ok({"optimize", "small.off", "-o", "out.off", "--time-limit", "100", "--quiet"});
  const Outcome outcome = shell(
      "mkfifo late.off; (sleep 1; cat small.off > late.off) & "
      "temper optimize late.off -o out.off --time-limit 2 --write r.json");
  EXPECT_EQ(outcome.exit, 4) << outcome.err;
  EXPECT_EQ(read_json("r.json")["stopped"], "time_limit");
}

// One linear program of all triangles takes minutes.
TEST_F(Stopping, EndsTheSearchForWeightsWith4AndNoFile) {
  const std::vector<std::string> search = {"weights", "in.vtu", "-o", "w.vtu", "--whole", "1000000"};
  std::vector<std::string> limited = search;
  limited.insert(limited.end(), {"--time-limit", "0.2"});
  const Outcome outcome = temper(limited);
  EXPECT_EQ(outcome.exit, 4) << outcome.out;
  EXPECT_TRUE(contains(outcome.err, "stopped by --time-limit after ")) << outcome.err;
  int exit = 0;
  for (auto delay = 500ms; exit != 4 && delay < 10s; delay *= 3) {  // a signal while temper reads kills it
    const pid_t process = start(search, "out.txt", "err.txt");
    std::this_thread::sleep_for(delay);
    kill(process, SIGTERM);
    exit = wait_for(process);
  }
  EXPECT_EQ(exit, 4);
  EXPECT_TRUE(contains(read("err.txt"), "stopped by a signal after ")) << read("err.txt");
  EXPECT_FALSE(exists("w.vtu"));
}

}  // namespace
}  // namespace temper::test
