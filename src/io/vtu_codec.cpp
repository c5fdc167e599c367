// See vtu_codec.hpp.
#include "io/vtu_codec.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace temper::io {

namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kPad = 64, kBlank = 65, kBad = 66;

constexpr std::array<std::uint8_t, 256> decode_table() {
  std::array<std::uint8_t, 256> table{};
  table.fill(kBad);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    table[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
  for (const unsigned char c : {' ', '\n', '\r', '\t'}) table[c] = kBlank;
  table['='] = kPad;
  return table;
}
constexpr std::array<std::uint8_t, 256> kDecode = decode_table();

/// Six bits a character, from one to three bytes a group; a group ends at padding, too.
class Base64Decoder {
 public:
  explicit Base64Decoder(char* out) : begin_(out), at_(out) {}
  [[nodiscard]] bool take(std::uint8_t code) {
    if (code == kBlank) return true;
    if (code == kBad) return false;
    if (code == kPad) {
      flush();
      return true;
    }
    bits_ = bits_ << 6 | code;
    if (++count_ == 4) flush();
    return true;
  }
  std::size_t finish() {
    flush();
    return static_cast<std::size_t>(at_ - begin_);
  }

 private:
  void flush() {
    const int bytes = count_ == 4 ? 3 : count_ == 3 ? 2 : count_ == 2 ? 1 : 0;
    const std::uint32_t aligned = count_ == 0 ? 0 : bits_ << (6 * (4 - count_));
    for (int k = 0; k < bytes; ++k) *at_++ = static_cast<char>(aligned >> (16 - 8 * k) & 0xff);
    bits_ = 0;
    count_ = 0;
  }
  char* begin_;
  char* at_;
  std::uint32_t bits_ = 0;
  int count_ = 0;
};

}  // namespace

std::optional<std::size_t> decode_base64(std::string_view in, char* out) {
  const auto* at = reinterpret_cast<const unsigned char*>(in.data());
  const auto* end = at + in.size();
  char* fast = out;
  // Whole groups of four without blanks or padding; the decoder does the rest. Writing never overtakes reading.
  for (; end - at >= 4; at += 4) {
    const std::uint8_t a = kDecode[at[0]], b = kDecode[at[1]], c = kDecode[at[2]], d = kDecode[at[3]];
    if ((a | b | c | d) >= kPad) {
      // Padding ends a group of its own; a group that straddles blanks, or is none, is left to the decoder.
      const bool padded = a < kPad && b < kPad && c <= kPad && d == kPad;
      if (!padded) break;
      Base64Decoder group(fast);
      for (const std::uint8_t code : {a, b, c, d}) static_cast<void>(group.take(code));
      fast += group.finish();
      continue;
    }
    const std::uint32_t bits = static_cast<std::uint32_t>(a << 18 | b << 12 | c << 6 | d);
    fast[0] = static_cast<char>(bits >> 16 & 0xff);
    fast[1] = static_cast<char>(bits >> 8 & 0xff);
    fast[2] = static_cast<char>(bits & 0xff);
    fast += 3;
  }
  Base64Decoder decoder(fast);
  for (; at != end; ++at) {
    if (!decoder.take(kDecode[*at])) return std::nullopt;
  }
  return static_cast<std::size_t>(fast - out) + decoder.finish();
}

void encode_base64(Output& out, std::string_view bytes) {
  const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
  std::array<char, 4096> text_block;
  std::size_t used = 0;
  std::size_t left = bytes.size();
  while (left > 0) {
    const std::size_t n = std::min<std::size_t>(left, 3);
    const std::uint32_t bits = static_cast<std::uint32_t>(at[0] << 16 | (n > 1 ? at[1] << 8 : 0) | (n > 2 ? at[2] : 0));
    text_block[used] = kAlphabet[bits >> 18];
    text_block[used + 1] = kAlphabet[bits >> 12 & 63];
    text_block[used + 2] = n > 1 ? kAlphabet[bits >> 6 & 63] : '=';
    text_block[used + 3] = n > 2 ? kAlphabet[bits & 63] : '=';
    used += 4;
    at += n;
    left -= n;
    if (used == text_block.size() || left == 0) {
      out.put(std::string_view(text_block.data(), used));
      used = 0;
    }
  }
}

namespace {

/// Header words from the front of a packed array.
class Header {
 public:
  Header(std::string_view packed, const Packing& packing) : packed_(packed), packing_(packing) {}
  std::uint64_t word() {
    if (packed_.size() < packing_.header_bytes)
      fail(ErrorCode::truncated, packing_.where, "the data end within their header");
    std::array<char, 8> bytes{};
    std::copy_n(packed_.data(), packing_.header_bytes, bytes.data());
    if (packing_.swap) std::reverse(bytes.data(), bytes.data() + packing_.header_bytes);
    packed_.remove_prefix(packing_.header_bytes);
    if (packing_.header_bytes == 4) {
      std::uint32_t value;
      std::memcpy(&value, bytes.data(), 4);
      return value;
    }
    std::uint64_t value;
    std::memcpy(&value, bytes.data(), 8);
    return value;
  }
  [[nodiscard]] std::string_view rest() const { return packed_; }

 private:
  std::string_view packed_;
  const Packing& packing_;
};

template <class T>
void swap_bytes(std::vector<T>& values) {
  for (T& value : values) {
    auto* bytes = reinterpret_cast<char*>(&value);
    std::reverse(bytes, bytes + sizeof(T));
  }
}

struct Blocks {
  std::vector<std::uint64_t> compressed;  // bytes of each
  std::uint64_t block = 0, last = 0;      // bytes of a whole one and of the last one, unpacked
  std::uint64_t total = 0;
  std::string_view data;
};

Blocks read_blocks(std::string_view packed, const Packing& packing) {
  Header header(packed, packing);
  const std::uint64_t n = header.word();
  if (n > packed.size() / packing.header_bytes) {
    fail(ErrorCode::truncated, packing.where,
         text("announces ", n, " compressed blocks, but has only ", packed.size(), " bytes"));
  }
  Blocks blocks;
  if (n == 0) return blocks;
  blocks.block = header.word();
  blocks.last = header.word();
  if (blocks.last == 0) blocks.last = blocks.block;
  std::uint64_t sum = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    blocks.compressed.push_back(header.word());
    if (blocks.compressed.back() > packed.size()) sum = packed.size();
    sum += std::min<std::uint64_t>(blocks.compressed.back(), packed.size());
  }
  blocks.data = header.rest();
  if (sum > blocks.data.size()) {
    fail(ErrorCode::truncated, packing.where,
         text("compressed blocks of ", sum, " bytes, but only ", blocks.data.size(), " follow"));
  }
  // zlib packs at most 1032 bytes into one: whoever announces more would make us allocate for nothing.
  constexpr std::uint64_t kBestRatio = 1032;
  const std::uint64_t most = (sum + 64 * n) * kBestRatio;
  const std::uint64_t whole = n > 1 ? blocks.block : 0;
  if (whole > most || blocks.last > most || (n - 1) * whole > most) {
    fail(ErrorCode::syntax, packing.where,
         text("announces ", n, " blocks of ", blocks.block, " bytes, more than zlib can pack into ", sum));
  }
  blocks.total = (n - 1) * blocks.block + blocks.last;
  return blocks;
}

void inflate_blocks(const Blocks& blocks, char* out, const Packing& packing) {
  const auto* data = reinterpret_cast<const Bytef*>(blocks.data.data());
  auto* to = reinterpret_cast<Bytef*>(out);
  for (std::size_t i = 0; i < blocks.compressed.size(); ++i) {
    const uLongf expected = i + 1 < blocks.compressed.size() ? blocks.block : blocks.last;
    uLongf got = expected;
    const int status = uncompress(to, &got, data, blocks.compressed[i]);
    if (status != Z_OK || got != expected) {
      fail(ErrorCode::syntax, packing.where, text("block ", i, " of the compressed data is damaged"));
    }
    data += blocks.compressed[i];
    to += expected;
  }
}

void check_whole(std::uint64_t bytes, std::size_t each, const Packing& packing) {
  if (bytes % each == 0) return;
  fail(ErrorCode::syntax, packing.where, text("has ", bytes, " bytes, which is not a multiple of ", each));
}

}  // namespace

Values unpack(std::string_view packed, Scalar scalar, const Packing& packing) {
  return with_scalar(scalar, [&](auto zero) -> Values {
    using T = decltype(zero);
    std::vector<T> values;
    if (packing.compressed) {
      const Blocks blocks = read_blocks(packed, packing);
      check_whole(blocks.total, sizeof(T), packing);
      values.resize(blocks.total / sizeof(T));
      inflate_blocks(blocks, reinterpret_cast<char*>(values.data()), packing);
    } else {
      Header header(packed, packing);
      const std::uint64_t bytes = header.word();
      if (bytes > header.rest().size()) {
        fail(ErrorCode::truncated, packing.where,
             text("announces ", bytes, " bytes, but only ", header.rest().size(), " follow"));
      }
      check_whole(bytes, sizeof(T), packing);
      values.resize(bytes / sizeof(T));
      if (bytes > 0) std::memcpy(values.data(), header.rest().data(), bytes);
    }
    if (packing.swap) swap_bytes(values);
    return values;
  });
}

std::string compress_block(std::string_view bytes, int level) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  // The only errors are a bad level and too small a buffer.
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
            level);
  packed.resize(size);
  return packed;
}

}  // namespace temper::io
