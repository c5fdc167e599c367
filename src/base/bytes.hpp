// Plain values as bytes and back, for messages among ranks. Numbers are as they are in memory: all ranks run the same
// build on the same kind of machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace temper {

class ByteWriter {
 public:
  /// Appends to `out`.
  explicit ByteWriter(std::string& out) : out_(out) {}

  template <class T>
  void write(const T& value) {
    write_array(&value, 1);
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(std::uint64_t{values.size()});
    write_array(values.data(), values.size());
  }

 private:
  template <class T>
  void write_array(const T* values, std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    out_.append(reinterpret_cast<const char*>(values), n * sizeof(T));
  }

  std::string& out_;
};

/// Reads in the order of writing. When too few bytes are left it fails, and leaves the value as it was.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void read(T& value) {
    if (has<T>(1)) take(&value, 1);
  }
  template <class T>
  void read(std::vector<T>& values) {
    std::uint64_t n = 0;
    read(n);
    if (!has<T>(n)) return;
    values.resize(static_cast<std::size_t>(n));
    take(values.data(), values.size());
  }
  /// Says whether all bytes have been read, and none was missing.
  [[nodiscard]] bool at_end() const { return !failed_ && bytes_.empty(); }

 private:
  template <class T>
  bool has(std::uint64_t n) {
    failed_ = failed_ || n > bytes_.size() / sizeof(T);
    return !failed_;
  }
  template <class T>
  void take(T* values, std::size_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (n > 0) std::memcpy(values, bytes_.data(), n * sizeof(T));
    bytes_.remove_prefix(n * sizeof(T));
  }

  std::string_view bytes_;
  bool failed_ = false;
};

}  // namespace temper
