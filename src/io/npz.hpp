// NumPy's .npz: a zip archive of .npy arrays (format 1.0: numpy.lib.format), none of them pickled.
#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/zip_writer.hpp"

namespace temper::io {

class NpzWriter {
 public:
  explicit NpzWriter(Output& out) : zip_(out) {}
  /// An array, rows first; `shape` has the product of its numbers many values.
  template <class T>
  void add(std::string_view name, const std::vector<T>& values, const std::vector<std::size_t>& shape) {
    static_assert(std::is_arithmetic_v<T>);
    constexpr char kKind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
    add_bytes(name, kKind, sizeof(T), {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)}, shape);
  }
  template <class T>
  void add(std::string_view name, const std::vector<T>& values) {
    add(name, values, {values.size()});
  }
  /// Text, as an array of no dimension.
  void add_text(std::string_view name, std::string_view text) { add_bytes(name, 'S', text.size(), text, {}); }
  void finish() { zip_.finish(); }

 private:
  void add_bytes(std::string_view name, char kind, std::size_t bytes_each, std::string_view bytes,
                 const std::vector<std::size_t>& shape);
  ZipWriter zip_;
};

}  // namespace temper::io
