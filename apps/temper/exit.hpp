// How the program ends: its exit codes, the exception that carries one to main, and signals.
//
// The library returns bad input as values; the program, which has nothing to do but report it and stop,
// turns them into a Failure with or_fail.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "temper/detail/error.hpp"

namespace temper::app {

enum class Exit : int {
  done = 0,
  bad_input = 1,      ///< an input that cannot be used, or an output that cannot be written
  bad_usage = 2,      ///< options that make no sense
  requirement = 3,    ///< check --require, reproduce --require-claims: not met
  stopped_early = 4,  ///< a signal or --time-limit; the best mesh so far is written. Or edges that may flip lack flips
  internal = 5,       ///< a defect of temper
  infeasible = 6,     ///< weights: none do what was asked
};

class Failure : public std::runtime_error {
 public:
  Failure(Exit code, const std::string& message) : std::runtime_error(message), exit(code) {}
  Exit exit;
};

/// Ends a verb whose options make no sense.
[[noreturn]] inline void refuse_usage(const std::string& verb, const std::string& message) {
  throw Failure(Exit::bad_usage, verb + ": " + message + "\nSee temper " + verb + " --help");
}

inline Failure as_failure(const InputError& error) {
  const Exit exit = error.code == ErrorCode::invalid_option ? Exit::bad_usage
                    : error.code == ErrorCode::stopped      ? Exit::stopped_early
                                                            : Exit::bad_input;
  return {exit, error.what()};
}

/// The value, or a Failure that says why there is none.
template <class T>
T or_fail(Expected<T> expected) {
  if (!expected) throw as_failure(expected.error());
  return *std::move(expected);
}
inline void or_fail(const Expected<void>& expected) {
  if (!expected) throw as_failure(expected.error());
}

// Ctrl-C and its like: SIGINT, SIGTERM and SIGHUP end the program at once, whatever it does, and leave every file as it
// was or whole. A verb that has something to show for its time notes the first one instead, and stops.

/// From here on a signal ends the program: what is being written is removed, a line says so, and whoever waits for the
/// program sees the signal. (A signal that is ignored, as by nohup, stays so.)
void end_on_signals();
/// From here on the first SIGINT, SIGTERM or SIGUSR1, which mpirun hands on and job schedulers send when time is nearly
/// up, is only noted; the second one ends the program.
void catch_interrupts();
/// One has been noted.
[[nodiscard]] bool interrupted();

}  // namespace temper::app
