// The state of the disk at a path, and files written whole or not at all. (By POSIX: libc++ for WebAssembly has no
// std::filesystem.)
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/failure.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/vec.hpp"

namespace temper::io {

struct OnDisk {
  enum class Kind { nothing, file, folder, other };  ///< links followed; other: a pipe, a device
  Kind kind = Kind::nothing;
  std::uint64_t bytes = 0;  ///< of a file

  [[nodiscard]] bool exists() const { return kind != Kind::nothing; }
};

/// A path that cannot be examined counts as nothing: opening it gives the reason.
[[nodiscard]] OnDisk look_at(const std::string& path);

[[nodiscard]] inline bool exists(const std::string& path) { return look_at(path).exists(); }

/// Says whether no file can be put next to it: a pipe, a device, and standard output, even if it goes to a file.
[[nodiscard]] bool is_stream(const std::string& path);

/// A whole file in memory.
struct Source {
  std::string path;   ///< as the user gave it
  std::string bytes;  ///< readers may overwrite it while they decode
  Executor* executor = nullptr;
  AllocationLimits allocation = {};
  std::optional<std::array<Vec2, 2>> window = {};  ///< as in ReadOptions
  bool raster_in_degrees = false;
};

/// Reads a file, or fails with the reason: missing, a directory, empty.
[[nodiscard]] Source load(const std::string& path);
/// At most the first n bytes of a file; none if it cannot be read.
[[nodiscard]] std::string first_bytes(const std::string& path, std::size_t n);
/// PATH without its last suffix, when that is `suffix`; else PATH.
[[nodiscard]] std::string without_suffix(const std::string& path, std::string_view suffix);

/// Returns freed memory to the system if the C library keeps it between blocks in use. Otherwise the memory for reading
/// a large file would add to all later memory.
void give_memory_back();
/// Empties these vectors, and returns their memory.
template <class... Vectors>
void give_memory_back_of(Vectors&... vectors) {
  (Vectors().swap(vectors), ...);  // assigning {} would keep the capacity
  give_memory_back();
}

// Files written whole or not at all. Everything goes to temporary files next to their targets, which are renamed only
// when all are complete. A target that is no regular file (a pipe, /dev/stdout) is written directly.

// Temporary files next to their targets, and their fate when a run does not end well.
//
//   OUT.tmp0   new bytes, locked by the run that writes them; renamed to OUT when they are whole
//
// A run that fails removes its own, and so does a signal that ends the program (io::discard_unfinished). A run that is
// killed leaves them, without harm: the lock ended with its owner. So the next run that writes OUT removes OUT.tmp0 and
// makes its own.

class Temporary {
 public:
  Temporary() = default;
  /// Makes an empty file next to `target`, for this run alone. On failure there is none, and errno has the reason.
  static Temporary beside(const std::string& target);
  Temporary(Temporary&& other) noexcept { *this = std::move(other); }
  Temporary& operator=(Temporary&& other) noexcept;
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() { remove(); }

  [[nodiscard]] bool exists() const { return !path_.empty(); }
  [[nodiscard]] const std::string& path() const { return path_; }
  /// The file, open for writing, to be closed by the caller; −1: errno has the reason. (The lock stays here.)
  [[nodiscard]] int open() const;
  /// Gives it the permissions of the target, as far as it may have them.
  void take_permissions(const std::string& target) const;
  /// Puts it in the place of `target`. False: errno has the reason, and nothing has changed.
  bool rename_to(const std::string& target);
  void remove();

 private:
  Temporary(std::string path, std::size_t entry, int lock);
  void end();

  std::string path_;
  std::size_t entry_ = 0;  // of the list that discard_unfinished() goes through
  int lock_ = -1;          // the open file that has it
};

/// The path of the file itself, if links lead to it.
[[nodiscard]] std::string without_links(const std::string& path);

class Output {
 public:
  explicit Output(std::string path);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void put(char c) {
    if (used_ == buffer_.size()) flush();
    buffer_[used_++] = c;
  }
  /// As the user gave it.
  [[nodiscard]] const std::string& path() const { return path_; }

  void put(std::string_view bytes);
  /// Shortest text that reads back to the same bits.
  template <class T>
  requires std::is_arithmetic_v<T> &&(!std::is_same_v<T, char>)void put(T value) {
    constexpr std::size_t kLongest = 32;
    if (buffer_.size() - used_ < kLongest) flush();
    char* start = buffer_.data() + used_;
    used_ += static_cast<std::size_t>(std::to_chars(start, start + kLongest, value).ptr - start);
  }
  template <class First, class Second, class... More>
  void put(First&& first, Second&& second, More&&... more) {
    put(first);
    put(second);
    (put(more), ...);
  }
  /// The bytes of a number, as they are in memory.
  template <class T>
  void put_raw(const T& value) {
    put(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
  }

 private:
  friend class OutputSet;
  void flush();
  void close();   // all bytes are in the temporary file and on the disk, or Failure
  void commit();  // the temporary takes the place of the target
  [[noreturn]] void fail_writing(const char* doing) const;

  std::string path_;
  std::string target_;   // what it stands for, links resolved
  Temporary temporary_;  // none: written directly
  int file_ = -1;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

/// The files of one write. They are renamed when all are whole, one after the other: an error or a kill just then
/// leaves new files next to old ones.
class OutputSet {
 public:
  Output& open(const std::string& path);
  void commit();

 private:
  std::vector<std::unique_ptr<Output>> outputs_;
};

}  // namespace temper::io
