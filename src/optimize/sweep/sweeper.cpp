#include "optimize/sweep/sweeper.hpp"

#include <algorithm>
#include <array>

#include "base/assert.hpp"

namespace temper {

/// All threads of a sweep ask this token whether to go on. The calling thread asks the clock and the caller for the
/// others.
class StopToken {
 public:
  /// Construct it in the thread that asks the caller and the clock.
  StopToken(Run& run, std::size_t n_vertices)
      : run_(run), caller_(this_thread()), n_(static_cast<double>(std::max<std::size_t>(1, n_vertices))) {}

  /// Makes the next stretch ask the caller first. Call it in the thread that made this token.
  void ask_soon() {
    TEMPER_ASSERT(this_thread() == caller_);
    since_asked_ = kVerticesBetweenCalls;
  }
  /// Begin and end the work that each rank does alone. Rank 0 asks, and the others get its answer at the end.
  void begin_local(std::size_t n_ranks) {
    alone_ = true;
    n_ranks_ = n_ranks;
  }
  void end_local() {
    alone_ = false;
    n_ranks_ = 1;
    run_.sync_stop();
    if (run_.stopped_early()) stop_.store(true, std::memory_order_relaxed);
    ask_soon();  // on all ranks, whatever their progress
  }
  /// Call this before each stretch of vertices: it says whether to go on.
  [[nodiscard]] bool goes_on() {
    if (stop_.load(std::memory_order_relaxed)) return false;
    if (this_thread() != caller_ || since_asked_ < kVerticesBetweenCalls) return true;
    since_asked_ = 0;
    const bool stop = run_.asked_to_stop(static_cast<double>(done_.load(std::memory_order_relaxed)) / n_, alone_);
    if (stop) stop_.store(true, std::memory_order_relaxed);
    return !stop;
  }
  /// Call this after each stretch. `left` of its vertices must wait for another phase.
  void passed(std::size_t vertices, std::size_t left) {
    done_.fetch_add(n_ranks_ * (vertices - left), std::memory_order_relaxed);  // the other ranks do about as much
    if (this_thread() == caller_) since_asked_ += vertices;
  }
  [[nodiscard]] bool stopped() const { return stop_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kVerticesBetweenCalls = 8192;  // calls of the observer and the clock: a few milliseconds

  /// Returns a different address in each thread.
  static const void* this_thread() {
    thread_local const char here = 0;
    return &here;
  }

  Run& run_;
  const void* caller_;
  double n_;
  bool alone_ = false;                               // between begin_local() and end_local()
  std::size_t n_ranks_ = 1;                          // that work on other vertices
  std::size_t since_asked_ = kVerticesBetweenCalls;  // of the caller's thread
  std::atomic<bool> stop_ = false;
  std::atomic<std::size_t> done_ = 0;
};

namespace {

constexpr std::size_t kStretch = 8192;  // vertices between two calls of goes_on()

/// Improves these vertices of a part, in order. Vertices that need another part are appended to `left`.
template <class Vertices>
void improve(Improver& improver, const Vertices& vertices, const Part& part, std::vector<VertexId>& left,
             StopToken& stop) {
  std::array<VertexId, kStretch> stretch;
  for (auto next = vertices.begin(); next != vertices.end() && stop.goes_on();) {
    std::size_t n = 0;
    for (; n < kStretch && next != vertices.end(); ++next) stretch[n++] = *next;
    const std::size_t before = left.size();
    improver.improve({stretch.data(), n}, part, left);
    stop.passed(n, left.size() - before);
  }
}

}  // namespace

void Improvers::make_room(std::size_t n) {
  TEMPER_ASSERT_SLOW(std::none_of(places_.begin(), places_.end(), [](const Place& p) { return p.taken.load(); }));
  while (places_.size() < n) places_.emplace_back();
}

Improvers::Lease Improvers::take() {
  for (std::size_t i = 0;; i = (i + 1) % places_.size()) {
    Place& place = places_[i];
    if (place.taken.exchange(true, std::memory_order_acquire)) continue;
    if (!place.improver) {
      place.improver = std::make_unique<Improver>(context_);
      place.improver->step().begin_sweep(iteration_, unknowns_);
    }
    return Lease(place.improver.get(), {&place});
  }
}

void Improvers::begin_sweep(int iteration, Unknowns unknowns) {
  iteration_ = iteration, unknowns_ = unknowns;
  for_each([&](Improver& improver) { improver.step().begin_sweep(iteration, unknowns); });
}

Sweeper::Sweeper(WorkingCopy& work, Flipper& flipper, std::size_t part_size)
    : limits_(work, flipper.settings(), work.units),
      context_{work.mesh, flipper.settings(), flipper.state(), work.units, limits_, flipper.recorder()},
      flipper_(flipper),
      improvers_(context_),
      part_size_(part_size) {}

bool Sweeper::sweep(int iteration, std::span<const VertexId> sequence, Run& run) {
  const Unknowns all = unknowns_of_sweep(context_.settings, context_.state.energy, iteration);
  if (context_.settings.policy.visits == Visits::once || all != Unknowns::positions_and_weights) {
    return visit_all(iteration, all, sequence, run);
  }
  return visit_all(iteration, Unknowns::positions, sequence, run) &&
         visit_all(iteration, Unknowns::weights, sequence, run);
}

bool Sweeper::visit_all(int iteration, Unknowns unknowns, std::span<const VertexId> sequence, Run& run) {
  improvers_.begin_sweep(iteration, unknowns);
  StopToken stop(run, context_.mesh.n_vertices());
  sequence.empty() ? visit_parts(stop) : visit_in_order(sequence, stop);
  improvers_.for_each([](Improver& improver) { improver.step().end_sweep(); });
  add_changes();
  return !stop.stopped();
}

/// Visits the vertices in the parts of the numbers, then the vertices that are left in the parts of the shifted cuts.
/// The rest follows in order.
void Sweeper::visit_parts(StopToken& stop) {
  const Mesh& mesh = context_.mesh;
  const std::size_t n = mesh.n_vertices(), count = std::max<std::size_t>(1, (n + part_size_ - 1) / part_size_);
  if (count > 1 && !partitions_.are_of(mesh)) partitions_.cut(mesh, count, engine().executor());
  const Partition partition{n, count};
  const auto numbers = [&](std::size_t i) { return IdRange<VertexId>(partition[i].first, partition[i].last); };
  run_parts(
      count, stop, [&](std::size_t i) { return count == 1 ? Part() : partition[i]; }, numbers);
  const auto handed_out = [&](std::size_t i) {
    return std::span<const VertexId>(waiting_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
  };
  for (std::size_t k = 0; count > 1 && k < ShiftedPartitions::kPartitions; ++k) {
    stop.ask_soon();
    hand_out(k);
    run_parts(
        partitions_.n_parts(), stop, [&](std::size_t i) { return partitions_.part(k, i); }, handed_out);
  }
  std::sort(waiting_.begin(), waiting_.end());
  visit_in_order(waiting_, stop);
}

/// Visits vertices one after another, without parts.
void Sweeper::visit_in_order(std::span<const VertexId> vertices, StopToken& stop) {
  improvers_.make_room(1);
  std::vector<VertexId> none;
  const auto improver = improvers_.take();
  improver->flipper().log_flips(nullptr);
  improve(*improver, vertices, {}, none, stop);
}

/// Runs one phase of n parts: part(i) improves vertices(i). Vertices that are left wait for the next phase.
template <class PartOf, class VerticesOf>
void Sweeper::run_parts(std::size_t n, StopToken& stop, PartOf&& part, VerticesOf&& vertices) {
  const Engine by = engine();
  if (done_.size() < n) done_.resize(n);
  improvers_.make_room(n);
  if (by.has_ranks()) stop.begin_local(by.n_ranks());
  static_cast<void>(stop.goes_on());  // asks even if no part runs on this thread
  by.run(n, [&](std::size_t i) {
    done_[i].left.clear();
    done_[i].flips.clear();
    const auto improver = improvers_.take();
    improver->flipper().log_flips(by.has_ranks() ? &done_[i].flips : nullptr);
    improve(*improver, vertices(i), part(i), done_[i].left, stop);
  });
  const auto write = [&](ByteWriter& writer, std::size_t i) {
    writer.write(done_[i].left);
    writer.write(done_[i].flips);
    improvers_.take()->write(writer, vertices(i));
  };
  const auto read = [&](ByteReader& reader, std::size_t i) {
    reader.read(done_[i].left);
    reader.read(done_[i].flips);
    const auto improver = improvers_.take();
    improver->flipper().repeat(done_[i].flips);
    improver->read(reader, vertices(i));
  };
  by.exchange(n, write, read);
  if (by.has_ranks()) stop.end_local();
  waiting_.clear();
  for (std::size_t i = 0; i < n; ++i) waiting_.insert(waiting_.end(), done_[i].left.begin(), done_[i].left.end());
}

/// Sorts the waiting vertices by their parts of cut k (counting sort).
void Sweeper::hand_out(std::size_t k) {
  begin_.assign(partitions_.n_parts() + 1, 0);
  for (const VertexId v : waiting_) ++begin_[partitions_.part_of(k, v) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  handed_out_.resize(waiting_.size());
  std::vector<std::size_t> next = begin_;
  for (const VertexId v : waiting_) handed_out_[next[partitions_.part_of(k, v)]++] = v;
  waiting_.swap(handed_out_);
}

void Sweeper::shake(double amount, Rng& rng) {
  improvers_.make_room(1);
  improvers_.take()->step().shake(amount, rng);
  add_changes();
}

/// Returns the caller's engine if the proof in sweeper.hpp covers all steps. Otherwise parts run one by one on each
/// rank.
Engine Sweeper::engine() {
  const Policy& policy = context_.settings.policy;
  const bool told_in_order = context_.recorder.on() || policy.defers_updates();
  const bool removes = policy.removes_hidden() || policy.changes_vertices();
  if (told_in_order || removes || limits_.band.on() || limits_.guard.reads_stars()) return &in_order_;
  return engine_of(context_.settings.hooks);
}

void Sweeper::add_changes() {
  improvers_.for_each([this](Improver& improver) { flipper_.add(improver.flipper().take_changes()); });
}

}  // namespace temper
