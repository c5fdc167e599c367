// The messages of two ranks in `temper optimize`, and the time that the busiest of several is at work.
//
//   bench_rank_messages messages plane|sphere|periodic VERTICES
//   bench_rank_messages work plane|sphere|periodic VERTICES RANKS …
//
// Counts of messages are exact, whatever the machine. Times are of the processor's clock. Ranks are threads of this
// process, each with a mesh of its own, and need no processor each. Prints tables of Markdown: see
// docs/internals/performance.md.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/thread_communicator.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace {

using namespace temper;

/// Counts what passes through it.
class CountingCommunicator final : public Communicator {
 public:
  explicit CountingCommunicator(Communicator& of) : of_(of) {}
  [[nodiscard]] std::size_t size() const override { return of_.size(); }
  [[nodiscard]] std::size_t rank() const override { return of_.rank(); }
  void broadcast(std::string& bytes, std::size_t from) override {
    of_.broadcast(bytes, from);
    calls.push_back(bytes.size());
  }
  std::vector<std::size_t> calls;  // the bytes of each

 private:
  Communicator& of_;
};

Mesh example(std::string_view space, std::size_t n) {
  if (space == "sphere") return *random_sphere({.vertices = n, .seed = 1});
  if (space == "periodic") return *random_periodic({.vertices = n, .seed = 1});
  return *random_mesh({.vertices = n, .seed = 1});
}

/// Of the calling thread.
double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// What one rank of a run has done.
struct Done {
  int sweeps = 0;
  double seconds = 0;              // of its processor
  std::vector<std::size_t> calls;  // bytes of each broadcast
};

std::vector<Done> run_on(std::size_t n_ranks, const Mesh& input) {
  std::vector<Done> done(n_ranks);
  test::on_ranks(n_ranks, [&](Communicator& communicator) {
    CountingCommunicator counting(communicator);
    Mesh mesh = input;
    const double start = processor_seconds();
    const auto report = optimize(mesh, {}, {.communicator = &counting});
    done[counting.rank()] = {report ? report->sweeps : 0, processor_seconds() - start, std::move(counting.calls)};
  });
  return done;
}

void print_messages(const std::string& space, std::size_t n) {
  const Done done = run_on(2, example(space, n)).front();
  // By size: answers whether to stop are small, messages of the numbers' parts are the largest.
  std::size_t small = 0, of_cuts = 0, bytes_of_cuts = 0, of_numbers = 0, bytes_of_numbers = 0;
  for (const std::size_t bytes : done.calls) {
    if (bytes < n / 64) {
      ++small;
    } else if (bytes < 4 * n) {
      ++of_cuts, bytes_of_cuts += bytes;
    } else {
      ++of_numbers, bytes_of_numbers += bytes;
    }
  }
  const double sweeps = done.sweeps, vertices = static_cast<double>(n);
  std::printf("| %s | %zu | %d | %.1f | %.2f | %.1f | %.2f | %.1f |\n", space.c_str(), n, done.sweeps,
              static_cast<double>(of_numbers) / sweeps, static_cast<double>(bytes_of_numbers) / sweeps / vertices,
              static_cast<double>(of_cuts) / sweeps, static_cast<double>(bytes_of_cuts) / sweeps / vertices,
              static_cast<double>(small) / sweeps);
}

/// What the busiest rank does, which the others wait for.
void print_work(const std::string& space, std::size_t n, std::size_t n_ranks) {
  double most = 0;
  for (const Done& done : run_on(n_ranks, example(space, n))) most = std::max(most, done.seconds);
  std::printf("| %s | %zu | %zu | %.1f |\n", space.c_str(), n, n_ranks, most);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3 || (words[0] != "messages" && words[0] != "work")) {
    std::fprintf(stderr, "bench_rank_messages messages SPACE VERTICES | work SPACE VERTICES RANKS …\n");
    return 2;
  }
  const auto n = static_cast<std::size_t>(std::atoll(words[2].c_str()));
  if (words[0] == "messages") {
    std::printf("| space | vertices | sweeps | of numbers and passes | bytes a vertex | of shifted cuts | ");
    std::printf("bytes a vertex | small ones |\n|-|-:|-:|-:|-:|-:|-:|-:|\n");
    print_messages(words[1], n);
    return 0;
  }
  std::printf("| space | vertices | ranks | processor seconds of the busiest |\n|-|-:|-:|-:|\n");
  for (std::size_t i = 3; i < words.size(); ++i) {
    print_work(words[1], n, static_cast<std::size_t>(std::atoll(words[i].c_str())));
  }
  return 0;
}
