// Speed and memory of whole runs on random meshes, all ratios from one run of this program; see docs/performance.md.
//
//   bench_whole_run [--sizes 1000,10000,100000,1000000] [--sweeps 10] [--golden-sweeps 3] [--temper PATH]
//                   [--json FILE] [--check]
//
// Times are processor time. Each measurement has its own process. --check: exit 1 when a bound is missed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "child.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#ifdef TEMPER_WITH_IO
#include "temper/io.hpp"
#endif

namespace temper::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // not measured

struct Options {
  std::vector<std::size_t> sizes = {1000, 10000, 100000, 1000000};
  int sweeps = 10;        // of Newton and alternating
  int golden_sweeps = 3;  // of golden, which takes about twenty times as long
  std::string temper;     // the program, for its start-up time and its memory
  std::string json;
  bool check = false;
};

[[noreturn]] void fail(const std::string& message) {
  std::fprintf(stderr, "bench_whole_run: %s\n", message.c_str());
  std::exit(2);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--check") {
      options.check = true;
      continue;
    }
    if (i + 1 == argc) fail("unknown option, or without value: " + word);
    const std::string value = argv[++i];
    if (word == "--sizes") {
      options.sizes.clear();
      for (std::size_t at = 0; at < value.size();) {
        std::size_t end = std::min(value.find(',', at), value.size());
        options.sizes.push_back(std::strtoull(value.c_str() + at, nullptr, 10));
        at = end + 1;
      }
    } else if (word == "--sweeps") {
      options.sweeps = std::atoi(value.c_str());
    } else if (word == "--golden-sweeps") {
      options.golden_sweeps = std::atoi(value.c_str());
    } else if (word == "--temper") {
      options.temper = value;
    } else if (word == "--json") {
      options.json = value;
    } else {
      fail("unknown option " + word);
    }
  }
  return options;
}

Mesh random_mesh(std::size_t vertices) {
  auto mesh = random_points({.vertices = vertices, .seed = 1});
  if (!mesh) fail(mesh.error().what());
  return std::move(*mesh);
}

/// Processor time of one optimize() of a copy of the mesh.
double seconds_of(const Mesh& mesh, const OptimizeOptions& options, int& sweeps) {
  Mesh copy = mesh;
  const double start = cpu_seconds();
  const auto report = optimize(copy, options);
  const double seconds = cpu_seconds() - start;
  if (!report) fail(report.error().what());
  sweeps = report->sweeps;
  return seconds;
}

/// Nanoseconds a vertex and sweep: a run of some sweeps less one of none, the least of a few.
double sweep_cost(const Mesh& mesh, Solver solver, int max_sweeps) {
  OptimizeOptions options;
  options.solver = solver;
  options.tolerance = 0;
  double least_none = kNone, least_all = kNone;
  int sweeps = 0, none = 0;
  const double start = cpu_seconds();
  for (int round = 0; round < 20 && (round == 0 || cpu_seconds() - start < 4); ++round) {
    options.max_sweeps = 0;
    least_none = std::fmin(least_none, seconds_of(mesh, options, none));
    options.max_sweeps = max_sweeps;
    least_all = std::fmin(least_all, seconds_of(mesh, options, sweeps));
  }
  return 1e9 * (least_all - least_none) / (static_cast<double>(mesh.n_vertices()) * sweeps);
}

/// Read, optimise with no option, write.
struct WholeRun {
  double read = kNone, optimise = 0, write = kNone;  // seconds
  double sweeps = 0, sweeps_to_good = kNone, bad = 0;
  double peak_bytes = 0;
  double triangles = 0, bad_before = 0;
};

void note_report(const OptimizeReport& report, WholeRun& run) {
  run.sweeps = report.sweeps;
  run.bad_before = static_cast<double>(report.history.front().bad);
  run.bad = static_cast<double>(report.history.back().bad);
  for (const SweepRecord& record : report.history) {
    if (record.bad == 0 && std::isnan(run.sweeps_to_good)) run.sweeps_to_good = record.sweep;
  }
}

#ifdef TEMPER_WITH_IO

void make_input(std::size_t vertices, const std::string& path) {
  const auto done = in_child([&] {
    const auto written = io::write(path, io::from_mesh(random_mesh(vertices)));
    if (!written) fail(written.error().what());
    return 0;
  });
  if (!done) fail("cannot make " + path);
}

WholeRun whole_run(std::size_t, const std::string& input, const std::string& output) {
  WholeRun run;
  const double start = cpu_seconds();
  auto file = io::read(input);
  if (!file) fail(file.error().what());
  auto loaded = io::make_mesh(*file);
  if (!loaded) fail(loaded.error().what());
  io::release_geometry(*file, *loaded);
  const double read = cpu_seconds();
  const auto report = optimize(loaded->mesh);
  if (!report) fail(report.error().what());
  const double optimised = cpu_seconds();
  io::update(*file, *loaded, loaded->mesh);
  const auto written = io::write(output, *file);
  if (!written) fail(written.error().what());
  run.read = read - start, run.optimise = optimised - read, run.write = cpu_seconds() - optimised;
  run.triangles = static_cast<double>(loaded->mesh.n_triangles());
  note_report(*report, run);
  run.peak_bytes = peak_bytes();
  return run;
}

#else

void make_input(std::size_t, const std::string&) {}

WholeRun whole_run(std::size_t vertices, const std::string&, const std::string&) {
  WholeRun run;
  Mesh mesh = random_mesh(vertices);
  const double start = cpu_seconds();
  const auto report = optimize(mesh);
  if (!report) fail(report.error().what());
  run.optimise = cpu_seconds() - start;
  run.triangles = static_cast<double>(mesh.n_triangles());
  note_report(*report, run);
  run.peak_bytes = kNone;  // the generator's own
  return run;
}

#endif

/// All that is measured at one size.
struct Row {
  std::size_t vertices = 0;
  double newton = kNone, alternating = kNone, golden = kNone;  // ns a vertex-sweep
  WholeRun run;
  double program_peak_bytes = kNone;

  [[nodiscard]] double io_share() const { return (run.read + run.write) / (run.read + run.optimise + run.write); }
};

struct SweepCosts {
  double newton, alternating, golden;
};

Row measure(std::size_t vertices, const Options& options, const std::filesystem::path& folder) {
  Row row;
  row.vertices = vertices;
  const auto costs = in_child([&] {
    const Mesh mesh = random_mesh(vertices);
    return SweepCosts{sweep_cost(mesh, Solver::newton, options.sweeps),
                      sweep_cost(mesh, Solver::alternating, options.sweeps),
                      vertices == 10000 ? sweep_cost(mesh, Solver::golden, options.golden_sweeps) : kNone};
  });
  if (!costs) fail("the measurement of sweeps died");
  row.newton = costs->newton, row.alternating = costs->alternating, row.golden = costs->golden;

  const std::string input = folder / "in.vtu", output = folder / "out.vtu";
  make_input(vertices, input);
  const auto run = in_child([&] { return whole_run(vertices, input, output); });
  if (!run) fail("the whole run died");
  row.run = *run;
  if (!options.temper.empty() && std::filesystem::exists(input)) {
    // Its memory peaks before the third sweep.
    const ProgramRun program =
        run_program({options.temper, "optimize", input, "-o", output, "--max-sweeps", "3", "--quiet"});
    if (!program.ok) fail(options.temper + " optimize failed");
    row.program_peak_bytes = program.peak_bytes;
  }
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

/// A requirement on one number; NaN when this run did not measure it.
struct Bound {
  std::string what;
  double value;
  bool at_least;
  double limit;

  [[nodiscard]] bool measured() const { return !std::isnan(value); }
  [[nodiscard]] bool met() const { return at_least ? value >= limit : value <= limit; }
};

const Row* find(const std::vector<Row>& rows, std::size_t vertices) {
  for (const Row& row : rows) {
    if (row.vertices == vertices) return &row;
  }
  return nullptr;
}

std::vector<Bound> bounds(const std::vector<Row>& rows, double startup) {
  const Row* ten_thousand = find(rows, 10000);
  const Row* million = find(rows, 1000000);
  const auto of = [](const Row* row, auto&& value) { return row != nullptr ? value(*row) : kNone; };
  const double small = of(ten_thousand, [](const Row& r) { return r.newton; });
  return {
      {"golden / Newton, ns a vertex-sweep at 10,000", of(ten_thousand, [](const Row& r) { return r.golden; }) / small,
       true, 15},
      {"Newton, ns a vertex-sweep at 10,000", small, false, 1500},
      {"Newton at 1,000,000 / at 10,000", of(million, [](const Row& r) { return r.newton; }) / small, false, 1.5},
      {"reading and writing VTU, share of the run at 1,000,000", of(million, [](const Row& r) { return r.io_share(); }),
       false, 1.0 / 3},
      {"peak bytes a vertex at 1,000,000, by the library alone",
       of(million, [](const Row& r) { return r.run.peak_bytes / static_cast<double>(r.vertices); }), false, 250},
      {"peak bytes a vertex at 1,000,000, by the program",
       of(million, [](const Row& r) { return r.program_peak_bytes / static_cast<double>(r.vertices); }), false, 250},
      {"start of the program, ms", startup, false, 20},
  };
}

void print(const std::vector<Row>& rows, const std::vector<Bound>& all) {
  std::printf("%9s | %7s %7s %7s | %9s %9s | %6s %6s %6s | %7s %7s | %6s\n", "vertices", "newton", "altern.", "golden",
              "bad", "bad after", "sweeps", "to all", "s", "B/v lib", "B/v app", "I/O %");
  for (const Row& r : rows) {
    const auto n = static_cast<double>(r.vertices);
    std::printf("%9zu | %7.0f %7.0f %7.0f | %9.0f %9.0f | %6.0f %6.0f %6.2f | %7.0f %7.0f | %6.1f\n", r.vertices,
                r.newton, r.alternating, r.golden, r.run.bad_before, r.run.bad, r.run.sweeps, r.run.sweeps_to_good,
                r.run.optimise, r.run.peak_bytes / n, r.program_peak_bytes / n, 100 * r.io_share());
  }
  std::printf(
      "\nnewton, altern., golden: ns a vertex-sweep. to all: sweeps until every triangle is well-centered.\n"
      "s: optimisation alone. B/v: peak bytes a vertex of reading, optimising and writing.\n\n");
  for (const Bound& bound : all) {
    if (!bound.measured()) continue;
    std::printf("%-58s %8.3g  (at %s %.3g)  %s\n", bound.what.c_str(), bound.value, bound.at_least ? "least" : "most ",
                bound.limit, bound.met() ? "ok" : "MISSED");
  }
}

std::string json_number(double x) {
  if (std::isnan(x)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}

void write_json(const std::string& path, const std::vector<Row>& rows, const std::vector<Bound>& all) {
  std::FILE* out = std::fopen(path.c_str(), "w");
  if (out == nullptr) fail("cannot write " + path);
  std::fprintf(out, "{\"sizes\": [\n");
  for (const Row& r : rows) {
    const std::pair<const char*, double> numbers[] = {{"newton_ns", r.newton},
                                                      {"alternating_ns", r.alternating},
                                                      {"golden_ns", r.golden},
                                                      {"triangles", r.run.triangles},
                                                      {"bad_before", r.run.bad_before},
                                                      {"bad_after", r.run.bad},
                                                      {"sweeps", r.run.sweeps},
                                                      {"sweeps_to_well_centered", r.run.sweeps_to_good},
                                                      {"read_seconds", r.run.read},
                                                      {"optimize_seconds", r.run.optimise},
                                                      {"write_seconds", r.run.write},
                                                      {"library_peak_bytes", r.run.peak_bytes},
                                                      {"program_peak_bytes", r.program_peak_bytes}};
    std::fprintf(out, "  {\"vertices\": %zu", r.vertices);
    for (const auto& [key, value] : numbers) std::fprintf(out, ", \"%s\": %s", key, json_number(value).c_str());
    std::fprintf(out, "}%s\n", &r == &rows.back() ? "" : ",");
  }
  std::fprintf(out, "],\n\"bounds\": [\n");
  for (const Bound& b : all) {
    std::fprintf(out, "  {\"what\": \"%s\", \"value\": %s, \"%s\": %s, \"met\": %s}%s\n", b.what.c_str(),
                 json_number(b.value).c_str(), b.at_least ? "least" : "most", json_number(b.limit).c_str(),
                 b.measured() ? (b.met() ? "true" : "false") : "null", &b == &all.back() ? "" : ",");
  }
  std::fprintf(out, "]}\n");
  std::fclose(out);
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

int main(int argc, char** argv) { return temper::bench::main_of(temper::bench::parse(argc, argv)); }
