#include "io/containers/zip_writer.hpp"

#include <zlib.h>

#include <algorithm>

namespace temper::io {
namespace {

constexpr int kVersion = 20, kVersion64 = 45;  // needed to extract: 2.0 for folders and stored entries, 4.5 for zip64
constexpr int kDate = (1 << 5) | 1;            // 1 January 1980
constexpr int kExtra64 = 1;                    // id of the extra field with 64-bit numbers

}  // namespace

void ZipWriter::put(std::string_view bytes) {
  out_.put(bytes);
  written_ += bytes.size();
}

/// Little-endian.
void ZipWriter::number(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    out_.put(static_cast<char>(value & 0xff));
    value >>= 8;
  }
  written_ += static_cast<std::uint64_t>(bytes);
}

void ZipWriter::add(std::string_view name, const std::vector<std::string_view>& parts) {
  Entry entry = {std::string(name), 0, 0, written_};
  for (const std::string_view part : parts) {
    entry.crc = static_cast<std::uint32_t>(
        crc32_z(entry.crc, reinterpret_cast<const unsigned char*>(part.data()), part.size()));
    entry.size += part.size();
  }
  const bool large = entry.size >= limit_;
  number(0x04034b50, 4);
  number(large ? kVersion64 : kVersion, 2);
  number(0, 2);  // flags
  number(0, 2);  // stored
  number(0, 2);  // time
  number(kDate, 2);
  number(entry.crc, 4);
  number(short_form(entry.size), 4);  // stored
  number(short_form(entry.size), 4);  // unpacked
  number(name.size(), 2);
  number(large ? 20 : 0, 2);
  put(name);
  if (large) {
    number(kExtra64, 2);
    number(16, 2);
    number(entry.size, 8);
    number(entry.size, 8);
  }
  for (const std::string_view part : parts) put(part);
  entries_.push_back(std::move(entry));
}

void ZipWriter::directory_entry(const Entry& entry) {
  const bool large = entry.size >= limit_, far = entry.offset >= limit_;
  const int extra = (large ? 16 : 0) + (far ? 8 : 0);
  const int version = extra > 0 ? kVersion64 : kVersion;
  number(0x02014b50, 4);
  number(static_cast<std::uint64_t>(version), 2);  // made by
  number(static_cast<std::uint64_t>(version), 2);
  number(0, 2);  // flags
  number(0, 2);  // stored
  number(0, 2);  // time
  number(kDate, 2);
  number(entry.crc, 4);
  number(short_form(entry.size), 4);
  number(short_form(entry.size), 4);
  number(entry.name.size(), 2);
  number(extra > 0 ? static_cast<std::uint64_t>(extra) + 4 : 0, 2);
  number(0, 2);  // comment
  number(0, 2);  // disk
  number(0, 2);  // internal attributes
  number(0, 4);  // external attributes
  number(short_form(entry.offset), 4);
  put(entry.name);
  if (extra == 0) return;
  number(kExtra64, 2);
  number(static_cast<std::uint64_t>(extra), 2);
  if (large) {
    number(entry.size, 8);
    number(entry.size, 8);
  }
  if (far) number(entry.offset, 8);
}

void ZipWriter::finish() {
  const std::uint64_t start = written_;
  for (const Entry& entry : entries_) directory_entry(entry);
  const std::uint64_t end = written_, size = end - start, n = entries_.size();
  if (start >= limit_ || size >= limit_ || n >= 0xffff) {
    number(0x06064b50, 4);
    number(44, 8);  // of what follows
    number(kVersion64, 2);
    number(kVersion64, 2);
    number(0, 4);  // this disk
    number(0, 4);  // disk of the directory
    number(n, 8);
    number(n, 8);
    number(size, 8);
    number(start, 8);
    number(0x07064b50, 4);  // where that is
    number(0, 4);
    number(end, 8);
    number(1, 4);
  }
  number(0x06054b50, 4);
  number(0, 2);
  number(0, 2);
  number(std::min<std::uint64_t>(n, 0xffff), 2);
  number(std::min<std::uint64_t>(n, 0xffff), 2);
  number(short_form(size), 4);
  number(short_form(start), 4);
  number(0, 2);  // comment
}

}  // namespace temper::io
