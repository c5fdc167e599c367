// Checks the header of a classic NetCDF file (CDF-1, CDF-2 and CDF-5) before the library reads it. If counts or offsets
// are wrong, libnetcdf 4.9 may read beyond its memory.
//
//   magic numrecs dimensions attributes variables      lists: tag, count, entries; both zero when there are none
//   dimension: name length    attribute: name type count values    variable: name dimensions attributes type size begin
//
// Numbers are big-endian, of 4 bytes, or of 8 bytes in CDF-5. Offsets have 8 bytes, in CDF-1 4. Names and values are
// filled up to multiples of 4. ("File Format Specifications", NetCDF documentation.)
#include <array>
#include <bit>

#include "io/containers/netcdf_file.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

constexpr std::uint64_t kDimensionTag = 10, kVariableTag = 11, kAttributeTag = 12;
constexpr std::array<std::uint64_t, 12> kTypeBytes = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // nc_type counts from 1
constexpr std::size_t kClassicTypes = 6, kAllTypes = 11;

class ClassicHeader {
 public:
  explicit ClassicHeader(const Source& source) : path_(source.path), bytes_(source.bytes) {}

  void check() {
    large_ = bytes_[3] == 5;
    offset_bytes_ = bytes_[3] == 1 ? 4 : 8;
    at_ = 4;
    records_ = number();
    // All ones: a file that is still being written; its size gives the number.
    if (records_ == (large_ ? ~std::uint64_t{0} : 0xffffffffu)) refuse("has no number of records");
    for (std::uint64_t i = list(kDimensionTag, "dimensions"); i > 0; --i) {
      name();
      lengths_.push_back(number());
    }
    attributes();
    for (std::uint64_t i = list(kVariableTag, "variables"); i > 0; --i) variable();
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    fail(ErrorCode::syntax, path_, "the NetCDF header ", what);
  }

  std::uint64_t big_endian(std::size_t n) {
    if (bytes_.size() - at_ < n) fail(ErrorCode::truncated, path_, "the file ends within the NetCDF header");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < n; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
    at_ += n;
    return value;
  }
  std::uint64_t number() { return big_endian(large_ ? 8 : 4); }

  void skip(std::uint64_t n) {
    const std::uint64_t filled = (n + 3) / 4 * 4;
    if (n > bytes_.size() || filled > bytes_.size() - at_)
      fail(ErrorCode::truncated, path_, "the file ends within the NetCDF header");
    at_ += static_cast<std::size_t>(filled);
  }

  std::uint64_t list(std::uint64_t tag, std::string_view what) {
    const std::uint64_t found = big_endian(4), n = number();
    if (found != tag && (found != 0 || n != 0)) refuse(text("has tag ", found, " where ", what, " were expected"));
    if (n > bytes_.size()) refuse(text("announces ", n, " ", what, " in ", bytes_.size(), " bytes"));
    return n;
  }

  std::string name() {
    const std::uint64_t n = number();
    const std::size_t start = at_;
    skip(n);
    std::string result(bytes_.substr(start, static_cast<std::size_t>(n)));
    constexpr std::size_t kLongest = 256;  // NC_MAX_NAME
    bool fine = n > 0 && n <= kLongest && result[0] > ' ';
    for (const char c : result) fine = fine && c >= ' ' && c < 127 && c != '/';
    if (!fine) refuse(text("has a name ", in_quotes(result)));
    return result;
  }

  std::uint64_t type_bytes() {
    const std::uint64_t type = big_endian(4);
    if (type < 1 || type > (large_ ? kAllTypes : kClassicTypes)) refuse(text("has a type ", type));
    return kTypeBytes[static_cast<std::size_t>(type)];
  }

  void attributes() {
    for (std::uint64_t i = list(kAttributeTag, "attributes"); i > 0; --i) {
      name();
      const std::uint64_t each = type_bytes(), n = number();
      if (n > bytes_.size()) refuse(text("announces an attribute of ", n, " values"));
      skip(n * each);
    }
  }

  void variable() {
    const std::string what = name();
    const std::uint64_t rank = number();
    if (rank > lengths_.size() + 1024) refuse(text("gives variable ", what, " ", rank, " dimensions"));
    std::uint64_t rows = 1, each_row = 1;
    bool records = false;
    for (std::uint64_t i = 0; i < rank; ++i) {
      const std::uint64_t d = number();
      if (d >= lengths_.size()) refuse(text("gives variable ", what, " dimension ", d, " of ", lengths_.size()));
      const std::uint64_t length = lengths_[static_cast<std::size_t>(d)];
      if (length == 0 && i > 0) refuse(text("gives variable ", what, " records that are not its rows"));
      records = records || length == 0;
      if (length == 0) {
        rows = records_;
      } else {
        if (each_row > bytes_.size() / length) refuse(text("announces variable ", what, " larger than the file"));
        each_row *= length;
      }
    }
    attributes();
    each_row *= type_bytes();
    static_cast<void>(number());  // its size once more, which NetCDF itself does not trust
    const std::uint64_t begin = big_endian(offset_bytes_);
    if (rows > bytes_.size()) refuse(text("announces ", rows, " records in ", bytes_.size(), " bytes"));
    // Records of all variables take turns: each record has at least one row of this variable.
    if (rows == 0) return;
    if (begin > bytes_.size() || each_row > (bytes_.size() - begin) / rows)
      fail(ErrorCode::truncated, path_, "the file ends within variable ", what);
  }

  const std::string& path_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool large_ = false;
  std::size_t offset_bytes_ = 4;
  std::uint64_t records_ = 0;
  std::vector<std::uint64_t> lengths_;
};

}  // namespace

void check_netcdf_header(const Source& source) {
  if (!source.bytes.starts_with("CDF") || source.bytes.size() < 4) return;  // HDF5 has checks of its own
  ClassicHeader(source).check();
}

}  // namespace temper::io
