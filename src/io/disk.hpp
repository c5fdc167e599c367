// What the disk has at a path. (By POSIX: libc++ for WebAssembly has no std::filesystem.)
#pragma once

#include <cstdint>
#include <string>

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

}  // namespace temper::io
