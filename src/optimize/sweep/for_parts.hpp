// Work on the parts of a mesh, at once or one after another, by one process or several: the same bytes each way.
//
// This is the only place that knows of executors, of ranks, of the workers that threads need, of when to stop, of parts
// that are shifted and of vertices that wait for another part.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "base/engine.hpp"
#include "optimize/flips/partition.hpp"
#include "optimize/sweep/shifted_cuts.hpp"
#include "optimize/sweep/stop_token.hpp"

namespace temper {

// The workers of parts that run at once: as many are made as ever are at work together, and kept.

template <class Worker>
class WorkerPool {
  struct Place {
    std::atomic<bool> taken = false;
    std::unique_ptr<Worker> worker;
  };

 public:
  explicit WorkerPool(std::function<std::unique_ptr<Worker>()> make) : make_(std::move(make)) {}

  /// A worker that nobody else has, until this ends.
  struct GiveBack {
    Place* place;
    void operator()(Worker*) const { place->taken.store(false, std::memory_order_release); }
  };
  using Lease = std::unique_ptr<Worker, GiveBack>;

  /// Room for n workers; while none is leased.
  void make_room(std::size_t n) {
    TEMPER_ASSERT_SLOW(std::none_of(places_.begin(), places_.end(), [](const Place& p) { return p.taken.load(); }));
    while (places_.size() < n) places_.emplace_back();
  }

  /// The first worker that is free. With as many places as there are blocks one always is, or is just about to be.
  [[nodiscard]] Lease take() {
    for (std::size_t i = 0;; i = (i + 1) % places_.size()) {
      if (places_[i].taken.exchange(true, std::memory_order_acquire)) continue;
      if (!places_[i].worker) places_[i].worker = make_();
      return Lease(places_[i].worker.get(), {&places_[i]});
    }
  }

  /// Every worker that has been made; while none is leased.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (Place& place : places_) {
      if (place.worker) visit(*place.worker);
    }
  }

 private:
  std::function<std::unique_ptr<Worker>()> make_;
  std::deque<Place> places_;  // places do not move; few of them ever get a worker
};

/// Calls work(worker, i) for each of n parts, by the engine's threads and ranks. For write and read see
/// Engine::exchange().
template <class Worker, class Work, class Write, class Read>
void for_parts(std::size_t n, const Engine& engine, WorkerPool<Worker>& workers, StopToken& stop, Work&& work,
               Write&& write, Read&& read) {
  workers.make_room(n);
  if (engine.has_ranks()) stop.begin_local(engine.n_ranks());
  static_cast<void>(stop.goes_on());  // asks, should no part run on this thread
  engine.run(n, [&](std::size_t i) {
    const auto worker = workers.take();
    work(*worker, i);
  });
  engine.exchange(n, write, read);
  if (engine.has_ranks()) stop.end_local();
}

/// A sweep over all vertices, by workers with functions improve(vertices, part, left): it improves those that it can,
/// in order, and appends the others to `left`; log_flips(log), which says where flips are appended to; repeat(flips),
/// which does them again; write(writer, vertices) and read(reader, vertices), of what else a sweep changes.
///
/// First each part of the numbers does what it can. What is left comes next, with the parts of three shifted cuts,
/// inside of which nearly all of it is. What is left then, mostly nothing, comes one after another.
template <class Worker>
class PartSweep {
 public:
  PartSweep(std::size_t part_size, WorkerPool<Worker>& workers) : part_size_(part_size), workers_(workers) {}

  void in_parts(const Mesh& mesh, const Engine& engine, StopToken& stop) {
    const std::size_t n = mesh.n_vertices(), count = std::max<std::size_t>(1, (n + part_size_ - 1) / part_size_);
    if (count > 1 && !cuts_.are_of(mesh)) cuts_.cut(mesh, count, engine.executor());
    const Cut cut{n, count};
    const auto in_numbers = [&](Worker& worker, std::size_t i, VertexList& left) {
      improve_numbers(worker, count == 1 ? Part() : cut[i], n, left, stop);
    };
    run(count, engine, stop, in_numbers, [&](std::size_t i) { return IdRange<VertexId>(cut[i].first, cut[i].last); });
    for (std::size_t k = 0; count > 1 && k < ShiftedCuts::kCuts; ++k) {
      stop.ask_soon();
      hand_out(k);
      const auto of_part = [&](std::size_t i) {
        return std::span<const VertexId>(waiting_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
      };
      const auto in_cut = [&](Worker& worker, std::size_t i, VertexList& left) {
        improve(worker, of_part(i), cuts_.part(k, i), left, stop);
      };
      run(cuts_.n_parts(), engine, stop, in_cut, of_part);
    }
    std::sort(waiting_.begin(), waiting_.end());
    in_order(waiting_, stop);
  }

  /// Vertices have other numbers than before.
  void renumber() { cuts_.clear(); }

  /// These vertices one after another, without parts.
  void in_order(std::span<const VertexId> vertices, StopToken& stop) {
    workers_.make_room(1);
    VertexList none;
    const auto worker = workers_.take();
    worker->log_flips(nullptr);
    improve(*worker, vertices, {}, none, stop);
  }

 private:
  using VertexList = std::vector<VertexId>;
  static constexpr std::size_t kStretch = 8192;  // vertices between looks at whether to stop

  /// What a part has done besides moving vertices.
  struct Done {
    VertexList left;
    std::vector<HalfedgeId> flips;  // for other ranks
  };

  /// One phase of n parts, of these vertices. What is left after it waits for the next.
  template <class Work, class VerticesOf>
  void run(std::size_t n, const Engine& engine, StopToken& stop, Work&& work, VerticesOf&& vertices) {
    if (done_.size() < n) done_.resize(n);
    const auto part = [&](Worker& worker, std::size_t i) {
      done_[i].left.clear();
      done_[i].flips.clear();
      worker.log_flips(engine.has_ranks() ? &done_[i].flips : nullptr);
      work(worker, i, done_[i].left);
    };
    const auto write = [&](ByteWriter& writer, std::size_t i) {
      writer.write(done_[i].left);
      writer.write(done_[i].flips);
      workers_.take()->write(writer, vertices(i));
    };
    const auto read = [&](ByteReader& reader, std::size_t i) {
      reader.read(done_[i].left);
      reader.read(done_[i].flips);
      const auto worker = workers_.take();
      worker->repeat(done_[i].flips);
      worker->read(reader, vertices(i));
    };
    for_parts(n, engine, workers_, stop, part, write, read);
    waiting_.clear();
    for (std::size_t i = 0; i < n; ++i) waiting_.insert(waiting_.end(), done_[i].left.begin(), done_[i].left.end());
  }

  /// Those that wait, by their parts of cut k (counting sort).
  void hand_out(std::size_t k) {
    begin_.assign(cuts_.n_parts() + 1, 0);
    for (const VertexId v : waiting_) ++begin_[cuts_.part_of(k, v) + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    handed_out_.resize(waiting_.size());
    std::vector<std::size_t> next = begin_;
    for (const VertexId v : waiting_) handed_out_[next[cuts_.part_of(k, v)]++] = v;
    waiting_.swap(handed_out_);
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
  std::vector<Done> done_;            // by each part of the phase under way: storage is kept
  std::vector<VertexId> waiting_;     // for the phase under way
  std::vector<VertexId> handed_out_;  // as they are put in the order of their parts
  std::vector<std::size_t> begin_;    // of each part among those that wait
  ShiftedCuts cuts_;                  // as the mesh was at the first sweep, or the first with these vertices
};

}  // namespace temper
