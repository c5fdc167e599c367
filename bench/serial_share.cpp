// Makes a run from file to file on one thread, and predicts its time on many. It takes the processor time inside and
// outside of parallel regions, and the longest block of each region. See docs/internals/performance.md.
//
//   bench_serial_share IN OUT
#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "options.hpp"
#include "temper/detail/executor.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::bench {
namespace {

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The function at each address, by addr2line of binutils: the core has no type information that could name blocks.
std::string function_at(void* address) {
  Dl_info program{};
  if (dladdr(address, &program) == 0) return "?";
  const auto offset = static_cast<char*>(address) - static_cast<char*>(program.dli_fbase);
  char command[4200];
  std::snprintf(command, sizeof command, "addr2line -Cfe '%s' 0x%zx", program.dli_fname,
                static_cast<std::size_t>(offset));
  std::FILE* const lines = popen(command, "r");
  char line[4096] = "?";
  if (lines != nullptr && std::fgets(line, sizeof line, lines) == nullptr) std::snprintf(line, sizeof line, "?");
  if (lines != nullptr) pclose(lines);
  const std::string text = std::regex_replace(line, std::regex(R"(\(anonymous namespace\)::|temper::|\n)"), "");
  return text.substr(0, std::min(text.find('('), std::size_t{60}));
}

std::string name_of(void* caller) { return caller == nullptr ? "start or end" : function_at(caller); }

/// All regions of one caller.
struct Regions {
  std::size_t runs = 0, blocks = 0;
  double seconds = 0, longest = 0;  ///< `longest`: the sum of the longest block of each region
};

/// Runs all in the calling thread, and takes the times.
class CountingExecutor final : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    if (inside_ || n == 0) {
      for (std::size_t i = 0; i < n; ++i) block(i);
      return;
    }
    void* const name = __builtin_return_address(0);
    end_serial(name);
    inside_ = true;
    Regions& regions = regions_[name];
    double longest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double start = thread_seconds();
      block(i);
      const double seconds = thread_seconds() - start;
      regions.seconds += seconds;
      longest = std::max(longest, seconds);
    }
    regions.longest += longest;
    regions.blocks += n;
    ++regions.runs;
    inside_ = false;
    last_ = name;
    serial_since_ = thread_seconds();
  }
  /// Ends the serial place before a region of that caller.
  void end_serial(void* next) { serial_[{last_, next}] += thread_seconds() - serial_since_; }

  void print(int sweeps) const;

 private:
  bool inside_ = false;
  void* last_ = nullptr;  // the caller of the last region
  double serial_since_ = thread_seconds();
  std::map<void*, Regions> regions_;
  std::map<std::pair<void*, void*>, double> serial_;  // between the regions of two callers; null: start, end
};

void CountingExecutor::print(int sweeps) const {
  double serial = 0, parallel = 0, chain = 0;
  std::vector<std::pair<double, std::pair<void*, void*>>> places;
  for (const auto& [name, seconds] : serial_) serial += seconds, places.emplace_back(seconds, name);
  for (const auto& [name, regions] : regions_) parallel += regions.seconds, chain += regions.longest;
  std::sort(places.rbegin(), places.rend());
  const double total = serial + parallel;
  std::printf("%.2f s, of these %.2f s or %.1f %% outside of parallel regions, at most:\n", total, serial,
              100 * serial / total);
  constexpr std::size_t kShown = 12;
  for (std::size_t i = 0; i < std::min(kShown, places.size()); ++i)
    std::printf("  %7.3f s  %s … %s\n", places[i].first, name_of(places[i].second.first).c_str(),
                name_of(places[i].second.second).c_str());

  std::printf("\n   regions   blocks        s  longest blocks, s\n");
  double sweeping = 0;
  for (const auto& [caller, r] : regions_) {
    const std::string name = name_of(caller);
    if (name.find("Sweeper::") != std::string::npos) sweeping += r.longest;
    if (r.seconds > 0.005 * total)
      std::printf("  %8zu %8zu %8.2f %8.2f  %s\n", r.runs, r.blocks, r.seconds, r.longest, name.c_str());
  }
  std::printf("\nlongest chain of blocks: %.2f s, of these in a sweep %.4f s\n", chain, sweeping / sweeps);
  // No schedule that keeps all threads busy while blocks wait takes longer.
  for (const int threads : {1, 2, 8, 32, 64})
    std::printf("%3d threads: at most %.2f s\n", threads, serial + chain + (parallel - chain) / threads);
}

void insist(const auto& result) {
  if (!result) fail(result.error().what());
}

/// Both return the number of sweeps.
int run_triangles(io::MeshFile& file, const std::string& output, CountingExecutor& executor) {
  auto loaded = io::make_mesh(file, {}, &executor);
  insist(loaded);
  io::release_geometry(file, *loaded);
  OptimizeHooks hooks;
  hooks.executor = &executor;
  hooks.exclusive = true;
  hooks.viewer = [&](const Mesh& mesh) {
    static_cast<void>(quality(mesh, {.detail = QualityDetail::brief, .executor = &executor}));
  };
  hooks.measures_sizes = false;
  const auto report = optimize(loaded->mesh, {}, hooks);
  insist(report);
  io::update(file, *loaded, loaded->mesh);
  insist(io::write(output, file, {{}, {}, &executor}));
  return report->sweeps;
}

int run_tetrahedra(io::MeshFile& file, const std::string& output, CountingExecutor& executor) {
  const auto loaded = io::make_tet_mesh(file, &executor);
  insist(loaded);
  static_cast<void>(quality(loaded->mesh, {.executor = &executor}));
  tets::TetMesh mesh = loaded->mesh;
  tets::OptimizeHooks hooks;
  hooks.executor = &executor;
  const auto report = optimize(mesh, {.flips = Flips::none}, hooks);
  insist(report);
  static_cast<void>(quality(mesh, {.executor = &executor}));
  io::update(file, *loaded, mesh, report->origins, {{}, &executor});
  insist(io::write(output, file, {{}, {}, &executor}));
  return report->sweeps;
}

int run(const std::string& input, const std::string& output) {
  CountingExecutor executor;
  auto file = io::read(input, {&executor});
  insist(file);
  const int sweeps =
      file->dimension() == 3 ? run_tetrahedra(*file, output, executor) : run_triangles(*file, output, executor);
  executor.end_serial(nullptr);
  executor.print(std::max(1, sweeps));
  return 0;
}

}  // namespace
}  // namespace temper::bench

int main(int argc, char** argv) {
  if (argc != 3) temper::bench::fail("expected IN OUT");
  return temper::bench::run(argv[1], argv[2]);
}
