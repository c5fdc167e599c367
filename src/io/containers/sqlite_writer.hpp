// A SQLite database, written in one pass (https://www.sqlite.org/fileformat2.html). It has tables whose rows come in
// ascending order, and the indexes of their constraints. Nothing in it depends on the time: equal rows make equal
// bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace temper::io {

struct SqliteBlob {
  std::string bytes;
};
/// NULL, and the four kinds of values.
using SqliteValue = std::variant<std::monostate, std::int64_t, double, std::string, SqliteBlob>;
using SqliteRow = std::vector<SqliteValue>;

class SqliteWriter {
 public:
  SqliteWriter() : pages_(1) {}

  /// Begins a table. A column INTEGER PRIMARY KEY is the number of the row, and its values are NULL.
  void begin_table(std::string name, std::string sql);
  /// Adds a row to the table at hand. Precondition: its number is above those of the rows before.
  void add_row(std::int64_t number, const SqliteRow& values);
  void end_table();
  /// The index of the n-th constraint of the table that ended last, for tables of one row: its values there.
  void add_index_of_one_row(int n, SqliteRow values, std::int64_t number);
  /// The bytes of the file. The last call. Precondition: the schema fits into one page.
  [[nodiscard]] std::string finish(std::uint32_t application_id, std::uint32_t user_version);

 private:
  struct Child {
    std::uint32_t page;
    std::int64_t last_row;
  };
  std::uint32_t add_page(std::string page);
  [[nodiscard]] std::string with_overflow(std::string_view payload);
  void end_leaf();
  [[nodiscard]] std::uint32_t root_of(std::vector<Child> children);

  std::vector<std::string> pages_;  // the first one is the schema
  std::vector<SqliteRow> schema_;
  std::string table_, sql_;
  std::vector<std::string> cells_;  // of the leaf at hand
  std::size_t used_ = 0;            // bytes of these cells and their pointers
  std::int64_t last_row_ = 0;
  std::vector<Child> leaves_;
};

}  // namespace temper::io
