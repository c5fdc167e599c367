// Outlines: the content decides the format.
#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "io/outlines/outline_input.hpp"
#include "io/text/failure.hpp"
#include "io/text/scanner.hpp"
#include "temper/detail/read_number.hpp"

namespace temper::io {
namespace {

std::string numbered(std::string_view kind, const RunLength& numbers, std::size_t i) {
  return text(kind, numbers[static_cast<std::int64_t>(i)]);
}

using OutlineReader = OutlineDocument (*)(Source&);

OutlineReader reader_of(const std::string& path, std::string_view head) {
  if (sniff_geojson(head)) return read_geojson;
  if (sniff_gis(head)) return read_gis;
  if (sniff_jigsaw(head)) return read_jigsaw;
  if (sniff_poly(head)) return read_poly;
  fail(ErrorCode::unsupported, path,
       "is no outline that temper reads: expected a .poly file of Triangle, a geometry of JIGSAW (MSHID=…), GeoJSON, a "
       "shapefile or a GeoPackage");
}

}  // namespace

std::string OutlineFileNames::point(std::size_t i) const {
  const auto named = point_names.find(static_cast<std::int32_t>(i));
  return named != point_names.end() ? named->second : numbered("point ", points, i);
}
std::string OutlineFileNames::segment(std::size_t i) const {
  if (groups.empty()) return numbered("segment ", segments, i);
  std::size_t group = groups.size() - 1;
  while (group > 0 && groups[group].first > i) --group;
  return text("segment ", i - groups[group].first, " of ", groups[group].name);
}
std::string OutlineFileNames::hole(std::size_t i) const { return numbered("hole ", holes, i); }
std::string OutlineFileNames::region(std::size_t i) const { return numbered("region ", regions, i); }
std::string OutlineFileNames::part(std::size_t i) const { return i < parts.size() ? parts[i] : text("part ", i); }
std::string OutlineFileNames::ring(std::size_t i) const { return i < rings.size() ? rings[i] : text("ring ", i); }

std::string OutlineFileNames::point_where(std::size_t i) const {
  return at_line(point_path.empty() ? path : point_path, point_lines, i);
}
std::string OutlineFileNames::segment_where(std::size_t i) const { return at_line(path, segment_lines, i); }
std::string OutlineFileNames::hole_where(std::size_t i) const { return at_line(path, hole_lines, i); }
std::string OutlineFileNames::region_where(std::size_t i) const { return at_line(path, region_lines, i); }

Expected<OutlineFile> read_outline(const std::string& path) {
  return guarded<OutlineFile>(path, [&] {
    OutlineReader reader = nullptr;
    Source source = load(path, [&](std::string_view head, std::uint64_t) { reader = reader_of(path, head); });
    OutlineDocument document = reader(source);
    document.file.path = path;
    const Outline& o = document.file.outline;
    if (o.points.empty() || o.segments.empty()) {
      fail(ErrorCode::empty_input, path, "has no ", o.points.empty() ? "points" : "segments");
    }
    document.file.outline.names = std::move(document.names);
    return std::move(document.file);
  });
}

// Recursive descent; depth is bounded, so that no input overflows the stack.

namespace {

constexpr int kDeepest = 200;

class Parser {
 public:
  Parser(const std::string& path, std::string_view bytes) : path_(path), rest_(bytes) {}

  JsonValue run() {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);  // a byte order mark
    JsonValue root = value(0);
    skip_space();
    if (!rest_.empty()) fail_here("expected the end of the file, found ", found());
    return root;
  }

 private:
  template <class... Parts>
  [[noreturn]] void fail_here(const Parts&... message) const {
    fail(rest_.empty() ? ErrorCode::truncated : ErrorCode::syntax, text(path_, ":", line_), message...);
  }
  [[nodiscard]] std::string found() const {
    return rest_.empty() ? "the end of the file"
                         : in_quotes(rest_.substr(0, std::min<std::size_t>(rest_.find('\n'), 20)));
  }

  void skip_space() {
    std::size_t n = 0;
    for (; n < rest_.size(); ++n) {
      const char c = rest_[n];
      if (c == '\n') ++line_;
      if (c != ' ' && c != '\t' && c != '\n' && c != '\r') break;
    }
    rest_.remove_prefix(n);
  }
  bool take(char c) {
    skip_space();
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool take_word(std::string_view word) {
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  JsonValue value(int depth) {
    if (depth > kDeepest) fail_here("is nested more than ", kDeepest, " deep");
    skip_space();
    JsonValue v;
    v.line = static_cast<std::uint32_t>(line_);
    if (take('{')) {
      v.type = JsonValue::Type::object;
      object(v, depth);
    } else if (take('[')) {
      v.type = JsonValue::Type::array;
      array(v, depth);
    } else if (rest_.starts_with('"')) {
      v.type = JsonValue::Type::string;
      v.string = string();
    } else if (take_word("true") || take_word("false")) {
      v.type = JsonValue::Type::boolean;
      v.number = rest_.data()[-2] == 'u' ? 1 : 0;  // tr-u-e, fal-s-e
    } else if (!take_word("null")) {
      v.type = JsonValue::Type::number;
      v.number = number();
    }
    return v;
  }

  void object(JsonValue& v, int depth) {
    if (take('}')) return;
    do {
      skip_space();
      if (!rest_.starts_with('"')) fail_here("expected a name in quotes, found ", found());
      std::string name = string();
      if (!take(':')) fail_here("expected ':' after ", in_quotes(name), ", found ", found());
      v.items.push_back(value(depth + 1));
      v.names.push_back(std::move(name));
    } while (take(','));
    if (!take('}')) fail_here("expected ',' or '}', found ", found());
  }

  void array(JsonValue& v, int depth) {
    if (take(']')) return;
    do {
      JsonValue item = value(depth + 1);
      if (item.type == JsonValue::Type::number && v.items.empty()) {
        v.numbers.push_back(item.number);
        continue;
      }
      for (const double earlier : v.numbers) {  // not only numbers after all
        v.items.emplace_back();
        v.items.back().type = JsonValue::Type::number;
        v.items.back().number = earlier;
        v.items.back().line = v.line;
      }
      v.numbers.clear();
      v.items.push_back(std::move(item));
    } while (take(','));
    if (!v.numbers.empty()) v.type = JsonValue::Type::numbers;
    if (!take(']')) fail_here("expected ',' or ']', found ", found());
  }

  double number() {
    std::size_t n = 0;
    while (n < rest_.size() && std::string_view("+-.0123456789eE").find(rest_[n]) != std::string_view::npos) ++n;
    double result = 0;
    const auto [end, error] = read_number(rest_.data(), rest_.data() + n, result);
    if (n == 0 || end != rest_.data() + n) fail_here("expected a value, found ", found());
    if (error == std::errc::result_out_of_range) result = std::numeric_limits<double>::infinity();
    rest_.remove_prefix(n);
    return result;
  }

  std::string string() {
    rest_.remove_prefix(1);
    std::string result;
    for (;;) {
      if (rest_.empty() || rest_[0] == '\n') fail_here("a string does not end on its line");
      const char c = rest_[0];
      rest_.remove_prefix(1);
      if (c == '"') return result;
      result += c == '\\' ? escape() : std::string(1, c);
    }
  }

  std::string escape() {
    if (rest_.empty()) fail_here("a string does not end");
    const char c = rest_[0];
    rest_.remove_prefix(1);
    constexpr std::string_view kNames = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    if (const std::size_t i = kNames.find(c); i != std::string_view::npos) return {kMeanings[i]};
    if (c != 'u') fail_here("an escape in a string is none of JSON's");
    const std::uint32_t code = code_unit();
    constexpr std::uint32_t kReplacement = 0xFFFD;  // for half a pair
    const bool high = code >= 0xD800 && code < 0xDC00, low = code >= 0xDC00 && code < 0xE000;
    if (!high) return utf8(low ? kReplacement : code);
    // Beyond 16 bits a character is a pair of escapes.
    const std::string_view before = rest_;
    if (rest_.starts_with("\\u")) {
      rest_.remove_prefix(2);
      const std::uint32_t second = code_unit();
      if (second >= 0xDC00 && second < 0xE000) return utf8(0x10000 + ((code - 0xD800) << 10) + (second - 0xDC00));
    }
    rest_ = before;
    return utf8(kReplacement);
  }

  /// The four digits of an escape \uXXXX.
  std::uint32_t code_unit() {
    std::uint32_t code = 0;
    const std::size_t digits = std::min<std::size_t>(4, rest_.size());
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + digits, code, 16);
    if (error != std::errc() || end != rest_.data() + 4) fail_here("an escape in a string is none of JSON's");
    rest_.remove_prefix(4);
    return code;
  }

  static std::string utf8(std::uint32_t code) {
    constexpr std::uint32_t kMore = 0x80, kSix = 0x3F;
    if (code < kMore) return {static_cast<char>(code)};
    std::string bytes;
    std::uint32_t lead = 0xC0;
    for (std::uint32_t most = 0x20;; most >>= 1) {  // what the first byte holds
      bytes.insert(bytes.begin(), static_cast<char>(kMore | (code & kSix)));
      code >>= 6;
      if (code < most) break;
      lead = (lead >> 1) | kMore;
    }
    bytes.insert(bytes.begin(), static_cast<char>(lead | code));
    return bytes;
  }

  const std::string& path_;
  std::string_view rest_;
  std::size_t line_ = 1;
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

JsonValue parse_json(const std::string& path, std::string_view bytes) { return Parser(path, bytes).run(); }

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
