#include "optimize/run/run.hpp"

#include "base/bytes.hpp"
#include "geometry/predicates_inline.hpp"
#include "optimize/run/estimate.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/working/rounding.hpp"

namespace temper {

bool time_is_up(double elapsed, double ending, double limit) { return limit > 0 && elapsed + ending > limit; }

void Run::offer(const WorkingCopy& now, const Settings& settings, const SweepState& state) const {
  if (!hooks_.best_so_far) return;
  hooks_.best_so_far([&](const std::function<void(const BestSoFar&)>& use) {
    const auto score_of = [&](const WorkingCopy& work) { return score(work.mesh, settings, state.model); };
    const WorkingCopy* best = &now;
    if (best_before != nullptr && !replaces(score_of(now), score_of(*best_before), Requirement::not_worse)) {
      best = best_before;
    }
    const MeshScore found = score_of(*best);
    if (found.inverted > 0 || (found.non_regular > 0 && !settings.policy.keeps_connectivity)) return;
    Mesh mesh = best->in_user_terms(settings.executor());
    IdVector<VertexId, VertexId> vertices;
    if (best->has_gaps || best->has_inserted()) vertices = best->user_vertices();
    take_back_rounding(input_, vertices, mesh);
    use({mesh, vertices});
  });
}

bool Run::asked_to_stop(double fraction_of_sweep) {
  if (hooks_.communicator == nullptr) return ask(fraction_of_sweep);
  if (hooks_.communicator->rank() == 0) ask(fraction_of_sweep);
  if (!local_) sync_stop();
  return stopped_early();
}

void Run::end_local() {
  local_ = false;
  if (hooks_.communicator != nullptr) sync_stop();
}

/// All ranks stop if rank 0 was told to.
void Run::sync_stop() {
  std::string message;
  ByteWriter(message).write(report.stopped);
  hooks_.communicator->broadcast(message, 0);
  Stopped stopped = report.stopped;
  ByteReader(message).read(stopped);
  if (temper::stopped_early(stopped)) report.stopped = stopped;
}

bool Run::ask(double fraction_of_sweep) {
  if (time_is_up(seconds_between(limit_from_, Clock::now()), ending_seconds_, options_.time_limit)) {
    report.stopped = Stopped::time_limit;
    return true;
  }
  const auto progress = [&]() -> Progress {
    return {report.history.back(), fraction_of_sweep, options_.max_sweeps,
            estimate_sweeps_left(report.history, options_)};
  };
  if (hooks_.observer && hooks_.observer(progress()) == Continue::no) {
    report.stopped = Stopped::cancelled;
    return true;
  }
  return false;
}

std::size_t count_inverted(const Mesh& mesh) {
  std::size_t count = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (inlined::orientation(mesh, a, b, c) != Sign::positive) ++count;
  }
  return count;
}

}  // namespace temper
