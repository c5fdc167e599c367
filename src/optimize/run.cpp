#include "optimize/run.hpp"

#include "base/bytes.hpp"
#include "geometry/predicates_inline.hpp"
#include "optimize/estimate.hpp"

namespace temper {

bool Run::asked_to_stop(double fraction_of_sweep) {
  if (communicator_ == nullptr) return ask(fraction_of_sweep);
  if (communicator_->rank() == 0) ask(fraction_of_sweep);
  if (!local_) sync_stop();
  return stopped_early();
}

void Run::end_local() {
  local_ = false;
  if (communicator_ != nullptr) sync_stop();
}

/// All ranks stop if rank 0 was told to.
void Run::sync_stop() {
  std::string message;
  ByteWriter(message).write(report.stopped);
  communicator_->broadcast(message, 0);
  Stopped stopped = report.stopped;
  ByteReader(message).read(stopped);
  if (temper::stopped_early(stopped)) report.stopped = stopped;
}

bool Run::ask(double fraction_of_sweep) {
  if (options_.time_limit > 0 && seconds_here() + ending_seconds_ > options_.time_limit) {
    report.stopped = Stopped::time_limit;
    return true;
  }
  const auto progress = [&]() -> Progress {
    return {report.history.back(), fraction_of_sweep, options_.max_sweeps,
            estimate_sweeps_left(report.history, options_)};
  };
  if (observer_ && observer_(progress()) == Continue::no) {
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
