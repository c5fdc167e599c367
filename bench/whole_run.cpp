// Speed and memory of whole runs on random meshes, all ratios from one run of this program; see
// docs/internals/performance.md.
//
//   bench_whole_run [--sizes 1000,10000,100000,1000000] [--rounds 3] [--sweeps 10] [--golden-sweeps 3] [--threads N]
//                   [--sweeps-alone] [--temper PATH] [--json FILE] [--check]
//
// --sweeps-alone: nothing but the cost of Newton and accuracy sweeps, for comparing builds. --check: exit 1 when a
// bound is missed. Times are processor time, but for those with several threads. Each measurement has its own process.
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "child.hpp"
#include "measure.hpp"
#include "threads.hpp"

#ifdef __GLIBC__
#endif

namespace temper::bench {
namespace {

/// A requirement on one number; NaN when this run did not measure it.
struct Bound {
  std::string what;
  double value;
  bool at_least;
  double limit;

  [[nodiscard]] bool measured() const { return value == value; }
  [[nodiscard]] bool met() const { return at_least ? value >= limit : value <= limit; }
};

constexpr std::size_t kSmall = 10000, kMiddle = 100000, kLarge = 1000000, kHuge = 10000000;

/// A number of the row of that size, NaN when there is none.
double at(const std::vector<Row>& rows, std::size_t vertices, const std::function<double(const Row&)>& value) {
  for (const Row& row : rows) {
    if (row.vertices == vertices) return value(row);
  }
  return kNone;
}

double newton(const Row& r) { return r.costs.newton; }
double settled(const Row& r) { return r.costs.settled; }
double peak(const Row& r) { return r.one.peak_bytes / static_cast<double>(r.vertices); }
double program_peak(const Row& r) { return r.program_peak_bytes / static_cast<double>(r.vertices); }
double io_share(const Row& r) { return r.one.seconds.io_share(); }
double io_share_of_all(const Row& r) { return r.all.seconds.io_share(); }
/// 1 when no comparison of bytes has failed, at any size.
double all_same(const std::vector<Row>& rows, double ThreadCosts::*same) {
  double least = kNone;
  for (const Row& r : rows) least = std::fmin(least, r.threads.*same);
  return least;
}

using Numbers = std::vector<std::pair<const char*, double>>;

Numbers numbers_of(const Row& r) {
  return {{"newton_ns", r.costs.newton},
          {"settled_ns", r.costs.settled},
          {"accuracy_ns", r.costs.accuracy},
          {"alternating_ns", r.costs.alternating},
          {"golden_ns", r.costs.golden},
          {"paper_ns", r.costs.paper},
          {"loop_ns", r.costs.by_triangles},
          {"loop_by_stars_ns", r.costs.by_stars},
          {"triad_ns", r.costs.triad},
          {"same_bytes_threads", r.threads.same_threads},
          {"same_bytes_instruction_sets", r.threads.same_instructions},
          {"triangles", r.one.triangles},
          {"bad_before", r.one.bad_before},
          {"bad_after", r.one.bad},
          {"sweeps", r.one.sweeps},
          {"sweeps_to_well_centered", r.one.sweeps_to_good},
          {"optimize_seconds", r.one.seconds.optimize()},
          {"library_peak_bytes", r.one.peak_bytes},
          {"program_peak_bytes", r.program_peak_bytes}};
}

Numbers stages_of(const Stages& s) {
  return {{"read", s.read},
          {"build", s.build},
          {"order", s.order},
          {"make regular", s.make_regular},
          {"until none is bad", s.to_well_centered},
          {"until converged", s.to_converged},
          {"back", s.back},
          {"update", s.update},
          {"write", s.write},
          {"total", s.total()}};
}

Numbers numbers_of(const Race& race) {
  return {{"plain_seconds", race.plain}, {"default_seconds", race.standard}, {"default_sweeps", race.standard_sweeps}};
}

std::string json_number(double x) {
  if (!std::isfinite(x)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

std::string json_object(const Numbers& numbers) {
  std::string text = "{";
  for (const auto& [key, value] : numbers) {
    text += (text.size() > 1 ? ", \"" : "\"") + std::string(key) + "\": " + json_number(value);
  }
  return text + "}";
}

std::string json_row(const Row& r) {
  std::string text = json_object(numbers_of(r));
  text.pop_back();
  text += ", \"wall_ns_by_threads\": [";
  for (std::size_t i = 0; i < r.threads.ns.size() && !std::isnan(r.threads.ns[i]); ++i) {
    text += (i > 0 ? ", " : "") + json_number(r.threads.ns[i]);
  }
  return "{\"vertices\": " + std::to_string(r.vertices) + ", " + text.substr(1) +
         "], \"stages\": " + json_object(stages_of(r.one.seconds)) +
         ", \"stages_with_threads\": " + json_object(stages_of(r.all.seconds)) +
         ", \"race\": " + json_object(numbers_of(r.races.whole)) +
         ", \"settled_race\": " + json_object(numbers_of(r.races.settled)) + "}";
}

std::string json_bound(const Bound& b) {
  return "{\"what\": \"" + b.what + "\", \"value\": " + json_number(b.value) + ", \"" +
         (b.at_least ? "least" : "most") + "\": " + json_number(b.limit) +
         ", \"met\": " + (b.measured() ? (b.met() ? "true" : "false") : "null") + "}";
}

void print_sweeps(const std::vector<Row>& rows) {
  std::printf("%9s | %7s %7s %7s %7s %7s %7s | %7s %7s %7s | threads, wall\n", "vertices", "newton", "settled",
              "accur.", "altern.", "golden", "paper", "loop", "stars", "triad");
  for (const Row& r : rows) {
    const SweepCosts& c = r.costs;
    std::printf("%9zu | %7.0f %7.0f %7.0f %7.0f %7.0f %7.0f | %7.0f %7.0f %7.1f |", r.vertices, c.newton, c.settled,
                c.accuracy, c.alternating, c.golden, c.paper, c.by_triangles, c.by_stars, c.triad);
    for (const double ns : r.threads.ns) {
      if (!std::isnan(ns)) std::printf(" %7.0f", ns);
    }
    std::printf("\n");
  }
  std::printf(
      "ns a vertex-sweep, the first sweeps; settled: those after the mesh is well-centered; accur.: from there on for "
      "the\n"
      "accuracy objective. loop: value, gradient and Hessian of all stars and nothing else, one star after the other; "
      "stars: eight at once. triad: 80 bytes a "
      "vertex.\n\n");
}

void print_runs(const std::vector<Row>& rows) {
  std::printf("%9s | %9s %9s | %6s %6s %8s | %7s %7s | %6s\n", "vertices", "bad", "bad after", "sweeps", "to all", "s",
              "B/v lib", "B/v app", "I/O %");
  for (const Row& r : rows) {
    std::printf("%9zu | %9.0f %9.0f | %6.0f %6.0f %8.2f | %7.0f %7.0f | %6.1f\n", r.vertices, r.one.bad_before,
                r.one.bad, r.one.sweeps, r.one.sweeps_to_good, r.one.seconds.optimize(), peak(r), program_peak(r),
                100 * io_share(r));
  }
  std::printf(
      "to all: sweeps until every triangle is well-centered. s: optimization alone, one thread. B/v: peak bytes a\n"
      "vertex of reading, optimizing and writing.\n\n");
}

void print_stages(const Row& r) {
  const Numbers one = stages_of(r.one.seconds), all = stages_of(r.all.seconds);
  std::printf("%9zu vertices, from file to file, seconds with one thread and with all:\n", r.vertices);
  for (std::size_t i = 0; i < one.size(); ++i) {
    std::printf("  %-18s %8.3f %8.3f\n", one[i].first, one[i].second, all[i].second);
  }
  std::printf("\n");
}

void print_race(const char* from, const Race& race) {
  std::printf("  %-26s %6.2f s; by default %6.2f s, %3.0f sweeps\n", from, race.plain, race.standard,
              race.standard_sweeps);
}

/// `startup`: of the program, in milliseconds.
std::vector<Bound> bounds(const std::vector<Row>& rows, double startup) {
  const double small = at(rows, kSmall, newton), small_settled = at(rows, kSmall, settled);
  return {
      {"Newton / pure loop over the same stars, at 100,000",
       at(rows, kMiddle, [](const Row& r) { return r.costs.newton / r.costs.by_triangles; }), false, 2.5},
      {"settled / pure loop over the same stars, at 100,000",
       at(rows, kMiddle, [](const Row& r) { return r.costs.settled / r.costs.by_triangles; }), false, 2.5},
      {"golden / Newton, at 100,000", at(rows, kMiddle, [](const Row& r) { return r.costs.golden / r.costs.newton; }),
       true, 60},
      {"the paper's Algorithm 1 / Newton, at 100,000",
       at(rows, kMiddle, [](const Row& r) { return r.costs.paper / r.costs.newton; }), true, 60},
      {"Newton, ns a vertex-sweep at 10,000", small, false, 1000},
      {"Newton at 1,000,000 / at 10,000", at(rows, kLarge, newton) / small, false, 1.3},
      {"Newton at 10,000,000 / at 10,000", at(rows, kHuge, newton) / small, false, 1.3},
      {"settled at 10,000,000 / at 10,000", at(rows, kHuge, settled) / small_settled, false, 1.3},
      {"two threads, times one, at 1,000,000",
       at(rows, kLarge, [](const Row& r) { return r.threads.ns[0] / r.threads.ns[1]; }), true, 1.8},
      {"same bytes for 1, 2, 3 and 8 threads", all_same(rows, &ThreadCosts::same_threads), true, 1},
      {"same bytes for each instruction set", all_same(rows, &ThreadCosts::same_instructions), true, 1},
      {"200 plain sweeps / time to their energy, at 100,000",
       at(rows, kMiddle, [](const Row& r) { return r.races.whole.plain / r.races.whole.standard; }), true, 5},
      {"the same from a well-centered mesh, at 100,000",
       at(rows, kMiddle, [](const Row& r) { return r.races.settled.plain / r.races.settled.standard; }), true, 2},
      {"share of files in the run, at 1,000,000", at(rows, kLarge, io_share), false, 1.0 / 3},
      {"share of files in the run, all threads, at 1,000,000", at(rows, kLarge, io_share_of_all), false, 1.0 / 3},
      {"share of files in the run, at 10,000,000", at(rows, kHuge, io_share), false, 1.0 / 3},
      {"share of files in the run, all threads, at 10,000,000", at(rows, kHuge, io_share_of_all), false, 1.0 / 3},
      {"triangles left bad, at 1,000,000", at(rows, kLarge, [](const Row& r) { return r.one.bad; }), false, 0},
      {"peak bytes a vertex, by the library, at 1,000,000", at(rows, kLarge, peak), false, 200},
      {"peak bytes a vertex, by the program, at 1,000,000", at(rows, kLarge, program_peak), false, 200},
      {"peak bytes a vertex, by the library, at 10,000,000", at(rows, kHuge, peak), false, 200},
      {"start of the program, ms", startup, false, 20},
  };
}

void print(const std::vector<Row>& rows, const std::vector<Bound>& bounds) {
  print_sweeps(rows);
  print_runs(rows);
  for (const Row& r : rows) {
    if (r.vertices >= kLarge && !std::isnan(r.one.seconds.read)) print_stages(r);
    if (std::isnan(r.races.whole.plain)) continue;
    std::printf("%9zu vertices, to the energy of 200 plain sweeps:\n", r.vertices);
    print_race("from the input", r.races.whole);
    print_race("from a well-centered mesh", r.races.settled);
    std::printf("\n");
  }
  for (const Bound& bound : bounds) {
    if (!bound.measured()) continue;
    std::printf("%-58s %8.3g  (at %s %.3g)  %s\n", bound.what.c_str(), bound.value, bound.at_least ? "least" : "most ",
                bound.limit, bound.met() ? "ok" : "MISSED");
  }
}

void write_json(const std::string& path, const std::vector<Row>& rows, const std::vector<Bound>& bounds) {
  std::FILE* out = std::fopen(path.c_str(), "w");
  if (out == nullptr) fail("cannot write " + path);
  const auto list = [out](const char* name, const auto& items, const auto& text) {
    std::fprintf(out, "\"%s\": [\n", name);
    for (const auto& item : items) std::fprintf(out, "  %s%s\n", text(item).c_str(), &item == &items.back() ? "" : ",");
    std::fprintf(out, "]");
  };
  std::fprintf(out, "{");
  list("sizes", rows, json_row);
  std::fprintf(out, ",\n");
  list("bounds", bounds, json_bound);
  std::fprintf(out, "}\n");
  std::fclose(out);
}

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
      run_program({options.temper, "optimize", input, "-o", output, "--set", "max_sweeps=12", "--quiet"});
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
