// Names of arrays and groups. Each is once in a list, and has no characters that a terminal or a text file would
// interpret.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/scanner.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// The names that are taken. A name costs O(log n), however often it comes.
class TakenNames {
 public:
  /// Returns `name`, or when it is taken name_2, name_3, …; the result is taken from now on.
  [[nodiscard]] std::string take(std::string name);

 private:
  std::map<std::string, int> next_;  // the number that the next one of that name is tried with
};

/// Gives new names to arrays whose name an earlier array has.
void make_names_unique(std::vector<DataArray>& arrays);

/// The text with ASCII letters of one case.
[[nodiscard]] std::string upper_case(std::string_view text);
[[nodiscard]] std::string lower_case(std::string_view text);
/// The length of the longest suffix that the path ends with, of those between blanks, or 0. `any_case`: letters of the
/// path may be large.
[[nodiscard]] std::size_t suffix_length(std::string_view suffixes, std::string_view path, bool any_case);

/// Appends %20 for a blank.
void append_percent(std::string& text, char c);

/// "a, b, c"; of a long list the first ones, and the number of the others.
[[nodiscard]] std::string list_of(const std::vector<std::string_view>& names);

/// "12 things …: first, second, third, …", with the first kNamed of them or fewer in `names`.
[[nodiscard]] std::string listed(std::size_t n, std::string_view what, const std::vector<std::string>& names);
inline constexpr std::size_t kNamed = 10;

/// The name with its control characters written out (\x0a), in UTF-8.
[[nodiscard]] std::string plain_name(std::string_view name);
/// Makes all names plain, with a warning.
void make_names_plain(MeshFile& file);
/// Refuses names that are not plain: files made by hand may have some.
void check_names(const std::string& path, const MeshFile& file);

// --- physical names where a format has only text for them: lines "dimension tag name" ---

/// The rest of the line.
inline PhysicalName read_physical_name(Scanner& scanner) {
  PhysicalName name;
  name.dimension = scanner.integer("the dimension of a physical name");
  name.tag = scanner.integer("the tag of a physical name");
  name.name = scanner.rest_of_line();
  return name;
}

/// Reads a name from each line of a text, and appends them to `names`.
inline void read_physical_names(Scanner& scanner, std::vector<PhysicalName>& names) {
  while (!scanner.at_end()) names.push_back(read_physical_name(scanner));
}

/// The line of a name, without its end.
inline std::string line_of(const PhysicalName& name) { return text(name.dimension, " ", name.tag, " ", name.name); }

inline std::string lines_of(const std::vector<PhysicalName>& names) {
  std::string all;
  for (const PhysicalName& name : names) all += line_of(name) + "\n";
  return all;
}

}  // namespace temper::io
