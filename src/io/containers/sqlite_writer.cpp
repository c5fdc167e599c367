#include "io/containers/sqlite_writer.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace temper::io {
namespace {

constexpr std::size_t kPageBytes = 4096, kFileHeader = 100, kLeafHeader = 8, kInnerHeader = 12, kPointer = 2;
constexpr char kInnerTable = 0x05, kLeafIndex = 0x0a, kLeafTable = 0x0d;
// A payload of more bytes goes on in overflow pages: at least kLeastLocal bytes stay, and the pages are full.
constexpr std::size_t kMostLocal = kPageBytes - 35, kLeastLocal = (kPageBytes - 12) * 32 / 255 - 23;
constexpr std::size_t kOverflowBytes = kPageBytes - 4;

/// The lowest `bytes` bytes, the most significant first.
void append_number(std::string& to, std::uint64_t value, int bytes) {
  for (int i = bytes; i-- > 0;) to += static_cast<char>((value >> (8 * i)) & 0xff);
}

/// Seven bits in a byte, the most significant first; the ninth byte has eight.
void append_varint(std::string& to, std::uint64_t value) {
  constexpr int kMostBytes = 9;
  if (value >> 56 != 0) {
    for (int i = kMostBytes - 1; i-- > 0;) to += static_cast<char>(0x80 | ((value >> (8 + 7 * i)) & 0x7f));
    to += static_cast<char>(value & 0xff);
    return;
  }
  int bytes = 1;
  while (value >> (7 * bytes) != 0) ++bytes;
  for (int i = bytes; i-- > 0;) to += static_cast<char>((i > 0 ? 0x80 : 0) | ((value >> (7 * i)) & 0x7f));
}

/// Types of a record, and its values.
struct RecordParts {
  std::string types, values;

  void operator()(std::monostate) { types += '\0'; }
  void operator()(std::int64_t value) {
    struct Kind {
      char type;
      int bits;
    };
    constexpr Kind kKinds[] = {{1, 8}, {2, 16}, {3, 24}, {4, 32}, {5, 48}, {6, 64}};
    const auto fits = [value](const Kind& kind) {
      return kind.bits == 64 ||
             (value >= -(std::int64_t{1} << (kind.bits - 1)) && value < (std::int64_t{1} << (kind.bits - 1)));
    };
    if (value == 0 || value == 1) {
      types += static_cast<char>(8 + value);  // the type is the value
      return;
    }
    const Kind kind = *std::ranges::find_if(kKinds, fits);
    types += kind.type;
    append_number(values, static_cast<std::uint64_t>(value), kind.bits / 8);
  }
  void operator()(double value) {
    types += '\x07';
    append_number(values, std::bit_cast<std::uint64_t>(value), 8);
  }
  void operator()(const std::string& value) { bytes(value, 13); }
  void operator()(const SqliteBlob& value) { bytes(value.bytes, 12); }

 private:
  void bytes(const std::string& value, std::size_t least_type) {
    append_varint(types, 2 * value.size() + least_type);
    values += value;
  }
};

std::string record_of(const SqliteRow& row) {
  RecordParts parts;
  for (const SqliteValue& value : row) std::visit(parts, value);
  // The size of the header counts itself, in one byte or two.
  std::string record;
  append_varint(record, parts.types.size() + (parts.types.size() + 1 < 0x80 ? 1 : 2));
  return record + parts.types + parts.values;
}

/// A page of cells, which fill it from its end. `first`: bytes before it, in the first page of the file.
std::string page_of(char type, const std::vector<std::string>& cells, std::uint32_t last_child = 0,
                    std::size_t first = 0) {
  std::string header(1, type), pointers, content;
  std::size_t start = kPageBytes;
  for (const std::string& cell : cells) {
    start -= cell.size();
    append_number(pointers, start, 2);
    content = cell + content;
  }
  append_number(header, 0, 2);  // no free block
  append_number(header, cells.size(), 2);
  append_number(header, start, 2);
  append_number(header, 0, 1);
  if (type == kInnerTable) append_number(header, last_child, 4);
  const std::size_t free = start - first - header.size() - pointers.size();
  return header + pointers + std::string(free, '\0') + content;
}

}  // namespace

std::uint32_t SqliteWriter::add_page(std::string page) {
  pages_.push_back(std::move(page));
  return static_cast<std::uint32_t>(pages_.size());
}

/// The payload as it is in a cell of a table: whole, or its beginning and the number of the page where it goes on.
std::string SqliteWriter::with_overflow(std::string_view payload) {
  if (payload.size() <= kMostLocal) return std::string(payload);
  const std::size_t full = kLeastLocal + (payload.size() - kLeastLocal) % kOverflowBytes;
  std::string local(payload.substr(0, full <= kMostLocal ? full : kLeastLocal));
  payload.remove_prefix(local.size());
  append_number(local, pages_.size() + 1, 4);
  while (!payload.empty()) {
    const std::size_t n = std::min(kOverflowBytes, payload.size());
    std::string page;
    append_number(page, n < payload.size() ? pages_.size() + 2 : 0, 4);
    page += payload.substr(0, n);
    page.resize(kPageBytes, '\0');
    add_page(std::move(page));
    payload.remove_prefix(n);
  }
  return local;
}

void SqliteWriter::begin_table(std::string name, std::string sql) {
  table_ = std::move(name);
  sql_ = std::move(sql);
  leaves_.clear();
}

void SqliteWriter::add_row(std::int64_t number, const SqliteRow& values) {
  const std::string payload = record_of(values);
  std::string cell;
  append_varint(cell, payload.size());
  append_varint(cell, static_cast<std::uint64_t>(number));
  cell += with_overflow(payload);
  if (kLeafHeader + used_ + kPointer + cell.size() > kPageBytes) end_leaf();
  used_ += kPointer + cell.size();
  cells_.push_back(std::move(cell));
  last_row_ = number;
}

void SqliteWriter::end_leaf() {
  leaves_.push_back({add_page(page_of(kLeafTable, cells_)), last_row_});
  cells_.clear();
  used_ = 0;
}

/// The root of a tree over these pages: inner pages with the children before the last one in cells.
std::uint32_t SqliteWriter::root_of(std::vector<Child> children) {
  constexpr std::size_t kMostCellBytes = 4 + 9 + kPointer, kMostChildren = (kPageBytes - kInnerHeader) / kMostCellBytes;
  while (children.size() > 1) {
    // Equal shares, so that no page has a single child.
    const std::size_t n = (children.size() + kMostChildren - 1) / kMostChildren;
    std::vector<Child> parents;
    for (std::size_t i = 0, at = 0; i < n; ++i) {
      const std::size_t end = children.size() * (i + 1) / n;
      std::vector<std::string> cells;
      for (; at + 1 < end; ++at) {
        append_number(cells.emplace_back(), children[at].page, 4);
        append_varint(cells.back(), static_cast<std::uint64_t>(children[at].last_row));
      }
      parents.push_back({add_page(page_of(kInnerTable, cells, children[at].page)), children[at].last_row});
      ++at;
    }
    children = std::move(parents);
  }
  return children.front().page;
}

void SqliteWriter::end_table() {
  if (!cells_.empty() || leaves_.empty()) end_leaf();
  schema_.push_back({std::string("table"), table_, table_, std::int64_t{root_of(std::move(leaves_))}, sql_});
  leaves_.clear();
}

void SqliteWriter::add_index_of_one_row(int n, SqliteRow values, std::int64_t number) {
  values.emplace_back(number);
  const std::string payload = record_of(values);
  std::string cell;
  append_varint(cell, payload.size());
  const std::uint32_t root = add_page(page_of(kLeafIndex, {cell + payload}));
  schema_.push_back({std::string("index"), "sqlite_autoindex_" + table_ + "_" + std::to_string(n), table_,
                     std::int64_t{root}, std::monostate()});
}

std::string SqliteWriter::finish(std::uint32_t application_id, std::uint32_t user_version) {
  for (std::size_t i = 0; i < schema_.size(); ++i) {
    const std::string payload = record_of(schema_[i]);
    append_varint(cells_.emplace_back(), payload.size());
    append_varint(cells_.back(), i + 1);
    cells_.back() += payload;
  }
  std::string file("SQLite format 3", 16);  // with the zero at its end
  append_number(file, kPageBytes, 2);
  for (const int byte : {1, 1, 0, 64, 32, 32}) append_number(file, static_cast<std::uint64_t>(byte), 1);
  append_number(file, 1, 4);  // changes
  append_number(file, pages_.size(), 4);
  append_number(file, 0, 8);  // no free pages
  append_number(file, schema_.size(), 4);
  append_number(file, 4, 4);  // format of the schema
  append_number(file, 0, 8);
  append_number(file, 1, 4);  // UTF-8
  append_number(file, user_version, 4);
  append_number(file, 0, 4);
  append_number(file, application_id, 4);
  file.resize(92, '\0');
  append_number(file, 1, 4);        // the change that the next number is for
  append_number(file, 3008000, 4);  // version of SQLite
  pages_[0] = file + page_of(kLeafTable, cells_, 0, kFileHeader);
  file.clear();
  for (const std::string& page : pages_) file += page;
  return file;
}

}  // namespace temper::io
