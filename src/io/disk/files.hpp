// What the disk has at a path. (By POSIX: libc++ for WebAssembly has no std::filesystem.)
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/text/failure.hpp"
#include "temper/detail/executor.hpp"

namespace temper::io {

struct OnDisk {
  enum class Kind { nothing, file, folder, other };  ///< links followed; other: a pipe, a device
  Kind kind = Kind::nothing;
  std::uint64_t bytes = 0;  ///< of a file

  [[nodiscard]] bool exists() const { return kind != Kind::nothing; }
};

/// What cannot be looked at is nothing: whoever opens it hears why.
[[nodiscard]] OnDisk look_at(const std::string& path);

[[nodiscard]] inline bool exists(const std::string& path) { return look_at(path).exists(); }

/// Nothing can be put beside it: a pipe, a device, and standard output, even where it goes to a file.
[[nodiscard]] bool is_stream(const std::string& path);

/// A whole file in memory.
struct Source {
  std::string path;   ///< as the user gave it
  std::string bytes;  ///< readers may overwrite it while they decode
  Executor* executor = nullptr;
  Allowance allowance = {};
};

/// Reads a file, or says why not: missing, a directory, empty.
[[nodiscard]] Source load(const std::string& path);
/// At most n bytes that a file begins with; none where it cannot be read.
[[nodiscard]] std::string first_bytes(const std::string& path, std::size_t n);
/// PATH without its last suffix, when that is `suffix`; else PATH.
[[nodiscard]] std::string without_suffix(const std::string& path, std::string_view suffix);

/// Lets the system have the memory that was freed between what is in use, where the C library keeps it: what reading a
/// large file has left would count on top of all that comes after.
void give_memory_back();

}  // namespace temper::io
