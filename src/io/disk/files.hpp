// Files read whole, and written whole or not at all.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/system/system.hpp"
#include "io/text/failure.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/vec.hpp"

namespace temper::io {

[[nodiscard]] inline bool exists(const std::string& path) { return look_at(path).exists(); }

/// A whole file in memory.
struct Source {
  std::string path;   ///< as the user gave it
  std::string bytes;  ///< readers may overwrite it while they decode
  Executor* executor = nullptr;
  AllocationLimits allocation = {};
  std::optional<std::array<Vec2, 2>> window = {};  ///< as in ReadOptions
  bool raster_in_degrees = false;
};

/// Fails if a file that begins this way cannot be read. `bytes`: of the whole file, or of the beginning of a stream.
using LookAtBeginning = std::function<void(std::string_view beginning, std::uint64_t bytes)>;
/// Reads a file, or fails with the reason: missing, a directory, empty, an endless stream. `look` sees the first bytes
/// before all others are read: a device such as /dev/zero never ends, and a sparse file may be larger than the memory.
[[nodiscard]] Source load(const std::string& path, const LookAtBeginning& look = {});
/// At most the first n bytes of a file; none if it cannot be read.
[[nodiscard]] std::string first_bytes(const std::string& path, std::size_t n);
/// PATH without its last suffix, when that is `suffix`; else PATH.
[[nodiscard]] std::string without_suffix(const std::string& path, std::string_view suffix);

/// Empties these vectors, and returns their memory.
template <class... Vectors>
void give_memory_back_of(Vectors&... vectors) {
  (Vectors().swap(vectors), ...);  // assigning {} would keep the capacity
  give_memory_back();
}

// Files written whole or not at all. Everything goes to temporary files next to their targets, which are renamed only
// when all are complete. A stream (a pipe, a device, /dev/stdout) is written directly, and never replaced.

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
