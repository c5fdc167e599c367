// What a file may become in memory. Text and plain bytes are bound by the size of the file; packed, repeated and left
// out numbers are not, and a few bytes could ask for all the memory there is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "io/text/failure.hpp"

namespace temper::io {

class Allowance {
 public:
  Allowance() : Allowance(0) {}
  explicit Allowance(std::uint64_t file_bytes) : all_(kNumbersAByte * std::max(file_bytes, kLeastBytes)), left_(all_) {}

  /// Refuses rows × columns numbers when they are more than are left. `where`: the file, or the array in it.
  void check(std::uint64_t rows, std::uint64_t columns, const std::string& where) const {
    if (columns == 0 || rows <= left_ / columns) return;
    fail(
        ErrorCode::unsupported, where,
        text("becomes more than ", all_, " numbers with these ", rows,
             columns == 1 ? std::string() : text(" times ", columns),
             ", all that temper unpacks from a file of this size; write it without compression, or with fewer arrays"));
  }
  /// Takes them from what is left.
  void take(std::uint64_t rows, std::uint64_t columns, const std::string& where) {
    check(rows, columns, where);
    left_ -= rows * columns;
  }

 private:
  // What meshes need is below: a point compressed to two bytes has 3 coordinates and 12 numbers of triangles, and
  // twenty arrays of data are more than files have.
  static constexpr std::uint64_t kNumbersAByte = 16;
  static constexpr std::uint64_t kLeastBytes = 1 << 20;  // small files of constant data may be packed better
  std::uint64_t all_, left_;
};

}  // namespace temper::io
