// Work on the parts of a mesh, at once or one after another: the same bytes either way.
//
// This is the only place that knows of executors, of the workers that threads need, of when to stop, of parts that are
// shifted and of vertices that wait for another part. Another engine than threads would take its place.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "optimize/sweep/partition.hpp"
#include "optimize/sweep/stop_token.hpp"
#include "optimize/sweep/worker_pool.hpp"
#include "temper/executor.hpp"

namespace temper {

/// work(worker, i, part) for each part i of the cut.
template <class Worker, class Work>
void for_parts(const Cut& cut, Executor& executor, WorkerPool<Worker>& workers, StopToken& stop, Work&& work) {
  workers.make_room(cut.size());
  static_cast<void>(stop.goes_on());  // asks, should no part run on this thread
  executor.run(cut.size(), [&](std::size_t i) {
    const auto worker = workers.take();
    work(*worker, i, cut[i]);
  });
}

/// A sweep over all vertices, by workers with a function improve(vertices, part, left): it improves those that it can,
/// in order, and appends the others to `left`.
///
/// First each part does what it can. What is left comes next, with parts that are shifted by half of their size, then
/// with parts four times as large and again, since some neighbours in the plane are far apart on the curve. The last
/// part is the whole mesh: it takes what is left, about 1 % of a million vertices.
template <class Worker>
class PartSweep {
 public:
  PartSweep(std::size_t part_size, WorkerPool<Worker>& workers) : part_size_(part_size), workers_(workers) {}

  void in_parts(std::size_t n_vertices, Executor& executor, StopToken& stop) {
    std::size_t count = parts_of(n_vertices, part_size_);
    run({n_vertices, count, false}, executor, stop, [&](Worker& worker, const Part& part, VertexList& left) {
      improve_numbers(worker, part, n_vertices, left, stop);
    });
    for (; count > 1; count = parts_of(count, kGrowth)) {
      stop.ask_soon();
      run({n_vertices, count, true}, executor, stop, [&](Worker& worker, const Part& part, VertexList& left) {
        const auto begin = std::lower_bound(waiting_.begin(), waiting_.end(), part.first);
        improve(worker, {begin, std::lower_bound(begin, waiting_.end(), part.last)}, part, left, stop);
      });
    }
    in_order(waiting_, stop);
  }

  /// These vertices one after another, without parts.
  void in_order(std::span<const VertexId> vertices, StopToken& stop) {
    workers_.make_room(1);
    VertexList none;
    improve(*workers_.take(), vertices, {}, none, stop);
  }

 private:
  using VertexList = std::vector<VertexId>;
  static constexpr std::size_t kStretch = 8192;  // vertices between looks at whether to stop
  static constexpr std::size_t kGrowth = 4;      // of parts from phase to phase, once shifted

  static std::size_t parts_of(std::size_t n, std::size_t most) {
    return std::max<std::size_t>(1, n / most + (n % most != 0 ? 1 : 0));
  }

  /// One phase. What is left after it waits for the next.
  template <class Work>
  void run(const Cut& cut, Executor& executor, StopToken& stop, Work&& work) {
    if (left_.size() < cut.size()) left_.resize(cut.size());
    for_parts(cut, executor, workers_, stop, [&](Worker& worker, std::size_t i, const Part& part) {
      left_[i].clear();
      work(worker, cut.size() == 1 ? Part() : part, left_[i]);
    });
    waiting_.clear();
    for (std::size_t i = 0; i < cut.size(); ++i) waiting_.insert(waiting_.end(), left_[i].begin(), left_[i].end());
  }

  static void improve_numbers(Worker& worker, const Part& part, std::size_t n, VertexList& left, StopToken& stop) {
    std::array<VertexId, kStretch> numbers;
    const std::size_t last = std::min<std::size_t>(n, part.last.index);
    for (std::size_t begin = part.first.index; begin < last; begin += kStretch) {
      const std::size_t count = std::min(kStretch, last - begin);
      for (std::size_t i = 0; i < count; ++i) numbers[i] = VertexId(begin + i);
      improve(worker, {numbers.data(), count}, part, left, stop);
    }
  }

  static void improve(Worker& worker, std::span<const VertexId> vertices, const Part& part, VertexList& left,
                      StopToken& stop) {
    for (std::size_t begin = 0; begin < vertices.size() && stop.goes_on(); begin += kStretch) {
      const auto stretch = vertices.subspan(begin, std::min(kStretch, vertices.size() - begin));
      const std::size_t before = left.size();
      worker.improve(stretch, part, left);
      stop.passed(stretch.size(), left.size() - before);
    }
  }

  std::size_t part_size_;
  WorkerPool<Worker>& workers_;
  std::vector<std::vector<VertexId>> left_;  // by each part of the phase under way: storage is kept
  std::vector<VertexId> waiting_;            // for the phase under way, in order
};

}  // namespace temper
