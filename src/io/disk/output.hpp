// Files written whole or not at all: everything goes to temporary files beside their targets, and only when all
// of them are complete are they renamed. What is no regular file (a pipe, /dev/stdout) is written directly.
#pragma once

#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/disk/temporary.hpp"
#include "io/text/failure.hpp"

namespace temper::io {

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

/// The files of one write: renamed when all are whole, one after the other, so that an error or a kill just then leaves
/// new ones beside old ones.
class OutputSet {
 public:
  Output& open(const std::string& path);
  void commit();

 private:
  std::vector<std::unique_ptr<Output>> outputs_;
};

}  // namespace temper::io
