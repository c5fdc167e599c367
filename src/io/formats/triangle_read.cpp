// Triangle's .node and .ele (Shewchuk), and the segments of .poly and .edge if these files exist. TetGen's files are
// the same with a dimension more: points x y z, tetrahedra a b c d, and tagged faces in .face.
//
//   NAME.node   points 2 attributes markers(0|1), then: number x y attributes… [marker]
//   NAME.ele    triangles 3 attributes, then: number a b c attributes…
//   NAME.poly   (points, none when they are in .node), segments markers, then: number a b [marker]
//   NAME.edge   edges markers, then the same; only those with a marker other than 0 are lines
//   NAME.face   faces markers, then: number a b c [marker]; only those with a marker other than 0
//
// Attributes have no names in this format, so temper declares them in comments, which Triangle skips.
//   # temper attribute float64 1 weight        type, components, name: one line for each array, in order
// Undeclared attributes of points are data attribute1, … (Triangle -w takes the first as weight: declare it to have it
// read as weight). The last undeclared attribute of triangles is the region if it is integer throughout (Triangle -A).
// A marker other than 0 is the tag of a point. Numbers start at 0 or 1, as the first point does.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/formats/triangle.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

/// The numbers on the first lines that are not comments.
std::vector<std::vector<std::string_view>> first_lines(std::string_view head, std::size_t n) {
  std::vector<std::vector<std::string_view>> lines;
  Scanner scanner("", head, '#');
  while (lines.size() < n && !scanner.at_end()) {
    lines.emplace_back();
    while (scanner.more_on_line()) {
      const std::string_view word = scanner.word("a number");
      if (!looks_like_number(word)) return {};
      lines.back().push_back(word);
    }
  }
  return lines;
}

enum class TriangleFile { none, node, ele };

TriangleFile kind_of(std::string_view head) {
  const auto lines = first_lines(head, 2);
  if (lines.empty()) return TriangleFile::none;
  const auto& first = lines[0];
  const auto plain = [](std::string_view word) {
    return word.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (first.size() < 2 || first.size() > 4 || !std::all_of(first.begin(), first.end(), plain))
    return TriangleFile::none;
  const bool only_header = lines.size() < 2;
  const std::size_t columns = only_header ? 0 : lines[1].size();
  if (first[1] == "2" && first.size() != 3 && (only_header || columns >= 3)) return TriangleFile::node;
  if (first[1] == "2" && first.size() == 3 && columns >= 4) return TriangleFile::node;
  // Files of TetGen.
  if (first[1] == "3" && first.size() == 4 && columns >= 4) return TriangleFile::node;
  if ((first[1] == "4" || first[1] == "10") && first.size() <= 3 && columns >= 5) return TriangleFile::ele;
  if ((first[1] == "3" || first[1] == "6") && first.size() <= 3 && (only_header || columns >= 4))
    return TriangleFile::ele;
  return TriangleFile::none;
}

/// The declarations in the comments of a file.
struct Declarations {
  std::vector<DataArray> arrays;  // empty values
  double z = 0;
  std::vector<PhysicalName> names;
};

Declarations declarations(std::string_view bytes) {
  Declarations result;
  const auto each_line_with = [&](std::string_view start, auto use) {
    for (std::size_t at = bytes.find(start); at != std::string_view::npos; at = bytes.find(start, at + 1)) {
      if (at > 0 && bytes[at - 1] != '\n') continue;
      const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
      Scanner scanner("", bytes.substr(at + start.size(), end - at - start.size()));
      try {
        use(scanner);
      } catch (const Failure&) {
        // The comment is no declaration of temper's.
      }
    }
  };
  constexpr std::int32_t kMostComponents = 1000;
  each_line_with(kDeclaration, [&](Scanner& s) {
    const auto scalar = scalar_of_text(s.word("a type"));
    const std::int32_t components = s.integer("components");
    if (!scalar || components < 1 || components > kMostComponents) return;
    result.arrays.push_back({std::string(s.rest_of_line()), components, zeros(*scalar, 0)});
  });
  each_line_with(kDeclaredZ, [&](Scanner& s) { result.z = s.real("z"); });
  each_line_with(kDeclaredName, [&](Scanner& s) {
    const std::int32_t dimension = s.integer("a dimension"), tag = s.integer("a tag");
    result.names.push_back({dimension, tag, std::string(s.rest_of_line())});
  });
  return result;
}

/// The numbers of one point or triangle. They are on one line, as many as in the header.
class TriangleRow {
 public:
  TriangleRow(Scanner& scanner, std::string_view kind, std::size_t columns)
      : scanner_(scanner), kind_(kind), columns_(columns), number_(scanner.integer(kind)) {}

  [[nodiscard]] std::int32_t number() const { return number_; }
  template <class T>
  T next(std::string_view expected) {
    expect_more();
    return scanner_.number<T>(expected);
  }
  std::int32_t next_vertex(std::int32_t first) {
    expect_more();
    return scanner_.vertex(first);
  }
  void end() {
    if (!scanner_.more_on_line()) return;
    const std::string where = scanner_.where();
    for (; scanner_.more_on_line(); ++found_) static_cast<void>(scanner_.word("a number"));
    refuse(where);
  }

 private:
  void expect_more() {
    if (!scanner_.more_on_line()) {
      const std::string where = scanner_.where();
      if (!scanner_.at_end()) refuse(where);  // else the file is cut off
    }
    ++found_;
  }
  [[noreturn]] void refuse(const std::string& where) const {
    fail(ErrorCode::size_mismatch, where, "the row of ", kind_.substr(kind_.rfind(' ') + 1), " ", number_, " has ",
         found_, " numbers, but the header says ", columns_);
  }

  Scanner& scanner_;
  std::string_view kind_;  // "the number of a point"
  std::size_t columns_, found_ = 1;
  std::int32_t number_;
};

/// Columns of a table that become data arrays.
class AttributeColumns {
 public:
  AttributeColumns(std::vector<DataArray> declared, std::size_t columns, const Scanner& scanner)
      : arrays_(std::move(declared)) {
    std::size_t sum = 0;
    for (const DataArray& a : arrays_) sum += static_cast<std::size_t>(a.components);
    if (sum > columns) {
      scanner.fail_here(ErrorCode::size_mismatch, "declares ", sum, " attributes, but the header says ", columns);
    }
    for (std::size_t i = sum; i < columns; ++i) {
      arrays_.push_back({text("attribute", i + 1), 1, std::vector<double>()});
      ++undeclared_;
    }
  }
  void read(TriangleRow& row) {
    for (DataArray& a : arrays_) {
      std::visit(
          [&](auto& v) {
            for (int k = 0; k < a.components; ++k) v.push_back(row.next<ElementOf<decltype(v)>>("an attribute"));
          },
          a.values);
    }
  }
  [[nodiscard]] std::size_t undeclared() const { return undeclared_; }
  std::vector<DataArray> take() { return std::move(arrays_); }

 private:
  std::vector<DataArray> arrays_;
  std::size_t undeclared_ = 0;
};

class TriangleReader {
 public:
  explicit TriangleReader(Source& source) : source_(source), document_(new_document(source.path)) {}
  Document read() {
    const TriangleFile kind = kind_of(std::string_view(source_.bytes).substr(0, kSniffBytes));
    const bool is_node = kind == TriangleFile::node;
    const std::string base = without_suffix(source_.path, is_node ? ".node" : ".ele");
    const std::string other_path = base + (is_node ? ".ele" : ".node");
    if (!exists(other_path)) {
      fail(ErrorCode::not_found, source_.path, "is the ", is_node ? "points" : "elements",
           " of a mesh of Triangle or TetGen; its ", is_node ? "elements" : "points", " are expected in ", other_path,
           ", which does not exist");
    }
    Source other = load(other_path);
    document_.names->path = is_node ? source_.path : other_path;
    document_.names->triangle_path = document_.names->tetrahedron_path = is_node ? other_path : source_.path;
    nodes(is_node ? source_ : other);
    elements(is_node ? other : source_);
    if (dimension_ == 2 && exists(base + ".poly"))
      segments(base + ".poly", false);
    else if (exists(base + ".edge"))
      segments(base + ".edge", true);
    if (dimension_ == 3 && exists(base + ".face")) faces(base + ".face");
    return std::move(document_);
  }

 private:
  void nodes(Source& source) {
    Scanner scanner(source.path, source.bytes, '#');
    MeshFile& f = document_.file;
    const std::size_t n = scanner.count("points", 6);
    dimension_ = scanner.integer("the dimension");
    if (dimension_ != 2 && dimension_ != 3)
      scanner.fail_here(ErrorCode::unsupported, "has points of dimension ", dimension_, "; expected 2 or 3");
    const std::size_t n_attributes = scanner.more_on_line() ? scanner.count("attributes", 1) : 0;
    const bool markers = scanner.more_on_line() && scanner.count("markers", 1) != 0;
    scanner.check_room(n, "points", 6 + 2 * n_attributes);
    Declarations declared = declarations(source.bytes);
    AttributeColumns columns(std::move(declared.arrays), n_attributes, scanner);
    document_.z = declared.z;
    f.names = std::move(declared.names);
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < n; ++i) {
      TriangleRow row(scanner, "the number of a point",
                      1 + static_cast<std::size_t>(dimension_) + n_attributes + (markers ? 1 : 0));
      const std::int32_t number = row.number();
      if (i == 0) first_ = number;
      if (number != first_ + static_cast<std::int64_t>(i)) {
        scanner.fail_here(ErrorCode::syntax, "expected point ", first_ + static_cast<std::int64_t>(i), ", found point ",
                          number);
      }
      document_.names->points.push_back(number);
      document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner.line()));
      const auto x = row.next<double>("the x coordinate of a point");
      f.points.push_back({x, row.next<double>("the y coordinate of a point")});
      if (dimension_ == 3) plane.add(i, row.next<double>("the z coordinate of a point"));
      columns.read(row);
      const auto marker = markers ? row.next<std::int32_t>("the marker of a point") : 0;
      row.end();
      if (marker == 0) continue;
      f.marked_points.add(static_cast<std::int32_t>(i), marker);
    }
    if (columns.undeclared() > 0) {
      f.warnings.push_back(text(source.path,
                                ": undeclared attributes are read as data, not as weights; the comment line '",
                                kDeclaration, "float64 1 weight' makes the first one a weight"));
    }
    f.point_data = columns.take();
    if (const DataArray* weight = find(f.point_data, "weight"); weight != nullptr && weight->components == 1) {
      f.weights = to_doubles(std::move(take(f.point_data, "weight")->values));
    }
  }
  void elements(Source& source) {
    Scanner scanner(source.path, source.bytes, '#');
    MeshFile& f = document_.file;
    const bool tets = dimension_ == 3;
    const std::string_view kind = tets ? "tetrahedra" : "triangles";
    const std::size_t n = scanner.count(kind, 8);
    const std::int32_t corners = scanner.integer("the number of corners");
    if (corners == 6) refuse_element(scanner.where(), first_, "quadratic triangle", KindsOfCells::simplices);
    if (corners == 10) refuse_element(scanner.where(), first_, "quadratic tetrahedron", KindsOfCells::simplices);
    if (corners != dimension_ + 1)
      scanner.fail_here(ErrorCode::unsupported, "has elements of ", corners, " corners, and points of dimension ",
                        dimension_, "; expected ", kind, " of ", dimension_ + 1);
    const std::size_t n_attributes = scanner.more_on_line() ? scanner.count("attributes", 1) : 0;
    scanner.check_room(n, kind, 8 + 2 * n_attributes);
    Declarations declared = declarations(source.bytes);
    AttributeColumns columns(std::move(declared.arrays), n_attributes, scanner);
    FileNames& names = *document_.names;
    tets ? document_.file.tetrahedra.corners.reserve(n) : f.triangles.corners.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      TriangleRow row(scanner, tets ? "the number of a tetrahedron" : "the number of a triangle",
                      1 + static_cast<std::size_t>(corners) + n_attributes);
      (tets ? names.tetrahedra : names.triangles).push_back(row.number());
      (tets ? names.tetrahedron_lines : names.triangle_lines).push_back(static_cast<std::int64_t>(scanner.line()));
      const std::int32_t a = row.next_vertex(first_), b = row.next_vertex(first_), c = row.next_vertex(first_);
      if (tets)
        document_.file.tetrahedra.corners.push_back({a, b, c, row.next_vertex(first_)});
      else
        f.triangles.corners.push_back({a, b, c});
      columns.read(row);
      row.end();
    }
    const bool last_is_region = columns.undeclared() > 0;
    std::vector<DataArray>& data = tets ? document_.file.tetrahedra.data : f.triangles.data;
    data = columns.take();
    const std::string region = last_is_region ? data.back().name : "region";
    const DataArray* array = find(data, region);
    if (array == nullptr || array->components != 1) return;
    if (auto regions = to_int32(array->values)) {
      (tets ? document_.file.tetrahedra.tags : f.triangles.tags) = std::move(*regions);
      static_cast<void>(take(data, region));
    }
  }
  void faces(const std::string& path) {
    const Source source = load(path);
    Scanner scanner(path, source.bytes, '#');
    MeshFile& f = document_.file;
    document_.names->triangle_path = path;
    const std::size_t n = scanner.count("faces", 8);
    const bool markers = scanner.more_on_line() && scanner.count("markers", 1) != 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = scanner.integer("the number of a face");
      const auto text_line = static_cast<std::int64_t>(scanner.line());
      const std::int32_t a = scanner.vertex(first_), b = scanner.vertex(first_), c = scanner.vertex(first_);
      const std::int32_t marker = markers ? scanner.integer("the marker of a face") : 0;
      skip_neighbors(scanner);
      if (marker == 0) continue;
      document_.names->triangles.push_back(number);
      document_.names->triangle_lines.push_back(text_line);
      f.triangles.add({a, b, c}, marker);
    }
  }
  /// TetGen -nn adds the numbers of tetrahedra to faces and edges.
  static void skip_neighbors(Scanner& scanner) {
    while (scanner.more_on_line()) static_cast<void>(scanner.word("a number"));
  }
  void segments(const std::string& path, bool edges) {
    const Source source = load(path);
    Scanner scanner(path, source.bytes, '#');
    if (!edges) {
      const std::size_t n_points = scanner.count("points", 1);
      scanner.rest_of_line();
      // An outline with points of its own is the input of Triangle, not the mesh: its numbers do not fit.
      if (n_points > 0) return;
    }
    MeshFile& f = document_.file;
    const std::size_t n = scanner.count("segments", 6);
    const bool markers = scanner.more_on_line() && scanner.count("markers", 1) != 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = scanner.integer("the number of a segment");
      const auto text_line = static_cast<std::int64_t>(scanner.line());
      const std::int32_t a = scanner.vertex(first_), b = scanner.vertex(first_);
      const std::int32_t marker = markers ? scanner.integer("the marker of a segment") : 0;
      if (dimension_ == 3) skip_neighbors(scanner);
      if (edges && (marker == 0 || b + first_ == -1)) continue;
      document_.names->lines.push_back(number);
      document_.names->line_lines.push_back(text_line);
      f.lines.add({a, b}, marker);
    }
  }

  Source& source_;
  Document document_;
  std::int32_t first_ = 0;      // number of the first point
  std::int32_t dimension_ = 2;  // of points: 3 in TetGen's files
};

}  // namespace

std::string base_of_triangle(const std::string& path) { return without_suffix(without_suffix(path, ".node"), ".ele"); }

bool sniff_triangle(std::string_view head) { return kind_of(head) != TriangleFile::none; }

Document read_triangle(Source& source) { return TriangleReader(source).read(); }

std::vector<std::string> triangle_files(const std::string& path) {
  const std::string base = base_of_triangle(path);
  return {base + ".node", base + ".ele", base + ".poly", base + ".face", base + ".edge"};
}

std::vector<std::string> triangle_files_to_read(const std::string& path) {
  const std::string base = base_of_triangle(path);
  return {base + ".node", base + ".ele", base + (exists(base + ".poly") ? ".poly" : ".edge"), base + ".face"};
}

}  // namespace temper::io
