// The driver: sweeps along the schedule of γ, the history, and the best mesh.
#include "temper/tets/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "tets/optimize/sweeper.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

// γ shrinks from level to level, as in the plane (optimize/run/schedule.hpp). On 13 public meshes a last γ of 0.01
// leaves 10 bad tetrahedra in a ball that 0.003 makes good, and steps of 0.85 gain nothing.
constexpr double kFirstGamma = 1, kGammaFactor = 0.7, kLastGamma = 0.003;
constexpr int kLevelSweeps = 3;
constexpr double kRelaxation = 1.7;
// At the last γ the run ends when a sweep lowers the energy by less than this part of it, or after so many sweeps.
constexpr double kTolerance = 1e-4;
constexpr int kLastSweeps = 100;
// Vertices between two looks at the clock.
constexpr std::size_t kVerticesPerLook = 1024;

bool is_bad(const TetMesh& mesh, TetId t) {
  for (int f = 0; f < 4; ++f) {
    const HalffaceId h = TetMesh::halfface(t, f);
    const auto [a, b, c] = points_of(mesh, h);
    if (signed_height_sign(a, b, c, mesh.point(mesh.opposite(h))) != Sign::positive) return true;
  }
  return false;
}

std::size_t count_bad(const TetMesh& mesh) {
  const auto all = mesh.tetrahedra();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](TetId t) { return is_bad(mesh, t); }));
}

double total_energy(const TetMesh& mesh, double gamma) {
  double sum = 0;
  for (const TetId t : mesh.tetrahedra()) {
    const HalffaceId h = TetMesh::halfface(t, 0);
    const LinkFace<double> face = link_face(mesh, h);
    sum += star_energy({&face, 1}, mesh.point(mesh.opposite(h)), gamma);
  }
  return sum;
}

std::optional<InputError> wrong_option(const OptimizeOptions& options) {
  if (options.max_sweeps < 0)
    return InputError{
        ErrorCode::invalid_option, {}, "max_sweeps: expected at least 0, found " + std::to_string(options.max_sweeps)};
  if (options.keep_positions && options.keep_weights)
    return InputError{ErrorCode::invalid_option, {}, "positions and weights are both to be kept; expected one"};
  if (!(options.time_limit >= 0))
    return InputError{
        ErrorCode::invalid_option, {}, "time_limit: expected at least 0, found " + to_text(options.time_limit)};
  return std::nullopt;
}

class Run {
 public:
  Run(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks)
      : mesh_(mesh), options_(options), hooks_(hooks), sweeper_(mesh, options) {}

  OptimizeReport run() {
    report_.objective_before = total_energy(mesh_, kLastGamma);
    record();
    for (double gamma = best_bad_ == 0 ? kLastGamma : kFirstGamma; gamma > kLastGamma; gamma *= kGammaFactor) {
      for (int i = 0; i < kLevelSweeps; ++i) {
        if (!sweep(gamma)) return end();
      }
    }
    for (int i = 0; i < kLastSweeps; ++i) {
      if (!sweep(kLastGamma)) return end();
      const auto last = report_.history.end() - 1;
      if (i > 0 && (last - 1)->energy - last->energy <= kTolerance * last->energy) break;
    }
    return end();
  }

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  /// Returns false if no further sweep may follow. A sweep that was stopped is kept if it makes the mesh no worse.
  bool sweep(double gamma) {
    if (report_.sweeps == options_.max_sweeps) {
      report_.stopped = Stopped::max_sweeps;
      return false;
    }
    gamma_ = gamma;
    for (const VertexId v : mesh_.vertices()) {
      if (v.index % kVerticesPerLook == 0 && is_stopped(double(v.index) / double(mesh_.n_vertices()))) break;
      sweeper_.improve(v, {gamma, kRelaxation});
    }
    if (!stopped_early(report_.stopped)) ++report_.sweeps;
    record();
    return !stopped_early(report_.stopped);
  }

  bool is_stopped(double fraction) {
    if (options_.time_limit > 0 && seconds_since(start_) > options_.time_limit - 2 * seconds_before_) {
      report_.stopped = Stopped::time_limit;
    } else if (hooks_.observer &&
               hooks_.observer({report_.history.back(), fraction, options_.max_sweeps}) == Continue::no) {
      report_.stopped = Stopped::canceled;
    }
    return stopped_early(report_.stopped);
  }

  /// Measures the mesh, and keeps its points if it is the best so far. Of equals the last is the best.
  void record() {
    const std::size_t bad = count_bad(mesh_);
    if (report_.history.empty() || bad <= best_bad_) {
      best_bad_ = bad;
      best_.clear();
      for (const VertexId v : mesh_.vertices()) best_.push_back(mesh_.point(v));
    }
    if (stopped_early(report_.stopped)) return;
    SweepRecord now;
    now.sweep = report_.sweeps;
    now.energy = total_energy(mesh_, gamma_);
    now.bad = bad;
    now.length_parameter = gamma_;
    now.seconds = seconds_since(start_);
    report_.history.push_back(now);
  }

  OptimizeReport end() {
    for (const VertexId v : mesh_.vertices()) mesh_.set_point(v, best_[v.index]);
    report_.objective_after = total_energy(mesh_, kLastGamma);
    report_.seconds = seconds_since(start_);
    return std::move(report_);
  }

  TetMesh& mesh_;
  const OptimizeOptions& options_;
  const OptimizeHooks& hooks_;
  Sweeper sweeper_;
  Clock::time_point start_ = Clock::now();
  // What reading took, writing will take, too: both are parts of the limit.
  double seconds_before_ = std::chrono::duration<double>(start_ - hooks_.started.value_or(start_)).count();
  OptimizeReport report_;
  double gamma_ = kFirstGamma;
  std::size_t best_bad_ = 0;
  std::vector<WeightedPoint> best_;
};

}  // namespace

Expected<OptimizeReport> optimize(TetMesh& mesh, const OptimizeOptions& options, const OptimizeHooks& hooks) {
  if (auto wrong = wrong_option(options)) return *std::move(wrong);
  if (mesh.n_tetrahedra() == 0) return OptimizeReport{};
  return Run(mesh, options, hooks).run();
}

}  // namespace temper::tets
