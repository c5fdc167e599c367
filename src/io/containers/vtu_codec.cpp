#include "io/containers/vtu_codec.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <vector>

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

/// Six bits per character, one to three bytes per group. Padding ends a group, too.
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

namespace {

/// Two characters of base64 for each twelve bits.
constexpr auto kPairs = [] {
  std::array<std::array<char, 2>, 4096> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {kAlphabet[i >> 6], kAlphabet[i & 63]};
  return pairs;
}();

void encode_group(const unsigned char* three, char* to) {
  const std::uint32_t bits = static_cast<std::uint32_t>(three[0] << 16 | three[1] << 8 | three[2]);
  std::memcpy(to, kPairs[bits >> 12].data(), 2);
  std::memcpy(to + 2, kPairs[bits & 4095].data(), 2);
}

}  // namespace

std::string base64(std::string_view bytes) {
  const std::size_t whole = bytes.size() / 3 * 3;
  std::string encoded((bytes.size() + 2) / 3 * 4, '=');
  const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
  for (std::size_t i = 0; i < whole; i += 3) encode_group(at + i, encoded.data() + i / 3 * 4);
  if (whole == bytes.size()) return encoded;
  std::array<unsigned char, 3> rest{};
  std::copy(at + whole, at + bytes.size(), rest.begin());
  std::array<char, 4> group;
  encode_group(rest.data(), group.data());
  std::copy_n(group.begin(), bytes.size() - whole + 1, encoded.end() - 4);
  return encoded;
}

void Base64Encoder::put(std::string_view bytes) {
  const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
  std::size_t left = bytes.size();
  while (n_left_ > 0 && left > 0) {
    left_[n_left_++] = *at++;
    --left;
    if (n_left_ < 3) continue;
    put_group(left_.data());
    n_left_ = 0;
  }
  constexpr std::size_t kGroups = 1024;
  std::array<char, 4 * kGroups> text_block;
  while (left >= 3) {
    const std::size_t groups = std::min(left / 3, kGroups);
    for (std::size_t i = 0; i < groups; ++i) encode_group(at + 3 * i, text_block.data() + 4 * i);
    out_.put(std::string_view(text_block.data(), 4 * groups));
    at += 3 * groups;
    left -= 3 * groups;
  }
  while (left-- > 0) left_[n_left_++] = *at++;
}

void Base64Encoder::put_group(const unsigned char* three) {
  std::array<char, 4> text_group;
  encode_group(three, text_group.data());
  out_.put(std::string_view(text_group.data(), text_group.size()));
}

void Base64Encoder::finish() {
  out_.put(base64(std::string_view(reinterpret_cast<const char*>(left_.data()), n_left_)));
  n_left_ = 0;
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
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data(), 4);
      return value;
    }
    std::uint64_t value = 0;
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
    fail(ErrorCode::truncated, packing.where, "announces ", n, " compressed blocks, but has only ", packed.size(),
         " bytes");
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
    fail(ErrorCode::truncated, packing.where, "compressed blocks of ", sum, " bytes, but only ", blocks.data.size(),
         " follow");
  }
  // zlib packs at most 1032 bytes into one. A file that announces more would make us allocate for nothing.
  constexpr std::uint64_t kBestRatio = 1032;
  // Divided, not multiplied: a product of numbers from a file may wrap around. `most` is computed from the size of the
  // file.
  const std::uint64_t most = (sum + 64 * n) * kBestRatio;
  if (blocks.last > most || (n > 1 && blocks.block > most / (n - 1))) {
    fail(ErrorCode::syntax, packing.where, "announces ", n, " blocks of ", blocks.block,
         " bytes, more than zlib can pack into ", sum);
  }
  blocks.total = (n - 1) * blocks.block + blocks.last;
  return blocks;
}

bool inflate_block(const Blocks& blocks, std::size_t i, std::size_t start, char* out) {
  const auto expected = static_cast<uLongf>(i + 1 < blocks.compressed.size() ? blocks.block : blocks.last);
  uLongf got = expected;
  const auto* data = reinterpret_cast<const Bytef*>(blocks.data.data()) + start;
  auto* to = reinterpret_cast<Bytef*>(out) + i * blocks.block;
  return uncompress(to, &got, data, static_cast<uLong>(blocks.compressed[i])) == Z_OK && got == expected;
}

/// No block throws on a thread of the executor's: the first damaged one is named afterwards.
void inflate_blocks(const Blocks& blocks, char* out, const Packing& packing, Executor* executor) {
  const std::size_t n = blocks.compressed.size();
  std::vector<std::size_t> starts(n, 0);
  for (std::size_t i = 1; i < n; ++i) starts[i] = starts[i - 1] + static_cast<std::size_t>(blocks.compressed[i - 1]);
  std::vector<char> damaged(n, 0);
  or_serial(executor).run(n, [&](std::size_t i) { damaged[i] = inflate_block(blocks, i, starts[i], out) ? 0 : 1; });
  for (std::size_t i = 0; i < n; ++i) {
    if (damaged[i] != 0) {
      fail(ErrorCode::syntax, packing.where, "block ", i, " of the compressed data is damaged");
    }
  }
}

void check_whole(std::uint64_t bytes, std::size_t each, const Packing& packing) {
  if (bytes % each == 0) return;
  fail(ErrorCode::syntax, packing.where, "has ", bytes, " bytes, which is not a multiple of ", each);
}

/// On a system of 32 bits a file may announce more than can be counted.
template <class T>
void resize(std::vector<T>& values, std::uint64_t n) {
  if (n > values.max_size()) throw std::bad_alloc();
  values.resize(static_cast<std::size_t>(n));
}

}  // namespace

Values unpack(std::string_view packed, Scalar scalar, const Packing& packing, AllocationLimits& allocation,
              Executor* executor) {
  return with_scalar(scalar, [&](auto zero) -> Values {
    using T = decltype(zero);
    std::vector<T> values;
    if (packing.compressed) {
      const Blocks blocks = read_blocks(packed, packing);
      check_whole(blocks.total, sizeof(T), packing);
      allocation.take(blocks.total / sizeof(T), 1, packing.where);
      resize(values, blocks.total / sizeof(T));
      inflate_blocks(blocks, reinterpret_cast<char*>(values.data()), packing, executor);
    } else {
      Header header(packed, packing);
      const std::uint64_t bytes = header.word();
      if (bytes > header.rest().size()) {
        fail(ErrorCode::truncated, packing.where, "announces ", bytes, " bytes, but only ", header.rest().size(),
             " follow");
      }
      check_whole(bytes, sizeof(T), packing);
      allocation.take(bytes / sizeof(T), 1, packing.where);
      resize(values, bytes / sizeof(T));
      if (bytes > 0) std::memcpy(values.data(), header.rest().data(), static_cast<std::size_t>(bytes));
    }
    if (packing.swap) swap_bytes(values);
    return values;
  });
}

std::string compress_block(std::string_view bytes, Redundancy redundancy) {
  constexpr int kLevel = 1, kWindowBits = 15, kMemory = 8;  // fast; the rest as compress() has it
  z_stream stream{};
  const int strategy = redundancy == Redundancy::runs ? Z_RLE : Z_DEFAULT_STRATEGY;
  // The only possible errors are wrong parameters and lack of memory.
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kWindowBits, kMemory, strategy) != Z_OK) throw std::bad_alloc();
  std::vector<Bytef> packed(deflateBound(&stream, static_cast<uLong>(bytes.size())));
  // zlib reads it only.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // NOLINT(*-const-cast)
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  std::string result(reinterpret_cast<const char*>(packed.data()), stream.total_out);
  deflateEnd(&stream);
  return result;
}

Redundancy choose_redundancy(std::string_view bytes) {
  constexpr double kWorth = 1.05;  // of the size, for less than half of the time
  const std::size_t runs = compress_block(bytes, Redundancy::runs).size();
  const std::size_t strings = compress_block(bytes, Redundancy::strings).size();
  return static_cast<double>(runs) <= kWorth * static_cast<double>(strings) ? Redundancy::runs : Redundancy::strings;
}

}  // namespace temper::io
