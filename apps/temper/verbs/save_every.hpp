// --save-every: the best mesh so far, in the form of the result, is written during a run.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "console.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {

/// Writes a file as the result will be written.
inline Expected<void> save(const OptimizeSettings& s, const io::MeshFile& file, Executor* threads) {
  io::WriteOptions options = s.output.options;
  options.executor = threads;
  const Expected<std::vector<std::string>> written = io::write(s.output.path, file, options);
  if (!written) return written.error();
  return {};
}

/// The listener of a run. `save_best` writes a best mesh. A run whose mesh cannot be written goes on, and prints one
/// warning.
template <class SaveBest>
auto saver(const OptimizeSettings& s, SaveBest save_best) {
  using Clock = std::chrono::steady_clock;
  return [&s, save_best, last = Clock::now(), warned = false](const auto& best) mutable {
    if (std::chrono::duration<double>(Clock::now() - last).count() < *s.save_every) return;
    best([&](const auto& mesh) {
      const Expected<void> saved = save_best(mesh);
      if (!saved && !std::exchange(warned, true)) print_warnings(std::vector{saved.error().what()});
    });
    last = Clock::now();
  };
}

}  // namespace temper::app
