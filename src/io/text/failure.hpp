// Inside io an error is an exception that carries the InputError. The only entry points of the library, read and write,
// turn it into a value.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
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

/// The message in parts, as for text().
template <class... Parts>
[[noreturn]] void fail(ErrorCode code, std::string where, const Parts&... message) {
  throw Failure{InputError{code, std::move(where), text(message...)}};
}

/// Runs work; an exception in it comes back as a value.
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

// Limits of the memory that a file may take. The size of the file limits text and plain bytes. Packed, repeated and
// left out numbers have no such limit: a few bytes could ask for all the memory there is.

class AllocationLimits {
 public:
  AllocationLimits() : AllocationLimits(0) {}
  explicit AllocationLimits(std::uint64_t file_bytes)
      : all_(kNumbersAByte * std::max(file_bytes, kLeastBytes)), left_(all_) {}

  /// Refuses rows × columns numbers when the limit has less left. `where`: the file, or the array in it.
  void check(std::uint64_t rows, std::uint64_t columns, const std::string& where) const {
    if (columns == 0 || rows <= left_ / columns) return;
    fail(ErrorCode::unsupported, where, "becomes more than ", all_, " numbers with these ", rows,
         columns == 1 ? std::string() : text(" times ", columns),
         ", all that temper unpacks from a file of this size; write it without compression, or with fewer arrays");
  }
  /// Subtracts them from the limit.
  void take(std::uint64_t rows, std::uint64_t columns, const std::string& where) {
    check(rows, columns, where);
    left_ -= rows * columns;
  }

 private:
  // Meshes need less: a point compressed to two bytes has 3 coordinates and 12 numbers of triangles. Twenty arrays of
  // data are more than files have.
  static constexpr std::uint64_t kNumbersAByte = 16;
  static constexpr std::uint64_t kLeastBytes = 1 << 20;  // small files of constant data may be packed better
  std::uint64_t all_, left_;
};

}  // namespace temper::io
