// How VTU packs an array: base64 of a header and blocks, each block compressed by zlib or not.
//
//   uncompressed  [bytes] data
//   zlib          [blocks, bytes of a block, bytes of the last block (0: whole), compressed bytes of each] data
//
// Header words are UInt32 or UInt64 (attribute header_type). In base64 a compressed array is two pieces, each
// padded on its own; a decoder that goes on past padding reads both forms.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/output.hpp"
#include "io/values.hpp"

namespace temper::io {

/// Decodes in place or elsewhere (out may be in.data()). Returns the bytes written; nothing when a character is not
/// base64's.
[[nodiscard]] std::optional<std::size_t> decode_base64(std::string_view in, char* out);
/// Encodes with padding.
void encode_base64(Output& out, std::string_view bytes);

struct Packing {
  std::string where;         ///< for errors: file and array
  std::size_t header_bytes;  ///< 4 or 8
  bool compressed;
  bool swap;  ///< byte order is not this machine's
};
/// The numbers of one packed array.
[[nodiscard]] Values unpack(std::string_view packed, Scalar scalar, const Packing& packing);

/// One block of numbers, compressed.
[[nodiscard]] std::string compress_block(std::string_view bytes, int level);

}  // namespace temper::io
