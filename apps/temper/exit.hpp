// The end of the program: its exit codes, and the exception that carries one to main. (Signals: system/system.hpp.)
//
// The library returns bad input as values. The program can only report it and stop: or_fail turns it into a Failure.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
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

/// A sentence for people, about the exit of a verb. Without a verb it is about the whole program.
[[nodiscard]] std::string_view meaning(Exit exit, std::string_view verb);

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

/// The error, with the file as its place if it has none.
[[nodiscard]] inline InputError located(InputError error, const std::string& path) {
  if (error.where.empty()) error.where = path;
  return error;
}

/// The value, or a Failure with the reason why there is none.
template <class T>
T or_fail(Expected<T> expected) {
  if (!expected) throw as_failure(expected.error());
  return *std::move(expected);
}
inline void or_fail(const Expected<void>& expected) {
  if (!expected) throw as_failure(expected.error());
}

}  // namespace temper::app
