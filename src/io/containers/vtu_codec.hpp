// The packing of an array in VTU: base64 of a header and blocks, each block compressed by zlib or not.
//
//   uncompressed  [bytes] data
//   zlib          [blocks, bytes of a block, bytes of the last block (0: whole), compressed bytes of each] data
//
// Header words are UInt32 or UInt64 (attribute header_type). In base64 a compressed array is two pieces, each
// padded on its own; a decoder that goes on past padding reads both forms.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/disk/files.hpp"
#include "io/text/failure.hpp"
#include "io/text/values.hpp"
#include "temper/detail/executor.hpp"

namespace temper::io {

/// Decodes in place (`out` is in.data()) or elsewhere. Returns the bytes written; nothing when a character is not
/// base64's.
[[nodiscard]] std::optional<std::size_t> decode_base64(std::string_view in, char* out);
/// Base64 of some bytes, padded.
[[nodiscard]] std::string base64(std::string_view bytes);
/// Base64 of bytes that come piece by piece.
class Base64Encoder {
 public:
  explicit Base64Encoder(Output& out) : out_(out) {}
  void put(std::string_view bytes);
  /// The last call: padding.
  void finish();

 private:
  void put_group(const unsigned char* three);

  Output& out_;
  std::array<unsigned char, 3> left_{};  // over from the piece before
  std::size_t n_left_ = 0;
};

struct Packing {
  std::string where;         ///< for errors: file and array
  std::size_t header_bytes;  ///< 4 or 8
  bool compressed;
  bool swap;  ///< byte order is not this machine's
};
/// The numbers of one packed array; blocks are inflated on the executor's threads when there is one.
[[nodiscard]] Values unpack(std::string_view packed, Scalar scalar, const Packing& packing,
                            AllocationLimits& allocation, Executor* executor);

/// The repetitions that zlib looks for: any earlier string, or only runs of one byte. Runs are far faster, and lose
/// little on the digits of measured coordinates.
enum class Redundancy { strings, runs };
/// One block of numbers, compressed fast rather than small.
[[nodiscard]] std::string compress_block(std::string_view bytes, Redundancy redundancy);
/// Returns runs, when they make a sample hardly larger.
[[nodiscard]] Redundancy choose_redundancy(std::string_view bytes);

}  // namespace temper::io
