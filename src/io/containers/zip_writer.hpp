// A zip archive of stored entries, written front to back (APPNOTE.TXT 6.3.9 of PKWARE, §4.3).
//
// Nothing is compressed, so that arrays inside can be read without unpacking. All times are the earliest of zip: equal
// content makes equal bytes. Only entries or archives of 4 GiB and more use the fields of zip64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/disk/files.hpp"

namespace temper::io {

class ZipWriter {
 public:
  /// Numbers from `limit` on go into fields of zip64: numbers beyond 32 bits, or smaller ones for tests.
  explicit ZipWriter(Output& out, std::uint64_t limit = 0xffffffffu) : out_(out), limit_(limit) {}
  /// One entry: the bytes of all parts, one after the other.
  void add(std::string_view name, const std::vector<std::string_view>& parts);
  /// The last call: the directory of the archive.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint32_t crc;
    std::uint64_t size, offset;
  };
  void put(std::string_view bytes);
  void number(std::uint64_t value, int bytes);
  [[nodiscard]] std::uint64_t short_form(std::uint64_t value) const { return value >= limit_ ? 0xffffffffu : value; }
  void directory_entry(const Entry& entry);

  Output& out_;
  std::uint64_t limit_;
  std::uint64_t written_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace temper::io
