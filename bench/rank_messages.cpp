// What two ranks tell each other in `temper optimize`: messages and bytes a sweep, by kind. Exact, whatever the
// machine; of more ranks each tells less, all together the same: parts say what they say, whoever does them.
//
//   bench_rank_messages messages plane|sphere|periodic VERTICES
//   bench_rank_messages work plane|sphere|periodic VERTICES RANKS …
//   bench_rank_messages pages plane|sphere|periodic VERTICES RANKS …
//
// The second prints how long the busiest rank is at work, by its processor's clock. Ranks are threads of this process,
// each with a mesh of its own, and need no processor each. The third prints how much of the mesh a sweep of one rank
// reads or writes, in the pages that memory comes in. Tables of Markdown; see docs/ranks.md.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "optimize/sweep/shifted_cuts.hpp"
#include "optimize/sweep/sweeper.hpp"
#include "optimize/working_copy.hpp"
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
  test::on_ranks(n_ranks, [&](Ranks& ranks) {
    CountingRanks counting(ranks);
    Mesh mesh = input;
    const double start = processor_seconds();
    const auto report = optimize(mesh, {}, {.ranks = &counting});
    done[ranks.rank()] = {report ? report->sweeps : 0, processor_seconds() - start, std::move(counting.calls)};
  });
  return done;
}

void print_messages(const std::string& space, std::size_t n) {
  const Done done = run_on(2, example(space, n)).front();
  // By size: stops and sums are small, what the numbers' parts tell is most of all.
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

/// The pages of a mesh's arrays that are read or written.
class Pages {
 public:
  explicit Pages(const Mesh& mesh)
      : mesh_(mesh),
        of_vertices_(1 + kVertexBytes * mesh.n_vertices() / kPage),
        of_corners_(1 + 4 * mesh.n_halfedges() / kPage) {}

  /// What a step of v looks at: its star, its link, and the corners across the link.
  void touch(VertexId v) {
    touch_vertex(v);
    for (const HalfedgeId h : mesh_.star(v)) {
      touch_vertex(mesh_.target(h));
      touch_vertex(mesh_.opposite(h));
      of_corners_[4 * h.index / kPage] = true;
      const HalfedgeId across = mesh_.twin(Mesh::next(h));
      if (!across.valid()) continue;
      of_corners_[4 * across.index / kPage] = true;
      touch_vertex(mesh_.opposite(across));
    }
  }
  /// Of all, those that were; twins lie as corners do.
  [[nodiscard]] double part() const {
    const auto count = [](const std::vector<bool>& pages) { return std::count(pages.begin(), pages.end(), true); };
    return static_cast<double>(count(of_vertices_) + 2 * count(of_corners_)) /
           static_cast<double>(of_vertices_.size() + 2 * of_corners_.size());
  }

 private:
  static constexpr std::size_t kPage = 4096, kVertexBytes = 32;
  void touch_vertex(VertexId v) { of_vertices_[kVertexBytes * v.index / kPage] = true; }

  const Mesh& mesh_;
  std::vector<bool> of_vertices_, of_corners_;
};

/// For each rank the vertices that it visits in a sweep of an evenly spaced mesh, where no flip leaves any for later.
/// `near`: each shifted part is visited by the rank that has most of its numbers; else by runs of parts, as it is now.
std::vector<std::vector<VertexId>> visits(const Mesh& mesh, std::size_t n_ranks, bool near) {
  const std::size_t n = mesh.n_vertices(), count = (n + kPartSize - 1) / kPartSize;
  const Cut cut{n, count, false};
  std::vector<std::vector<VertexId>> visited(n_ranks);
  std::vector<VertexId> waiting;
  std::vector<std::size_t> owner(n);
  for (std::size_t r = 0; r < n_ranks; ++r) {
    const Share share(count, r, n_ranks);
    for (std::size_t i = share.first; i < share.last; ++i) {
      for (const VertexId v : IdRange<VertexId>(cut[i].first, cut[i].last)) {
        owner[v.index] = r;
        visited[r].push_back(v);
        if (!is_confined(mesh, v, cut[i])) waiting.push_back(v);
      }
    }
  }
  SerialExecutor serial;
  ShiftedCuts cuts;
  if (count > 1) cuts.cut(mesh, count, serial);
  for (std::size_t k = 0; count > 1 && k < ShiftedCuts::kCuts; ++k) {
    std::vector<std::size_t> doer(cuts.n_parts());
    for (std::size_t r = 0; r < n_ranks; ++r) {
      const Share share(doer.size(), r, n_ranks);
      for (std::size_t i = share.first; i < share.last; ++i) doer[i] = r;
    }
    if (near) {
      std::vector<std::vector<std::size_t>> numbers(doer.size(), std::vector<std::size_t>(n_ranks));
      for (const VertexId v : mesh.vertices()) ++numbers[cuts.part_of(k, v)][owner[v.index]];
      for (std::size_t i = 0; i < doer.size(); ++i) {
        doer[i] = static_cast<std::size_t>(std::max_element(numbers[i].begin(), numbers[i].end()) - numbers[i].begin());
      }
    }
    std::vector<VertexId> left;
    for (const VertexId v : waiting) {
      const std::size_t part = cuts.part_of(k, v);
      visited[doer[part]].push_back(v);
      if (!is_confined(mesh, v, cuts.part(k, part))) left.push_back(v);
    }
    waiting.swap(left);
  }
  return visited;
}

/// The largest part of the mesh that any rank touches.
double largest_part(const Mesh& mesh, const std::vector<std::vector<VertexId>>& visited) {
  double largest = 0;
  for (const auto& vertices : visited) {
    Pages pages(mesh);
    for (const VertexId v : vertices) pages.touch(v);
    largest = std::max(largest, pages.part());
  }
  return largest;
}

void print_pages(const std::string& space, const Mesh& mesh, std::size_t n_ranks) {
  std::printf("| %s | %zu | %zu | %.3f | %.3f | %.3f |\n", space.c_str(), mesh.n_vertices(), n_ranks,
              1 / static_cast<double>(n_ranks), largest_part(mesh, visits(mesh, n_ranks, true)),
              largest_part(mesh, visits(mesh, n_ranks, false)));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3 || (words[0] != "messages" && words[0] != "work" && words[0] != "pages")) {
    std::fprintf(stderr, "bench_rank_messages messages SPACE VERTICES | work|pages SPACE VERTICES RANKS …\n");
    return 2;
  }
  const auto n = static_cast<std::size_t>(std::atoll(words[2].c_str()));
  if (words[0] == "messages") {
    std::printf("| space | vertices | sweeps | of numbers and passes | bytes a vertex | of shifted cuts | ");
    std::printf("bytes a vertex | small ones |\n|-|-:|-:|-:|-:|-:|-:|-:|\n");
    print_messages(words[1], n);
    return 0;
  }
  if (words[0] == "pages") {
    const Mesh mesh = WorkingCopy(example(words[1], n), SweepOrder::hilbert).mesh;
    std::printf("| space | vertices | ranks | 1/ranks | nearest rank's parts | runs of parts |\n|-|-:|-:|-:|-:|-:|\n");
    for (std::size_t i = 3; i < words.size(); ++i) {
      print_pages(words[1], mesh, static_cast<std::size_t>(std::atoll(words[i].c_str())));
    }
    return 0;
  }
  std::printf("| space | vertices | ranks | processor seconds of the busiest |\n|-|-:|-:|-:|\n");
  for (std::size_t i = 3; i < words.size(); ++i) {
    print_work(words[1], n, static_cast<std::size_t>(std::atoll(words[i].c_str())));
  }
  return 0;
}
