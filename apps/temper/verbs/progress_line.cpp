#include "verbs/progress_line.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace temper::app {
namespace {

constexpr std::chrono::milliseconds kInterval(100);  // faster than this nobody reads

std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 100 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

/// The phase that lowers the objective, and what its energy is. At the change of the phase the number jumps.
struct PhaseWords {
  const char *phase, *measure;
};
PhaseWords phase_words(Objective objective) {
  switch (objective) {
    case Objective::energy:
      break;
    case Objective::accuracy:
      return {"accuracy phase", "accuracy energy"};
    case Objective::solver_error:
      return {"solver phase", "error"};
  }
  return {"centering phase", "energy"};
}

}  // namespace

void ProgressLine::show(const Progress& progress) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (shown_ && now - last_ < kInterval) return;
  last_ = now;
  shown_ = true;

  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double sweeps = progress.last.sweep + progress.fraction;
  const auto [phase, measure] = phase_words(progress.last.objective);
  const std::string share =
      progress.share_of_phase ? fmt::format(" {:.0f} %", std::floor(100 * *progress.share_of_phase)) : std::string();
  std::string text = fmt::format("{}{}: sweep {}, {} {} bad, {} {:.6g}, {}", phase, share, progress.last.sweep,
                                 progress.last.bad, elements_, measure, progress.last.energy, duration(seconds));
  if (!progress.phase.empty()) {
    text = std::string(progress.phase);
    if (progress.fraction > 0) text += fmt::format(", {:.0f} %", 100 * progress.fraction);
    text += ", " + duration(seconds);
  } else if (progress.n_vertices) {
    text = fmt::format("{} vertices, {} {} bad, {}", *progress.n_vertices, progress.last.bad, elements_,
                       duration(seconds));
  } else if (progress.sweeps_left && sweeps > 0) {
    const double left = std::max(0.0, *progress.sweeps_left - progress.fraction);
    text += fmt::format(", about {} left", duration(seconds / sweeps * left));
  }
  fmt::print(stderr, "\r{}\x1b[K", text);
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (shown_) fmt::print(stderr, "\r\x1b[K");
  shown_ = false;
}

}  // namespace temper::app
