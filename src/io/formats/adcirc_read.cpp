// ADCIRC's grid and boundary file, fort.14: a title, "NE NP", nodes "number x y depth", elements "number 3 a b c", in
// SCHISM's hgrid.gr3 also "number 4 a b c d", then strings of boundary nodes. The rest of a line is a comment.
//
//   NOPE, NETA, and for each open boundary   NVDLL IBTYPEE, then its nodes
//   NBOU, NVEL, and for each land boundary   NVELL IBTYPE, then its nodes, with more numbers where there are levees:
//     3 13 23       node height coefficient
//     4 24 64       node partner height coefficient coefficient
//     5 25          node partner height coefficient coefficient, height, coefficient and diameter of a pipe
//
// Type 64 is a vertical element wall: a levee without width, whose two nodes are at one place. A mesh cannot have that.
// So the partners go aside by a millionth of the wall's edges, and come back to their nodes when fort.14 is written.
//
// (ADCIRC users' manual, fort.14.) ADCIRC itself closes islands (types 1, 11, 21) whose last node is not their first.
// SCHISM reads no types (hgrid.gr3): its files may have none, or type 1 for boundaries that are no islands.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/conversion/bed.hpp"
#include "io/conversion/globe.hpp"
#include "io/formats/adcirc.hpp"
#include "io/formats/boundary_codes.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {

std::string adcirc_boundary_name(const AdcircBoundary& b, std::size_t number) {
  const std::string name = text(b.open ? "open" : "land", " boundary ", number);
  return b.open && b.type == 0 ? name : text(name, ", type ", b.type);
}

std::optional<AdcircBoundary> adcirc_boundary(std::string_view name) {
  constexpr std::pair<std::string_view, AdcircBoundary> kWords[] = {
      {"open", {true, 0}}, {"land", {false, 0}}, {"island", {false, 1}}};
  constexpr std::string_view kType = ", type ";
  const std::string_view word = name.substr(0, name.find_first_of(" ,"));
  const auto* const kind =
      std::find_if(std::begin(kWords), std::end(kWords), [word](const auto& row) { return row.first == word; });
  if (kind == std::end(kWords)) return std::nullopt;
  AdcircBoundary result = kind->second;
  const std::size_t at = name.find(kType);
  if (at == std::string_view::npos) return result;
  const std::string_view digits = name.substr(at + kType.size());
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), result.type);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return result;
}

AdcircRow adcirc_row(const AdcircBoundary& b) {
  if (b.open) return {};
  switch (b.type) {
    case 3:
    case 13:
    case 23:
      return {false, 2};
    case 4:
    case 24:
    case kAdcircWall:
      return {true, 3};
    case 5:
    case 25:
      return {true, 6};
    default:
      return {};
  }
}

namespace {

class AdcircReader {
 public:
  explicit AdcircReader(Source& source) : scanner_(source.path, source.bytes), document_(new_document(source.path)) {}
  Document read() {
    MeshFile& f = document_.file;
    const std::string_view title = scanner_.rest_of_line();
    if (!title.empty())
      f.field_data.push_back({std::string(kAdcircTitle), 1, std::vector<std::uint8_t>(title.begin(), title.end())});
    const std::size_t n_elements = scanner_.count("elements", 10), n_nodes = scanner_.count("nodes", 8);
    scanner_.next_line();
    nodes(n_nodes);
    document_.may_be_degrees = true;
    const NumberLookup lookup(document_.names->points);
    if (const auto twice = lookup.duplicate()) fail(ErrorCode::syntax, scanner_.path(), "has node ", *twice, " twice");
    elements(n_elements, lookup);
    boundaries(true, lookup);
    boundaries(false, lookup);
    settle_lines();
    part_walls();
    if (untyped_ > 0) {
      f.warnings.push_back(text(scanner_.path(), ": ", untyped_,
                                untyped_ == 1 ? " land boundary has" : " land boundaries have",
                                " no type, which SCHISM reads none of: read as type 0"));
    }
    if (!sides_.empty()) {
      f.marked_points.data.push_back({std::string(kPairSide), 1, std::move(sides_)});
      f.marked_points.data.push_back({std::string(kAdcircLevee), kAdcircLeveeNumbers, std::move(levees_)});
    }
    return std::move(document_);
  }

 private:
  void nodes(std::size_t n) {
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    std::vector<double> depths(n);
    f.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      names.points.push_back(scanner_.number<std::int64_t>("the number of a node"));
      names.point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const double x = scanner_.real("the x coordinate of a node");
      f.points.push_back({x, scanner_.real("the y coordinate of a node")});
      depths[i] = scanner_.real("the depth of a node");
      scanner_.next_line();
    }
    f.point_data.push_back({std::string(kDepth), 1, std::move(depths)});
  }
  void elements(std::size_t n, const NumberLookup& lookup) {
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    f.triangles.corners.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = scanner_.number<std::int64_t>("the number of an element");
      names.triangles.push_back(number);
      names.triangle_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const std::int32_t corners = scanner_.integer("the number of corners");
      if (corners != 3 && corners != 4) {
        scanner_.fail_here(ErrorCode::syntax, "element ", number, " has ", corners, " corners; expected 3 or 4");
      }
      const std::string element = text(corners == 3 ? "triangle " : "quadrilateral ", number);
      const std::int32_t a = node(lookup, element), b = node(lookup, element), c = node(lookup, element);
      document_.add_face({a, b, c}, corners == 4 ? node(lookup, element) : kNoCorner);
      scanner_.next_line();
    }
  }
  std::size_t count_line(std::string_view things, std::size_t bytes_each) {
    const std::size_t n = scanner_.count(things, bytes_each);
    scanner_.next_line();
    return n;
  }
  // Old files end early: they have no boundaries.
  void boundaries(bool open, const NumberLookup& lookup) {
    if (scanner_.at_end()) return;
    const std::size_t n = count_line(open ? "open boundaries" : "land boundaries", 2);
    if (n == 0 && scanner_.at_end()) return;
    static_cast<void>(count_line("boundary nodes", 1));
    for (std::size_t i = 0; i < n; ++i) boundary(open, i + 1, lookup);
  }
  void boundary(bool open, std::size_t number, const NumberLookup& lookup) {
    MeshFile& f = document_.file;
    const std::size_t n = scanner_.count("nodes of a boundary", 2);
    AdcircBoundary kind{open, 0};
    const bool typed = scanner_.more_on_line() && scanner_.peek().find_first_not_of("0123456789") == std::string::npos;
    if (typed) kind.type = scanner_.integer("the type of a boundary");
    if (!typed && !open) ++untyped_;
    scanner_.next_line();
    const std::string name = adcirc_boundary_name(kind, number);
    const AdcircRow row = adcirc_row(kind);
    const std::int32_t tag = ++last_tag_;
    const auto mark = [&](std::int32_t point, std::int8_t side) {
      f.marked_points.add(point, tag);
      sides_.push_back(side);
    };
    ReadString string = {tag, f.lines.size()};
    std::int32_t last_of_wall = -1;
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t point = node(lookup, name);
      if (i > 0) connect(string, point);
      string.nodes.push_back(point);
      if (row.numbers > 0) {
        mark(point, 0);
        if (row.paired) {
          const std::int32_t partner = node(lookup, name);
          mark(partner, 1);
          if (kind.type == kAdcircWall) expect_one_place(point, partner, name);
          if (kind.type == kAdcircWall && i > 0) walls_.emplace_back(std::minmax(last_of_wall, partner));
          last_of_wall = partner;
        }
        levees_.resize(sides_.size() * kAdcircLeveeNumbers);
        double* numbers = levees_.data() + (sides_.size() - (row.paired ? 2 : 1)) * kAdcircLeveeNumbers;
        for (int k = 0; k < row.numbers; ++k) numbers[k] = scanner_.real("a number of a levee");
      }
      scanner_.next_line();
    }
    const bool island = !open && (kind.type == 1 || kind.type == 11 || kind.type == 21);
    end_string(string, island, name);
    f.names.push_back({1, tag, name});
  }
  /// The nodes of a boundary, as far as they are read.
  struct ReadString {
    std::int32_t tag = 0;
    std::size_t first_line = 0;
    NodeString nodes = {};
    double n_rows = 1;  // of the last node
  };
  /// Adds the line from the last node. A node in a further row needs none.
  void connect(ReadString& string, std::int32_t to) {
    MeshFile& f = document_.file;
    const std::int32_t last = string.nodes.back();
    if (last == to) {
      ++string.n_rows;
      if (f.lines.size() > string.first_line) rows_of_lines_.back()[1] = string.n_rows;
      return;
    }
    f.lines.add({last, to}, string.tag);
    rows_of_lines_.push_back({std::exchange(string.n_rows, 1), 1, 1});
    document_.names->line_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
  }
  /// Closes an island, and compares the string with the one that the writer would make of its lines.
  void end_string(ReadString& string, bool is_island, const std::string& name) {
    MeshFile& f = document_.file;
    const NodeString& nodes = string.nodes;
    if (is_island && nodes.size() > 2 && nodes.back() != nodes.front()) {
      connect(string, nodes.front());
      rows_of_lines_.back()[2] = 0;
    }
    const auto begin = f.lines.begin() + static_cast<std::ptrdiff_t>(string.first_line);
    are_plain_ = are_plain_ && node_strings({begin, f.lines.end()}) == std::vector<NodeString>(1, nodes);
    if (begin == f.lines.end()) f.warnings.push_back(text(scanner_.where(), ": ", name, " has no edge and is dropped"));
  }
  std::int32_t node(const NumberLookup& lookup, const std::string& element) {
    const auto number = scanner_.number<std::int64_t>("the number of a node");
    if (const auto index = lookup.find(number)) return static_cast<std::int32_t>(*index);
    scanner_.fail_here(ErrorCode::index_out_of_range, element, " uses vertex ", number, ", but the file has ",
                       document_.file.points.size(), " vertices, numbered from ", document_.names->points[0]);
  }
  void expect_one_place(std::int32_t point, std::int32_t partner, const std::string& wall) const {
    constexpr double kRounding = 1e-7;  // of a coordinate
    const Vec2 p = document_.file.points[static_cast<std::size_t>(point)],
               q = document_.file.points[static_cast<std::size_t>(partner)];
    if (length(q - p) <= kRounding * std::max({1.0, std::abs(p.x), std::abs(p.y)})) return;
    const auto& numbers = document_.names->points;
    scanner_.fail_here(ErrorCode::syntax, wall, ": node ", numbers[point], " and its partner ", numbers[partner],
                       " are ", length(q - p),
                       " apart; expected one place, as walls of type 64 have no width. Next: type 24 is a levee");
  }
  /// Moves the partners of walls aside, each into its own triangles.
  void part_walls() {
    MeshFile& f = document_.file;
    std::sort(walls_.begin(), walls_.end());
    struct Aside {
      Vec2 normal;  // sum of those of the edges
      double least2 = std::numeric_limits<double>::infinity();
    };
    std::map<std::int32_t, Aside> partners;
    for (const auto& t : f.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = t[k], b = t[(k + 1) % 3];
        if (!std::binary_search(walls_.begin(), walls_.end(), std::pair<std::int32_t, std::int32_t>(std::minmax(a, b))))
          continue;
        const auto at = [&](std::int32_t i) { return f.points[static_cast<std::size_t>(i)]; };
        const Vec2 edge = at(b) - at(a), left = {-edge.y, edge.x};
        const double side = dot(left, at(t[(k + 2) % 3]) - at(a)) < 0 ? -1 : 1, l2 = squared_length(edge);
        for (const std::int32_t end : {a, b}) {
          Aside& aside = partners[end];
          aside.normal = aside.normal + (side / std::sqrt(l2)) * left;
          aside.least2 = std::min(aside.least2, l2);
        }
      }
    }
    for (const auto& [partner, aside] : partners) {
      constexpr double kPart = 1e-6;  // of an edge
      Vec2& place = f.points[static_cast<std::size_t>(partner)];
      place = place + kPart * std::sqrt(aside.least2) * aside.normal;
    }
  }
  /// How many triangles each line has on its left, and on its right.
  [[nodiscard]] std::vector<std::array<int, 2>> sides_of_lines() const {
    const MeshFile& f = document_.file;
    using Ends = std::pair<std::int32_t, std::int32_t>;
    std::vector<std::pair<Ends, std::size_t>> wanted;  // and the line
    for (const auto& [a, b] : f.lines) wanted.emplace_back(std::minmax(a, b), wanted.size());
    std::sort(wanted.begin(), wanted.end());
    std::vector<std::array<int, 2>> sides(f.lines.size());
    for (std::size_t i = 0; i < f.triangles.size() && !wanted.empty(); ++i) {
      const auto at = [&](std::size_t k) { return f.points[static_cast<std::size_t>(f.triangles[i][k])]; };
      const Vec2 ab = at(1) - at(0), ac = at(2) - at(0);
      const bool clockwise = ab.x * ac.y < ab.y * ac.x;
      const std::array corners = corners_of_face(f.triangles[i], document_.fourth_corners, i);
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t from = corners[k], to = corners[(k + 1) % 4];
        const Ends ends = std::minmax(from, to);
        auto line = std::lower_bound(wanted.begin(), wanted.end(), std::pair(ends, std::size_t{0}));
        for (; line != wanted.end() && line->first == ends; ++line)
          ++sides[line->second][(f.lines[line->second][0] == from) == clockwise ? 1 : 0];
      }
    }
    return sides;
  }
  /// Removes the lines that close islands and are no edges of the mesh. Notes how strings differ from the writer's own.
  void settle_lines() {
    MeshFile& f = document_.file;
    const std::vector<std::array<int, 2>> sides = sides_of_lines();
    RunLength text_lines;
    std::vector<double> rows;
    std::size_t n = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (rows_of_lines_[i][2] == 0 && sides[i] == std::array{0, 0}) continue;
      are_plain_ = are_plain_ && sides[i] == std::array{1, 0};
      f.lines[n] = f.lines[i];
      f.lines.tags[n++] = f.lines.tags[i];
      rows.insert(rows.end(), rows_of_lines_[i].begin(), rows_of_lines_[i].end());
      text_lines.push_back(document_.names->line_lines[static_cast<std::int64_t>(i)]);
    }
    f.lines.corners.resize(n);
    f.lines.tags.resize(n);
    document_.names->line_lines = std::move(text_lines);
    if (!are_plain_ && n > 0) f.lines.data.push_back({std::string(kAdcircRows), kAdcircRowNumbers, std::move(rows)});
  }

  Scanner scanner_;
  Document document_;
  std::int32_t last_tag_ = 0;
  std::size_t untyped_ = 0;
  std::vector<std::array<double, kAdcircRowNumbers>> rows_of_lines_;
  bool are_plain_ = true;                                     // strings are those that the writer makes of their lines
  std::vector<std::pair<std::int32_t, std::int32_t>> walls_;  // edges of partners
  std::vector<double> levees_;
  std::vector<std::int8_t> sides_;
};

}  // namespace

// The first line is a title, so the next two lines decide: two counts and no third number, then a node.
bool sniff_adcirc(std::string_view head) {
  const auto take_line = [&head] {
    const std::size_t end = std::min(head.find('\n'), head.size());
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(std::min(end + 1, head.size()));
    return line;
  };
  const auto is_count = [](std::string_view w) {
    return !w.empty() && w.find_first_not_of("0123456789") == std::string_view::npos && w != "0";
  };
  take_line();
  Scanner counts("", take_line()), node("", take_line());
  for (int i = 0; i < 2; ++i) {
    if (!is_count(counts.peek())) return false;
    static_cast<void>(counts.word("a count"));
  }
  if (looks_like_number(counts.peek()) || !is_count(node.peek())) return false;
  static_cast<void>(node.word("a number"));
  for (int i = 0; i < 3; ++i) {
    if (!looks_like_number(node.peek())) return false;
    static_cast<void>(node.word("a number"));
  }
  return true;
}

Document read_adcirc(Source& source) { return AdcircReader(source).read(); }

}  // namespace temper::io
