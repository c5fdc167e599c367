// Checkpoints as files: all that a run needs to go on, so that nothing else has to be there, or as it was.
//
//     io::CheckpointFile checkpoint("run.ckpt", 600);
//     OptimizeHooks hooks;
//     hooks.checkpoints = [&](const auto& state) { checkpoint.keep(state); };
//     auto report = optimize(mesh, options, hooks);
//     if (report && stopped_early(report->stopped)) checkpoint.write();
//     …
//     auto before = io::read_checkpoint("run.ckpt");
//     hooks.resume = before->state;
//     report = optimize(the_same_mesh, options, hooks);
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "temper/error.hpp"
#include "temper/io.hpp"

namespace temper::io {

struct Checkpoint {
  std::vector<std::string> command;  ///< the words that the run was started by; none, when it was by no command
  std::vector<MeshFile> inputs;      ///< the files that it has read, as read() gave them
  std::string trace;                 ///< the text of its trace so far
  std::uint64_t events = 0;          ///< in the trace
  std::string state;                 ///< OptimizeHooks::resume; empty: the run goes on from its beginning
};
/// Errors: no checkpoint; one of another version of temper; one that was cut off or damaged.
[[nodiscard]] Expected<Checkpoint> read_checkpoint(const std::string& path);

/// The checkpoints of a run, of which the last one is in a file.
class CheckpointFile {
 public:
  /// `seconds`: between two times that the file is written, first at once. 0: at every place where it can be.
  CheckpointFile(std::string path, double seconds);

  void set_command(std::vector<std::string> command) { now_.command = std::move(command); }
  /// A file that the run has read. It is copied.
  void add_input(const MeshFile& file);
  /// Where the text of a trace is.
  struct TracePlace {
    std::uint64_t bytes = 0, events = 0;
  };
  /// Tells where the trace is when a state is kept, and how to get its text when that is written.
  void set_trace(std::function<TracePlace()> place, std::function<Expected<std::string>()> text);

  /// To be called at every place where a checkpoint can be taken. Keeps the state, unless that would take more than a
  /// twentieth of the time, and writes it when it is time to. An error is one of writing: what was there before still
  /// is.
  [[nodiscard]] Expected<void> keep(const std::function<std::string()>& state);
  /// Writes the state that was kept last; by a temporary file that takes the place of the one before.
  [[nodiscard]] Expected<void> write();

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::string path_;
  std::chrono::duration<double> between_;
  Checkpoint now_;       // without the text of the trace
  TracePlace trace_at_;  // when the state was kept
  std::function<TracePlace()> trace_place_;
  std::function<Expected<std::string>()> trace_text_;
  std::optional<Clock::time_point> written_;  // when the file was, last
  Clock::time_point next_;                    // when the next state may be kept
};

}  // namespace temper::io
