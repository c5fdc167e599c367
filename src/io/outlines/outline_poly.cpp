// Triangle's .poly (Shewchuk): points, segments, holes, and regions when they are there.
//
//   points 2 attributes markers(0|1), then: number x y attributes… [marker]; no points: they are in NAME.node
//   segments markers(0|1), then: number a b [marker]
//   holes, then: number x y
//   regions, then: number x y attribute [largest area]
//
// Numbers start at 0 or 1, as the first point does. A largest area A stands for edges of length √(4A/√3).
#include <algorithm>
#include <cmath>

#include "io/disk/files.hpp"
#include "io/outlines/outline_input.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

class PolyReader {
 public:
  explicit PolyReader(Source& source) : source_(source), scanner_(source.path, source.bytes, '#') {
    document_.names = std::make_shared<OutlineFileNames>(source.path);
    document_.file.format = "poly";
  }

  OutlineDocument read() {
    if (const std::size_t n = points(scanner_); n == 0) other_points();
    segments();
    holes();
    if (!scanner_.at_end()) regions();
    return std::move(document_);
  }

 private:
  /// Reads the points, and returns how many there were.
  std::size_t points(Scanner& s) {
    Outline& o = document_.file.outline;
    OutlineFileNames& names = *document_.names;
    const std::size_t n = s.count("points", 6);
    const std::int32_t dimension = s.more_on_line() ? s.integer("the dimension") : 2;
    if (dimension != 2) s.fail_here(ErrorCode::unsupported, "has points of dimension ", dimension, "; expected 2");
    const std::size_t attributes = s.more_on_line() ? s.count("attributes", 1) : 0;
    const bool markers = s.more_on_line() && s.count("markers", 1) != 0;
    s.check_room(n, "points", 6 + 2 * attributes);
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t number = s.integer("the number of a point");
      if (i == 0) first_ = number;
      if (number != first_ + static_cast<std::int64_t>(i)) {
        s.fail_here(ErrorCode::syntax, "expected point ", first_ + static_cast<std::int64_t>(i), ", found point ",
                    number);
      }
      names.points.push_back(number);
      names.point_lines.push_back(static_cast<std::int64_t>(s.line()));
      const double x = s.real("the x coordinate of a point");
      o.points.push_back({x, s.real("the y coordinate of a point")});
      for (std::size_t k = 0; k < attributes; ++k) s.real("an attribute");
      const std::int32_t tag = markers ? s.integer("the marker of a point") : 0;
      if (tag != 0) o.point_tags.push_back({static_cast<std::int32_t>(i), tag});
    }
    return n;
  }

  void other_points() {
    const std::string path = without_suffix(source_.path, ".poly") + ".node";
    if (!exists(path)) {
      fail(ErrorCode::not_found, source_.path, "has no points of its own; they are expected in ", path,
           ", which does not exist");
    }
    node_ = load(path);
    Scanner scanner(path, node_.bytes, '#');
    points(scanner);
    document_.names->point_path = path;
  }

  void segments() {
    Scanner& s = scanner_;
    const std::size_t n = s.count("segments", 6);
    const bool markers = s.more_on_line() && s.count("markers", 1) != 0;
    for (std::size_t i = 0; i < n; ++i) {
      document_.names->segments.push_back(s.integer("the number of a segment"));
      document_.names->segment_lines.push_back(static_cast<std::int64_t>(s.line()));
      const std::int32_t a = s.vertex(first_), b = s.vertex(first_);
      check_end(a), check_end(b);
      document_.file.outline.segments.push_back({{a, b}, markers ? s.integer("the marker of a segment") : 0});
    }
  }

  void check_end(std::int32_t end) const {
    const auto n = static_cast<std::int32_t>(document_.file.outline.points.size());
    if (end >= 0 && end < n) return;
    scanner_.fail_here(ErrorCode::index_out_of_range, document_.names->segment(document_.file.outline.segments.size()),
                       " uses point ", std::int64_t{end} + first_, ", but there are points ", first_, " to ",
                       std::int64_t{first_} + n - 1);
  }

  void holes() {
    Scanner& s = scanner_;
    if (s.at_end()) return;  // some programs leave the last 0 out
    const std::size_t n = s.count("holes", 6);
    for (std::size_t i = 0; i < n; ++i) {
      document_.names->holes.push_back(s.integer("the number of a hole"));
      document_.names->hole_lines.push_back(static_cast<std::int64_t>(s.line()));
      const double x = s.real("the x coordinate of a hole");
      document_.file.outline.holes.push_back({x, s.real("the y coordinate of a hole")});
    }
  }

  void regions() {
    Scanner& s = scanner_;
    const std::size_t n = s.count("regions", 8);
    for (std::size_t i = 0; i < n; ++i) {
      document_.names->regions.push_back(s.integer("the number of a region"));
      document_.names->region_lines.push_back(static_cast<std::int64_t>(s.line()));
      OutlineRegion region;
      region.at.x = s.real("the x coordinate of a region");
      region.at.y = s.real("the y coordinate of a region");
      region.region = attribute();
      if (s.more_on_line()) {
        const double area = s.real("the largest area of a region");
        if (area > 0) region.size = std::sqrt(4 * area / std::sqrt(3.0));  // negative: no limit
      }
      document_.file.outline.regions.push_back(region);
    }
  }

  /// The number of a region; Triangle takes any real one.
  std::int32_t attribute() {
    const double value = scanner_.real("the attribute of a region");
    if (value != std::floor(value) || std::abs(value) > 2e9) {
      scanner_.fail_here(ErrorCode::syntax, "expected a whole number as the attribute of a region, found ", value);
    }
    return static_cast<std::int32_t>(value);
  }

  Source& source_;
  Source node_;  // NAME.node, when the points are there
  Scanner scanner_;
  OutlineDocument document_;
  std::int32_t first_ = 0;  // number of the first point
};

}  // namespace

bool sniff_poly(std::string_view head) {
  Scanner scanner("", head, '#');
  int words = 0;
  for (; words < 4 && (words == 0 || scanner.more_on_line()) && !scanner.at_end(); ++words) {
    const std::string_view word = scanner.word("");
    if (word.find_first_not_of("0123456789") != std::string_view::npos || (words == 1 && word != "2")) return false;
  }
  return words >= 1;
}

OutlineDocument read_poly(Source& source) { return PolyReader(source).read(); }

}  // namespace temper::io
