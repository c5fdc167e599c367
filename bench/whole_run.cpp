// Speed and memory of whole runs on random meshes, all ratios from one run of this program; see docs/performance.md.
//
//   bench_whole_run [--sizes 1000,10000,100000,1000000] [--rounds 3] [--sweeps 10] [--golden-sweeps 3] [--threads N]
//                   [--sweeps-alone] [--temper PATH] [--json FILE] [--check]
//
// --sweeps-alone: nothing but the cost of Newton and accuracy sweeps, for comparing builds. --check: exit 1 when a
// bound is missed. Times are processor time, but for those with several threads. Each measurement has its own process.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "child.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "threads.hpp"
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace temper::bench {
namespace {

constexpr std::size_t kLeastWithThreads = 100000;  // fewer vertices are one part, or few
constexpr std::size_t kMostWithThreads = 1000000;
constexpr std::size_t kRace = 100000;

/// work() in a process of its own.
template <class Work>
auto measured(const char* what, Work&& work) {
  const auto result = in_child(work);
  if (!result) fail(std::string(what) + ": the measurement died");
  return *result;
}

void run_files(Row& row, const Options& options, const std::filesystem::path& folder) {
  const std::string input = folder / "in.vtu", output = folder / "out.vtu";
  make_input(row.vertices, input);
  row.one = measured("run from file to file", [&] { return measure_file_run(input, output, 1); });
  if (kHasThreads && row.vertices >= kLeastWithThreads) {
    row.all = measured("run with threads", [&] { return measure_file_run(input, output, options.threads); });
  }
  if (options.temper.empty() || !std::filesystem::exists(input)) return;
  // Its memory has peaked by then.
  const ProgramRun program =
      run_program({options.temper, "optimize", input, "-o", output, "--max-sweeps", "12", "--quiet"});
  if (!program.ok) fail(options.temper + " optimize failed");
  row.program_peak_bytes = program.peak_bytes;
}

Row measure(std::size_t vertices, const Options& options, const std::filesystem::path& folder) {
  Row row;
  row.vertices = vertices;
  row.costs = measured("sweeps", [&] { return measure_sweeps(vertices, options); });
  if (options.sweeps_alone) return row;
  if (vertices <= kMostWithThreads) {
    const bool timed = vertices >= kLeastWithThreads;
    row.threads = measured("threads", [&] { return measure_threads(vertices, timed ? options.rounds : 0, options); });
  }
  if (vertices == kRace) row.races = measured("races", [&] { return measure_races(vertices, options); });
  run_files(row, options, folder);
  return row;
}

double startup_milliseconds(const std::string& program) {
  std::vector<double> times;
  const int null = fileno(std::fopen("/dev/null", "w"));
  const int out = dup(STDOUT_FILENO);
  std::fflush(stdout);
  dup2(null, STDOUT_FILENO);
  for (int i = 0; i < 20; ++i) {
    const ProgramRun run = run_program({program, "--version"});
    if (!run.ok) fail(program + " --version failed");
    times.push_back(1e3 * run.wall);
  }
  dup2(out, STDOUT_FILENO);
  std::sort(times.begin(), times.end());
  return (times[9] + times[10]) / 2;
}

int main_of(const Options& options) {
  std::string name = (std::filesystem::temp_directory_path() / "temper-bench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) fail("no temporary folder");
  std::vector<Row> rows;
  for (const std::size_t vertices : options.sizes) {
    std::fprintf(stderr, "%zu vertices …\n", vertices);
    rows.push_back(measure(vertices, options, name));
  }
  std::filesystem::remove_all(name);
  const double startup = options.temper.empty() ? kNone : startup_milliseconds(options.temper);
  const std::vector<Bound> all = bounds(rows, startup);
  print(rows, all);
  if (!options.json.empty()) write_json(options.json, rows, all);
  const bool missed = std::any_of(all.begin(), all.end(), [](const Bound& b) { return b.measured() && !b.met(); });
  return options.check && missed ? 1 : 0;
}

}  // namespace
}  // namespace temper::bench

int main(int argc, char** argv) {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 20);  // as the program has it
#endif
  return temper::bench::main_of(temper::bench::parse(argc, argv));
}
