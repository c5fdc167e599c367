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
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "base/engine.hpp"
#include "optimize/flips/partition.hpp"
#include "optimize/run/run.hpp"
#include "optimize/sweep/shifted_cuts.hpp"

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

// When to stop: all threads of a sweep ask whether to go on, one of them finds out.

/// The thread that called asks the clock and the caller; the others hear of the answer.
class StopToken {
 public:
  /// To be made in the thread that is to ask.
  StopToken(Run& run, std::size_t n_vertices)
      : run_(run), caller_(this_thread()), n_(static_cast<double>(std::max<std::size_t>(1, n_vertices))) {}

  /// Has the caller asked before the next stretch. To be called from the thread that asks.
  void ask_soon() {
    TEMPER_ASSERT(this_thread() == caller_);
    since_asked_ = kVerticesBetweenCalls;
  }
  /// Begins and ends what each rank does alone: rank 0 asks meanwhile, the others get the answer at the end.
  void begin_local(std::size_t n_ranks) {
    alone_ = true;
    n_ranks_ = n_ranks;
  }
  void end_local() {
    alone_ = false;
    n_ranks_ = 1;
    run_.sync_stop();
    if (run_.stopped_early()) stop_.store(true, std::memory_order_relaxed);
    ask_soon();  // on all ranks, however much each has done
  }
  /// To be asked before each stretch of vertices: says whether to go on.
  [[nodiscard]] bool goes_on() {
    if (stop_.load(std::memory_order_relaxed)) return false;
    if (this_thread() != caller_ || since_asked_ < kVerticesBetweenCalls) return true;
    since_asked_ = 0;
    const bool stop = run_.asked_to_stop(static_cast<double>(done_.load(std::memory_order_relaxed)) / n_, alone_);
    if (stop) stop_.store(true, std::memory_order_relaxed);
    return !stop;
  }
  /// To be told after each stretch, some of whose vertices must wait for another phase.
  void passed(std::size_t vertices, std::size_t left) {
    done_.fetch_add(n_ranks_ * (vertices - left), std::memory_order_relaxed);  // the others do about as much
    if (this_thread() == caller_) since_asked_ += vertices;
  }
  [[nodiscard]] bool stopped() const { return stop_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kVerticesBetweenCalls = 8192;  // of the observer and the clock: a few milliseconds

  /// A different address in each thread.
  static const void* this_thread() {
    thread_local const char here = 0;
    return &here;
  }

  Run& run_;
  const void* caller_;
  double n_;
  bool alone_ = false;                               // between begin_local() and end_local()
  std::size_t n_ranks_ = 1;                          // that are at work on other vertices
  std::size_t since_asked_ = kVerticesBetweenCalls;  // the caller's own
  std::atomic<bool> stop_ = false;
  std::atomic<std::size_t> done_ = 0;
};

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
    run(
        count, engine, stop, [&](std::size_t i) { return count == 1 ? Part() : cut[i]; },
        [&](std::size_t i) { return IdRange<VertexId>(cut[i].first, cut[i].last); });
    for (std::size_t k = 0; count > 1 && k < ShiftedCuts::kCuts; ++k) {
      stop.ask_soon();
      hand_out(k);
      run(
          cuts_.n_parts(), engine, stop, [&](std::size_t i) { return cuts_.part(k, i); },
          [&](std::size_t i) {
            return std::span<const VertexId>(waiting_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
          });
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

  /// One phase of n parts: part(i) of vertices(i). What is left after it waits for the next.
  template <class PartOf, class VerticesOf>
  void run(std::size_t n, const Engine& engine, StopToken& stop, PartOf&& part, VerticesOf&& vertices) {
    if (done_.size() < n) done_.resize(n);
    workers_.make_room(n);
    if (engine.has_ranks()) stop.begin_local(engine.n_ranks());
    static_cast<void>(stop.goes_on());  // asks, should no part run on this thread
    engine.run(n, [&](std::size_t i) {
      done_[i].left.clear();
      done_[i].flips.clear();
      const auto worker = workers_.take();
      worker->log_flips(engine.has_ranks() ? &done_[i].flips : nullptr);
      improve(*worker, vertices(i), part(i), done_[i].left, stop);
    });
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
    engine.exchange(n, write, read);
    if (engine.has_ranks()) stop.end_local();
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

  template <class Vertices>
  static void improve(Worker& worker, const Vertices& vertices, const Part& part, VertexList& left, StopToken& stop) {
    std::array<VertexId, kStretch> stretch;
    for (auto next = vertices.begin(); next != vertices.end() && stop.goes_on();) {
      std::size_t n = 0;
      for (; n < kStretch && next != vertices.end(); ++next) stretch[n++] = *next;
      const std::size_t before = left.size();
      worker.improve({stretch.data(), n}, part, left);
      stop.passed(n, left.size() - before);
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
