#include "optimize/sweep/accuracy_sweeper.hpp"

#include <algorithm>
#include <memory>

namespace temper {
namespace {

// Vertices between looks at whether to stop.
constexpr std::size_t kAccuracyStretch = 8192;

}  // namespace

AccuracySweeper::AccuracySweeper(Mesh& mesh, const Settings& settings, const Frame& frame, const AccuracyGround& ground,
                                 const Recorder& recorder, std::size_t part_size)
    : mesh_(mesh),
      settings_(settings),
      frame_(frame),
      ground_(ground),
      recorder_(recorder),
      limits_(mesh, settings, frame),
      n_parts_(std::max<std::size_t>(1, (mesh.n_vertices() + part_size - 1) / part_size)),
      main_(make_step()) {}

bool AccuracySweeper::sweep(Run& run) {
  Watch watch(run, mesh_.n_vertices());
  waiting_.clear();
  for (const VertexId v : mesh_.vertices()) waiting_.push_back(v);
  if (n_parts_ > 1) {
    run_parts(false, watch);
    watch.ask_soon();
    run_parts(true, watch);
  }
  std::vector<VertexId> none;
  improve(main_, waiting_, {}, none, watch);
  return !watch.stopped();
}

/// Improves what is waiting. What no part could, waits for what comes next.
void AccuracySweeper::run_parts(bool shifted, Watch& watch) {
  const std::size_t count = shifted ? n_parts_ + 1 : n_parts_;
  left_.resize(count);
  const auto run_part = [&](AccuracyStep& step, std::size_t i) {
    const Part part = part_of(mesh_.n_vertices(), n_parts_, i, shifted);
    const auto begin = std::lower_bound(waiting_.begin(), waiting_.end(), part.first);
    left_[i].clear();
    improve(step, {begin, std::lower_bound(begin, waiting_.end(), part.last)}, part, left_[i], watch);
  };
  if (may_run_at_once()) {
    desks_.make_room(count);
    static_cast<void>(watch.goes_on());  // asks, should no part run on this thread
    settings_.options.executor->run(count, [&](std::size_t i) {
      auto& desk = desks_.take([this] { return std::make_unique<AccuracyStep>(make_step()); });
      run_part(*desk.worker, i);
      desk.leave();
    });
  } else {
    for (std::size_t i = 0; i < count; ++i) run_part(main_, i);
  }
  waiting_.clear();
  for (const std::vector<VertexId>& of_part : left_) waiting_.insert(waiting_.end(), of_part.begin(), of_part.end());
}

/// Those that are confined to the part; the others are left.
void AccuracySweeper::improve(AccuracyStep& step, std::span<const VertexId> vertices, const Part& part,
                              std::vector<VertexId>& left, Watch& watch) const {
  for (std::size_t begin = 0; begin < vertices.size(); begin += kAccuracyStretch) {
    if (!watch.goes_on()) return;
    const auto stretch = vertices.subspan(begin, std::min(kAccuracyStretch, vertices.size() - begin));
    const std::size_t before = left.size();
    for (const VertexId v : stretch) {
      if (mesh_.is_isolated(v)) continue;
      if (is_confined(mesh_, v, part)) {
        step.improve(v);
      } else {
        left.push_back(v);
      }
    }
    watch.passed(stretch.size(), left.size() - before);
  }
}

/// Events are told in order, and a size band keeps the field where vertices are and looks at the stars of neighbours.
bool AccuracySweeper::may_run_at_once() const {
  return settings_.options.executor != nullptr && !recorder_.on() && !limits_.band.on();
}

}  // namespace temper
