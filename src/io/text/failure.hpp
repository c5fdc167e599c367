// Inside io an error is an exception that carries the InputError; read and write, the only doors of the
// library, turn it into a value.
#pragma once

#include <charconv>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "temper/detail/error.hpp"

namespace temper::io {

struct Failure {
  InputError error;
};

[[noreturn]] inline void fail(ErrorCode code, std::string where, std::string message) {
  throw Failure{InputError{code, std::move(where), std::move(message)}};
}

/// The shortest text that reads back to the same number.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] std::string to_text(T value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}
[[nodiscard]] inline std::string to_text(std::string_view value) { return std::string(value); }

/// The parts of a message, one after the other: text("triangle ", 12, " uses …").
template <class... Parts>
[[nodiscard]] std::string text(const Parts&... parts) {
  std::string joined;
  (joined.append(to_text(parts)), ...);
  return joined;
}

/// Runs work; whatever stops it comes back as a value.
template <class Result, class Work>
Expected<Result> guarded(const std::string& path, Work work) {
  try {
    if constexpr (std::is_void_v<Result>) {
      work();
      return {};
    } else {
      return work();
    }
  } catch (Failure& failure) {
    return std::move(failure.error);
  } catch (const std::bad_alloc&) {
    return InputError{ErrorCode::unsupported, path, "needs more memory than there is"};
  }
}

}  // namespace temper::io
