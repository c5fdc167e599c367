// The tree grows while nlohmann's parser reads. So its depth is bounded, and each value gets the line that the parser
// has reached.
#include "io/outlines/json_tree.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/text/failure.hpp"
#include "temper/detail/utf8.hpp"

namespace temper::io {
namespace {

using Type = JsonValue::Type;

constexpr std::size_t kDeepest = 200;

constexpr std::size_t kEscape = 6;  // the length of \uXXXX

/// The number of an escape \uXXXX at this place; 0 if there is none.
unsigned escape_at(std::string_view text, std::size_t at) {
  if (!text.substr(std::min(at, text.size())).starts_with("\\u") || text.size() < at + kEscape) return 0;
  unsigned code = 0;
  const auto [end, error] = std::from_chars(text.data() + at + 2, text.data() + at + kEscape, code, 16);
  return end == text.data() + at + kEscape ? code : 0;
}

/// The places of escapes that are half of a pair: JSON allows them, and no text can hold them.
std::vector<std::size_t> half_pairs(std::string_view text) {
  std::vector<std::size_t> places;
  const auto is_high = [](unsigned code) { return code >= 0xD800 && code < 0xDC00; };
  const auto is_low = [](unsigned code) { return code >= 0xDC00 && code < 0xE000; };
  std::size_t length = 0;  // of what is behind a backslash
  for (std::size_t i = text.find('\\'); i != std::string_view::npos; i = text.find('\\', i + length)) {
    const unsigned code = escape_at(text, i);
    const bool pair = is_high(code) && is_low(escape_at(text, i + kEscape));
    if (!pair && (is_high(code) || is_low(code))) places.push_back(i);
    length = pair ? 2 * kEscape : 2;
  }
  return places;
}

/// The bytes of a file, whose reader knows how far the parser is.
struct Bytes {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  reference operator*() const { return **at; }
  Bytes& operator++() {
    ++*at;
    return *this;
  }
  friend bool operator==(const Bytes& a, const Bytes& b) { return *a.at == *b.at; }
  friend bool operator!=(const Bytes& a, const Bytes& b) { return !(a == b); }

  const char** at;  ///< of all copies
};

class TreeBuilder {
 public:
  TreeBuilder(const std::string& path, std::string_view bytes)
      : path_(path), counted_(bytes.data()), at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  JsonValue run() {
    nlohmann::json::sax_parse(Bytes{&at_}, Bytes{&end_}, this);
    return std::move(root_);
  }

  // What the parser finds: true to go on.
  bool null() { return add({}); }
  bool boolean(bool value) { return add({.type = Type::boolean, .number = value ? 1.0 : 0.0}); }
  bool number_integer(std::int64_t value) { return add_number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return add_number(static_cast<double>(value)); }
  bool number_float(double value, const std::string& /*digits*/) { return add_number(value); }
  bool string(std::string& value) { return add({.type = Type::string, .string = std::move(value)}); }
  static bool binary(std::vector<std::uint8_t>& /*value*/) { return false; }  // JSON has none
  bool start_object(std::size_t /*size*/) { return open(Type::object); }
  bool key(std::string& name) {
    open_.back()->names.push_back(std::move(name));
    return true;
  }
  bool end_object() { return close(); }
  bool start_array(std::size_t /*size*/) { return open(Type::array); }
  bool end_array() {
    if (!open_.back()->numbers.empty()) open_.back()->type = Type::numbers;
    return close();
  }
  /// `error` says what was expected and found, after the place.
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/, const std::exception& error) {
    std::string_view what = error.what();
    if (const std::size_t place = what.find("] "); place != std::string_view::npos) what.remove_prefix(place + 2);
    if (const std::size_t column = what.find(", column "); column != std::string_view::npos)
      what = what.substr(what.find(": ", column) + 2);
    fail(at_ == end_ ? ErrorCode::truncated : ErrorCode::syntax, text(path_, ":", line()), "is no JSON: ", what);
  }

 private:
  /// The line of what was read last. Behind a number the parser reads one more character, maybe the end of the line.
  std::uint32_t line() {
    for (; at_ - counted_ > 1; ++counted_) line_ += *counted_ == '\n' ? 1 : 0;
    return line_;
  }

  bool add_number(double value) { return add({.type = Type::number, .number = value}); }

  bool add(JsonValue value) {
    value.line = line();
    JsonValue& in = open_.empty() ? root_ : *open_.back();
    if (open_.empty()) {
      in = std::move(value);
    } else if (in.type == Type::array && in.items.empty() && value.type == Type::number) {
      in.numbers.push_back(value.number);
    } else {
      for (const double earlier : in.numbers)  // not only numbers after all
        in.items.push_back({.type = Type::number, .line = in.line, .number = earlier});
      in.numbers.clear();
      in.items.push_back(std::move(value));
    }
    return true;
  }

  bool open(Type type) {
    if (open_.size() > kDeepest)
      fail(ErrorCode::syntax, text(path_, ":", line()), "is nested more than ", kDeepest, " deep");
    add({.type = type});
    open_.push_back(open_.empty() ? &root_ : &open_.back()->items.back());
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& path_;
  const char *counted_, *at_, *end_;
  std::uint32_t line_ = 1;
  JsonValue root_;
  std::vector<JsonValue*> open_;  // from the root to the value that is read
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return &items[i];
  }
  return nullptr;
}

std::string_view JsonValue::text(std::string_view name) const {
  const JsonValue* member = find(name);
  return member != nullptr && member->type == Type::string ? std::string_view(member->string) : std::string_view();
}

JsonValue parse_json(const std::string& path, std::string_view bytes) {
  std::optional<std::string> changed = recoded(bytes);
  for (const std::size_t at : half_pairs(changed ? *changed : bytes)) {
    if (!changed) changed = std::string(bytes);
    changed->replace(at, kEscape, "\\ufffd");
  }
  return TreeBuilder(path, changed ? *changed : bytes).run();
}

std::string_view describe(const JsonValue& value) {
  switch (value.type) {
    case JsonValue::Type::null:
      return "null";
    case JsonValue::Type::boolean:
      return "true or false";
    case JsonValue::Type::number:
      return "a number";
    case JsonValue::Type::string:
      return "a string";
    case JsonValue::Type::numbers:
      return "numbers";
    case JsonValue::Type::array:
      return "an array";
    case JsonValue::Type::object:
      return "an object";
  }
  return "";
}

}  // namespace temper::io
