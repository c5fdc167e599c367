#include "optimize/sweep/sweeper.hpp"

#include <algorithm>
#include <array>

namespace temper {
namespace {

// Vertices between looks at whether to stop.
constexpr std::size_t kStretch = 8192;
// By how much parts grow from phase to phase, once shifted.
constexpr std::size_t kGrowth = 4;

std::size_t pieces_of(std::size_t n, std::size_t most) { return std::max<std::size_t>(1, (n + most - 1) / most); }

}  // namespace

Sweeper::Worker::Worker(Sweeper& sweeper)
    : flipper(sweeper.mesh_, sweeper.settings_, sweeper.recorder_),
      step(sweeper.mesh_, sweeper.settings_, sweeper.frame_, sweeper.limits_, flipper, sweeper.recorder_) {}

Sweeper::Sweeper(Mesh& mesh, const Settings& settings, const Frame& frame, Flipper& flipper, const Recorder& recorder,
                 std::size_t part_size)
    : mesh_(mesh),
      settings_(settings),
      frame_(frame),
      flipper_(flipper),
      recorder_(recorder),
      part_size_(part_size),
      limits_(mesh, settings, frame),
      main_(mesh, settings, frame, limits_, flipper, recorder),
      passes_(mesh, settings, frame, limits_, recorder, part_size) {}

bool Sweeper::sweep(int iteration, std::span<const VertexId> sequence, Run& run) {
  iteration_ = iteration;
  main_.begin_sweep(iteration);
  Watch watch(run, mesh_.n_vertices());
  const bool along_curve = settings_.options.order == SweepOrder::hilbert;
  if (along_curve && mesh_.n_vertices() > part_size_) {
    sweep_in_parts(watch);
  } else {
    sweep_in_order(sequence, watch);
  }
  main_.end_sweep();
  return !watch.stopped();
}

bool Sweeper::newton_pass(int iteration, Run& run) {
  Watch watch(run, mesh_.n_vertices());
  passes_.run(unknowns_of_sweep(settings_.options, iteration), watch);
  return !watch.stopped();
}

/// One after another, without parts.
void Sweeper::sweep_in_order(std::span<const VertexId> sequence, Watch& watch) {
  Piece whole;
  if (sequence.empty()) {
    improve_numbers(main_, 0, mesh_.n_vertices(), whole, watch);
  } else {
    improve(main_, sequence, whole, watch);
  }
}

void Sweeper::sweep_in_parts(Watch& watch) {
  std::size_t count = pieces_of(mesh_.n_vertices(), part_size_);
  cut(count, false);
  run_pieces(true, watch);
  for (; count > 1; count = pieces_of(count, kGrowth)) {
    watch.ask_soon();
    cut(count, true);
    run_pieces(false, watch);
  }
  Piece whole;
  improve(main_, waiting_, whole, watch);
}

void Sweeper::cut(std::size_t count, bool shifted) {
  n_pieces_ = shifted ? count + 1 : count;
  if (pieces_.size() < n_pieces_) pieces_.resize(n_pieces_);
  for (std::size_t i = 0; i < n_pieces_; ++i) {
    pieces_[i].part = part_of(mesh_.n_vertices(), count, i, shifted);
    pieces_[i].left.clear();
  }
}

/// Improves what is waiting, or in the first phase all vertices. What is left waits for the next.
void Sweeper::run_pieces(bool first, Watch& watch) {
  const auto run_one = [&](Piece& piece, VertexStep& step) {
    if (first) {
      improve_numbers(step, piece.part.first.index, piece.part.last.index, piece, watch);
    } else {
      const auto begin = std::lower_bound(waiting_.begin(), waiting_.end(), piece.part.first);
      improve(step, {begin, std::lower_bound(begin, waiting_.end(), piece.part.last)}, piece, watch);
    }
  };
  if (may_run_at_once()) {
    desks_.make_room(n_pieces_);
    static_cast<void>(watch.goes_on());  // asks, should no piece run on this thread
    settings_.options.executor->run(n_pieces_, [&](std::size_t i) {
      auto& desk = desks_.take([this] { return std::make_unique<Worker>(*this); });
      desk.worker->step.begin_sweep(iteration_);
      run_one(pieces_[i], desk.worker->step);
      desk.leave();
    });
    desks_.for_each_worker([this](Worker& worker) { flipper_.add(worker.flipper.take_changes()); });
  } else {
    for (std::size_t i = 0; i < n_pieces_; ++i) run_one(pieces_[i], main_);
  }
  waiting_.clear();
  for (std::size_t i = 0; i < n_pieces_; ++i) {
    waiting_.insert(waiting_.end(), pieces_[i].left.begin(), pieces_[i].left.end());
  }
}

void Sweeper::improve_numbers(VertexStep& step, std::size_t first, std::size_t last, Piece& piece, Watch& watch) {
  std::array<VertexId, kStretch> numbers;
  for (std::size_t begin = first; begin < last; begin += kStretch) {
    const std::size_t count = std::min(kStretch, last - begin);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = VertexId(begin + i);
    if (!improve_stretch(step, {numbers.data(), count}, piece, watch)) return;
  }
}

void Sweeper::improve(VertexStep& step, std::span<const VertexId> vertices, Piece& piece, Watch& watch) {
  for (std::size_t begin = 0; begin < vertices.size(); begin += kStretch) {
    const std::size_t count = std::min(kStretch, vertices.size() - begin);
    if (!improve_stretch(step, vertices.subspan(begin, count), piece, watch)) return;
  }
}

/// False when the sweep does not go on.
bool Sweeper::improve_stretch(VertexStep& step, std::span<const VertexId> vertices, Piece& piece, Watch& watch) {
  if (!watch.goes_on()) return false;
  const std::size_t left = piece.left.size();
  step.improve(vertices, piece.part, piece.left);
  watch.passed(vertices.size(), piece.left.size() - left);
  return true;
}

/// Whether steps only do what sweeper.hpp says of them.
bool Sweeper::may_run_at_once() const {
  const OptimizeOptions& o = settings_.options;
  const bool in_order = recorder_.on() || o.weight_updates == WeightUpdates::deferred;
  const bool removes = o.hidden == HiddenPolicy::remove || o.collapse_from || o.removal != Removal::none;
  return o.executor != nullptr && !in_order && !removes && !limits_.band.on();
}

}  // namespace temper
