// JIGSAW's geometry (Engwirda): MSHID=3;EUCLIDEAN-MESH, NDIMS=2, POINT, EDGE2 and BOUND.
//
//   POINT=n, then: x;y;tag        coordinates of an ELLIPSOID-MESH are longitude and latitude in radians
//   EDGE2=n, then: a;b;tag        points from 0
//   BOUND=n, then: part;edge;20   an edge (20: an EDGE2, from 0) of the boundary of a part
//
// Without BOUND nested loops take turns. Other sections are skipped.
#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <numbers>

#include "io/outlines/outline_input.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

class JigsawReader {
 public:
  explicit JigsawReader(Source& source) : path_(source.path), rest_(source.bytes) {
    document_.names = std::make_shared<OutlineFileNames>(source.path);
    document_.file.format = "jigsaw";
  }

  OutlineDocument read() {
    while (next_line()) section();
    Outline& o = document_.file.outline;
    if (o.points.empty()) fail(ErrorCode::empty_input, path_, "the file has no POINT section");
    if (o.segments.empty()) fail(ErrorCode::empty_input, path_, "the file has no EDGE2 section");
    check_ends();
    return std::move(document_);
  }

 private:
  template <class... Parts>
  [[noreturn]] void fail_here(ErrorCode code, const Parts&... message) const {
    fail(code, text(path_, ":", line_number_), message...);
  }

  /// The next line that is neither blank nor a comment, without blanks at its ends.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_number_;
      while (!line_.empty() && std::string_view(" \t\r").find(line_.back()) != std::string_view::npos) {
        line_.remove_suffix(1);
      }
      while (!line_.empty() && std::string_view(" \t").find(line_.front()) != std::string_view::npos) {
        line_.remove_prefix(1);
      }
      if (!line_.empty() && line_.front() != '#') return true;
    }
    line_ = {};
    return false;
  }

  void section() {
    const std::size_t equals = line_.find('=');
    if (equals == std::string_view::npos) {
      fail_here(ErrorCode::syntax, "expected a section NAME=…, found ", in_quotes(line_));
    }
    std::string name(line_.substr(0, equals));
    while (!name.empty() && name.back() == ' ') name.pop_back();
    name = upper_case(name);
    const std::string_view value = line_.substr(equals + 1);
    if (name == "MSHID") return kind(value);
    if (name == "NDIMS") return dimensions(value);
    if (name == "RADII") return;
    const std::size_t n = count(name, value);
    for (std::size_t i = 0; i < n; ++i) {
      if (!next_line()) {
        fail_here(ErrorCode::truncated, name, " announces ", n, " lines, but the file ends after ", i);
      }
      if (name == "POINT") point();
      if (name == "EDGE2") edge();
      if (name == "BOUND") bound();
    }
  }

  void kind(std::string_view value) {
    const std::size_t semicolon = std::min(value.find(';'), value.size());
    const std::string_view type = value.substr(std::min(semicolon + 1, value.size()));
    const auto has = [type](std::string_view upper, std::string_view lower) {
      return type.find(upper) != std::string_view::npos || type.find(lower) != std::string_view::npos;
    };
    if (has("GRID", "grid")) {
      fail_here(ErrorCode::unsupported, "is a grid (", in_quotes(type), "); expected EUCLIDEAN-MESH or ELLIPSOID-MESH");
    }
    document_.file.geographic = has("ELLIPSOID", "ellipsoid");
  }

  void dimensions(std::string_view value) const {
    if (value != "2") fail_here(ErrorCode::unsupported, "has NDIMS=", value, "; expected 2");
  }

  std::size_t count(const std::string& name, std::string_view value) const {
    const std::string_view digits = value.substr(0, value.find(';'));
    std::size_t n = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (error != std::errc() || end != digits.data() + digits.size()) {
      fail_here(ErrorCode::syntax, "expected the number of lines of ", name, ", found ", in_quotes(value));
    }
    if (n > rest_.size()) {
      fail_here(ErrorCode::truncated, name, " announces ", n, " lines, but only ", rest_.size(), " bytes follow");
    }
    return n;
  }

  /// The numbers of the line, between semicolons, after the first ones.
  template <class T, std::size_t n>
  std::array<T, n> numbers(std::string_view expected, int after = 0) const {
    std::array<T, n> result = {};
    std::string_view rest = line_;
    for (; after > 0; --after) rest.remove_prefix(rest.find(';') + 1);
    for (std::size_t i = 0; i < n; ++i) {
      const std::string_view field = rest.substr(0, rest.find(';'));
      // As everywhere: a leading plus and Fortran's exponents are numbers too.
      Scanner scanner(text(path_, ":", line_number_), field);
      try {
        result[i] = scanner.number<T>(expected);
      } catch (const Failure&) {
        fail_here(ErrorCode::syntax, "expected ", expected, ", found ", in_quotes(line_));
      }
      if (!scanner.at_end()) fail_here(ErrorCode::syntax, "expected ", expected, ", found ", in_quotes(line_));
      rest.remove_prefix(std::min(field.size() + 1, rest.size()));
    }
    return result;
  }

  void point() {
    constexpr std::string_view kExpected = "a point x;y;tag";
    const auto [x, y] = numbers<double, 2>(kExpected);
    const bool tagged = std::count(line_.begin(), line_.end(), ';') > 1;
    const auto tag = tagged ? numbers<std::int32_t, 1>(kExpected, 2)[0] : 0;
    const double unit = document_.file.geographic ? 180 / std::numbers::pi : 1;
    Outline& o = document_.file.outline;
    if (tag != 0) o.point_tags.push_back({static_cast<std::int32_t>(o.points.size()), tag});
    o.points.push_back({unit * x, unit * y});
    document_.names->point_lines.push_back(static_cast<std::int64_t>(line_number_));
  }

  void edge() {
    const auto [a, b, tag] = numbers<std::int32_t, 3>("an edge a;b;tag");
    document_.file.outline.segments.push_back({{a, b}, tag});
    document_.names->segment_lines.push_back(static_cast<std::int64_t>(line_number_));
  }

  void bound() {
    constexpr std::int32_t kEdge2 = 20;  // JIGSAW_EDGE2_TAG
    const auto [part, edge, type] = numbers<std::int32_t, 3>("a line part;edge;type of BOUND");
    if (type != kEdge2) {
      fail_here(ErrorCode::unsupported, "bounds a part by elements of type ", type, "; expected 20, edges");
    }
    const auto [known, is_new] = part_of_tag_.emplace(part, document_.file.outline.parts.size());
    if (is_new) {
      document_.file.outline.parts.push_back({part, {}, {}});
      document_.names->parts.push_back(text("part ", part));
    }
    document_.file.outline.parts[known->second].segments.push_back(edge);
    last_bound_line_ = line_number_;
  }

  /// POINT may follow EDGE2, so ends are looked at last.
  void check_ends() const {
    const Outline& o = document_.file.outline;
    for (std::size_t i = 0; i < o.segments.size(); ++i) {
      for (const std::int32_t end : o.segments[i].ends) {
        if (end >= 0 && static_cast<std::size_t>(end) < o.points.size()) continue;
        fail(ErrorCode::index_out_of_range, document_.names->segment_where(i), document_.names->segment(i),
             " uses point ", end, ", but there are points 0 to ", o.points.size() - 1);
      }
    }
    for (const OutlinePart& part : o.parts) {
      for (const std::int32_t edge : part.segments) {
        if (edge >= 0 && static_cast<std::size_t>(edge) < o.segments.size()) continue;
        fail(ErrorCode::index_out_of_range, text(path_, ":", last_bound_line_), "part ", part.region, " uses edge ",
             edge, ", but there are edges 0 to ", o.segments.size() - 1);
      }
    }
  }

  std::string path_;
  std::string_view rest_, line_;
  std::size_t line_number_ = 0, last_bound_line_ = 0;
  std::map<std::int32_t, std::size_t> part_of_tag_;
  OutlineDocument document_;
};

}  // namespace

bool sniff_jigsaw(std::string_view head) {
  Scanner scanner("", head, '#');
  if (scanner.at_end()) return false;
  const std::string_view word = scanner.peek();
  return word.starts_with("MSHID=") || word.starts_with("mshid=");
}

OutlineDocument read_jigsaw(Source& source) { return JigsawReader(source).read(); }

}  // namespace temper::io
