// JSON (RFC 8259) as a tree whose values have their line.
//
// Errors in coordinates need the line, which general trees do not keep. GeoJSON consists mostly of arrays of numbers,
// which are kept flat.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace temper::io {

struct JsonValue {
  enum class Type { null, boolean, number, string, numbers, array, object };
  Type type = Type::null;
  std::uint32_t line = 0;
  double number = 0;  ///< of a number; 1 or 0 of a boolean
  std::string string = {};
  std::vector<double> numbers = {};     ///< of an array of numbers alone, which has one at least
  std::vector<JsonValue> items = {};    ///< of any other array, and the members of an object, in their order
  std::vector<std::string> names = {};  ///< of the members of an object

  /// The member of that name, or null when there is none or this is no object.
  [[nodiscard]] const JsonValue* find(std::string_view name) const;
  /// The member of that name, when it is a string; else empty.
  [[nodiscard]] std::string_view text(std::string_view name) const;
};

/// Fails with file and line on anything that is not JSON. Bytes that are not UTF-8 are read as Latin-1.
[[nodiscard]] JsonValue parse_json(const std::string& path, std::string_view bytes);

/// "a number", "an array", …: for messages.
[[nodiscard]] std::string_view describe(const JsonValue& value);

}  // namespace temper::io
