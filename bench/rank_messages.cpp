// What ranks tell each other in `temper optimize`: messages and bytes of a run, by kind, and how much of its work is
// shared out. Exact, whatever the machine and however many ranks there are: parts say what they say, whoever does them.
//
//   bench_rank_messages [plane|sphere|periodic] [VERTICES …]
//
// Two ranks, as threads of this process, each with a mesh of its own. A table of Markdown; see docs/scaling.md.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "support/thread_ranks.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace {

using namespace temper;

/// Counts what passes through it.
class CountingRanks final : public Ranks {
 public:
  explicit CountingRanks(Ranks& ranks) : ranks_(ranks) {}
  [[nodiscard]] std::size_t size() const override { return ranks_.size(); }
  [[nodiscard]] std::size_t rank() const override { return ranks_.rank(); }
  void broadcast(std::string& bytes, std::size_t from) override {
    ranks_.broadcast(bytes, from);
    calls.push_back(bytes.size());
  }
  std::vector<std::size_t> calls;  // the bytes of each

 private:
  Ranks& ranks_;
};

Mesh example(std::string_view space, std::size_t n) {
  if (space == "sphere") return *random_sphere({.vertices = n, .seed = 1});
  if (space == "periodic") return *random_periodic({.vertices = n, .seed = 1});
  return *random_points({.vertices = n, .seed = 1});
}

void measure(std::string_view space, std::size_t n) {
  const Mesh input = example(space, n);
  test::on_ranks(2, [&](Ranks& ranks) {
    CountingRanks counting(ranks);
    Mesh mesh = input;
    const auto report = optimize(mesh, {}, {.ranks = &counting});
    if (!report || ranks.rank() != 0) return;
    std::size_t most = 0, all = 0, asked = 0, small = 0;
    for (const std::size_t bytes : counting.calls) {
      all += bytes;
      most = std::max(most, bytes);
      if (bytes <= 64) ++asked;
      if (bytes > 64 && bytes < n) ++small;
    }
    const auto sweeps = static_cast<double>(report->sweeps), vertices = static_cast<double>(n);
    std::printf("| %.*s | %zu | %d | %zu | %zu | %zu | %.1f | %.1f |\n", static_cast<int>(space.size()), space.data(),
                n, report->sweeps, counting.calls.size(), asked, small, static_cast<double>(most) / vertices,
                static_cast<double>(all) / sweeps / vertices);
  });
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::printf(
      "| space | vertices | sweeps | calls | that ask | of shifted cuts | largest, bytes a vertex | a sweep, bytes a "
      "vertex |\n");
  std::printf("|-|-:|-:|-:|-:|-:|-:|-:|\n");
  std::string space = "plane";
  for (const std::string& word : words) {
    if (word[0] < '0' || word[0] > '9') {
      space = word;
    } else {
      measure(space, static_cast<std::size_t>(std::atoll(word.c_str())));
    }
  }
}
